#pragma once

#include <string>
#include <vector>

#include "harness/base/json.h"

/// Second reader of the schemas in cases/schema, independent of the reader under test. It
/// determines the values that the schema rules forbid.
namespace trammel::fuzz {

using harness::Json;
using harness::JsonPointer;

/// Pointer to a value in a document, with the rules of the schema that apply to the value.
struct Place {
  JsonPointer at;
  std::vector<const Json*> rules;  ///< alternative rules; empty if unknown
  bool is_certain = false;         ///< true if no enclosing value has alternative rules
};

class Schema {
 public:
  explicit Schema(const std::string& name);

  /// Returns the document and all values in it, with their pointers and rules.
  [[nodiscard]] std::vector<Place> places(const Json& document) const;
  /// Returns the alternatives of a schema rule, with references resolved.
  [[nodiscard]] std::vector<const Json*> alternatives(const Json& rule) const;
  /// Returns the schema rules of an element of an object or array.
  [[nodiscard]] std::vector<const Json*> rules_of_entry(const std::vector<const Json*>& rules,
                                                        const std::string& key) const;
  [[nodiscard]] const Json& root() const { return root_; }

 private:
  Json root_;
};

/// Returns true if a schema rule forbids this value by its type, range, list of permitted words or
/// required keys.
[[nodiscard]] bool forbids(const Json& rule, const Json& value);

}  // namespace trammel::fuzz

#pragma once

#include <string>
#include <vector>

#include "harness/base/json.h"

/// What a schema of cases/schema says of each place in a document: read here anew, so that what it
/// forbids is known without the reader that is under test.
namespace trammel::fuzz {

using harness::Json;
using harness::JsonPointer;

/// A value in a document, with the rules that hold there.
struct Place {
  JsonPointer at;
  std::vector<const Json*> rules;  ///< one of them must be obeyed; empty: nothing is known
  bool is_certain = false;         ///< no choice between rules on the way to it
};

class Schema {
 public:
  explicit Schema(const std::string& name);

  /// The document itself and all that is in it.
  [[nodiscard]] std::vector<Place> places(const Json& document) const;
  /// What a rule comes to: references resolved, choices listed.
  [[nodiscard]] std::vector<const Json*> alternatives(const Json& rule) const;
  /// Rules of an entry of an object or array.
  [[nodiscard]] std::vector<const Json*> rules_of_entry(const std::vector<const Json*>& rules,
                                                        const std::string& key) const;
  [[nodiscard]] const Json& root() const { return root_; }

 private:
  Json root_;
};

/// Whether the rule alone forbids this value, whatever is in it: its type, its range, its words.
[[nodiscard]] bool forbids(const Json& rule, const Json& value);

}  // namespace trammel::fuzz

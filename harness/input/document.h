#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/base/errors.h"
#include "harness/base/json.h"

namespace trammel::harness {

/// File and JSON pointer at which the user wrote a value.
struct Origin {
  std::string file, pointer;
  /// `pointer` leads to the value of a sweep that replaces the value at this place.
  bool is_value = false;
};

/// Composes two merge patches that apply one after the other. Unlike a document, a patch keeps its
/// nulls.
void compose(Json& patch, const Json& later);

/// A JSON document made of layers, each a merge patch (RFC 7386) over the previous ones. It records
/// the file of each value, so that messages refer to the place written by the user.
class Document {
 public:
  /// Returns a document without further layers, which keeps its nulls.
  [[nodiscard]] static Document from_json(const std::string& file, const Json& json);

  /// Applies a patch. A null removes a key, except inside "variants", which are patches themselves.
  /// @param origin  pointer to the patch in `file`; empty: the complete file
  void apply_patch(const std::string& file, const std::string& origin, const Json& patch);
  /// Applies a patch that the file states as one number of a sweep. Errors refer to that number.
  void apply_value_patch(const std::string& file, const std::string& origin, const Json& patch);

  [[nodiscard]] const Json& value() const { return value_; }

  /// Returns the place where the value at `pointer`, or its innermost container, was last written.
  [[nodiscard]] Origin origin(const std::string& pointer) const;

  /// Returns an error for `pointer`, with the file and pointer at which the value was written.
  [[nodiscard]] InputError error(const std::string& pointer, const std::string& message) const;

  /// @throws InputError  if the document violates the schema of that name.
  void validate(const std::string& schema) const;

 private:
  struct Layer {
    std::string file, origin;
    std::shared_ptr<const Json> patch;  ///< shared by all copies of the document
    bool is_value = false;
  };
  Json value_ = Json::object();
  std::vector<Layer> layers_;
};

/// A violation of a schema and its place.
struct SchemaFault {
  std::string pointer;  ///< JSON pointer into the document; empty: the document itself
  std::string message;  ///< "expected ... (got ...)"
};

/// Returns the most deeply nested violation; empty if the document satisfies the schema.
/// @param schema  "case", "cost", "reference" or "results"
[[nodiscard]] std::optional<SchemaFault> find_schema_fault(const Json& document,
                                                           const std::string& schema);

}  // namespace trammel::harness

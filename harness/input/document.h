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
  /// True if `pointer` refers to a parameter value of a sweep, which replaces a value of the
  /// document.
  bool is_value = false;
};

/// Combines two merge patches into one: `patch`, followed by `later`. Nulls are kept, because they
/// remove keys when the combined patch is applied.
void compose_patches(Json& patch, const Json& later);

/// A JSON document made of layers, each a merge patch (RFC 7386) over the previous layers. The
/// document records the file of each value, so that messages refer to the file and key that the
/// user wrote.
class Document {
 public:
  /// Returns a document of one JSON value. Nulls are kept and do not remove keys.
  [[nodiscard]] static Document from_json(const std::string& file, const Json& json);

  /// Applies a merge patch. A null removes its key, except inside "variants", which contains
  /// patches.
  /// @param origin  JSON pointer of the patch in `file`; empty if the patch is the complete file
  void apply_patch(const std::string& file, const std::string& origin, const Json& patch);
  /// Applies a patch built from one value of a sweep. Error messages refer to this value in `file`.
  void apply_value_patch(const std::string& file, const std::string& origin, const Json& patch);

  [[nodiscard]] const Json& value() const { return value_; }

  /// Returns the file in which a value was last written, and its pointer in this file. If no file
  /// contains the value, returns the file of the innermost object around the value.
  [[nodiscard]] Origin origin(const std::string& pointer) const;

  /// Returns an error about the value at `pointer`, with the file and pointer at which the value
  /// was written.
  [[nodiscard]] InputError error(const std::string& pointer, const std::string& message) const;

  /// @throws InputError  if the document violates the schema with this name.
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

/// Violation of a JSON schema: message and position in the document.
struct SchemaFault {
  std::string pointer;  ///< JSON pointer into the document; empty: the document itself
  std::string message;  ///< text of the form "expected ... (got ...)"
};

/// Returns the most deeply nested violation; empty if the document satisfies the schema.
/// @param schema  "case", "cost", "reference" or "results"
[[nodiscard]] std::optional<SchemaFault> find_schema_fault(const Json& document,
                                                           const std::string& schema);

}  // namespace trammel::harness

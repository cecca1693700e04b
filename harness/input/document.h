#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/base/errors.h"
#include "harness/base/json.h"

namespace trammel::harness {

/// Where something was written.
struct Origin {
  std::string file, pointer;
  bool is_value = false;  ///< `pointer` leads to a sweep's value that stands in for the place
};

/// Makes one merge patch that does what two do one after the other: unlike a document, a patch
/// keeps its nulls.
void compose(Json& patch, const Json& later);

/// A JSON document made of layers, each a merge patch (RFC 7386) over those before it. It remembers
/// which file said what, so that a message points to where the user wrote it.
class Document {
 public:
  /// A document that nothing is laid over: its nulls are kept.
  [[nodiscard]] static Document from_json(const std::string& file, const Json& json);

  /// A null removes a key, except inside "variants", which are patches for later.
  /// @param origin  pointer in `file` where the patch stands; empty: the whole file
  void apply_patch(const std::string& file, const std::string& origin, const Json& patch);
  /// A patch that stands in the file as one number of a sweep: errors point to that number.
  void apply_value_patch(const std::string& file, const std::string& origin, const Json& patch);

  [[nodiscard]] const Json& value() const { return value_; }

  /// Where the value at `pointer`, or the innermost thing around it, was written last.
  [[nodiscard]] Origin origin(const std::string& pointer) const;

  /// The error of something at `pointer`, in the file and at the pointer where it was written.
  [[nodiscard]] InputError error(const std::string& pointer, const std::string& message) const;

  /// @throws InputError  where the document does not obey the schema of that name.
  void validate(const std::string& schema) const;

 private:
  struct Layer {
    std::string file, origin;
    std::shared_ptr<const Json> patch;  ///< one for all copies of the document
    bool is_value = false;
  };
  Json value_ = Json::object();
  std::vector<Layer> layers_;
};

/// What is wrong, and where.
struct SchemaFault {
  std::string pointer;  ///< JSON pointer into the document; empty: the document itself
  std::string message;  ///< "expected ... (got ...)"
};

/// The deepest fault of a document, empty when it obeys the schema.
/// @param schema  "case", "cost", "reference" or "results"
[[nodiscard]] std::optional<SchemaFault> find_schema_fault(const Json& document,
                                                           const std::string& schema);

}  // namespace trammel::harness

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/input/document.h"
#include "harness/input/json_view.h"

namespace trammel::harness {

class Catalogue;

/// Case file in JSON, merged with the case files that it extends. It satisfies the case schema.
struct Case {
  std::filesystem::path file;
  Document document;
  std::vector<std::string> chosen_variants = {};  ///< names of variants to run; empty: all

  [[nodiscard]] std::string id() const { return document.value().at("id").get<std::string>(); }
  [[nodiscard]] std::string title() const {
    return document.value().at("title").get<std::string>();
  }
  [[nodiscard]] std::vector<std::string> labels() const;
  /// Returns the names of all variants: "base" (no patch), then the variants in the order of the
  /// file.
  [[nodiscard]] std::vector<std::string> variants() const;
  [[nodiscard]] std::string variant_title(const std::string& variant) const;
};

inline constexpr const char* kBaseVariant = "base";

/// @throws InputError  if the case or an extended case cannot be read or violates the schema.
[[nodiscard]] Case load_case(const std::filesystem::path& file);
/// @param catalogue  cases to which the key "extends" may refer by name
[[nodiscard]] Case load_case(const std::filesystem::path& file, const Catalogue& catalogue);

/// Returns the case with the variant's patch applied. The result has no key "variants", and its
/// "description" is the description of the variant.
/// @throws InputError  for an unknown name of a variant, or if the patched case violates the
/// schema.
[[nodiscard]] Document patched(const Case& given, const std::string& variant);

/// Returns warnings about numbers that probably have a wrong unit: angles above 2 pi in a key
/// "..._rad", and coordinates or lengths that exceed all other lengths more than a hundredfold.
/// Each warning contains the JSON pointer of the number and the likely unit.
[[nodiscard]] std::vector<std::string> unit_warnings(const Document& document);

/// @param pointer  text in the document that is itself a JSON pointer: "/model/elements"
/// @throws InputError  if the pointer does not lead to a value of the document.
void require_pointer(const Document& document, const JsonView& pointer);

/// Returns the merge patch (RFC 7386) that sets the value at an existing pointer of a document.
[[nodiscard]] Json patch_setting_value(const Json& document, const std::string& pointer,
                                       const Json& value);

/// One level of a parameter sweep: the value of the parameter, and the case with this value.
struct Level {
  double parameter = 0;
  Document document;
};

/// @param variant  case with the patch of a variant, as returned by `patched`
/// @throws InputError  if a swept pointer does not exist or a level violates the schema.
[[nodiscard]] std::vector<Level> sweep_levels(const Document& variant, const std::string& sweep);
/// Returns the levels of a sweep or study. Its JSON object has the key "values", and either
/// "pointers" or "patches".
[[nodiscard]] std::vector<Level> sweep_levels(const Document& variant, const JsonView& sweep);

}  // namespace trammel::harness

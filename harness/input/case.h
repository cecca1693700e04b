#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/input/document.h"
#include "harness/input/json_view.h"

namespace trammel::harness {

class Catalogue;

/// A case file merged with the cases that it extends. It satisfies the schema.
struct Case {
  std::filesystem::path file;
  Document document;
  std::vector<std::string> chosen_variants = {};  ///< variants to run; empty: all

  [[nodiscard]] std::string id() const { return document.value().at("id").get<std::string>(); }
  [[nodiscard]] std::string title() const {
    return document.value().at("title").get<std::string>();
  }
  [[nodiscard]] std::vector<std::string> labels() const;
  /// Returns "base", which is the unpatched case, then the variants in the order of the file.
  [[nodiscard]] std::vector<std::string> variants() const;
  [[nodiscard]] std::string variant_title(const std::string& variant) const;
};

inline constexpr const char* kBaseVariant = "base";

/// @throws InputError  if the file, or one that it extends, cannot be read or violates the schema.
[[nodiscard]] Case load_case(const std::filesystem::path& file);
/// @param catalogue  contains the cases that can be extended by name
[[nodiscard]] Case load_case(const std::filesystem::path& file, const Catalogue& catalogue);

/// Returns the case with the variant's patch applied. The result has no "variants", and its
/// "description" is that of the variant.
/// @throws InputError  for an unknown name, or if the patched case violates the schema.
[[nodiscard]] Document patched(const Case& given, const std::string& variant);

/// Returns warnings about numbers that probably have a wrong unit: angles above 2 pi in a key
/// "..._rad", and coordinates or lengths more than a hundred times all others of their kind. Each
/// warning names the pointer and the likely unit.
[[nodiscard]] std::vector<std::string> unit_warnings(const Document& document);

/// @param pointer  value of the document that is a JSON pointer
/// @throws InputError  if the pointer does not lead to a value of the document.
void require_pointer(const Document& document, const JsonView& pointer);

/// Returns the merge patch that sets the value at a pointer, which must exist in the document.
[[nodiscard]] Json patch_at(const Json& document, const std::string& pointer, const Json& value);

/// One level of a sweep: the swept number, and the case or variant with the level's patch.
struct Level {
  double parameter = 0;
  Document document;
};

/// @param variant  result of `patched`
/// @throws InputError  if a pointer does not exist or a patched level violates the schema.
[[nodiscard]] std::vector<Level> levels(const Document& variant, const std::string& sweep);
/// Returns the levels of a sweep or study, which has "values", and "pointers" or "patches".
[[nodiscard]] std::vector<Level> levels(const Document& variant, const JsonView& sweep);

}  // namespace trammel::harness

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/input/document.h"
#include "harness/input/json_view.h"

namespace trammel::harness {

class Catalogue;

/// A case file, with what it extends; obeys the schema.
struct Case {
  std::filesystem::path file;
  Document document;
  std::vector<std::string> chosen_variants = {};  ///< that are to be run; empty: all

  [[nodiscard]] std::string id() const { return document.value().at("id").get<std::string>(); }
  [[nodiscard]] std::string title() const {
    return document.value().at("title").get<std::string>();
  }
  [[nodiscard]] std::vector<std::string> labels() const;
  /// "base", which is the case unpatched, then the variants in the order of the file.
  [[nodiscard]] std::vector<std::string> variants() const;
  [[nodiscard]] std::string variant_title(const std::string& variant) const;
};

inline constexpr const char* kBaseVariant = "base";

/// @throws InputError  where the file, or one that it extends, cannot be read or breaks the schema.
[[nodiscard]] Case load_case(const std::filesystem::path& file);
/// @param catalogue  where names of cases to extend are looked up
[[nodiscard]] Case load_case(const std::filesystem::path& file, const Catalogue& catalogue);

/// The case with the variant's patch laid over it; "variants" itself is gone, and
/// "description" is the variant's.
/// @throws InputError  for an unknown name, or where the patched case breaks the schema.
[[nodiscard]] Document patched(const Case& given, const std::string& variant);

/// Numbers that are probably in another unit: angles above 2 pi in a key "..._rad", and coordinates
/// or lengths a hundred times all others of their kind. Each names the pointer and the likely unit.
[[nodiscard]] std::vector<std::string> unit_warnings(const Document& document);

/// @param pointer  a place that holds a JSON pointer
/// @throws InputError  where the pointer leads to nothing in the document.
void require_pointer(const Document& document, const JsonView& pointer);

/// The merge patch that puts the value at the pointer, which leads to something in the document.
[[nodiscard]] Json patch_at(const Json& document, const std::string& pointer, const Json& value);

/// One level of a sweep: the swept number, and the case or variant with the level's patch.
struct Level {
  double parameter = 0;
  Document document;
};

/// @param variant  what `patched` returned
/// @throws InputError  where a pointer leads nowhere or a patched level breaks the schema.
[[nodiscard]] std::vector<Level> levels(const Document& variant, const std::string& sweep);
/// The same of any place with values, and pointers or patches.
[[nodiscard]] std::vector<Level> levels(const Document& variant, const JsonView& sweep);

}  // namespace trammel::harness

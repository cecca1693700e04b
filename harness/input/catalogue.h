#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "harness/input/case.h"

namespace trammel::harness {

/// The case files below a folder, listed once.
class Catalogue {
 public:
  /// Lists the catalogue of the installation.
  Catalogue();
  /// @throws InputError  with both files, if two folders contain a case of the same name.
  explicit Catalogue(const std::filesystem::path& folder);

  /// Returns the files that can be run, by name. A file without an analysis, direct or inherited,
  /// exists only to be extended.
  [[nodiscard]] std::vector<std::filesystem::path> runnable_files() const;

  /// Returns the file of a case, given its name in the catalogue or its path.
  /// @throws InputError  with the nearest name, if there is none.
  [[nodiscard]] std::filesystem::path find_case(const std::string& name_or_file) const;

  /// Returns the file of "extends" in `from`: relative to that file, or a name of the catalogue.
  /// @throws InputError  if there is none.
  [[nodiscard]] std::filesystem::path find_base_case(const std::string& name_or_file,
                                                     const std::filesystem::path& from) const;

  /// Returns the cases that have all `labels` and at least one of `any_labels`, if there are any.
  /// @throws InputError  for a label that no case has, or if no case is selected.
  [[nodiscard]] std::vector<Case> load(const std::vector<std::string>& labels = {},
                                       const std::vector<std::string>& any_labels = {}) const;

 private:
  [[nodiscard]] std::filesystem::path by_name(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] bool has_analysis(const std::filesystem::path& file, int depth = 0) const;

  std::vector<std::pair<std::string, std::string>> files_;  ///< pairs of id and path, sorted by id
};

/// Loads a case, given its name in the catalogue or its path.
/// @throws InputError  as Catalogue::find_case and load_case.
[[nodiscard]] Case load_named_case(const std::string& name_or_file);

}  // namespace trammel::harness

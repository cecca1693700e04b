#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "harness/input/case.h"

namespace trammel::harness {

/// Catalogue of all case files below a folder. The folder is searched on construction. The folder
/// of the installation is searched only once per process.
class Catalogue {
 public:
  /// Lists the case files of the installation.
  Catalogue();
  /// @throws InputError  if two case files have the same name. The message contains both paths.
  explicit Catalogue(const std::filesystem::path& folder);

  /// Returns the case files with an analysis, sorted by name. Files that neither state nor inherit
  /// an analysis serve only as a base of other cases.
  [[nodiscard]] std::vector<std::filesystem::path> runnable_files() const;

  /// Returns the file of a case, given its name in the catalogue or its path.
  /// @throws InputError  if the case does not exist. The message suggests the most similar name.
  [[nodiscard]] std::filesystem::path find_case(const std::string& name_or_file) const;

  /// Returns the case file to which the key "extends" of `extending_file` refers: a path relative
  /// to `extending_file` or a name in the catalogue.
  /// @throws InputError  if the case file does not exist.
  [[nodiscard]] std::filesystem::path find_base_case(
      const std::string& name_or_file, const std::filesystem::path& extending_file) const;

  /// Returns the cases with all `labels` and, unless `any_labels` is empty, one of `any_labels`.
  /// @throws InputError  for a label that no case has, or if no case is selected.
  [[nodiscard]] std::vector<Case> load(const std::vector<std::string>& labels = {},
                                       const std::vector<std::string>& any_labels = {}) const;

 private:
  [[nodiscard]] std::filesystem::path file_of_name(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] bool has_analysis(const std::filesystem::path& file, int depth = 0) const;

  std::vector<std::pair<std::string, std::string>> files_;  ///< pairs of id and path, sorted by id
};

/// Returns true if a file is below the folder of the catalogue. Symbolic links are followed.
[[nodiscard]] bool is_in_catalogue(const std::filesystem::path& file);

/// Loads a case, given its name in the catalogue or its path.
/// @throws InputError  under the conditions of Catalogue::find_case and load_case.
[[nodiscard]] Case load_named_case(const std::string& name_or_file);

}  // namespace trammel::harness

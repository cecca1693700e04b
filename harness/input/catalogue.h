#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "harness/input/case.h"

namespace trammel::harness {

/// The case files of all rooms of a folder, listed once.
class Catalogue {
 public:
  /// The catalogue of the data.
  Catalogue();
  /// @throws InputError  that names both files, where two rooms have a case of one name.
  explicit Catalogue(const std::filesystem::path& folder);

  /// Files that can be run, by name. A file without an analysis of its own or inherited is there to
  /// be extended.
  [[nodiscard]] std::vector<std::filesystem::path> runnable_files() const;

  /// The file meant by a name of the catalogue or by a path.
  /// @throws InputError  with the nearest name, where there is none.
  [[nodiscard]] std::filesystem::path find_case(const std::string& name_or_file) const;

  /// The file meant by "extends" in `from`: relative to that file, or a name of the catalogue.
  /// @throws InputError  where there is none.
  [[nodiscard]] std::filesystem::path find_base_case(const std::string& name_or_file,
                                                     const std::filesystem::path& from) const;

  /// Returns the cases that have all `labels` and at least one of `any_labels`, if there are any.
  /// @throws InputError  for a label that no case has.
  [[nodiscard]] std::vector<Case> load(const std::vector<std::string>& labels = {},
                                       const std::vector<std::string>& any_labels = {}) const;

 private:
  [[nodiscard]] std::filesystem::path by_name(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] bool has_analysis(const std::filesystem::path& file, int depth = 0) const;

  std::vector<std::pair<std::string, std::string>> files_;  ///< by id, which is the file's name
};

/// The case meant by a name of the catalogue or by a path.
/// @throws InputError  as Catalogue::find_case and load_case.
[[nodiscard]] Case load_named_case(const std::string& name_or_file);

}  // namespace trammel::harness

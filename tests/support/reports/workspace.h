#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace trammel::testing {

/// A folder that is gone at the end of the test.
class Workspace {
 public:
  Workspace();
  ~Workspace();
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Writes a results file. @returns its path.
  [[nodiscard]] std::filesystem::path results(const nlohmann::ordered_json& json) const;

 private:
  std::filesystem::path path_;
};

[[nodiscard]] std::string text_of(const std::filesystem::path& file);

/// As `reports::write_report`, from a results file.
std::filesystem::path write_report_of(const std::filesystem::path& results_json,
                                      const std::filesystem::path& out, bool single_file = false);

/// The pages of a report by their paths below its folder, and all of them as one text.
[[nodiscard]] std::map<std::string, std::string> pages_of(const std::filesystem::path& report);
[[nodiscard]] std::string text_of_pages(const std::filesystem::path& report);

/// The report of the sample, made once for all tests of this program.
[[nodiscard]] const std::filesystem::path& sample_report();

}  // namespace trammel::testing

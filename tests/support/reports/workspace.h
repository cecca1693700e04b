#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "harness/results/results.h"

namespace trammel::testing {

/// Temporary folder that is deleted at the end of its scope.
class Workspace {
 public:
  Workspace();
  ~Workspace();
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

[[nodiscard]] std::string read_text_file(const std::filesystem::path& file);

/// Returns the texts of all pages of a report by their relative paths.
[[nodiscard]] std::map<std::string, std::string> pages_of(const std::filesystem::path& report);
[[nodiscard]] std::string text_of_pages(const std::filesystem::path& report);

/// Returns results of a few cases of the catalogue with every kind of failure added: a failed
/// check, a check without a number, a check that is not judged, a check that did not run, a
/// singular run and a run with an error. The title of the beam contains characters that are special
/// in HTML, XML, CSV and gnuplot. These commands renew the files in results/:
///
///     trammel converge beam-pinned-pinned --variant base --json >results/beam.json
///     trammel converge vpcs-sdll02 --json >results/benchmark.json
///     trammel run manipulator-modes table-1-audit --variant base --json >results/manipulator.json
[[nodiscard]] results::Results sample_results();

/// Returns the sample results with the runs of one case only.
[[nodiscard]] results::Results sample_results_of_case(const std::string& case_id);

/// Returns the folder of a report of the sample results, which is written once for all tests of
/// this program.
[[nodiscard]] const std::filesystem::path& sample_report();

/// Returns the text of the front page of a report of these results.
[[nodiscard]] std::string page_of(const results::Results& results);
[[nodiscard]] std::string all_pages_of(const results::Results& results);

}  // namespace trammel::testing

#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "harness/results/results.h"

namespace trammel::testing {

/// A folder that is gone at the end of the test.
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

[[nodiscard]] std::string text_of(const std::filesystem::path& file);

/// The pages of a report by their paths below its folder, and all of them as one text.
[[nodiscard]] std::map<std::string, std::string> pages_of(const std::filesystem::path& report);
[[nodiscard]] std::string text_of_pages(const std::filesystem::path& report);

/// Results of a few cases of the catalogue, with one of everything that goes wrong, which the
/// catalogue does not have: a check that fails, one without a number, one that is not judged and
/// one that did not run, a singular run and a run with an error. The title of the beam contains
/// characters that are special in HTML, XML, CSV and gnuplot. The files in results/ are renewed by
///
///     trammel converge beam-pinned-pinned --variant base --json >results/beam.json
///     trammel converge vpcs-sdll02 --json >results/benchmark.json
///     trammel run manipulator-modes table-1-audit --variant base --json >results/manipulator.json
[[nodiscard]] results::Results sample_results();

/// The sample with the runs of one case only.
[[nodiscard]] results::Results sample_of(const std::string& case_id);

/// The report of the sample, made once for all tests of this program.
[[nodiscard]] const std::filesystem::path& sample_report();

/// The first page of a report of these results, and all its pages as one text.
[[nodiscard]] std::string page_of(const results::Results& results);
[[nodiscard]] std::string all_pages_of(const results::Results& results);

}  // namespace trammel::testing

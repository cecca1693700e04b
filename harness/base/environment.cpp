#include "harness/base/environment.h"

#include <fmt/chrono.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <ctime>
#include <fstream>
#include <thread>

#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "trammel_build.h"
#include "trammel_commit.h"

namespace trammel::harness {
namespace {

/// Finds the first line of a file that starts with `key`. Returns the text after ':' or '=' in this
/// line, or "unknown".
std::string line_of(const char* file, const std::string& key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(key, 0) != 0) continue;
    const auto start = line.find_first_of(":=");
    if (start == std::string::npos) continue;
    const auto from = line.find_first_not_of(" \t\"", start + 1);
    const auto to = line.find_last_not_of(" \t\"");
    if (from != std::string::npos && to >= from) return line.substr(from, to - from + 1);
  }
  return "unknown";
}

}  // namespace

Json build_and_machine_info() {
  Json libraries = {
      {"Eigen",
       fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"Spectra", TRAMMEL_SPECTRA_VERSION},
      {"nlohmann_json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR,
                                    NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
      {"CLI11", CLI11_VERSION},
      {"Boost", TRAMMEL_BOOST_VERSION},
      {"GSL", TRAMMEL_GSL_VERSION},
      {"gnuplot", TRAMMEL_GNUPLOT_VERSION}};
  return {{"trammel", TRAMMEL_VERSION},
          {"commit", TRAMMEL_COMMIT},
          {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))},
          {"compiler", TRAMMEL_COMPILER},
          {"flags", TRAMMEL_FLAGS},
          {"build_type", TRAMMEL_BUILD_TYPE},
          {"libraries", libraries},
          {"processor", line_of("/proc/cpuinfo", "model name")},
          {"cores", std::max(1U, std::thread::hardware_concurrency())},
          {"system", line_of("/etc/os-release", "PRETTY_NAME")}};
}

std::string file_hash(const std::filesystem::path& file) {
  try {
    return content_hash(read_text(file));
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace trammel::harness

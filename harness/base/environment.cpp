#include "harness/base/environment.h"

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <ctime>
#include <fstream>
#include <thread>

#include "trammel_build.h"
#include "trammel_commit.h"

namespace trammel::harness {
namespace {

std::string date() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

/// The value behind the first line of a file that starts with `key`.
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

std::string eigen_version() {
  return std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
         std::to_string(EIGEN_MINOR_VERSION);
}

std::string nlohmann_version() {
  return std::to_string(NLOHMANN_JSON_VERSION_MAJOR) + "." +
         std::to_string(NLOHMANN_JSON_VERSION_MINOR) + "." +
         std::to_string(NLOHMANN_JSON_VERSION_PATCH);
}

}  // namespace

Json environment() {
  Json libraries = {{"Eigen", eigen_version()},
                    {"Spectra", TRAMMEL_SPECTRA_VERSION},
                    {"nlohmann_json", nlohmann_version()},
                    {"CLI11", CLI11_VERSION},
                    {"Boost", TRAMMEL_BOOST_VERSION},
                    {"GSL", TRAMMEL_GSL_VERSION},
                    {"gnuplot", TRAMMEL_GNUPLOT_VERSION}};
  return {{"trammel", TRAMMEL_VERSION},
          {"commit", TRAMMEL_COMMIT},
          {"date", date()},
          {"compiler", TRAMMEL_COMPILER},
          {"flags", TRAMMEL_FLAGS},
          {"build_type", TRAMMEL_BUILD_TYPE},
          {"libraries", libraries},
          {"processor", line_of("/proc/cpuinfo", "model name")},
          {"cores", std::max(1U, std::thread::hardware_concurrency())},
          {"system", line_of("/etc/os-release", "PRETTY_NAME")}};
}

}  // namespace trammel::harness

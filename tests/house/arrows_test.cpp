// The arrows of the house: which folder may include what. See CONTRIBUTING.md.
#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace fs = std::filesystem;

namespace {

struct Arrows {
  std::set<std::string> folders;    ///< own folders it may include
  std::set<std::string> forbidden;  ///< outside libraries it must not know
};

const std::map<std::string, Arrows>& rules() {
  static const std::map<std::string, Arrows> table = {
      {"solver",
       {{"solver"},
        {"nlohmann", "rapidjson", "CLI", "gsl", "kainjow", "gnuplot-iostream.h", "fstream"}}},
      {"references",
       {{"references"}, {"Eigen", "Spectra", "CLI", "kainjow", "gnuplot-iostream.h"}}},
      {"harness", {{"harness", "solver", "references"}, {"kainjow", "gnuplot-iostream.h", "gsl"}}},
      {"reports", {{"reports"}, {"Eigen", "Spectra", "CLI", "gsl"}}},
  };
  return table;
}

/// The one place where the stops meet: the program's entry, which hands a results file to the
/// report.
bool is_exception(const std::string& file, const std::string& target) {
  return file == "harness/cli/main.cpp" && target.rfind("reports/", 0) == 0;
}

/// Of references/, the harness reads the stored data and never the programs that derive it.
bool is_derivation(const std::string& target) {
  return target.rfind("references/", 0) == 0 && target.rfind("references/data/", 0) != 0;
}

std::string first_part(const std::string& target) {
  return target.substr(0, target.find('/'));
}

}  // namespace

BOOST_AUTO_TEST_SUITE(arrows)

BOOST_AUTO_TEST_CASE(no_include_goes_against_the_arrows) {
  const fs::path root = TRAMMEL_SOURCE_DIR;
  const std::regex include(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  const std::set<std::string> own = {"solver", "references", "harness", "reports", "tests"};
  int seen = 0;
  for (const auto& [folder, rule] : rules()) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      const std::string file = fs::relative(entry.path(), root).generic_string();
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) {
        std::smatch match;
        if (!std::regex_search(line, match, include)) continue;
        ++seen;
        const std::string target = match[1];
        const std::string part = first_part(target);
        const bool allowed_folder = own.count(part) == 0 || rule.folders.count(part) > 0;
        const bool harness_derives = folder == "harness" && is_derivation(target);
        BOOST_TEST((is_exception(file, target) ||
                    (allowed_folder && rule.forbidden.count(part) == 0 && !harness_derives)),
                   file << " must not include " << target);
      }
    }
  }
  BOOST_TEST(seen > 10);
}

BOOST_AUTO_TEST_SUITE_END()

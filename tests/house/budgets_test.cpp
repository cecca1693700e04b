// Compares numbers of files and code lines of the project with the limits in budgets.json. If a
// number decreases, its limit must be reduced to this number, but not below the budget.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

BOOST_AUTO_TEST_SUITE(budgets)

namespace fs = std::filesystem;

namespace {

constexpr long kSmallHeader = 15;  // largest number of code lines of a small header

struct Sizes {
  std::map<std::string, long> code_lines;  ///< of C++ by top folder; "python" for all folders
  long files = 0;
  long small_headers = 0;
};

/// Counts the lines that are neither blank nor a comment only.
long code_lines(const fs::path& file, const std::string& comment) {
  std::ifstream in(file);
  long count = 0;
  for (std::string line; std::getline(in, line);) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin != std::string::npos && line.compare(begin, comment.size(), comment) != 0) ++count;
  }
  return count;
}

/// Returns true for generated folders, as in .gitignore, and for hidden folders of other programs.
bool is_made(const fs::path& folder) {
  static const std::set<std::string> made = {"build", "out", "__pycache__", "fuzz-findings"};
  const std::string name = folder.filename().string();
  return made.count(name) > 0 || name.rfind("trammel-", 0) == 0 ||
         (name[0] == '.' && name != ".ci");
}

Sizes bounded_magnitudes(const fs::path& root) {
  Sizes sizes;
  for (auto it = fs::recursive_directory_iterator(root); it != fs::end(it); ++it) {
    if (it->is_directory()) {
      if (is_made(it->path())) it.disable_recursion_pending();
      continue;
    }
    ++sizes.files;
    const std::string extension = it->path().extension().string();
    const std::string folder = it->path().lexically_relative(root).begin()->string();
    if (extension == ".py") sizes.code_lines["python"] += code_lines(it->path(), "#");
    if (extension != ".cpp" && extension != ".h") continue;
    const long lines = code_lines(it->path(), "//");
    sizes.code_lines[folder] += lines;
    if (extension == ".h" && lines <= kSmallHeader) ++sizes.small_headers;
  }
  return sizes;
}

void check(const std::string& what, long count, const nlohmann::json& entry) {
  const long limit = entry.at("limit"), budget = entry.at("budget");
  BOOST_TEST(count <= limit, what << ": " << count << " exceed the limit of " << limit);
  BOOST_TEST(limit <= std::max(count, budget),
             what << ": the limit of " << limit << " can go down to " << std::max(count, budget));
  BOOST_TEST(limit >= budget, what << ": the limit is below the budget of " << budget);
}

}  // namespace

BOOST_AUTO_TEST_CASE(code_sizes_are_within_and_close_to_their_limits) {
  const fs::path root = TRAMMEL_SOURCE_DIR;
  std::ifstream in(root / "tests/house/budgets.json");
  const nlohmann::json budgets = nlohmann::json::parse(in);
  const Sizes sizes = bounded_magnitudes(root);
  for (const auto& [name, entry] : budgets.at("code_lines").items())
    check(name, sizes.code_lines.at(name), entry);
  check("files", sizes.files, budgets.at("files"));
  check("small headers", sizes.small_headers, budgets.at("small_headers"));
}

BOOST_AUTO_TEST_SUITE_END()

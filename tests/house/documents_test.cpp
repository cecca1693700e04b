// Tests that the files and names in README.md, CONTRIBUTING.md and other documents exist.
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(documents)

namespace fs = std::filesystem;

namespace {

const fs::path root = TRAMMEL_SOURCE_DIR;

std::string read_text_file(const std::string& file) {
  std::ifstream in(root / file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::string> found(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> all;
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at)
    all.push_back((*at)[1]);
  return all;
}

}  // namespace

BOOST_AUTO_TEST_CASE(files_named_in_the_main_documents_exist) {
  const std::regex path("`((?:cases|harness|references|reports|solver|tests|\\.ci)/[\\w./-]*)`");
  for (const char* document : {"README.md", "CONTRIBUTING.md"}) {
    const std::vector<std::string> named = found(read_text_file(document), path);
    BOOST_TEST(!named.empty(), document);
    for (const std::string& file : named)
      BOOST_TEST(fs::exists(root / file), document << " names " << file);
  }
}

BOOST_AUTO_TEST_CASE(files_named_in_folder_readmes_exist) {
  const std::regex path("`([\\w-]+/[\\w./-]+\\.(?:h|cpp|json))`");
  for (const char* folder : {"solver", "harness", "references", "reports", "cases"}) {
    const std::string readme = std::string(folder) + "/README.md";
    const std::vector<std::string> named = found(read_text_file(readme), path);
    BOOST_TEST(named.size() > 4U, readme);
    for (const std::string& file : named)
      BOOST_TEST((fs::exists(root / folder / file) || fs::exists(root / file)),
                 readme << " names " << file);
  }
}

BOOST_AUTO_TEST_CASE(named_schema_of_a_file_exists) {
  const std::regex schema("\"\\$schema\": \"(\\.[^\"]*)\"");
  std::size_t named = 0;
  for (const char* folder : {"cases", "references/values"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.path().extension() != ".json") continue;
      const fs::path file = fs::relative(entry.path(), root);
      for (const std::string& path : found(read_text_file(file.string()), schema)) {
        ++named;
        BOOST_TEST(fs::exists(entry.path().parent_path() / path), file << " names " << path);
      }
    }
  BOOST_TEST(named > 300U);
}

BOOST_AUTO_TEST_CASE(case_format_names_every_analysis) {
  const auto schema = nlohmann::json::parse(read_text_file("cases/schema/case.schema.json"));
  const std::string readme = read_text_file("docs/cases.md");
  const auto ref = schema.at("properties").at("analysis").at("$ref").get<std::string>();
  const auto& analyses = schema.at(nlohmann::json::json_pointer(ref.substr(1))).at("properties");
  BOOST_TEST(analyses.size() > 10U);
  for (const auto& item : analyses.items())
    BOOST_TEST(readme.find("`" + item.key() + "`") != std::string::npos, item.key());
}

BOOST_AUTO_TEST_CASE(conventions_have_a_row_for_every_analysis) {
  const std::string text = read_text_file("cases/CONVENTIONS.md");
  const auto schema = nlohmann::json::parse(read_text_file("cases/schema/case.schema.json"));
  for (const auto& item : schema.at("definitions").at("analysis").at("properties").items())
    BOOST_TEST(text.find("\n| `" + item.key() + "` |") != std::string::npos, item.key());
  std::vector<std::string> cases;
  for (const auto& entry : fs::recursive_directory_iterator(root / "cases"))
    cases.push_back(entry.path().stem().string());
  // The last of the four columns of a table in CONVENTIONS.md lists cases.
  const std::regex last("\n\\|[^|\n]*\\|[^|\n]*\\|[^|\n]*\\|([^|\n]*`[^|\n]*)\\|(?=\n)");
  std::size_t named = 0;
  for (const std::string& column : found(text, last))
    for (const std::string& name : found(column, std::regex("`([\\w-]+)`"))) {
      ++named;
      BOOST_TEST((std::find(cases.begin(), cases.end(), name) != cases.end()), name);
    }
  BOOST_TEST(named > 40U);
}

BOOST_AUTO_TEST_SUITE_END()

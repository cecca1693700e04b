// Rules for comments, documents and texts of cases: first words, phrases, spelling and length.
#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(prose)

namespace fs = std::filesystem;
using Strings = std::vector<std::string>;

namespace {

const fs::path kRoot = TRAMMEL_SOURCE_DIR;
constexpr std::size_t kLongSentence = 30, kLongTestName = 55;  // words, characters

/// Quotations and other fragments that may break a rule. Each fragment must occur in a text.
const Strings kAllowed = {};

std::regex words(const std::string& alternatives) {
  return std::regex("\\b(" + alternatives + ")\\b", std::regex::icase | std::regex::optimize);
}

/// Text without code and quotations.
std::string plain(const std::string& text) {
  static const std::regex quotation("`[^`]*`|\"[^\"]*\""), link(R"(\]\([^)]*\))");
  return std::regex_replace(std::regex_replace(text, quotation, "quotation"), link, "");
}

/// Number of words of the longest sentence; symbols and formulas are no words.
std::size_t longest_sentence(const std::string& text) {
  static const std::regex counted("[(\"]*[A-Za-z][A-Za-z'-]+[.,;:!?)\"]*");
  std::istringstream in(text);
  std::size_t count = 0, longest = 0;
  for (std::string word; in >> word;) {
    if (std::regex_match(word, counted)) longest = std::max(longest, ++count);
    if (std::string(".!?:").find(word.back()) != std::string::npos) count = 0;
  }
  return longest;
}

/// Names of the rules that a text breaks.
Strings broken_rules(const std::string& text, bool is_document) {
  static const std::regex beginning("^(What|Which|Whether|How|Why|Where|Of|That)\\b.*");
  static const std::regex phrase = words(
      "beside|stands?|stood|(of|on) (its|their) own|comes? to(?! rest)|the whole|so "
      "many|reckon\\w*|told|"
      "tells?|(is|are) worth|what there is to|nothing but|no less than|it is said");
  static const std::regex british = words(
      "colour\\w*|centre\\w*|behaviour\\w*|\\w*metres?|neighbour\\w*|favour\\w*|analys(er?|ed|ing)|"
      "labelled|modell(ed|ing)|travell\\w*|cancell(ed|ing)|\\w+(al|im|ar|et)is(e|ed|es|ing)|"
      "recognis\\w*|artefact\\w*|licence|programmes?|fulfil|whilst|amongst|towards");
  const std::string prose = plain(text);
  Strings rules;
  if (!is_document && std::regex_match(text, beginning)) rules.emplace_back("first word");
  if (std::regex_search(prose, phrase)) rules.emplace_back("phrase");
  if (std::regex_search(prose, british)) rules.emplace_back("spelling");
  if (longest_sentence(prose) > kLongSentence) rules.emplace_back("long sentence");
  return rules;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

void join(std::string& text, const std::string& line) {
  text += (text.empty() ? "" : " ") + line;
}

/// Comments of a source. Comments on successive lines are one text. Formulas end sentences.
Strings comments_of_source(std::istream& in, const std::string& mark) {
  Strings texts(1);
  for (std::string line; std::getline(in, line);) {
    const std::size_t begin = line.find_first_not_of(' ');
    const bool is_comment =
        begin != std::string::npos && line.compare(begin, mark.size(), mark) == 0;
    const std::size_t text =
        is_comment ? line.find_first_not_of("/#!< ", begin) : std::string::npos;
    const bool is_formula = text != std::string::npos && text > begin + 4 && contains(line, " = ");
    if (is_formula)
      texts.back() += '.';
    else if (text != std::string::npos)
      join(texts.back(), line.substr(text));
    else if (!texts.back().empty())
      texts.emplace_back();
    const std::size_t behind = line.find("  " + mark + " ");  // a comment that follows code
    if (!is_comment && behind != std::string::npos)
      texts.insert(texts.end() - 1, line.substr(behind + mark.size() + 3));
  }
  return texts;
}

/// Paragraphs, items of lists and cells of tables, without blocks of code.
Strings paragraphs_of_document(std::istream& in) {
  static const std::regex item(R"(\s*([-*]|\d+\.|#+) (.*))");
  Strings texts(1);
  bool is_code = false;
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (line.starts_with("```")) is_code = !is_code;
    const bool is_item = std::regex_match(line, match, item), is_row = line.starts_with("|");
    if (is_item || is_row || is_code || line.empty() || line.starts_with("    "))
      texts.emplace_back();
    if (is_code || line.starts_with("    ") || line.starts_with("```")) continue;
    std::istringstream cells(is_row ? line.substr(1) : "");
    for (std::string cell; std::getline(cells, cell, '|');) texts.push_back(cell);
    if (!is_row) join(texts.back(), is_item ? match[2].str() : line);
  }
  return texts;
}

void collect_texts(const nlohmann::json& json, Strings& texts) {
  if (json.is_string() && json.get_ref<const std::string&>().find(' ') != std::string::npos)
    texts.push_back(json);
  if (json.is_structured())
    for (const nlohmann::json& entry : json) collect_texts(entry, texts);
}

Strings texts_of_file(const fs::path& file) {
  std::ifstream in(file);
  const std::string extension = file.extension().string();
  if (extension == ".h" || extension == ".cpp") return comments_of_source(in, "//");
  if (extension == ".py") return comments_of_source(in, "#");
  if (extension == ".md") return paragraphs_of_document(in);
  Strings texts;
  if (extension == ".json") collect_texts(nlohmann::json::parse(in), texts);
  return texts;
}

std::vector<fs::path> files() {
  std::vector<fs::path> files;
  for (const char* top : {"cases", "docs", "harness", "references", "reports", "solver", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / top))
      if (entry.is_regular_file()) files.push_back(entry.path());
  for (const char* name : {"README.md", "CONTRIBUTING.md", "CHANGELOG.md"})
    files.push_back(kRoot / name);
  return files;
}

}  // namespace

BOOST_AUTO_TEST_CASE(each_prose_rule_detects_its_violation) {
  std::string long_text;
  for (int i = 0; i < 31; ++i) join(long_text, "word");
  const std::pair<std::string, std::string> violations[] = {
      {"Which of them is larger.", "first word"},
      {"A line beside it.", "phrase"},
      {"The center and the colour.", "spelling"},
      {long_text, "long sentence"}};
  for (const auto& [text, rule] : violations)
    BOOST_TEST(broken_rules(text, false) == Strings{rule}, boost::test_tools::per_element());
  BOOST_TEST(broken_rules("Residual of `beside` and \"the whole\" [N].", false).empty());
  std::istringstream code("/// Returns\n/// it.\nint a;  // [m]\n"), page("A line\nof `b`.\n- c\n");
  BOOST_TEST(comments_of_source(code, "//").at(0) == "Returns it.");
  BOOST_TEST(paragraphs_of_document(page).at(0) == "A line of `b`.");
}

BOOST_AUTO_TEST_CASE(all_texts_obey_the_prose_rules) {
  std::set<std::string> used;
  for (const fs::path& file : files()) {
    if (file.extension() == ".json" && file.string().starts_with((kRoot / "tests").string()))
      continue;  // faults quote code
    for (const std::string& text : texts_of_file(file)) {
      const Strings rules = broken_rules(text, file.extension() == ".md");
      const auto allowed = std::ranges::find_if(
          kAllowed, [&](const auto& part) { return text.find(part) != std::string::npos; });
      if (rules.empty()) continue;
      if (allowed != kAllowed.end()) used.insert(*allowed);
      BOOST_TEST((allowed != kAllowed.end()), file << ": " << rules.front() << ": " << text);
    }
  }
  BOOST_TEST(used.size() == kAllowed.size());
  BOOST_TEST(kAllowed.size() <= 20U);
}

BOOST_AUTO_TEST_CASE(names_of_tests_are_short) {
  static const std::regex test(R"(BOOST_(AUTO|DATA)_TEST_CASE\(\s*(\w+))");
  for (const fs::path& file : files()) {
    if (file.extension() != ".cpp") continue;
    std::ifstream in(file);
    std::smatch match;
    for (std::string line; std::getline(in, line);)
      if (std::regex_search(line, match, test))
        BOOST_TEST(match[2].str().size() <= kLongTestName, file << ": " << match[2].str());
  }
}

BOOST_AUTO_TEST_SUITE_END()

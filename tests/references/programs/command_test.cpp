#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "references/data/family.h"
#include "references/programs/program.h"

BOOST_AUTO_TEST_SUITE(command)

namespace fs = std::filesystem;
using namespace trammel::references;

namespace {

const fs::path values = fs::path(TRAMMEL_SOURCE_DIR) / "references/values";

const fs::path roots_file = values / "beams/beam-modes.json";
const std::string roots_place = roots_file.string() + ":cantilever-roots";

Json roots() {
  return read_family(roots_file.string()).at("cantilever-roots");
}

struct Outcome {
  int status;
  std::string out, err;
};

Outcome run(const std::vector<std::string>& words) {
  std::ostringstream out;
  std::ostringstream err;
  const int status = derive_command(words, out, err);
  return {status, out.str(), err.str()};
}

/// Temporary file that is deleted at the end of the test.
class ScratchFile {
 public:
  explicit ScratchFile(const std::string& text)
      : path_(fs::temp_directory_path() /
              (std::string("trammel_command_test_") +
               std::to_string(std::hash<std::string>{}(text)) + ".json")) {
    std::ofstream(path_) << text;
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  ~ScratchFile() { fs::remove(path_); }
  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  fs::path path_;
};

bool is_one_line(const std::string& text) {
  return !text.empty() && text.find('\n') == text.size() - 1;
}

}  // namespace

BOOST_AUTO_TEST_CASE(valid_reference_is_printed_with_derived_values) {
  const Outcome outcome = run({roots_place});
  BOOST_TEST(outcome.status == 0);
  BOOST_TEST(outcome.out.find("cantilever-roots [1] by beam-roots") == 0U);
  BOOST_TEST(outcome.out.find("1.8751040687119611") != std::string::npos);
  BOOST_TEST(outcome.out.find("  confirmed\n") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(corrupted_reference_returns_status_1) {
  Json reference = roots();
  reference["values"][2] = reference["values"][2].get<double>() + 1e-9;
  const ScratchFile file(Json{{"cantilever-roots", reference}}.dump());
  const Outcome outcome =
      run({file.path(), (values / "manipulator/circle.json:centroid").string()});
  BOOST_TEST(outcome.status == 1);
  BOOST_TEST(outcome.out.find("NOT CONFIRMED") != std::string::npos);
  BOOST_TEST(outcome.out.find("centroid") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(unproved_digit_of_a_reference_is_printed) {
  Json reference = roots();
  const Outcome right = run({roots_place});
  BOOST_TEST(right.out.find("all digits stored are proved") != std::string::npos);
  std::string digits = reference["printed"][1].get<std::string>();
  digits.back() = digits.back() == '1' ? '2' : '1';
  reference["printed"][1] = digits;
  const ScratchFile file(Json{{"cantilever-roots", reference}}.dump());
  const Outcome wrong = run({file.path()});
  BOOST_TEST(wrong.status == 1);
  BOOST_TEST(wrong.out.find("  value 1: stored " + digits + ", proved ") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(published_reference_is_listed_without_derivation) {
  const Outcome outcome = run({(values / "paper/table-2.json:table-2-ansys").string()});
  BOOST_TEST(outcome.status == 0);
  BOOST_TEST(outcome.out == "table-2-ansys [Hz]: no derivation\n");
}

BOOST_AUTO_TEST_CASE(program_prints_its_values_with_all_digits) {
  const Outcome outcome =
      run({"--program", "beam-roots", "--arguments", R"({"ends": "pinned-pinned", "count": 1})"});
  BOOST_TEST(outcome.status == 0);
  BOOST_TEST(outcome.out == "3.1415926535897931\n");
}

BOOST_AUTO_TEST_CASE(every_program_is_listed) {
  const Outcome outcome = run({"--list"});
  BOOST_TEST(outcome.status == 0);
  for (const auto& [name, program] : programs())
    BOOST_TEST(("\n" + outcome.out).find("\n" + name + "\n    ") != std::string::npos, name);
}

BOOST_AUTO_TEST_CASE(invalid_usage_and_input_return_status_2_in_one_line) {
  const ScratchFile not_json("{\"id\": ");
  const ScratchFile bad_argument(R"({"x": {"title": "x", "kind": "exact", "unit": "1",
    "values": [1], "source": "x", "place": "x",
    "uncertainty": {"relative": 1}, "derivation": {"program": "beam-roots", "arguments": {}}}})");
  const ScratchFile twice(R"({"x": {}, "y": {}, "x": {}})");
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"--program", "none"}, "expected one of"},
      {{"--program", "beam-roots", "--arguments", "{"}, "--arguments: not JSON"},
      {{"--program", "beam-roots", "--arguments", "{}"}, "/ends: is missing"},
      {{"--unknown"}, "cannot use '--unknown'"},
      {{"no-such-file.json"}, "no-such-file.json: cannot be read"},
      {{not_json.path()}, "not JSON at byte"},
      {{twice.path()}, ": /x: expected every key once"},
      {{roots_file.string() + ":none"}, ": /none: expected a reference"},
      {{bad_argument.path()}, ": /x/derivation/arguments/ends: is missing"}};
  for (const auto& [words, expected] : cases) {
    const Outcome outcome = run(words);
    BOOST_TEST_CONTEXT(words.back()) {
      BOOST_TEST(outcome.status == 2);
      BOOST_TEST(is_one_line(outcome.err));
      BOOST_TEST(outcome.err.find(expected) != std::string::npos);
    }
  }
  BOOST_TEST(run({}).status == 2);
}

BOOST_AUTO_TEST_SUITE_END()

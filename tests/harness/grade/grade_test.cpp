// ctest: labels=program timeout=300
#include "harness/grade/grade.h"

#include <sys/wait.h>

#include <boost/test/unit_test.hpp>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>

#include "harness/base/json_file.h"
#include "harness/input/document.h"
#include "harness/results/results.h"
#include "harness/results/run_grade.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(grade)

using namespace trammel;
using namespace trammel::testing;

namespace {

namespace fs = std::filesystem;

const fs::path kSource = TRAMMEL_SOURCE_DIR;

/// Runs trammel in the folder `folder`. @returns the exit status
int run(const Folder& folder, const std::string& words) {
  const std::string line = "cd '" + folder.path().string() + "' && '" + testing::trammel_program() +
                           "' " + words + " >out.txt 2>err.txt </dev/null";
  const int status = std::system(line.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string grade_words(const fs::path& adapter, const std::string& words) {
  return "grade 'python3 " + adapter.string() + "' " + words;
}

/// Returns the cantilever case with the given id and a check of the reaction at A (-100 N).
Json judged(const std::string& id) {
  Json json = testing::cantilever();
  json["id"] = id;
  json["checks"]["held"] = {{"quantity", "reaction_y_N:A"},
                            {"role", "verification"},
                            {"bound", {{"at_least", -101}, {"at_most", -99}, {"why", "100 N"}}}};
  return json;
}

results::Results read_results_in_folder(const Folder& folder, const std::string& out) {
  return results::read_results(folder.path() / out / "results.json");
}

const std::map<std::string, std::pair<std::string, std::string>> kHostile = {
    {"never-returns", {"timed out", "stopped after 8 s"}},
    {"leaves-children", {"agrees", ""}},
    {"fills-the-disk", {"crashed", "more than 50 MiB of files"}},
    {"writes-ten-gigabytes", {"crashed", ""}},
    {"takes-memory", {"crashed", "MemoryError"}},
    {"writes-half-a-json", {"broken", "result.json:"}},
    {"says-nan", {"broken", "result.json:"}},
    {"says-infinity", {"broken", "result.json:"}},
    {"other-unit", {"broken", "/quantities/reaction_y_N:A/unit: expected 'N' (got 'kN')"}},
    {"other-length", {"broken", "/quantities/frequency_Hz/values: expected 3 numbers (got 1)"}},
    {"longer", {"broken", "/quantities/frequency_Hz/values: expected 3 numbers (got 4)"}},
    {"other-name", {"broken", "did you mean 'reaction_y_N:A'?"}},
    {"other-key", {"broken", "/verdict"}},
    {"prints-much", {"agrees", ""}},
    {"prints-for-ever", {"timed out", ""}},
    {"dies", {"crashed", "signal 11"}},
    {"fails", {"crashed", "exit status 1: the license has expired"}},
    {"says-nothing", {"broken", "the adapter has not written this file"}},
    {"links-to-zeros", {"broken", "result.json"}},
    {"makes-a-pipe", {"broken", "result.json"}},
    {"removes-its-folder", {"broken", "the adapter has not written this file"}},
    {"cannot", {"cannot", "no beams"}},
    {"cannot-say-why", {"cannot", "without a reason"}},
    {"gives-nothing", {"not given", ""}},
    {"is-off", {"off", ""}},
    {"well-behaved", {"agrees", ""}}};

bool is_process_alive(const fs::path& pid_file) {
  const int process = std::atoi(read_text(pid_file).c_str());
  BOOST_TEST_REQUIRE(process > 0);
  return kill(process, 0) == 0 || errno != ESRCH;
}

}  // namespace

BOOST_AUTO_TEST_CASE(misbehaving_adapter_program_fails_only_its_own_run) {
  const Folder folder;
  std::string names;
  for (const auto& item : kHostile) {
    Json json = judged(item.first);
    if (item.first == "other-length" || item.first == "longer") {
      json["analysis"] = {{"modes", {{"count", 3}}}};
      json["checks"]["held"]["quantity"] = "frequency_Hz";
    }
    names += " " + folder.write(json).filename().string();
  }
  const std::string words = grade_words(kSource / "tests/harness/grade/hostile.py", names) +
                            " --jobs 3 --max-time 8 --max-disk 50MiB --max-memory 2GB";
  BOOST_TEST(run(folder, words) == 1);
  const fs::path out = folder.path() / "trammel-grade";
  const auto fault = find_schema_fault(read_json(out / "results.json"), "results");
  BOOST_TEST(!fault.has_value(), (fault ? fault->pointer + ": " + fault->message : ""));
  const results::Results found = read_results_in_folder(folder, "trammel-grade");
  BOOST_TEST_REQUIRE(found.runs.size() == kHostile.size());
  for (const results::Run& row : found.runs) {
    const auto& [grade, reason] = kHostile.at(row.case_id);
    BOOST_TEST(to_string(results::grade_of_run(row)) == grade, row.case_id << ": " << row.reason);
    BOOST_TEST(contains(row.reason, reason), row.case_id << ": " << row.reason);
    BOOST_TEST(row.cost.wall_s < 20, row.case_id);
    std::error_code error;
    const fs::path calls = out / "calls" / row.case_id;
    BOOST_TEST(folder_size(calls, std::size_t{1} << 40) < std::size_t{20} << 20, row.case_id);
  }
  BOOST_TEST(found.solver->name == "hostile");
  BOOST_TEST(!found.cases.front().hash.empty());
  for (const char* mode : {"never-returns", "leaves-children"})
    BOOST_TEST(!is_process_alive(out / "calls" / mode / "base" / "pid"), mode);
  BOOST_TEST(contains(read_text(out / "junit.xml"), "skipped"));
}

BOOST_AUTO_TEST_CASE(missing_answer_exits_with_0_and_wrong_command_with_2) {
  const Folder folder;
  for (const char* id : {"cannot", "gives-nothing", "well-behaved"}) (void)folder.write(judged(id));
  const fs::path adapter = kSource / "tests/harness/grade/hostile.py";
  BOOST_TEST(
      run(folder, grade_words(adapter, "cannot.json gives-nothing.json well-behaved.json")) == 0);
  BOOST_TEST(run(folder, "grade ./no-such-adapter well-behaved.json") == 2);
  BOOST_TEST(run(folder, "grade well-behaved.json well-behaved.json") == 2);  // no executable
  BOOST_TEST(run(folder, grade_words(adapter, "no-such-case")) == 2);
  BOOST_TEST(run(folder, "grade 'python3 no-such-adapter.py' well-behaved.json") == 2);
}

BOOST_AUTO_TEST_CASE(grades_not_exported_and_cannot_are_distinct) {
  const Folder folder;
  (void)folder.write(judged("cannot"));
  const fs::path adapter = kSource / "tests/harness/grade/hostile.py";
  BOOST_TEST(
      run(folder, grade_words(adapter, "cannot.json manufactured-timoshenko --variant base")) == 0);
  const std::vector<results::Run> runs = read_results_in_folder(folder, "trammel-grade").runs;
  BOOST_TEST_REQUIRE(runs.size() == 2U);
  BOOST_TEST(to_string(results::grade_of_run(runs[0])) == "cannot");
  BOOST_TEST(to_string(results::grade_of_run(runs[1])) == "not exported");
  BOOST_TEST(runs[1].reason.rfind("/analysis/", 0) == 0U, runs[1].reason);
}

BOOST_AUTO_TEST_CASE(changed_adapter_is_not_resumed) {
  const Folder folder;
  (void)folder.write(judged("well-behaved"));
  const std::string source = read_text(kSource / "tests/harness/grade/hostile.py");
  const fs::path adapter = folder.write("adapter.py", source + "open('was-here', 'w')\n");
  const fs::path trace = folder.path() / "trammel-grade/calls/well-behaved/base/was-here";
  const std::string words = grade_words(adapter, "well-behaved.json --resume");
  BOOST_TEST(run(folder, words) == 0);
  BOOST_TEST(fs::remove(trace));
  BOOST_TEST(run(folder, words) == 0);
  BOOST_TEST(!fs::exists(trace));
  (void)folder.write("adapter.py", source + "open('was-here', 'w')\n# changed\n");
  BOOST_TEST(run(folder, words) == 0);
  BOOST_TEST(fs::exists(trace));
}

BOOST_AUTO_TEST_CASE(several_codes_are_compared_in_one_report) {
  const Folder folder;
  for (const char* id : {"is-off", "cannot", "dies"}) (void)folder.write(judged(id));
  const std::string names = "is-off.json cannot.json dies.json";
  BOOST_TEST(run(folder, grade_words(kSource / "tests/harness/grade/hostile.py", names)) == 1);
  BOOST_TEST(run(folder, "run " + names) == 0);
  BOOST_TEST(
      run(folder, "report trammel-results/results.json trammel-grade/results.json -o page") == 0);
  const std::string page = read_text(folder.path() / "page/index.html");
  for (const char* text : {"hostile", "trammel", "off", "cannot", "no beams", "crashed"})
    BOOST_TEST(contains(page, text), text);
  BOOST_TEST(run(folder, "report trammel-results/results.json is-off.json") == 2);
}

BOOST_AUTO_TEST_CASE(order_check_expects_the_order_declared_by_adapter) {
  const Folder folder;
  const std::string adapter = (kSource / "tests/harness/grade/hostile.py").string();
  const auto verdict = [&](const std::string& orders) {
    const int status = run(folder, grade_words(adapter + orders, "beam-cantilever --variant base"));
    const results::Results found = read_results_in_folder(folder, "trammel-grade");
    const results::Check& last = found.runs.at(0).checks.back();
    BOOST_TEST(last.name == "order");
    return std::to_string(status) + " " + to_string(last.verdict);
  };
  BOOST_TEST(verdict(" 2 2") == "0 pass");
  BOOST_TEST(verdict(" 2 4") == "1 fail");
  BOOST_TEST(verdict(" 2 null") == "0 not-given");
  BOOST_TEST(verdict(" 2 2 --no-level-converges") != "0 pass");  // the solver fails
}

BOOST_AUTO_TEST_CASE(documented_adapter_works_unchanged) {
  const Folder folder;
  const fs::path adapters = kSource / "harness/adapters";
  const std::string page = read_text(adapters / "README.md");
  const std::size_t begin = page.find("```python") + 10;
  (void)folder.write("handbook.py", page.substr(begin, page.find("```", begin) - begin));
  fs::copy_file(adapters / "trammel_adapter.py", folder.path() / "trammel_adapter.py");
  const std::string words = "cantilever-tip-force cantilever-tip-moment portal-frame";
  BOOST_TEST(run(folder, grade_words("handbook.py", words + " --variant base")) == 0);
  const std::vector<results::Run> runs = read_results_in_folder(folder, "trammel-grade").runs;
  BOOST_TEST_REQUIRE(runs.size() == 3U);
  for (const results::Run& row : runs)
    BOOST_TEST(to_string(results::grade_of_run(row)) ==
                   (row.case_id == "portal-frame" ? "cannot" : "agrees"),
               row.case_id << ": " << row.reason);
}

/// Returns the faults in the table of harness/adapters/README.md, each with the cases that detect
/// it.
std::map<std::string, std::set<std::string>> documented_faults() {
  std::map<std::string, std::set<std::string>> faults;
  std::istringstream page(read_text(kSource / "harness/adapters/README.md"));
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    inside = line.rfind("| fault |", 0) == 0 || (inside && line.rfind("|", 0) == 0);
    if (!inside || line.rfind("| `", 0) != 0) continue;
    std::vector<std::string> words;
    std::istringstream parts(line);
    for (std::string part; std::getline(parts, part, '`') && std::getline(parts, part, '`');)
      words.push_back(part);
    faults[words.front()] = {words.begin() + 1, words.end()};
  }
  return faults;
}

/// Grades the faulty solver on the named cases. @returns the cases with the grade "off"
std::set<std::string> cases_graded_off(const Folder& folder, const std::string& fault,
                                       const std::set<std::string>& cases, int status) {
  std::string names;
  for (const std::string& name : cases) names += " " + name;
  const std::string adapter = (kSource / "harness/adapters/wrong_solver.py").string() +
                              (fault.empty() ? "" : " --fault ") + fault;
  BOOST_TEST(run(folder, grade_words(adapter, names + " --variant base --jobs 2")) == status,
             fault);
  std::set<std::string> off;
  for (const results::Run& row : read_results_in_folder(folder, "trammel-grade").runs) {
    const auto found = results::grade_of_run(row);
    if (found == results::Grade::off) off.insert(row.case_id);
    if (found != results::Grade::off)
      BOOST_TEST(to_string(found) == "agrees", fault << " " << row.case_id << ": " << row.reason);
  }
  return off;
}

BOOST_AUTO_TEST_CASE(each_documented_solver_fault_fails_the_listed_cases) {
  const Folder folder;
  const auto faults = documented_faults();
  BOOST_TEST(faults.size() == 10U);
  std::set<std::string> cases;
  for (const auto& [fault, caught] : faults) cases.insert(caught.begin(), caught.end());
  BOOST_TEST(cases_graded_off(folder, "", cases, 0).empty());
  for (const auto& [fault, caught] : faults)
    BOOST_TEST((cases_graded_off(folder, fault, caught, 1) == caught), fault);
}

BOOST_AUTO_TEST_SUITE_END()

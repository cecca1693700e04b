// ctest: labels=program timeout=300
#include <sys/wait.h>

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "harness/base/json_file.h"
#include "harness/input/document.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(command_line)

using namespace trammel;
using namespace trammel::testing;

namespace {

struct Outcome {
  int status = -1;
  std::string out, err;
};

/// Runs the program trammel with command-line arguments (`words`) in a folder.
Outcome run(const Folder& folder, const std::string& words, const std::string& before = "") {
  const std::string line = "cd '" + folder.path().string() + "' && " + before + " '" +
                           testing::trammel_program() + "' " + words +
                           " >out.txt 2>err.txt </dev/null";
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(folder.path() / "out.txt"),
          read_text(folder.path() / "err.txt")};
}

Json judged(double at_most, const char* id = "cantilever") {
  Json json = testing::cantilever();
  json["id"] = id;
  json["checks"]["c"] = {{"quantity", "reaction_y_N:A"},
                         {"statistic", "max_abs"},
                         {"role", "verification"},
                         {"bound", {{"at_most", at_most}, {"why", "the load is 100 N"}}}};
  return json;
}

Json named(Json json, const char* id, const char* patch) {
  json["id"] = id;
  json.merge_patch(Json::parse(patch));
  return json;
}

std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Returns a folder with the input files of the calls in the tables of this test.
const Folder& files() {
  static const Folder folder;
  static const bool is_written = [] {
    const Json beam = testing::cantilever(), holds = judged(101), robot = testing::manipulator();
    for (const Json& json :
         {judged(101, "holds"), judged(99, "fails"), named(beam, "unjudged", "{}"),
          named(holds, "invalid", R"({"model": {"elements": -1}})"),
          named(holds, "variants", R"({"variants": {"again": {}}})"),
          named(holds, "lost", R"({"checks": {"c": {"bound": null, "reference": "nowhere",
                "tolerance": {"relative": 0.1, "why": "x"}}}})"),
          named(holds, "twofold", R"({"checks": {"c": {"bound": null, "reference": "nowhere",
                "tolerance": {"relative": 0.1, "absolute": 1, "why": "x"}}}})"),
          named(holds, "modes", R"({"analysis": {"statics": null, "modes": {"count": 2}}})"),
          named(beam, "frequencies", R"({"analysis": {"statics": null, "modes": {"count": 2}}})"),
          named(beam, "crowded", R"({"analysis": {"statics": null, "modes": {"count": 99}}})"),
          named(beam, "swept", R"({"analysis": {"statics": null, "modes": {"count": 2}},
                "sweeps": {"elements": {"pointers": ["/model/elements"],
                           "values": [1, 2, 4, 8, 16, 32], "theory_order": 4}}})"),
          named(beam, "narrow", R"({"checks": {"c": {"quantity": "reaction_y_N:A",
                "role": "verification", "bound": {"at_least": -100.0000001,
                "at_most": -99.9999999, "why": "x"}}}})"),
          named(beam, "drive", R"({"analysis": {"statics": null, "large-motion": {"end_time_s": 1,
                "step_s": 0.1, "drives": {"motor": {"node": "A", "motion": "rotation",
                "law": {"constant_speed": {"speed_per_s": 1}}}}}}})"),
          named(robot, "refused", R"({"analysis": {"modes": null, "statics": {}}, "model": {
                "manipulator": {"platform": {"kind": "triangles"}},
                "loads": {"P": {"moment_N_m": 1}}}})"),
          named(robot, "path", R"({"analysis": {"modes": null,
                "large-motion": {"track": "angles", "end_time_s": 1, "step_s": 0.05}},
                "model": {"pose": null, "manipulator": {"joints": {"elbow": "hinged"}},
                "trajectory": {"spline": {"points": 2, "step_s": 0.1, "knots": [
                {"time_s": 0, "x_m": 0.25, "y_m": 0.144, "phi_rad": 0},
                {"time_s": 0.1, "x_m": 0.26, "y_m": 0.144, "phi_rad": 0},
                {"time_s": 0.2, "x_m": 0.27, "y_m": 0.144, "phi_rad": 0}]}}}})")})
      (void)folder.write(json);
    (void)folder.write("broken.json", "{\"id\": ");
    (void)folder.write("other.json", R"({"a": 1})");
    (void)folder.write("references.json", R"({"first": {}, "nowhere-near": {}})");
    std::filesystem::create_directories(folder.path() / "blocked/index.html/inside");
    return run(folder, "run holds.json --out results").status == 0;
  }();
  BOOST_REQUIRE(is_written);
  return folder;
}

/// Program call that must end with status 2 and print one line that contains the message.
struct Refusal {
  const char *arguments, *message, *before = "";
};

std::ostream& operator<<(std::ostream& out, const Refusal& refusal) {
  return out << refusal.before << " trammel " << refusal.arguments;
}

const Refusal kRefusals[] = {
    {"", "expected a command (see trammel --help)"},
    {"rn", "expected a command (got 'rn'); did you mean 'run'?"},
    {"run holds.json --quantity load_factor", "--quantity requires --accuracy"},
    {"help verdict", "effects and accuracy (got 'verdict'); did you mean 'verdicts'?"},
    {"run variants.json:agian", "(got 'agian'); did you mean 'again'?"},
    {"run variants.json:", "a file that ends in .json (got 'variants.json:')"},
    {"run", "expected a case or label (see trammel run --help)"},
    {"run --nonsense x", "The following argument was not expected: --nonsense"},
    {"run none.json", "none.json: expected a readable file"},
    {"run /dev/zero", "/dev/zero: expected a readable file"},
    {"run holds.json --jobs 0", "--jobs: expected a number from 1 to 1024 (got 0)"},
    {"run holds.json --variant bse", "(got 'bse'); did you mean 'base'?"},
    {"run holds.json --out holds.json/x", "--out holds.json/x: expected a writable folder"},
    {"run holds.json", "TRAMMEL_HOME: expected a folder that contains cases/schema",
     "TRAMMEL_HOME=/nonexistent"},
    {"run holds.json", "expected a standard output that can be written",
     "sh -c 'exec \"$@\" >&-' sh"},
    {"run invalid.json", "invalid.json: /model/elements: expected a whole number at least 1"},
    {"quantities refused.json", "refused.json: /model/manipulator: "},
    {"list -L beam -L hard -L grnn", "no case of the catalogue has this combination of labels"},
    {"list -L nolabel", "expected a label of the catalogue (got 'nolabel')"},
    {"describe", "case is required (see trammel describe --help)"},
    {"describe twofold.json",
     "/checks/c/tolerance: expected exactly one of 'absolute' or 'relative'"},
    {"export holds.json --out /dev/full", "cannot be written (No space left on device)"},
    {"compare results", "expected at least two results files (got one)"},
    {"compare holds.json:base", "expected at least two variants or cases (got one"},
    {"compare results none.json", "none.json: expected a readable file"},
    {"compare results other.json", "other.json: /a: unknown key"},
    {"compare results holds.json", "expected either cases or results files (got both)"},
    {"converge holds.json", "holds.json: /: expected 'sweeps', which define the refinement"},
    {"cost mods",
     "expected the name or 'family' of a study in cases/cost, a case or a file (got 'mods'); did "
     "you mean 'modes'?"},
    {"cost unjudged.json", "unjudged.json: /: expected 'sweeps', which define the refinement"},
    {"cost modes --sweep elements", "--sweep and --variant apply to cases only"},
    {"cost modes --repeats 6", "--repeats requires at least 7 measurements (got 6)"},
    {"cost modes --out page", "PATH: expected a folder with gnuplot", "PATH=/nonexistent"},
    {"report holds.json --out page", "PATH: expected a folder with gnuplot", "PATH=/nonexistent"},
    {"certify unjudged.json", "no selected case has a check"},
    {"paper other.json", "other.json: /a: unknown key"},
    {"effects --repeats 0 --out page", "either cases or --label is required"},
    {"references tabel-2-ansys", "did you mean 'table-2-ansys'?"}};

/// Program call with its exit status and the expected parts of its output, in any order.
struct Call {
  const char* arguments;
  int status;
  std::vector<const char*> parts;
  const char* stream = "out";
};

std::ostream& operator<<(std::ostream& out, const Call& call) {
  return out << "trammel " << call.arguments;
}

const std::vector<Call> kCalls = {
    {"--help", 0, {"Usage: trammel"}},
    {"--version", 0, {"trammel 0.", "\ncommit ", "\nEigen "}},
    {"help run", 0, {"Usage: trammel run"}},
    {"help verdicts", 0, {"known discrepancy"}},
    {"list LUMPED", 0, {"lumped"}},
    {"list --label-any beam --label-any frame", 0, {"beam-cantilever", "portal-frame"}},
    {"run variants.json:again", 0, {"1 run, 1 check with 1 number: 1 pass"}},
    {"quantities variants.json:again", 0, {"displacement_y_m:B"}},
    {"run beam-cantilever --warn-above 1e-9 -q", 0, {"warning: estimated discretization"}},
    {"claims --help", 0, {"--json"}},  // without --help, the command computes the full catalogue
    {"run holds.json", 0, {"pass", "1 check with 1 number: 1 pass"}},
    {"run fails.json", 1, {"fail"}},
    {"run holds.json --quiet >all.txt; grep -c . all.txt", 0, {"2\n"}},
    {"run narrow.json --no-errors", 0, {"displacement_y_m:B ", "[-100.0000001, -99.9999999]"}},
    {"run frequencies.json", 0, {"frequency_Hz"}},
    {"run modes.json", 1, {"(computed quantities:"}},
    {"run lost.json",
     2,
     {"which is not in", "references/values); did you mean 'nowhere-near'?"},
     "err"},
    {"run crowded.json", 0, {"warning: 'count' is 99: the model has fewer modes"}},
    {"run refused.json", 2, {"refused.json: /model/manipulator: "}, "err"},
    {"run drive.json", 2, {": /analysis/large-motion/drives/motor: "}, "err"},
    {"run path.json", 2, {": /analysis/large-motion/end_time_s: "}, "err"},
    {"run manipulator-modes --variant rigid-platform",
     0,
     {"comparisons with the paper (ASME V&V 20)"}},
    {"report fails.json --out page", 1, {"report in page/index.html"}},
    {"report holds.json --out blocked", 2, {"blocked/index.html: expected a file"}, "err"},
    {"list >/dev/full 2>err.txt; exit $?; true",
     2,
     {"expected a standard output that can be written\n"},
     "err"},
    {"converge swept.json", 0, {"frequency_Hz[0]", "asymptotic", "order by theory 4"}},
    {"describe holds.json",
     0,
     {"planar model; 2 nodes, 1 member in 4 elements", "the load is 100 N"}},
    {"describe manipulator-modes", 0, {"half a unit in the last place of '0.0015'"}},
    {"effects scene-column:base scene-soft-platform --repeats 0 --out page",
     0,
     {"page in page/index.html"}},
    {"quantities", 0, {"peak_displacement_y_m:NODE", "estimated_correct_digits"}},
    {"quantities holds.json", 0, {"displacement_y_m:B", "displacement along y"}},
    {"references cantilever-roots", 0, {"1.87510406871196116644530824108"}},
    {"references cantilever-roots --json", 0, {"\"1.87510406871196116644530824108"}}};

}  // namespace

BOOST_DATA_TEST_CASE(refused_call_prints_one_line, kRefusals, refusal) {
  const Outcome outcome = run(files(), refusal.arguments, refusal.before);
  BOOST_TEST(outcome.status == 2);
  BOOST_TEST(outcome.out.empty(), outcome.out);
  BOOST_TEST(lines(outcome.err) == 1, outcome.err);
  BOOST_TEST(contains(outcome.err, refusal.message), outcome.err);
}

BOOST_DATA_TEST_CASE(command_line_prints_the_expected_text, kCalls, call) {
  const Outcome outcome = run(files(), call.arguments);
  BOOST_TEST(outcome.status == call.status, outcome.err);
  const bool to_err = std::string(call.stream) == "err";
  BOOST_TEST(outcome.err.empty() == !to_err, outcome.err);  // a pipe gets no progress bar
  BOOST_TEST(!contains(outcome.out, "\r"));
  for (const char* part : call.parts)
    BOOST_TEST(contains(to_err ? outcome.err : outcome.out, part), part << " in " << outcome.out);
}

BOOST_AUTO_TEST_CASE(roundoff_quantities_are_not_printed) {
  for (const char* words : {"run frequencies.json", "converge swept.json"})
    BOOST_TEST(!contains(run(files(), words).out, "roundoff"), words);
}

BOOST_AUTO_TEST_CASE(user_manipulator_is_run_with_references_in_its_folder) {
  const Folder folder;
  Json json = testing::manipulator();
  Json& robot = json["model"]["manipulator"];
  robot["links"]["proximal_length_m"] = {0.25, 0.24, 0.26};
  robot["links"]["distal_length_m"] = 0.3;
  robot["platform"].erase("side_m");
  robot["platform"]["vertices_m"] = {{-0.1, -0.05}, {0.12, -0.06}, {0, 0.11}};
  robot["working_mode"] = {1, -1, 1};
  json["model"]["pose"] = {{"x_m", 0.22}, {"y_m", 0.2}, {"phi_rad", 0.2}};
  json["checks"]["first"] = Json::parse(R"({
    "quantity": "frequency_Hz", "index": 0, "reference": "measured", "reference_index": 0,
    "role": "validation", "expect": {"agrees": "a rough bench", "ratio_between": [0.1, 10]}})");
  (void)folder.write(json);
  folder.write_reference("measured", "Hz", 12, {{"absolute", 1}});
  const Outcome outcome = run(folder, "run robot.json --out here/results");
  BOOST_TEST(outcome.status == 0, outcome.err);
  const Json results = read_json(folder.path() / "here/results/results.json");
  const auto fault = find_schema_fault(results, "results");
  BOOST_TEST(!fault.has_value(), (fault ? fault->pointer + ": " + fault->message : ""));
  BOOST_TEST(results["citations"][0] == "me");
  BOOST_TEST(results["runs"][0]["checks"][0]["verdict"] == "pass");
}

BOOST_AUTO_TEST_CASE(invalid_case_file_loses_no_results_of_other_files) {
  const Outcome outcome = run(files(), "run holds.json broken.json --out mixed");
  BOOST_TEST(outcome.status == 2);
  BOOST_TEST(contains(outcome.out, "2 runs, 1 check with 1 number: 1 pass"), outcome.out);
  BOOST_TEST(contains(outcome.out, "; 1 with status error"));
  BOOST_TEST(contains(outcome.err, "broken.json: line 1, column 8: expected JSON"));
  const Json results = read_json(files().path() / "mixed/results.json");
  BOOST_TEST(results["runs"].size() == 2U);
  BOOST_TEST(results["runs"][0]["status"] == "solved");
  BOOST_TEST(results["runs"][1]["status"] == "error");
}

BOOST_AUTO_TEST_CASE(second_call_into_one_folder_is_refused) {
  const Folder folder;
  (void)folder.write(judged(101));
  (void)folder.write("out/.trammel-lock", "process 4711");
  const std::string held = "flock -x -o out/.trammel-lock";
  for (const char* words : {"run cantilever.json --out out", "report cantilever.json --out out",
                            "cost cantilever.json --out out"}) {
    const Outcome second = run(folder, words, held);
    BOOST_TEST(second.status == 2, words);
    BOOST_TEST(contains(second.err,
                        "--out out: another call of trammel writes to this folder "
                        "(process 4711)"),
               second.err);
  }
  BOOST_TEST(run(folder, "run cantilever.json --out out").status == 0);
  std::set<std::string> left;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "out"))
    left.insert(entry.path().filename().string());
  BOOST_TEST((left == std::set<std::string>{"junit.xml", "results.json", "store"}));
}

BOOST_AUTO_TEST_CASE(lock_as_named_pipe_and_store_as_symlink_are_refused) {
  const Folder folder;
  (void)folder.write(judged(101));
  const auto message = [&](const std::string& before) {
    return run(folder, "run cantilever.json --out out", before + " && timeout 20").err;
  };
  BOOST_TEST(message("mkdir out && mkfifo out/.trammel-lock") ==
             "--out out: .trammel-lock is not a regular file\n");
  BOOST_TEST(message("rm out/.trammel-lock && mkdir mine && ln -s ../mine out/store") ==
             "--out out: 'store' is a symbolic link, which only --store accepts\n");
}

BOOST_AUTO_TEST_CASE(text_of_a_case_cannot_control_the_terminal) {
  const Folder folder;
  Json json = judged(101);
  json["title"] = "red \x1b[31m";
  (void)folder.write(json);
  for (const char* words : {"describe cantilever.json", "report cantilever.json --out out"})
    BOOST_TEST(!contains(run(folder, words).out, "\x1b"), words);
  BOOST_TEST(!contains(read_text(folder.path() / "out/index.html"), "\x1b"));
  json["model"]["nodes"]["x\n\x1b" + std::string(3000, 'k')] = "nowhere";
  (void)folder.write(json);
  const Outcome outcome = run(folder, "run cantilever.json");
  BOOST_TEST(outcome.status == 2);
  BOOST_TEST(lines(outcome.err) == 1, outcome.err);
  BOOST_TEST(contains(outcome.err, "\\u000a\\u001b"), outcome.err);
  BOOST_TEST(outcome.err.size() < 500U);
}

BOOST_AUTO_TEST_CASE(every_command_that_prints_a_table_takes_json) {
  const Folder folder;
  Json json = judged(101);
  json["sweeps"]["elements"] = {{"pointers", {"/model/elements"}},
                                {"values", {1, 2, 4}},
                                {"quantities", {{"displacement_y_m:B", Json::object()}}}};
  (void)folder.write(json);
  (void)run(folder, "run cantilever.json --shard 1/1 --out shard");
  const std::string program = "'" + testing::trammel_program() + "'", file = " cantilever.json";
  const std::vector<std::pair<std::string, std::string>> commands = {
      {"list", "/0/title"},
      {"describe" + file, "/model/nodes"},
      {"quantities", "/0/meaning"},
      {"quantities" + file, "/0/entries"},
      {"references", "/0/values"},
      {"run" + file + " --history h.db", "/runs/0/checks/0/verdict"},
      {"merge shard", "/runs/0/checks/0/verdict"},
      {"compare" + file + file, "/sides/0/label"},
      {"converge" + file, "/runs/0/convergence/0/values/2"},
      {"cost" + file, "/cost/studies/0/settings/0/cpu_s"},
      {"cost" + file + " --accuracy 0.01", "/search/0/setting"},
      {"certify cantilever-tip-force", "/configurations/0/checks"},
      {"coverage", "/0/evidence"},
      {"paper", "/0/what"},
      {"effects scene-soft-platform --repeats 0", "/runs/0/element_evaluations"},
      {"effects scene-column scene-soft-platform --repeats 0", "/1/minimal"},
      {"grade \"" + testing::trammel_program() + " solve\"" + file, "/runs/0/checks/0/verdict"},
      {"history h.db", "/calls/0/checks"}};
  std::set<std::string> seen = {"claims", "report", "export", "solve", "slurm"};
  for (const auto& [words, pointer] : commands) {
    seen.insert(words.substr(0, words.find(' ')));
    const Outcome outcome = run(folder, words + " --json");
    BOOST_TEST_REQUIRE(outcome.status < 2, words << ": " << outcome.err);
    BOOST_TEST(parse_json(outcome.out, words).contains(Json::json_pointer(pointer)), words);
  }
  BOOST_TEST(contains(run(folder, "cost cantilever.json --accuracy 0.01").out, "estimated error"));
  std::istringstream help(run(folder, "--help").out);
  std::string line, name;
  while (std::getline(help, line) && line != "Subcommands:") {
  }
  while (std::getline(help, line) && !line.empty())
    if (std::istringstream(line) >> name && line[2] != ' ')
      BOOST_TEST(seen.count(name) == 1U, name);
  BOOST_TEST(seen.size() > 15U);
}

BOOST_AUTO_TEST_CASE(drawings_are_written_as_vtk_files) {
  const Folder folder;
  (void)folder.write(judged(101));
  BOOST_TEST(run(folder, "run cantilever.json --vtk --out out").status == 0);
  const auto name = [&](const char* end) {
    return read_text(folder.path() / "out/vtk" / (std::string("cantilever-base-") + end));
  };
  BOOST_TEST(contains(name("shapes.pvd"), "file=\"cantilever-base-shapes-1.vtu\""));
  BOOST_TEST(contains(name("shapes-1.vtu"), "Name=\"displacement\" NumberOfComponents=\"3\""));
  BOOST_TEST(!contains(name("poses-1.vtu"), "displacement"));
  BOOST_TEST(contains(name("poses-1.vtu"), "\n2 0 0\n"));  // node B is at x = 2 m
}

BOOST_AUTO_TEST_CASE(report_draws_history_without_counting_time_twice) {
  const Folder folder;
  (void)folder.write(judged(101));
  for (const char* words : {"report cantilever.json --out out --history h.db",
                            "report cantilever.json --out out --history h.db"})
    BOOST_TEST(run(folder, words).status == 0);
  const Json calls = parse_json(run(folder, "history h.db --json").out, "out")["calls"];
  BOOST_REQUIRE(calls.size() == 2U);
  BOOST_TEST(calls[0]["cpu_s"].get<double>() > 0);
  BOOST_TEST(calls[1]["cpu_s"].get<double>() == 0);  // the second call used a stored run
  BOOST_TEST(calls[1]["work"] == calls[0]["work"]);
  const std::string page = read_text(folder.path() / "out/environment.html");
  BOOST_TEST(contains(page, "<section id=\"history\">"));
  BOOST_TEST(contains(page, "2 calls; no value changed since call 1"));
  BOOST_TEST(contains(page, "<figure id=\"fig-history\">"));
  BOOST_TEST(contains(page, "The newest call has 1 times the work"));
  BOOST_TEST(run(folder, "report out/results.json --out again").status == 0);
  BOOST_TEST(
      contains(read_text(folder.path() / "again/environment.html"), "<section id=\"history\">"));
}

BOOST_AUTO_TEST_CASE(data_folder_is_set_by_the_environment) {
  BOOST_TEST(run(files(), "run holds.json", "TRAMMEL_HOME='" TRAMMEL_SOURCE_DIR "'").status == 0);
}

BOOST_AUTO_TEST_CASE(any_number_of_variants_or_results_is_compared) {
  const Folder folder;
  Json json = judged(101);
  json["variants"]["soft"]["model"]["materials"]["steel"]["E_Pa"] = 1e11;
  json["variants"]["same"]["title"] = "the same again";
  (void)folder.write(json);
  const Outcome variants = run(folder, "compare cantilever.json cantilever.json:soft");
  BOOST_TEST(variants.status == 0, variants.err);
  BOOST_TEST(variants.out.rfind("soft against base: ", 0) == 0U, variants.out);
  BOOST_TEST(contains(variants.out, " by +100 %"), variants.out);
  const Json all = parse_json(run(folder, "compare cantilever.json --json").out, "out");
  BOOST_TEST(all["sides"].size() == 3U);
  BOOST_TEST(all["runs"][0]["changed"] == true);
  const Outcome csv = run(folder, "compare cantilever.json --csv");
  BOOST_TEST(contains(csv.out, "base [%],base +- [%],soft,soft [%],soft +- [%],same"), csv.out);
  BOOST_TEST(!contains(csv.out, "?"), csv.out);
  (void)run(folder, "run cantilever.json --out a");
  (void)run(folder, "run cantilever.json --out b --jobs 1");
  const Outcome same = run(folder, "compare a/results.json b --gate");
  BOOST_TEST(same.status == 0);
  BOOST_TEST(contains(same.out, "Nothing has changed: 3 runs are the same bit for bit"));
  json["model"]["elements"] = 5;
  (void)folder.write(json);
  (void)run(folder, "run cantilever.json --out b");
  const Outcome other = run(folder, "compare a b a --gate");
  BOOST_TEST(other.status == 1);
  BOOST_TEST(contains(other.out, "3 of 3 runs changed beyond round-off"), other.out);
  BOOST_TEST(run(folder, "compare a b").status == 0);
}

BOOST_AUTO_TEST_CASE(comparison_page_is_one_self_contained_html_file) {
  const Folder folder;
  Json json = judged(101);
  json["variants"]["soft"]["model"]["materials"]["steel"]["E_Pa"] = 1e11;
  json["figures"]["twice"] = Json::parse(R"({
    "title": "Tip", "caption": "Tip.", "x": "displacement_x_m:B", "y": ["displacement_y_m:B"]})");
  (void)folder.write(json);
  const Outcome outcome = run(folder, "compare cantilever.json --html out/page.html");
  BOOST_TEST(outcome.status == 0, outcome.err);
  const std::string page = read_text(folder.path() / "out/page.html");
  BOOST_TEST(contains(page, "soft against base"));
  BOOST_TEST(contains(page, "<svg "));
  BOOST_TEST(!contains(page, "<link"));
  BOOST_TEST(!contains(page, "src="));
  const std::filesystem::directory_iterator files(folder.path() / "out");
  BOOST_TEST(std::distance(begin(files), end(files)) == 1);
}

BOOST_AUTO_TEST_CASE(case_is_certified_over_rounding_modes) {
  const Folder folder;
  const Outcome outcome = run(folder, "certify cantilever-tip-force");
  BOOST_TEST(outcome.status == 0, outcome.err);
  for (const char* words : {"upwards", "downwards", "toward zero", "No verdict differs between"})
    BOOST_TEST(contains(outcome.out, words), outcome.out);
  const Json found = Json::parse(run(folder, "certify cantilever-tip-force --json").out);
  for (const Json& row : found.at("configurations"))
    BOOST_TEST(row.at("fewest_digits").get<double>() < 16, row.dump());
  (void)run(folder, "run cantilever-tip-force --out other");
  BOOST_TEST(run(folder, "certify cantilever-tip-force --results other").status == 0);
  Json other = read_json(folder.path() / "other/results.json");
  other["cases"]["cantilever-tip-force"]["hash"] = "9b12aadb-01ba-5329-ace7-33862ad0c057";
  (void)folder.write("other/results.json", other.dump());
  const Outcome stale = run(folder, "certify cantilever-tip-force --results other");
  BOOST_TEST(stale.status == 2);
  BOOST_TEST(
      contains(stale.err, "other/results.json: /cases/cantilever-tip-force/hash: the results"),
      stale.err);
}

BOOST_AUTO_TEST_CASE(second_report_computes_only_what_has_changed) {
  const Folder folder;
  (void)folder.write(judged(101));
  const std::string stored = "1 run (1 of them stored by an earlier call), 1 check";
  const auto stored_runs = [&] {
    return read_json(folder.path() / "mine/results.json")["environment"]["stored_runs"];
  };
  (void)run(folder, "report cantilever.json --out mine");
  BOOST_TEST(stored_runs() == 0);
  const Json results = read_json(folder.path() / "mine/results.json");
  BOOST_TEST(results["cases"].size() == 1U);
  BOOST_TEST(!results.contains("claims"));
  BOOST_TEST(contains(run(folder, "report cantilever.json --out mine").out, stored));
  BOOST_TEST(stored_runs() == 1);
  BOOST_TEST(!contains(run(folder, "report cantilever.json --out mine --fresh").out, "stored"));
  Json changed = judged(101);
  changed["model"]["elements"] = 2;
  (void)folder.write(changed);
  BOOST_TEST(!contains(run(folder, "report cantilever.json --out mine").out, "stored"));
  (void)run(folder, "report --out mine cantilever.json " + folder.write(judged(9, "b")).string());
  BOOST_TEST(contains(read_text(folder.path() / "mine/environment.html"), "1 of 2 runs with"));
}

BOOST_AUTO_TEST_CASE(reason_of_a_singular_run_is_printed_once) {
  const Folder folder;
  Json json = judged(101);
  json["model"].erase("supports");
  (void)folder.write(json);
  const Outcome outcome = run(folder, "run cantilever.json");
  BOOST_TEST(outcome.status == 1);
  const auto first = outcome.out.find("node B along x");
  BOOST_TEST(first != std::string::npos);
  BOOST_TEST(outcome.out.find("node B along x", first + 1) == std::string::npos, outcome.out);
}

namespace {

/// Applies a JSON block from the documentation to the case `example`. The block contains a
/// reference, a complete case, or a merge patch of the case. A line "..." represents keys that do
/// not change.
void apply_json_block(std::string block, Json& example, const Folder& folder) {
  if (const auto dots = block.find("    ...\n"); dots != std::string::npos) block.erase(dots, 8);
  const Json json = parse_json(block.front() == '{' ? block : "{" + block + "}", "block");
  if (json.front().contains("uncertainty")) {
    (void)folder.write("references.json", json.dump());
    example["checks"]["reaction"] = {{"quantity", "displacement_y_m:B"},
                                     {"variants", {"base"}},
                                     {"role", "verification"},
                                     {"reference", json.items().begin().key()},
                                     {"tolerance", {{"relative", 0.1}, {"why", "gauge"}}}};
    return;
  }
  if (json.contains("id")) example = json;
  if (json.contains("id") && json["id"] == "my-robot")
    BOOST_TEST((json == read_json(TRAMMEL_SOURCE_DIR "/docs/example/my-robot.json")));
  if (json.contains("analysis")) example.erase("analysis");
  example.merge_patch(json);
  if (!example["model"].contains("trajectory")) return;
  example.erase("checks");
  example["model"].erase("pose");
}

}  // namespace

BOOST_AUTO_TEST_CASE(commands_and_cases_in_documents_run_without_error) {
  static const std::regex command(R"re(^    (?:\./)?trammel (.*?)(?: +#.*)?$)re");
  const std::set<std::string> too_long = {"report", "test",
                                          "run -L verification --out results/catalogue"};
  for (const char* document :
       {"README.md", "docs/tutorial.md", "docs/cases.md", "docs/results.md"}) {
    std::istringstream text(read_text(std::filesystem::path(TRAMMEL_SOURCE_DIR) / document));
    const Folder folder;
    Json example;
    std::string fence, block;
    std::smatch match;
    for (std::string line; std::getline(text, line);) {
      Outcome outcome{0, "", ""};
      if (line.starts_with("```")) {
        if (fence == "```json") {
          apply_json_block(block, example, folder);
          const std::string file = example.at("id").get<std::string>() + ".json";
          (void)folder.write(file, example.dump());
          outcome = run(folder, "run " + file);
        } else if (fence == "```python") {
          (void)folder.write("example.py", block);
          outcome = run(folder, "run cantilever-tip-force >out && python3 example.py");
        }
        fence = fence.empty() ? line : "";
        block.clear();
      } else if (!fence.empty()) {
        block += line + "\n";
      } else if (std::regex_match(line, match, command) && too_long.count(match[1]) == 0) {
        const std::string solve = "'" + testing::trammel_program() + " solve'";
        outcome =
            run(folder, std::regex_replace(match[1].str(), std::regex("./my-adapter"), solve));
      }
      BOOST_TEST(outcome.status == 0, document << ": " << line << ": " << outcome.err);
    }
  }
}

BOOST_AUTO_TEST_CASE(every_case_of_the_catalogue_can_be_described) {
  for (const Json& listed : parse_json(run(files(), "list --json").out, "out")) {
    const auto id = listed.at("id").get<std::string>();
    const Outcome outcome = run(files(), "describe " + id);
    BOOST_TEST(outcome.status == 0, id << ": " << outcome.err);
  }
}

BOOST_AUTO_TEST_CASE(sweep_of_an_own_case_is_measured_and_written) {
  const Folder folder;
  Json json = testing::cantilever();
  json["analysis"] = {{"modes", {{"count", 2}}}};
  json["sweeps"]["elements"] = {{"pointers", {"/model/elements"}},
                                {"values", {1, 2, 4}},
                                {"quantities", {{"frequency_Hz", {{"index", {0, 1}}}}}}};
  (void)folder.write(json);
  const Outcome outcome = run(folder, "cost cantilever.json --sweep elements --out mine");
  BOOST_TEST(outcome.status == 0, outcome.err);
  BOOST_TEST(contains(outcome.out, "elements 2"));
  const Json results = read_json(folder.path() / "mine/results.json");
  BOOST_TEST(run(folder, "cost cantilever.json --sweep elements --out mine --resume").status == 0);
  BOOST_TEST((read_json(folder.path() / "mine/results.json")["cost"] == results["cost"]));
  BOOST_TEST(run(folder, "cost cantilever.json --sweep elements --out mine").status == 0);
  BOOST_TEST((read_json(folder.path() / "mine/results.json")["cost"] != results["cost"]));
  const auto fault = find_schema_fault(results, "results");
  BOOST_TEST(!fault.has_value(), (fault ? fault->pointer + ": " + fault->message : ""));
  BOOST_TEST(results["cost"]["sweep"] == "full");
  BOOST_TEST(results["cost"]["studies"][0]["settings"].size() == 3U);
  BOOST_TEST(std::filesystem::exists(folder.path() / "mine/index.html"));
  BOOST_TEST(std::filesystem::exists(folder.path() / "mine/figures/cost-cantilever.csv"));
}

BOOST_AUTO_TEST_CASE(full_disk_leaves_the_former_report_unchanged) {
  const Folder folder;
  (void)folder.write(testing::cantilever());
  BOOST_TEST(run(folder, "report cantilever.json --out out").status == 0);
  const auto contents = [&] {
    std::map<std::string, std::string> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path() / "out"))
      if (entry.is_regular_file() && entry.path().extension() != ".cbor")
        all[entry.path().string()] = read_text(entry.path());
    return all;
  };
  const auto former = contents();
  std::size_t broken_off = 0;
  for (const int blocks : {1, 2, 4, 8, 16, 32, 64, 128}) {  // limit of the file size / 512 bytes
    const Outcome full = run(folder, "report cantilever.json --out out",
                             "ulimit -f " + std::to_string(blocks) + " &&");
    if (full.status == 0) continue;
    ++broken_off;
    BOOST_TEST(full.status == 2, blocks << ": " << full.err);
    BOOST_TEST(lines(full.err) == 1, full.err);
    BOOST_TEST((contents() == former), blocks);
  }
  BOOST_TEST(broken_off >= 4);
}

BOOST_AUTO_TEST_CASE(references_have_one_row_for_each_value) {
  const Folder folder;
  const Outcome json = run(folder, "references --json"), csv = run(folder, "references --csv");
  std::size_t values = 0;
  for (const Json& reference : Json::parse(json.out)) values += reference["values"].size();
  BOOST_TEST(values > 4000U);
  BOOST_TEST(lines(csv.out) == values + 1);
  BOOST_TEST(csv.out.find_first_of("\r?") == std::string::npos, "an end of line is one character");
  const Outcome one = run(folder, "references table-2-ansys --csv");
  BOOST_TEST(lines(one.out) == 7U);
  BOOST_TEST(contains(one.out, "paper,Hz,5,64.514,5e-04,64.514,\"K. V. Varalakshmi"));
}

BOOST_AUTO_TEST_SUITE_END()

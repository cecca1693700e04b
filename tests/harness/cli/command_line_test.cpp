// ctest: labels=program timeout=300
#include <sys/wait.h>

#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "harness/base/json_file.h"
#include "harness/input/document.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(command_line)

using namespace trammel;
using namespace trammel::harness;
using testing::contains;
using testing::Folder;

namespace {

struct Outcome {
  int status = -1;
  std::string out, err;
};

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// The program itself, started in the folder.
Outcome run(const Folder& folder, const std::string& words, const std::string& before = "") {
  const std::string line = "cd '" + folder.path().string() + "' && " + before + " '" +
                           testing::trammel_program() + "' " + words +
                           " >out.txt 2>err.txt </dev/null";
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(folder.path() / "out.txt"),
          text_of(folder.path() / "err.txt")};
}

Json judged(double at_most) {
  Json json = testing::cantilever();
  json["checks"]["c"] = {{"quantity", "reaction_y_N:A"},
                         {"statistic", "max_abs"},
                         {"role", "verification"},
                         {"bound", {{"at_most", at_most}, {"why", "the load is 100 N"}}}};
  return json;
}

std::size_t lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_exit_status_says_how_it_went) {
  const Folder folder;
  (void)folder.write(judged(101));
  BOOST_TEST(run(folder, "run cantilever.json").status == 0);
  (void)folder.write(judged(99));
  const Outcome failed = run(folder, "run cantilever.json");
  BOOST_TEST(failed.status == 1);
  BOOST_TEST(contains(failed.out, "fail"));
  Json bad = judged(99);
  bad["model"]["elements"] = -1;
  (void)folder.write(bad);
  BOOST_TEST(run(folder, "run cantilever.json").status == 2);
  for (const char* words : {"", "rn", "run", "run --nonsense x", "run none.json", "run nonesuch",
                            "describe", "compare a", "run cantilever.json --jobs 0",
                            "run cantilever.json --variant none", "list -L nolabel"}) {
    const Outcome outcome = run(folder, words);
    BOOST_TEST(outcome.status == 2, words);
    BOOST_TEST(lines(outcome.err) == 1, words << ": " << outcome.err);
  }
  for (const char* words : {"--help", "--version", "run --help", "list", "list --json"}) {
    BOOST_TEST(run(folder, words).status == 0, words);
  }
}

BOOST_AUTO_TEST_CASE(a_run_in_any_folder_writes_results_that_obey_their_schema) {
  const Folder folder;
  (void)folder.write("mine/cantilever.json", judged(101).dump());
  const Outcome outcome = run(folder, "run mine/cantilever.json --out here/results");
  BOOST_TEST(outcome.status == 0, outcome.err);
  const Json results = read_json(folder.path() / "here/results/results.json");
  const auto fault = find_schema_fault(results, "results");
  BOOST_TEST(!fault.has_value(), (fault ? fault->pointer + ": " + fault->message : ""));
  BOOST_TEST(results["runs"][0]["checks"][0]["verdict"] == "pass");
  BOOST_TEST(results["runs"][0]["quantities"]["displacement_y_m:B"].size() == 1U);
}

BOOST_AUTO_TEST_CASE(a_robot_of_one_s_own_is_run_with_a_reference_beside_it) {
  const Folder folder;
  Json json = testing::manipulator();
  Json& robot = json["model"]["manipulator"];
  robot["links"]["proximal_length_m"] = {0.25, 0.24, 0.26};
  robot["links"]["distal_length_m"] = 0.3;
  robot["platform"].erase("side_m");
  robot["platform"]["vertices_m"] = {{-0.1, -0.05}, {0.12, -0.06}, {0, 0.11}};
  robot["working_mode"] = {1, -1, 1};
  json["model"]["pose"] = {{"x_m", 0.22}, {"y_m", 0.2}, {"phi_rad", 0.2}};
  json["checks"]["first"] = {
      {"quantity", "frequency_Hz"},
      {"index", 0},
      {"reference", "measured"},
      {"reference_index", 0},
      {"role", "validation"},
      {"expect", {{"agrees", "a rough bench"}, {"ratio_between", {0.1, 10}}}}};
  (void)folder.write(json);
  folder.write_reference({{"id", "measured"},
                          {"title", "Measured"},
                          {"kind", "paper"},
                          {"unit", "Hz"},
                          {"values", {12}},
                          {"uncertainty", {{"absolute", 1}}},
                          {"source", "my bench"},
                          {"place", "run 1"}});
  const Outcome outcome = run(folder, "run robot.json");
  BOOST_TEST(outcome.status == 0, outcome.err);
  const Json results = read_json(folder.path() / "trammel-results/results.json");
  BOOST_TEST(results["citations"][0] == "my bench");
  BOOST_TEST(results["runs"][0]["checks"][0]["verdict"] == "pass");
}

BOOST_AUTO_TEST_CASE(a_bad_file_among_good_ones_loses_nothing) {
  const Folder folder;
  (void)folder.write(judged(101));
  (void)folder.write("broken.json", "{\"id\": ");
  const Outcome outcome = run(folder, "run cantilever.json broken.json");
  BOOST_TEST(outcome.status == 2);
  BOOST_TEST(contains(outcome.err, "broken.json: line 1, column 8: expected JSON"));
  const Json results = read_json(folder.path() / "trammel-results/results.json");
  BOOST_TEST(results["runs"].size() == 2U);
  BOOST_TEST(results["runs"][0]["status"] == "solved");
  BOOST_TEST(results["runs"][1]["status"] == "error");
}

BOOST_AUTO_TEST_CASE(a_place_that_cannot_be_written_is_told_before_anything_is_computed) {
  const Folder folder;
  (void)folder.write(judged(101));
  const Outcome outcome = run(folder, "run cantilever.json --out out.txt/x");
  BOOST_TEST(outcome.status == 2);
  BOOST_TEST(contains(outcome.err, "--out out.txt/x: expected a folder that can be written"));
}

BOOST_AUTO_TEST_CASE(a_second_call_into_one_folder_is_told_who_writes_it) {
  const Folder folder;
  (void)folder.write(judged(101));
  (void)folder.write("out/.trammel-lock", "process 4711");
  const std::string held = "flock -x -o out/.trammel-lock";
  for (const char* words : {"run cantilever.json --out out", "report cantilever.json --out out",
                            "cost cantilever.json --out out"}) {
    const Outcome second = run(folder, words, held);
    BOOST_TEST(second.status == 2, words);
    BOOST_TEST(contains(second.err,
                        "--out out: expected a folder that no other call writes "
                        "(process 4711 does)"),
               second.err);
  }
  BOOST_TEST(run(folder, "run cantilever.json --out out").status == 0);
  std::set<std::string> left;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "out"))
    left.insert(entry.path().filename().string());
  BOOST_TEST((left == std::set<std::string>{"junit.xml", "results.json", "store"}));
}

BOOST_AUTO_TEST_CASE(what_stands_in_the_place_of_lock_or_store_is_neither_waited_for_nor_followed) {
  const Folder folder;
  (void)folder.write(judged(101));
  const auto told = [&](const std::string& before) {
    return run(folder, "run cantilever.json --out out", before + " && timeout 20").err;
  };
  BOOST_TEST(told("mkdir out && mkfifo out/.trammel-lock") ==
             "--out out: expected a file in the place of its lock\n");
  BOOST_TEST(told("rm out/.trammel-lock && mkdir mine && ln -s ../mine out/store") ==
             "--out out: expected no link named 'store' (--store follows one)\n");
}

BOOST_AUTO_TEST_CASE(no_file_takes_the_place_of_a_closed_standard_output) {
  const Folder folder;
  (void)folder.write(judged(101));
  const Outcome outcome =
      run(folder, "run cantilever.json --out out", "sh -c 'exec \"$@\" >&-' sh");
  BOOST_TEST(outcome.status == 2);
  BOOST_TEST(contains(outcome.err, "expected a standard output that can be written"));
}

BOOST_AUTO_TEST_CASE(a_report_without_gnuplot_is_refused_before_any_work) {
  const Folder folder;
  (void)folder.write(judged(101));
  (void)folder.write("out/index.html", "former");
  for (const char* words : {"report cantilever.json --out out", "cost modes --out out"}) {
    const Outcome outcome = run(folder, words, "PATH=/nonexistent");
    BOOST_TEST(outcome.status == 2, words);
    BOOST_TEST(contains(outcome.err, "gnuplot"), outcome.err);
    BOOST_TEST(outcome.out.empty());
  }
  BOOST_TEST(text_of(folder.path() / "out/index.html") == "former");
}

BOOST_AUTO_TEST_CASE(no_text_of_a_case_commands_the_terminal_or_breaks_a_message) {
  const Folder folder;
  Json json = judged(101);
  json["title"] = "red \x1b[31m";
  (void)folder.write(json);
  for (const char* words : {"describe cantilever.json", "report cantilever.json --out out"})
    BOOST_TEST(!contains(run(folder, words).out, "\x1b"), words);
  BOOST_TEST(!contains(text_of(folder.path() / "out/index.html"), "\x1b"));
  json["model"]["nodes"]["x\n\x1b" + std::string(3000, 'k')] = "nowhere";
  (void)folder.write(json);
  const Outcome outcome = run(folder, "run cantilever.json");
  BOOST_TEST(outcome.status == 2);
  BOOST_TEST(lines(outcome.err) == 1, outcome.err);
  BOOST_TEST(contains(outcome.err, "\\u000a\\u001b"), outcome.err);
  BOOST_TEST(outcome.err.size() < 500U);
}

BOOST_AUTO_TEST_CASE(a_pipe_sees_no_progress_bar) {
  const Folder folder;
  Json json = judged(101);
  json["variants"]["again"] = Json::object();
  (void)folder.write(json);
  const Outcome outcome = run(folder, "run cantilever.json");
  BOOST_TEST(outcome.err.empty());
  BOOST_TEST(!contains(outcome.out, "\r"));
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
      {"cost" + file + " --accuracy 0.01", "/patch/model"},
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
  BOOST_TEST(contains(run(folder, "cost cantilever.json --accuracy 0.01").out, "Within 1 %:"));
  BOOST_TEST(contains(run(folder, "claims --help").out, "--json"));  // it runs a whole catalogue
  std::istringstream help(run(folder, "--help").out);
  std::string line, name;
  while (std::getline(help, line) && line != "Subcommands:") {
  }
  while (std::getline(help, line) && !line.empty())
    if (std::istringstream(line) >> name && line[2] != ' ')
      BOOST_TEST(seen.count(name) == 1U, name);
  BOOST_TEST(seen.size() > 15U);
}

BOOST_AUTO_TEST_CASE(ctest_is_told_how_much_was_checked_and_how_near_to_its_tolerance) {
  const Folder folder;
  Json json = judged(101);
  json["checks"]["near"] = {{"quantity", "reaction_y_N:A"},
                            {"statistic", "sum"},
                            {"role", "verification"},
                            {"bound", {{"at_least", -101}, {"at_most", -99}, {"why", "100 N"}}}};
  (void)folder.write(json);
  BOOST_TEST(!contains(run(folder, "run cantilever.json").out, "CTestMeasurement"));
  const std::string out = run(folder, "run cantilever.json --ctest").out;
  const auto says = [&](const std::string& name, const std::string& value) {
    return contains(out, "<CTestMeasurement type=\"numeric/double\" name=\"" + name + "\">" +
                             value + "</CTestMeasurement>\n");
  };
  BOOST_TEST(says("checks", "2"), out);
  BOOST_TEST(says("failed checks", "0"), out);
  BOOST_TEST(says("runs", "1"), out);
}

BOOST_AUTO_TEST_CASE(drawings_are_also_files_of_vtk) {
  const Folder folder;
  (void)folder.write(judged(101));
  BOOST_TEST(run(folder, "run cantilever.json --vtk --out out").status == 0);
  const auto name = [&](const char* end) {
    return text_of(folder.path() / "out/vtk" / (std::string("cantilever-base-") + end));
  };
  BOOST_TEST(contains(name("shapes.pvd"), "file=\"cantilever-base-shapes-1.vtu\""));
  BOOST_TEST(contains(name("shapes-1.vtu"), "Name=\"displacement\" NumberOfComponents=\"3\""));
  BOOST_TEST(!contains(name("poses-1.vtu"), "displacement"));
  BOOST_TEST(contains(name("poses-1.vtu"), "\n2 0 0\n"));  // node B
}

BOOST_AUTO_TEST_CASE(a_report_draws_its_history_and_notes_no_time_twice) {
  const Folder folder;
  (void)folder.write(judged(101));
  for (const char* words : {"report cantilever.json --out out --history h.db",
                            "report cantilever.json --out out --history h.db"})
    BOOST_TEST(run(folder, words).status == 0);
  const Json calls = parse_json(run(folder, "history h.db --json").out, "out")["calls"];
  BOOST_REQUIRE(calls.size() == 2U);
  BOOST_TEST(calls[0]["cpu_s"].get<double>() > 0);
  BOOST_TEST(calls[1]["cpu_s"].get<double>() == 0);  // the store had the run
  BOOST_TEST(calls[1]["work"] == calls[0]["work"]);
  const std::string page = text_of(folder.path() / "out/index.html");
  BOOST_TEST(contains(page, "<section id=\"history\">"));
  BOOST_TEST(contains(page, "2 calls; nothing has changed since call 1"));
  BOOST_TEST(contains(page, "<figure id=\"fig-history\">"));
  BOOST_TEST(contains(page, "Counted work is 1 times the first call"));
  BOOST_TEST(run(folder, "report out/results.json --out again").status == 0);
  BOOST_TEST(contains(text_of(folder.path() / "again/index.html"), "<section id=\"history\">"));
}

BOOST_AUTO_TEST_CASE(a_misspelt_case_or_command_is_answered_with_the_nearest) {
  const Folder folder;
  BOOST_TEST(contains(run(folder, "rnu x").err, "did you mean 'run'?"));
  (void)folder.write(judged(101));
  const Outcome outcome = run(folder, "run cantilever.json --variant bse");
  BOOST_TEST(contains(outcome.err, "did you mean 'base'?"));
}

BOOST_AUTO_TEST_CASE(the_data_folder_can_be_said) {
  const Folder folder;
  (void)folder.write(judged(101));
  BOOST_TEST(run(folder, "run cantilever.json", "TRAMMEL_HOME='" TRAMMEL_SOURCE_DIR "'").status ==
             0);
  const Outcome lost = run(folder, "run cantilever.json", "TRAMMEL_HOME=/nonexistent");
  BOOST_TEST(lost.status == 2);
  BOOST_TEST(contains(lost.err, "TRAMMEL_HOME: expected a folder with cases/schema"));
}

BOOST_AUTO_TEST_CASE(variants_and_results_are_compared_in_any_number) {
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
  BOOST_TEST(contains(csv.out, "\"base [%]\",\"soft\",\"soft [%]\",\"same\""), csv.out);
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
  for (const char* words : {"a/results.json cantilever.json", "a", "cantilever.json:soft"})
    BOOST_TEST(run(folder, "compare " + std::string(words)).status == 2, words);
}

BOOST_AUTO_TEST_CASE(a_comparison_is_also_a_page_of_one_file_with_curves_over_each_other) {
  const Folder folder;
  Json json = judged(101);
  json["variants"]["soft"]["model"]["materials"]["steel"]["E_Pa"] = 1e11;
  json["figures"]["twice"] = {{"title", "Tip"},
                              {"caption", "Tip."},
                              {"x", "displacement_x_m:B"},
                              {"y", {"displacement_y_m:B"}}};
  (void)folder.write(json);
  const Outcome outcome = run(folder, "compare cantilever.json --html out/page.html");
  BOOST_TEST(outcome.status == 0, outcome.err);
  const std::string page = text_of(folder.path() / "out/page.html");
  BOOST_TEST(contains(page, "soft against base"));
  BOOST_TEST(contains(page, "<svg "));
  BOOST_TEST(!contains(page, "<link"));
  BOOST_TEST(!contains(page, "src="));
  const std::filesystem::directory_iterator files(folder.path() / "out");
  BOOST_TEST(std::distance(begin(files), end(files)) == 1);
}

BOOST_AUTO_TEST_CASE(percent_of_a_comparison_is_of_the_first_side_and_not_of_round_off) {
  const Folder folder;
  Json json = testing::cantilever();
  json["model"]["nodes"]["B"] = {1.2, 1.6};
  json["model"]["loads"]["tip"]["force_N"] = {-80, 60};
  json["variants"]["soft"]["model"]["materials"]["steel"]["E_Pa"] = 0.8e11;
  (void)folder.write(json);
  const Json found =
      parse_json(run(folder, "compare cantilever.json cantilever.json:soft --json").out, "out");
  std::size_t seen = 0;
  for (const Json& number : found["runs"][0]["numbers"]) {
    const bool moves = number["quantity"] == "displacement_y_m:B";
    if (moves)
      BOOST_TEST(number["percent"][1].get<double>() == 150, boost::test_tools::tolerance(1e-6));
    const bool is_zero = number["quantity"] == "axial_force_N:AB.start";
    if (is_zero) BOOST_TEST(number["percent"][1].is_null());
    if (is_zero) BOOST_TEST(number["changed"] == false);
    seen += moves || is_zero ? 1 : 0;
  }
  BOOST_TEST(seen == 2U);
}

BOOST_AUTO_TEST_CASE(a_model_that_the_solver_refuses_is_bad_input_of_every_command) {
  const Folder folder;
  Json json = testing::manipulator();
  json["model"]["manipulator"]["platform"]["kind"] = "triangles";
  json["model"]["loads"]["P"]["moment_N_m"] = 1;
  json["analysis"] = {{"statics", Json::object()}};
  (void)folder.write(json);
  for (const char* words : {"run robot.json", "effects robot.json", "quantities robot.json"}) {
    const Outcome outcome = run(folder, words);
    BOOST_TEST(outcome.status == 2, words);
    BOOST_TEST(lines(outcome.err) == 1, words << ": " << outcome.err);
    BOOST_TEST(contains(outcome.err, "robot.json: /model/manipulator: "), outcome.err);
  }
}

BOOST_AUTO_TEST_CASE(a_refused_drive_and_a_path_that_ends_too_soon_are_told_by_their_own_place) {
  const Folder folder;
  Json json = testing::cantilever();
  json["analysis"] = Json::parse(R"({"large-motion": {"end_time_s": 1, "step_s": 0.1, "drives": {
      "motor": {"node": "A", "motion": "rotation", "law": {"constant_speed": {"speed_per_s": 1}}}}}})");
  (void)folder.write(json);
  const std::string drive = run(folder, "run cantilever.json").err;
  BOOST_TEST(contains(drive, ": /analysis/large-motion/drives/motor: "), drive);
  json = testing::manipulator();
  json["model"].erase("pose");
  json["model"]["manipulator"]["joints"]["elbow"] = "hinged";
  json["model"]["trajectory"] = Json::parse(R"({"spline": {"points": 2, "step_s": 0.1, "knots": [
      {"time_s": 0, "x_m": 0.25, "y_m": 0.144, "phi_rad": 0},
      {"time_s": 0.1, "x_m": 0.26, "y_m": 0.144, "phi_rad": 0},
      {"time_s": 0.2, "x_m": 0.27, "y_m": 0.144, "phi_rad": 0}]}})");
  json["analysis"] = {{"large-motion", {{"track", "angles"}, {"end_time_s", 1}, {"step_s", 0.05}}}};
  (void)folder.write(json);
  const std::string path = run(folder, "run robot.json").err;
  BOOST_TEST(contains(path, ": /analysis/large-motion/end_time_s: "), path);
}

BOOST_AUTO_TEST_CASE(a_tolerance_of_two_kinds_and_a_lost_reference_are_told_as_they_are_read) {
  const Folder folder;
  Json json = judged(101);
  json["checks"]["c"].erase("bound");
  json["checks"]["c"]["reference"] = "nowhere";
  json["checks"]["c"]["tolerance"] = {{"absolute", 1}, {"relative", 0.1}, {"why", "x"}};
  (void)folder.write(json);
  BOOST_TEST(contains(run(folder, "describe cantilever.json").err,
                      "/checks/c/tolerance: expected exactly one of 'absolute' or 'relative'"));
  json["checks"]["c"]["tolerance"].erase("absolute");
  (void)folder.write(json);
  const std::string lost = run(folder, "run cantilever.json").err;
  BOOST_TEST(contains(lost, "looked for in"), lost);
  BOOST_TEST(contains(lost, "references/values"), lost);
}

BOOST_AUTO_TEST_CASE(a_case_is_certified_over_ways_of_rounding) {
  const Folder folder;
  const Outcome outcome = run(folder, "certify cantilever-tip-force");
  BOOST_TEST(outcome.status == 0, outcome.err);
  for (const char* words :
       {"upwards", "downwards", "towards zero", "No verdict differs, and none is missing."})
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
  BOOST_TEST(contains(stale.err,
                      "other/results.json: /cases/cantilever-tip-force/hash: expected results of"),
             stale.err);
  (void)folder.write(testing::cantilever());
  const Outcome none = run(folder, "certify cantilever.json");
  BOOST_TEST(none.status == 2);
  BOOST_TEST(contains(none.err, "expected cases with checks"), none.err);
}

BOOST_AUTO_TEST_CASE(a_page_of_effects_is_one_of_many_scenes) {
  const Folder folder;
  const Outcome none = run(folder, "effects --repeats 0 --out page");
  BOOST_TEST(none.status == 2);
  BOOST_TEST(contains(none.err, "either cases or --label is required"), none.err);
  const Outcome many =
      run(folder, "effects scene-column scene-soft-platform --repeats 0 --out page");
  BOOST_TEST(contains(many.out, "page in page/index.html"), many.out);
  const Json results = Json::parse(text_of(folder.path() / "page/results.json"));
  BOOST_TEST(results.at("effect_scenes").size() == 2U);
}

BOOST_AUTO_TEST_CASE(quantities_are_told_with_unit_and_meaning) {
  const Folder folder;
  (void)folder.write(testing::cantilever());
  const Outcome all = run(folder, "quantities"), own = run(folder, "quantities cantilever.json");
  BOOST_TEST(contains(all.out, "estimated_correct_digits"));
  BOOST_TEST(contains(all.out, "peak_displacement_y_m:NODE"));
  BOOST_TEST(contains(own.out, "displacement_y_m:B"));
  BOOST_TEST(contains(own.out, "displacement along y"));
}

BOOST_AUTO_TEST_CASE(what_is_no_results_file_is_said_so_beside_one) {
  const Folder folder;
  (void)folder.write(judged(101));
  (void)folder.write("other.json", R"({"a": 1})");
  (void)run(folder, "run cantilever.json");
  const auto refusal = [&](const std::string& other) {
    const Outcome outcome = run(folder, "compare trammel-results/results.json " + other);
    BOOST_TEST(outcome.status == 2);
    return outcome.err;
  };
  BOOST_TEST(contains(refusal("none.json"), "none.json: expected a readable file"));
  BOOST_TEST(contains(refusal("other.json"), "other.json: /a: expected no key of that name"));
  BOOST_TEST(contains(refusal("cantilever.json"), "expected variants alone or results alone"));
  for (const char* command :
       {"paper other.json", "run cantilever.json --shard 1/1 --costs other.json"}) {
    const Outcome outcome = run(folder, command);
    BOOST_TEST(outcome.status == 2);
    BOOST_TEST(contains(outcome.err, "other.json: /a: expected no key of that name"));
  }
}

BOOST_AUTO_TEST_CASE(the_page_of_one_s_own_case_has_that_case_alone) {
  const Folder folder;
  (void)folder.write(judged(101));
  const Outcome outcome = run(folder, "report cantilever.json --out mine");
  BOOST_TEST(outcome.status == 0, outcome.err);
  BOOST_TEST(
      contains(outcome.out, "1 run, 1 check: 1 pass, 0 do not agree (as recorded), 0 fail\n"));
  BOOST_TEST(contains(outcome.out, "report in mine/index.html"));
  BOOST_TEST(std::filesystem::exists(folder.path() / "mine/index.html"));
  const Json results = read_json(folder.path() / "mine/results.json");
  BOOST_TEST(results["cases"].size() == 1U);
  BOOST_TEST(!results.contains("claims"));
  (void)folder.write(judged(99));
  BOOST_TEST(run(folder, "report cantilever.json --out mine").status == 1);
}

BOOST_AUTO_TEST_CASE(a_second_report_computes_nothing_that_has_not_changed_and_says_so) {
  const Folder folder;
  (void)folder.write(judged(101));
  const std::string stored = "1 run (1 of them stored by an earlier call), 1 check";
  const auto stored_runs = [&] {
    return read_json(folder.path() / "mine/results.json")["environment"]["stored_runs"];
  };
  (void)run(folder, "report cantilever.json --out mine");
  BOOST_TEST(stored_runs() == 0);
  BOOST_TEST(contains(run(folder, "report cantilever.json --out mine").out, stored));
  BOOST_TEST(stored_runs() == 1);
  BOOST_TEST(contains(read_text(folder.path() / "mine/index.html"), "not computed anew"));
  BOOST_TEST(!contains(run(folder, "report cantilever.json --out mine --fresh").out, "stored"));
  Json changed = judged(101);
  changed["model"]["elements"] = 2;
  (void)folder.write(changed);
  BOOST_TEST(!contains(run(folder, "report cantilever.json --out mine").out, "stored"));
}

BOOST_AUTO_TEST_CASE(how_a_singular_run_ended_is_told_once) {
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

BOOST_AUTO_TEST_CASE(a_narrow_window_is_told_with_the_digits_that_it_takes) {
  const Folder folder;
  Json json = judged(101);
  json["checks"] = {
      {"hold",
       {{"quantity", "reaction_y_N:A"},
        {"role", "verification"},
        {"bound", {{"at_least", 99.9999999}, {"at_most", 100.0000001}, {"why", "x"}}}}}};
  (void)folder.write(json);
  BOOST_TEST(contains(run(folder, "run cantilever.json").out, "[99.9999999, 100.0000001]"));
}

BOOST_AUTO_TEST_CASE(a_case_without_checks_tells_what_was_computed) {
  const Folder folder;
  Json json = testing::cantilever();
  json["analysis"] = {{"modes", {{"count", 2}}}};
  json.erase("checks");
  (void)folder.write(json);
  const Outcome outcome = run(folder, "run cantilever.json");
  BOOST_TEST(contains(outcome.out, "frequency_Hz"));
  BOOST_TEST(!contains(outcome.out, "roundoff"));
}

BOOST_AUTO_TEST_CASE(the_example_of_the_readme_runs_and_holds) {
  const std::string readme = text_of(TRAMMEL_SOURCE_DIR "/README.md");
  const std::string fence = "```json\n";
  const auto start = readme.find(fence + "{\n  \"id\": \"short-arm\"") + fence.size();
  const Folder folder;
  (void)folder.write("short-arm.json", readme.substr(start, readme.find("\n```", start) - start));
  const Outcome outcome = run(folder, "run short-arm.json");
  BOOST_TEST(outcome.status == 0, outcome.err);
  BOOST_TEST(contains(outcome.out, "1 check: 1 pass, 0 do not agree"));
}

BOOST_AUTO_TEST_CASE(a_quantity_that_is_not_there_is_answered_with_what_is) {
  const Folder folder;
  Json json = judged(101);
  json["analysis"] = {{"modes", {{"count", 2}}}};
  (void)folder.write(json);
  BOOST_TEST(contains(run(folder, "run cantilever.json").out, "(known here: degrees_of_freedom,"));
}

BOOST_AUTO_TEST_CASE(what_refinements_show_is_told) {
  const Folder folder;
  Json json = testing::cantilever();
  json["analysis"] = {{"modes", {{"count", 2}}}};
  json["sweeps"]["elements"] = {
      {"pointers", {"/model/elements"}}, {"values", {1, 2, 4, 8, 16, 32}}, {"theory_order", 4}};
  (void)folder.write(json);
  const Outcome outcome = run(folder, "converge cantilever.json");
  BOOST_TEST(outcome.status == 0, outcome.err);
  BOOST_TEST(contains(outcome.out, "frequency_Hz[0]"));
  BOOST_TEST(contains(outcome.out, "asymptotic"));
  BOOST_TEST(contains(outcome.out, "order by theory 4"));
  BOOST_TEST(!contains(outcome.out, "roundoff"));  // it converges to nothing
  json.erase("sweeps");
  (void)folder.write(json);
  BOOST_TEST(run(folder, "converge cantilever.json").status == 2);
}

BOOST_AUTO_TEST_CASE(a_case_is_described_for_people_and_for_programs) {
  const Folder folder;
  (void)folder.write(judged(101));
  const Outcome words = run(folder, "describe cantilever.json");
  BOOST_TEST(contains(words.out, "planar model; 2 nodes, 1 member in 4 elements"));
  BOOST_TEST(contains(words.out, "the load is 100 N"));
  const Outcome json = run(folder, "describe cantilever.json --json");
  BOOST_TEST((parse_json(json.out, "out")["id"] == "cantilever"));
  BOOST_TEST(parse_json(run(folder, "list --json").out, "out").is_array());
}

BOOST_AUTO_TEST_CASE(every_case_of_the_catalogue_can_be_described) {
  const Folder folder;
  for (const Json& one : parse_json(run(folder, "list --json").out, "out")) {
    const auto id = one.at("id").get<std::string>();
    const Outcome outcome = run(folder, "describe " + id);
    BOOST_TEST(outcome.status == 0, id << ": " << outcome.err);
  }
  const Outcome modes = run(folder, "describe manipulator-modes");
  BOOST_TEST(contains(modes.out, "half a unit in the last place of '0.0015'"));
}

BOOST_AUTO_TEST_CASE(the_noise_of_a_validation_is_told_where_one_variant_is_run) {
  const Folder folder;
  const Outcome one = run(folder, "run manipulator-modes --variant rigid-platform");
  BOOST_TEST(contains(one.out, "u_input"));
  BOOST_TEST(contains(one.out, "link thickness"));
  BOOST_TEST(contains(one.out, "is within the validation uncertainty of"));
  BOOST_TEST(contains(one.out, "comparisons with the paper (ASME V&V 20)"));
}

BOOST_AUTO_TEST_CASE(the_sweep_of_one_s_own_case_is_measured_and_written) {
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
  const Outcome same = run(folder, "compare mine/results.json mine/results.json");
  BOOST_TEST(same.status == 0, same.err);
  BOOST_TEST(contains(same.out, "0 % apart"));
}

BOOST_AUTO_TEST_CASE(what_cannot_be_measured_is_bad_usage) {
  const Folder folder;
  (void)folder.write(testing::cantilever());
  for (const char* words :
       {"cost nonesuch", "cost cantilever.json", "cost modes --sweep elements",
        "cost modes --repeats 6", "cost none.json", "cost cantilever.json --sweep none"}) {
    const Outcome outcome = run(folder, words);
    BOOST_TEST(outcome.status == 2, words);
    BOOST_TEST(lines(outcome.err) == 1, words << ": " << outcome.err);
  }
  BOOST_TEST(contains(run(folder, "cost mods").err, "did you mean 'modes'"));
}

BOOST_AUTO_TEST_CASE(what_the_system_refuses_is_not_our_fault) {
  const Folder folder;
  (void)folder.write(testing::cantilever());
  const Outcome full = run(folder, "list >/dev/full 2>err.txt; exit $?; true");
  BOOST_TEST(full.status == 2);
  BOOST_TEST(full.err == "expected a standard output that can be written\n");
  std::filesystem::create_directories(folder.path() / "page/index.html/inside");
  const Outcome blocked = run(folder, "report cantilever.json --out page");
  BOOST_TEST(blocked.status == 2);
  BOOST_TEST(contains(blocked.err, "page/index.html: a folder"), blocked.err);
  const Outcome endless = run(folder, "run /dev/zero");
  BOOST_TEST(endless.status == 2);
  BOOST_TEST(endless.err == "/dev/zero: expected a readable file\n");
}

BOOST_AUTO_TEST_CASE(a_disk_that_is_full_leaves_the_former_report) {
  const Folder folder;
  (void)folder.write(testing::cantilever());
  BOOST_TEST(run(folder, "report cantilever.json --out out").status == 0);
  const auto files = [&] {
    std::map<std::string, std::string> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path() / "out"))
      if (entry.is_regular_file() && entry.path().extension() != ".cbor")
        all[entry.path().string()] = text_of(entry.path());
    return all;
  };
  const auto former = files();
  std::size_t broken_off = 0;
  for (const int blocks : {1, 2, 4, 8, 16, 32, 64, 128}) {  // of 512 bytes in one file
    const Outcome full = run(folder, "report cantilever.json --out out",
                             "ulimit -f " + std::to_string(blocks) + " &&");
    if (full.status == 0) continue;
    ++broken_off;
    BOOST_TEST(full.status == 2, blocks << ": " << full.err);
    BOOST_TEST(lines(full.err) == 1, full.err);
    BOOST_TEST((files() == former), blocks);
  }
  BOOST_TEST(broken_off >= 4);
}

BOOST_AUTO_TEST_CASE(references_have_a_row_a_value_and_their_source) {
  const Folder folder;
  const Outcome json = run(folder, "references --json"), csv = run(folder, "references --csv");
  std::size_t values = 0;
  for (const Json& reference : Json::parse(json.out)) values += reference["values"].size();
  BOOST_TEST(values > 4000U);
  BOOST_TEST(lines(csv.out) == values + 1);
  BOOST_TEST(csv.out.find_first_of("\r?") == std::string::npos, "an end of line is one character");
  const Outcome one = run(folder, "references table-2-ansys --csv");
  BOOST_TEST(lines(one.out) == 7U);
  BOOST_TEST(contains(one.out, "\"paper\",\"Hz\",5,64.514,5e-04,64.514,\"K. V. Varalakshmi"));
  const Outcome proved = run(folder, "references cantilever-roots");
  BOOST_TEST(contains(proved.out, "1.87510406871196116644530824108"), proved.out);
  const Outcome digits = run(folder, "references cantilever-roots --json");
  BOOST_TEST(contains(digits.out, "\"1.87510406871196116644530824108"), digits.out);
  const Outcome wrong = run(folder, "references tabel-2-ansys");
  BOOST_TEST(wrong.status == 2);
  BOOST_TEST(contains(wrong.err, "did you mean 'table-2-ansys'?"));
}

BOOST_AUTO_TEST_SUITE_END()

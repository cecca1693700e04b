#include "harness/cli/command_line.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <csignal>
#include <iostream>
#include <new>
#include <system_error>
#include <thread>
#include <utility>

#include "harness/base/errors.h"
#include "harness/base/processes.h"
#include "harness/base/text.h"
#include "harness/cli/command_certify.h"
#include "harness/cli/command_claims.h"
#include "harness/cli/command_compare.h"
#include "harness/cli/command_converge.h"
#include "harness/cli/command_cost.h"
#include "harness/cli/command_coverage.h"
#include "harness/cli/command_effects.h"
#include "harness/cli/command_export.h"
#include "harness/cli/command_grade.h"
#include "harness/cli/command_history.h"
#include "harness/cli/command_list.h"
#include "harness/cli/command_references.h"
#include "harness/cli/command_run.h"
#include "harness/cli/command_shards.h"
#include "harness/input/former_names.h"
#include "harness/printing/printable_stream.h"
#include "trammel_build.h"

namespace trammel::harness {
namespace {

constexpr const char* kAbout =
    R"(Verification and validation of flexible-link planar parallel manipulators.

A case is a JSON file: a model, an analysis, and checks against references with their
provenance. A name is looked up in the catalogue; a path is a file of your own, in any folder.)";

constexpr const char* kFooter = R"(
Examples:
  trammel list                              what there is
  trammel describe manipulator-modes        what a case models, checks and compares with
  trammel quantities                        what each analysis computes, with units
  trammel references --csv                  every stored value with its source
  trammel run manipulator-modes             all its variants, with verdicts
  trammel run -L verification --jobs 4      every case with that label
  trammel run ~/my-robot.json               a case file of your own
  trammel compare manipulator-modes manipulator-modes:rigid-platform
  trammel converge beam-cantilever          orders, extrapolation, numerical uncertainty
  trammel cost modes                        accuracy against computing time
  trammel claims                            the paper's claims, and a verdict for each
  trammel paper                             which case shows an equation, figure or table of the paper
  trammel coverage --gaps                   what has no independent evidence, and why
  trammel effects scene-soft-platform       influence of each effect on a model
  trammel report                            the whole catalogue as a report
  trammel report ~/my-robot.json            a report of your own case
  trammel export portal-frame               one computation for another code
  trammel grade ./my-adapter -L frame       another code, judged by the same checks
  trammel report a/results.json b/results.json    several codes side by side
  trammel slurm --shards 40 --out results         the catalogue on a cluster
  trammel history history.db                what changed since the last green call, and when
  trammel slower ../before/trammel -L frame whether this build is slower than another one

Every command that prints a table takes --json.

Exit status: 0 every check passes, 1 a check failed, 2 bad usage or input, also a
folder of --out that another call writes, 3 a fault of trammel, 130 interrupted
(143 by SIGTERM).)";

constexpr const char* kResultsJson = "As JSON, as in results.json";
constexpr const char* kStoreHelp =
    "Folder where each run or study is kept as it ends; OUT/store by default";

/// All words of the command line, and what to do with them.
class CommandLine {
 public:
  /// @param first  the first argument: only the command of that name is defined; all of them, for
  ///               the help and what is meant, where it is none's.
  CommandLine(const Renderers& renderers, const std::string& first) : renderers_(renderers) {
    app_.name("trammel");
    app_.footer(kFooter);
    app_.set_version_flag("--version", TRAMMEL_VERSION);
    app_.require_subcommand(1);
    for (const Command& command : kCommands) {
      if (is_command(first) && first != command.name) continue;
      (this->*command.define)(app_.add_subcommand(command.name));
    }
  }

  int run(const std::vector<std::string>& arguments) {
    // CLI11 takes them from the back, and keeps what is left.
    std::vector<std::string> stack(arguments.rbegin(), arguments.rend());
    try {
      app_.parse(stack);
    } catch (const CLI::ParseError& error) {
      if (error.get_exit_code() == 0) return app_.exit(error);
      throw InputError("trammel: " + explained(error, arguments));
    }
    run_.json = compare_.json = coverage_.json = cost_.json = effects_.json = slower_.json = json_;
    return command_();
  }

 private:
  struct Command {
    const char* name;
    void (CommandLine::*define)(CLI::App* sub);
  };
  static const Command kCommands[21];

  static bool is_command(const std::string& name) {
    return std::any_of(std::begin(kCommands), std::end(kCommands),
                       [&](const Command& command) { return name == command.name; });
  }

  std::string explained(const CLI::ParseError& error, const std::vector<std::string>& arguments) {
    const std::string first = arguments.empty() ? "" : arguments.front();
    if (first.empty()) return "expected a command (see trammel --help)";
    if (!is_command(first) && first.front() != '-') {
      std::vector<std::string> names;
      for (const Command& command : kCommands) names.emplace_back(command.name);
      return "expected a command (got '" + printable(first) + "')" +
             did_you_mean(current_command(first), names);
    }
    std::string line = printable(error.what(), 200);
    return line + " (see trammel " + (is_command(first) ? first + " " : "") + "--help)";
  }

  static void describe(CLI::App* sub, const char* what, const char* examples) {
    sub->description(what);
    sub->footer(examples);
  }
  void add_jobs(CLI::App* sub) {
    sub->add_option("-j,--jobs", run_.jobs,
                    "Computations at a time; the numbers do not depend on it")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
  }
  void add_out(CLI::App* sub, const char* what) {
    sub->add_option("-o,--out", run_.out, what)->capture_default_str();
  }

  void add_store(CLI::App* sub, bool& resume, std::string& store) {
    sub->add_flag("--resume", resume,
                  "Take what an earlier call left in the store, and compute only what is missing");
    sub->add_option("--store", store, kStoreHelp);
  }
  void add_memory(CLI::App* sub) {
    sub->add_option("--max-memory", run_.memory_bytes,
                    "What one run may take, as 500MB or 2GB; by default half of the memory")
        ->transform(CLI::AsSizeValue(false));
  }

  void add_costs(CLI::App* sub) {
    sub->add_option("--costs", run_.costs,
                    "results.json of an earlier run, whose times balance the shards; the same file "
                    "for all of them");
  }

  CLI::Option* add_json(CLI::App* sub, const char* what = "As JSON") {
    return sub->add_flag("--json", json_, what);
  }

  void add_history(CLI::App* sub) {
    sub->add_option("--history", run_.history,
                    "SQLite file that verdicts, values, counted work and the times of what was "
                    "computed are added to, for 'trammel history' and the report");
  }

  void define_list(CLI::App* sub) {
    describe(sub, "The cases of the catalogue",
             "\nExamples:\n  trammel list\n  trammel list -L manipulator --json");
    sub->add_option("-L,--label", run_.labels, "Only cases with one of these labels");
    add_json(sub);
    sub->callback([this] { command_ = [this] { return list_cases(run_.labels, json_); }; });
  }
  void define_describe(CLI::App* sub) {
    describe(sub, "Model, analysis, variants, checks and references of a case",
             "\nExample:\n  trammel describe manipulator-modes");
    sub->add_option("case", name_, "Name or file of a case")->required();
    add_json(sub, "As JSON: the case with all that it extends");
    sub->callback([this] { command_ = [this] { return describe_case(name_, json_); }; });
  }
  void define_quantities(CLI::App* sub) {
    describe(sub, "What each analysis computes, or a case: unit and meaning",
             "\nExamples:\n  trammel quantities\n  trammel quantities beam-cantilever");
    sub->add_option("case", name_,
                    "Name or file of a case, which is computed; all analyses by "
                    "default");
    add_json(sub);
    sub->callback([this] { command_ = [this] { return quantities_command(name_, json_); }; });
  }
  void define_references(CLI::App* sub) {
    describe(sub, "The stored references: values, units, uncertainty, provenance",
             "\nExamples:\n  trammel references\n  trammel references --csv > references.csv\n"
             "  trammel references table-2-ansys --json");
    sub->add_option("names", run_.cases, "Names of references; all by default");
    auto* csv = sub->add_flag("--csv", csv_, "A row for each value, with its source in words");
    add_json(sub)->excludes(csv);
    sub->callback([this] {
      command_ = [this] {
        return list_references(run_.cases, csv_    ? ReferenceFormat::csv
                                           : json_ ? ReferenceFormat::json
                                                   : ReferenceFormat::table);
      };
    });
  }
  void define_run(CLI::App* sub) {
    describe(sub, "Compute cases and evaluate their checks",
             "\nExamples:\n  trammel run manipulator-modes --variant rigid-platform\n"
             "  trammel run my-robot.json other.json --jobs 2\n"
             "  trammel run -L beam -L frame --out results");
    sub->add_option("cases", run_.cases, "Names or files of cases");
    sub->add_option("-L,--label", run_.labels, "Cases of the catalogue with one of these labels");
    sub->add_option("--variant", run_.variant, "Only this variant; 'base' is the case unpatched");
    add_jobs(sub);
    add_out(sub, "Folder for results.json and junit.xml");
    add_store(sub, run_.resume, run_.store);
    add_memory(sub);
    add_history(sub);
    sub->add_option("--shard", run_.shard,
                    "K/N: only the K-th of N parts, for 'trammel merge'; without cases and labels "
                    "of the whole catalogue")
        ->excludes("--store");
    add_costs(sub);
    auto* json = add_json(sub, kResultsJson);
    sub->add_flag("--ctest", run_.measurements,
                  "Also checks, worst share of a tolerance and time as ctest's measurements")
        ->excludes(json);
    sub->add_flag(
        "--vtk", run_.vtk,
        "Also OUT/vtk: shapes, poses and motions for ParaView, each set as PVD of VTU files");
    sub->callback([this] {
      if (run_.cases.empty() && run_.labels.empty() && run_.shard.empty()) {
        throw CLI::RequiredError("a case or a label");
      }
      command_ = [this] { return run_command(run_, renderers_); };
    });
  }
  void define_compare(CLI::App* sub) {
    describe(
        sub, "Any number of variants, cases or results, number by number",
        "\nPercent is of the first side. Modes are matched by shape, repeated ones as a set. A "
        "case alone\nstands for all its variants. Round-off: what refinements and checks state, "
        "at least 1e-9 of\nthe largest number of its kind.\n\nExamples:\n"
        "  trammel compare manipulator-modes manipulator-modes:rigid-platform\n"
        "  trammel compare manipulator-modes --html variants.html\n"
        "  trammel compare before/results.json after/results.json --gate");
    sub->add_option("sides", compare_.sides,
                    "case, case:variant; or results.json or a folder that has one")
        ->required();
    auto* csv = sub->add_flag("--csv", compare_.csv, "As CSV: a row for each number");
    add_json(sub)->excludes(csv);
    sub->add_option("--html", compare_.html, "Also a page with curves over each other, one file");
    sub->add_flag("--gate", compare_.gate,
                  "Exit status 1 where something differs beyond round-off");
    sub->callback([this] { command_ = [this] { return compare_command(compare_, renderers_); }; });
  }
  void define_converge(CLI::App* sub) {
    describe(sub, "Convergence of a case: orders, extrapolated values, numerical uncertainty",
             "\nExample:\n  trammel converge beam-cantilever");
    sub->add_option("case", name_, "Name or file of a case with sweeps")->required();
    sub->add_option("--variant", run_.variant, "Only this variant; 'base' is the case unpatched");
    add_jobs(sub);
    add_json(sub, kResultsJson);
    sub->callback([this] {
      command_ = [this] { return converge_command(name_, run_.variant, run_.jobs, json_); };
    });
  }
  void define_cost(CLI::App* sub) {
    describe(sub, "Accuracy against computing time: error, time and Pareto front",
             "\nStudies stand in cases/cost; a case of your own is studied by its sweeps.\n"
             "Settings run in random order, one at a time; keep the machine otherwise idle.\n\n"
             "Examples:\n  trammel cost\n  trammel cost modes statics --quick\n"
             "  trammel cost beam-cantilever --sweep elements\n"
             "  trammel cost my-study.json --repeats 15 --out cost\n"
             "  trammel cost my-case.json --accuracy 1e-3 --quantity displacement_y_m:B");
    sub->add_option("what", cost_.what,
                    "Families or studies of the catalogue, cases, or files of either; every study "
                    "by default");
    sub->add_option("--sweep", cost_.sweeps, "Sweeps of the cases named; all of them by default");
    sub->add_option("--variant", cost_.variant,
                    "Of the cases named; 'base', the default, is the case unpatched");
    sub->add_flag("--quick", cost_.quick, "Few values of each study, as the report shows them");
    sub->add_option("--repeats", cost_.repeats, "Measurements of each setting")
        ->check(CLI::Range(7, 10000))
        ->capture_default_str();
    sub->add_option("--seed", cost_.seed, "Of the order")->capture_default_str();
    sub->add_option("-o,--out", cost_.out, "Folder for results.json, the page, figures and data")
        ->capture_default_str();
    sub->add_option(
           "--accuracy", cost_.accuracy,
           "Search the cheapest setting of one case within this relative error: mesh, beam "
           "theory, tier, integrator and step as far as it has them")
        ->check(CLI::Range(1e-10, 1.0));
    sub->add_option("--quantity", cost_.quantities,
                    "What --accuracy looks at, as displacement_y_m:B or displacement_y_m");
    sub->add_option("--time-limit", cost_.time_limit_s, "Of the search by --accuracy [s]")
        ->check(CLI::Range(1.0, 1e6))
        ->capture_default_str();
    add_store(sub, cost_.resume, cost_.store);
    add_json(sub, "As results.json; with --accuracy what was tried and chosen");
    sub->callback([this] { command_ = [this] { return cost_command(cost_, renderers_); }; });
  }
  void define_certify(CLI::App* sub) {
    describe(
        sub, "Whether verdicts and digits depend on rounding, compiler or optimization",
        "\nComputes cases with the solver rounding to the nearest, upwards, downwards and towards "
        "zero\n(reading and judging round to the nearest), and puts results of other builds of "
        "the same cases\nbeside them: verdicts that differ, digits that agree, and tolerances "
        "less than ten times what\nthe differences come to. Exit status 1 where a verdict "
        "differs or\nis missing, or a run ends otherwise or without an answer.\n\nExamples:\n"
        "  trammel certify -L beam\n"
        "  trammel certify -L beam --results clang/results.json");
    sub->add_option("cases", run_.cases, "Names or files of cases; the catalogue by default");
    sub->add_option("-L,--label", run_.labels, "Cases of the catalogue with one of these labels");
    sub->add_option("--results", builds_, "results.json of the same cases by other builds")
        ->allow_extra_args();
    add_jobs(sub);
    add_json(sub);
    add_memory(sub);
    sub->callback([this] { command_ = [this] { return certify_command(run_, builds_); }; });
  }
  void define_claims(CLI::App* sub) {
    describe(sub, "The paper's claims, and the verdict on each",
             "\nRuns the cases that the claims rest on. Exit status 1 where a verdict is "
             "not the recorded one.\n\nExample:\n  trammel claims");
    add_jobs(sub);
    add_json(sub, "As JSON, with every number");
    sub->callback([this] { command_ = [this] { return claims_command(run_.jobs, json_); }; });
  }
  void define_coverage(CLI::App* sub) {
    describe(
        sub, "What is verified by what kind of evidence, and what by none",
        "\nA row for each key and value of the case schema, each pair of an analysis and a part,\n"
        "element or joint, and each quantity. Exit status 1 where one has neither independent\n"
        "evidence nor a recorded reason (cases/schema/without_evidence.json).\n\nExamples:\n"
        "  trammel coverage --gaps\n  trammel coverage trammel-results/results.json");
    sub->add_option("results", coverage_.results, "Count the series of this results.json, too");
    sub->add_flag("--gaps", coverage_.gaps, "Only what has no independent evidence");
    add_json(sub);
    sub->callback([this] { command_ = [this] { return coverage_command(coverage_); }; });
  }
  void define_paper(CLI::App* sub) {
    describe(sub, "The paper item by item: which case shows an equation or a figure",
             "\nExamples:\n  trammel paper\n  trammel paper trammel-results/results.json");
    sub->add_option("results", name_, "Show the verdicts of this results.json, too");
    add_json(sub);
    sub->callback([this] { command_ = [this] { return paper_command(name_, json_); }; });
  }
  void define_effects(CLI::App* sub) {
    describe(sub,
             "Physical effects of a model: which it calls for, and the measured influence of each",
             "\nThe full model against the model without each effect, without pairs, and "
             "with only those\nselected for the tolerance.\n\nExamples:\n"
             "  trammel effects scene-soft-platform\n"
             "  trammel effects my-robot.json --tolerance 0.001\n"
             "  trammel effects -L effects                 a table of these cases\n"
             "  trammel effects --random 200 --out page    hit rate on random models\n"
             "  trammel effects --seed 1 --model 17        one of them");
    sub->add_option("case", name_, "Name or file of a case whose analysis has effects");
    sub->add_option("--variant", effects_.variant, "This variant; 'base' is the case unpatched");
    sub->add_option("--tolerance", effects_.tolerance,
                    "Relative, where the case's effects are not automatic")
        ->check(CLI::Range(1e-12, 1.0))
        ->capture_default_str();
    sub->add_option("--repeats", effects_.repeats, "Measurements of time")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
    auto* random =
        sub->add_option("--random", effects_.random, "Number of random models instead of a case")
            ->check(CLI::Range(1, 100000));
    auto* scene = sub->add_option("--model", effects_.scene, "Number of one random model");
    sub->add_option("--seed", effects_.seed, "Seed of the random models")->capture_default_str();
    auto* labels = sub->add_option("-L,--label", effects_.labels,
                                   "Every case with one of these labels, in a table")
                       ->allow_extra_args(false);
    auto* out = sub->add_option("--out", effects_.out,
                                "Also a page there: asked against obtained, and time (of many)");
    add_json(sub);
    sub->callback([this, random, scene, labels, out] {
      const bool many = random->count() > 0, one = scene->count() > 0, all = labels->count() > 0;
      if (int(many) + int(one) + int(all) + int(!name_.empty()) != 1) {
        throw CLI::RequiredError("exactly one of a case, --label, --random and --model");
      }
      if (out->count() > 0 && !many && !all)
        throw CLI::RequiredError("--random or --label beside --out");
      effects_.name = name_;
      command_ = [this, many, all] {
        if (all) return labelled_effects_command(effects_, renderers_);
        return many ? random_effects_command(effects_, renderers_) : effects_command(effects_);
      };
    });
  }
  void define_report(CLI::App* sub) {
    describe(
        sub, "Run the whole catalogue, or some cases, and write the report",
        "\nOnly the report of the whole catalogue has the cost studies and the "
        "claims of the paper.\nOf results files it computes nothing: one becomes a report as it "
        "stands, several codes\n(trammel run, trammel grade) stand side by side, case by "
        "code.\n\nExamples:\n  trammel report --out report --jobs 4\n"
        "  trammel report my-robot.json      a report of your own case\n"
        "  trammel report trammel-results/results.json --single-file\n"
        "  trammel report trammel-results/results.json trammel-grade/results.json");
    sub->add_option("cases", run_.cases,
                    "Names or files of cases, the catalogue by default; or results files");
    sub->add_option("-L,--label", run_.labels, "Cases of the catalogue with one of these labels");
    add_jobs(sub);
    add_out(sub, "Folder for the pages, their figures and data, results.json and junit.xml");
    sub->add_flag("--single-file", run_.single_file,
                  "Also report.html: all in one file of at most 6 MB, to be mailed");
    sub->add_flag("--fresh", fresh_,
                  "Compute everything anew; by default only what the store does not have of this "
                  "program and input");
    sub->add_option("--store", run_.store, kStoreHelp);
    add_history(sub);
    add_memory(sub);
    sub->callback([this] {
      run_.resume = !fresh_;
      command_ = [this] { return report_command(run_, renderers_); };
    });
  }

  void define_export(CLI::App* sub) {
    describe(sub, "One computation of a case for other codes, with everything resolved",
             "\nA case file of plain nodes, members with section properties, triangles, rigid "
             "bodies, supports and\nloads at nodes; 'trammel run' computes the same numbers of "
             "it.\n\nExamples:\n  trammel export manipulator-modes --variant rigid-platform\n"
             "  trammel export beam-cantilever --level 2 --out level-2.json\n"
             "  trammel export portal-frame --matrices portal");
    sub->add_option("case", name_, "Name or file of a case")->required();
    sub->add_option("--variant", export_.choice.variant, "'base' is the case unpatched")
        ->capture_default_str();
    sub->add_option("--level", export_.level, "Level of its sweep, from 0; the case by default")
        ->check(CLI::Range(0, 1000000));
    sub->add_option("--sweep", export_.choice.sweep, "Which sweep, where it has several");
    sub->add_option("-o,--out", export_.out, "File of the case; standard output by default");
    sub->add_option("--matrices", export_.matrices,
                    "Folder for K, M, C, T and f (Matrix Market) and the mesh (VTU); the case "
                    "only beside --out");
    sub->callback([this] { command_ = [this] { return export_command(name_, export_); }; });
  }
  void define_solve(CLI::App* sub) {
    describe(sub, "Compute an exported case as an adapter does, into a result file",
             "\nExample:\n  trammel export portal-frame --out case.json && "
             "trammel solve case.json result.json");
    sub->add_option("case", name_, "File of a case")->required();
    sub->add_option("result", other_, "File of its result")->required();
    sub->callback([this] { command_ = [this] { return solve_command(name_, other_); }; });
  }
  void define_grade(CLI::App* sub) {
    describe(
        sub, "Let another code compute cases through an adapter, and judge what it answers",
        "\nThe adapter is a program: adapter CASE.json RESULT.json. It exits with 0, or with 4 "
        "for\n\"this code cannot do that\"; harness/adapters/README.md shows how to write one. "
        "Whatever it\ndoes costs its own row. Exit status 1 where something disagrees, breaks "
        "or takes too long;\nwhat is not given is no failure.\n\nExamples:\n"
        "  trammel grade ./my-adapter beam-cantilever\n"
        "  trammel grade \"python3 my_adapter.py --fast\" -L frame --jobs 4 --out graded");
    sub->add_option("adapter", grade_.command, "Program, or program with arguments in one word")
        ->required();
    sub->add_option("cases", run_.cases, "Names or files of cases; the catalogue by default");
    sub->add_option("-L,--label", run_.labels, "Cases of the catalogue with one of these labels");
    sub->add_option("--variant", run_.variant, "Only this variant; 'base' is the case unpatched");
    add_jobs(sub);
    sub->add_option("-o,--out", grade_.out,
                    "Folder for results.json, junit.xml, the page, and a folder for each call")
        ->capture_default_str();
    add_store(sub, run_.resume, run_.store);
    add_json(sub, kResultsJson);
    add_memory(sub);
    sub->add_option("--max-time", grade_.limits.wall_s, "Wall time of one call [s]")
        ->check(CLI::Range(0.01, 1e6))
        ->capture_default_str();
    sub->add_option("--max-disk", grade_.limits.disk_bytes, "What one call may write, as 1GB")
        ->transform(CLI::AsSizeValue(false));
    sub->callback([this] {
      run_.out = grade_.out;
      command_ = [this] { return grade_command(grade_, run_, renderers_); };
    });
  }

  void define_merge(CLI::App* sub) {
    describe(
        sub, "The shards of a run, computed apart, as one",
        "\nAll shards of one selection, each once, by this program. Judges what they computed as\n"
        "'trammel run' does; what ended in an error is tried again.\n\nExample:\n"
        "  trammel run -L beam --shard 1/2 --out a\n  trammel run -L beam --shard 2/2 --out b\n"
        "  trammel merge a b --out results");
    sub->add_option("shards", run_.cases, "Folders that 'trammel run --shard' has written")
        ->required();
    add_jobs(sub);
    add_out(sub, "Folder for results.json and junit.xml");
    add_memory(sub);
    add_json(sub, kResultsJson);
    sub->callback([this] {
      command_ = [this] {
        const std::vector<std::string> folders = std::exchange(run_.cases, {});
        return merge_command(folders, run_, renderers_);
      };
    });
  }
  void define_slurm(CLI::App* sub) {
    describe(sub, "A script that runs shards as a Slurm job array, merges them and reports",
             "\nSent again, it computes only what is missing (harness/README.md).\n\nExample:\n"
             "  trammel slurm --shards 40 -L manipulator --jobs 8 --out /scratch/results > job.sh\n"
             "  sh job.sh");
    sub->add_option("--shards", slurm_.shards, "Jobs of the array")
        ->required()
        ->check(CLI::Range(1, 100000));
    sub->add_option("cases", run_.cases, "Names or files of cases; the catalogue by default");
    sub->add_option("-L,--label", run_.labels, "Cases of the catalogue with one of these labels");
    sub->add_option("--variant", run_.variant, "Only this variant; 'base' is the case unpatched");
    add_jobs(sub);
    sub->add_option("--time", slurm_.time, "Limit of a job, as sbatch reads it, such as 2:00:00");
    add_costs(sub);
    add_out(sub, "Folder that all nodes see");
    sub->callback([this] { command_ = [this] { return slurm_command(slurm_, run_); }; });
  }

  void define_history(CLI::App* sub) {
    describe(
        sub, "What changed over the calls that '--history FILE' kept, and since which commit",
        "\nVerdicts, values beyond round-off and counted work against the last green call, and "
        "slow drifts.\nExit status 1 where the newest call has failures.\n\nExample:\n"
        "  trammel run -L verification --history history.db && trammel history history.db");
    sub->add_option("file", name_, "The SQLite file")->required();
    add_json(sub);
    sub->callback([this] { command_ = [this] { return history_command(name_, json_); }; });
  }

  void define_slower(CLI::App* sub) {
    describe(
        sub, "Whether this build is slower than another, told from noise",
        "\nBoth run the cases in interleaved repeats; a case is slower where the interval of "
        "the ratio of\nprocessor times, made for all cases together, lies above 1. Exit status "
        "1 where one is.\n\nExample:\n  trammel slower /usr/bin/trammel -L frame");
    sub->add_option("program", slower_.program, "Another build of trammel")->required();
    sub->add_option("cases", run_.cases, "Names or files of cases; the catalogue by default");
    sub->add_option("-L,--label", run_.labels, "Cases of the catalogue with one of these labels");
    sub->add_option("--repeats", slower_.repeats, "21 by default, more for many cases")
        ->check(CLI::Range(1, 10000));
    add_json(sub);
    sub->callback([this] { command_ = [this] { return slower_command(slower_, run_); }; });
  }

  const Renderers& renderers_;
  CLI::App app_{kAbout};
  RunCommand run_{{},
                  {},
                  "",
                  std::max(1U, std::thread::hardware_concurrency()),
                  "trammel-results",
                  "",
                  false,
                  memory_limit_bytes()};
  CompareCommand compare_;
  CoverageCommand coverage_;
  CostCommand cost_{{}, {}, "", false, 7, 1, "trammel-cost"};
  EffectsCommand effects_;
  ExportCommand export_;
  GradeCommand grade_;
  SlowerCommand slower_;
  SlurmCommand slurm_;
  std::string name_, other_;
  std::vector<std::string> builds_;
  bool json_ = false, csv_ = false, fresh_ = false;
  std::function<int()> command_;
};

/// In the order of the help.
const CommandLine::Command CommandLine::kCommands[] = {
    {"list", &CommandLine::define_list},
    {"describe", &CommandLine::define_describe},
    {"quantities", &CommandLine::define_quantities},
    {"references", &CommandLine::define_references},
    {"run", &CommandLine::define_run},
    {"compare", &CommandLine::define_compare},
    {"converge", &CommandLine::define_converge},
    {"cost", &CommandLine::define_cost},
    {"certify", &CommandLine::define_certify},
    {"claims", &CommandLine::define_claims},
    {"coverage", &CommandLine::define_coverage},
    {"paper", &CommandLine::define_paper},
    {"effects", &CommandLine::define_effects},
    {"report", &CommandLine::define_report},
    {"export", &CommandLine::define_export},
    {"solve", &CommandLine::define_solve},
    {"grade", &CommandLine::define_grade},
    {"merge", &CommandLine::define_merge},
    {"slurm", &CommandLine::define_slurm},
    {"history", &CommandLine::define_history},
    {"slower", &CommandLine::define_slower},
};

}  // namespace

void require_drawing(const Renderers& renderers) {
  if (!renderers.can_draw())
    throw InputError("PATH: expected a folder with gnuplot, which draws the report");
}

int run_command_line(const std::vector<std::string>& arguments, const Renderers& renderers) {
  const PrintableStream out(std::cout), err(std::cerr);
  end_on_signals("trammel: interrupted; the same command begins anew\n");
  std::signal(SIGXFSZ, SIG_IGN);  // a write beyond the limit of files fails instead
  try {
    const int status =
        CommandLine(renderers, arguments.empty() ? "" : arguments.front()).run(arguments);
    if (!std::cout.flush()) throw InputError("expected a standard output that can be written");
    return status;
  } catch (const InputError& error) {
    std::cerr << one_line(error.what()) << '\n';
    return 2;
  } catch (const Interrupted& interrupted) {
    std::cout.flush();
    std::raise(interrupted.signal);
    return 128 + interrupted.signal;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::system_error& error) {  // a full disk, a folder where a file should be
    std::cerr << "expected files and processes that the system grants: " << one_line(error.what())
              << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "trammel: a fault of its own: " << one_line(error.what()) << '\n';
    return 3;
  }
}

}  // namespace trammel::harness

#include "harness/cli/command_line.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <csignal>
#include <iostream>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "harness/base/embedded_text.h"
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
#include "harness/printing/printable_stream.h"
#include "trammel_build.h"

namespace trammel::harness {
namespace {

constexpr const char* kResultsJson = "As JSON, as in results.json";
constexpr const char* kStoreHelp =
    "Folder where each run or study is kept as it ends; OUT/store by default";

/// A section of help.txt; a command's has what it does in the first line.
std::string help_text(const std::string& section) {
  const std::string& all = embedded_text("help.txt");
  const std::string head = "[" + section + "]\n";
  const std::size_t place = all.find(head);
  if (place == std::string::npos) throw std::logic_error("no help for " + section);
  const std::size_t begin = place + head.size();
  const std::size_t end = std::min(all.find("\n\n[", begin), all.size() - 1);
  return all.substr(begin, end - begin);
}

/// All words of the command line, and what to do with them.
class CommandLine {
 public:
  /// @param first  the first argument: only the command of that name is defined; all of them, for
  ///               the help and what is meant, where it is none's.
  CommandLine(const Renderers& renderers, const std::string& first) : renderers_(renderers) {
    app_.name("trammel");
    app_.footer("\n" + help_text("trammel"));
    app_.set_version_flag("--version", TRAMMEL_VERSION);
    app_.require_subcommand(1);
    for (const Command& command : kCommands) {
      if (is_command(first) && first != command.name) continue;
      const std::string help = help_text(command.name);
      const std::size_t line = help.find('\n');
      CLI::App* sub = app_.add_subcommand(command.name, help.substr(0, line));
      sub->footer(help.substr(line + 1));
      (this->*command.define)(sub);
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
    run_.json = compare_.json = coverage_.json = cost_.json = effects_.json = json_;
    return command_();
  }

 private:
  struct Command {
    const char* name;
    void (CommandLine::*define)(CLI::App* sub);
  };
  static const Command kCommands[20];

  static bool is_command(const std::string& name) {
    return std::ranges::any_of(kCommands,
                               [&](const Command& command) { return name == command.name; });
  }

  std::string explained(const CLI::ParseError& error, const std::vector<std::string>& arguments) {
    const std::string first = arguments.empty() ? "" : arguments.front();
    if (first.empty()) return "expected a command (see trammel --help)";
    if (!is_command(first) && first.front() != '-') {
      std::vector<std::string> names;
      for (const Command& command : kCommands) names.emplace_back(command.name);
      return "expected a command (got '" + printable(first) + "')" + did_you_mean(first, names);
    }
    std::string line = printable(error.what(), 200);
    return line + " (see trammel " + (is_command(first) ? first + " " : "") + "--help)";
  }

  /// What the command does once all its words are read.
  void on_run(CLI::App* sub, std::function<int()> command) {
    sub->callback([this, command = std::move(command)] { command_ = command; });
  }
  void add_cases(CLI::App* sub,
                 const char* what = "Names or files of cases; the catalogue by default") {
    sub->add_option("cases", run_.cases, what);
    sub->add_option("-L,--label", run_.labels, "Cases of the catalogue with one of these labels");
  }
  void add_variant(CLI::App* sub) {
    sub->add_option("--variant", run_.variant, "Only this variant; 'base' is the case unpatched");
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
    sub->add_option("-L,--label", run_.labels, "Only cases with one of these labels");
    add_json(sub);
    on_run(sub, [this] { return list_cases(run_.labels, json_); });
  }
  void define_describe(CLI::App* sub) {
    sub->add_option("case", name_, "Name or file of a case")->required();
    add_json(sub, "As JSON: the case with all that it extends");
    on_run(sub, [this] { return describe_case(name_, json_); });
  }
  void define_quantities(CLI::App* sub) {
    sub->add_option("case", name_,
                    "Name or file of a case, which is computed; all analyses by "
                    "default");
    add_json(sub);
    on_run(sub, [this] { return quantities_command(name_, json_); });
  }
  void define_references(CLI::App* sub) {
    sub->add_option("names", run_.cases, "Names of references; all by default");
    auto* csv = sub->add_flag("--csv", csv_, "A row for each value, with its source in words");
    add_json(sub)->excludes(csv);
    on_run(sub, [this] {
      return list_references(run_.cases, csv_    ? ReferenceFormat::csv
                                         : json_ ? ReferenceFormat::json
                                                 : ReferenceFormat::table);
    });
  }
  void define_run(CLI::App* sub) {
    add_cases(sub, "Names or files of cases");
    add_variant(sub);
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
    sub->add_option("sides", compare_.sides,
                    "case, case:variant; or results.json or a folder that has one")
        ->required();
    auto* csv = sub->add_flag("--csv", compare_.csv, "As CSV: a row for each number");
    add_json(sub)->excludes(csv);
    sub->add_option("--html", compare_.html, "Also a page with curves over each other, one file");
    sub->add_flag("--gate", compare_.gate,
                  "Exit status 1 where something differs beyond round-off");
    on_run(sub, [this] { return compare_command(compare_, renderers_); });
  }
  void define_converge(CLI::App* sub) {
    sub->add_option("case", name_, "Name or file of a case with sweeps")->required();
    add_variant(sub);
    add_jobs(sub);
    add_json(sub, kResultsJson);
    on_run(sub, [this] { return converge_command(name_, run_.variant, run_.jobs, json_); });
  }
  void define_cost(CLI::App* sub) {
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
    on_run(sub, [this] { return cost_command(cost_, renderers_); });
  }
  void define_certify(CLI::App* sub) {
    add_cases(sub);
    sub->add_option("--results", builds_, "results.json of the same cases by other builds")
        ->allow_extra_args();
    add_jobs(sub);
    add_json(sub);
    add_memory(sub);
    on_run(sub, [this] { return certify_command(run_, builds_); });
  }
  void define_claims(CLI::App* sub) {
    add_jobs(sub);
    add_json(sub, "As JSON, with every number");
    on_run(sub, [this] { return claims_command(run_.jobs, json_); });
  }
  void define_coverage(CLI::App* sub) {
    sub->add_option("results", coverage_.results, "Count the series of this results.json, too");
    sub->add_flag("--gaps", coverage_.gaps, "Only what has no independent evidence");
    add_json(sub);
    on_run(sub, [this] { return coverage_command(coverage_); });
  }
  void define_paper(CLI::App* sub) {
    sub->add_option("results", name_, "Show the verdicts of this results.json, too");
    add_json(sub);
    on_run(sub, [this] { return paper_command(name_, json_); });
  }
  void define_effects(CLI::App* sub) {
    sub->add_option("cases", effects_.names,
                    "Names or files of cases whose analysis has effects; of several, a table");
    sub->add_option("--variant", effects_.variant, "This variant; 'base' is the case unpatched");
    sub->add_option("--tolerance", effects_.tolerance,
                    "Relative, where the case's effects are not automatic")
        ->check(CLI::Range(1e-12, 1.0))
        ->capture_default_str();
    sub->add_option("--repeats", effects_.repeats, "Measurements of time")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
    sub->add_option("-L,--label", effects_.labels,
                    "Every case with one of these labels, in a table")
        ->allow_extra_args(false);
    auto* out = sub->add_option("--out", effects_.out,
                                "Also a page there: asked against obtained, and time (of several)");
    add_json(sub);
    sub->callback([this, out] {
      if (effects_.labels.empty() == effects_.names.empty())
        throw CLI::RequiredError("either cases or --label");
      const bool one = effects_.names.size() == 1;
      if (out->count() > 0 && one)
        throw CLI::RequiredError("several cases or --label beside --out");
      command_ = [this, one] {
        return one ? effects_command(effects_) : effects_table_command(effects_, renderers_);
      };
    });
  }
  void define_report(CLI::App* sub) {
    add_cases(sub, "Names or files of cases, the catalogue by default; or results files");
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
    on_run(sub, [this] {
      run_.resume = !fresh_;
      return report_command(run_, renderers_);
    });
  }

  void define_export(CLI::App* sub) {
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
    on_run(sub, [this] { return export_command(name_, export_); });
  }
  void define_solve(CLI::App* sub) {
    sub->add_option("case", name_, "File of a case")->required();
    sub->add_option("result", other_, "File of its result")->required();
    on_run(sub, [this] { return solve_command(name_, other_); });
  }
  void define_grade(CLI::App* sub) {
    sub->add_option("adapter", grade_.command, "Program, or program with arguments in one word")
        ->required();
    add_cases(sub);
    add_variant(sub);
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
    on_run(sub, [this] {
      run_.out = grade_.out;
      return grade_command(grade_, run_, renderers_);
    });
  }

  void define_merge(CLI::App* sub) {
    sub->add_option("shards", run_.cases, "Folders that 'trammel run --shard' has written")
        ->required();
    add_jobs(sub);
    add_out(sub, "Folder for results.json and junit.xml");
    add_memory(sub);
    add_json(sub, kResultsJson);
    on_run(sub, [this] {
      const std::vector<std::string> folders = std::exchange(run_.cases, {});
      return merge_command(folders, run_, renderers_);
    });
  }
  void define_slurm(CLI::App* sub) {
    sub->add_option("--shards", slurm_.shards, "Jobs of the array")
        ->required()
        ->check(CLI::Range(1, 100000));
    add_cases(sub);
    add_variant(sub);
    add_jobs(sub);
    sub->add_option("--time", slurm_.time, "Limit of a job, as sbatch reads it, such as 2:00:00");
    add_costs(sub);
    add_out(sub, "Folder that all nodes see");
    on_run(sub, [this] { return slurm_command(slurm_, run_); });
  }

  void define_history(CLI::App* sub) {
    sub->add_option("file", name_, "The SQLite file")->required();
    add_json(sub);
    on_run(sub, [this] { return history_command(name_, json_); });
  }

  const Renderers& renderers_;
  CLI::App app_{help_text("about")};
  RunCommand run_;
  CompareCommand compare_;
  CoverageCommand coverage_;
  CostCommand cost_;
  EffectsCommand effects_;
  ExportCommand export_;
  GradeCommand grade_;
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

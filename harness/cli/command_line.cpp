#include "harness/cli/command_line.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <csignal>
#include <iostream>
#include <new>
#include <sstream>
#include <stdexcept>
#include <streambuf>
#include <system_error>
#include <type_traits>
#include <utility>
#include <variant>

#include "harness/base/errors.h"
#include "harness/base/processes.h"
#include "harness/base/text.h"
#include "harness/cli/commands.h"
#include "trammel_build.h"

namespace trammel::harness {
namespace {

/// As long as it lives, control characters other than line breaks and tabs reach the stream as '?',
/// so that no text of a case commands the terminal.
class PrintableStream : std::streambuf {
 public:
  explicit PrintableStream(std::ostream& stream) : stream_(stream), target_(stream.rdbuf(this)) {}
  ~PrintableStream() override { stream_.rdbuf(target_); }
  PrintableStream(const PrintableStream&) = delete;
  PrintableStream& operator=(const PrintableStream&) = delete;

 private:
  int overflow(int c) override {
    if (c == traits_type::eof()) return traits_type::not_eof(c);
    const bool control = (c >= 0 && c < 0x20 && c != '\n' && c != '\t') || c == 0x7f;
    return target_->sputc(control ? '?' : static_cast<char>(c));
  }
  int sync() override { return target_->pubsync(); }

  std::ostream& stream_;
  std::streambuf* target_;
};

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

using Options = CommandOptions;

/// An option of one or several commands.
struct Option {
  std::string flags;  ///< without a dash: an argument by its place
  std::variant<bool Options::*, int Options::*, unsigned Options::*, std::size_t Options::*,
               double Options::*, std::string Options::*, std::vector<std::string> Options::*>
      member;
  const char* help;
  CLI::Validator validator = {};

  [[nodiscard]] std::string_view name() const {
    return std::string_view(flags).substr(flags.rfind(',') + 1);
  }
};

/// A number from `least` to `most`; CLI::Range prints limits such as 1e-10 as 0.
CLI::Validator within(double least, double most) {
  const std::string limits = shortest(least) + " to " + shortest(most);
  const auto complaint = [=](std::string& word) -> std::string {
    double value = 0;
    const bool fits = CLI::detail::lexical_cast(word, value) && value >= least && value <= most;
    return fits ? "" : "expected a number from " + limits + " (got " + printable(word) + ")";
  };
  return {complaint, limits};
}

const std::vector<Option>& all_options() {
  static const std::vector<Option> options = {
      {"case", &Options::word, "Name or file of a case"},
      {"cases", &Options::words,
       "Names or files of cases; except for 'run', the catalogue by default"},
      {"inputs", &Options::words,
       "Names or files of cases, the catalogue by default; or results files"},
      {"names", &Options::words, "Names of references; all by default"},
      {"sides", &Options::words,
       "case, case:variant; or results.json or a folder that contains one"},
      {"what", &Options::words,
       "Families or studies of the catalogue, cases, or files of either; every study by default"},
      {"results", &Options::word, "A results.json whose series or verdicts are shown, too"},
      {"shards", &Options::words, "Folders that 'trammel run --shard' has written"},
      {"adapter", &Options::adapter, "Program, or program with arguments in one word"},
      {"result", &Options::out, "File of the result"},
      {"file", &Options::word, "The SQLite file"},
      {"-L,--label", &Options::labels, "Cases of the catalogue with one of these labels"},
      {"--variant", &Options::variant, "Only this variant; 'base' is the case unpatched"},
      {"-j,--jobs", &Options::jobs, "Computations at a time; the numbers do not depend on it",
       within(1, 1024)},
      {"-o,--out", &Options::out, "Folder for what the command writes; of 'export' a file"},
      {"--resume", &Options::resume,
       "Take what an earlier call left in the store, and compute only what is missing"},
      {"--fresh", &Options::fresh,
       "Compute everything anew; by default only what the store does not have of this program "
       "and input"},
      {"--store", &Options::store,
       "Folder where each run or study is kept as it ends; OUT/store by default"},
      {"--max-memory", &Options::memory_bytes,
       "What one run may take, as 500MB or 2GB; by default half of the memory",
       CLI::AsSizeValue(false)},
      {"--history", &Options::history,
       "SQLite file that verdicts, values, counted work and the times of what was computed are "
       "added to, for 'trammel history' and the report"},
      {"--shard", &Options::shard,
       "K/N: only the K-th of N parts, for 'trammel merge'; without cases and labels of the full "
       "catalogue"},
      {"--costs", &Options::costs,
       "results.json of an earlier run, whose times balance the shards; the same file for all of "
       "them"},
      {"--json", &Options::json, "As JSON; of a command that runs cases or studies results.json"},
      {"--csv", &Options::csv, "As CSV: a row for each number"},
      {"--ctest", &Options::measurements,
       "Also checks, worst share of a tolerance and time as ctest's measurements"},
      {"--vtk", &Options::vtk,
       "Also OUT/vtk: shapes, poses and motions for ParaView, each set as PVD of VTU files"},
      {"--html", &Options::html, "Also a page with curves over each other, one file"},
      {"--gate", &Options::gate, "Exit status 1 if something differs beyond round-off"},
      {"--sweep", &Options::sweeps, "Sweeps of the cases; all of them by default"},
      {"--level", &Options::level, "Level of the sweep, from 0; the case itself by default",
       within(0, 1000000)},
      {"--matrices", &Options::matrices,
       "Folder for K, M, C, T and f (Matrix Market) and the mesh (VTU); the case only together "
       "with --out"},
      {"--quick", &Options::quick, "Few values of each study, as the report shows them"},
      {"--repeats", &Options::repeats, "Measurements of each setting", within(0, 10000)},
      {"--tolerance", &Options::tolerance,
       "Relative change that removed effects may cause; a case's own tolerance has precedence",
       within(1e-12, 1.0)},
      {"--seed", &Options::seed, "Seed of the order of measurements"},
      {"--errors", &Options::all_errors,
       "Estimate discretization errors also of cases of the catalogue"},
      {"--no-errors", &Options::no_errors, "Estimate no discretization errors"},
      {"--warn-above", &Options::warn_above, "Relative error above which a warning is given",
       within(0.0, 1e6)},
      {"--accuracy", &Options::accuracy,
       "Choose mesh and step so that the estimated relative error is below this",
       within(1e-10, 1.0)},
      {"--quantity", &Options::quantities,
       "Quantities of --accuracy, as displacement_y_m:B or displacement_y_m"},
      {"--time-limit", &Options::time_limit_s, "Time limit of the search by --accuracy [s]",
       within(1.0, 1e6)},
      {"--results", &Options::builds, "results.json of the same cases by other builds"},
      {"--gaps", &Options::gaps, "Only rows without independent evidence"},
      {"--max-time", &Options::max_time_s, "Wall time of one call of the adapter [s]",
       within(0.01, 1e6)},
      {"--max-disk", &Options::max_disk_bytes, "What one call of the adapter may write, as 1GB",
       CLI::AsSizeValue(false)},
      {"--shards", &Options::shard_count, "Jobs of the array", within(1, 100000)},
      {"--time", &Options::job_time, "Limit of a job, as sbatch reads it, such as 2:00:00"}};
  return options;
}

/// Pairs of options that no call may have both.
constexpr std::pair<const char*, const char*> kExclusive[] = {{"--shard", "--store"},
                                                              {"--errors", "--no-errors"},
                                                              {"--ctest", "--json"},
                                                              {"--csv", "--json"}};

struct CommandEntry {
  const char* name;
  Command* run;
  const char* options;  ///< names in the order of the help; '!': required
  const char* out = "trammel-results";
};

/// In the order of the help.
constexpr CommandEntry kCommands[] = {
    {"list", list_command, "--label --json"},
    {"describe", describe_command, "case! --json"},
    {"quantities", quantities_command, "case --json"},
    {"references", references_command, "names --csv --json"},
    {"run", run_command,
     "cases --label --variant --jobs --out --resume --store --max-memory --history --shard --costs "
     "--json --ctest --vtk --errors --no-errors --warn-above --accuracy --quantity"},
    {"compare", compare_command, "sides! --csv --json --html --gate"},
    {"converge", converge_command, "case! --variant --jobs --json"},
    {"cost", cost_command,
     "what --sweep --variant --quick --repeats --seed --out --accuracy --quantity --time-limit "
     "--resume --store --json",
     "trammel-cost"},
    {"certify", certify_command, "cases --label --results --jobs --json --max-memory"},
    {"claims", claims_command, "--jobs --json"},
    {"coverage", coverage_command, "results --gaps --json"},
    {"paper", paper_command, "results --json"},
    {"effects", effects_command, "cases --label --variant --tolerance --repeats --out --json", ""},
    {"report", report_command,
     "inputs --label --jobs --out --fresh --store --history --max-memory --errors "
     "--no-errors --warn-above --accuracy --quantity"},
    {"export", export_command, "case! --variant --level --sweep --out --matrices", ""},
    {"solve", solve_command, "case! result!", ""},
    {"grade", grade_command,
     "adapter! cases --label --variant --jobs --out --resume --store --json --max-memory "
     "--max-time --max-disk",
     "trammel-grade"},
    {"merge", merge_command, "shards! --jobs --out --max-memory --json"},
    {"slurm", slurm_command, "--shards! cases --label --variant --jobs --time --costs --out"},
    {"history", history_command, "file! --json"},
};

/// All words of the command line, and what to do with them.
class CommandLine {
 public:
  /// @param first  the first argument. If it names a command, only that command is defined;
  ///               otherwise all of them are, for the help and for suggestions.
  CommandLine(const Renderers& renderers, const std::string& first) : renderers_(renderers) {
    app_.name("trammel");
    app_.footer("\n" + help_text("trammel"));
    app_.set_version_flag("--version", TRAMMEL_VERSION);
    app_.require_subcommand(1);
    for (const CommandEntry& command : kCommands)
      if (!is_command(first) || first == command.name) define(command);
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
    return command_();
  }

 private:
  static bool is_command(const std::string& name) {
    return std::ranges::any_of(kCommands,
                               [&](const CommandEntry& command) { return name == command.name; });
  }

  std::string explained(const CLI::ParseError& error, const std::vector<std::string>& arguments) {
    const std::string first = arguments.empty() ? "" : arguments.front();
    if (first.empty()) return "expected a command (see trammel --help)";
    if (!is_command(first) && first.front() != '-') {
      std::vector<std::string> names;
      for (const CommandEntry& command : kCommands) names.emplace_back(command.name);
      return "expected a command (got '" + printable(first) + "')" + did_you_mean(first, names);
    }
    std::string line = printable(error.what(), 200);
    return line + " (see trammel " + (is_command(first) ? first + " " : "") + "--help)";
  }

  void define(const CommandEntry& command) {
    const std::string help = help_text(command.name);
    const std::size_t line = help.find('\n');
    CLI::App* sub = app_.add_subcommand(command.name, help.substr(0, line));
    sub->footer(help.substr(line + 1));
    options_.out = command.out;
    std::istringstream names(command.options);
    for (std::string name; names >> name;) add_option(name, sub);
    for (const auto& [one, other] : kExclusive) {
      CLI::Option *first = sub->get_option_no_throw(one), *second = sub->get_option_no_throw(other);
      if (first != nullptr && second != nullptr) first->excludes(second);
    }
    command_ = [this, &command] { return command.run(options_, renderers_); };
  }

  /// @param name  of `all_options`; '!': required
  void add_option(std::string name, CLI::App* sub) {
    const bool is_required = name.ends_with('!');
    if (is_required) name.pop_back();
    const Option& option = *std::ranges::find(all_options(), name, &Option::name);
    const auto add = [&](auto member) {
      auto& value = options_.*member;
      using Value = std::decay_t<decltype(value)>;
      if constexpr (std::is_same_v<Value, bool>) {
        sub->add_flag(option.flags, value, option.help);
      } else {
        CLI::Option* added = sub->add_option(option.flags, value, option.help);
        added->required(is_required)->transform(option.validator);
        if constexpr (std::is_same_v<Value, std::string>) {
          if (!value.empty()) added->capture_default_str();
        } else if constexpr (std::is_arithmetic_v<Value> && !std::is_same_v<Value, std::size_t>) {
          if (value > 0) added->capture_default_str();
        }
      }
    };
    std::visit(add, option.member);
  }

  const Renderers& renderers_;
  CLI::App app_{help_text("about")};
  CommandOptions options_;
  std::function<int()> command_;
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

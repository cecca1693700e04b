#include "harness/cli/command_line.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <csignal>
#include <iostream>
#include <new>
#include <sstream>
#include <streambuf>
#include <system_error>
#include <type_traits>
#include <utility>
#include <variant>

#include "harness/base/environment.h"
#include "harness/base/errors.h"
#include "harness/base/find_or_add.h"
#include "harness/base/processes.h"
#include "harness/base/text.h"
#include "harness/cli/commands.h"
#include "trammel_build.h"

namespace trammel::harness {
namespace {

/// Stream that replaces control characters, except line breaks and tabs, by '?' during its
/// lifetime. Text of a case therefore cannot control the terminal.
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

/// Returns a section of help.txt, or "" if there is none. The first line of a command's section is
/// its summary.
std::string help_text(const std::string& section) {
  const std::string& all = embedded_text("help.txt");
  const std::string head = "[" + section + "]\n";
  const std::size_t place = all.find(head);
  if (place == std::string::npos) return "";
  const std::size_t begin = place + head.size();
  const std::size_t end = std::min(all.find("\n\n[", begin), all.size() - 1);
  return all.substr(begin, end - begin);
}

using Options = CommandOptions;

/// Command-line option that one or several commands support.
struct Option {
  std::string flags;  ///< names on the command line; without a dash: positional argument
  std::variant<bool Options::*, int Options::*, unsigned Options::*, std::size_t Options::*,
               double Options::*, std::string Options::*, std::vector<std::string> Options::*>
      member;
  const char* help;
  CLI::Validator validator = {};

  [[nodiscard]] std::string_view name() const {
    return std::string_view(flags).substr(flags.rfind(',') + 1);
  }
};

/// Accepts a number from `least` to `most`. CLI::Range would print limits such as 1e-10 as 0.
CLI::Validator within(double least, double most) {
  const std::string limits = shortest_decimal(least) + " to " + shortest_decimal(most);
  const auto message_of = [=](std::string& word) -> std::string {
    double value = 0;
    const bool fits = CLI::detail::lexical_cast(word, value) && value >= least && value <= most;
    return fits ? "" : "expected a number from " + limits + " (got " + printable(word) + ")";
  };
  return {message_of, limits};
}

const std::vector<Option>& all_command_options() {
  static const std::vector<Option> options = {
      {"case", &Options::word, "Name or file of a case, or case:variant"},
      {"cases", &Options::words,
       "Names or files of cases; default: the catalogue, except for 'run' and 'effects'"},
      {"inputs", &Options::words,
       "Names or files of cases, or results files or their folders; default: the catalogue"},
      {"names", &Options::words, "Names of references; default: all"},
      {"sides", &Options::words,
       "case, case:variant, results.json, or a folder that contains results.json"},
      {"what", &Options::words,
       "Families, studies or cases of the catalogue, or their files; default: every study"},
      {"results", &Options::word,
       "results.json file, or its folder, with the values or verdicts to use"},
      {"shards", &Options::words, "Folders written by 'trammel run --shard'"},
      {"adapter", &Options::adapter, "Program; quote it together with its arguments"},
      {"result", &Options::out, "Result file to be written"},
      {"file", &Options::word, "SQLite file of the history"},
      {"pattern", &Options::word, "Text in the name or title of a case (case-insensitive)"},
      {"-L,--label", &Options::labels,
       "Select cases of the catalogue with this label; repeated: with all labels"},
      {"--label-any", &Options::any_labels,
       "Select cases of the catalogue with one of these labels"},
      {"--variant", &Options::variant, "Run only this variant; 'base' is the case without patch"},
      {"-j,--jobs", &Options::jobs,
       "Number of parallel computations; the results do not depend on it", within(1, 1024)},
      {"-o,--out", &Options::out, "Output folder; for 'export', output file"},
      {"--resume", &Options::resume,
       "Reuse results of earlier calls from the store, and compute only missing ones"},
      {"--fresh", &Options::fresh,
       "Compute everything again; by default, results of the same program and input are reused "
       "from the store"},
      {"--store", &Options::store,
       "Folder in which completed runs and studies are stored; default: OUT/store"},
      {"--max-memory", &Options::memory_bytes,
       "Memory limit of one run, such as 500MB or 2GB; default: half of the memory",
       CLI::AsSizeValue(false)},
      {"--history", &Options::history,
       "Add verdicts, values, counted work and computing times to this SQLite file, for "
       "'trammel history' and the report"},
      {"--shard", &Options::shard,
       "K/N: run only the K-th of N parts, for 'trammel merge'; default selection: the full "
       "catalogue"},
      {"--json", &Options::json,
       "Print JSON; commands that run cases or studies print results.json"},
      {"--csv", &Options::csv, "Print CSV with a row for each number"},
      {"-q,--quiet", &Options::quiet,
       "Print only runs that fail or have warnings, and the summary"},
      {"--vtk", &Options::vtk,
       "Also write shapes, poses and motions to OUT/vtk for ParaView, as PVD and VTU files"},
      {"--pdf", &Options::pdf,
       "Also print the summary on one A4 sheet, OUT/summary.pdf, by Chromium"},
      {"--open", &Options::open, "Show the report in the default browser"},
      {"--html", &Options::html, "Also write a page with overlaid curves to this file"},
      {"--gate", &Options::gate, "Exit status 1 if a number differs beyond round-off"},
      {"--sweep", &Options::sweeps, "Use only the refinement sweep with this name; default: all"},
      {"--level", &Options::level, "Level of the refinement sweep, from 0; default: case itself",
       within(0, 1000000)},
      {"--matrices", &Options::matrices,
       "Write K, M, C, T and f (Matrix Market) and the mesh (VTU) to this folder; the case is "
       "written only with --out"},
      {"--quick", &Options::quick, "Measure only a few settings of each study, as in the report"},
      {"--repeats", &Options::repeats,
       "Number of measurements of each setting; for 'cost', at least 7", within(0, 10000)},
      {"--tolerance", &Options::tolerance,
       "Relative change that removed effects may cause, unless the case states a tolerance",
       within(1e-12, 1.0)},
      {"--seed", &Options::seed, "Seed of the random order of measurements"},
      {"--errors", &Options::all_errors,
       "Estimate discretization errors also for cases of the catalogue"},
      {"--no-errors", &Options::no_errors, "Estimate no discretization errors"},
      {"--warn-above", &Options::warn_above,
       "Relative discretization error above which a warning is printed; also estimates the errors "
       "of cases of the catalogue. Default: 0.01, for your own cases only",
       within(1e-15, 1e6)},
      {"--accuracy", &Options::accuracy,
       "Choose mesh and step so that the estimated relative errors of frequencies, load factors, "
       "displacements and positions are below this value",
       within(1e-10, 1.0)},
      {"--quantity", &Options::quantities,
       "Quantity to which --accuracy applies instead of the default, such as reaction_y_N:A"},
      {"--time-limit", &Options::time_limit_s, "Time limit of the search by --accuracy [s]",
       within(1.0, 1e6)},
      {"--results", &Options::builds, "results.json of the same cases computed by another build"},
      {"--max-time", &Options::max_time_s, "Wall time limit of one call of the adapter [s]",
       within(0.01, 1e6)},
      {"--max-disk", &Options::max_disk_bytes,
       "Disk space limit of one call of the adapter, such as 1GB", CLI::AsSizeValue(false)},
      {"--shards", &Options::shard_count, "Number of jobs in the array", within(1, 100000)},
      {"--time", &Options::job_time, "Time limit of a job in sbatch format, such as 2:00:00"}};
  return options;
}

constexpr std::pair<const char*, const char*> kExclusive[] = {{"--shard", "--store"},
                                                              {"--errors", "--no-errors"},
                                                              {"--warn-above", "--no-errors"},
                                                              {"--accuracy", "--no-errors"},
                                                              {"--csv", "--json"}};

struct CommandEntry {
  const char* name;
  Command* run;
  const char* options;  ///< names of options in the order of the help; final '!': required
  const char* out = "trammel-results";
};

constexpr CommandEntry kCommands[] = {
    {"list", list_command, "pattern --label --label-any --json"},
    {"describe", describe_command, "case! --json"},
    {"quantities", quantities_command, "case --json"},
    {"references", references_command, "names --csv --json"},
    {"run", run_command,
     "cases --label --label-any --variant --jobs --out --resume --store --max-memory --history "
     "--shard --json --quiet --vtk --errors --no-errors --warn-above --accuracy --quantity"},
    {"compare", compare_command, "sides! --csv --json --html --gate"},
    {"converge", converge_command, "case! --variant --jobs --json"},
    {"cost", cost_command,
     "what --sweep --variant --quick --repeats --seed --out --accuracy --quantity --time-limit "
     "--resume --store --json",
     "trammel-cost"},
    {"certify", certify_command, "cases --label --label-any --results --jobs --json --max-memory"},
    {"claims", claims_command, "results --jobs --json"},
    {"coverage", coverage_command, "results --json"},
    {"paper", paper_command, "results --json"},
    {"effects", effects_command, "cases --label --variant --tolerance --repeats --out --json", ""},
    {"report", report_command,
     "inputs --label --label-any --jobs --out --fresh --store --history --max-memory --errors "
     "--no-errors --warn-above --accuracy --quantity --pdf --open"},
    {"export", export_command, "case! --variant --level --sweep --out --matrices", ""},
    {"solve", solve_command, "case! result!", ""},
    {"grade", grade_command,
     "adapter! cases --label --label-any --variant --jobs --out --resume --store --json "
     "--max-memory --max-time --max-disk",
     "trammel-grade"},
    {"merge", merge_command, "shards! --jobs --out --max-memory --json"},
    {"slurm", slurm_command, "--shards! cases --label --label-any --variant --jobs --time --out"},
    {"history", history_command, "file! --json"},
};

std::string version_text() {
  const Json all = build_and_machine_info();
  std::string text = "trammel " TRAMMEL_VERSION "\ncommit " + all["commit"].get<std::string>();
  for (const auto& [name, version] : all["libraries"].items())
    text += "\n" + name + " " + version.get<std::string>();
  return text;
}

const std::vector<std::string> kTopics = {"cases", "verdicts", "effects", "accuracy"};

class CommandLine {
 public:
  /// @param first  the first argument. If it names a command, only that command is defined;
  ///   otherwise all commands are defined, for the help and for suggestions.
  CommandLine(const Renderers& renderers, const std::string& first) : renderers_(renderers) {
    app_.name("trammel");
    app_.footer("\n" + help_text("trammel"));
    app_.set_version_flag("--version", version_text());
    app_.require_subcommand(1);
    for (const CommandEntry& command : kCommands)
      if (!is_command(first) || first == command.name) define(command);
  }

  int run(const std::vector<std::string>& arguments) {
    const std::string first = arguments.empty() ? "" : arguments.front();
    if (!is_command(first) && !first.starts_with('-'))
      throw InputError("trammel: " + expected_command(first));
    // CLI11 takes the arguments from the back of the vector and keeps unused arguments in the
    // vector.
    std::vector<std::string> stack(arguments.rbegin(), arguments.rend());
    try {
      app_.parse(stack);
    } catch (const CLI::ParseError& error) {
      if (error.get_exit_code() == 0) return app_.exit(error);
      throw InputError("trammel: " + explained(error, arguments));
    }
    return command_();
  }

  static bool is_command(const std::string& name) {
    return contains(kCommands, name, &CommandEntry::name);
  }

  /// @param names  names of help topics, which are allowed in addition to commands
  static std::string expected_command(const std::string& word,
                                      std::vector<std::string> names = {}) {
    if (word.empty()) return "expected a command (see trammel --help)";
    const std::string topics = names.empty() ? "" : " or one of the topics " + join(names, "and");
    for (const CommandEntry& command : kCommands) names.emplace_back(command.name);
    return "expected a command" + topics + " (got '" + printable(word) + "')" +
           did_you_mean(word, names);
  }

 private:
  std::string explained(const CLI::ParseError& error, const std::vector<std::string>& arguments) {
    const std::string first = arguments.front();
    std::vector<std::string> names;
    for (const Option& option : all_command_options()) names.emplace_back(option.name());
    const auto wrong = std::ranges::find_if(arguments, [&](const std::string& argument) {
      return argument.starts_with("--") && !contains(names, argument);
    });
    return printable(error.what(), 200) +
           (wrong == arguments.end() ? "" : did_you_mean(*wrong, names)) + " (see trammel " +
           (is_command(first) ? first + " " : "") + "--help)";
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
    for (const char* of_search : {"--quantity", "--time-limit"})
      if (CLI::Option* option = sub->get_option_no_throw(of_search))
        option->needs(sub->get_option("--accuracy"));
    command_ = [this, &command] { return command.run(options_, renderers_); };
  }

  /// @param name  name of an option in `all_command_options`; a final '!' marks a required option
  void add_option(std::string name, CLI::App* sub) {
    const bool is_required = name.ends_with('!');
    if (is_required) name.pop_back();
    const Option& option = *std::ranges::find(all_command_options(), name, &Option::name);
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

void require_gnuplot(const Renderers& renderers) {
  if (!renderers.has_gnuplot())
    throw InputError("PATH: expected a folder with gnuplot, which draws the report");
}

int run_command_line(const std::vector<std::string>& arguments, const Renderers& renderers) {
  const PrintableStream out(std::cout), err(std::cerr);
  exit_on_signals("trammel: interrupted; the same command starts from the beginning\n");
  // Writing beyond the file size limit fails, but does not end the program.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    std::vector<std::string> words = arguments;
    if (!words.empty() && words.front() == "help") {
      words.erase(words.begin());
      const std::string text = words.empty() ? "" : help_text("topic " + words.front());
      std::cout << text << (text.empty() ? "" : "\n");
      if (!text.empty()) return 0;
      if (!words.empty() && !words.front().starts_with('-') &&
          !CommandLine::is_command(words.front()))
        throw InputError("trammel help: " + CommandLine::expected_command(words.front(), kTopics));
      words.emplace_back("--help");
    }
    const int status = CommandLine(renderers, words.empty() ? "" : words.front()).run(words);
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
  } catch (const std::system_error& error) {  // for example, a full disk
    std::cerr << "expected sufficient rights and disk space: " << one_line(error.what()) << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "trammel: internal error: " << one_line(error.what()) << '\n';
    return 3;
  }
}

}  // namespace trammel::harness

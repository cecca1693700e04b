#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <iterator>
#include <map>
#include <set>

#include "harness/base/errors.h"
#include "harness/base/find_or_add.h"
#include "harness/base/json_file.h"
#include "harness/base/processes.h"
#include "harness/base/progress.h"
#include "harness/base/text.h"
#include "harness/cli/commands.h"
#include "harness/coverage/evidence_coverage.h"
#include "harness/export/vtk_files.h"
#include "harness/input/catalogue.h"
#include "harness/input/document.h"
#include "harness/printing/printing.h"
#include "harness/results/unfinished_folder.h"
#include "harness/run/claims.h"
#include "harness/run/results.h"
#include "harness/run/shards.h"
#include "harness/run/stored_results.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;

/// Returns true if the options contain neither cases nor labels.
bool selects_all(const CommandOptions& options) {
  return options.words.empty() && options.labels.empty() && options.any_labels.empty();
}

/// Cases to run, and failed runs for case files that cannot be read.
struct Selection {
  std::vector<Case> cases;
  std::vector<Run> broken;
};

/// Loads case files. A file that cannot be read becomes a failed run, so that the other cases run.
Selection load(const std::vector<fs::path>& files, const Catalogue& catalogue) {
  Selection selection;
  for (const auto& file : files) {
    try {
      selection.cases.push_back(load_case(file, catalogue));
    } catch (const InputError& error) {
      if (files.size() == 1) throw;
      Run run;
      run.case_id = file.stem().string();
      run.variant = kBaseVariant;
      run.status = results::Status::error;
      run.reason = one_line(error.what());
      run.fault = results::Fault::input;
      selection.broken.push_back(std::move(run));
    }
  }
  return selection;
}

void require_distinct_cases(const std::vector<Case>& cases) {
  std::map<std::string, std::string> seen;
  for (const Case& test_case : cases) {
    const auto [entry, fresh] = seen.emplace(test_case.id(), test_case.file.string());
    if (!fresh)
      throw InputError("expected cases of different names (got '" + test_case.id() + "' in " +
                       entry->second + " and in " + test_case.file.string() + ")");
  }
}

void require_variant_in_cases(const std::vector<Case>& cases, const std::string& variant) {
  for (const Case& test_case : cases) {
    if (!variant.empty()) (void)patched(test_case, variant);
    for (const std::string& chosen : test_case.chosen_variants) (void)patched(test_case, chosen);
  }
}

RunOptions to_run_options(const CommandOptions& given, Progress& progress) {
  RunOptions options{given.variant, given.jobs, TrackedQuantities::named, {}};
  options.progress = [&](std::size_t done, std::size_t all) {
    if (!given.quiet) progress.show(done, all);
  };
  options.store = store_folder(given.out, given.store);
  options.resume = given.resume;
  options.any_machine = given.any_machine;
  options.memory_bytes = given.memory_bytes;
  options.errors = given.all_errors || given.warn_above > 0 ? ErrorWish::all
                   : given.no_errors                        ? ErrorWish::none
                                                            : ErrorWish::own_cases;
  if (given.warn_above > 0) options.warn_above = given.warn_above;
  options.accuracy = given.accuracy;
  options.quantities = given.quantities;
  return options;
}

std::vector<Run> compute(const Selection& selection, const References& references,
                         const CommandOptions& options) {
  Progress progress("runs");
  std::vector<Run> runs = run_cases(selection.cases, references, to_run_options(options, progress));
  runs.insert(runs.end(), selection.broken.begin(), selection.broken.end());
  return runs;
}

void print_run_errors(const std::vector<Run>& runs) {
  std::set<std::string> printed;  // variants of one case often fail with the same message
  for (const Run& run : runs)
    if (run.fault != results::Fault::none && printed.insert(run.reason).second)
      std::cerr << run.reason << '\n';
}

/// Returns true if all runs were refused because of invalid input, and prints their errors. The
/// command then leaves earlier results unchanged.
bool print_errors_if_all_refused(const std::vector<Run>& runs) {
  const auto is_refused = [](const Run& run) { return run.fault == results::Fault::input; };
  if (runs.empty() || !std::ranges::all_of(runs, is_refused)) return false;
  print_run_errors(runs);
  return true;
}

void reject_variant_option(const std::string& option, const std::string& name) {
  if (!option.empty())
    throw InputError("--variant: expected a name of a case without a variant (got '" + name + "')");
}

/// Selects the cases with the given names or labels; all cases of the catalogue if the options
/// contain neither names nor labels.
Selection select(const CommandOptions& options) {
  const Catalogue catalogue;
  if (selects_all(options)) return load(catalogue.runnable_files(), catalogue);
  std::vector<fs::path> files;
  std::map<fs::path, std::vector<std::string>> chosen;
  for (const std::string& word : options.words) {
    const auto [name, variant] = split_case_name(word);
    const fs::path file = catalogue.find_case(name);
    if (!variant.empty()) reject_variant_option(options.variant, word);
    if (variant.empty() || !chosen.contains(file)) files.push_back(file);
    if (!variant.empty()) chosen[file].push_back(variant);
  }
  Selection selection = load(files, catalogue);
  for (Case& test_case : selection.cases) test_case.chosen_variants = chosen[test_case.file];
  if (!options.labels.empty() || !options.any_labels.empty())
    for (Case& test_case : catalogue.load(options.labels, options.any_labels))
      if (!contains(selection.cases, test_case.id(), &Case::id))
        selection.cases.push_back(std::move(test_case));
  require_distinct_cases(selection.cases);
  require_variant_in_cases(selection.cases, options.variant);
  return selection;
}

/// Runs each function in a separate process. The functions write their results into the store.
/// @returns true if all functions were completed
bool call_in_subprocesses(const std::vector<std::function<void()>>& work, unsigned jobs,
                          const std::string& items) {
  constexpr unsigned kLimit = 3600;  // [s]; each computation inside a function has a separate limit
  std::vector<ProcessTask> tasks;
  for (const auto& one : work) {
    const auto done = [&one] {
      try {
        one();
      } catch (const InputError&) {  // reported when the missing result is needed
        return std::string("not done");
      }
      return std::string();
    };
    tasks.push_back({done, kLimit});
  }
  Progress progress(items);
  std::size_t ended = 0;
  bool all = true;
  const auto show = [&] { progress.show(ended, tasks.size()); };
  const int signal = run_in_worker_processes(
      tasks, {jobs, 0, show}, [&](std::size_t, const ProcessOutcome& outcome) {
        all = all && outcome.termination == ProcessOutcome::Termination::answered &&
              outcome.text.empty();
        ++ended;
        show();
      });
  if (signal != 0) std::raise(signal);
  return all;
}

bool is_results_file(const std::string& name) {
  try {
    return !read_json_if_results(results_file_path(name)).is_null();
  } catch (const InputError&) {
    return false;  // the error is reported when the file is read as a case
  }
}

/// Returns the path of the first installed program that can carry out an option, such as --pdf.
/// @throws InputError  if no suitable program is installed
std::string require_program(const std::string& option) {
  static const std::map<std::string, std::vector<std::string>> kPrograms = {
      {"--pdf", {"chromium", "chromium-browser", "google-chrome"}}, {"--open", {"xdg-open"}}};
  for (const std::string& name : kPrograms.at(option))
    if (const std::string path = find_program(name); !path.empty()) return path;
  throw InputError(option + ": expected the program '" + kPrograms.at(option).front() +
                   "' in PATH");
}

void require_programs(const CommandOptions& options) {
  if (options.pdf) (void)require_program("--pdf");
  if (options.open) (void)require_program("--open");
}

/// Prints summary.html as PDF, and shows the report in a browser, if the options request this.
void present(const CommandOptions& options, const fs::path& page) {
  std::cout << "report in " << page.string() << std::endl;
  const fs::path folder = fs::absolute(page).parent_path();
  const fs::path sheet = folder / "summary.html", pdf = folder / "summary.pdf";
  fs::remove(pdf);  // summary of an earlier report
  if (options.pdf) {
    if (!fs::exists(sheet))
      throw InputError("--pdf: the report has no summary, because no case was run");
    // The profile of the browser is below the system's folder for temporary files, because Chromium
    // limits the length of its path.
    std::string profile = (fs::temp_directory_path() / "trammel-XXXXXX").string();
    if (mkdtemp(profile.data()) == nullptr)
      throw InputError(profile + ": cannot create a folder for Chromium");
    const ProcessOutcome outcome =
        run_limited({require_program("--pdf"), "--headless", "--no-sandbox", "--disable-gpu",
                     "--no-pdf-header-footer", "--user-data-dir=" + profile,
                     "--print-to-pdf=" + pdf.string(), sheet.string()},
                    profile, {});
    fs::remove_all(profile);
    if (!fs::exists(pdf)) throw InputError("--pdf: Chromium failed: " + one_line(outcome.text));
    std::cout << "summary in " << pdf.string() << std::endl;
  }
  if (options.open && fork() == 0) {
    const std::string program = require_program("--open");
    setsid();  // so that the browser may outlive this program
    execl(program.c_str(), program.c_str(), page.c_str(), nullptr);
    _exit(127);
  }
}

/// Renders existing results without computing: a single file as a report, several files as a page
/// that compares codes.
int report_results(const CommandOptions& options, const Renderers& renderers) {
  std::vector<fs::path> files;
  std::ranges::transform(options.words, std::back_inserter(files), results_file_path);
  if (files.size() > 1)
    for (const auto& file : files)
      if (const auto fault = find_schema_fault(read_json(file), "results"))
        throw InputError(file.string(), fault->pointer, fault->message);
  if (files.size() > 1 && options.pdf)
    throw InputError("--pdf: a comparison of codes has no summary; expected one results file");
  if (files.size() == 1) require_gnuplot(renderers);
  require_programs(options);
  const OutputLock lock(options.out);
  fs::path page;
  if (files.size() == 1) {
    const results::Results results = load_results(files.front());
    if (!results.missing.empty())
      std::cerr << files.front().string() << ": " << results.missing << '\n';
    fs::remove_all(fs::path(options.out) / results::kUnfinishedFolder);
    page = renderers.report(results, options.out);
  } else {
    page = renderers.codes(files, options.out);
  }
  present(options, page);
  return 0;
}

/// Returns the selected cases, labels and variant in a form that does not depend on the working
/// folder.
Json selection_json(const CommandOptions& options) {
  Json cases = Json::array();
  for (const std::string& word : options.words) {
    const auto [name, variant] = split_case_name(word);
    cases.push_back((fs::exists(name) ? fs::absolute(name).string() : name) +
                    (variant.empty() ? "" : ":" + variant));
  }
  return {{"cases", cases},
          {"labels", options.labels},
          {"any_labels", options.any_labels},
          {"variant", options.variant}};
}

/// Computes one shard of the selected cases. The checks are evaluated after the shards are merged.
int compute_shard(const CommandOptions& options) {
  const Shard shard = parse_shard(options.shard);
  const Selection selection = select(options);
  const OutputLock lock(options.out);
  exit_on_signals(kInterrupted);
  fs::remove(fs::path(options.out) / kShardFile);
  Progress progress("runs");
  const ShardRuns shard_runs = run_shard(selection.cases, to_run_options(options, progress), shard);
  print_run_errors(shard_runs.runs);
  require_uninterrupted(shard_runs.runs);
  write_shard(options.out, shard, selection_json(options), shard_runs);
  std::cout << "shard " << options.shard << ": " << shard_runs.runs.size() << " of "
            << shard_runs.in_all << " computations in " << options.out
            << "; 'trammel merge' judges them\n";
  return 0;
}

/// Adds the results of the studies that belong to the complete catalogue: cost, claims, coverage
/// and effects.
/// @returns the exit status of the studies
int add_all_studies(results::Results& results, const std::vector<Case>& cases,
                    const References& references, const CommandOptions& options) {
  const fs::path store = store_folder(options.out, options.store);
  const bool resume = !options.fresh;
  std::vector<std::function<void()>> studies;
  // An earlier report of the same runs has stored all studies.
  if (!resume || results.environment.stored_runs < std::ssize(results.runs) ||
      !fs::exists(fs::path(options.out) / "index.html")) {
    studies = quick_cost_work(references, store, resume);
    for (auto& work : effect_scene_work(store, resume)) studies.push_back(std::move(work));
  }
  // The calls of `quick_cost_studies` and `catalogue_effect_scenes` below read the results from the
  // store, and compute those that are missing. With --fresh, they read stored results only if all
  // functions in `studies` were completed.
  const bool measured = call_in_subprocesses(studies, options.jobs, "studies of cost and effects");
  std::vector<std::string> error_messages;
  results.cost = quick_cost_studies(references, store, resume || measured, error_messages);
  const Document document = load_claims();
  results.claims = evaluate_claims(document, results.runs);
  results.claims->items = load_paper_items(document, Catalogue());
  judge_paper_items(results, results.claims->items);
  results.coverage = evidence_coverage(cases, references);
  explain_missing_evidence(results.coverage);
  count_quantity_runs(results, results.coverage);
  results.effect_scenes = catalogue_effect_scenes(store, resume || measured);
  for (const std::string& error_message : error_messages) std::cerr << error_message << '\n';
  for (const results::Claim& claim : results.claims->claims)
    if (claim.verdict != claim.expected)
      std::cerr << "claim " << claim.id << ": expected the recorded verdict, " << claim.expected
                << " (got " << claim.verdict << ")\n";
  return std::max(error_messages.empty() ? 0 : 2, exit_status(*results.claims));
}

}  // namespace

std::pair<std::string, std::string> split_case_name(const std::string& name) {
  const auto colon = name.rfind(':');
  const bool is_split = colon != std::string::npos && colon > 0 && colon + 1 < name.size() &&
                        name.find('/', colon) == std::string::npos && !fs::exists(name);
  return {is_split ? name.substr(0, colon) : name, is_split ? name.substr(colon + 1) : ""};
}

std::pair<Case, std::string> load_case_variant(const std::string& name, const std::string& option) {
  const auto [file, variant] = split_case_name(name);
  if (!variant.empty()) reject_variant_option(option, name);
  return {load_named_case(file), option + variant};
}

std::vector<Case> select_cases(const CommandOptions& options) {
  Selection selection = select(options);
  if (!selection.broken.empty()) throw InputError(selection.broken.front().reason);
  return std::move(selection.cases);
}

fs::path write_pages(const results::Results& results, const std::string& out,
                     const Renderers& renderers) {
  const auto unfinished = fs::path(out) / results::kUnfinishedFolder;
  fs::create_directories(unfinished);
  write_results(results, unfinished);
  if (!results.runs.empty()) renderers.junit(results, unfinished / "junit.xml");
  return renderers.report(results, out);
}

int run_command(const CommandOptions& options, const Renderers& renderers) {
  if (!options.shard.empty()) return compute_shard(options);
  if (selects_all(options)) throw InputError("expected a case or label (see trammel run --help)");
  const Selection selection = select(options);
  const OutputLock lock(options.out);
  exit_on_signals(kInterrupted);
  const References references;
  std::vector<Run> computed = compute(selection, references, options);
  if (print_errors_if_all_refused(computed)) return 2;
  const results::Results results = collect_results(std::move(computed), selection.cases, references,
                                                   store_folder(options.out, options.store));
  const std::vector<Run>& runs = results.runs;
  const fs::path out = options.out, file = write_results(results, out);
  renderers.junit(results, out / "junit.xml");
  if (options.json) {
    std::cout << read_text(file);
  } else {
    for (const Run& run : runs)
      if (run.fault == results::Fault::none && run.interrupted_by == 0 &&
          (!options.quiet || counts_as_failure(run) || !run.warnings.empty()))
        print_run(run, options.no_errors);
    print_summary(results);
    const bool has_pages = fs::exists(out / "index.html");
    std::cout << "results in " << file.string() << (has_pages ? "; index.html is older\n" : "\n")
              << std::flush;
  }
  if (options.vtk)
    for (const Run& run : runs) write_vtk(run, out / "vtk");
  print_run_errors(runs);
  require_uninterrupted(runs);
  if (!options.history.empty()) append_history(options.history, results);
  return exit_status(runs);
}

int report_command(const CommandOptions& options, const Renderers& renderers) {
  const std::size_t stored = std::ranges::count_if(options.words, is_results_file);
  if (stored > 0) {
    if (stored < options.words.size() || !options.labels.empty() || !options.any_labels.empty())
      throw InputError("expected either cases or existing results files (got both)");
    return report_results(options, renderers);
  }
  require_gnuplot(renderers);
  require_programs(options);
  CommandOptions resuming = options;
  resuming.resume = !options.fresh;
  const Selection selection = select(resuming);
  const OutputLock lock(options.out);
  exit_on_signals("trammel: interrupted; the same command computes the rest\n");
  const References references;
  std::vector<Run> computed = compute(selection, references, resuming);
  require_uninterrupted(computed);
  if (print_errors_if_all_refused(computed)) return 2;
  results::Results results = collect_results(std::move(computed), selection.cases, references,
                                             store_folder(options.out, options.store));
  const std::vector<Run>& runs = results.runs;
  for (const Run& run : runs)
    if (counts_as_failure(run) && run.fault == results::Fault::none) print_run(run);
  const int status =
      selects_all(options) ? add_all_studies(results, selection.cases, references, options) : 0;
  if (!options.history.empty()) {
    append_history(options.history, results);
    results.history = read_history(options.history);
  }
  const auto page = write_pages(results, options.out, renderers);
  print_summary(results);
  print_run_errors(runs);
  present(options, page);
  return std::max(exit_status(runs), status);
}

}  // namespace trammel::harness

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <functional>
#include <iostream>
#include <map>

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
#include "harness/results/run_grade.h"
#include "harness/results/unfinished_folder.h"
#include "harness/run/claims.h"
#include "harness/run/results.h"
#include "harness/run/shards.h"
#include "harness/run/stored_results.h"

namespace trammel::harness {
namespace {

/// Cases to run, and the runs of those that could not even be read.
struct Selection {
  std::vector<Case> cases;
  std::vector<Run> broken;
};

/// Bad files among several must not take the good ones' results with them.
Selection load(const std::vector<std::filesystem::path>& files, const Catalogue& catalogue) {
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

void require_distinct(const std::vector<Case>& cases) {
  std::map<std::string, std::string> seen;
  for (const Case& test_case : cases) {
    const auto [entry, fresh] = seen.emplace(test_case.id(), test_case.file.string());
    if (!fresh) {
      throw InputError("expected cases of different names (got '" + test_case.id() + "' in " +
                       entry->second + " and in " + test_case.file.string() + ")");
    }
  }
}

void require_variant(const std::vector<Case>& cases, const std::string& variant) {
  if (variant.empty()) return;
  for (const Case& test_case : cases) (void)patched(test_case, variant);
}

RunOptions run_options(const CommandOptions& given, Progress& progress) {
  RunOptions options{given.variant, given.jobs, TrackedQuantities::named, {}};
  options.progress = [&](std::size_t done, std::size_t all) { progress.show(done, all); };
  options.store = store_folder(given.out, given.store);
  options.resume = given.resume;
  options.any_machine = given.any_machine;
  options.memory_bytes = given.memory_bytes;
  options.errors = given.all_errors  ? ErrorWish::all
                   : given.no_errors ? ErrorWish::none
                                     : ErrorWish::own_cases;
  options.warn_above = given.warn_above;
  options.accuracy = given.accuracy;
  options.quantities = given.quantities;
  return options;
}

std::vector<Run> compute(const Selection& selection, const References& references,
                         const CommandOptions& options) {
  Progress progress("runs");
  std::vector<Run> runs = run_cases(selection.cases, references, run_options(options, progress));
  runs.insert(runs.end(), selection.broken.begin(), selection.broken.end());
  return runs;
}

/// Numbers for a dashboard, as ctest extracts them from the output of a test.
void print_measurements(const results::Results& results) {
  std::size_t checks = 0, failures = 0;
  double share = 0, cpu_s = 0;
  for (const Run& run : results.runs) {
    cpu_s += run.cost.cpu_s;
    for (const results::Check& check : run.checks) {
      ++checks;
      failures += fails_gate(check.verdict) ? 1 : 0;
      const bool is_limited = check.tolerance && check.tolerance->low && check.tolerance->high;
      if (is_limited) share = std::max(share, results::tolerance_share(check));
    }
  }
  const auto print = [](const char* name, auto value) {
    std::cout << fmt::format(
        "<CTestMeasurement type=\"numeric/double\" name=\"{}\">{:.6g}</CTestMeasurement>\n", name,
        static_cast<double>(value));
  };
  print("runs", results.runs.size());
  print("checks", checks);
  print("failed checks", failures);
  print("worst share of a tolerance", share);
  print("processor time of the runs [s]", cpu_s);
}

void print_run_errors(const std::vector<Run>& runs) {
  std::vector<std::string> told;
  for (const Run& run : runs) {
    if (run.fault == results::Fault::none) continue;
    // Variants of one case often have one and the same fault.
    if (contains(told, run.reason)) continue;
    told.push_back(run.reason);
    std::cerr << run.reason << '\n';
  }
}

/// The cases that are named, and those with the labels; the whole catalogue where there are
/// neither.
Selection select(const CommandOptions& options) {
  const Catalogue catalogue;
  if (options.words.empty() && options.labels.empty())
    return load(catalogue.runnable_files(), catalogue);
  std::vector<std::filesystem::path> files;
  for (const std::string& name : options.words) files.push_back(catalogue.find_case(name));
  Selection selection = load(files, catalogue);
  if (!options.labels.empty()) {
    for (Case& test_case : catalogue.load(options.labels)) {
      const bool there = std::ranges::any_of(
          selection.cases, [&](const Case& other) { return other.id() == test_case.id(); });
      if (!there) selection.cases.push_back(std::move(test_case));
    }
  }
  require_distinct(selection.cases);
  require_variant(selection.cases, options.variant);
  return selection;
}

/// Does work that leaves what it finds in the store, each in a process of its own.
/// @returns whether all of it came to its end
bool do_in_processes(const std::vector<std::function<void()>>& work, unsigned jobs,
                     const std::string& items) {
  constexpr unsigned kLimit = 3600;  // [s]; each computation in it has a limit of its own
  std::vector<ProcessTask> tasks;
  for (const auto& one : work) {
    const auto done = [&one] {
      try {
        one();
      } catch (const InputError&) {  // told by who reads the store
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
  const int signal =
      run_in_processes(tasks, {jobs, 0, show}, [&](std::size_t, const ProcessOutcome& outcome) {
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
    return !read_if_results(name).is_null();
  } catch (const InputError&) {
    return false;  // reported when it is read as a case
  }
}

/// Computes nothing: one file becomes a report as it is, several a page of codes side by side.
int report_results(const CommandOptions& options, const Renderers& renderers) {
  const std::vector<std::filesystem::path> files(options.words.begin(), options.words.end());
  if (files.size() > 1)
    for (const auto& file : files)
      if (const auto fault = find_schema_fault(read_json(file), "results"))
        throw InputError(file.string(), fault->pointer, fault->message);
  if (files.size() == 1) require_drawing(renderers);
  const OutputLock lock(options.out);
  std::filesystem::path page;
  if (files.size() == 1) {
    const results::Results results = load_results(files.front());
    if (!results.missing.empty())
      std::cerr << files.front().string() << ": " << results.missing << '\n';
    std::filesystem::remove_all(std::filesystem::path(options.out) / results::kUnfinishedFolder);
    page = renderers.report(results, options.out);
  } else {
    page = renderers.codes(files, options.out);
  }
  std::cout << "report in " << page.string() << std::endl;
  return 0;
}

/// The selection in words that mean the same in another folder.
Json selection_of(const CommandOptions& options) {
  Json cases = Json::array();
  for (const std::string& name : options.words)
    cases.push_back(std::filesystem::exists(name) ? std::filesystem::absolute(name).string()
                                                  : name);
  return {{"cases", cases}, {"labels", options.labels}, {"variant", options.variant}};
}

/// Computes a part of what is selected and judges nothing.
int compute_shard(const CommandOptions& options) {
  Shard shard = shard_from(options.shard);
  if (!options.costs.empty()) shard.costs = earlier_costs(options.costs);
  const Selection selection = select(options);
  const OutputLock lock(options.out);
  end_on_signals(kInterrupted);
  std::filesystem::remove(std::filesystem::path(options.out) / kShardFile);
  Progress progress("runs");
  const ShardRuns shard_runs = run_shard(selection.cases, run_options(options, progress), shard);
  print_run_errors(shard_runs.runs);
  require_complete(shard_runs.runs);
  write_shard(options.out, shard, selection_of(options), shard_runs);
  std::cout << "shard " << options.shard << ": " << shard_runs.runs.size() << " of "
            << shard_runs.in_all << " computations in " << options.out
            << "; 'trammel merge' judges them\n";
  return 0;
}

/// Adds the studies of the catalogue: cost, claims, coverage, effects.
/// @returns the exit status of the studies
int add_studies(results::Results& results, const std::vector<Case>& cases,
                const References& references, const CommandOptions& options) {
  const std::filesystem::path store = store_folder(options.out, options.store);
  const bool resume = !options.fresh;
  std::vector<std::function<void()>> studies = quick_cost_work(references, store, resume);
  for (auto& work : effect_scene_work(store, resume)) studies.push_back(std::move(work));
  // Finished work is in the store. The rest is done, or reported as impossible, here.
  const bool measured = do_in_processes(studies, options.jobs, "studies of cost and effects");
  std::vector<std::string> error_messages;
  results.cost = quick_cost(references, store, resume || measured, error_messages);
  const Document document = load_claims();
  results.claims = evaluate_claims(document, results.runs);
  results.claims->items = load_paper_items(document, Catalogue());
  judge_paper_items(results, results.claims->items);
  results.coverage = evidence_coverage(cases, references);
  add_reasons(results.coverage);
  count_series(results, results.coverage);
  results.effect_scenes = catalogue_effect_scenes(store, resume || measured);
  for (const std::string& error_message : error_messages) std::cerr << error_message << '\n';
  for (const results::Claim& claim : results.claims->claims)
    if (claim.verdict != claim.expected)
      std::cerr << "claim " << claim.id << ": expected the recorded verdict, " << claim.expected
                << " (got " << claim.verdict << ")\n";
  return std::max(error_messages.empty() ? 0 : 2, exit_status(*results.claims));
}

}  // namespace

std::vector<Case> select_cases(const CommandOptions& options) {
  Selection selection = select(options);
  if (!selection.broken.empty()) throw InputError(selection.broken.front().reason);
  return std::move(selection.cases);
}

std::filesystem::path write_pages(const results::Results& results, const std::string& out,
                                  const Renderers& renderers) {
  const auto unfinished = std::filesystem::path(out) / results::kUnfinishedFolder;
  std::filesystem::create_directories(unfinished);
  write_results(results, unfinished);
  if (!results.runs.empty()) renderers.junit(results, unfinished / "junit.xml");
  return renderers.report(results, out);
}

int run_command(const CommandOptions& options, const Renderers& renderers) {
  if (!options.shard.empty()) return compute_shard(options);
  if (options.words.empty() && options.labels.empty())
    throw InputError("expected a case or a label (see trammel run --help)");
  const Selection selection = select(options);
  const OutputLock lock(options.out);
  end_on_signals(kInterrupted);
  const References references;
  const results::Results results =
      results_of(compute(selection, references, options), selection.cases, references,
                 store_folder(options.out, options.store));
  const std::vector<Run>& runs = results.runs;
  const std::filesystem::path out = options.out, file = write_results(results, out);
  renderers.junit(results, out / "junit.xml");
  if (options.json) {
    std::cout << read_text(file);
  } else {
    for (const Run& run : runs)
      if (run.fault == results::Fault::none && run.interrupted_by == 0) print_run(run);
    if (runs.size() == 1) print_validation(runs.front());
    print_summary(results);
    std::cout << "results in " << file.string() << std::endl;
  }
  if (options.measurements) print_measurements(results);
  if (options.vtk)
    for (const Run& run : runs) write_vtk(run, out / "vtk");
  print_run_errors(runs);
  require_complete(runs);
  if (!options.history.empty()) append_history(options.history, results);
  return exit_status(runs);
}

int report_command(const CommandOptions& options, const Renderers& renderers) {
  const std::size_t stored = std::ranges::count_if(options.words, is_results_file);
  if (stored > 0) {
    if (stored < options.words.size() || !options.labels.empty())
      throw InputError("expected cases, or results files alone; each file has to be there");
    return report_results(options, renderers);
  }
  require_drawing(renderers);
  CommandOptions resuming = options;
  resuming.resume = !options.fresh;
  const Selection selection = select(resuming);
  const OutputLock lock(options.out);
  end_on_signals("trammel: interrupted; the same command does what is missing\n");
  const References references;
  std::vector<Run> computed = compute(selection, references, resuming);
  require_complete(computed);
  results::Results results = results_of(std::move(computed), selection.cases, references,
                                        store_folder(options.out, options.store));
  const std::vector<Run>& runs = results.runs;
  for (const Run& run : runs)
    if (fails_gate(run) && run.fault == results::Fault::none) print_run(run);
  const bool catalogue = options.words.empty() && options.labels.empty();
  const int status = catalogue ? add_studies(results, selection.cases, references, options) : 0;
  if (!options.history.empty()) {
    append_history(options.history, results);
    results.history = read_history(options.history);
  }
  const auto page = write_pages(results, options.out, renderers);
  print_summary(results);
  std::cout << "report in " << page.string() << std::endl;
  print_run_errors(runs);
  return std::max(exit_status(runs), status);
}

}  // namespace trammel::harness

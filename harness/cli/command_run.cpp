#include "harness/cli/command_run.h"

#include <algorithm>
#include <csignal>
#include <functional>
#include <iostream>
#include <map>

#include "harness/base/contains.h"
#include "harness/base/errors.h"
#include "harness/base/find_or_add.h"
#include "harness/base/json_file.h"
#include "harness/base/processes.h"
#include "harness/base/progress.h"
#include "harness/base/quantity.h"
#include "harness/base/statistic.h"
#include "harness/base/table.h"
#include "harness/base/text.h"
#include "harness/cli/command_cost.h"
#include "harness/cli/command_effects.h"
#include "harness/coverage/evidence_coverage.h"
#include "harness/export/vtk_files.h"
#include "harness/input/catalogue.h"
#include "harness/input/schema.h"
#include "harness/judge/uncertainty_summary.h"
#include "harness/printing/print_uncertainty.h"
#include "harness/results/unfinished_folder.h"
#include "harness/run/claims.h"
#include "harness/run/history.h"
#include "harness/run/output_lock.h"
#include "harness/run/paper_items.h"
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

RunOptions options_of(const RunCommand& command, Progress& progress) {
  RunOptions options{command.variant, command.jobs, TrackedQuantities::named, {}};
  options.progress = [&](std::size_t done, std::size_t all) { progress.show(done, all); };
  options.store = store_folder(command.out, command.store);
  options.resume = command.resume;
  options.any_machine = command.any_machine;
  options.memory_bytes = command.memory_bytes;
  return options;
}

std::vector<Run> compute(const Selection& selection, const References& references,
                         const RunCommand& command) {
  Progress progress("runs");
  std::vector<Run> runs = run_cases(selection.cases, references, options_of(command, progress));
  runs.insert(runs.end(), selection.broken.begin(), selection.broken.end());
  return runs;
}

/// The entry of a check that deserves to be told: the first one that does not hold, else the one
/// farthest out.
struct CheckSummary {
  const CheckResult* worst = nullptr;
  std::size_t entries = 0;
};

std::vector<CheckSummary> summarise_checks(const Run& run) {
  std::vector<CheckSummary> told;
  for (const CheckResult& check_result : run.checks) {
    const auto is_same = [&](const CheckSummary& one) {
      return one.worst->name == check_result.name;
    };
    CheckSummary& check = find_or_add(told, is_same, {&check_result, 0});
    ++check.entries;
    const auto rank = [](const CheckResult& judged) {
      return std::pair(fails_gate(judged.verdict), severity(judged));
    };
    if (rank(check_result) > rank(*check.worst)) check.worst = &check_result;
  }
  return told;
}

/// Digits that tell the ends of a window from each other and from what lies between them.
int digits_of(const CheckResult& check_result) {
  constexpr int least = 3, most = 12;
  if (!check_result.tolerance || check_result.tolerance->symmetric) return least;
  const double low = *check_result.tolerance->low, high = *check_result.tolerance->high;
  const auto judged =
      check_result.measure == "bound" ? check_result.computed : check_result.difference;
  const auto apart = [](double a, double b, int digits) {
    return a == b || !std::isfinite(a) || !std::isfinite(b) ||
           rounded(a, digits) != rounded(b, digits);
  };
  for (int digits = least; digits < most; ++digits) {
    const bool told = apart(low, high, digits) &&
                      (!judged || (apart(low, *judged, digits) && apart(*judged, high, digits)));
    if (told) return digits;
  }
  return most;
}

std::string tolerance_text(const CheckResult& check_result) {
  if (!check_result.tolerance) return "";
  const results::Tolerance& tolerance = *check_result.tolerance;
  if (tolerance.symmetric) return "+-" + rounded(*tolerance.high, 3);
  const int digits = digits_of(check_result);
  const std::string low = rounded(*tolerance.low, digits), high = rounded(*tolerance.high, digits);
  if (!tolerance.low) return "at most " + high;
  if (!tolerance.high) return "at least " + low;
  return "[" + low + ", " + high + "]";
}

std::string verdict_text(const CheckResult& check_result) {
  if (check_result.verdict == Verdict::pass &&
      check_result.expectation == Expectation::known_discrepancy) {
    return "does not agree";
  }
  return to_string(check_result.verdict);
}

/// What was computed, where no check says it: short ones whole, of long ones the range.
void print_quantities(const Run& run) {
  constexpr std::size_t most = 30, whole = 6;
  Table table({"quantity", ">entries", "values"});
  std::size_t told = 0, left = 0;
  for (const auto& [name, quantity] : run.quantities) {
    const std::vector<double>& values = quantity.values;
    if (values.empty() || is_diagnostic(name)) continue;
    if (told == most) {
      ++left;
      continue;
    }
    ++told;
    std::string text;
    if (values.size() > whole) {
      text = rounded(statistic_of("min", values)) + " ... " + rounded(statistic_of("max", values));
    } else {
      for (const double value : values) text += (text.empty() ? "" : ", ") + rounded(value, 8);
    }
    table.add({name, std::to_string(values.size()), text});
  }
  if (!table.empty()) table.print(std::cout, "  ");
  if (left > 0) std::cout << "  and " << left << " more in results.json\n";
}

void print_run(const Run& run) {
  std::cout << run.case_id << (run.variant == kBaseVariant ? "" : ":" + run.variant) << "  "
            << to_string(run.status) << ", " << rounded(run.cost.wall_s, 2) << " s\n";
  if (!run.reason.empty()) std::cout << wrapped(run.reason, "  ");
  for (const std::string& warning : run.warnings) std::cout << wrapped("warning: " + warning, "  ");
  Table table(
      {"verdict", "check", "quantity", ">computed", ">expected", ">difference", ">allowed"});
  std::vector<std::string> messages;
  for (const CheckSummary& told : summarise_checks(run)) {
    const CheckResult& check_result = *told.worst;
    std::string quantity = check_result.quantity;
    if (check_result.index && told.entries > 1)
      quantity += "[" + std::to_string(*check_result.index) + "]";
    if (!check_result.statistic.empty()) quantity.insert(0, check_result.statistic + " ");
    table.add(
        {verdict_text(check_result), check_result.name, quantity,
         check_result.computed ? rounded(*check_result.computed, 8) : "",
         check_result.expected ? rounded(*check_result.expected, 8) : "",
         check_result.difference ? rounded(*check_result.difference, digits_of(check_result)) : "",
         tolerance_text(check_result)});
    const bool said_above = check_result.quantity == "status" && !run.reason.empty();
    if (fails_gate(check_result.verdict) && !check_result.message.empty() && !said_above) {
      messages.push_back(check_result.name + ": " + check_result.message);
    }
  }
  if (!table.empty()) table.print(std::cout, "  ");
  if (table.empty()) print_quantities(run);
  for (const std::string& message : messages) std::cout << wrapped(message, "    ");
}

void print_summary(const std::vector<Run>& runs) {
  std::map<std::string, std::size_t> verdicts;
  std::size_t checks = 0;
  for (const Run& run : runs) {
    checks += run.checks.size();
    for (const CheckResult& check_result : run.checks) ++verdicts[verdict_text(check_result)];
  }
  const auto stored = std::ranges::count_if(runs, [](const Run& run) { return run.was_stored; });
  std::cout << runs.size() << (runs.size() == 1 ? " run" : " runs");
  if (stored > 0) std::cout << " (" << stored << " of them stored by an earlier call)";
  std::cout << ", " << checks << (checks == 1 ? " check: " : " checks: ") << verdicts["pass"]
            << " pass, " << verdicts["does not agree"] << " do not agree (as recorded), "
            << verdicts["fail"] << " fail";
  for (const char* rare : {"error", "not-run", "recorded"})
    if (verdicts[rare] > 0) std::cout << ", " << verdicts[rare] << ' ' << rare;
  std::cout << '\n';
  print_numerical_uncertainty(summarise_numerical_uncertainty(runs), std::cout);
  print_validation_summary(runs, std::cout);
}

/// What a dashboard follows over time, as ctest takes it out of what a test prints.
void print_measurements(const std::vector<Run>& runs) {
  double checks = 0, failures = 0, share = 0, cpu_s = 0;
  for (const Run& run : runs) {
    cpu_s += run.cost.cpu_s;
    for (const CheckResult& check : run.checks) {
      ++checks;
      failures += fails_gate(check.verdict) ? 1 : 0;
      const bool limited =
          check.tolerance && check.difference && check.tolerance->low && check.tolerance->high;
      if (limited) share = std::max(share, 1 + severity(check));
    }
  }
  const auto print = [](const char* name, double value) {
    std::cout << "<CTestMeasurement type=\"numeric/double\" name=\"" << name << "\">"
              << rounded(value, 6) << "</CTestMeasurement>\n";
  };
  print("runs", static_cast<double>(runs.size()));
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

std::filesystem::path write_all(const results::Results& found, const std::filesystem::path& out,
                                const Renderers& renderers) {
  auto file = write_results(found, out);
  if (renderers.junit) renderers.junit(found, out / "junit.xml");
  return file;
}

/// The cases that are named, and those with the labels; the whole catalogue where there are
/// neither.
Selection select(const RunCommand& command) {
  const Catalogue catalogue;
  if (command.cases.empty() && command.labels.empty())
    return load(catalogue.runnable_files(), catalogue);
  std::vector<std::filesystem::path> files;
  for (const std::string& name : command.cases) files.push_back(catalogue.find_case(name));
  Selection selection = load(files, catalogue);
  if (!command.labels.empty()) {
    for (Case& test_case : catalogue.load(command.labels)) {
      const bool there = std::ranges::any_of(
          selection.cases, [&](const Case& other) { return other.id() == test_case.id(); });
      if (!there) selection.cases.push_back(std::move(test_case));
    }
  }
  require_distinct(selection.cases);
  require_variant(selection.cases, command.variant);
  return selection;
}

void print_failed_runs(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (fails_gate(run) && run.fault == results::Fault::none) print_run(run);
  }
}

constexpr const char* kReportInterrupted =
    "trammel: interrupted; the same command does what is missing\n";

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

/// The page of these results, and where it is.
void write_page(results::Results& found, const RunCommand& command, const Renderers& renderers) {
  if (!command.history.empty()) {
    append_history(command.history, found);
    found.history = read_history(command.history);
  }
  const auto unfinished = std::filesystem::path(command.out) / results::kUnfinishedFolder;
  std::filesystem::create_directories(unfinished);
  write_all(found, unfinished, renderers);
  const auto page = renderers.report(found, command.out, command.single_file);
  print_summary(found.runs);
  std::cout << "report in " << page.string() << std::endl;
  print_run_errors(found.runs);
}

/// The page of some cases: without the cost studies and the claims, which rest on the catalogue.
int report_cases(const RunCommand& command, const Renderers& renderers) {
  const Selection selection = select(command);
  const OutputLock lock(command.out);
  end_on_signals(kReportInterrupted);
  const References references;
  std::vector<Run> runs = compute(selection, references, command);
  require_complete(runs);
  print_failed_runs(runs);
  results::Results found = results_of(std::move(runs), selection.cases, references,
                                      store_folder(command.out, command.store));
  write_page(found, command, renderers);
  return exit_status(found.runs);
}

bool is_results_file(const std::string& name) {
  try {
    const Json json = std::filesystem::is_regular_file(name) ? read_json(name) : Json();
    return json.is_object() && json.contains("format") && json.contains("runs");
  } catch (const InputError&) {
    return false;  // told where it is read as a case
  }
}

/// Computes nothing: one file becomes the page as it stands, several stand side by side.
int report_results(const RunCommand& command, const Renderers& renderers) {
  const std::vector<std::filesystem::path> files(command.cases.begin(), command.cases.end());
  if (files.size() > 1)
    for (const auto& file : files)
      if (const auto fault = find_schema_fault(read_json(file), "results"))
        throw InputError(file.string(), fault->pointer, fault->message);
  if (files.size() == 1) require_drawing(renderers);
  const OutputLock lock(command.out);
  std::filesystem::path page;
  if (files.size() == 1) {
    const results::Results found = load_results(files.front());
    if (!found.missing.empty())
      std::cerr << files.front().string() << ": " << found.missing << '\n';
    std::filesystem::remove_all(std::filesystem::path(command.out) / results::kUnfinishedFolder);
    page = renderers.report(found, command.out, command.single_file);
  } else {
    page = renderers.codes(files, command.out);
  }
  std::cout << "report in " << page.string() << std::endl;
  return 0;
}

/// What was asked for, by words that mean the same in another folder.
Json selection_of(const RunCommand& command) {
  Json cases = Json::array();
  for (const std::string& name : command.cases)
    cases.push_back(std::filesystem::exists(name) ? std::filesystem::absolute(name).string()
                                                  : name);
  return {{"cases", cases}, {"labels", command.labels}, {"variant", command.variant}};
}

/// Computes a part of what is selected and judges nothing.
int compute_shard(const RunCommand& command) {
  Shard shard = shard_from(command.shard);
  if (!command.costs.empty()) shard.costs = earlier_costs(command.costs);
  const Selection selection = select(command);
  const OutputLock lock(command.out);
  end_on_signals(kInterrupted);
  const std::filesystem::path done = std::filesystem::path(command.out) / kShardFile;
  std::filesystem::remove(done);
  Progress progress("runs");
  const ShardRuns found = run_shard(selection.cases, options_of(command, progress), shard);
  print_run_errors(found.runs);
  require_complete(found.runs);
  write_shard(command.out, shard, selection_of(command), found);
  std::cout << "shard " << command.shard << ": " << found.runs.size() << " of " << found.in_all
            << " computations in " << command.out << "; 'trammel merge' judges them\n";
  return 0;
}

}  // namespace

std::vector<Case> select_cases(const RunCommand& command) {
  Selection selection = select(command);
  if (!selection.broken.empty()) throw InputError(selection.broken.front().reason);
  return std::move(selection.cases);
}

int run_command(const RunCommand& command, const Renderers& renderers) {
  if (!command.shard.empty()) return compute_shard(command);
  const Selection selection = select(command);
  const OutputLock lock(command.out);
  end_on_signals(kInterrupted);
  const References references;
  const results::Results found =
      results_of(compute(selection, references, command), selection.cases, references,
                 store_folder(command.out, command.store));
  const std::vector<Run>& runs = found.runs;
  for (const Run& run : runs) {
    if (command.json || run.fault != results::Fault::none || run.interrupted_by != 0) continue;
    print_run(run);
    if (runs.size() == 1) print_validation(run, std::cout);
  }
  const auto results = write_all(found, command.out, renderers);
  if (command.json) {
    std::cout << read_text(results);
  } else {
    print_summary(runs);
    std::cout << "results in " << results.string() << std::endl;
  }
  if (command.measurements) print_measurements(runs);
  if (command.vtk)
    for (const Run& run : runs) write_vtk(run, std::filesystem::path(command.out) / "vtk");
  print_run_errors(runs);
  require_complete(runs);
  if (!command.history.empty()) append_history(command.history, found);
  return exit_status(runs);
}

int report_command(const RunCommand& command, const Renderers& renderers) {
  const std::size_t stored = std::ranges::count_if(command.cases, is_results_file);
  if (stored > 0) {
    if (stored < command.cases.size() || !command.labels.empty())
      throw InputError("expected cases, or results files alone; each file has to be there");
    return report_results(command, renderers);
  }
  require_drawing(renderers);
  if (!command.cases.empty() || !command.labels.empty()) return report_cases(command, renderers);
  const OutputLock lock(command.out);
  end_on_signals(kReportInterrupted);
  const Catalogue catalogue;
  const Selection selection = select(command);
  const References references;
  std::vector<Run> runs = compute(selection, references, command);
  require_complete(runs);
  print_failed_runs(runs);
  const std::filesystem::path store = store_folder(command.out, command.store);
  std::vector<std::function<void()>> studies = quick_cost_work(references, store, command.resume);
  for (auto& work : effect_scene_work(store, command.resume)) studies.push_back(std::move(work));
  // What has come to its end is in the store; the rest is done, and said to be impossible, here.
  const bool measured = do_in_processes(studies, command.jobs, "studies of cost and effects");
  std::vector<std::string> error_messages;
  results::CostStudies cost =
      quick_cost(references, store, command.resume || measured, error_messages);
  results::Results results = results_of(std::move(runs), selection.cases, references, store);
  results.cost = std::move(cost);
  const Document claims = load_claims();
  const ClaimSet claim_set = evaluate_claims(claims, results.runs);
  results.claims = claim_results(claim_set);
  results.claims->items = load_paper_items(claims, catalogue);
  judge_paper_items(results, results.claims->items);
  results.coverage = evidence_coverage(selection.cases, references);
  add_reasons(results.coverage);
  count_series(results, results.coverage);
  results.effect_scenes = catalogue_effect_scenes(store, command.resume || measured);
  write_page(results, command, renderers);
  for (const std::string& error_message : error_messages) std::cerr << error_message << '\n';
  for (const Claim& claim : claim_set.claims) {
    if (claim.as_expected()) continue;
    std::cerr << "claim " << claim.id << ": expected the recorded verdict, "
              << to_text(claim.expected) << " (got " << to_text(claim.verdict) << ")\n";
  }
  return std::max(
      {exit_status(results.runs), error_messages.empty() ? 0 : 2, exit_status(claim_set)});
}

}  // namespace trammel::harness

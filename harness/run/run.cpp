#include "harness/run/run.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <set>

#include "harness/analysis/size_estimate.h"
#include "harness/base/find_or_add.h"
#include "harness/base/json_file.h"
#include "harness/base/processes.h"
#include "harness/base/progress.h"
#include "harness/base/stopwatch.h"
#include "harness/base/text.h"
#include "harness/input/catalogue.h"
#include "harness/judge/convergence.h"
#include "harness/judge/evaluate_check.h"
#include "harness/run/results.h"
#include "harness/run/run_store.h"
#include "harness/studies/accuracy_search.h"
#include "harness/studies/validation_uncertainty.h"

namespace trammel::harness {

using results::Fault;
using results::Status;

namespace {

/// A variant to be computed, either requested or needed by a check of another variant.
struct Task {
  const Case* owner = nullptr;
  Document document;
  std::vector<Check> checks;
  bool requested = true;
  bool studies = true;  ///< true: compute refinements and validation uncertainty
  bool errors = false;  ///< true: estimate discretization errors
  std::vector<std::string> input_warnings;
  AccuracyRequest accuracy = {0, {}, 0};  ///< accuracy 0: no search
  Run run;
};

/// Returns true if the run ended without an answer, for example by a crash. Such a run is not
/// stored, because a later call may succeed.
bool run_lacks_answer(const Run& run) {
  return run.status == Status::error || run.status == Status::crashed ||
         run.status == Status::timed_out;
}

void mark_run_as_failed(Run& run, const std::string& reason, Fault fault) {
  run.status = Status::error;
  run.reason = one_line(reason);
  run.fault = fault;
}

/// Executes `work` and records an exception as the failure of the run.
template <class Work>
void catch_errors_of_run(Run& run, const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    mark_run_as_failed(run, error.what(), Fault::input);
  } catch (const std::bad_alloc&) {
    throw;  // the parent process reports lack of memory
  } catch (const std::exception& error) {
    mark_run_as_failed(run, std::string("internal error: ") + error.what(), Fault::internal);
  }
}

Task prepare(const Case& owner, const std::string& variant, bool requested) {
  Task task;
  task.owner = &owner;
  task.requested = requested;
  task.run.case_id = owner.id();
  task.run.variant = variant;
  catch_errors_of_run(task.run, [&] {
    task.document = patched(owner, variant);
    task.input_warnings = unit_warnings(task.document);
    task.checks = read_checks(task.document, variant, owner.variants());
  });
  if (task.run.fault == Fault::input)  // the checks of an invalid variant end with errors
    try {
      task.checks = read_checks(patched(owner, kBaseVariant), variant, owner.variants());
    } catch (const InputError&) {  // the base variant is invalid, too
    }
  return task;
}

std::vector<Task> prepare_case(const Case& owner, const std::string& chosen) {
  std::vector<std::string> variants = owner.chosen_variants;
  if (variants.empty()) variants = owner.variants();
  if (!chosen.empty()) variants = {chosen};
  std::vector<Task> tasks;
  for (const std::string& variant : variants) tasks.push_back(prepare(owner, variant, true));
  std::set<std::string> looked_at;
  for (const Task& task : tasks)
    for (const Check& check : task.checks)
      if (!check.against_variant.empty()) looked_at.insert(check.against_variant);
  for (const std::string& variant : looked_at)
    if (!contains(tasks, variant, [](const Task& task) { return task.run.variant; }))
      tasks.push_back(prepare(owner, variant, false));
  return tasks;
}

std::vector<Task> prepare_all(const std::vector<Case>& cases, const std::string& chosen) {
  std::vector<Task> tasks;
  for (const Case& owner : cases) {
    std::vector<Task> case_tasks = prepare_case(owner, chosen);
    std::ranges::move(case_tasks, std::back_inserter(tasks));
  }
  return tasks;
}

/// Computes the solution of a task, and estimates its discretization errors if requested.
void compute_with_errors(Task& task, const References& references) {
  if (task.requested && task.accuracy.accuracy > 0 && has_mesh_or_time_steps(task.document)) {
    AccuracySearch search = search_accuracy(task.document, task.accuracy, references);
    if (!search.reached) task.run.warnings = {"accuracy not reached: " + search.errors.reason};
    task.run.errors = std::move(search.errors);
    return record_result(std::move(search.result), task.run);
  }
  AnalysisResult result = analyze(task.document, references, {task.requested});
  const bool for_validation = task.studies && task.document.value().contains("uncertainty");
  if (task.requested && (task.errors || for_validation) && result.outcome.solved())
    task.run.errors = estimate_errors(task.document, result, references);
  record_result(std::move(result), task.run);
}

void compute(Task& task, const References& references) {
  const Stopwatch watch;
  catch_errors_of_run(task.run, [&] {
    compute_with_errors(task, references);
    if (task.requested && task.studies)
      task.run.sweeps = run_sweep_levels(task.document, references);
  });
  task.run.cost.wall_s = watch.wall_s();
  task.run.cost.cpu_s = watch.cpu_s();
}

void compare_for_validation(Task& task, const References& references) {
  const bool wanted = task.requested && task.studies && task.run.is_solved() &&
                      task.document.value().contains("uncertainty");
  if (!wanted) return;
  const Stopwatch watch;
  catch_errors_of_run(task.run, [&] {
    task.run.uncertainty = evaluate_validation_uncertainty(
        task.document, task.run.quantities, task.checks, task.run.errors.value(), references);
    if (!task.errors && task.accuracy.accuracy == 0) task.run.errors.reset();
  });
  if (task.run.uncertainty) task.run.cost.uncertainty_wall_s = watch.wall_s();
}

std::string compute_answer(Task task, const RunOptions& options) {
  if (options.solver.compute) {
    catch_errors_of_run(task.run, [&] {
      options.solver.compute(*task.owner, task.run.variant, task.document, task.checks,
                             task.requested, task.run);
    });
  } else {
    const References references;
    compute(task, references);
    compare_for_validation(task, references);
    task.run.references = references.hashes();
  }
  if (options.tracked == TrackedQuantities::named)
    for (Sweep& sweep : task.run.sweeps) drop_other_values(sweep, task.document, task.checks);
  if (!task.run.cost.timings.empty()) task.run.machine = machine_name();
  return serialize(task.run);
}

/// Returns the limit of the processor time of a case [s].
unsigned processor_time_limit_s(const Document& document) {
  constexpr double kDefault = 120, kLongest = 1e7;
  return static_cast<unsigned>(
      std::ceil(std::min(document.value().value("timeout_s", kDefault), kLongest)));
}

void record_ended_process(Task& task, const ProcessOutcome& outcome, const RunOptions& options) {
  using Termination = ProcessOutcome::Termination;
  if (options.solver.compute && outcome.termination != Termination::answered)
    return mark_run_as_failed(task.run, "no answer: " + outcome.text, Fault::none);
  const auto expected = [&](const std::string& pointer, const std::string& what) {
    const std::string found = " (" + task.run.variant + ": " + outcome.text + ")";
    mark_run_as_failed(task.run, task.document.error(pointer, "expected " + what + found).what(),
                       Fault::input);
  };
  switch (outcome.termination) {
    case Termination::answered:
      task.run = parse_run(outcome.text);
      break;
    case Termination::timed_out:
      expected("/timeout_s", "a computation that ends within timeout_s");
      break;
    case Termination::out_of_memory:
      expected(estimate_problem_size(task.document).cause, "a model that fits into memory");
      break;
    case Termination::not_started:
      expected("", "a system that can start another process");
      break;
    case Termination::disk_full:  // only programs of other solvers have this limit
    case Termination::crashed:
      mark_run_as_failed(
          task.run,
          "internal error: " + task.run.case_id + ":" + task.run.variant + ": " + outcome.text,
          Fault::internal);
  }
}

/// Returns a text with the options of a task that, together with the case, determine the stored
/// result.
std::string describe_request(const Task& task) {
  if (task.accuracy.accuracy == 0) return task.errors ? "errors" : "";
  return shortest_decimal(task.accuracy.accuracy) + " " + join(task.accuracy.quantities, " ");
}

/// Computes the tasks that are missing from the store.
/// @returns the signal that ended the computation early, else 0
int compute_all(std::vector<Task>& tasks, const RunOptions& options) {
  std::vector<std::pair<Task*, std::filesystem::path>> open;
  const References references;
  for (Task& task : tasks) {
    std::filesystem::path file;
    if (task.run.status == Status::error) continue;
    if (!options.store.empty())
      file = options.store / run_file_name(task.document, task.requested,
                                           options.solver.hash + describe_request(task));
    if (options.resume && load_stored_run(file, task.run, options.any_machine, references)) {
      task.run.stored = file.filename().string();
      task.run.was_stored = true;
      continue;
    }
    open.emplace_back(&task, std::move(file));
  }
  if (!options.store.empty()) prepare_store(options.store);
  std::vector<ProcessTask> work;
  for (const auto& [task, file] : open)
    work.push_back({[&options, run = task] { return compute_answer(*run, options); },
                    options.solver.compute ? options.solver.time_limit_s
                                           : processor_time_limit_s(task->document)});
  std::size_t done = tasks.size() - work.size();
  const auto show = [&] {
    if (options.progress) options.progress(done, tasks.size());
  };
  return run_in_worker_processes(work, {options.jobs, options.memory_bytes, show},
                                 [&](std::size_t i, const ProcessOutcome& outcome) {
                                   const auto& [task, file] = open[i];
                                   record_ended_process(*task, outcome, options);
                                   if (!file.empty() && !run_lacks_answer(task->run)) {
                                     write_file(file, outcome.text);
                                     task->run.stored = file.filename().string();
                                   }
                                   ++done;
                                   show();
                                 });
}

/// Adds a check of the status of the run, unless the expected and actual status are "solved". If
/// the case expects another status, the name of the check does not depend on the actual status.
/// @returns whether the computation ended as the case expects
bool evaluate_status_check(const Task& task, Run& run) {
  const std::string expected = task.document.value().value("expect_status", "solved");
  const std::string status = to_string(run.status);
  if (expected == "solved" && run.is_solved()) return true;
  CheckResult check_result;
  check_result.name = expected == "solved" ? "unexpected-status" : "status";
  check_result.quantity = "status";
  check_result.unit = "1";
  check_result.role = to_string(Role::verification);
  check_result.measure = "status";
  check_result.why = "the case expects the status " + expected;
  check_result.verdict = status == expected ? Verdict::pass : Verdict::fail;
  check_result.message = status + (run.reason.empty() ? "" : ": " + run.reason);
  run.checks.push_back(std::move(check_result));
  return status == expected;
}

/// Adds a check that the ASME V&V 20 comparisons have the verdicts that the case records.
void evaluate_validation_verdicts(const Check& check, Run& run) {
  if (check.validation_verdicts.empty()) return;
  CheckResult result = create_check_result(check);
  result.name += ".validation";
  result.measure = "validation";
  result.reference.clear();
  result.expectation = Expectation::none;
  result.why = "the case records these verdicts in 'validation_verdicts'";
  std::vector<std::string> found;
  for (const results::Comparison& entry :
       run.uncertainty.value_or(results::Uncertainty()).comparisons)
    if (entry.check == check.name) found.push_back(entry.verdict);
  result.verdict = found == check.validation_verdicts ? Verdict::pass : Verdict::fail;
  if (result.verdict == Verdict::fail)
    result.message =
        "expected " + join(check.validation_verdicts, "and") + " (got " + join(found, "and") + ")";
  run.checks.push_back(std::move(result));
}

void evaluate_checks(Task& task, const std::vector<Task>& tasks, const References& references,
                     const RunOptions& options) {
  Run& run = task.run;
  const auto leave_unjudged = [&](const std::string& message, Verdict verdict) {
    for (const Check& check : task.checks) {
      run.checks.push_back(failed_check_result(check, message));
      run.checks.back().verdict = verdict;
    }
  };
  if (run_lacks_answer(run)) return leave_unjudged("not computed: " + run.reason, Verdict::error);
  if (run.status == Status::not_run) return leave_unjudged("interrupted", Verdict::not_run);
  if (run.status == Status::cannot || run.status == Status::not_exported)
    return leave_unjudged(to_string(run.status) + ": " + run.reason, Verdict::not_given);
  // If the case expects that the computation has no solution, no other check applies.
  if (evaluate_status_check(task, run) && !run.is_solved()) return;
  for (const Sweep& sweep : run.sweeps) {
    auto found = sweep_convergence(sweep, task.document, task.checks, references, options.tracked,
                                   run.solver.element_order);
    std::ranges::move(found, std::back_inserter(run.convergence));
  }
  const auto quantities_of = [&](const std::string& variant) -> const Quantities* {
    for (const Task& other : tasks)
      if (other.owner == task.owner && other.run.variant == variant && other.run.is_solved())
        return &other.run.quantities;
    return nullptr;
  };
  const CheckContext context{task.document,   run.quantities,
                             run.convergence, references,
                             quantities_of,   options.solver.compute ? &run.solver : nullptr};
  for (const Check& check : task.checks) {
    auto judged =
        run.is_solved()
            ? evaluate_check(check, context)
            : std::vector{failed_check_result(check, "no solution: " + to_string(run.status))};
    // A regression check compares with earlier results of trammel. If another solver differs from
    // them, the verdict is `recorded`, which does not fail the run.
    for (CheckResult& result : judged)
      if (options.solver.compute && check.role == Role::regression &&
          result.verdict == Verdict::fail)
        result.verdict = Verdict::recorded;
    std::ranges::move(judged, std::back_inserter(run.checks));
  }
  if (!options.solver.compute && run.is_solved())
    for (const Check& check : task.checks) evaluate_validation_verdicts(check, run);
  // A negative control is a check that is wrong on purpose and must not pass. The summary of
  // numerical uncertainty excludes the convergence studies of runs with such a check.
  if (std::ranges::any_of(task.checks,
                          [](const Check& check) { return check.negative_control.has_value(); }))
    run.convergence.clear();
}

/// Requests estimates of discretization errors according to the options and the case.
void request_error_estimates(Task& task, const RunOptions& options) {
  if (options.solver.compute || !task.requested || task.run.status == Status::error) return;
  const Json& json = task.document.value();
  task.accuracy = {options.accuracy > 0 ? options.accuracy : json.value("accuracy", 0.0),
                   options.quantities, processor_time_limit_s(task.document) * 1.0};
  const bool is_own = !is_in_catalogue(task.owner->file);
  task.errors =
      options.errors == ErrorWish::all || (options.errors == ErrorWish::own_cases && is_own);
}

}  // namespace

std::vector<Run> run_cases(const std::vector<Case>& cases, const References& references,
                           const RunOptions& options) {
  std::vector<Task> tasks = prepare_all(cases, options.variant);
  for (Task& task : tasks) {
    task.studies = options.studies;
    request_error_estimates(task, options);
  }
  const int signal = compute_all(tasks, options);
  for (Task& task : tasks) {
    for (const auto& [place, hash] : task.run.references)
      if (!hash.empty()) (void)references.add(place);
    if (task.run.status == Status::not_run) task.run.interrupted_by = signal;
    std::ranges::move(task.input_warnings, std::back_inserter(task.run.warnings));
    if (task.run.errors)
      std::ranges::move(error_warnings(*task.run.errors, options.warn_above),
                        std::back_inserter(task.run.warnings));
    if (task.requested)
      catch_errors_of_run(task.run, [&] { evaluate_checks(task, tasks, references, options); });
  }
  std::vector<Run> runs;
  for (Task& task : tasks)
    if (task.requested) runs.push_back(std::move(task.run));
  return runs;
}

std::vector<Run> run_with_progress(const std::vector<Case>& cases, const References& references,
                                   RunOptions options, const std::string& items) {
  Progress progress(items);
  options.progress = [&](std::size_t done, std::size_t all) { progress.show(done, all); };
  std::vector<Run> runs = run_cases(cases, references, options);
  require_uninterrupted(runs);
  return runs;
}

ShardRuns run_shard(const std::vector<Case>& cases, const RunOptions& options, const Shard& shard) {
  std::vector<Task> tasks = prepare_all(cases, options.variant);
  for (Task& task : tasks) request_error_estimates(task, options);
  std::vector<std::string> names;
  for (const Task& task : tasks)
    names.push_back(task.run.case_id + ":" + task.run.variant +
                    (task.requested ? "" : " (compared with)"));
  std::vector<Task> own;
  ShardRuns found;
  found.in_all = tasks.size();
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (i % shard.count + 1 != shard.number) continue;
    own.push_back(std::move(tasks[i]));
    found.names.push_back(names[i]);
  }
  const int signal = compute_all(own, options);
  for (Task& task : own) {
    if (task.run.status == Status::not_run) task.run.interrupted_by = signal;
    found.runs.push_back(std::move(task.run));
  }
  return found;
}

Run run_variant(const Case& owner, const std::string& variant) {
  Progress progress("runs");
  const RunOptions options{
      .progress = [&](std::size_t done, std::size_t all) { progress.show(done, all); },
      .memory_bytes = memory_limit_bytes()};
  std::vector<Task> tasks(1, prepare(owner, variant, false));
  if (const int signal = compute_all(tasks, options); signal != 0) throw Interrupted(signal);
  Run& run = tasks.front().run;
  require_solved(run);
  return std::move(run);
}

void require_no_error(const Run& run) {
  if (run.fault == Fault::internal) throw std::runtime_error(run.reason);
  if (run.fault == Fault::input) throw InputError(run.reason);
}

void require_solved(const Run& run) {
  require_no_error(run);
  if (!run.is_solved())
    throw InputError(run.case_id + ":" + run.variant + ": expected a solution (" + run.reason +
                     ")");
}

bool counts_as_failure(const Run& run) {
  return std::ranges::any_of(run.checks, [](const CheckResult& check_result) {
    return counts_as_failure(check_result.verdict);
  });
}

void require_uninterrupted(const std::vector<Run>& runs) {
  for (const Run& run : runs)
    if (run.interrupted_by != 0) throw Interrupted(run.interrupted_by);
}

int exit_status(const std::vector<Run>& runs) {
  int worst = summarize_numerical_uncertainty(runs).passes ? 0 : 1;
  for (const Run& run : runs) {
    if (run.fault == Fault::internal) worst = std::max(worst, 3);
    if (run.fault == Fault::input) worst = std::max(worst, 2);
    if (counts_as_failure(run)) worst = std::max(worst, 1);
  }
  return worst;
}

}  // namespace trammel::harness

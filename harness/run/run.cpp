#include "harness/run/run.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "harness/base/one_line.h"
#include "harness/base/stopwatch.h"
#include "harness/studies/run_sweeps.h"

namespace trammel::harness {
namespace {

/// A computation to do: one asked for, or one that a check of another variant looks at.
struct Task {
  const Case* owner = nullptr;
  Document document;
  std::vector<Check> checks;
  bool requested = true;
  Run run;
};

const char* status_name(solver::Status status) {
  switch (status) {
    case solver::Status::solved:
      return "solved";
    case solver::Status::singular:
      return "singular";
    case solver::Status::not_converged:
      return "not-converged";
  }
  return "error";
}

void mark_failed(Run& run, const std::string& reason, Run::RunError error) {
  run.status = "error";
  run.reason = one_line(reason);
  run.error = error;
}

/// Does what may fail, and leaves the failure in the run.
template <class Work>
void run_guarded(Run& run, const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    mark_failed(run, error.what(), Run::RunError::input);
  } catch (const std::bad_alloc&) {
    mark_failed(run, run.case_id + ": expected a model that fits into memory",
                Run::RunError::input);
  } catch (const std::exception& error) {
    mark_failed(run, std::string("a fault of trammel itself: ") + error.what(),
                Run::RunError::internal);
  }
}

Task prepare(const Case& owner, const std::string& variant, bool requested) {
  Task task;
  task.owner = &owner;
  task.requested = requested;
  task.run.case_id = owner.id();
  task.run.variant = variant;
  task.run.status = "not-run";
  run_guarded(task.run, [&] {
    task.document = patched(owner, variant);
    task.checks = read_checks(task.document, variant, owner.variants());
  });
  return task;
}

std::vector<Task> prepare_case(const Case& owner, const std::string& chosen) {
  const std::vector<std::string> variants = owner.variants();
  std::vector<Task> tasks;
  if (!chosen.empty()) {
    tasks.push_back(prepare(owner, chosen, true));
  } else {
    for (const std::string& variant : variants) tasks.push_back(prepare(owner, variant, true));
  }
  std::set<std::string> looked_at;
  for (const Task& task : tasks) {
    for (const Check& check : task.checks) {
      if (!check.against_variant.empty()) looked_at.insert(check.against_variant);
    }
  }
  for (const std::string& variant : looked_at) {
    const bool there = std::any_of(tasks.begin(), tasks.end(),
                                   [&](const Task& task) { return task.run.variant == variant; });
    if (!there) tasks.push_back(prepare(owner, variant, false));
  }
  return tasks;
}

void compute(Task& task, const References& references) {
  if (task.run.status == "error") return;
  const Stopwatch watch;
  run_guarded(task.run, [&] {
    task.run.result = analyse(task.document, references, {task.requested});
    task.run.status = status_name(task.run.result.outcome.status);
    task.run.reason = task.run.result.outcome.reason;
    if (task.requested) task.run.sweeps = run_sweeps(task.document, references);
  });
  task.run.wall_s = watch.wall_s();
  task.run.cpu_s = watch.cpu_s();
}

void compare_for_validation(Task& task, const References& references) {
  const bool wanted = task.requested && task.run.status == "solved" &&
                      task.document.value().contains("uncertainty");
  if (!wanted) return;
  const Stopwatch watch;
  run_guarded(task.run, [&] {
    task.run.uncertainty =
        evaluate_validation_uncertainty(task.document, task.run.result, task.checks, references);
  });
  task.run.uncertainty_wall_s = watch.wall_s();
}

void compute_all(std::vector<Task>& tasks, const References& references,
                 const RunOptions& options) {
  std::atomic<std::size_t> next{0};
  std::size_t done = 0;
  std::mutex lock;
  const auto work = [&] {
    for (std::size_t i = next++; i < tasks.size(); i = next++) {
      compute(tasks[i], references);
      compare_for_validation(tasks[i], references);
      const std::lock_guard<std::mutex> guard(lock);
      ++done;
      if (options.progress) options.progress(done, tasks.size());
    }
  };
  std::vector<std::thread> threads;
  const std::size_t jobs = std::min<std::size_t>(std::max(1U, options.jobs), tasks.size());
  for (std::size_t j = 1; j < jobs; ++j) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
}

/// How the computation ended, as a check of its own where that is not plain.
/// @returns whether it ended as the case expects.
bool evaluate_status_check(const Task& task, Run& run) {
  const std::string expected = task.document.value().value("expect_status", "solved");
  if (expected == "solved" && run.status == "solved") return true;
  CheckResult check_result;
  check_result.name = "status";
  check_result.quantity = "status";
  check_result.unit = "1";
  check_result.role = to_string(Role::verification);
  check_result.measure = "status";
  check_result.why = "the case expects it to be " + expected;
  check_result.verdict = run.status == expected ? Verdict::pass : Verdict::fail;
  check_result.message = run.status + (run.reason.empty() ? "" : ": " + run.reason);
  run.check_results.push_back(std::move(check_result));
  return run.status == expected;
}

void evaluate_checks(Task& task, const std::vector<Task>& tasks, const References& references,
                     const RunOptions& options) {
  Run& run = task.run;
  if (run.status == "error") {
    for (const Check& check : task.checks) {
      run.check_results.push_back(failed_check_result(check, "not computed: " + run.reason));
    }
    return;
  }
  // Where no solution is what the case expects, there is nothing more to judge.
  if (evaluate_status_check(task, run) && run.status != "solved") return;
  for (const Sweep& sweep : run.sweeps) {
    auto found = study_sweep(sweep, task.document, task.checks, references, options.tracked);
    std::move(found.begin(), found.end(), std::back_inserter(run.convergence));
  }
  const auto quantities_of = [&](const std::string& variant) -> const Quantities* {
    for (const Task& other : tasks) {
      if (other.owner == task.owner && other.run.variant == variant &&
          other.run.status == "solved") {
        return &other.run.result.quantities;
      }
    }
    return nullptr;
  };
  const CheckContext context{task.document, run.result.quantities, run.convergence, references,
                             quantities_of};
  for (const Check& check : task.checks) {
    const bool solved = run.status == "solved";
    auto judged =
        solved ? evaluate_check(check, context)
               : std::vector<CheckResult>{failed_check_result(check, "no solution: " + run.status)};
    std::move(judged.begin(), judged.end(), std::back_inserter(run.check_results));
  }
}

}  // namespace

std::vector<Run> run_cases(const std::vector<Case>& cases, const References& references,
                           const RunOptions& options) {
  std::vector<Task> tasks;
  for (const Case& owner : cases) {
    std::vector<Task> case_tasks = prepare_case(owner, options.variant);
    std::move(case_tasks.begin(), case_tasks.end(), std::back_inserter(tasks));
  }
  compute_all(tasks, references, options);
  for (Task& task : tasks) {
    if (task.requested)
      run_guarded(task.run, [&] { evaluate_checks(task, tasks, references, options); });
  }
  std::vector<Run> runs;
  for (Task& task : tasks) {
    if (task.requested) runs.push_back(std::move(task.run));
  }
  return runs;
}

NumericalUncertaintySummary numerical_uncertainty_of(const std::vector<Run>& runs) {
  std::vector<const Convergence*> studies;
  for (const Run& run : runs) {
    for (const Convergence& found : run.convergence) studies.push_back(&found);
  }
  return summarise_numerical_uncertainty(studies);
}

int exit_status(const std::vector<Run>& runs) {
  int worst = numerical_uncertainty_of(runs).fails() ? 1 : 0;
  for (const Run& run : runs) {
    if (run.error == Run::RunError::internal) worst = std::max(worst, 3);
    if (run.error == Run::RunError::input) worst = std::max(worst, 2);
    const bool broken = std::any_of(
        run.check_results.begin(), run.check_results.end(),
        [](const CheckResult& check_result) { return fails_gate(check_result.verdict); });
    if (broken) worst = std::max(worst, 1);
  }
  return worst;
}

}  // namespace trammel::harness

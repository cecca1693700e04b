#include "harness/run/run.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "harness/base/stopwatch.h"

namespace trammel {
namespace {

/// A computation to do: one asked for, or one that a check of another variant looks at.
struct Task {
  const Case* owner = nullptr;
  Document document;
  std::vector<Check> checks;
  bool asked = true;
  Run run;
};

const char* status_word(Status status) {
  switch (status) {
    case Status::solved:
      return "solved";
    case Status::singular:
      return "singular";
    case Status::not_converged:
      return "not-converged";
  }
  return "error";
}

void spoil(Run& run, const std::string& reason, Run::Trouble trouble) {
  run.status = "error";
  run.reason = reason;
  run.trouble = trouble;
}

/// Does what may fail, and leaves the failure in the run.
template <class Work>
void attempt(Run& run, const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    spoil(run, error.what(), Run::Trouble::input);
  } catch (const std::bad_alloc&) {
    spoil(run, run.case_id + ": expected a model that fits into memory", Run::Trouble::input);
  } catch (const std::exception& error) {
    spoil(run, std::string("a fault of trammel itself: ") + error.what(), Run::Trouble::ours);
  }
}

Task prepare(const Case& owner, const std::string& variant, bool asked) {
  Task task;
  task.owner = &owner;
  task.asked = asked;
  task.run.case_id = owner.id();
  task.run.variant = variant;
  task.run.status = "not-run";
  attempt(task.run, [&] {
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
  attempt(task.run, [&] {
    task.run.result = analyse(task.document, references, {task.asked});
    task.run.status = status_word(task.run.result.outcome.status);
    task.run.reason = task.run.result.outcome.reason;
    if (task.asked) task.run.sweeps = run_sweeps(task.document, references);
  });
  task.run.wall_s = watch.wall_s();
  task.run.cpu_s = watch.cpu_s();
}

void compare_for_validation(Task& task, const References& references) {
  const bool wanted =
      task.asked && task.run.status == "solved" && task.document.value().contains("uncertainty");
  if (!wanted) return;
  const Stopwatch watch;
  attempt(task.run, [&] {
    task.run.uncertainty =
        study_validation(task.document, task.run.result, task.checks, references);
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
bool judge_status(const Task& task, Run& run) {
  const std::string expected = task.document.value().value("expect_status", "solved");
  if (expected == "solved" && run.status == "solved") return true;
  Judgement one;
  one.name = "status";
  one.quantity = "status";
  one.unit = "1";
  one.measure = "status";
  one.expectation = Expectation::agrees;
  one.why = "the case expects it to be " + expected;
  one.verdict = run.status == expected ? Verdict::pass : Verdict::fail;
  one.message = run.status + (run.reason.empty() ? "" : ": " + run.reason);
  run.judgements.push_back(std::move(one));
  return run.status == expected;
}

void judge_task(Task& task, const std::vector<Task>& tasks, const References& references,
                const RunOptions& options) {
  Run& run = task.run;
  if (run.status == "error") {
    for (const Check& check : task.checks) {
      run.judgements.push_back(failed_judgement(check, "not computed: " + run.reason));
    }
    return;
  }
  // Where no solution is what the case expects, there is nothing more to judge.
  if (judge_status(task, run) && run.status != "solved") return;
  for (const Sweep& sweep : run.sweeps) {
    auto found = study_sweep(sweep, task.document, task.checks, references, options.follow);
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
  const Evidence evidence{task.document, run.result.quantities, run.convergence, references,
                          quantities_of};
  for (const Check& check : task.checks) {
    const bool solved = run.status == "solved";
    auto judged =
        solved ? judge(check, evidence)
               : std::vector<Judgement>{failed_judgement(check, "no solution: " + run.status)};
    std::move(judged.begin(), judged.end(), std::back_inserter(run.judgements));
  }
}

}  // namespace

std::vector<Run> run_cases(const std::vector<Case>& cases, const References& references,
                           const RunOptions& options) {
  std::vector<Task> tasks;
  for (const Case& owner : cases) {
    std::vector<Task> its = prepare_case(owner, options.variant);
    std::move(its.begin(), its.end(), std::back_inserter(tasks));
  }
  compute_all(tasks, references, options);
  for (Task& task : tasks) {
    if (task.asked) attempt(task.run, [&] { judge_task(task, tasks, references, options); });
  }
  std::vector<Run> runs;
  for (Task& task : tasks) {
    if (task.asked) runs.push_back(std::move(task.run));
  }
  return runs;
}

BandSummary bands_of(const std::vector<Run>& runs) {
  std::vector<const Convergence*> studies;
  for (const Run& run : runs) {
    for (const Convergence& found : run.convergence) studies.push_back(&found);
  }
  return summarise_bands(studies);
}

int exit_status(const std::vector<Run>& runs) {
  int worst = bands_of(runs).fails() ? 1 : 0;
  for (const Run& run : runs) {
    if (run.trouble == Run::Trouble::ours) worst = std::max(worst, 3);
    if (run.trouble == Run::Trouble::input) worst = std::max(worst, 2);
    const bool broken = std::any_of(run.judgements.begin(), run.judgements.end(),
                                    [](const Judgement& one) { return breaks_gate(one.verdict); });
    if (broken) worst = std::max(worst, 1);
  }
  return worst;
}

}  // namespace trammel

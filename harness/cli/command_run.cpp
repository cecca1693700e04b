#include <algorithm>
#include <iostream>
#include <map>

#include "harness/input/catalogue.h"
#include "harness/cli/commands.h"
#include "harness/base/diagnostic.h"
#include "harness/base/errors.h"
#include "harness/judge/judge.h"
#include "harness/run/claims.h"
#include "harness/cli/print_uncertainty.h"
#include "harness/base/progress.h"
#include "harness/run/results.h"
#include "harness/base/table.h"
#include "harness/base/text.h"
#include "harness/base/statistic.h"

namespace trammel {
namespace {

/// Cases to run, and the runs of those that could not even be read.
struct Selection {
  std::vector<Case> cases;
  std::vector<Run> broken;
};

/// Bad files among several must not take the good ones' results with them.
Selection load(const std::vector<std::filesystem::path>& files) {
  Selection selection;
  for (const auto& file : files) {
    try {
      selection.cases.push_back(load_case(file));
    } catch (const InputError& error) {
      if (files.size() == 1) throw;
      Run run;
      run.case_id = file.stem().string();
      run.variant = base_variant;
      run.status = "error";
      run.reason = error.what();
      run.trouble = Run::Trouble::input;
      selection.broken.push_back(std::move(run));
    }
  }
  return selection;
}

void require_distinct(const std::vector<Case>& cases) {
  std::map<std::string, std::string> seen;
  for (const Case& one : cases) {
    const auto [entry, fresh] = seen.emplace(one.id(), one.file.string());
    if (!fresh) {
      throw InputError("expected cases of different names (got '" + one.id() + "' in " +
                       entry->second + " and in " + one.file.string() + ")");
    }
  }
}

void require_variant(const std::vector<Case>& cases, const std::string& variant) {
  if (variant.empty()) return;
  for (const Case& one : cases) (void)patched(one, variant);
}

std::vector<Run> compute(const Selection& selection, const References& references,
                         const RunOptions& asked) {
  Progress progress;
  RunOptions options = asked;
  options.progress = [&](std::size_t done, std::size_t all) { progress.show(done, all); };
  std::vector<Run> runs = run_cases(selection.cases, references, options);
  runs.insert(runs.end(), selection.broken.begin(), selection.broken.end());
  return runs;
}

/// The entry of a check that deserves to be told: the first one that does not hold, else the one
/// farthest out.
struct Told {
  const Judgement* worst = nullptr;
  std::size_t entries = 0;
};

std::vector<Told> by_check(const Run& run) {
  std::vector<Told> told;
  for (const Judgement& one : run.judgements) {
    auto same = std::find_if(told.begin(), told.end(),
                             [&](const Told& check) { return check.worst->name == one.name; });
    if (same == told.end()) same = told.insert(told.end(), {&one, 0});
    Told& check = *same;
    ++check.entries;
    const auto rank = [](const Judgement& judged) {
      return std::pair(breaks_gate(judged.verdict) ? 1 : 0,
                       std::abs(judged.difference.value_or(0)));
    };
    if (rank(one) > rank(*check.worst)) check.worst = &one;
  }
  return told;
}

/// Digits that tell the ends of a window from each other and from what lies between them.
int digits_of(const Judgement& one) {
  constexpr int least = 3, most = 12;
  if (!one.window || one.symmetric) return least;
  const double low = one.window->low, high = one.window->high;
  const auto judged = one.measure == "bound" ? one.computed : one.difference;
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

std::string allowed(const Judgement& one) {
  if (!one.window) return "";
  if (one.symmetric) return "+-" + rounded(one.window->high, 3);
  const int digits = digits_of(one);
  const std::string low = rounded(one.window->low, digits),
                    high = rounded(one.window->high, digits);
  if (!std::isfinite(one.window->low)) return "at most " + high;
  if (!std::isfinite(one.window->high)) return "at least " + low;
  return "[" + low + ", " + high + "]";
}

std::string verdict_word(const Judgement& one) {
  if (one.verdict == Verdict::pass && one.expectation == Expectation::known_discrepancy) {
    return "known";
  }
  return to_string(one.verdict);
}

/// What was computed, where no check says it: short ones whole, of long ones the range.
void print_quantities(const Run& run) {
  constexpr std::size_t most = 30, whole = 6;
  Table table({"quantity", ">entries", "values"});
  std::size_t told = 0, left = 0;
  for (const auto& [name, quantity] : run.result.quantities) {
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
  std::cout << run.case_id << (run.variant == base_variant ? "" : ":" + run.variant) << "  "
            << run.status << ", " << rounded(run.wall_s, 2) << " s\n";
  if (!run.reason.empty()) std::cout << wrapped(run.reason, "  ");
  Table table(
      {"verdict", "check", "quantity", ">computed", ">expected", ">difference", ">allowed"});
  std::vector<std::string> messages;
  for (const Told& told : by_check(run)) {
    const Judgement& one = *told.worst;
    std::string quantity = one.quantity;
    if (one.index && told.entries > 1) quantity += "[" + std::to_string(*one.index) + "]";
    if (!one.statistic.empty()) quantity.insert(0, one.statistic + " ");
    table.add({verdict_word(one), one.name, quantity, one.computed ? rounded(*one.computed, 8) : "",
               one.expected ? rounded(*one.expected, 8) : "",
               one.difference ? rounded(*one.difference, digits_of(one)) : "", allowed(one)});
    const bool said_above = one.quantity == "status" && !run.reason.empty();
    if (breaks_gate(one.verdict) && !one.message.empty() && !said_above) {
      messages.push_back(one.name + ": " + one.message);
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
    for (const Judgement& one : run.judgements) {
      ++checks;
      ++verdicts[verdict_word(one)];
    }
  }
  std::cout << runs.size() << (runs.size() == 1 ? " run, " : " runs, ") << checks
            << (checks == 1 ? " check" : " checks");
  for (const auto& [word, count] : verdicts) std::cout << ", " << count << " " << word;
  std::cout << '\n';
  print_bands(bands_of(runs), std::cout);
  print_validation_summary(runs, std::cout);
}

void print_trouble(const std::vector<Run>& runs) {
  std::vector<std::string> told;
  for (const Run& run : runs) {
    if (run.trouble == Run::Trouble::none) continue;
    // Variants of one case often have one and the same fault.
    if (std::find(told.begin(), told.end(), run.reason) != told.end()) continue;
    told.push_back(run.reason);
    std::cerr << run.reason << '\n';
  }
}

std::filesystem::path write_all(const Json& json, const std::string& out,
                                const Renderers& renderers) {
  auto results = write_results(json, out);
  if (renderers.junit) renderers.junit(results, std::filesystem::path(out) / "junit.xml");
  return results;
}

/// The cases that are named, and those with the labels.
Selection select(const RunCommand& command) {
  std::vector<std::filesystem::path> files;
  for (const std::string& name : command.cases) files.push_back(find_case(name));
  Selection selection = load(files);
  if (!command.labels.empty()) {
    for (Case& one : load_catalogue(command.labels)) {
      const bool there = std::any_of(selection.cases.begin(), selection.cases.end(),
                                     [&](const Case& other) { return other.id() == one.id(); });
      if (!there) selection.cases.push_back(std::move(one));
    }
  }
  require_distinct(selection.cases);
  require_variant(selection.cases, command.variant);
  return selection;
}

void print_broken(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    const bool broken = std::any_of(run.judgements.begin(), run.judgements.end(),
                                    [](const Judgement& one) { return breaks_gate(one.verdict); });
    if (broken && run.trouble == Run::Trouble::none) print_run(run);
  }
}

/// The page of these results, and where it is.
void write_page(const Json& results, const std::vector<Run>& runs, const std::string& out,
                const Renderers& renderers) {
  const auto file = write_all(results, out, renderers);
  const auto page = renderers.report ? renderers.report(file, out) : file;
  print_summary(runs);
  std::cout << "report in " << page.string() << std::endl;
  print_trouble(runs);
}

/// The page of some cases: without the cost studies and the claims, which rest on the catalogue.
int report_some(const RunCommand& command, const Renderers& renderers) {
  const Selection selection = select(command);
  require_writable(command.out);
  const References references;
  const std::vector<Run> runs =
      compute(selection, references, {command.variant, command.jobs, Follow::named, {}});
  print_broken(runs);
  write_page(results_of(runs, selection.cases, references), runs, command.out, renderers);
  return exit_status(runs);
}

}  // namespace

int run_command(const RunCommand& command, const Renderers& renderers) {
  const Selection selection = select(command);
  require_writable(command.out);
  const References references;
  const std::vector<Run> runs =
      compute(selection, references, {command.variant, command.jobs, Follow::named, {}});
  for (const Run& run : runs) {
    if (run.trouble != Run::Trouble::none) continue;
    print_run(run);
    if (runs.size() == 1) print_validation(run, std::cout);
  }
  const auto results =
      write_all(results_of(runs, selection.cases, references), command.out, renderers);
  print_summary(runs);
  std::cout << "results in " << results.string() << std::endl;
  print_trouble(runs);
  return exit_status(runs);
}

int report_command(const RunCommand& command, const Renderers& renderers) {
  if (!command.cases.empty() || !command.labels.empty()) return report_some(command, renderers);
  require_writable(command.out);
  const Selection selection = load(catalogue_files());
  const References references;
  const std::vector<Run> runs =
      compute(selection, references, {"", command.jobs, Follow::named, {}});
  print_broken(runs);
  std::vector<std::string> troubles;
  const Json cost = quick_cost(references, troubles);
  Json json = results_of(runs, selection.cases, references);
  json["cost"] = cost;
  const Ledger ledger = judge_ledger(load_ledger(), runs);
  json["ledger"] = to_json(ledger);
  write_page(json, runs, command.out, renderers);
  for (const std::string& trouble : troubles) std::cerr << trouble << '\n';
  for (const LedgerClaim& claim : ledger.claims) {
    if (claim.follows()) continue;
    std::cerr << "claim " << claim.id << ": expected the recorded verdict, "
              << in_words(claim.expected) << " (got " << in_words(claim.verdict) << ")\n";
  }
  return std::max({exit_status(runs), troubles.empty() ? 0 : 2, ledger.follows() ? 0 : 1});
}

}  // namespace trammel

#include "harness/cli/command_cost.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <set>

#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/base/processes.h"
#include "harness/base/progress.h"
#include "harness/base/table.h"
#include "harness/base/text.h"
#include "harness/input/catalogue.h"
#include "harness/results/unfinished_folder.h"
#include "harness/run/cost_results.h"
#include "harness/run/output_lock.h"
#include "harness/run/results.h"
#include "harness/run/run_store.h"
#include "harness/run/stored_results.h"
#include "harness/studies/accuracy_search.h"
#include "harness/studies/cost_study_of_sweeps.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;
using MeasurementStatus = MeasuredSetting::MeasurementStatus;

/// Studies of the catalogue that a word means: of that family, or of that name.
std::vector<fs::path> studies_named(const std::string& word, std::vector<std::string>& known) {
  std::vector<fs::path> found;
  for (const fs::path& file : cost_study_files()) {
    const Json json = read_json(file);
    const std::string id = file.stem().string(), family = json.value("family", "");
    if (word == id || word == family) found.push_back(file);
    known.push_back(id);
    known.push_back(family);
  }
  return found;
}

fs::path find_one(const std::string& word, const std::vector<std::string>& known) {
  try {
    return Catalogue().find_case(word);
  } catch (const InputError&) {
    if (word.find('/') != std::string::npos || fs::path(word).extension() == ".json") throw;
    const std::string hint = did_you_mean(word, known);
    if (hint.empty()) throw;
    throw InputError("expected a family or study of cases/cost, a case or a file (got '" +
                     printable(word) + "')" + hint);
  }
}

std::vector<CostStudy> read_studies(const CostCommand& command, SweepExtent extent,
                                    const References& references) {
  std::vector<CostStudy> studies;
  std::set<fs::path> seen;
  bool any_case = false;
  const auto add = [&](const fs::path& file) {
    if (seen.insert(fs::weakly_canonical(file)).second) {
      studies.push_back(load_cost_study(file, extent, references));
    }
  };
  for (const std::string& word : command.what) {
    std::vector<std::string> known;
    const std::vector<fs::path> named = studies_named(word, known);
    std::ranges::for_each(named, add);
    if (!named.empty()) continue;
    const fs::path file = find_one(word, known);
    if (is_cost_study(file)) {
      add(file);
      continue;
    }
    any_case = true;
    const std::string variant = command.variant.empty() ? kBaseVariant : command.variant;
    studies.push_back(cost_study_of_sweeps(load_case(file), variant, command.sweeps, references));
  }
  if (!any_case && (!command.sweeps.empty() || !command.variant.empty())) {
    throw InputError("--sweep and --variant: expected a case beside them");
  }
  if (!command.what.empty()) return studies;
  for (const fs::path& file : cost_study_files()) add(file);
  return studies;
}

std::string mark(const MeasuredSetting& measured, bool on_pareto_front) {
  if (on_pareto_front) return "*";
  return measured.status == MeasurementStatus::measured ? "" : to_string(measured.status);
}

void print_settings(const MeasuredStudy& measured) {
  Table table({"setting", ">error", ">time", ">interval", ">cpu [s]", ">elements", ">factor.",
               ">solves", ">steps", ""});
  std::vector<std::string> reasons;
  for (std::size_t i = 0; i < measured.settings.size(); ++i) {
    const MeasuredSetting& measurement = measured.settings[i];
    const bool on_pareto_front = has_setting(measured.pareto_front, i);
    const std::string& title = measured.study.settings[i].title;
    table.add(
        {title, measurement.error ? rounded(measurement.error->get(measured.study.norm), 3) : "-",
         rounded(measurement.relative.median, 3),
         rounded(measurement.relative.low, 3) + " - " + rounded(measurement.relative.high, 3),
         rounded(measurement.cpu_s, 3), std::to_string(measurement.counters.element_evaluations),
         std::to_string(measurement.counters.factorizations),
         std::to_string(measurement.counters.solves), std::to_string(measurement.counters.steps),
         mark(measurement, on_pareto_front)});
    if (!measurement.reason.empty()) reasons.push_back(title + ": " + measurement.reason);
  }
  table.print(std::cout, "  ");
  for (const std::string& reason : reasons) std::cout << wrapped(reason, "    ");
}

void add_cheapest(const MeasuredStudy& measured, const std::vector<CostPoint>& points,
                  const std::string& output, Table& table) {
  const auto title = [&](std::size_t i) { return measured.study.settings[i].title; };
  for (const double error : target_errors()) {
    const auto found = cheapest(points, error);
    const std::string target = error < 1e-3 ? rounded(error) : rounded(100 * error) + " %";
    table.add({target, output, found ? title(found->setting) : "none of these",
               found ? rounded(found->error, 2) : "", found ? rounded(found->time, 3) : ""});
    for (const std::size_t tied : tied_settings(points, error))
      table.add({"", "", "or " + title(tied), "", ""});
  }
}

void print_cheapest(const MeasuredStudy& measured) {
  const std::vector<StudyOutput>& outputs = measured.study.outputs;
  const bool several = outputs.size() > 1;
  Table table({">within", several ? "of" : "", "cheapest setting", ">error", ">time"});
  for (std::size_t k = 0; k < outputs.size(); ++k)
    add_cheapest(measured, output_points(measured, k), outputs[k].title, table);
  if (several) add_cheapest(measured, output_points(measured, std::nullopt), "all at once", table);
  table.print(std::cout, "  ");
}

void print(const MeasuredStudy& measured) {
  const CostStudy& study = measured.study;
  std::cout << study.family << ": " << study.title << '\n'
            << wrapped(fmt::format("Error ({}) against {}, {}; time relative to '{}'; * on the "
                                   "efficient front.",
                                   to_string(study.norm), study.reference_description,
                                   study.outputs.front().scale_description,
                                   study.settings[study.baseline].title),
                       "  ");
  print_settings(measured);
  print_cheapest(measured);
  std::cout << wrapped(measured.conclusion, "  ");
  const ParetoFrontAgreement& both = measured.repeatability;
  std::cout << wrapped(fmt::format("Odd and even repeats by themselves: {} of {} settings on both "
                                   "fronts, {} of {} cheapest settings the same, times {} % apart "
                                   "(median), {} % at most.",
                                   both.shared, both.either, both.same_cheapest, both.targets,
                                   rounded(100 * both.median_difference, 2),
                                   rounded(100 * both.largest_difference, 2)),
                       "  ")
            << '\n';
}

void print_search(const AccuracySearch& search) {
  Table table({"tried", ">error", ""});
  for (const TriedSetting& tried : search.tried)
    table.add({tried.title, tried.reason.empty() ? rounded(tried.error, 2) : "-", tried.reason});
  table.print(std::cout, "  ");
  std::cout << wrapped(
      fmt::format("Errors against {}, which the last refinement changed by {}.",
                  search.study.reference_description, error_text(search.reference_change)),
      "  ");
  if (search.out_of_time)
    std::cout << "  Not everything was tried: --time-limit gives the search more time.\n";
}

/// The cheapest setting within the accuracy, and the patch that makes a case compute so.
void print_choice(const AccuracySearch& search, const MeasuredStudy& measured, double accuracy) {
  const auto best = cheapest(measured.points, accuracy);
  if (!best) {
    std::cout << "No setting that was tried comes within " << error_text(accuracy) << ".\n";
    return;
  }
  const auto title = [&](std::size_t i) { return "'" + measured.study.settings[i].title + "'"; };
  std::vector<std::string> tied;
  for (const std::size_t i : tied_settings(measured.points, accuracy)) tied.push_back(title(i));
  std::string words = "Within " + error_text(accuracy) + ": " + title(best->setting);
  if (!tied.empty()) words += "; in times that cannot be told from its, also " + join(tied, "and");
  std::cout << wrapped(words + ". As a variant of the case:", "")
            << search.patches[best->setting].dump(2) << '\n';
}

/// What was tried, and the patch of the cheapest setting within the accuracy; null where none is.
Json choice_json(const AccuracySearch& search, const MeasuredStudy& measured, double accuracy) {
  Json json = {{"accuracy", accuracy},
               {"reference_change", number_or_null(search.reference_change)},
               {"out_of_time", search.out_of_time},
               {"tried", Json::array()},
               {"setting", nullptr},
               {"patch", nullptr},
               {"tied", Json::array()}};
  for (const TriedSetting& tried : search.tried)
    json["tried"].push_back({{"setting", tried.title},
                             {"error", number_or_null(tried.error)},
                             {"reason", tried.reason}});
  const auto title = [&](std::size_t i) { return measured.study.settings[i].title; };
  if (const auto best = cheapest(measured.points, accuracy)) {
    json["setting"] = title(best->setting);
    json["patch"] = search.patches[best->setting];
    for (const std::size_t i : tied_settings(measured.points, accuracy))
      json["tied"].push_back(title(i));
  }
  return json;
}

MeasuredStudy choose_setting(const CostCommand& command, const CostOptions& options,
                             const References& references) {
  if (command.what.size() != 1 || !command.sweeps.empty())
    throw InputError("--accuracy: expected one case beside it, and no --sweep");
  const Case given = load_case(find_one(command.what.front(), {}));
  const fs::path store = store_folder(command.out, command.store);
  AccuracySearch search;
  {
    Progress progress("settings tried");
    const auto show = [&](std::size_t tried) { progress.show(tried, 0); };
    const auto compute = [&](const Setting& setting, int time_limit_s) {
      return run_or_find(setting, time_limit_s, references, store, command.resume);
    };
    search = search_accuracy(given, command.variant.empty() ? kBaseVariant : command.variant,
                             {command.accuracy, command.quantities, command.time_limit_s}, compute,
                             show);
  }
  if (!command.json) print_search(search);
  MeasuredStudy measured =
      measure_or_find(search.study, options, references, store, command.resume);
  if (command.json) {
    std::cout << pretty(choice_json(search, measured, command.accuracy));
  } else {
    print(measured);
    print_choice(search, measured, command.accuracy);
  }
  return measured;
}

TimingOptions timing_of(const CostCommand& command) {
  TimingOptions timing;
  timing.repeats = command.repeats;
  timing.seed = command.seed;
  return timing;
}

}  // namespace

fs::path store_folder(const std::string& out, const std::string& store) {
  if (!store.empty()) return store;
  fs::path folder = fs::path(out) / "store";
  if (fs::is_symlink(folder))
    throw InputError("--out " + out + ": expected no link named 'store' (--store follows one)");
  return folder;
}

int cost_command(const CostCommand& command, const Renderers& renderers) {
  require_drawing(renderers);
  const OutputLock lock(command.out);
  end_on_signals(kInterrupted);
  const References references;
  const SweepExtent extent = command.quick ? SweepExtent::quick : SweepExtent::full;
  CostOptions options{timing_of(command), {}};
  std::vector<MeasuredStudy> measured;
  std::vector<CostStudy> studies;
  if (command.accuracy > 0) {
    measured.push_back(choose_setting(command, options, references));
  } else {
    studies = read_studies(command, extent, references);
  }
  for (CostStudy& study : studies) {
    {
      Progress progress("measurements");
      options.progress = [&](std::size_t done, std::size_t all) { progress.show(done, all); };
      measured.push_back(measure_or_find(std::move(study), options, references,
                                         store_folder(command.out, command.store), command.resume));
    }
    if (!command.json) print(measured.back());
  }
  results::Results results = results_of({}, {}, references);
  results.cost = cost_results(measured, extent, options.timing);
  const fs::path unfinished = fs::path(command.out) / results::kUnfinishedFolder;
  fs::create_directories(unfinished);
  write_results(results, unfinished);
  const fs::path page = renderers.report(results, command.out, false);
  const fs::path file = fs::path(command.out) / "results.json";
  if (!command.json) {
    std::cout << "results in " << file.string() << "\npage in " << page.string() << std::endl;
  } else if (command.accuracy == 0) {
    std::cout << read_text(file);
  }
  const bool any_lost = std::ranges::any_of(
      measured, [](const MeasuredStudy& study) { return study.points.empty(); });
  return any_lost ? 1 : 0;
}

std::vector<std::function<void()>> quick_cost_work(const References& references,
                                                   const fs::path& store, bool resume) {
  std::vector<std::function<void()>> work;
  for (const fs::path& file : cost_study_files())
    work.emplace_back([file, &references, store, resume] {
      (void)measure_or_find(load_cost_study(file, SweepExtent::quick, references), {}, references,
                            store, resume);
    });
  return work;
}

results::CostStudies quick_cost(const References& references, const fs::path& store, bool resume,
                                std::vector<std::string>& error_messages) {
  std::vector<MeasuredStudy> measured;
  const CostOptions options;
  for (const fs::path& file : cost_study_files()) {
    try {
      measured.push_back(measure_or_find(load_cost_study(file, SweepExtent::quick, references),
                                         options, references, store, resume));
    } catch (const InputError& error) {
      error_messages.emplace_back(error.what());
    }
  }
  return cost_results(measured, SweepExtent::quick, options.timing);
}

}  // namespace trammel::harness

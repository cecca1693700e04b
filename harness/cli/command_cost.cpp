#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <set>

#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/base/progress.h"
#include "harness/base/rows.h"
#include "harness/base/text.h"
#include "harness/cli/commands.h"
#include "harness/input/catalogue.h"
#include "harness/printing/printing.h"
#include "harness/results/result_fields.h"
#include "harness/run/results.h"
#include "harness/run/run_store.h"
#include "harness/run/stored_results.h"
#include "harness/studies/accuracy_search.h"
#include "harness/studies/cost_study.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;

/// Files of the cost studies of the catalogue, by name and by family.
std::multimap<std::string, fs::path> catalogue_studies() {
  std::multimap<std::string, fs::path> studies;
  for (const fs::path& file : cost_study_files()) {
    studies.emplace(file.stem().string(), file);
    studies.emplace(read_json(file).value("family", ""), file);
  }
  return studies;
}

fs::path find_file(const std::string& word, const std::multimap<std::string, fs::path>& studies) {
  try {
    return Catalogue().find_case(word);
  } catch (const InputError&) {
    if (word.find('/') != std::string::npos || fs::path(word).extension() == ".json") throw;
    std::vector<std::string> known;
    for (const auto& item : studies) known.push_back(item.first);
    if (nearest_word(word, known).empty()) throw;
    throw InputError(unknown_name_message(
        "the name or 'family' of a study in cases/cost, a case or a file", word, known));
  }
}

std::vector<CostStudy> read_cost_studies(const CommandOptions& options, SweepExtent extent,
                                         const References& references) {
  std::vector<CostStudy> studies;
  std::set<fs::path> seen;
  bool any_case = false;
  const auto add = [&](const fs::path& file) {
    if (seen.insert(fs::weakly_canonical(file)).second)
      studies.push_back(load_cost_study(file, extent, references));
  };
  const auto named = catalogue_studies();
  for (const std::string& word : options.words) {
    const auto [begin, end] = named.equal_range(word);
    std::for_each(begin, end, [&](const auto& item) { add(item.second); });
    if (begin != end) continue;
    const fs::path file = find_file(split_case_name(word).first, named);
    if (is_cost_study(file)) {
      add(file);
      continue;
    }
    any_case = true;
    const auto [given, variant] = load_case_variant(word, options.variant);
    studies.push_back(cost_study_of_sweeps(given, variant.empty() ? kBaseVariant : variant,
                                           options.sweeps, references));
  }
  if (!any_case && (!options.sweeps.empty() || !options.variant.empty()))
    throw InputError("--sweep and --variant apply to cases only; expected the name of a case");
  if (!options.words.empty()) return studies;
  for (const fs::path& file : cost_study_files()) add(file);
  return studies;
}

void print_cost_settings(const results::CostStudy& study) {
  std::vector<Column> columns = {"setting",   {"error", "", 3},        {"time", "", 3},
                                 ">interval", {"cpu_s", "cpu [s]", 3}, ""};
  for (const auto& counter : study.settings.front().counters)
    columns.emplace_back(counter.first.c_str());
  Rows table(columns);
  std::string reasons;
  for (const results::CostSetting& setting : study.settings) {
    const std::string status = setting.is_measured() ? "" : setting.status;
    std::vector<Json> row = {setting.title,
                             number_or_null(study.error_of(setting)),
                             number_or_null(setting.relative),
                             setting.time
                                 ? fmt::format("{:.3g} - {:.3g}", setting.time->relative_low,
                                               setting.time->relative_high)
                                 : "",
                             setting.cpu_s,
                             setting.pareto_optimal ? "*" : status};
    for (const auto& counter : setting.counters) row.emplace_back(counter.second);
    table.add(std::move(row));
    if (!setting.reason.empty()) reasons += wrapped(setting.title + ": " + setting.reason, "    ");
  }
  table.print(std::cout, "  ");
  std::cout << reasons;
}

void add_cheapest(const results::CostStudy& study, const results::CostOutput& output, Rows& table) {
  for (const results::CheapestSetting& best : output.cheapest) {
    const std::string target = error_text(best.error);
    if (best.setting) {
      const results::CostSetting& setting = study.settings[*best.setting];
      table.add({target, output.title, setting.title, number_or_null(output.errors[*best.setting]),
                 number_or_null(setting.relative)});
    } else {
      table.add({target, output.title, "no setting"});
    }
    for (const std::size_t k : best.tied) table.add({"", "", "or " + study.settings[k].title});
  }
}

void print(const results::CostStudy& study) {
  std::cout << study.family << ": " << study.title << '\n'
            << wrapped(fmt::format("Error ({}) against {}, {}; time relative to '{}'; * on the "
                                   "efficient front.",
                                   study.norm, study.reference_solution, study.scale,
                                   study.settings[study.baseline].title),
                       "  ");
  print_cost_settings(study);
  results::CostOutput only{"", "", {}, study.cheapest};
  for (const results::CostSetting& setting : study.settings)
    only.errors.push_back(study.error_of(setting));
  Rows table({">within",
              study.outputs.empty() ? "" : "of",
              "cheapest setting",
              {"error", "", 2},
              {"time", "", 3}});
  if (study.outputs.empty()) add_cheapest(study, only, table);
  for (const results::CostOutput& output : study.outputs) add_cheapest(study, output, table);
  table.print(std::cout, "  ");
  std::cout << wrapped(study.conclusion, "  ") << '\n';
}

results::CostStudy search_setting(const CommandOptions& options, const CostOptions& cost_options,
                                  const References& references) {
  if (options.words.size() != 1 || !options.sweeps.empty())
    throw InputError("--accuracy: expected a single case, and no --sweep");
  const Case given = load_named_case(options.words.front());
  const std::string variant = options.variant.empty() ? kBaseVariant : options.variant;
  const AccuracyRequest request{options.accuracy, options.quantities, options.time_limit_s};
  const AccuracySearch search = search_accuracy(patched(given, variant), request, references);
  results::CostStudy measured =
      cached_cost_study(cost_study_of_search(given, variant, search, request), cost_options,
                        references, store_folder(options.out, options.store), options.resume);
  if (options.json) {
    std::cout << format_json(results::to_json(search.errors));
  } else {
    print(measured);
    print_tried_settings(search.errors);
    if (!search.reached)
      std::cout << wrapped("The accuracy is not reached: " + search.errors.reason + ".", "  ");
  }
  return measured;
}

}  // namespace

fs::path store_folder(const std::string& out, const std::string& store) {
  if (!store.empty()) return store;
  fs::path folder = fs::path(out) / "store";
  if (fs::is_symlink(folder))
    throw InputError("--out " + out + ": 'store' is a symbolic link, which only --store accepts");
  return folder;
}

int cost_command(const CommandOptions& options, const Renderers& renderers) {
  constexpr int kLeastRepeats = 7;  // because odd and even repeats are compared
  if (options.repeats < kLeastRepeats)
    throw InputError("trammel: --repeats requires at least 7 measurements (got " +
                     std::to_string(options.repeats) + ")");
  require_gnuplot(renderers);
  const OutputLock lock(options.out);
  exit_on_signals(kInterrupted);
  const References references;
  const SweepExtent extent = options.quick ? SweepExtent::quick : SweepExtent::full;
  CostOptions cost_options;
  cost_options.timing.repeats = options.repeats;
  cost_options.timing.seed = options.seed;
  std::vector<results::CostStudy> measured;
  std::vector<CostStudy> studies;
  if (options.accuracy > 0) {
    measured.push_back(search_setting(options, cost_options, references));
  } else {
    studies = read_cost_studies(options, extent, references);
  }
  for (const CostStudy& study : studies) {
    {
      Progress progress("measurements");
      cost_options.progress = [&](std::size_t done, std::size_t all) { progress.show(done, all); };
      measured.push_back(cached_cost_study(study, cost_options, references,
                                           store_folder(options.out, options.store),
                                           options.resume));
    }
    if (!options.json) print(measured.back());
  }
  results::Results results = collect_results({}, {}, references);
  const bool any_lost = std::ranges::any_of(
      measured, [](const results::CostStudy& study) { return cost_points(study).empty(); });
  results.cost = cost_results(std::move(measured), extent, cost_options.timing);
  const fs::path page = write_pages(results, options.out, renderers);
  const fs::path file = fs::path(options.out) / "results.json";
  if (!options.json) {
    std::cout << "results in " << file.string() << "\npage in " << page.string() << std::endl;
  } else if (options.accuracy == 0) {
    std::cout << read_text(file);
  }
  return any_lost ? 1 : 0;
}

std::vector<std::function<void()>> quick_cost_work(const References& references,
                                                   const fs::path& store, bool resume) {
  std::vector<std::function<void()>> work;
  for (const fs::path& file : cost_study_files())
    work.emplace_back([file, &references, store, resume] {
      (void)cached_cost_study(load_cost_study(file, SweepExtent::quick, references), {}, references,
                              store, resume);
    });
  return work;
}

results::CostStudies quick_cost_studies(const References& references, const fs::path& store,
                                        bool resume, std::vector<std::string>& error_messages) {
  std::vector<results::CostStudy> measured;
  const CostOptions options;
  for (const fs::path& file : cost_study_files()) {
    try {
      measured.push_back(cached_cost_study(load_cost_study(file, SweepExtent::quick, references),
                                           options, references, store, resume));
    } catch (const InputError& error) {
      error_messages.emplace_back(error.what());
    }
  }
  return cost_results(std::move(measured), SweepExtent::quick, options.timing);
}

}  // namespace trammel::harness

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <optional>

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
#include "harness/studies/effect_study.h"

namespace trammel::harness {
namespace {

double ratio(double part, double full) {
  return full > 0 ? part / full : 0;
}

/// Columns of a table with one row per model from which some effects are removed. The row contains
/// the changes of the results relative to the full model, the computing time and the counted work.
const std::vector<Column> kRunColumns = {"left_out",
                                         {"status", ""},
                                         {"change", "change [%]", 3, 100},
                                         {"changes", "of"},
                                         {"time_ratio", "time", 3},
                                         {"work_ratio", "work", 3},
                                         {"element_evaluations", "elements"},
                                         "factorizations",
                                         "solves"};

void add_run(Rows& rows, const EffectRun& run, const EffectRun& full) {
  std::vector<std::string> changes;
  for (const auto& [kind, change] : run.changes)
    changes.push_back(kind + " " + rounded(100 * change.value, 3));
  rows.add({effect_names(run.left_out), run.outcome.solved() ? "solved" : run.outcome.reason,
            number_or_null(run.largest_change()), join(changes, "and"),
            ratio(run.cpu_s, full.cpu_s), ratio(run.work, full.work),
            run.counters.element_evaluations, run.counters.factorizations, run.counters.solves});
}

Rows rows_of_effect_contributions(const EffectStudy& study) {
  Rows rows(kRunColumns);
  add_run(rows, study.full, study.full);
  for (const EffectRun& run : study.without_one) add_run(rows, run, study.full);
  EffectRun chosen = study.chosen;
  chosen.left_out = study.full.effects.without(chosen.effects);
  if (!chosen.left_out.empty()) add_run(rows, chosen, study.full);
  return rows;
}

/// Columns of a table of the effects selected in each case. The keys of the columns are members of
/// `results::EffectScene`.
const std::vector<Column> kSceneColumns = {"scene",
                                           "analysis",
                                           "chosen",
                                           {"change", "change [%]", 3, 100},
                                           {"tolerance", "tolerance [%]", 3, 100},
                                           {"whole_s", "all effects [s]", 3},
                                           {"chosen_s", "chosen [s]", 3},
                                           {"deciding_s", "deciding [s]", 3}};

results::EffectScene make_scene(const std::string& id, const std::string& analysis,
                                const EffectStudy& study) {
  return {.scene = id,
          .analysis = analysis,
          .chosen = effect_names(study.choice.chosen),
          .tolerance = study.tolerance,
          .change = study.chosen.largest_change(),
          .minimal = study.is_minimal(),
          .whole_s = study.full.cpu_s,
          .chosen_s = study.chosen.cpu_s,
          .deciding_s = study.deciding_cpu_s,
          .work_ratio = study.work_ratio(),
          .deciding_work_ratio = ratio(study.choice.automatic->work, study.full.work),
          .mesh_change = study.mesh_change,
          .beyond_tier = study.choice.automatic->beyond_tier};
}

Json study_to_json(const std::string& id, const std::string& analysis, const EffectStudy& study) {
  Json json = results::to_json(make_scene(id, analysis, study));
  json["effects"] = results::to_json(study.choice.rows);
  json["runs"] = rows_of_effect_contributions(study).json();
  return json;
}

/// @returns true if the omitted effects change the results by at most the tolerance. The change
///   includes the effect of large displacement if the analysis cannot represent this effect.
bool holds(const EffectStudy& study) {
  return study.within_tolerance() && !study.choice.is_beyond_linear_theory();
}

void print_effect_study(const EffectStudy& study) {
  std::cout << "\nChanges measured against the model with all effects\n";
  rows_of_effect_contributions(study).print(std::cout, "  ");
  std::cout << "  time, work: relative to the full model; work: counted factorizations, solves and "
               "element matrices, weighted by unknowns\n\nChosen    "
            << effect_names(study.choice.chosen) << "\nEffects   "
            << percent(study.chosen.largest_change())
            << " from the full model, measured; tolerance " << percent(study.tolerance) << '\n';
  if (study.mesh_change) {
    std::cout << "Mesh      " << percent(*study.mesh_change)
              << " change of the results from half the elements to all of them\n";
    if (*study.mesh_change > study.tolerance)
      std::cout << "Warning: the mesh changes the results by more than the tolerance of effects; "
                   "use more elements\n";
  }
  if (study.choice.automatic->beyond_tier)
    std::cout << "Beyond    " << percent(*study.choice.automatic->beyond_tier)
              << " by large displacement, which this analysis cannot represent\n";
  std::cout << "Minimal   " << (study.is_minimal() ? "yes" : "no")
            << ", for effects that cost computing time\nWork      "
            << rounded(study.work_ratio(), 3) << " of the full model's, "
            << rounded(study.choice.automatic->work / study.full.work, 2)
            << " of it to select the effects\n";
}

/// Writes results.json and a page with the effects selected in the cases `scenes`.
void write_effect_scenes(std::vector<results::EffectScene> scenes, const CommandOptions& options,
                         const Renderers& renderers) {
  results::Results results = collect_results({}, {}, References());
  results.effect_scenes = std::move(scenes);
  const OutputLock lock(options.out);
  const auto page = write_pages(results, options.out, renderers);
  if (!options.json) std::cout << "page in " << page.string() << '\n';
}

struct EffectCase {
  std::string id;
  Document document;
};

/// Returns the cases that have all of the `labels` and an analysis that supports a selection of
/// effects.
std::vector<EffectCase> effect_cases(const std::vector<std::string>& labels,
                                     const std::string& variant) {
  std::vector<EffectCase> cases;
  for (const Case& given : Catalogue().load(labels)) {
    Document document = patched(given, variant);
    if (supports_effects(document)) cases.push_back({given.id(), std::move(document)});
  }
  return cases;
}

std::vector<EffectCase> selected_cases(const CommandOptions& options) {
  if (options.words.empty() == options.labels.empty())
    throw InputError("trammel: either cases or --label is required (see trammel effects --help)");
  std::vector<EffectCase> cases;
  for (const std::string& name : options.words) {
    const auto [given, chosen] = load_case_variant(name, options.variant);
    const std::string variant = chosen.empty() ? kBaseVariant : chosen;
    cases.push_back(
        {given.id() + (variant == kBaseVariant ? "" : ":" + variant), patched(given, variant)});
  }
  if (options.words.empty())
    cases = effect_cases(options.labels, options.variant.empty() ? kBaseVariant : options.variant);
  if (cases.empty()) throw InputError("no case with these labels has effects to select");
  return cases;
}

int print_effect_selection(const EffectCase& scene, const CommandOptions& options) {
  const EffectStudy study = study_effects(scene.document, {options.tolerance, options.repeats});
  if (!options.json) {
    std::cout << scene.id << ": " << scene.document.value().at("title").get<std::string>() << '\n';
    print_effects(study.choice);
  }
  if (!study.full.outcome.solved())
    throw InputError(scene.id + ": the model with all effects has no solution (" +
                     study.full.outcome.reason + ")");
  if (options.json) {
    std::cout << format_json(study_to_json(scene.id, analysis_kind(scene.document), study), 2);
  } else {
    print_effect_study(study);
  }
  return holds(study) ? 0 : 1;
}

/// Returns the effects selected in a case, measured or read from the store; empty if the model with
/// all effects has no solution.
EffectScenes case_scenes(const EffectCase& given, const std::filesystem::path& store, bool resume) {
  const auto measure = [&] {
    const EffectStudy study =
        study_effects(given.document, {.repeats = 3, .measures_contributions = false});
    if (!study.full.outcome.solved()) return EffectScenes{};
    return EffectScenes{make_scene(given.id, analysis_kind(given.document), study)};
  };
  return cached_effect_study(given.document, measure, store, resume);
}

}  // namespace

int effects_command(const CommandOptions& options, const Renderers& renderers) {
  const std::vector<EffectCase> cases = selected_cases(options);
  if (cases.size() == 1 && options.labels.empty() && options.out.empty())
    return print_effect_selection(cases.front(), options);
  if (!options.out.empty()) require_gnuplot(renderers);
  std::vector<results::EffectScene> scenes;
  Json json = Json::array();
  bool all_hold = true;
  std::optional<Progress> progress("scenes");
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto study = study_effects(cases[i].document, {options.tolerance, options.repeats});
    progress->show(i + 1, cases.size());
    if (!study.full.outcome.solved()) continue;
    const std::string analysis = analysis_kind(cases[i].document);
    json.push_back(study_to_json(cases[i].id, analysis, study));
    scenes.push_back(make_scene(cases[i].id, analysis, study));
    all_hold = all_hold && holds(study);
  }
  progress.reset();
  if (!options.out.empty()) write_effect_scenes(std::move(scenes), options, renderers);
  if (options.json) {
    std::cout << format_json(json, 3);
  } else {
    Rows(kSceneColumns, json).print(std::cout);
    std::cout << "work: of the selection and the chosen effects, relative to that of all effects; "
                 "mesh: change of the results from half the elements to all\n";
  }
  return all_hold ? 0 : 1;
}

std::vector<std::function<void()>> effect_scene_work(const std::filesystem::path& store,
                                                     bool resume) {
  std::vector<std::function<void()>> work;
  for (const EffectCase& scene : effect_cases({"effects"}, kBaseVariant))
    work.emplace_back([scene, store, resume] { (void)case_scenes(scene, store, resume); });
  return work;
}

std::vector<results::EffectScene> catalogue_effect_scenes(const std::filesystem::path& store,
                                                          bool resume) {
  std::vector<results::EffectScene> scenes;
  for (const EffectCase& scene : effect_cases({"effects"}, kBaseVariant))
    std::ranges::move(case_scenes(scene, store, resume), std::back_inserter(scenes));
  return scenes;
}

}  // namespace trammel::harness

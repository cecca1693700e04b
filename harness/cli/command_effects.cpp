#include "harness/cli/command_effects.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <utility>

#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/base/progress.h"
#include "harness/base/rows.h"
#include "harness/base/text.h"
#include "harness/input/catalogue.h"
#include "harness/printing/print_effects.h"
#include "harness/results/unfinished_folder.h"
#include "harness/run/output_lock.h"
#include "harness/run/results.h"
#include "harness/run/run_store.h"
#include "harness/run/stored_results.h"
#include "harness/studies/effect_study.h"

namespace trammel::harness {
namespace {

std::string in_percent(double share) {
  return std::isfinite(share) ? rounded(100 * share, 3) : "all";
}

std::string kinds_of(const Changes& changes) {
  std::string text;
  for (const auto& [kind, change] : changes)
    text += (text.empty() ? "" : ", ") + kind + " " + in_percent(change.value);
  return text;
}

std::string ratio(double part, double whole) {
  return whole > 0 ? rounded(part / whole, 3) : "";
}

void add_row(Rows& table, const std::string& what, const EffectRun& run, const EffectRun& full) {
  if (!run.outcome.solved()) {
    table.add({what, "all", run.outcome.reason, "", "", "", ""});
    return;
  }
  const bool noisy = run.cpu_spread > 0.1;
  table.add({what, in_percent(max_change(run.changes).value), kinds_of(run.changes),
             ratio(run.cpu_s, full.cpu_s) + (noisy ? " ~" : ""),
             std::to_string(run.counters.element_evaluations),
             std::to_string(run.counters.factorizations), std::to_string(run.counters.solves)});
}

void print_singles(const EffectStudy& study) {
  Rows table({"left out", ">change [%]", "of", ">time", ">elements", ">factorizations", ">solves"});
  add_row(table, "nothing", study.full, study.full);
  for (const Ablation& ablation : study.singles) {
    const solver::Effects with_dependents = study.full.effects.without(ablation.run.effects);
    add_row(table, effect_names(with_dependents.list()), ablation.run, study.full);
  }
  add_row(table, "all but the chosen", study.chosen, study.full);
  table.print(std::cout, "  ");
  std::cout << "  time: relative to the full model, median of interleaved runs; ~ quartile spread "
               "above 10 %\n";
}

/// Pairs whose joint change is not the larger, nor the sum, of the two.
void print_pairs(const EffectStudy& study) {
  const auto single = [&](solver::Effect effect) {
    for (const Ablation& ablation : study.singles) {
      if (ablation.effects.front() == effect) return max_change(ablation.run.changes).value;
    }
    return 0.0;
  };
  Rows table({"pair", ">together [%]", ">one [%]", ">other [%]"});
  for (const Ablation& pair : study.pairs) {
    const double together = max_change(pair.run.changes).value;
    const double a = single(pair.effects[0]), b = single(pair.effects[1]);
    const double slack = 0.1 * study.tolerance;
    const bool interact = std::isfinite(together) && std::isfinite(a) && std::isfinite(b) &&
                          (together > a + b + slack || together < std::max(a, b) - slack);
    if (!interact) continue;
    table.add({effect_names(pair.effects), in_percent(together), in_percent(a), in_percent(b)});
  }
  if (table.empty()) {
    std::cout << "\nNo pair interacts: two left out together change no more than the sum, and no "
                 "less than the larger.\n";
    return;
  }
  std::cout << "\nPairs that interact: together more than the sum, or less than the larger\n";
  table.print(std::cout, "  ");
}

void print_verdict(const EffectStudy& study) {
  std::cout << "\nChosen    " << effect_names(study.choice.chosen.list()) << '\n';
  const double off = max_change(study.chosen.changes).value;
  std::cout << "Within    " << (study.within_tolerance() ? "yes" : "no") << ": " << in_percent(off)
            << " % from the full model, where " << in_percent(study.tolerance)
            << " % are allowed\n";
  if (study.choice.beyond_tier) {
    std::cout << "Beyond    " << in_percent(*study.choice.beyond_tier)
              << " % at most by large displacement, which this motion cannot have\n";
  }
  std::cout << "Minimal   " << (study.is_minimal() ? "yes" : "no");
  for (const Ablation& ablation : study.from_chosen) {
    const double change = max_change(ablation.run.changes).value;
    if (change <= study.tolerance) {
      std::cout << "; " << in_percent(change) << " % without " << effect_names(ablation.effects)
                << ", overestimated";
    }
  }
  std::cout << '\n';
  if (study.full.cpu_s > 0) {
    std::cout << "Time      " << ratio(study.chosen.cpu_s, study.full.cpu_s)
              << " of the full model's " << rounded(1e3 * study.full.cpu_s, 3)
              << " ms; to decide took " << rounded(1e3 * study.choice_cpu_s, 3) << " ms\n";
  }
}

Json names_json(const std::vector<solver::Effect>& effects) {
  Json names = Json::array();
  for (const solver::Effect effect : effects) names.push_back(solver::name_of(effect));
  return names;
}

/// A run and its change from the full model, all of it where there is no solution.
Json run_json(const EffectRun& run) {
  Json changes = Json::object();
  for (const auto& [kind, change] : run.changes) changes[kind] = number_or_null(change.value);
  return {{"status", run.outcome.solved() ? "solved" : run.outcome.reason},
          {"change", number_or_null(max_change(run.changes).value)},
          {"changes", changes},
          {"cpu_s", run.cpu_s},
          {"element_evaluations", run.counters.element_evaluations},
          {"factorizations", run.counters.factorizations},
          {"solves", run.counters.solves}};
}

Json ablations_json(const std::vector<Ablation>& ablations) {
  Json json = Json::array();
  for (const Ablation& ablation : ablations) {
    json.push_back({{"left_out", names_json(ablation.effects)}});
    json.back().update(run_json(ablation.run));
  }
  return json;
}

Json study_json(const std::string& id, const EffectStudy& study, const std::string& analysis) {
  Json effects = Json::array();
  for (const EffectReason& reason : study.choice.reasons)
    effects.push_back(
        {{"effect", solver::name_of(reason.effect)},
         {"applicable", reason.applicable},
         {"active", reason.active},
         {"dimensionless_number", number_or_null(reason.number)},
         {"number_definition",
          reason.number ? describe_effect_number(reason.effect, analysis) : std::string()},
         {"estimated_change", number_or_null(reason.change)},
         {"why", reason.why}});
  return {{"case", id},
          {"tolerance", study.tolerance},
          {"effects", effects},
          {"chosen", names_json(study.choice.chosen.list())},
          {"within_tolerance", study.within_tolerance()},
          {"minimal", study.is_minimal()},
          {"beyond_tier", number_or_null(study.choice.beyond_tier)},
          {"load_over_buckling_load", number_or_null(study.load_over_buckling_load)},
          {"deciding_cpu_s", study.choice_cpu_s},
          {"full_run", run_json(study.full)},
          {"chosen_run", run_json(study.chosen)},
          {"singles", ablations_json(study.singles)},
          {"pairs", ablations_json(study.pairs)},
          {"from_chosen", ablations_json(study.from_chosen)}};
}

results::EffectScene scene_of(const std::string& id, const std::string& analysis,
                              const EffectStudy& study) {
  return {id,
          analysis,
          study.tolerance,
          max_change(study.chosen.changes).value,
          study.is_minimal(),
          study.full.cpu_s,
          study.chosen.cpu_s,
          study.choice_cpu_s};
}

/// The page of these scenes, where a folder is asked for.
void write_page(const EffectsCommand& command, std::vector<results::EffectScene> scenes,
                const Renderers& renderers) {
  if (command.out.empty()) return;
  results::Results results = results_of({}, {}, References());
  results.effect_scenes = std::move(scenes);
  const OutputLock lock(command.out);
  const auto unfinished = std::filesystem::path(command.out) / results::kUnfinishedFolder;
  std::filesystem::create_directories(unfinished);
  write_results(results, unfinished);
  const auto page = renderers.report(results, command.out, false);
  if (!command.json) std::cout << "page in " << page.string() << '\n';
}

[[noreturn]] void refuse_unsolved(const std::string& id, const EffectStudy& study) {
  throw InputError(id + ": expected a solution with all effects (" + study.full.outcome.reason +
                   ")");
}

/// A case that knows effects.
struct EffectCase {
  std::string id;
  Document document;
};

std::vector<EffectCase> catalogue_effect_cases() {
  std::vector<EffectCase> found;
  for (const Case& given : Catalogue().load({"effects"})) {
    Document document = patched(given, kBaseVariant);
    if (knows_effects(document)) found.push_back({given.id(), std::move(document)});
  }
  return found;
}

/// What the choice of effects comes to in one case; nothing where the whole has no solution.
EffectScenes scenes_of(const EffectCase& given, const std::filesystem::path& store, bool resume) {
  const auto measure = [&] {
    const EffectStudy study = study_effects(given.document, {.pairs = false, .repeats = 3});
    EffectScenes own;
    if (study.full.outcome.solved())
      own.push_back(scene_of(given.id, analysis_kind(given.document), study));
    return own;
  };
  return scenes_or_find(given.document, measure, store, resume);
}

Document effect_document(const Case& given, const EffectsCommand& command) {
  return patched(given, command.variant.empty() ? kBaseVariant : command.variant);
}

/// The named cases, or those with the labels whose analysis knows effects.
std::vector<Document> effect_documents(const EffectsCommand& command) {
  std::vector<Document> documents;
  for (const std::string& name : command.names)
    documents.push_back(effect_document(load_named_case(name), command));
  if (!command.names.empty()) return documents;
  for (const Case& given : Catalogue().load(command.labels)) {
    documents.push_back(effect_document(given, command));
    if (!knows_effects(documents.back())) documents.pop_back();
  }
  if (documents.empty())
    throw InputError("expected a case with these labels whose analysis knows effects");
  return documents;
}

}  // namespace

int effects_command(const EffectsCommand& command) {
  const Document document = effect_document(load_named_case(command.names.front()), command);
  const EffectStudy study = study_effects(document, {command.tolerance, true, command.repeats});
  const Json& json = document.value();
  const std::string id = json.at("id").get<std::string>();
  const int status = study.within_tolerance() && !study.is_beyond_tier() ? 0 : 1;
  if (command.json) {
    if (!study.full.outcome.solved()) refuse_unsolved(id, study);
    std::cout << pretty(study_json(id, study, analysis_kind(document)), 2);
    return status;
  }
  std::cout << id << ": " << json.at("title").get<std::string>() << '\n';
  print_effects(study.choice, analysis_kind(document));
  if (study.load_over_buckling_load)
    std::cout << "\nLoads     " << percent(*study.load_over_buckling_load)
              << " of the buckling load (linear buckling, first pose)\n";
  if (!study.full.outcome.solved()) refuse_unsolved(id, study);
  std::cout << "\nMeasured against the full model\n";
  print_singles(study);
  print_pairs(study);
  print_verdict(study);
  return status;
}

std::vector<std::function<void()>> effect_scene_work(const std::filesystem::path& store,
                                                     bool resume) {
  std::vector<std::function<void()>> work;
  for (const EffectCase& scene : catalogue_effect_cases())
    work.emplace_back([scene, store, resume] { (void)scenes_of(scene, store, resume); });
  return work;
}

std::vector<results::EffectScene> catalogue_effect_scenes(const std::filesystem::path& store,
                                                          bool resume) {
  std::vector<results::EffectScene> scenes;
  for (const EffectCase& scene : catalogue_effect_cases()) {
    EffectScenes found = scenes_of(scene, store, resume);
    std::ranges::move(found, std::back_inserter(scenes));
  }
  return scenes;
}

int effects_table_command(const EffectsCommand& command, const Renderers& renderers) {
  if (!command.out.empty()) require_drawing(renderers);
  std::vector<results::EffectScene> scenes;
  Rows table({"case", "chosen", ">off by [%]", ">allowed", ">minimal", ">beyond [%]", ">full [ms]",
              ">time", ">deciding"});
  bool within = true;
  Json rows = Json::array();
  const std::vector<Document> documents = effect_documents(command);
  std::optional<Progress> progress("scenes");
  for (std::size_t i = 0; i < documents.size(); ++i) {
    const EffectStudy study =
        study_effects(documents[i], {command.tolerance, false, command.repeats});
    progress->show(i + 1, documents.size());
    if (!study.full.outcome.solved()) continue;
    const auto id = documents[i].value().at("id").get<std::string>();
    const std::string analysis = analysis_kind(documents[i]);
    rows.push_back(study_json(id, study, analysis));
    scenes.push_back(scene_of(id, analysis, study));
    within = within && study.within_tolerance() && !study.is_beyond_tier();
    table.add({id, effect_names(study.choice.chosen.list()),
               in_percent(max_change(study.chosen.changes).value), in_percent(study.tolerance),
               study.is_minimal() ? "yes" : "no",
               study.choice.beyond_tier ? in_percent(*study.choice.beyond_tier) : "",
               rounded(1e3 * study.full.cpu_s, 3), ratio(study.chosen.cpu_s, study.full.cpu_s),
               ratio(study.choice_cpu_s, study.full.cpu_s)});
  }
  progress.reset();
  write_page(command, std::move(scenes), renderers);
  if (command.json) {
    std::cout << pretty(rows, 3);
    return within ? 0 : 1;
  }
  table.print(std::cout, "");
  std::cout << "beyond: by large displacement, which the analysis does not have; time, deciding: "
               "relative to the full model\n";
  return within ? 0 : 1;
}

}  // namespace trammel::harness

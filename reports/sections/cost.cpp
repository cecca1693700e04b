#include "reports/figures/figures.h"
#include "reports/sections/sections.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

/// Returns a computing time relative to that of the baseline setting: "2.4 ×".
std::string times(Number factor) {
  return factor ? trimmed(*factor, *factor < 10 ? 2 : 3) + "\u202f×" : "–";
}

std::string error_text(double error) {
  return error < 1e-4 ? power_of_ten(-6) : trimmed(100 * error, 2) + "\u202f%";
}

/// Returns the names of the setting with the shortest computing time, and of settings whose
/// measured times cannot be distinguished from this time.
std::string settings_text(const CostStudy& study, const CheapestSetting& cheapest) {
  const std::string text = study.settings[*cheapest.setting].title;
  const std::size_t tied = cheapest.tied.size();
  if (tied == 1) return text + " or " + study.settings[cheapest.tied.front()].title;
  return tied == 0 ? text : text + " or one of " + std::to_string(tied) + " others";
}

/// Returns the headings of a table of the cheapest settings, with a column for each target error.
/// The caller adds the rows.
TextTable cheapest_table(const std::string& title, const std::string& head,
                         const CostStudy& study) {
  TextTable table{title, {head}};
  for (const CheapestSetting& target : study.cheapest)
    table.heads.push_back("within " + error_text(target.error));
  return table;
}

void add_row(TextTable& table, const std::string& head, const CostStudy& study,
             const std::vector<CheapestSetting>& cheapest) {
  std::vector<std::string>& row = table.rows.emplace_back();
  row = {head};
  for (const CheapestSetting& found : cheapest)
    row.push_back(found.setting ? settings_text(study, found) + " (" +
                                      times(study.settings[*found.setting].relative) + ")"
                                : "none");
}

/// Returns a table of the cheapest setting for each target error, with its error, time and work.
TextTable settings_table(const CostStudy& study) {
  TextTable table{
      "Cheapest settings: " + study.title,
      {"Within", "Cheapest setting", ">Error", ">Time", ">Processor time", "Counted work"}};
  for (const CheapestSetting& cheapest : study.cheapest) {
    std::vector<std::string> row = {error_text(cheapest.error)};
    if (cheapest.setting) {
      const CostSetting& setting = study.settings[*cheapest.setting];
      const Number error = study.error_of(setting);
      for (const std::string& cell :
           {settings_text(study, cheapest), error ? percent_text(*error, 2, false) : "–",
            times(setting.relative), duration(setting.cpu_s), work_counters_text(setting.counters)})
        row.push_back(cell);
    } else {
      row.emplace_back("none of these settings");
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string measured_text(const CostStudy& study) {
  const CostSetting& baseline = study.settings[study.baseline];
  const std::string norm = study.norm == "max"   ? "Largest error"
                           : study.norm == "rms" ? "Root mean square of the errors"
                                                 : "Mean error";
  return norm + " against " + study.reference_solution + ", " + study.scale +
         ". Times are relative to '" + baseline.title + "', which takes " +
         duration(baseline.cpu_s) +
         ". At equal accuracy, the times of odd and of even repeats differ by at most " +
         percent_text(study.repeatability.value_or(0), 2, false) + ".";
}

std::string study_anchor(const CostStudy& study) {
  return "cost-" + slug(study.id);
}

Data study_data(const CostStudy& study, const Figure& figure) {
  TextTable outputs = cheapest_table("Cheapest settings by output", "Output", study);
  for (const CostOutput& output : study.outputs)
    add_row(outputs, output.title + (output.scale.empty() ? "" : " (" + output.scale + ")"), study,
            output.cheapest);
  return object({{"anchor", study_anchor(study)},
                 {"description", study.description},
                 {"measured", measured_text(study)},
                 {"figure", figure_data(figure)},
                 {"cheapest", table_data(settings_table(study))},
                 {"outputs", outputs.rows.empty() ? Data(false) : table_data(outputs)}});
}

}  // namespace

std::vector<Figure*> StudyFigures::all() {
  std::vector<Figure*> figures;
  for (std::vector<Figure>* some : {&trust, &cost, &stress, &effects, &errors, &history})
    for (Figure& figure : *some) figures.push_back(&figure);
  return figures;
}

StudyFigures plan_studies(const Results& results, const std::vector<Family>& families) {
  StudyFigures figures{{}, {}, {}, effect_scene_figures(results.effect_scenes), {}, {}};
  std::map<std::string, std::string> titles, groups;
  std::vector<const Run*> stress, all;
  for (const Family& family : families)
    for (const Run* run : family.runs) {
      const CaseInfo& info = results.case_info(run->case_id);
      all.push_back(run), groups[info.id] = family.group;
      if (info.stress_suite) stress.push_back(run), titles[info.id] = info.title;
    }
  if (results.claims) {
    figures.errors.push_back(error_coverage_figure());
    if (auto figure = tolerance_figure("all", groups, all)) figures.trust.push_back(*figure);
  }
  if (auto figure = order_figure(all)) figures.trust.push_back(std::move(*figure));
  if (auto figure = tolerance_figure("stress-cases", titles, stress, true))
    figures.stress.push_back(std::move(*figure));
  if (results.cost)
    for (const CostStudy& study : results.cost->studies) figures.cost.push_back(cost_figure(study));
  if (results.history && results.history->calls.size() > 1)
    figures.history = {call_history_figure(*results.history)};
  return figures;
}

Data cost_section(const Results& results, const StudyFigures& figures) {
  if (figures.cost.empty()) return object({{"has_rows", false}});
  const CostStudies& cost = *results.cost;
  Data lead = list(), studies = list();
  TextTable overview =
      cheapest_table("Cheapest settings of all studies", "Cheapest setting", cost.studies.front());
  for (std::size_t i = 0; i < cost.studies.size(); ++i) {
    const CostStudy& study = cost.studies[i];
    add_row(overview, study.title, study, study.cheapest);
    overview.links[study.title] = "#" + study_anchor(study);
    (figures.cost[i].id == kLeadFigure ? lead : studies)
        .push_back(study_data(study, figures.cost[i]));
  }
  return object({{"has_rows", true},
                 {"sweep", cost.is_quick() ? "the quick sweep" : "the full sweep"},
                 {"quick", cost.is_quick()},
                 {"repeats", std::to_string(cost.repeats)},
                 {"overview", table_data(overview)},
                 {"lead", lead},
                 {"studies", studies}});
}

Data effects_section(const Results& results, const StudyFigures& figures) {
  TextTable scenes{"Scenes",
                   {"Scene", "Selected effects", ">Requested limit", ">Obtained change",
                    ">Selection time", ">Run time", ">Time with all effects"}};
  for (const EffectScene& scene : results.effect_scenes) {
    scenes.rows.push_back({scene.scene, scene.chosen, percent_text(scene.tolerance, 2, false),
                           percent_text(scene.change, 2, false), duration(scene.deciding_s),
                           duration(scene.chosen_s), duration(scene.whole_s)});
    if (!results.runs.empty()) scenes.links[scene.scene] = case_link(scene.scene);
  }
  return object({{"has_rows", !figures.effects.empty()},
                 {"figures", list_of(figures.effects, figure_data)},
                 {"scenes", table_data(scenes)}});
}

}  // namespace trammel::reports

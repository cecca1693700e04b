#include <algorithm>
#include <functional>

#include "harness/base/find_or_add.h"
#include "reports/data/check_text.h"
#include "reports/figures/figures.h"
#include "reports/sections/sections.h"
#include "reports/text/html.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

struct CaseCost {
  const CaseInfo* info;
  std::size_t runs = 0;
  double wall_s = 0, cpu_s = 0;
  Counters counters;
};

std::vector<CaseCost> costs(const std::vector<Family>& families) {
  std::vector<CaseCost> out;
  for (const Family& family : families) {
    for (const CaseInfo* info : family.cases) {
      CaseCost cost;
      cost.info = info;
      for (const Run* run : family.runs_of(info->id)) {
        ++cost.runs;
        cost.wall_s += run->cost.wall_s;
        cost.cpu_s += run->cost.cpu_s;
        for (const auto& [name, n] : run->cost.counters) {
          const auto same = [&, key = name](const auto& known) { return known.first == key; };
          harness::find_or_add(cost.counters, same, {name, 0}).second += n;
        }
      }
      out.push_back(std::move(cost));
    }
  }
  std::ranges::stable_sort(out, std::ranges::greater(), &CaseCost::wall_s);
  return out;
}

Data row_of(const CaseCost& cost, double longest) {
  return object({{"case_title", cost.info->title},
                 {"case_link", case_link(cost.info->id)},
                 {"runs", std::to_string(cost.runs)},
                 {"wall", duration(cost.wall_s)},
                 {"cpu", duration(cost.cpu_s)},
                 {"percent", trimmed(longest > 0 ? 100 * cost.wall_s / longest : 0, 3)},
                 {"counters", work_counters_text(cost.counters)}});
}

/// Where the time of the runs went.
void set_runs(Data& section, const std::vector<Family>& families) {
  const std::vector<CaseCost> all = costs(families);
  double wall = 0, cpu = 0;
  for (const CaseCost& cost : all) wall += cost.wall_s, cpu += cost.cpu_s;
  std::string words = "All runs together took " + duration(wall) + " one after another (" +
                      duration(cpu) + " of processor time)";
  if (!all.empty() && wall > 0)
    words += "; the longest case, " + all.front().info->title + ", has " +
             relative(all.front().wall_s / wall, 2, false) + " of it";
  const auto row = [&](const CaseCost& cost) { return row_of(cost, all.front().wall_s); };
  set(section,
      {{"runs_words", words + "."}, {"rows", list_of(all, row)}, {"has_runs", !all.empty()}});
}

/// "2.4 ×".
std::string times(Number factor) {
  return factor ? trimmed(*factor, *factor < 10 ? 2 : 3) + "\u202f×" : "–";
}

std::string within(double error) {
  return error < 1e-4 ? power_of_ten(-6) : trimmed(100 * error, 2) + "\u202f%";
}

Data cheapest_row(const CostStudy& study, const CheapestSetting& cheapest) {
  if (!cheapest.setting) return object({{"within", within(cheapest.error)}, {"found", false}});
  const CostSetting& setting = study.settings[*cheapest.setting];
  const Number error_of = study.error(setting);
  std::string settings = setting.title;
  const std::size_t named = cheapest.tied.size() <= 3 ? cheapest.tied.size() : 2;
  for (std::size_t i = 0; i < named; ++i)
    settings += " or " + study.settings[cheapest.tied[i]].title;
  if (cheapest.tied.size() > named)
    settings += " or one of " + std::to_string(cheapest.tied.size() - named) + " more";
  return object({{"within", within(cheapest.error)},
                 {"found", true},
                 {"setting", settings},
                 {"error", error_of ? relative(*error_of, 2, false) : "–"},
                 {"times", times(setting.relative)},
                 {"cpu", duration(setting.cpu_s)},
                 {"work", work_counters_text(setting.counters)}});
}

std::string measured_text(const CostStudy& study) {
  const CostSetting& baseline = study.settings[study.baseline];
  std::string norm = study.norm == "max"   ? "The largest error"
                     : study.norm == "rms" ? "The root mean square of the errors"
                                           : "The mean error";
  return norm + " against " + study.reference_solution + ", " + study.scale +
         ". Times are relative to '" + baseline.title + "', which takes " +
         duration(baseline.cpu_s) + ". Taken by themselves, odd and even repeats put " +
         std::to_string(study.repeatability.on_both_fronts) + " of " +
         std::to_string(study.repeatability.on_either_front) +
         " settings on the Pareto front in both halves, and the time that an accuracy takes "
         "differs by at most " +
         relative(study.repeatability.largest_difference.value_or(0), 2, false) + " between them.";
}

std::string study_anchor(const CostStudy& study) {
  return "cost-" + slug(study.id);
}

/// The targets as heads of a table's columns.
Data heads_of(const std::vector<CheapestSetting>& cheapest) {
  return list_of(cheapest, [](const CheapestSetting& target) {
    return object({{"within", within(target.error)}});
  });
}

Data cells_of(const CostStudy& study, const std::vector<CheapestSetting>& cheapest) {
  return list_of(cheapest,
                 [&](const CheapestSetting& target) { return cheapest_row(study, target); });
}

/// The cheapest settings for each of several outputs, and for all at once.
void set_outputs(Data& data, const CostStudy& study) {
  set(data, {{"has_outputs", !study.outputs.empty()}});
  if (study.outputs.empty()) return;
  const auto row = [&](const CostOutput& output) {
    return object({{"output", output.title},
                   {"scale", output.scale},
                   {"cells", cells_of(study, output.cheapest)}});
  };
  set(data, {{"output_heads", heads_of(study.cheapest)}, {"outputs", list_of(study.outputs, row)}});
}

Data study_data(const CostPanel& panel) {
  const CostStudy& study = *panel.study;
  Data data = object({{"anchor", study_anchor(study)},
                      {"study_title", study.title},
                      {"description", study.description},
                      {"measured", measured_text(study)},
                      {"figure", figure_data(panel.figure)},
                      {"cheapest", cells_of(study, study.cheapest)}});
  set_outputs(data, study);
  return data;
}

/// All studies in one table: the cheapest setting for each accuracy.
void set_overview(Data& section, const std::vector<CostPanel>& panels) {
  const auto row = [](const CostPanel& panel) {
    return object({{"anchor", study_anchor(*panel.study)},
                   {"study_title", panel.study->title},
                   {"cells", cells_of(*panel.study, panel.study->cheapest)}});
  };
  set(section, {{"overview_heads", heads_of(panels.front().study->cheapest)},
                {"overview_rows", list_of(panels, row)}});
}

}  // namespace

std::vector<Figure*> CostPanels::figures() {
  std::vector<Figure*> all;
  for (CostPanel& panel : studies) all.push_back(&panel.figure);
  for (Figure& figure : effects) all.push_back(&figure);
  return all;
}

CostPanels plan_cost(const Results& results) {
  CostPanels panels{{}, effect_scene_figures(results.effect_scenes)};
  if (!results.cost) return panels;
  for (const CostStudy& study : results.cost->studies) {
    panels.studies.push_back({&study, cost_figure(study)});
    panels.studies.back().figure.is_linked = true;
  }
  return panels;
}

Data cost_section(const Results& results, const std::vector<Family>& families,
                  const CostPanels& all) {
  const std::vector<CostPanel>& panels = all.studies;
  Data section = object({{"has_studies", !panels.empty()}});
  set_runs(section, families);
  if (panels.empty()) return section;
  const CostStudies& cost = *results.cost;
  const std::string studies_count = count(panels.size(), "study", "studies");
  const CostStudy& first = *panels.front().study;
  set(section, {{"sweep", cost.is_quick() ? "the quick sweep" : "the full sweep"},
                {"quick", cost.is_quick()},
                {"repeats", std::to_string(cost.repeats)},
                {"studies_count", studies_count},
                {"words", studies_count + ". " + first.title + ": " + first.conclusion},
                {"studies", list_of(panels, study_data)}});
  set_overview(section, panels);
  return section;
}

Data effects_section(const CostPanels& panels) {
  return object({{"has_rows", !panels.effects.empty()},
                 {"words", panels.effects.empty() ? "" : panels.effects.front().caption},
                 {"figures", list_of(panels.effects, figure_data)}});
}

}  // namespace trammel::reports

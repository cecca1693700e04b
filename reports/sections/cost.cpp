#include "reports/sections/cost.h"

#include <algorithm>

#include "reports/data/work_counters_text.h"
#include "reports/figures/cost.h"
#include "reports/figures/effect_scenes.h"
#include "reports/sections/check_status_data.h"
#include "reports/sections/family.h"
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
          auto known = std::ranges::find_if(
              cost.counters, [&, key = name](const auto& c) { return c.first == key; });
          if (known == cost.counters.end()) {
            cost.counters.emplace_back(name, n);
          } else {
            known->second += n;
          }
        }
      }
      out.push_back(std::move(cost));
    }
  }
  std::ranges::stable_sort(
      out, [](const CaseCost& a, const CaseCost& b) { return a.wall_s > b.wall_s; });
  return out;
}

Data row_of(const CaseCost& cost, double longest) {
  Data row = object();
  row.set("case_title", cost.info->title);
  row.set("case_link", case_link(cost.info->id));
  row.set("runs", std::to_string(cost.runs));
  row.set("wall", duration(cost.wall_s));
  row.set("cpu", duration(cost.cpu_s));
  row.set("percent", trimmed(longest > 0 ? 100 * cost.wall_s / longest : 0, 3));
  set_text(row, "counters", work_counters_text(cost.counters));
  return row;
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
  section.set("runs_words", words + ".");
  Data rows = list();
  for (const CaseCost& cost : all) rows.push_back(row_of(cost, all.front().wall_s));
  section.set("rows", rows);
  set_flag(section, "has_runs", !all.empty());
}

/// "2.4 ×".
std::string times(const std::optional<double>& factor) {
  return factor ? trimmed(*factor, *factor < 10 ? 2 : 3) + "\u202f×" : "–";
}

std::string within(double error) {
  return error < 1e-4 ? power_of_ten(-6) : trimmed(100 * error, 2) + "\u202f%";
}

Data cheapest_row(const CostStudy& study, const CheapestSetting& cheapest) {
  Data row = object();
  row.set("within", within(cheapest.error));
  set_flag(row, "found", cheapest.setting.has_value());
  if (!cheapest.setting) return row;
  const CostSetting& setting = study.settings[*cheapest.setting];
  const Number error_of = study.error(setting);
  std::string settings = setting.title;
  const std::size_t named = cheapest.tied.size() <= 3 ? cheapest.tied.size() : 2;
  for (std::size_t i = 0; i < named; ++i)
    settings += " or " + study.settings[cheapest.tied[i]].title;
  if (cheapest.tied.size() > named)
    settings += " or one of " + std::to_string(cheapest.tied.size() - named) + " more";
  row.set("setting", settings);
  row.set("error", error_of ? relative(*error_of, 2, false) : "–");
  row.set("times", times(setting.relative));
  row.set("cpu", duration(setting.cpu_s));
  row.set("work", work_counters_text(setting.counters));
  return row;
}

std::string status_text(const CostSetting& setting) {
  if (setting.status == "timed-out") return "out of time";
  return setting.status == "diverged" ? "diverged" : "no solution";
}

Data left_out(const CostStudy& study) {
  Data rows = list();
  for (const CostSetting& setting : study.settings) {
    if (!setting.without_result()) continue;
    Data row = object();
    row.set("setting", setting.title);
    row.set("status_text", status_text(setting));
    set_text(row, "reason", setting.reason);
    rows.push_back(row);
  }
  return rows;
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
  Data heads = list();
  for (const CheapestSetting& target : cheapest) {
    Data head = object();
    head.set("within", within(target.error));
    heads.push_back(head);
  }
  return heads;
}

Data cells_of(const CostStudy& study, const std::vector<CheapestSetting>& cheapest) {
  Data cells = list();
  for (const CheapestSetting& target : cheapest) cells.push_back(cheapest_row(study, target));
  return cells;
}

/// The cheapest settings for each of several outputs, and for all at once.
void set_outputs(Data& data, const CostStudy& study) {
  set_flag(data, "has_outputs", !study.outputs.empty());
  if (study.outputs.empty()) return;
  data.set("output_heads", heads_of(study.cheapest));
  Data rows = list();
  for (const CostOutput& output : study.outputs) {
    Data row = object();
    row.set("output", output.title);
    set_text(row, "scale", output.scale);
    row.set("cells", cells_of(study, output.cheapest));
    rows.push_back(row);
  }
  data.set("outputs", rows);
}

Data study_data(const CostPanel& panel) {
  const CostStudy& study = *panel.study;
  Data data = object();
  data.set("anchor", study_anchor(study));
  data.set("study_title", study.title);
  set_text(data, "description", study.description);
  data.set("measured", measured_text(study));
  data.set("figure", figure_data(panel.figure));
  Data rows = list();
  for (const CheapestSetting& cheapest : study.cheapest)
    rows.push_back(cheapest_row(study, cheapest));
  data.set("cheapest", rows);
  set_outputs(data, study);
  const Data lost = left_out(study);
  set_flag(data, "has_left_out", lost.is_non_empty_list());
  data.set("left_out", lost);
  return data;
}

/// Loops beside the machine: rates, and shares of the lower of what its core and memory allow.
void set_roofline(Data& section, const Roofline& roofline) {
  Data rows = list();
  for (const LoopRate& loop : roofline.loops) {
    const double flops = loop.operations / loop.cpu_s, bytes = loop.bytes / loop.cpu_s;
    const double allowed = std::min(roofline.peak_flop_per_s,
                                    loop.operations / loop.bytes * roofline.bandwidth_B_per_s);
    Data row = object();
    row.set("loop", loop.title);
    row.set("flops", trimmed(flops / 1e9, 3));
    row.set("peak_share", trimmed(100 * flops / roofline.peak_flop_per_s, 2));
    row.set("bytes", trimmed(bytes / 1e9, 3));
    row.set("bandwidth_share", trimmed(100 * bytes / roofline.bandwidth_B_per_s, 2));
    row.set("allowed_share", trimmed(100 * flops / allowed, 2));
    rows.push_back(row);
  }
  section.set("peak", trimmed(roofline.peak_flop_per_s / 1e9, 3));
  section.set("bandwidth", trimmed(roofline.bandwidth_B_per_s / 1e9, 3));
  section.set("loops", rows);
}

/// All studies in one table: the cheapest setting for each accuracy.
void set_overview(Data& section, const std::vector<CostPanel>& panels) {
  Data rows = list();
  for (const CostPanel& panel : panels) {
    Data row = object();
    row.set("anchor", study_anchor(*panel.study));
    row.set("study_title", panel.study->title);
    row.set("cells", cells_of(*panel.study, panel.study->cheapest));
    rows.push_back(row);
  }
  section.set("overview_heads", heads_of(panels.front().study->cheapest));
  section.set("overview_rows", rows);
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
  Data section = object();
  set_runs(section, families);
  Data effects = list();
  for (const Figure& figure : all.effects) effects.push_back(figure_data(figure));
  section.set("effects", effects);
  set_flag(section, "has_effects", !all.effects.empty());
  const std::vector<CostPanel>& panels = all.studies;
  set_flag(section, "has_studies", !panels.empty());
  if (panels.empty()) return section;
  const CostStudies& cost = *results.cost;
  section.set("sweep", cost.is_quick() ? "the quick sweep" : "the full sweep");
  set_flag(section, "quick", cost.is_quick());
  section.set("repeats", std::to_string(cost.repeats));
  Data studies = list();
  for (const CostPanel& panel : panels) studies.push_back(study_data(panel));
  const std::string studies_count = count(panels.size(), "study", "studies");
  section.set("studies_count", studies_count);
  const CostStudy& first = *panels.front().study;
  section.set("words", studies_count + ". " + first.title + ": " + first.conclusion);
  set_overview(section, panels);
  section.set("studies", studies);
  set_flag(section, "has_roofline", cost.roofline.has_value());
  if (cost.roofline) set_roofline(section, *cost.roofline);
  return section;
}

}  // namespace trammel::reports

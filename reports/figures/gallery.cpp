#include "reports/figures/gallery.h"

#include <algorithm>
#include <iterator>
#include <set>

#include "harness/base/find_or_add.h"
#include "reports/figures/figures.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

constexpr std::size_t kMaxDrawnVariants = 12;  ///< largest number of variants with shape figures

/// Plans the figures of a case. The page shows the sketch of the model, and the first figure of up
/// to three of four groups. The groups, in this order, are: mechanical effects; values (printed
/// against computed values, and figures that the case requests); motions and shapes; refinement
/// studies. All other figures are in a part of the page that is closed at first.
Gallery plan_case_gallery(const CaseInfo& info, const Results& results,
                          const std::vector<const Run*>& runs) {
  Gallery gallery;
  const auto drawn =
      std::ranges::find_if(runs, [](const Run* run) { return run->drawing.has_value(); });
  if (drawn != runs.end())
    if (auto figure = mechanism_figure(info, **drawn)) gallery.sketch.push_back(*figure);
  std::vector<Figure> effects, values, shapes, meshes;
  if (auto figure = agreement_figure(info, results, *runs.front())) values.push_back(*figure);
  std::size_t motions = 0, variants = 0;
  for (const Run* run : runs) {
    if (auto figure = effects_figure(info, results, *run)) effects.push_back(*figure);
    if (auto motion = motion_figure(info, *run); motion && ++motions == 1)
      shapes.push_back(*motion);
    std::ranges::move(convergence_figures(info, *run), std::back_inserter(meshes));
  }
  for (const Run* run : runs)
    if (auto shape = shapes_figure(info, *run); shape && ++variants <= kMaxDrawnVariants)
      shapes.push_back(*shape);
  if (variants > kMaxDrawnVariants)
    gallery.problems.push_back("Shapes are drawn for " + std::to_string(kMaxDrawnVariants) +
                               " of " + count(variants, "variant") + ".");
  if (motions > 1)
    gallery.problems.push_back("The motion of one of " + count(motions, "variant") +
                               " is drawn; 'run --vtk' writes the other motions.");
  for (const PlotRequest& request : info.figures) {
    std::string problem;
    const auto draw = request.value.empty() ? curves_figure : map_figure;
    if (auto figure = draw(info, request, runs, problem))
      values.push_back(*figure);
    else
      gallery.problems.push_back(request.title + " is not drawn: " + problem + ".");
  }
  for (std::vector<Figure>* figures : {&effects, &values, &shapes, &meshes})
    for (Figure& figure : *figures) {
      const bool is_first = &figure == &figures->front() && gallery.shown.size() < 3;
      figure.is_linked = !is_first && figures != &values;
      (is_first ? gallery.shown : gallery.folded).push_back(std::move(figure));
    }
  return gallery;
}

/// A group of case families on the front page. A family belongs to the first group with a word that
/// the family's id contains.
struct FamilyGroup {
  const char* title;
  std::vector<const char*> words;
};

/// Sets the group of a case family, and its position in the report. A family without a group, such
/// as a user's own cases, is last.
void set_group_of_family(Family& family) {
  static const std::vector<FamilyGroup> groups = {
      {"Manipulator", {"manipulator", "elastodynamics", "sensitivity", "kinematics", "rigid"}},
      {"Neural network and tables", {"neural", "consistency"}},
      {"Effects", {"effect"}},
      {"Beams", {"beam", "prestressed", "rotating", "second-order", "buckling", "transient"}},
      {"Large motion", {"large"}},
      {"Membranes", {"membrane"}},
      {"Benchmarks", {"benchmark"}},
      {"Stress suite", {"stress", "hard"}},
      {"Manufactured solutions and controls", {"manufactured", "negative"}}};
  for (const auto& [title, words] : groups)
    for (const char* word : words) {
      family.group = title;
      ++family.position;
      if (family.id.find(word) != std::string::npos) return;
    }
  family.group = family.title;
  ++family.position;
}

}  // namespace

std::string Family::short_title(const CaseInfo& info) const {
  const std::string& full = info.title;
  std::size_t same = full.size();
  for (const CaseInfo* other : cases) {
    if (other == &info) continue;
    std::size_t i = 0;
    while (i < same && i < other->title.size() && other->title[i] == full[i]) ++i;
    same = i;
  }
  if (cases.size() < 2 || same == 0 || same == full.size()) return full;
  const std::size_t word = full.find_last_of(",:", same - 1);
  if (word == std::string::npos) return full;
  const std::size_t from = full.find_first_not_of(" ,:", word);
  return from == std::string::npos ? full : full.substr(from);
}

std::vector<const Run*> Family::runs_of(const std::string& case_id) const {
  std::vector<const Run*> out;
  std::ranges::copy_if(runs, std::back_inserter(out),
                       [&](const Run* run) { return run->case_id == case_id; });
  return out;
}

std::vector<Family> plan_family_figures(const Results& results) {
  std::vector<Family> families;
  for (const CaseInfo& info : results.cases) {
    std::vector<const Run*> runs;
    for (const Run& run : results.runs)
      if (run.case_id == info.id) runs.push_back(&run);
    if (runs.empty()) continue;
    const auto same = [&](const Family& known) { return known.id == info.family; };
    const std::string title =
        info.family.empty() ? "Own cases" : capitalized(replace_separators(info.family));
    Family& family = harness::find_or_add(families, same, {.id = info.family, .title = title});
    family.cases.push_back(&info);
    family.runs.insert(family.runs.end(), runs.begin(), runs.end());
    family.galleries[info.id] = plan_case_gallery(info, results, runs);
  }
  for (Family& family : families) set_group_of_family(family);
  std::ranges::stable_sort(families, {}, &Family::position);
  for (Family& family : families) {
    std::map<std::string, std::string> titles;
    for (const CaseInfo* info : family.cases) titles[info->id] = family.short_title(*info);
    if (auto figure = tolerance_figure(family.id, titles, family.runs))
      family.overview.push_back(*figure);
  }
  return families;
}

std::vector<Figure*> all_figures(std::vector<Family>& families) {
  std::vector<Figure*> figures;
  const auto add = [&](std::vector<Figure>& from) {
    for (Figure& figure : from) figures.push_back(&figure);
  };
  for (Family& family : families) {
    add(family.overview);
    for (const CaseInfo* info : family.cases) {
      Gallery& gallery = family.galleries.at(info->id);
      for (std::vector<Figure>* part : {&gallery.sketch, &gallery.shown, &gallery.folded})
        add(*part);
    }
  }
  return figures;
}

void make_ids_unique(const std::vector<Figure*>& figures) {
  std::set<std::string> used;
  for (Figure* figure : figures) {
    const std::string wanted = figure->id;
    for (int copy = 2; !used.insert(figure->id).second; ++copy)
      figure->id = wanted + "-" + std::to_string(copy);
  }
}

}  // namespace trammel::reports

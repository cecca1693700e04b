#include "harness/studies/accuracy_search.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "harness/base/find_or_add.h"
#include "harness/base/statistic.h"
#include "harness/base/stopwatch.h"
#include "harness/base/text.h"

namespace trammel::harness {
namespace {

constexpr int kMaxRefinements = 14, kCoarserSteps = 2;
/// Computing time of a refinement level relative to the previous level: about 2 for beams and 4 for
/// plates.
constexpr double kCostGrowth = 4, kUnknown = std::numeric_limits<double>::infinity();

bool is_requested(const std::string& name, const std::vector<std::string>& names) {
  return contains(names, name) || contains(names, name.substr(0, name.find(':')));
}

/// Returns a patch that keeps the times at which results are recorded if the time step changes.
Json patch_keeping_output_times(const Document& document) {
  const std::string kind = inner_analysis_kind(document), place = analysis_pointer(document);
  const Json& analysis = document.value().at(JsonPointer(place));
  if (kind == "transient") {
    const double steps = analysis["duration_s"].get<double>() / analysis["step_s"].get<double>();
    const int samples =
        analysis.value("samples", static_cast<int>(std::min(1e4, std::ceil(steps))));
    return patch_setting_value(document.value(), place + "/samples", samples);
  }
  if (kind != "large-motion") return Json::object();
  return patch_setting_value(document.value(), place + "/output_step_s",
                             analysis.value("output_step_s", analysis["step_s"]));
}

/// Returns the description of a discretization: "elements 8, step 0.001".
std::string describe_discretization(const Document& document) {
  std::vector<std::string> parts;
  const Json& json = document.value();
  const auto add = [&](const std::string& word, const std::string& pointer) {
    const JsonPointer place(pointer);
    if (json.contains(place) && json.at(place).is_number())
      parts.push_back(word + rounded(json.at(place).get<double>()));
  };
  const Json& model = json.value("model", Json::object());
  if (model.contains("manipulator")) add("elements ", mesh_pointer(document));
  if (model.contains("members"))
    parts.push_back("elements " +
                    std::to_string(element_count_of(document, model["members"].begin().key())));
  if (model.contains("plates"))
    add("divisions ", "/model/plates/" + model["plates"].begin().key() + "/divisions");
  if (adjacent_refinement_level(document, ErrorSource::step, Refine::finer))
    add(has_step_tolerance(document) ? "tolerance " : "step ", time_step_pointer(document));
  if (has_step_tolerance(document)) add("largest step ", analysis_pointer(document) + "/step_s");
  return fmt::format("{}", fmt::join(parts, ", "));
}

class Search {
 public:
  Search(const Document& document, const AccuracyRequest& request, const References& references)
      : request_(request),
        references_(references),
        current_(document),
        outputs_(patch_keeping_output_times(document)) {
    current_.apply_patch("recorded times", "", outputs_);
  }

  AccuracySearch run() {
    coarsen();
    solve_coarsest();
    choose_quantities();
    if (has(ErrorSource::mesh) && has(ErrorSource::step)) probe();
    while (!(found_.reached = error() <= request_.accuracy)) {
      if (watch_.cpu_s() + (bands_.empty() ? 0 : kCostGrowth * cpu_s_) > request_.time_limit_s) {
        found_.errors.reason = "the time limit ended the search";
        break;
      }
      if (!refine(dominant())) break;
    }
    if (!found_.reached && best_ && best_->error < error()) {
      current_ = best_->document;
      found_.result = std::move(best_->result);
      bands_ = std::move(best_->bands);
      found_.errors.reason += "; the results are those of " + describe_discretization(current_);
    }
    found_.errors.quantities = relative_errors(current_, found_.result, bands_);
    found_.asked = asked_;
    found_.errors.companions = "the refinement levels of the search";
    found_.errors.counters = named_counters(counters_);
    return std::move(found_);
  }

 private:
  [[nodiscard]] bool has(ErrorSource source) const {
    return adjacent_refinement_level(current_, source, Refine::finer).has_value();
  }

  void coarsen() {
    if (!has_mesh_or_time_steps(current_))
      throw current_.error("/analysis", "the case has no mesh and no time step to be refined");
    while (const auto patch = mesh_patch(current_, Refine::coarser))
      current_.apply_patch("coarser mesh", "", *patch);
    for (int i = 0; i < kCoarserSteps && has(ErrorSource::step) && may_be_longer(); ++i)
      if (const auto patch = time_step_patch(current_, Refine::coarser))
        current_.apply_patch("longer step", "", *patch);
    current_.apply_patch("recorded times", "", outputs_);
  }

  /// Returns true if twice the time step is at most the interval between recorded times.
  [[nodiscard]] bool may_be_longer() const {
    const Json& analysis = current_.value().at(JsonPointer(analysis_pointer(current_)));
    return !analysis.contains("output_step_s") || !analysis.contains("step_s") ||
           2 * analysis["step_s"].get<double>() <=
               (1 + 1e-9) * analysis["output_step_s"].get<double>();
  }

  /// @returns true if the document has a solution
  bool solve(const Document& document) {
    document.validate("case");
    const double before = watch_.cpu_s();
    AnalysisResult result = analyze(document, references_, {});
    counters_ += result.counters;
    cpu_s_ = watch_.cpu_s() - before;
    reason_ = result.outcome.reason;
    if (!result.outcome.solved()) return false;
    found_.result = std::move(result);
    return true;
  }

  /// Refines mesh and time step until the case has a solution. A mesh may be too coarse for the
  /// requested number of modes, and a time scheme may not converge.
  void solve_coarsest() {
    for (int i = 0; i < kMaxRefinements; ++i) {
      try {
        if (solve(current_)) {
          found_.tried.push_back(current_);
          return;
        }
      } catch (const InputError& error) {
        reason_ = error.what();
      }
      for (const ErrorSource source : {ErrorSource::mesh, ErrorSource::step})
        if (const auto finer = adjacent_refinement_level(current_, source, Refine::finer))
          current_ = finer->document;
    }
    throw current_.error(
        "/analysis", "the case has no solution for any mesh and step of the search: " + reason_);
  }

  /// Solves with a finer mesh and with a finer step, for estimates of the errors of the first
  /// refinement level due to mesh and step. The search continues with one of these results.
  void probe() {
    for (const ErrorSource source : {ErrorSource::mesh, ErrorSource::step}) {
      auto finer = adjacent_refinement_level(current_, source, Refine::finer, &found_.result);
      const AnalysisResult first = found_.result;
      finer->document.apply_patch("recorded times", "", outputs_);
      if (!solve(finer->document)) continue;
      found_.tried.push_back(finer->document);
      const AnalysisResult& fine = probed_[source] = std::exchange(found_.result, first);
      if (source == ErrorSource::mesh || !is_same_result(first, fine))
        two_levels_[source] = error_bands(first, fine, source, {current_, true, finer->ratio, ""});
    }
    bands_ = two_levels_;
    found_.errors.search.push_back({describe_discretization(current_), error(), cpu_s_});
  }

  void choose_quantities() {
    static const std::vector<std::string> kUsual = {"frequency_Hz",     "load_factor",
                                                    "displacement_x_m", "displacement_y_m",
                                                    "position_x_m",     "position_y_m"};
    std::vector<std::string> names;
    for (const auto& item : found_.result.quantities)
      if (is_estimated(item.first)) names.push_back(item.first);
    for (const std::string& asked : request_.quantities) {
      if (std::ranges::any_of(names, [&](const auto& name) { return is_requested(name, {asked}); }))
        continue;
      throw InputError("--quantity: " +
                       unknown_name_message("a quantity with an estimated error", asked, names));
    }
    asked_ = request_.quantities.empty() ? kUsual : request_.quantities;
    if (std::ranges::none_of(names, [&](const auto& name) { return is_requested(name, asked_); }))
      asked_.clear();
  }

  [[nodiscard]] double largest(const std::map<ErrorSource, ErrorBands>& bands) const {
    double error = -1;
    for (const auto& estimate : relative_errors(current_, found_.result, bands)) {
      if (!asked_.empty() && !is_requested(estimate.quantity, asked_)) continue;
      for (const Number relative : estimate.relative)
        error = std::max(error, relative.value_or(kUnknown));
    }
    return error < 0 ? kUnknown : error;
  }
  [[nodiscard]] double error_by(ErrorSource source) const {
    if (!has(source)) return 0;
    const auto found = bands_.find(source);
    return found == bands_.end() ? kUnknown : largest({*found});
  }
  [[nodiscard]] double error() const {
    const double unknown = std::max(error_by(ErrorSource::mesh), error_by(ErrorSource::step));
    return std::isinf(unknown) ? unknown : largest(bands_);
  }
  [[nodiscard]] ErrorSource dominant() const {
    return error_by(ErrorSource::mesh) >= error_by(ErrorSource::step) ? ErrorSource::mesh
                                                                      : ErrorSource::step;
  }

  /// @returns true if the search can continue with a finer mesh or step
  bool refine(ErrorSource source) {
    auto finer = adjacent_refinement_level(current_, source, Refine::finer, &found_.result);
    const double before = error_by(source);
    if (++refinements_ > 2 * kMaxRefinements || !finer) {
      found_.errors.reason = "the finest permitted mesh and step do not reach this accuracy";
      return false;
    }
    const AnalysisResult coarse = found_.result;
    finer->document.apply_patch("recorded times", "", outputs_);
    if (probed_.contains(source)) {
      found_.result = std::move(probed_.at(source));
      two_levels_.erase(source);
    } else if (!solve(finer->document)) {  // for example, an explicit scheme is unstable
      if (source == ErrorSource::mesh && has(ErrorSource::step)) return refine(ErrorSource::step);
      found_.errors.reason = "with " + finer->words + " there is no solution: " + reason_;
      return false;
    }
    const Companion coarser{current_, false, finer->ratio, ""};
    ErrorBands two_levels = error_bands(found_.result, coarse, source, coarser);
    current_ = finer->document;
    bands_[source] = bands_with_observed_order(two_levels, two_levels_[source], source, coarser);
    two_levels_[source] = std::move(two_levels);
    if (source == ErrorSource::step && is_same_result(found_.result, coarse)) bands_.erase(source);
    if (has_exact_steps(current_))  // a peak can still lie between samples
      bands_[ErrorSource::step] =
          error_bands(found_.result, found_.result, ErrorSource::step, {current_, false, 2, ""});
    if (!probed_.contains(source)) found_.tried.push_back(current_);
    probed_.clear();
    const double error_now = error();
    found_.errors.search.push_back({describe_discretization(current_), error_now, cpu_s_});
    if (!best_ || error_now <= best_->error) best_ = {current_, found_.result, bands_, error_now};
    stalled_ = error_by(source) > 0.7 * before ? stalled_ + 1 : 0;
    if (stalled_ < 3) return true;
    found_.errors.reason =
        "refinement no longer reduces the estimated error, due to round-off, a singularity or the "
        "interval between samples";
    return false;
  }

  struct Level {
    Document document;
    AnalysisResult result;
    std::map<ErrorSource, ErrorBands> bands;
    double error = kUnknown;
  };

  const AccuracyRequest& request_;
  const References& references_;
  Document current_;
  Json outputs_;  // patch that keeps the recorded times
  Stopwatch watch_;
  AccuracySearch found_;
  std::optional<Level> best_;  // level with the smallest estimated error
  std::vector<std::string> asked_;
  // Error bands from three and from two refinement levels.
  std::map<ErrorSource, ErrorBands> bands_, two_levels_;
  // Results one refinement level finer than the first level.
  std::map<ErrorSource, AnalysisResult> probed_;
  solver::Counters counters_;
  std::string reason_;
  double cpu_s_ = 0;
  int refinements_ = 0, stalled_ = 0;
};

}  // namespace

bool has_mesh_or_time_steps(const Document& document) {
  return adjacent_refinement_level(document, ErrorSource::mesh) ||
         adjacent_refinement_level(document, ErrorSource::step);
}

AccuracySearch search_accuracy(const Document& document, const AccuracyRequest& request,
                               const References& references) {
  return Search(document, request, references).run();
}

CostStudy cost_study_of_search(const Case& given, const std::string& variant,
                               const AccuracySearch& search, const AccuracyRequest& request) {
  CostStudy study = cost_study_without_settings(given, variant);
  std::vector<ObservedQuantity> observed;
  for (const auto& estimate : search.errors.quantities) {
    const bool is_zero = max_abs(search.result.quantities.at(estimate.quantity).values) == 0;
    if (!is_zero && (search.asked.empty() || is_requested(estimate.quantity, search.asked)))
      observed.push_back({estimate.quantity, "", "", {}, false, {}});
  }
  const auto add = [&](const Document& document) {
    Setting setting;
    setting.curve = setting.curve_title = "refinement";
    setting.title = describe_discretization(document);
    setting.document = document;
    setting.observed = observed;
    return setting;
  };
  for (const Document& document : search.tried) study.settings.push_back(add(document));
  Document finest = search.tried.back();
  for (const ErrorSource source : {ErrorSource::mesh, ErrorSource::step})
    if (const auto finer = adjacent_refinement_level(finest, source, Refine::finer))
      finest = finer->document;
  study.reference_solution = add(finest);
  study.reference_description = study.reference_solution->title;
  const std::string kind = inner_analysis_kind(finest);
  StudyOutput& output = study.outputs.front();
  output.scale.kind =
      kind == "modes" || kind == "buckling" ? Scale::Kind::entry : Scale::Kind::quantity;
  output.scale_description = output.scale.kind == Scale::Kind::entry
                                 ? "relative to each true value"
                                 : "relative to the largest true value of each quantity";
  study.time_limit_s = static_cast<int>(std::ceil(request.time_limit_s));
  return study;
}

}  // namespace trammel::harness

#include "harness/studies/discretization_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include "harness/analysis/coarse_scene.h"
#include "harness/analysis/effect_changes.h"
#include "harness/base/statistic.h"
#include "harness/base/text.h"
#include "harness/statics_modes/range_warnings.h"
#include "harness/studies/mode_match.h"

namespace trammel::harness {
namespace {

using results::ErrorEstimate;
using results::ErrorEstimates;

constexpr double kSafetyFactor = 3;       // Roache's safety factor if no order is observed
constexpr double kLargeDifference = 0.1;  // above this relative difference: not asymptotic
constexpr std::size_t kMaxEntries = 12;   // a quantity with more entries is a curve, with one error
                                          // for all entries

/// Returns the name of a quantity without "steady_" or "peak_".
std::string base_name(const std::string& name) {
  for (const char* prefix : {"steady_", "peak_"})
    if (name.starts_with(prefix)) return name.substr(std::string_view(prefix).size());
  return name;
}

/// Returns true if the analysis depends on neither a mesh nor steps.
bool is_closed_form(const std::string& kind) {
  static const std::vector<std::string> kinds = {
      "properties", "kinematics", "inverse-dynamics",    "manufactured",
      "comparison", "options",    "model-probabilities", "grnn"};
  return contains(kinds, kind);
}

/// Returns true for equilibria of springs, bars and rigid bodies, which have no discretization
/// error.
bool has_exact_equilibrium(const Document& document) {
  const std::string kind = inner_analysis_kind(document);
  const bool is_statics = kind == "statics" || kind == "large-statics" || kind == "buckling";
  return is_statics && document.value().contains("model") &&
         !document.value()["model"].contains("plates") &&
         !document.value()["model"].contains("manipulator");
}

/// Returns true if a member `key` of the JSON object, at any depth, equals `value`.
bool has_value(const Json& json, const std::string& key, const Json& value) {
  if (!json.is_object()) return false;
  for (const auto& [name, entry] : json.items())
    if ((name == key && entry == value) || has_value(entry, key, value)) return true;
  return false;
}

/// Returns the order of convergence in the element size; empty if nodal values are exact.
std::optional<double> order_in_element_size(const Document& document, const std::string& quantity) {
  const Json& model = document.value()["model"];
  const std::string kind = inner_analysis_kind(document);
  const auto any = [&](const char* key, const char* value) { return has_value(model, key, value); };
  const JsonPointer place(analysis_pointer(document) + "/second_order");
  const bool is_linear = kind == "statics" && !document.value().value(place, false);
  const bool has_triangles = model.contains("plates") || any("kind", "triangles");
  if (has_triangles && quantity.starts_with("stress_")) return 1;
  // Harmonic peaks, section forces in motion and equilibria in large rotation converge with order
  // 2, modes with order 4. Second-order theory under a distributed load has order 2, because axial
  // force is constant in each element.
  const bool is_compressed = kind == "buckling" || (kind == "statics" && !is_linear);
  bool is_second = has_triangles || kind == "harmonic" || kind == "large-statics" ||
                   kind == "elastodynamics" || (is_compressed && model.contains("gravity_m_s2"));
  if (!is_linear)
    is_second = is_second || any("mass_matrix", "lumped") || any("beam", "timoshenko") ||
                any("beam", "shear");
  if (model.contains("members"))
    for (const auto& [name, member] : model["members"].items())
      is_second = is_second || (is_compressed && member.contains("load_N_per_m")) ||
                  member.contains("end_section") || member.contains("arc_center_m") ||
                  member.contains("restrained_motions");
  if (is_second) return 2;
  if (is_linear) return std::nullopt;
  return 4;
}

/// Returns the order of convergence in the time step. With a step control, returns the exponent of
/// the tolerance to which the error is proportional.
double order_in_time_step(const Document& document, const std::string& quantity) {
  const Json& analysis = document.value().at(JsonPointer(analysis_pointer(document)));
  if (inner_analysis_kind(document) == "forward-dynamics") return 8.0 / 9;  // adaptive Runge-Kutta
  // With "error_control", a refinement divides the tolerance by 10 and halves the largest step. If
  // the largest step limits all steps, the error decreases only to 1/4, and not to 10^(-2/3). The
  // estimate assumes the larger of these two errors.
  if (has_step_tolerance(document))
    return analysis.contains("error_control") ? std::log10(4.0) : 2.0 / 3;
  // Vibrations with periods shorter than the time step delay the convergence of reactions.
  if (inner_analysis_kind(document) == "large-motion" && quantity.starts_with("reaction_"))
    return 1;
  if (analysis.value("extrapolated", false)) return 3;
  for (const char* key : {"method", "scheme"}) {
    const JsonPointer gamma(std::string("/") + key + "/newmark/gamma");
    if (analysis.contains(gamma) && analysis.at(gamma) != 0.5) return 1;
  }
  return 2;
}

/// Returns the order of convergence, which is the lowest order of all discretized parts.
/// Mesh: 4 for straight prismatic members with a consistent mass. 2 for a lumped mass, tapered
/// members, chords of arcs and triangles (J. S. Archer, J. Struct. Div. ASCE 89, 1963), and for the
/// conditions named in `order_in_element_size`.
/// Step: 2 for time schemes, 1 for Newmark's with numerical damping. For an adaptive scheme of
/// order p, the error is proportional to the tolerance to the power p/(p + 1). The result is empty
/// if nodal values are exact in theory.
std::optional<double> theoretical_order(const Document& document, ErrorSource source,
                                        const std::string& quantity) {
  if (source == ErrorSource::mesh) return order_in_element_size(document, quantity);
  // The largest value among samples converges at most with order 2 in the distance between samples.
  const double order = order_in_time_step(document, quantity);
  return quantity.starts_with("peak_") ? std::min(order, 2.0) : order;
}

/// Returns a bound of the difference between the largest value of a curve and the largest of its
/// samples, for a parabola through three samples. With few samples, this bound is unreliable, and
/// the largest value is the bound. Returns 0 for quantities that are not peaks.
double sampling_error(const AnalysisResult& result, const std::string& name) {
  constexpr std::size_t kFew = 16;
  const auto curve = result.quantities.find(base_name(name));
  if (!name.starts_with("peak_") || curve == result.quantities.end()) return 0;
  const std::vector<double>& values = curve->second.values;
  if (values.size() < kFew) return max_abs(values);
  double largest = 0;
  for (std::size_t i = 2; i < values.size(); ++i)
    largest = std::max(largest, std::abs(values[i] - 2 * values[i - 1] + values[i - 2]));
  return largest / 8;
}

/// Returns true if a study sets the key at a pointer, and would undo a patch of this key.
bool is_varied_by_study(const Document& document, const std::string& pointer) {
  const Json study = document.value().value(JsonPointer("/analysis/study"), Json::object());
  return contains(study.value("pointers", Json::array()), Json(pointer)) ||
         study.value("patches", Json::array({Json()})).front().contains(JsonPointer(pointer));
}

bool has_mode_shapes(const AnalysisResult& result) {
  return result.drawing && !result.drawing->shapes.empty() &&
         result.drawing->shapes.front().label.starts_with("mode") &&
         result.quantities.contains("frequency_Hz");
}

/// Returns true if a frequency or load factor has no match on the other mesh, or if a curve
/// has fewer than two common samples.
bool lacks_a_match(const ErrorBands& bands) {
  return std::ranges::any_of(bands, [](const auto& item) {
    const std::vector<double>& width = item.second.half_width;
    const auto known = std::ranges::count_if(width, [](double x) { return std::isfinite(x); });
    const bool is_listed = item.first == "frequency_Hz" || item.first == "load_factor";
    return is_listed ? known < std::ssize(width) : width.size() > 1 && known < 2;
  });
}

/// Scales of the quantities. An error divided by the scale is a relative error.
class ErrorScales {
 public:
  ErrorScales(const Document& document, const AnalysisResult& own)
      : own_(own.quantities), kind_(inner_analysis_kind(document)) {
    if (!document.value().contains("model")) return;
    const ModelScales model = typical_model_scales(model_at_path_start(read_case_model(document)));
    Quantities grouped = own_;
    for (const auto& [name, quantity] : own_)  // peaks share the scales of the curves
      if (base_name(name) != name) grouped.emplace(base_name(name), quantity);
    scales_ = change_scales(grouped, model);
    scales_["growth rate"] = 2 * std::numbers::pi * scales_["frequency"];
    if (!kind_.starts_with("large-") && kind_ != "modes") return;
    for (const auto& [kind, size] : {std::pair("displacement", model.length), {"rotation", 1.0}})
      scales_[kind] = std::max(scales_[kind], kPositionRoundoff * size);
  }

  /// Returns true for a quantity recorded over time or along a path, and for a quantity with many
  /// entries. Only the largest error of such a quantity is reported.
  [[nodiscard]] bool is_curve(const std::string& name) const {
    const std::size_t size = own_.at(name).values.size();
    const auto time = own_.find("time_s");
    const bool is_series = time != own_.end() && time->second.values.size() == size && size > 1;
    return quantity_group(name) != "frequency" && (size > kMaxEntries || is_series);
  }
  /// Returns the scale of a quantity's error, such as the largest displacement of the structure for
  /// displacements. For a curve, the scale is at least its largest value. Errors of frequencies,
  /// load factors and other numbers are relative to each number, but at least to 1e-6 of the
  /// largest number.
  [[nodiscard]] double of(const std::string& name) const {
    const std::string kind =
        name.starts_with("growth_rate_per_s") ? "growth rate" : quantity_group(base_name(name));
    const double largest = max_abs(own_.at(name).values);
    const auto found = scales_.find(kind);
    if (kind == "frequency" || found == scales_.end())
      return is_curve(name) ? largest : 1e-6 * largest;
    return std::max(largest, found->second);
  }
  /// Returns the assumed relative round-off error of a quantity. This error is larger for analyses
  /// with iterations or time steps, and for sensitivities, which can be difference quotients.
  [[nodiscard]] double roundoff() const {
    if (kind_ == "sensitivity") return std::sqrt(std::numeric_limits<double>::epsilon());
    return kind_ == "statics" || kind_ == "modes" || kind_ == "buckling" ? 1e-11 : 1e-9;
  }

 private:
  /// Round-off error of rotations, and of displacements computed as differences of positions,
  /// relative to the length of the model.
  static constexpr double kPositionRoundoff = 1e-11;
  const Quantities& own_;
  std::string kind_;
  std::map<std::string, double> scales_;
};

}  // namespace

bool is_estimated(const std::string& name) {
  const std::string head = name.substr(0, name.find(':'));
  static const std::vector<std::string> others = {
      "time_s",  "pose_",         "parameter",         "status",
      "digits",  "frequency_gap", "effect_",           "error",
      "step",    "drift",         "newton_correction", "iteration",
      "elements"};
  return !is_error_measure(name) && !is_count_quantity(head) &&
         std::ranges::none_of(others,
                              [&](const auto& part) { return head.find(part) != head.npos; });
}

std::vector<std::optional<std::size_t>> modes_matched_by_shape(const AnalysisResult& own,
                                                               const AnalysisResult& other) {
  const std::vector<double>& frequency = own.quantities.at("frequency_Hz").values;
  const std::vector<double>& others = other.quantities.at("frequency_Hz").values;
  std::vector<std::optional<std::size_t>> places(frequency.size());
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = i;
  if (!has_mode_shapes(own) || !has_mode_shapes(other)) return places;
  const auto [a, b] = sample_modes(frequency, *own.drawing, others, *other.drawing);
  for (std::size_t i = 0; i < a.frequency.size(); ++i)
    if (i >= others.size() || std::abs(frequency[i] - others[i]) > kLargeDifference * frequency[i])
      places[i].reset();
  for (const ModeMatch& match : match_modes(a, b))
    for (std::size_t k = 0; k < match.a.size() && k < match.b.size(); ++k)
      places[match.a[k]] = match.b[k];
  return places;
}

std::vector<std::optional<std::size_t>> samples_matched_by_time(const Quantities& own,
                                                                const Quantities& other,
                                                                std::size_t size,
                                                                std::size_t other_size) {
  std::vector<std::optional<std::size_t>> places(size);
  const auto times = [](const Quantities& quantities, std::size_t samples) {
    const auto time = quantities.find("time_s");
    const bool is_axis = time != quantities.end() && time->second.values.size() == samples;
    return is_axis ? time->second.values : std::vector<double>();
  };
  const std::vector<double> time = times(own, size), others = times(other, other_size);
  for (std::size_t i = 0, j = 0; i < size; ++i) {
    if (time.empty() || others.empty()) {
      if (size == other_size) places[i] = i;
      continue;
    }
    const double near = 1e-9 * time.back();
    while (j < other_size && others[j] < time[i] - near) ++j;
    if (j < other_size && others[j] <= time[i] + near) places[i] = j;
  }
  return places;
}

bool is_same_result(const AnalysisResult& result, const AnalysisResult& other) {
  return std::ranges::all_of(result.quantities, [&](const auto& item) {
    const auto found = other.quantities.find(item.first);
    return !is_estimated(item.first) ||
           (found != other.quantities.end() && found->second.values == item.second.values);
  });
}

std::optional<Companion> adjacent_refinement_level(const Document& document, ErrorSource source,
                                                   Refine refine, const AnalysisResult* result) {
  if (is_closed_form(inner_analysis_kind(document))) return std::nullopt;
  const bool is_mesh = source == ErrorSource::mesh;
  if (is_varied_by_study(document, is_mesh ? mesh_pointer(document) : time_step_pointer(document)))
    return std::nullopt;
  const bool has_step = result != nullptr && result->quantities.contains("largest_step_s");
  const double step = has_step ? result->quantities.at("largest_step_s").values.front() : 0;
  const auto patch_of = [&](const Document& given, Refine how) {
    return is_mesh ? mesh_patch(given, how) : time_step_patch(given, how, step);
  };
  std::optional<Json> patch = patch_of(document, refine);
  Companion companion{document, refine == Refine::finer, 2, ""};
  if (!patch && refine == Refine::coarser) {
    patch = patch_of(document, Refine::finer);
    companion.finer = true;
  }
  if (!patch) return std::nullopt;
  const bool by_tolerance = !is_mesh && (has_step_tolerance(document) ||
                                         inner_analysis_kind(document) == "forward-dynamics");
  if (by_tolerance) companion.ratio = 10;
  companion.words = is_mesh ? (companion.finer ? "twice the elements" : "half the elements")
                    : by_tolerance
                        ? (companion.finer ? "a tenth of the tolerance" : "ten times the tolerance")
                        : (companion.finer ? "half the step" : "twice the step");
  companion.document.apply_patch(companion.words, "", *patch);
  return companion;
}

ErrorBands error_bands(const AnalysisResult& result, const AnalysisResult& other,
                       ErrorSource source, const Companion& companion) {
  const Document& document = companion.document;
  const ErrorScales scales(document, result);
  ErrorBands bands;
  // Highest frequency that the coarser of both meshes resolves [Hz].
  double resolved = std::numeric_limits<double>::infinity();
  if (source == ErrorSource::mesh && inner_analysis_kind(document) == "modes") {
    const solver::Mesh mesh =
        solver::discretize(model_at_path_start(read_case_model(document))).mesh;
    resolved = resolved_frequency(mesh);
    for (const solver::FrameElement& e : mesh.frame)  // two elements per axial half wave
      if (e.section.mass_per_length > 0)
        resolved = std::min(resolved,
                            std::sqrt(e.section.EA / e.section.mass_per_length) / (4 * e.length));
    if (companion.finer) resolved /= 4;
  }
  for (const auto& [name, quantity] : result.quantities) {
    const auto found = other.quantities.find(name);
    if (!is_estimated(name) || found == other.quantities.end()) continue;
    const std::vector<double>& values = quantity.values;
    const std::vector<double>& others = found->second.values;
    const auto places = name == "frequency_Hz"
                            ? modes_matched_by_shape(result, other)
                            : samples_matched_by_time(result.quantities, other.quantities,
                                                      values.size(), others.size());
    const double scale = scales.of(name);
    const std::optional<double> order = theoretical_order(document, source, name);
    ErrorBand band{std::vector<double>(values.size(), kNaN), {}, {}, order, true};
    band.difference = band.factor = band.half_width;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!places[i] || *places[i] >= others.size()) continue;
      const double difference = std::abs(values[i] - others[*places[i]]);
      const double roundoff =
          scales.roundoff() * std::max(scale, std::abs(values[i])) +
          (i < quantity.roundoff.size() ? quantity.roundoff[i] * std::abs(values[i]) : 0);
      // Growth rates that are equal up to round-off have no estimate: the mode may be unstable.
      if (name.starts_with("growth_rate") && difference <= roundoff) continue;
      const bool is_nodal = !order && difference <= 100 * roundoff;
      const bool is_coarse = difference > kLargeDifference * std::max(std::abs(values[i]), scale) ||
                             (name == "frequency_Hz" && values[i] > resolved);
      // Equal values on two coarse meshes do not imply convergence. An example is a free bar with
      // one element and with two elements.
      const bool is_blind = is_coarse && difference <= 100 * roundoff;
      const double p = is_coarse ? std::min(order.value_or(2), 2.0) : order.value_or(2);
      const double power = std::pow(companion.ratio, p);
      band.difference[i] = difference;
      band.factor[i] = is_nodal ? 1 : kSafetyFactor * (companion.finer ? power : 1) / (power - 1);
      band.half_width[i] = roundoff + band.factor[i] * difference;
      if (is_blind) band.half_width[i] = kLargeDifference * std::max(std::abs(values[i]), scale);
      if (source == ErrorSource::step) band.half_width[i] += sampling_error(result, name);
      if (!is_nodal) band.order = p;
      band.asymptotic = band.asymptotic && !is_coarse;
    }
    bands.emplace(name, std::move(band));
  }
  // Stresses are derivatives of displacements. On a coarse mesh, their relative errors are at least
  // those of the displacements.
  double coarse_error = 0;
  for (const auto& [name, band] : bands)
    if (name.starts_with("displacement_") && !band.asymptotic)
      coarse_error = std::max(coarse_error, max_abs(band.half_width) / scales.of(name));
  for (auto& [name, band] : bands)
    if (coarse_error > 0 && name.find("stress_") != std::string::npos)
      for (double& half_width : band.half_width)
        half_width = std::max(half_width, coarse_error * scales.of(name));
  return bands;
}

ErrorBands bands_with_observed_order(ErrorBands bands, const ErrorBands& coarser,
                                     ErrorSource source, const Companion& companion) {
  constexpr double kFactor = 1.25, kNear = 0.5, kLowest = 0.5;
  for (auto& [name, band] : bands) {
    const auto before = coarser.find(name);
    const auto order = theoretical_order(companion.document, source, name);
    if (before == coarser.end() || !order) continue;
    const std::vector<double>& wider = before->second.difference;
    bool agrees = wider.size() == band.difference.size();
    for (std::size_t i = 0; i < std::min(wider.size(), band.difference.size()); ++i) {
      const double observed = std::log(wider[i] / band.difference[i]) / std::log(companion.ratio);
      const bool is_near = std::abs(observed - *order) < kNear;
      agrees = agrees && is_near;
      if (!std::isfinite(observed)) continue;
      const double p = is_near ? *order : std::clamp(observed, kLowest, 2 * *order);
      const double factor =
          (is_near ? kFactor : kSafetyFactor) / (std::pow(companion.ratio, p) - 1);
      band.half_width[i] += (factor - band.factor[i]) * band.difference[i];
    }
    band.asymptotic = band.asymptotic || agrees;
  }
  return bands;
}

std::vector<ErrorEstimate> relative_errors(const Document& document, const AnalysisResult& result,
                                           const std::map<ErrorSource, ErrorBands>& bands) {
  std::vector<ErrorEstimate> estimates;
  const ErrorScales scales(document, result);
  for (const auto& [name, quantity] : result.quantities) {
    const auto has_all = [&, &name = name, size = quantity.values.size()](const auto& source) {
      const auto found = source.second.find(name);
      return found != source.second.end() && found->second.half_width.size() == size;
    };
    if (bands.empty() || !std::ranges::all_of(bands, has_all)) continue;
    ErrorEstimate estimate;
    estimate.quantity = name;
    const std::vector<double>& values = quantity.values;
    const double scale = scales.of(name);
    const bool is_curve = scales.is_curve(name);
    std::vector<double> sum(values.size(), 0.0);
    double dominant = -1;
    for (const auto& [source, parts] : bands) {
      const ErrorBand& band = parts.at(name);
      double largest = 0;
      for (std::size_t i = 0; i < values.size(); ++i) {
        sum[i] += band.half_width[i];
        if (std::isfinite(band.half_width[i])) largest = std::max(largest, band.half_width[i]);
      }
      if (band.order) estimate.order = std::min(estimate.order.value_or(*band.order), *band.order);
      estimate.asymptotic = estimate.asymptotic && band.asymptotic;
      if (largest <= dominant) continue;
      dominant = largest;
      estimate.setting =
          source == ErrorSource::mesh ? mesh_pointer(document) : time_step_pointer(document);
    }
    Number of_curve;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double size = is_curve ? scale : std::max(std::abs(values[i]), scale);
      const Number relative = sum[i] == 0 ? 0 : sum[i] / size;
      if (!is_curve) estimate.relative.push_back(relative);
      if (relative) of_curve = std::max(of_curve.value_or(0), *relative);
    }
    if (is_curve) estimate.relative = {of_curve};
    if (scale > 0) estimate.scale = scale;
    estimates.push_back(std::move(estimate));
  }
  return estimates;
}

ErrorEstimates estimate_errors(const Document& document, const AnalysisResult& result,
                               const References& references) {
  ErrorEstimates found;
  std::map<ErrorSource, ErrorBands> bands;
  solver::Counters counters;
  for (const ErrorSource source : {ErrorSource::mesh, ErrorSource::step}) {
    std::string used, failed;
    for (const Refine refine : {Refine::coarser, Refine::finer}) {
      const auto companion = adjacent_refinement_level(document, source, refine, &result);
      if (!companion) continue;
      if (!used.empty() && (used == companion->words || !lacks_a_match(bands[source]))) continue;
      failed = companion->words;
      const auto model = [&] { return model_at_path_start(read_case_model(document)); };
      if (companion->finer && unknown_count(model()) > 1000) continue;
      try {
        companion->document.validate("case");
        const auto other =
            analyze(companion->document, references, {.drawing = has_mode_shapes(result)});
        counters += other.counters;
        if (!other.outcome.solved() || (!companion->finer && is_same_result(result, other)))
          continue;
        bands[source] = error_bands(result, other, source, *companion);
        used = companion->words;
      } catch (const InputError&) {  // fewer modes than the case requests
      }
    }
    if (source == ErrorSource::step && has_exact_steps(document))
      bands[source] = error_bands(result, result, source, {document, false, 2, ""});  // peaks
    if (!used.empty()) found.companions += (found.companions.empty() ? "" : "; ") + used;
    if (used.empty() && !failed.empty())
      found.reason = "the computation with " + failed + " has no solution or is too expensive";
  }
  if (bands.empty() && found.reason.empty() && !has_exact_equilibrium(document))
    found.reason = "the analysis has neither a mesh nor steps";
  if (bands.empty() && found.reason.empty()) {  // round-off is the only error
    found.companions = "none: springs, bars and rigid bodies have no mesh";
    bands[ErrorSource::mesh] =
        error_bands(result, result, ErrorSource::mesh, {document, false, 2, ""});
  }
  if (found.reason.empty()) found.quantities = relative_errors(document, result, bands);
  found.counters = named_counters(counters);
  return found;
}

std::vector<std::string> error_warnings(const ErrorEstimates& errors, double limit) {
  constexpr std::size_t kNamed = 3;
  std::map<std::string, std::vector<std::pair<double, std::string>>> by_setting;
  for (const ErrorEstimate& estimate : errors.quantities) {
    std::vector<std::string> entries;
    double largest = 0;
    for (std::size_t i = 0; i < estimate.relative.size(); ++i) {
      if (!(estimate.relative[i].value_or(0) > limit)) continue;
      if (estimate.relative.size() > 1) entries.push_back(std::to_string(i));
      largest = std::max(largest, *estimate.relative[i]);
    }
    if (!(largest > limit)) continue;
    by_setting[estimate.setting].emplace_back(
        -largest,
        fmt::format("{}{} {:.2g} %{}", estimate.quantity,
                    entries.empty() ? "" : "[" + join(entries, "and") + "]", 100 * largest,
                    estimate.asymptotic ? "" : " (not in the asymptotic range)"));
  }
  std::vector<std::string> warnings;
  for (auto& [setting, found] : by_setting) {
    std::ranges::sort(found);
    std::vector<std::string> words;
    for (std::size_t i = 0; i < std::min(kNamed, found.size()); ++i)
      words.push_back(found[i].second);
    if (found.size() > kNamed) words.push_back(std::to_string(found.size() - kNamed) + " more");
    warnings.push_back("estimated discretization errors: " + join(words, "and") + "; change " +
                       setting);
  }
  return warnings;
}

}  // namespace trammel::harness

#include "harness/studies/validation_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "harness/base/number.h"
#include "harness/input/case.h"

namespace trammel::harness {
namespace {

using results::Comparison;
using results::Number;
using results::UncertainInput;

/// Ratio of the 95 % half width of the discretization error to its standard uncertainty. The error
/// is one-sided and close to the half width. Source: ASME V&V 20-2009, section 2 (k = 1.1 to 1.15).
constexpr double kGciToStandard = 1.15;

/// Entry of a computed quantity that is compared with an entry of a reference.
struct Place {
  const Check* check = nullptr;
  std::size_t index = 0, reference_index = 0;
  const references::Reference* reference = nullptr;
};

std::vector<Place> compared_places(const std::vector<Check>& checks, const JsonView& root,
                                   const Quantities& quantities, const References& references) {
  std::vector<Place> places;
  for (const Check& check : checks) {
    const bool compared =
        check.role == Role::validation && !check.reference.empty() && check.statistic.empty();
    const auto found = quantities.find(check.quantity);
    if (!compared || found == quantities.end()) continue;
    const auto& reference = references.get(root["checks"][check.name]["reference"]);
    const std::size_t count = check.index.empty() ? reference.values.size() : check.index.size();
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t index = check.index.empty() ? k : check.index[k];
      const std::size_t entry = check.reference_index.empty() ? k : check.reference_index.at(k);
      if (index >= found->second.values.size() || entry >= reference.values.size()) continue;
      places.push_back({&check, index, entry, &reference});
    }
  }
  return places;
}

double value_at_place(const Quantities& quantities, const Place& place) {
  const auto found = quantities.find(place.check->quantity);
  if (found == quantities.end() || place.index >= found->second.values.size()) return kNaN;
  return found->second.values[place.index];
}

/// Returns the case document with each number at the JSON pointers replaced by the result of
/// `move`.
Document moved(const Document& document, const std::vector<std::string>& pointers,
               const std::function<double(double)>& move) {
  Document copy = document;
  for (const std::string& pointer : pointers) {
    const double value = document.value().at(JsonPointer(pointer)).get<double>();
    const Origin written = document.origin(pointer);
    copy.apply_value_patch(written.file, written.pointer,
                           patch_setting_value(copy.value(), pointer, move(value)));
  }
  return copy;
}

bool is_number(const Document& document, const std::string& pointer) {
  const JsonPointer at(pointer);
  return document.value().contains(at) && document.value().at(at).is_number();
}

std::vector<UncertainInput> read_input_list(const JsonView& place, const References& references) {
  std::vector<UncertainInput> inputs;
  const Document& document = place.document();
  for (const auto& [name, entry] : place.entries()) {
    UncertainInput input;
    input.name = name;
    input.nominal = entry.get("nominal", false);
    if (entry.has("half_width") == entry.has("reference"))
      throw entry.error("expected either 'half_width' or 'reference' of an uncertain input");
    if (entry.has("reference")) {
      const references::Reference& reference = references.get(entry["reference"]);
      input.half_width = reference.uncertainty.at(0);
      if (!reference.printed.empty())
        input.why = "half a unit in the last place of '" + reference.printed[0] + "'";
    } else {
      input.half_width = entry.number("half_width");
    }
    const auto why = entry.get<std::string>("why", "");
    if (!why.empty()) input.why += (input.why.empty() ? "" : "; ") + why;
    for (const auto& [number, at] : entry["pointers"].entries()) {
      require_pointer(document, at);
      const auto pointer = at.get<std::string>();
      if (is_number(document, pointer)) input.pointers.push_back(pointer);
    }
    if (!input.pointers.empty()) inputs.push_back(std::move(input));
  }
  return inputs;
}

class ValidationStudy {
 public:
  ValidationStudy(const Document& document, const Quantities& quantities,
                  const std::vector<Check>& checks, const References& references)
      : document_(document),
        stated_(JsonView(document)["uncertainty"]),
        references_(references),
        quantities_(quantities),
        places_(compared_places(checks, JsonView(document), quantities, references)) {}

  std::optional<results::Uncertainty> run(const results::ErrorEstimates& errors) {
    if (places_.empty()) return std::nullopt;
    study_.inputs = uncertain_inputs(document_, references_);
    for (const Place& place : places_) study_.comparisons.push_back(start(place));
    take_errors(errors);
    derive();
    sample();
    evaluate_check();
    return std::move(study_);
  }

 private:
  [[nodiscard]] Comparison start(const Place& place) const {
    Comparison entry;
    entry.check = place.check->name;
    entry.quantity = place.check->quantity;
    entry.unit = place.reference->unit;
    entry.reference = place.reference->id;
    entry.index = static_cast<int>(place.index);
    entry.simulation = value_at_place(quantities_, place);
    entry.expected = place.reference->values[place.reference_index];
    entry.u_reference = place.reference->uncertainty[place.reference_index] / std::sqrt(3.0);
    for (const Place& other : places_) {
      const bool same = other.check->quantity == entry.quantity && other.index == place.index &&
                        other.reference_index == place.reference_index;
      if (!same || other.reference == place.reference) continue;
      entry.spread.emplace_back(other.reference->values[other.reference_index] - *entry.expected);
    }
    return entry;
  }

  /// Returns the values of all compared entries for a changed case; empty without a solution.
  [[nodiscard]] std::optional<std::vector<double>> values_of(const Document& document) const {
    try {
      const AnalysisResult result = analyze(document, references_, {false});
      if (!result.outcome.solved()) return std::nullopt;
      std::vector<double> values;
      for (const Place& place : places_) {
        values.push_back(value_at_place(result.quantities, place));
        if (!std::isfinite(values.back())) return std::nullopt;
      }
      return values;
    } catch (const InputError&) {
      return std::nullopt;  // pose out of reach, or invalid mechanism
    }
  }

  /// Sets the standard uncertainty of each compared entry due to the discretization error.
  void take_errors(const results::ErrorEstimates& errors) {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const auto* found = errors.find(places_[i].check->quantity);
      const double half_width =
          found == nullptr
              ? 0  // no discretization error
              : found->error_half_width(places_[i].index, value_at_place(quantities_, places_[i]))
                    .value_or(kNaN);
      study_.comparisons[i].u_num = half_width / kGciToStandard;
    }
  }

  /// Inputs that are varied, and the response of the model to offsets of these inputs.
  struct Variation {
    std::vector<const UncertainInput*> inputs;
    std::vector<double> half_widths;
    Response response;
  };

  /// @param literal  if true, also varies nominal inputs, as if their printed digits were uncertain
  [[nodiscard]] Variation vary(bool literal) const {
    Variation found;
    for (const UncertainInput& input : study_.inputs) {
      if (!literal && input.nominal) continue;
      found.inputs.push_back(&input);
      found.half_widths.push_back(*input.half_width);
    }
    found.response = [this, inputs = found.inputs](const std::vector<double>& offsets) {
      Document document = document_;
      for (std::size_t i = 0; i < inputs.size(); ++i)
        document =
            moved(document, inputs[i]->pointers, [&](double value) { return value + offsets[i]; });
      return values_of(document);
    };
    return found;
  }

  void derive() {
    const Variation all = vary(true);
    const auto found = uncertainty_by_derivatives(all.response, all.half_widths);
    if (!found)
      throw stated_["inputs"].error("the model has no solution near values of uncertain inputs");
    for (std::size_t i = 0; i < places_.size(); ++i) {
      Comparison& entry = study_.comparisons[i];
      double square = 0, literal = 0, largest = 0;
      for (std::size_t k = 0; k < all.inputs.size(); ++k) {
        const UncertainInput& input = *all.inputs[k];
        const double part = found->at(k)[i];
        literal += part * part;
        entry.contributions.emplace_back(input.name, part);
        if (input.nominal) continue;
        square += part * part;
        if (std::abs(part) <= largest) continue;
        largest = std::abs(part);
        entry.dominant_input = input.name;
      }
      entry.u_input = std::sqrt(square);
      entry.dominant_share = square > 0 ? largest * largest / square : 0;
      entry.all_inputs.u_input = std::sqrt(literal);
    }
  }

  void sample() {
    const auto seed = stated_["seed"].get<std::uint64_t>();
    const auto draw = [&](bool literal, const char* key, int& samples, int& failed) {
      const Variation varied = vary(literal);
      const SampledUncertainty found = uncertainty_by_sampling(varied.response, varied.half_widths,
                                                               stated_[key].get<int>(), seed);
      samples = found.samples;
      failed = found.failed;
      for (std::size_t i = 0; i < found.standard.size(); ++i) {
        Comparison& entry = study_.comparisons[i];
        (literal ? entry.all_inputs : entry).u_input_sampled = found.standard[i];
      }
    };
    draw(false, "samples", study_.samples, study_.failed);
    draw(true, "samples_all_inputs", study_.samples_all_inputs, study_.failed_all_inputs);
  }

  /// Evaluates the comparisons of each check. The entries of a check form one row of the reference.
  void evaluate_check() {
    for (auto first = study_.comparisons.begin(); first != study_.comparisons.end();) {
      const auto end = std::find_if(first, study_.comparisons.end(), [&](const Comparison& entry) {
        return entry.check != first->check;
      });
      evaluate_validation_row({first, end});
      first = end;
    }
  }

  const Document& document_;
  JsonView stated_;
  const References& references_;
  const Quantities& quantities_;
  std::vector<Place> places_;
  results::Uncertainty study_;
};

}  // namespace

std::vector<results::UncertainInput> uncertain_inputs(const Document& document,
                                                      const References& references) {
  return read_input_list(JsonView(document)["uncertainty"]["inputs"], references);
}

std::optional<results::Uncertainty> evaluate_validation_uncertainty(
    const Document& document, const Quantities& quantities, const std::vector<Check>& checks,
    const results::ErrorEstimates& errors, const References& references) {
  return ValidationStudy(document, quantities, checks, references).run(errors);
}

}  // namespace trammel::harness

#pragma once

#include <array>

#include "harness/results/fields.h"
#include "harness/results/results.h"
#include "harness/results/side_comparison.h"

/// Keys and members of all structs of results.json. Writing and reading use the same list.
namespace trammel::results {

TRAMMEL_NAMES(Verdict, "pass", "fail", "error", "not-run", "recorded", "not-given");
TRAMMEL_NAMES(Expectation, "agrees", "known-discrepancy", "none");
TRAMMEL_NAMES(Status, "solved", "singular", "not-converged", "error", "not-run", "cannot",
              "not-exported", "crashed", "timed-out");

TRAMMEL_NAMES(Fault, "none", "input", "internal");

/// Writes the tolerance of a difference: t for +-t, or [low, high], in which null means no limit.
template <>
inline Json to_json(const Tolerance& tolerance, Form) {
  if (tolerance.symmetric) return to_json(tolerance.high);
  return Json::array({to_json(tolerance.low), to_json(tolerance.high)});
}

template <>
inline void from_json(const Json& json, const Place& place, Tolerance& tolerance) {
  if (json.is_number()) {
    const double high = json.get<double>();
    tolerance = {-high, high, true};
    return;
  }
  Numbers ends;
  if (!json.is_array() || json.size() != 2) place.fail("a number or two numbers");
  from_json(json, place, ends);
  tolerance = {ends[0], ends[1], false};
}

TRAMMEL_FIELDS(TwoTermLaw, TRAMMEL_REQUIRED(coefficients, max_relative_misfit, used));
inline std::string default_unit(const Check& check) {
  return harness::unit_of(check.quantity);
}
inline std::string default_role(const Check& check) {
  return check.expectation == Expectation::agrees ? "verification" : "validation";
}
inline std::string default_difference_measure(const Check& check) {
  return check.expected ? "relative" : "bound";
}
TRAMMEL_FIELDS(Check, TRAMMEL_REQUIRED(name, quantity), TRAMMEL_OPTIONAL(index, computed, expected),
               omitted_if_default("measure", &S::measure, default_difference_measure),
               omitted_if_default("difference", &S::difference, difference_of_check),
               TRAMMEL_REQUIRED(tolerance, why, verdict),
               omitted_if_default("unit", &S::unit, default_unit), TRAMMEL_OPTIONAL(expectation),
               omitted_if_default("role", &S::role, default_role),
               TRAMMEL_OPTIONAL(title, message, statistic, reference, against_variant,
                                against_quantity));
TRAMMEL_FIELDS(Convergence,
               TRAMMEL_REQUIRED(sweep, parameter, quantity, index, values, exact, error, roundoff,
                                order, in_asymptotic_range, at_roundoff_floor, theory_order,
                                fitted_order, richardson, gci, safety_factor),
               TRAMMEL_OPTIONAL(statistic, reference, lower_order, two_term));
TRAMMEL_FIELDS(UncertainInput, TRAMMEL_REQUIRED(name, pointers, half_width, nominal, why));
TRAMMEL_FIELDS(ValidationVerdict,
               TRAMMEL_REQUIRED(u_input, u_input_sampled, u_val, interval, verdict, conclusion));
TRAMMEL_FIELDS(Comparison,
               TRAMMEL_REQUIRED(check, quantity, index, unit, reference, simulation, expected,
                                u_num, u_input, u_input_sampled, u_reference, contributions,
                                dominant_input, dominant_share, spread, difference, u_val, interval,
                                verdict, conclusion, all_inputs));
TRAMMEL_FIELDS(Uncertainty, TRAMMEL_REQUIRED(inputs, samples, failed, samples_all_inputs,
                                             failed_all_inputs, comparisons));
TRAMMEL_FIELDS(Joint, TRAMMEL_REQUIRED(node, kind, name));
TRAMMEL_FIELDS(Shape, required("displacement_m", &S::displacement), TRAMMEL_REQUIRED(label));
TRAMMEL_FIELDS(Pose, required("nodes_m", &S::nodes), TRAMMEL_REQUIRED(label),
               TRAMMEL_OPTIONAL(time_s), optional("displacement_m", &S::displacement));
TRAMMEL_FIELDS(DrawnForce, TRAMMEL_REQUIRED(node, x, y, unit));
TRAMMEL_FIELDS(Drawing, required("nodes_m", &S::nodes),
               TRAMMEL_REQUIRED(members, triangles, joints, shapes),
               TRAMMEL_OPTIONAL(poses, forces));
TRAMMEL_KEY(harness::EvaluationTime, name);
TRAMMEL_FIELDS(harness::EvaluationTime, required("per_evaluation_s", &S::wall_s),
               TRAMMEL_REQUIRED(evaluations));
TRAMMEL_FIELDS(Cost, TRAMMEL_REQUIRED(wall_s, cpu_s, counters),
               TRAMMEL_OPTIONAL(uncertainty_wall_s, timings));
TRAMMEL_FIELDS(EffectRow, required("effect", &S::name),
               TRAMMEL_REQUIRED(applicable, active, why, evaluations),
               TRAMMEL_OPTIONAL(dimensionless_number, number_definition, own_change,
                                cumulative_change));
TRAMMEL_FIELDS(ErrorEstimate, TRAMMEL_REQUIRED(quantity, relative, asymptotic),
               TRAMMEL_OPTIONAL(scale, order, setting));
TRAMMEL_FIELDS(AccuracyStep, TRAMMEL_REQUIRED(setting, error, cpu_s));
TRAMMEL_FIELDS(ErrorEstimates, TRAMMEL_REQUIRED(quantities, companions, counters),
               TRAMMEL_OPTIONAL(reason, search));
TRAMMEL_FIELDS(ReadingClass, TRAMMEL_REQUIRED(title, readings, probability, values));
TRAMMEL_KEY(FurtherNumber, name);
TRAMMEL_FIELDS(FurtherNumber, TRAMMEL_REQUIRED(expected_information_bits));
TRAMMEL_FIELDS(RowProbabilities, TRAMMEL_REQUIRED(row, reference, unit, discrepancy, log_evidence,
                                                  entropy_bits, printed, readings, classes,
                                                  credible_classes, leading, further_numbers));
TRAMMEL_FIELDS(ExcludedReadings, TRAMMEL_REQUIRED(reason, first, readings));
TRAMMEL_FIELDS(ModelProbabilities, TRAMMEL_REQUIRED(rows, excluded));

/// Writes the quantities of a run. The form `store` is an array with the name, values and round-off
/// errors of each quantity in turn, because an object would compare hundreds of names. The other
/// forms are objects with an array of values for each quantity.
template <>
inline Json to_json(const harness::Quantities& quantities, Form form) {
  Json json = form == Form::store ? Json::array() : Json::object();
  if (form != Form::store) json.get_ref<Json::object_t&>().reserve(quantities.size());
  for (const auto& [name, quantity] : quantities) {
    if (form == Form::store) {
      json.push_back(name);
      json.push_back(detail::pack(quantity.values));
      json.push_back(detail::pack(quantity.roundoff));
    } else if (form == Form::text || quantity.values.size() <= kSummaryEntries) {
      json.get_ref<Json::object_t&>().emplace_back(name, to_json(quantity.values, form));
    }
  }
  return json;
}

template <>
inline void from_json(const Json& json, const Place& place, harness::Quantities& quantities) {
  quantities.clear();
  if (json.is_object()) {
    for (const auto& [name, entries] : json.items()) {
      Numbers numbers;
      from_json(entries, Place{&place, name}, numbers);
      std::vector<double>& values = quantities[name].values;
      for (const Number number : numbers) values.push_back(*number);
    }
    return;
  }
  if (!json.is_array() || json.size() % 3 != 0) place.fail("an object");
  for (std::size_t i = 0; i < json.size(); i += 3) {
    std::string name;
    harness::Quantity quantity;
    from_json(json[i], place, name);
    from_json(json[i + 1], place, quantity.values);
    from_json(json[i + 2], place, quantity.roundoff);
    quantities.emplace_hint(quantities.end(), std::move(name), std::move(quantity));
  }
}

TRAMMEL_FIELDS(SweepLevel, TRAMMEL_REQUIRED(parameter, quantities));
TRAMMEL_FIELDS(Sweep, TRAMMEL_REQUIRED(name, levels));
TRAMMEL_FIELDS(SolverIdentity, TRAMMEL_REQUIRED(name),
               TRAMMEL_OPTIONAL(version, element_order, digits));
TRAMMEL_FIELDS(Run, required("case", &S::case_id),
               TRAMMEL_REQUIRED(variant, status, quantities, checks, cost),
               TRAMMEL_OPTIONAL(reason), TRAMMEL_STORED(convergence),
               TRAMMEL_OPTIONAL(residuals, warnings, errors),
               TRAMMEL_STORED(uncertainty, effects, model_probabilities, drawing),
               TRAMMEL_OPTIONAL(stored),
               TRAMMEL_STORE_ONLY(sweeps, references, machine, solver, fault));
/// Writes a run. If the run has no file in the store, even a summary contains its series.
template <>
inline Json to_json(const Run& run, Form form) {
  return detail::object_to_json(run,
                                run.stored.empty() && form == Form::summary ? Form::text : form);
}
TRAMMEL_NAMES(SandboxedRun::Termination, "failed", "solved", "timed-out");
TRAMMEL_FIELDS(SandboxedRun, TRAMMEL_REQUIRED(termination, values, quantities, counters, cpu_s),
               TRAMMEL_OPTIONAL(reason));
TRAMMEL_FIELDS(ErrorNorms, TRAMMEL_REQUIRED(max, rms, mean));
TRAMMEL_FIELDS(SettingTime, TRAMMEL_REQUIRED(cpu_s, relative_low, relative_high, wall_median_s,
                                             runs_per_measurement));
TRAMMEL_FIELDS(CostSetting, required("error", &S::errors), required("relative_time", &S::relative),
               TRAMMEL_REQUIRED(curve, curve_title, title, value, status, reason, cpu_s, time,
                                counters, pareto_optimal),
               TRAMMEL_STORE_ONLY(output_errors));
TRAMMEL_FIELDS(CheapestSetting, TRAMMEL_REQUIRED(error, setting, tied));
TRAMMEL_FIELDS(CostOutput, TRAMMEL_REQUIRED(title, scale, errors, cheapest));
TRAMMEL_FIELDS(CostStudy,
               TRAMMEL_REQUIRED(id, family, title, reference_solution, scale, norm, baseline,
                                wall_s, settings, cheapest, repeatability, conclusion),
               TRAMMEL_OPTIONAL(description, outputs), TRAMMEL_STORE_ONLY(references));
TRAMMEL_FIELDS(CostStudies,
               TRAMMEL_REQUIRED(sweep, seed, repeats, equal_within, diverged_above, studies));
TRAMMEL_FIELDS(Environment,
               TRAMMEL_REQUIRED(trammel, commit, date, compiler, flags, build_type, libraries,
                                processor, cores, system),
               TRAMMEL_OPTIONAL(stored_runs));
TRAMMEL_KEY(PlotRequest::Line, title);
TRAMMEL_FIELDS(PlotRequest::Line, TRAMMEL_REQUIRED(x, y));
TRAMMEL_KEY(PlotRequest, id);
TRAMMEL_FIELDS(PlotRequest, TRAMMEL_REQUIRED(y),
               TRAMMEL_OPTIONAL(title, x, variants, log, value, lines, caption));
TRAMMEL_KEY(ColumnRequest, id);
TRAMMEL_FIELDS(ColumnRequest, TRAMMEL_REQUIRED(title),
               TRAMMEL_OPTIONAL(quantity, statistic, timing, over_timing));
TRAMMEL_KEY(TableRequest, id);
TRAMMEL_FIELDS(TableRequest, TRAMMEL_REQUIRED(columns), TRAMMEL_OPTIONAL(title, variants, caption));
TRAMMEL_FIELDS(StressSuiteEntry, TRAMMEL_REQUIRED(item, indicators));
TRAMMEL_KEY(Variant, id);
TRAMMEL_FIELDS(Variant, TRAMMEL_REQUIRED(title));
TRAMMEL_KEY(CaseInput, path);
TRAMMEL_FIELDS(CaseInput, TRAMMEL_REQUIRED(value), TRAMMEL_OPTIONAL(source));
TRAMMEL_KEY(CaseInfo, id);
TRAMMEL_FIELDS(CaseInfo, TRAMMEL_REQUIRED(title, variants),
               TRAMMEL_OPTIONAL(description, family, labels, stress_suite, figures, tables,
                                analysis, hash, inputs, file));
TRAMMEL_FIELDS(Solver, TRAMMEL_REQUIRED(name, version, command));
TRAMMEL_KEY(Reference, id);
TRAMMEL_FIELDS(Reference, TRAMMEL_REQUIRED(title, kind, unit, values, uncertainty, citation, place),
               TRAMMEL_OPTIONAL(doi, printed, derivation, errata, ambiguities, notes));
TRAMMEL_FIELDS(UncertaintyCoverage,
               TRAMMEL_REQUIRED(levels, covered, coverage, min_coverage, median_ratio,
                                max_median_ratio, min_levels, passes));
TRAMMEL_FIELDS(ClaimEntry, required("case", &S::case_id), TRAMMEL_REQUIRED(variant, name, value));
TRAMMEL_FIELDS(ClaimInterpretation, TRAMMEL_REQUIRED(description, metric, unit, verdict, entries));
TRAMMEL_FIELDS(Claim, TRAMMEL_OPTIONAL(title),
               TRAMMEL_REQUIRED(id, claim, place, verdict, expected, conclusion, undecidable,
                                interpretations));
TRAMMEL_FIELDS(PaperItem::Counterpart, required("case", &S::case_id),
               TRAMMEL_OPTIONAL(variant, quantity, figure, verdict));
TRAMMEL_FIELDS(PaperItem, TRAMMEL_REQUIRED(id, section, what),
               TRAMMEL_OPTIONAL(shown_by, claims, reason, note));
TRAMMEL_FIELDS(Claims, TRAMMEL_REQUIRED(title, as_recorded, claims), TRAMMEL_OPTIONAL(items));
TRAMMEL_FIELDS(CoverageRow, TRAMMEL_REQUIRED(group, feature, evidence),
               TRAMMEL_OPTIONAL(reason, series, judged));
TRAMMEL_FIELDS(EffectScene,
               TRAMMEL_REQUIRED(scene, analysis, chosen, tolerance, change, minimal, whole_s,
                                chosen_s, deciding_s, work_ratio, deciding_work_ratio),
               TRAMMEL_OPTIONAL(mesh_change, beyond_tier));
TRAMMEL_FIELDS(HistoryCall,
               TRAMMEL_REQUIRED(id, date, commit, machine, runs, checks, failures, cpu_s, work));
TRAMMEL_FIELDS(HistoryChange,
               TRAMMEL_REQUIRED(name, verdict_before, verdict, before, after, commit, date));
TRAMMEL_FIELDS(HistoryDrift, TRAMMEL_REQUIRED(name, steps, first, last));
TRAMMEL_FIELDS(History, TRAMMEL_REQUIRED(calls, since, changes, work, drifts));
TRAMMEL_FIELDS(Results, optional("numerical_uncertainty", &S::uncertainty_coverage),
               TRAMMEL_REQUIRED(format, environment, cases, references, runs),
               TRAMMEL_OPTIONAL(solver, cost, claims, coverage, effect_scenes, history, store));
TRAMMEL_FIELDS(ComparedNumber, TRAMMEL_REQUIRED(quantity, index, entries, values, percent, errors,
                                                noise, share, changed));
TRAMMEL_FIELDS(ComparedModes, TRAMMEL_REQUIRED(modes, values, last, percent, errors, alike, noise,
                                               share, changed));
TRAMMEL_FIELDS(ComparedRun, TRAMMEL_REQUIRED(name, changed, share, numbers),
               TRAMMEL_OPTIONAL(modes, remarks));
TRAMMEL_FIELDS(ComparedSide,
               TRAMMEL_REQUIRED(label, runs, cpu_s, relative_time, work, median_error,
                                largest_error),
               TRAMMEL_OPTIONAL(commit, date, processor, solver));
TRAMMEL_FIELDS(SideComparison,
               TRAMMEL_REQUIRED(conclusion, sides, same, within_noise, changed, runs));

}  // namespace trammel::results

#pragma once

#include "harness/analysis/analysis.h"
#include "harness/analysis/recorder.h"
#include "harness/input/case.h"
#include "harness/scene/case_model.h"
#include "solver/manipulator/elastodynamics.h"
#include "solver/statics/statics.h"

/// The analyses, one source each. Each adds what it finds at one step of the scene's path, or along
/// the whole of it.
namespace trammel::harness {

/// What an analysis of one step leaves behind.
struct StepResult {
  solver::Outcome outcome;
  solver::Counters counters;
  std::optional<Drawing> drawing;  ///< on the first step, when asked for
  std::vector<EvaluationTime> timings = {};
};

/// Time and pose of a step of the path; nothing where there is none.
void record_path(const CaseModel& case_model, std::size_t step, Recorder& record);

/// The outcome of a step, its reason naming the point of the path.
[[nodiscard]] solver::Outcome at_point(const CaseModel& case_model, std::size_t step,
                                       solver::Outcome outcome);

/// Natural frequencies, at rest, under the model's loads or in a rotating frame; along a path one
/// quantity a mode, frequency_Hz:1 ...
[[nodiscard]] StepResult analyse_modes(const JsonView& analysis, const CaseModel& case_model,
                                       std::size_t step, bool draw, Recorder& record);

/// Displacements, end rotations, reactions, section forces, stresses, residuals.
[[nodiscard]] StepResult analyse_statics(const CaseModel& case_model, std::size_t step, bool draw,
                                         Recorder& record);

/// Multiples of all loads together at which the model buckles, and what they make of each force.
[[nodiscard]] StepResult analyse_buckling(const JsonView& analysis, const CaseModel& case_model,
                                          std::size_t step, bool draw, Recorder& record);

/// The same in large motion, at each load factor or along the whole path: geometrically exact.
[[nodiscard]] StepResult analyse_large_statics(const JsonView& analysis,
                                               const CaseModel& case_model, std::size_t step,
                                               bool draw, Recorder& record);

/// Motion in time of a geometrically exact model: one number an output time.
[[nodiscard]] StepResult analyse_large_motion(const JsonView& analysis, const CaseModel& case_model,
                                              bool draw, Recorder& record);

/// Adds what a solution says of nodes, members, supports and plates.
/// @param roundoff  relative; negative: not known
void record_solution(const solver::Model& model, const solver::StaticSolution& solution,
                     double roundoff, Recorder& record);

/// Amplitudes of the outputs over frequency, and their peaks.
[[nodiscard]] StepResult analyse_harmonic(const JsonView& analysis, const CaseModel& case_model,
                                          std::size_t step, bool draw, Recorder& record);

/// The outputs over time, and their peaks.
[[nodiscard]] StepResult analyse_transient(const JsonView& analysis, const CaseModel& case_model,
                                           std::size_t step, bool draw, Recorder& record);

/// Joint angles, closure, distances from singularities, holding torques.
[[nodiscard]] StepResult analyse_kinematics(const CaseModel& case_model, std::size_t step,
                                            bool draw, Recorder& record);

/// Torques along the whole path, motions of all links, power balance, residuals of the properties
/// of Eq. 4, 5, work over a turn.
[[nodiscard]] StepResult analyse_inverse_dynamics(const JsonView& analysis,
                                                  const CaseModel& case_model, bool draw,
                                                  Recorder& record);

/// Elastic vibration about the nominal motion along the path: deflection and error of P, joint
/// rotations, section forces, stresses, reactions, torques beside those of rigid links, energies.
[[nodiscard]] StepResult analyse_elastodynamics(const JsonView& analysis,
                                                const CaseModel& case_model, bool draw,
                                                Recorder& record);

/// The motion that a case of elastodynamics describes, with the scene's effects.
/// @throws InputError  where something stands beside the manipulator or the trajectory has no time.
[[nodiscard]] solver::ElastodynamicsOptions read_elastodynamics(const JsonView& analysis,
                                                                const CaseModel& case_model);

/// Derivatives of the natural frequencies with respect to the design, at one pose.
[[nodiscard]] StepResult analyse_sensitivity(const JsonView& analysis, const CaseModel& case_model,
                                             bool draw, Recorder& record);

/// The first elastic frequency and its derivative over the workspace, for some orientations.
[[nodiscard]] StepResult analyse_sensitivity_map(const JsonView& analysis,
                                                 const CaseModel& case_model, Recorder& record);

/// From torques back to the motion: those of the inverse dynamics of the path, or constant ones.
[[nodiscard]] StepResult analyse_forward_dynamics(const JsonView& analysis,
                                                  const CaseModel& case_model, bool draw,
                                                  Recorder& record);

/// A general regression neural network, on samples of its own or on those of the inverse dynamics
/// along the scene's path (where `case_model` is one): smoothing, predictions, errors, skill,
/// times.
[[nodiscard]] StepResult analyse_grnn(const JsonView& analysis,
                                      const std::optional<CaseModel>& case_model, bool draw,
                                      Recorder& record);

/// Lengths, masses, centres and inertias of the parts and of the whole.
[[nodiscard]] StepResult analyse_properties(const CaseModel& case_model, std::size_t step,
                                            bool draw, Recorder& record);

/// Relative error norms of a manufactured solution on one mesh; needs no scene.
[[nodiscard]] StepResult analyse_manufactured(const JsonView& manufactured, bool draw,
                                              Recorder& record);

/// Another analysis at each value of a parameter: every quantity kept has one number a value.
[[nodiscard]] StepResult analyse_study(const Document& document, const References& references,
                                       bool draw, Recorder& record);

/// The levels of a study, each with the inner analysis in the study's place.
[[nodiscard]] std::vector<Level> study_levels(const Document& document);

/// Every combination of some options tried on the variants and levels of other cases: how they end,
/// how many numbers are none, how many reasons lack words, how far apart are those that must agree.
void analyse_options(const Document& document, const References& references, Recorder& record);

/// relative_difference and difference_percent of references from each other, by name.
void compare_references(const JsonView& comparison, const References& references, Recorder& record);

}  // namespace trammel::harness

#pragma once

#include <string>
#include <vector>

#include "harness/studies/cost_study.h"
#include "harness/studies/discretization_error.h"

/// Searches for the mesh and the time step with which the results of a case reach a requested
/// accuracy.
namespace trammel::harness {

struct AccuracyRequest {
  double accuracy = 1e-3;  ///< largest relative error, > 0
  /// Names of the quantities that must reach the accuracy, with or without the part after the
  /// colon. If empty: frequencies, load factors, displacements and positions, or all quantities if
  /// the case computes none of these.
  std::vector<std::string> quantities;
  double time_limit_s = 120;  ///< limit of the processor time of the search
};

struct AccuracySearch {
  std::vector<Document> tried;  ///< all computed discretizations, coarse to fine
  /// Result with the last discretization if it is accurate enough, else with the most accurate one.
  AnalysisResult result;
  results::ErrorEstimates errors;
  std::vector<std::string> asked;  ///< names of the quantities that must be accurate; empty: all
  bool reached = false;
};

/// Returns true if the analysis uses a mesh or time steps, so that its accuracy can be chosen.
[[nodiscard]] bool has_mesh_or_time_steps(const Document& document);

/// Refines mesh and time step until the estimated error is at most `accuracy`. Starts from a coarse
/// discretization: up to four times the case's time step, and the case's numbers of elements,
/// halved until one of them is odd. Then refines the source of the larger error, mesh or time step.
/// Beam theory and analysis remain unchanged. The results on each refinement level also serve for
/// the error estimate of the next level.
/// @throws InputError  if the case has neither mesh nor time steps, no solution, or no estimated
///   error of a requested quantity.
[[nodiscard]] AccuracySearch search_accuracy(const Document& document,
                                             const AccuracyRequest& request,
                                             const References& references);

/// Returns a cost study of the discretizations tried by a search. The reference solution has twice
/// the elements and half the time step of the last discretization.
[[nodiscard]] CostStudy cost_study_of_search(const Case& given, const std::string& variant,
                                             const AccuracySearch& search,
                                             const AccuracyRequest& request);

}  // namespace trammel::harness

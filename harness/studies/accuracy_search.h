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
  /// Names of quantities, with or without the part after the colon. If empty: frequencies, load
  /// factors, displacements and positions, or all quantities if the case computes none of these.
  std::vector<std::string> quantities;
  double time_limit_s = 120;  ///< limit of the processor time of the search
};

struct AccuracySearch {
  std::vector<Document> tried;  ///< all settings, coarse to fine; the last one is chosen
  AnalysisResult result;        ///< result of the chosen setting
  results::ErrorEstimates errors;
  std::vector<std::string> asked;  ///< names of the quantities that must be accurate; empty: all
  bool reached = false;
};

/// Refines mesh and time step until the estimated error is at most `accuracy`. Starts from up to
/// four times the time step, and from numbers of elements that are halved until one of them is odd.
/// Then refines the source of the larger error, mesh or time step. Beam theory and analysis are
/// kept. Each level also serves for the error estimate of the next level.
/// @throws InputError  if the case has no mesh or steps, no solution or no such quantity.
[[nodiscard]] AccuracySearch search_accuracy(const Document& document,
                                             const AccuracyRequest& request,
                                             const References& references);

/// Returns the settings of a search as a cost study. The reference solution has twice the elements
/// and half the step of the last setting.
[[nodiscard]] CostStudy cost_study_of_search(const Case& given, const std::string& variant,
                                             const AccuracySearch& search,
                                             const AccuracyRequest& request);

}  // namespace trammel::harness

#pragma once

#include <string>
#include <vector>

#include "harness/studies/cost_study.h"
#include "harness/studies/discretization_error.h"

/// The mesh and the step with which a case reaches an accuracy.
namespace trammel::harness {

struct AccuracyRequest {
  double accuracy = 1e-3;  ///< largest relative error, > 0
  /// Names, or names before the colon; empty: frequencies, load factors, displacements and
  /// positions, or all quantities if there are none of these.
  std::vector<std::string> quantities;
  double time_limit_s = 120;  ///< of processor time
};

struct AccuracySearch {
  std::vector<Document> tried;  ///< coarse to fine; the last one is chosen
  AnalysisResult result;        ///< of the last one
  results::ErrorEstimates errors;
  std::vector<std::string> asked;  ///< names of the quantities; empty: all
  bool reached = false;
};

/// From one element a member and four times the step, refines what makes the larger error until the
/// estimate is below the request. Beam theory and tier of statics stay. Each level is the companion
/// of the next one, so that no computation is made for an estimate alone.
/// @throws InputError  where the case has neither mesh nor steps, no solution or no such quantity.
[[nodiscard]] AccuracySearch search_accuracy(const Document& document,
                                             const AccuracyRequest& request,
                                             const References& references);

/// The settings that a search has tried as a study, measured against twice the elements and half
/// the step of the last one.
[[nodiscard]] CostStudy cost_study_of_search(const Case& given, const std::string& variant,
                                             const AccuracySearch& search,
                                             const AccuracyRequest& request);

}  // namespace trammel::harness

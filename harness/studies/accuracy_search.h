#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/input/case.h"
#include "harness/studies/cost_study.h"

/// Which settings of a case reach an accuracy: mesh, beam theory, tier of statics, integrator and
/// step are varied as far as the analysis has them, without a study being written.
namespace trammel::harness {

struct AccuracyRequest {
  double accuracy = 1e-3;               ///< largest relative error, > 0
  std::vector<std::string> quantities;  ///< names, or names before the colon; empty: displacements,
                                        ///< positions, frequencies or load factors
  double time_limit_s = 120;            ///< of the whole search
};

struct TriedSetting {
  std::string title;
  Json patch;  ///< merge patch of the case
  double error = 0;
  std::string reason;  ///< without a solution: why
};

struct AccuracySearch {
  /// The case as it stands, which is the baseline, and the coarsest settings of each kind that are
  /// within the accuracy; errors are measured against the richest model that is solved, on a mesh
  /// and with a step that no longer change it.
  CostStudy study;
  std::vector<Json> patches;  ///< of the study's settings
  std::vector<TriedSetting> tried;
  double reference_change = 0;  ///< what the last refinement changed the reference by, relative
  bool out_of_time = false;     ///< not everything was tried
};

/// How a setting is computed within so many seconds of processor time: in a process of its own.
using ComputeSetting = std::function<SandboxedRun(const Setting& setting, int time_limit_s)>;

/// @param progress  gets how many settings were tried
/// @throws InputError  where the case itself is not solved, has no such quantity or nothing of it
///                     can be varied.
[[nodiscard]] AccuracySearch search_accuracy(const Case& given, const std::string& variant,
                                             const AccuracyRequest& request,
                                             const ComputeSetting& compute,
                                             const std::function<void(std::size_t)>& progress);

}  // namespace trammel::harness

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "harness/base/json.h"
#include "solver/large/large_motion_model.h"
#include "solver/model/model.h"

/// A built model as a case file says it, with nothing left to resolve: every node has a name,
/// sections have numbers, what was tapered is a chain of uniform members, and what was spread over
/// edges stands at nodes.
namespace trammel::harness {

/// Names that a built model has lost.
struct WrittenNames {
  std::vector<std::pair<std::string, solver::Material>> materials;
  std::vector<std::string> loads;  ///< of the first `Model::loads`
};

/// The value of a case's "model".
/// @param model  without the linear constraints of its sliders, which `joints` has
/// @throws ModelError  where a case file has no words for a part, or two have one name.
[[nodiscard]] Json model_json(solver::Model model,
                              const solver::large_motion::LargeMotionModel& joints,
                              const WrittenNames& names);

/// Whether the member's section varies along it.
[[nodiscard]] bool is_tapered(const solver::Member& member);

}  // namespace trammel::harness

#include "solver/effects/axial_constraints.h"

#include "solver/assembly/constraints.h"
#include "solver/assembly/restrict_model_effects.h"

namespace trammel::solver {

bool is_axially_overconstrained(const Model& model) {
  const Model stiff = restrict_effects(model, Effects::all().without(Effect::axial_flexibility));
  const Constraints constraints = build_constraints(stiff, discretise(stiff));
  for (std::size_t i = 0; i < constraints.rows.size(); ++i) {
    const bool along = constraints.rows[i].source == ConstraintRow::Source::inextensible;
    if (along && constraints.pivot[i] < 0) return true;
  }
  return false;
}

}  // namespace trammel::solver

#pragma once

#include "solver/large/geometrically_exact_system.h"
#include "solver/large/large_motion_model.h"
#include "tests/support/solver/frames.h"

/// Models with large displacements that several tests of the solver share.
namespace trammel::testing {

using namespace solver;

using large_motion::GeometricallyExactSystem;
using large_motion::LargeMotionModel;
using large_motion::State;

/// Returns the elastica: an inextensible Euler-Bernoulli cantilever of length 1 with EI = 1.
inline Model elastica(Index elements, double angle = 0) {
  Model model = cantilever(unit_section(), 1, elements, angle);
  model.members[0].axially_flexible = false;
  return model;
}

/// IFToMM A01: 1 kg at the end of a massless rod of 1 m, released with the rod horizontal.
inline Model simple_pendulum() {
  Model model;
  model.nodes = {{"O", {0, 0}}, {"B", {-1, 0}}};
  model.supports = {pin(0)};
  model.rigid_bodies = {{"rod", 0, {1}}};
  model.masses = {{1, 1.0, 0, {0, 0}}};
  model.gravity = {0, -9.81};
  return model;
}

}  // namespace trammel::testing

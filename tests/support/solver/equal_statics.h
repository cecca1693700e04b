#pragma once

#include <boost/test/unit_test.hpp>

#include "solver/manipulator/elastodynamics.h"
#include "solver/manipulator/manipulator.h"

namespace trammel::solver {

/// Returns a static model of the manipulator at one point of its path, with the load at P and
/// gravity.
inline Model static_model(const ElastodynamicsOptions& options, const TrajectoryPoint& point) {
  Model model = build_manipulator(options.design, point.pose);
  model.loads.push_back({model.find_node("P"), options.wrench});
  model.gravity = options.gravity;
  return model;
}

/// Compares two static solutions: displacements, rotations of the members' ends, reactions, and
/// resultants (forces and moments at the members' ends). Rotations of nodes are compared if all
/// nodes have a rotation. Tolerances are relative: `motion` for displacements and rotations,
/// `force` for reactions and resultants.
inline void check_equal_statics(const StaticSolution& found, const StaticSolution& expected,
                                double motion, double force) {
  const auto check = [](const char* what, const auto& value, const auto& truth, double share) {
    BOOST_TEST((value - truth).norm() < share * truth.norm(), what);
  };
  const Index columns = expected.displacement.allFinite() ? 3 : 2;
  check("displacement", found.displacement.leftCols(columns),
        expected.displacement.leftCols(columns), motion);
  check("rotation of members' ends", found.end_rotation, expected.end_rotation, motion);
  check("reaction", found.reaction, expected.reaction, force);
  check("resultant at the start", found.resultant_start, expected.resultant_start, force);
  check("resultant at the end", found.resultant_end, expected.resultant_end, force);
}

}  // namespace trammel::solver

#include "solver/sensitivity/sensitivity_map.h"

namespace trammel::solver {

FirstFrequency first_frequency(const ManipulatorDesign& design, const DesignParameter& parameter,
                               const Pose& pose) {
  FirstFrequency first{
      .outcome = {}, .evidence = {}, .frequency = kNaN, .derivative = kNaN, .counters = {}};
  for (Index count = 1;; count *= 2) {
    const FrequencySensitivity s = frequency_sensitivity(design, pose, {parameter}, count);
    first.counters += s.counters;
    first.outcome = s.outcome;
    first.evidence = s.evidence;
    const auto rigid = (s.frequency.array() == 0).count();
    if (rigid < s.frequency.size()) {
      first.frequency = s.frequency[rigid];
      first.derivative = s.derivative(rigid, 0);
      return first;
    }
    if (rigid < count) break;
  }
  if (first.outcome.solved()) first.outcome = {Status::singular, "every motion is rigid"};
  return first;
}

SensitivityMap map_first_frequency(const ManipulatorDesign& design,
                                   const DesignParameter& parameter, const PoseGrid& grid) {
  SensitivityMap map;
  map.grid = grid;
  for (Eigen::MatrixXd* m : {&map.frequency, &map.derivative, &map.serial_distance})
    m->setConstant(grid.rows, grid.columns, kNaN);
  for (Index j = 0; j < grid.rows; ++j) {
    for (Index i = 0; i < grid.columns; ++i) {
      const Pose pose = grid.pose(j, i);
      const Posture posture = inverse_kinematics(design.geometry, pose);
      if (!posture.outcome.solved()) continue;
      map.serial_distance(j, i) = jacobians(design.geometry, pose, posture).serial_distance;
      const FirstFrequency first = first_frequency(design, parameter, pose);
      map.frequency(j, i) = first.frequency;
      map.derivative(j, i) = first.derivative;
      map.counters += first.counters;
      if (first.outcome.solved()) map.evidence.add(first.evidence);
    }
  }
  return map;
}

}  // namespace trammel::solver

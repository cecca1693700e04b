#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "solver/elastodynamics/elastodynamics.h"
#include "solver/elastodynamics/motion_postprocessing.h"
#include "solver/elastodynamics/path_follower.h"

namespace trammel::solver {

/// Sets what the deflection is along the path and to its left.
void set_path_errors(ElastodynamicsSolution& solution);

/// Fills an ElastodynamicsSolution sample by sample.
class ElastodynamicsRecorder {
 public:
  ElastodynamicsRecorder(const ElastodynamicsOptions& options, PathFollower& follower,
                         ElastodynamicsSolution& solution)
      : options_(options), follower_(follower), solution_(solution) {}

  /// Moves the follower to `time`; records nothing where there is no pose.
  /// @param q, v, a  free coordinates of the elastic displacements and their rates
  /// @param load_time  whose loads act on them, where that is not `time`
  /// @param interpolated  as in MotionSample: out of balance by the error of interpolation
  void record(double time, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
              const Eigen::VectorXd& a, const MotionEnergy& energy,
              std::optional<double> load_time = std::nullopt, bool interpolated = false);
  /// Balance of the end of a step inside which samples lie.
  void add_balance(double load_time, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                   const Eigen::VectorXd& a);
  /// Stacks what the samples have given.
  void finish();
  /// What is left of all forces on the whole, over them.
  [[nodiscard]] double balance() const { return balance_.share(); }

 private:
  /// At the pose the follower is at.
  [[nodiscard]] StaticSolution state_of(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                        const Eigen::VectorXd& a, WholeBalance& balance) const;
  [[nodiscard]] Vector2d quasi_static_displacement(Index node);
  void update_effect_numbers();

  const ElastodynamicsOptions& options_;
  PathFollower& follower_;
  ElastodynamicsSolution& solution_;
  WholeBalance balance_;
  std::vector<double> rotation_;
  std::vector<Vector2d> deflection_, quasi_static_;
  std::vector<Vector3d> torque_, rigid_torque_;
  double inertia_ = 0, max_angular_velocity_ = 0, max_velocity_ = 0, max_acceleration_ = 0;
};

}  // namespace trammel::solver

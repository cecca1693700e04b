#pragma once

#include <string>
#include <vector>

#include "harness/base/recorder.h"
#include "harness/input/json_view.h"
#include "solver/linear/statics.h"

/// Table of the quantities of nodes, members, supports and plates as functions of a model's state.
/// Analyses record these quantities, and the key "outputs" of a case selects some of them.
/// results/quantities.txt documents each quantity and the kinds of analysis that compute it.
namespace trammel::harness {

/// State of a model at one time, or amplitudes of its vibration. An analysis sets only the matrices
/// that its quantities require.
struct ModelState : solver::StaticSolution {
  Eigen::MatrixX3d velocity = {}, acceleration = {};  ///< one row (x, y, rotation) per node
  Eigen::MatrixX3d relative = {};  ///< displacement in axes that move and rotate with a node
};

/// Named node, member, end of a member, plate or set of supports.
struct ModelPart {
  std::string name;
  std::vector<solver::Index> items;  ///< indices of nodes, members, supports or triangles
  solver::Index end = 0;             ///< index of the member's end, 0 or 1
};

struct Observable {
  enum class Of { node, member, member_end, support, plate };
  const char* name;
  Of of;
  /// Function that computes the quantity for a part of the model. It returns NaN if the part does
  /// not have the quantity.
  double (*value)(const solver::Model&, const ModelState&, const ModelPart&);
  bool is_force = false;     ///< true: the quantity has the round-off error of forces
  bool is_optional = false;  ///< true: omitted for parts with the value NaN
};

/// Records the quantities of an analysis for all parts of a model. The model must outlive the
/// recorder.
class StateRecorder {
 public:
  /// @param nodes    nodes to record; null: all
  /// @param without  names of observables that are not recorded
  StateRecorder(const solver::Model& model, const std::string& analysis,
                const std::vector<std::string>& without = {},
                const std::vector<solver::Index>* nodes = nullptr);

  /// @param displacement_roundoff, force_roundoff  relative round-off errors; negative: unknown
  void record(const ModelState& state, Recorder& record, double displacement_roundoff = -1,
              double force_roundoff = -1) const;

 private:
  struct Row {
    const Observable* observable;
    std::vector<ModelPart> parts;
  };
  const solver::Model& model_;
  std::vector<Row> rows_;
};

/// Quantity that the key "outputs" of a transient or harmonic analysis selects.
struct Output {
  std::string name;  ///< displacement_y_m:M, bending_moment_N_m:AB.start, stress_Pa:AB ...
  const Observable* observable = nullptr;
  ModelPart part;
  [[nodiscard]] double value(const solver::Model& model, const ModelState& state) const {
    return observable->value(model, state, part);
  }
};

[[nodiscard]] bool needs_forces(const std::vector<Output>& outputs);

/// Reads the quantities that the key "outputs" selects.
/// @throws InputError  for an unknown quantity or a part that the model does not have.
[[nodiscard]] std::vector<Output> read_outputs(const JsonView& outputs, const solver::Model& model);

}  // namespace trammel::harness

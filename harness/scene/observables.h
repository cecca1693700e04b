#pragma once

#include <string>
#include <vector>

#include "harness/base/recorder.h"
#include "harness/input/json_view.h"
#include "solver/linear/statics.h"

/// Table of the quantities of a model's parts as functions of its state. An analysis records its
/// states by this table, and the key "outputs" selects rows of it. results/quantities.txt documents
/// each row and the kinds of analysis that have it.
namespace trammel::harness {

/// State of a model at one moment, or amplitudes of its vibration. An analysis sets the members
/// that its quantities need.
struct ModelState : solver::StaticSolution {
  Eigen::MatrixX3d velocity = {}, acceleration = {};  ///< model node x (x, y, rotation)
  Eigen::MatrixX3d relative = {};  ///< displacement relative to a node that moves and rotates
};

/// Named node, member, end of a member, plate or set of supports.
struct ModelPart {
  std::string name;
  std::vector<solver::Index> items;  ///< nodes, members, supports, or triangles of the plate
  solver::Index end = 0;             ///< end of the member, 0 or 1
};

struct Observable {
  enum class Of { node, member, member_end, support, plate };
  const char* name;
  Of of;
  /// Returns NaN if the part has no such quantity.
  double (*value)(const solver::Model&, const ModelState&, const ModelPart&);
  bool is_force = false;     ///< computed from forces, whose round-off error applies
  bool is_optional = false;  ///< parts with the value NaN are omitted
};

/// Records the observables of an analysis for all parts of a model, which must outlive the
/// recorder.
class StateRecorder {
 public:
  /// @param nodes    nodes to record; null: all
  /// @param without  names of observables that are not recorded
  StateRecorder(const solver::Model& model, const std::string& analysis,
                const std::vector<std::string>& without = {},
                const std::vector<solver::Index>* nodes = nullptr);

  /// @param displacement_roundoff, force_roundoff  relative; negative: unknown
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

/// Returns true if the outputs need section forces.
[[nodiscard]] bool needs_forces(const std::vector<Output>& outputs);

/// Reads the outputs.
/// @throws InputError  for an unknown quantity or a part that the model does not have.
[[nodiscard]] std::vector<Output> read_outputs(const JsonView& outputs, const solver::Model& model);

}  // namespace trammel::harness

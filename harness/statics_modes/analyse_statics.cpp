#include "harness/statics_modes/analyse_statics.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "harness/statics_modes/range_warnings.h"
#include "solver/large/equilibrium.h"
#include "solver/linear/second_order.h"
#include "solver/linear/statics.h"
#include "solver/model/numbers.h"

namespace trammel::harness {
namespace {

/// Relative; negative: not known.
struct Roundoff {
  double displacement, force;
};

void record_nodes(const solver::Model& model, const solver::StaticSolution& solution,
                  double roundoff, Recorder& record) {
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const std::string& name = model.nodes[i].name;
    if (name.empty()) continue;  // inside a plate or a chain of members
    const Eigen::RowVector3d motion = solution.displacement.row(static_cast<solver::Index>(i));
    record.add("displacement_x_m", name, motion[0], roundoff);
    record.add("displacement_y_m", name, motion[1], roundoff);
    if (!std::isnan(motion[2])) record.add("rotation_rad", name, motion[2], roundoff);
  }
}

/// M / W at the ends of each member, with the sign of M: what the fibre on the right of the way
/// from the first to the second node feels.
void record_bending_stress(const solver::Model& model, const solver::StaticSolution& solution,
                           double roundoff, Recorder& record) {
  for (std::size_t i = 0; i < model.members.size(); ++i) {
    const solver::Member& member = model.members[i];
    const auto add = [&](const char* end, const solver::Section& section, double moment) {
      const double modulus = section.section_modulus;
      if (!(modulus > 0 && std::isfinite(modulus))) return;
      record.add("bending_stress_Pa", member.name + end, moment / modulus, roundoff);
    };
    const auto row = static_cast<solver::Index>(i);
    add(".start", member.section, solution.resultant_start(row, 2));
    add(".end", member.end_section, solution.resultant_end(row, 2));
  }
}

void record_members(const solver::Model& model, const solver::StaticSolution& solution,
                    Roundoff roundoff, Recorder& record) {
  for (std::size_t i = 0; i < model.members.size(); ++i) {
    const auto row = static_cast<solver::Index>(i);
    const std::string& name = model.members[i].name;
    const std::array<Eigen::RowVector3d, 2> resultants = {solution.resultant_start.row(row),
                                                          solution.resultant_end.row(row)};
    for (std::size_t end = 0; end < 2; ++end) {
      const std::string item = name + (end == 0 ? ".start" : ".end");
      const double rotation = solution.end_rotation(row, static_cast<solver::Index>(end));
      if (!std::isnan(rotation))
        record.add("end_rotation_rad", item, rotation, roundoff.displacement);
      record.add("axial_force_N", item, resultants[end][0], roundoff.force);
      record.add("shear_force_N", item, resultants[end][1], roundoff.force);
      record.add("bending_moment_N_m", item, resultants[end][2], roundoff.force);
    }
    // Not finite where the section does not say how far its outermost fibre is.
    if (row < solution.member_stress.size() && std::isfinite(solution.member_stress[row])) {
      record.add("stress_Pa", name, solution.member_stress[row], roundoff.force);
    }
  }
}

/// Of the supports of one name, which are one or the nodes of an edge, the sum; no moment of edges.
void record_reactions(const solver::Model& model, const solver::StaticSolution& solution,
                      double roundoff, Recorder& record) {
  std::map<std::string, std::pair<Eigen::RowVector3d, int>> sums;
  for (std::size_t i = 0; i < model.supports.size(); ++i) {
    const Eigen::RowVector3d reaction = solution.reaction.row(static_cast<solver::Index>(i));
    if (model.supports[i].name.empty()) continue;  // inside a chain of members
    const auto [sum, first] = sums.try_emplace(model.supports[i].name, reaction, 1);
    if (first) continue;
    sum->second.first += reaction;
    ++sum->second.second;
  }
  for (const auto& [name, sum] : sums) {
    const auto& [reaction, nodes] = sum;
    record.add("reaction_x_N", name, reaction[0], roundoff);
    record.add("reaction_y_N", name, reaction[1], roundoff);
    if (nodes == 1) record.add("reaction_moment_N_m", name, reaction[2], roundoff);
  }
}

/// Stresses at named nodes of plates.
void record_node_stresses(const solver::Model& model, const solver::StaticSolution& solution,
                          double roundoff, Recorder& record) {
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const std::string& name = model.nodes[i].name;
    const Eigen::RowVector3d stress = solution.node_stress.row(static_cast<solver::Index>(i));
    if (name.empty() || std::isnan(stress[0])) continue;
    record.add("stress_xx_Pa", name, stress[0], roundoff);
    record.add("stress_yy_Pa", name, stress[1], roundoff);
    record.add("stress_xy_Pa", name, stress[2], roundoff);
  }
}

/// Largest von Mises stress of each plate's triangles.
void record_plates(const solver::Model& model, const solver::StaticSolution& solution,
                   double roundoff, Recorder& record) {
  if (solution.triangle_stress.rows() == 0) return;
  std::vector<double> largest(model.plates.size(), 0);
  for (std::size_t i = 0; i < model.triangles.size(); ++i) {
    const Eigen::RowVector3d s = solution.triangle_stress.row(static_cast<solver::Index>(i));
    const double von_mises = std::sqrt(s[0] * s[0] - s[0] * s[1] + s[1] * s[1] + 3 * s[2] * s[2]);
    double& plate = largest[solver::to_size(model.triangles[i].plate)];
    plate = solver::nan_max(plate, von_mises);
  }
  for (std::size_t p = 0; p < largest.size(); ++p) {
    record.add("von_mises_stress_Pa", model.plates[p].name, largest[p], roundoff);
  }
}

/// With large displacement: in the geometrically exact tier.
StepResult analyse_exactly(const CaseModel& case_model, std::size_t step, bool draw,
                           Recorder& record) {
  const solver::Model model = build_bare_model(case_model, step);
  const auto solve = case_model.estimates_large_displacement ? solver::estimate_large_statics
                                                             : solver::solve_large_statics;
  const solver::StaticSolution solution = solve(model, case_model.joint_elements);
  StepResult result{solution.outcome, solution.counters, std::nullopt, {}, solution.evidence};
  if (draw) {
    result.drawing = draw_model(solver::assemble(build_model(case_model, step)),
                                case_model.manipulator.has_value());
  }
  if (!solution.outcome.solved()) return result;
  record_solution(model, solution, -1, record);
  warn_of_strain(model, solution, result.warnings);
  return result;
}

void record_all(const solver::Model& model, const solver::StaticSolution& solution,
                Roundoff roundoff, Recorder& record) {
  record_nodes(model, solution, roundoff.displacement, record);
  record_members(model, solution, roundoff, record);
  record_reactions(model, solution, roundoff.force, record);
  record_plates(model, solution, roundoff.force, record);
}

}  // namespace

void record_solution(const solver::Model& model, const solver::StaticSolution& solution,
                     double roundoff, Recorder& record) {
  record_all(model, solution, {roundoff, roundoff}, record);
}

StepResult analyse_statics(const JsonView&, const CaseModel& case_model, std::size_t step,
                           bool draw, Recorder& record) {
  if (case_model.effects.has(solver::Effect::large_displacement)) {
    return analyse_exactly(case_model, step, draw, record);
  }
  const solver::System system = solver::assemble(build_model(case_model, step), case_model.effects);
  const solver::StaticSolution solution = solver::solve_statics(
      system, {.second_order = case_model.effects.has(solver::Effect::geometric_stiffening)});
  StepResult result{solution.outcome, solution.counters, std::nullopt, {}, solution.evidence};
  if (draw) result.drawing = draw_model(system, case_model.manipulator.has_value());
  if (!solution.outcome.solved()) return result;
  const double roundoff = std::pow(10.0, -solution.estimated_correct_digits);
  const double of_forces = std::min(1.0, roundoff + solver::force_roundoff(system, solution.q));
  const solver::Model& model = system.model;
  record_all(model, solution, {roundoff, of_forces}, record);
  if (!case_model.path) record_bending_stress(model, solution, of_forces, record);
  warn_of_rotation(largest_rotation(system, system.T * solution.q), result.warnings);
  warn_of_strain(model, solution, result.warnings);
  warn_of_redundancy(system, result.warnings);
  warn_of_taper(model, result.warnings);
  warn_of_amplification(solution, result.warnings);
  // The pins of a platform are points that no mesh resolves.
  if (!case_model.manipulator) record_node_stresses(model, solution, of_forces, record);
  // Loads times displacements: twice the strain energy.
  record.add("compliance_J", "", system.f.dot(solution.q), roundoff);
  record.add("equilibrium_residual_N", "", solution.equilibrium_residual);
  record.add("moment_residual_N_m", "", solution.moment_residual);
  record.add("estimated_correct_digits", "", solution.estimated_correct_digits);
  if (result.drawing) {
    result.drawing->shapes.push_back(draw_shape(system, solution.q, "under the loads"));
  }
  return result;
}

}  // namespace trammel::harness

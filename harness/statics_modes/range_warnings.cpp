#include "harness/statics_modes/range_warnings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/model/model.h"
#include "solver/model/numbers.h"

namespace trammel::harness {
namespace {

using Eigen::Vector2d;

/// Returns the rotation about the triangle's center that fits the motion of its corners best.
double rotation_of_triangle(const solver::System& system, const solver::Triangle& triangle,
                            const Eigen::VectorXd& u) {
  Vector2d center = Vector2d::Zero(), shift = Vector2d::Zero();
  std::array<Vector2d, 3> place, motion;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto node = solver::to_size(triangle.nodes[i]);
    place[i] = system.mesh.positions[node];
    motion[i] = {u[system.coordinates.node[node][0]], u[system.coordinates.node[node][1]]};
    center += place[i] / 3;
    shift += motion[i] / 3;
  }
  double turned = 0, size = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    turned += solver::cross(place[i] - center, motion[i] - shift);
    size += (place[i] - center).squaredNorm();
  }
  return turned / size;
}

}  // namespace

double largest_rotation(const solver::System& system, const Eigen::VectorXd& u) {
  double largest = 0;
  for (Eigen::Index i = 0; i < u.size(); ++i)
    if (system.coordinates.is_rotation[solver::to_size(i)])
      largest = std::max(largest, std::abs(u[i]));
  for (const solver::FrameElement& e : system.mesh.frame) {
    const Vector2d shift(u[e.coordinates[3]] - u[e.coordinates[0]],
                         u[e.coordinates[4]] - u[e.coordinates[1]]);
    largest = std::max(largest, std::abs(solver::cross(e.direction, shift)) / e.length);
  }
  for (const solver::Triangle& triangle : system.model.triangles)
    largest = std::max(largest, std::abs(rotation_of_triangle(system, triangle, u)));
  return largest;
}

double largest_rotation(const solver::StaticSolution& solution) {
  double largest = 0;  // a comparison with NaN (a node without rotation) keeps the value
  for (const double angle : solution.displacement.col(2).eval())
    largest = std::max(largest, std::abs(angle));
  for (const double angle : solution.end_rotation.reshaped().eval())
    largest = std::max(largest, std::abs(angle));
  return largest;
}

void warn_of_rotation(double rotation, std::vector<Warning>& warnings) {
  if (!(rotation > kMaxLinearRotation)) return;
  add_warning(warnings, {"the largest rotation", rotation, " rad",
                         "linear theory holds up to " + rounded(kMaxLinearRotation) +
                             " rad, where it neglects theta^2 / 2 = 0.5 %; large-statics, "
                             "large-motion and the effect large-displacement have no limit"});
}

void warn_of_strain(const solver::Model& model, const solver::StaticSolution& solution,
                    std::vector<Warning>& warnings) {
  double extension = 0, shear = 0;
  for (std::size_t i = 0; i < model.members.size(); ++i) {
    const solver::Member& member = model.members[i];
    const auto row = static_cast<Eigen::Index>(i);
    const auto add = [&](const auto& resultant, const solver::Section& section) {
      if (member.axially_flexible)
        extension = std::max(extension, std::abs(resultant(row, 0)) / section.EA);
      const double stiffness = section.kappa_GA > 0 ? section.kappa_GA : section.EA;
      shear = std::max(shear, std::abs(resultant(row, 1)) / stiffness);
    };
    add(solution.resultant_start, member.section);
    add(solution.resultant_end, member.end_section);
  }
  for (const auto& [name, strain] : {std::pair("extension", extension), std::pair("shear", shear)})
    if (strain > kMaxStrain)
      add_warning(warnings,
                  {std::string("the largest ") + name + " of a member", strain, "",
                   "the linear elastic law of sections holds up to " + rounded(kMaxStrain) +
                       ", where engineering, logarithmic and Green strain differ by 5 %"});
}

void warn_of_near_buckling(const solver::StaticSolution& solution, std::vector<Warning>& warnings) {
  if (!(solution.amplification > kMaxAmplification)) return;
  add_warning(warnings, {"the amplification by second-order theory", solution.amplification, "",
                         "the loads are near those of buckling, and errors of the mesh are "
                         "amplified as much as displacements"});
}

double resolved_frequency(const solver::Mesh& mesh) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const solver::FrameElement& e : mesh.frame) {
    const double beta = kMaxWaveNumber / e.length;
    const double omega = beta * beta * std::sqrt(e.section.EI / e.section.mass_per_length);
    if (e.section.EI > 0) lowest = std::min(lowest, omega / (2 * std::numbers::pi));
  }
  return lowest;
}

void warn_of_wave_length(const solver::System& system, double frequency,
                         std::vector<Warning>& warnings) {
  const double largest = kMaxWaveNumber * std::sqrt(frequency / resolved_frequency(system.mesh));
  if (!(largest > kMaxWaveNumber)) return;
  add_warning(warnings, {"the largest dimensionless wave number of an element", largest, "",
                         "above pi / 2 there are fewer than two elements per half wave of the "
                         "highest mode; more 'elements' of members, or of a manipulator's 'links', "
                         "make frequencies accurate"});
}

void warn_of_taper(const solver::Model& model, std::vector<Warning>& warnings) {
  double largest = 1;
  for (const solver::Member& member : model.members) {
    const auto add = [&](double start, double end) {
      if (!(start > 0 && end > 0)) return;
      const double change = std::abs(std::log(end / start)) / static_cast<double>(member.elements);
      largest = std::max(largest, std::exp(change));
    };
    add(member.section.EI, member.end_section.EI);
    add(member.section.EA, member.end_section.EA);
  }
  if (!(largest > kMaxTaperRatio)) return;
  add_warning(warnings, {"the largest ratio of stiffness at the ends of an element", largest, "",
                         "each element of a tapered member has a constant section; more "
                         "'elements' of the member make results accurate"});
}

void warn_of_redundant_constraints(const solver::System& system, std::vector<Warning>& warnings) {
  const std::vector<solver::Index>& pivot = system.constraints.pivot;
  warn_of_redundant_constraints(std::ranges::count(pivot, -1), warnings);
}

void warn_of_redundant_constraints(Eigen::Index redundant, std::vector<Warning>& warnings) {
  if (redundant == 0) return;
  add_warning(warnings, {"the number of redundant constraints", static_cast<double>(redundant), "",
                         "equilibrium alone does not determine constraint forces: the reported "
                         "forces are one of many solutions"});
}

void warn_of_roundoff(double frequency_roundoff, std::vector<Warning>& warnings) {
  constexpr double kNoticed = 1e-3;
  if (!(frequency_roundoff > kNoticed)) return;
  add_warning(warnings, {"the relative round-off error of a frequency", frequency_roundoff, "",
                         "very different stiffnesses cause this error; 'axial': 'inextensible' or "
                         "rigid bodies in place of stiff parts reduce it"});
}

}  // namespace trammel::harness

#include "solver/large_motion/system/penalty_scales.h"

#include <algorithm>
#include <utility>

namespace trammel::solver::large_motion {

namespace {

/// Stiffness of the elements at each coordinate: EA/h of bars, 12 EI/h^3 and 12 EI/h of beams, E t
/// of triangles, and that of springs.
Eigen::VectorXd coordinate_stiffness(const Model& model, const LargeMotionModel& large_motion,
                                     const Layout& layout) {
  Eigen::VectorXd stiffness = Eigen::VectorXd::Zero(layout.total);
  for (const MemberElement& element : layout.elements) {
    const double h = element.length();
    for (std::size_t a = 0; a < element.coordinates.size(); ++a) {
      const double part = a % 3 == 2 ? h : h * h * h;
      stiffness[element.coordinates[a]] +=
          element.is_bar() ? element.section.EA / h : 12 * element.section.EI / part;
    }
  }
  for (const Triangle& triangle : model.triangles) {
    const Plate& plate = model.plates[to_size(triangle.plate)];
    for (const Index node : triangle.nodes) {
      if (node < 0) continue;
      for (std::size_t k = 0; k < 2; ++k) {
        stiffness[layout.node[to_size(node)][k]] += plate.material.E * plate.thickness;
      }
    }
  }
  const auto add = [&](Index node, std::size_t direction, double value) {
    const Index k = node < 0 ? node : layout.node[to_size(node)][direction];
    if (k >= 0) stiffness[k] += value;
  };
  for (const Spring& spring : model.springs) {
    for (const Index node : spring.nodes)
      for (std::size_t k = 0; k < 3; ++k) add(node, k, spring.stiffness[static_cast<Index>(k)]);
  }
  for (const LineSpring& spring : large_motion.line_springs) {
    for (const Index node : spring.nodes)
      for (std::size_t k = 0; k < 2; ++k) add(node, k, spring.stiffness);
  }
  return stiffness;
}

/// Over the coordinates that have any; `none` where none has.
double mean_of_positive(const Eigen::VectorXd& values, double none) {
  const Index count = (values.array() > 0).count();
  const double mean = count > 0 ? values.sum() / static_cast<double>(count) : 0.0;
  return mean > 0 ? mean : none;
}

double largest(const Eigen::VectorXd& values, std::span<const Index> coordinates, double none) {
  double value = 0;
  for (const Index k : coordinates) {
    if (k >= 0) value = std::max(value, values[k]);
  }
  return value > 0 ? value : none;
}

}  // namespace

PenaltyScales::PenaltyScales(const Model& model, const LargeMotionModel& large_motion,
                             const Layout& layout, Eigen::VectorXd mass)
    : stiffness_(coordinate_stiffness(model, large_motion, layout)), mass_(std::move(mass)) {
  mean_mass_ = mean_of_positive(mass_, 1);
  mean_stiffness_ = mean_of_positive(stiffness_, mean_mass_);
}

double PenaltyScales::stiffness(std::span<const Index> coordinates) const {
  return largest(stiffness_, coordinates, mean_stiffness_);
}

double PenaltyScales::mass(std::span<const Index> coordinates) const {
  return largest(mass_, coordinates, mean_mass_);
}

}  // namespace trammel::solver::large_motion

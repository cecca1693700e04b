#include "solver/large/element_group.h"

#include <algorithm>
#include <cmath>

namespace trammel::solver::large_motion {

namespace {

/// Returns the sum of the element stiffnesses at each coordinate: EA/h of bars, 12 EI/h^3
/// (translation) and 12 EI/h (rotation) of beams, E t of triangles, and the stiffness of springs.
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
  const auto add = [&](const auto& nodes, const Vector3d& value) {
    for (const Index node : nodes) {
      for (std::size_t direction = 0; direction < 3 && node >= 0; ++direction) {
        const Index k = layout.node[to_size(node)][direction];
        if (k >= 0) stiffness[k] += value[static_cast<Index>(direction)];
      }
    }
  };
  for (const Triangle& triangle : model.triangles) {
    const Plate& plate = model.plates[to_size(triangle.plate)];
    const double Et = plate.material.E * plate.thickness;
    add(triangle.nodes, {Et, Et, 0});
  }
  for (const Spring& spring : model.springs) add(spring.nodes, spring.stiffness);
  for (const LineSpring& spring : large_motion.line_springs)
    add(spring.nodes, {spring.stiffness, spring.stiffness, 0});
  return stiffness;
}

/// Returns the sum of the magnitudes of all nodal loads and of the weight of point masses [N].
/// Moments are divided by the model size.
double load_magnitude_sum(const Model& model, const LargeMotionModel& large_motion, double size) {
  double sum = 0, mass = 0;
  const auto add = [&](const Vector3d& load) {
    sum += load.head<2>().norm() + (size > 0 ? std::abs(load[2]) / size : 0);
  };
  for (const NodalLoad& load : model.loads) add(load.force);
  for (const FollowerLoad& load : large_motion.follower_loads) add(load.force);
  for (const PointMass& point : model.masses) mass += point.mass;
  return sum + mass * model.gravity.norm();
}

/// Returns the mean of the positive values, or `none` if no value is positive.
double mean_of_positive(const Eigen::VectorXd& values, double none) {
  const Index count = (values.array() > 0).count();
  const double mean = count > 0 ? values.sum() / static_cast<double>(count) : 0.0;
  return mean > 0 ? mean : none;
}

}  // namespace

PenaltyScales::PenaltyScales(const Model& model, const LargeMotionModel& large_motion,
                             const Layout& layout, const Eigen::VectorXd& mass, double size)
    : layout_(layout),
      size_(size),
      stiffness_(coordinate_stiffness(model, large_motion, layout)),
      mass_(mass) {
  const auto of_translations = [&](Eigen::VectorXd values) {
    for (Index k = 0; k < layout.total; ++k)
      if (layout_.is_rotation(k)) values[k] /= size * size;
    return values;
  };
  mean_mass_ = mean_of_positive(of_translations(mass_), 1);
  // In a model without stiffness, the loads divided by the model size define the scale of
  // stiffness.
  const double turning = load_magnitude_sum(model, large_motion, size) / size;
  mean_stiffness_ =
      mean_of_positive(of_translations(stiffness_), turning > 0 ? turning : mean_mass_);
}

RowScales PenaltyScales::row_scales(std::span<const Index> coordinates, double lever) const {
  const bool turns =
      std::ranges::all_of(coordinates, [&](Index k) { return k < 0 || layout_.is_rotation(k); });
  const auto largest = [&](const Eigen::VectorXd& values, double mean) {
    // `value` is the largest stiffness or mass of the coordinates of the same type as the row
    // (translation or rotation). `levered` is the largest value of the rotations in a row that also
    // contains translations.
    double value = 0, levered = 0;
    for (const Index k : coordinates) {
      if (k < 0) continue;
      double& kind = layout_.is_rotation(k) && !turns ? levered : value;
      kind = std::max(kind, values[k]);
    }
    if (!(value > 0) && lever > 0) {
      constexpr double kShortest = 1e-3;  // smallest lever arm relative to the model size
      const double length = std::max(lever, kShortest * size_);
      value = levered / (length * length);
    }
    return value > 0 ? value : turns ? mean * size_ * size_ : mean;
  };
  return {turns ? 1 : size_, largest(stiffness_, mean_stiffness_), largest(mass_, mean_mass_)};
}

}  // namespace trammel::solver::large_motion

#include "solver/manipulator/kinematics.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "solver/linalg/dense_eigen.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

namespace {

template <Real T>
Eigen::Vector2<T> unit(const T& angle) {
  using std::cos;
  using std::sin;
  return {cos(angle), sin(angle)};
}

double wrapped(double angle) {
  const double a = std::remainder(angle, 2 * std::numbers::pi);
  return a <= -std::numbers::pi ? std::numbers::pi : a;
}

/// Angle at A_i and sine of the angle at B_i in the triangle A_i B_i C_i of a limb.
template <Real T>
struct LimbAngles {
  T angle_at_A;
  T elbow_sine;  ///< absolute value of the sine of the angle at B_i
};

/// Returns x, or 0 if x is negative. Round-off errors can make a factor of Heron's formula slightly
/// negative if the limb is straight.
template <Real T>
T clamp_to_nonnegative(const T& x) {
  return value(x) > 0 ? x : T(0);
}

template <Real T>
LimbAngles<T> solve_limb(const T& a, const T& b, double r) {
  using std::atan2;
  using std::sqrt;
  const T stretch = clamp_to_nonnegative<T>((a + b) - r);
  const T fold_out = clamp_to_nonnegative<T>((b - a) + r);
  const T fold_in = clamp_to_nonnegative<T>((a - b) + r);
  const T sum = a + b + r;
  const T opposite = sqrt(T(fold_out * stretch));
  const T adjacent = sqrt(T(sum * fold_in));
  const T angle = atan2(opposite, adjacent);
  return {2.0 * angle, sqrt(T(sum * stretch)) * sqrt(T(fold_out * fold_in)) / (2.0 * a * b)};
}

/// Returns the angle theta_a of the proximal link [rad], which may be outside (-pi, pi].
template <Real T>
T active_joint_angle(const Vector2d& p_AC, const LimbAngles<T>& limb, int working_mode) {
  return std::atan2(p_AC.y(), p_AC.x()) + static_cast<double>(working_mode) * limb.angle_at_A;
}

/// Returns the reason why limb i cannot reach the platform, or an empty text if the limb can.
std::string reason_out_of_reach(std::size_t i, double a, double b, double r) {
  const double roundoff = 4 * kEps * (a + b + r), beyond = r - (a + b),
               within = std::abs(a - b) - r;
  if (beyond <= roundoff && within <= roundoff && r > roundoff) return {};
  std::ostringstream why;
  why << "limb " << i + 1 << " (A" << i + 1 << "-B" << i + 1 << "-C" << i + 1 << ")";
  if (beyond <= roundoff && within <= roundoff) {
    why << " has C at A and equal links: the direction of the links is undetermined";
  } else {
    why << " cannot reach: C is " << r << " m from A, " << std::max(beyond, within)
        << (beyond > roundoff ? " m beyond the sum of its link lengths"
                              : " m within the difference of its link lengths");
  }
  return why.str();
}

/// Returns the Jacobian matrix J_x without units: the rows are divided by the distal lengths, and
/// the rotation column by the platform radius.
Matrix3d scaled(const Jacobians& j) {
  Matrix3d s = j.parallel;
  s.col(2) /= j.platform_radius;
  for (Index i = 0; i < 3; ++i) s.row(i) /= j.parallel.row(i).head<2>().norm();
  return s;
}

}  // namespace

double platform_radius(const ManipulatorGeometry& g) {
  double sum = 0;
  for (const Vector2d& c : g.platform) sum += c.squaredNorm();
  return std::sqrt(sum / 3);
}

std::array<Vector2d, 3> equilateral_base(double side) {
  return {Vector2d{0, 0}, Vector2d{side, 0}, Vector2d{side / 2, side * std::sqrt(0.75)}};
}

std::array<Vector2d, 3> equilateral_platform(double side) {
  const double inradius = side / (2 * std::numbers::sqrt3);
  return {Vector2d{-side / 2, -inradius}, Vector2d{side / 2, -inradius}, Vector2d{0, 2 * inradius}};
}

void check_geometry(const ManipulatorGeometry& g) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto n = [i] { return std::to_string(i + 1); };
    if (!g.base[i].allFinite()) throw ModelError("base point A" + n() + " is not finite");
    if (!g.platform[i].allFinite()) throw ModelError("platform point C" + n() + " is not finite");
    for (const auto& [name, length] :
         {std::pair("proximal", g.proximal[i]), {"distal", g.distal[i]}}) {
      if (!(length > 0) || !std::isfinite(length))
        throw ModelError("the " + std::string(name) + " length of limb " + n() +
                         " must be positive");
    }
    if (std::abs(g.working_mode[i]) != 1)
      throw ModelError("the working mode of limb " + n() + " must be 1 or -1");
  }
  if (platform_radius(g) == 0) throw ModelError("the platform joints C1, C2 and C3 all lie at P");
}

Posture inverse_kinematics(const ManipulatorGeometry& g, const Pose& pose) {
  check_geometry(g);
  require(pose.vector().allFinite(), "the pose is not finite");
  Posture posture;
  const Vector2d P = pose.position();
  for (std::size_t i = 0; i < 3; ++i) {
    posture.C[i] = P + rotated(g.platform[i], pose.phi);
    const Vector2d p_AC = posture.C[i] - g.base[i];
    const double r = std::hypot(p_AC.x(), p_AC.y());
    const std::string why = reason_out_of_reach(i, g.proximal[i], g.distal[i], r);
    if (!why.empty()) {
      posture.outcome.status = Status::singular;
      posture.outcome.reason += (posture.outcome.reason.empty() ? "" : "; ") + why;
      posture.B[i].setConstant(kNaN);
      posture.active[i] = posture.passive[i] = posture.elbow_sine[i] = kNaN;
      continue;
    }
    const LimbAngles<double> limb = solve_limb(g.proximal[i], g.distal[i], r);
    const int mode = g.working_mode[i];
    posture.active[i] = wrapped(active_joint_angle(p_AC, limb, mode));
    posture.B[i] = g.base[i] + g.proximal[i] * unit(posture.active[i]);
    const Vector2d d = posture.C[i] - posture.B[i];
    posture.passive[i] = wrapped(std::atan2(d.y(), d.x()));
    posture.elbow_sine[i] = -mode * limb.elbow_sine;
    posture.closure_error =
        std::max(posture.closure_error, std::abs(std::hypot(d.x(), d.y()) - g.distal[i]));
  }
  if (!posture.outcome.solved()) posture.closure_error = kNaN;
  return posture;
}

template <Real T>
Eigen::Vector2<T> elbow_position(const Vector2d& A, const Vector2d& C, const T& proximal,
                                 const T& distal, int working_mode) {
  const Vector2d p_AC = C - A;
  const LimbAngles<T> limb = solve_limb(proximal, distal, std::hypot(p_AC.x(), p_AC.y()));
  const T angle = active_joint_angle(p_AC, limb, working_mode);
  return A.cast<T>() + proximal * unit(angle);
}

template Eigen::Vector2<double> elbow_position(const Vector2d&, const Vector2d&, const double&,
                                               const double&, int);
template Eigen::Vector2<Dual> elbow_position(const Vector2d&, const Vector2d&, const Dual&,
                                             const Dual&, int);

ForwardKinematics forward_kinematics(const ManipulatorGeometry& g,
                                     const std::array<double, 3>& angles, const Pose& start) {
  check_geometry(g);
  constexpr int kMaxIterations = 50;
  const double size = platform_radius(g);
  ForwardKinematics result{.outcome = {}, .pose = start};
  double last = std::numeric_limits<double>::infinity();
  for (; result.iterations < kMaxIterations; ++result.iterations) {
    // Jacobian matrix J_x. Rows are divided by the distal lengths, and the rotation column by
    // `size`.
    Matrix3d J;
    // Length errors (|d|^2 - b^2) / 2b [m] of the distal lengths b, which are |d| - b to first
    // order.
    Vector3d residual;
    result.closure_error = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto k = static_cast<Index>(i);
      const Vector2d c = rotated(g.platform[i], result.pose.phi);
      const Vector2d B = g.base[i] + g.proximal[i] * unit(angles[i]);
      const Vector2d d = result.pose.position() + c - B;
      const double gap = std::hypot(d.x(), d.y()) - g.distal[i];
      residual(k) = gap * (1 + gap / (2 * g.distal[i]));
      J.row(k) << d.x(), d.y(), cross(c, d) / size;
      J.row(k) /= g.distal[i];
      result.closure_error = std::max(result.closure_error, std::abs(gap));
    }
    if (!residual.allFinite()) break;
    const PivotedSolution correction = pivoted_solve(J, residual);
    if (!(correction.smallest_to_largest_pivot > kSingularRatio)) {
      result.outcome = {Status::singular,
                        "a parallel singularity: the actuator angles do not determine the pose"};
      return result;
    }
    const Vector3d step = -correction.x;
    const double norm = step.norm();
    // Newton's method converges quadratically until round-off dominates. The corrections of the
    // pose then no longer decrease, and the iteration ends.
    if (norm <= 4 * kEps * size || (norm <= 1e-12 * size && norm >= last / 2)) return result;
    last = norm;
    result.pose = pose_of(result.pose.vector() + step.cwiseProduct(Vector3d(1, 1, 1 / size)));
  }
  std::ostringstream why;
  why << "no assembly of the manipulator was found near the start pose: the loop closure "
      << "error is " << result.closure_error << " m";
  result.outcome = {Status::not_converged, why.str()};
  return result;
}

Jacobians jacobians(const ManipulatorGeometry& g, const Pose& pose, const Posture& posture) {
  Jacobians j;
  j.platform_radius = platform_radius(g);
  j.serial_distance = 1;
  const Vector2d P = pose.position();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Index>(i);
    const Vector2d d = posture.C[i] - posture.B[i];
    j.parallel.row(k) << d.x(), d.y(), cross(posture.C[i] - P, d);
    j.serial(k) = g.proximal[i] * g.distal[i] * posture.elbow_sine[i];
    j.serial_distance = std::min(j.serial_distance, std::abs(posture.elbow_sine[i]));
  }
  const Vector3d sigma = singular_values(scaled(j));
  j.parallel_distance = sigma(2) / sigma(0);
  return j;
}

double parallel_determinant(const ManipulatorGeometry& g, const Pose& pose) {
  const Posture posture = inverse_kinematics(g, pose);
  return posture.outcome.solved() ? jacobians(g, pose, posture).parallel.determinant() : kNaN;
}

HoldingTorques holding_torques(const Jacobians& j, const Vector3d& wrench) {
  HoldingTorques result;
  result.torque.setConstant(kNaN);
  result.tension.setConstant(kNaN);
  if (!(j.parallel_distance > kSingularRatio)) {
    result.outcome = {Status::singular,
                      "a parallel singularity: no finite actuator torques hold the platform"};
    return result;
  }
  const Vector3d scaled_wrench(wrench(0), wrench(1), wrench(2) / j.platform_radius);
  const Matrix3d directions = scaled(j).transpose();
  result.tension = pivoted_solve(directions, scaled_wrench).x;
  for (Index i = 0; i < 3; ++i)
    result.torque(i) = -result.tension(i) * j.serial(i) / j.parallel.row(i).head<2>().norm();
  return result;
}

}  // namespace trammel::solver

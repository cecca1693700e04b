#include "solver/manipulator/pose_modes.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <atomic>
#include <future>
#include <numbers>
#include <optional>
#include <thread>

#include "solver/linalg/eigenpairs.h"
#include "solver/linear/modes.h"
#include "solver/linear/validate.h"
#include "solver/manipulator/manipulator.h"
#include "solver/manipulator/moving_pencil.h"

namespace trammel::solver {
namespace {

constexpr Index kBlock = 64;  // number of poses that one thread solves in sequence
constexpr Index kGuard = 3;   // number of iteration vectors in addition to the requested modes
// Number of joint coordinates above which sparse matrices are faster than dense matrices.
constexpr Index kLargest = 48;
// Lower limit of the pivots of the scaled stiffness matrix K. At this limit, nine digits are lost.
constexpr double kSmallestPivot = 1e-9;
// Upper limit of neglected mode coupling, whose square is the relative error of eigenvalues.
constexpr double kMaxCoupling = 1e-7;
// Upper limit of the relative change of eigenvalues in one step of the subspace iteration.
constexpr double kTolerance = 1e-11;
// Backward error of modes below which the iteration ends.
constexpr double kResidual = 1e-11;
constexpr double kClearGap = 1e-3;  // relative difference of eigenvalues treated as distinct

/// Data shared by all threads. Different threads write results of different poses.
struct Task {
  const ManipulatorDesign& design;  ///< manipulator without inactive effects
  const std::vector<Pose>& poses;
  const PoseModesOptions& options;
  PoseModes& result;
};

Model model_at_pose(const Task& task, const Pose& pose) {
  return restrict_effects(build_manipulator(task.design, pose), task.options.active);
}

void store(const Task& task, std::size_t at, const ModalSolution& modes, Counters& counters) {
  PoseModes& result = task.result;
  const auto column = static_cast<Index>(at);
  result.outcome[at] = modes.outcome;
  result.evidence[at] = modes.evidence;
  result.zero_energy_mode_count[at] = modes.zero_energy_mode_count;
  const Index kept = modes.frequency.size();
  if (modes.outcome.solved()) {
    result.frequency.col(column).head(kept) = modes.frequency;
    result.roundoff.col(column).head(kept) = modes.roundoff;
  }
  counters += modes.counters;
}

/// Computes the modes of a block of poses, one pose after the other, by subspace iteration with
/// `rows` vectors.
template <int rows>
class BlockSolver {
 public:
  BlockSolver(const Task& task, const MovingPencil& pencil) : task_(task), pencil_(pencil) {}

  void run(std::size_t begin, std::size_t end) {
    warm_ = false;
    plain_ = 1;
    for (std::size_t at = begin; at < end; ++at) {
      const Pose& pose = task_.poses[at];
      const Posture posture = inverse_kinematics(task_.design.geometry, pose);
      if (!posture.outcome.solved()) {
        task_.result.outcome[at] = posture.outcome;
        continue;
      }
      if (solve(at, posture)) continue;
      ++by_itself;
      store(task_, at,
            solve_modes(assemble(model_at_pose(task_, pose), task_.options.active),
                        {.count = task_.options.count}),
            counters);
    }
  }

  Counters counters;
  Index by_itself = 0;

 private:
  using Numbers = Eigen::Array<double, rows, 1>;
  using Square = Eigen::Matrix<double, rows, rows>;

  /// Computes the modes at a pose with the condensed matrices. Returns true if Sylvester's law of
  /// inertia certifies that no mode is missing.
  bool solve(std::size_t at, const Posture& posture) {
    if (pencil_.joint_coordinate_count() > kLargest ||
        pencil_.joint_coordinate_count() + pencil_.interior_mode_count() < rows)
      return false;
    if (task_.options.count + kGuard > rows || pencil_.largest_coupling() > kMaxCoupling)
      return false;
    if (!pencil_.move_to(posture, task_.poses[at]).solved()) return false;
    ++counters.factorizations;
    if (!(stiffness_.compute(pencil_.K()) && stiffness_.smallest_pivot() > kSmallestPivot))
      return false;
    // Start with the modes of the preceding pose. If this trial fails, the second trial uses new
    // start vectors.
    for (int trial = warm_ ? 0 : 1; trial < 2; ++trial) {
      if (trial > 0) begin();
      if (iterate(trial == 0) && certify(at)) return warm_ = true;
    }
    return warm_ = false;
  }

  void begin() {
    const Index n = pencil_.joint_coordinate_count();
    X_.ends = start_vectors(rows, n);
    // Scale the joint coordinates to unit stiffness, which is also the stiffness of interior modes.
    X_.ends *= pencil_.K().diagonal().cwiseSqrt().cwiseInverse().asDiagonal();
    X_.inside = start_vectors(rows, pencil_.interior_mode_count(), 1);
  }

  /// Performs a step of inverse iteration: computes Y = K^-1 M X and M Y for the vectors X.
  void inverse_iteration() {
    Y_ = MX_;
    stiffness_.solve_in_place(Y_.ends);
    counters.solves += rows;
    pencil_.mass_times(Y_, MY_);
  }

  /// Iterates until the requested eigenvalues and modes converge. Returns false if they do not
  /// converge.
  bool iterate(bool warm) {
    constexpr int kSteps = 60;
    pencil_.mass_times(X_, MX_);
    const Index wanted = task_.options.count;
    for (int step = 0; step < kSteps; ++step) {
      for (int k = 0; warm && step == 0 && k < plain_; ++k) {
        inverse_iteration();
        std::swap(X_, Y_);
        std::swap(MX_, MY_);
      }
      inverse_iteration();
      if (!rayleigh_ritz()) return false;
      if (change_.head(wanted).maxCoeff() < kTolerance) {
        measures_ = pencil_.measure_modes(X_, MX_, space_);
        const double residual = measures_.backward_error.head(wanted).maxCoeff();
        if (residual < kResidual) {
          if (warm && step == 0 && residual < 1e-2 * kResidual && plain_ > 0) --plain_;
          return true;
        }
      }
      if (warm && plain_ < 4) ++plain_;
    }
    return false;
  }

  static Square products(const VectorBlock<rows>& A, const VectorBlock<rows>& B) {
    Square sum = Square::Zero();
    for (Index i = 0; i < A.ends.cols(); ++i) sum += A.ends.col(i) * B.ends.col(i).transpose();
    for (Index i = 0; i < A.inside.cols(); ++i)
      sum += A.inside.col(i) * B.inside.col(i).transpose();
    return sum;
  }

  static void combine(const Square& Z, VectorBlock<rows>& X) {
    for (Index i = 0; i < X.ends.cols(); ++i) X.ends.col(i) = Z * X.ends.col(i);
    for (Index i = 0; i < X.inside.cols(); ++i) X.inside.col(i) = Z * X.inside.col(i);
  }

  /// Computes the lowest eigenvalues in the subspace of Y = K^-1 M X, and the relative change of
  /// the eigenvalues in this step. For a mode Y z, the approximation before the step is X z.
  bool rayleigh_ritz() {
    const Square stiffness = products(Y_, MX_), inertia = products(Y_, MY_);
    const Square before = products(X_, MX_);
    const Numbers scale = stiffness.diagonal().array().rsqrt();
    const auto scaled = [&scale](const Square& A) -> Square {
      return scale.matrix().asDiagonal() * (A + A.transpose()) / 2 * scale.matrix().asDiagonal();
    };
    const Eigen::LLT<Square> cholesky(scaled(stiffness));
    if (cholesky.info() != Eigen::Success) return false;
    Square C = cholesky.matrixL().solve(scaled(inertia));
    C = cholesky.matrixL().solve(C.transpose().eval());
    const Eigen::SelfAdjointEigenSolver<Square> eigen((C + C.transpose()) / 2);
    if (eigen.info() != Eigen::Success) return false;
    const Square vectors = cholesky.matrixU().solve(eigen.eigenvectors().rowwise().reverse());
    const Square Z = vectors.transpose() * scale.matrix().asDiagonal();
    const Numbers theta = eigen.eigenvalues().reverse().array();  // 1 / omega^2
    if (!(theta.minCoeff() > 0)) return false;
    value_ = theta.inverse();
    change_ = ((Z * before).cwiseProduct(Z).rowwise().sum().array() * theta - 1).abs();
    combine(Z, Y_);
    combine(Z, MY_);
    std::swap(X_, Y_);
    std::swap(MX_, MY_);
    return true;
  }

  /// Returns the number of eigenvalues below the first gap of at least kClearGap above the
  /// requested modes, or 0 if no such gap was found.
  [[nodiscard]] Index cut() const {
    for (Index k = task_.options.count; k < rows; ++k) {
      if (!(change_[k - 1] < 1e-2 * kClearGap)) return 0;
      if (value_[k] - value_[k - 1] > kClearGap * value_[k]) return k;
    }
    return 0;
  }

  bool certify(std::size_t at) {
    const Index found = cut(), count = task_.options.count;
    if (found == 0) return false;
    Index below = -1;
    for (const double fraction : {0.5, 0.37, 0.61}) {
      const double gap = value_[found] - value_[found - 1];
      below = pencil_.eigenvalues_below(value_[found - 1] + fraction * gap);
      ++counters.factorizations;
      if (below >= 0) break;
    }
    if (below != found) return false;
    const Numbers w2 = measures_.strain / measures_.inertia;
    // The Rayleigh quotients from element matrices must confirm the eigenvalues from assembled
    // matrices.
    if (!((w2 / value_ - 1).abs().head(count).maxCoeff() < 1e-6)) return false;
    Evidence evidence;
    evidence.add(Residual::mode_count, 0);
    evidence.add(Residual::eigenvalue_equation, measures_.backward_error.head(count).maxCoeff());
    if (!outcome_by_evidence({}, evidence).solved()) return false;
    const auto column = static_cast<Index>(at);
    const Numbers error = change_ * (w2 / w2[rows - 1]).square();
    const Numbers frequency = w2.sqrt() / (2 * std::numbers::pi);
    const Numbers rounding = 0.5 * (measures_.rounding / measures_.strain + error) + 4 * kEps;
    task_.result.frequency.col(column) = frequency.head(count);
    task_.result.roundoff.col(column) = rounding.head(count);
    task_.result.evidence[at] = evidence;
    return true;
  }

  const Task& task_;
  MovingPencil pencil_;
  DenseLdlt stiffness_;
  VectorBlock<rows> X_, Y_, MX_, MY_;
  Workspace<rows> space_;
  Numbers value_, change_;
  ModeMeasures<rows> measures_;
  bool warm_ = false;  // true: X_ contains the modes of the preceding pose
  int plain_ = 1;      // number of inverse iterations before the first Rayleigh-Ritz step
};

/// Solves blocks of poses on threads, one thread per solver. The result of each block depends only
/// on the poses of the block.
template <class Solver>
void solve_blocks_of_poses(const Task& task, std::vector<Solver> solvers) {
  std::atomic<std::size_t> next = 0;
  const std::size_t poses = task.poses.size();
  const auto work = [&](Solver& solver) {
    for (std::size_t begin; (begin = kBlock * next++) < poses;)
      solver.run(begin, std::min(poses, begin + kBlock));
  };
  std::vector<std::future<void>> threads;
  for (Solver& solver : solvers)
    threads.push_back(std::async(std::launch::async, work, std::ref(solver)));
  // If get() of a future throws, the destructors of the other futures wait for their threads.
  for (std::future<void>& thread : threads) thread.get();
  for (const Solver& solver : solvers) {
    task.result.counters += solver.counters;
    task.result.by_itself += solver.by_itself;
  }
}

/// Returns the first pose that all limbs can reach, or an empty value.
std::optional<Pose> first_reachable_pose(const ManipulatorGeometry& geometry,
                                         const std::vector<Pose>& poses) {
  for (const Pose& pose : poses) {
    if (inverse_kinematics(geometry, pose).outcome.solved()) return pose;
  }
  return std::nullopt;
}

}  // namespace

PoseModes solve_pose_modes(const ManipulatorDesign& whole_design, const std::vector<Pose>& poses,
                           const PoseModesOptions& options) {
  const ManipulatorDesign design = restrict_effects(whole_design, options.active);
  PoseModes result;
  result.outcome.resize(poses.size());
  result.evidence.resize(poses.size());
  result.zero_energy_mode_count.resize(poses.size());
  result.frequency.setConstant(options.count, std::ssize(poses), kNaN);
  result.roundoff = result.frequency;
  const std::optional<Pose> start = first_reachable_pose(design.geometry, poses);
  if (!start) {
    for (std::size_t i = 0; i < poses.size(); ++i)
      result.outcome[i] = inverse_kinematics(design.geometry, poses[i]).outcome;
    return result;
  }
  const Task task{design, poses, options, result};
  const MovingPencil pencil(model_at_pose(task, *start), design.geometry, *start);
  result.counters = pencil.counters();
  result.free_coordinates = pencil.free_coordinate_count();
  result.coupling = pencil.largest_coupling();
  const auto blocks = static_cast<Index>((poses.size() + kBlock - 1) / kBlock);
  const Index cores = std::max<Index>(1, std::thread::hardware_concurrency());
  const auto threads = std::min(blocks, options.threads > 0 ? options.threads : cores);
  const Index rows = options.count + kGuard;
  if (rows <= 6) {
    solve_blocks_of_poses(task, std::vector(to_size(threads), BlockSolver<6>(task, pencil)));
  } else {
    solve_blocks_of_poses(task, std::vector(to_size(threads), BlockSolver<16>(task, pencil)));
  }
  return result;
}

}  // namespace trammel::solver

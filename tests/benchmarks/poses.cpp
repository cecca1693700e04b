// Measures the number of poses per second for which one core computes natural frequencies along the
// circular path of Varalakshmi and Srinivas (2017): by solve_pose_modes and by a separate solution
// for each pose. The program checks no results.
//   poses                       1, 4 and 16 elements per link
//   poses 4 10000               4 elements per link, 10000 poses, solve_pose_modes only
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "solver/linear/modes.h"
#include "solver/manipulator/pose_modes.h"
#include "tests/support/solver/table_1.h"

namespace {

using namespace trammel::solver;

double seconds() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

void run(Index elements, Index count, bool one_by_one) {
  const ManipulatorDesign design = meshed_design(elements);
  std::vector<Pose> poses;
  for (Index i = 0; i < count; ++i) {
    const double t = 0.01 * static_cast<double>(i);
    poses.push_back({0.25 + 0.01 * std::cos(t), 0.144 + 0.01 * std::sin(t), 0});
  }
  double begin = seconds();
  const PoseModes modes = solve_pose_modes(design, poses, {.count = 3, .threads = 1});
  const double rate = static_cast<double>(count) / (seconds() - begin);
  std::printf("%td elements a link: %.0f poses a second, %td by themselves, %.1f solves a pose\n",
              elements, rate, modes.by_itself,
              static_cast<double>(modes.counters.solves) / static_cast<double>(count));
  if (!one_by_one) return;
  double worst = 0;
  begin = seconds();
  const Index compared = std::min<Index>(count, 631);
  for (Index i = 0; i < compared; ++i) {
    const System system = assemble(build_manipulator(design, poses[to_size(i)]));
    const ModalSolution alone = solve_modes(system, {.count = 3});
    const Eigen::VectorXd ratio = modes.frequency.col(i).cwiseQuotient(alone.frequency);
    worst = std::max(worst, (ratio.array() - 1).abs().maxCoeff());
  }
  const double alone = static_cast<double>(compared) / (seconds() - begin);
  std::printf("  one by one %.0f a second, ratio %.1f; largest relative difference %.1e\n", alone,
              rate / alone, worst);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3) {
    run(std::atol(argv[1]), std::atol(argv[2]), false);
    return 0;
  }
  for (const Index elements : {1, 4, 16}) run(elements, 10000, true);
  return 0;
}

// Measures processor time and peak memory of computing the first ten modes of two large models.
// Each model is solved at four sizes, from 1/32 to the full size, in separate processes. The
// program prints the exponents of the growth of time and memory with the size. It checks no
// results.
//   large_modes                  both models, four sizes
//   large_modes lattice 100000   one model: a square lattice of 100000 frame members
//   large_modes plate 200000     one model: a square plate of 200000 constant-strain triangles
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Eigen/LU>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "solver/linear/modes.h"

namespace {

using namespace trammel::solver;

double seconds() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

/// Grid of n x n nodes in a square of 1 m, clamped along x = 0.
Model square(Index n, bool rotations) {
  Model model;
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) {
      const auto steps = static_cast<double>(n - 1);
      model.nodes.push_back({"", {static_cast<double>(i) / steps, static_cast<double>(j) / steps}});
      if (i == 0) model.supports.push_back({"", j * n, {true, true, rotations}});
    }
  return model;
}

Model lattice(Index members) {
  const auto n = static_cast<Index>(std::lround(std::sqrt(static_cast<double>(members) / 2)) + 1);
  Model model = square(n, true);
  Member member;
  const double h = 0.2 / static_cast<double>(n - 1);
  member.section = {2e11 * h * h, 2e11 * h * h * h * h / 12, 0, 8000 * h * h, 0, h * h, 0};
  member.end_section = member.section;
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) {
      member.nodes = {j * n + i, j * n + i + 1};
      if (i + 1 < n) model.members.push_back(member);
      member.nodes = {j * n + i, (j + 1) * n + i};
      if (j + 1 < n) model.members.push_back(member);
    }
  return model;
}

Model plate(Index triangles) {
  const auto n = static_cast<Index>(std::lround(std::sqrt(static_cast<double>(triangles) / 2)) + 1);
  Model model = square(n, false);
  model.plates.push_back({"plate", {2e11, 8000, 0.3}, 0.01});
  for (Index j = 0; j + 1 < n; ++j)
    for (Index i = 0; i + 1 < n; ++i) {
      const Index a = j * n + i;
      model.triangles.push_back({0, {a, a + 1, a + n + 1, -1, -1, -1}});
      model.triangles.push_back({0, {a, a + n + 1, a + n, -1, -1, -1}});
    }
  return model;
}

int run(const std::string& kind, Index size) {
  const double begin = seconds();
  const System system = assemble(kind == "lattice" ? lattice(size) : plate(size));
  const double assembled = seconds();
  ModesOptions options;
  options.count = 10;
  const ModalSolution modes = solve_modes(system, options);
  const double end = seconds();
  std::printf("%s of %td: %td free coordinates, assembled in %.2f s, ten modes in %.2f s\n",
              kind.c_str(), size, system.K.rows(), assembled - begin, end - assembled);
  std::printf(
      "  %s%td found, %g missed, %lld factorizations, %lld solves; f1 = %.10g Hz, "
      "f10 = %.10g Hz, round-off %.1e\n",
      modes.outcome.reason.c_str(), modes.frequency.size(),
      modes.evidence.largest(Residual::mode_count),
      static_cast<long long>(modes.counters.factorizations),
      static_cast<long long>(modes.counters.solves), modes.frequency[0],
      modes.frequency[modes.frequency.size() - 1], modes.roundoff.maxCoeff());
  return modes.outcome.solved() ? 0 : 1;
}

struct Cost {
  double seconds = 0, megabytes = 0;
};

Cost measure_mode_cost(const std::string& kind, Index size) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    const int status = run(kind, size);
    std::fflush(stdout);
    _exit(status);
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  const auto of = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  const Cost cost{of(usage.ru_utime) + of(usage.ru_stime),
                  static_cast<double>(usage.ru_maxrss) / 1024};
  std::printf("  %.2f s, peak memory %.0f MB\n", cost.seconds, cost.megabytes);
  return cost;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3) return run(argv[1], std::atol(argv[2]));
  for (const auto& [kind, size] : {std::pair{"lattice", Index{100000}}, {"plate", Index{200000}}}) {
    Eigen::MatrixXd powers(4, 2), costs(4, 2);  // rows of log(cost) = a + b log(size)
    for (Index i = 0; i < 4; ++i) {
      const auto part = static_cast<Index>(static_cast<double>(size) * std::pow(32, (i - 3) / 3.0));
      const Cost cost = measure_mode_cost(kind, part);
      powers.row(i) << 1, std::log(static_cast<double>(part));
      costs.row(i) << std::log(cost.seconds), std::log(cost.megabytes);
    }
    const Eigen::MatrixXd fit =
        (powers.transpose() * powers).inverse() * powers.transpose() * costs;
    std::printf("  time grows as size^%.2f, memory as size^%.2f\n\n", fit(1, 0), fit(1, 1));
  }
  return 0;
}

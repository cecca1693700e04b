// What the inner loops reach of what one core of this machine can do: operations counted, over its
// measured peak, and bytes over its measured bandwidth. Measured, never asserted.
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <functional>
#include <vector>

#include "solver/grnn/grnn.h"
#include "solver/linalg/sparse_ldlt.h"

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__)
#define TRAMMEL_WIDE __attribute__((target_clones("avx512f", "arch=haswell", "default")))
#else
#define TRAMMEL_WIDE
#endif

namespace {

using namespace trammel::solver;

/// Processor time of one call: the least of several that take a tenth of a second together.
double seconds(const std::function<void()>& work) {
  double least = 1e300;
  for (double all = 0; all < 0.5;) {
    const std::clock_t begin = std::clock();
    work();
    const double took = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    least = std::min(least, std::max(took, 1e-6));
    all += took + 1e-6;
  }
  return least;
}

constexpr std::size_t kLanes = 64;  // enough to hide how long an operation takes
constexpr int kRounds = 1000000;

TRAMMEL_WIDE void multiply_and_add(std::array<double, kLanes>& values) {
  std::array<double, kLanes> local = values;
  for (int round = 0; round < kRounds; ++round)
    for (double& value : local) value = value * 0.999999 + 1e-6;
  values = local;
}

/// A square grid's Laplacian, as sparse as a lattice's stiffness.
SparseMatrix grid(Index n) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto couple = [&](Index i, Index j) {
    entries.emplace_back(i, j, -1);
    entries.emplace_back(j, i, -1);
  };
  for (Index i = 0; i < n * n; ++i) {
    entries.emplace_back(i, i, 4.1);
    if (i % n + 1 < n) couple(i, i + 1);
    if (i + n < n * n) couple(i, i + n);
  }
  SparseMatrix A(n * n, n * n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

}  // namespace

int main() {
  std::array<double, kLanes> lanes{};
  const double peak = 2.0 * kLanes * kRounds / seconds([&] { multiply_and_add(lanes); });
  Eigen::VectorXd a(Eigen::VectorXd::Zero(1 << 23)), b = a, c = a;
  const double bandwidth = 24.0 * static_cast<double>(a.size()) / seconds([&] { a = b + 0.5 * c; });
  std::printf("one core: %.1f Gflop/s, %.1f GB/s\n", peak / 1e9, bandwidth / 1e9);
  const auto print = [&](const char* what, double operations, double bytes, double time) {
    std::printf("%s: %.2f Gflop/s, %.1f %% of the peak; %.2f GB/s, %.1f %% of the bandwidth\n",
                what, operations / time / 1e9, 100 * operations / time / peak, bytes / time / 1e9,
                100 * bytes / time / bandwidth);
  };

  const SparseMatrix A = grid(250);
  SparseLdlt ldlt(SparseLdlt::Triangle::lower);
  if (!ldlt.factorize(A)) return 1;
  const SparseMatrix U =
      ldlt.square_root();  // P^T L D^1/2 transposed: entries of row i are column i
  Eigen::VectorXd below = Eigen::VectorXd::Constant(A.rows(), -1);
  for (Index j = 0; j < U.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(U, j); it; ++it) ++below[it.row()];
  const double entries = static_cast<double>(U.nonZeros());
  print("LDL^T of 62,500 coordinates", (below.array() * (below.array() + 2)).sum(), 12 * entries,
        seconds([&] { (void)ldlt.factorize(A); }));
  Eigen::VectorXd x = Eigen::VectorXd::Ones(A.rows()), solution;
  print("its triangular solves", 4 * entries, 24 * entries,
        seconds([&] { ldlt.solve(x, solution); }));

  constexpr Index kSamples = 379, kInputs = 3, kOutputs = 6, kQueries = 1000;
  // A pair: squares and their least, excess and its least, exponential, products with the outputs.
  constexpr double kPair = 3 * kInputs + 1 + 5 * kInputs + 2 + 24 + 2 * (kOutputs + 1);
  const Grnn network = make_grnn(Eigen::MatrixXd::Random(kSamples, kInputs),
                                 Eigen::MatrixXd::Random(kSamples, kOutputs), 1);
  const Eigen::MatrixXd queries = Eigen::MatrixXd::Random(kQueries, kInputs);
  const double time = seconds([&] { (void)predict(network, queries); });
  const double pairs = static_cast<double>(kSamples * kQueries);
  print("network", kPair * pairs, 8.0 * static_cast<double>(kQueries * (kInputs + kOutputs)), time);
  std::printf("  %.2f ns for each sample and query\n", 1e9 * time / pairs);
  return 0;
}

// Measures the rates of the solver's inner loops relative to their roofline: the lower of the peak
// rate of one core and the bandwidth of its memory. Numbers of operations and bytes follow from the
// sizes of the matrices. Run by hand: build/release/tests/roofline
#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "solver/grnn/grnn.h"
#include "solver/linalg/factorization.h"

// Compiles a function for the widest vector instructions of the machine.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__)
#define TRAMMEL_WIDE __attribute__((target_clones("avx512f", "arch=haswell", "default")))
#else
#define TRAMMEL_WIDE
#endif

namespace {

namespace solver = trammel::solver;
using solver::Index;
using solver::SparseMatrix;

/// Returns the processor time of one call [s]: the minimum of several calls.
double least_time(const std::function<void()>& work) {
  constexpr double kTogether = 0.12, kShortest = 1e-6;
  double least = 1e300;
  for (double all = 0; all < kTogether;) {
    const std::clock_t start = std::clock();
    work();
    const double cpu_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const double took = std::max(cpu_s, kShortest);
    least = std::min(least, took);
    all += took;
  }
  return least;
}

/// Inner loop of the solver: its numbers of operations and bytes, and its processor time.
struct LoopRate {
  std::string title;
  double operations = 0, bytes = 0, cpu_s = 0;
};

constexpr std::size_t kLanes = 64;  // independent values, which hide the latency of operations
constexpr int kRounds = 200000;

TRAMMEL_WIDE void multiply_and_add(std::array<double, kLanes>& values) {
  std::array<double, kLanes> local = values;
  for (int round = 0; round < kRounds; ++round)
    for (double& value : local) value = value * 0.999999 + 1e-6;
  values = local;
}

/// Returns the Laplacian of a square grid, which is as sparse as the stiffness matrix of a lattice.
SparseMatrix grid_laplacian(Index n) {
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

void add_factorization(std::vector<LoopRate>& loops) {
  const SparseMatrix A = grid_laplacian(160);
  solver::SparseLdlt ldlt(solver::SparseLdlt::Triangle::lower);
  if (!ldlt.factorize(A)) return;
  const SparseMatrix U = Eigen::SimplicialLDLT<SparseMatrix>(A).matrixU();  // Eigen's ordering
  Eigen::VectorXd below = Eigen::VectorXd::Constant(A.rows(), -1);
  for (Index j = 0; j < U.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(U, j); it; ++it) ++below[it.row()];
  const double entries = static_cast<double>(U.nonZeros());
  const SparseMatrix twice = 2 * A;  // the factors of an unchanged matrix would be reused
  bool is_doubled = false;
  const double time = least_time([&] {
    is_doubled = !is_doubled;
    (void)ldlt.factorize(is_doubled ? twice : A);
  });
  loops.push_back({"Sparse L D L^T of 25,600 coordinates",
                   (below.array() * (below.array() + 2)).sum(), 12 * entries, time});
  Eigen::VectorXd x = Eigen::VectorXd::Ones(A.rows()), solution;
  loops.push_back({"Its triangular solves", 4 * entries, 24 * entries,
                   least_time([&] { ldlt.solve(x, solution); })});
}

void add_network(std::vector<LoopRate>& loops) {
  constexpr Index kSamples = 379, kInputs = 3, kOutputs = 6, kQueries = 1000;
  // Floating-point operations of the regression network for each pair of query and sample: squared
  // distance and its minimum, excess over the minimum and minimum of the excess, exponential,
  // products with the outputs.
  constexpr double kPair = 3 * kInputs + 1 + 5 * kInputs + 2 + 24 + 2 * (kOutputs + 1);
  const solver::Grnn network = solver::make_grnn(Eigen::MatrixXd::Random(kSamples, kInputs),
                                                 Eigen::MatrixXd::Random(kSamples, kOutputs), 1);
  const Eigen::MatrixXd queries = Eigen::MatrixXd::Random(kQueries, kInputs);
  loops.push_back({"GRNN, 1,000 queries of 379 samples",
                   kPair * static_cast<double>(kSamples * kQueries),
                   8.0 * static_cast<double>(kQueries * (kInputs + kOutputs)),
                   least_time([&] { (void)predict(network, queries); })});
}

}  // namespace

int main() {
  std::array<double, kLanes> lanes{};
  const double peak = 2.0 * kLanes * kRounds / least_time([&] { multiply_and_add(lanes); });
  Eigen::VectorXd a(Eigen::VectorXd::Zero(1 << 22)), b = a, c = a;
  const double bandwidth =
      24.0 * static_cast<double>(a.size()) / least_time([&] { a = b + 0.5 * c; });
  std::printf("one core: %.3g Gflop/s, %.3g GB/s\n", peak / 1e9, bandwidth / 1e9);
  std::vector<LoopRate> loops;
  add_factorization(loops);
  add_network(loops);
  for (const LoopRate& loop : loops) {
    const double allowed = std::min(peak, loop.operations / loop.bytes * bandwidth);
    const double rate = loop.operations / loop.cpu_s;
    std::printf("%-36s %8.3g Gflop/s, %8.3g GB/s, %5.1f %% of what it can reach\n",
                loop.title.c_str(), rate / 1e9, loop.bytes / loop.cpu_s / 1e9,
                100 * rate / allowed);
  }
}

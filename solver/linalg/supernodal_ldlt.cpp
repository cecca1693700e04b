#include "solver/linalg/supernodal_ldlt.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

namespace trammel::solver {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<Index> elimination_tree(const SparseMatrix& upper) {
  std::vector<Index> parent(to_size(upper.cols()), -1), ancestor = parent;
  for (Index k = 0; k < upper.cols(); ++k) {
    for (SparseMatrix::InnerIterator it(upper, k); it; ++it) {
      for (Index i = it.row(); i != -1 && i < k;) {
        const Index next = std::exchange(ancestor[to_size(i)], k);
        if (next == -1) parent[to_size(i)] = k;
        i = next;
      }
    }
  }
  return parent;
}

std::vector<Index> postorder(const std::vector<Index>& parent) {
  const auto n = static_cast<Index>(parent.size());
  std::vector<Index> descendants(parent.size(), 1), place(parent.size()), next(parent.size() + 1);
  for (Index j = 0; j < n; ++j) {
    if (parent[to_size(j)] >= 0)
      descendants[to_size(parent[to_size(j)])] += descendants[to_size(j)];
  }
  // From the roots down: a column stands last of its subtree, its children's subtrees before it.
  for (Index j = n - 1, roots = n; j >= 0; --j) {
    const Index up = parent[to_size(j)];
    Index& end = up >= 0 ? next[to_size(up)] : roots;
    place[to_size(j)] = end - 1;
    next[to_size(j)] = end - 1;
    end -= descendants[to_size(j)];
  }
  return place;
}

void SupernodalLdlt::analyze(const SparseMatrix& upper) {
  D_.resize(upper.cols());
  nodes_.clear();
  find_supernodes(upper);
  find_rows(upper.transpose());
}

/// A column joins the one before it where that is its child and at most a fifth of what is then
/// stored are zeros.
void SupernodalLdlt::find_supernodes(const SparseMatrix& upper) {
  constexpr double kZeros = 0.2;
  const std::vector<Index> parent = elimination_tree(upper);
  std::vector<Index> count(parent.size(), 1), seen(parent.size(), -1);  // entries of L's columns
  for (Index k = 0; k < upper.cols(); ++k) {
    seen[to_size(k)] = k;
    for (SparseMatrix::InnerIterator it(upper, k); it; ++it) {
      for (Index i = it.row(); i < k && seen[to_size(i)] != k; i = parent[to_size(i)]) {
        ++count[to_size(i)];
        seen[to_size(i)] = k;
      }
    }
  }
  double entries = 0;
  for (Index j = 0; j < upper.cols(); ++j) {
    const Index height = count[to_size(j)];
    if (j > 0 && parent[to_size(j - 1)] == j) {
      const auto w = static_cast<double>(nodes_.back().width);
      const double stored = (w + 1) * static_cast<double>(height) + w * (w + 1) / 2;
      if (stored - entries - static_cast<double>(height) <= kZeros * stored) {
        ++nodes_.back().width;
        entries += static_cast<double>(height);
        continue;
      }
    }
    nodes_.emplace_back();
    nodes_.back().first = j;
    nodes_.back().width = 1;
    entries = static_cast<double>(height);
  }
}

void SupernodalLdlt::find_rows(const SparseMatrix& lower) {
  std::vector<Index> node_of(to_size(lower.cols())), seen(node_of.size(), -1);
  for (std::size_t s = 0; s < nodes_.size(); ++s) {
    std::fill_n(node_of.begin() + nodes_[s].first, nodes_[s].width, static_cast<Index>(s));
  }
  for (std::size_t s = 0; s < nodes_.size(); ++s) {
    Supernode& node = nodes_[s];
    const Index end = node.first + node.width;
    const auto add = [&](Index row) {
      if (row < end ||
          std::exchange(seen[to_size(row)], static_cast<Index>(s)) == static_cast<Index>(s))
        return;
      node.rows.push_back(row);
    };
    for (Index j = node.first; j < end; ++j) {
      for (SparseMatrix::InnerIterator it(lower, j); it; ++it) add(it.row());
    }
    for (const Index child : node.children) {
      for (const Index row : nodes_[to_size(child)].rows) add(row);
    }
    std::sort(node.rows.begin(), node.rows.end());
    if (node.rows.empty()) continue;
    nodes_[to_size(node_of[to_size(node.rows[0])])].children.push_back(static_cast<Index>(s));
  }
}

bool SupernodalLdlt::factorize(const SparseMatrix& upper) {
  const SparseMatrix lower = upper.transpose();
  std::vector<Index> local(to_size(upper.cols())), at;
  for (Supernode& node : nodes_) {
    const auto size = node.width + static_cast<Index>(node.rows.size());
    for (Index j = 0; j < node.width; ++j) local[to_size(node.first + j)] = j;
    for (std::size_t i = 0; i < node.rows.size(); ++i)
      local[to_size(node.rows[i])] = node.width + static_cast<Index>(i);
    MatrixXd front = MatrixXd::Zero(size, size);
    for (Index j = 0; j < node.width; ++j) {
      for (SparseMatrix::InnerIterator it(lower, node.first + j); it; ++it)
        front(local[to_size(it.row())], j) = it.value();
    }
    for (const Index child : node.children) {
      Supernode& from = nodes_[to_size(child)];
      at.clear();
      for (const Index row : from.rows) at.push_back(local[to_size(row)]);
      for (Index j = 0; j < from.update.cols(); ++j) {
        for (Index i = j; i < from.update.rows(); ++i)
          front(at[to_size(i)], at[to_size(j)]) += from.update(i, j);
      }
      from.update.resize(0, 0);
    }
    if (!eliminate(node, front)) return false;
  }
  return true;
}

/// In panels, so that nearly all of the work is a product of matrices.
bool SupernodalLdlt::eliminate(Supernode& node, MatrixXd& front) {
  constexpr Index kPanel = 48;
  MatrixXd below;  // L D below the panel
  for (Index k = 0; k < node.width; k += kPanel) {
    const Index width = std::min(kPanel, node.width - k), rest = front.rows() - k - width;
    auto corner = front.block(k, k, width, width);
    auto D = D_.segment(node.first + k, width);
    for (Index j = 0; j < width; ++j) {
      D[j] = corner(j, j);
      if (D[j] == 0 || !std::isfinite(D[j])) return false;
      corner.col(j).tail(width - j - 1) /= D[j];
      for (Index i = j + 1; i < width; ++i)
        corner.col(i).tail(width - i) -= corner(i, j) * D[j] * corner.col(j).tail(width - i);
    }
    auto L = front.block(k + width, k, rest, width);
    below = L;
    corner.triangularView<Eigen::UnitLower>().transpose().solveInPlace<Eigen::OnTheRight>(below);
    L = below * D.cwiseInverse().asDiagonal();
    front.bottomRightCorner(rest, rest).triangularView<Eigen::Lower>() -= L * below.transpose();
  }
  node.L = front.leftCols(node.width);
  node.L.diagonal().setOnes();
  const auto rows = static_cast<Index>(node.rows.size());
  node.update = front.bottomRightCorner(rows, rows);
  return true;
}

SparseMatrix SupernodalLdlt::L() const {
  std::vector<Eigen::Triplet<double>> entries;
  for (const Supernode& node : nodes_) {
    for (Index j = 0; j < node.width; ++j) {
      for (Index i = j; i < node.L.rows(); ++i) {
        const Index row = i < node.width ? node.first + i : node.rows[to_size(i - node.width)];
        entries.emplace_back(row, node.first + j, node.L(i, j));
      }
    }
  }
  SparseMatrix L(D_.size(), D_.size());
  L.setFromTriplets(entries.begin(), entries.end());
  return L;
}

double SupernodalLdlt::largest_entry() const {
  double largest = 1;
  for (const Supernode& node : nodes_)
    largest = std::max(largest, node.L.lpNorm<Eigen::Infinity>());
  return largest;
}

void SupernodalLdlt::solve_lower(VectorXd& x) const {
  VectorXd product;
  for (const Supernode& node : nodes_) {
    auto own = x.segment(node.first, node.width);
    node.L.topRows(node.width).triangularView<Eigen::UnitLower>().solveInPlace(own);
    product.noalias() = node.L.bottomRows(node.L.rows() - node.width) * own;
    for (std::size_t i = 0; i < node.rows.size(); ++i)
      x[node.rows[i]] -= product[static_cast<Index>(i)];
  }
}

void SupernodalLdlt::solve_lower_transposed(VectorXd& x) const {
  VectorXd others;
  for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node) {
    auto own = x.segment(node->first, node->width);
    others.resize(static_cast<Index>(node->rows.size()));
    for (std::size_t i = 0; i < node->rows.size(); ++i)
      others[static_cast<Index>(i)] = x[node->rows[i]];
    own.noalias() -= node->L.bottomRows(others.size()).transpose() * others;
    node->L.topRows(node->width).triangularView<Eigen::UnitLower>().transpose().solveInPlace(own);
  }
}

}  // namespace trammel::solver

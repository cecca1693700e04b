#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/model/numbers.h"

namespace trammel::solver {

/// Modes whose frequencies are equal but for round-off. Their shapes are an arbitrary basis of
/// their subspace; what has a meaning are the derivatives of the set.
struct FrequencySet {
  Index first = 0;
  Index count = 1;
};

/// @param frequency  ascending [Hz]
[[nodiscard]] std::vector<FrequencySet> equal_frequencies(const Eigen::VectorXd& frequency);

}  // namespace trammel::solver

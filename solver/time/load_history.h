#pragma once

#include <vector>

namespace trammel::solver {

/// Factor on loads: linear between ascending times, constant outside them; a time given twice is a
/// jump. 1 throughout by default.
struct LoadHistory {
  std::vector<double> time{0.0};    ///< [s]
  std::vector<double> factor{1.0};  ///< one for each time [-]

  [[nodiscard]] bool constant() const { return time.size() == 1; }
  /// Where its slope changes or it jumps [s].
  [[nodiscard]] std::vector<double> bends() const;
  /// At a jump, the value after it.
  [[nodiscard]] double at(double t) const;
  /// The time whose loads act on the state in which a step of integration ends at `t`: at a jump,
  /// just before it.
  [[nodiscard]] double end_of_step(double t) const;
};

}  // namespace trammel::solver

#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "harness/base/recorder.h"

namespace trammel::harness {

/// Records the energies of a motion [J] and keeps the largest change of their sum.
class EnergyRecorder {
 public:
  void record(double kinetic, double strain, double total, Recorder& record) {
    record.add("kinetic_energy_J", kinetic);
    record.add("strain_energy_J", strain);
    record.add("total_energy_J", total);
    if (!start_) start_ = total;
    change_ = std::max(change_, std::abs(total - *start_));
    largest_kinetic_ = std::max(largest_kinetic_, kinetic);
  }
  [[nodiscard]] double largest_kinetic() const { return largest_kinetic_; }
  /// The largest change over the largest kinetic energy; 0 without motion.
  [[nodiscard]] double drift() const {
    return largest_kinetic_ > 0 ? change_ / largest_kinetic_ : 0;
  }

 private:
  std::optional<double> start_;
  double change_ = 0, largest_kinetic_ = 0;
};

}  // namespace trammel::harness

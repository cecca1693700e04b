#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>

#include "harness/base/quantity.h"

namespace trammel::harness {

/// Collects quantities: each call adds one number at the end of its quantity, so that a path ends
/// up with one number a point.
class Recorder {
 public:
  /// @param item  what it belongs to, after the colon; empty: nothing
  void add(const std::string& name, const std::string& item, double value, double roundoff = -1) {
    Quantity& quantity = quantity_of(name, item);
    quantity.values.push_back(value);
    if (roundoff >= 0) quantity.roundoff.push_back(roundoff);
    if (!std::isfinite(value) && not_finite_.empty()) not_finite_ = key(name, item);
  }
  /// A number of the whole model or motion.
  template <class Number>
  requires std::is_arithmetic_v<Number>
  void add(const std::string& name, Number value) { add(name, "", static_cast<double>(value)); }
  /// One number for each item.
  template <class Items, class Values>
  void add_each(const std::string& name, const Items& items, const Values& values) {
    auto value = std::begin(values);
    for (const auto& item : items) add(name, item, *value++);
  }
  /// The analysis itself says that there is no number here: a gap between curves, a level of a
  /// study without solution. Written as null; only a check that asks for it fails.
  void add_gap(const std::string& name, const std::string& item) {
    quantity_of(name, item).values.push_back(std::numeric_limits<double>::quiet_NaN());
  }
  /// A number, or a gap where it is NaN.
  void add_or_gap(const std::string& name, const std::string& item, double value) {
    std::isnan(value) ? add_gap(name, item) : add(name, item, value);
  }
  /// The first quantity with a number that is none and was not said to be a gap; empty: none.
  [[nodiscard]] const std::string& not_finite() const { return not_finite_; }
  [[nodiscard]] Quantities take_quantities() { return std::move(quantities_); }

 private:
  static std::string key(const std::string& name, const std::string& item) {
    return item.empty() ? name : name + ":" + item;
  }
  Quantity& quantity_of(const std::string& name, const std::string& item) {
    return quantities_[key(name, item)];
  }

  Quantities quantities_;
  std::string not_finite_;
};

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

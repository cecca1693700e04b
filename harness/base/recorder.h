#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>

#include "harness/base/quantity.h"

namespace trammel::harness {

/// Collects the quantities of an analysis. Each call of `add` appends one number to a quantity.
/// Along a path, a quantity has one number per point.
class Recorder {
 public:
  /// @param item  part of the model, written after the colon of the name; empty: none
  void add(const std::string& name, const std::string& item, double value, double roundoff = -1) {
    Quantity& quantity = quantity_of(name, item);
    quantity.values.push_back(value);
    if (roundoff >= 0) quantity.roundoff.push_back(roundoff);
    if (!std::isfinite(value) && not_finite_.empty()) not_finite_ = key(name, item);
  }
  /// Adds a number that belongs to the complete model or motion instead of one part of the model.
  template <class Number>
  requires std::is_arithmetic_v<Number>
  void add(const std::string& name, Number value) { add(name, "", static_cast<double>(value)); }
  /// Adds one number to the quantity of each part of the model.
  template <class Items, class Values>
  void add_each(const std::string& name, const Items& items, const Values& values) {
    auto value = std::begin(values);
    for (const auto& item : items) add(name, item, *value++);
  }
  /// Records a missing number, such as a break in a curve, or the result of a parameter study at a
  /// value without solution. Files contain null for the number. A check of the quantity fails only
  /// if the check uses this number.
  void add_missing_value(const std::string& name, const std::string& item) {
    quantity_of(name, item).values.push_back(std::numeric_limits<double>::quiet_NaN());
  }
  /// Adds a number. NaN is recorded as a missing number.
  void add_or_missing(const std::string& name, const std::string& item, double value) {
    std::isnan(value) ? add_missing_value(name, item) : add(name, item, value);
  }
  /// Returns the name of the first quantity with an infinite or undefined number that was not
  /// recorded as missing; empty if there is none.
  [[nodiscard]] const std::string& first_nonfinite_quantity() const { return not_finite_; }
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

/// Records the energies of a motion [J] and keeps the largest change of the total energy since the
/// start.
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
  [[nodiscard]] double largest_kinetic_energy() const { return largest_kinetic_; }
  /// Returns the largest change of the total energy, divided by the largest kinetic energy; 0 if
  /// nothing moves.
  [[nodiscard]] double relative_drift() const {
    return largest_kinetic_ > 0 ? change_ / largest_kinetic_ : 0;
  }

 private:
  std::optional<double> start_;
  double change_ = 0, largest_kinetic_ = 0;
};

}  // namespace trammel::harness

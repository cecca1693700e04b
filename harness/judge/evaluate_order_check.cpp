#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/base/find_or_add.h"
#include "harness/base/number.h"
#include "harness/base/text.h"
#include "harness/judge/evaluate_check.h"

namespace trammel::harness {
namespace {

/// Convergence study of one entry of the checked quantity, with the constants of its theoretical
/// discretization error.
struct Entry {
  const Convergence& found;
  double wave_number = kNaN;  ///< wave number times length of the refined member
  double share = 1;
};

double reference_entry(const references::Reference& reference,
                       const std::vector<std::size_t>& index, std::size_t position) {
  const std::size_t at = index.empty() ? position : index.at(position);
  return at < reference.values.size() ? reference.values[at] : kNaN;
}

class OrderCheckEvaluator {
 public:
  OrderCheckEvaluator(const Check& check, const Entry& entry, bool is_other_solver)
      : check_(check),
        criterion_(*check.order),
        entry_(entry),
        found_(entry.found),
        is_other_solver_(is_other_solver) {
    for (std::size_t k = 0; k < found_.error.size(); ++k) qualifies_.push_back(qualifies(k));
    meshes_ = static_cast<std::size_t>(std::ranges::count(qualifies_, true));
  }

  /// Judges the criteria that the check states: order, leading term of the error, and extrapolated
  /// value. For another solver, judges only the order, because the other criteria depend on
  /// trammel's elements.
  [[nodiscard]] std::vector<CheckResult> run() const {
    if (is_other_solver_) {
      CheckResult check_result = order();
      check_result.index = found_.index;
      return {check_result};
    }
    std::vector<CheckResult> all = {criterion_.two_term_within ? two_term() : order()};
    if (criterion_.leading_term) all.push_back(leading_term());
    if (criterion_.richardson_within) all.push_back(richardson());
    for (CheckResult& check_result : all) check_result.index = found_.index;
    return all;
  }

 private:
  [[nodiscard]] bool qualifies(std::size_t k) const {
    if (!criterion_.wave_number) return found_.in_asymptotic_range[k];
    const bool fine = entry_.wave_number * found_.size[k] <= criterion_.wave_number->at_most;
    return fine && found_.error[k].has_value() && !found_.at_roundoff_floor[k];
  }

  /// Returns true if the refinement levels are insufficient for a judgment of the order. In this
  /// case, sets the message of `check_result`.
  bool lacks_asymptotic_range(CheckResult& check_result) const {
    if (found_.broken) {
      check_result.message = "a refinement level has no finite value";
    } else if (!found_.exact) {
      check_result.message = "no reference states the exact value for the errors";
    } else if (meshes_ < criterion_.meshes) {
      check_result.message = fmt::format("only {} meshes qualify to fit the order, {} are required",
                                         meshes_, criterion_.meshes);
      if (is_other_solver_) check_result.verdict = Verdict::not_given;
    } else {
      return false;
    }
    return true;
  }

  void conclude(CheckResult& check_result, double value, double limit) const {
    check_result.difference = value;
    check_result.tolerance = {-limit, limit, true};
    check_result.verdict = std::abs(value) <= limit ? Verdict::pass : Verdict::fail;
    if (check_result.message.empty())
      check_result.message = fmt::format("{} meshes qualify to fit the order", meshes_);
  }

  [[nodiscard]] CheckResult start(const std::string& suffix, std::string measure,
                                  std::string unit) const {
    CheckResult check_result = create_check_result(check_);
    check_result.name += suffix;
    check_result.measure = std::move(measure);
    check_result.unit = std::move(unit);
    return check_result;
  }

  /// Returns the value with the largest distance from `target` over the refinement levels that
  /// qualify. These are the levels in the asymptotic range or, if the check states a wave number,
  /// the levels with sufficiently fine meshes.
  template <class Value>
  double worst(double target, const Value& value, CheckResult& check_result) const {
    double farthest = kNaN;
    for (std::size_t k = 0; k < qualifies_.size(); ++k) {
      if (!qualifies_[k]) continue;
      const double here = value(k);
      if (std::isnan(here)) continue;
      if (std::isnan(farthest) || std::abs(here - target) > std::abs(farthest - target)) {
        farthest = here;
        check_result.message = fmt::format("{} meshes qualify, the worst is mesh {}", meshes_,
                                           shortest_decimal(*found_.parameter[k]));
      }
    }
    return farthest;
  }

  [[nodiscard]] CheckResult order() const {
    CheckResult check_result = start("", "order", "1");
    check_result.expected = found_.theory_order;
    if (lacks_asymptotic_range(check_result)) return check_result;
    const double theory = *found_.theory_order;
    const std::optional<double> fitted = log_log_slope(found_.size, found_.error, qualifies_);
    if (!fitted) {
      check_result.message = "fewer than two meshes qualify to fit the order";
      return check_result;
    }
    check_result.computed = *fitted;
    const double farthest = worst(
        theory, [&](std::size_t k) { return k > 0 && qualifies_[k - 1] ? *found_.order[k] : kNaN; },
        check_result);
    check_result.message =
        fmt::format("{} meshes qualify; the worst order between two meshes is {}", meshes_,
                    shortest_decimal(farthest));
    conclude(check_result, *check_result.computed - theory, criterion_.within);
    return check_result;
  }

  /// Judges the largest relative deviation of the two-term law from the errors used in its fit.
  [[nodiscard]] CheckResult two_term() const {
    CheckResult check_result = start("", "two-term", "1");
    check_result.expected = 0;
    if (lacks_asymptotic_range(check_result)) return check_result;
    if (!found_.two_term) {
      check_result.message = "the two-term error law could not be fitted";
      return check_result;
    }
    const double a = *found_.two_term->coefficients[0], b = *found_.two_term->coefficients[1];
    check_result.computed = found_.two_term->max_relative_misfit;
    check_result.message =
        fmt::format("{} meshes qualify; relative error = {} h^{} + {} h^{}", meshes_,
                    shortest_decimal(a), shortest_decimal(*found_.theory_order),
                    shortest_decimal(b), shortest_decimal(*found_.lower_order));
    conclude(check_result, *check_result.computed, *criterion_.two_term_within);
    return check_result;
  }

  [[nodiscard]] CheckResult leading_term() const {
    CheckResult check_result = start(".leading-term", "leading-term", "1");
    check_result.expected = 1;
    if (lacks_asymptotic_range(check_result)) return check_result;
    const double exact = *found_.exact;
    const auto ratio = [&](std::size_t k) {
      const double error = (*found_.values[k] - exact) / std::abs(exact);
      const double step = entry_.wave_number * found_.size[k];
      return error / (criterion_.leading_term->coefficient * entry_.share *
                      std::pow(step, *found_.theory_order));
    };
    check_result.computed = worst(1, ratio, check_result);
    if (!std::isfinite(*check_result.computed)) return check_result;
    conclude(check_result, *check_result.computed - 1, criterion_.leading_term->within);
    return check_result;
  }

  [[nodiscard]] CheckResult richardson() const {
    CheckResult check_result = start(".richardson", "relative", unit_of(check_.quantity));
    check_result.expected = found_.exact;
    if (lacks_asymptotic_range(check_result)) return check_result;
    if (!found_.richardson) {
      check_result.message = "the values have no extrapolated limit";
      return check_result;
    }
    check_result.computed = *found_.richardson;
    const double exact = *found_.exact;
    conclude(check_result, (*found_.richardson - exact) / std::abs(exact),
             *criterion_.richardson_within);
    return check_result;
  }

  const Check& check_;
  const OrderCriterion& criterion_;
  const Entry& entry_;
  const Convergence& found_;
  std::vector<bool> qualifies_;
  std::size_t meshes_ = 0;
  bool is_other_solver_ = false;
};

}  // namespace

std::vector<CheckResult> evaluate_order_check(const Check& check, const CheckContext& context) {
  const OrderCriterion& criterion = *check.order;
  const bool is_other_solver = context.other_solver != nullptr;
  if (is_other_solver && !context.other_solver->element_order) {
    CheckResult unknown = failed_check_result(check, "the solver states no 'element_order'");
    unknown.verdict = Verdict::not_given;
    return {unknown};
  }
  std::vector<CheckResult> all;
  std::size_t position = 0;
  for (const Convergence& series : context.convergence) {
    if (series.sweep != criterion.sweep || series.quantity != check.quantity ||
        series.statistic != check.statistic) {
      continue;
    }
    const bool chosen =
        check.index.empty() || contains(check.index, static_cast<std::size_t>(series.index));
    if (!chosen) continue;
    if (!criterion.of_errors &&
        series.exact != reference_entry(find_reference(context, check.pointer + "/reference"),
                                        check.reference_index, position)) {
      all.push_back(failed_check_result(
          check, fmt::format("the refinement's errors are taken against {}, not against {}",
                             series.reference.empty() ? "no reference" : series.reference,
                             check.reference)));
      all.back().index = series.index;
      ++position;
      continue;
    }
    Entry entry{series};
    if (criterion.wave_number) {
      const auto& reference =
          find_reference(context, criterion.wave_number->pointer + "/reference");
      entry.wave_number = reference_entry(reference, criterion.wave_number->index, position);
    }
    if (criterion.leading_term && !criterion.leading_term->share.empty()) {
      const auto& reference = find_reference(context, criterion.leading_term->pointer + "/share");
      entry.share = reference_entry(reference, {}, position);
    }
    const auto judged = OrderCheckEvaluator(check, entry, is_other_solver).run();
    all.insert(all.end(), judged.begin(), judged.end());
    ++position;
  }
  const std::size_t wanted = std::max<std::size_t>(1, check.index.size());
  if (position < wanted)
    all.push_back(failed_check_result(
        check, fmt::format("the sweep '{}' records {} entries of {}, {} are judged",
                           criterion.sweep, position, check.quantity, wanted)));
  std::ranges::stable_sort(
      all, [](const CheckResult& a, const CheckResult& b) { return a.name < b.name; });
  return all;
}

}  // namespace trammel::harness

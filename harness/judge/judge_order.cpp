#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/judge/judge.h"
#include "harness/base/text.h"

namespace trammel {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// One entry of the quantity, with what theory says of it.
struct Entry {
  const Convergence& found;
  double wave_number = nothing;  ///< times the length of the swept member
  double share = 1;
};

double entry_of(const Reference& reference, const std::vector<std::size_t>& index,
                std::size_t position) {
  const std::size_t at = index.empty() ? position : index.at(position);
  return at < reference.values.size() ? reference.values[at] : nothing;
}

class OrderJudge {
 public:
  OrderJudge(const Check& check, const Entry& entry)
      : check_(check), demand_(*check.order), entry_(entry), found_(entry.found) {
    for (std::size_t k = 0; k < found_.error.size(); ++k) qualifies_.push_back(qualifies(k));
    meshes_ = static_cast<std::size_t>(std::count(qualifies_.begin(), qualifies_.end(), true));
  }

  [[nodiscard]] std::vector<Judgement> run() const {
    std::vector<Judgement> all = {demand_.two_term_within ? two_term() : order()};
    if (demand_.leading_term) all.push_back(leading_term());
    if (demand_.richardson_within) all.push_back(richardson());
    for (Judgement& one : all) one.index = found_.series.index;
    return all;
  }

 private:
  [[nodiscard]] bool qualifies(std::size_t k) const {
    if (!demand_.wave_number) return found_.in_asymptotic_range[k];
    const bool fine = entry_.wave_number * found_.series.size[k] <= demand_.wave_number->at_most;
    return fine && std::isfinite(found_.error[k]) && !found_.at_roundoff_floor[k];
  }

  /// Whether anything can be said at all.
  bool lacks_evidence(Judgement& one) const {
    if (found_.broken) {
      one.message = "a refined level has no finite value";
    } else if (!found_.series.exact) {
      one.message = "there is no exact value to measure errors by";
    } else if (meshes_ < demand_.meshes) {
      one.message = "only " + std::to_string(meshes_) + " meshes qualify, " +
                    std::to_string(demand_.meshes) + " are needed";
    } else {
      return false;
    }
    return true;
  }

  void conclude(Judgement& one, double value, double limit) const {
    one.difference = value;
    one.window = Window{-limit, limit};
    one.symmetric = true;
    one.verdict = std::abs(value) <= limit ? Verdict::pass : Verdict::fail;
    if (one.message.empty()) one.message = std::to_string(meshes_) + " meshes qualify";
  }

  [[nodiscard]] Judgement start(const std::string& suffix, std::string measure,
                                std::string unit) const {
    Judgement one = start_judgement(check_);
    one.name += suffix;
    one.measure = std::move(measure);
    one.unit = std::move(unit);
    return one;
  }

  /// The number of a qualifying level that is farthest from `target`.
  template <class Value>
  double worst(double target, const Value& value, Judgement& one) const {
    double farthest = nothing;
    for (std::size_t k = 0; k < qualifies_.size(); ++k) {
      if (!qualifies_[k]) continue;
      const double here = value(k);
      if (std::isnan(here)) continue;
      if (std::isnan(farthest) || std::abs(here - target) > std::abs(farthest - target)) {
        farthest = here;
        one.message = std::to_string(meshes_) + " meshes qualify, the worst is " +
                      shortest(found_.series.parameter[k]);
      }
    }
    return farthest;
  }

  [[nodiscard]] Judgement order() const {
    Judgement one = start("", "order", "1");
    one.expected = found_.series.theory;
    if (lacks_evidence(one)) return one;
    const double theory = *found_.series.theory;
    const std::optional<double> fitted = slope(found_.series.size, found_.error, qualifies_);
    if (!fitted) {
      one.message = "fewer than two meshes qualify";
      return one;
    }
    one.computed = *fitted;
    const double farthest = worst(
        theory,
        [&](std::size_t k) { return k > 0 && qualifies_[k - 1] ? found_.order[k] : nothing; }, one);
    one.message = std::to_string(meshes_) + " meshes qualify; between two of them at worst " +
                  shortest(farthest);
    conclude(one, *one.computed - theory, demand_.within);
    return one;
  }

  /// The largest relative distance of the law from an error, over the meshes that it is fitted to.
  [[nodiscard]] Judgement two_term() const {
    Judgement one = start("", "two-term", "1");
    one.expected = 0;
    if (lacks_evidence(one)) return one;
    if (!found_.two_term) {
      one.message = "no two-term law could be fitted";
      return one;
    }
    const auto& [a, b] = found_.two_term->coefficient;
    one.computed = found_.two_term->worst;
    one.message = std::to_string(meshes_) + " meshes qualify; relative error = " + shortest(a) +
                  " h^" + shortest(*found_.series.theory) + " + " + shortest(b) + " h^" +
                  shortest(*found_.series.lower);
    conclude(one, *one.computed, *demand_.two_term_within);
    return one;
  }

  [[nodiscard]] Judgement leading_term() const {
    Judgement one = start(".leading-term", "leading-term", "1");
    one.expected = 1;
    if (lacks_evidence(one)) return one;
    const double exact = *found_.series.exact;
    const auto ratio = [&](std::size_t k) {
      const double error = (found_.series.values[k] - exact) / std::abs(exact);
      const double step = entry_.wave_number * found_.series.size[k];
      return error / (demand_.leading_term->coefficient * entry_.share *
                      std::pow(step, *found_.series.theory));
    };
    one.computed = worst(1, ratio, one);
    if (!std::isfinite(*one.computed)) return one;
    conclude(one, *one.computed - 1, demand_.leading_term->within);
    return one;
  }

  [[nodiscard]] Judgement richardson() const {
    Judgement one = start(".richardson", "relative", unit_of(check_.quantity));
    one.expected = found_.series.exact;
    if (lacks_evidence(one)) return one;
    if (!found_.richardson) {
      one.message = "there is no extrapolated value";
      return one;
    }
    one.computed = *found_.richardson;
    const double exact = *found_.series.exact;
    conclude(one, (*found_.richardson - exact) / std::abs(exact), *demand_.richardson_within);
    return one;
  }

  const Check& check_;
  const OrderDemand& demand_;
  const Entry& entry_;
  const Convergence& found_;
  std::vector<bool> qualifies_;
  std::size_t meshes_ = 0;
};

}  // namespace

std::vector<Judgement> judge_order(const Check& check, const Evidence& evidence) {
  const OrderDemand& demand = *check.order;
  std::vector<Judgement> all;
  std::size_t position = 0;
  for (const Convergence& found : evidence.convergence) {
    const Series& series = found.series;
    if (series.sweep != demand.sweep || series.quantity != check.quantity ||
        series.statistic != check.statistic) {
      continue;
    }
    const bool chosen = check.index.empty() || std::find(check.index.begin(), check.index.end(),
                                                         series.index) != check.index.end();
    if (!chosen) continue;
    Entry entry{found};
    if (demand.wave_number) {
      const auto& reference = find_reference(evidence, demand.wave_number->pointer + "/reference");
      entry.wave_number = entry_of(reference, demand.wave_number->index, position);
    }
    if (demand.leading_term && !demand.leading_term->share.empty()) {
      const auto& reference = find_reference(evidence, demand.leading_term->pointer + "/share");
      entry.share = entry_of(reference, {}, position);
    }
    const auto judged = OrderJudge(check, entry).run();
    all.insert(all.end(), judged.begin(), judged.end());
    ++position;
  }
  const std::size_t wanted = std::max<std::size_t>(1, check.index.size());
  if (position < wanted) {
    all.push_back(failed_judgement(check, "the sweep '" + demand.sweep + "' follows " +
                                              std::to_string(position) + " entries of " +
                                              check.quantity + ", " + std::to_string(wanted) +
                                              " are judged"));
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Judgement& a, const Judgement& b) { return a.name < b.name; });
  return all;
}

}  // namespace trammel

#include <algorithm>
#include <cmath>

#include "harness/base/find_or_add.h"
#include "reports/drawing/interval.h"
#include "reports/sections/sections.h"
#include "reports/text/html.h"
#include "reports/text/number.h"
#include "reports/text/quantity.h"

namespace trammel::reports {

namespace {

constexpr double kOrderTolerance = 0.1;
constexpr std::size_t kMaxUnfoldedOrders = 24;  ///< rows of a family's table that is not folded

/// How many bands hold the exact value, and how wide they are for the error that there is.
struct GciCoverage {
  std::size_t levels = 0, hits = 0;
  std::vector<double> ratios;

  void add(const Convergence& c) {
    if (!c.exact || *c.exact == 0) return;
    for (std::size_t k = 0; k < c.gci.size(); ++k) {
      if (!c.gci[k] || !c.values[k] || !c.error[k]) continue;
      // The band is relative to the value, the error to the exact one.
      const double half_width = *c.gci[k] * std::abs(*c.values[k] / *c.exact);
      ++levels;
      hits += half_width >= *c.error[k] ? 1 : 0;
      if (!c.at_roundoff_floor[k] && *c.error[k] > 0) ratios.push_back(half_width / *c.error[k]);
    }
  }
  void add(const GciCoverage& more) {
    levels += more.levels;
    hits += more.hits;
    ratios.insert(ratios.end(), more.ratios.begin(), more.ratios.end());
  }
  [[nodiscard]] Number median() const {
    if (ratios.empty()) return std::nullopt;
    std::vector<double> sorted = ratios;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    return *middle;
  }
};

Number finite(const Number& x) {
  return x && std::isfinite(*x) ? x : std::nullopt;
}

/// Entries of one quantity along one sweep of one run.
struct OrderRow {
  const Run* run;
  std::vector<const Convergence*> entries;

  [[nodiscard]] const Convergence& front() const { return *entries.front(); }
};

std::vector<OrderRow> rows_of(const Run& run) {
  std::vector<OrderRow> rows;
  for (const Convergence& c : run.convergence) {
    const auto same = [&](const OrderRow& row) {
      return row.front().sweep == c.sweep && row.front().quantity == c.quantity;
    };
    harness::find_or_add(rows, same, {&run, {}}).entries.push_back(&c);
  }
  return rows;
}

double largest_finite(const Numbers& numbers, bool first) {
  double found = 0;
  for (const Number& x : numbers) {
    if (!x || !std::isfinite(*x)) continue;
    found = *x;
    if (first) break;
  }
  return found;
}

/// What a row has to say, over its entries.
struct Findings {
  Interval order, law;
  double first = 0, last = 0;
  double off = -1;  ///< of the extrapolated value from the exact one; below 0: not known
  std::size_t fitted = 0, near = 0;  ///< entries with a fitted order, and with one near theory
  GciCoverage coverage;
};

Findings summarise(const OrderRow& row) {
  Findings found;
  for (const Convergence* c : row.entries) {
    if (!c->lower_order) found.order.cover(finite(c->fitted_order));
    if (c->two_term) found.law.cover(finite(c->two_term->max_relative_misfit));
    found.first = std::max(found.first, largest_finite(c->error, true));
    found.last = std::max(found.last, largest_finite(c->error, false));
    if (c->exact && *c->exact != 0 && c->richardson)
      found.off = std::max(found.off, std::abs(*c->richardson / *c->exact - 1));
    if (!c->lower_order && c->fitted_order && c->theory_order) {
      ++found.fitted;
      const double apart = std::abs(*c->fitted_order - *c->theory_order);
      found.near += apart <= kOrderTolerance * std::max(1.0, *c->theory_order) ? 1 : 0;
    }
    found.coverage.add(*c);
  }
  return found;
}

std::string theory_text(const Convergence& c) {
  if (!c.theory_order) return "–";
  const std::string order = trimmed(*c.theory_order, 4);
  return c.lower_order ? order + " and " + trimmed(*c.lower_order, 4) : order;
}

std::string observed_text(const Findings& found) {
  if (!found.law.empty()) return "law within " + relative(found.law.high, 2, false);
  if (found.order.empty()) return "–";
  return low_to_high(trimmed(found.order.low, 3), trimmed(found.order.high, 3));
}

Data data_of(const OrderRow& row, const Findings& found, const CaseInfo& info) {
  const QuantityLabel quantity = parse_quantity(row.front().quantity);
  return object(
      {{"quantity", to_text(quantity)},
       {"entries", row.entries.size() > 1 ? count(row.entries.size(), "entry", "entries") : ""},
       {"variant", row.run->variant == "base" ? "" : info.variant_title(row.run->variant)},
       {"theory", theory_text(row.front())},
       {"observed", observed_text(found)},
       {"error", significant(found.first, 2) + " to " + significant(found.last, 2)},
       {"off", found.off < 0 ? "–" : significant(found.off, 2)}});
}

std::string coverage_text(const GciCoverage& coverage) {
  if (coverage.levels == 0) return "";
  std::string text = "The numerical uncertainty (GCI) covers the exact value on " +
                     std::to_string(coverage.hits) + " of " + count(coverage.levels, "level");
  if (const Number median = coverage.median())
    text += " and is " + trimmed(*median, 3) + " times the error (median)";
  return text + ".";
}

struct Totals {
  std::size_t rows = 0, series = 0, fitted = 0, near = 0;
  double law = 0;
  GciCoverage coverage;
};

std::string orders_text(const Totals& totals) {
  std::string text = count(totals.series, "refinement") + ".";
  if (totals.fitted > 0)
    text += " The fitted order lies within a tenth of theory for " + std::to_string(totals.near) +
            " of " + std::to_string(totals.fitted) + ".";
  if (totals.law > 0)
    text += " Where two orders mix, the two-term law fits the errors within " +
            relative(totals.law, 2, false) + ".";
  return text;
}

Data family_of(const Family& family, Totals& totals) {
  Data cases = list();
  for (const CaseInfo* info : family.cases) {
    Data rows = list();
    for (const Run* run : family.runs_of(info->id)) {
      for (const OrderRow& row : rows_of(*run)) {
        const Findings found = summarise(row);
        rows.push_back(data_of(row, found, *info));
        ++totals.rows;
        totals.series += row.entries.size();
        totals.fitted += found.fitted;
        totals.near += found.near;
        if (!found.law.empty()) totals.law = std::max(totals.law, found.law.high);
        totals.coverage.add(found.coverage);
      }
    }
    if (rows.is_empty_list()) continue;
    cases.push_back(object({{"case_title", family.short_title(*info)},
                            {"case_link", case_link(info->id)},
                            {"rows", rows}}));
  }
  return object({{"family_title", family.title},
                 {"cases", cases},
                 {"words", orders_text(totals) + " " + coverage_text(totals.coverage)},
                 {"folded_title", count(totals.rows, "row")},
                 {"open", totals.rows <= kMaxUnfoldedOrders}});
}

}  // namespace

Data orders_section(const Results& results, const std::vector<Family>& families) {
  Data shown = list();
  std::size_t series = 0;
  for (const Family& family : families) {
    Totals totals;
    const Data data = family_of(family, totals);
    if (totals.rows == 0) continue;
    series += totals.series;
    shown.push_back(data);
  }
  std::string text;
  if (results.uncertainty_coverage && results.uncertainty_coverage->levels > 0) {
    const UncertaintyCoverage& found = *results.uncertainty_coverage;
    const double rate = static_cast<double>(found.covered) / found.levels;
    text =
        "The numerical uncertainty (GCI), estimated from the computed values alone, covers the "
        "exact value on " +
        std::to_string(found.covered) + " of " + std::to_string(found.levels) + " levels (" +
        relative(rate, 3, false) + ")";
    if (found.min_coverage) text += "; " + relative(*found.min_coverage, 3, false) + " is required";
    if (found.median_ratio)
      text += ". In the median it is " + trimmed(*found.median_ratio, 3) + " times the true error";
    if (found.max_median_ratio)
      text += "; a median above " + trimmed(*found.max_median_ratio, 3) +
              " times the true error counts as too conservative";
    text += ".";
  }
  return object({{"has_rows", series > 0},
                 {"words", count(series, "quantity", "quantities") +
                               " refined; the theoretical and the observed order of each."},
                 {"coverage", text},
                 {"families", shown}});
}

}  // namespace trammel::reports

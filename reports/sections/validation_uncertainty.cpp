#include "reports/sections/validation_uncertainty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "harness/base/find_or_add.h"
#include "reports/data/variant_rows.h"
#include "reports/sections/check_status_data.h"
#include "reports/text/html.h"
#include "reports/text/number.h"
#include "reports/text/quantity.h"
#include "reports/text/words.h"

namespace trammel::reports {

namespace {

constexpr std::size_t kMaxUnfoldedComparisons = 8;
constexpr double kFullColourOfUncertainty =
    0.4;  ///< relative difference that is drawn in full colour

/// One variant in one check.
struct ComparisonRow {
  const Run* run;
  std::map<int, const Comparison*> entries;
};

/// One check, which may compare entries of a reference in another order than another check.
struct ComparisonSubject {
  const CaseInfo* info;
  std::string reference, quantity, check;
  std::vector<ComparisonRow> rows;
  std::map<int, double> targets;
};

void add_run(const Run& run, const CaseInfo& info, std::vector<ComparisonSubject>& subjects) {
  if (!run.uncertainty) return;
  for (const Comparison& c : run.uncertainty->comparisons) {
    if (!c.expected || *c.expected == 0 || !c.difference || !c.u_val) continue;
    const auto same = [&](const ComparisonSubject& known) {
      return known.info == &info && known.reference == c.reference && known.check == c.check;
    };
    auto& subject =
        harness::find_or_add(subjects, same, {&info, c.reference, c.quantity, c.check, {}, {}});
    if (subject.rows.empty() || subject.rows.back().run != &run) subject.rows.push_back({&run, {}});
    subject.rows.back().entries[c.index] = &c;
    subject.targets.emplace(c.index, *c.expected);
  }
}

/// Number of each verdict, and of the entries that an input dominates.
struct Tally {
  std::map<std::string, std::size_t> verdict, dominant;
  std::size_t entries = 0;

  void add(const ComparisonRow& row) {
    for (const auto& [_, c] : row.entries) {
      ++entries;
      ++verdict[c->verdict];
      if (!c->dominant_input.empty()) ++dominant[c->dominant_input];
    }
  }
};

std::string verdict_text(const Tally& counts) {
  constexpr std::array<std::pair<const char*, const char*>, 4> words = {{
      {"within-uncertainty", "within the validation uncertainty"},
      {"model-error", "with a model error"},
      {"reference-inconsistent", "against an inconsistent reference"},
      {"undecided", "undecided"},
  }};
  std::string text;
  for (const auto& [key, text_of_key] : words) {
    const auto found = counts.verdict.find(key);
    if (found == counts.verdict.end()) continue;
    add_item(text, std::to_string(found->second) + " " + text_of_key);
  }
  return text;
}

std::string dominant_text(const Tally& counts) {
  const auto most = std::ranges::max_element(
      counts.dominant, [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most == counts.dominant.end()) return "";
  return " The dominant input is the " + spaced(most->first) + ", for " +
         std::to_string(most->second) + " of " + std::to_string(counts.entries) + ".";
}

/// The inputs that dominate a row, each with its modes' largest share.
std::string dominant_text(const ComparisonRow& row) {
  std::map<std::string, Number> shares;
  for (const auto& [_, c] : row.entries) {
    if (c->dominant_input.empty()) continue;
    Number& share = shares[c->dominant_input];
    if (c->dominant_share && (!share || *share < *c->dominant_share)) share = c->dominant_share;
  }
  std::string text;
  for (const auto& [name, share] : shares) {
    add_item(text, spaced(name), "; ");
    if (share) text += ", up to " + relative(*share, 2, false);
  }
  return text.empty() ? "–" : text;
}

Data cell_of(const Comparison* c) {
  if (!c) return object({{"filled", false}});
  const double difference = *c->difference / std::abs(*c->expected);
  std::string words = c->conclusion;
  if (!c->all_inputs.conclusion.empty())
    words +=
        " With nominal lengths as uncertain as their printed digits: " + c->all_inputs.conclusion;
  return object(
      {{"filled", true},
       {"difference", relative(difference, 3, true)},
       {"expanded_uncertainty", relative(2 * *c->u_val / std::abs(*c->expected), 2, false)},
       {"verdict", c->verdict},
       {"side", difference < 0 ? "below" : "above"},
       {"depth", trimmed(std::min(1.0, std::abs(difference) / kFullColourOfUncertainty), 2)},
       {"words", words}});
}

Data row_of(const ComparisonRow& row, const ComparisonSubject& subject) {
  return object({{"title", subject.info->variant_title(row.run->variant)},
                 {"cells", target_cells(subject.targets, row.entries, cell_of)},
                 {"dominant", dominant_text(row)}});
}

Data table_of(const ComparisonSubject& subject, bool is_only, const Results& results) {
  const Reference* reference = results.reference(subject.reference);
  const bool modes = subject.quantity.starts_with("frequency");
  Tally counts;
  for (const ComparisonRow& row : subject.rows) counts.add(row);
  Data table = object({{"title", reference ? reference->title : subject.reference},
                       {"reference_link", reference ? reference_link(reference->id) : ""},
                       {"unit", reference ? display_unit(reference->unit) : ""},
                       {"check", is_only ? "" : spaced(subject.check)},
                       {"case_title", subject.info->title},
                       {"case_link", case_link(subject.info->id)},
                       {"columns", target_columns(subject.targets, modes ? "mode " : "entry ")},
                       {"words", "Of " + count(counts.entries, "comparison") + ": " +
                                     verdict_text(counts) + "." + dominant_text(counts)}});
  set_variant_rows(table, subject.rows.size(), kMaxUnfoldedComparisons,
                   [&](std::size_t i) { return row_of(subject.rows[i], subject); });
  return table;
}

}  // namespace

Data validation_uncertainty_section(const Results& results, const std::vector<Family>& families) {
  std::vector<ComparisonSubject> subjects;
  for (const Family& family : families)
    for (const CaseInfo* info : family.cases)
      for (const Run* run : family.runs_of(info->id)) add_run(*run, *info, subjects);
  Tally all;
  Data tables = list();
  for (const ComparisonSubject& subject : subjects) {
    for (const ComparisonRow& row : subject.rows) all.add(row);
    const auto same = std::ranges::count_if(subjects, [&](const ComparisonSubject& other) {
      return other.info == subject.info && other.reference == subject.reference;
    });
    tables.push_back(table_of(subject, same == 1, results));
  }
  return object({{"has_rows", !subjects.empty()},
                 {"words", count(all.entries, "comparison") +
                               " with the paper: " + verdict_text(all) + "." + dominant_text(all)},
                 {"tables", tables}});
}

}  // namespace trammel::reports

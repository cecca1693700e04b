#include <algorithm>
#include <array>

#include "reports/text/number.h"
#include "reports/text/quantity.h"
#include "reports/page/sections.h"

namespace trammel::reports {

namespace {

/// How the page marks a verdict: the words say it, the sign and its colour only help to find it.
struct Mark {
  const char *verdict, *css_class, *sign;
};
constexpr std::array<Mark, 10> marks = {{
    {"confirmed", "holds", "✓"},
    {"confirmed in part", "known", "±"},
    {"contradicted", "fails", "≠"},
    {"cannot be decided", "recorded", "?"},
    {"not measured", "not-run", "–"},
    {"confirms", "holds", "✓"},
    {"contradicts", "fails", "≠"},
    {"confirms in part", "known", "±"},
    {"decides nothing", "recorded", "?"},
    {"", "not-run", "–"},
}};

void set_mark(Data& data, const std::string& verdict) {
  const auto* found = std::find_if(marks.begin(), marks.end() - 1,
                                   [&](const Mark& mark) { return verdict == mark.verdict; });
  data.set("verdict", verdict);
  data.set("standing_class", found->css_class);
  data.set("sign", found->sign);
}

std::string number_text(const ClaimReading& reading, double value) {
  if (reading.take == "relative") return relative(value, 3, true);
  if (reading.take == "ratio") return "× " + trimmed(value, 4);
  const std::string unit = unit_for_people(reading.unit);
  return trimmed(value, 4) + (unit.empty() ? "" : "\u202f" + unit);
}

/// The value, or the least and the most of several.
std::string measured(const ClaimReading& reading) {
  if (reading.entries.empty()) return "";
  const auto [least, most] = std::minmax_element(
      reading.entries.begin(), reading.entries.end(),
      [](const ClaimEntry& a, const ClaimEntry& b) { return a.value < b.value; });
  const std::string low = number_text(reading, least->value);
  const std::string high = number_text(reading, most->value);
  return low == high ? low : low + " to " + high;
}

Data reading_data(const ClaimReading& reading, const Results& results) {
  Data data = object();
  set_mark(data, reading.verdict);
  data.set("what", reading.what);
  set_text(data, "measured", measured(reading));
  Data cases = list();
  std::vector<std::string> seen;
  for (const ClaimEntry& entry : reading.entries) {
    const bool listed = std::any_of(results.runs.begin(), results.runs.end(),
                                    [&](const Run& run) { return run.case_id == entry.case_id; });
    if (!listed || std::find(seen.begin(), seen.end(), entry.case_id) != seen.end()) continue;
    seen.push_back(entry.case_id);
    Data one = object();
    one.set("case_id", entry.case_id);
    one.set("case_anchor", case_anchor(entry.case_id));
    cases.push_back(one);
  }
  data.set("cases", cases);
  return data;
}

Data claim_data(const Claim& claim, const Results& results) {
  Data data = object();
  data.set("id", claim.id);
  data.set("claim", claim.claim);
  data.set("place", claim.place);
  data.set("conclusion", claim.verdict == "not measured" ? "No case of these results measures it."
                                                         : claim.conclusion);
  set_text(data, "undecidable", claim.undecidable);
  set_mark(data, claim.verdict);
  set_text(
      data, "differs",
      claim.verdict == claim.expected || claim.verdict == "not measured" ? "" : claim.expected);
  Data readings = list();
  for (const ClaimReading& reading : claim.readings)
    readings.push_back(reading_data(reading, results));
  data.set("readings", readings);
  return data;
}

/// "2 confirmed, 4 contradicted, ..."
std::string overview(const Claims& ledger) {
  std::string text;
  for (const Mark& mark : marks) {
    const auto n = std::count_if(ledger.claims.begin(), ledger.claims.end(),
                                 [&](const Claim& claim) { return claim.verdict == mark.verdict; });
    if (n > 0) text += (text.empty() ? "" : ", ") + std::to_string(n) + " " + mark.verdict;
  }
  return count(ledger.claims.size(), "claim") + ": " + text +
         ". A verdict follows from the readings below it by a recorded rule, and a test fails when "
         "it no longer does.";
}

}  // namespace

Data claims_section(const Results& results) {
  Data section = object();
  if (!results.ledger) return section;
  section.set("title", results.ledger->title);
  section.set("overview", overview(*results.ledger));
  Data claims = list();
  for (const Claim& claim : results.ledger->claims) claims.push_back(claim_data(claim, results));
  section.set("list", claims);
  return section;
}

}  // namespace trammel::reports

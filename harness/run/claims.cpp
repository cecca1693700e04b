#include "harness/run/claims.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "harness/base/data_root.h"
#include "harness/base/json_file.h"
#include "harness/base/statistic.h"

namespace trammel {
namespace {

constexpr const char* ledger_file = "varalakshmi-2017.json";

/// Which values a window holds; one side may take all that the other's window does not.
struct Rule {
  std::optional<Window> confirms, contradicts;
  ReadingVerdict otherwise = ReadingVerdict::undecided;
  bool jointly = false;  ///< the entries of one check count as one

  [[nodiscard]] ReadingVerdict of(double value) const {
    if (confirms && confirms->contains(value)) return ReadingVerdict::confirms;
    if (contradicts && contradicts->contains(value)) return ReadingVerdict::contradicts;
    return otherwise;
  }
};

Window read_window(const Cursor& interval) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto side = [&](std::size_t i, double open) {
    return interval[i].json().is_null() ? open : interval[i].get<double>();
  };
  return {side(0, -infinity), side(1, infinity)};
}

Rule read_rule(const Cursor& reading) {
  Rule rule;
  rule.jointly = reading.get("jointly", false);
  const auto read = [&](const char* key, std::optional<Window>& window, ReadingVerdict verdict) {
    if (!reading.has(key)) return;
    if (!reading[key].json().is_string()) {
      window = read_window(reading[key]);
    } else {
      rule.otherwise = verdict;
    }
  };
  read("confirms", rule.confirms, ReadingVerdict::confirms);
  read("contradicts", rule.contradicts, ReadingVerdict::contradicts);
  if (!rule.confirms && !rule.contradicts) {
    throw reading.error("expected a window in 'confirms' or 'contradicts'");
  }
  if (rule.confirms && rule.contradicts && rule.confirms->low < rule.contradicts->high &&
      rule.contradicts->low < rule.confirms->high) {
    throw reading.error("expected windows of which no value is in both");
  }
  return rule;
}

bool matches(const std::string& name, const std::string& pattern) {
  if (pattern.empty() || pattern.back() != '*') return name == pattern;
  return name.compare(0, pattern.size() - 1, pattern, 0, pattern.size() - 1) == 0;
}

bool wants(const Cursor& reading, const Run& run) {
  if (reading.has("case") && reading.text("case") != run.case_id) return false;
  if (!reading.has("variants")) return true;
  const auto variants = reading["variants"].get<std::vector<std::string>>();
  return std::find(variants.begin(), variants.end(), run.variant) != variants.end();
}

std::optional<double> taken(const std::string& take, const Judgement& one) {
  if (take == "value") return one.computed;
  if (!one.computed || !one.expected) return std::nullopt;
  const double computed = *one.computed, expected = *one.expected;
  if (take == "difference") return computed - expected;
  if (expected == 0) return std::nullopt;
  return take == "ratio" ? computed / expected : (computed - expected) / std::abs(expected);
}

void add_checks(const Cursor& reading, const Run& run, LedgerReading& found) {
  for (const Judgement& one : run.judgements) {
    const bool named = reading.has("check") && matches(one.name, reading.text("check"));
    const bool against = reading.has("reference") && one.reference == reading.text("reference");
    if (!named && !against) continue;
    if (reading.has("index")) {
      const auto index = reading["index"].get<std::vector<std::size_t>>();
      const bool chosen =
          one.index && std::find(index.begin(), index.end(), *one.index) != index.end();
      if (!chosen) continue;
    }
    const auto value = taken(found.take, one);
    if (run.status != "solved" || !value || !std::isfinite(*value)) {
      found.incomplete = true;
      continue;
    }
    found.unit = found.take == "ratio" || found.take == "relative" ? "1" : one.unit;
    found.entries.push_back({run.case_id, run.variant, one.name, *value});
  }
}

void add_quantity(const Cursor& reading, const Run& run, LedgerReading& found) {
  const std::string name = reading.text("quantity");
  const auto quantity = run.result.quantities.find(name);
  if (quantity == run.result.quantities.end() || quantity->second.values.empty()) {
    found.incomplete = true;
    return;
  }
  std::vector<double> values;
  const std::vector<double>& all = quantity->second.values;
  if (reading.has("index")) {
    for (const auto i : reading["index"].get<std::vector<std::size_t>>()) {
      if (i >= all.size()) {
        throw reading["index"].error("expected entries that " + name + " has, which are " +
                                     std::to_string(all.size()));
      }
      values.push_back(all[i]);
    }
  } else {
    values = all;
  }
  if (found.take == "steps") {
    std::adjacent_difference(values.begin(), values.end(), values.begin());
    values.erase(values.begin());
  }
  if (reading.has("statistic")) values = {statistic_of(reading.text("statistic"), values)};
  found.unit = unit_of(name);
  for (const double value : values) {
    if (std::isfinite(value)) {
      found.entries.push_back({run.case_id, run.variant, name, value});
    } else {
      found.incomplete = true;
    }
  }
}

/// One verdict for each entry, or for each check: it confirms where all its entries do, and
/// contradicts where one does.
std::vector<ReadingVerdict> verdicts_of(const Rule& rule, const std::vector<LedgerEntry>& entries) {
  std::vector<ReadingVerdict> verdicts;
  const LedgerEntry* before = nullptr;
  for (const LedgerEntry& entry : entries) {
    const ReadingVerdict verdict = rule.of(entry.value);
    const bool same = rule.jointly && before && before->case_id == entry.case_id &&
                      before->variant == entry.variant && before->name == entry.name;
    before = &entry;
    if (!same) {
      verdicts.push_back(verdict);
    } else if (verdicts.back() != ReadingVerdict::contradicts &&
               verdict != ReadingVerdict::confirms) {
      verdicts.back() = verdict;
    }
  }
  return verdicts;
}

ReadingVerdict verdict_of(const Rule& rule, const std::vector<LedgerEntry>& entries) {
  const std::vector<ReadingVerdict> each = verdicts_of(rule, entries);
  const std::set<ReadingVerdict> verdicts(each.begin(), each.end());
  if (verdicts.empty()) return ReadingVerdict::not_measured;
  if (verdicts.size() == 1) return *verdicts.begin();
  if (verdicts.count(ReadingVerdict::confirms) > 0) return ReadingVerdict::in_part;
  return ReadingVerdict::undecided;
}

LedgerReading judge_reading(const std::string& name, const Cursor& reading,
                            const std::vector<Run>& runs) {
  LedgerReading found;
  found.name = name;
  found.what = reading.text("what");
  found.take = reading.text("take");
  const bool by_check = reading.has("check") || reading.has("reference");
  if (by_check == reading.has("quantity")) {
    throw reading.error("expected either a 'check' or 'reference', or a 'quantity'");
  }
  if (by_check ? found.take == "steps" || reading.has("statistic")
               : found.take != "value" && found.take != "steps") {
    throw reading["take"].error(
        "expected a check's value, ratio, relative or difference, or a "
        "quantity's value or steps");
  }
  const Rule rule = read_rule(reading);
  for (const Run& run : runs) {
    if (!wants(reading, run)) continue;
    by_check ? add_checks(reading, run, found) : add_quantity(reading, run, found);
  }
  if (!found.incomplete) found.verdict = verdict_of(rule, found.entries);
  return found;
}

ClaimVerdict verdict_of(const std::vector<LedgerReading>& readings, bool alternatives) {
  std::set<ReadingVerdict> verdicts;
  for (const LedgerReading& reading : readings) {
    if (reading.incomplete) return ClaimVerdict::not_measured;
    verdicts.insert(reading.verdict);
  }
  verdicts.erase(ReadingVerdict::not_measured);
  if (verdicts.empty()) return ClaimVerdict::not_measured;
  if (verdicts.size() == 1) {
    switch (*verdicts.begin()) {
      case ReadingVerdict::confirms:
        return ClaimVerdict::confirmed;
      case ReadingVerdict::contradicts:
        return ClaimVerdict::contradicted;
      case ReadingVerdict::in_part:
        return alternatives ? ClaimVerdict::cannot_be_decided : ClaimVerdict::confirmed_in_part;
      default:
        return ClaimVerdict::cannot_be_decided;
    }
  }
  const bool some =
      verdicts.count(ReadingVerdict::confirms) + verdicts.count(ReadingVerdict::in_part) > 0;
  return some && !alternatives ? ClaimVerdict::confirmed_in_part : ClaimVerdict::cannot_be_decided;
}

ClaimVerdict read_verdict(const std::string& word) {
  if (word == "confirmed") return ClaimVerdict::confirmed;
  if (word == "confirmed-in-part") return ClaimVerdict::confirmed_in_part;
  if (word == "contradicted") return ClaimVerdict::contradicted;
  return word == "not-measured" ? ClaimVerdict::not_measured : ClaimVerdict::cannot_be_decided;
}

LedgerClaim judge_claim(const std::string& id, const Cursor& claim, const std::vector<Run>& runs) {
  LedgerClaim found;
  found.id = id;
  found.claim = claim.text("claim");
  found.place = claim.text("place");
  found.conclusion = claim.text("conclusion");
  found.expected = read_verdict(claim.text("expected"));
  if (claim.has("readings") == claim.has("undecidable")) {
    throw claim.error("expected either 'readings' or why it is 'undecidable'");
  }
  if (claim.has("undecidable")) {
    found.undecidable = claim.text("undecidable");
    found.verdict = ClaimVerdict::cannot_be_decided;
    return found;
  }
  for (const auto& [name, reading] : claim["readings"].entries()) {
    found.readings.push_back(judge_reading(name, reading, runs));
  }
  found.verdict =
      verdict_of(found.readings, claim.get<std::string>("together", "parts") == "alternatives");
  return found;
}

bool rests_on(const Cursor& reading, const Case& one) {
  if (reading.has("case")) return reading.text("case") == one.id();
  const auto checks = Cursor(one.document).find("checks");
  if (!checks) return false;
  for (const auto& [name, check] : checks->entries()) {
    if (reading.has("check") && matches(name, reading.text("check"))) return true;
    if (reading.has("reference") &&
        check.get<std::string>("reference", "") == reading.text("reference")) {
      return true;
    }
  }
  return false;
}

}  // namespace

bool Ledger::follows() const {
  return std::all_of(claims.begin(), claims.end(),
                     [](const LedgerClaim& claim) { return claim.follows(); });
}

Document load_ledger() {
  const auto file = home() / "cases" / "paper" / "claims" / ledger_file;
  Document document;
  document.lay(file.string(), "", read_json(file));
  document.check("ledger");
  return document;
}

std::vector<Case> cases_of(const Document& ledger, const std::vector<Case>& catalogue) {
  std::vector<Cursor> readings;
  for (const auto& [id, claim] : Cursor(ledger)["claims"].entries()) {
    if (!claim.has("readings")) continue;
    for (const auto& [name, reading] : claim["readings"].entries()) readings.push_back(reading);
  }
  std::vector<Case> cases;
  std::copy_if(catalogue.begin(), catalogue.end(), std::back_inserter(cases), [&](const Case& one) {
    return std::any_of(readings.begin(), readings.end(),
                       [&](const Cursor& reading) { return rests_on(reading, one); });
  });
  return cases;
}

Ledger judge_ledger(const Document& document, const std::vector<Run>& runs) {
  const Cursor root(document);
  Ledger ledger{root.text("title"), root.text("source"), {}};
  for (const auto& [id, claim] : root["claims"].entries()) {
    ledger.claims.push_back(judge_claim(id, claim, runs));
  }
  return ledger;
}

std::string in_words(ClaimVerdict verdict) {
  switch (verdict) {
    case ClaimVerdict::confirmed:
      return "confirmed";
    case ClaimVerdict::confirmed_in_part:
      return "confirmed in part";
    case ClaimVerdict::contradicted:
      return "contradicted";
    case ClaimVerdict::cannot_be_decided:
      return "cannot be decided";
    case ClaimVerdict::not_measured:
      return "not measured";
  }
  return "";
}

std::string in_words(ReadingVerdict verdict) {
  switch (verdict) {
    case ReadingVerdict::confirms:
      return "confirms";
    case ReadingVerdict::contradicts:
      return "contradicts";
    case ReadingVerdict::in_part:
      return "confirms in part";
    case ReadingVerdict::undecided:
      return "decides nothing";
    case ReadingVerdict::not_measured:
      return "not measured";
  }
  return "";
}

Json to_json(const Ledger& ledger) {
  Json json = {{"title", ledger.title}, {"follows", ledger.follows()}, {"claims", Json::array()}};
  for (const LedgerClaim& claim : ledger.claims) {
    Json one = {{"id", claim.id},
                {"claim", claim.claim},
                {"place", claim.place},
                {"verdict", in_words(claim.verdict)},
                {"expected", in_words(claim.expected)},
                {"conclusion", claim.conclusion},
                {"undecidable", claim.undecidable},
                {"readings", Json::array()}};
    for (const LedgerReading& reading : claim.readings) {
      Json its = {{"what", reading.what},
                  {"take", reading.take},
                  {"unit", reading.unit},
                  {"verdict", in_words(reading.verdict)},
                  {"entries", Json::array()}};
      for (const LedgerEntry& entry : reading.entries) {
        its["entries"].push_back({{"case", entry.case_id},
                                  {"variant", entry.variant},
                                  {"name", entry.name},
                                  {"value", entry.value}});
      }
      one["readings"].push_back(std::move(its));
    }
    json["claims"].push_back(std::move(one));
  }
  return json;
}

}  // namespace trammel

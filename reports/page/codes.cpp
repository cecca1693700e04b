#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "harness/results/run_grade.h"
#include "reports/data/check_text.h"
#include "reports/data/results.h"
#include "reports/page/render.h"
#include "reports/page/report.h"
#include "reports/text/files.h"
#include "reports/text/html.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

/// A column of the matrix, with what its cells come to.
struct Code {
  Results results;
  std::string name, version;
  std::map<Grade, std::size_t> counts;
  std::size_t nearest = 0;
  double wall_s = 0;
};

/// One variant of a case, by code; null where a code has none.
struct Row {
  const CaseInfo* info = nullptr;
  std::string variant;
  std::vector<const Run*> runs;
  bool other_case = false;  ///< the codes had different versions of it
};

Code read_code(const std::filesystem::path& file) {
  Code code{read_results(file), "trammel", "", {}, 0, 0};
  code.version = code.results.environment.trammel;
  if (const auto& solver = code.results.solver) {
    code.name = solver->name;
    code.version = solver->version;
  }
  for (const Run& run : code.results.runs) {
    ++code.counts[grade_of(run)];
    code.wall_s += run.cost.wall_s;
  }
  return code;
}

const Run* find_run(const Results& results, const std::string& id, const std::string& variant) {
  for (const Run& run : results.runs)
    if (run.case_id == id && run.variant == variant) return &run;
  return nullptr;
}

std::vector<Row> plan_rows(const std::vector<Code>& codes) {
  std::vector<Row> rows;
  for (const Code& code : codes) {
    for (const Run& run : code.results.runs) {
      const auto same = [&](const Row& row) {
        return row.info->id == run.case_id && row.variant == run.variant;
      };
      if (std::ranges::any_of(rows, same)) continue;
      Row row{&code.results.case_info(run.case_id), run.variant, {}};
      for (const Code& other : codes) {
        row.runs.push_back(find_run(other.results, run.case_id, run.variant));
        if (row.runs.back() == nullptr) continue;
        const std::string& hash = other.results.case_info(run.case_id).hash;
        row.other_case = row.other_case || hash != row.info->hash;
      }
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

/// The same entry of the same check in another run.
const Check* find_check(const Run& run, const Check& like) {
  for (const Check& check : run.checks)
    if (check.name == like.name && check.quantity == like.quantity && check.index == like.index &&
        check.difference)
      return &check;
  return nullptr;
}

/// What the row shows: the entry that some code fails worst, else the one that uses most of its
/// tolerance.
const Check* shown_check(const Row& row) {
  const Check* shown = nullptr;
  const auto rank = [](const Check& check) {
    return std::tuple(check.expected.has_value(), check.verdict == Verdict::fail,
                      tolerance_share(check));
  };
  for (const Run* run : row.runs) {
    const Check* check = run == nullptr ? nullptr : telling_check(*run);
    if (check != nullptr && (shown == nullptr || rank(*check) > rank(*shown))) shown = check;
  }
  return shown;
}

/// Class in the style sheet, and a sign that does not need colour.
std::pair<const char*, const char*> mark(Grade grade) {
  if (grade == Grade::agrees) return {"passes", "✓"};
  if (grade == Grade::off) return {"fails", "✗"};
  return is_failure(grade) ? std::pair("error", "!") : std::pair("not-run", "–");
}

std::string status_text(const Run& run, Grade grade, const Check* here) {
  if (grade != Grade::off) return to_string(grade);
  if (here != nullptr && here->verdict == Verdict::fail) return "off by";
  const Check* check = telling_check(run);
  return check == nullptr ? "off" : "off in " + check_title(*check);
}

Data cell(const Run* run, const Check* shown, bool nearest) {
  if (run == nullptr) return object({{"there", false}});
  const Grade grade = grade_of(*run);
  const Check* here = shown == nullptr ? nullptr : find_check(*run, *shown);
  const bool not_computed = grade == Grade::cannot || grade == Grade::not_exported;
  return object({{"there", true},
                 {"status_class", mark(grade).first},
                 {"sign", mark(grade).second},
                 {"status_text", status_text(*run, grade, here)},
                 {"difference", here == nullptr ? "" : difference_text(*here)},
                 {"reason", is_failure(grade) || not_computed ? run->reason : std::string()},
                 {"time", not_computed ? "" : duration(run->cost.wall_s)},
                 {"nearest", nearest}});
}

/// The codes whose numbers lie nearest to the expected one; none where all are as near.
std::vector<bool> nearest_of(const Row& row, const Check* shown) {
  constexpr double kTie = 1e-13;  // of the expected value: round-off
  std::vector<double> away;
  for (const Run* run : row.runs) {
    const Check* check = run == nullptr || shown == nullptr ? nullptr : find_check(*run, *shown);
    const bool has = check != nullptr && check->expected && check->computed;
    away.push_back(has ? std::abs(*check->computed - *check->expected)
                       : std::numeric_limits<double>::infinity());
  }
  const double least = *std::ranges::min_element(away);
  std::vector<bool> nearest;
  std::size_t farther = 0;
  for (const double distance : away) {
    nearest.push_back(distance <=
                      1.000001 * least + kTie * std::abs(shown ? shown->expected.value_or(0) : 0));
    if (std::isfinite(distance) && !nearest.back()) ++farther;
  }
  return farther > 0 ? nearest : std::vector<bool>(row.runs.size(), false);
}

std::size_t entries_of(const Row& row, const Check& shown) {
  std::ptrdiff_t most = 0;
  for (const Run* run : row.runs)
    if (run != nullptr)
      most = std::max(most, std::ranges::count_if(run->checks, [&](const Check& c) {
                        return c.name == shown.name && c.quantity == shown.quantity;
                      }));
  return static_cast<std::size_t>(most);
}

Data row_data(const Row& row, std::vector<Code>& codes) {
  const Check* shown = shown_check(row);
  const std::vector<bool> nearest = nearest_of(row, shown);
  Data cells = list();
  for (std::size_t i = 0; i < row.runs.size(); ++i) {
    if (nearest[i]) ++codes[i].nearest;
    cells.push_back(cell(row.runs[i], shown, nearest[i]));
  }
  return object({{"title", row.info->title},
                 {"variant", row.variant == "base" ? "" : row.info->variant_title(row.variant)},
                 {"run", row.info->id + (row.variant == "base" ? "" : ":" + row.variant)},
                 {"other_case", row.other_case},
                 {"quantity", shown == nullptr ? ""
                                               : quantity_text(*shown) + " " +
                                                     entry_text(*shown, entries_of(row, *shown))},
                 {"expected", shown == nullptr ? "" : target_text(*shown)},
                 {"cells", cells}});
}

Data code_data(const Code& code, const std::vector<Grade>& grades) {
  const auto number_of = [&](Grade grade) {
    const auto found = code.counts.find(grade);
    return object({{"n", found == code.counts.end() ? "" : std::to_string(found->second)}});
  };
  const Environment& environment = code.results.environment;
  return object({{"name", code.name},
                 {"version", code.version},
                 {"command", code.results.solver ? code.results.solver->command : ""},
                 {"catalogue", environment.trammel + " (" + environment.commit + ")"},
                 {"date", environment.date},
                 {"runs", std::to_string(code.results.runs.size())},
                 {"counts", list_of(grades, number_of)},
                 {"nearest", std::to_string(code.nearest)},
                 {"time", duration(code.wall_s)}});
}

}  // namespace

std::filesystem::path write_codes(const std::vector<std::filesystem::path>& results_json,
                                  const std::filesystem::path& out) {
  std::vector<Code> codes;
  for (const auto& file : results_json) codes.push_back(read_code(file));
  const std::vector<Row> planned = plan_rows(codes);
  // The rows first: they count for the codes how often each is nearest.
  const Data rows = list_of(planned, [&](const Row& row) { return row_data(row, codes); });
  std::vector<Grade> grades;
  for (const Grade grade : kAllGrades)
    if (std::ranges::any_of(codes, [&](const Code& code) { return code.counts.contains(grade); }))
      grades.push_back(grade);
  const auto column = [&](const Code& code) { return code_data(code, grades); };
  const auto head = [](Grade grade) { return object({{"grade", to_string(grade)}}); };
  const Data page = object({{"style", template_text("style.css")},
                            {"codes", list_of(codes, column)},
                            {"grades", list_of(grades, head)},
                            {"rows", rows},
                            {"several", codes.size() > 1},
                            {"extent", count(planned.size(), "run") + " of the catalogue, " +
                                           count(codes.size(), "code")}});
  write_file(out / "index.html", render("codes.mustache", page));
  return out / "index.html";
}

}  // namespace trammel::reports

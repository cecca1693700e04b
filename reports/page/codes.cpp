#include "reports/page/codes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "harness/results/run_grade.h"
#include "reports/data/check_text.h"
#include "reports/data/results.h"
#include "reports/page/render.h"
#include "reports/text/files.h"
#include "reports/text/html.h"
#include "reports/text/number.h"
#include "reports/text/templates.h"

namespace trammel::reports {

namespace {

using namespace reports;

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
  Data data = object();
  set_flag(data, "there", run != nullptr);
  if (run == nullptr) return data;
  const Grade grade = grade_of(*run);
  const Check* here = shown == nullptr ? nullptr : find_check(*run, *shown);
  const bool not_computed = grade == Grade::cannot || grade == Grade::not_exported;
  data.set("status_class", mark(grade).first);
  data.set("sign", mark(grade).second);
  data.set("status_text", status_text(*run, grade, here));
  set_text(data, "difference", here == nullptr ? "" : difference_text(*here));
  set_text(data, "reason", is_failure(grade) || not_computed ? run->reason : std::string());
  set_text(data, "time", not_computed ? "" : duration(run->cost.wall_s));
  set_flag(data, "nearest", nearest);
  return data;
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
  Data data = object();
  const Check* shown = shown_check(row);
  data.set("title", row.info->title);
  set_text(data, "variant", row.variant == "base" ? "" : row.info->variant_title(row.variant));
  data.set("run", row.info->id + (row.variant == "base" ? "" : ":" + row.variant));
  set_flag(data, "other_case", row.other_case);
  set_text(data, "quantity",
           shown == nullptr
               ? ""
               : quantity_text(*shown) + " " + entry_text(*shown, entries_of(row, *shown)));
  set_text(data, "expected", shown == nullptr ? "" : target_text(*shown));
  const std::vector<bool> nearest = nearest_of(row, shown);
  Data cells = list();
  for (std::size_t i = 0; i < row.runs.size(); ++i) {
    if (nearest[i]) ++codes[i].nearest;
    cells.push_back(cell(row.runs[i], shown, nearest[i]));
  }
  data.set("cells", cells);
  return data;
}

Data code_data(const Code& code, const std::vector<Grade>& grades) {
  Data data = object();
  data.set("name", code.name);
  set_text(data, "version", code.version);
  set_text(data, "command", code.results.solver ? code.results.solver->command : "");
  const Environment& environment = code.results.environment;
  data.set("catalogue", environment.trammel + " (" + environment.commit + ")");
  data.set("date", environment.date);
  data.set("runs", std::to_string(code.results.runs.size()));
  Data counts = list();
  for (const Grade grade : grades) {
    Data count = object();
    const auto found = code.counts.find(grade);
    set_text(count, "n", found == code.counts.end() ? "" : std::to_string(found->second));
    counts.push_back(count);
  }
  data.set("counts", counts);
  data.set("nearest", std::to_string(code.nearest));
  data.set("time", duration(code.wall_s));
  return data;
}

}  // namespace

std::filesystem::path write_codes(const std::vector<std::filesystem::path>& results_json,
                                  const std::filesystem::path& out) {
  std::vector<Code> codes;
  for (const auto& file : results_json) codes.push_back(read_code(file));
  Data page = object();
  page.set("style", template_text("style.css"));
  Data rows = list(), columns = list(), heads = list();
  const std::vector<Row> planned = plan_rows(codes);
  for (const Row& row : planned) rows.push_back(row_data(row, codes));
  std::vector<Grade> grades;
  for (const Grade grade : kAllGrades) {
    if (std::ranges::none_of(codes, [&](const Code& code) { return code.counts.count(grade) > 0; }))
      continue;
    grades.push_back(grade);
    Data head = object();
    head.set("grade", to_string(grade));
    heads.push_back(head);
  }
  for (const Code& code : codes) columns.push_back(code_data(code, grades));
  page.set("codes", columns);
  page.set("grades", heads);
  page.set("rows", rows);
  set_flag(page, "several", codes.size() > 1);
  page.set("extent",
           count(planned.size(), "run") + " of the catalogue, " + count(codes.size(), "code"));
  write_file(out / "index.html", render("codes.mustache", page));
  return out / "index.html";
}

}  // namespace trammel::reports

#include <algorithm>
#include <map>
#include <tuple>

#include "harness/base/find_or_add.h"
#include "harness/results/check_groups.h"
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

/// Results of one simulation code, and its number of runs with each grade ("agrees", "off", ...).
struct Code {
  Results results;
  std::string name, version;
  std::map<Grade, std::size_t> counts;
  double wall_s = 0;
};

/// One variant of a case with its run by each code. A null pointer marks a code without this run.
struct Row {
  const CaseInfo* info = nullptr;
  std::string variant;
  std::vector<const Run*> runs;
  bool other_case = false;  ///< the codes ran different versions of the case
};

Code read_code(const std::filesystem::path& file) {
  Code code{read_results(file), "trammel", "", {}, 0};
  code.version = code.results.environment.trammel;
  if (const auto& solver = code.results.solver) {
    code.name = solver->name;
    code.version = solver->version;
  }
  for (const Run& run : code.results.runs) {
    ++code.counts[grade_of_run(run)];
    code.wall_s += run.cost.wall_s;
  }
  return code;
}

/// Returns a row for each variant of a case that at least one code has run.
std::vector<Row> plan_table_rows(const std::vector<Code>& codes) {
  std::vector<Row> rows;
  for (std::size_t c = 0; c < codes.size(); ++c)
    for (const Run& run : codes[c].results.runs) {
      const CaseInfo& info = codes[c].results.case_info(run.case_id);
      const auto same = [&](const Row& row) {
        return row.info->id == run.case_id && row.variant == run.variant;
      };
      Row& row = harness::find_or_add(rows, same,
                                      {&info, run.variant, std::vector<const Run*>(codes.size())});
      row.runs[c] = &run;
      row.other_case = row.other_case || info.hash != row.info->hash;
    }
  return rows;
}

/// Returns the check of `run` with the name, quantity and index of the check `like`; null if `run`
/// has no such check.
const Check* find_same_check(const Run& run, const Check& like) {
  for (const Check& check : run.checks)
    if (check.name == like.name && check.quantity == like.quantity && check.index == like.index &&
        check.difference)
      return &check;
  return nullptr;
}

/// Returns the check that represents a row of the table. The candidates are the checks that decide
/// the grades of the codes. Checks with an expected value come first, then failed checks, then
/// those that use the largest fraction of their tolerance.
const Check* representative_check(const Row& row) {
  const Check* shown = nullptr;
  const auto rank = [](const Check& check) {
    return std::tuple(check.expected.has_value(), check.verdict == Verdict::fail,
                      results::difference_over_tolerance(check));
  };
  for (const Run* run : row.runs) {
    const Check* check = run == nullptr ? nullptr : decisive_check(*run);
    if (check != nullptr && (shown == nullptr || rank(*check) > rank(*shown))) shown = check;
  }
  return shown;
}

/// Returns the CSS class of a grade, and a symbol that shows the grade without color.
std::pair<const char*, const char*> mark(Grade grade) {
  if (grade == Grade::agrees) return {"passes", "✓"};
  if (grade == Grade::off) return {"fails", "✗"};
  return is_failure(grade) ? std::pair("error", "!") : std::pair("not-run", "–");
}

std::string status_text(const Run& run, Grade grade, const Check* here) {
  if (grade != Grade::off) return to_string(grade);
  if (here != nullptr && here->verdict == Verdict::fail) return "off by";
  const Check* check = decisive_check(run);
  return check == nullptr ? "off" : "off in " + check_title(*check);
}

Data cell(const Run* run, const Check* shown) {
  if (run == nullptr) return object({{"has_run", false}});
  const Grade grade = grade_of_run(*run);
  const Check* here = shown == nullptr ? nullptr : find_same_check(*run, *shown);
  const bool not_computed = grade == Grade::cannot || grade == Grade::not_exported;
  return object({{"has_run", true},
                 {"status_class", mark(grade).first},
                 {"sign", mark(grade).second},
                 {"status_text", status_text(*run, grade, here)},
                 {"difference", here == nullptr ? "" : difference_text(*here)},
                 {"reason", is_failure(grade) || not_computed ? run->reason : std::string()},
                 {"time", not_computed ? "" : duration(run->cost.wall_s)}});
}

Data template_data_of_row(const Row& row) {
  const Check* shown = representative_check(row);
  const auto cell_of = [&](const Run* run) { return cell(run, shown); };
  return object(
      {{"title", row.info->title},
       {"variant", row.variant == "base" ? "" : row.info->variant_title(row.variant)},
       {"run", row.info->id + (row.variant == "base" ? "" : ":" + row.variant)},
       {"other_case", row.other_case},
       {"quantity", shown == nullptr ? "" : quantity_text(*shown) + " " + entry_text(*shown, 1)},
       {"expected", shown == nullptr ? "" : target_text(*shown)},
       {"cells", list_of(row.runs, cell_of)}});
}

/// Returns a table of the simulation codes, with their numbers of runs of each grade and their
/// computing times.
TextTable table_of_codes(const std::vector<Code>& codes) {
  std::vector<Grade> grades;
  for (const Grade grade : kAllGrades)
    if (std::ranges::any_of(codes, [&](const Code& code) { return code.counts.contains(grade); }))
      grades.push_back(grade);
  TextTable table{"Codes", {"Code", "Command", ">runs"}};
  for (const Grade grade : grades) table.heads.push_back(">" + to_string(grade));
  table.heads.insert(table.heads.end(), {">time", "Catalogue"});
  for (const Code& code : codes) {
    const Results& results = code.results;
    std::vector<std::string>& row = table.rows.emplace_back();
    row = {code.name + " " + code.version, results.solver ? results.solver->command : "",
           std::to_string(results.runs.size())};
    for (const Grade grade : grades)
      row.push_back(code.counts.contains(grade) ? std::to_string(code.counts.at(grade)) : "");
    row.push_back(duration(code.wall_s));
    row.push_back(results.environment.trammel + " (" + results.environment.commit + "), " +
                  results.environment.date);
  }
  return table;
}

}  // namespace

std::filesystem::path write_code_comparison(const std::vector<std::filesystem::path>& results_json,
                                            const std::filesystem::path& out) {
  std::vector<Code> codes;
  for (const auto& file : results_json) codes.push_back(read_code(file));
  const std::vector<Row> rows = plan_table_rows(codes);
  const auto name = [](const Code& code) { return object({{"name", code.name}}); };
  const Data page = object({{"style", template_text("style.css")},
                            {"table", table_data(table_of_codes(codes))},
                            {"codes", list_of(codes, name)},
                            {"rows", list_of(rows, template_data_of_row)},
                            {"extent", count(rows.size(), "run") + " of the catalogue, " +
                                           count(codes.size(), "code")}});
  write_file(out / "index.html", render("codes.mustache", page));
  return out / "index.html";
}

}  // namespace trammel::reports

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "harness/base/errors.h"
#include "harness/base/json.h"
#include "harness/run/diff.h"
#include "harness/run/results.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;

constexpr int kFormat = 1;  ///< version of the tables, stored as SQLite's user_version
constexpr const char* kTables = R"(
CREATE TABLE call (id INTEGER PRIMARY KEY, date TEXT, commit_id TEXT, machine TEXT, trammel TEXT,
  runs INTEGER, checks INTEGER, failures INTEGER, cpu_s REAL, work INTEGER);
CREATE TABLE name (id INTEGER PRIMARY KEY, text TEXT UNIQUE);
CREATE TABLE cost (call INTEGER, name INTEGER, cpu_s REAL, work INTEGER);
CREATE TABLE entry (call INTEGER, name INTEGER, verdict TEXT, value REAL, noise REAL);
CREATE INDEX entry_name ON entry (name, call);
PRAGMA user_version = 1;)";

using Row = std::vector<Json>;

/// Connection to an SQLite file that contains a history.
class Database {
 public:
  Database(const fs::path& file, bool create) : file_(file.string()) {
    const int flags = create ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READONLY;
    const int status = sqlite3_open_v2(file_.c_str(), &handle_, flags, nullptr);
    if (status != SQLITE_OK) {
      const std::string reason = sqlite3_errmsg(handle_);
      sqlite3_close(handle_);
      fail(reason);
    }
    sqlite3_busy_timeout(handle_, 60'000);
  }
  ~Database() { sqlite3_close(handle_); }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void execute(const char* sql) { check(sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr)); }

  /// Executes one SQL statement with `values` as its parameters.
  /// @returns the rows of the result
  std::vector<Row> query(const char* sql, const Row& values = {}) {
    sqlite3_stmt* prepared = nullptr;
    check(sqlite3_prepare_v2(handle_, sql, -1, &prepared, nullptr));
    const std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> statement(prepared,
                                                                          sqlite3_finalize);
    for (std::size_t i = 0; i < values.size(); ++i)
      bind(prepared, static_cast<int>(i) + 1, values[i]);
    std::vector<Row> rows;
    while (check(sqlite3_step(prepared)) == SQLITE_ROW) {
      Row& row = rows.emplace_back();
      for (int i = 0; i < sqlite3_column_count(prepared); ++i) row.push_back(cell(prepared, i));
    }
    return rows;
  }
  [[nodiscard]] std::int64_t last_id() const { return sqlite3_last_insert_rowid(handle_); }

  /// Requires that the file contains a history or no tables.
  /// @returns whether the file contains a history
  bool has_tables() {
    const Json format = query("PRAGMA user_version").front().front();
    const bool is_empty = query("SELECT count(*) FROM sqlite_master").front().front() == 0;
    if (format != kFormat && (format != 0 || !is_empty))
      throw InputError(fmt::format(
          "{}: the file has another version; expected a history of version {}", file_, kFormat));
    return format != 0;
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw InputError(file_ + ": expected a history written by trammel (" + reason + ")");
  }
  int check(int status) const {
    if (status != SQLITE_OK && status != SQLITE_ROW && status != SQLITE_DONE)
      fail(sqlite3_errmsg(handle_));
    return status;
  }
  static void bind(sqlite3_stmt* statement, int place, const Json& value) {
    if (value.is_string()) {
      const std::string text = value.get<std::string>();
      sqlite3_bind_text(statement, place, text.data(), static_cast<int>(text.size()),
                        SQLITE_TRANSIENT);
    } else if (value.is_number_float()) {
      sqlite3_bind_double(statement, place, value.get<double>());
    } else if (value.is_number()) {
      sqlite3_bind_int64(statement, place, value.get<std::int64_t>());
    } else {
      sqlite3_bind_null(statement, place);
    }
  }
  static Json cell(sqlite3_stmt* statement, int i) {
    switch (sqlite3_column_type(statement, i)) {
      case SQLITE_INTEGER:
        return sqlite3_column_int64(statement, i);
      case SQLITE_FLOAT:
        return sqlite3_column_double(statement, i);
      case SQLITE_TEXT:
        return reinterpret_cast<const char*>(sqlite3_column_text(statement, i));
      default:
        return nullptr;
    }
  }

  std::string file_;
  sqlite3* handle_ = nullptr;
};

bool is_failure(const results::Check& check) {
  return check.verdict == results::Verdict::fail || check.verdict == results::Verdict::error ||
         check.verdict == results::Verdict::not_run;
}

/// Records of a run or check entry, by the id of the call.
using Course = std::vector<std::pair<std::int64_t, Entry>>;

/// Returns the records of each compared item (run or check entry), by the name of the item.
/// @param sql  query for name, call, verdict, value and noise, in the order of the calls
std::map<std::string, Course> courses_of(Database& database, const char* sql) {
  std::map<std::string, Course> courses;
  for (const Row& row : database.query(sql)) {
    const results::Number value =
        row[3].is_null() ? results::Number() : results::Number(row[3].get<double>());
    courses[row[0].get<std::string>()].push_back(
        {row[1].get<std::int64_t>(), {row[2].get<std::string>(), value, row[4].get<double>()}});
  }
  return courses;
}

std::map<std::string, Course> entry_courses(Database& database) {
  return courses_of(database,
                    "SELECT text, call, verdict, value, noise FROM entry JOIN name ON name.id = "
                    "entry.name ORDER BY entry.rowid");
}

void add_call_to_history(Database& database, const results::Results& results) {
  std::size_t checks = 0, failures = 0, work = 0;
  double cpu_s = 0;
  for (const results::Run& run : results.runs) {
    checks += run.checks.size();
    failures += static_cast<std::size_t>(std::ranges::count_if(run.checks, is_failure));
    work += run.cost.counted_work();
    cpu_s += run.cost.cpu_s;
  }
  const bool all_new =
      std::ranges::none_of(results.runs, [](const results::Run& run) { return run.was_stored; });
  const results::Environment& from = results.environment;
  database.query("INSERT INTO call VALUES (NULL, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                 {from.date, from.commit, from.processor, from.trammel, results.runs.size(), checks,
                  failures, all_new ? Json(cpu_s) : Json(), work});
}

/// Returns the state of all entries at a call: for each entry, the last record up to this call.
Entries state_at(const std::map<std::string, Course>& courses, std::int64_t call) {
  Entries entries;
  for (const auto& [name, course] : courses)
    for (const auto& [since, entry] : course)
      if (since <= call) entries[name] = entry;
  return entries;
}

/// Adds records of check entries that have changed or are missing from a run.
void write_entries(Database& database, const results::Results& results, std::int64_t call) {
  const auto insert = [&](const std::string& name, const char* sql, Row values) {
    database.query("INSERT OR IGNORE INTO name (text) VALUES (?)", {name});
    values.insert(values.begin(), call);
    values.emplace_back(name);
    database.query(sql, values);
  };
  const Entries before = state_at(entry_courses(database), call), now = all_entries(results);
  for (const DiffRow& row : pair_entries(before, now)) {
    const std::string run = row.name.substr(0, row.name.find(' '));
    if (now.count(run) == 0 || row.name == run) continue;
    const Entry gone{"gone", std::nullopt, 0};
    const Entry& entry = row.after ? *row.after : gone;
    const bool same =
        row.before && row.before->verdict == entry.verdict && row.before->value == entry.value;
    if (!same)
      insert(row.name, "INSERT INTO entry SELECT ?, id, ?, ?, ? FROM name WHERE text = ?",
             {entry.verdict, number_or_null(entry.value), entry.noise});
  }
  for (const results::Run& run : results.runs)  // stored runs are in the record of an earlier call
    if (!run.was_stored)
      insert(name_of(run), "INSERT INTO cost SELECT ?, id, ?, ? FROM name WHERE text = ?",
             {run.cost.cpu_s, run.cost.counted_work()});
}

std::vector<HistoryCall> calls_of_history(Database& database) {
  std::vector<HistoryCall> calls;
  for (const Row& row : database.query("SELECT id, date, commit_id, machine, runs, checks, "
                                       "failures, work, cpu_s FROM call ORDER BY id"))
    calls.push_back({row[0].get<std::int64_t>(), row[1].get<std::string>(),
                     row[2].get<std::string>(), row[3].get<std::string>(),
                     row[4].get<std::size_t>(), row[5].get<std::size_t>(),
                     row[6].get<std::size_t>(), row[7].get<std::size_t>(),
                     row[8].is_null() ? 0 : row[8].get<double>()});
  return calls;
}

/// Returns the changes since a call. Each change has the date and the commit of the first call that
/// shows the change.
std::vector<HistoryChange> changes_since_call(std::int64_t since,
                                              const std::map<std::string, Course>& courses,
                                              const std::vector<HistoryCall>& calls) {
  std::vector<HistoryChange> changes;
  const Entries before = state_at(courses, since), now = state_at(courses, calls.back().id);
  for (const DiffRow& row : pair_entries(before, now)) {
    if (!row.is_in_both() || !row.after->differs(*row.before)) continue;
    std::int64_t first = 0;  // first of the latest consecutive calls with a change; 0: none
    for (const auto& [call, entry] : courses.at(row.name)) {
      const bool differs = call > since && entry.differs(*row.before);
      first = !differs ? 0 : first == 0 ? call : first;
    }
    const HistoryCall& call = *std::ranges::find(calls, first, &HistoryCall::id);
    changes.push_back({row.name, row.before->verdict, row.after->verdict, row.before->value,
                       row.after->value, call.commit, call.date});
  }
  std::ranges::stable_partition(changes, &HistoryChange::verdict_changed);
  return changes;
}

std::vector<HistoryDrift> drifts_of_entries(const std::map<std::string, Course>& courses) {
  constexpr std::size_t kLeast = 3;      // minimum number of steps
  constexpr double kLargestStep = 0.01;  // largest relative step of a slow drift
  std::vector<HistoryDrift> drifts;
  for (const auto& [name, course] : courses) {
    std::vector<double> values;
    bool slow = true;
    for (const auto& [call, entry] : course) {
      slow = slow && entry.value && entry.verdict == course.front().second.verdict;
      if (!slow) break;
      if (!values.empty() && std::abs(*entry.value - values.back()) <= entry.noise) continue;
      values.push_back(*entry.value);
    }
    if (!slow || values.size() < kLeast + 1) continue;
    for (std::size_t i = 1; i < values.size(); ++i) {
      const double step = values[i] - values[i - 1];
      slow = slow && step * (values[1] - values[0]) > 0 &&
             std::abs(step) <= kLargestStep * std::abs(values[i - 1]);
    }
    if (slow) drifts.push_back({name, values.size() - 1, values.front(), values.back()});
  }
  std::ranges::stable_sort(drifts, [](const auto& a, const auto& b) {
    return std::abs(a.last / a.first - 1) > std::abs(b.last / b.first - 1);
  });
  return drifts;
}

}  // namespace

void append_history(const fs::path& file, const results::Results& results) {
  Database database(file, true);
  database.execute("BEGIN IMMEDIATE");
  if (!database.has_tables()) database.execute(kTables);
  add_call_to_history(database, results);
  write_entries(database, results, database.last_id());
  database.execute("COMMIT");
}

History read_history(const fs::path& file) {
  Database database(file, false);
  if (!database.has_tables())
    throw InputError(file.string() + ": the file is empty; expected a history written by trammel");
  History history;
  history.calls = calls_of_history(database);
  for (std::size_t i = 0; i + 1 < history.calls.size(); ++i)
    if (history.calls[i].has_passed()) history.since = history.calls[i].id;
  const auto courses = entry_courses(database);
  if (history.since > 0) {
    history.changes = changes_since_call(history.since, courses, history.calls);
    const auto work = courses_of(database,
                                 "SELECT text, call, '', work, 0 FROM cost JOIN name ON name.id = "
                                 "cost.name ORDER BY cost.rowid");
    history.work = changes_since_call(history.since, work, history.calls);
  }
  history.drifts = drifts_of_entries(courses);
  return history;
}

}  // namespace trammel::harness

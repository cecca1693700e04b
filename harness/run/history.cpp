#include "harness/run/history.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "harness/base/errors.h"
#include "harness/base/quantity.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;

constexpr int kFormat = 1;  ///< of the tables, as SQLite's user_version
constexpr const char* kTables = R"(
CREATE TABLE call (id INTEGER PRIMARY KEY, date TEXT, commit_id TEXT, machine TEXT, trammel TEXT,
  runs INTEGER, checks INTEGER, failures INTEGER, cpu_s REAL, work INTEGER);
CREATE TABLE name (id INTEGER PRIMARY KEY, text TEXT UNIQUE);
CREATE TABLE cost (call INTEGER, name INTEGER, cpu_s REAL, work INTEGER);
CREATE TABLE entry (call INTEGER, name INTEGER, verdict TEXT, value REAL, noise REAL);
CREATE INDEX entry_name ON entry (name, call);
PRAGMA user_version = 1;)";

/// A file of SQLite, and statements that end with it.
class Database {
 public:
  Database(const fs::path& file, bool create) : file_(file.string()) {
    const int flags = create ? SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE : SQLITE_OPEN_READONLY;
    const int status = sqlite3_open_v2(file_.c_str(), &handle_, flags, nullptr);
    if (status != SQLITE_OK) {
      const std::string reason = sqlite3_errmsg(handle_);
      sqlite3_close(handle_);
      throw InputError(file_ + ": expected a history (" + reason + ")");
    }
    sqlite3_busy_timeout(handle_, 60'000);
  }
  ~Database() { sqlite3_close(handle_); }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void execute(const char* sql) { check(sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr)); }
  void check(int status) const {
    if (status != SQLITE_OK && status != SQLITE_ROW && status != SQLITE_DONE)
      throw InputError(file_ + ": expected a history (" + sqlite3_errmsg(handle_) + ")");
  }
  [[nodiscard]] std::int64_t last_id() const { return sqlite3_last_insert_rowid(handle_); }
  [[nodiscard]] sqlite3* handle() const { return handle_; }
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  std::string file_;
  sqlite3* handle_ = nullptr;
};

class Statement {
 public:
  Statement(Database& database, const char* sql) : database_(database) {
    database.check(sqlite3_prepare_v2(database.handle(), sql, -1, &handle_, nullptr));
  }
  ~Statement() { sqlite3_finalize(handle_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  /// Does it once with these values.
  template <class... Values>
  void run(const Values&... values) {
    sqlite3_reset(handle_);
    int place = 0;
    (bind(++place, values), ...);
    step();
  }
  /// @returns whether there is a row
  bool step() {
    const int status = sqlite3_step(handle_);
    database_.check(status);
    return status == SQLITE_ROW;
  }
  [[nodiscard]] std::int64_t integer(int i) const { return sqlite3_column_int64(handle_, i); }
  [[nodiscard]] results::Number number(int i) const {
    if (sqlite3_column_type(handle_, i) == SQLITE_NULL) return std::nullopt;
    return sqlite3_column_double(handle_, i);
  }
  [[nodiscard]] std::string text(int i) const {
    const unsigned char* text = sqlite3_column_text(handle_, i);
    return text == nullptr ? "" : reinterpret_cast<const char*>(text);
  }

 private:
  void bind(int place, const std::string& text) {
    sqlite3_bind_text(handle_, place, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT);
  }
  void bind(int place, std::int64_t number) { sqlite3_bind_int64(handle_, place, number); }
  void bind(int place, std::size_t number) { bind(place, static_cast<std::int64_t>(number)); }
  void bind(int place, double number) { sqlite3_bind_double(handle_, place, number); }
  void bind(int place, const results::Number& number) {
    number ? sqlite3_bind_double(handle_, place, *number) : sqlite3_bind_null(handle_, place);
  }

  Database& database_;
  sqlite3_stmt* handle_ = nullptr;
};

int format_of(Database& database) {
  Statement statement(database, "PRAGMA user_version");
  statement.step();
  const auto format = static_cast<int>(statement.integer(0));
  Statement tables(database, "SELECT count(*) FROM sqlite_master");
  tables.step();
  if (format != kFormat && (format != 0 || tables.integer(0) > 0))
    throw InputError(database.file() + ": expected a history of format " + std::to_string(kFormat));
  return format;
}

/// Verdict and value of a check entry at a time.
struct State {
  std::string verdict;
  results::Number value;
  double noise = 0;

  [[nodiscard]] bool same_bits(const State& other) const {
    return verdict == other.verdict && value == other.value;
  }
  [[nodiscard]] bool differs(const State& other) const {
    if (verdict != other.verdict || value.has_value() != other.value.has_value()) return true;
    return value && !(std::abs(*value - *other.value) <= std::max(noise, other.noise));
  }
};

/// What is round-off of a check's value: 1e-9 of it, or a millionth of its tolerance. How well
/// others were computed is no value to be followed.
double noise_of(const results::Check& check) {
  if (is_diagnostic(check.quantity)) return HUGE_VAL;
  double width = 0;
  if (check.tolerance)
    for (const results::Number& end : {check.tolerance->low, check.tolerance->high})
      width = std::max(width, std::abs(end.value_or(0)));
  const double size =
      std::max(std::abs(check.computed.value_or(0)), std::abs(check.expected.value_or(0)));
  if (check.measure == "relative") width *= size;
  return std::max(1e-9 * size, 1e-6 * width);
}

std::size_t work_of(const results::Run& run) {
  std::size_t work = 0;
  for (const auto& counter : run.cost.counters) work += counter.second;
  return work;
}

bool is_failure(const results::Check& check) {
  return check.verdict == results::Verdict::fail || check.verdict == results::Verdict::error ||
         check.verdict == results::Verdict::not_run;
}

std::string name_of(const results::Run& run) {
  return run.case_id + ":" + run.variant;
}

std::map<std::string, State> states_of(const results::Run& run) {
  std::map<std::string, State> states;
  for (const results::Check& check : run.checks) {
    std::string name = name_of(run) + " " + check.name + " " + check.quantity;
    if (check.index) name += fmt::format("[{}]", *check.index);
    while (states.count(name) > 0) name += "'";
    states[name] = {results::to_string(check.verdict), check.computed, noise_of(check)};
  }
  return states;
}

using Course = std::vector<std::pair<std::int64_t, State>>;  ///< by call

std::map<std::string, Course> courses_of(Database& database) {
  std::map<std::string, Course> courses;
  Statement rows(database,
                 "SELECT text, call, verdict, value, noise FROM entry JOIN name ON name.id = "
                 "entry.name ORDER BY entry.rowid");
  while (rows.step())
    courses[rows.text(0)].push_back(
        {rows.integer(1), {rows.text(2), rows.number(3), rows.number(4).value_or(0)}});
  return courses;
}

/// Numbers of names, each written once.
class Names {
 public:
  explicit Names(Database& database)
      : database_(database), insert_(database, "INSERT INTO name (text) VALUES (?)") {
    Statement rows(database, "SELECT text, id FROM name");
    while (rows.step()) known_[rows.text(0)] = rows.integer(1);
  }
  std::int64_t id(const std::string& text) {
    const auto found = known_.find(text);
    if (found != known_.end()) return found->second;
    insert_.run(text);
    return known_[text] = database_.last_id();
  }

 private:
  Database& database_;
  Statement insert_;
  std::map<std::string, std::int64_t> known_;
};

void add_call(Database& database, const results::Results& results) {
  std::size_t checks = 0, failures = 0, work = 0;
  double cpu_s = 0;
  for (const results::Run& run : results.runs) {
    checks += run.checks.size();
    failures += static_cast<std::size_t>(std::ranges::count_if(run.checks, is_failure));
    work += work_of(run);
    cpu_s += run.cost.cpu_s;
  }
  const bool all_new =
      std::ranges::none_of(results.runs, [](const results::Run& run) { return run.was_stored; });
  const results::Environment& from = results.environment;
  Statement(database, "INSERT INTO call VALUES (NULL, ?, ?, ?, ?, ?, ?, ?, ?, ?)")
      .run(from.date, from.commit, from.processor, from.trammel, results.runs.size(), checks,
           failures, all_new ? results::Number(cpu_s) : results::Number(), work);
}

/// Entries that are other than before, also those that a run no longer has.
void add_entries(Database& database, const results::Results& results, std::int64_t call) {
  const std::map<std::string, Course> before = courses_of(database);
  const auto last = [](const auto& item) -> const State& { return item.second.back().second; };
  Names names(database);
  Statement entry(database, "INSERT INTO entry VALUES (?, ?, ?, ?, ?)");
  Statement cost(database, "INSERT INTO cost VALUES (?, ?, ?, ?)");
  const auto write = [&](const std::string& name, const State& state) {
    entry.run(call, names.id(name), state.verdict, state.value, state.noise);
  };
  for (const results::Run& run : results.runs) {
    // What an earlier call has measured is no second measurement.
    if (!run.was_stored) cost.run(call, names.id(name_of(run)), run.cost.cpu_s, work_of(run));
    const std::map<std::string, State> now = states_of(run);
    for (const auto& [name, state] : now) {
      const auto known = before.find(name);
      if (known == before.end() || !last(*known).same_bits(state)) write(name, state);
    }
    const std::string own = name_of(run) + " ";
    for (auto old = before.lower_bound(own); old != before.end() && old->first.rfind(own, 0) == 0;
         ++old)
      if (now.count(old->first) == 0 && last(*old).verdict != "gone")
        write(old->first, {"gone", std::nullopt, 0});
  }
}

std::vector<HistoryCall> calls_of(Database& database) {
  std::vector<HistoryCall> calls;
  Statement rows(
      database,
      "SELECT id, date, commit_id, machine, runs, checks, failures, cpu_s, work FROM call "
      "ORDER BY id");
  const auto size = [&](int i) { return static_cast<std::size_t>(rows.integer(i)); };
  while (rows.step())
    calls.push_back({rows.integer(0), rows.text(1), rows.text(2), rows.text(3), size(4), size(5),
                     size(6), size(8), rows.number(7).value_or(0)});
  return calls;
}

/// Counted work as courses of values without noise.
std::map<std::string, Course> work_courses(Database& database) {
  std::map<std::string, Course> courses;
  Statement rows(database,
                 "SELECT text, call, work FROM cost JOIN name ON name.id = cost.name ORDER BY "
                 "cost.rowid");
  while (rows.step()) courses[rows.text(0)].push_back({rows.integer(1), {"", rows.number(2), 0}});
  return courses;
}

/// What differs from how it stood at a call, with the first call after it that had that.
std::vector<HistoryChange> changes_since(std::int64_t since,
                                         const std::map<std::string, Course>& courses,
                                         const std::vector<HistoryCall>& calls) {
  std::vector<HistoryChange> changes;
  for (const auto& [name, course] : courses) {
    const auto later =
        std::ranges::find_if(course, [&](const auto& step) { return step.first > since; });
    if (later == course.begin() || later == course.end()) continue;  // new, or as it was
    const State& before = std::prev(later)->second;
    const State& now = course.back().second;
    if (!now.differs(before)) continue;
    auto first = later;  // since when it has been other than before without a break
    for (auto step = later; step != course.end(); ++step)
      if (!step->second.differs(before)) first = std::next(step);
    const auto call =
        std::ranges::find_if(calls, [&](const HistoryCall& c) { return c.id == first->first; });
    changes.push_back(
        {name, before.verdict, now.verdict, before.value, now.value, call->commit, call->date});
  }
  std::ranges::stable_sort(
      changes, [](const auto& a, const auto& b) { return a.of_verdict() && !b.of_verdict(); });
  return changes;
}

std::vector<HistoryDrift> drifts_of(const std::map<std::string, Course>& courses) {
  constexpr std::size_t kLeast = 3;      // steps
  constexpr double kLargestStep = 0.01;  // relative: more is no slow drift
  std::vector<HistoryDrift> drifts;
  for (const auto& [name, course] : courses) {
    std::vector<double> values;
    bool slow = true;
    for (const auto& [call, state] : course) {
      slow = slow && state.value && state.verdict == course.front().second.verdict;
      if (!slow) break;
      if (!values.empty() && std::abs(*state.value - values.back()) <= state.noise) continue;
      values.push_back(*state.value);
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
  if (format_of(database) == 0) database.execute(kTables);
  add_call(database, results);
  add_entries(database, results, database.last_id());
  database.execute("COMMIT");
}

History read_history(const fs::path& file) {
  Database database(file, false);
  if (format_of(database) == 0)
    throw InputError(file.string() + ": expected a history (found an empty file)");
  History history;
  history.calls = calls_of(database);
  for (std::size_t i = 0; i + 1 < history.calls.size(); ++i)
    if (history.calls[i].green()) history.since = history.calls[i].id;
  const auto courses = courses_of(database);
  if (history.since > 0) {
    history.changes = changes_since(history.since, courses, history.calls);
    history.work = changes_since(history.since, work_courses(database), history.calls);
  }
  history.drifts = drifts_of(courses);
  return history;
}

}  // namespace trammel::harness

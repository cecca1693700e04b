#include "reports/page/sections.h"

namespace trammel::reports {

namespace {

struct Entry {
  const char *key, *words;
};
constexpr std::array<Entry, 9> kEntries = {{
    {"trammel", "trammel"},
    {"commit", "commit"},
    {"date", "date"},
    {"compiler", "compiler"},
    {"build_type", "build"},
    {"flags", "flags"},
    {"processor", "processor"},
    {"cores", "cores"},
    {"system", "system"},
}};

void add(Data& rows, const std::string& key, const std::string& value) {
  Data row = object();
  row.set("key", key);
  row.set("value", value);
  rows.push_back(row);
}

std::string value_of(const Results& results, const std::string& key) {
  const auto found = results.environment.find(key);
  return found == results.environment.end() ? "" : found->second;
}

}  // namespace

Data environment_section(const Results& results) {
  Data data = object();
  for (const Entry& entry : kEntries) set_text(data, entry.key, value_of(results, entry.key));
  Data rows = list();
  for (const Entry& entry : kEntries) {
    const std::string value = value_of(results, entry.key);
    if (!value.empty()) add(rows, entry.words, value);
  }
  for (const auto& [name, version] : results.libraries) add(rows, name, version);
  data.set("rows", rows);
  return data;
}

}  // namespace trammel::reports

#include "reports/sections/sections.h"
#include "reports/text/html.h"

namespace trammel::reports {

Data environment_section(const Results& results) {
  const Environment& from = results.environment;
  const std::pair<const char*, std::string> entries[] = {
      {"trammel", from.trammel},     {"commit", from.commit},
      {"date", from.date},           {"compiler", from.compiler},
      {"build", from.build_type},    {"flags", from.flags},
      {"processor", from.processor}, {"cores", std::to_string(from.cores)},
      {"system", from.system}};
  Data data = object();
  Data rows = list();
  const auto add = [&](const std::string& key, const std::string& value) {
    rows.push_back(object({{"key", key}, {"value", value}}));
  };
  for (const auto& [key, value] : entries) {
    set(data, {{key, value}});
    if (!value.empty()) add(key, value);
  }
  for (const auto& [name, version] : from.libraries) add(name, version);
  if (from.stored_runs > 0)
    add("not computed anew",
        std::to_string(from.stored_runs) + " of " + std::to_string(results.runs.size()) +
            " runs, left by an earlier call of the same program on the same input, and the "
            "drawings of what did not change");
  if (results.solver) add("computed by", results.solver->name + " " + results.solver->version);
  data.set("rows", rows);
  return data;
}

}  // namespace trammel::reports

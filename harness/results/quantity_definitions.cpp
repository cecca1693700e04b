#include "harness/results/quantity_definitions.h"

#include <map>
#include <sstream>

#include "harness/base/find_or_add.h"
#include "harness/base/text.h"

namespace trammel::results {

namespace {

/// Reads the table quantities.txt. A line in brackets lists analyses, or adds them to the previous
/// list ([+ ...]). Each line below defines a quantity that all these analyses compute. "+peak_" in
/// the brackets also defines the largest magnitude of each quantity, with this prefix.
std::vector<QuantityDefinition> read_table() {
  std::vector<QuantityDefinition> all;
  std::vector<std::string> analyses;
  std::string prefix;
  std::istringstream table(harness::embedded_text("quantities.txt"));
  for (std::string line; std::getline(table, line);) {
    if (line.empty()) continue;
    if (line.front() == '[') {
      std::istringstream names(line.substr(1, line.size() - 2));
      if (line[1] != '+') analyses.clear();
      prefix.clear();
      for (std::string name; names >> name;) {
        if (name.front() != '+') analyses.push_back(name);
        if (name.front() == '+') prefix = name.substr(1);
      }
      continue;
    }
    const std::size_t gap = line.find("  ");
    const std::string name = line.substr(0, gap), meaning = line.substr(gap + 2);
    all.push_back({name, analyses, meaning});
    if (!prefix.empty()) all.push_back({prefix + name, analyses, "largest magnitude: " + meaning});
  }
  return all;
}

}  // namespace

const std::vector<QuantityDefinition>& quantity_definitions() {
  static const std::vector<QuantityDefinition> all = read_table();
  return all;
}

bool QuantityDefinition::belongs_to_analysis(const std::string& analysis) const {
  return harness::contains(analyses, analysis);
}

const QuantityDefinition* find_quantity_definition(const std::string& name,
                                                   const std::string& analysis) {
  static const auto by_head = [] {
    std::map<std::string, std::vector<const QuantityDefinition*>> table;
    for (const QuantityDefinition& one : quantity_definitions())
      table[one.base_name()].push_back(&one);
    return table;
  }();
  const auto found = by_head.find(name.substr(0, name.find(':')));
  if (found == by_head.end()) return nullptr;
  for (const QuantityDefinition* one : found->second)
    if (analysis.empty() || one->belongs_to_analysis(analysis)) return one;
  return nullptr;
}

}  // namespace trammel::results

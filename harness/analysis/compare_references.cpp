#include "harness/analysis/analysis_kinds.h"

namespace trammel {

void compare_references(const Cursor& comparison, const References& references, Recorder& record) {
  for (const auto& [name, pair] : comparison.entries()) {
    const Reference& of = references.get(pair["of"]);
    const Reference& from = references.get(pair["from"]);
    if (of.unit != from.unit || of.values.size() != from.values.size()) {
      throw pair.error("expected two references of one unit and length (got " +
                       std::to_string(of.values.size()) + " in " + of.unit + ", " +
                       std::to_string(from.values.size()) + " in " + from.unit + ")");
    }
    for (std::size_t i = 0; i < of.values.size(); ++i) {
      const double difference = (of.values[i] - from.values[i]) / from.values[i];
      record.add("relative_difference", name, difference);
      record.add("difference_percent", name, 100 * difference);
    }
  }
}

}  // namespace trammel

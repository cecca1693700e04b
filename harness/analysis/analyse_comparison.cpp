#include "harness/analysis/analyse_study.h"

namespace trammel::harness {

StepResult analyse_comparison(const Document& document, const References& references, bool,
                              Recorder& record) {
  const JsonView comparison = JsonView(document)["analysis"]["comparison"];
  for (const auto& [name, pair] : comparison.entries()) {
    const references::Reference& minuend = references.get(pair["compared"]);
    const references::Reference& subtrahend = references.get(pair["baseline"]);
    if (minuend.unit != subtrahend.unit || minuend.values.size() != subtrahend.values.size()) {
      throw pair.error("expected two references of one unit and length (got " +
                       std::to_string(minuend.values.size()) + " in " + minuend.unit + ", " +
                       std::to_string(subtrahend.values.size()) + " in " + subtrahend.unit + ")");
    }
    for (std::size_t i = 0; i < minuend.values.size(); ++i) {
      const double difference = (minuend.values[i] - subtrahend.values[i]) / subtrahend.values[i];
      record.add("relative_difference", name, difference);
      record.add("difference_percent", name, 100 * difference);
    }
  }
  return {};
}

}  // namespace trammel::harness

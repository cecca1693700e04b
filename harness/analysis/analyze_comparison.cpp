#include "harness/results/result_fields.h"

namespace trammel::harness {

StepResult analyze_comparison(const Document& document, const References& references, bool,
                              Recorder& record) {
  const JsonView comparison = JsonView(document)["analysis"]["comparison"];
  for (const auto& [name, pair] : comparison.entries()) {
    const references::Reference& minuend = references.get(pair["compared"]);
    const references::Reference& subtrahend = references.get(pair["baseline"]);
    if (minuend.unit != subtrahend.unit || minuend.values.size() != subtrahend.values.size())
      throw pair.error("expected two references with equal units and numbers of values (got " +
                       std::to_string(minuend.values.size()) + " in " + minuend.unit + ", " +
                       std::to_string(subtrahend.values.size()) + " in " + subtrahend.unit + ")");
    for (std::size_t i = 0; i < minuend.values.size(); ++i) {
      const double difference = (minuend.values[i] - subtrahend.values[i]) / subtrahend.values[i];
      record.add("relative_difference", name, difference);
      record.add("difference_percent", name, 100 * difference);
    }
  }
  return {};
}

StepResult analyze_model_probabilities(const Document& document, const References& references, bool,
                                       Recorder& record) {
  const JsonView id = JsonView(document)["analysis"]["model-probabilities"]["reference"];
  const references::Reference& stored = references.get(id);
  if (stored.probabilities.empty())
    throw id.error("expected a reference with 'probabilities' of interpretations of a publication");
  StepResult result;
  result.model_probabilities =
      results::from_json<results::ModelProbabilities>(Json::parse(stored.probabilities));
  const results::ModelProbabilities& found = *result.model_probabilities;
  int excluded = 0;
  for (const results::ExcludedReadings& some : found.excluded) excluded += some.readings;
  record.add("reading_count", "", found.rows.front().readings);
  record.add("excluded_reading_count", "", excluded);
  for (const results::RowProbabilities& row : found.rows) {
    record.add("log_evidence", row.row, row.log_evidence.value());
    record.add("class_count", row.row, row.classes);
    record.add("class_entropy_bits", row.row, row.entropy_bits.value());
    record.add("credible_class_count", row.row, row.credible_classes);
    record.add("largest_class_probability", row.row, row.leading.front().probability.value());
    record.add("expected_information_bits", row.row,
               row.further_numbers.front().expected_information_bits.value());
  }
  return result;
}

}  // namespace trammel::harness

#include <string>

#include "reports/sections/sections.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

Data row_of(const std::string& title, const std::string& probability, const Numbers& values) {
  const auto cell = [](const Number& value) {
    return object({{"value", value ? significant(*value, 5) : ""}});
  };
  return object({{"title", title}, {"probability", probability}, {"cells", list_of(values, cell)}});
}

std::string caption_of(const RowProbabilities& row) {
  return count(static_cast<std::size_t>(row.readings), "reading") + " in " +
         count(static_cast<std::size_t>(row.classes), "class", "classes") +
         " that the row could tell apart; 95\u202f% of the probability lie in " +
         std::to_string(row.credible_classes) + ".";
}

Data table_of(const RowProbabilities& row, const std::string& variant) {
  Data rows = list();
  rows.push_back(row_of("as printed [" + row.unit + "]", "", row.printed));
  for (const ReadingClass& some : row.leading) {
    const auto others = static_cast<std::size_t>(some.readings - 1);
    rows.push_back(row_of(
        some.title + (others == 0 ? "" : " (and " + count(others, "other") + " within the noise)"),
        relative(some.probability.value_or(0), 3, false), some.values));
  }
  return object({{"title", "Row " + row.row + " under a discrepancy of " +
                               relative(row.discrepancy.value_or(0), 2, false) +
                               (variant == "base" ? "" : ", variant " + variant)},
                 {"rows", rows},
                 {"caption", caption_of(row)}});
}

}  // namespace

void set_model_probabilities(Data& data, const std::vector<const Run*>& runs) {
  Data tables = list();
  std::vector<std::string> excluded;
  for (const Run* run : runs) {
    if (!run->model_probabilities) continue;
    for (const RowProbabilities& row : run->model_probabilities->rows)
      tables.push_back(table_of(row, run->variant));
    for (const ExcludedReadings& some : run->model_probabilities->excluded)
      excluded.push_back(count(static_cast<std::size_t>(some.readings), "combination") + ", as " +
                         some.first + ": " + some.reason);
  }
  set(data, {{"has_model_probabilities", tables.is_non_empty_list()},
             {"model_probabilities", tables},
             {"has_excluded_readings", !excluded.empty()},
             {"excluded_readings", texts(excluded, "value")}});
}

}  // namespace trammel::reports

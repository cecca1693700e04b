#include "harness/grade/adapter_answer.h"

#include <algorithm>

#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/base/text.h"
#include "harness/input/schema.h"
#include "harness/results/quantity_definitions.h"

namespace trammel::harness {
namespace {

constexpr std::uintmax_t kMaxAnswerBytes = std::uintmax_t{64} << 20;

/// The quantity of that name as asked for; null where another of trammel's is given on top.
Json asked_quantity(const Json& asked, const std::string& name, const InputError& unknown) {
  const Json& all = asked.at("quantities");
  const auto found =
      std::ranges::find_if(all, [&](const Json& one) { return one.at("name") == name; });
  if (found != all.end()) return *found;
  if (results::find_quantity_definition(name, "") == nullptr) throw unknown;
  return {{"unit", unit_of(name)}};
}

Quantity read_quantity(const Json& given, const Json& asked, const std::string& file,
                       const std::string& pointer) {
  if (given.at("unit") != asked.at("unit"))
    throw InputError(file, pointer + "/unit",
                     "expected " + quoted(asked.at("unit").get<std::string>()) + " (got " +
                         quoted(printable(given.at("unit").get<std::string>())) + ")");
  Quantity quantity;
  const Json& values = given.at("values");
  quantity.values = values.is_array() ? values.get<std::vector<double>>()
                                      : std::vector<double>{values.get<double>()};
  const Json length = asked.value("length", Json());
  if (length.is_number() && length != quantity.values.size())
    throw InputError(file, pointer + "/values",
                     "expected " + length.dump() + " numbers (got " +
                         std::to_string(quantity.values.size()) + ")");
  return quantity;
}

}  // namespace

void read_adapter_answer(const std::filesystem::path& file, const Json& asked, Run& run) {
  const std::string name = file.filename().string();
  std::error_code error;
  const auto bytes = std::filesystem::file_size(file, error);
  if (error) throw InputError(name, "", "expected a file that the adapter writes (got none)");
  if (bytes > kMaxAnswerBytes) throw InputError(name, "", "expected at most 64 MiB");
  const Json json = parse_json(read_text(file), name);
  if (const auto fault = find_schema_fault(json, "adapter_result"))
    throw InputError(name, fault->pointer, fault->message);
  auto status = json.at("status").get<std::string>();
  std::ranges::replace(status, '_', '-');
  run.status = results::read_status(status);
  run.reason = one_line(json.value("reason", ""));
  if (json.contains("solver")) {
    const Json& solver = json.at("solver");
    run.solver = {solver.at("name").get<std::string>(), solver.value("version", ""), {}, {}};
    if (solver.contains("element_order") && !solver.at("element_order").is_null())
      run.solver.element_order = solver.at("element_order").get<double>();
    if (solver.contains("digits") && !solver.at("digits").is_null())
      run.solver.digits = solver.at("digits").get<int>();
  }
  std::vector<std::string> known;
  for (const Json& one : asked.at("quantities")) known.push_back(one.at("name"));
  const Json quantities = json.value("quantities", Json::object());
  for (const auto& item : quantities.items()) {
    const std::string pointer = (JsonPointer("/quantities") / item.key()).to_string();
    const InputError unknown(name, pointer,
                             "expected a quantity of trammel" + did_you_mean(item.key(), known));
    run.quantities[item.key()] =
        read_quantity(item.value(), asked_quantity(asked, item.key(), unknown), name, pointer);
  }
  if (json.contains("cost") && json.at("cost").contains("seconds"))
    run.cost.timings = {{"solver", json.at("cost").at("seconds").get<double>(), 1}};
}

}  // namespace trammel::harness

#include "references/programs/parameter_sweep.h"

#include "references/programs/program.h"

namespace trammel::references {

namespace {

Json with_value(Json arguments, const std::vector<std::string>& pointers, const Json& value,
                const Arguments& where) {
  for (const std::string& pointer : pointers) {
    try {
      arguments.at(Json::json_pointer(pointer)) = value;
    } catch (const Json::exception&) {
      where.fail("pointers", "expected pointers to values of the arguments, not '" + pointer + "'");
    }
  }
  return arguments;
}

}  // namespace

std::vector<double> parameter_sweep_program(const Json& json) {
  const Arguments arguments(json, "", {"program", "arguments", "pointers", "values", "patches"});
  const std::string program = arguments.text("program");
  std::vector<Json> levels;
  if (arguments.has("patches")) {
    for (const Json& patch : arguments["patches"]) {
      levels.push_back(arguments["arguments"]);
      levels.back().merge_patch(patch);
    }
  } else {
    const std::vector<std::string> pointers = arguments.texts("pointers");
    for (const Json& value : arguments["values"]) {
      levels.push_back(with_value(arguments["arguments"], pointers, value, arguments));
    }
  }
  std::vector<double> values;
  for (const Json& level : levels) {
    const std::vector<double> found = derive(program, level);
    values.insert(values.end(), found.begin(), found.end());
  }
  return values;
}

}  // namespace trammel::references

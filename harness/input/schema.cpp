#include "harness/input/schema.h"

#include <map>
#include <mutex>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "harness/base/data_root.h"
#include "harness/base/json_file.h"
#include "harness/input/schema_diagnostics.h"

namespace trammel::harness {
namespace {

using valijson::adapters::NlohmannJsonAdapter;

struct LoadedSchema {
  nlohmann::json text;
  valijson::Schema rules;
};

const LoadedSchema& load_schema(const std::string& name) {
  static std::mutex lock;
  static std::map<std::string, LoadedSchema> loaded;
  const std::lock_guard<std::mutex> guard(lock);
  const auto [entry, fresh] = loaded.try_emplace(name);
  if (fresh) {
    const auto file = data_root() / "cases" / "schema" / (name + ".schema.json");
    entry->second.text = nlohmann::json(read_json(file));
    valijson::SchemaParser().populateSchema(NlohmannJsonAdapter(entry->second.text),
                                            entry->second.rules);
  }
  return entry->second;
}

/// valijson writes a path as "<root>", "[model]", "[elements]".
std::vector<std::string> path_of(const std::vector<std::string>& context) {
  std::vector<std::string> path;
  for (std::size_t i = 1; i < context.size(); ++i) {
    path.push_back(context[i].substr(1, context[i].size() - 2));
  }
  return path;
}

}  // namespace

std::optional<SchemaError> find_schema_error(const Json& document, const std::string& schema) {
  const LoadedSchema& loaded = load_schema(schema);
  const nlohmann::json plain(document);
  valijson::ValidationResults results;
  valijson::Validator validator;
  if (validator.validate(loaded.rules, NlohmannJsonAdapter(plain), &results)) return std::nullopt;
  // The innermost error is the cause; those around it only repeat that something inside is wrong.
  std::vector<std::string> deepest;
  for (const auto& error : results) {
    if (error.context.size() > deepest.size()) deepest = error.context;
  }
  return explain(loaded.text, plain, path_of(deepest));
}

}  // namespace trammel::harness

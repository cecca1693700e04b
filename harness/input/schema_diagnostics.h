#pragma once

#include <string>
#include <vector>

#include "harness/base/json.h"
#include "harness/input/schema.h"
#include "harness/input/schema_rules.h"

namespace trammel::harness {

/// A value and the rules, all those of an anyOf, that it breaks.
struct BrokenRules {
  const Json* value = nullptr;
  std::vector<std::string> path;  ///< of keys and indices, from the root
  std::vector<const SchemaRule*> rules;
};

/// What the schema wants instead, in words.
/// @param schema  root of the schema document
[[nodiscard]] SchemaFault explain(const SchemaRule& schema, const BrokenRules& broken);

}  // namespace trammel::harness

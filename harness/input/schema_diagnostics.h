#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/input/schema.h"

/// What a JSON Schema wants, in words. Whether a document obeys is for the validator to say; this
/// only explains.
namespace trammel::harness {

/// Explains the value at `path`, which the validator refused.
/// @param schema  root of the schema document
[[nodiscard]] SchemaError explain(const nlohmann::json& schema, const nlohmann::json& document,
                                  const std::vector<std::string>& path);

}  // namespace trammel::harness

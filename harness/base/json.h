#pragma once

#include <nlohmann/json.hpp>

#include "harness/base/number.h"

namespace trammel::harness {

/// JSON type that keeps the order of keys. Cases, checks and variants are therefore shown in the
/// order in which the file lists them.
using Json = nlohmann::ordered_json;
using JsonPointer = Json::json_pointer;

/// Returns a number as JSON; null if the number is missing or infinite, which JSON cannot express.
[[nodiscard]] inline Json number_or_null(Number value) {
  return value ? Json(*value) : Json(nullptr);
}

}  // namespace trammel::harness

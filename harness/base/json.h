#pragma once

#include <nlohmann/json.hpp>

#include "harness/base/number.h"

namespace trammel::harness {

/// Keeps the order of the file: cases, checks and variants are shown as they were written.
using Json = nlohmann::ordered_json;
using JsonPointer = Json::json_pointer;

/// null where the number is missing or not finite, which JSON cannot hold.
[[nodiscard]] inline Json number_or_null(Number value) {
  return value ? Json(*value) : Json(nullptr);
}

}  // namespace trammel::harness

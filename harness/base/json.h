#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace trammel::harness {

/// Keeps the order of the file: cases, checks and variants are shown as they were written.
using Json = nlohmann::ordered_json;
using JsonPointer = Json::json_pointer;

/// null where the number is not finite, which JSON cannot hold.
[[nodiscard]] inline Json number_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}
[[nodiscard]] inline Json number_or_null(const std::optional<double>& value) {
  return value ? number_or_null(*value) : Json(nullptr);
}

}  // namespace trammel::harness

#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace trammel {

/// Keeps the order of the file: cases, checks and variants are shown as they were written.
using Json = nlohmann::ordered_json;
using JsonPointer = Json::json_pointer;

}  // namespace trammel

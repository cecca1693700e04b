#pragma once

#if defined(__SSE2__) && !defined(__SANITIZE_ADDRESS__)  // reads 16 bytes at a time
#define RAPIDJSON_SSE2
#endif
#include <rapidjson/document.h>

#include <string>

/// Schemas as rapidjson reads them: five times faster than nlohmann's reader, whose time on the
/// 85 kB of the case schema a user waits for. rapidjson's own validator takes 20 million
/// instructions to populate the case schema, and names no fault inside an alternative of anyOf.
namespace trammel::harness {

using SchemaRule = rapidjson::Value;

/// The value of that keyword, or null.
[[nodiscard]] const SchemaRule* keyword(const SchemaRule& rule, const char* name);

/// The schemas of cases/schema, each read once in a process.
/// @throws InputError  where there is no such schema.
[[nodiscard]] const SchemaRule& load_schema(const std::string& name);

/// What "$ref" stands for; any other rule is itself.
[[nodiscard]] const SchemaRule& resolved(const SchemaRule& root, const SchemaRule& rule);

/// Whether "type" is, or is among others, the one named.
[[nodiscard]] bool wants(const SchemaRule& rule, const char* type);

[[nodiscard]] inline std::string text_of(const SchemaRule& value) {
  return {value.GetString(), value.GetStringLength()};
}

}  // namespace trammel::harness

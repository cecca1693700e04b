#pragma once

#if defined(__SSE2__)  // RapidJSON processes 16 bytes at a time
#define RAPIDJSON_SSE2
#endif
#include <rapidjson/document.h>

#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#include "harness/base/json.h"
#include "harness/input/document.h"

/// Schemas read with RapidJSON, which is five times faster than nlohmann's reader. The case schema
/// has 85 kB, and the user waits while it is read. RapidJSON's own validator is not used: it takes
/// 20 million instructions to set up the case schema, and reports no violation inside an
/// alternative of anyOf.
namespace trammel::harness {

/// Allocator that throws std::bad_alloc. RapidJSON's own allocator returns null, which its reader
/// then dereferences.
struct SchemaAllocator {
  static constexpr bool kNeedFree = true;
  static void* Malloc(std::size_t size) { return size > 0 ? non_null(std::malloc(size)) : nullptr; }
  static void* Realloc(void* data, std::size_t /*old_size*/, std::size_t size) {
    if (size > 0) return non_null(std::realloc(data, size));
    std::free(data);
    return nullptr;
  }
  static void Free(void* data) { std::free(data); }

 private:
  static void* non_null(void* data) { return data != nullptr ? data : throw std::bad_alloc(); }
};

using SchemaPool = rapidjson::MemoryPoolAllocator<SchemaAllocator>;
using SchemaRule = rapidjson::GenericValue<rapidjson::UTF8<>, SchemaPool>;
using SchemaDocument = rapidjson::GenericDocument<rapidjson::UTF8<>, SchemaPool, SchemaAllocator>;

/// Returns the value of a keyword of a JSON schema, such as "minimum"; null if the keyword is
/// absent.
[[nodiscard]] const SchemaRule* keyword(const SchemaRule& rule, const char* name);

/// Loads a schema of cases/schema. Each schema is read once per process.
/// @throws InputError  if the schema does not exist.
[[nodiscard]] const SchemaRule& load_schema(const std::string& name);

/// Returns the schema rule to which "$ref" refers, or the rule itself if it has no "$ref".
[[nodiscard]] const SchemaRule& resolve_ref(const SchemaRule& root, const SchemaRule& rule);

/// Returns true if the keyword "type" of a schema rule allows the given JSON type.
[[nodiscard]] bool rule_allows_type(const SchemaRule& rule, const char* type);

/// JSON value and the schema rules that it violates. For anyOf, these are the rules of all options.
struct BrokenRules {
  const Json* value = nullptr;
  std::vector<std::string> path;  ///< keys and indices that lead from the root to the value
  std::vector<const SchemaRule*> rules;
};

/// Returns the position of a violation, and a message with the expected and the given value.
/// @param schema  root of the schema document
[[nodiscard]] SchemaFault describe_violation(const SchemaRule& schema, const BrokenRules& broken);

[[nodiscard]] inline std::string schema_string(const SchemaRule& value) {
  return {value.GetString(), value.GetStringLength()};
}

}  // namespace trammel::harness

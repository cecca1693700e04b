#pragma once

#if defined(__SSE2__)  // reads 16 bytes at a time
#define RAPIDJSON_SSE2
#endif
#include <rapidjson/document.h>

#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#include "harness/base/json.h"
#include "harness/input/document.h"

/// Schemas as rapidjson reads them: five times faster than nlohmann's reader, whose time on the
/// 85 kB of the case schema a user waits for. rapidjson's own validator takes 20 million
/// instructions to populate the case schema, and names no fault inside an alternative of anyOf.
namespace trammel::harness {

/// Throws std::bad_alloc where rapidjson's own allocator returns null, which its reader then uses.
struct SchemaAllocator {
  static constexpr bool kNeedFree = true;
  static void* Malloc(std::size_t size) { return size > 0 ? checked(std::malloc(size)) : nullptr; }
  static void* Realloc(void* data, std::size_t /*old_size*/, std::size_t size) {
    if (size > 0) return checked(std::realloc(data, size));
    std::free(data);
    return nullptr;
  }
  static void Free(void* data) { std::free(data); }

 private:
  static void* checked(void* data) { return data != nullptr ? data : throw std::bad_alloc(); }
};

using SchemaPool = rapidjson::MemoryPoolAllocator<SchemaAllocator>;
using SchemaRule = rapidjson::GenericValue<rapidjson::UTF8<>, SchemaPool>;
using SchemaDocument = rapidjson::GenericDocument<rapidjson::UTF8<>, SchemaPool, SchemaAllocator>;

/// The value of that keyword, or null.
[[nodiscard]] const SchemaRule* keyword(const SchemaRule& rule, const char* name);

/// The schemas of cases/schema, each read once in a process.
/// @throws InputError  where there is no such schema.
[[nodiscard]] const SchemaRule& load_schema(const std::string& name);

/// What "$ref" stands for; any other rule is itself.
[[nodiscard]] const SchemaRule& resolved(const SchemaRule& root, const SchemaRule& rule);

/// Whether "type" is, or is among others, the one named.
[[nodiscard]] bool wants(const SchemaRule& rule, const char* type);

/// A value and the rules, all those of an anyOf, that it breaks.
struct BrokenRules {
  const Json* value = nullptr;
  std::vector<std::string> path;  ///< of keys and indices, from the root
  std::vector<const SchemaRule*> rules;
};

/// Describes in words what the schema expects.
/// @param schema  root of the schema document
[[nodiscard]] SchemaFault explain(const SchemaRule& schema, const BrokenRules& broken);

[[nodiscard]] inline std::string text_of(const SchemaRule& value) {
  return {value.GetString(), value.GetStringLength()};
}

}  // namespace trammel::harness

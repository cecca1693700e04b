#include "harness/input/schema_rules.h"

#include <rapidjson/pointer.h>

#include <algorithm>
#include <map>

#include "harness/base/data_root.h"
#include "harness/base/errors.h"
#include "harness/base/json_file.h"

namespace trammel::harness {

const SchemaRule* keyword(const SchemaRule& rule, const char* name) {
  const auto found = rule.FindMember(name);
  return found == rule.MemberEnd() ? nullptr : &found->value;
}

const SchemaRule& load_schema(const std::string& name) {
  static std::map<std::string, std::pair<std::string, SchemaDocument>> loaded;
  auto& [text, document] = loaded[name];  // whose strings point into the text
  if (document.IsNull()) {
    const auto file = data_root() / "cases" / "schema" / (name + ".schema.json");
    // White space is skipped in aligned blocks of 16 bytes, which may begin at the last byte.
    text = read_text(file) + std::string(16, '\0');
    if (document.ParseInsitu(text.data()).HasParseError())
      throw InputError(file.string() + ": expected JSON");
  }
  return document;
}

const SchemaRule& resolved(const SchemaRule& root, const SchemaRule& rule) {
  const SchemaRule* reference = keyword(rule, "$ref");
  if (reference == nullptr) return rule;
  using Pointer = rapidjson::GenericPointer<SchemaRule, SchemaAllocator>;
  return resolved(root, *Pointer(reference->GetString(), reference->GetStringLength()).Get(root));
}

bool wants(const SchemaRule& rule, const char* type) {
  const SchemaRule* stated = keyword(rule, "type");
  if (stated == nullptr) return false;
  const auto is_type = [&](const SchemaRule& value) { return value == type; };
  return stated->IsString() ? is_type(*stated)
                            : std::any_of(stated->Begin(), stated->End(), is_type);
}

}  // namespace trammel::harness

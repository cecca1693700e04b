#include "harness/input/former_names.h"

#include <algorithm>
#include <sstream>

#include "harness/base/data_root.h"
#include "harness/base/json_file.h"

namespace trammel::harness {
namespace {

const Json& renamed(const char* kind) {
  static const Json names = read_json(data_root() / "cases" / "schema" / "renamed.json");
  return names.at(kind);
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
  return parts;
}

/// Whether a key is what the pattern's part names, or what that is called now.
bool fits(const std::string& part, const std::string& key) {
  if (part == "*" || part == key) return true;
  const auto& keys = renamed("keys").items();
  return std::ranges::any_of(keys, [&](const auto& entry) {
    return split(entry.key(), '/').back() == part && entry.value() == key;
  });
}

}  // namespace

std::string current_key(const std::vector<std::string>& path) {
  std::vector<std::string> whole = {""};  // a pattern that begins with '/' asks for it
  whole.insert(whole.end(), path.begin(), path.end());
  std::string found = path.back();
  std::size_t longest = 0;
  for (const auto& [pattern, name] : renamed("keys").items()) {
    const std::vector<std::string> parts = split(pattern, '/');
    if (parts.size() <= longest || parts.size() > whole.size() || parts.back() != path.back()) {
      continue;
    }
    if (!std::equal(parts.rbegin(), parts.rend(), whole.rbegin(), fits)) continue;
    longest = parts.size();
    found = name.get<std::string>();
  }
  return found;
}

std::string current_quantity(const std::string& name) {
  std::string now;
  for (const std::string& part : split(name, ':')) {
    now += (now.empty() ? "" : ":") + renamed("quantities").value(part, part);
  }
  return now;
}

std::string current_command(const std::string& word) {
  return renamed("commands").value(word, word);
}

}  // namespace trammel::harness

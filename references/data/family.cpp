#include "references/data/family.h"

#include <dirent.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "references/data/reference.h"

namespace trammel::references {
namespace {

using Json = nlohmann::json;

constexpr std::array<bool, 256> kStructural = [] {
  std::array<bool, 256> table{};
  for (const unsigned char character : {'"', '{', '}', '[', ']', ','}) table[character] = true;
  return table;
}();

/// Position in a JSON text. The functions `pass...` advance the position, and return false if the
/// text does not contain the expected characters at the position.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  [[nodiscard]] std::size_t place() const { return place_; }
  bool is_at(char character) {
    place_ = std::min(text_.find_first_not_of(" \t\r\n", place_), text_.size());
    return place_ < text_.size() && text_[place_] == character;
  }
  bool pass(char character) {
    const bool there = is_at(character);
    place_ += there ? 1 : 0;
    return there;
  }
  [[nodiscard]] bool is_at_end() { return !is_at('\0') && place_ == text_.size(); }

  /// Advances the position past the string that starts at the position.
  bool pass_string() {
    ++place_;
    while ((place_ = text_.find('"', place_)) != std::string_view::npos) {
      const std::size_t last = text_.find_last_not_of('\\', place_ - 1);
      const std::size_t backslashes = place_++ - 1 - last;
      if (backslashes % 2 == 0) return true;
    }
    return false;
  }

  /// Advances the position past a value, to the comma or bracket after it.
  bool pass_value() {
    for (int depth = 0;; ++place_) {
      const char* next = text_.data() + place_;
      const char* const end = text_.data() + text_.size();
      while (next != end && !kStructural[static_cast<unsigned char>(*next)]) ++next;
      place_ = static_cast<std::size_t>(next - text_.data());
      if (next == end) return false;
      const char character = *next;
      if (character == '"') {
        if (!pass_string()) return false;
        --place_;
      } else if (character == '{' || character == '[') {
        ++depth;
      } else if (character == '}' || character == ']') {
        if (depth-- == 0) return true;
      } else if (character == ',' && depth == 0) {
        return true;
      }
    }
  }

 private:
  std::string_view text_;
  std::size_t place_ = 0;
};

bool less(const JsonMember& a, const JsonMember& b) {
  return a.key < b.key;
}

constexpr std::string_view kEnding = ".json";

/// Calls the function `see` with the folder and the name of each JSON file in a folder and its
/// subfolders.
template <typename See>
void walk(const std::string& folder, const See& see) {
  const std::unique_ptr<DIR, int (*)(DIR*)> open(opendir(folder.c_str()), closedir);
  if (!open) return;
  while (const dirent* entry = readdir(open.get())) {
    const std::string_view name = entry->d_name;
    if (name == "." || name == "..") continue;
    if (name.size() > kEnding.size() && name.ends_with(kEnding)) {
      see(folder, name);
    } else if (entry->d_type == DT_DIR || entry->d_type == DT_UNKNOWN) {
      walk(folder + "/" + entry->d_name, see);
    }
  }
}

}  // namespace

bool is_reference_id(std::string_view key) {
  return key != kCommon && key != "$schema";
}

std::optional<std::vector<JsonMember>> json_members(std::string_view text) {
  Scanner scanner(text);
  std::vector<JsonMember> members;
  if (!scanner.pass('{')) return {};
  if (!scanner.is_at('}')) {
    do {
      if (!scanner.is_at('"')) return {};
      const std::size_t key = scanner.place() + 1;
      if (!scanner.pass_string()) return {};
      const std::size_t key_end = scanner.place() - 1;
      if (!scanner.pass(':')) return {};
      const std::size_t value = scanner.place();
      if (!scanner.pass_value()) return {};
      const std::size_t end = text.find_last_not_of(" \t\r\n", scanner.place() - 1) + 1;
      members.push_back({text.substr(key, key_end - key), text.substr(value, end - value)});
    } while (scanner.pass(','));
  }
  if (!scanner.pass('}') || !scanner.is_at_end()) return {};
  std::ranges::sort(members, less);
  const auto is_twice = [](const JsonMember& a, const JsonMember& b) { return a.key == b.key; };
  if (std::ranges::adjacent_find(members, is_twice) != members.end()) return {};
  return members;
}

std::vector<std::string_view> top_level_keys(std::string_view text) {
  constexpr std::string_view between = "},\n  \"";
  std::vector<std::string_view> keys;
  const auto add_key = [&](std::size_t start) {
    keys.push_back(text.substr(start, std::min(text.find('"', start), text.size()) - start));
  };
  const std::size_t first = std::min(text.find('{', 1), text.size());
  const std::size_t quote = text.rfind('"', first);
  if (quote != std::string_view::npos) add_key(text.rfind('"', quote - 1) + 1);
  for (std::size_t end = first; (end = text.find('}', end)) != std::string_view::npos; ++end) {
    const std::size_t key = end + between.size();
    if (key < text.size() && text[key - 1] == '"' && text.substr(end).starts_with(between))
      add_key(key);
  }
  return keys;
}

std::optional<std::string_view> find_member(const std::vector<JsonMember>& members,
                                            std::string_view key) {
  const auto member = std::ranges::lower_bound(members, JsonMember{key, {}}, less);
  if (member == members.end() || member->key != key) return {};
  return member->value;
}

Json merge_common_keys(const Json& common, Json reference) {
  for (const auto& [key, value] : common.items()) {
    Json& merged = reference[key];
    if (key == "derivation" && merged.is_object()) {
      Json derivation = value;
      derivation.merge_patch(merged);
      merged = std::move(derivation);
    } else if (merged.is_null()) {
      merged = value;
    }
  }
  return reference;
}

std::map<std::string, Json> read_family(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw ReferenceError(file + ": cannot be read");
  std::vector<std::set<std::string>> keys;  // keys of the open objects, from the root inward
  std::string id;
  const auto refuse_repeated_keys = [&](int, Json::parse_event_t event, const Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event != Json::parse_event_t::key) return true;
    const auto key = parsed.get<std::string>();
    if (keys.size() == 1) id = key;
    if (!keys.back().insert(key).second)
      throw ReferenceError(file + ": /" + id + ": expected every key once (got '" + key +
                           "' twice)");
    return true;
  };
  std::map<std::string, Json> family;
  try {
    const Json json = Json::parse(in, refuse_repeated_keys);
    if (!json.is_object()) throw ReferenceError(file + ": /: expected an object");
    for (const auto& [key, value] : json.items()) {
      if (!value.is_object() && key != "$schema")
        throw ReferenceError(file + ": /" + key + ": expected an object");
      if (is_reference_id(key))
        family[key] = merge_common_keys(json.value(std::string(kCommon), Json()), value);
    }
  } catch (const Json::parse_error& error) {
    throw ReferenceError(file + ": not JSON at byte " + std::to_string(error.byte));
  }
  return family;
}

std::vector<std::pair<std::string, std::string>> json_files(const std::string& folder) {
  std::vector<std::pair<std::string, std::string>> files;
  walk(folder, [&](const std::string& in, std::string_view name) {
    files.emplace_back(name.substr(0, name.size() - kEnding.size()), "");
    std::string& file = files.back().second;
    file.reserve(in.size() + name.size() + 1);
    file.append(in).append(1, '/').append(name);
  });
  return files;
}

FileText read_file(const std::string& file) {
  FileText read;
  struct stat status {};
  if (stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return read;
  const std::unique_ptr<FILE, int (*)(FILE*)> in(std::fopen(file.c_str(), "rb"), std::fclose);
  if (!in) return read;
  const auto size = static_cast<std::size_t>(status.st_size);
  read.bytes = std::make_unique_for_overwrite<char[]>(size);
  read.text = {read.bytes.get(), std::fread(read.bytes.get(), 1, size, in.get())};
  return read;
}

}  // namespace trammel::references

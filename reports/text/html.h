#pragma once

#include <concepts>
#include <initializer_list>
#include <kainjow/mustache.hpp>
#include <string>
#include <utility>

namespace trammel::reports {

/// What a template is filled with. {{name}} is escaped by mustache, {{{name}}} is not.
using Data = kainjow::mustache::data;

/// What a template finds under a name: a text, yes or no, or data in turn. An empty text is no, so
/// that {{#name}} skips it and no outer `name` shines through.
struct Entry {
  Entry(std::string key, const std::string& text)
      : name(std::move(key)), value(text.empty() ? Data(false) : Data(text)) {}
  Entry(std::string key, const char* text) : Entry(std::move(key), std::string(text)) {}
  Entry(std::string key, std::same_as<bool> auto flag) : name(std::move(key)), value(flag) {}
  Entry(std::string key, Data data) : name(std::move(key)), value(std::move(data)) {}

  std::string name;
  Data value;
};

inline void set(Data& data, std::initializer_list<Entry> entries) {
  for (const Entry& entry : entries) data.set(entry.name, entry.value);
}

/// A text that was set, an empty one too.
[[nodiscard]] inline std::string text_under(const Data& data, const std::string& name) {
  const Data* found = data.get(name);
  return found != nullptr && found->is_string() ? found->string_value() : "";
}

[[nodiscard]] inline Data object(std::initializer_list<Entry> entries = {}) {
  Data data(Data::type::object);
  set(data, entries);
  return data;
}

[[nodiscard]] inline Data list() {
  return Data(Data::type::list);
}

/// What `make` makes of each, in order.
template <typename Range, typename Make>
[[nodiscard]] Data list_of(const Range& range, Make make) {
  Data out = list();
  for (const auto& item : range) out.push_back(make(item));
  return out;
}
/// A list whose items hold one text each, under `name`.
template <typename Range>
[[nodiscard]] Data texts(const Range& range, const char* name = "text") {
  return list_of(range, [&](const auto& text) { return object({{name, text}}); });
}

}  // namespace trammel::reports

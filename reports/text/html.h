#pragma once

#include <concepts>
#include <initializer_list>
#include <kainjow/mustache.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "reports/text/quantity.h"

/// Data for the Mustache templates of pages. Mustache escapes HTML characters in the value of
/// {{name}} and copies the value of {{{name}}} unchanged.
namespace trammel::reports {

using Data = kainjow::mustache::data;

/// A variable of a template with its value: a text, a truth value, or nested data. An empty text
/// becomes false, so that Mustache skips {{#name}} and does not use a `name` of the enclosing data.
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

/// Returns the text of a variable of the data; empty if the data have no such text.
[[nodiscard]] inline std::string text_variable(const Data& data, const std::string& name) {
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

/// Returns template data: a list with the result of the function `make` for each item, in the order
/// of the items.
template <typename Range, typename Make>
[[nodiscard]] Data list_of(const Range& range, Make make) {
  Data out = list();
  for (const auto& item : range) out.push_back(make(item));
  return out;
}

/// Returns a list of objects, each with one text under the name "text".
template <typename Range>
[[nodiscard]] Data texts(const Range& range) {
  return list_of(range, [&](const auto& text) { return object({{"text", text}}); });
}

/// A table of texts for table.mustache. The first cell of a row is the heading of the row. A row of
/// one cell is a heading of the rows below it.
struct TextTable {
  std::string title;
  /// Headings of columns; '>' in front marks a column of numbers, '=' a column of formulas
  /// (or texts).
  std::vector<std::string> heads;
  std::vector<std::vector<std::string>> rows = {};
  std::string caption = {};
  std::map<std::string, std::string> links = {};  ///< links of rows, by the heading of the row
};

[[nodiscard]] inline Data table_data(const TextTable& table) {
  const auto is = [&](char mark, std::size_t i) { return table.heads[i].starts_with(mark); };
  Data heads = list(), rows = list();
  for (std::size_t i = 0; i < table.heads.size(); ++i)
    heads.push_back(object(
        {{"text", table.heads[i].substr(is('>', i) || is('=', i))}, {"is_number", is('>', i)}}));
  for (const auto& row : table.rows) {
    Data cells = list();
    for (std::size_t i = 1; i < row.size(); ++i) {
      const bool formula = is('=', i) && row[i].find_first_of("^/=") != std::string::npos;
      cells.push_back(object({{"text", formula ? "" : row[i]},
                              {"formula", formula ? math_html(row[i]) : ""},
                              {"is_number", is('>', i)}}));
    }
    const auto link = table.links.find(row.front());
    rows.push_back(object({{"head", row.front()},
                           {"link", link == table.links.end() ? "" : link->second},
                           {"is_group", row.size() == 1},
                           {"cells", cells}}));
  }
  return object({{"title", table.title},
                 {"caption", table.caption},
                 {"columns", std::to_string(table.heads.size())},
                 {"heads", heads},
                 {"rows", rows}});
}

}  // namespace trammel::reports

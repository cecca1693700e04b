#pragma once

#include <kainjow/mustache.hpp>
#include <string>

namespace trammel::reports {

/// What a template is filled with. {{name}} is escaped by mustache, {{{name}}} is not.
using Data = kainjow::mustache::data;

[[nodiscard]] inline Data object() {
  return Data(Data::type::object);
}
[[nodiscard]] inline Data list() {
  return Data(Data::type::list);
}

/// Empty texts are set as false, so that {{#name}} skips them and no outer `name` shines through.
inline void set_text(Data& data, const std::string& name, const std::string& text) {
  data.set(name, text.empty() ? Data(Data::type::bool_false) : Data(text));
}

inline void set_flag(Data& data, const std::string& name, bool flag) {
  data.set(name, Data(flag ? Data::type::bool_true : Data::type::bool_false));
}

}  // namespace trammel::reports

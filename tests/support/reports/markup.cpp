#include "tests/support/reports/markup.h"

#include <set>

namespace trammel::testing {

namespace {

const std::set<std::string>& void_elements() {
  static const std::set<std::string> names = {"meta", "link", "br", "hr", "img", "input", "col"};
  return names;
}

/// Returns the end of the tag that starts at the position `at`: the first > outside quotes.
std::size_t tag_end(const std::string& text, std::size_t at) {
  char quote = 0;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (quote) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return at;
    }
  }
  return std::string::npos;
}

std::string near(const std::string& text, std::size_t at) {
  return " near \"" + text.substr(at, 60) + "\"";
}

/// Returns true if the & at position `at` starts an entity.
bool is_entity(const std::string& text, std::size_t at) {
  const std::size_t end = text.find(';', at);
  if (end == std::string::npos || end - at < 2 || end - at > 8) return false;
  return text.find_first_of(" <>&", at + 1) > end;
}

}  // namespace

std::string markup_fault(const std::string& text, bool html) {
  std::vector<std::string> open;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '&' && !is_entity(text, at)) return "a bare &" + near(text, at);
    if (text[at] != '<') continue;
    const std::size_t end = tag_end(text, at);
    if (end == std::string::npos) return "an open tag" + near(text, at);
    const char next = text[at + 1];
    if (next == '!' || next == '?') {
      at = end;
      continue;
    }
    const bool closing = next == '/';
    const std::size_t from = at + (closing ? 2 : 1);
    const std::string name = text.substr(from, text.find_first_of(" \t\n/>", from) - from);
    if (name.empty()) return "a bare <" + near(text, at);
    if (closing) {
      if (open.empty() || open.back() != name)
        return "</" + name + "> where " + (open.empty() ? "nothing" : open.back()) + " is open" +
               near(text, at);
      open.pop_back();
    } else if (text[end - 1] != '/' && !(html && void_elements().count(name))) {
      open.push_back(name);
      if (html && (name == "script" || name == "style")) {
        at = text.find("</" + name, end) - 1;
        continue;
      }
    }
    at = end;
  }
  return open.empty() ? "" : open.back() + " is never closed";
}

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos;
       at = text.find(part, at + part.size()))
    ++n;
  return n;
}

std::vector<std::string> attribute_values(const std::string& text, const std::string& name) {
  std::vector<std::string> values;
  for (const char quote : {'"', '\''}) {
    const std::string start = " " + name + "=" + quote;
    for (std::size_t at = text.find(start); at != std::string::npos;
         at = text.find(start, at + 1)) {
      const std::size_t from = at + start.size();
      values.push_back(text.substr(from, text.find(quote, from) - from));
    }
  }
  return values;
}

}  // namespace trammel::testing

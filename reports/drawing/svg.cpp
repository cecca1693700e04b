#include "reports/drawing/svg.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <kainjow/mustache.hpp>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace trammel::reports {

namespace {

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// Takes out everything from `open` to `close`, both included, wherever they stand.
/// @returns what stood between them at the first place.
std::string cut(std::string& text, const std::string& open, const std::string& close) {
  std::string first;
  for (std::size_t at = text.find(open); at != std::string::npos; at = text.find(open, at)) {
    const std::size_t end = text.find(close, at);
    if (end == std::string::npos) break;
    if (first.empty()) first = text.substr(at + open.size(), end - at - open.size());
    text.erase(at, end + close.size() - at);
  }
  return first;
}

/// rgb( 31,  95, 168) -> #1f5fa8
void shorten_colors(std::string& text) {
  for (std::size_t at = text.find("rgb("); at != std::string::npos; at = text.find("rgb(", at)) {
    const std::size_t end = text.find(')', at);
    int r = 0, g = 0, b = 0;
    char comma = 0;
    std::istringstream in(text.substr(at + 4, end - at - 4));
    in >> r >> comma >> g >> comma >> b;
    std::array<char, 8> hex{};
    std::snprintf(hex.data(), hex.size(), "#%02x%02x%02x", r & 255, g & 255, b & 255);
    text.replace(at, end + 1 - at, hex.data());
  }
}

/// What gnuplot says of every group again and stands once on the root.
constexpr std::array<const char*, 6> kCommonAttributes = {" fill=\"none\"",
                                                          " stroke-linecap=\"butt\"",
                                                          " stroke-linejoin=\"miter\"",
                                                          " stroke-linecap=\"round\"",
                                                          " stroke-linejoin=\"round\"",
                                                          " font-family=\"Helvetica\""};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// 57.75 -> 57.8, 335.00 -> 335 inside paths and transforms: a tenth of a unit is finer than eyes.
void shorten_coordinates(std::string& text) {
  std::string out;
  out.reserve(text.size());
  bool inside = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\'') inside = !inside;
    const bool two_decimals = inside && text[i] == '.' && i > 0 && is_digit(text[i - 1]) &&
                              i + 2 < text.size() && is_digit(text[i + 1]) &&
                              is_digit(text[i + 2]) &&
                              (i + 3 == text.size() || !is_digit(text[i + 3]));
    if (!two_decimals) {
      out += text[i];
      continue;
    }
    if (text[i + 1] != '0') out += {'.', text[i + 1]};
    i += 2;
  }
  text = std::move(out);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    const std::size_t from = line.find_first_not_of(" \t");
    if (from == std::string::npos) continue;
    lines.push_back(line.substr(from, line.find_last_not_of(" \t") + 1 - from));
  }
  return lines;
}

bool opens_group(const std::string& line) {
  return line.starts_with("<g") && line.find('>') == line.size() - 1;
}

/// Groups that hold nothing go, and with them those that then hold nothing.
std::string without_empty_groups(const std::string& text) {
  std::vector<std::string> kept;
  for (std::string& line : lines_of(text)) {
    if (line == "</g>" && !kept.empty() && opens_group(kept.back())) {
      kept.pop_back();
    } else {
      kept.push_back(std::move(line));
    }
  }
  std::string out;
  for (const std::string& line : kept) out += line + '\n';
  return out;
}

/// The definitions of the symbols that `body` uses, and of those that these use.
std::string symbols(const std::string& definitions, const std::string& body) {
  const std::vector<std::string> lines = lines_of(definitions);
  std::set<std::string> used;
  std::string seen = body;
  for (bool grown = true; grown;) {
    grown = false;
    for (const std::string& line : lines) {
      const std::size_t at = line.find("id='");
      if (at == std::string::npos || line.starts_with("<filter")) continue;
      const std::string id = line.substr(at + 4, line.find('\'', at + 4) - at - 4);
      if (seen.find("#" + id + "'") == std::string::npos || !used.insert(line).second) continue;
      seen += line;
      grown = true;
    }
  }
  std::string out;
  for (const std::string& line : lines)
    if (used.count(line)) out += line + '\n';
  return out.empty() ? out : "<defs>\n" + out + "</defs>\n";
}

std::string view_box(const std::string& head) {
  const std::size_t at = head.find("viewBox=\"");
  if (at == std::string::npos) throw std::runtime_error("an SVG without viewBox");
  return head.substr(at, head.find('"', at + 9) + 1 - at);
}

}  // namespace

std::string tidy_svg(const std::string& text, const std::string& id, const std::string& title,
                     const std::string& description) {
  const std::size_t start = text.find("<svg");
  const std::size_t end = text.rfind("</svg>");
  if (start == std::string::npos || end == std::string::npos)
    throw std::runtime_error("not a complete SVG");
  const std::size_t open = text.find('>', start) + 1;
  std::string body = text.substr(open, end - open);
  const std::string definitions = cut(body, "<defs>", "</defs>");
  cut(body, "<title>", "</title>");
  cut(body, "<desc>", "</desc>");
  // Groups carry ids that repeat from drawing to drawing; nothing refers to them.
  for (std::size_t at = body.find("<g id="); at != std::string::npos; at = body.find("<g id=", at))
    body.replace(at, body.find('>', at) + 1 - at, "<g>");
  shorten_colors(body);
  for (const char* inherited : kCommonAttributes) replace_all(body, inherited, "");
  shorten_coordinates(body);
  body = without_empty_groups(body);
  body = symbols(definitions, body) + body;
  replace_all(body, "xlink:href='#gp", "href='#" + id + "-gp");
  replace_all(body, "id='gp", "id='" + id + "-gp");
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" " + view_box(text.substr(start, open - start)) +
         " fill=\"none\" stroke-linejoin=\"round\" font-family=\"Helvetica, Arial, sans-serif\""
         " role=\"img\" aria-label=\"" +
         xml_escaped(title + ". " + description) + "\">\n" + body + "</svg>\n";
}

std::string xml_escaped(std::string text) {
  const auto is_unfit = [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t';
  };
  std::ranges::replace_if(text, is_unfit, ' ');
  return kainjow::mustache::html_escape(text);
}

}  // namespace trammel::reports

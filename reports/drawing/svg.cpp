#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/geometry.hpp>
#include <cmath>
#include <cstdio>
#include <kainjow/mustache.hpp>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "reports/drawing/figure.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// Removes all parts of a text that start with `open` and end with `close`.
/// @returns the text between `open` and `close` in the first part.
std::string cut(std::string& text, const std::string& open, const std::string& close) {
  std::string first;
  for (std::size_t at = text.find(open); at != std::string::npos; at = text.find(open, at)) {
    const std::size_t end = text.find(close, at + open.size());
    if (end == std::string::npos) break;
    if (first.empty()) first = text.substr(at + open.size(), end - at - open.size());
    text.erase(at, end + close.size() - at);
  }
  return first;
}

/// Replaces colors such as rgb( 31,  95, 168) by #1f5fa8.
void shorten_colors(std::string& text) {
  for (std::size_t at = text.find("rgb("); at != std::string::npos; at = text.find("rgb(", at)) {
    const std::size_t end = text.find(')', at);
    int r = 0, g = 0, b = 0;
    (void)std::sscanf(text.c_str() + at, "rgb(%d,%d,%d", &r, &g, &b);
    std::array<char, 8> hex{};
    std::snprintf(hex.data(), hex.size(), "#%02x%02x%02x", r & 255, g & 255, b & 255);
    text.replace(at, end + 1 - at, hex.data());
  }
}

/// Removable SVG attributes that gnuplot repeats for every group. Each is set on the root element,
/// is a default, or has no effect, because every path, point and text has its own color.
constexpr const char* kCommonAttributes =
    R"(fill="none" stroke-linecap="butt" stroke-linecap="round" stroke-linejoin="miter"
       stroke-linejoin="round" stroke-width="1.00" font-family="Helvetica" font-size="15.00"
       color="black" stroke="currentColor" stroke="none" class="gridline" text-anchor="middle")";

/// Simplifies the lines of an SVG path and rounds coordinates to 0.1 px. Lines of a single point
/// are omitted.
std::string simplify_svg_path(const std::string& path) {
  using Line = boost::geometry::model::linestring<boost::geometry::model::d2::point_xy<double>>;
  std::string out;
  Line line;
  const auto end_line = [&] {
    Line kept;
    boost::geometry::simplify(line, kept, 0.1);  // largest distance of an omitted point [px]
    for (std::size_t i = 0; kept.size() > 1 && i < kept.size(); ++i)
      out += (i == 0 ? "M" : " ") + shortest_decimal(std::round(10 * kept[i].x()) / 10) + ',' +
             shortest_decimal(std::round(10 * kept[i].y()) / 10);
    line.clear();
  };
  std::istringstream in(path);
  for (char next = 0, comma = 0; in >> next;) {
    if (next == 'M' || next == 'Z') end_line();
    if (next == 'Z') out += 'Z';
    if (next == 'M' || next == 'L' || next == 'Z') continue;
    double x = 0, y = 0;
    in.putback(next) >> x >> comma >> y;
    line.emplace_back(x, y);
  }
  end_line();
  return out;
}

/// Shortens all paths of an SVG drawing, and converts polygons to paths.
void shorten_paths(std::string& text) {
  const std::string open = " d='";
  replace_all(text, " " + open, open);
  replace_all(text, "<polygon fill = ", "<path fill=");
  replace_all(text, " points = '", open + "M");
  for (std::size_t at = text.find(open); at != std::string::npos; at = text.find(open, at)) {
    at += open.size();
    const std::size_t length = text.find('\'', at) - at;
    text.replace(at, length, simplify_svg_path(text.substr(at, length)));
  }
}

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    const std::size_t from = line.find_first_not_of(" \t");
    if (from == std::string::npos) continue;
    lines.push_back(line.substr(from, line.find_last_not_of(" \t") + 1 - from));
  }
  return lines;
}

/// Removes empty groups (<g> elements) from an SVG drawing. For groups without attributes, removes
/// the tags and keeps the content.
std::string remove_idle_svg_groups(std::string text) {
  replace_all(text, "<g", "\n<g");
  replace_all(text, "</g>", "\n</g>\n");
  constexpr auto kNoTag = std::string::npos;
  std::vector<std::string> kept;
  std::vector<std::size_t> groups;  // indices in `kept` of the open <g> tags
  for (std::string& line : split_lines(text)) {
    const bool closes = line == "</g>";
    const std::size_t start = closes && !groups.empty() ? groups.back() : kNoTag;
    if (closes && !groups.empty()) groups.pop_back();
    if (line.starts_with("<g")) groups.push_back(line == "<g>" ? kNoTag : kept.size());
    if (closes && start != kNoTag && start + 1 == kept.size()) {
      kept.pop_back();
    } else if (closes ? start != kNoTag : line != "<g>") {
      kept.push_back(std::move(line));
    }
  }
  std::string out;
  for (const std::string& line : kept) out += line + '\n';
  return out;
}

/// Returns the SVG definitions of the symbols that `body` uses directly or through other symbols.
/// Each symbol is defined before the symbols that use it.
std::string symbols(const std::string& definitions, const std::string& body) {
  const std::vector<std::string> lines = split_lines(definitions);
  std::string used;
  for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
    const std::size_t at = line->find("id='");
    if (at == std::string::npos || line->starts_with("<filter")) continue;
    const std::string mark = "#" + line->substr(at + 4, line->find('\'', at + 4) - at - 3);
    if (body.find(mark) != std::string::npos || used.find(mark) != std::string::npos)
      used.insert(0, *line + '\n');
  }
  return used.empty() ? used : "<defs>\n" + used + "</defs>\n";
}

}  // namespace

std::string tidy_svg(const std::string& text, const std::string& id, const std::string& title,
                     const std::string& description) {
  const std::size_t start = text.find("<svg"), end = text.rfind("</svg>");
  if (start == std::string::npos || end == std::string::npos)
    throw std::runtime_error("gnuplot: the SVG drawing is incomplete");
  const std::size_t open = text.find('>', start) + 1;
  std::string head = text.substr(start, open - start), body = text.substr(open, end - open);
  const std::string definitions = cut(body, "<defs>", "</defs>");
  cut(body, "<title>", "</title>");
  cut(body, "<desc>", "</desc>");
  // The ids of groups are removed, because they repeat in each drawing and are not used.
  for (std::size_t at = body.find("<g id="); at != std::string::npos; at = body.find("<g id=", at))
    body.replace(at, body.find('>', at) + 1 - at, "<g>");
  shorten_colors(body);
  for (const std::string& common : words_in(kCommonAttributes)) replace_all(body, " " + common, "");
  shorten_paths(body);
  body = remove_idle_svg_groups(std::move(body));
  body = symbols(definitions, body) + body;
  const std::string own = "p" + std::to_string(std::hash<std::string>{}(id) % 1000000000) + "-";
  replace_all(body, "xlink:href='#gp", "href='#" + own);
  replace_all(body, "id='gp", "id='" + own);
  return svg_element(cut(head, "viewBox=\"", "\""), title + ". " + description, body);
}

std::string svg_element(const std::string& view_box, const std::string& label,
                        const std::string& body, const std::string& attributes) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{}\" fill=\"none\" "
      "stroke-linejoin=\"round\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"15\" "
      "text-anchor=\"middle\"{} role=\"img\" aria-label=\"{}\">\n{}</svg>\n",
      view_box, attributes, xml_escaped(label), body);
}

std::string xml_escaped(std::string text) {
  const auto is_unfit = [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t';
  };
  std::ranges::replace_if(text, is_unfit, ' ');
  return kainjow::mustache::html_escape(text);
}

}  // namespace trammel::reports

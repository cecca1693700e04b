#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/text/files.h"

namespace trammel::reports {

/// A figure of the report: gnuplot commands or the finished SVG drawing, and the plotted data as a
/// table.
struct Figure {
  std::string id;        ///< slug for the names of files and the anchor, unique within the report
  std::string title;     ///< subject of the figure
  std::string caption;   ///< plotted data, then the conclusion
  std::string alt = {};  ///< description of the picture for screen readers
  int width = 500, height = 360;  ///< size before the page scales it [px]
  std::string commands = {};      ///< gnuplot commands of a PlotScript
  Table data;
  std::string moving = {};  ///< animation as JSON, for page.js; empty: no animation
  bool is_linked = false;   ///< true: the page loads the SVG file when the reader scrolls to it
  std::string svg = {};     ///< drawing as an <svg> element; its ids are unique on the page
};

/// Converts a text to at most 100 lower-case letters, digits and single hyphens. If this changes
/// the text, a hash is appended, so that different texts have different slugs.
[[nodiscard]] std::string slug(const std::string& text);

/// Returns whether gnuplot is installed.
[[nodiscard]] bool has_gnuplot();

/// Draws the figures whose `svg` is empty, with two concurrent gnuplot processes. Sets `svg`, and
/// writes <id>.svg and <id>.csv for each figure into `folder`.
/// @param cache   folder of earlier drawings, which are reused if unchanged; empty: no reuse
/// @param program  version of this program; drawings of other versions are not reused
/// @throws std::runtime_error  if a figure cannot be drawn or written.
void draw(const std::vector<Figure*>& figures, const std::filesystem::path& folder,
          const std::filesystem::path& cache = {}, const std::string& program = {});

/// Converts gnuplot's SVG to an <svg> element for a page: with role, title and description, ids
/// that start with a hash of `id`, and colors as #rrggbb, but without empty groups and unused
/// symbols. Points of a line within 0.1 px of the simplified line are omitted.
/// @throws std::runtime_error  if `text` is not a complete drawing by gnuplot.
[[nodiscard]] std::string tidy_svg(const std::string& text, const std::string& id,
                                   const std::string& title, const std::string& description);

/// Returns an <svg> element with the attributes that all drawings share, such as the font.
/// @param attributes  further attributes, each with a space before it
[[nodiscard]] std::string svg_element(const std::string& view_box, const std::string& label,
                                      const std::string& body, const std::string& attributes = "");

/// Escapes & < > " ' as entities. Control characters that XML cannot contain become spaces.
[[nodiscard]] std::string xml_escaped(std::string text);

}  // namespace trammel::reports

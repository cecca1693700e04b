#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/text/files.h"

namespace trammel::reports {

/// A figure: commands for gnuplot or the drawing itself, and its data as a table.
struct Figure {
  std::string id;        ///< slug for the names of files and the anchor, unique within the report
  std::string title;     ///< subject of the figure
  std::string caption;   ///< plotted data, then the conclusion
  std::string alt = {};  ///< description of the picture for screen readers
  int width = 500, height = 360;  ///< size before scaling to the column [px]
  std::string commands = {};      ///< gnuplot commands of a PlotScript
  Table data;
  std::string moving = {};  ///< JSON of a motion for the script of the page; empty: no motion
  bool is_linked = false;   ///< the page loads the drawing when it comes into view
  std::string svg = {};     ///< the drawing as an element with unique ids
};

/// Converts a text to at most 100 lower-case letters, digits and single hyphens. If this changes
/// the text, a hash is appended, so that different texts have different slugs.
[[nodiscard]] std::string slug(const std::string& text);

/// Returns whether gnuplot is installed.
[[nodiscard]] bool has_gnuplot();

/// Draws the figures that have no drawing yet with two gnuplot processes. Sets `svg`, and writes
/// <id>.svg and <id>.csv for each figure into `folder`.
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

/// Returns an <svg> element with the attributes of all drawings.
/// @param attributes  further attributes, each with a space before it
[[nodiscard]] std::string svg_element(const std::string& view_box, const std::string& label,
                                      const std::string& body, const std::string& attributes = "");

/// Escapes & < > " ' as entities. Control characters that XML cannot contain become spaces.
[[nodiscard]] std::string xml_escaped(std::string text);

}  // namespace trammel::reports

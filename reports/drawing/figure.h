#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/text/files.h"

namespace trammel::reports {

/// A figure before it is drawn: what gnuplot is told, and the same data as a table.
struct Figure {
  std::string id;       ///< a slug, unique within the report: names the files and the anchor
  std::string title;    ///< what is shown
  std::string caption;  ///< what to conclude
  std::string alt;      ///< the picture in words, for those who do not see it
  int width = 500, height = 360;  ///< of the drawing; on the page it scales with its column
  std::string commands;           ///< gnuplot commands of a PlotScript
  Table data;
  std::string moving = {};  ///< JSON of modes or moments that a page's script moves; or empty
  bool is_linked = false;   ///< its page loads the drawing from its file when it comes into view
  int number = 0;           ///< on its page, from 1
  std::string svg = {};  ///< the drawing, once drawn: an element for inlining, with ids of its own
};

/// Lower-case letters, digits and single hyphens, at most 100; with a hash at the end where that is
/// not the text itself, so that two texts have two slugs.
[[nodiscard]] std::string slug(const std::string& text);

/// Whether there is a gnuplot.
[[nodiscard]] bool can_draw();

/// Draws all figures with one gnuplot process: sets `svg`, and writes <id>.svg and <id>.csv for
/// each into `folder`.
/// @param former   folder of drawings, of which those are taken that tell the same; empty: none
/// @param program  what draws: drawings of another one are not taken
/// @throws std::runtime_error if a figure could not be drawn or written.
void draw(const std::vector<Figure*>& figures, const std::filesystem::path& folder,
          const std::filesystem::path& former = {}, const std::string& program = {});

/// gnuplot's SVG made fit to stand beside others in a page: one <svg> element with role, title and
/// description, ids that start with a hash of `id`, colors as #rrggbb, no empty groups, no unused
/// symbols. Lines leave out points that are at most 0.1 of a unit away from the line without them.
/// @throws std::runtime_error if `text` is not a complete drawing of gnuplot's.
[[nodiscard]] std::string tidy_svg(const std::string& text, const std::string& id,
                                   const std::string& title, const std::string& description);

/// & < > " ' as entities; other control characters, which XML cannot hold, as spaces.
[[nodiscard]] std::string xml_escaped(std::string text);

}  // namespace trammel::reports

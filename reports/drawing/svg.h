#pragma once

#include <string>

namespace trammel::reports {

/// gnuplot's SVG made fit to stand beside others in a page: one <svg> element with role, title and
/// description, ids that start with a hash of `id`, colors as #rrggbb, no empty groups, no unused
/// symbols. Lines leave out points that are at most 0.1 of a unit away from the line without them.
/// @throws std::runtime_error if `text` is not a complete drawing of gnuplot's.
[[nodiscard]] std::string tidy_svg(const std::string& text, const std::string& id,
                                   const std::string& title, const std::string& description);

/// & < > " ' as entities; other control characters, which XML cannot hold, as spaces.
[[nodiscard]] std::string xml_escaped(std::string text);

}  // namespace trammel::reports

#pragma once

#include <filesystem>
#include <string>

namespace trammel::testing {

/// What headless Chromium makes of a page: its document after loading, and what it logged.
struct Visit {
  std::string document, console;
};

/// @throws std::runtime_error if there is no browser or it does not end well.
[[nodiscard]] Visit visit(const std::filesystem::path& page);

/// Shows a page in a frame of this width, for no window is as narrow as a phone, with all folded
/// parts open, and measures it: <html> then carries data-width, data-scroll-width, data-figures
/// (drawings with a size), data-empty (those without) and data-wide (elements that stick out at
/// the right, named in data-wide-names), data-misplaced (targets that do not stand under their
/// head).
[[nodiscard]] Visit visit_framed(const std::filesystem::path& page, int width);

/// The number under data-<name>; -1 if there is none.
[[nodiscard]] int measured(const Visit& visit, const std::string& name);

}  // namespace trammel::testing

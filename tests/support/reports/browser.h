#pragma once

#include <filesystem>
#include <string>

namespace trammel::testing {

/// Result of loading a page in headless Chromium: the document after loading, and the log.
struct Visit {
  std::string document, console;
};

/// Loads a page. @throws std::runtime_error  if there is no browser or the browser fails
[[nodiscard]] Visit visit(const std::filesystem::path& page);

/// Loads a page in an HTML frame of this width [px], because browser windows cannot be as narrow as
/// a phone. All collapsible parts are open. The <html> element then has these attributes:
///   data-width, data-scroll-width   widths of the frame and of its content [px].
///   data-figures, data-empty        numbers of drawings with and without a size.
///   data-wide, data-wide-names      number and names of elements beyond the right side.
///   data-misplaced                  number of cells not aligned with the header "Target".
[[nodiscard]] Visit visit_in_frame(const std::filesystem::path& page, int width);

/// Returns the number in data-<name>, or -1 if it is missing.
[[nodiscard]] int measured_number(const Visit& visit, const std::string& name);

}  // namespace trammel::testing

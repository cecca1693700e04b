// ctest: labels=browser timeout=300
#include "tests/support/reports/browser.h"

#include <boost/test/unit_test.hpp>
#include <fstream>

#include "tests/support/reports/markup.h"
#include "tests/support/reports/workspace.h"

BOOST_AUTO_TEST_SUITE(browser)

using namespace trammel::testing;

namespace {

constexpr const char* kPages[] = {"index.html", "families/beam-modes.html",
                                  "cases/beam-pinned-pinned.html", "references.html"};

/// Opens a page of the sample report with a width [px], and checks the conditions that hold for
/// every width.
void check_page_at_width(int width, const std::string& name) {
  const auto page = sample_report() / name;
  const std::string text = read_text_file(page);
  const std::size_t thumbnails = occurrences(text, "class=\"thumbnail\" inert><svg ");
  const auto figures = static_cast<int>(occurrences(text, "<svg ") - thumbnails);
  const Visit seen = visit_in_frame(page, width);
  BOOST_TEST(measured_number(seen, "width") == width);
  BOOST_TEST(measured_number(seen, "figures") == figures);
  BOOST_TEST(measured_number(seen, "empty") == 0);
  BOOST_TEST(measured_number(seen, "scroll-width") <= width);
  BOOST_TEST(measured_number(seen, "wide") == 0, seen.document.substr(0, 600));
  BOOST_TEST(measured_number(seen, "misplaced") == 0);
  BOOST_TEST(seen.console.find("CONSOLE") == std::string::npos, seen.console);
}

}  // namespace

BOOST_AUTO_TEST_CASE(report_is_displayed_without_errors_on_wide_screen) {
  for (const char* page : kPages) check_page_at_width(1280, page);
}

BOOST_AUTO_TEST_CASE(report_fits_a_phone_without_scrolling_sideways) {
  for (const char* page : kPages) check_page_at_width(400, page);
}

BOOST_AUTO_TEST_CASE(script_error_is_detected) {
  const Workspace workspace;
  const auto page = workspace.path() / "broken.html";
  std::ofstream(page) << "<html><body><script>nonsense();</script></body></html>";
  const Visit seen = visit(page);
  BOOST_TEST(seen.console.find("CONSOLE") != std::string::npos, seen.console);
}

BOOST_AUTO_TEST_CASE(wide_block_and_empty_drawing_are_detected) {
  const Workspace workspace;
  const auto page = workspace.path() / "wide.html";
  std::ofstream(page) << "<html><body><main><p style='width: 900px'>x</p>"
                         "<figure><svg></svg></figure></main></body></html>";
  const Visit seen = visit_in_frame(page, 400);
  BOOST_TEST(measured_number(seen, "width") == 400);
  BOOST_TEST(measured_number(seen, "wide") == 1);
  BOOST_TEST(measured_number(seen, "scroll-width") > 400);
  BOOST_TEST(measured_number(seen, "empty") == 1);
}

BOOST_AUTO_TEST_SUITE_END()

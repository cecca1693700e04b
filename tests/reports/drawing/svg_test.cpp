#include <boost/test/unit_test.hpp>

#include "reports/drawing/figure.h"
#include "reports/drawing/plot_script.h"
#include "tests/support/reports/markup.h"

BOOST_AUTO_TEST_SUITE(svg)

using namespace trammel::reports;
using namespace trammel::testing;

namespace {

constexpr const char* kDrawnSvg = R"(<?xml version="1.0"?>
<svg
 viewBox="0 0 500 360"
 xmlns="http://www.w3.org/2000/svg">
<title>Gnuplot</title>
<defs>
	<circle id='gpDot' r='0.5'/>
	<circle id='gpPt5' cx='0' cy='0' r='1'/>
	<use xlink:href='#gpPt5' id='gpPt6' fill='currentColor'/>
</defs>
<g fill="none" color="black">
</g>
<g id="plot_1" ><title>plot_1</title>
<path stroke='rgb( 31,  95, 168)'  d='M57.75,335.00 L69.04,335.12'/>
<use xlink:href='#gpPt6' color='black'/>
<text>335.00 is shown</text>
</g>
</svg>)";

}  // namespace

BOOST_AUTO_TEST_CASE(drawing_becomes_one_element_with_unique_ids) {
  const std::string tidy = tidy_svg(kDrawnSvg, "fig-a", "Title", "What <it> shows");
  BOOST_TEST(markup_fault(tidy, false) == "");
  BOOST_TEST(tidy.rfind("<svg ", 0) == 0U);
  BOOST_TEST(tidy.find(" viewBox=\"0 0 500 360\" fill=\"none\" stroke-linejoin=") !=
             std::string::npos);
  BOOST_TEST(tidy.find("aria-label=\"Title. What &lt;it&gt; shows\"") != std::string::npos);
  const auto symbol = [](const std::string& svg) { return svg.substr(svg.find("<use href"), 30); };
  BOOST_TEST(symbol(tidy) != symbol(tidy_svg(kDrawnSvg, "fig-b", "Title", "")));
  BOOST_TEST(tidy.find("gpDot") == std::string::npos);
  BOOST_TEST(tidy.find("plot_1") == std::string::npos);
  BOOST_TEST(occurrences(tidy, "<g") == 0U);
}

BOOST_AUTO_TEST_CASE(coordinates_and_colors_are_shortened_but_not_texts) {
  const std::string tidy = tidy_svg(kDrawnSvg, "a", "t", "d");
  BOOST_TEST(tidy.find("stroke='#1f5fa8'") != std::string::npos);
  BOOST_TEST(tidy.find("<path stroke='#1f5fa8' d='M57.8,335 69,335.1'/>") != std::string::npos);
  BOOST_TEST(tidy.find("335.00 is shown") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(incomplete_drawing_is_refused) {
  BOOST_CHECK_THROW((void)tidy_svg("<svg viewBox=\"0 0 1 1\">", "a", "t", "d"), std::runtime_error);
}

BOOST_AUTO_TEST_CASE(path_digits_after_a_gnuplot_escape_are_escaped) {
  BOOST_TEST(gnuplot_path("/a%20") == R"("/a\045\062\060")");
}

BOOST_AUTO_TEST_SUITE_END()

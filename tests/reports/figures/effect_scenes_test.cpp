#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include "reports/figures/figures.h"
#include "reports/page/report.h"
#include "reports/sections/sections.h"
#include "tests/support/reports/markup.h"
#include "tests/support/reports/workspace.h"

BOOST_AUTO_TEST_SUITE(effect_scenes)

using namespace trammel::testing;
using namespace trammel::reports;

namespace {

const std::vector<EffectScene> kScenes = {
    {"quick", "statics", "shear", 0.01, 0.002, true, 0.05, 0.01, 0.02, 0.6, 0.4, {}, {}},
    {"slow", "modes", "none", 0.01, 0.02, false, 0.02, 0.02, 0.01, 1.5, 0.5, {}, {}},
    {"short", "modes", "none", 0.001, 0, true, 0.001, 0.001, 0.004, 5, 4, {}, {}},
};

}  // namespace

BOOST_AUTO_TEST_CASE(caption_counts_accurate_and_minimal_scenes) {
  const std::vector<Figure> figures = effect_scene_figures(kScenes);
  BOOST_TEST_REQUIRE(figures.size() == 1U);
  BOOST_TEST(contains(figures[0].caption, "2 of 3 scenes stay within"));
  BOOST_TEST(contains(figures[0].caption, "In 2, no selected effect"));
  BOOST_TEST(contains(figures[0].caption, "took 0.915 times as long"));
  BOOST_TEST(figures[0].data.rows.size() == 3U);
  BOOST_TEST(effect_scene_figures({}).empty());
}

BOOST_AUTO_TEST_CASE(figure_of_a_scene_shows_selected_effects) {
  CaseInfo info;
  Results results;
  Run run;
  info.id = "quick";
  results.effect_scenes = kScenes;
  BOOST_TEST(!effects_figure(info, results, run));
  run.effects = {{"link-mass", "", "", true, true, 0, {}, 0.05, 0.06},
                 {"shear", "", "", true, false, 0, {}, 0.002, 0.002}};
  const std::string caption = effects_figure(info, results, run)->caption;
  BOOST_TEST(contains(caption, "Kept: link mass (5\u202f%). Omitted: shear (0.2\u202f%)."));
  BOOST_TEST(contains(caption, "Permitted change 1\u202f%, obtained 0.2\u202f%."));
}

BOOST_AUTO_TEST_CASE(page_of_scenes_only_shows_their_effects) {
  Results results;
  results.effect_scenes = kScenes;
  const Workspace folder;
  const std::string page = read_text_file(write_report(results, folder.path() / "out"));
  BOOST_TEST(contains(page, "Automatic selection of effects"));
  BOOST_TEST(contains(page, "figures/effects-obtained.svg"));
  BOOST_TEST(contains(page, "2 of 3 scenes stay within"));
  const Results again = trammel::results::read_results(to_json(results));
  BOOST_TEST_REQUIRE(again.effect_scenes.size() == 3U);
  BOOST_TEST(again.effect_scenes[1].deciding_s == 0.01);
  BOOST_TEST(again.effect_scenes[1].analysis == "modes");
}

BOOST_AUTO_TEST_SUITE_END()

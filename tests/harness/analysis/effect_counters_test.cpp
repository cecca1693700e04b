// ctest: timeout=300
#include <boost/test/unit_test.hpp>

#include "harness/analysis/analysis.h"
#include "harness/analysis/case_effects.h"
#include "harness/input/catalogue.h"
#include "harness/input/reference_library.h"

BOOST_AUTO_TEST_SUITE(effect_counters)

using namespace trammel::references;
using namespace trammel::solver;
using namespace trammel::harness;

namespace {

/// Returns the case reduced to the first point of its path, or to the first two points of a motion.
/// An effect that is evaluated at any point of the path is also evaluated at these points.
Document reduce_to_one_point(Document document) {
  const std::string file = document.origin("").file;
  const JsonPointer circle("/model/trajectory/circle");
  if (document.value().contains(circle)) {
    const int points = analysis_kind(document) == "elastodynamics" ? 2 : 1;
    document.apply_patch(file, "",
                         Json{{"model", {{"trajectory", {{"circle", {{"points", points}}}}}}}});
  }
  return document;
}

void check_effect_counters(const Document& document, const References& references) {
  const AnalysisResult result = analyze(document, references, {false});
  BOOST_TEST(result.effects.size() == kEffectCount);
  for (const Effect effect : Effects::all().list()) {
    if (result.effects[static_cast<std::size_t>(effect)].active) continue;
    BOOST_TEST(result.counters.evaluations(effect) == 0, name_of(effect));
  }
}

}  // namespace

/// Tests that the number of evaluations of each inactive mechanical effect is 0. Each variant of
/// each case that supports effects runs with the effects of its case file, and with the required
/// effects only.
BOOST_AUTO_TEST_CASE(inactive_effects_are_never_evaluated) {
  const References references;
  std::size_t runs = 0;
  for (const Case& given : Catalogue().load()) {
    if (!supports_effects(given.document)) continue;
    for (const std::string& variant : given.variants()) {
      const Document document = reduce_to_one_point(patched(given, variant));
      if (!supports_effects(document)) continue;
      // Long motions with all effects active are skipped: they take minutes and have no inactive
      // effect.
      const std::string kind = analysis_kind(document);
      const bool moves = kind == "transient" || kind == "harmonic" || kind == "large-motion";
      if (moves && !document.value().contains("effects")) continue;
      BOOST_TEST_CONTEXT(given.id() << ":" << variant) {
        check_effect_counters(document, references);
        const EffectScope scope = effect_scope(document, read_case_model(document));
        check_effect_counters(apply_effects(document, scope.required), references);
        ++runs;
      }
    }
  }
  BOOST_TEST_MESSAGE(runs << " runs, each with its own effects and with the required effects only");
  BOOST_TEST(runs > 100);
}

BOOST_AUTO_TEST_SUITE_END()

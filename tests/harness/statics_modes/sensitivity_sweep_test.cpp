// ctest: labels=slow timeout=900
#include <boost/test/unit_test.hpp>
#include <iostream>

#include "tests/support/harness/sensitivity_comparison.h"

BOOST_AUTO_TEST_SUITE(sensitivity_sweep)

using namespace trammel::solver;

namespace {

/// Printed whatever the log level: the figure is what the sweep is for.
void tell(const char* what, const Comparison& c) {
  std::cout << what << ": worst error " << c.worst << " of the mode's largest |df/dL| over "
            << c.compared << " poses, " << c.repeated << " of them with repeated frequencies\n";
}

ManipulatorDesign design_with(bool total_mass) {
  ManipulatorDesign design = coarse_design();
  for (std::size_t i = 0; i < 3 && total_mass; ++i) {
    design.proximal[i].mass = design.distal[i].mass = 0.0234;
  }
  return design;
}

}  // namespace

// Modes 1 to 6, the worst error over the largest |df/dL| of the mode.
BOOST_AUTO_TEST_CASE(five_hundred_poses_agree_with_differences) {
  for (const bool total : {false, true}) {
    const Comparison c = compare(design_with(total), all(Kind::length), 500, 5e-3, 35);
    tell(total ? "all links, mass held" : "all links, density held", c);
    BOOST_TEST(c.compared == 500);
    BOOST_TEST(c.worst < 1e-8);
  }
}

BOOST_AUTO_TEST_CASE(five_hundred_poses_agree_where_every_other_repeats_its_frequencies) {
  const Comparison c = compare(design_with(false), one_length(0, false), 500, 5e-3, 36, 2);
  tell("one link, density held", c);
  BOOST_TEST(c.compared == 500);
  BOOST_TEST(c.repeated >= 250);
  BOOST_TEST(c.worst < 1e-8);
}

BOOST_AUTO_TEST_SUITE_END()

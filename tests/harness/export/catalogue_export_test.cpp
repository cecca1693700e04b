// ctest: labels=slow timeout=3600
#include <boost/test/unit_test.hpp>
#include <iostream>
#include <map>

#include "harness/export/exported_case.h"
#include "harness/input/catalogue.h"
#include "tests/support/harness/export_twin.h"

BOOST_AUTO_TEST_SUITE(catalogue_export)

/// Exports every case of the catalogue with its variants and the levels of its sweeps, and computes
/// the exported cases.
using namespace trammel;
using namespace trammel::harness;
using namespace trammel::testing;

BOOST_AUTO_TEST_CASE(exported_catalogue_has_the_same_numbers) {
  std::map<std::string, int> refused;
  int same = 0, close = 0;
  for (const auto& file : Catalogue().runnable_files()) {
    const Case given = load_case(file);
    for (const std::string& variant : given.variants())
      for (const ExportChoice& choice : exportable_choices(given, variant)) {
        const ExportTwin twin = export_and_compute_both(given, choice);
        if (!twin.refused.empty()) {
          ++refused[twin.refused];
          continue;
        }
        ++(twin.difference == 0 ? same : close);
        if (twin.difference > 0)
          std::cout << twin.name << " " << twin.difference << " " << twin.worst << std::endl;
        BOOST_TEST(twin.difference <= 1e-12, twin.name << ": " << twin.worst);
      }
  }
  std::cout << same << " the same, " << close << " close\n";
  for (const auto& [reason, count] : refused) std::cout << count << " refused: " << reason << '\n';
}

BOOST_AUTO_TEST_SUITE_END()

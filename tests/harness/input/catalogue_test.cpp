#include "harness/input/catalogue.h"

#include <boost/test/unit_test.hpp>

#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(catalogue)

using namespace trammel;
using namespace trammel::testing;

BOOST_AUTO_TEST_CASE(equal_case_names_in_two_folders_are_refused) {
  const testing::Folder folder;
  const auto first = folder.write("beams/cantilever.json", "{}");
  BOOST_TEST(input_error_message([&] { (void)Catalogue(folder.path()); }).empty());
  const auto second = folder.write("hard/cantilever.json", "{}");
  BOOST_TEST(input_error_message([&] { (void)Catalogue(folder.path()); }) ==
             second.string() + ": /id: expected a unique case name (the same name is in " +
                 first.string() + ")");
}

BOOST_AUTO_TEST_CASE(case_is_found_in_any_catalogue_folder) {
  const testing::Folder folder;
  const auto run = folder.write("a/b/runs.json", R"({"extends": "base"})");
  (void)folder.write("c/base.json", R"({"analysis": {}})");
  (void)folder.write("c/only-extended.json", "{}");
  const Catalogue catalogue(folder.path());
  BOOST_TEST(catalogue.find_case("runs") == run);
  BOOST_TEST(catalogue.runnable_files().size() == 2);
  BOOST_TEST(testing::contains(input_error_message([&] { (void)catalogue.find_case("rnus"); }),
                               "did you mean 'runs'?"));
}

BOOST_AUTO_TEST_SUITE_END()

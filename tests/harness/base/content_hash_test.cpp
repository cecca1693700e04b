#include <boost/test/unit_test.hpp>

#include "harness/base/environment.h"

BOOST_AUTO_TEST_SUITE(content_hash)

namespace harness = trammel::harness;

BOOST_AUTO_TEST_CASE(different_texts_have_different_hashes) {
  BOOST_TEST(harness::content_hash("a") == harness::content_hash("a"));
  BOOST_TEST(harness::content_hash("a") != harness::content_hash("b"));
  BOOST_TEST(harness::file_hash("/nowhere/at/all").empty());
}

BOOST_AUTO_TEST_CASE(program_hash_identifies_the_program_file) {
  const auto file = boost::unit_test::framework::master_test_suite().argv[0];
  BOOST_TEST(harness::program_hash() == harness::file_hash(file));
  BOOST_TEST(harness::program_hash() != harness::content_hash(""));
}

BOOST_AUTO_TEST_SUITE_END()

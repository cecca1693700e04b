#include <boost/test/unit_test.hpp>

#include "harness/base/environment.h"

BOOST_AUTO_TEST_SUITE(content_hash)

namespace harness = trammel::harness;

BOOST_AUTO_TEST_CASE(different_texts_have_different_hashes) {
  BOOST_TEST(harness::content_hash("a") == harness::content_hash("a"));
  BOOST_TEST(harness::content_hash("a") != harness::content_hash("b"));
  BOOST_TEST(harness::file_hash("/nowhere/at/all").empty());
}

BOOST_AUTO_TEST_CASE(program_hash_is_its_build_id) {
  BOOST_TEST(harness::program_hash().size() == harness::content_hash("").size());
  BOOST_TEST(harness::program_hash() == harness::program_hash());
  BOOST_TEST(harness::program_hash() != harness::content_hash(""));
  BOOST_TEST(harness::program_hash() != harness::file_hash("/proc/self/exe"));
}

BOOST_AUTO_TEST_SUITE_END()

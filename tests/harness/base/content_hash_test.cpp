#include "harness/base/content_hash.h"

#include <boost/test/unit_test.hpp>

using namespace trammel::harness;

BOOST_AUTO_TEST_SUITE(content_hash_of)

BOOST_AUTO_TEST_CASE(texts_that_differ_have_hashes_that_differ) {
  BOOST_TEST(content_hash("a") == content_hash("a"));
  BOOST_TEST(content_hash("a") != content_hash("b"));
  BOOST_TEST(file_hash("/nowhere/at/all").empty());
}

BOOST_AUTO_TEST_CASE(the_program_is_named_by_its_build_id_without_being_read) {
  BOOST_TEST(program_hash().size() == content_hash("").size());
  BOOST_TEST(program_hash() == program_hash());
  BOOST_TEST(program_hash() != content_hash(""));
  BOOST_TEST(program_hash() != file_hash("/proc/self/exe"));
}

BOOST_AUTO_TEST_SUITE_END()

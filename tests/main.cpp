#define BOOST_TEST_MODULE trammel
#include <boost/test/unit_test.hpp>

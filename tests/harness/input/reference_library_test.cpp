#include "harness/input/reference_library.h"

#include <boost/test/unit_test.hpp>

#include "harness/base/errors.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(reference_library)

using namespace trammel;
using namespace trammel::testing;

namespace {

Json reference() {
  return {{"title", "T"},
          {"values", {2}},
          {"unit", "Hz"},
          {"uncertainty", {{"relative", 0.5}}},
          {"place", "here"}};
}

/// Returns the error message for the reference "x" in a reference file with the given text.
std::string fault(const std::string& text) {
  const Folder folder;
  const std::string file = folder.write("references.json", text).string();
  const std::string message = input_error_message([&] { (void)References().add(file + "#/x"); });
  BOOST_TEST(message.rfind(file + ":", 0) == 0U, message);
  return message.substr(std::min(message.size(), file.size()));
}

std::string fault(const Json& common, const Json& entry) {
  return fault(Json{{"common", common}, {"x", entry}}.dump());
}

}  // namespace

BOOST_AUTO_TEST_CASE(reference_inherits_common_keys_of_its_family) {
  const Folder folder;
  const Json common = {{"kind", "paper"}, {"source", "me"}, {"unit", "m"}};
  const auto file =
      folder.write("references.json", Json{{"common", common}, {"x", reference()}}.dump());
  const References library;
  const auto& read = library.add(file.string() + "#/x");
  BOOST_TEST(read.id == "x");
  BOOST_TEST(read.source == "me");
  BOOST_TEST(read.unit == "Hz");
  BOOST_TEST(read.uncertainty.at(0) == 1);
}

BOOST_AUTO_TEST_CASE(invalid_family_file_is_refused_with_its_pointer) {
  const Json common = {{"kind", "paper"}, {"source", "me"}};
  const auto changed = [&](const char* key, const Json& value) {
    Json entry = reference();
    entry[key] = value;
    return fault(common, entry);
  };
  BOOST_TEST(contains(changed("values", {1, "2"}), ": /x/values/1: expected"));
  BOOST_TEST(contains(changed("color", "red"), ": /x/color: "));
  BOOST_TEST(contains(changed("unit", "furlong"), ": /x/unit: expected"));
  BOOST_TEST(contains(changed("uncertainty", {{"relative", -1}}), ": /x/uncertainty/relative"));
  BOOST_TEST(contains(changed("derivation", {{"program", "p"}}), ": /x/derivation: expected"));
  Json entry = reference();
  entry.erase("values");
  BOOST_TEST(contains(fault(common, entry), ": /x: expected"));
  BOOST_TEST(contains(fault({{"kind", "paper"}}, reference()), ": /x: expected the key 'source'"));
  BOOST_TEST(contains(fault({{"kind", "rumor"}}, reference()), ": /common/kind: expected"));
  BOOST_TEST(contains(fault(R"({"x": {"values": [NaN]}})"), ": line 1, column"));
  BOOST_TEST(contains(fault(R"({"x": {"values": [1e999]}})"), ": /x/values/0: expected"));
  BOOST_TEST(contains(fault(R"({"x": {}, "y": {}, "x": {}})"), ": /x: expected every key once"));
  BOOST_TEST(contains(fault(R"({"x": {"unit": "m", "unit": "m"}})"), ": /x/unit: expected every"));
  BOOST_TEST(contains(fault("{\"y\": {}}"), ": /x: the file has no"));
  BOOST_TEST(contains(fault("[]"), ": /: expected an object"));
}

BOOST_AUTO_TEST_CASE(hash_covers_reference_and_common_keys_of_its_family) {
  const Folder folder;
  const auto hash = [&](const Json& family) {
    const auto file = folder.write("references.json", family.dump());
    return References().hash(file.string() + "#/x");
  };
  const std::string first = hash({{"common", {{"unit", "m"}}}, {"x", {{"values", {1}}}}});
  BOOST_TEST(!first.empty());
  BOOST_TEST(hash({{"common", {{"unit", "m"}}}, {"x", {{"values", {1}}}}, {"y", 1}}) == first);
  BOOST_TEST(hash({{"common", {{"unit", "s"}}}, {"x", {{"values", {1}}}}}) != first);
  BOOST_TEST(hash({{"common", {{"unit", "m"}}}, {"x", {{"values", {2}}}}}) != first);
  BOOST_TEST(hash({{"y", 1}}).empty());
}

BOOST_AUTO_TEST_SUITE_END()

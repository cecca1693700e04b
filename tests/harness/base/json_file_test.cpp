#include "harness/base/json_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <boost/test/unit_test.hpp>

#include "harness/base/errors.h"
#include "harness/base/text.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(json_file)

using namespace trammel;
using namespace trammel::testing;

namespace {

std::string fault(const std::string& text) {
  return input_error_message([&] { (void)parse_json(text, "x.json"); });
}

}  // namespace

BOOST_AUTO_TEST_CASE(invalid_json_is_refused_with_line_and_column) {
  BOOST_TEST(fault(R"({"a": nan})").rfind("x.json: line 1, column 8: expected JSON", 0) == 0);
  BOOST_TEST(fault(R"({"a": NaN})").rfind("x.json: line 1, column 7: expected JSON", 0) == 0);
  BOOST_TEST(fault(R"({"a": 1)").rfind("x.json: line 1, column 8: expected JSON", 0) == 0);
  BOOST_TEST(fault("{\"\xe9\": 1}").find(": expected JSON in UTF-8 (got ") != std::string::npos);
  BOOST_TEST(fault("").rfind("x.json: line 1, column 1: expected JSON", 0) == 0);
  BOOST_TEST(fault("{} {}").rfind("x.json: line 1, column 4: expected JSON", 0) == 0);
  BOOST_TEST(fault("{\n  \"a\": 1,\n  \"b\": }\n").rfind("x.json: line 3, column 8: ", 0) == 0);
}

BOOST_AUTO_TEST_CASE(duplicate_key_is_refused_with_its_pointer) {
  BOOST_TEST(fault(R"({"a": {"b": [0, {"c": 1, "c": 2}]}})") ==
             "x.json: /a/b/1/c: expected every key once (got 'c' twice)");
  BOOST_TEST(fault(R"({"a": {"c": 1}, "b": {"c": 2}})").empty());
}

BOOST_AUTO_TEST_CASE(number_beyond_the_range_of_double_is_refused) {
  BOOST_TEST(fault(R"({"a": [1, 1e999]})") ==
             "x.json: /a/1: expected a number within the range of a double (got '1e999')");
}

BOOST_AUTO_TEST_CASE(number_that_underflows_to_zero_is_refused) {
  for (const std::string number : {"1e-400", "-1e-400", "0.001e-330", "2E-324", "1.0e-9999"}) {
    BOOST_TEST(fault(R"({"a": [1, )" + number + "]}") ==
               "x.json: /a/1: expected 0 or a number that is not rounded to 0 as a double (got '" +
                   number + "')");
  }
  for (const std::string number : {"0", "0.0", "-0.0", "0e-400", "5e-324", "1e-300"})
    BOOST_TEST(fault(R"({"a": [1, )" + number + "]}").empty());
}

BOOST_AUTO_TEST_CASE(deep_nesting_is_refused_without_stack_overflow) {
  BOOST_TEST(testing::contains(fault(std::string(1000000, '[')), "levels of nesting"));
}

BOOST_AUTO_TEST_CASE(missing_file_and_folder_are_not_readable) {
  const testing::Folder folder;
  for (const auto& path : {folder.path(), folder.path() / "none.json"}) {
    BOOST_TEST(input_error_message([&] { (void)read_json(path); }) ==
               path.string() + ": expected a readable file");
  }
}

BOOST_AUTO_TEST_CASE(written_json_reads_back_bit_identical) {
  const Json json = {{"a", {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, -0.0}},
                     {"b", {{"c", "line\nbreak"}, {"d", nullptr}}}};
  BOOST_TEST((parse_json(format_json(json), "x.json") == json));
}

BOOST_AUTO_TEST_CASE(text_after_a_null_character_is_refused) {
  const std::string text("{}\0 and more", 12);
  BOOST_CHECK_EXCEPTION((void)parse_json(text, "a.json"), InputError, [](const InputError& error) {
    return testing::contains(error.what(), "a.json: expected no null character (got '\\u0000'");
  });
}

BOOST_AUTO_TEST_CASE(file_is_written_completely_or_not_at_all) {
  const testing::Folder folder;
  write_file(folder.path() / "a.json", "[1]");
  BOOST_TEST((read_json(folder.path() / "a.json") == Json::array({1})));
  BOOST_TEST(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
  BOOST_CHECK_THROW(write_file(folder.path() / "none" / "a.json", "[1]"), InputError);
}

BOOST_AUTO_TEST_CASE(failed_write_leaves_no_file_and_symlink_is_replaced) {
  const testing::Folder folder;
  std::filesystem::create_directories(folder.path() / "here/in-the-way");
  BOOST_CHECK_THROW(write_file(folder.path() / "here", "[1]"), InputError);
  BOOST_TEST(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
  (void)folder.write("elsewhere", "kept");
  std::filesystem::create_symlink("elsewhere", folder.path() / "link");
  write_file(folder.path() / "link", "[1]");
  BOOST_TEST(read_text(folder.path() / "elsewhere") == "kept");
}

BOOST_AUTO_TEST_CASE(pipe_is_written_to_and_not_replaced) {
  const testing::Folder folder;
  const auto pipe = folder.path() / "pipe";
  BOOST_REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  // A named pipe that is opened for reading and writing does not wait for another process.
  const int end = open(pipe.c_str(), O_RDWR | O_NONBLOCK);
  std::filesystem::create_symlink("pipe", folder.path() / "link");
  write_file(pipe, "[1]");
  write_file(folder.path() / "link", "[2]");
  std::array<char, 6> text{};
  BOOST_TEST(read(end, text.data(), text.size()) == 6);
  BOOST_TEST(std::string(text.data(), text.size()) == "[1][2]");
  BOOST_TEST(std::filesystem::is_fifo(pipe));
  BOOST_TEST(std::filesystem::is_symlink(folder.path() / "link"));
  close(end);
}

BOOST_AUTO_TEST_CASE(link_to_an_open_file_is_written_through) {
  const testing::Folder folder;
  const auto file = folder.path() / "file", link = folder.path() / "link";
  const int end = open(file.c_str(), O_RDWR | O_CREAT, 0600);
  std::filesystem::create_symlink("/proc/self/fd/" + std::to_string(end), link);
  write_file(link, "[1]");
  BOOST_TEST(std::filesystem::is_symlink(link));
  BOOST_TEST(read_text(file) == "[1]");
  close(end);
}

BOOST_AUTO_TEST_CASE(message_with_control_characters_is_one_line) {
  BOOST_TEST(one_line("a.json: /b\n\x1b[2J: x") == "a.json: /b\\u000a\\u001b[2J: x");
  const std::string cut = one_line("a.json: /" + std::string(5000, 'k') + ": x");
  BOOST_TEST(cut.size() < 200U);
  BOOST_TEST(cut.ends_with("... x"), cut);
}

BOOST_AUTO_TEST_CASE(endless_and_too_large_files_are_refused) {
  BOOST_TEST(input_error_message([] { (void)read_json("/dev/zero"); }) ==
             "/dev/zero: expected a readable file");
  const testing::Folder folder;
  const auto large = folder.write("large.json", "{}");
  std::filesystem::resize_file(large, (std::uintmax_t{1} << 28) + 1);  // sparse file
  BOOST_TEST(
      testing::contains(input_error_message([&] { (void)read_json(large); }), "up to 256 MiB"));
}

BOOST_AUTO_TEST_SUITE_END()

// Tests the wrapper ./trammel with stubs of cmake and of the program.
#include <sys/wait.h>
#include <unistd.h>

#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

BOOST_AUTO_TEST_SUITE(wrapper)

namespace fs = std::filesystem;

namespace {

std::string read_text_file(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void write_script(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << "#!/bin/sh\n" << text;
  fs::permissions(file, fs::perms::owner_all);
}

/// Checkout with the wrapper and a stub of cmake. The stub is slow, and records simultaneous calls.
class Checkout {
 public:
  Checkout() {
    fs::remove_all(root_);
    fs::create_directories(root_ / "source");
    fs::copy_file(TRAMMEL_SOURCE_DIR "/trammel", root_ / "source/trammel");
    write_script(root_ / "source/.ci/install", "exit 0\n");
    write_script(root_ / "bin/cmake", R"(
for word in "$@"; do case $before in -B | --build) folder=$word ;; esac; before=$word; done
[ ! -e "$folder/broken" ] || { echo "a new fault"; exit 1; }
mkdir "$folder/busy" || echo overlap >>"$folder/faults"
sleep 0.3
touch "$folder/build.ninja" "$folder/CMakeCache.txt"
mkdir -p "$folder/harness"
printf '#!/bin/sh\necho program "$@"\n' >"$folder/harness/trammel.part"
chmod +x "$folder/harness/trammel.part"
mv "$folder/harness/trammel.part" "$folder/harness/trammel"
rmdir "$folder/busy"
)");
  }
  ~Checkout() {
    std::error_code ignored;
    fs::remove_all(root_, ignored);
  }
  Checkout(const Checkout&) = delete;
  Checkout& operator=(const Checkout&) = delete;

  /// Runs a shell command next to the checkout in `source`. @returns its output
  [[nodiscard]] std::string run(const std::string& command) const {
    const std::string line = "cd '" + root_.string() + "' && export PATH=\"$PWD/bin:$PATH\" && (" +
                             command + ") >said.txt 2>&1 </dev/null";
    status_ = WEXITSTATUS(std::system(line.c_str()));
    return read_text_file(root_ / "said.txt");
  }
  [[nodiscard]] const fs::path& root() const { return root_; }
  [[nodiscard]] int status() const { return status_; }

 private:
  fs::path root_ = fs::temp_directory_path() / ("trammel-wrapper-" + std::to_string(getpid()));
  mutable int status_ = 0;
};

bool contains_text(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_CASE(simultaneous_calls_build_one_after_the_other) {
  const Checkout checkout;
  const std::string said = checkout.run(
      "source/trammel list & a=$!; source/trammel describe & b=$!; wait $a && wait $b");
  BOOST_TEST(checkout.status() == 0);
  BOOST_TEST(contains_text(said, "program list"), said);
  BOOST_TEST(contains_text(said, "program describe"), said);
  BOOST_TEST(contains_text(said, "waiting for another call"), said);
  BOOST_TEST(!fs::exists(checkout.root() / "source/build/release/faults"));
}

BOOST_AUTO_TEST_CASE(other_build_folder_leaves_the_checkout_unchanged) {
  const Checkout checkout;
  const std::string said = checkout.run(
      "mkdir away; ln -s ../source/trammel away/trammel; cd away; "
      "CDPATH=/usr TRAMMEL_BUILD=build ./trammel list");
  BOOST_TEST(contains_text(said, "program list"), said);
  BOOST_TEST(!fs::exists(checkout.root() / "source/build"));
}

BOOST_AUTO_TEST_CASE(log_of_a_former_call_is_discarded) {
  const Checkout checkout;
  (void)checkout.run("source/trammel list");
  const fs::path build = checkout.root() / "source/build/release";
  std::ofstream(build / "wrapper.log") << "an old fault\n";
  (void)checkout.run("script -qec 'source/trammel list' /dev/null");  // a terminal has no log
  BOOST_TEST(!contains_text(read_text_file(build / "wrapper.log"), "an old fault"));
  std::ofstream(build / "wrapper.log") << "an old fault\n";
  std::ofstream(build / "broken") << '\n';
  const std::string said = checkout.run("source/trammel list");
  BOOST_TEST(checkout.status() == 3);
  BOOST_TEST(contains_text(said, "a new fault"), said);
  BOOST_TEST(!contains_text(said, "an old fault"), said);
}

BOOST_AUTO_TEST_CASE(impossible_build_folder_is_refused_in_one_line) {
  const Checkout checkout;
  const std::string said = checkout.run("TRAMMEL_BUILD=/dev/null/x source/trammel list");
  BOOST_TEST(checkout.status() == 3);
  BOOST_TEST(said == "trammel: expected a writable folder: /dev/null/x\n");
  BOOST_TEST(checkout.run("TRAMMEL_BUILD=source/trammel source/trammel list") ==
             "trammel: expected a writable folder: source/trammel\n");
}

BOOST_AUTO_TEST_SUITE_END()

#include "tests/support/harness/interruption.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <boost/test/unit_test.hpp>
#include <chrono>
#include <csignal>
#include <random>
#include <set>
#include <thread>

#include "harness/base/json_file.h"
#include "tests/support/harness/support.h"

namespace trammel::testing {
namespace {

namespace fs = std::filesystem;

pid_t start(const fs::path& file, const fs::path& out) {
  const std::string program = trammel_program();
  const pid_t child = fork();
  if (child != 0) return child;
  const int null = open("/dev/null", O_RDWR);
  for (const int stream : {0, 1, 2}) dup2(null, stream);
  execl(program.c_str(), "trammel", "run", file.c_str(), "--jobs", "2", "--resume", "--out",
        out.c_str(), nullptr);
  _exit(127);
}

/// Returns the exit status as a shell does: 128 plus the signal if a signal ended the process.
int exit_status(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

/// Returns the files of the folder store that contain computed results, without those that contain
/// judged results.
std::set<fs::path> stored(const fs::path& out) {
  std::set<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(out / "store", error))
    if (entry.path().extension() == ".cbor" && entry.path().stem().extension() != ".judged")
      files.insert(entry.path());
  return files;
}

/// Returns the results without times and date.
std::string results(const fs::path& out) {
  Json json = read_json(out / "results.json");
  json["environment"].erase("date");
  json["environment"].erase("stored_runs");
  for (Json& run : json["runs"]) run["cost"] = run["cost"]["counters"];
  return json.dump();
}

}  // namespace

void interrupt_and_resume(int kills, unsigned seed) {
  constexpr int kVariants = 12;
  const Folder folder;
  Json json = cantilever();
  json["model"]["elements"] = 150;
  json["analysis"] = {{"modes", {{"count", 4}}}};
  for (int i = 1; i < kVariants; ++i)
    json["variants"]["v" + std::to_string(i)]["model"]["nodes"]["B"] = {1 + 0.1 * i, 0};
  const fs::path file = folder.write(json), whole = folder.path() / "whole",
                 out = folder.path() / "out";
  const auto begin = std::chrono::steady_clock::now();
  BOOST_REQUIRE(exit_status(start(file, whole)) == 0);
  const std::chrono::duration<double> takes = std::chrono::steady_clock::now() - begin;
  std::mt19937 random(seed);
  std::set<fs::path> before;
  for (int i = 0; i < kills; ++i) {
    const int signal = std::array{SIGKILL, SIGINT, SIGTERM}[static_cast<std::size_t>(i % 3)];
    const pid_t child = start(file, out);
    std::this_thread::sleep_for(takes * (static_cast<double>(random()) / 4294967296.0));
    kill(child, signal);
    const int status = exit_status(child);
    BOOST_TEST((status == 0 || status == 128 + signal), "kill " << i << ": " << status);
    const std::set<fs::path> after = stored(out);
    BOOST_TEST(std::includes(after.begin(), after.end(), before.begin(), before.end()));
    before = after;
    if (fs::exists(out / "results.json")) (void)results(out);
    if (after.size() < kVariants) continue;
    BOOST_TEST(exit_status(start(file, out)) == 0);
    BOOST_TEST(results(out) == results(whole));
    fs::remove_all(out);
    before.clear();
  }
  BOOST_TEST(exit_status(start(file, out)) == 0);
  BOOST_TEST(stored(out).size() == kVariants);
  BOOST_TEST(results(out) == results(whole));
}

}  // namespace trammel::testing

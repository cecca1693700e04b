// ctest: labels=program timeout=300
#include "tests/support/harness/interruption.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <boost/test/unit_test.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <thread>

#include "harness/base/json_file.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(interruption)

using namespace trammel;
using namespace trammel::testing;

BOOST_AUTO_TEST_CASE(ten_killed_calls_lose_and_duplicate_no_result) {
  testing::interrupt_and_resume(10, 1);
}

BOOST_AUTO_TEST_CASE(killed_computation_affects_its_own_run_only) {
  const Folder folder;
  const auto files =
      std::array{folder.write(testing::endless()), folder.write(testing::cantilever())};
  const auto out = folder.path() / "out";
  const std::string trammel = testing::trammel_program();
  const pid_t program = fork();
  if (program == 0) {
    const auto log = folder.path() / "log";
    if (std::freopen(log.c_str(), "w", stderr) == nullptr) _exit(126);
    if (std::freopen("/dev/null", "w", stdout) == nullptr) _exit(126);
    execl(trammel.c_str(), "trammel", "run", files[0].c_str(), files[1].c_str(), "--jobs", "1",
          "--out", out.c_str(), nullptr);
    _exit(127);
  }
  const std::string id = std::to_string(program);
  pid_t child = 0;
  for (int i = 0; i < 3000 && child == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::ifstream("/proc/" + id + "/task/" + id + "/children") >> child;
  }
  BOOST_REQUIRE(child > 0);
  // A child that has used 0.2 s of processor time is computing its run.
  for (int i = 0, ticks = 0; i < 3000 && ticks < 20; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::string line;
    std::getline(std::ifstream("/proc/" + std::to_string(child) + "/stat"), line);
    (void)std::sscanf(line.c_str(), "%*d %*s %*c %*d%*d%*d%*d%*d%*u%*u%*u%*u%*u %d", &ticks);
  }
  kill(child, SIGILL);  // sanitizers do not handle this signal
  int status = 0;
  waitpid(program, &status, 0);
  BOOST_TEST(WEXITSTATUS(status) == 3);
  const Json runs = read_json(out / "results.json")["runs"];
  BOOST_TEST(runs[0]["status"] == "error");
  BOOST_TEST(contains(runs[0]["reason"].get<std::string>(), "crashed (signal 4"));
  BOOST_TEST(runs[1]["status"] == "solved");
}

BOOST_AUTO_TEST_CASE(interrupted_command_explains_how_to_continue) {
  const Folder folder;
  Json json = testing::cantilever();
  json["sweeps"]["elements"] = {{"pointers", {"/model/elements"}},
                                {"values", {1, 2, 4}},
                                {"quantities", {{"displacement_y_m:B", {{"index", {0}}}}}}};
  (void)folder.write(json);
  const auto gnuplot = folder.write("gnuplot", "#!/bin/sh\n: >drawing\nexec sleep 20\n");
  std::filesystem::permissions(gnuplot, std::filesystem::perms::all);
  const auto status_of = [&](const std::string& words, const std::string& until) {
    const std::string line = "cd " + folder.path().string() + "; PATH=$PWD:$PATH; " +
                             testing::trammel_program() + " " + words + " >out.txt 2>err.txt & " +
                             until + "; kill -TERM $!; wait $!";
    return WEXITSTATUS(std::system(line.c_str()));
  };
  const auto error_text = [&] { return read_text(folder.path() / "err.txt"); };
  BOOST_TEST(status_of("report cantilever.json", "until test -e drawing; do sleep 0.1; done") ==
             143);
  BOOST_TEST(error_text() == "trammel: interrupted; the same command computes the rest\n");
  BOOST_TEST(status_of("cost cantilever.json --repeats 10000", "sleep 1") == 143);
  BOOST_TEST(contains(error_text(), "with --resume"));
  BOOST_TEST(status_of("effects scene-soft-platform --repeats 1000", "sleep 1") == 143);
  BOOST_TEST(error_text() == "trammel: interrupted; the same command starts from the beginning\n");
}

BOOST_AUTO_TEST_SUITE_END()

#include "harness/base/processes.h"

#include <sys/resource.h>
#include <unistd.h>

#include <boost/test/unit_test.hpp>
#include <csignal>
#include <fstream>
#include <map>
#include <stdexcept>

BOOST_AUTO_TEST_SUITE(processes)

using namespace trammel::harness;
using Termination = ProcessOutcome::Termination;

namespace {

/// Ends the process by a signal, without the signal handler of the test framework.
std::string end_by(int signal) {
  std::signal(signal, SIG_DFL);
  std::raise(signal);
  return {};
}

std::string loop() {
  for (volatile bool on = true; on;) {
  }
  return {};
}

std::map<std::size_t, ProcessOutcome> run_all(const std::vector<ProcessTask>& tasks,
                                              const ProcessOptions& options) {
  std::map<std::size_t, ProcessOutcome> outcomes;
  const int signal =
      run_in_worker_processes(tasks, options, [&](std::size_t task, const ProcessOutcome& outcome) {
        BOOST_TEST(outcomes.emplace(task, outcome).second);
      });
  BOOST_TEST(signal == 0);
  return outcomes;
}

}  // namespace

BOOST_AUTO_TEST_CASE(failed_process_does_not_affect_the_others) {
  const std::string large(1 << 20, 'x');
  const std::vector<ProcessTask> tasks = {{[&] { return large; }, 10},
                                          {[] { return end_by(SIGSEGV); }, 10},
                                          {loop, 1},
                                          {[]() -> std::string { throw std::bad_alloc(); }, 10},
                                          {[] { return end_by(SIGKILL); }, 10},
                                          {[]() -> std::string {
                                             std::signal(SIGABRT, SIG_DFL);
                                             throw std::runtime_error("uncaught");
                                           },
                                           10},
                                          {[] { return std::string("last"); }, 10}};
  const std::vector<Termination> expected = {Termination::answered,      Termination::crashed,
                                             Termination::timed_out,     Termination::out_of_memory,
                                             Termination::out_of_memory, Termination::crashed,
                                             Termination::answered};
  for (const unsigned at_once : {1U, 3U, 100U}) {
    auto outcomes = run_all(tasks, {at_once, 0});
    BOOST_REQUIRE(outcomes.size() == tasks.size());
    for (std::size_t i = 0; i < tasks.size(); ++i)
      BOOST_TEST((outcomes[i].termination == expected[i]), i << ": " << outcomes[i].text);
    BOOST_TEST((outcomes[0].text == large));
    BOOST_TEST(outcomes[6].text == "last");
  }
}

BOOST_AUTO_TEST_CASE(failed_fork_affects_its_own_task_only) {
  rlimit before{};
  getrlimit(RLIMIT_NOFILE, &before);
  const int descriptor = dup(0);  // lowest free: for signals; the next two: for a pipe
  close(descriptor);
  const auto lowest = static_cast<rlim_t>(descriptor);
  const rlimit one_pipe{lowest + 3, before.rlim_max}, no_pipe{lowest + 2, before.rlim_max};
  const auto read = [] {  // a child does not inherit the descriptors of other tasks
    return std::string(std::ifstream("/dev/null").is_open() ? "done" : "no file");
  };
  const std::vector<ProcessTask> tasks(5, {read, 10});
  setrlimit(RLIMIT_NOFILE, &one_pipe);
  const auto one = run_all(tasks, {5, 0});
  setrlimit(RLIMIT_NOFILE, &no_pipe);
  const auto none = run_all(tasks, {5, 0});
  setrlimit(RLIMIT_NOFILE, &before);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    BOOST_TEST(one.at(i).text == "done");
    BOOST_TEST((none.at(i).termination == Termination::not_started));
  }
}

BOOST_AUTO_TEST_CASE(signal_stops_running_and_waiting_tasks) {
  for (const int asked : {SIGINT, SIGTERM}) {
    std::size_t answered = 0;
    const ProcessTask stop{[] { return std::string(); }, 10};
    const int signal = run_in_worker_processes({{loop, 20}, stop, {loop, 20}, {loop, 20}}, {2, 0},
                                               [&](std::size_t, const ProcessOutcome&) {
                                                 ++answered;
                                                 std::raise(asked);
                                               });
    BOOST_TEST(signal == asked);
    BOOST_TEST(answered == 1);
  }
}

BOOST_AUTO_TEST_CASE(process_has_memory_limit_and_waiting_calls_callback) {
  int waited = 0;
  const auto outcomes =
      run_all({{[] { return std::to_string(memory_limit_bytes()); }, 10}, {loop, 2}},
              {2, std::size_t{1} << 30, [&] { ++waited; }});
  BOOST_TEST(outcomes.at(0).text == "1073741824");
  BOOST_TEST(waited >= 1);
  BOOST_TEST(memory_limit_bytes() != std::size_t{1} << 30);
}

BOOST_AUTO_TEST_SUITE_END()

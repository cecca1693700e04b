#include "harness/base/processes.h"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <iostream>
#include <new>
#include <stdexcept>

namespace trammel::harness {
namespace {

using Termination = ProcessOutcome::Termination;

constexpr int kOutOfMemory = 12;  // the exit status of a process that could not allocate
/// Wall time beyond which a process that uses none of its processor time counts as hung.
constexpr unsigned kHangTimeoutFactor = 20;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kLimitsMemory = false;  // sanitizers reserve terabytes of addresses
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kLimitsMemory = false;
#else
constexpr bool kLimitsMemory = true;
#endif
#else
constexpr bool kLimitsMemory = true;
#endif

int status_without_memory = 0;
const char* line_without_memory = "";
std::terminate_handler otherwise = nullptr;
/// What terminates where nothing may be thrown (a directory iterator) holds no exception.
std::atomic<bool> found_no_memory{false};

[[noreturn]] void end_by_exception() {
  try {
    if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
    if (found_no_memory) throw std::bad_alloc();
  } catch (const std::bad_alloc&) {
    std::fputs(line_without_memory, stderr);
    _exit(status_without_memory);
  } catch (...) {  // told by what terminates
  }
  otherwise();
  std::abort();
}

std::size_t allowed_bytes = 0;  ///< to this process by the one that forked it; 0: nothing is said

struct Child {
  pid_t process = -1;
  int answer = -1;  ///< read end of its pipe
  std::size_t task = 0;
  unsigned cpu_limit_s = 0;
  std::string text;
};

/// What the child does. Signals that ask the program to stop are the parent's; with it, the child
/// ends.
[[noreturn]] void compute(const ProcessTask& task, std::size_t memory_bytes, pid_t parent,
                          int out) noexcept {
  end_without_memory(kOutOfMemory, "");
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
  const rlimit cpu{task.cpu_limit_s, task.cpu_limit_s + 1};
  setrlimit(RLIMIT_CPU, &cpu);
  alarm(kHangTimeoutFactor * task.cpu_limit_s);
  const rlimit memory{memory_bytes, memory_bytes};
  if (kLimitsMemory && memory_bytes > 0) setrlimit(RLIMIT_AS, &memory);
  allowed_bytes = memory_bytes;
  std::string text;
  try {
    text = task.work();
  } catch (const std::bad_alloc&) {
    _exit(kOutOfMemory);
  }
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t n = write(out, text.data() + written, text.size() - written);
    if (n <= 0) _exit(1);
    written += static_cast<std::size_t>(n);
  }
  _exit(0);
}

/// Awaits the end of a child that has closed its pipe.
ProcessOutcome outcome_of(Child& child) {
  int status = 0;
  rusage used{};
  while (wait4(child.process, &status, 0, &used) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
    return {Termination::answered, std::move(child.text)};
  if (WIFEXITED(status) && WEXITSTATUS(status) == kOutOfMemory)
    return {Termination::out_of_memory, "more memory than there is"};
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (signal == SIGXCPU || signal == SIGALRM ||
      (signal == SIGKILL && cpu_time_s(used) >= child.cpu_limit_s))
    return {Termination::timed_out,
            "not done after " + std::to_string(child.cpu_limit_s) + " s of processor time"};
  if (signal == SIGKILL)
    return {Termination::out_of_memory, "killed from outside, as where memory runs short"};
  if (signal == 0)
    return {Termination::crashed,
            "the computation ended with status " + std::to_string(WEXITSTATUS(status))};
  return {Termination::crashed, "the computation crashed (signal " + std::to_string(signal) + ", " +
                                    strsignal(signal) + ")"};
}

/// The processes under way. As long as it lives, SIGINT and SIGTERM are read here instead of ending
/// the program.
class ProcessPool {
 public:
  ProcessPool() {
    sigset_t asked;
    sigemptyset(&asked);
    sigaddset(&asked, SIGINT);
    sigaddset(&asked, SIGTERM);
    signals_ = signalfd(-1, &asked, SFD_CLOEXEC);
    if (signals_ < 0) throw std::runtime_error("no descriptor for signals");
    sigprocmask(SIG_BLOCK, &asked, &before_);
  }
  ~ProcessPool() {
    for (const Child& child : children_) {
      kill(child.process, SIGKILL);
      close(child.answer);
      waitpid(child.process, nullptr, 0);
    }
    close(signals_);
    sigprocmask(SIG_SETMASK, &before_, nullptr);
  }
  ProcessPool(const ProcessPool&) = delete;
  ProcessPool& operator=(const ProcessPool&) = delete;

  [[nodiscard]] std::size_t size() const { return children_.size(); }

  /// @returns whether the system has room for another process; errno says why not
  bool start(std::size_t number, const ProcessTask& task, std::size_t memory_bytes) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) return false;
    std::cout.flush();
    std::fflush(nullptr);
    const pid_t parent = getpid(), child = fork();
    if (child == 0) {  // which needs what descriptors there are
      for (const Child& other : children_) close(other.answer);
      for (const int unused : {ends[0], signals_}) close(unused);
      compute(task, memory_bytes, parent, ends[1]);
    }
    const int error = errno;
    close(ends[1]);
    if (child < 0) close(ends[0]);
    errno = error;
    if (child > 0) children_.push_back({child, ends[0], number, task.cpu_limit_s, {}});
    return child > 0;
  }

  /// Takes in what there is of answers. @returns the signal where one came, else 0
  int wait(const std::function<void(std::size_t, const ProcessOutcome&)>& ended,
           const std::function<void()>& waiting) {
    std::vector<pollfd> ready = {{signals_, POLLIN, 0}};
    for (const Child& child : children_) ready.push_back({child.answer, POLLIN, 0});
    constexpr int a_second = 1000;
    const int found = poll(ready.data(), ready.size(), a_second);
    if (found == 0 && waiting) waiting();
    if (found <= 0) return 0;
    if (signalfd_siginfo came{}; ready[0].revents != 0)
      return read(signals_, &came, sizeof came) > 0 ? static_cast<int>(came.ssi_signo) : 0;
    for (std::size_t i = children_.size(); i-- > 0;) {
      if (ready[i + 1].revents == 0 || is_under_way(children_[i])) continue;
      Child child = std::move(children_[i]);
      children_.erase(children_.begin() + static_cast<std::ptrdiff_t>(i));
      close(child.answer);
      ended(child.task, outcome_of(child));
    }
    return 0;
  }

 private:
  static bool is_under_way(Child& child) {
    std::array<char, 65536> buffer;  // as it comes: zeros would cost more than most answers
    const ssize_t n = read(child.answer, buffer.data(), buffer.size());
    if (n > 0) child.text.append(buffer.data(), static_cast<std::size_t>(n));
    return n > 0 || (n < 0 && errno == EINTR);
  }

  std::vector<Child> children_;
  sigset_t before_{};
  int signals_ = -1;
};

/// Said by a signal's handler, which may only write and end.
std::array<char, 200> last_line{};

extern "C" void say_and_end(int signal) {
  if (write(STDERR_FILENO, last_line.data(), std::strlen(last_line.data())) >= 0) {
  }
  _exit(128 + signal);
}

}  // namespace

void end_without_memory(int status, const char* line) {
  status_without_memory = status;
  line_without_memory = line;
  if (otherwise == nullptr) otherwise = std::set_terminate(end_by_exception);
  std::set_new_handler([] {
    found_no_memory = true;
    throw std::bad_alloc();
  });
}

void end_on_signals(const std::string& line) {
  last_line.fill(0);
  line.copy(last_line.data(), last_line.size() - 1);
  for (const int signal : {SIGINT, SIGTERM})
    if (std::signal(signal, say_and_end) == SIG_IGN) std::signal(signal, SIG_IGN);
}

std::size_t memory_limit_bytes() {
  static const std::size_t least = [] {
    auto bytes = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) *
                 static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    if (rlimit set{}; getrlimit(RLIMIT_AS, &set) == 0)
      bytes = std::min<std::size_t>(bytes, set.rlim_cur);
    for (const char* file :
         {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"})
      if (std::size_t allowed = 0; std::ifstream(file) >> allowed) bytes = std::min(bytes, allowed);
    return bytes;
  }();
  return allowed_bytes > 0 ? allowed_bytes : least / 2;
}

int run_in_processes(const std::vector<ProcessTask>& tasks, const ProcessOptions& options,
                     const std::function<void(std::size_t, const ProcessOutcome&)>& ended) {
  ProcessPool pool;
  std::size_t next = 0;
  while (next < tasks.size() || pool.size() > 0) {
    bool room = true;
    while (room && next < tasks.size() && pool.size() < std::max(1U, options.at_once)) {
      room = pool.start(next, tasks[next], options.memory_bytes);
      if (!room && pool.size() > 0) break;
      if (!room) ended(next, {Termination::not_started, std::strerror(errno)});
      ++next;
    }
    if (pool.size() == 0) continue;
    if (const int signal = pool.wait(ended, options.waiting); signal != 0) return signal;
  }
  return 0;
}

double cpu_time_s(const rusage& used) {
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

}  // namespace trammel::harness

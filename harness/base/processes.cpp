#include "harness/base/processes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/syscall.h>
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
#include <ctime>
#include <exception>
#include <fstream>
#include <iostream>
#include <new>
#include <span>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "harness/base/errors.h"
#include "harness/base/stopwatch.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;
using Termination = ProcessOutcome::Termination;
using Ended = std::function<void(std::size_t, const ProcessOutcome&)>;

constexpr int kOutOfMemory = 12;  // exit status of a process that could not allocate memory
/// A process is stopped as hung if its wall time exceeds this factor times its limit of processor
/// time.
constexpr unsigned kHangTimeoutFactor = 20;

#ifndef __has_feature
#define __has_feature(feature) 0
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || \
    __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool kLimitsMemory = false;  // sanitizers reserve terabytes of address space
#else
constexpr bool kLimitsMemory = true;
#endif

int status_without_memory = 0;
const char* line_without_memory = "";
std::terminate_handler otherwise = nullptr;
/// True after an allocation failure. If the failure occurs in a noexcept function, such as a
/// directory iterator, the program terminates without a current exception.
std::atomic<bool> found_no_memory{false};

[[noreturn]] void end_by_exception() {
  try {
    if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
    if (found_no_memory) throw std::bad_alloc();
  } catch (const std::bad_alloc&) {
    std::fputs(line_without_memory, stderr);
    _exit(status_without_memory);
  } catch (...) {  // the terminate handler `otherwise` reports all other errors
  }
  otherwise();
  std::abort();
}

std::size_t allowed_bytes = 0;  ///< memory limit set by the parent process; 0: none

void limit(__rlimit_resource resource, std::size_t most) {
  const rlimit both{most, most};
  setrlimit(resource, &both);
}

/// Replaces this process by an external program, which inherits only working folder and output.
[[noreturn]] void become(const std::vector<char*>& words, const std::string& folder,
                         const ProgramLimits& limits, int out) noexcept {
  setsid();
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int signal : {SIGXFSZ, SIGPIPE, SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
  limit(RLIMIT_FSIZE, limits.disk_bytes);
  limit(RLIMIT_CORE, 0);
  dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
  dup2(out, STDOUT_FILENO);
  dup2(out, STDERR_FILENO);
  close_range(STDERR_FILENO + 1, ~0U, 0);
  setenv("TMPDIR", folder.c_str(), 1);
  const bool there = chdir(folder.c_str()) == 0;
  // The memory limit is set last, because this process may already exceed it, for example under a
  // sanitizer.
  if (limits.memory_bytes > 0) limit(RLIMIT_AS, limits.memory_bytes);
  if (there) execv(words.front(), words.data());
  dprintf(STDERR_FILENO, "not started: %s\n", std::strerror(errno));
  _exit(127);
}

/// Id of the process that runs each task, in memory shared with the workers; 0: the task has not
/// started; -1: the task has ended.
using Owners = std::span<std::atomic<pid_t>>;

/// Assigns the first task that has not started to this process.
/// @returns the index of the task; the number of tasks if all tasks have started
std::size_t claim_next_task(Owners owners) {
  for (std::size_t task = 0; task < owners.size(); ++task)
    if (pid_t nobody = 0; owners[task].compare_exchange_strong(nobody, getpid())) return task;
  return owners.size();
}

/// Header of an answer that a worker writes into its pipe. The text of the answer follows.
struct Answer {
  std::size_t task = 0, bytes = 0;
  double wall_s = 0, cpu_s = 0;
};

struct Child {
  pid_t process = -1;
  int output = -1;                             ///< read end of the pipe from the child
  std::size_t kept_bytes = std::string::npos;  ///< maximum length of `text`; its end is kept
  std::string text = {};
  Stopwatch watch = {};
};

/// Forks a child process that is killed when this process ends.
/// @param run  function that the child calls with the write end of the pipe; the function does not
///   return
/// @returns the child. If the fork failed, `process` is -1 and errno contains the reason
Child fork_process(const std::function<void(int out)>& run) {
  Child child;
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return child;
  std::cout.flush();
  std::fflush(nullptr);
  const pid_t parent = getpid();
  child.process = fork();
  if (child.process == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);
    close(ends[0]);
    run(ends[1]);
  }
  const int error = errno;
  close(ends[1]);
  child.output = ends[0];
  if (child.process < 0) close(ends[0]);
  errno = error;
  return child;
}

/// Reads available output of a child process.
/// @returns true if more output may follow
bool drain(Child& child) {
  std::array<char, 65536> buffer;  // not initialized, because filling it with zeros is slow
  const ssize_t n = read(child.output, buffer.data(), buffer.size());
  if (n > 0) child.text.append(buffer.data(), static_cast<std::size_t>(n));
  if (child.text.size() > child.kept_bytes)
    child.text.erase(0, child.text.size() - child.kept_bytes);
  return n > 0 || (n < 0 && (errno == EINTR || errno == EAGAIN));
}

double timeval_in_seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

ProcessOutcome reap(const Child& child) {
  int status = 0;
  rusage used{};
  while (wait4(child.process, &status, 0, &used) < 0 && errno == EINTR) {
  }
  const bool signalled = WIFSIGNALED(status);
  return {signalled ? Termination::crashed : Termination::answered,
          {},
          signalled ? WTERMSIG(status) : WEXITSTATUS(status),
          child.watch.wall_s(),
          timeval_in_seconds(used.ru_utime) + timeval_in_seconds(used.ru_stime)};
}

void put(int out, const void* data, std::size_t bytes) {
  const auto* from = static_cast<const char*>(data);
  for (std::size_t written = 0; written < bytes;) {
    const ssize_t n = write(out, from + written, bytes - written);
    if (n <= 0) _exit(1);
    written += static_cast<std::size_t>(n);
  }
}

/// Runs tasks in this child process until all tasks have started or the process has used much
/// memory. The parent process handles signals that stop the program.
[[noreturn]] void work_on(const std::vector<ProcessTask>& tasks, Owners owners,
                          std::size_t memory_bytes, int out) noexcept {
  set_exit_on_out_of_memory(kOutOfMemory, "");
  // An allocation failure ends the process without an exception. An exception would leave
  // incomplete JSON values, whose destructor reads a null pointer.
  std::set_new_handler([] { _exit(kOutOfMemory); });
  if (kLimitsMemory && memory_bytes > 0) limit(RLIMIT_AS, memory_bytes);
  allowed_bytes = memory_bytes;
  for (std::size_t number = 0; (number = claim_next_task(owners)) < tasks.size();) {
    const Stopwatch watch;
    const auto used_s = static_cast<rlim_t>(std::clock() / CLOCKS_PER_SEC);
    const rlimit cpu{used_s + tasks[number].cpu_limit_s + 1, RLIM_INFINITY};
    setrlimit(RLIMIT_CPU, &cpu);
    alarm(kHangTimeoutFactor * tasks[number].cpu_limit_s);
    try {
      const std::string text = tasks[number].work();
      const Answer answer{number, text.size(), watch.wall_s(), watch.cpu_s()};
      put(out, &answer, sizeof answer);
      put(out, text.data(), text.size());
    } catch (const std::bad_alloc&) {
      _exit(kOutOfMemory);
    }
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    if (used.ru_maxrss > 500'000) break;  // [kB]; a new worker needs less memory
  }
  _exit(0);
}

/// Returns the outcome of a task whose worker ended without an answer, with the reason.
/// @param outcome  exit status or signal of the worker, and its computing times
ProcessOutcome explain_missing_answer(ProcessOutcome outcome, unsigned cpu_limit_s) {
  const int status = outcome.status;
  const auto because = [&](Termination termination, const std::string& reason) {
    outcome.termination = termination;
    outcome.text = reason;
    return outcome;
  };
  if (outcome.termination == Termination::answered && status == kOutOfMemory)
    return because(Termination::out_of_memory, "the available memory is exhausted");
  if (outcome.termination == Termination::answered)
    return because(Termination::crashed,
                   fmt::format("the computation ended with status {}", status));
  if (status == SIGXCPU || status == SIGALRM)
    return because(Termination::timed_out,
                   fmt::format("stopped after {} s of processor time", cpu_limit_s));
  if (status == SIGKILL)
    return because(Termination::out_of_memory,
                   "killed by another process, possibly because memory was exhausted");
  return because(Termination::crashed,
                 fmt::format("the computation crashed (signal {}, {})", status, strsignal(status)));
}

/// Waits until a program ends or exceeds a limit.
Termination await(Child& child, const fs::path& folder, const ProgramLimits& limits) {
  constexpr int tick_ms = 100;
  const auto handle = static_cast<int>(syscall(SYS_pidfd_open, child.process, 0));
  Termination termination = Termination::answered;
  double looked_s = 0;
  for (std::array<pollfd, 2> ready{{{handle, POLLIN, 0}, {child.output, POLLIN, 0}}};;) {
    poll(ready.data(), ready.size(), tick_ms);
    if (ready[1].fd >= 0 && ready[1].revents != 0 && !drain(child)) ready[1].fd = -1;
    if (handle < 0 || ready[0].revents != 0) break;
    const double now_s = child.watch.wall_s();
    const bool looks = now_s - looked_s >= 1e-3 * tick_ms;
    if (now_s > limits.wall_s) {
      termination = Termination::timed_out;
    } else if (looks && folder_size(folder, limits.disk_bytes) > limits.disk_bytes) {
      termination = Termination::disk_full;
    }
    if (termination != Termination::answered) break;
    if (looks) looked_s = now_s;
  }
  if (handle >= 0) close(handle);
  return termination;
}

/// Pool of running child processes. While the pool exists, SIGINT and SIGTERM do not end the
/// program. `wait` returns the number of a received signal.
class ProcessPool {
 public:
  ProcessPool() {
    sigset_t asked;
    sigemptyset(&asked);
    sigaddset(&asked, SIGINT);
    sigaddset(&asked, SIGTERM);
    signals_ = signalfd(-1, &asked, SFD_CLOEXEC);
    if (signals_ < 0) throw std::runtime_error("no file descriptor for signals");
    sigprocmask(SIG_BLOCK, &asked, &before_);
  }
  ~ProcessPool() {
    for (const Child& child : children_) {
      kill(child.process, SIGKILL);
      close(child.output);
      waitpid(child.process, nullptr, 0);
    }
    close(signals_);
    sigprocmask(SIG_SETMASK, &before_, nullptr);
  }
  ProcessPool(const ProcessPool&) = delete;
  ProcessPool& operator=(const ProcessPool&) = delete;

  [[nodiscard]] std::size_t size() const { return children_.size(); }

  /// Starts a worker. @returns false if the worker cannot be started; errno contains the reason
  bool start(const std::vector<ProcessTask>& tasks, Owners owners, std::size_t memory_bytes) {
    Child child = fork_process([&](int out) {  // the child closes unused descriptors
      for (const Child& other : children_) close(other.output);
      close(signals_);
      work_on(tasks, owners, memory_bytes, out);
    });
    if (child.process < 0) return false;
    children_.push_back(std::move(child));
    return true;
  }

  /// Waits up to one second for answers of the workers and reads them.
  /// @returns SIGINT or SIGTERM if the signal was received, else 0
  int wait(const std::vector<ProcessTask>& tasks, Owners owners, const Ended& ended,
           const std::function<void()>& waiting) {
    std::vector<pollfd> ready = {{signals_, POLLIN, 0}};
    for (const Child& child : children_) ready.push_back({child.output, POLLIN, 0});
    const int found = poll(ready.data(), ready.size(), 1000);  // timeout [ms]
    if (found == 0 && waiting) waiting();
    if (found <= 0) return 0;
    if (signalfd_siginfo came{}; ready[0].revents != 0)
      return read(signals_, &came, sizeof came) > 0 ? static_cast<int>(came.ssi_signo) : 0;
    for (std::size_t i = children_.size(); i-- > 0;) {
      if (ready[i + 1].revents == 0) continue;
      const bool goes_on = drain(children_[i]);
      while (take_answer(children_[i], ended)) continue;
      if (goes_on) continue;
      Child child = std::move(children_[i]);
      children_.erase(children_.begin() + static_cast<std::ptrdiff_t>(i));
      close(child.output);
      const ProcessOutcome outcome = reap(child);
      for (std::size_t task = 0; task < tasks.size(); ++task)
        if (owners[task] == child.process)
          ended(task, explain_missing_answer(outcome, tasks[task].cpu_limit_s));
    }
    return 0;
  }

 private:
  /// Removes the first complete answer from the output of a worker and calls `ended`.
  /// @returns false if the output contains no complete answer
  static bool take_answer(Child& child, const Ended& ended) {
    Answer head;
    std::string& text = child.text;
    if (text.size() < sizeof head) return false;
    std::memcpy(&head, text.data(), sizeof head);
    if (text.size() < sizeof head + head.bytes) return false;
    const std::string answer = text.substr(sizeof head, head.bytes);
    text.erase(0, sizeof head + head.bytes);
    ended(head.task, {Termination::answered, answer, 0, head.wall_s, head.cpu_s});
    return true;
  }

  std::vector<Child> children_;
  sigset_t before_{};
  int signals_ = -1;
};

/// Line that the signal handler prints. A signal handler may only write and exit.
std::array<char, 200> last_line{};

extern "C" void print_and_end(int signal) {
  (void)!write(STDERR_FILENO, last_line.data(), std::strlen(last_line.data()));
  _exit(128 + signal);
}

}  // namespace

void set_exit_on_out_of_memory(int status, const char* line) {
  status_without_memory = status;
  line_without_memory = line;
  if (otherwise == nullptr) otherwise = std::set_terminate(end_by_exception);
  std::set_new_handler([] {
    found_no_memory = true;
    throw std::bad_alloc();
  });
}

void exit_on_signals(const std::string& line) {
  last_line.fill(0);
  line.copy(last_line.data(), last_line.size() - 1);
  for (const int signal : {SIGINT, SIGTERM})
    if (std::signal(signal, print_and_end) == SIG_IGN) std::signal(signal, SIG_IGN);
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

int run_in_worker_processes(const std::vector<ProcessTask>& tasks, const ProcessOptions& options,
                            const std::function<void(std::size_t, const ProcessOutcome&)>& ended) {
  const std::size_t bytes = (tasks.size() + 1) * sizeof(std::atomic<pid_t>);
  void* shared = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) throw std::bad_alloc();
  const Owners owners(static_cast<std::atomic<pid_t>*>(shared), tasks.size());  // mmap sets 0
  const Ended end = [&](std::size_t task, const ProcessOutcome& outcome) {
    owners[task] = -1;
    ended(task, outcome);
  };
  const auto any_waits = [&] {
    return std::ranges::any_of(owners, [](const auto& owner) { return owner == 0; });
  };
  int signal = 0;
  ProcessPool pool;
  while (signal == 0 && (any_waits() || pool.size() > 0)) {
    while (any_waits() && pool.size() < std::max(1U, options.at_once))
      if (!pool.start(tasks, owners, options.memory_bytes)) {
        if (pool.size() > 0) break;
        end(claim_next_task(owners), {Termination::not_started, std::strerror(errno)});
      }
    if (pool.size() > 0) signal = pool.wait(tasks, owners, end, options.waiting);
  }
  munmap(shared, bytes);
  return signal;
}

ProcessOutcome run_limited(const ProcessTask& task, const ProcessOptions& options) {
  ProcessOutcome outcome;
  const auto ended = [&](std::size_t, const ProcessOutcome& found) { outcome = found; };
  if (const int signal = run_in_worker_processes({task}, options, ended); signal != 0)
    throw Interrupted(signal);
  return outcome;
}

void adopt_descendants() {
  prctl(PR_SET_CHILD_SUBREAPER, 1);
}

void kill_descendants() {
  const std::string children = "/proc/self/task/" + std::to_string(getpid()) + "/children";
  for (bool found = true; found;) {
    found = false;
    std::ifstream in(children);
    for (pid_t process = 0; in >> process; found = true) {
      kill(process, SIGKILL);
      waitpid(process, nullptr, 0);
    }
  }
}

std::size_t folder_size(const fs::path& folder, std::size_t stop_above) {
  constexpr std::size_t entry_bytes = 4096;  // size counted per entry, so that empty files count
  std::size_t sum = 0;
  std::error_code error;
  for (fs::recursive_directory_iterator
           entry(folder, fs::directory_options::skip_permission_denied, error),
       end;
       entry != end && !error && sum <= stop_above; entry.increment(error)) {
    std::error_code unknown;
    sum += entry_bytes;
    if (!entry->is_symlink(unknown) && entry->is_regular_file(unknown)) {
      const auto size = entry->file_size(unknown);
      if (!unknown) sum += size;
    }
  }
  return sum;
}

std::string find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const fs::path file = fs::path(folder) / name; access(file.c_str(), X_OK) == 0) return file;
  return "";
}

ProcessOutcome run_limited(const std::vector<std::string>& words, const fs::path& folder,
                           const ProgramLimits& limits) {
  adopt_descendants();
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  Child child = fork_process([&](int out) { become(arguments, folder.string(), limits, out); });
  if (child.process < 0) return {Termination::not_started, {}, errno};
  child.kept_bytes = 65536;
  fcntl(child.output, F_SETFL, O_NONBLOCK);
  const Termination termination = await(child, folder, limits);
  if (termination != Termination::answered) kill(child.process, SIGKILL);
  ProcessOutcome outcome = reap(child);
  if (termination != Termination::answered) outcome.termination = termination;
  kill_descendants();
  errno = 0;
  while (drain(child) && errno == 0) {
  }
  close(child.output);
  outcome.text = std::move(child.text);
  return outcome;
}

}  // namespace trammel::harness

#include "harness/grade/limited_program.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "harness/base/processes.h"
#include "harness/base/stopwatch.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;
using Ending = ProgramOutcome::Ending;

constexpr std::size_t kMaxOutput = 65536;

void limit(__rlimit_resource resource, std::size_t most) {
  const rlimit both{most, most};
  setrlimit(resource, &both);
}

/// What the child does: nothing of this process but its folder and its output is left to it.
[[noreturn]] void become(const std::vector<char*>& words, const std::string& folder,
                         const ProgramLimits& limits, int out, pid_t parent) noexcept {
  setsid();
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
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
  // Last, since this process may itself hold more, as under a sanitizer.
  if (limits.memory_bytes > 0) limit(RLIMIT_AS, limits.memory_bytes);
  if (there) execv(words.front(), words.data());
  dprintf(STDERR_FILENO, "not started: %s\n", std::strerror(errno));
  _exit(127);
}

/// Takes in what there is, keeping the end. @returns whether more may come
bool drain(int from, std::string& output) {
  std::array<char, 65536> buffer{};
  const ssize_t n = read(from, buffer.data(), buffer.size());
  if (n > 0) output.append(buffer.data(), static_cast<std::size_t>(n));
  if (output.size() > kMaxOutput) output.erase(0, output.size() - kMaxOutput);
  return n > 0 || (n < 0 && errno == EAGAIN);
}

/// Waits until it ends or must be ended.
Ending await(pid_t child, int out, const fs::path& folder, const ProgramLimits& limits,
             const Stopwatch& watch, std::string& output) {
  constexpr int tick_ms = 100;
  const auto handle = static_cast<int>(syscall(SYS_pidfd_open, child, 0));
  Ending ending = Ending::exited;
  double looked_s = 0;
  for (std::array<pollfd, 2> ready{{{handle, POLLIN, 0}, {out, POLLIN, 0}}};;) {
    poll(ready.data(), ready.size(), tick_ms);
    if (ready[1].fd >= 0 && ready[1].revents != 0 && !drain(out, output)) ready[1].fd = -1;
    if (handle < 0 || ready[0].revents != 0) break;
    if (watch.wall_s() > limits.wall_s) {
      ending = Ending::timed_out;
      break;
    }
    if (watch.wall_s() - looked_s < 1e-3 * tick_ms) continue;
    looked_s = watch.wall_s();
    if (folder_bytes(folder, limits.disk_bytes) > limits.disk_bytes) {
      ending = Ending::disk_full;
      break;
    }
  }
  if (handle >= 0) close(handle);
  return ending;
}

pid_t parent_of(const fs::path& process) {
  std::string text;
  std::getline(std::ifstream(process / "stat"), text);
  const auto name_end = text.rfind(')');  // a name may hold anything
  int parent = 0;
  if (name_end != std::string::npos)
    (void)std::sscanf(text.c_str() + name_end + 1, " %*c %d", &parent);
  return parent;
}

}  // namespace

void adopt_descendants() {
  prctl(PR_SET_CHILD_SUBREAPER, 1);
}

void end_descendants() {
  for (bool found = true; found;) {
    found = false;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator("/proc", error)) {
      const int process = std::atoi(entry.path().filename().c_str());
      if (process <= 0 || parent_of(entry.path()) != getpid()) continue;
      found = true;
      kill(process, SIGKILL);
      waitpid(process, nullptr, 0);
    }
  }
}

std::size_t folder_bytes(const fs::path& folder, std::size_t enough) {
  constexpr std::size_t entry_bytes = 4096;  // a million empty files are too much, too
  std::size_t sum = 0;
  std::error_code error;
  for (fs::recursive_directory_iterator
           entry(folder, fs::directory_options::skip_permission_denied, error),
       end;
       entry != end && !error && sum <= enough; entry.increment(error)) {
    std::error_code unknown;
    sum += entry_bytes;
    if (!entry->is_symlink(unknown) && entry->is_regular_file(unknown)) {
      const auto size = entry->file_size(unknown);
      if (!unknown) sum += size;
    }
  }
  return sum;
}

ProgramOutcome run_limited(const std::vector<std::string>& words, const fs::path& folder,
                           const ProgramLimits& limits) {
  adopt_descendants();
  ProgramOutcome outcome;
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  std::array<int, 2> ends{};
  const pid_t parent = getpid();
  const bool piped = pipe2(ends.data(), O_CLOEXEC) == 0;
  const Stopwatch watch;
  const pid_t child = piped ? fork() : -1;
  if (child == 0) become(arguments, folder.string(), limits, ends[1], parent);
  outcome.status = errno;
  if (piped) close(ends[1]);
  if (child > 0) {
    fcntl(ends[0], F_SETFL, O_NONBLOCK);
    outcome.ending = await(child, ends[0], folder, limits, watch, outcome.output);
    int status = 0;
    rusage used{};
    if (outcome.ending != Ending::exited) kill(child, SIGKILL);
    while (wait4(child, &status, 0, &used) < 0 && errno == EINTR) {
    }
    outcome.wall_s = watch.wall_s();
    outcome.cpu_s = cpu_time_s(used);
    end_descendants();
    errno = 0;
    while (drain(ends[0], outcome.output) && errno == 0) {
    }
    if (outcome.ending == Ending::exited && WIFSIGNALED(status)) outcome.ending = Ending::signalled;
    outcome.status = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
  }
  if (piped) close(ends[0]);
  return outcome;
}

}  // namespace trammel::harness

// Library that is loaded before the C library (LD_PRELOAD). It makes one call fail after main() has
// begun. The environment variable TRAMMEL_FAULT is KIND:NUMBER.
//   memory:N   the N-th malloc fails.
//   disk:N     files accept only N bytes, as on a full disk.
//   read:S     signal S arrives when a case is read first.
//   compute:S  signal S arrives when the first run starts.
//   result:S   signal S arrives before the temporary file is renamed to results.json.
//   draw:S     signal S arrives when gnuplot is started.
//   clock:0    each value of the calendar clock is an hour earlier than the previous value.
//   count:0    prints the numbers of calls and bytes to standard error.
#include <dlfcn.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

namespace {

enum class Kind { none, memory, disk, read, compute, result, draw, clock, count };
Kind kind = Kind::none;  // no fault until main() begins
long number = 0;
pid_t program = 0;
std::atomic<long> allocations{0}, bytes{0};
int (*own_main)(int, char**, char**) = nullptr;

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

void send_signal_at_stage(Kind stage) {
  if (kind != stage || getpid() != program) return;
  kind = Kind::none;
  kill(program, static_cast<int>(number));
}

bool ends_with(const char* text, const char* end) {
  const std::size_t length = std::strlen(text), tail = std::strlen(end);
  return length >= tail && std::strcmp(text + length - tail, end) == 0;
}

/// @returns true if writing `size` more bytes exceeds the capacity of the simulated disk
bool is_full(int file, std::size_t size) {
  struct stat what {};
  if ((kind != Kind::disk && kind != Kind::count) || fstat(file, &what) != 0 ||
      !S_ISREG(what.st_mode))
    return false;
  const long all = bytes += static_cast<long>(size);
  if (kind == Kind::count || all <= number) return false;
  errno = ENOSPC;
  return true;
}

int main_with_faults(int argc, char** argv, char** environment) {
  const char* const fault = std::getenv("TRAMMEL_FAULT");
  const char* const names[] = {"none",   "memory", "disk",  "read", "compute",
                               "result", "draw",   "clock", "count"};
  program = getpid();
  if (fault != nullptr && std::strchr(fault, ':') != nullptr) {
    number = std::atol(std::strchr(fault, ':') + 1);
    for (int i = 1; i < 9; ++i)
      if (std::strncmp(fault, names[i], std::strlen(names[i])) == 0) kind = static_cast<Kind>(i);
  }
  return own_main(argc, argv, environment);
}

__attribute__((destructor)) void tell() {
  if (kind == Kind::count && getpid() == program)
    dprintf(2, "counted %ld calls, %ld bytes\n", allocations.load(), bytes.load());
}

}  // namespace

extern "C" {

// NOLINTBEGIN(bugprone-reserved-identifier): names of the C library
void* __libc_malloc(std::size_t size);

int __libc_start_main(int (*main)(int, char**, char**), int argc, char** argv, void (*init)(),
                      void (*fini)(), void (*rtld_fini)(), void* stack_end) {
  own_main = main;
  return next<decltype(&__libc_start_main)>("__libc_start_main")(main_with_faults, argc, argv, init,
                                                                 fini, rtld_fini, stack_end);
}
// NOLINTEND(bugprone-reserved-identifier)

void* malloc(std::size_t size) {
  if (kind == Kind::memory || kind == Kind::count) {
    if (++allocations == number && kind == Kind::memory) {
      errno = ENOMEM;
      return nullptr;
    }
  }
  return __libc_malloc(size);
}

ssize_t write(int file, const void* data, std::size_t size) {
  if (is_full(file, size)) return -1;
  return next<decltype(&write)>("write")(file, data, size);
}

ssize_t writev(int file, const iovec* parts, int count) {
  std::size_t size = 0;
  for (int i = 0; i < count; ++i) size += parts[i].iov_len;
  if (is_full(file, size)) return -1;
  return next<decltype(&writev)>("writev")(file, parts, count);
}

FILE* fopen64(const char* file, const char* mode) {
  if (ends_with(file, "/own.json")) send_signal_at_stage(Kind::read);
  return next<decltype(&fopen64)>("fopen64")(file, mode);
}

pid_t fork() {
  const pid_t child = next<decltype(&fork)>("fork")();
  if (child > 0) send_signal_at_stage(Kind::compute);
  return child;
}

int rename(const char* from, const char* to) {
  if (ends_with(to, "/results.json")) send_signal_at_stage(Kind::result);
  return next<decltype(&rename)>("rename")(from, to);
}

FILE* popen(const char* command, const char* mode) {
  send_signal_at_stage(Kind::draw);
  return next<decltype(&popen)>("popen")(command, mode);
}

int clock_gettime(clockid_t clock, timespec* time) {
  static std::atomic<long> hours{0};
  const int status = next<decltype(&clock_gettime)>("clock_gettime")(clock, time);
  if (kind == Kind::clock && clock == CLOCK_REALTIME) time->tv_sec -= 3600 * ++hours;
  return status;
}

}  // extern "C"

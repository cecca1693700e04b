#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <new>
#include <thread>

#include "harness/base/errors.h"
#include "harness/results/unfinished_folder.h"
#include "harness/run/stored_results.h"

namespace trammel::harness {
namespace {

/// Returns true if the text is "process NUMBER" and this process no longer exists.
bool is_gone(const std::string& holder) {
  const int process = std::atoi(holder.substr(holder.find(' ') + 1).c_str());
  return process > 0 && kill(process, 0) != 0 && errno == ESRCH;
}

}  // namespace

namespace fs = std::filesystem;

OutputLock::OutputLock(const fs::path& folder) : folder_(folder), file_(folder / ".trammel-lock") {
  std::error_code error;
  fs::create_directories(folder, error);
  acquire();
  fs::remove_all(folder_ / results::kUnfinishedFolder, error);  // removes files of a killed call
  const std::string holder = "process " + std::to_string(getpid());
  if (write(descriptor_, holder.data(), holder.size()) != static_cast<ssize_t>(holder.size()))
    throw InputError("--out " + folder_.string() + ": expected a writable folder");
}

OutputLock::~OutputLock() {
  try {
    std::error_code ignored;
    fs::remove(file_, ignored);
    fs::remove_all(folder_ / results::kUnfinishedFolder, ignored);
  } catch (const std::bad_alloc&) {  // the next call removes all remaining files
  }
  close(descriptor_);
}

void OutputLock::acquire() {
  int waits = 0;
  for (struct stat mine{}, there{};;) {
    descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor_ < 0)
      throw InputError("--out " + folder_.string() + ": expected a writable folder");
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      close(descriptor_);
      std::string holder;
      std::getline(std::ifstream(file_), holder);
      // The process that acquired the lock no longer exists. The lock is released when its child
      // processes end.
      if (is_gone(holder) && ++waits < 100) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        continue;
      }
      throw InputError("--out " + folder_.string() +
                       ": another call of trammel writes to this folder (" +
                       (holder.empty() ? "process unknown" : holder) + ")");
    }
    if (fstat(descriptor_, &mine) == 0 && !S_ISREG(mine.st_mode)) {
      close(descriptor_);
      throw InputError("--out " + folder_.string() + ": .trammel-lock is not a regular file");
    }
    // The previous owner of the lock may have removed the file after this process opened it.
    if (fstat(descriptor_, &mine) == 0 && lstat(file_.c_str(), &there) == 0 &&
        mine.st_ino == there.st_ino && ftruncate(descriptor_, 0) == 0)
      return;
    close(descriptor_);
  }
}

}  // namespace trammel::harness

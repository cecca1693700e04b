#include "reports/text/files.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "harness/base/rows.h"

namespace trammel::reports {

namespace fs = std::filesystem;

std::string read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  if (!in) throw std::system_error(EIO, std::generic_category(), path.string() + ": not readable");
  return out.str();
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  static std::atomic<unsigned> count{0};
  fs::path part = path;
  part += ".part-" + std::to_string(getpid()) + "-" + std::to_string(count++);
  std::ofstream out(part, std::ios::binary);
  out << text;
  out.close();
  std::error_code error, ignored;
  if (out) fs::rename(part, path, error);
  if (out && !error) return;
  fs::remove(part, ignored);
  throw std::system_error(EIO, std::generic_category(), path.string() + ": cannot be written");
}

void replace_files(const fs::path& from, const fs::path& to, const std::string& last_moved,
                   const std::vector<fs::path>& obsolete) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(from))
    if (!entry.is_directory()) files.push_back(entry.path().lexically_relative(from));
  std::ranges::sort(files, [&](const fs::path& a, const fs::path& b) {
    return std::pair(a == last_moved, a) < std::pair(b == last_moved, b);
  });
  for (const fs::path& file : files) {
    const fs::path path = to / file, folder = path.parent_path();
    if (fs::is_directory(fs::symlink_status(path)))
      throw std::system_error(EISDIR, std::generic_category(),
                              path.string() + ": expected a file, but it is a folder");
    if (fs::is_regular_file(fs::symlink_status(folder)))
      throw std::system_error(ENOTDIR, std::generic_category(),
                              folder.string() + ": expected a folder, but it is a file");
  }
  sigset_t ending, before;
  sigemptyset(&ending);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ending, signal);
  pthread_sigmask(SIG_BLOCK, &ending, &before);
  for (const fs::path& file : files) {
    const fs::path folder = (to / file).parent_path();
    if (file.has_parent_path() && !fs::is_directory(fs::symlink_status(folder))) fs::remove(folder);
    fs::create_directories(folder);
    fs::rename(from / file, to / file);
  }
  std::error_code ignored;
  for (const fs::path& file : obsolete)
    if (std::ranges::find(files, file) == files.end()) fs::remove(to / file, ignored);
  fs::remove_all(from);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

std::string to_csv(const Table& table) {
  std::vector<harness::Column> columns;
  for (const std::string& head : table.heads) columns.emplace_back(head.c_str());
  harness::Rows rows(std::move(columns));
  for (const auto& row : table.rows) rows.add(row);
  return rows.csv(table.digits);
}

}  // namespace trammel::reports

#include <dirent.h>
#include <sys/stat.h>

#include <cstdio>

#include "references/data/family.h"

namespace trammel::references {
namespace {

constexpr std::string_view kEnding = ".json";

/// @param see  is given a folder and the name of each JSON file in it.
template <typename See>
void walk(const std::string& folder, const See& see) {
  const std::unique_ptr<DIR, int (*)(DIR*)> open(opendir(folder.c_str()), closedir);
  if (!open) return;
  while (const dirent* entry = readdir(open.get())) {
    const std::string_view name = entry->d_name;
    if (name == "." || name == "..") continue;
    if (name.size() > kEnding.size() && name.ends_with(kEnding)) {
      see(folder, name);
    } else if (entry->d_type == DT_DIR || entry->d_type == DT_UNKNOWN) {
      walk(folder + "/" + entry->d_name, see);
    }
  }
}

}  // namespace

std::vector<std::pair<std::string, std::string>> json_files(const std::string& folder) {
  std::vector<std::pair<std::string, std::string>> files;
  walk(folder, [&](const std::string& in, std::string_view name) {
    files.emplace_back(name.substr(0, name.size() - kEnding.size()), "");
    std::string& file = files.back().second;
    file.reserve(in.size() + name.size() + 1);
    file.append(in).append(1, '/').append(name);
  });
  return files;
}

FileText read_file(const std::string& file) {
  FileText read;
  struct stat status {};
  if (stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return read;
  const std::unique_ptr<FILE, int (*)(FILE*)> in(std::fopen(file.c_str(), "rb"), std::fclose);
  if (!in) return read;
  const auto size = static_cast<std::size_t>(status.st_size);
  read.bytes = std::make_unique_for_overwrite<char[]>(size);
  read.text = {read.bytes.get(), std::fread(read.bytes.get(), 1, size, in.get())};
  return read;
}

}  // namespace trammel::references

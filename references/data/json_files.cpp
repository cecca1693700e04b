#include "references/data/json_files.h"

#include <dirent.h>
#include <unistd.h>

#include <memory>
#include <string_view>

namespace trammel::references {
namespace {

constexpr std::string_view kEnding = ".json";

/// @param see  is given a folder and the name of each JSON file in it.
template <typename See>
void walk(const std::string& folder, std::vector<std::string>& folders, const See& see) {
  const std::unique_ptr<DIR, int (*)(DIR*)> open(opendir(folder.c_str()), closedir);
  if (!open) return;
  folders.push_back(folder);
  while (const dirent* entry = readdir(open.get())) {
    const std::string_view name = entry->d_name;
    if (name == "." || name == "..") continue;
    if (name.size() > kEnding.size() && name.ends_with(kEnding)) {
      see(folder, name);
    } else if (entry->d_type == DT_DIR || entry->d_type == DT_UNKNOWN) {
      walk(folder + "/" + entry->d_name, folders, see);
    }
  }
}

}  // namespace

std::vector<std::pair<std::string, std::string>> json_files(const std::string& folder) {
  std::vector<std::pair<std::string, std::string>> files;
  std::vector<std::string> folders;
  walk(folder, folders, [&](const std::string& in, std::string_view name) {
    files.emplace_back(name.substr(0, name.size() - kEnding.size()), "");
    std::string& file = files.back().second;
    file.reserve(in.size() + name.size() + 1);
    file.append(in).append(1, '/').append(name);
  });
  return files;
}

std::vector<std::string> folders(const std::string& folder) {
  std::vector<std::string> found;
  walk(folder, found, [](const std::string&, std::string_view) {});
  return found;
}

std::string find_json_file(const std::vector<std::string>& folders, const std::string& name) {
  for (const std::string& folder : folders) {
    std::string file = folder + "/" + name + std::string(kEnding);
    if (access(file.c_str(), F_OK) == 0) return file;
  }
  return {};
}

}  // namespace trammel::references

#include "references/data/json_files.h"

#include <dirent.h>

#include <memory>
#include <string_view>

namespace trammel::references {
namespace {

constexpr std::string_view kEnding = ".json";

void walk(const std::string& folder, std::vector<std::pair<std::string, std::string>>& files) {
  const std::unique_ptr<DIR, int (*)(DIR*)> open(opendir(folder.c_str()), closedir);
  if (!open) return;
  while (const dirent* entry = readdir(open.get())) {
    std::string name = entry->d_name;
    if (name == "." || name == "..") continue;
    std::string file = folder + "/" + name;
    if (name.size() > kEnding.size() && name.ends_with(kEnding)) {
      name.resize(name.size() - kEnding.size());
      files.emplace_back(std::move(name), std::move(file));
    } else if (entry->d_type == DT_DIR || entry->d_type == DT_UNKNOWN) {
      walk(file, files);
    }
  }
}

}  // namespace

std::vector<std::pair<std::string, std::string>> json_files(const std::string& folder) {
  std::vector<std::pair<std::string, std::string>> files;
  walk(folder, files);
  return files;
}

}  // namespace trammel::references

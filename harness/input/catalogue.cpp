#include "harness/input/catalogue.h"

#include <algorithm>
#include <set>

#include "harness/base/environment.h"
#include "harness/base/find_or_add.h"
#include "harness/base/json_file.h"
#include "harness/base/text.h"
#include "references/data/family.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kOtherRooms[] = {"/schema/", "/cost/", "/claims/"};

/// Returns true if a file below the catalogue's folder is in a subfolder without cases.
bool is_outside_case_folders(std::string_view path_below) {
  return std::ranges::any_of(kOtherRooms,
                             [&](std::string_view room) { return path_below.starts_with(room); });
}

/// Returns true if a text can be the name of a case, and is not a path.
bool is_name(const std::string& text) {
  return text.find('/') == std::string::npos && !text.empty() && text.front() != '.';
}

}  // namespace

Catalogue::Catalogue() {
  static const Catalogue installed_catalogue(data_root() / "cases");
  files_ = installed_catalogue.files_;
}

Catalogue::Catalogue(const fs::path& folder) : files_(references::json_files(folder.string())) {
  const std::size_t above = folder.string().size();
  std::erase_if(files_, [&](const auto& item) {
    return is_outside_case_folders(std::string_view(item.second).substr(above));
  });
  std::ranges::sort(files_);
  const auto twice = std::ranges::adjacent_find(
      files_, [](const auto& a, const auto& b) { return a.first == b.first; });
  if (twice == files_.end()) return;
  throw InputError(twice[1].second, "/id",
                   "expected a unique case name (the same name is in " + twice->second + ")");
}

bool Catalogue::has_analysis(const fs::path& file, int depth) const {
  const Json json = read_json(file);
  if (!json.is_object()) return true;  // load_case reports the malformed file
  if (json.contains("analysis")) return true;
  if (!json.contains("extends") || !json["extends"].is_string() || depth > 20) return false;
  return has_analysis(find_base_case(json["extends"].get<std::string>(), file), depth + 1);
}

fs::path Catalogue::file_of_name(const std::string& name) const {
  if (!is_name(name)) return {};
  const fs::path wanted(name);
  const std::string id = (wanted.extension() == ".json" ? wanted.stem() : wanted).string();
  const auto found = std::ranges::lower_bound(files_, std::pair(id, std::string()));
  return found == files_.end() || found->first != id ? fs::path() : fs::path(found->second);
}

std::vector<std::string> Catalogue::names() const {
  std::vector<std::string> names;
  for (const auto& item : files_) names.push_back(item.first);
  return names;
}

std::vector<fs::path> Catalogue::runnable_files() const {
  std::vector<fs::path> files;
  for (const auto& item : files_)
    if (has_analysis(item.second)) files.push_back(item.second);
  return files;
}

fs::path Catalogue::find_case(const std::string& name_or_file) const {
  fs::path file(name_or_file);
  std::error_code error;
  const bool looks_like_file = !is_name(name_or_file) || file.extension() == ".json";
  if (looks_like_file && fs::exists(file, error)) return file;
  if (fs::path found = file_of_name(name_or_file); !found.empty()) return found;
  if (looks_like_file) throw InputError(name_or_file + ": expected a readable file (not found)");
  throw InputError(unknown_name_message("a case of the catalogue or a file that ends in .json",
                                        name_or_file, names()));
}

fs::path Catalogue::find_base_case(const std::string& name_or_file,
                                   const fs::path& extending_file) const {
  std::error_code error;
  fs::path file = extending_file.parent_path() / name_or_file;
  if (fs::is_regular_file(file, error)) return file;
  file += ".json";
  if (fs::is_regular_file(file, error)) return file;
  if (fs::path found = file_of_name(name_or_file); !found.empty()) return found;
  throw InputError(extending_file.string(), "/extends",
                   unknown_name_message("a catalogue case or a path relative to this file",
                                        name_or_file, names()));
}

std::vector<Case> Catalogue::load(const std::vector<std::string>& labels,
                                  const std::vector<std::string>& any_labels) const {
  std::vector<Case> chosen;
  std::set<std::string> known;
  for (const fs::path& file : runnable_files()) {
    Case loaded = load_case(file, *this);
    const std::vector<std::string> case_labels = loaded.labels();
    known.insert(case_labels.begin(), case_labels.end());
    const auto has = [&](const std::string& label) { return contains(case_labels, label); };
    if (std::ranges::all_of(labels, has) &&
        (any_labels.empty() || std::ranges::any_of(any_labels, has)))
      chosen.push_back(std::move(loaded));
  }
  for (const auto* given : {&labels, &any_labels})
    for (const std::string& label : *given)
      if (!known.contains(label))
        throw InputError(
            unknown_name_message("a label of the catalogue", label, {known.begin(), known.end()}));
  if (chosen.empty() && !known.empty())
    throw InputError(
        "no case of the catalogue has this combination of labels; expected labels "
        "of at least one common case");
  return chosen;
}

bool is_in_catalogue(const fs::path& file) {
  const fs::path folder = fs::weakly_canonical(data_root() / "cases");
  return std::ranges::mismatch(folder, fs::weakly_canonical(file)).in1 == folder.end();
}

Case load_named_case(const std::string& name_or_file) {
  const Catalogue catalogue;
  return load_case(catalogue.find_case(name_or_file), catalogue);
}

}  // namespace trammel::harness

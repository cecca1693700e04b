#include "harness/input/catalogue.h"

#include <algorithm>
#include <set>

#include "harness/base/data_root.h"
#include "harness/base/json_file.h"
#include "harness/base/text.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;

fs::path catalogue() {
  return data_root() / "cases";
}

/// Rooms that hold something else than cases.
bool holds_no_cases(const fs::path& folder) {
  const std::string name = folder.filename().string();
  return name == "schema" || name == "cost" || name == "claims";
}

/// All case files of all rooms, sorted by name.
std::vector<fs::path> all_files() {
  std::vector<fs::path> files;
  for (auto entry = fs::recursive_directory_iterator(catalogue());
       entry != fs::recursive_directory_iterator(); ++entry) {
    if (entry->is_directory() && holds_no_cases(entry->path())) entry.disable_recursion_pending();
    if (entry->path().extension() == ".json") files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end(),
            [](const fs::path& a, const fs::path& b) { return a.filename() < b.filename(); });
  return files;
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const fs::path& file : all_files()) names.push_back(file.stem().string());
  return names;
}

bool has_analysis(const fs::path& file, int depth = 0) {
  const Json json = read_json(file);
  if (!json.is_object()) return true;  // broken: for load_case to say
  if (json.contains("analysis")) return true;
  if (!json.contains("extends") || !json["extends"].is_string() || depth > 20) return false;
  return has_analysis(find_base_case(json["extends"].get<std::string>(), file), depth + 1);
}

/// Nothing a user types as a name may leave the catalogue's folder.
bool is_name(const std::string& text) {
  return text.find('/') == std::string::npos && !text.empty() && text.front() != '.';
}

fs::path by_name(const std::string& name) {
  if (!is_name(name)) return {};
  fs::path wanted(name);
  if (wanted.extension() != ".json") wanted += ".json";
  for (const fs::path& file : all_files()) {
    if (file.filename() == wanted) return file;
  }
  return {};
}

}  // namespace

std::vector<fs::path> catalogue_files() {
  std::vector<fs::path> files = all_files();
  files.erase(std::remove_if(files.begin(), files.end(),
                             [](const fs::path& file) { return !has_analysis(file); }),
              files.end());
  return files;
}

fs::path find_case(const std::string& name_or_file) {
  fs::path file(name_or_file);
  std::error_code error;
  const bool looks_like_file = !is_name(name_or_file) || file.extension() == ".json";
  if (looks_like_file && fs::exists(file, error)) return file;
  if (fs::path found = by_name(name_or_file); !found.empty()) return found;
  if (looks_like_file) throw InputError(name_or_file + ": expected a readable file");
  throw InputError("expected a case of the catalogue or a file (got '" + printable(name_or_file) +
                   "')" + did_you_mean(name_or_file, all_names()));
}

fs::path find_base_case(const std::string& name_or_file, const fs::path& from) {
  std::error_code error;
  fs::path beside = from.parent_path() / name_or_file;
  if (fs::is_regular_file(beside, error)) return beside;
  fs::path with_extension = beside;
  with_extension += ".json";
  if (fs::is_regular_file(with_extension, error)) return with_extension;
  if (fs::path found = by_name(name_or_file); !found.empty()) return found;
  throw InputError(from.string(), "/extends",
                   "expected a file relative to this one or a case of the catalogue (got '" +
                       printable(name_or_file) + "')" + did_you_mean(name_or_file, all_names()));
}

std::vector<Case> load_catalogue(const std::vector<std::string>& labels) {
  std::vector<Case> chosen;
  std::set<std::string> known;
  for (const fs::path& file : catalogue_files()) {
    Case loaded = load_case(file);
    const std::vector<std::string> case_labels = loaded.labels();
    known.insert(case_labels.begin(), case_labels.end());
    const bool wanted =
        labels.empty() || std::any_of(labels.begin(), labels.end(), [&](const std::string& label) {
          return std::find(case_labels.begin(), case_labels.end(), label) != case_labels.end();
        });
    if (wanted) chosen.push_back(std::move(loaded));
  }
  for (const std::string& label : labels) {
    if (known.count(label) > 0) continue;
    throw InputError("expected a label of the catalogue (got '" + printable(label) + "')" +
                     did_you_mean(label, {known.begin(), known.end()}));
  }
  return chosen;
}

}  // namespace trammel::harness

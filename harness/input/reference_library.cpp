#include "harness/input/reference_library.h"

#include "harness/base/environment.h"
#include "harness/base/json_file.h"
#include "harness/base/text.h"
#include "harness/input/document.h"
#include "references/data/json_files.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;

fs::path stored() {
  return data_root() / "references" / "values";
}

bool is_in_catalogue(const fs::path& folder) {
  const fs::path inside = fs::relative(folder, data_root() / "cases");
  return !inside.empty() && *inside.begin() != "..";
}

/// Where a case of the user's own may have its references beside it, none for the catalogue's. One
/// of the case's own name is not the case.
std::vector<fs::path> places_beside(const std::string& id, const fs::path& case_file) {
  const std::string name = id + ".json";
  const fs::path folder = fs::absolute(case_file).parent_path();
  if (is_in_catalogue(folder)) return {};
  if (case_file.filename() == name) return {folder / "references" / name};
  return {folder / name, folder / "references" / name};
}

}  // namespace

references::Source References::source(const std::string& key, const fs::path& file) const {
  for (const fs::path& folder : {file.parent_path(), stored().parent_path()}) {
    const fs::path place = folder / "bibliography.json";
    auto sources = bibliographies_.find(place);
    if (sources == bibliographies_.end())
      sources = bibliographies_.emplace(place, references::load_bibliography(place)).first;
    if (const auto found = sources->second.find(key); found != sources->second.end())
      return found->second;
  }
  return {key, ""};
}

CitedReference References::read(const fs::path& file) const {
  const Json json = read_json(file);
  if (const auto schema_error = find_schema_fault(json, "reference")) {
    throw InputError(file.string(), schema_error->pointer, schema_error->message);
  }
  try {
    CitedReference cited{references::read_reference(nlohmann::json(json), file.string()), {}};
    if (cited.reference.id != file.stem().string()) {
      throw InputError(file.string(), "/id",
                       "expected the file's name, '" + file.stem().string() + "'");
    }
    cited.source = source(cited.reference.source, file);
    return cited;
  } catch (const references::ReferenceError& error) {
    throw InputError(error.what());
  }
}

const references::Reference& References::get(const JsonView& id) const {
  const auto name = id.get<std::string>();
  if (rooms_.empty()) rooms_ = references::folders(stored().string());
  const auto beside = places_beside(name, id.document().origin(id.pointer()).file);
  for (const fs::path& file : beside) {
    std::error_code error;
    if (fs::is_regular_file(file, error)) return add(file);
    absent_.insert(file);
  }
  if (const std::string file = references::find_json_file(rooms_, name); !file.empty())
    return add(file);
  std::vector<std::string> places, names;
  for (const fs::path& file : beside) places.push_back(file.parent_path().string());
  places.push_back(stored().string());
  for (const auto& item : references::json_files(stored().string())) names.push_back(item.first);
  throw id.error("expected the name of a reference (got '" + printable(name) + "', looked for in " +
                 join(places, "and") + ")" + did_you_mean(name, names));
}

const references::Reference& References::add(const fs::path& file) const {
  auto found = read_.find(file);
  if (found == read_.end()) found = read_.emplace(file, read(file)).first;
  return found->second.reference;
}

std::map<std::string, std::string> References::hashes() const {
  std::map<std::string, std::string> hashes;
  for (const fs::path& file : absent_) hashes[file.string()];
  for (const auto& item : read_) hashes[item.first.string()] = file_hash(item.first);
  return hashes;
}

std::map<std::string, CitedReference> References::used() const {
  std::map<std::string, CitedReference> by_name;
  for (const auto& item : read_) by_name.emplace(item.second.reference.id, item.second);
  return by_name;
}

}  // namespace trammel::harness

#include "harness/input/reference_library.h"

#include <algorithm>

#include "harness/base/data_root.h"
#include "harness/base/json_file.h"
#include "harness/input/schema.h"
#include "harness/base/text.h"

namespace trammel {
namespace {

namespace fs = std::filesystem;

fs::path stored() {
  return home() / "references" / "values";
}

std::vector<fs::path> places(const std::string& id, const fs::path& case_file) {
  const std::string name = id + ".json";
  const fs::path folder = fs::absolute(case_file).parent_path();
  std::error_code error;
  if (fs::equivalent(folder, home() / "cases", error)) return {stored() / name};
  return {folder / name, folder / "references" / name, stored() / name};
}

std::vector<std::string> stored_names() {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(stored(), error)) {
    names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

CitedReference read(const fs::path& file) {
  const Json json = read_json(file);
  if (const auto fault = find_fault(json, "reference")) {
    throw InputError(file.string(), fault->pointer, fault->message);
  }
  try {
    CitedReference cited{read_reference(nlohmann::json(json), file.string()), {}};
    if (cited.reference.id != file.stem().string()) {
      throw InputError(file.string(), "/id",
                       "expected the file's name, '" + file.stem().string() + "'");
    }
    cited.source.text = cited.reference.source;
    for (const fs::path& folder : {file.parent_path(), stored().parent_path()}) {
      const Bibliography sources = load_bibliography(folder / "bibliography.json");
      const auto found = sources.find(cited.reference.source);
      if (found == sources.end()) continue;
      cited.source = found->second;
      break;
    }
    return cited;
  } catch (const ReferenceError& error) {
    throw InputError(error.what());
  }
}

}  // namespace

const Reference& References::get(const Cursor& id) const {
  const auto name = id.get<std::string>();
  const std::lock_guard<std::mutex> guard(lock_);
  for (const fs::path& file : places(name, id.document().origin(id.pointer()).file)) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) continue;
    auto found = read_.find(file);
    if (found == read_.end()) found = read_.emplace(file, read(file)).first;
    return found->second.reference;
  }
  throw id.error("expected the name of a reference (got '" + printable(name) + "')" +
                 did_you_mean(name, stored_names()));
}

std::map<std::string, CitedReference> References::used() const {
  const std::lock_guard<std::mutex> guard(lock_);
  std::map<std::string, CitedReference> by_name;
  for (const auto& item : read_) by_name.emplace(item.second.reference.id, item.second);
  return by_name;
}

}  // namespace trammel

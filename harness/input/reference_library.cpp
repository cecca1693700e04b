#include "harness/input/reference_library.h"

#include <algorithm>

#include "harness/base/environment.h"
#include "harness/base/json_file.h"
#include "harness/base/text.h"
#include "harness/input/catalogue.h"
#include "harness/input/document.h"
#include "references/data/family.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;
using references::find_member;

constexpr const char* kOwnFile = "references.json";

fs::path stored() {
  return data_root() / "references" / "values";
}

/// Returns the path of references.json next to a user's case. The path is empty for cases of the
/// catalogue.
std::string user_reference_file(const fs::path& case_file) {
  const fs::path folder = fs::absolute(case_file).parent_path();
  if (is_in_catalogue(folder) || case_file.filename() == kOwnFile) return {};
  return (folder / kOwnFile).string();
}

std::string reference_place(const std::string& file, const std::string& id) {
  return file + "#/" + id;
}

/// Splits the place "FILE#/ID" of a reference into file and id.
std::pair<std::string, std::string> split_reference_place(const std::string& place) {
  const std::size_t end = place.rfind("#/");
  if (end == std::string::npos) return {place, ""};
  return {place.substr(0, end), place.substr(end + 2)};
}

InputError repeated_id(const std::string& file, const std::string& id, const std::string& other) {
  return {file, "/" + id,
          "two references have this id; expected a unique id (the id is also in " + other + ")"};
}

}  // namespace

const std::vector<std::string>& References::catalogue_files() const {
  if (catalogue_files_.empty()) {
    for (auto& item : references::json_files(stored().string()))
      catalogue_files_.push_back(std::move(item.second));
    std::ranges::sort(catalogue_files_);
  }
  return catalogue_files_;
}

References::Family& References::family(const std::string& file) const {
  const auto [item, is_new] = families_.try_emplace(file);
  if (is_new) item->second.file = references::read_file(file);
  return item->second;
}

const std::vector<references::JsonMember>& References::members(const std::string& file) const {
  Family& split = family(file);
  if (!split.members) split.members = references::json_members(split.file.text);
  if (!split.members) {
    (void)read_json(file);  // throws an error with the line or key
    throw InputError(file, "", "expected an object with one key per reference or source");
  }
  return *split.members;
}

bool References::exists(const std::string& file) const {
  std::error_code error;
  return family(file).file.bytes != nullptr || fs::exists(file, error);
}

bool References::has(const std::string& file, const std::string& id) const {
  return exists(file) && references::is_reference_id(id) &&
         find_member(members(file), id).has_value();
}

const std::vector<References::Key>& References::catalogue_keys() const {
  if (!catalogue_keys_.empty()) return catalogue_keys_;
  for (const std::string& file : catalogue_files())
    for (const std::string_view key : references::top_level_keys(family(file).file.text))
      catalogue_keys_.push_back({key, &file});
  return catalogue_keys_;
}

references::Source References::source(const std::string& key, const std::string& file) const {
  for (const fs::path& folder : {fs::path(file).parent_path(), stored().parent_path()}) {
    const std::string bibliography = (folder / "bibliography.json").string();
    if (!exists(bibliography)) continue;
    if (const auto source = find_member(members(bibliography), key))
      return references::read_source(*source, bibliography + ": /" + key);
  }
  return {key, ""};
}

std::string References::find_in_catalogue(const std::string& id) const {
  const std::string* found = nullptr;
  if (!references::is_reference_id(id)) return {};
  for (const auto& [key, file] : catalogue_keys()) {
    if (key != id) continue;
    if (found != nullptr) throw repeated_id(*file, id, *found);
    found = file;
  }
  if (found != nullptr && has(*found, id)) return reference_place(*found, id);
  const auto places = catalogue();  // also searches files of unusual format
  const auto place = places.find(id);
  return place == places.end() ? "" : place->second;
}

CitedReference References::read(const std::string& place) const {
  const auto [file, id] = split_reference_place(place);
  if (!has(file, id))
    throw InputError(file, "/" + id,
                     "the file has no reference with this id; expected a key of the file");
  const auto common = find_member(members(file), references::kCommon);
  std::string text = "{";
  if (common) text.append("\"common\":").append(*common).append(1, ',');
  text.append(1, '"').append(id).append("\":").append(*find_member(members(file), id)) += '}';
  Json json;
  try {
    json = parse_json(text, file);
  } catch (const InputError&) {
    (void)read_json(file);  // throws an error with the line in the file
    throw;
  }
  if (const auto schema_error = find_schema_fault(json, "reference"))
    throw InputError(file, schema_error->pointer, schema_error->message);
  try {
    const nlohmann::json merged = references::merge_common_keys(
        common ? nlohmann::json(json.front()) : nlohmann::json(), nlohmann::json(json.back()));
    CitedReference cited{references::read_reference(merged, file, id), {}};
    cited.source = source(cited.reference.source, file);
    return cited;
  } catch (const references::ReferenceError& error) {
    throw InputError(error.what());
  }
}

const references::Reference& References::get(const JsonView& id) const {
  const auto name = id.get<std::string>();
  const std::string& case_file = id.document().origin(id.pointer()).file;
  auto place = places_.find({case_file, name});
  if (place == places_.end())
    place = places_.emplace(std::pair(case_file, name), find(name, case_file, id)).first;
  return add(place->second);
}

std::string References::find(const std::string& name, const std::string& case_file,
                             const JsonView& id) const {
  const std::string own = user_reference_file(case_file);
  if (!own.empty()) {
    std::string place = reference_place(own, name);
    if (has(own, name)) return place;
    absent_.insert(std::move(place));
  }
  if (std::string place = find_in_catalogue(name); !place.empty()) return place;
  std::vector<std::string> looked_for, names;
  if (!own.empty()) looked_for.push_back(own);
  looked_for.push_back(stored().string());
  for (const auto& item : catalogue()) names.push_back(item.first);
  if (exists(own))
    for (const references::JsonMember& member : members(own)) names.emplace_back(member.key);
  throw id.error("expected the name of a reference (got '" + printable(name) +
                 "', which is not in " + join(looked_for, "or") + ")" + did_you_mean(name, names));
}

const references::Reference& References::add(const std::string& place) const {
  auto found = read_.find(place);
  if (found == read_.end()) found = read_.emplace(place, read(place)).first;
  return found->second.reference;
}

std::map<std::string, std::string> References::catalogue() const {
  std::map<std::string, std::string> places;
  for (const std::string& file : catalogue_files())
    for (const references::JsonMember& member : members(file)) {
      if (!references::is_reference_id(member.key)) continue;
      const std::string id(member.key);
      const auto [place, is_new] = places.emplace(id, reference_place(file, id));
      if (!is_new) throw repeated_id(file, id, split_reference_place(place->second).first);
    }
  return places;
}

std::string References::hash(const std::string& place) const {
  const auto [file, id] = split_reference_place(place);
  try {
    if (!has(file, id)) return {};
  } catch (const InputError&) {
    return content_hash(std::string(family(file).file.text));
  }
  std::string text(*find_member(members(file), id));
  return content_hash(text.append(find_member(members(file), references::kCommon).value_or("")));
}

std::map<std::string, std::string> References::hashes() const {
  std::map<std::string, std::string> hashes;
  for (const std::string& place : absent_) hashes[place];
  for (const auto& item : read_) hashes[item.first] = hash(item.first);
  return hashes;
}

std::map<std::string, CitedReference> References::requested_references() const {
  std::map<std::string, CitedReference> by_id;
  for (const auto& item : read_) by_id.emplace(item.second.reference.id, item.second);
  return by_id;
}

}  // namespace trammel::harness

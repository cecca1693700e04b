#include "harness/input/json_view.h"

namespace trammel::harness {
namespace {

/// Returns the JSON pointer of a key. `pointer` is parsed only if the key contains '~' or '/'.
std::string append_key_to_pointer(const std::string& pointer, const std::string& key) {
  if (key.find_first_of("~/") != std::string::npos) return (JsonPointer(pointer) / key).to_string();
  return pointer + "/" + key;
}

}  // namespace

bool JsonView::has(const std::string& key) const {
  return json_->is_object() && json_->contains(key);
}

JsonView JsonView::operator[](const std::string& key) const {
  return {*document_, json_->at(key), append_key_to_pointer(pointer_, key)};
}

JsonView JsonView::operator[](std::size_t index) const {
  return {*document_, json_->at(index), pointer_ + "/" + std::to_string(index)};
}

std::optional<JsonView> JsonView::find(const std::string& key) const {
  if (!has(key)) return std::nullopt;
  return (*this)[key];
}

std::vector<std::pair<std::string, JsonView>> JsonView::entries() const {
  std::vector<std::pair<std::string, JsonView>> found;
  found.reserve(json_->size());
  if (json_->is_array()) {
    for (std::size_t i = 0; i < json_->size(); ++i)
      found.emplace_back(std::to_string(i), (*this)[i]);
    return found;
  }
  for (const auto& item : json_->items())
    found.emplace_back(item.key(), JsonView(*document_, item.value(),
                                            append_key_to_pointer(pointer_, item.key())));
  return found;
}

std::vector<std::pair<std::string, JsonView>> JsonView::entries(const std::string& key) const {
  const auto found = find(key);
  return found ? found->entries() : std::vector<std::pair<std::string, JsonView>>();
}

std::vector<std::size_t> JsonView::indices(const std::string& key) const {
  const auto stated = find(key);
  if (!stated) return {};
  if (stated->json().is_array()) return stated->get<std::vector<std::size_t>>();
  return {stated->get<std::size_t>()};
}

}  // namespace trammel::harness

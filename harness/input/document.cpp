#include "harness/input/document.h"

#include <algorithm>

namespace trammel::harness {
namespace {

/// Returns a JSON value without those members of objects that are null.
Json remove_nulls(const Json& value) {
  if (!value.is_object()) return value;
  Json kept = Json::object();
  // Members are appended, because operator[] would make the cost quadratic in the number of keys.
  Json::object_t::Container& members = kept.get_ref<Json::object_t&>();
  members.reserve(value.size());
  for (const auto& item : value.items())
    if (!item.value().is_null()) members.emplace_back(item.key(), remove_nulls(item.value()));
  return kept;
}

/// Applies a merge patch (RFC 7386). Objects that the target lacks are copied in one pass.
void merge(Json& target, const Json& patch) {
  if (!patch.is_object() || !target.is_object() || target.empty()) {
    target = remove_nulls(patch);
    return;
  }
  for (const auto& item : patch.items()) {
    if (item.value().is_null()) {
      target.erase(item.key());
    } else {
      merge(target[item.key()], item.value());
    }
  }
}

}  // namespace

void compose_patches(Json& patch, const Json& later) {
  if (!patch.is_object() || !later.is_object()) {
    patch = later;
    return;
  }
  for (const auto& item : later.items()) compose_patches(patch[item.key()], item.value());
}

Document Document::from_json(const std::string& file, const Json& json) {
  Document document;
  document.value_ = json;
  document.layers_.push_back({file, "", std::make_shared<const Json>(json), false});
  return document;
}

void Document::apply_patch(const std::string& file, const std::string& origin, const Json& patch) {
  // The key "variants" contains patches. Their nulls are kept until the variant is applied.
  Json variants = value_.value("variants", Json());
  merge(value_, patch);
  if (const auto stated = patch.find("variants"); stated != patch.end() && stated->is_object()) {
    compose_patches(variants, *stated);
    value_["variants"] = std::move(variants);
  }
  layers_.push_back({file, origin, std::make_shared<const Json>(patch), false});
}

void Document::apply_value_patch(const std::string& file, const std::string& origin,
                                 const Json& patch) {
  apply_patch(file, origin, patch);
  layers_.back().is_value = true;
}

Origin Document::origin(const std::string& pointer) const {
  for (JsonPointer at(pointer);; at = at.parent_pointer()) {
    const auto layer = std::find_if(layers_.rbegin(), layers_.rend(), [&](const Layer& candidate) {
      return candidate.patch->contains(at);
    });
    if (layer != layers_.rend())
      return {layer->file, layer->is_value ? layer->origin : layer->origin + pointer,
              layer->is_value};
    if (at.empty()) return {layers_.empty() ? "" : layers_.back().file, pointer, false};
  }
}

InputError Document::error(const std::string& pointer, const std::string& message) const {
  const Origin written = origin(pointer);
  return {written.file, written.pointer, written.is_value ? message + ", at " + pointer : message};
}

void Document::validate(const std::string& schema) const {
  if (const auto schema_error = find_schema_fault(value_, schema))
    throw error(schema_error->pointer, schema_error->message);
}

}  // namespace trammel::harness

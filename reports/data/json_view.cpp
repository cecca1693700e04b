#include "reports/data/json_view.h"

#include <stdexcept>

namespace trammel::reports {

namespace {

/// RFC 6901: ~ and / inside a key.
std::string escaped(const std::string& key) {
  std::string out;
  for (const char c : key) {
    if (c == '~') {
      out += "~0";
    } else if (c == '/') {
      out += "~1";
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace

void JsonView::fail(const std::string& expected) const {
  throw std::runtime_error((pointer_.empty() ? "/" : pointer_) + ": expected " + expected);
}

JsonView JsonView::find(const std::string& key) const {
  static const Json kNull;
  if (!value_->is_object()) fail("an object");
  const auto found = value_->find(key);
  return JsonView(found == value_->end() ? kNull : *found, pointer_ + "/" + escaped(key));
}

JsonView JsonView::at(const std::string& key) const {
  JsonView view = find(key);
  if (!value_->contains(key)) view.fail("a value, found nothing");
  return view;
}

std::string JsonView::text() const {
  if (!value_->is_string()) fail("a string");
  return value_->get<std::string>();
}

std::string JsonView::text_or(const char* other) const {
  return null() ? other : text();
}

double JsonView::number() const {
  if (!value_->is_number()) fail("a number");
  return value_->get<double>();
}

std::optional<double> JsonView::optional_number() const {
  if (null()) return std::nullopt;
  return number();
}

int JsonView::integer(int upper_bound) const {
  const std::string expected = "an integer from 0 to " + std::to_string(upper_bound - 1);
  if (!value_->is_number_integer()) fail(expected);
  const auto i = value_->get<long long>();
  if (i < 0 || i >= upper_bound) fail(expected);
  return static_cast<int>(i);
}

bool JsonView::boolean() const {
  if (!value_->is_boolean()) fail("true or false");
  return value_->get<bool>();
}

std::vector<JsonView> JsonView::entries() const {
  std::vector<JsonView> out;
  if (null()) return out;
  if (!value_->is_array()) fail("an array");
  for (std::size_t i = 0; i < value_->size(); ++i)
    out.emplace_back((*value_)[i], pointer_ + "/" + std::to_string(i));
  return out;
}

std::vector<std::pair<std::string, JsonView>> JsonView::members() const {
  std::vector<std::pair<std::string, JsonView>> out;
  if (null()) return out;
  if (!value_->is_object()) fail("an object");
  for (const auto& [key, value] : value_->items())
    out.emplace_back(key, JsonView(value, pointer_ + "/" + escaped(key)));
  return out;
}

}  // namespace trammel::reports

#include "references/numerics/arguments.h"

#include <algorithm>
#include <utility>

namespace trammel::references {

namespace {

std::string joined(const std::vector<std::string>& choices) {
  std::string text;
  for (const std::string& name : choices) text += (text.empty() ? "" : ", ") + name;
  return text;
}

Real decimal(const Json& number) {
  return Real(number.dump());
}

/// Returns the converted entries of an array, which must satisfy `is_valid` and not be empty.
template <class Convert>
auto read_array(const Arguments& arguments, const std::string& key, const char* entries,
                bool (Json::*is_valid)() const noexcept, const Convert& convert) {
  const Json& value = arguments[key];
  std::vector<decltype(convert(value))> result;
  for (const Json& entry : value) {
    if ((entry.*is_valid)()) result.push_back(convert(entry));
  }
  if (!value.is_array() || value.empty() || result.size() != value.size())
    arguments.fail(key, std::string("expected an array of ") + entries);
  return result;
}

}  // namespace

Arguments::Arguments(const Json& object, std::string pointer)
    : object_(object), pointer_(std::move(pointer)) {
  if (!object_.is_object())
    throw DerivationError((pointer_.empty() ? "/" : pointer_) + ": expected an object");
}

Arguments::Arguments(const Json& object, std::string pointer, const std::vector<std::string>& known)
    : Arguments(object, std::move(pointer)) {
  for (const auto& item : object_.items()) {
    if (std::ranges::find(known, item.key()) == known.end()) {
      fail(item.key(), "no such key; expected one of " + joined(known));
    }
  }
}

void Arguments::fail(const std::string& key, const std::string& expected) const {
  throw DerivationError(pointer(key) + ": " + expected);
}

std::string Arguments::pointer(const std::string& key) const {
  return pointer_ + "/" + key;
}

std::vector<std::string> Arguments::keys() const {
  std::vector<std::string> names;
  for (const auto& item : object_.items()) names.push_back(item.key());
  return names;
}

Arguments Arguments::object(const std::string& key, const std::vector<std::string>& known) const {
  return {(*this)[key], pointer(key), known};
}

const Json& Arguments::operator[](const std::string& key) const {
  const auto found = object_.find(key);
  if (found == object_.end()) fail(key, "is missing");
  return *found;
}

Real Arguments::number(const std::string& key, const Default& default_value) const {
  if (default_value && !has(key)) return *default_value;
  const Json& value = (*this)[key];
  if (!value.is_number()) fail(key, "expected a number");
  return decimal(value);
}

Real Arguments::positive(const std::string& key, const Default& default_value) const {
  Real value = number(key, default_value);
  if (!(value > 0)) fail(key, "expected a positive number");
  return value;
}

Real Arguments::not_negative(const std::string& key, const Real& default_value) const {
  Real value = number(key, default_value);
  if (value < 0) fail(key, "expected a number of at least 0");
  return value;
}

int Arguments::natural_number(const std::string& key) const {
  const Json& value = (*this)[key];
  if (!value.is_number_integer() || value.get<long>() < 1 || value.get<long>() > 1000)
    fail(key, "expected a whole number from 1 to 1000");
  return value.get<int>();
}

bool Arguments::flag(const std::string& key, bool default_value) const {
  if (!has(key)) return default_value;
  if (!(*this)[key].is_boolean()) fail(key, "expected true or false");
  return (*this)[key].get<bool>();
}

std::string Arguments::text(const std::string& key) const {
  if (!(*this)[key].is_string()) fail(key, "expected a string");
  return (*this)[key].get<std::string>();
}

std::string Arguments::choice(const std::string& key, const std::string& default_value,
                              const std::vector<std::string>& choices) const {
  if (!has(key) && !default_value.empty()) return default_value;
  const Json& value = (*this)[key];
  const auto found = std::ranges::find_if(choices, [&](const auto& name) { return value == name; });
  if (found == choices.end()) fail(key, "expected one of " + joined(choices));
  return *found;
}

std::vector<Real> Arguments::numbers(const std::string& key, std::size_t size) const {
  std::vector<Real> result = read_array(*this, key, "numbers", &Json::is_number, decimal);
  if (size > 0 && result.size() != size) fail(key, "expected " + std::to_string(size) + " numbers");
  return result;
}

std::vector<std::vector<Real>> Arguments::rows(const std::string& key, std::size_t columns) const {
  std::vector<std::vector<Real>> result;
  for (const Json& row : (*this)[key]) {
    result.push_back(Arguments({{"row", row}}, pointer(key)).numbers("row"));
    if (columns == 0) columns = result.front().size();
    if (result.back().size() != columns)
      fail(key, "expected rows of " + std::to_string(columns) + " numbers");
  }
  if (result.empty()) fail(key, "expected rows of numbers");
  return result;
}

std::vector<std::array<Real, 2>> Arguments::points(const std::string& key, std::size_t size) const {
  std::vector<std::array<Real, 2>> result;
  for (const auto& row : rows(key, 2)) result.push_back({row[0], row[1]});
  if (result.size() != size) fail(key, "expected " + std::to_string(size) + " points");
  return result;
}

std::array<Real, 2> Arguments::point(const std::string& key) const {
  const std::vector<Real> values = numbers(key, 2);
  return {values[0], values[1]};
}

std::array<Real, 2> Arguments::point_or_origin(const std::string& key) const {
  return has(key) ? point(key) : std::array<Real, 2>{};
}

std::vector<std::string> Arguments::texts(const std::string& key) const {
  return read_array(*this, key, "texts", &Json::is_string,
                    [](const Json& entry) { return entry.get<std::string>(); });
}

}  // namespace trammel::references

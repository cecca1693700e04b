#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace trammel::reports {

using Json = nlohmann::ordered_json;

/// A JSON value that knows where it stands, so that what is missing or of a wrong type is named by
/// its pointer. Every accessor throws std::runtime_error("/pointer: what was expected").
class JsonView {
 public:
  explicit JsonView(const Json& value, std::string pointer = "")
      : value_(&value), pointer_(std::move(pointer)) {}

  [[nodiscard]] const Json& json() const { return *value_; }
  [[nodiscard]] const std::string& pointer() const { return pointer_; }

  /// The member `key`; required, or a null view if it may be absent.
  [[nodiscard]] JsonView at(const std::string& key) const;
  [[nodiscard]] JsonView find(const std::string& key) const;
  [[nodiscard]] bool null() const { return value_->is_null(); }

  [[nodiscard]] std::string text() const;                       ///< a string
  [[nodiscard]] double number() const;                          ///< a number
  [[nodiscard]] std::optional<double> optional_number() const;  ///< a number, null or absent
  [[nodiscard]] int integer(int upper_bound) const;             ///< 0 <= i < below
  [[nodiscard]] bool boolean() const;                           ///< true or false
  [[nodiscard]] std::string text_or(const char* other) const;   ///< a string, null or absent

  /// The entries of an array or the members of an object; none of null.
  [[nodiscard]] std::vector<JsonView> entries() const;
  [[nodiscard]] std::vector<std::pair<std::string, JsonView>> members() const;

  [[noreturn]] void fail(const std::string& expected) const;

 private:
  const Json* value_;
  std::string pointer_;
};

}  // namespace trammel::reports

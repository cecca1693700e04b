#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "harness/input/document.h"

namespace trammel::harness {

/// Default ratio of the (first or largest) time step of a motion to the duration of the motion.
inline constexpr double kDefaultStep = 1e-3;

/// Words that denote the values of an enumeration in case files, in the order of the enumeration.
template <class Enum>
inline constexpr std::array<const char*, 0> kWords{};
#define TRAMMEL_WORDS(Enum, ...) \
  template <>                    \
  inline constexpr std::array kWords<Enum> = {__VA_ARGS__}

/// View of one value in a document that satisfies its schema. It reads the value and its members,
/// and reports errors with file and JSON pointer.
class JsonView {
 public:
  explicit JsonView(const Document& document) : document_(&document), json_(&document.value()) {}

  [[nodiscard]] bool has(const std::string& key) const;
  [[nodiscard]] JsonView operator[](const std::string& key) const;
  [[nodiscard]] JsonView operator[](std::size_t index) const;
  /// Returns the value of a key; empty if the key is absent.
  [[nodiscard]] std::optional<JsonView> find(const std::string& key) const;
  /// Returns the entries of an object with their names, or of an array with their indices as names.
  [[nodiscard]] std::vector<std::pair<std::string, JsonView>> entries() const;
  /// Returns the entries of the object or array at a key; an empty list if the key is missing.
  [[nodiscard]] std::vector<std::pair<std::string, JsonView>> entries(const std::string& key) const;
  [[nodiscard]] std::size_t size() const { return json_->size(); }

  template <class T>
  [[nodiscard]] T get() const {
    if constexpr (std::is_enum_v<T>) {
      const auto word = std::ranges::find(kWords<T>, json_->template get<std::string>());
      return static_cast<T>(word - kWords<T>.begin());
    } else {
      return json_->template get<T>();
    }
  }
  template <class T>
  [[nodiscard]] T get(const std::string& key, const T& otherwise) const {
    return has(key) ? (*this)[key].template get<T>() : otherwise;
  }
  [[nodiscard]] double number(const std::string& key) const { return (*this)[key].get<double>(); }
  [[nodiscard]] std::string text(const std::string& key) const {
    return (*this)[key].get<std::string>();
  }

  /// Returns the indices stated at a key as one number or a list; an empty list if the key is
  /// missing.
  [[nodiscard]] std::vector<std::size_t> indices(const std::string& key) const;

  [[nodiscard]] const Json& json() const { return *json_; }
  [[nodiscard]] const std::string& pointer() const { return pointer_; }
  [[nodiscard]] const Document& document() const { return *document_; }
  [[nodiscard]] InputError error(const std::string& message) const {
    return document_->error(pointer_, message);
  }

 private:
  JsonView(const Document& document, const Json& json, std::string pointer)
      : document_(&document), json_(&json), pointer_(std::move(pointer)) {}

  const Document* document_;
  const Json* json_;
  std::string pointer_;
};

}  // namespace trammel::harness

#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "references/numerics/real.h"

/// Reads the arguments of a derivation. Each error message contains the JSON pointer of the invalid
/// value and the expected value.
namespace trammel::references {

using Json = nlohmann::json;

/// Error of a derivation: invalid arguments, or a model that it cannot solve.
class DerivationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Arguments of a derivation: a JSON object without unknown keys.
class Arguments {
 public:
  using Default = std::optional<Real>;  ///< value of a missing key; none: the key is required

  /// @param pointer  JSON pointer to the object, for error messages.
  /// @throws DerivationError  if `object` is not an object, or has a key that is not in `known`.
  Arguments(const Json& object, std::string pointer, const std::vector<std::string>& known);
  /// Creates arguments from a JSON object whose keys are arbitrary names, such as names of nodes.
  Arguments(const Json& object, std::string pointer);

  [[nodiscard]] const Json& json() const { return object_; }
  [[nodiscard]] bool has(const std::string& key) const { return object_.contains(key); }
  [[nodiscard]] const Json& operator[](const std::string& key) const;
  [[nodiscard]] std::string pointer(const std::string& key) const;
  [[nodiscard]] std::vector<std::string> keys() const;
  /// Returns the JSON object at a key. The keys of this object must be in `known`.
  [[nodiscard]] Arguments object(const std::string& key,
                                 const std::vector<std::string>& known) const;

  // Numbers are returned exactly as the decimal numbers in the file: 0.0015 is 15/10000, not the
  // nearest double. This also applies to positive() and to the other functions that return Real.
  [[nodiscard]] Real number(const std::string& key, const Default& default_value = {}) const;
  [[nodiscard]] Real positive(const std::string& key, const Default& default_value = {}) const;
  [[nodiscard]] Real not_negative(const std::string& key, const Real& default_value) const;
  [[nodiscard]] int natural_number(const std::string& key) const;  ///< 1 ... 1000
  [[nodiscard]] bool flag(const std::string& key, bool default_value) const;
  [[nodiscard]] std::string text(const std::string& key) const;
  /// Returns one of `choices`, or `default_value` if the key is missing.
  [[nodiscard]] std::string choice(const std::string& key, const std::string& default_value,
                                   const std::vector<std::string>& choices) const;
  /// @param size  required length of the array; 0: any length
  [[nodiscard]] std::vector<Real> numbers(const std::string& key, std::size_t size = 0) const;
  /// @param columns  required length of each row; 0: the length of the first row
  [[nodiscard]] std::vector<std::vector<Real>> rows(const std::string& key,
                                                    std::size_t columns = 0) const;
  [[nodiscard]] std::vector<std::array<Real, 2>> points(const std::string& key,
                                                        std::size_t size) const;
  [[nodiscard]] std::array<Real, 2> point(const std::string& key) const;
  /// Returns the point [x, y] at a key, or the origin if the key is missing.
  [[nodiscard]] std::array<Real, 2> point_or_origin(const std::string& key) const;
  [[nodiscard]] std::vector<std::string> texts(const std::string& key) const;

  [[noreturn]] void fail(const std::string& key, const std::string& expected) const;

 private:
  Json object_;
  std::string pointer_;
};

}  // namespace trammel::references

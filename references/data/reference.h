#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

/// A reference: numbers from outside with their passport, as stored in references/values/*.json.
namespace trammel {

enum class ReferenceKind { exact, computed, paper, code };

struct Reference {
  std::string id;
  std::string title;
  ReferenceKind kind = ReferenceKind::exact;
  std::string unit;  ///< "Hz", "m", "1", ...
  std::vector<double> values;
  std::vector<double> uncertainty;   ///< absolute, one a value, same unit
  std::string source;                ///< key into references/bibliography.json
  std::string place;                 ///< where in the source: "Table 2, row 1"
  std::vector<std::string> printed;  ///< as printed, where the source prints them
  std::string derivation;            ///< program and arguments in words; empty where none
  std::vector<std::string> errata;   ///< what is wrong with the source, and how it was shown
};

/// Bad input: one line with file, JSON pointer (or byte offset) and what was expected.
class ReferenceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// @throws ReferenceError
[[nodiscard]] Reference load_reference(const std::filesystem::path& file);

}  // namespace trammel

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// References: numbers from independent sources with their provenance, stored in references/values.
namespace trammel::references {

enum class ReferenceKind { proved, exact, computed, paper, code };

struct Reference {
  std::string id;
  std::string title;
  ReferenceKind kind = ReferenceKind::exact;
  std::string unit;  ///< "Hz", "m", "1", ...
  std::vector<double> values;
  std::vector<double> uncertainty;       ///< absolute half width, one per value, same unit
  std::string source;                    ///< key into references/bibliography.json
  std::string place;                     ///< location in the source, such as "Table 2, row 1"
  std::vector<std::string> printed;      ///< digits printed in the source; may be empty
  std::string derivation;                ///< program and arguments as text; empty if none
  std::vector<std::string> errata;       ///< proved misprints and errors of the source
  std::vector<std::string> ambiguities;  ///< data that the source leaves open
  std::string notes;
  /// Probabilities of the interpretations ("readings") of a published model, as JSON text. The text
  /// is empty if the reference has no probabilities.
  std::string probabilities;
};

[[nodiscard]] const char* to_string(ReferenceKind kind);

/// Invalid reference file. The message is one line with file, JSON pointer (or byte offset) and the
/// expected content.
class ReferenceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a reference with all its keys, including the common keys of its family.
/// @param file  name of the file in messages
/// @throws ReferenceError  if a key is missing or of the wrong type, or if 'printed' or the
///                         uncertainty has another number of items than 'values'. It is also thrown
///                         if 'uncertainty' is missing, and 'printed' is missing or differs from
///                         'values'.
[[nodiscard]] Reference read_reference(const nlohmann::json& json, const std::string& file,
                                       const std::string& id);

/// Returns half a unit of the last printed digit: "12.768" -> 0.0005, "6.9e10" -> 0.05e10,
/// "12" -> 0.5.
/// @throws ReferenceError  if the text is not a decimal number.
[[nodiscard]] double half_unit_in_last_place(const std::string& printed);

struct Source {
  std::string text;  ///< full citation
  std::string doi;   ///< empty if the source has no DOI
};

/// Reads a member of a bibliography, {"key": {"text": "...", "doi": "..."}}.
/// @param place  location in messages, "file: /key"
/// @throws ReferenceError  if 'text' is missing, or if 'text' or 'doi' is not a text.
[[nodiscard]] Source read_source(std::string_view json, const std::string& place);

}  // namespace trammel::references

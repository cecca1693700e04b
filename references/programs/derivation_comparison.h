#pragma once

#include <string>
#include <vector>

#include "references/numerics/arguments.h"

/// Stored reference and the values of its derivation.
namespace trammel::references {

struct Comparison {
  std::string id;
  std::string program;  ///< empty: the file has no derivation
  std::string unit;
  std::vector<double> stored;
  std::vector<double> uncertainty;           ///< absolute, one a value
  std::vector<double> derived;               ///< empty where there is no derivation
  std::vector<std::string> printed, proved;  ///< digits stored and proved again, of kind "proved"

  /// Every derived value lies within the stated uncertainty of the stored one, and proved digits
  /// are those stored.
  [[nodiscard]] bool within_uncertainty() const;
};

/// @param reference  a reference with what its family has in common.
/// @param file  file in messages.
/// @throws DerivationError  with the file and the JSON pointer inside it.
[[nodiscard]] Comparison compare_with_derivation(const Json& reference, const std::string& file,
                                                 const std::string& id);

}  // namespace trammel::references

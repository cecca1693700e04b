#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "tests/fuzz/schema.h"

/// Inputs made from the files of the catalogue by one to three changes that know the schema, the
/// grammar of JSON, merge patches and what a document calls by name.
namespace trammel::fuzz {

struct Input {
  std::string kind;         ///< case, cost, claims, reference or results
  std::string name;         ///< of its file, without .json
  std::string text, how;    ///< and what was changed
  bool is_invalid = false;  ///< by construction: whoever accepts it is wrong
  std::size_t pick = 0;     ///< which of its variants is computed, by remainder
};

class Mutator {
 public:
  /// Reads the catalogue; `results` are texts of results files to start from.
  explicit Mutator(const std::vector<Json>& results);

  /// The same for the same seed and number. @param kind  empty: any
  [[nodiscard]] Input make(std::uint32_t seed, std::uint32_t number, const std::string& kind) const;

  static const std::vector<std::string>& kinds();

 private:
  struct Origin {
    std::string name;
    Json json;
    std::vector<Place> places;
  };
  using Random = std::mt19937_64;

  void add(const std::string& kind, const std::string& name, Json json);
  void change(Random& random, const std::string& kind, Json& json, Input& input) const;
  [[nodiscard]] Json generate(Random& random, const Schema& schema, const Json& rule,
                              const Json& document, int depth) const;

  std::map<std::string, Schema> schemas_;
  std::map<std::string, std::vector<Origin>> origins_;
};

}  // namespace trammel::fuzz

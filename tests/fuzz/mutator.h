#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "tests/fuzz/schema.h"

/// Makes test inputs from the files of the catalogue by one to three changes of each file. The
/// changes follow the schema, the grammar of JSON, merge patches and the names in the document.
namespace trammel::fuzz {

struct Input {
  std::string kind;         ///< type of file: case, cost, claims, reference or results
  std::string name;         ///< name of the changed file, without .json
  std::string text, how;    ///< content of the file, and a description of the changes
  bool is_invalid = false;  ///< known to be invalid; accepting it is a fault
  std::size_t pick = 0;     ///< selects the variant to compute, modulo the number of variants
};

class Mutator {
 public:
  /// Reads the catalogue of cases. @param results  sample results, which are also changed to make
  /// inputs
  explicit Mutator(const std::vector<Json>& results);

  /// Returns input `number` of the random sequence of `seed`.
  /// @param kind  type of file; empty: any type
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

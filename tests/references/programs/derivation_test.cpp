// ctest: labels=verification timeout=900
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "references/data/family.h"
#include "references/programs/program.h"

BOOST_AUTO_TEST_SUITE(derivation)

namespace fs = std::filesystem;
using namespace trammel::references;

namespace {

const fs::path root = fs::path(TRAMMEL_SOURCE_DIR) / "references";

const std::map<std::string, Json>& stored() {
  static const auto all = [] {
    std::map<std::string, Json> references;
    for (const auto& item : json_files((root / "values").string()))
      for (auto& [id, reference] : read_family(item.second))
        BOOST_TEST(references.emplace(id, std::move(reference)).second, id << " is there twice");
    return references;
  }();
  return all;
}

/// Returns every stored reference with its derived values, computed once.
const std::map<std::string, Comparison>& comparisons() {
  static const auto all = [] {
    std::map<std::string, Comparison> result;
    for (const auto& [id, reference] : stored())
      result[id] = compare_with_derivation(reference, "values", id);
    return result;
  }();
  return all;
}

/// Returns the value with its tenth significant digit changed by one.
double with_tenth_digit_changed(double value) {
  return value + std::pow(10.0, std::floor(std::log10(std::abs(value))) - 9);
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_stored_value_agrees_with_its_derivation) {
  int derived = 0;
  for (const auto& [name, comparison] : comparisons()) {
    BOOST_TEST_CONTEXT(name) {
      if (comparison.program.empty()) continue;
      BOOST_TEST(comparison.derived.size() == comparison.stored.size());
      BOOST_TEST(comparison.within_uncertainty());
      ++derived;
    }
  }
  BOOST_TEST(derived > 200);
}

BOOST_AUTO_TEST_CASE(exact_values_have_derivations_and_all_have_sources) {
  std::ifstream in(root / "bibliography.json");
  const Json bibliography = Json::parse(in);
  for (const auto& [id, reference] : stored()) {
    BOOST_TEST_CONTEXT(id) {
      BOOST_TEST((reference.at("kind") != "exact" || reference.contains("derivation")));
      BOOST_TEST(bibliography.contains(reference.at("source").get<std::string>()));
      BOOST_TEST(!reference.at("place").get<std::string>().empty());
      if (!reference.contains("printed")) continue;
      for (std::size_t i = 0; i < reference.at("values").size(); ++i) {
        const double printed = std::stod(reference.at("printed").at(i).get<std::string>());
        BOOST_TEST(
            (printed == reference.at("values").at(i).get<double>() || reference.contains("notes")));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(corrupted_exact_value_is_caught) {
  int corrupted = 0;
  for (const auto& [name, reference] : stored()) {
    if (reference.at("kind") != "exact") continue;
    BOOST_TEST_CONTEXT(name) {
      Comparison comparison = comparisons().at(name);
      for (std::size_t i = 0; i < comparison.stored.size(); ++i) {
        double& value = comparison.stored[i];
        if (value == 0) continue;
        const double kept = value;
        value = std::max(with_tenth_digit_changed(kept), kept + 2.1 * comparison.uncertainty[i]);
        BOOST_TEST(!comparison.within_uncertainty());
        value = kept;
        ++corrupted;
      }
    }
  }
  BOOST_TEST(corrupted > 100);
}

BOOST_AUTO_TEST_CASE(changed_proved_digit_is_caught) {
  int proved = 0;
  for (const auto& [name, kept] : comparisons()) {
    if (kept.printed.empty()) continue;
    Comparison comparison = kept;
    char& last = comparison.printed.back().back();
    last = last == '9' ? '8' : static_cast<char>(last + 1);
    BOOST_TEST(!comparison.within_uncertainty(), name);
    ++proved;
  }
  BOOST_TEST(proved > 90);
  BOOST_CHECK_THROW((void)prove("pendulum", Json::object()), DerivationError);
}

BOOST_AUTO_TEST_CASE(wrong_length_and_nan_never_agree_with_derivation) {
  Comparison comparison;
  comparison.stored = {1.0, 2.0};
  comparison.uncertainty = {1e-9, 1e-9};
  comparison.derived = {1.0, 2.0};
  BOOST_TEST(comparison.within_uncertainty());
  comparison.derived = {1.0};
  BOOST_TEST(!comparison.within_uncertainty());
  comparison.derived = {1.0, std::nan("")};
  BOOST_TEST(!comparison.within_uncertainty());
}

BOOST_AUTO_TEST_CASE(message_names_file_and_pointer_of_derivation) {
  const Json reference = Json::parse(R"({
    "title": "x", "kind": "exact", "unit": "1", "source": "x", "place": "x", "values": [1],
    "uncertainty": {"relative": 0}, "derivation": {
      "program": "beam-roots", "arguments": {"ends": "glued", "count": 1}}})");
  try {
    static_cast<void>(compare_with_derivation(reference, "x.json", "x"));
    BOOST_TEST(false, "accepted");
  } catch (const DerivationError& error) {
    BOOST_TEST(std::string(error.what())
                   .rfind("x.json: /x/derivation/arguments/ends: expected one of", 0) == 0U);
  }
}

BOOST_AUTO_TEST_SUITE_END()

#include "references/data/reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "references/data/json_files.h"

namespace trammel::references {
namespace {

using Json = nlohmann::json;

/// In the order of ReferenceKind.
constexpr std::array kKinds = {"proved", "exact", "computed", "paper", "code"};

[[noreturn]] void fail(const std::string& file, const std::string& pointer,
                       const std::string& expected) {
  throw ReferenceError(file + ": " + pointer + ": expected " + expected);
}

template <class T>
T required(const Json& json, const std::string& file, const char* key, const char* expected) {
  const auto found = json.find(key);
  if (found == json.end()) fail(file, "/", std::string("the key '") + key + "'");
  try {
    return found->get<T>();
  } catch (const Json::exception&) {
    fail(file, std::string("/") + key, expected);
  }
}

template <class T>
T optional(const Json& json, const std::string& file, const char* key, const char* expected) {
  return json.contains(key) ? required<T>(json, file, key, expected) : T{};
}

ReferenceKind parse_kind(const std::string& word, const std::string& file) {
  const auto* const found = std::ranges::find(kKinds, word);
  if (found != kKinds.end()) return static_cast<ReferenceKind>(found - kKinds.begin());
  fail(file, "/kind", "'proved', 'exact', 'computed', 'paper' or 'code' (got '" + word + "')");
}

/// One number for all values, or one for each.
std::vector<double> expand(const Json& stated, const std::string& file, const char* pointer,
                           std::size_t count) {
  std::vector<double> half_widths;
  if (stated.is_number()) {
    half_widths.assign(count, stated.get<double>());
  } else if (stated.is_array() && stated.size() == count) {
    for (const Json& number : stated) {
      if (!number.is_number()) fail(file, pointer, "numbers");
      half_widths.push_back(number.get<double>());
    }
  } else {
    fail(file, pointer, "a number or " + std::to_string(count) + " of them, one a value");
  }
  for (const double value : half_widths)
    if (!(value >= 0)) fail(file, pointer, "numbers that are not negative");
  return half_widths;
}

std::vector<double> read_uncertainty(const Json& json, const Reference& reference,
                                     const std::string& file) {
  const auto stated = json.find("uncertainty");
  if (stated != json.end()) {
    const bool relative = stated->contains("relative");
    const char* key = relative ? "relative" : "absolute";
    if (!stated->is_object() || !stated->contains(key)) {
      fail(file, "/uncertainty", "'relative' or 'absolute'");
    }
    const std::string pointer = std::string("/uncertainty/") + key;
    auto half_widths = expand(stated->at(key), file, pointer.c_str(), reference.values.size());
    for (std::size_t i = 0; relative && i < half_widths.size(); ++i) {
      half_widths[i] *= std::abs(reference.values[i]);
    }
    return half_widths;
  }
  if (reference.printed.empty()) fail(file, "/", "'uncertainty', or 'printed' digits that tell it");
  std::vector<double> half_widths;
  for (std::size_t i = 0; i < reference.printed.size(); ++i) {
    // Where the digits are in another unit or corrected, they say nothing about the value.
    const double read = std::strtod(reference.printed[i].c_str(), nullptr);
    if (std::abs(read - reference.values[i]) > 1e-12 * std::abs(read)) {
      fail(file, "/printed/" + std::to_string(i),
           "the digits of the value, or 'uncertainty' beside them (got '" + reference.printed[i] +
               "')");
    }
    half_widths.push_back(half_unit_in_last_place(reference.printed[i]));
  }
  return half_widths;
}

std::string describe_derivation(const Json& derivation) {
  std::string text = derivation.value("program", "");
  const Json arguments = derivation.value("arguments", Json::object());
  for (const auto& item : arguments.items()) text += " " + item.key() + "=" + item.value().dump();
  return text;
}

}  // namespace

const char* to_string(ReferenceKind kind) {
  return kKinds.at(static_cast<std::size_t>(kind));
}

double half_unit_in_last_place(const std::string& printed) {
  char* end = nullptr;
  (void)std::strtod(printed.c_str(), &end);
  const bool plain = printed.find_first_not_of("+-.0123456789eE") == std::string::npos;
  if (printed.empty() || *end != '\0' || !plain) {
    throw ReferenceError("expected a decimal number as printed (got '" + printed + "')");
  }
  const auto mantissa = printed.find_first_of("eE");
  const auto point = printed.find('.');
  const auto last = std::min(mantissa, printed.size());
  const auto decimals = point == std::string::npos ? 0 : last - point - 1;
  const long exponent =
      mantissa == std::string::npos ? 0 : std::strtol(printed.c_str() + mantissa + 1, nullptr, 10);
  // Through text: 0.5e-3 read from decimal is the nearest double, a power by pow need not be.
  const long place = exponent - static_cast<long>(decimals);
  return std::strtod(("0.5e" + std::to_string(place)).c_str(), nullptr);
}

Reference read_reference(const Json& json, const std::string& name) {
  if (!json.is_object()) fail(name, "/", "an object");
  const auto text = [&](const char* key) { return required<std::string>(json, name, key, "text"); };
  Reference read;
  read.id = text("id");
  read.title = text("title");
  read.kind = parse_kind(text("kind"), name);
  read.unit = text("unit");
  read.values = required<std::vector<double>>(json, name, "values", "an array of numbers");
  read.source = text("source");
  read.place = text("place");
  read.printed = optional<std::vector<std::string>>(json, name, "printed", "an array of texts");
  read.errata = optional<std::vector<std::string>>(json, name, "errata", "an array of texts");
  read.notes = optional<std::string>(json, name, "notes", "text");
  if (json.contains("probabilities")) read.probabilities = json.at("probabilities").dump();
  if (json.contains("derivation")) read.derivation = describe_derivation(json.at("derivation"));
  if (read.values.empty()) fail(name, "/values", "at least one number");
  if (!read.printed.empty() && read.printed.size() != read.values.size()) {
    fail(name, "/printed",
         "as many texts as values (got " + std::to_string(read.printed.size()) + " for " +
             std::to_string(read.values.size()) + ")");
  }
  const bool proved = read.kind == ReferenceKind::proved;
  if ((proved || read.kind == ReferenceKind::exact) && read.derivation.empty())
    fail(name, "/",
         std::string("'derivation' for a reference of kind '") + to_string(read.kind) + "'");
  if (proved && read.printed.empty())
    fail(name, "/", "'printed', the digits proved, for a reference of kind 'proved'");
  read.uncertainty = read_uncertainty(json, read, name);
  return read;
}

std::map<std::string, std::string> reference_files(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (auto& [name, file] : json_files(folder)) files.emplace(std::move(name), std::move(file));
  return files;
}

}  // namespace trammel::references

#include "references/data/reference.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace trammel::references {
namespace {

using Json = nlohmann::json;

/// Names of the kinds of references, in the order of ReferenceKind.
constexpr std::array kKinds = {"proved", "exact", "computed", "paper", "code"};

/// @param place  location of the reference for the message, "file: /id"
[[noreturn]] void fail(const std::string& place, const std::string& pointer,
                       const std::string& expected) {
  throw ReferenceError(place + pointer + ": expected " + expected);
}

bool is_name(const std::string& id) {
  return !id.empty() && std::isalnum(static_cast<unsigned char>(id.front())) != 0 &&
         std::ranges::all_of(id, [](unsigned char c) {
           return (c < 128 && std::isalnum(c) != 0) || c == '.' || c == '_' || c == '-';
         });
}

template <class T>
T required_member(const Json& json, const std::string& place, const char* key,
                  const char* expected) {
  const auto found = json.find(key);
  if (found == json.end()) fail(place, "", std::string("the key '") + key + "'");
  try {
    return found->get<T>();
  } catch (const Json::exception&) {
    fail(place, std::string("/") + key, expected);
  }
}

template <class T>
T optional_member(const Json& json, const std::string& place, const char* key,
                  const char* expected) {
  return json.contains(key) ? required_member<T>(json, place, key, expected) : T{};
}

ReferenceKind parse_kind(const std::string& word, const std::string& place) {
  const auto* const found = std::ranges::find(kKinds, word);
  if (found != kKinds.end()) return static_cast<ReferenceKind>(found - kKinds.begin());
  fail(place, "/kind", "'proved', 'exact', 'computed', 'paper' or 'code' (got '" + word + "')");
}

/// Returns the half width of the uncertainty of each value.
/// @param stated  one number for all values, or a list with one number for each value
std::vector<double> expand(const Json& stated, const std::string& place, const char* pointer,
                           std::size_t count) {
  const Json numbers = stated.is_number() ? Json(std::vector<Json>(count, stated)) : stated;
  const auto is_half_width = [](const Json& number) { return number.is_number() && number >= 0; };
  if (!numbers.is_array() || numbers.size() != count ||
      !std::all_of(numbers.begin(), numbers.end(), is_half_width))
    fail(place, pointer,
         "a number of at least 0, or " + std::to_string(count) + " such numbers, one per value");
  return numbers.get<std::vector<double>>();
}

std::vector<double> read_uncertainty(const Json& json, const Reference& reference,
                                     const std::string& place) {
  const auto stated = json.find("uncertainty");
  if (stated != json.end()) {
    const bool relative = stated->contains("relative");
    const char* key = relative ? "relative" : "absolute";
    if (!stated->is_object() || !stated->contains(key))
      fail(place, "/uncertainty", "'relative' or 'absolute'");
    const std::string pointer = std::string("/uncertainty/") + key;
    auto half_widths = expand(stated->at(key), place, pointer.c_str(), reference.values.size());
    for (std::size_t i = 0; relative && i < half_widths.size(); ++i)
      half_widths[i] *= std::abs(reference.values[i]);
    return half_widths;
  }
  if (reference.printed.empty())
    fail(place, "", "'uncertainty', or 'printed' digits that imply it");
  std::vector<double> half_widths;
  for (std::size_t i = 0; i < reference.printed.size(); ++i) {
    // If the stored value differs from the printed number (because it is corrected, or in another
    // unit), the printed digits do not determine its uncertainty.
    const double read = std::strtod(reference.printed[i].c_str(), nullptr);
    if (std::abs(read - reference.values[i]) > 1e-12 * std::abs(read))
      fail(place, "/printed/" + std::to_string(i),
           "the digits of the value, or 'uncertainty' in addition (got '" + reference.printed[i] +
               "')");
    half_widths.push_back(half_unit_in_last_place(reference.printed[i]));
  }
  return half_widths;
}

std::string describe_derivation(const Json& derivation, const std::string& place) {
  const auto program = derivation.find("program"), arguments = derivation.find("arguments");
  if (program == derivation.end() || !program->is_string() || arguments == derivation.end() ||
      !arguments->is_object())
    fail(place, "/derivation", "'program' and 'arguments'");
  auto text = program->get<std::string>();
  for (const auto& item : arguments->items()) text += " " + item.key() + "=" + item.value().dump();
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
  if (printed.empty() || *end != '\0' || !plain)
    throw ReferenceError("expected a decimal number as printed (got '" + printed + "')");
  const auto mantissa = printed.find_first_of("eE");
  const auto point = printed.find('.');
  const auto last = std::min(mantissa, printed.size());
  const auto decimals = point == std::string::npos ? 0 : last - point - 1;
  const long exponent =
      mantissa == std::string::npos ? 0 : std::strtol(printed.c_str() + mantissa + 1, nullptr, 10);
  // The half unit is parsed from a text such as 0.5e-3, which yields the nearest double. The
  // product 0.5 * std::pow(10, -3) can differ from the nearest double.
  const long place = exponent - static_cast<long>(decimals);
  return std::strtod(("0.5e" + std::to_string(place)).c_str(), nullptr);
}

Reference read_reference(const Json& json, const std::string& file, const std::string& id) {
  const std::string place = file + ": /" + id;
  if (!is_name(id)) fail(place, "", "an id of letters, digits, '.', '_' and '-'");
  if (!json.is_object()) fail(place, "", "an object");
  const auto text = [&](const char* key) {
    return required_member<std::string>(json, place, key, "text");
  };
  Reference read;
  read.id = id;
  read.title = text("title");
  read.kind = parse_kind(text("kind"), place);
  read.unit = text("unit");
  read.values = required_member<std::vector<double>>(json, place, "values", "an array of numbers");
  read.source = text("source");
  read.place = text("place");
  read.printed =
      optional_member<std::vector<std::string>>(json, place, "printed", "an array of texts");
  for (const auto& [key, texts] :
       {std::pair("errata", &read.errata), {"ambiguities", &read.ambiguities}})
    *texts = optional_member<std::vector<std::string>>(json, place, key, "an array of texts");
  read.notes = optional_member<std::string>(json, place, "notes", "text");
  if (json.contains("probabilities")) read.probabilities = json.at("probabilities").dump();
  if (json.contains("derivation"))
    read.derivation = describe_derivation(json.at("derivation"), place);
  if (read.values.empty()) fail(place, "/values", "at least one number");
  if (!read.printed.empty() && read.printed.size() != read.values.size())
    fail(place, "/printed",
         "as many texts as values (got " + std::to_string(read.printed.size()) + " for " +
             std::to_string(read.values.size()) + ")");
  const bool proved = read.kind == ReferenceKind::proved;
  if ((proved || read.kind == ReferenceKind::exact) && read.derivation.empty())
    fail(place, "",
         std::string("'derivation' for a reference of kind '") + to_string(read.kind) + "'");
  if (proved && read.printed.empty())
    fail(place, "", "the proved digits in 'printed' for a reference of kind 'proved'");
  read.uncertainty = read_uncertainty(json, read, place);
  return read;
}

Source read_source(std::string_view json, const std::string& place) {
  try {
    const Json source = Json::parse(json);
    return {source.at("text").get<std::string>(), source.value("doi", "")};
  } catch (const Json::exception& error) {
    throw ReferenceError(place + ": expected the texts 'text' and, optionally, 'doi' (" +
                         error.what() + ")");
  }
}

}  // namespace trammel::references

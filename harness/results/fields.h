#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <boost/preprocessor/seq/enum.hpp>
#include <boost/preprocessor/seq/transform.hpp>
#include <boost/preprocessor/variadic/to_seq.hpp>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "harness/base/number.h"

/// Conversion between a struct and its JSON object, in both directions, from one list of keys and
/// members:
///
///   TRAMMEL_FIELDS(Pose, required("nodes_m", &S::nodes), TRAMMEL_REQUIRED(label));
namespace trammel::results {

using Json = nlohmann::ordered_json;
using harness::Number;
using harness::Numbers;

/// Form of written JSON. text: without `store_only` fields. summary: without `stored` fields, which
/// the run store contains. store: all fields, with arrays of numbers as bytes.
enum class Form { text, summary, store };

/// Location of a value in a JSON document. Its JSON pointer is built only for an error message.
struct Place {
  const Place* parent = nullptr;
  std::string key;

  [[nodiscard]] std::string pointer() const;
  /// @throws std::runtime_error  "/pointer: expected ..."
  [[noreturn]] void fail(const std::string& expected) const;
};

/// Rules for a field. required: always written, and an error if absent. optional: omitted if empty.
/// stored: optional, omitted in the form `summary`. store_only: optional, written only in `store`.
enum class Presence { required, optional, stored, store_only };

template <class Struct, class Member>
struct Field {
  const char* key;
  Member Struct::*member;
  Presence presence;
};
/// Field with a default value, which the function `usual` computes from the preceding fields.
template <class Struct, class Member>
struct UsualField {
  const char* key;
  Member Struct::*member;
  Member (*usual)(const Struct& fields_before);
};

/// Declares a field with a rule.
template <Presence presence>
inline constexpr auto declare =
    []<class Struct, class Member>(const char* key, Member Struct::*member) {
      return Field<Struct, Member>{key, member, presence};
    };
inline constexpr auto required = declare<Presence::required>;
/// Declares a field that may be absent from the JSON object. An absent field leaves its member
/// empty, or sets it to the first enumeration value.
inline constexpr auto optional = declare<Presence::optional>;
inline constexpr auto not_in_summary = declare<Presence::stored>;
inline constexpr auto only_in_store = declare<Presence::store_only>;

/// Declares a field that is omitted if it equals the default computed from the preceding fields.
template <class Struct, class Member>
constexpr UsualField<Struct, Member> omitted_if_default(
    const char* key, Member Struct::*member, Member (*value)(const Struct& fields_before)) {
  return {key, member, value};
}

struct None {};
/// Fields of a struct, in the order in which they are written.
template <class Struct>
inline constexpr None kFields{};
/// Names of an enumeration's values, in the order of the enumeration.
template <class Enum>
inline constexpr None kNames{};
#define TRAMMEL_NAMES(Enum, ...) \
  template <>                    \
  inline constexpr std::array kNames<Enum> = {__VA_ARGS__}
/// Member of a struct that becomes the JSON key. A list of such structs is written as a JSON object
/// instead of an array.
template <class Struct>
inline constexpr None kKeyMember{};

/// Declares the fields of a struct, named S in the declarations. TRAMMEL_REQUIRED(name, quantity)
/// declares required fields whose keys are the names of the members.
#define TRAMMEL_FIELDS(Struct, ...)            \
  template <>                                  \
  inline constexpr auto kFields<Struct> = [] { \
    using S = Struct;                          \
    return std::tuple{__VA_ARGS__};            \
  }()
#define TRAMMEL_REQUIRED(...) TRAMMEL_EACH(TRAMMEL_ONE_REQUIRED, __VA_ARGS__)
#define TRAMMEL_OPTIONAL(...) TRAMMEL_EACH(TRAMMEL_ONE_OPTIONAL, __VA_ARGS__)
#define TRAMMEL_STORED(...) TRAMMEL_EACH(TRAMMEL_ONE_STORED, __VA_ARGS__)
#define TRAMMEL_STORE_ONLY(...) TRAMMEL_EACH(TRAMMEL_ONE_STORE_ONLY, __VA_ARGS__)
#define TRAMMEL_EACH(one, ...) \
  BOOST_PP_SEQ_ENUM(BOOST_PP_SEQ_TRANSFORM(one, , BOOST_PP_VARIADIC_TO_SEQ(__VA_ARGS__)))
#define TRAMMEL_ONE_REQUIRED(_, none, member) required(#member, &S::member)
#define TRAMMEL_ONE_OPTIONAL(_, none, member) optional(#member, &S::member)
#define TRAMMEL_ONE_STORED(_, none, member) not_in_summary(#member, &S::member)
#define TRAMMEL_ONE_STORE_ONLY(_, none, member) only_in_store(#member, &S::member)
// NOLINTNEXTLINE(bugprone-macro-parentheses): a member cannot be in parentheses
#define TRAMMEL_KEY(Struct, member) \
  template <>                       \
  inline constexpr auto kKeyMember<Struct> = &Struct::member

namespace detail {

template <class T>
inline constexpr bool has_fields = !std::is_same_v<decltype(kFields<T>), const None>;
template <class T>
inline constexpr bool has_key = !std::is_same_v<decltype(kKeyMember<T>), const None>;
template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
template <class T>
inline constexpr bool is_vector = false;
template <class T>
inline constexpr bool is_vector<std::vector<T>> = true;
template <class T>
inline constexpr bool is_map = false;
template <class T>
inline constexpr bool is_map<std::map<std::string, T>> = true;
using Pair = std::pair<double, double>;
/// True for types whose arrays are written as bytes in the form `store`.
template <class T>
inline constexpr bool is_packed =
    std::is_same_v<T, double> || std::is_same_v<T, Number> || std::is_same_v<T, Pair>;
/// True if T is std::pair<std::string, Value>. A list of such pairs is written as a JSON object,
/// whose keys are the strings.
template <class T>
inline constexpr bool is_named = false;
template <class T>
inline constexpr bool is_named<std::pair<std::string, T>> = true;

template <class T>
bool is_empty(const T& value) {
  if constexpr (is_optional<T> || std::is_same_v<T, Number>) {
    return !value.has_value();
  } else if constexpr (requires { value.empty(); }) {
    return value.empty();
  } else if constexpr (std::is_enum_v<T>) {
    return value == T{};
  } else {
    return false;
  }
}

}  // namespace detail

template <class T>
Json to_json(const T& value, Form form = Form::text);

template <class T>
void from_json(const Json& json, const Place& place, T& value);

template <class T>
T from_json(const Json& json) {
  T value;
  from_json(json, Place{}, value);
  return value;
}

namespace detail {

template <class Struct, class Member>
bool is_omitted_field(const Field<Struct, Member>& field, const std::type_identity_t<Struct>& value,
                      Form form) {
  if (field.presence == Presence::required) return false;
  return (field.presence == Presence::stored && form == Form::summary) ||
         (field.presence == Presence::store_only && form != Form::store) ||
         is_empty(value.*field.member);
}
template <class Struct, class Member>
bool is_omitted_field(const UsualField<Struct, Member>& field,
                      const std::type_identity_t<Struct>& value, Form) {
  return value.*field.member == field.usual(value);
}

template <class Struct, class Member>
void set_default_if_absent(const Field<Struct, Member>& field, const Place& place,
                           std::type_identity_t<Struct>&) {
  if (field.presence == Presence::required) place.fail("a value, found nothing");
}
template <class Struct, class Member>
void set_default_if_absent(const UsualField<Struct, Member>& field, const Place&,
                           std::type_identity_t<Struct>& value) {
  value.*field.member = field.usual(value);
}

template <class T>
Json object_to_json(const T& value, Form form) {
  Json json = Json::object();
  auto& members = json.template get_ref<Json::object_t&>();
  // Reserves memory, because a growing vector copies all its elements.
  members.reserve(std::tuple_size_v<std::decay_t<decltype(kFields<T>)>>);
  const auto write = [&](const auto& field) {
    if (!is_omitted_field(field, value, form))
      members.emplace_back(field.key, to_json(value.*field.member, form));
  };
  std::apply([&](const auto&... fields) { (write(fields), ...); }, kFields<T>);
  return json;
}

template <class T>
void object_from_json(const Json& json, const Place& place, T& value) {
  if (!json.is_object()) place.fail("an object");
  const auto read = [&](const auto& field) {
    const Place member_place{&place, field.key};
    const auto found = json.find(field.key);
    if (found != json.end()) return from_json(*found, member_place, value.*field.member);
    set_default_if_absent(field, member_place, value);
  };
  std::apply([&](const auto&... fields) { (read(fields), ...); }, kFields<T>);
}

constexpr std::size_t kBytes = sizeof(double);

/// Returns the bits of the number two positions before index i. In a list of pairs (x, y), that
/// number is the same coordinate of the previous pair.
inline std::uint64_t bits_two_before(const double* numbers, std::size_t i) {
  return i < 2 ? 0 : std::bit_cast<std::uint64_t>(numbers[i - 2]);
}

/// Returns the differences between the bits of each number and of the number two positions earlier.
/// The lowest bytes of all differences come first, because runs of similar bytes compress best.
template <class Entry>
Json pack(const std::vector<Entry>& values) {
  const auto* const numbers = reinterpret_cast<const double*>(values.data());
  const std::size_t count = values.size() * sizeof(Entry) / kBytes;
  std::vector<std::uint8_t> bytes(count * kBytes);
  for (std::size_t i = 0; i < count; ++i) {
    const auto step = std::bit_cast<std::uint64_t>(numbers[i]) - bits_two_before(numbers, i);
    for (std::size_t b = 0; b < kBytes; ++b)
      bytes[b * count + i] = static_cast<std::uint8_t>(step >> (8 * b));
  }
  // Json::binary() is not used, because it sets the type before it allocates memory. If the
  // allocation failed, the destructor would access a null pointer.
  return Json(Json::binary_t(std::move(bytes)));
}

template <class Entry>
void unpack(const Json& json, const Place& place, std::vector<Entry>& values) {
  const auto& bytes = json.get_binary();
  if (bytes.size() % sizeof(Entry) != 0) place.fail("the bytes of complete numbers");
  values.resize(bytes.size() / sizeof(Entry));
  auto* const numbers = reinterpret_cast<double*>(values.data());
  const std::size_t count = bytes.size() / kBytes;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint64_t bits = bits_two_before(numbers, i);
    for (std::size_t b = 0; b < kBytes; ++b)
      bits += static_cast<std::uint64_t>(bytes[b * count + i]) << (8 * b);
    numbers[i] = std::bit_cast<double>(bits);
  }
}

template <class Entry>
Json list_to_json(const std::vector<Entry>& values, Form form) {
  if constexpr (is_packed<Entry>)
    if (form == Form::store) return pack(values);
  Json json = has_key<Entry> || is_named<Entry> ? Json::object() : Json::array();
  if constexpr (is_named<Entry>) json.template get_ref<Json::object_t&>().reserve(values.size());
  for (const auto& entry : values) {
    if constexpr (is_named<Entry>) {  // json[name] would compare all previous names
      json.template get_ref<Json::object_t&>().emplace_back(entry.first,
                                                            to_json(entry.second, form));
    } else if constexpr (has_key<Entry>) {
      json[entry.*kKeyMember<Entry>] = to_json(entry, form);
    } else {
      json.push_back(to_json<Entry>(entry, form));
    }
  }
  return json;
}

template <class Entry>
void list_from_json(const Json& json, const Place& place, std::vector<Entry>& values) {
  if constexpr (is_packed<Entry>)
    if (json.is_binary()) return unpack(json, place, values);
  constexpr bool is_object = has_key<Entry> || is_named<Entry>;
  if (is_object ? !json.is_object() : !json.is_array())
    place.fail(is_object ? "an object" : "an array");
  values.clear();
  for (const auto& [key, item] : json.items()) {
    Entry entry{};
    const Place entry_place{&place, key};
    if constexpr (is_named<Entry>) {
      entry.first = key;
      from_json(item, entry_place, entry.second);
    } else {
      from_json(item, entry_place, entry);
      if constexpr (has_key<Entry>) entry.*kKeyMember<Entry> = key;
    }
    values.push_back(std::move(entry));
  }
}

template <class Enum>
const char* name_of(Enum value) {
  return kNames<Enum>.at(static_cast<std::size_t>(value));
}

template <class Enum>
void enum_from_json(const Json& json, const Place& place, Enum& value) {
  const auto name = std::ranges::find_if(kNames<Enum>, [&](const char* w) { return json == w; });
  if (name == kNames<Enum>.end())
    place.fail(fmt::format("one of {}", fmt::join(kNames<Enum>, " ")));
  value = static_cast<Enum>(name - kNames<Enum>.begin());
}

/// Reads a pair (x, y) of coordinates. JSON null represents a coordinate that is not finite.
inline void pair_from_json(const Json& json, const Place& place, Pair& value) {
  Numbers numbers;
  if (!json.is_array() || json.size() != 2) place.fail("two numbers");
  list_from_json(json, place, numbers);
  value = {*numbers[0], *numbers[1]};
}

}  // namespace detail

/// Converts a value to JSON. Except in the form `store`, numbers that are not finite become null.
template <class T>
Json to_json(const T& value, Form form) {
  if constexpr (detail::has_fields<T>) {
    return detail::object_to_json(value, form);
  } else if constexpr (detail::is_optional<T>) {
    return value ? to_json(*value, form) : Json(nullptr);
  } else if constexpr (detail::is_vector<T>) {
    return detail::list_to_json(value, form);
  } else if constexpr (detail::is_map<T>) {
    Json json = Json::object();
    for (const auto& [key, entry] : value) json[key] = to_json(entry, form);
    return json;
  } else if constexpr (std::is_same_v<T, detail::Pair>) {
    return Json::array({to_json(value.first, form), to_json(value.second, form)});
  } else if constexpr (std::is_enum_v<T>) {
    return detail::name_of(value);
  } else if constexpr (std::is_same_v<T, Number>) {
    return to_json(*value, form);
  } else if constexpr (std::is_floating_point_v<T>) {
    return std::isfinite(value) || form == Form::store ? Json(value) : Json(nullptr);
  } else {
    return value;
  }
}

/// @throws std::runtime_error  with the JSON pointer of a value that is absent or of a wrong type.
template <class T>
void from_json(const Json& json, const Place& place, T& value) {
  if constexpr (detail::has_fields<T>) {
    detail::object_from_json(json, place, value);
  } else if constexpr (detail::is_optional<T>) {
    value.reset();
    if (!json.is_null()) from_json(json, place, value.emplace());
  } else if constexpr (detail::is_vector<T>) {
    detail::list_from_json(json, place, value);
  } else if constexpr (detail::is_map<T>) {
    if (!json.is_object()) place.fail("an object");
    for (const auto& [key, entry] : json.items()) from_json(entry, Place{&place, key}, value[key]);
  } else if constexpr (std::is_same_v<T, detail::Pair>) {
    detail::pair_from_json(json, place, value);
  } else if constexpr (std::is_enum_v<T>) {
    detail::enum_from_json(json, place, value);
  } else if constexpr (std::is_same_v<T, std::string>) {
    if (!json.is_string()) place.fail("a string");
    value = json.get<std::string>();
  } else if constexpr (std::is_same_v<T, bool>) {
    if (!json.is_boolean()) place.fail("true or false");
    value = json.get<bool>();
  } else if constexpr (std::is_integral_v<T>) {
    if (!json.is_number_integer() || json < 0) place.fail("an integer of at least 0");
    value = json.get<T>();
  } else if constexpr (std::is_same_v<T, Number>) {
    value.reset();
    if (json.is_null()) return;
    if (!json.is_number()) place.fail("a number");
    value = json.get<double>();
  } else {
    static_assert(std::is_same_v<T, double>);
    if (!json.is_number()) place.fail("a number");
    value = json.get<double>();
  }
}

}  // namespace trammel::results

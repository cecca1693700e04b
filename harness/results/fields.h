#pragma once

#include <boost/preprocessor/seq/enum.hpp>
#include <boost/preprocessor/seq/transform.hpp>
#include <boost/preprocessor/variadic/to_seq.hpp>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

/// A struct and its JSON object, both ways, from one list of keys and members:
///
///   TRAMMEL_FIELDS(Pose, required("nodes_m", &S::nodes), TRAMMEL_REQUIRED(label));
namespace trammel::results {

using Json = nlohmann::ordered_json;

/// Where a value stands in a document; its JSON pointer is put together only for a message.
struct Place {
  const Place* parent = nullptr;
  std::string key;

  [[nodiscard]] std::string pointer() const;
  /// @throws std::runtime_error  "/pointer: expected ..."
  [[noreturn]] void fail(const std::string& expected) const;
};

template <class Struct, class Member>
struct Field {
  const char* key;
  Member Struct::*member;
  bool is_required;
};
/// A text that mostly is what `usual` makes of the fields before it.
template <class Struct>
struct UsualField {
  const char* key;
  std::string Struct::*member;
  std::string (*usual)(const Struct& fields_before);
};

/// Always written; an error where it is absent.
template <class Struct, class Member>
constexpr Field<Struct, Member> required(const char* key, Member Struct::*member) {
  return {key, member, true};
}
/// Not written where it is empty, or an enumeration's first value; that where it is absent.
template <class Struct, class Member>
constexpr Field<Struct, Member> optional(const char* key, Member Struct::*member) {
  return {key, member, false};
}

/// Not written where it is what `value` makes of the fields before it; that where it is absent.
template <class Struct>
constexpr UsualField<Struct> usual(const char* key, std::string Struct::*member,
                                   std::string (*value)(const Struct& fields_before)) {
  return {key, member, value};
}

struct None {};
/// The fields of a struct, in the order of the document.
template <class Struct>
inline constexpr None kFields{};
/// The names of an enumeration: an array of pairs (name, value).
template <class Enum>
inline constexpr None kNames{};
/// The member that is the key of a struct where several stand in an object instead of an array.
template <class Struct>
inline constexpr None kKeyMember{};

/// The fields of a struct, which is S among them. Those whose keys are the names of the members:
/// TRAMMEL_REQUIRED(name, quantity).
#define TRAMMEL_FIELDS(Struct, ...)            \
  template <>                                  \
  inline constexpr auto kFields<Struct> = [] { \
    using S = Struct;                          \
    return std::tuple{__VA_ARGS__};            \
  }()
#define TRAMMEL_REQUIRED(...) TRAMMEL_EACH(TRAMMEL_ONE_REQUIRED, __VA_ARGS__)
#define TRAMMEL_OPTIONAL(...) TRAMMEL_EACH(TRAMMEL_ONE_OPTIONAL, __VA_ARGS__)
#define TRAMMEL_EACH(one, ...) \
  BOOST_PP_SEQ_ENUM(BOOST_PP_SEQ_TRANSFORM(one, , BOOST_PP_VARIADIC_TO_SEQ(__VA_ARGS__)))
#define TRAMMEL_ONE_REQUIRED(_, none, member) required(#member, &S::member)
#define TRAMMEL_ONE_OPTIONAL(_, none, member) optional(#member, &S::member)
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
inline constexpr bool is_pair = false;
template <class A, class B>
inline constexpr bool is_pair<std::pair<A, B>> = true;
/// A named value, which is a member of an object.
template <class T>
inline constexpr bool is_named = false;
template <class T>
inline constexpr bool is_named<std::pair<std::string, T>> = true;

template <class T>
bool is_empty(const T& value) {
  if constexpr (is_optional<T>) {
    return !value.has_value();
  } else if constexpr (is_vector<T> || std::is_same_v<T, std::string>) {
    return value.empty();
  } else if constexpr (std::is_enum_v<T>) {
    return value == T{};
  } else {
    return false;
  }
}

}  // namespace detail

template <class T>
Json to_json(const T& value);

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
bool is_left_out(const Field<Struct, Member>& field, const std::type_identity_t<Struct>& value) {
  return !field.is_required && is_empty(value.*field.member);
}
template <class Struct>
bool is_left_out(const UsualField<Struct>& field, const std::type_identity_t<Struct>& value) {
  return value.*field.member == field.usual(value);
}

template <class Struct, class Member>
void give_absent(const Field<Struct, Member>& field, const Place& place,
                 std::type_identity_t<Struct>&) {
  if (field.is_required) place.fail("a value, found nothing");
}
template <class Struct>
void give_absent(const UsualField<Struct>& field, const Place&,
                 std::type_identity_t<Struct>& value) {
  value.*field.member = field.usual(value);
}

template <class T>
Json object_to_json(const T& value) {
  Json json = Json::object();
  auto& members = json.template get_ref<Json::object_t&>();
  members.reserve(std::tuple_size_v<std::decay_t<decltype(kFields<T>)>>);  // growing copies all
  const auto write = [&](const auto& field) {
    if (!is_left_out(field, value)) members.emplace_back(field.key, to_json(value.*field.member));
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
    give_absent(field, member_place, value);
  };
  std::apply([&](const auto&... fields) { (read(fields), ...); }, kFields<T>);
}

template <class Entry>
Json list_to_json(const std::vector<Entry>& values) {
  Json json = has_key<Entry> || is_named<Entry> ? Json::object() : Json::array();
  if constexpr (is_named<Entry>) json.template get_ref<Json::object_t&>().reserve(values.size());
  for (const auto& entry : values) {
    if constexpr (is_named<Entry>) {  // at the end, for json[name] would look through all before it
      json.template get_ref<Json::object_t&>().emplace_back(entry.first, to_json(entry.second));
    } else if constexpr (has_key<Entry>) {
      json[entry.*kKeyMember<Entry>] = to_json(entry);
    } else {
      json.push_back(to_json<Entry>(entry));
    }
  }
  return json;
}

template <class Entry>
void list_from_json(const Json& json, const Place& place, std::vector<Entry>& values) {
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
  for (const auto& [name, known] : kNames<Enum>)
    if (known == value) return name;
  throw std::logic_error("a value without a name");
}

template <class Enum>
void enum_from_json(const Json& json, const Place& place, Enum& value) {
  std::string expected = "one of";
  for (const auto& [name, known] : kNames<Enum>) {
    if (json == name) {
      value = known;
      return;
    }
    expected += std::string(" ") + name;
  }
  place.fail(expected);
}

/// (x, y); a coordinate that is not a number is null.
template <class A, class B>
void pair_from_json(const Json& json, const Place& place, std::pair<A, B>& value) {
  if (!json.is_array() || json.size() != 2) place.fail("two numbers");
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::optional<double>> numbers;
  list_from_json(json, place, numbers);
  value = {numbers[0].value_or(kNaN), numbers[1].value_or(kNaN)};
}

}  // namespace detail

/// null for a number that is not finite.
template <class T>
Json to_json(const T& value) {
  if constexpr (detail::has_fields<T>) {
    return detail::object_to_json(value);
  } else if constexpr (detail::is_optional<T>) {
    return value ? to_json(*value) : Json(nullptr);
  } else if constexpr (detail::is_vector<T>) {
    return detail::list_to_json(value);
  } else if constexpr (detail::is_pair<T>) {
    return Json::array({to_json(value.first), to_json(value.second)});
  } else if constexpr (std::is_enum_v<T>) {
    return detail::name_of(value);
  } else if constexpr (std::is_floating_point_v<T>) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
  } else {
    return value;
  }
}

/// @throws std::runtime_error  with the pointer of what is absent or of a wrong type.
template <class T>
void from_json(const Json& json, const Place& place, T& value) {
  if constexpr (detail::has_fields<T>) {
    detail::object_from_json(json, place, value);
  } else if constexpr (detail::is_optional<T>) {
    value.reset();
    if (!json.is_null()) from_json(json, place, value.emplace());
  } else if constexpr (detail::is_vector<T>) {
    detail::list_from_json(json, place, value);
  } else if constexpr (detail::is_pair<T>) {
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
  } else {
    static_assert(std::is_same_v<T, double>);
    if (!json.is_number()) place.fail("a number");
    value = json.get<double>();
  }
}

}  // namespace trammel::results

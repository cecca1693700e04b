#include "harness/input/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "harness/base/find_or_add.h"
#include "harness/base/text.h"

namespace trammel::harness {
namespace {

constexpr std::array<std::string_view, 4> kMeasures = {"relative", "absolute", "ratio", "value"};
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

void require_variant(const JsonView& place, const std::vector<std::string>& variants) {
  const auto name = place.get<std::string>();
  if (contains(variants, name)) return;
  throw place.error(unknown_name_message("a variant of the case", name, variants));
}

/// Returns the only one of the alternative `keys` that the JSON object contains. Rejects an object
/// that contains none or several of the keys.
std::string find_only_alternative_key(const JsonView& place, const std::vector<std::string>& keys) {
  std::string found;
  int count = 0;
  for (const std::string& key : keys) {
    if (!place.has(key)) continue;
    found = key;
    ++count;
  }
  if (count == 1) return found;
  std::vector<std::string> quoted;
  for (const std::string& key : keys) quoted.push_back("'" + key + "'");
  throw place.error("expected exactly one of the keys " + join(quoted, "and") + " (got " +
                    std::to_string(count) + " of them)");
}

void read_tolerance(const JsonView& place, Check& check) {
  const bool relative = place.has("relative");  // the schema requires 'relative' or 'absolute'
  const double limit = place.number(relative ? "relative" : "absolute");
  check.measure = relative ? Measure::relative : Measure::absolute;
  check.windows = {{-limit, limit}};
  check.symmetric = true;
  check.why = place.text("why");
}

void read_bound(const JsonView& place, Check& check) {
  if (!place.has("at_most") && !place.has("at_least"))
    throw place.error("a bound requires 'at_most', 'at_least' or both (got neither)");
  check.measure = Measure::value;
  check.windows = {{place.get("at_least", -kUnlimited), place.get("at_most", kUnlimited)}};
  if (check.windows[0].low > check.windows[0].high)
    throw place.error("'at_least' is larger than 'at_most'; expected a non-empty interval");
  check.why = place.text("why");
}

/// Returns the keys that a sweep of the case states for one quantity, such as the theoretical order
/// of convergence.
Json sweep_keys_of_quantity(const Json& sweep, const std::string& quantity) {
  return sweep.value("quantities", Json::object()).value(quantity, Json::object());
}

OrderCriterion read_order_check(const JsonView& place, const std::string& quantity,
                                const Json& document) {
  OrderCriterion order;
  order.sweep = place.text("sweep");
  const Json sweeps = document.value("sweeps", Json::object());
  if (!sweeps.contains(order.sweep)) {
    std::vector<std::string> names;
    for (const auto& item : sweeps.items()) names.push_back(item.key());
    throw place["sweep"].error(unknown_name_message("a sweep of the case", order.sweep, names));
  }
  const Json& sweep = sweeps.at(order.sweep);
  const Json own = sweep_keys_of_quantity(sweep, quantity);
  if (!sweep.contains("theory_order") && !own.contains("theory_order"))
    throw place["sweep"].error(
        "an 'order' check requires a sweep with the key 'theory_order' (this sweep has none)");
  order.of_errors = own.value("is_error", false);
  if (find_only_alternative_key(place, {"within", "two_term_within"}) == "within") {
    order.within = place.number("within");
  } else {
    order.two_term_within = place.number("two_term_within");
    if (!sweep.contains("lower_order"))
      throw place["sweep"].error(
          "'two_term_within' requires a sweep with the key 'lower_order' (this sweep has none)");
  }
  order.meshes = place.get("min_meshes", std::size_t{3});
  if (const auto wave = place.find("wave_number"))
    order.wave_number = {wave->text("reference"), wave->indices("reference_index"),
                         wave->number("at_most"), wave->pointer()};
  if (const auto term = place.find("leading_term")) {
    if (!order.wave_number) throw term->error("'leading_term' requires the key 'wave_number'");
    order.leading_term = {term->number("coefficient"), term->number("within"),
                          term->get<std::string>("share", ""), term->pointer()};
  }
  if (place.has("richardson_within")) order.richardson_within = place.number("richardson_within");
  return order;
}

/// Rejects a known discrepancy if the allowed intervals of all entries contain zero, because an
/// agreement would then not be detected.
void require_discrepancy(const JsonView& place, const Check& check) {
  const bool is_difference =
      check.measure == Measure::relative || check.measure == Measure::absolute;
  if (!is_difference || check.expectation != Expectation::known_discrepancy) return;
  const bool everywhere =
      std::ranges::all_of(check.windows, [](const Window& window) { return window.contains(0); });
  if (everywhere)
    throw place.error(
        "expected a range without 0 for a known discrepancy: if the range contains 0, "
        "agreement cannot be detected");
}

/// Removes round-off from a sum of decimal numbers: 0.033 for 0.038 - 0.005.
double decimal(double sum) {
  return std::isfinite(sum) ? std::strtod(rounded(sum, 15).c_str(), nullptr) : sum;
}

/// Returns the allowed intervals [v - w, v + w] for the stated values v and one half width w.
std::vector<Window> windows_around_values(const JsonView& values, double half_width) {
  std::vector<Window> windows;
  const auto add = [&](double value) {
    windows.push_back({decimal(value - half_width), decimal(value + half_width)});
  };
  if (values.json().is_array()) {
    for (const auto& entry : values.entries()) add(entry.second.get<double>());
  } else {
    add(values.get<double>());
  }
  return windows;
}

std::vector<Window> read_windows(const JsonView& place) {
  if (!place[0].json().is_array()) return {read_window(place)};
  std::vector<Window> windows;
  for (const auto& entry : place.entries()) windows.push_back(read_window(entry.second));
  return windows;
}

void read_expectation(const JsonView& place, Check& check) {
  const std::string kind = find_only_alternative_key(place, {"agrees", "known_discrepancy"});
  check.expectation = kind == "agrees" ? Expectation::agrees : Expectation::known_discrepancy;
  check.why = place.text(kind);
  const std::string key = find_only_alternative_key(
      place, {"relative", "absolute", "ratio", "value", "relative_between", "absolute_between",
              "ratio_between", "value_between"});
  const std::string measure = key.substr(0, key.find('_'));
  const bool is_value = measure == key;
  if (is_value != place.has("within"))
    throw place.error(is_value ? "'" + key + "' requires 'within', the half width of the range"
                               : "'within' requires '" + measure + "' (got '" + key + "')");
  check.measure = static_cast<Measure>(std::ranges::find(kMeasures, measure) - kMeasures.begin());
  check.windows = is_value ? windows_around_values(place[key], place.number("within"))
                           : read_windows(place[key]);
  require_discrepancy(place[key], check);
  if (place.has("validation_verdicts"))
    place["validation_verdicts"].json().get_to(check.validation_verdicts);
}

void require_target(const JsonView& place, const Check& check) {
  const int targets = (check.reference.empty() ? 0 : 1) +
                      (check.against_variant.empty() && check.against_quantity.empty() ? 0 : 1);
  if (targets > 1)
    throw place.error("'reference' excludes 'against_variant' and 'against_quantity' (got both)");
  if (check.against_quantity == check.quantity && check.against_variant.empty())
    throw place["against_quantity"].error(
        "a quantity cannot be compared with itself; expected another quantity");
  if (!check.reference_index.empty() && check.reference.empty())
    throw place["reference_index"].error("'reference_index' requires 'reference' (got none)");
  const bool of_errors = check.order && check.order->of_errors;
  const bool needs = !of_errors && (check.order || check.measure != Measure::value);
  if (needs && targets == 0)
    throw place.error(
        "the check has no value to compare with: it requires 'reference', 'against_variant' or "
        "'against_quantity'");
  if (!needs && targets > 0)
    throw place.error("expected no 'reference', 'against_variant' or 'against_quantity': " +
                      std::string(of_errors ? "the quantity is itself an error"
                                            : "a bound limits the value itself"));
  if (check.order && !of_errors && check.reference.empty())
    throw place.error("'order' requires 'reference', a reference with the exact values");
}

/// Reads the criterion of a check: "expect" for a validation, else "tolerance", "bound" or "order".
void read_criterion(const JsonView& place, const Document& document, Check& check) {
  if (check.role == Role::validation) {
    for (const char* key : {"tolerance", "bound", "order"}) {
      if (place.has(key))
        throw place[key].error(
            "a check of role validation does not use this key; expected the key 'expect' "
            "with the expected verdict");
    }
    check.expectation = Expectation::none;
    if (place.has("expect")) read_expectation(place["expect"], check);
    return;
  }
  if (place.has("expect"))
    throw place["expect"].error("'expect' requires the role 'validation' (got another role)");
  const std::string key = find_only_alternative_key(place, {"tolerance", "bound", "order"});
  if (key == "tolerance") read_tolerance(place[key], check);
  if (key == "bound") read_bound(place[key], check);
  if (key == "order") {
    check.order = read_order_check(place[key], check.quantity, document.value());
    check.why = place[key].text("why");
  }
}

Check read_check(const std::string& name, const JsonView& place, const Document& document) {
  Check check;
  check.name = name;
  check.pointer = place.pointer();
  check.title = place.get<std::string>("title", "");
  check.quantity = place.text("quantity");
  check.index = place.indices("index");
  check.statistic = place.get<std::string>("statistic", "");
  check.reference = place.get<std::string>("reference", "");
  check.reference_index = place.indices("reference_index");
  check.against_variant = place.get<std::string>("against_variant", "");
  check.against_quantity = place.get<std::string>("against_quantity", "");
  check.role = place["role"].get<Role>();
  read_criterion(place, document, check);
  require_target(place, check);
  if (const auto control = place.find("negative_control")) {
    check.negative_control = {control->text("verdict"), control->text("message"), std::nullopt};
    if (const auto index = control->find("index"))
      check.negative_control->index = index->get<std::size_t>();
    check.why = control->text("why");
  }
  // The description of a variant is part of the reason for each of its known discrepancies.
  const auto variant_text = JsonView(document).get<std::string>("description", "");
  if (check.expectation == Expectation::known_discrepancy && !variant_text.empty())
    check.why = variant_text + " " + check.why;
  return check;
}

bool applies(const JsonView& place, const std::string& variant,
             const std::vector<std::string>& variants) {
  if (place.has("against_variant")) {
    require_variant(place["against_variant"], variants);
    const auto quantity = place.text("quantity");
    if (place.text("against_variant") == variant &&
        place.get("against_quantity", quantity) == quantity) {
      if (variants.size() == 1)
        throw place["against_variant"].error(
            "the case has no other variant to compare with; expected a case with variants");
      return false;
    }
  }
  if (!place.has("variants")) return true;
  bool named = false;
  for (const auto& entry : place["variants"].entries()) {
    require_variant(entry.second, variants);
    named = named || entry.second.get<std::string>() == variant;
  }
  return named;
}

}  // namespace

Window read_window(const JsonView& place) {
  const auto limit = [&](std::size_t side, double open) {
    return place[side].json().is_null() ? open : place[side].get<double>();
  };
  const Window window{limit(0, -kUnlimited), limit(1, kUnlimited)};
  if (place[0].json().is_null() && place[1].json().is_null())
    throw place.error("expected at least one limit that is a number (got two nulls)");
  if (window.low > window.high)
    throw place.error("expected the lower limit first (got " + shortest_decimal(window.low) + ", " +
                      shortest_decimal(window.high) + ")");
  return window;
}

std::vector<Check> read_checks(const Document& document, const std::string& variant,
                               const std::vector<std::string>& variants) {
  std::vector<Check> checks;
  for (const auto& [name, place] : JsonView(document).entries("checks"))
    if (applies(place, variant, variants)) checks.push_back(read_check(name, place, document));
  return checks;
}

const char* to_string(Role role) {
  return kWords<Role>[static_cast<std::size_t>(role)];
}

const char* to_string(Measure measure) {
  return measure == Measure::value ? "bound" : kMeasures[static_cast<std::size_t>(measure)].data();
}

}  // namespace trammel::harness

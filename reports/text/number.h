#pragma once

#include <string>
#include <vector>

#include "harness/base/number.h"
#include "harness/base/text.h"

namespace trammel::reports {

// Numbers as text for pages, with a typographic minus sign, powers of ten as 10⁻⁷, and significant
// digits only. Numbers in CSV files have full precision (`shortest_decimal`).

[[nodiscard]] inline bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

/// Returns a number with `digits` significant digits and trailing zeros. The notation is scientific
/// below 1e-4 and from 1e6.
[[nodiscard]] std::string rounded_text(double x, int digits);

/// Returns a number with at most `digits` digits and no trailing zeros: 0.002, not 0.002000.
[[nodiscard]] std::string trimmed(double x, int digits);

/// Returns the number like the function `trimmed`, but with its sign: +0.31, −4.2 × 10⁻⁹.
[[nodiscard]] std::string number_with_sign(double x, int digits);

/// Returns a relative difference as a percentage; a magnitude below 1e-5 as a plain number.
[[nodiscard]] std::string percent_text(double x, int digits, bool sign);

/// Returns the number of significant digits, from 4 to 10, that show the difference of two numbers.
/// Returns 6 if the numbers agree in more than 10 digits.
[[nodiscard]] int distinguishing_digits(double a, double b);

/// Number of significant digits of the points of curves in figures. The rounding error is smaller
/// than a pixel.
inline constexpr int kSampleDigits = 7;

using harness::shortest_decimal;

/// Returns the number with at most `digits` significant digits.
[[nodiscard]] std::string shortest_decimal(double x, int digits);

/// Returns ten with an exponent in superscript digits, such as "10⁻⁷".
[[nodiscard]] std::string power_of_ten(int exponent);

/// Replaces numbers such as 1e-6 and 2.1e-09 in a text by 10⁻⁶ and 2.1 × 10⁻⁹.
[[nodiscard]] std::string with_powers_of_ten(const std::string& text);

/// Returns a number with its noun in singular or plural: "1 check" or "3 checks".
[[nodiscard]] std::string count(std::size_t n, const std::string& singular,
                                const std::string& plural = "");

/// Returns a time in a suitable unit: 840 µs, 12 ms, 3.4 s, 2 min 5 s.
[[nodiscard]] std::string duration(double seconds);

/// Returns a length as "8.1 mm" or "1.25 m": in meters from 0.2 m upward, as on axes.
[[nodiscard]] std::string length_text(double length_m);

/// Returns the number, or a dash if it is missing.
[[nodiscard]] std::string text_or_dash(harness::Number x, int digits);

/// Replaces hyphens and underscores by spaces.
[[nodiscard]] std::string replace_separators(std::string name);

[[nodiscard]] std::string capitalized(std::string text);

/// Returns a range as text: "3.9 to 4.1", or "4" if both limits are equal.
[[nodiscard]] std::string limits_text(const std::string& low, const std::string& high);

/// Appends an item to a list, after a separator unless it is the first item.
void add_item(std::string& list, const std::string& item, const std::string& separator = ", ");

/// Splits a text at spaces, for the column headings of tables.
[[nodiscard]] std::vector<std::string> words_in(const std::string& text);

}  // namespace trammel::reports

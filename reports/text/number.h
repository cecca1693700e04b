#pragma once

#include <string>
#include <vector>

#include "harness/base/number.h"

namespace trammel::reports {

/// Numbers for people: a real minus sign, powers of ten as 10⁻⁷, no more digits than say something.
/// Full precision is for the CSV files (`shortest`).

/// Neither a printed character nor a space; every byte of a longer UTF-8 character is none.
[[nodiscard]] inline bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

/// `digits` significant digits, zeros at the end kept; scientific outside 1e-4 ... 1e6.
[[nodiscard]] std::string significant(double x, int digits);

/// The same with zeros at the end dropped: 0.002, not 0.002000.
[[nodiscard]] std::string trimmed(double x, int digits);

/// With a sign always: +0.31, −4.2 × 10⁻⁹.
[[nodiscard]] std::string with_sign(double x, int digits);

/// A relative difference: in per cent from 1e-5 upwards, as a plain number below.
[[nodiscard]] std::string relative(double x, int digits, bool sign);

/// Digits that show where two numbers part, between 4 and 10; 6 where they agree beyond that.
[[nodiscard]] int distinguishing_digits(double a, double b);

/// Significant digits of samples that are drawn, finer than any pixel; the store of runs has all.
inline constexpr int kSampleDigits = 7;

/// The shortest text that reads back as the same double, independent of the locale.
[[nodiscard]] std::string shortest(double x);

/// The same with at most `digits` significant digits.
[[nodiscard]] std::string shortest(double x, int digits);

/// 10⁻⁷.
[[nodiscard]] std::string power_of_ten(int exponent);

/// A text whose numbers written as 1e-6 and 2.1e-09 are 10⁻⁶ and 2.1 × 10⁻⁹.
[[nodiscard]] std::string with_powers(const std::string& text);

/// "1 check", "3 checks".
[[nodiscard]] std::string count(std::size_t n, const std::string& singular,
                                const std::string& plural = "");

/// Seconds as people say them: 840 µs, 12 ms, 3.4 s, 2 min 5 s.
[[nodiscard]] std::string duration(double seconds);

/// 8.1 mm, 1.25 m: metres from 0.2 m up, as on axes.
[[nodiscard]] std::string length_text(double metres);

/// An em dash for what is not there.
[[nodiscard]] std::string or_dash(harness::Number x, int digits);

/// "axial-flexibility" and "mean_square" as words with blanks between them.
[[nodiscard]] std::string spaced(std::string name);

[[nodiscard]] std::string capitalized(std::string text);

/// "3.9 to 4.1", or "4" where both ends read alike.
[[nodiscard]] std::string low_to_high(const std::string& low, const std::string& high);

/// Adds to a list in words: after a separator, but for the first item.
void add_item(std::string& list, const std::string& item, const std::string& separator = ", ");

/// What stands between blanks: heads of a table's columns.
[[nodiscard]] std::vector<std::string> words_in(const std::string& text);

}  // namespace trammel::reports

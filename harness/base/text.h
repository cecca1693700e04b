#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Small words for messages.
namespace trammel::harness {

/// The candidate that a misspelt word most likely meant; empty when none is near.
[[nodiscard]] std::string nearest(const std::string& word,
                                  const std::vector<std::string>& candidates);

/// "; did you mean 'x'?", or nothing when no candidate is near.
[[nodiscard]] std::string did_you_mean(const std::string& word,
                                       const std::vector<std::string>& candidates);

/// "expected X (got 'name'); did you mean 'y'?"
[[nodiscard]] std::string unknown_name(const std::string& expected, const std::string& name,
                                       const std::vector<std::string>& candidates);

/// "'word'"
[[nodiscard]] std::string quoted(const std::string& word);

/// A word that a shell reads as it stands.
[[nodiscard]] std::string shell_quoted(const std::string& word);

/// "a, b or c"
[[nodiscard]] std::string join(const std::vector<std::string>& items, const std::string& last);

/// The shortest decimal that reads back the same double.
[[nodiscard]] std::string shortest(double value);

/// "%.*g" of a number; "-" where it is not finite.
[[nodiscard]] std::string rounded(double value, int digits = 6);

/// "12.3 %" of 0.123
[[nodiscard]] std::string percent(double share);

/// Bytes that a terminal or a line cannot hold become '?', long text is cut.
[[nodiscard]] std::string printable(std::string text, std::size_t length = 60);

/// A message as one line: control characters as JSON escapes, words beyond 120 bytes cut.
[[nodiscard]] std::string one_line(const std::string& text);

/// The text of a file that is built into the program, by its name. @throws std::logic_error  if
/// there is no such file.
[[nodiscard]] const std::string& embedded_text(const std::string& file);

}  // namespace trammel::harness

#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace trammel::harness {

/// Returns the candidate closest to a misspelled word; empty if no candidate is similar.
[[nodiscard]] std::string nearest_word(const std::string& word,
                                       const std::vector<std::string>& candidates);

/// Returns "; did you mean 'x'?" with the closest candidate, or an empty string if no candidate is
/// similar.
[[nodiscard]] std::string did_you_mean(const std::string& word,
                                       const std::vector<std::string>& candidates);

/// Returns the message for an unknown name: "expected X (got 'name'); did you mean 'y'?".
[[nodiscard]] std::string unknown_name_message(const std::string& expected, const std::string& name,
                                               const std::vector<std::string>& candidates);

[[nodiscard]] std::string quoted(const std::string& word);

/// Returns a word quoted so that a shell reads it unchanged.
[[nodiscard]] std::string shell_quoted(const std::string& word);

/// Returns items as a list in a sentence: "a, b or c", where `and_or` is "or".
[[nodiscard]] std::string join(const std::vector<std::string>& items, const std::string& and_or);

/// Returns the shortest decimal number that is read back as the same double.
[[nodiscard]] std::string shortest_decimal(double value);

/// Formats a number with "%.*g"; returns "-" if the number is not finite.
[[nodiscard]] std::string rounded(double value, int digits = 6);

/// Formats a fraction as a percentage: "12.3 %" for 0.123.
[[nodiscard]] std::string percent(double share);

/// Replaces control characters and non-ASCII bytes of a text by '?' and truncates long text.
[[nodiscard]] std::string printable(std::string text, std::size_t length = 60);

/// Formats a message as one line: control characters become JSON escapes, and words longer than 120
/// bytes are truncated.
[[nodiscard]] std::string one_line(const std::string& text);

/// Returns the text of a file that is embedded in the program.
/// @throws std::logic_error  if no embedded file has this name.
[[nodiscard]] const std::string& embedded_text(const std::string& file);

}  // namespace trammel::harness

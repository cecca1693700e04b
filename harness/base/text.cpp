#include "harness/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "harness/base/find_or_add.h"

namespace trammel::harness {

namespace {

/// Returns the edit distance of two words: number of inserted, deleted, replaced and swapped
/// adjacent letters.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = std::exchange(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + change});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

}  // namespace

std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates) {
  if (word.size() > 200) return {};
  // Users often write "entries" or "entry" for the key "index".
  if ((word == "entries" || word == "entry") && contains(candidates, std::string("index")))
    return "index";
  std::string best;
  // A suggestion is not helpful if it changes more than two letters and more than two fifths of the
  // word.
  std::size_t least = std::max<std::size_t>(2, word.size() * 2 / 5) + 1;
  for (const std::string& candidate : candidates) {
    std::size_t distance = edit_distance(word, candidate);
    const bool contained = word.size() >= 3 && candidate.find(word) != std::string::npos;
    if (contained) distance = std::min<std::size_t>(distance, 2);
    if (candidate.starts_with(word + "_")) distance = 1;  // the word lacks only the unit of a key
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string best = nearest_word(word, candidates);
  return best.empty() ? "" : "; did you mean '" + best + "'?";
}

std::string unknown_name_message(const std::string& expected, const std::string& name,
                                 const std::vector<std::string>& candidates) {
  const std::string near = did_you_mean(name, candidates), all = join(candidates, "or");
  return "expected " + expected + " (got '" + printable(name) + "')" +  // lists all names if few
         (near.empty() && !all.empty() && all.size() <= 160 ? "; expected " + all : near);
}

std::string quoted(const std::string& word) {
  return std::string("'").append(word).append("'");
}

std::string shell_quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

std::string join(const std::vector<std::string>& items, const std::string& and_or) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) text += i + 1 == items.size() ? " " + and_or + " " : ", ";
    text += items[i];
  }
  return text;
}

std::string shortest_decimal(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0 ? "infinity" : "-infinity";
  char buffer[32];
  const auto result = std::to_chars(std::begin(buffer), std::end(buffer), value);
  return {std::begin(buffer), result.ptr};
}

std::string rounded(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  return fmt::format("{:.{}g}", value + 0.0, digits);  // "0" for -0
}

std::string percent(double share) {
  return rounded(100 * share, 3) + " %";
}

std::string printable(std::string text, std::size_t length) {
  if (text.size() > length) text = text.substr(0, length - 3) + "...";
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 32 || c >= 127; }, '?');
  return text;
}

std::string one_line(const std::string& text) {
  constexpr std::size_t kMaxWord = 120;
  std::string out;
  std::size_t word = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool continues = (byte & 0xC0U) == 0x80U;  // part of a multi-byte character
    word = c == ' ' || c == '/' ? 0 : word + 1;
    if (word == kMaxWord) out += "...";
    if (word >= kMaxWord && !(continues && word == kMaxWord)) continue;
    out += byte < 0x20 || byte == 0x7f ? fmt::format("\\u{:04x}", byte) : std::string(1, c);
  }
  return out;
}

}  // namespace trammel::harness

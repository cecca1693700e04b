#include "harness/base/one_line.h"

#include <fmt/format.h>

namespace trammel::harness {

std::string one_line(const std::string& text) {
  constexpr std::size_t kMaxWord = 120;
  std::string out;
  std::size_t word = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool continues = (byte & 0xC0U) == 0x80U;  // a character of several bytes
    word = c == ' ' || c == '/' ? 0 : word + 1;
    if (word == kMaxWord) out += "...";
    if (word >= kMaxWord && !(continues && word == kMaxWord)) continue;
    out += byte < 0x20 || byte == 0x7f ? fmt::format("\\u{:04x}", byte) : std::string(1, c);
  }
  return out;
}

}  // namespace trammel::harness

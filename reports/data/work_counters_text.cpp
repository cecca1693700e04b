#include "reports/data/check_text.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

/// 1 240 000 with thin spaces.
std::string grouped(std::size_t n) {
  const std::string digits = std::to_string(n);
  std::string out;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) out += "\u202f";
    out += digits[i];
  }
  return out;
}

}  // namespace

std::string work_counters_text(const Counters& counters) {
  std::string text;
  for (const auto& [name, n] : counters) {
    if (n == 0 && name == "steps") continue;  // most computations have none
    add_item(text, grouped(n) + " " + spaced(name));
  }
  return text;
}

}  // namespace trammel::reports

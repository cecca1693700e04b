#include <algorithm>
#include <iterator>
#include <sstream>

#include "reports/text/number.h"

namespace trammel::reports {

std::string spaced(std::string name) {
  std::ranges::replace_if(
      name, [](char c) { return c == '-' || c == '_'; }, ' ');
  return name;
}

std::string capitalized(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] -= 'a' - 'A';
  return text;
}

std::string low_to_high(const std::string& low, const std::string& high) {
  return low == high ? low : low + " to " + high;
}

void add_item(std::string& list, const std::string& item, const std::string& separator) {
  list += (list.empty() ? "" : separator) + item;
}

std::vector<std::string> words_in(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

}  // namespace trammel::reports

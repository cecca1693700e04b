#include "harness/base/diagnostic.h"

namespace trammel::harness {

bool is_diagnostic(const std::string& name) {
  const std::string head = name.substr(0, name.find(':'));
  return head.find("roundoff") != std::string::npos || head.find("residual") != std::string::npos;
}

}  // namespace trammel::harness

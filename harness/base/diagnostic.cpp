#include "harness/base/diagnostic.h"

namespace trammel::harness {

bool is_diagnostic(const std::string& name) {
  const std::string head = name.substr(0, name.find(':'));
  return head.find("roundoff") != std::string::npos || head.find("residual") != std::string::npos ||
         head.rfind("constraint_gap", 0) == 0;
}

}  // namespace trammel::harness

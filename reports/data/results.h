#pragma once

#include "harness/results/results.h"

namespace trammel::reports {

using namespace results;

}  // namespace trammel::reports

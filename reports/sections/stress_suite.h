#pragma once

#include <vector>

#include "reports/figures/gallery.h"
#include "reports/text/html.h"

namespace trammel::reports {

/// The stress suite: items in order, each indicator with its worst value, bound, reason and
/// verdict, and links to the pictures; empty where no case belongs to it.
[[nodiscard]] Data stress_suite_section(const std::vector<Family>& families);

}  // namespace trammel::reports

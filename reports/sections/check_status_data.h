#pragma once

#include <initializer_list>
#include <string>

#include "reports/data/check_status.h"
#include "reports/text/html.h"

namespace trammel::reports {

/// With text, class name and sign of a status: keys status_text, status_class, sign.
[[nodiscard]] Data with_status(CheckStatus status, std::initializer_list<Entry> entries = {});

/// Counts as a list of {n, status_text, status_class, sign, percent} without the zeros.
[[nodiscard]] Data counts_list(const Counts& counts);

/// Where a page and a place on it stand, seen from the folder of the report.
[[nodiscard]] std::string case_link(const std::string& id);
[[nodiscard]] std::string case_anchor(const std::string& id);  ///< where one file holds all
[[nodiscard]] std::string family_link(const std::string& id);
[[nodiscard]] std::string reference_link(const std::string& id);

}  // namespace trammel::reports

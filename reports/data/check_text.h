#pragma once

#include <string>

#include "reports/data/check_status.h"
#include "reports/data/results.h"

namespace trammel::reports {

/// A check in the words and digits of a table's cells.

[[nodiscard]] std::string target_text(const Check& check);
[[nodiscard]] std::string computed_text(const Check& check);
[[nodiscard]] std::string difference_text(const Check& check);
[[nodiscard]] std::string tolerance_text(const Check& check);

/// A difference of this check's measure: +26 %, −3 × 10⁻⁸ N, ratio 1.02.
[[nodiscard]] std::string difference_text(const Check& check, double difference);

/// What the case calls the check, else its name.
[[nodiscard]] std::string check_title(const Check& check);

/// "frequency (Hz)", "largest |x displacement of P| (m), over rigid-platform".
[[nodiscard]] std::string quantity_text(const Check& check);

/// "mode 3", "point 37", "2"; empty without an index.
[[nodiscard]] std::string entry_text(const Check& check, std::size_t entries);

/// One line that says what went wrong with a group: how many, and the worst.
[[nodiscard]] std::string failure_text(const CheckGroup& group);

}  // namespace trammel::reports

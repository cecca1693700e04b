#include "harness/results/side_comparison.h"

#include "harness/results/fields.h"

namespace trammel::results {

TRAMMEL_FIELDS(ComparedNumber,
               TRAMMEL_REQUIRED(quantity, index, entries, values, percent, noise, share, changed));
TRAMMEL_FIELDS(ComparedModes,
               TRAMMEL_REQUIRED(modes, values, last, percent, alike, noise, share, changed));
TRAMMEL_FIELDS(ComparedRun, TRAMMEL_REQUIRED(name, changed, share, numbers),
               TRAMMEL_OPTIONAL(modes, remarks));
TRAMMEL_FIELDS(ComparedSide,
               TRAMMEL_REQUIRED(label, runs, cpu_s, relative_time, work, median_error,
                                largest_error, error_ratio, rank),
               TRAMMEL_OPTIONAL(commit, date, processor, solver));
TRAMMEL_FIELDS(SideComparison,
               TRAMMEL_REQUIRED(conclusion, sides, same, within_noise, changed, runs));

Json to_json(const SideComparison& comparison) {
  return to_json<SideComparison>(comparison);
}

}  // namespace trammel::results

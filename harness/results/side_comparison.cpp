#include "harness/results/side_comparison.h"

#include "harness/results/fields.h"

namespace trammel::results {

template <>
inline constexpr auto kFields<ComparedNumber> = std::tuple{TRAMMEL_REQUIRED(
    ComparedNumber, quantity, index, entries, values, percent, noise, share, changed)};
template <>
inline constexpr auto kFields<ComparedModes> = std::tuple{
    TRAMMEL_REQUIRED(ComparedModes, modes, values, last, percent, alike, noise, share, changed)};
template <>
inline constexpr auto kFields<ComparedRun> =
    std::tuple{TRAMMEL_REQUIRED(ComparedRun, name, changed, share, numbers),
               TRAMMEL_OPTIONAL(ComparedRun, modes, remarks)};
template <>
inline constexpr auto kFields<ComparedSide> =
    std::tuple{TRAMMEL_REQUIRED(ComparedSide, label, runs, cpu_s, relative_time, work, median_error,
                                largest_error, error_ratio, rank),
               TRAMMEL_OPTIONAL(ComparedSide, commit, date, processor, solver)};
template <>
inline constexpr auto kFields<SideComparison> = std::tuple{
    TRAMMEL_REQUIRED(SideComparison, conclusion, sides, same, within_noise, changed, runs)};

Json to_json(const SideComparison& comparison) {
  return to_json<SideComparison>(comparison);
}

}  // namespace trammel::results

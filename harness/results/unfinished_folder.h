#pragma once

namespace trammel::results {

/// Below the folder of --out: where a report is written before it takes the former one's place.
inline constexpr const char* kUnfinishedFolder = ".trammel-unfinished";

}  // namespace trammel::results

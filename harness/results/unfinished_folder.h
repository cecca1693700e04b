#pragma once

namespace trammel::results {

/// Folder below --out in which a report is written before it replaces the previous one.
inline constexpr const char* kUnfinishedFolder = ".trammel-unfinished";

}  // namespace trammel::results

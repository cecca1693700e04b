#pragma once

#include <string>

namespace trammel::harness {

/// What calls kept in a history came to, what changed since the last green one, and slow drifts.
/// @returns the exit status: 1 where the newest call has failures
int history_command(const std::string& file, bool json);

}  // namespace trammel::harness

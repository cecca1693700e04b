#pragma once

namespace trammel::testing {

/// Runs the program, kills it at random times with KILL, INT and TERM, resumes it each time, and
/// compares with an uninterrupted call.
void interrupt_and_resume(int kills, unsigned seed);

}  // namespace trammel::testing

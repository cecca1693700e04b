#pragma once

namespace trammel::testing {

/// Kills runs at random times with KILL, INT and TERM, resumes each of them, and compares the
/// results with those of an uninterrupted run.
void interrupt_and_resume(int kills, unsigned seed);

}  // namespace trammel::testing

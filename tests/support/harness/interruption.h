#pragma once

namespace trammel::testing {

/// Interrupts runs at random times by the signals KILL, INT and TERM, resumes each run, and
/// compares the results with those of an uninterrupted run.
void interrupt_and_resume(int kills, unsigned seed);

}  // namespace trammel::testing

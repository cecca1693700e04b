#pragma once

namespace trammel::harness {

/// The paper's claims, and what the results say of each. @returns the exit status
int claims_command(unsigned jobs, bool json);

}  // namespace trammel::harness

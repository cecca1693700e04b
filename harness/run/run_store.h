#pragma once

#include <filesystem>
#include <string>

#include "harness/run/run.h"

/// What runs came to, kept for a later call: a file a run, named by a hash of all that decides it.
/// CBOR (RFC 8949) after its own hash: every double as it was, also those that are no number.
namespace trammel::harness {

/// Name of what is computed of a case or variant: a hash of the case with all that it extends, its
/// file, the program, and whether it was asked for or only looked at by another.
[[nodiscard]] std::string computation_name(const Document& document, bool requested);

/// As a process answers and a file of the store holds it.
[[nodiscard]] std::string to_bytes(const Computation& computation);
/// @throws std::exception  where the text is not what `to_bytes` has written.
[[nodiscard]] Computation computation_from(const std::string& bytes);

/// @returns whether the file holds a computation that still stands: whole, with the references as
///          they are now, and with times of this machine.
[[nodiscard]] bool find_stored(const std::filesystem::path& file, Computation& computation);

/// The machine that times are measured on.
[[nodiscard]] std::string machine_name();

}  // namespace trammel::harness

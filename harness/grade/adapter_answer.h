#pragma once

#include <filesystem>

#include "harness/run/run.h"

/// RESULT.json of an adapter: what is broken is an error, what is missing is not given.
namespace trammel::harness {

/// Reads what an adapter has answered into status, reason, quantities and solver.
/// @param asked  "export" of the case that it was given: the quantities' names, units and lengths
/// @throws InputError  where the file is missing, larger than 64 MiB, no JSON or breaks its schema,
///                     or where a quantity has another unit or length than asked for or is unknown.
void read_adapter_answer(const std::filesystem::path& file, const Json& asked, Run& run);

}  // namespace trammel::harness

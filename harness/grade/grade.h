#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/base/processes.h"
#include "harness/run/run.h"

/// Other codes in place of trammel's solver, by adapters: `adapter CASE.json RESULT.json`.
namespace trammel::harness {

struct Adapter {
  std::vector<std::string> words;  ///< its program and arguments
  std::filesystem::path folder;    ///< each call has a folder of its own below it
  ProgramLimits limits;            ///< of one call
};

/// The words of a command: an executable file, or a program of the PATH with arguments. Words that
/// name files become absolute, since every call has another folder.
/// @throws InputError  where there is no such program.
[[nodiscard]] std::vector<std::string> adapter_words(const std::string& command);

/// Runs an adapter for a case or variant, and level by level for the sweeps whose orders are
/// judged where it declares the order of its element.
[[nodiscard]] OtherSolver solver_of(const Adapter& adapter);

/// RESULT.json of an adapter: what is broken is an error, what is missing is not given.

/// Reads what an adapter has answered into status, reason, quantities and solver.
/// @param asked  "export" of the case that it was given: the quantities' names, units and lengths
/// @throws InputError  where the file is missing, larger than 64 MiB, no JSON or breaks its schema,
///                     or where a quantity has another unit or length than asked for or is unknown.
void read_adapter_answer(const std::filesystem::path& file, const Json& asked, Run& run);

}  // namespace trammel::harness

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/base/processes.h"
#include "harness/run/run.h"

/// Runs other codes in place of trammel's solver through adapters, which are called with the paths
/// of CASE.json and RESULT.json.
namespace trammel::harness {

struct Adapter {
  std::vector<std::string> words;  ///< program of the adapter, and its arguments
  std::filesystem::path folder;    ///< folder with a subfolder for each call of the adapter
  ProgramLimits limits;            ///< limits of one call of the adapter
};

/// Splits a command into words. The command is an executable file, or a program of the PATH with
/// arguments. Words that name files become absolute, because each call runs in another folder.
/// @throws InputError  if the program does not exist or is not executable.
[[nodiscard]] std::vector<std::string> split_adapter_command(const std::string& command);

/// Returns a solver that runs an adapter for a case or variant. If the adapter reports the order of
/// convergence of its element, the solver also computes all levels of the refinement sweeps whose
/// order is checked.
[[nodiscard]] OtherSolver adapter_solver(const Adapter& adapter);

/// Reads the RESULT.json of an adapter into status, reason, quantities and solver of `run`. Missing
/// quantities are not an error.
/// @param requested  value of the key "export" of the exported case: names, units and lengths of
///   the quantities.
/// @throws InputError  if the file is missing, larger than 64 MiB, not JSON or violates its schema.
///     Also throws for an unknown quantity, and for a wrong unit or number of values.
void read_adapter_answer(const std::filesystem::path& file, const Json& requested, Run& run);

}  // namespace trammel::harness

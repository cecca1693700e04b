#pragma once

#include <string>

#include "harness/export/exported_case.h"

/// The adapter protocol from the side of trammel.
namespace trammel::harness {

struct ExportCommand {
  ExportChoice choice;
  int level = -1;        ///< of the sweep; -1: the case itself
  std::string out;       ///< file of the case; empty: standard output
  std::string matrices;  ///< folder for matrices and mesh instead of the case, or beside `out`
};

/// Writes the resolved case. @returns the exit status
int export_command(const std::string& name, const ExportCommand& command);

/// trammel as an adapter: computes a case file, and writes what the protocol asks for.
int solve_command(const std::string& case_file, const std::string& result_file);

}  // namespace trammel::harness

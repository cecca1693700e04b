#pragma once

#include <string>
#include <vector>

#include "harness/command_line.h"

/// The commands behind the words. Each returns the exit status, and throws InputError.
namespace trammel {

struct RunCommand {
  std::vector<std::string> cases;   ///< names or files
  std::vector<std::string> labels;  ///< beside them
  std::string variant;
  unsigned jobs = 1;
  std::string out;
};

int list_cases(const std::vector<std::string>& labels, bool json);
int describe_case(const std::string& name, bool json);
int run_command(const RunCommand& command, const Renderers& renderers);
int compare_command(const std::string& a, const std::string& b);
int converge_command(const std::string& name, const std::string& variant, unsigned jobs);
int report_command(const std::string& out, unsigned jobs, const Renderers& renderers);

}  // namespace trammel

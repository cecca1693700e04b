#include "harness/cli/command_shards.h"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "harness/base/embedded_text.h"
#include "harness/base/text.h"
#include "harness/cli/command_cost.h"
#include "harness/run/output_lock.h"
#include "harness/run/shards.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;

/// The cases and labels as words of a command line, each after a blank.
std::string words_of(const RunCommand& command) {
  std::string words;
  for (const std::string& name : command.cases) words += " " + shell_quoted(name);
  for (const std::string& label : command.labels) words += " -L " + shell_quoted(label);
  return words;
}

}  // namespace

int merge_command(const std::vector<std::string>& folders, RunCommand command,
                  const Renderers& renderers) {
  {
    const OutputLock lock(command.out);
    const Json selection =
        merge_shards({folders.begin(), folders.end()}, store_folder(command.out, command.store));
    selection.at("cases").get_to(command.cases);
    selection.at("labels").get_to(command.labels);
    selection.at("variant").get_to(command.variant);
  }
  command.resume = command.any_machine = true;
  return run_command(command, renderers);
}

int slurm_command(const SlurmCommand& slurm, const RunCommand& command) {
  const auto option = [](const char* name, const std::string& value) {
    return value.empty() ? "" : std::string(name) + shell_quoted(value);
  };
  const std::string costs =
      command.costs.empty() ? "" : fs::absolute(command.costs).lexically_normal().string();
  std::cout << fmt::format(
      fmt::runtime(embedded_text("slurm.sh.in")), fmt::arg("count", slurm.shards),
      fmt::arg("jobs", command.jobs),
      fmt::arg("program", shell_quoted(fs::read_symlink("/proc/self/exe").string())),
      fmt::arg("out", shell_quoted(fs::absolute(command.out).lexically_normal().string())),
      fmt::arg("words", words_of(command)),
      fmt::arg("variant", option(" --variant ", command.variant)),
      fmt::arg("costs", option(" --costs ", costs)),
      fmt::arg("time", slurm.time.empty() ? "" : option("--time=", slurm.time) + " "));
  return 0;
}

}  // namespace trammel::harness

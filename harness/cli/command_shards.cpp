#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "harness/base/text.h"
#include "harness/cli/commands.h"
#include "harness/run/shards.h"
#include "harness/run/stored_results.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;

/// Returns the selected cases and labels as arguments of a command line, each preceded by a space.
std::string selection_arguments(const CommandOptions& options) {
  std::string words;
  for (const std::string& name : options.words) words += " " + shell_quoted(name);
  for (const std::string& label : options.labels) words += " -L " + shell_quoted(label);
  for (const std::string& label : options.any_labels)
    words += " --label-any " + shell_quoted(label);
  return words;
}

}  // namespace

int merge_command(const CommandOptions& options, const Renderers& renderers) {
  CommandOptions run = options;
  {
    const OutputLock lock(options.out);
    const Json selection = merge_shards({options.words.begin(), options.words.end()},
                                        store_folder(options.out, options.store));
    selection.at("cases").get_to(run.words);
    selection.at("labels").get_to(run.labels);
    selection.at("any_labels").get_to(run.any_labels);
    selection.at("variant").get_to(run.variant);
  }
  run.resume = run.any_machine = true;
  return run_command(run, renderers);
}

int slurm_command(const CommandOptions& options, const Renderers& /*renderers*/) {
  const auto option = [](const char* name, const std::string& value) {
    return value.empty() ? "" : std::string(name) + shell_quoted(value);
  };
  std::cout << fmt::format(
      fmt::runtime(embedded_text("slurm.sh.in")), fmt::arg("count", options.shard_count),
      fmt::arg("jobs", options.jobs),
      fmt::arg("program", shell_quoted(fs::read_symlink("/proc/self/exe").string())),
      fmt::arg("out", shell_quoted(fs::absolute(options.out).lexically_normal().string())),
      fmt::arg("words", selection_arguments(options)),
      fmt::arg("variant", option(" --variant ", options.variant)),
      fmt::arg("time", options.job_time.empty() ? "" : option("--time=", options.job_time) + " "));
  return 0;
}

}  // namespace trammel::harness

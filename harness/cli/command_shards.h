#pragma once

#include <string>
#include <vector>

#include "harness/cli/command_run.h"

namespace trammel::harness {

/// Judges what the shards in the folders have computed as `run` would, into `command.out`.
int merge_command(const std::vector<std::string>& folders, RunCommand command,
                  const Renderers& renderers);

struct SlurmCommand {
  std::size_t shards = 0;
  std::string time;  ///< as sbatch reads it; empty: the partition's own
};
/// Prints a script that sends the shards of `run` as a job array, with a job after it that merges
/// them and makes the page.
int slurm_command(const SlurmCommand& slurm, const RunCommand& command);

}  // namespace trammel::harness

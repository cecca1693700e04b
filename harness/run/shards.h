#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/base/json.h"
#include "harness/run/run.h"

/// Parts of one long call of `run` that are computed apart, each into a store of its own, and the
/// union of their stores.
namespace trammel::harness {

/// "2/8": the second of eight.
/// @throws InputError  where the text is none.
[[nodiscard]] Shard shard_from(const std::string& text);

/// Says in `folder` that a shard of the selection is done: what it has computed is in `store`.
void write_shard(const std::filesystem::path& folder, const Shard& shard, const Json& selection,
                 const ShardRuns& done);

/// The files of a shard beside those of a run.
inline constexpr const char* kShardFile = "shard.json";
inline constexpr const char* kStoreFolder = "store";

/// Copies what the stores of all shards hold into one.
/// @param folders  where `write_shard` has written, in any order
/// @returns the selection that they are the shards of
/// @throws InputError  where a shard is not done, missing, there twice, of another program or
///                     selection, or where a computation is in two of them or in none.
Json merge_shards(const std::vector<std::filesystem::path>& folders,
                  const std::filesystem::path& store);

}  // namespace trammel::harness

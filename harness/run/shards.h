#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/base/json.h"
#include "harness/run/run.h"

/// Splits a long call of `run` into parts (shards), which are computed separately, each with a
/// separate store. Merges these stores.
namespace trammel::harness {

/// Parses "2/8", the second of eight shards.
/// @throws InputError  if the text is not a shard.
[[nodiscard]] Shard parse_shard(const std::string& text);

/// Writes the file of a finished shard into `folder`: its number, the selection of cases, and the
/// names of its computations, which are in the store.
void write_shard(const std::filesystem::path& folder, const Shard& shard, const Json& selection,
                 const ShardRuns& done);

/// Names of the file and of the store in the folder of a finished shard.
inline constexpr const char* kShardFile = "shard.json";
inline constexpr const char* kStoreFolder = "store";

/// Copies the stores of all shards into one store.
/// @param folders  folders written by `write_shard`, in any order.
/// @returns the selection of cases, which is equal in all shards.
/// @throws InputError  if a shard is incomplete, missing or duplicated, if shards are results of
///   different programs or selections of cases, or if a computation is in two shards or in none.
Json merge_shards(const std::vector<std::filesystem::path>& folders,
                  const std::filesystem::path& store);

}  // namespace trammel::harness

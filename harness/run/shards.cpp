#include "harness/run/shards.h"

#include <charconv>

#include "harness/base/environment.h"
#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/base/text.h"
#include "harness/results/results.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;

std::size_t parse_number(const char* begin, const char* end) {
  std::size_t number = 0;
  const auto [stop, error] = std::from_chars(begin, end, number);
  return error == std::errc() && stop == end ? number : 0;
}

Json read_shard(const fs::path& folder) {
  const fs::path file = folder / kShardFile;
  if (!fs::exists(file))
    throw InputError(folder.string() + ": expected the folder of a finished shard (no " +
                     kShardFile + ")");
  Json shard = read_json(file);
  const auto expect = [&](const char* key, bool holds, const std::string& what) {
    if (!holds) throw InputError(file.string(), std::string("/") + key, "expected " + what);
  };
  const auto whole = [&](const char* key) {
    return shard.contains(key) && shard[key].is_number_unsigned() && shard[key] > 0;
  };
  expect("", shard.is_object(), "an object");
  for (const char* key : {"shard", "of", "in_all"}) expect(key, whole(key), "a positive number");
  expect("computations", shard.contains("computations") && shard["computations"].is_array(),
         "the names of computations");
  expect("selection", shard.contains("selection"), "the selection of cases");
  expect("program", shard.value("program", "") == program_hash(),
         "this program, " + build_and_machine_info()["commit"].get<std::string>() + " (got " +
             shard.value("commit", "another one") + ")");
  return shard;
}

/// @returns folders of the shards by shard number
std::map<std::size_t, fs::path> require_all(const std::vector<fs::path>& folders,
                                            std::map<fs::path, Json>& shards) {
  std::map<std::size_t, fs::path> places;
  const Json& first = shards.at(folders.front());
  for (const fs::path& folder : folders) {
    const Json& shard = shards.at(folder);
    for (const char* key : {"of", "in_all", "selection"})
      if (shard[key] != first[key])
        throw InputError((folder / kShardFile).string(), std::string("/") + key,
                         "expected the same value as in " + folders.front().string());
    const auto [place, fresh] = places.emplace(shard["shard"].get<std::size_t>(), folder);
    if (!fresh)
      throw InputError((folder / kShardFile).string(), "/shard",
                       "expected each shard once (shard " + std::to_string(place->first) +
                           " is also in " + place->second.string() + ")");
  }
  for (std::size_t number = 1; number <= first["of"]; ++number)
    if (places.count(number) == 0)
      throw InputError("expected all " + first["of"].dump() +
                       " shards (missing: " + std::to_string(number) + ")");
  return places;
}

}  // namespace

Shard parse_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  Shard shard;
  if (slash != std::string::npos) {
    shard.number = parse_number(text.data(), text.data() + slash);
    shard.count = parse_number(text.data() + slash + 1, text.data() + text.size());
  }
  constexpr std::size_t most = 100000;
  if (slash == std::string::npos || shard.number < 1 || shard.number > shard.count ||
      shard.count > most)
    throw InputError("--shard: expected K/N with 1 <= K <= N <= 100000 (got " +
                     quoted(printable(text)) + ")");
  return shard;
}

void write_shard(const fs::path& folder, const Shard& shard, const Json& selection,
                 const ShardRuns& done) {
  write_file(folder / kShardFile, format_json({{"shard", shard.number},
                                               {"of", shard.count},
                                               {"in_all", done.in_all},
                                               {"program", program_hash()},
                                               {"commit", build_and_machine_info()["commit"]},
                                               {"selection", selection},
                                               {"computations", done.names}}));
}

Json merge_shards(const std::vector<fs::path>& folders, const fs::path& store) {
  std::map<fs::path, Json> shards;
  for (const fs::path& folder : folders) shards[folder] = read_shard(folder);
  std::map<std::string, fs::path> computed;
  for (const auto& [number, folder] : require_all(folders, shards))
    for (const Json& name : shards[folder]["computations"]) {
      const auto [place, fresh] = computed.emplace(name.get<std::string>(), folder);
      if (!fresh)
        throw InputError((folder / kShardFile).string(), "/computations",
                         "expected each computation in one shard (" + place->first +
                             " is also in " + place->second.string() + ")");
    }
  const Json& first = shards[folders.front()];
  if (first["in_all"] != computed.size())
    throw InputError("expected " + first["in_all"].dump() + " computations in all shards (got " +
                     std::to_string(computed.size()) + ")");
  fs::create_directories(store);
  for (const fs::path& folder : folders)
    for (const auto& entry : fs::directory_iterator(folder / kStoreFolder))
      if (entry.path().extension() == ".cbor")
        write_file(store / entry.path().filename(), read_text(entry.path()));
  return first["selection"];
}

}  // namespace trammel::harness

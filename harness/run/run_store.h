#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/results/results.h"
#include "harness/run/run.h"
#include "harness/studies/cost.h"
#include "harness/studies/cost_study.h"

/// Runs that are kept for a later call: a file for each run, named by a hash of all that decides
/// it. A file is the run's fields as CBOR (RFC 8949), compressed by zstd (RFC 8878) with a
/// checksum. It holds every double bit for bit.
namespace trammel::harness {

/// Name of the file of what is computed of a case or variant: a hash of the case with all that it
/// extends, its file, the program, whether it was asked for or only looked at by another, and of
/// another solver than trammel's.
[[nodiscard]] std::string computation_name(const Document& document, bool requested,
                                           const std::string& solver_hash = "");

/// A run as its process answers it and a file of the store holds it.
[[nodiscard]] std::string to_bytes(const Run& run);
/// @throws std::exception  if `to_bytes` has not written the bytes.
[[nodiscard]] Run run_from(const std::string& bytes);
/// Its studies, which are judged later than it is stored.
[[nodiscard]] std::string to_bytes(const std::vector<results::Convergence>& studies);
[[nodiscard]] std::vector<results::Convergence> convergence_from(const std::string& bytes);

/// @returns whether the file holds a computation that still stands: whole, with the references as
///          they are now, and with times of this machine unless any will do.
[[nodiscard]] bool find_stored(const std::filesystem::path& file, Run& run,
                               bool any_machine = false, const References& references = {});

/// How many calls have begun the computation of that file and were ended before it was.
[[nodiscard]] std::size_t unfinished_starts(const std::filesystem::path& file);
void mark_started(const std::filesystem::path& file);
void forget_starts(const std::filesystem::path& file);

/// As `measure`, or what the store holds of the same settings, by the same program and options, on
/// this machine, with the references as they are now.
[[nodiscard]] results::CostStudy measure_or_find(const CostStudy& study, const CostOptions& options,
                                                 const References& references,
                                                 const std::filesystem::path& store, bool resume);

/// As `run_sandboxed`, or the solution that the store holds of the same setting by the same
/// program.
[[nodiscard]] SandboxedRun run_or_find(const Setting& setting, int time_limit_s,
                                       const References& references,
                                       const std::filesystem::path& store, bool resume);

/// What `measure` gives of a case's scene, or the store holds of the same case by the same program
/// on this machine.
using EffectScenes = std::vector<results::EffectScene>;
[[nodiscard]] EffectScenes scenes_or_find(const Document& document,
                                          const std::function<EffectScenes()>& measure,
                                          const std::filesystem::path& store, bool resume);

/// Removes what no call has written or found for 30 days.
void drop_unused(const std::filesystem::path& store);

/// The machine that times are measured on.
[[nodiscard]] std::string machine_name();

}  // namespace trammel::harness

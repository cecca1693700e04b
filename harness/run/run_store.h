#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/results/results.h"
#include "harness/run/run.h"
#include "harness/studies/cost.h"
#include "harness/studies/cost_study.h"

/// Stored runs for reuse by later calls: one file per run, named by a hash of everything that
/// determines the run. A file contains the run's fields as CBOR (RFC 8949), compressed by zstd (RFC
/// 8878) with a checksum. Doubles are stored exactly.
namespace trammel::harness {

/// Returns the file name of a computation of a case or variant. It is a hash of the case with all
/// cases that it extends, its file and the program. The hash also includes `requested`, because
/// computations needed only by other checks are smaller, and the identity of another solver.
[[nodiscard]] std::string computation_name(const Document& document, bool requested,
                                           const std::string& solver_hash = "");

/// Serializes a run for its process and for a file of the store.
[[nodiscard]] std::string to_bytes(const Run& run);
/// @throws std::exception  if the bytes were not written by `to_bytes`.
[[nodiscard]] Run run_from(const std::string& bytes);
/// Serializes the studies of a run, which are judged after it is stored.
[[nodiscard]] std::string to_bytes(const std::vector<results::Convergence>& studies);
[[nodiscard]] std::vector<results::Convergence> convergence_from(const std::string& bytes);

/// @returns whether the file contains a valid computation. It must be complete, use the current
///   references, and have times of this machine unless `any_machine` is set.
[[nodiscard]] bool find_stored(const std::filesystem::path& file, Run& run,
                               bool any_machine = false, const References& references = {});

/// Returns the number of calls that started the computation of that file but were interrupted.
[[nodiscard]] std::size_t unfinished_starts(const std::filesystem::path& file);
void mark_started(const std::filesystem::path& file);
void clear_starts(const std::filesystem::path& file);

/// Measures a study, or reads it from the store. A stored study must have the same settings,
/// program, options, machine and current references.
[[nodiscard]] results::CostStudy cached_cost_study(const CostStudy& study,
                                                   const CostOptions& options,
                                                   const References& references,
                                                   const std::filesystem::path& store, bool resume);

/// Runs a setting as `run_sandboxed` does, or reads the solution of the same setting by the same
/// program from the store.
[[nodiscard]] SandboxedRun cached_solution(const Setting& setting, int time_limit_s,
                                           const References& references,
                                           const std::filesystem::path& store, bool resume);

using EffectScenes = std::vector<results::EffectScene>;
/// Returns the result of `measure` for a case's scene, or the stored result of the same case by the
/// same program on this machine.
[[nodiscard]] EffectScenes cached_scenes(const Document& document,
                                         const std::function<EffectScenes()>& measure,
                                         const std::filesystem::path& store, bool resume);

/// Removes files that no call has written or read for 30 days.
void remove_unused_files(const std::filesystem::path& store);

/// Returns the identity of the machine, for time measurements.
[[nodiscard]] std::string machine_name();

}  // namespace trammel::harness

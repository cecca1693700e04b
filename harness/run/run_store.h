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

/// Returns the file name of a computation of a case or variant. The name is a hash of the program,
/// of the case file and of the case with all cases that it extends. The hash includes the identity
/// of a solver other than trammel. It also includes `requested`, because a run that is only needed
/// by checks of other runs contains less data.
[[nodiscard]] std::string run_file_name(const Document& document, bool requested,
                                        const std::string& solver_hash = "");

/// Serializes a run for a file of the store, and for the transfer from the process of the run.
[[nodiscard]] std::string serialize(const Run& run);
/// @throws std::exception  if the bytes were not written by `serialize_run`.
[[nodiscard]] Run parse_run(const std::string& bytes);
/// Serializes the convergence studies of a run, which are evaluated after the run is stored.
[[nodiscard]] std::string serialize(const std::vector<results::Convergence>& studies);
[[nodiscard]] std::vector<results::Convergence> parse_convergence(const std::string& bytes);

/// @returns whether the file contains a reusable run. The run must be complete and use the current
///     references. Times must be from this machine unless `any_machine` is set.
[[nodiscard]] bool load_stored_run(const std::filesystem::path& file, Run& run,
                                   bool any_machine = false, const References& references = {});

/// Measures a cost study, or reads its results from the run store. The stored study must have the
/// same settings, program, options, machine and references.
[[nodiscard]] results::CostStudy cached_cost_study(const CostStudy& study,
                                                   const CostOptions& options,
                                                   const References& references,
                                                   const std::filesystem::path& store, bool resume);

/// Computes a setting by `run_sandboxed`, or reads its solution from the store if the same program
/// has computed it.
[[nodiscard]] SandboxedRun cached_solution(const Setting& setting, int time_limit_s,
                                           const References& references,
                                           const std::filesystem::path& store, bool resume);

using EffectScenes = std::vector<results::EffectScene>;
/// Returns the effect study of a case from the store if the same program has measured it on this
/// machine. Otherwise, calls `measure` and stores its result.
[[nodiscard]] EffectScenes cached_effect_study(const Document& document,
                                               const std::function<EffectScenes()>& measure,
                                               const std::filesystem::path& store, bool resume);

/// Creates the folder of the run store, and removes its files that no call of trammel has written
/// or read for 30 days.
void prepare_store(const std::filesystem::path& store);

/// Returns processor and host name, which identify the machine on which times are measured.
[[nodiscard]] std::string machine_name();

}  // namespace trammel::harness

#include "harness/run/run_store.h"

#include <unistd.h>
#include <zstd.h>
#include <zstd_errors.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "harness/analysis/analysis.h"
#include "harness/base/content_hash.h"
#include "harness/base/environment.h"
#include "harness/base/json_file.h"
#include "harness/input/catalogue.h"
#include "harness/results/result_fields.h"

namespace trammel::harness {
namespace {

struct KeptStudy {
  std::vector<MeasuredSetting> settings;
  double wall_s = 0;
  std::map<std::string, std::string> references;
};

}  // namespace
}  // namespace trammel::harness

namespace trammel::results {

using harness::KeptStudy;
using harness::MeasuredSetting;
using harness::SandboxedRun;

template <>
inline constexpr std::array kNames<MeasuredSetting::MeasurementStatus> = {
    std::pair{"measured", MeasuredSetting::MeasurementStatus::measured},
    std::pair{"reference", MeasuredSetting::MeasurementStatus::reference_solution},
    std::pair{"diverged", MeasuredSetting::MeasurementStatus::diverged},
    std::pair{"timed-out", MeasuredSetting::MeasurementStatus::timed_out},
    std::pair{"failed", MeasuredSetting::MeasurementStatus::failed}};
template <>
inline constexpr std::array kNames<SandboxedRun::Termination> = {
    std::pair{"solved", SandboxedRun::Termination::solved},
    std::pair{"failed", SandboxedRun::Termination::failed},
    std::pair{"timed-out", SandboxedRun::Termination::timed_out}};
TRAMMEL_FIELDS(solver::Counters,
               TRAMMEL_REQUIRED(element_evaluations, factorizations, solves, steps));
TRAMMEL_FIELDS(harness::ErrorNorms, TRAMMEL_REQUIRED(max, rms, mean));
TRAMMEL_FIELDS(harness::Timing, TRAMMEL_REQUIRED(cpu_s, median_s, lower_quartile_s,
                                                 upper_quartile_s, wall_median_s, runs_each));
TRAMMEL_FIELDS(harness::RelativeTime, TRAMMEL_REQUIRED(median, low, high));
TRAMMEL_FIELDS(MeasuredSetting,
               TRAMMEL_REQUIRED(status, error, output_errors, timing, relative, cpu_s, counters),
               TRAMMEL_OPTIONAL(reason));
TRAMMEL_FIELDS(SandboxedRun, TRAMMEL_REQUIRED(termination, values, quantities, counters, cpu_s),
               TRAMMEL_OPTIONAL(reason));
TRAMMEL_FIELDS(KeptStudy, TRAMMEL_REQUIRED(settings, wall_s, references));

}  // namespace trammel::results

namespace trammel::harness {
namespace {

constexpr unsigned long long kMaxBytes = 1ULL << 30U;  ///< of what is uncompressed

/// @throws std::bad_alloc  if that is what zstd reports.
bool failed(std::size_t result) {
  if (ZSTD_getErrorCode(result) == ZSTD_error_memory_allocation) throw std::bad_alloc();
  return ZSTD_isError(result) != 0;
}

std::string compressed(const std::string& bytes) {
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(),
                                                                     &ZSTD_freeCCtx);
  if (!context) throw std::bad_alloc();
  // Higher levels save at most 2 %, because most bytes are digits of doubles.
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, 3);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress2(context.get(), out.data(), out.size(), bytes.data(), bytes.size());
  if (failed(size)) throw std::runtime_error(ZSTD_getErrorName(size));
  out.resize(size);
  return out;
}

/// @throws std::runtime_error  for a part of a file, or a damaged one.
std::string uncompressed(const std::string& bytes) {
  const unsigned long long size = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  std::string out(size <= kMaxBytes ? size : 0, '\0');
  const std::size_t written = ZSTD_decompress(out.data(), out.size(), bytes.data(), bytes.size());
  if (failed(written) || written != size)
    throw std::runtime_error("the computation ended without an answer");
  return out;
}

template <class Kept>
std::string stored_bytes(const Kept& kept) {
  std::string bytes;
  Json::to_cbor(results::to_json(kept, results::Form::store), bytes);
  return compressed(bytes);
}

template <class Kept>
Kept stored_from(const std::string& bytes) {
  return results::from_json<Kept>(parse_cbor(uncompressed(bytes)));
}

bool stand(const std::map<std::string, std::string>& references) {
  return std::ranges::all_of(references,
                             [](const auto& item) { return file_hash(item.first) == item.second; });
}

void mark_used(const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now(), error);
}

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// What the file holds; nothing where it is not to be taken, half a file, or of another version.
template <class Kept>
std::optional<Kept> kept_in(const std::filesystem::path& file, bool resume) {
  if (!resume) return std::nullopt;
  try {
    return stored_from<Kept>(read_text(file));
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

std::string name_of(const std::string& all_that_decides) {
  static const std::string program = program_hash();
  return content_hash(program + all_that_decides) + ".cbor";
}

void add_setting(const Setting& setting, Json& all) {
  all.push_back(setting.document.value());
  for (const ObservedQuantity& one : setting.observed)
    all.push_back(
        {one.quantity, one.addend, one.statistic, one.index, one.is_error, one.exact, one.output});
}

std::string name_of(const CostStudy& study, const TimingOptions& timing) {
  Json all = {machine_name(),     timing.repeats, timing.seed, timing.shortest_s,
              study.time_limit_s, study.baseline, study.norm};
  for (const StudyOutput& output : study.outputs)
    all.push_back({output.scale.kind, output.scale.number});
  for (const Setting& setting : study.settings) add_setting(setting, all);
  if (study.reference_solution) add_setting(*study.reference_solution, all);
  return name_of(text_of(all));
}

/// A byte for each call that has begun the computation of that file.
std::filesystem::path started(std::filesystem::path file) {
  return file.replace_extension(".started");
}

/// Cases that an analysis of other cases tries.
Json tried_cases(const Document& document) {
  Json tried = Json::object();
  if (analysis_kind(document) != "options") return tried;
  const Catalogue catalogue;
  const JsonView place = JsonView(document)["analysis"]["options"];
  const std::string here = document.origin(place.pointer()).file;
  for (const auto& item : place["cases"].entries())
    tried[item.first] =
        load_case(catalogue.find_base_case(item.first, here), catalogue).document.value();
  return tried;
}

}  // namespace

std::string computation_name(const Document& document, bool requested,
                             const std::string& solver_hash) {
  const std::string file = std::filesystem::absolute(document.origin("").file).string();
  return name_of(text_of({requested, file, tried_cases(document), solver_hash}) +
                 text_of(document.value()));
}

std::string to_bytes(const Run& run) {
  return stored_bytes(run);
}
Run run_from(const std::string& bytes) {
  return stored_from<Run>(bytes);
}

std::string to_bytes(const std::vector<results::Convergence>& studies) {
  return stored_bytes(studies);
}
std::vector<results::Convergence> convergence_from(const std::string& bytes) {
  return stored_from<std::vector<results::Convergence>>(bytes);
}

bool find_stored(const std::filesystem::path& file, Run& run, bool any_machine) {
  try {
    Run found = run_from(read_text(file));
    if (!stand(found.references)) return false;
    const bool timed = !any_machine && !found.cost.timings.empty();
    if (timed && found.machine != machine_name()) return false;
    found.case_id = run.case_id;
    found.variant = run.variant;
    run = std::move(found);
  } catch (const std::exception&) {
    return false;  // half a file, or of another version
  }
  mark_used(file);
  return true;
}

std::size_t unfinished_starts(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(started(file), error);
  return error ? 0 : static_cast<std::size_t>(bytes);
}

void mark_started(const std::filesystem::path& file) {
  std::ofstream(started(file), std::ios::app) << '.';
}

void forget_starts(const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::remove(started(file), error);
}

MeasuredStudy measure_or_find(CostStudy study, const CostOptions& options,
                              const References& references, const std::filesystem::path& store,
                              bool resume) {
  const std::filesystem::path file = store / name_of(study, options.timing);
  std::optional<KeptStudy> kept = kept_in<KeptStudy>(file, resume);
  if (!kept || kept->settings.empty() || !stand(kept->references)) {
    MeasuredStudy measured = measure(std::move(study), options, references);
    std::filesystem::create_directories(store);
    write_file(file,
               stored_bytes(KeptStudy{measured.settings, measured.wall_s, references.hashes()}));
    return measured;
  }
  mark_used(file);
  MeasuredStudy measured;
  measured.study = std::move(study);
  measured.settings = std::move(kept->settings);
  measured.wall_s = kept->wall_s;
  derive_results(measured);
  return measured;
}

SandboxedRun run_or_find(const Setting& setting, int time_limit_s, const References& references,
                         const std::filesystem::path& store, bool resume) {
  Json all = Json::array({"setting"});
  add_setting(setting, all);
  const std::filesystem::path file = store / name_of(text_of(all));
  if (std::optional<SandboxedRun> kept = kept_in<SandboxedRun>(file, resume)) {
    mark_used(file);
    return *std::move(kept);
  }
  SandboxedRun run = run_sandboxed(setting, time_limit_s, references);
  std::filesystem::create_directories(store);
  if (run.termination == SandboxedRun::Termination::solved) write_file(file, stored_bytes(run));
  return run;
}

EffectScenes scenes_or_find(const Document& document, const std::function<EffectScenes()>& measure,
                            const std::filesystem::path& store, bool resume) {
  const std::filesystem::path file =
      store / name_of("effects " + machine_name() + text_of(document.value()));
  if (std::optional<EffectScenes> kept = kept_in<EffectScenes>(file, resume)) {
    mark_used(file);
    return *std::move(kept);
  }
  EffectScenes scenes = measure();
  std::filesystem::create_directories(store);
  write_file(file, stored_bytes(scenes));
  return scenes;
}

void drop_unused(const std::filesystem::path& store) {
  std::error_code error;
  const auto oldest = std::filesystem::file_time_type::clock::now() - std::chrono::days(30);
  for (const auto& entry : std::filesystem::directory_iterator(store, error))
    if ((entry.path().extension() == ".cbor" || entry.path().extension() == ".started") &&
        entry.last_write_time(error) < oldest)
      std::filesystem::remove(entry.path(), error);
}

std::string machine_name() {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  return environment()["processor"].get<std::string>() + " of " + host.data();
}

}  // namespace trammel::harness

#include "harness/run/run_store.h"

#include <unistd.h>
#include <zstd.h>
#include <zstd_errors.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <new>
#include <stdexcept>
#include <utility>
#include <vector>

#include "harness/analysis/analysis.h"
#include "harness/base/environment.h"
#include "harness/base/json_file.h"
#include "harness/input/catalogue.h"
#include "harness/results/result_fields.h"

namespace trammel::harness {
namespace {

constexpr unsigned long long kMaxBytes = 1ULL << 30U;  ///< maximum size of uncompressed data [byte]

/// Returns true if a function of zstd failed.
/// @throws std::bad_alloc  if zstd could not allocate memory.
bool failed(std::size_t result) {
  if (ZSTD_getErrorCode(result) == ZSTD_error_memory_allocation) throw std::bad_alloc();
  return ZSTD_isError(result) != 0;
}

std::string compress_bytes(const std::string& bytes) {
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(),
                                                                     &ZSTD_freeCCtx);
  if (!context) throw std::bad_alloc();
  // Higher compression levels reduce the size by at most 2 %, because most bytes are digits of
  // doubles.
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, 3);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress2(context.get(), out.data(), out.size(), bytes.data(), bytes.size());
  if (failed(size)) throw std::runtime_error(ZSTD_getErrorName(size));
  out.resize(size);
  return out;
}

/// Returns the uncompressed contents of a file of the store.
/// @throws std::runtime_error  for a truncated or damaged file.
std::string uncompress_bytes(const std::string& bytes) {
  const unsigned long long size = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  std::string out(size <= kMaxBytes ? size : 0, '\0');
  const std::size_t written = ZSTD_decompress(out.data(), out.size(), bytes.data(), bytes.size());
  if (failed(written) || written != size)
    throw std::runtime_error("the computation ended without a result");
  return out;
}

template <class Kept>
std::string bytes_to_store(const Kept& kept) {
  std::string bytes;
  Json::to_cbor(results::to_json(kept, results::Form::store), bytes);
  return compress_bytes(bytes);
}

template <class Kept>
Kept parse_stored_bytes(const std::string& bytes) {
  return results::from_json<Kept>(parse_cbor(uncompress_bytes(bytes)));
}

bool hashes_agree(const std::map<std::string, std::string>& hashes, const References& references) {
  return std::ranges::all_of(
      hashes, [&](const auto& item) { return references.hash(item.first) == item.second; });
}

void mark_file_as_used(const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now(), error);
}

std::string text_of_json(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Returns the value from the file `name` if the file is complete and the value is valid. Otherwise
/// computes the value, and stores it if it is valid.
template <class Kept>
Kept find_or_compute(const std::filesystem::path& store, const std::string& name, bool resume,
                     const std::function<bool(const Kept&)>& is_valid,
                     const std::function<Kept()>& compute) {
  const std::filesystem::path file = store / name;
  try {
    if (resume) {
      Kept kept = parse_stored_bytes<Kept>(read_text(file));
      if (is_valid(kept)) {
        mark_file_as_used(file);
        return kept;
      }
    }
  } catch (const std::exception&) {  // truncated file, or another version
  }
  Kept computed = compute();
  std::filesystem::create_directories(store);
  if (is_valid(computed)) write_file(file, bytes_to_store(computed));
  return computed;
}

std::string name_of(const std::string& all_that_decides) {
  static const std::string program = program_hash();
  return content_hash(program + all_that_decides) + ".cbor";
}

void add_setting_to_json(const Setting& setting, Json& all) {
  all.push_back({setting.curve, setting.curve_title, setting.title, setting.document.value()});
  if (setting.value) all.push_back(*setting.value);
  for (const ObservedQuantity& one : setting.observed)
    all.push_back(
        {one.quantity, one.addend, one.statistic, one.index, one.is_error, one.exact, one.output});
}

std::string name_of(const CostStudy& study, const TimingOptions& timing) {
  Json all = {machine_name(),     timing.repeats, timing.seed,       timing.shortest_s,
              study.time_limit_s, study.baseline, study.norm,        study.id,
              study.family,       study.title,    study.description, study.reference_description};
  for (const StudyOutput& output : study.outputs)
    all.push_back({output.scale.kind, output.scale.number, output.title, output.scale_description});
  for (const Setting& setting : study.settings) add_setting_to_json(setting, all);
  if (study.reference_solution) add_setting_to_json(*study.reference_solution, all);
  return name_of(text_of_json(all));
}

/// Returns the cases that the analysis "options" of a case computes; empty for other analyses.
Json cases_of_options_analysis(const Document& document) {
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

std::string run_file_name(const Document& document, bool requested,
                          const std::string& solver_hash) {
  const std::string file = std::filesystem::absolute(document.origin("").file).string();
  return name_of(text_of_json({requested, file, cases_of_options_analysis(document), solver_hash}) +
                 text_of_json(document.value()));
}

std::string serialize(const Run& run) {
  return bytes_to_store(run);
}
Run parse_run(const std::string& bytes) {
  return parse_stored_bytes<Run>(bytes);
}

std::string serialize(const std::vector<results::Convergence>& studies) {
  return bytes_to_store(studies);
}
std::vector<results::Convergence> parse_convergence(const std::string& bytes) {
  return parse_stored_bytes<std::vector<results::Convergence>>(bytes);
}

bool load_stored_run(const std::filesystem::path& file, Run& run, bool any_machine,
                     const References& references) {
  try {
    Run found = parse_run(read_text(file));
    if (!hashes_agree(found.references, references)) return false;
    const bool timed = !any_machine && !found.cost.timings.empty();
    if (timed && found.machine != machine_name()) return false;
    found.case_id = run.case_id;
    found.variant = run.variant;
    run = std::move(found);
  } catch (const std::exception&) {
    return false;  // truncated file, or another version
  }
  mark_file_as_used(file);
  return true;
}

results::CostStudy cached_cost_study(const CostStudy& study, const CostOptions& options,
                                     const References& references,
                                     const std::filesystem::path& store, bool resume) {
  return find_or_compute<results::CostStudy>(
      store, name_of(study, options.timing), resume,
      [&](const results::CostStudy& kept) { return hashes_agree(kept.references, references); },
      [&] { return measure_study(study, options, references); });
}

SandboxedRun cached_solution(const Setting& setting, int time_limit_s, const References& references,
                             const std::filesystem::path& store, bool resume) {
  Json all = Json::array({"setting"});
  add_setting_to_json(setting, all);
  return find_or_compute<SandboxedRun>(
      store, name_of(text_of_json(all)), resume,
      [](const SandboxedRun& run) { return run.termination == SandboxedRun::Termination::solved; },
      [&] { return run_sandboxed(setting, time_limit_s, references); });
}

EffectScenes cached_effect_study(const Document& document,
                                 const std::function<EffectScenes()>& measure,
                                 const std::filesystem::path& store, bool resume) {
  return find_or_compute<EffectScenes>(
      store, name_of("effects " + machine_name() + text_of_json(document.value())), resume,
      [](const EffectScenes&) { return true; }, measure);
}

void prepare_store(const std::filesystem::path& store) {
  std::error_code error;
  std::filesystem::create_directories(store, error);
  const auto oldest = std::filesystem::file_time_type::clock::now() - std::chrono::days(30);
  for (const auto& entry : std::filesystem::directory_iterator(store, error))
    if (entry.path().extension() == ".cbor" && entry.last_write_time(error) < oldest)
      std::filesystem::remove(entry.path(), error);
}

std::string machine_name() {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  static const std::string processor = build_and_machine_info()["processor"];
  return processor + " of " + host.data();
}

}  // namespace trammel::harness

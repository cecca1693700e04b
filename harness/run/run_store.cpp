#include "harness/run/run_store.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/base/content_hash.h"
#include "harness/base/environment.h"
#include "harness/base/json_file.h"
#include "harness/input/catalogue.h"

/// A struct with all its members, one after the other: one that is not named here does not compile.
#define TRAMMEL_PUT(member) out.push_back(whole.member);
#define TRAMMEL_TAKE(member) in.at(place++).get_to(whole.member);
#define TRAMMEL_KEPT(Type, ...)                                          \
  inline void to_json(nlohmann::json& out, const Type& whole) {          \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(TRAMMEL_PUT, __VA_ARGS__))  \
  }                                                                      \
  inline void from_json(const nlohmann::json& in, Type& whole) {         \
    std::size_t place = 0;                                               \
    NLOHMANN_JSON_EXPAND(NLOHMANN_JSON_PASTE(TRAMMEL_TAKE, __VA_ARGS__)) \
  }                                                                      \
  [[maybe_unused]] static void name_all_members(const Type& whole_) {    \
    [[maybe_unused]] const auto& [__VA_ARGS__] = whole_;                 \
  }

namespace nlohmann {

template <class T>
struct adl_serializer<std::optional<T>> {
  static void to_json(json& out, const std::optional<T>& value) {
    out = value ? json(*value) : json(nullptr);
  }
  static void from_json(const json& in, std::optional<T>& value) {
    value = in.is_null() ? std::nullopt : std::optional<T>(in.get<T>());
  }
};

template <>
struct adl_serializer<trammel::solver::Evidence> {
  static void to_json(json& out, const trammel::solver::Evidence& evidence) {
    out = json::object();
    for (const auto kind : trammel::solver::kResiduals)
      if (evidence.has(kind)) out[rule_of(kind).name] = evidence.largest(kind);
  }
  static void from_json(const json& in, trammel::solver::Evidence& evidence) {
    evidence = {};
    for (const auto kind : trammel::solver::kResiduals)
      if (const char* name = rule_of(kind).name; in.contains(name))
        evidence.add(kind, in.at(name).get<double>());
  }
};

}  // namespace nlohmann

namespace trammel::solver {
TRAMMEL_KEPT(Outcome, status, reason)
TRAMMEL_KEPT(Counters, element_evaluations, factorizations, solves, steps, effects)
}  // namespace trammel::solver

namespace trammel::results {
TRAMMEL_KEPT(ReadingClass, title, readings, probability, values)
TRAMMEL_KEPT(FurtherNumber, name, expected_information_bits)
TRAMMEL_KEPT(RowProbabilities, row, reference, unit, discrepancy, log_evidence, entropy_bits,
             printed, readings, classes, credible_classes, leading, further_numbers)
TRAMMEL_KEPT(ExcludedReadings, reason, first, readings)
TRAMMEL_KEPT(ModelProbabilities, rows, excluded)
TRAMMEL_KEPT(EffectScene, scene, analysis, tolerance, change, minimal, whole_s, chosen_s,
             deciding_s)
}  // namespace trammel::results

namespace trammel::harness {

/// The numbers of the computation that is being written or read, beside its structure: the reader
/// of CBOR takes bytes one by one.
inline thread_local std::string written_numbers;
inline thread_local std::string_view read_numbers;

template <class Number>
std::size_t append(const std::vector<Number>& numbers) {
  const std::size_t length = numbers.size() * sizeof(Number);
  written_numbers.append(reinterpret_cast<const char*>(numbers.data()), length);
  return length;
}

/// Where they are: first byte and length.
template <class Number>
nlohmann::json packed(const std::vector<Number>& numbers) {
  const std::size_t start = written_numbers.size();
  return {start, append(numbers)};
}

/// @throws std::exception  where they are not there.
template <class Number>
void take(std::size_t start, std::size_t length, std::vector<Number>& numbers) {
  if (length % sizeof(Number) != 0 || start > read_numbers.size() ||
      length > read_numbers.size() - start)
    throw std::runtime_error("expected whole numbers");
  numbers.resize(length / sizeof(Number));
  std::copy_n(read_numbers.data() + start, length, reinterpret_cast<char*>(numbers.data()));
}

/// @throws std::exception  where the JSON is not what `packed` gives.
template <class Number>
void unpack(const nlohmann::json& json, std::vector<Number>& numbers) {
  take(json.at(0).get<std::size_t>(), json.at(1).get<std::size_t>(), numbers);
}

/// All names in one text and all numbers in a row, for there are hundreds of quantities.
inline void to_json(nlohmann::json& out, const Quantities& quantities) {
  std::string names;
  std::vector<std::size_t> lengths = {written_numbers.size()};
  for (const auto& [name, quantity] : quantities) {
    const auto& [values, roundoff] = quantity;
    names += name;
    lengths.insert(lengths.end(), {name.size(), append(values), append(roundoff)});
  }
  out = {names, packed(lengths)};
}
inline void from_json(const nlohmann::json& in, Quantities& quantities) {
  const auto& names = in.at(0).get_ref<const std::string&>();
  std::vector<std::size_t> lengths;
  unpack(in.at(1), lengths);
  std::size_t letter = 0, start = lengths.at(0);
  for (std::size_t i = 1; i < lengths.size(); i += 3) {
    Quantity& quantity = quantities[names.substr(letter, lengths[i])];
    letter += lengths[i];
    take(start, lengths.at(i + 1), quantity.values);
    take(start + lengths[i + 1], lengths.at(i + 2), quantity.roundoff);
    start += lengths[i + 1] + lengths[i + 2];
  }
}

inline void to_json(nlohmann::json& out, const Drawing::Shape& shape) {
  const auto& [label, displacement] = shape;
  out = {label, packed(displacement)};
}
inline void from_json(const nlohmann::json& in, Drawing::Shape& shape) {
  in.at(0).get_to(shape.label);
  unpack(in.at(1), shape.displacement);
}

/// Many moments of a motion: seven digits are enough of what is only drawn.
inline nlohmann::json drawn(const std::vector<Eigen::Vector2d>& points) {
  std::vector<Eigen::Vector2f> rounded;
  for (const Eigen::Vector2d& point : points) rounded.emplace_back(point.cast<float>());
  return packed(rounded);
}
inline std::vector<Eigen::Vector2d> drawn(const nlohmann::json& json) {
  std::vector<Eigen::Vector2f> rounded;
  unpack(json, rounded);
  std::vector<Eigen::Vector2d> points;
  for (const Eigen::Vector2f& point : rounded) points.emplace_back(point.cast<double>());
  return points;
}

inline void to_json(nlohmann::json& out, const Drawing::Pose& pose) {
  const auto& [label, nodes, time, displacement] = pose;
  out = {label, drawn(nodes), packed(std::vector<double>{time}), drawn(displacement)};
}
inline void from_json(const nlohmann::json& in, Drawing::Pose& pose) {
  in.at(0).get_to(pose.label);
  pose.nodes = drawn(in.at(1));
  std::vector<double> time;
  unpack(in.at(2), time);
  pose.time = time.at(0);
  pose.displacement = drawn(in.at(3));
}

TRAMMEL_KEPT(Drawing::Joint, node, kind, name)

inline void to_json(nlohmann::json& out, const Drawing& drawing) {
  const auto& [nodes, members, triangles, joints, shapes, poses] = drawing;
  out = {packed(nodes), packed(members), triangles, joints, shapes, poses};
}
inline void from_json(const nlohmann::json& in, Drawing& drawing) {
  unpack(in.at(0), drawing.nodes);
  unpack(in.at(1), drawing.members);
  in.at(2).get_to(drawing.triangles);
  in.at(3).get_to(drawing.joints);
  in.at(4).get_to(drawing.shapes);
  in.at(5).get_to(drawing.poses);
}

TRAMMEL_KEPT(EvaluationTime, name, wall_s, evaluations)
TRAMMEL_KEPT(EffectReason, effect, applicable, active, number, change, why)
TRAMMEL_KEPT(Warning, quantity, value, unit, meaning)
TRAMMEL_KEPT(AnalysisResult, outcome, evidence, quantities, drawing, counters, timings, warnings,
             analysis, effects, model_probabilities)
TRAMMEL_KEPT(SweepLevel, parameter, quantities)
TRAMMEL_KEPT(Sweep, name, levels)
TRAMMEL_KEPT(StatedInput, name, why, pointers, half_width, nominal)
TRAMMEL_KEPT(NumericalEstimate, refinement, quantity, index, parameter, values, order, factor,
             half_width)
TRAMMEL_KEPT(Comparison, simulation, reference, u_num, u_input, u_reference)
TRAMMEL_KEPT(Validation, difference, u_val, low, high, verdict, text)
TRAMMEL_KEPT(ComparedEntry, check, quantity, unit, reference, index, comparison, validation,
             u_input_sampled, contribution, dominant, dominant_share, spread, literal_comparison,
             literal, u_input_literal_sampled)
TRAMMEL_KEPT(ValidationUncertainty, inputs, samples, failed, literal_samples, literal_failed,
             numerical, entries)
TRAMMEL_KEPT(SolverIdentity, name, version, element_order, digits)
TRAMMEL_KEPT(Computation, status, reason, error, result, sweeps, uncertainty, wall_s, cpu_s,
             uncertainty_wall_s, references, machine, solver)

TRAMMEL_KEPT(ErrorNorms, max, rms, mean)
TRAMMEL_KEPT(Timing, cpu_s, median_s, lower_quartile_s, upper_quartile_s, wall_median_s, runs_each)
TRAMMEL_KEPT(RelativeTime, median, low, high)
TRAMMEL_KEPT(MeasuredSetting, status, reason, error, output_errors, timing, relative, cpu_s,
             counters)
TRAMMEL_KEPT(SandboxedRun, termination, reason, values, quantities, counters, cpu_s)

namespace {

struct KeptStudy {
  std::vector<MeasuredSetting> settings;
  double wall_s = 0;
  std::map<std::string, std::string> references;
};
TRAMMEL_KEPT(KeptStudy, settings, wall_s, references)

/// Tells half a file or a damaged one, eight bytes at a time: a hash that holds against malice
/// takes as long as all the reading.
std::string checksum(std::string_view bytes) {
  std::uint64_t sum = bytes.size();
  for (std::size_t i = 0; i < bytes.size(); i += sizeof sum) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min(sizeof word, bytes.size() - i));
    sum = (sum ^ word) * 0x9e3779b97f4a7c15U;  // odd, so that no bit is lost
    sum ^= sum >> 32U;
  }
  return {reinterpret_cast<const char*>(&sum), sizeof sum};
}
constexpr std::size_t kChecksumLength = sizeof(std::uint64_t);

std::string with_checksum(const std::string& bytes) {
  return checksum(bytes) + bytes;
}

std::string_view without_checksum(std::string_view bytes) {
  const std::string_view body = bytes.substr(std::min(kChecksumLength, bytes.size()));
  if (body.empty() || checksum(body) != bytes.substr(0, kChecksumLength))
    throw std::runtime_error("the computation ended without an answer");
  return body;
}

/// Numbers and structure of what is kept.
template <class Kept>
std::string stored_bytes(const Kept& kept) {
  written_numbers.clear();
  std::string structure;
  nlohmann::json::to_cbor(nlohmann::json(kept), structure);
  const std::uint64_t length = written_numbers.size();
  const std::string head(reinterpret_cast<const char*>(&length), sizeof length);
  return with_checksum(head + std::exchange(written_numbers, {}) + structure);
}

template <class Kept>
Kept stored_from(std::string_view bytes) {
  std::string_view body = without_checksum(bytes);
  std::uint64_t length = 0;
  if (body.size() < sizeof length) throw std::runtime_error("expected a computation");
  std::memcpy(&length, body.data(), sizeof length);
  body.remove_prefix(sizeof length);
  read_numbers = body.substr(0, length);
  return nlohmann::json::from_cbor(body.substr(read_numbers.size())).get<Kept>();
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

std::string to_bytes(const Json& json) {
  std::string bytes;
  Json::to_cbor(json, bytes);
  return with_checksum(bytes);
}
Json json_from(const std::string& bytes) {
  return Json::from_cbor(without_checksum(bytes));
}

std::string to_bytes(const Computation& computation) {
  return stored_bytes(computation);
}

Computation computation_from(const std::string& bytes) {
  return stored_from<Computation>(bytes);
}

bool find_stored(const std::filesystem::path& file, Computation& computation, bool any_machine) {
  try {
    Computation found = computation_from(read_text(file));
    if (!stand(found.references)) return false;
    const bool timed = !any_machine && !found.result.timings.empty();
    if (timed && found.machine != machine_name()) return false;
    computation = std::move(found);
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

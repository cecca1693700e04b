#include "harness/run/run_store.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <vector>

#include "harness/base/content_hash.h"
#include "harness/base/environment.h"
#include "harness/base/json_file.h"
#include "harness/input/catalogue.h"

/// A struct with all its members: one that is not named here does not compile.
#define TRAMMEL_KEPT(Type, ...)                                       \
  NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Type, __VA_ARGS__)               \
  [[maybe_unused]] static void name_all_members(const Type& whole_) { \
    [[maybe_unused]] const auto& [__VA_ARGS__] = whole_;              \
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
struct adl_serializer<Eigen::Vector2d> {
  static void to_json(json& out, const Eigen::Vector2d& point) {
    out = json::array({point.x(), point.y()});
  }
  static void from_json(const json& in, Eigen::Vector2d& point) {
    point = {in.at(0).get<double>(), in.at(1).get<double>()};
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

namespace trammel::harness {

TRAMMEL_KEPT(Quantity, values, roundoff)
TRAMMEL_KEPT(Drawing::Joint, node, kind, name)
TRAMMEL_KEPT(Drawing::Shape, label, displacement)
TRAMMEL_KEPT(Drawing::Pose, label, nodes)
TRAMMEL_KEPT(Drawing, nodes, members, triangles, joints, shapes, poses)
TRAMMEL_KEPT(EvaluationTime, name, wall_s, evaluations)
TRAMMEL_KEPT(EffectReason, effect, applicable, active, number, change, why)
TRAMMEL_KEPT(Warning, quantity, value, unit, meaning)
TRAMMEL_KEPT(AnalysisResult, outcome, evidence, quantities, drawing, counters, timings, warnings,
             analysis, effects)
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
TRAMMEL_KEPT(Computation, status, reason, error, result, sweeps, uncertainty, wall_s, cpu_s,
             uncertainty_wall_s, references, machine)

namespace {

constexpr std::size_t kHashLength = 36;

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

std::string computation_name(const Document& document, bool requested) {
  static const std::string program = program_hash();
  const std::string file = std::filesystem::absolute(document.origin("").file).string();
  const Json all = {program, requested, file, document.value(), tried_cases(document)};
  return content_hash(all.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::string to_bytes(const Computation& computation) {
  std::string bytes;
  nlohmann::json::to_cbor(computation, bytes);
  return content_hash(bytes) + bytes;
}

Computation computation_from(const std::string& bytes) {
  const std::string body = bytes.size() > kHashLength ? bytes.substr(kHashLength) : "";
  if (body.empty() || content_hash(body) != bytes.substr(0, kHashLength))
    throw std::runtime_error("the computation ended without an answer");
  return nlohmann::json::from_cbor(body).get<Computation>();
}

bool find_stored(const std::filesystem::path& file, Computation& computation) {
  try {
    Computation found = computation_from(read_text(file));
    const bool stands =
        std::all_of(found.references.begin(), found.references.end(),
                    [](const auto& item) { return file_hash(item.first) == item.second; }) &&
        (found.result.timings.empty() || found.machine == machine_name());
    if (stands) computation = std::move(found);
    return stands;
  } catch (const std::exception&) {
    return false;  // half a file, or of another version
  }
}

std::string machine_name() {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  return environment()["processor"].get<std::string>() + " of " + host.data();
}

}  // namespace trammel::harness

#include "harness/studies/accuracy_search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "harness/analysis/analysis.h"
#include "harness/base/stopwatch.h"
#include "harness/base/text.h"
#include "harness/studies/cost.h"

namespace trammel::harness {
namespace {

struct Option {
  std::string title = {};
  Json patch = Json::object();
};

constexpr int kFinestMesh = 7, kFinestStep = 6;  // 2^7 elements, the step of the case / 16
constexpr double kStepOfCoarsest = 4;            // over that of the case

/// Pointers to every value of that key in the model.
void find_key(const Json& json, const std::string& key, const std::string& at,
              std::vector<std::string>& found) {
  if (!json.is_object()) return;
  for (const auto& [name, value] : json.items()) {
    const std::string pointer = (JsonPointer(at) / name).to_string();
    if (name == key && !value.is_object()) {
      found.push_back(pointer);
    } else {
      find_key(value, key, pointer, found);
    }
  }
}

void put(const Json& document, const std::string& pointer, const Json& value, Json& patch) {
  compose(patch, patch_at(document, pointer, value));
}

/// Every option of one kind with every option of the other.
std::vector<Option> combined(const std::vector<Option>& a, const std::vector<Option>& b) {
  std::vector<Option> all;
  for (const Option& first : a) {
    for (const Option& second : b) {
      Option both = first;
      both.title += (first.title.empty() || second.title.empty() ? "" : ", ") + second.title;
      compose(both.patch, second.patch);
      all.push_back(std::move(both));
    }
  }
  return all;
}

class Search {
 public:
  Search(const Case& given, const std::string& variant, const AccuracyRequest& request,
         const ComputeSetting& compute, const std::function<void(std::size_t)>& progress)
      : base_(patched(given, variant)),
        json_(base_.value()),
        analysis_(analysis_kind(base_)),
        request_(request),
        compute_(compute),
        progress_(progress) {
    found_.study = empty_study(given, variant);
  }

  AccuracySearch run() {
    observed_ = observed_quantities();
    outputs_ = fixed_outputs();
    const std::vector<Option> models = combined(combined(theories(), tiers()), integrators());
    has_mesh_ = mesh_patch(0).has_value();
    has_step_ = step_place().has_value();
    if (!has_mesh_ && !has_step_ && models.size() == 1)
      throw base_.error("/analysis", "expected a case with a mesh, a theory or a step to vary");
    find_reference(models);
    for (const Option& model : models) try_model(model);
    return std::move(found_);
  }

 private:
  /// As the case has it, or of its kinds those that a user looks at first.
  std::vector<ObservedQuantity> observed_quantities() {
    Setting as_it_stands;
    as_it_stands.document = base_;
    const SandboxedRun result = compute_within_limit(as_it_stands);
    if (!solved(result))
      throw base_.error("/analysis", "expected a case that is solved: " + result.reason);
    static const std::vector<std::string> kUsual = {"frequency_Hz",     "load_factor",
                                                    "displacement_x_m", "displacement_y_m",
                                                    "position_x_m",     "position_y_m"};
    const bool asked = !request_.quantities.empty();
    std::vector<ObservedQuantity> observed;
    for (const std::string& wanted : asked ? request_.quantities : kUsual) {
      bool any = false;
      for (const auto& [name, values] : result.quantities) {
        if (name != wanted && name.substr(0, name.find(':')) != wanted) continue;
        any = true;
        if (std::ranges::any_of(values, [](double value) { return value != 0; }))
          observed.push_back({name, "", "", {}, false, {}});
      }
      if (asked && !any) {
        std::vector<std::string> names;
        for (const auto& item : result.quantities) names.push_back(item.first);
        throw base_.error("/analysis", "expected a quantity of the case (got '" +
                                           printable(wanted) + "')" + did_you_mean(wanted, names));
      }
    }
    if (observed.empty())
      throw base_.error("/analysis",
                        "expected --quantity: the case has neither displacements, positions, "
                        "frequencies nor load factors other than zero");
    return observed;
  }

  std::vector<Option> theories() const {
    const Json& model = json_.value("model", Json::object());
    std::vector<std::string> places;
    if (model.contains("members"))
      for (const auto& item : model["members"].items())
        places.push_back((JsonPointer("/model/members") / item.key()).to_string());
    if (model.contains("manipulator")) {
      places.emplace_back("/model/manipulator/links");
      for (const char* part : {"proximal", "distal"})
        if (model["manipulator"]["links"].contains(part))
          places.push_back(std::string("/model/manipulator/links/") + part);
    }
    if (places.empty()) return {Option{}};
    std::vector<Option> options;
    for (const auto& [title, name] :
         {std::pair("Euler-Bernoulli", "euler-bernoulli"), {"Timoshenko", "timoshenko"}}) {
      Option option{title, Json::object()};
      for (const std::string& place : places) put(json_, place, {{"beam", name}}, option.patch);
      options.push_back(std::move(option));
    }
    return options;
  }

  std::vector<Option> tiers() const {
    if (analysis_ != "statics" || json_["model"].contains("manipulator")) return {Option{}};
    return {{"linear", {{"analysis", {{"statics", {{"second_order", false}}}}}}},
            {"second order", {{"analysis", {{"statics", {{"second_order", true}}}}}}},
            {"large displacement",
             {{"analysis", {{"statics", nullptr}, {"large-statics", Json::object()}}}}}};
  }

  std::vector<Option> integrators() const {
    const auto options = [this](const char* key,
                                const std::vector<std::pair<std::string, Json>>& values) {
      std::vector<Option> all;
      for (const auto& [title, value] : values)
        all.push_back({title, {{"analysis", {{analysis_, {{key, value}}}}}}});
      return all;
    };
    if (analysis_ == "transient") {
      return options("method", {{"modal superposition", "modal-superposition"},
                                {"generalized-alpha 0.8", {{"spectral_radius", 0.8}}},
                                {"average acceleration", "average-acceleration"}});
    }
    if (analysis_ == "elastodynamics") {
      return options(
          "scheme", {{"generalized-alpha 0.8", {{"generalized-alpha", {{"spectral_radius", 0.8}}}}},
                     {"average acceleration", "newmark"}});
    }
    if (analysis_ == "large-motion") {
      return options("integrator", {{"energy-momentum", "energy-momentum"},
                                    {"generalized-alpha", "generalized-alpha"}});
    }
    return {Option{}};
  }

  /// 2^level elements a member, as many divisions of plates, so many refinements of a platform with
  /// pins: without them its joints are points, and what they give grows with each refinement.
  std::optional<Json> mesh_patch(int level) const {
    if (!json_.contains("model")) return std::nullopt;
    const Json& model = json_["model"];
    const int count = 1 << level;
    Json patch = Json::object();
    std::vector<std::string> places;
    find_key(model, "elements", "/model", places);
    for (const std::string& place : places) put(json_, place, count, patch);
    if (model.contains("members")) patch["model"]["elements"] = count;
    if (model.contains("plates")) {
      for (const auto& [name, plate] : model["plates"].items())
        if (plate.contains("blocks")) patch["model"]["plates"][name]["divisions"] = count;
    }
    if (model.contains("manipulator")) {
      patch["model"]["manipulator"]["links"]["elements"] = count;
      const Json& platform = model["manipulator"]["platform"];
      if (platform["kind"] == "triangles" && platform.value("pin_radius_m", 0.0) > 0)
        patch["model"]["manipulator"]["platform"]["refinements"] = level;
    }
    if (patch.empty()) return std::nullopt;
    return patch;
  }

  std::optional<std::string> step_place() const {
    const std::string place = "/analysis/" + analysis_ + "/step_s";
    if (!json_.contains(JsonPointer(place))) return std::nullopt;
    return place;
  }

  /// The times that are observed, the same for every step.
  Json fixed_outputs() const {
    const Json& analysis = json_["analysis"][analysis_];
    Json patch = Json::object();
    if (analysis_ == "transient" && !analysis.contains("samples")) {
      const double steps = analysis["duration_s"].get<double>() / analysis["step_s"].get<double>();
      patch["analysis"][analysis_]["samples"] = std::clamp<int>(static_cast<int>(steps), 1, 200);
    }
    if (analysis_ == "large-motion" && !analysis.contains("output_step_s")) {
      patch["analysis"][analysis_]["output_step_s"] =
          kStepOfCoarsest * analysis["step_s"].get<double>();
    }
    return patch;
  }

  struct Place {
    int mesh = 0, step = 0;
  };

  Setting setting(const Option& model, Place at, Json& patch) const {
    Setting out;
    out.curve = out.curve_title = model.title;
    out.title = model.title;
    patch = model.patch;
    const auto append = [&](const std::string& text) {
      out.title += (out.title.empty() ? "" : ", ") + text;
    };
    if (has_mesh_) {
      compose(patch, *mesh_patch(at.mesh));
      const Json& model_json = json_["model"];
      const bool members = model_json.contains("members") || model_json.contains("manipulator");
      append(std::to_string(1 << at.mesh) + (members ? " element" : " division") +
             (at.mesh == 0 ? "" : "s"));
      out.value = 1 << at.mesh;
    }
    if (has_step_) {
      const std::string place = *step_place();
      const double step =
          json_[JsonPointer(place)].get<double>() * kStepOfCoarsest / (1 << at.step);
      put(json_, place, step, patch);
      append("step " + shortest(step) + " s");
    }
    out.document = base_;
    Json whole = outputs_;
    compose(whole, patch);
    out.document.apply_patch("setting '" + out.title + "'", "", whole);
    out.observed = observed_;
    return out;
  }

  bool in_time() {
    if (watch_.wall_s() < request_.time_limit_s) return true;
    found_.out_of_time = true;
    return false;
  }

  SandboxedRun compute_within_limit(const Setting& tried) const {
    const double left = std::max(1.0, request_.time_limit_s - watch_.wall_s());
    return compute_(tried, static_cast<int>(std::ceil(left)));
  }

  const SandboxedRun& run(const Option& model, Place at) {
    const auto [place, is_new] = runs_.try_emplace({model.title, at.mesh, at.step});
    if (!is_new) return place->second;
    Json patch;
    const Setting tried = setting(model, at, patch);
    try {
      tried.document.validate("case");
      place->second = compute_within_limit(tried);
    } catch (const InputError& error) {
      place->second.reason = error.what();
    }
    if (progress_) progress_(runs_.size());
    return place->second;
  }

  static bool solved(const SandboxedRun& run) {
    return run.termination == SandboxedRun::Termination::solved;
  }

  /// Eigenvalues count one by one, others against the largest of their kind.
  Scale scale() const {
    const bool by_entry = analysis_ == "modes" || analysis_ == "buckling";
    return {by_entry ? Scale::Kind::entry : Scale::Kind::quantity, 0};
  }

  double error_of(const SandboxedRun& run, const SandboxedRun& reference) const {
    for (std::size_t i = 0; i < run.values.size(); ++i) {  // fewer modes, say
      if (run.values[i].size() != reference.values[i].size())
        return std::numeric_limits<double>::infinity();
    }
    return *error_norms(run.values, reference.values, scale()).max;
  }

  /// Mesh, then step, are halved until that changes a tenth of the accuracy asked for.
  /// @return the last change
  double refine(const Option& model) {
    const auto along = [&](bool there, int Place::*level, int finest) {
      double change = there ? std::numeric_limits<double>::infinity() : 0;
      while (there && at_.*level < finest && change > request_.accuracy / 10 && in_time()) {
        const Place before = at_;
        ++(at_.*level);
        const SandboxedRun& fine = run(model, at_);
        const SandboxedRun& coarse = run(model, before);
        if (solved(fine) && solved(coarse)) change = error_of(coarse, fine);
        if (fine.termination == SandboxedRun::Termination::timed_out) at_ = before;
      }
      return change;
    };
    at_ = {};
    const double by_mesh = along(has_mesh_, &Place::mesh, kFinestMesh);
    return std::max(by_mesh, along(has_step_, &Place::step, kFinestStep));
  }

  /// By the richest model that is solved.
  void find_reference(const std::vector<Option>& models) {
    std::string reason;
    for (auto model = models.rbegin(); model != models.rend() && reference_ == nullptr; ++model) {
      found_.reference_change = refine(*model);
      const SandboxedRun& richest = run(*model, at_);
      if (solved(richest)) {
        reference_ = &richest;
        Json patch;
        found_.study.reference_description = setting(*model, at_, patch).title;
      } else if (reason.empty()) {
        reason = richest.reason;
      }
    }
    if (reference_ == nullptr)
      throw base_.error("/analysis", "expected a reference solution: " + reason);
    for (std::size_t i = 0; i < observed_.size(); ++i) observed_[i].exact = reference_->values[i];
    CostStudy& study = found_.study;
    StudyOutput& output = study.outputs.front();
    output.scale = scale();
    output.scale_description = output.scale.kind == Scale::Kind::entry
                                   ? "relative to each true value"
                                   : "relative to the largest true value of each quantity";
    study.time_limit_s = static_cast<int>(std::ceil(request_.time_limit_s));
    Setting as_it_stands;
    as_it_stands.curve = as_it_stands.curve_title = as_it_stands.title = "the case as it stands";
    as_it_stands.document = base_;
    if (!outputs_.empty()) as_it_stands.document.apply_patch("fixed outputs", "", outputs_);
    as_it_stands.observed = observed_;
    study.settings.push_back(std::move(as_it_stands));
    found_.patches.push_back(Json::object());
  }

  /// From coarse to fine, until a mesh reaches the accuracy with some step.
  void try_model(const Option& model) {
    for (int mesh = 0; mesh <= at_.mesh; ++mesh) {
      for (int step = 0; step <= at_.step; ++step) {
        const bool known = runs_.count({model.title, mesh, step}) > 0;
        if (!known && !in_time()) return;
        const SandboxedRun& trial = run(model, {mesh, step});
        if (&trial == reference_) return;  // the reference itself is not a choice
        TriedSetting tried;
        Setting candidate = setting(model, {mesh, step}, tried.patch);
        tried.title = candidate.title;
        tried.error = solved(trial) ? error_of(trial, *reference_) : 0;
        if (!solved(trial)) tried.reason = trial.reason.empty() ? "no solution" : trial.reason;
        const bool within = solved(trial) && tried.error <= request_.accuracy;
        if (within) {
          found_.patches.push_back(tried.patch);
          found_.study.settings.push_back(std::move(candidate));
        }
        found_.tried.push_back(std::move(tried));
        if (within) return;
      }
    }
  }

  Document base_;
  const Json& json_;
  std::string analysis_;
  const AccuracyRequest& request_;
  const ComputeSetting& compute_;
  const std::function<void(std::size_t)>& progress_;
  Stopwatch watch_;
  AccuracySearch found_;
  std::vector<ObservedQuantity> observed_;
  Json outputs_;
  bool has_mesh_ = false, has_step_ = false;
  Place at_;  // of the reference
  std::map<std::tuple<std::string, int, int>, SandboxedRun> runs_;
  const SandboxedRun* reference_ = nullptr;
};

}  // namespace

AccuracySearch search_accuracy(const Case& given, const std::string& variant,
                               const AccuracyRequest& request, const ComputeSetting& compute,
                               const std::function<void(std::size_t)>& progress) {
  return Search(given, variant, request, compute, progress).run();
}

}  // namespace trammel::harness

#include "harness/analysis/size_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "harness/base/text.h"
#include "harness/input/json_view.h"

namespace trammel::harness {
namespace {

// Memory [bytes] per coordinate of the model, per non-zero of a matrix factor and per recorded
// number. These numbers were measured and include a margin (size_estimate_test). Coordinates
// require memory in the model, matrices and states. Recorded numbers are also written as JSON and
// drawn.
constexpr double kCoordinate = 2500, kEntry = 24, kNumber = 44;
/// Memory per number of a sensitivity map, and per number of the samples of a neural network
/// [bytes]. The numbers of a map are rounded and drawn; the numbers of samples are read from JSON.
constexpr double kMapNumber = 90, kSampleNumber = 500;
/// Bytes per recorded number of a frequency response.
constexpr double kResponseNumber = 22;

/// Returns the memory per coordinate of an analysis, relative to the memory of statics, which is
/// the largest.
double relative_memory(const std::string& kind, const JsonView& analysis, bool in_plane) {
  if (kind == "manufactured") return 0.5;
  if (kind != "harmonic" || in_plane) return 1;
  return analysis.has("damping") ? 0.75 : 0.45;
}

class Estimator {
 public:
  explicit Estimator(const Document& document) : document_(document), root_(document) {}

  SizeEstimate run() {
    const auto [kind, analysis] = root_["analysis"].entries().front();
    share_in_plane_ = relative_memory(kind, analysis, true);
    share_of_members_ = relative_memory(kind, analysis, false);
    if (kind == "grnn") numbers_ = 50;
    if (root_.has("model")) count_model(root_["model"]);
    if (kind == "study") {
      if (analysis.get("trajectory", false)) {  // the study has one case per point
        add(path_, points_ * 20 * static_cast<double>(document_.value().dump().size()));
      }
    } else {
      add(path_, points_ * numbers_ * kNumber);
      count_analysis(kind, analysis);
    }
    for (const auto& [pointer, bytes] : bytes_) {
      size_.bytes += bytes;
      if (size_.cause.empty() || bytes > bytes_[size_.cause]) size_.cause = pointer;
    }
    return size_;
  }

 private:
  void add(const std::string& pointer, double bytes) { bytes_[pointer] += bytes; }

  void add_coordinates(const JsonView& key, double count, bool in_plane) {
    const double entries = count * (in_plane ? 16 * std::log2(count + 2) : 12);
    size_.coordinates += count;
    size_.non_zeros += entries;
    add(key.pointer(), (in_plane ? share_in_plane_ : share_of_members_) *
                           (kCoordinate * count + kEntry * entries));
  }

  void count_model(const JsonView& model) {
    count_members(model);
    if (const auto plates = model.find("plates"))
      for (const auto& entry : plates->entries()) count_plate(entry.second);
    if (const auto manipulator = model.find("manipulator")) {
      const JsonView links = (*manipulator)["links"];
      for (const char* which : {"proximal", "distal"}) {
        const JsonView own = links.has(which) ? links[which] : links;
        count_elements(own.has("elements") ? own : links, links, 3);
      }
      const JsonView platform = (*manipulator)["platform"];
      if (const auto refinements = platform.find("refinements")) {
        const int middles = platform.has("element") && platform.text("element") == "six-node";
        add_coordinates(*refinements, 3 * std::pow(4, refinements->get<double>() + middles), true);
      }
    }
    if (const auto trajectory = model.find("trajectory")) {
      const JsonView path = trajectory->entries().front().second;
      if (path.has("points")) {
        points_ = path.number("points");
        path_ = path["points"].pointer();
      }
    }
  }

  void count_elements(const JsonView& owner, const JsonView& model, double members) {
    const JsonView& where = owner.has("elements") ? owner : model;
    const bool stated = where.has("elements");
    const double elements = stated ? where.number("elements") : 1;
    add_coordinates(stated ? where["elements"] : owner, 3 * members * elements, false);
  }

  void count_members(const JsonView& model) {
    if (const auto members = model.find("members")) {
      for (const auto& entry : members->entries()) count_elements(entry.second, model, 1);
      numbers_ += 12 * static_cast<double>(members->size());
    }
    if (const auto nodes = model.find("nodes")) numbers_ += 9 * static_cast<double>(nodes->size());
  }

  void count_plate(const JsonView& plate) {
    const auto blocks = plate.find("blocks");
    if (!blocks) return;
    const double of_cell = plate.get<std::string>("element", "three-node") == "six-node" ? 8 : 2;
    const double divisions = plate.get("divisions", 1.0);
    for (const auto& entry : blocks->entries()) {
      const JsonView& block = entry.second;
      const double cells = block.has("cells")
                               ? block["cells"][0].get<double>() * block["cells"][1].get<double>()
                               : 1;
      const bool divided = plate.has("divisions") && divisions * divisions >= cells;
      add_coordinates(divided              ? plate["divisions"]
                      : block.has("cells") ? block["cells"]
                                           : block,
                      of_cell * cells * divisions * divisions, true);
    }
  }

  void count_analysis(const std::string& kind, const JsonView& analysis) {
    const double n = size_.coordinates;
    const auto outputs = [&] {
      return 5.0 + (analysis.has("outputs") ? static_cast<double>(analysis["outputs"].size()) : 0);
    };
    if (analysis.has("eigensolver") && analysis["eigensolver"].json() == "dense")
      add(analysis["eigensolver"].pointer(), 64 * n * n);
    if (const auto count = analysis.find("count"))
      add(count->pointer(), 64 * n * std::min(count->get<double>(), n));
    if (kind == "transient") {
      if (analysis.has("method") && analysis["method"].json() == "modal-superposition")
        add(analysis["method"].pointer(), 80 * n * n);
      const double steps = analysis.number("duration_s") / analysis.number("step_s");
      const double samples = analysis.get("samples", std::clamp(steps, 1.0, 1e4));
      add(analysis[analysis.has("samples") ? "samples" : "step_s"].pointer(),
          samples * (40 * n + kNumber * outputs()));
    } else if (kind == "harmonic" && analysis.has("points")) {
      add(analysis["points"].pointer(), analysis.number("points") * kResponseNumber * outputs());
    } else if (kind == "large-statics") {
      add("/analysis/large-statics", 2 * kCoordinate * n);
    } else if (kind == "large-motion" &&
               (analysis.has("output_step_s") || !analysis.has("tolerance"))) {
      const char* key = analysis.has("output_step_s") ? "output_step_s" : "step_s";
      const double samples = analysis.number("end_time_s") / analysis.number(key);
      add(analysis[key].pointer(), samples * numbers_ * kNumber);
    } else if (kind == "elastodynamics") {
      add(path_, points_ * n * 300);
    } else if (kind == "sensitivity-map") {
      const double cells = std::pow(analysis.number("columns"), 2);
      const bool positions = analysis.get("positions", true);
      add(analysis["columns"].pointer(),
          40 * cells + (positions ? 4 * kMapNumber * cells : 0) *
                           static_cast<double>(analysis["orientations_deg"].size()));
    } else if (kind == "grnn" && analysis.has("samples")) {
      for (const JsonView& rows :
           {analysis["samples"]["inputs"], analysis["samples"]["outputs"], analysis["queries"]})
        add(rows.pointer(), kSampleNumber * static_cast<double>(rows.size() * rows[0].size()));
    } else if (kind == "manufactured" && analysis.has("cells")) {
      const double cells = analysis.number("cells");
      const bool in_plane = analysis.has("membrane");
      const double of_cell =
          in_plane && analysis["membrane"].text("triangles") == "six-node" ? 8 : 2;
      add_coordinates(analysis["cells"], in_plane ? of_cell * cells * cells : 3 * cells, in_plane);
    }
  }

  const Document& document_;
  JsonView root_;
  SizeEstimate size_;
  std::map<std::string, double> bytes_;  ///< memory [bytes] by JSON pointer of its cause
  double points_ = 1, numbers_ = 100;    ///< counts: path points, recorded numbers per point
  double share_in_plane_ = 1, share_of_members_ = 1;
  std::string path_ = "/model";
};

}  // namespace

SizeEstimate estimate_problem_size(const Document& document) {
  return Estimator(document).run();
}

void require_sufficient_memory(const Document& document, double max_memory) {
  const SizeEstimate size = estimate_problem_size(document);
  const bool countable = size.non_zeros <= std::numeric_limits<int>::max();
  if (countable && size.bytes <= max_memory) return;
  throw document.error(size.cause,
                       "expected a computation of at most " + rounded(max_memory / 1e9, 3) + " GB" +
                           (countable ? "" : " and 2^31 non-zeros") + " (estimated " +
                           rounded(size.bytes / 1e9, 3) + " GB, " + rounded(size.coordinates, 3) +
                           " coordinates, " + rounded(size.non_zeros, 3) + " non-zeros)");
}

}  // namespace trammel::harness

#include "harness/analysis/analyse_model_probabilities.h"

#include <algorithm>
#include <cmath>

#include "harness/base/find_or_add.h"
#include "harness/base/numbers.h"
#include "harness/readers/manipulator_reader.h"
#include "solver/manipulator/pose_modes.h"

namespace trammel::harness {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using solver::ManipulatorDesign;
using solver::Pose;

constexpr Index kRowCandidates = 7;  ///< modes among which the row's are looked for
constexpr Index kSolvedModes = 10;   ///< three of them may be rigid motions
constexpr double kThicknessStep =
    0.01;                           ///< relative, of a difference: the curve bends by 1e-4 of it
constexpr std::size_t kAngles = 4;  ///< in a third of the circle: by symmetry the rest is the same
constexpr double kCredible = 0.95;
constexpr std::size_t kListed = 8;         ///< classes of a row in the results
const double kEven = 1 / std::sqrt(12.0);  ///< standard deviation of an even spread of width 1

/// Numbers of a cell: the modes, the first frequency with the platform turned, the thickness.
constexpr Index kTurned = kRowCandidates, kThickness = kRowCandidates + 1,
                kNumbers = kRowCandidates + 2;

/// Unknowns of the readings, as the case has them.
struct Unknowns {
  double thickness_half_width = 0;  ///< relative
  std::vector<double> stiffness;    ///< nodes [N m/rad]
  double radius = 0, turn = 0;      ///< of the circle [m]; of the platform, for a further number
  Pose centre;
};

/// Relative.
double half_width_of(const references::Reference& number) {
  return number.uncertainty.at(0) / number.values.at(0);
}

bool is_sprung(const ManipulatorDesign& design) {
  return design.active[0].kind == solver::ActiveKind::sprung ||
         design.elbow[0].kind == solver::ElbowKind::sprung ||
         design.platform_joint[0].kind == solver::PlatformJointKind::sprung;
}

void set_stiffness(ManipulatorDesign& design, double stiffness) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (design.active[i].kind == solver::ActiveKind::sprung) design.active[i].stiffness = stiffness;
    if (design.elbow[i].kind == solver::ElbowKind::sprung) design.elbow[i].stiffness = stiffness;
    if (design.platform_joint[i].kind == solver::PlatformJointKind::sprung)
      design.platform_joint[i].stiffness = stiffness;
  }
}

/// Logarithms of the lowest frequencies at each pose, rigid motions left out; a column a pose.
/// @throws ModelError  where the design has no meaning or no modes.
MatrixXd log_frequencies(const ManipulatorDesign& design, const std::vector<Pose>& poses) {
  solver::PoseModesOptions options;
  options.count = kSolvedModes;
  options.threads = 1;
  const solver::PoseModes modes = solver::solve_pose_modes(design, poses, options);
  MatrixXd found = MatrixXd::Constant(kRowCandidates, static_cast<Index>(poses.size()), kNaN);
  for (std::size_t p = 0; p < poses.size(); ++p) {
    if (!modes.outcome[p].solved()) throw solver::ModelError(modes.outcome[p].reason);
    const Index rigid = modes.zero_energy_mode_count[p], column = static_cast<Index>(p);
    const Index count = std::min(kRowCandidates, modes.frequency.rows() - rigid);
    found.col(column).head(count) = modes.frequency.col(column).segment(rigid, count).array().log();
  }
  return found;
}

/// Of one stiffness: the numbers at the centre (column 0) and at points of the circle, and how the
/// thickness and the mesh change them.
struct Node {
  MatrixXd numbers;
  VectorXd by_thickness, by_mesh;
};

Node node_of(const ManipulatorDesign& design, const Unknowns& unknowns) {
  std::vector<Pose> poses = {unknowns.centre};
  for (std::size_t k = 0; k < kAngles; ++k) {
    const double angle = 2 * M_PI / 3 * static_cast<double>(k) / kAngles;
    poses.push_back({unknowns.centre.x + unknowns.radius * std::cos(angle),
                     unknowns.centre.y + unknowns.radius * std::sin(angle), unknowns.centre.phi});
  }
  poses.push_back({unknowns.centre.x, unknowns.centre.y, unknowns.centre.phi + unknowns.turn});
  const MatrixXd modes = log_frequencies(design, poses);
  ManipulatorDesign thicker = design, coarse = design;
  for (std::size_t i = 0; i < 3; ++i) {
    for (auto* link : {&thicker.proximal[i], &thicker.distal[i]})
      link->thickness *= 1 + kThicknessStep;
    coarse.proximal[i].elements = coarse.distal[i].elements = 1;
  }
  Node node;
  node.numbers = MatrixXd::Constant(kNumbers, 1 + kAngles, 0);
  node.numbers.topRows(kRowCandidates) = modes.leftCols(1 + kAngles);
  node.numbers.row(kTurned).setConstant(modes(0, 1 + kAngles));
  node.numbers.row(kThickness).setConstant(std::log(design.proximal[0].thickness));
  const auto change = [&](const ManipulatorDesign& other) {
    VectorXd by = VectorXd::Zero(kNumbers);
    by.head(kRowCandidates) = log_frequencies(other, {unknowns.centre}).col(0) - modes.col(0);
    by(kTurned) = by(0);
    return by;
  };
  node.by_thickness = change(thicker) / std::log(1 + kThicknessStep);
  node.by_thickness(kThickness) = 1;
  // A mesh of one element may have fewer modes than the row may be chosen from.
  node.by_mesh = change(coarse).unaryExpr([](double x) { return std::isfinite(x) ? x : 0.0; });
  return node;
}

/// Cells between nodes of the stiffness (one node: none) and along the circle.
std::vector<PredictedCell> cells_between(const std::vector<Node>& nodes, double thickness) {
  std::vector<PredictedCell> cells;
  const std::size_t spans = std::max<std::size_t>(1, nodes.size() - 1);
  for (std::size_t s = 0; s < spans; ++s) {
    const Node& low = nodes[s];
    const Node& high = nodes[std::min(s + 1, nodes.size() - 1)];
    for (std::size_t a = 0; a <= kAngles; ++a) {  // the centre, then the parts of the circle
      const Index here = static_cast<Index>(a),
                  there = a == 0 ? 0 : 1 + static_cast<Index>(a % kAngles);
      const VectorXd at_low = (low.numbers.col(here) + low.numbers.col(there)) / 2;
      const VectorXd at_high = (high.numbers.col(here) + high.numbers.col(there)) / 2;
      PredictedCell cell;
      cell.weight = (a == 0 ? 0.5 : 0.5 / kAngles) / static_cast<double>(spans);
      const VectorXd by_mesh = (low.by_mesh + high.by_mesh) / 2;
      cell.log_numbers = (at_low + at_high) / 2 + by_mesh / 2;
      cell.spread = MatrixXd::Zero(kNumbers, 4);
      cell.spread.col(0) = (low.by_thickness + high.by_thickness) * thickness * kEven;
      cell.spread.col(1) = by_mesh * kEven;
      cell.spread.col(2) = (at_high - at_low) * kEven;
      cell.spread.col(3) = (low.numbers.col(there) - low.numbers.col(here) +
                            high.numbers.col(there) - high.numbers.col(here)) /
                           2 * kEven;
      cells.push_back(std::move(cell));
    }
  }
  return cells;
}

std::vector<PredictedCell> cells_of(ManipulatorDesign design, const Unknowns& unknowns) {
  std::vector<Node> nodes;
  if (!is_sprung(design)) {
    nodes.push_back(node_of(design, unknowns));
  } else {
    for (const double stiffness : unknowns.stiffness) {
      set_stiffness(design, stiffness);
      nodes.push_back(node_of(design, unknowns));
    }
  }
  return cells_between(nodes, unknowns.thickness_half_width);
}

struct Combination {
  std::string title;
  Document document;
};

std::vector<Combination> combinations_of(const Document& document, const JsonView& factors) {
  Document scene = document;
  const Origin written = document.origin(factors.pointer());
  const Json modes = {{"model-probabilities", nullptr}, {"modes", {{"count", 1}}}};
  scene.apply_patch(written.file, written.pointer, {{"analysis", modes}});
  std::vector<Combination> found = {{"", scene}};
  for (const auto& [factor, alternatives] : factors.entries()) {
    std::vector<Combination> more;
    for (const Combination& some : found) {
      for (const auto& [name, patch] : alternatives.entries()) {
        const Origin origin = document.origin(patch.pointer());
        more.push_back({some.title + (some.title.empty() ? "" : ", ") + name, some.document});
        more.back().document.apply_patch(origin.file, origin.pointer, patch.json());
      }
    }
    found = std::move(more);
  }
  return found;
}

Unknowns read_unknowns(const Document& document, const JsonView& place,
                       const References& references) {
  Unknowns unknowns;
  unknowns.thickness_half_width = half_width_of(references.get(place["thickness"]));
  const JsonView stiffness = place["stiffness_N_m_per_rad"];
  const double low = stiffness["between"][0].get<double>(),
               high = stiffness["between"][1].get<double>();
  const int points = stiffness["points"].get<int>();
  if (!(low < high)) throw stiffness.error("expected the lower limit first");
  for (int i = 0; i < points; ++i)
    unknowns.stiffness.push_back(low * std::pow(high / low, i / (points - 1.0)));
  unknowns.radius = place.number("circle_radius_m");
  unknowns.turn = place.number("turned_rad");
  const JsonView pose = JsonView(document)["model"]["pose"];
  unknowns.centre = {pose.number("x_m"), pose.number("y_m"), pose.get("phi_rad", 0.0)};
  return unknowns;
}

void exclude(const std::string& reason, const std::string& title,
             std::vector<results::ExcludedReadings>& excluded) {
  const auto is_known = [&](const auto& some) { return some.reason == reason; };
  ++find_or_add(excluded, is_known, {reason, title, 0}).readings;
}

/// Computed elsewhere at some values of their unknowns, each as probable as the others.
std::vector<ModelReading> stored_readings(const JsonView& place,
                                          const references::Reference& thickness,
                                          const References& references) {
  std::vector<ModelReading> found;
  for (const auto& [title, stored] : place["readings"].entries()) {
    ModelReading reading{title, 0, place.number("noise"), {}};
    for (const auto& [number, id] : stored.entries()) {
      const references::Reference& computed = references.get(id);
      PredictedCell cell;
      cell.weight = 1 / static_cast<double>(stored.size());
      cell.log_numbers = VectorXd::Constant(kNumbers, kNaN);
      cell.spread = MatrixXd::Zero(kNumbers, 1);
      for (std::size_t i = 0; i < computed.values.size() && i < kRowCandidates; ++i) {
        cell.log_numbers(static_cast<Index>(i)) = std::log(computed.values[i]);
        // as bending of links of their own mass
        cell.spread(static_cast<Index>(i), 0) = 2 * half_width_of(thickness) * kEven;
      }
      cell.log_numbers(kThickness) = std::log(thickness.values.at(0));
      cell.spread(kThickness, 0) = 2 * half_width_of(thickness) * kEven;
      reading.cells.push_back(std::move(cell));
    }
    found.push_back(std::move(reading));
  }
  return found;
}

/// What a row and a discrepancy say, ready to be written.
results::RowProbabilities results_of(const ModelReadings& all, const PrintedRow& row,
                                     const ModelProbabilities& found, double discrepancy,
                                     double digits) {
  results::RowProbabilities out;
  out.discrepancy = discrepancy;
  out.log_evidence = found.log_evidence;
  out.entropy_bits = found.entropy_bits();
  out.readings = static_cast<int>(all.readings.size());
  out.classes = static_cast<int>(found.classes.size());
  out.credible_classes = static_cast<int>(found.credible_count(kCredible));
  for (std::size_t k = 0; k < std::min(kListed, found.classes.size()); ++k) {
    const ReadingClass& some = found.classes[k];
    const auto best = std::ranges::find_if(found.cells, [&](const CellPosterior& cell) {
      return std::ranges::count(some.readings, cell.reading) > 0;
    });
    results::ReadingClass listed{all.readings[some.readings.front()].title,
                                 static_cast<int>(some.readings.size()),
                                 some.probability,
                                 {}};
    if (best == found.cells.end()) break;  // of no probability
    for (const double x : conditional_prediction(all.readings, row, *best, discrepancy))
      listed.values.push_back(std::exp(x));
    out.leading.push_back(std::move(listed));
  }
  const auto add_further = [&](const char* name, Index number, double resolution) {
    out.further_numbers.push_back(
        {name, expected_information(all.readings, row, found, number, discrepancy, resolution)});
  };
  add_further("the seventh frequency", kRowCandidates - 1, std::hypot(discrepancy, digits));
  add_further("the first frequency with the platform turned", kTurned,
              std::hypot(discrepancy, digits));
  add_further("two further digits of the links' thickness", kThickness, digits);
  std::ranges::stable_sort(out.further_numbers, [](const auto& a, const auto& b) {
    return a.expected_information_bits > b.expected_information_bits;
  });
  return out;
}

void record_row(const std::string& name, const results::RowProbabilities& row, Recorder& record) {
  record.add("log_evidence", name, *row.log_evidence);
  record.add("class_count", name, row.classes);
  record.add("class_entropy_bits", name, *row.entropy_bits);
  record.add("credible_class_count", name, row.credible_classes);
  record.add("largest_class_probability", name, *row.leading.front().probability);
  for (const results::FurtherNumber& further : row.further_numbers)
    if (&further == &row.further_numbers.front())
      record.add("expected_information_bits", name, *further.expected_information_bits);
}

}  // namespace

PrintedRow printed_row(const references::Reference& reference) {
  PrintedRow row;
  const auto size = static_cast<Index>(reference.values.size());
  const Eigen::Map<const VectorXd> values(reference.values.data(), size);
  row.log_numbers = values.array().log();
  row.digits =
      Eigen::Map<const VectorXd>(reference.uncertainty.data(), size).cwiseQuotient(values) * 2 *
      kEven;
  return row;
}

ModelReadings read_model_readings(const Document& document, const References& references) {
  const JsonView place = JsonView(document)["analysis"]["model-probabilities"];
  const auto model = JsonView(document).find("model");
  if (!model || !model->has("manipulator") || !model->has("pose"))
    throw place.error("expected a model with a manipulator and a pose");
  const Unknowns unknowns = read_unknowns(document, place, references);
  ModelReadings all;
  for (const Combination& some : combinations_of(document, place["factors"])) {
    some.document.validate("case");
    try {
      const ManipulatorDesign design =
          read_manipulator(JsonView(some.document)["model"]["manipulator"]);
      all.readings.push_back({some.title, 1, 0, cells_of(design, unknowns)});
    } catch (const InputError& error) {
      exclude(error.what(), some.title, all.excluded);
    } catch (const solver::ModelError& error) {
      exclude(error.what(), some.title, all.excluded);
    }
  }
  double others = 0;
  const std::size_t own = all.readings.size();
  if (const auto stored = place.find("stored")) {
    for (ModelReading& reading :
         stored_readings(*stored, references.get(place["thickness"]), references))
      all.readings.push_back(std::move(reading));
    others = stored->number("probability");
  }
  if (own == 0) throw place["factors"].error("expected a combination that has modes");
  for (std::size_t r = 0; r < all.readings.size(); ++r)
    all.readings[r].prior = r < own ? (1 - others) / static_cast<double>(own)
                                    : others / static_cast<double>(all.readings.size() - own);
  return all;
}

StepResult analyse_model_probabilities(const Document& document, const References& references, bool,
                                       Recorder& record) {
  const JsonView place = JsonView(document)["analysis"]["model-probabilities"];
  ModelReadings all = read_model_readings(document, references);
  record.add("reading_count", "", static_cast<double>(all.readings.size()));
  double excluded = 0;
  for (const results::ExcludedReadings& some : all.excluded) excluded += some.readings;
  record.add("excluded_reading_count", "", excluded);
  StepResult result;
  result.model_probabilities.emplace();
  for (const auto& [name, id] : place["rows"].entries()) {
    const references::Reference& reference = references.get(id);
    const PrintedRow row = printed_row(reference);
    if (row.log_numbers.size() > kRowCandidates || !row.log_numbers.allFinite())
      throw id.error("expected at most " + std::to_string(kRowCandidates) + " positive numbers");
    for (const auto& [number, discrepancy] : place["discrepancy"].entries()) {
      const double s = discrepancy.get<double>();
      const ModelProbabilities found = model_probabilities(all.readings, row, kRowCandidates, s);
      results::RowProbabilities out = results_of(all, row, found, s, row.digits.maxCoeff());
      out.row = name;
      out.reference = reference.id;
      out.unit = reference.unit;
      for (const double value : reference.values) out.printed.push_back(value);
      record_row(name, out, record);
      result.model_probabilities->rows.push_back(std::move(out));
    }
  }
  result.model_probabilities->excluded = std::move(all.excluded);
  return result;
}

}  // namespace trammel::harness

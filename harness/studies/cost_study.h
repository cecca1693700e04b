#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/base/quantity.h"
#include "harness/input/case.h"
#include "harness/input/reference_library.h"
#include "harness/results/cost_results.h"

/// Studies of what accuracy costs in time: settings of one computation, to be measured against one
/// truth.
namespace trammel::harness {

/// A quantity that an error is measured of.
struct ObservedQuantity {
  std::string quantity;
  std::string addend;              ///< another quantity, added entry by entry; empty: none
  std::string statistic;           ///< one number from the entries; empty: the entries themselves
  std::vector<std::size_t> index;  ///< empty: all
  bool is_error = false;           ///< the values are relative errors themselves
  std::vector<double> exact;       ///< from a reference; empty: from the study's truth
  std::size_t output = 0;          ///< of the study's outputs

  /// Whether it needs the study's truth.
  [[nodiscard]] bool needs_reference_solution() const { return !is_error && exact.empty(); }
};

/// The values of what is observed, one list a quantity.
using Observations = std::vector<std::vector<double>>;

/// @throws std::runtime_error  naming a quantity that is not there or has other than as many
///                             entries as its index or exact values ask for.
[[nodiscard]] Observations observe(const Quantities& quantities,
                                   const std::vector<ObservedQuantity>& observed);

/// One way of computing: a case or variant with all patches laid over it.
struct Setting {
  std::string curve, curve_title;  ///< what it is joined to
  std::string title;               ///< with its value: "consistent mass, 4 elements a link"
  std::optional<double> value;     ///< along the curve
  Document document;
  std::vector<ObservedQuantity> observed;
};

/// What an error is divided by.
struct Scale {
  /// The entry itself, the largest of its quantity, the largest of all, a number.
  enum class Kind { entry, quantity, largest, number } kind = Kind::entry;
  double number = 0;
};

/// What errors are measured of together, with one scale: where P is, the torques of the drives.
struct StudyOutput {
  std::string title;  ///< empty where it is the only one
  Scale scale;
  std::string scale_description;
};

struct CostStudy {
  std::string id, family, title, description;
  std::vector<Setting> settings;  ///< curve by curve, coarse to fine
  std::optional<Setting>
      reference_solution;             ///< where the observed quantities have no exact values
  std::string reference_description;  ///< what errors are measured against
  std::size_t baseline = 0;           ///< among the settings
  /// The first is that of figure, front and conclusion; every setting gives it, the others where it
  /// can.
  std::vector<StudyOutput> outputs{1};
  std::string norm = "max";  ///< of results::ErrorNorms
  int time_limit_s = 60;
};

/// Which values of the curves.
enum class SweepExtent { full, quick };

/// @throws InputError  where the file breaks its schema, a case or value is not there, or a patched
///                     setting breaks the schema of cases.
[[nodiscard]] CostStudy load_cost_study(const std::filesystem::path& file, SweepExtent extent,
                                        const References& references);

/// A study of that case or variant, named after it, without settings yet.
[[nodiscard]] CostStudy empty_study(const Case& given, const std::string& variant);

/// Whether a file holds a study, not a case.
[[nodiscard]] bool is_cost_study(const std::filesystem::path& file);

/// The studies of the catalogue, by name.
[[nodiscard]] std::vector<std::filesystem::path> cost_study_files();

using results::SandboxedRun;

/// Computes a setting once, in a process of its own that is ended when it has used up its processor
/// time: an endless loop or a crash costs no more than that.
/// @param waiting  called about once a second until then
[[nodiscard]] SandboxedRun run_sandboxed(const Setting& setting, int time_limit_s,
                                         const References& references,
                                         const std::function<void()>& waiting = {});

/// The refinements of a case as a study: a curve for each of the sweeps named (all when none is),
/// measured of what they name or else the checks do, against references of kind exact or computed,
/// or else against the finest level of the first one. The coarsest level of all is the baseline.
/// @throws InputError  where the case has no such sweep, or nothing can be measured.
[[nodiscard]] CostStudy cost_study_of_sweeps(const Case& given, const std::string& variant,
                                             const std::vector<std::string>& sweeps,
                                             const References& references);

}  // namespace trammel::harness

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

/// Studies of the computing time that accuracy requires. Settings of one computation are measured
/// against one reference solution.
namespace trammel::harness {

/// Quantity whose error is measured.
struct ObservedQuantity {
  std::string quantity;
  std::string addend;              ///< another quantity, added entry by entry; empty: none
  std::string statistic;           ///< reduces the entries to one number; empty: the entries
                                   ///< themselves
  std::vector<std::size_t> index;  ///< selected entries; empty: all
  bool is_error = false;           ///< the values are relative errors
  /// Exact values from a reference; empty: the study's reference solution applies.
  std::vector<double> exact;
  std::size_t output = 0;  ///< index among the study's outputs

  /// Returns true if the quantity needs the study's reference solution.
  [[nodiscard]] bool needs_reference_solution() const { return !is_error && exact.empty(); }
};

/// Values of the observed quantities, one list per quantity.
using Observations = std::vector<std::vector<double>>;

/// Extracts the observed quantities.
/// @throws std::runtime_error  with the name of a quantity that is missing. Also throws for a
///     number of entries other than the index or the exact values require.
[[nodiscard]] Observations extract_observations(const Quantities& quantities,
                                                const std::vector<ObservedQuantity>& observed);

/// One setting of a computation: a case or variant with the patches of a point on a curve.
struct Setting {
  std::string curve, curve_title;  ///< curve of the setting in the figure
  std::string title;               ///< title with the value: "consistent mass, 4 elements a link"
  std::optional<double> value;     ///< value of the parameter along the curve
  Document document;
  std::vector<ObservedQuantity> observed;
};

/// Divisor of an error.
struct Scale {
  /// Magnitude of the entry, largest magnitude of the quantity, largest of all quantities, or a
  /// fixed number.
  enum class Kind { entry, quantity, largest, number } kind = Kind::entry;
  double number = 0;
};

/// Quantities whose errors share one scale, for example the position of P or the torques of the
/// drives.
struct StudyOutput {
  std::string title;  ///< empty if there is only one output
  Scale scale;
  std::string scale_description;
};

struct CostStudy {
  std::string id, family, title, description;
  std::vector<Setting> settings;  ///< curve by curve, coarse to fine
  std::optional<Setting>
      reference_solution;             ///< used if the observed quantities have no exact values
  std::string reference_description;  ///< description of the solution that errors are measured
                                      ///< against
  std::size_t baseline = 0;           ///< index among the settings
  /// Outputs. The first one defines figure, front and conclusion, and every setting has it. The
  /// others are optional.
  std::vector<StudyOutput> outputs{1};
  std::string norm = "max";  ///< name of a member of results::ErrorNorms
  int time_limit_s = 60;
};

/// Extent of the values of the curves.
enum class SweepExtent { full, quick };

/// Loads a study.
/// @throws InputError  if the file or a patched setting violates its schema, or a case or value
///     does not exist.
[[nodiscard]] CostStudy load_cost_study(const std::filesystem::path& file, SweepExtent extent,
                                        const References& references);

/// Returns a study of the case or variant, named after it, without settings.
[[nodiscard]] CostStudy empty_study(const Case& given, const std::string& variant);

/// Returns true if a file contains a study, not a case.
[[nodiscard]] bool is_cost_study(const std::filesystem::path& file);

/// Returns the files of the catalogue's studies, by name.
[[nodiscard]] std::vector<std::filesystem::path> cost_study_files();

using results::SandboxedRun;

/// Computes a setting once, in a separate process. The process is ended when it exceeds its
/// processor time, so that endless loops and crashes are contained.
/// @param waiting  called about once a second until then
[[nodiscard]] SandboxedRun run_sandboxed(const Setting& setting, int time_limit_s,
                                         const References& references,
                                         const std::function<void()>& waiting = {});

/// Returns the refinements of a case as a study, with a curve for each named sweep, or all sweeps
/// if none is named.
/// The observed quantities are those of the sweeps, or else those of the checks. Their errors are
/// measured against references of kind exact or computed, or else against the finest level of the
/// first sweep. The baseline is the coarsest level of all.
/// @throws InputError  if the case has no such sweep, or nothing can be measured.
[[nodiscard]] CostStudy cost_study_of_sweeps(const Case& given, const std::string& variant,
                                             const std::vector<std::string>& sweeps,
                                             const References& references);

}  // namespace trammel::harness

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

/// Cost studies: computing time that an accuracy requires. The results of one computation with
/// several settings, such as meshes, are compared with one reference solution.
namespace trammel::harness {

/// Quantity of which a cost study measures the error.
struct ObservedQuantity {
  std::string quantity;
  std::string addend;  ///< name of a quantity that is added to each entry; empty: none
  /// Statistic that reduces the entries to one number, such as the maximum; empty: all entries.
  std::string statistic;
  std::vector<std::size_t> index;  ///< selected entries; empty: all
  bool is_error = false;           ///< true: the values are relative errors
  /// Exact values of the quantity. If empty, errors are differences from the reference solution of
  /// the study.
  std::vector<double> exact;
  std::size_t output = 0;  ///< index of the quantity's output in CostStudy::outputs

  /// Returns true if errors of the quantity require the study's reference solution.
  [[nodiscard]] bool needs_reference_solution() const { return !is_error && exact.empty(); }
};

/// Values of the observed quantities, one list per quantity.
using Observations = std::vector<std::vector<double>>;

/// Extracts the observed quantities.
/// @throws std::runtime_error  if a quantity is missing, or if its number of entries does not match
///     the index or the exact values.
[[nodiscard]] Observations extract_observations(const Quantities& quantities,
                                                const std::vector<ObservedQuantity>& observed);

/// One setting of a computation, such as a mesh: a case or variant with the patches of the setting.
struct Setting {
  std::string curve, curve_title;  ///< curve to which the setting belongs
  std::string title;               ///< for example "consistent mass, 4 elements a link"
  std::optional<double> value;     ///< value of the parameter along the curve
  Document document;
  std::vector<ObservedQuantity> observed;
};

/// Divisor that makes an error relative.
struct Scale {
  /// Divisor: magnitude of the entry, largest magnitude of the quantity or of all quantities, or a
  /// fixed number.
  enum class Kind { entry, quantity, largest, number } kind = Kind::entry;
  double number = 0;
};

/// Quantities whose errors share one scale, for example the position of P or the torques of the
/// drives.
struct StudyOutput {
  std::string title;  ///< empty if the study has a single output
  Scale scale;
  std::string scale_description;
};

struct CostStudy {
  std::string id, family, title, description;
  std::vector<Setting> settings;  ///< settings of all curves, each coarse to fine
  std::optional<Setting>
      /// Setting of the reference solution; used if quantities have no exact values.
      reference_solution;
  /// Description of the solution against which errors are measured.
  std::string reference_description;
  std::size_t baseline = 0;  ///< index of the setting to which times are relative
  /// The first output defines the figure, the Pareto front and the conclusion of the study. Every
  /// setting computes the first output; further outputs are optional.
  std::vector<StudyOutput> outputs{1};
  std::string norm = "max";  ///< norm of the errors: "max", "rms" or "mean"
  int time_limit_s = 60;
};

/// Settings of a cost study that are measured: those for all values of the parameters (full), or
/// for a short selection of values (quick).
enum class SweepExtent { full, quick };

/// Loads a cost study from a file.
/// @throws InputError  if the file or a patched setting violates its schema, or a case or value
///     does not exist.
[[nodiscard]] CostStudy load_cost_study(const std::filesystem::path& file, SweepExtent extent,
                                        const References& references);

/// Returns a cost study without settings, named after a case or variant.
[[nodiscard]] CostStudy cost_study_without_settings(const Case& given, const std::string& variant);

/// Returns true if a file contains a cost study, not a case.
[[nodiscard]] bool is_cost_study(const std::filesystem::path& file);

/// Returns the files of the catalogue's cost studies, sorted by name.
[[nodiscard]] std::vector<std::filesystem::path> cost_study_files();

using results::SandboxedRun;

/// Computes a setting once, in a separate process. The process is ended at the limit of its
/// processor time, so that endless loops and crashes are contained.
/// @param waiting  called about once a second until the process ends
[[nodiscard]] SandboxedRun run_sandboxed(const Setting& setting, int time_limit_s,
                                         const References& references,
                                         const std::function<void()>& waiting = {});

/// Returns a cost study of the refinement sweeps of a case, with one curve per named sweep, or per
/// sweep of the case if `sweeps` is empty. The observed quantities are those of the sweeps, or else
/// those of the checks. Their errors are measured against references of the kinds proved, exact or
/// computed, or else against the finest level of the first sweep. The baseline is the coarsest
/// level of the first sweep.
/// @throws InputError  if the case has no such sweep, or has no quantity with measurable errors.
[[nodiscard]] CostStudy cost_study_of_sweeps(const Case& given, const std::string& variant,
                                             const std::vector<std::string>& sweeps,
                                             const References& references);

}  // namespace trammel::harness

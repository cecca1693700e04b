#include "harness/run/stored_results.h"

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <utility>

#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/input/schema.h"
#include "harness/results/unfinished_folder.h"
#include "harness/run/results.h"
#include "harness/run/run_store.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;

/// Beside the computation: what was judged of it.
fs::path judged_file(const fs::path& stored) {
  return fs::path(stored).replace_extension(".judged.cbor");
}

/// What stands in results.json: numbers and verdicts.
results::Run summary_of(const results::Run& run) {
  results::Run kept;
  kept.case_id = run.case_id;
  kept.variant = run.variant;
  kept.status = run.status;
  kept.reason = run.reason;
  kept.residuals = run.residuals;
  kept.warnings = run.warnings;
  kept.checks = run.checks;
  kept.cost = run.cost;
  kept.stored = run.stored;
  for (const auto& quantity : run.quantities)
    if (quantity.second.size() <= kSummaryEntries) kept.quantities.push_back(quantity);
  return kept;
}

results::Run studies_of(const results::Run& run) {
  results::Run kept;
  kept.case_id = run.case_id;
  kept.variant = run.variant;
  kept.convergence = run.convergence;
  kept.uncertainty = run.uncertainty;
  kept.effects = run.effects;
  kept.model_probabilities = run.model_probabilities;
  return kept;
}

/// The folder that a report will stand in, while it is written beside a former one.
fs::path place_of(const fs::path& folder) {
  return folder.filename() == results::kUnfinishedFolder ? folder.parent_path() : folder;
}

}  // namespace

fs::path write_results(const results::Results& results, const fs::path& folder) {
  // All but the runs, whose series may be most of the memory.
  const auto& [format, environment, cases, references, runs, solver, uncertainty_coverage, cost,
               claims, coverage, effect_scenes, history, store, missing] = results;
  results::Results summary{
      format, environment, cases,    references,    {},      solver, uncertainty_coverage,
      cost,   claims,      coverage, effect_scenes, history, store,  missing};
  for (const results::Run& run : runs) {
    summary.runs.push_back(run.stored.empty() ? run : summary_of(run));
    if (!run.stored.empty())
      write_file(judged_file(fs::path(results.store) / run.stored),
                 to_bytes(to_json(studies_of(run))));
  }
  if (!results.store.empty())
    summary.store = fs::proximate(results.store, place_of(folder)).string();
  fs::path file = folder / "results.json";
  write_file(file, pretty(to_json(summary), kLineDepth));
  return file;
}

results::Results read_summary(const fs::path& file) {
  return read_summary(file, read_json(file));
}

results::Results read_summary(const fs::path& file, Json json) {
  if (const auto fault = find_schema_fault(json, "results"))
    throw InputError(file.string(), fault->pointer, fault->message);
  try {
    results::Results results = results::read_results(std::move(json));
    if (!results.store.empty())
      results.store = (file.parent_path() / results.store).lexically_normal().string();
    return results;
  } catch (const std::runtime_error& error) {
    throw InputError(file.string() + ": " + error.what());
  }
}

bool take_stored_series(results::Run& run, const fs::path& store) {
  try {
    results::Run series = stored_series(computation_from(read_text(store / run.stored)));
    const bool same = std::ranges::all_of(run.quantities, [&](const auto& own) {
      const results::Numbers* other = series.quantity(own.first);
      return other != nullptr && *other == own.second;
    });
    if (!same) return false;  // it is of another run
    run.quantities = std::move(series.quantities);
    run.drawing = std::move(series.drawing);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

bool take_stored_studies(results::Run& run, const fs::path& store) {
  try {
    results::Run studies = results::read_run(json_from(read_text(judged_file(store / run.stored))));
    if (studies.case_id != run.case_id || studies.variant != run.variant) return false;
    run.convergence = std::move(studies.convergence);
    run.uncertainty = std::move(studies.uncertainty);
    run.effects = std::move(studies.effects);
    run.model_probabilities = std::move(studies.model_probabilities);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

results::Results load_results(const fs::path& file) {
  results::Results results = read_summary(file);
  if (results.store.empty()) return results;
  std::size_t missing = 0;
  for (results::Run& run : results.runs)
    if (!run.stored.empty() &&
        !(take_stored_studies(run, results.store) && take_stored_series(run, results.store)))
      ++missing;
  if (missing > 0)
    results.missing =
        std::to_string(missing) + " of " + std::to_string(results.runs.size()) +
        " runs are without series, drawings and studies: expected them in the store " +
        results.store;
  results::complete(results);
  return results;
}

}  // namespace trammel::harness

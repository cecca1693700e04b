#include "harness/run/stored_results.h"

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <utility>

#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/input/document.h"
#include "harness/results/unfinished_folder.h"
#include "harness/run/run_store.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;

/// Returns the file of the convergence studies, which is next to the file of the run.
fs::path convergence_file(const fs::path& stored) {
  return fs::path(stored).replace_extension(".judged.cbor");
}

results::Number as_number(double value) {
  return value;
}

/// Returns the final folder of a report. The temporary folder, in which the report is written
/// first, is a subfolder of the final folder.
fs::path final_report_folder(const fs::path& folder) {
  return folder.filename() == results::kUnfinishedFolder ? folder.parent_path() : folder;
}

}  // namespace

fs::path write_results(const results::Results& results, const fs::path& folder) {
  for (const Run& run : results.runs)
    if (!run.stored.empty() && !run.sweeps.empty())
      write_file(convergence_file(fs::path(results.store) / run.stored),
                 serialize(run.convergence));
  Json json = to_json(results, true);
  if (!results.store.empty())
    json["store"] = fs::proximate(results.store, final_report_folder(folder)).string();
  fs::path file = folder / "results.json";
  write_file(file, format_json(json, kLineDepth));
  return file;
}

results::Results read_results_json(const fs::path& file) {
  return read_results_json(file, read_json(file));
}

results::Results read_results_json(const fs::path& file, Json json) {
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

bool load_stored_data(Run& run, const fs::path& store) {
  try {
    Run found = parse_run(read_text(store / run.stored));
    const bool same = std::ranges::all_of(run.quantities, [&](const auto& own) {
      const std::vector<double>* other = found.quantity(own.first);
      return other != nullptr &&
             std::ranges::equal(*other, own.second.values, {}, as_number, as_number);
    });
    if (!same) return false;  // the file contains another run
    if (!found.sweeps.empty())
      run.convergence = parse_convergence(read_text(convergence_file(store / run.stored)));
    run.quantities = std::move(found.quantities);
    run.drawing = std::move(found.drawing);
    run.uncertainty = std::move(found.uncertainty);
    run.effects = std::move(found.effects);
    run.model_probabilities = std::move(found.model_probabilities);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

results::Results load_results(const fs::path& file) {
  results::Results results = read_results_json(file);
  if (results.store.empty()) return results;
  std::size_t missing = 0;
  for (Run& run : results.runs)
    if (!run.stored.empty() && !load_stored_data(run, results.store)) ++missing;
  if (missing > 0)
    results.missing =
        std::to_string(missing) + " of " + std::to_string(results.runs.size()) +
        " runs have no series, drawings and studies, which are missing from the store " +
        results.store;
  results::complete_and_validate(results);
  return results;
}

}  // namespace trammel::harness

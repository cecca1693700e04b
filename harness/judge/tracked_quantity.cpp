#include "harness/judge/tracked_quantity.h"

#include <algorithm>

namespace trammel::harness {

bool is_exact(const references::Reference& reference) {
  return reference.kind == references::ReferenceKind::proved ||
         reference.kind == references::ReferenceKind::exact ||
         reference.kind == references::ReferenceKind::computed;
}

std::vector<TrackedQuantity> named_by_sweep(const JsonView& quantities,
                                            const References& references) {
  std::vector<TrackedQuantity> tracked_quantities;
  for (const auto& [name, entry] : quantities.entries()) {
    TrackedQuantity tracked_quantity{name, entry.get<std::string>("statistic", ""),
                                     entry.indices("index"), entry.indices("reference_index")};
    tracked_quantity.is_error = entry.get("is_error", false);
    if (entry.has("theory_order")) tracked_quantity.theory = entry.number("theory_order");
    if (entry.has("reference")) tracked_quantity.reference = &references.get(entry["reference"]);
    tracked_quantities.push_back(std::move(tracked_quantity));
  }
  return tracked_quantities;
}

std::vector<TrackedQuantity> named_by_checks(const Document& document,
                                             const std::vector<Check>& checks,
                                             const References& references) {
  std::vector<TrackedQuantity> tracked_quantities;
  if (checks.empty()) return tracked_quantities;
  const JsonView places = JsonView(document)["checks"];
  for (const Check& check : checks) {
    TrackedQuantity tracked_quantity{check.quantity, check.statistic, check.index,
                                     check.reference_index};
    if (!check.reference.empty()) {
      const references::Reference& reference = references.get(places[check.name]["reference"]);
      if (is_exact(reference)) tracked_quantity.reference = &reference;
    }
    const auto same = std::ranges::find_if(tracked_quantities, [&](const TrackedQuantity& other) {
      return other.quantity == tracked_quantity.quantity &&
             other.statistic == tracked_quantity.statistic;
    });
    if (same == tracked_quantities.end()) {
      tracked_quantities.push_back(std::move(tracked_quantity));
    } else if (same->reference == nullptr && tracked_quantity.reference != nullptr) {
      *same = std::move(tracked_quantity);
    }
  }
  return tracked_quantities;
}

}  // namespace trammel::harness

#include "harness/readers/damping_reader.h"

#include <iterator>

namespace trammel::harness {

namespace {

std::size_t count_of(const JsonView& modal, std::optional<solver::Index> known) {
  if (!modal.has("modes")) throw modal.error("expected the key 'modes': how many have the ratio");
  const JsonView stated = modal["modes"];
  if (!stated.json().is_string()) return stated.get<std::size_t>();
  if (known) return static_cast<std::size_t>(*known);
  throw stated.error("expected a number: all modes are known with 'modal-superposition' only");
}

}  // namespace

solver::HarmonicDamping read_damping(const JsonView& analysis, std::optional<solver::Index> modes) {
  solver::HarmonicDamping read;
  const auto damping = analysis.find("damping");
  if (!damping) return read;
  if (const auto rayleigh = damping->find("rayleigh")) {
    read.rayleigh = {rayleigh->get("mass_per_s", 0.0), rayleigh->get("stiffness_s", 0.0)};
  }
  const auto modal = damping->find("modal");
  if (!modal) return read;
  const JsonView ratio = (*modal)["ratio"];
  if (!ratio.json().is_array()) {
    read.modal_ratio.assign(count_of(*modal, modes), ratio.get<double>());
  } else if (modal->has("modes")) {
    throw(*modal)["modes"].error("expected it beside one ratio only (got a ratio for each mode)");
  } else {
    read.modal_ratio = ratio.get<std::vector<double>>();
  }
  if (modes && std::ssize(read.modal_ratio) > *modes) {
    throw modal->error("expected at most " + std::to_string(*modes) + " modes (got " +
                       std::to_string(read.modal_ratio.size()) + ")");
  }
  return read;
}

}  // namespace trammel::harness

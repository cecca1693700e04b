#include "references/beams/beam_modes.h"

#include "references/numerics/real.h"

namespace trammel::references {

namespace {

Real characteristic(const BeamEnds& ends, const Real& b) {
  const std::string& kind = ends.kind;
  const Real sech = 1 / cosh(b);
  const Real moment = sin(b) + cos(b) * tanh(b), force = cos(b) * tanh(b) - sin(b);
  if (kind == "pinned-pinned") return sin(b);
  if (kind == "clamped-clamped" || kind == "free-free") return cos(b) - sech;
  if (kind == "clamped-pinned" || kind == "pinned-free") return force;
  if (kind == "clamped-guided") return moment;
  const Real &mu = ends.tip_mass_ratio, &j = ends.tip_inertia_ratio;
  return sech + cos(b) + mu * b * force - j * b * b * b * moment +
         mu * j * b * b * b * b * (sech - cos(b));
}

}  // namespace

BeamEnds read_beam_ends(const Arguments& arguments) {
  BeamEnds ends;
  ends.kind = arguments.choice("ends", "",
                               {"clamped-free", "pinned-pinned", "clamped-clamped",
                                "clamped-pinned", "pinned-free", "free-free", "clamped-guided"});
  ends.tip_mass_ratio = arguments.not_negative("tip_mass_ratio", 0);
  ends.tip_inertia_ratio = arguments.not_negative("tip_inertia_ratio", 0);
  if (ends.kind != "clamped-free") {
    for (const char* key : {"tip_mass_ratio", "tip_inertia_ratio"}) {
      if (arguments.has(key)) arguments.fail(key, "only a clamped-free beam carries a tip mass");
    }
  }
  return ends;
}

std::vector<Real> beam_roots(const BeamEnds& ends, int count) {
  return first_roots([&](const Real& b) { return characteristic(ends, b); }, Real("0.001"),
                     Real("0.05"), count);
}

std::vector<Real> beam_modal_mass_program(const Arguments& arguments) {
  const Real mu = arguments.positive("tip_mass_ratio");
  std::vector<Real> shares;
  for (const Real& b : beam_roots({"clamped-free", mu, 0}, arguments.count("count"))) {
    const Real sech = 1 / cosh(b);
    const Real force = cos(b) * tanh(b) - sin(b);
    const Real derivative_mu = b * force;
    const Real derivative_b = -sech * tanh(b) - sin(b) + mu * force +
                              mu * b * (cos(b) * sech * sech - sin(b) * tanh(b) - cos(b));
    shares.push_back(1 - 4 * (mu / b) * derivative_mu / derivative_b);
  }
  return shares;
}

std::vector<Real> beam_roots_program(const Arguments& arguments) {
  const BeamEnds ends = read_beam_ends(arguments);
  return beam_roots(ends, arguments.count("count"));
}

std::vector<Real> beam_frequencies_program(const Arguments& arguments) {
  static_cast<void>(arguments.positive("width_m"));  // cancels from EI / rho A
  const Real length = arguments.positive("length_m");
  const Real thickness = arguments.positive("thickness_m");
  const Real radius_of_gyration = thickness / sqrt(Real(12));
  const Real wave_speed = sqrt(arguments.positive("E_Pa") / arguments.positive("rho_kg_m3"));
  const BeamEnds ends = read_beam_ends(arguments);
  std::vector<Real> frequencies;
  for (const Real& b : beam_roots(ends, arguments.count("count"))) {
    const Real wave_number = b / length;
    frequencies.push_back(static_cast<double>(wave_number * wave_number * radius_of_gyration *
                                              wave_speed / (2 * pi<Real>())));
  }
  return frequencies;
}

}  // namespace trammel::references

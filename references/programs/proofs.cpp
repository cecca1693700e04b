#include "references/programs/proofs.h"

#include "references/beams/beam_modes.h"
#include "references/frames/frame_arguments.h"
#include "references/frames/proved_frequencies.h"

namespace trammel::references {
namespace {

/// One inextensible member of unit length, mass and bending stiffness.
Frame unit_beam(const BeamEnds& ends) {
  Frame frame;
  frame.nodes = {{"A", {0, 0}}, {"B", {1, 0}}};
  FrameMember member;
  member.name = "beam";
  member.nodes = {0, 1};
  member.section.EI = 1;
  member.section.mass = 1;
  frame.members = {member};
  const std::size_t dash = ends.kind.find('-');
  const std::string held[] = {ends.kind.substr(0, dash), ends.kind.substr(dash + 1)};
  for (int node = 0; node < 2; ++node) {
    const bool clamped = held[node] == "clamped", guided = held[node] == "guided";
    // Something holds the beam along its axis, which is no motion of bending.
    frame.supports.push_back(
        {node, {node == 0, clamped || held[node] == "pinned", clamped || guided}});
  }
  if (ends.tip_mass_ratio != 0 || ends.tip_inertia_ratio != 0)
    frame.masses = {{1, ends.tip_mass_ratio, ends.tip_inertia_ratio, {}}};
  return frame;
}

}  // namespace

std::vector<std::string> prove_frame_frequencies(const Json& json) {
  const Arguments arguments(json, "", {"model", "manipulator", "pose", "count"});
  return proved_frequencies(frame_from_arguments(arguments), arguments.count("count"));
}

std::vector<std::string> prove_beam_roots(const Json& json) {
  const Arguments arguments(json, "", {"ends", "count", "tip_mass_ratio", "tip_inertia_ratio"});
  return proved_wave_numbers(unit_beam(read_beam_ends(arguments)), arguments.count("count"));
}

}  // namespace trammel::references

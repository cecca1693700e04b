#include "references/beams/programs.h"
#include "references/frames/wittrick_williams.h"
#include "references/numerics/ball.h"
#include "references/programs/program.h"

/// Natural frequencies as proved enclosures. In ball arithmetic, rounding cannot change the count
/// of Wittrick and Williams, which is an integer. If the counts at two frequencies differ by m,
/// then m natural frequencies lie between these two frequencies. A proof relies on the theorem of
/// Wittrick and Williams, on the formulas of `dynamic_stiffness.cpp` and on Arb.
namespace trammel::references {
namespace {

/// Variable x of the search for natural frequencies, such as the frequency in Hz. w(x) is the
/// circular frequency, and `near` contains approximations of x at the first natural frequencies.
struct Variable {
  Ball (*w)(const Ball& x);
  std::vector<Real> near;
};

class Proof {
 public:
  Proof(const Frame& frame, const Variable& variable, int rigid_motions)
      : stiffness_(frame), variable_(variable), below_(rigid_motions) {
    last_ = Ball(variable_.near.front() / 1000).middle();
  }

  std::vector<std::string> run() {
    std::vector<std::string> digits;
    while (digits.size() < variable_.near.size()) {
      const auto [root, multiplicity] = next(Ball(variable_.near[digits.size()]).middle());
      for (int i = 0; i < multiplicity && digits.size() < variable_.near.size(); ++i)
        digits.push_back(root.digits());
    }
    return digits;
  }

 private:
  struct Passage {
    Ball root;
    int multiplicity = 0;
  };

  [[nodiscard]] int count(const Ball& x) const {
    return stiffness_.wittrick_williams(variable_.w(x)).below;
  }

  /// Encloses the next x at which the count of natural frequencies increases, by bisection to the
  /// 32nd digit of x. The count does not change between the previous enclosure and the new
  /// enclosure, so that no natural frequency is missed.
  /// @param x  approximation of the result
  Passage next(const Ball& x) {
    Ball width = x * Ball(Real("1e-18"));
    // The bracket is not symmetric, so that bisection avoids x, which may be the exact root.
    Ball low = (x - width).middle(), high = (x + width * 2).middle();
    if (count(low) != below_) low = last_;
    if (count(low) != below_)
      throw DerivationError("the first frequency is below a thousandth of its approximate value");
    for (int i = 0; count(high) <= below_; ++i) {
      if (i > 5) throw DerivationError("no natural frequency is near its approximate value");
      width = width * 1000;
      high = (x + width).middle();
    }
    const Ball close = x * Ball(Real("1e-32"));
    while (high - low > close) {
      const Ball middle = ((low + high) / 2).middle();
      (count(middle) == below_ ? low : high) = middle;
    }
    const int above = count(high), multiplicity = above - below_;
    below_ = above;
    last_ = high;
    return {(low + high) / 2, multiplicity};
  }

  DynamicStiffness<Ball> stiffness_;
  const Variable& variable_;
  int below_;  ///< number of natural frequencies below `last_`
  Ball last_;  ///< upper end of the previous enclosure
};

/// Returns a frame of one inextensible member with unit length, mass and bending stiffness.
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
    // The first node is fixed along the axis, because axial motions are not bending motions.
    frame.supports.push_back(
        {node, {node == 0, clamped || held[node] == "pinned", clamped || guided}});
  }
  if (ends.tip_mass_ratio != 0 || ends.tip_inertia_ratio != 0)
    frame.masses = {{1, ends.tip_mass_ratio, ends.tip_inertia_ratio, {}}};
  return frame;
}

}  // namespace

std::vector<std::string> prove_frame_frequencies(const Arguments& arguments) {
  const Frame frame = frame_from_arguments(arguments);
  const FrameFrequencies found = frame_frequencies(frame, arguments.natural_number("count"));
  const Variable variable{[](const Ball& f) { return 2 * pi<Ball>() * f; }, found.frequencies};
  return Proof(frame, variable, found.rigid_motions).run();
}

std::vector<std::string> prove_beam_roots(const Arguments& arguments) {
  const Frame frame = unit_beam(read_beam_ends(arguments));
  const FrameFrequencies found = frame_frequencies(frame, arguments.natural_number("count"));
  Variable variable{[](const Ball& b) { return b * b; }, {}};
  for (const Real& f : found.frequencies) variable.near.push_back(sqrt(2 * pi<Real>() * f));
  return Proof(frame, variable, found.rigid_motions).run();
}

}  // namespace trammel::references

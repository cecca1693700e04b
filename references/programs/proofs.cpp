#include "references/beams/programs.h"
#include "references/frames/wittrick_williams.h"
#include "references/numerics/ball.h"
#include "references/programs/program.h"

/// Natural frequencies as proved enclosures: the count of Wittrick and Williams in ball arithmetic
/// is an integer that no rounding can change. If two counts differ by m, then m frequencies lie
/// between them. A proof relies on the theorem, on the formulas of `dynamic_stiffness.cpp` and on
/// Arb.
namespace trammel::references {
namespace {

/// x as a function of which w rises, and its numbers near the first frequencies.
struct Measure {
  Ball (*w)(const Ball& x);
  std::vector<Real> near;
};

class Proof {
 public:
  Proof(const Frame& frame, const Measure& measure, int rigid_motions)
      : stiffness_(frame), measure_(measure), below_(rigid_motions) {
    last_ = Ball(measure_.near.front() / 1000).middle();
  }

  std::vector<std::string> run() {
    std::vector<std::string> digits;
    while (digits.size() < measure_.near.size()) {
      const auto [root, multiplicity] = next(Ball(measure_.near[digits.size()]).middle());
      for (int i = 0; i < multiplicity && digits.size() < measure_.near.size(); ++i)
        digits.push_back(root.digits());
    }
    return digits;
  }

 private:
  struct Passage {
    Ball root;
    int multiplicity = 0;
  };

  [[nodiscard]] int count(const Ball& x) const { return stiffness_.count(measure_.w(x)).below; }

  /// The next passage, x near it, halved to its 32nd digit. None lies between the last one and this
  /// one, since the count stays the same.
  Passage next(const Ball& x) {
    Ball width = x * Ball(Real("1e-18"));
    Ball low = (x - width).middle(), high = (x + width * 2).middle();  // x may be exact: not midway
    if (count(low) != below_) low = last_;
    if (count(low) != below_) throw DerivationError("a frequency lies below the first one found");
    for (int i = 0; count(high) <= below_; ++i) {
      if (i > 5) throw DerivationError("no frequency lies where one was found");
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
  const Measure& measure_;
  int below_;  ///< frequencies below `last_`
  Ball last_;  ///< above the last passage
};

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

std::vector<std::string> prove_frame_frequencies(const Arguments& arguments) {
  const Frame frame = frame_from_arguments(arguments);
  const FrameFrequencies found = frame_frequencies(frame, arguments.count("count"));
  const Measure measure{[](const Ball& f) { return 2 * pi<Ball>() * f; }, found.frequencies};
  return Proof(frame, measure, found.rigid_motions).run();
}

std::vector<std::string> prove_beam_roots(const Arguments& arguments) {
  const Frame frame = unit_beam(read_beam_ends(arguments));
  const FrameFrequencies found = frame_frequencies(frame, arguments.count("count"));
  Measure measure{[](const Ball& b) { return b * b; }, {}};
  for (const Real& f : found.frequencies) measure.near.push_back(sqrt(2 * pi<Real>() * f));
  return Proof(frame, measure, found.rigid_motions).run();
}

}  // namespace trammel::references

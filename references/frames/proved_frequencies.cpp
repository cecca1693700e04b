#include "references/frames/proved_frequencies.h"

#include "references/frames/dynamic_stiffness.h"
#include "references/frames/wittrick_williams.h"
#include "references/numerics/arguments.h"
#include "references/numerics/ball.h"

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

}  // namespace

std::vector<std::string> proved_frequencies(const Frame& frame, int count) {
  const FrameFrequencies found = frame_frequencies(frame, count);
  const Measure measure{[](const Ball& f) { return 2 * pi<Ball>() * f; }, found.frequencies};
  return Proof(frame, measure, found.rigid_motions).run();
}

std::vector<std::string> proved_wave_numbers(const Frame& unit_beam, int count) {
  const FrameFrequencies found = frame_frequencies(unit_beam, count);
  Measure measure{[](const Ball& b) { return b * b; }, {}};
  for (const Real& f : found.frequencies) measure.near.push_back(sqrt(2 * pi<Real>() * f));
  return Proof(unit_beam, measure, found.rigid_motions).run();
}

}  // namespace trammel::references

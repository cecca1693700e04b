#include "harness/scene/member_chain.h"

#include <cmath>
#include <numbers>

#include "solver/elements/frame_element.h"
#include "solver/model/plane.h"

namespace trammel {
namespace {

/// The place at s in [0, 1] along the chain.
class Path {
 public:
  Path(const MemberChain& chain, const Vector2d& start, const Vector2d& end)
      : center_(chain.arc_center), start_(start), end_(end) {
    if (!center_) return;
    const Vector2d a = start - *center_;
    const Vector2d b = end - *center_;
    if (!(std::abs(a.norm() - b.norm()) <= 1e-9 * a.norm())) {
      throw ModelError("expected a centre as far from the first node as from the second (got " +
                       std::to_string(a.norm()) + " m and " + std::to_string(b.norm()) + " m)");
    }
    radius_ = a.norm();
    angle_ = std::atan2(a.y(), a.x());
    turn_ = std::atan2(cross(a, b), a.dot(b));
    if (turn_ <= 0) turn_ += 2 * std::numbers::pi;
  }

  [[nodiscard]] Vector2d at(double s) const {
    if (!center_) return start_ + s * (end_ - start_);
    const double angle = angle_ + s * turn_;
    return *center_ + radius_ * Vector2d(std::cos(angle), std::sin(angle));
  }

 private:
  std::optional<Vector2d> center_;
  Vector2d start_, end_;
  double radius_ = 0, angle_ = 0, turn_ = 0;
};

}  // namespace

void add_chain(const Member& member, const MemberChain& chain, const Vector2d& start,
               const Vector2d& end, Index first_node, Model& structure) {
  const Path path(chain, start, end);
  const auto section = [&](double s) {
    return chain.exponential ? interpolate_geometric(member.section, member.end_section, s)
                             : interpolate(member.section, member.end_section, s);
  };
  const bool is_bar = section(0.5).EI == 0;
  const MemberEnd inner{is_bar ? EndFixity::hinged : EndFixity::welded, 0, 0};
  const bool holds = chain.held[0] || chain.held[1] || chain.held[2];
  const auto count = static_cast<double>(member.elements);
  Member link = member;
  link.elements = 1;
  link.nodes[1] = member.nodes[0];
  for (Index i = 0; i < member.elements; ++i) {
    const bool last = i + 1 == member.elements;
    link.name = member.name + "." + std::to_string(i + 1);
    link.nodes[0] = link.nodes[1];
    link.nodes[1] = last ? member.nodes[1] : first_node + i;
    link.section = section(static_cast<double>(i) / count);
    link.end_section = section(static_cast<double>(i + 1) / count);
    link.ends = {i == 0 ? member.ends[0] : inner, last ? member.ends[1] : inner};
    structure.members.push_back(link);
    if (last) break;
    structure.nodes.push_back({"", path.at(static_cast<double>(i + 1) / count)});
    if (holds) structure.supports.push_back({"", link.nodes[1], chain.held});
  }
}

}  // namespace trammel

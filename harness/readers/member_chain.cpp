#include "harness/readers/member_chain.h"

#include <cmath>
#include <numbers>

#include "solver/elements/frame_element.h"
#include "solver/model/model.h"

namespace trammel::harness {
namespace {

/// The place at s in [0, 1] along the chain.
class ChainPath {
 public:
  ChainPath(const MemberChain& chain, const Eigen::Vector2d& start, const Eigen::Vector2d& end)
      : center_(chain.arc_center), start_(start), end_(end) {
    if (!center_) return;
    const Eigen::Vector2d a = start - *center_;
    const Eigen::Vector2d b = end - *center_;
    if (!(std::abs(a.norm() - b.norm()) <= 1e-9 * a.norm())) {
      throw solver::ModelError(
          "expected a centre as far from the first node as from the second (got " +
          std::to_string(a.norm()) + " m and " + std::to_string(b.norm()) + " m)");
    }
    radius_ = a.norm();
    angle_ = std::atan2(a.y(), a.x());
    turn_ = std::atan2(solver::cross(a, b), a.dot(b));
    if (turn_ <= 0) turn_ += 2 * std::numbers::pi;
  }

  [[nodiscard]] Eigen::Vector2d at(double s) const {
    if (!center_) return start_ + s * (end_ - start_);
    const double angle = angle_ + s * turn_;
    return *center_ + radius_ * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }

 private:
  std::optional<Eigen::Vector2d> center_;
  Eigen::Vector2d start_, end_;
  double radius_ = 0, angle_ = 0, turn_ = 0;
};

}  // namespace

void add_chain(const solver::Member& member, const MemberChain& chain, const Eigen::Vector2d& start,
               const Eigen::Vector2d& end, solver::Index first_node, solver::Model& structure) {
  const ChainPath path(chain, start, end);
  const bool is_bar = solver::section_at(member, 0.5).EI == 0;
  const solver::MemberEnd inner{is_bar ? solver::EndFixity::hinged : solver::EndFixity::welded, 0,
                                0};
  const bool holds = chain.held[0] || chain.held[1] || chain.held[2];
  const auto count = static_cast<double>(member.elements);
  solver::Member link = member;
  link.elements = 1;
  link.nodes[1] = member.nodes[0];
  for (solver::Index i = 0; i < member.elements; ++i) {
    const bool last = i + 1 == member.elements;
    link.name = member.name + "." + std::to_string(i + 1);
    link.nodes[0] = link.nodes[1];
    link.nodes[1] = last ? member.nodes[1] : first_node + i;
    link.section = solver::section_at(member, static_cast<double>(i) / count);
    link.end_section = solver::section_at(member, static_cast<double>(i + 1) / count);
    link.ends = {i == 0 ? member.ends[0] : inner, last ? member.ends[1] : inner};
    structure.members.push_back(link);
    if (last) break;
    structure.nodes.push_back({"", path.at(static_cast<double>(i + 1) / count)});
    if (holds) structure.supports.push_back({"", link.nodes[1], chain.held});
  }
}

}  // namespace trammel::harness

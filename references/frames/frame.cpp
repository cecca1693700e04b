#include "references/frames/frame.h"

#include <algorithm>

#include "references/numerics/arguments.h"

namespace trammel::references {

namespace {

template <class Named>
int find_name(const std::vector<Named>& items, const std::string& name) {
  const auto found =
      std::ranges::find_if(items, [&](const Named& item) { return item.name == name; });
  return found == items.end() ? -1 : static_cast<int>(found - items.begin());
}

}  // namespace

int Frame::find_node(const std::string& name) const {
  return find_name(nodes, name);
}

int Frame::find_member(const std::string& name) const {
  return find_name(members, name);
}

MemberAxis member_axis(const Frame& frame, const FrameMember& member) {
  const auto& a = frame.nodes[member.nodes[0]].position;
  const auto& b = frame.nodes[member.nodes[1]].position;
  const Real dx = b[0] - a[0];
  const Real dy = b[1] - a[1];
  const Real length = sqrt(dx * dx + dy * dy);
  if (length == 0) throw DerivationError("member " + member.name + " has no length");
  return {length, dx / length, dy / length};
}

}  // namespace trammel::references

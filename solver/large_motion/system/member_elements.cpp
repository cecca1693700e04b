#include "solver/large_motion/system/member_elements.h"

namespace trammel::solver::large_motion {

namespace {

template <int P>
void add_beams(const Model& model, const Layout& layout, SystemParts& parts) {
  auto group = std::make_unique<ConstraintElements<Beam<P>>>(layout.free, parts.rows);
  for (std::size_t e = 0; e < layout.elements.size(); ++e) {
    const MemberElement& element = layout.elements[e];
    if (element.is_bar()) continue;
    const Member& member = model.members[to_size(element.member)];
    const Beam<P> beam = make_beam<P>(member, element);
    const std::array<Index, Beam<P>::N> where = coordinates_of<Beam<P>::N>(element);
    parts.add_mass<Beam<P>::N>(beam.mass(), where);
    for (int a = 0; a <= P; ++a) {
      for (int k = 0; k < 2; ++k) {
        parts.loads[where[to_size(3 * a + k)]] +=
            beam.length * shape_functions<P>().integral[a] * member.load[k];
      }
    }
    parts.element_row[e] = parts.rows + group->rows();
    group->add(beam, where);
  }
  parts.add(std::move(group));
}

void add_bars(const Model& model, const Layout& layout, SystemParts& parts) {
  auto group = std::make_unique<ConstraintElements<Bar>>(layout.free, parts.rows);
  for (std::size_t e = 0; e < layout.elements.size(); ++e) {
    const MemberElement& element = layout.elements[e];
    if (!element.is_bar()) continue;
    const Member& member = model.members[to_size(element.member)];
    const Bar bar = make_bar(member, element);
    const std::array<Index, 4> where = coordinates_of<4>(element);
    parts.add_mass<4>(bar.mass(), where);
    for (std::size_t i = 0; i < 4; ++i) {
      parts.loads[where[i]] += element.length() / 2 * member.load[static_cast<Index>(i % 2)];
    }
    parts.element_row[e] = parts.rows + group->rows();
    group->add(bar, where);
  }
  parts.add(std::move(group));
}

void add_end_inertias(const Model& model, const Layout& layout, SystemParts& parts) {
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    for (std::size_t end = 0; end < 2; ++end) {
      const double inertia = model.members[m].ends[end].inertia;
      if (inertia != 0) parts.point_mass.emplace_back(layout.end_rotation[m][end], inertia);
    }
  }
}

}  // namespace

void add_members(const Model& model, const Layout& layout, int degree, SystemParts& parts) {
  parts.element_row.assign(layout.elements.size(), -1);
  if (degree == 1) add_beams<1>(model, layout, parts);
  if (degree == 2) add_beams<2>(model, layout, parts);
  if (degree == 3) add_beams<3>(model, layout, parts);
  add_bars(model, layout, parts);
  add_end_inertias(model, layout, parts);
}

}  // namespace trammel::solver::large_motion

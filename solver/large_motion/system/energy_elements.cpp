#include "solver/large_motion/system/energy_elements.h"

#include "solver/large_motion/elements/coordinate_spring.h"
#include "solver/large_motion/elements/triangle.h"

namespace trammel::solver::large_motion {

namespace {

/// The triangles of that many nodes.
template <int Nodes>
void add_triangles_of(const Model& model, const Layout& layout, SystemParts& parts) {
  auto group = std::make_unique<EnergyElements<Triangle2d<Nodes>>>(layout.free);
  for (const Triangle& triangle : model.triangles) {
    if (triangle.quadratic() != (Nodes == 6)) continue;
    std::array<Vector2d, Nodes> corners;
    std::array<Index, 2 * Nodes> where{};
    for (std::size_t a = 0; a < Nodes; ++a) {
      corners[a] = model.nodes[to_size(triangle.nodes[a])].position;
      where[2 * a] = layout.node[to_size(triangle.nodes[a])][0];
      where[2 * a + 1] = layout.node[to_size(triangle.nodes[a])][1];
    }
    const Plate& plate = model.plates[to_size(triangle.plate)];
    const Triangle2d<Nodes> element(plate.material, plate.thickness, corners);
    parts.add_mass<2 * Nodes>(element.mass(), where);
    group->add(element, where);
  }
  parts.add(std::move(group));
}

}  // namespace

void add_triangles(const Model& model, const Layout& layout, SystemParts& parts) {
  add_triangles_of<3>(model, layout, parts);
  add_triangles_of<6>(model, layout, parts);
}

void add_coordinate_springs(const Model& model, const Layout& layout, SystemParts& parts) {
  auto group = std::make_unique<EnergyElements<CoordinateSpring>>(layout.free);
  for (const Spring& spring : model.springs) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double stiffness = spring.stiffness[static_cast<Index>(k)];
      if (stiffness == 0) continue;
      const auto index_of = [&](Index node) {
        return node < 0 ? Index{-1} : layout.node[to_size(node)][k];
      };
      group->add({stiffness}, {index_of(spring.nodes[0]), index_of(spring.nodes[1])});
    }
  }
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    for (std::size_t end = 0; end < 2; ++end) {
      const MemberEnd& fixity = model.members[m].ends[end];
      if (fixity.fixity != EndFixity::sprung) continue;
      const Index node = layout.node[to_size(model.members[m].nodes[end])][2];
      group->add({fixity.stiffness}, {node, layout.end_rotation[m][end]});
    }
  }
  parts.add(std::move(group));
}

}  // namespace trammel::solver::large_motion

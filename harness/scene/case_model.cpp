#include "harness/scene/case_model.h"

#include "harness/scene/frame_reader.h"
#include "harness/scene/manipulator_reader.h"
#include "harness/scene/joint_reader.h"
#include "solver/large_motion/system/linear_joints.h"
#include "solver/assembly/reduced_model.h"
#include "solver/manipulator/reduced_design.h"

namespace trammel {
namespace {

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

Scene read_scene(const Document& document) {
  const Cursor root(document);
  if (!root.has("model")) throw root.error("expected the key 'model' for this analysis");
  const Cursor model = root["model"];
  Scene scene;
  if (model.has("manipulator")) {
    read_manipulator(model, scene);
  } else {
    for (const char* key : {"pose", "trajectory"}) {
      if (model.has(key)) throw model[key].error("expected a manipulator beside it");
    }
    if (!model.has("nodes") || model["nodes"].size() == 0) {
      throw model.error("expected a manipulator or nodes");
    }
  }
  try {
    const Model bare = scene.manipulator
                           ? build_manipulator(*scene.manipulator, scene.motion.front().pose)
                           : Model();
    scene.parts = read_parts(model, bare.nodes);
    scene.mechanism = read_mechanism(model, build_bare_model(scene, 0));
  } catch (const ModelError& error) {
    throw model_error(document, error);
  }
  return scene;
}

Model build_model(const Scene& scene, std::size_t step) {
  Model model = build_bare_model(scene, step);
  for (const large::Slider& slider : scene.mechanism.sliders) add_linear_slider(model, slider);
  const bool only_large =
      !scene.mechanism.line_springs.empty() || !scene.mechanism.follower_loads.empty();
  if (only_large) {
    throw ModelError("line springs and follower loads need large-statics or large-motion");
  }
  return model;
}

Model build_bare_model(const Scene& scene, std::size_t step) {
  if (!scene.manipulator) return reduced(scene.parts, scene.effects);
  Model model =
      build_manipulator(reduced(*scene.manipulator, scene.effects), scene.motion.at(step).pose);
  const auto plates = static_cast<Index>(model.plates.size());
  for (Triangle triangle : scene.parts.triangles) {
    triangle.plate += plates;
    model.triangles.push_back(triangle);
  }
  append(model.nodes, scene.parts.nodes);
  append(model.members, scene.parts.members);
  append(model.plates, scene.parts.plates);
  append(model.rigid_bodies, scene.parts.rigid_bodies);
  append(model.masses, scene.parts.masses);
  append(model.springs, scene.parts.springs);
  append(model.supports, scene.parts.supports);
  append(model.constraints, scene.parts.constraints);
  append(model.loads, scene.parts.loads);
  for (EdgeLoad load : scene.parts.edge_loads) {
    load.plate += plates;
    model.edge_loads.push_back(load);
  }
  model.gravity = scene.parts.gravity;
  return reduced(std::move(model), scene.effects);
}

InputError model_error(const Document& document, const ModelError& error) {
  const std::string text = error.what();
  const Cursor model = Cursor(document)["model"];
  for (const char* kind :
       {"members", "rigid_bodies", "supports", "plates", "springs", "nodes", "edges"}) {
    const auto parts = model.find(kind);
    if (!parts) continue;
    for (const auto& [name, part] : parts->entries()) {
      for (const char* quote : {"'", "\""}) {
        if (text.find(quote + name + quote) != std::string::npos) {
          return part.error("expected a model that has a meaning: " + text);
        }
      }
    }
  }
  const Cursor place = model.has("manipulator") ? model["manipulator"] : model;
  return place.error("expected a model that has a meaning: " + text);
}

}  // namespace trammel

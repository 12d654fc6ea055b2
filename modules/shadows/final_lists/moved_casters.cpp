// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/final_lists/moved_casters.h"

#include <algorithm>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "engine/scene/components.h"
#include "modules/lights/outputs.h"
#include "modules/shadows/atlas/face_casters.h"
#include "shaders/shadows/final_lists/reproject_shared.h"

namespace gloam {
namespace {

/// The spheres of casters that have moved, each once.
class MovedSpheres {
 public:
  explicit MovedSpheres(const dvec3& camera) : camera_(camera) {}
  /// False if there is no room.
  bool add(const CasterBox& box) {
    const dvec3 centre = 0.5 * (box.low + box.high) - camera_;
    // A tenth wider than the box, for a filter's kernel, whose width is not known here.
    const vec4 sphere(vec3(centre), static_cast<float>(0.55 * glm::length(box.high - box.low)));
    if (std::ranges::find(spheres_, sphere) != spheres_.end()) return true;
    if (spheres_.size() == GLOAM_MOST_MOVED_CASTERS) return false;
    spheres_.push_back(sphere);
    return true;
  }
  [[nodiscard]] std::vector<vec4> take() { return std::move(spheres_); }

 private:
  dvec3 camera_;
  std::vector<vec4> spheres_;
};

/// Adds the casters in boxes that the face may see.
CastersMoved add_seen(const ShadowFace& face, std::span<const CasterBox> boxes, MovedSpheres& spheres) {
  if (boxes.empty()) return CastersMoved::none;
  const FaceVolume volume = face_volume(face);
  CastersMoved moved = CastersMoved::none;
  for (const CasterBox& box : boxes) {
    if (!may_see(volume, box)) continue;
    if (!box.known() || !spheres.add(box)) return CastersMoved::unknown;
    moved = CastersMoved::some;
  }
  return moved;
}

/// Hash of where a local light falls and of what its shadows depend on, without what follows the camera: its place in
/// the atlas, and the texels that its maps have.
std::uint64_t steady_hash(const World& world, Entity light, shaders::LocalLight reach, const shaders::ShadowRow& row) {
  reach.position = vec3(0.0f);
  Hasher hasher;
  hasher.bytes_of(world.get<WorldTransform>(light)).bytes_of(reach);
  hasher.bytes_of(vec4(row.kind, row.near_m, row.emitter_diameter_m, row.mirrored));
  hasher.bytes_of(row.right).bytes_of(row.up).bytes_of(vec3(row.cookie_layer, row.cookie_tan, row.traced_layer));
  return hasher.digest();
}

std::uint64_t steady_hash(const DirectionalLook& look, const shaders::DirectionalShadow& shadow) {
  Hasher hasher;
  hasher.bytes_of(vec4(look.direction, look.brightest > 0.0f ? 1.0f : 0.0f)).value(shadow.cascade_count);
  hasher.bytes_of(vec2(shadow.penumbra_m_per_m, shadow.traced_layer));
  return hasher.digest();
}

}  // namespace

void set_steady_inputs(const FrameBuilder& frame, const ShadowsOutputs& shadows, const ViewMapState& maps,
                       ListInputs& inputs) {
  const World& world = frame.world();
  const auto& visible = world.view_resource<VisibleLights>(frame.view().id);
  for (std::size_t i = 0; i < inputs.local.size(); ++i)
    inputs.local[i].steady =
        steady_hash(world, inputs.local[i].light, local_light_reach(visible, i), (*shadows.row_values)[i]);
  const std::vector<DirectionalLook> looks = directional_looks(visible);
  for (std::size_t i = 0; i < inputs.directional.size(); ++i)
    inputs.directional[i].steady = steady_hash(looks[i], shadows.block_values.directional[i]);
  const CasterHistory& casters = maps.frame.history;
  inputs.caster_frame = casters.frame();
  MovedSpheres spheres(frame.view().position);
  std::unordered_map<Entity, CastersMoved> moved;
  for (const ShadowFace& face : world.view_resource<ViewFaces>(frame.view().id).faces) {
    CastersMoved& of_light = moved.emplace(face.light, CastersMoved::none).first->second;
    // What waited for its turn may have been drawn in this frame.
    for (const std::span<const CasterBox> boxes : {casters.changed(face.light), maps.cache.late(face)})
      if (of_light != CastersMoved::unknown) of_light = std::max(of_light, add_seen(face, boxes, spheres));
  }
  for (std::vector<LightInputs>* lights : {&inputs.local, &inputs.directional})
    for (LightInputs& light : *lights) {
      const auto found = moved.find(light.light);
      light.casters = found == moved.end() ? CastersMoved::none : found->second;
    }
  inputs.moved = spheres.take();
}

}  // namespace gloam

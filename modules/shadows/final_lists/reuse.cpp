// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/final_lists/reuse.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "engine/core/hash.h"
#include "engine/render/camera/view_constants.h"
#include "engine/scene/resources.h"
#include "modules/lights/outputs.h"
#include "modules/shadows/filter/cookies.h"
#include "modules/shadows/final_lists/moved_casters.h"
#include "shaders/shadows/final_lists_shared.h"

namespace gloam {
namespace {

constexpr std::uint64_t kFramesKept = 120;

/// Hash of what visibilities depend on but the pixels, the lights and the camera.
std::uint64_t steady_hash(const FrameBuilder& frame, const ShadowKnobs& knobs, const ShadowsOutputs& shadows,
                          const KeptSizes& sizes) {
  const ViewFaces& faces = frame.world().view_resource<ViewFaces>(frame.view().id);
  Hasher hasher;
  hasher.bytes_of(sizes).value(frame.view().width).value(frame.view().height);
  hasher.value(faces.owner.value).value(faces.shared != nullptr);  // they name the atlas
  for (const gpu::SpecConstant& constant : shadows.constants)
    hasher.text(constant.name).value(constant.value.type).value(constant.value.bits);
  hasher.value(knobs.classify).value(knobs.slot_limit).value(knobs.pair_limit);
  const shaders::ShadowBlock& block = shadows.block_values;
  hasher.bytes_of(vec3(block.bias_m, block.depth_quantum, block.relative_quantum));
  hasher.value(frame.world().resource<Cookies>().version);
  hasher.bytes_of(knobs.min_contribution);
  return hasher.digest();
}

/// Hash of all that visibilities depend on but the pixels and the lights.
std::uint64_t shared_hash(const FrameBuilder& frame, const ShadowKnobs& knobs, const ShadowsOutputs& shadows,
                          std::uint64_t steady) {
  shaders::ViewConstants view = view_constants(frame.view());
  view.visualizer = 0;
  view.normal_variance = view.light_scale = 0.0f;
  Hasher hasher;
  hasher.value(steady).bytes_of(view).bytes_of(shadows.block_values.atlas_size);
  // Which lights of a tile are dim depends on the brightness of all, and on white.
  if (knobs.min_contribution > 0.0f) {
    const float white = std::exp2(frame.world().resource<SceneEnvironment>().exposure_ev100);
    hasher.bytes_of(vec2(white, frame.view().light_scale));
    hasher.value(local_lights_hash(frame.world().view_resource<VisibleLights>(frame.view().id)));
    for (const shaders::ShadowRow& row : *shadows.row_values) hasher.bytes_of(row);
  }
  return hasher.digest();
}

using MapVersions = std::unordered_map<Entity, std::uint64_t>;

/// Versions of the maps of each light. drawn: faces that have a version which no other frame has.
MapVersions map_versions(std::span<const FaceKey> faces, const ViewMapState& maps, std::span<const FaceKey> drawn,
                         std::uint64_t frame) {
  std::unordered_map<Entity, Hasher> hashers;
  for (const FaceKey& face : faces) {
    const bool changes = std::ranges::find(drawn, face) != drawn.end();
    hashers[face.light].value(face.index).value(changes).value(changes ? frame : maps.cache.version(face));
  }
  MapVersions versions;
  for (const auto& [light, hasher] : hashers) versions[light] = hasher.digest();
  return versions;
}

/// Sets LightInputs::composed of lights that later modules compose.
void set_composed(const FrameBuilder& frame, const CasterHistory& casters, std::span<LightInputs> lights) {
  const auto* composed = frame.find<ComposedLights>();
  if (composed == nullptr) return;
  for (LightInputs& light : lights) {
    const auto of_light = std::ranges::find(composed->lights, light.light, &ComposedLights::OfLight::light);
    if (of_light == composed->lights.end()) continue;
    Hasher hasher;
    hasher.value(of_light->hash).value(frame.world().resource<SceneAssets>().version);
    hasher.value(casters.withheld_hash(light.light));
    light.composed = hasher.digest();
  }
}

std::vector<FaceKey> keys_of(const FrameBuilder& frame) {
  std::vector<FaceKey> keys;
  for (const ShadowFace& face : frame.world().view_resource<ViewFaces>(frame.view().id).faces)
    keys.push_back({face.light, face.index, face.view});
  return keys;
}

void set_map_versions(const MapVersions& versions, std::vector<LightInputs>& lights) {
  for (LightInputs& light : lights) {
    const auto found = versions.find(light.light);
    light.maps = found == versions.end() ? 0 : found->second;
  }
}

/// exact: all that the lights share has not changed. steady: but for the camera.
void add_indices(std::span<const LightInputs> last, std::span<const LightInputs> now, bool exact, bool steady,
                 std::span<std::uint32_t> indices) {
  std::unordered_map<Entity, std::uint32_t> places;
  for (std::uint32_t i = 0; i < last.size(); ++i) places.emplace(last[i].light, i);
  for (std::size_t i = 0; i < std::min(now.size(), indices.size()); ++i) {
    const auto found = places.find(now[i].light);
    if (found == places.end()) continue;
    const LightInputs& before = last[found->second];
    const std::uint32_t recomposed = before.composed == now[i].composed ? 0u : GLOAM_LIGHT_RECOMPOSED;
    if (exact && before.hash == now[i].hash && before.maps == now[i].maps) {
      indices[i] = found->second | recomposed;
    } else if (steady && before.steady == now[i].steady && now[i].casters != CastersMoved::unknown) {
      const bool moved = now[i].casters == CastersMoved::some;
      indices[i] =
          found->second | recomposed | GLOAM_LIGHT_REPROJECTED | (moved ? GLOAM_LIGHT_CASTERS_MOVED : std::uint32_t{0});
    }
  }
}

}  // namespace

std::vector<std::uint32_t> last_indices(const ListInputs& last, const ListInputs& now) {
  std::vector<std::uint32_t> indices(GLOAM_MAX_LOCAL_LIGHTS + GLOAM_MAX_DIRECTIONAL_LIGHTS, GLOAM_LIGHT_CHANGED);
  const bool exact = last.shared == now.shared;
  const bool steady = last.steady == now.steady && now.caster_frame != 0 && last.caster_frame + 1 == now.caster_frame;
  if (!exact && !steady) return indices;
  const std::span all(indices);
  add_indices(last.local, now.local, exact, steady, all.first(GLOAM_MAX_LOCAL_LIGHTS));
  add_indices(last.directional, now.directional, exact, steady, all.subspan(GLOAM_MAX_LOCAL_LIGHTS));
  return indices;
}

bool reprojects_any(std::span<const std::uint32_t> indices) {
  return std::ranges::any_of(indices, [](std::uint32_t index) {
    return index != GLOAM_LIGHT_CHANGED && (index & GLOAM_LIGHT_REPROJECTED) != 0;
  });
}

bool keeps_any(const ListInputs& now, std::span<const std::uint32_t> indices) {
  const auto keeps = [&](const std::vector<LightInputs>& lights, std::size_t first) {
    for (std::size_t i = 0; i < lights.size(); ++i)
      if (lights[i].maps != 0 && indices[first + i] != GLOAM_LIGHT_CHANGED) return true;
    return false;
  };
  return keeps(now.local, 0) || keeps(now.directional, GLOAM_MAX_LOCAL_LIGHTS);
}

ViewReuse& ListReuse::view(std::uint64_t world, ViewId view, std::uint64_t frame) {
  ViewReuse& found = views_[{world, view.value}];
  found.last_use = frame;
  return found;
}

void ListReuse::forget_unused(std::uint64_t frame) {
  std::erase_if(views_, [&](const auto& entry) { return entry.second.last_use + kFramesKept < frame; });
}

void ListReuse::release_view(ViewId view) {
  std::erase_if(views_, [&](const auto& entry) { return entry.first.second == view.value; });
}

KeptBuffers use_kept_buffers(FrameBuilder& frame, const KeptSizes& sizes, std::uint64_t instance) {
  KeptBuffers buffers;
  buffers.filled = true;
  const auto use = [&](const char* name, std::uint64_t bytes) -> BufferRef {
    gpu::BufferDesc desc;
    desc.name = name;
    desc.module = "shadows";
    desc.size = std::max<std::uint64_t>(bytes, 4);
    desc.usage = gpu::BufferUsage::storage | gpu::BufferUsage::transfer_source;
    const auto kept = frame.history_buffer(desc, {.scope = HistoryScope::view,
                                                  .final_access = gpu::Access::compute_read,
                                                  .reset = {.most_missed = 0},
                                                  .instance = instance});
    if (!frame.check(kept)) return {};
    buffers.filled = buffers.filled && kept->filled();
    return kept->buffer;
  };
  buffers.tiles = use("shadow_kept_tiles", sizes.tiles);
  buffers.entries = use("final_light_entries", sizes.entries);
  buffers.visibilities[0] = buffers.visibilities[1] = use("shadow_visibilities", sizes.visibilities[0]);
  if (sizes.visibilities[1] != 0) buffers.visibilities[1] = use("more_shadow_visibilities", sizes.visibilities[1]);
  return buffers;
}

ListInputs list_inputs(const FrameBuilder& frame, const ShadowKnobs& knobs, const ShadowsOutputs& shadows,
                       const ViewMapState& maps, const KeptSizes& sizes) {
  const auto& visible = frame.world().view_resource<VisibleLights>(frame.view().id);
  ListInputs inputs;
  inputs.steady = steady_hash(frame, knobs, shadows, sizes);
  inputs.shared = shared_hash(frame, knobs, shadows, inputs.steady);
  const std::span<const Entity> local = local_lights(visible), directional = directional_lights(visible);
  for (std::size_t i = 0; i < local.size(); ++i) {
    Hasher hasher;
    hasher.bytes_of(local_light_reach(visible, i)).bytes_of((*shadows.row_values)[i]);
    inputs.local.push_back({.light = local[i], .hash = hasher.digest()});
  }
  const std::vector<DirectionalLook> looks = directional_looks(visible);
  for (std::size_t i = 0; i < directional.size(); ++i) {
    Hasher hasher;
    hasher.bytes_of(vec4(looks[i].direction, looks[i].brightest > 0.0f ? 1.0f : 0.0f));
    hasher.bytes_of(shadows.block_values.directional[i]);
    inputs.directional.push_back({.light = directional[i], .hash = hasher.digest()});
  }
  const auto versions = map_versions(keys_of(frame), maps, maps.frame.drawn, frame.services().device.frame_number());
  for (std::vector<LightInputs>* lights : {&inputs.local, &inputs.directional}) {
    set_map_versions(versions, *lights);
    set_composed(frame, maps.frame.history, *lights);
  }
  if (knobs.reuse == ShadowReuse::reprojected) set_steady_inputs(frame, shadows, maps, inputs);
  return inputs;
}

void note_reuse(FrameBuilder& frame, const ViewMapState& maps, const NotedFrame& noted, ListInputs inputs,
                ViewReuse& reuse) {
  // Runs after the commit of the maps, which were declared before.
  frame.on_commit([&maps, &reuse, inputs = std::move(inputs), faces = keys_of(frame), noted,
                   view = view_constants(frame.view()), position = frame.view().position,
                   number = frame.services().device.frame_number()]() mutable {
    const MapVersions versions = map_versions(faces, maps, {}, 0);
    set_map_versions(versions, inputs.local);
    set_map_versions(versions, inputs.directional);
    reuse = {.inputs = std::move(inputs),
             .has_keys = noted.has_keys,
             .instance = 1 - reuse.instance,
             .last_use = number,
             .view = view,
             .position = position,
             .turn = noted.turn,
             .exact_frames = noted.exact_frames};
  });
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/systems.h"

#include <bit>
#include <cmath>
#include <memory>
#include <vector>

#include "engine/core/hash.h"
#include "engine/math/world_box.h"
#include "modules/shadows/atlas/find_faces.h"

namespace gloam {
namespace {

constexpr std::size_t kMeshGrain = 1024;  // instances per job
constexpr std::size_t kLightGrain = 64;   // lights per job

void grow(CasterBounds& bounds, const Aabb& box, const dmat4& world_from_box) {
  const dvec3 center = dvec3(world_from_box * dvec4(dvec3(box.center()), 1.0));
  const dvec3 half(box.half_extent());
  const OrientedBox placed{center, glm::dmat3(dvec3(world_from_box[0]) * half.x, dvec3(world_from_box[1]) * half.y,
                                              dvec3(world_from_box[2]) * half.z)};
  const double sum = glm::length(center) + placed.half_diagonal();
  if (!(sum < 1e150)) return;  // a box that is not finite casts no shadow
  bounds.grow(placed);
}

/// Null when the mesh does not exist or has no bounds.
const Aabb* box_of(const SceneAssets& assets, const MeshInstance& instance) {
  if (instance.mesh >= assets.meshes.size()) return nullptr;
  const Aabb& box = assets.meshes[instance.mesh].bounds;
  return box.empty() ? nullptr : &box;
}

CasterBounds bounds_of(std::span<const MeshInstance> instances, std::span<const WorldTransform> transforms,
                       const SceneAssets& assets, double unit) {
  CasterBounds bounds;
  bounds.grid_unit = unit;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    if (instances[i].skin != kNone) continue;
    const Aabb* box = box_of(assets, instances[i]);
    if (box == nullptr) continue;
    grow(bounds, *box, transforms[i].matrix);
    bounds.add_size(half_diagonal(*box, transforms[i].matrix));
  }
  return bounds;
}

/// A skinned vertex is a weighted mean of the positions that its joints give it, so their boxes enclose it.
void grow_skinned(CasterBounds& bounds, const JointMatrices& joints, const JointMatrices::Range& range,
                  const Aabb& box) {
  for (std::uint32_t j = range.first; j < range.first + range.count && j < joints.matrices.size(); ++j) {
    dmat4 world(joints.matrices[j]);
    world[3] += dvec4(range.origin, 0.0);
    grow(bounds, box, world);
  }
}

/// Components of the lights. A light that no longer exists gets caster.enabled = false.
std::vector<ShadowLight> gather(std::span<const Entity> entities, const ShadowLights& lights, JobExecutor& jobs) {
  std::vector<ShadowLight> gathered(entities.size());
  jobs.parallel_for(entities.size(), kLightGrain, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Entity entity = entities[i];
      ShadowLight& to = gathered[i];
      to.entity = entity;
      const auto* light = lights.try_get<Light>(entity);
      const auto* transform = lights.try_get<WorldTransform>(entity);
      to.caster.enabled = light != nullptr && transform != nullptr;
      if (!to.caster.enabled) continue;
      to.light = *light;
      to.world_from_node = transform->matrix;
      if (const auto* bounds = lights.try_get<LightBounds>(entity)) to.bounds = *bounds;
      if (const auto* caster = lights.try_get<ShadowCaster>(entity)) to.caster = *caster;
    }
  });
  return gathered;
}

}  // namespace

void shadow_bounds_system(ViewResource<const VisibleLights> visible,
                          View<const MeshInstance, const WorldTransform> meshes, View<const CasterVolume> volumes,
                          Resource<const SceneAssets> assets, Resource<const JointMatrices> joints,
                          Resource<const ShadowTexelGrid> grid, ViewResource<CasterBounds> casters, JobExecutor& jobs) {
  if (directional_lights(*visible).empty()) return;
  std::vector<CasterBounds> found(meshes.chunk_count(kMeshGrain));
  meshes.parallel_chunks(
      jobs, kMeshGrain,
      [&](std::size_t ordinal, std::span<const MeshInstance> instances, std::span<const WorldTransform> transforms) {
        found[ordinal] = bounds_of(instances, transforms, *assets, grid->unit);
      });
  CasterBounds all;
  all.grid_unit = grid->unit;
  for (const CasterBounds& bounds : found) {
    all.grow(bounds);
    all.add_sizes(bounds);
  }
  for (const JointMatrices::Range& range : joints->ranges) {
    const auto* instance = meshes.try_get<MeshInstance>(range.instance);
    const Aabb* box = instance == nullptr ? nullptr : box_of(*assets, *instance);
    if (box != nullptr) grow_skinned(all, *joints, range, *box);
  }
  volumes.each([&](const CasterVolume& volume) {
    if (const CasterBounds box{volume.min, volume.max}; box.known()) all.grow(box.min, box.max);
  });
  all.grid_anchor = grid->anchor;
  *casters = all;
}

void shadow_views_system(ViewResource<const VisibleLights> visible, ViewResource<const RenderView> view,
                         ViewResource<const ShadowSettings> settings, ViewResource<const OverlayRoom> overlays,
                         ViewResource<const CasterBounds> casters, ShadowLights lights, ViewResource<ViewFaces> shadows,
                         JobExecutor& jobs) {
  shadows->spare_for_overlays = overlays->wanted;
  const std::vector<ShadowLight> local = gather(local_lights(*visible), lights, jobs);
  const std::vector<ShadowLight> directional = gather(directional_lights(*visible), lights, jobs);
  find_shadows(local, directional, *view, *settings, *casters, jobs, *shadows);
}

void add_shadow_systems(Schedule& schedule) {
  schedule.add_system("shadow_bounds", "shadows", Stage::view, &shadow_bounds_system);
  schedule.add_system("shadow_views", "shadows", Stage::view, &shadow_views_system);
}

namespace {

/// Owner of the atlas that the world's captures with these knobs share; no view has such a number.
ViewId owner_of_captures(const ShadowKnobs& knobs) {
  const std::uint64_t hash = Hasher()
                                 .value(knobs.atlas_size)
                                 .value(knobs.d16)
                                 .value(std::bit_cast<std::uint32_t>(knobs.bias_units))
                                 .value(knobs.mip_operator)
                                 .value(knobs.simplified)
                                 .value(std::bit_cast<std::uint32_t>(knobs.lod_texels))
                                 .digest();
  return ViewId{0x80000000u | static_cast<std::uint32_t>(hash)};
}

}  // namespace

void prepare_shadow_view(World& world, ViewId view, const ShadowKnobs& knobs) {
  if (world.try_view_resource<CasterBounds>(view) == nullptr) world.set_view_resource(view, CasterBounds{});
  if (world.try_view_resource<ShadowSettings>(view) == nullptr) world.set_view_resource(view, ShadowSettings{});
  world.set_view_resource(view, OverlayRoom{});
  if (world.try_view_resource<ViewFaces>(view) == nullptr) world.set_view_resource(view, ViewFaces{});
  auto& view_faces = world.view_resource<ViewFaces>(view);
  const auto* render_view = world.try_view_resource<RenderView>(view);
  // A view and its companions share the atlas of the view, captures share another one. A view under a time budget has
  // its atlas as if it had companions: with some of its settings it has.
  const bool paced = render_view != nullptr && render_view->paced && render_view->purpose == ViewPurpose::main;
  const bool together = render_view != nullptr && (render_view->is_companion() || render_view->has_companions || paced);
  const bool captures = !together && render_view != nullptr && render_view->purpose == ViewPurpose::capture;
  view_faces.leads = together && !render_view->is_companion();
  view_faces.owner = captures ? owner_of_captures(knobs) : together ? render_view->main_view : view;
  if (!captures && !together) {
    view_faces.shared = nullptr;
    return;
  }
  std::weak_ptr<SharedPlaces>& known = world.resource<CapturePlaces>().by_owner[view_faces.owner.value];
  view_faces.shared = known.lock();
  if (view_faces.shared == nullptr) known = view_faces.shared = std::make_shared<SharedPlaces>();
  if (captures) view_faces.shared->join(render_view->frame, view.value);
}

}  // namespace gloam

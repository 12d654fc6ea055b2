// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// Triangles that are too large for their distance from the camera.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/ecs/view.h"
#include "engine/render/packing/caster_bounds.h"
#include "engine/render/packing/packed_primitive.h"
#include "engine/render/scene/gpu_scene.h"
#include "engine/scene/components.h"

namespace gloam {
namespace {

/// Distance from the nearest eye to a box; 0 inside of it.
double nearest_eye(const WorldBox& box, std::span<const dvec3> eyes) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const dvec3& eye : eyes) nearest = std::min(nearest, glm::length(glm::clamp(eye, box.min, box.max) - eye));
  return nearest;
}

double largest_scale(const dmat4& matrix) {
  return std::max({glm::length(dvec3(matrix[0])), glm::length(dvec3(matrix[1])), glm::length(dvec3(matrix[2]))});
}

/// Whether triangles of the primitive may be too large. Cheap.
bool may_be_too_large(const Primitive& source, double longest_edge, const SeenFrom& seen) {
  const double least = seen.nearest * seen.too_long;
  const double length = largest_scale(seen.world_from_mesh) * longest_edge;
  if (!(length > least) || !std::isfinite(length)) return false;
  const double away = nearest_eye(world_box(source.bounds, seen.world_from_mesh), seen.eyes);
  return length > seen.too_long * away;
}

/// Distance from an eye to the surface.
double distance_to(const Primitive& source, const SeenFrom& seen, const dvec3& eye) {
  const auto corner = [&](std::size_t i) {
    return dvec3(seen.world_from_mesh * dvec4(dvec3(source.positions[source.indices[i]]), 1.0));
  };
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 2 < source.indices.size(); i += 3)
    nearest = std::min(nearest, distance_to_triangle(eye, corner(i), corner(i + 1), corner(i + 2)));
  return std::max(nearest, seen.nearest);
}

}  // namespace

bool GpuScene::Split::serves(const SeenFrom& seen) const {
  return world_from_mesh == seen.world_from_mesh && nearest == seen.nearest &&
         std::ranges::all_of(seen.eyes, [&](const dvec3& eye) {
           return std::ranges::any_of(eyes,
                                      [&](const auto& own) { return glm::length(eye - own.first) <= own.second; });
         });
}

const GpuPrimitive* GpuScene::split_primitive(Entity instance, std::uint32_t primitive) const {
  if (split_.empty()) return nullptr;
  const auto found = split_.find({instance.index, instance.generation, primitive});
  return found == split_.end() || !found->second.split ? nullptr : &found->second.primitive;
}

void GpuScene::split(const Primitive& source, std::uint32_t mesh, const SeenFrom& seen, std::uint64_t revision,
                     Split& made) {
  if (made.split) streams_.remove(made.primitive);
  const dvec3 origin(glm::inverse(seen.world_from_mesh) * dvec4(seen.eyes.front(), 1.0));
  PackedPrimitive packed = pack_primitive(refined_triangles(source, seen, origin), false);
  packed.primitive.origin = origin;
  packed.primitive.content = ++contents_;
  packed.primitive.simplification_tried = true;
  streams_.place(packed, true);
  AssetUploads::Job job{.number = kNoAsset, .parts = {}, .image = {}, .texels = {}, .urgent = true};
  for (std::uint32_t stream = 0; stream < MeshStreams::kStreams; ++stream)
    for (AssetUploads::BufferPart& part : streams_.parts(packed, stream)) job.parts.push_back(std::move(part));
  uploads_.add(std::move(job));
  made = {std::move(packed.primitive), mesh, revision, seen.world_from_mesh, seen.nearest, {}, true, true};
  for (const dvec3& eye : seen.eyes) made.eyes.emplace_back(eye, 0.5 * distance_to(source, seen, eye));
}

void GpuScene::keep_whole(std::uint32_t mesh, const SeenFrom& seen, std::uint64_t revision, double slack, Split& made) {
  if (made.split) {
    streams_.remove(made.primitive);
    removed_ = true;
  }
  made = {{}, mesh, revision, seen.world_from_mesh, seen.nearest, {}, false, true};
  for (const dvec3& eye : seen.eyes) made.eyes.emplace_back(eye, slack);
}

void GpuScene::split_large_triangles(const World& world, std::span<const dvec3> eyes, double nearest) {
  for (auto& [key, split] : split_) split.used = false;
  const SceneAssets& assets = world.resource<SceneAssets>();
  const auto split_instance = [&](Entity entity, const MeshInstance& instance, const WorldTransform& transform) {
    const std::uint32_t m = instance.mesh;
    if (m >= meshes_.size() || instance.skin != kNone || !holds_mesh(m)) return;
    const std::uint64_t revision = assets.revision(AssetKind::mesh, m);
    if (mesh_progress_[m].requested != revision || (options_.background && mesh_progress_[m].shown != revision)) return;
    const std::vector<Primitive>& sources = assets.meshes[m].primitives;
    const bool shown = mesh_progress_[m].shown == revision && meshes_[m].size() == sources.size();
    const SeenFrom seen{transform.matrix, eyes, nearest, too_long_for(device_.info().subpixel_bits)};
    for (std::uint32_t p = 0; p < sources.size(); ++p) {
      const Primitive& source = sources[p];
      if (!source.joints.empty() || !source.morph_targets.empty()) continue;
      if (!may_be_too_large(source, shown ? meshes_[m][p].longest_edge : longest_edge(source), seen)) continue;
      if (const auto found = split_.find({entity.index, entity.generation, p}); found != split_.end()) {
        Split& known = found->second;
        if (known.mesh == m && known.revision == revision && known.serves(seen)) {
          known.used = true;
          continue;
        }
      }
      const double slack = split_slack(source, seen);
      Split& made = split_[{entity.index, entity.generation, p}];
      if (slack < 0.0 && std::abs(glm::determinant(transform.matrix)) > 0.0)
        split(source, m, seen, revision, made);
      else
        keep_whole(m, seen, revision, std::max(slack, 0.0), made);
    }
  };
  if (!eyes.empty()) world.view<const MeshInstance, const WorldTransform>().each(split_instance);
  for (auto it = split_.begin(); it != split_.end();) {
    if (it->second.used) {
      ++it;
      continue;
    }
    if (it->second.split) {
      streams_.remove(it->second.primitive);
      removed_ = true;
    }
    it = split_.erase(it);
  }
}

}  // namespace gloam

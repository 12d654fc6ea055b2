// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/atlas/face_casters.h"

#include <algorithm>
#include <cmath>

#include "engine/math/bounds.h"
#include "engine/scene/assets.h"
#include "modules/shadows/views/bulbs.h"

namespace gloam {
namespace {

/// Bound on the float rounding of GPU and CPU when they rotate and sum lengths, as a share of the lengths involved.
constexpr float kRounding = 1e-5f;

void widen(Aabb& box) {
  const vec3 reach = glm::max(glm::abs(box.min), glm::abs(box.max));
  const float slack = kRounding * (reach.x + reach.y + reach.z);
  box.min -= vec3(slack);
  box.max += vec3(slack);
}

float distance_squared(const Aabb& box) {
  const vec3 nearest = glm::clamp(vec3(0.0f), box.min, box.max);
  return glm::dot(nearest, nearest);
}

bool may_see(const FaceVolume& volume, Aabb relative) {
  widen(relative);
  if (volume.reach_m > 0.0f && distance_squared(relative) > volume.reach_m * volume.reach_m) return false;
  return may_intersect(volume.frustum, relative);
}

/// Whether the winding tells the inside of the caster: it is closed, not mirrored and without holes.
bool has_inside(const Caster& caster) {
  return caster.primitive->closed && !is_cut_out(caster) && glm::determinant(glm::dmat3(caster.world_from_mesh)) > 0.0;
}

/// Whether fronts alone give the same map: the caster has an inside, and all of it is beyond the near plane. Where the
/// near plane opens a caster, its inside is seen.
bool fronts_suffice(const FaceVolume& volume, const Caster& caster) {
  if (!has_inside(caster)) return false;
  if (!(caster.bounds_min.x <= caster.bounds_max.x)) return false;
  Aabb relative{vec3(caster.bounds_min - volume.origin), vec3(caster.bounds_max - volume.origin)};
  widen(relative);
  return volume.clear_m <= 0.0f || distance_squared(relative) > volume.clear_m * volume.clear_m;
}

/// Distance of the caster's nearest point from the plane through the light across its axis; 0 if unknown.
float nearest_depth(const ShadowFace& face, const Caster& caster) {
  if (!(caster.bounds_min.x <= caster.bounds_max.x)) return 0.0f;
  Aabb relative{vec3(caster.bounds_min - face.origin), vec3(caster.bounds_max - face.origin)};
  widen(relative);
  return glm::dot(face.forward, relative.center()) - glm::dot(glm::abs(face.forward), relative.half_extent());
}

/// The caster's level that is drawn into the face; null: all triangles.
const DetailLevel* level_of(const ShadowFace& face, const Caster& caster, const CasterForm& form) {
  // The light in a subsurface material depends on the thickness of the body.
  if (form.lod_texels <= 0.0f || caster.levels == 0 || caster.subsurface || is_cut_out(caster)) return nullptr;
  const bool perspective = face.tan_half > 0.0f;
  const float extent_m = perspective ? face.tan_half * nearest_depth(face, caster) : face.half_extent_m;
  const float most_m = form.lod_texels * 2.0f * extent_m / static_cast<float>(face.square.size);
  const std::vector<DetailLevel>& levels = caster.primitive->levels(LevelUse::maps).levels;
  const DetailLevel* chosen = nullptr;
  for (std::size_t l = 0; l < caster.levels && caster.level_errors_m[l] <= most_m; ++l) chosen = &levels[l];
  return chosen;
}

/// Adds the clusters that the volume may see. draw: without indices. first_index: of the first cluster's first index 0.
void add_clusters(const FaceVolume& volume, std::span<const Cluster> clusters, std::uint32_t first_index, FaceDraw draw,
                  std::vector<FaceDraw>& draws) {
  dmat4 relative = draw.caster->world_from_mesh;
  relative[3] -= dvec4(volume.origin, 0.0);
  const mat4 matrix(relative);
  for (const Cluster& cluster : clusters) {
    if (!may_see(volume, transformed(cluster.bounds, matrix))) continue;
    const std::uint32_t first = first_index + cluster.first_index;
    if (draw.index_count > 0 && draw.first_index + draw.index_count == first) {
      draw.index_count += cluster.index_count;
      continue;
    }
    if (draw.index_count > 0) draws.push_back(draw);
    draw.first_index = first;
    draw.index_count = cluster.index_count;
  }
  if (draw.index_count > 0) draws.push_back(draw);
}

void add_draws(const ShadowFace& face, const FaceVolume& volume, const Caster& caster, const CasterForm& form,
               std::vector<FaceDraw>& draws) {
  const GpuPrimitive& primitive = *caster.primitive;
  const bool backs = form.subsurface_backs && caster.subsurface && has_inside(caster);
  const bool fronts = !backs && fronts_suffice(volume, caster);
  if (form.simplified && caster.deform == kNone && primitive.simplified_index_count > 0 && !is_cut_out(caster)) {
    draws.push_back({&caster, primitive.simplified_first_index, primitive.simplified_index_count, fronts, backs});
    return;
  }
  FaceDraw draw{&caster, 0, 0, fronts, backs};
  std::span<const Cluster> clusters = primitive.clusters;
  std::uint32_t first_index = primitive.first_index, index_count = primitive.index_count;
  if (const DetailLevel* const level = level_of(face, caster, form)) {
    clusters = level->clusters;
    const DetailLevels& levels = primitive.levels(LevelUse::maps);
    first_index = levels.first_index + level->first_index;
    index_count = level->index_count;
    draw.error_m = caster.level_errors_m[static_cast<std::size_t>(level - levels.levels.data())];
  }
  if (caster.deform == kNone && clusters.size() > 1) return add_clusters(volume, clusters, first_index, draw, draws);
  draw.first_index = first_index;
  draw.index_count = index_count;
  draws.push_back(draw);
}

}  // namespace

FaceVolume face_volume(const ShadowFace& face) {
  FaceVolume volume;
  volume.origin = face.origin;
  volume.bulb_radius_m = face.bulb_radius_m;
  volume.frustum.planes[5] = {vec3(0.0f), 1.0f};
  const bool perspective = face.tan_half > 0.0f;
  const vec3 sides[] = {face.right, -face.right, face.up, -face.up};
  for (std::size_t i = 0; i < 4; ++i)
    volume.frustum.planes[i] = perspective ? Plane{glm::normalize(sides[i] + face.forward * face.tan_half), 0.0f}
                                           : Plane{sides[i], face.half_extent_m};
  // Casters between a directional light and its box cast shadows into it: they are drawn at the near side, so there is
  // no near plane.
  volume.frustum.planes[4] = perspective ? Plane{face.forward, -face.clip_m()} : Plane{vec3(0.0f), 1.0f};
  if (face.far_m > 0.0f) volume.frustum.planes[5] = {-face.forward, face.far_m};
  if (perspective) volume.reach_m = face.far_m;
  // In a corner of the face, the near plane is farthest from the light.
  if (perspective) volume.clear_m = face.clip_m() * std::sqrt(1.0f + 2.0f * face.tan_half * face.tan_half);
  return volume;
}

FaceVolume face_volume(const ShadowFace& face, const TexelRect& region) {
  FaceVolume volume = face_volume(face);
  const bool perspective = face.tan_half > 0.0f;
  const float extent = perspective ? face.tan_half : face.half_extent_m;
  const float texel = 2.0f * extent / static_cast<float>(face.square.size);
  const auto from_edge = [&](std::uint32_t texels) { return static_cast<float>(texels) * texel - extent; };
  // Signed distances of the region's sides from the face's middle, along the inward normals: left, right, lower, upper.
  const float distances[] = {from_edge(region.begin.x) - texel, -from_edge(region.end.x) - texel,
                             -from_edge(region.end.y) - texel, from_edge(region.begin.y) - texel};
  const vec3 inward[] = {face.right, -face.right, face.up, -face.up};
  for (std::size_t i = 0; i < 4; ++i)
    volume.frustum.planes[i] = perspective ? Plane{glm::normalize(inward[i] - face.forward * distances[i]), 0.0f}
                                           : Plane{inward[i], -distances[i]};
  return volume;
}

CasterBox relative_box(const dvec3& origin, const CasterBox& box) {
  Aabb relative{vec3(box.low - origin), vec3(box.high - origin)};
  widen(relative);
  return {dvec3(relative.min), dvec3(relative.max)};
}

bool may_see(const FaceVolume& volume, const CasterBox& box) {
  if (!box.known()) return true;  // unknown: it may be anywhere
  if (is_bulb(volume.origin, static_cast<double>(volume.bulb_radius_m), box.low, box.high, box.emissive_reach_m))
    return false;
  return may_see(volume, Aabb{vec3(box.low - volume.origin), vec3(box.high - volume.origin)});
}

bool may_see(const FaceVolume& volume, const Caster& caster) {
  return may_see(volume, CasterBox{caster.bounds_min, caster.bounds_max, caster.emissive_reach_m});
}

CasterProjection projection_of(const ShadowFace& face) {
  const dvec3 right(face.right), up(face.up), forward(face.forward);
  const bool perspective = face.tan_half > 0.0f;
  const double scale = 1.0 / static_cast<double>(perspective ? face.tan_half : face.half_extent_m);
  dmat4 rows(0.0);
  rows[0] = dvec4(right * scale, 0.0);
  rows[1] = dvec4(up * scale, 0.0);
  if (perspective) {
    rows[2] = dvec4(0.0, 0.0, 0.0, static_cast<double>(face.clip_m()));
    rows[3] = dvec4(forward, 0.0);
  } else {
    const double depth = static_cast<double>(face.far_m - face.near_m);
    rows[2] = dvec4(forward * (-1.0 / depth), static_cast<double>(face.far_m) / depth);
    rows[3] = dvec4(0.0, 0.0, 0.0, 1.0);
  }
  return {face.origin, glm::transpose(rows), !perspective};
}

mat4 clip_from_mesh(const ShadowFace& face, const dmat4& world_from_mesh) {
  return projection_of(face).clip_from(world_from_mesh);
}

mat4 clip_from_mesh(const ShadowFace& face, const FaceDraw& draw) {
  dmat4 matrix = draw.caster->world_from_mesh;
  if (draw.error_m > 0.0f && face.tan_half > 0.0f) {
    // Scaled about the light, so that every point stays on its ray. A caster with an error is beyond the light's plane.
    const double nearest = static_cast<double>(nearest_depth(face, *draw.caster));
    const double scale = 1.0 + static_cast<double>(draw.error_m) / nearest;
    const dvec4 origin(face.origin, 0.0);
    matrix[3] -= origin;
    for (int column = 0; column < 4; ++column) matrix[column] = dvec4(scale * dvec3(matrix[column]), matrix[column].w);
    matrix[3] += origin;
  } else {
    matrix[3] += dvec4(static_cast<double>(draw.error_m) * dvec3(face.forward), 0.0);
  }
  return clip_from_mesh(face, matrix);
}

bool is_cut_out(const Caster& caster) { return (caster.variant.features & GLOAM_SURFACE_MASK) != 0; }

std::vector<FaceDraw> face_draws(const ShadowFace& face, const FaceVolume& volume, std::span<const Caster> casters,
                                 const CasterForm& form, std::span<const Entity> withheld) {
  std::vector<FaceDraw> draws;
  for (const Caster& caster : casters)
    if (caster.primitive->index_count > 0 && may_see(volume, caster) && !holds_caster(withheld, caster.entity))
      add_draws(face, volume, caster, form, draws);
  std::stable_partition(draws.begin(), draws.end(), [](const FaceDraw& draw) { return !is_cut_out(*draw.caster); });
  return draws;
}

}  // namespace gloam

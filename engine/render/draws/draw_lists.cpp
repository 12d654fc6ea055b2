// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/draws/draw_lists.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "engine/ecs/view.h"
#include "engine/render/packing/caster_bounds.h"
#include "engine/scene/posing/animated_nodes.h"
#include "engine/scene/resources.h"

namespace gloam {
namespace {

/// Clusters of one draw share an item of ViewDraws::clusters up to this number of indices. A command costs a software
/// device about as much as 50 triangles.
constexpr std::size_t kMostSharedIndices = 3 * 2 * kClusterTriangles;

struct Instance {
  Entity entity;
  std::uint32_t mesh = 0;
  dmat4 matrix = dmat4(1.0);
  const JointMatrices::Range* joints = nullptr;
  std::uint32_t first_weight = 0;
  std::uint32_t weight_count = 0;
  bool casts = true;
  bool moves = false;  ///< skinned, morphed or animated; known only if a view is static_only
};

bool is_static(const RenderView* view) { return view->static_only; }

std::vector<Instance> gather_instances(const World& world, std::span<const RenderView* const> views,
                                       const GpuScene& scene) {
  std::vector<Instance> instances;
  const bool some_static = std::ranges::any_of(views, is_static);
  const bool all_static = some_static && std::ranges::all_of(views, is_static);
  const std::optional<AnimatedNodes> animated = some_static ? std::optional<AnimatedNodes>(world) : std::nullopt;
  const auto& ranges = world.resource<JointMatrices>().ranges;
  world.view<const MeshInstance, const WorldTransform, Maybe<const MorphInstance>>().each(
      [&](Entity entity, const MeshInstance& mesh, const WorldTransform& transform, const MorphInstance* morph) {
        if (mesh.mesh >= scene.meshes().size()) return;
        Instance instance{.entity = entity, .mesh = mesh.mesh, .matrix = transform.matrix, .casts = mesh.casts_shadows};
        if (mesh.skin != kNone) {
          const auto range = std::lower_bound(
              ranges.begin(), ranges.end(), entity.index,
              [](const JointMatrices::Range& r, std::uint32_t index) { return r.instance.index < index; });
          if (range != ranges.end() && range->instance == entity && range->count > 0) instance.joints = &*range;
        }
        if (morph != nullptr) {
          instance.first_weight = morph->first;
          instance.weight_count = morph->count;
        }
        instance.moves = some_static && (mesh.skin != kNone || morph != nullptr || animated->moves(entity));
        if (instance.moves && all_static) return;
        instances.push_back(instance);
      });
  return instances;
}

mat4 affine(const shaders::DrawConstants& c) { return glm::transpose(mat4(c.row0, c.row1, c.row2, vec4(0, 0, 0, 1))); }

float nearest_depth(const RenderView& view, const Aabb& relative) {
  const vec3 forward = -vec3(glm::transpose(view.view_from_relative)[2]);
  return glm::dot(forward, relative.center()) - glm::dot(glm::abs(forward), relative.half_extent());
}

/// The shortest distance at this view depth that may be a pixel wide in the picture, in any direction; ≤ 0 behind the
/// camera.
float metres_per_pixel(const RenderView& view, float depth_m) {
  // Without jitter, so that a view at rest draws the same levels in all frames.
  const mat4& clip = view.jittered ? view.unmoved.clip_from_view : view.clip_from_view;
  const float pixels = 0.5f * std::max(std::abs(clip[0][0]) * static_cast<float>(view.width),
                                       std::abs(clip[1][1]) * static_cast<float>(view.height));
  if (view.camera.orthographic) return 1.0f / pixels;
  // Toward a corner of the picture, motion along the view's axis shows, too.
  const vec2 corner = (1.0f + glm::abs(vec2(clip[2]))) / glm::abs(vec2(clip[0][0], clip[1][1]));
  return depth_m / (pixels * std::sqrt(1.0f + glm::dot(corner, corner)));
}

Aabb relative_to(const WorldBox& box, const dvec3& origin) { return {vec3(box.min - origin), vec3(box.max - origin)}; }

bool is_mirroring(const dmat4& matrix) { return glm::determinant(glm::dmat3(matrix)) < 0.0; }

/// Conservative. relative: a box relative to the view's position.
bool may_see(const RenderView& view, const Aabb& relative) {
  if (!may_intersect(view.frustum, relative)) return false;
  if (!view.clipped) return true;
  const vec3 normal(view.clip_plane);
  return glm::dot(normal, relative.center()) + glm::dot(glm::abs(normal), relative.half_extent()) + view.clip_plane.w >=
         0.0f;
}

/// Adds the draws, deform jobs and casters of one instance to the lists.
class InstanceDrawer {
 public:
  InstanceDrawer(const World& world, std::span<const RenderView* const> views, const GpuScene& scene,
                 const DrawListContents& contents)
      : views_(views),
        scene_(scene),
        joints_(world.resource<JointMatrices>()),
        weights_(world.resource<MorphWeights>().values),
        contents_(contents) {}

  /// lists.views: one per view.
  void draw(const Instance& instance, FrameDraws& lists) const {
    const std::vector<GpuPrimitive>& primitives = scene_.meshes()[instance.mesh];
    for (std::uint32_t p = 0; p < primitives.size(); ++p) {
      const GpuPrimitive& primitive = primitives[p];
      if (primitive.index_count == 0) continue;
      const bool skinned = primitive.skinned && instance.joints != nullptr;
      const bool morphed = primitive.morph_targets > 0 && instance.weight_count >= primitive.morph_targets;
      if (skinned || morphed) {
        draw_deformed(instance, primitive, skinned, morphed, lists);
      } else if (const GpuPrimitive* const split = scene_.split_primitive(instance.entity, p)) {
        Instance moved = instance;
        moved.matrix = from_origin(instance.matrix, *split);
        draw_rigid(moved, *split, lists);
      } else {
        draw_rigid(instance, primitive, lists);
      }
    }
  }

 private:
  [[nodiscard]] static bool shows(const RenderView& view, const Instance& instance) {
    return !(view.static_only && instance.moves);
  }

  [[nodiscard]] bool casts(const Instance& instance, const GpuPrimitive& primitive) const {
    return contents_.casters && instance.casts && scene_.material(primitive.material).alpha_mode != AlphaMode::blend;
  }

  void cast(Entity entity, const GpuPrimitive& primitive, const dmat4& world_from_mesh, bool flipped,
            const WorldBox& box, std::uint32_t deform, const JointMatrices::Range* joints, FrameDraws& lists) const {
    const GpuMaterial& material = scene_.material(primitive.material);
    Caster caster;
    caster.entity = entity;
    caster.primitive = &primitive;
    caster.content = primitive.content;
    caster.cut_out_content = material.alpha_mode == AlphaMode::mask ? material.content : 0;
    caster.variant = surface_variant(material, primitive, flipped);
    caster.subsurface = material.subsurface;
    caster.moving = deform != kNone;
    caster.deform = deform;
    caster.world_from_mesh = world_from_mesh;
    const WorldBox bounds = box.known() ? box : WorldBox{};
    caster.bounds_min = bounds.min;
    caster.bounds_max = bounds.max;
    if (material.emissive && deform == kNone)
      caster.emissive_reach_m = half_diagonal(primitive.bounds, world_from_mesh);
    if (contents_.caster_levels && material.alpha_mode == AlphaMode::opaque) add_levels(caster, joints);
    lists.casters.casters.push_back(caster);
  }

  /// The error of each level in metres. joints: null for rigid vertices.
  [[nodiscard]] LevelErrors errors_m(const DetailLevels& levels, const JointMatrices::Range* joints,
                                     const dmat4& world_from_mesh) const {
    LevelErrors errors{};
    const std::size_t count = levels.levels.size();
    if (count == 0) return errors;
    if (joints != nullptr) {
      posed_errors(levels, std::span(joints_.matrices).subspan(joints->first, joints->count),
                   std::span(errors).first(count));
      return errors;
    }
    const auto scale = static_cast<float>(greatest_scale(glm::dmat3(world_from_mesh)));
    for (std::size_t l = 0; l < count; ++l) errors[l] = scale * levels.levels[l].error;
    return errors;
  }

  /// The coarsest level whose error the view shows as at most RenderView::lod_pixels; null: all triangles. bounds: of
  /// the drawn vertices, relative to the view's position.
  [[nodiscard]] const DetailLevel* level_of(const RenderView& view, const GpuPrimitive& primitive, const Aabb& bounds,
                                            const JointMatrices::Range* joints, const dmat4& world_from_mesh) const {
    const DetailLevels& levels = primitive.levels(LevelUse::views);
    if (view.lod_pixels <= 0.0f || levels.levels.empty()) return nullptr;
    if (scene_.material(primitive.material).alpha_mode != AlphaMode::opaque) return nullptr;
    const float most_m = view.lod_pixels * metres_per_pixel(view, nearest_depth(view, bounds));
    const LevelErrors errors = errors_m(levels, joints, world_from_mesh);
    const DetailLevel* chosen = nullptr;
    for (std::size_t l = 0; l < levels.levels.size() && errors[l] <= most_m; ++l) chosen = &levels.levels[l];
    return chosen;
  }

  /// joints: of a skinned caster.
  void add_levels(Caster& caster, const JointMatrices::Range* joints) const {
    const DetailLevels& levels = caster.primitive->levels(LevelUse::maps);
    caster.levels = static_cast<std::uint32_t>(levels.levels.size());
    caster.level_errors_m = errors_m(levels, joints, caster.world_from_mesh);
  }

  /// Bounds of the deformed vertices; unknown if a joint or a weight is missing or not finite. `world_from_mesh`: the
  /// matrix of vertices that are morphed but not skinned.
  [[nodiscard]] WorldBox deformed_box(const Instance& instance, const GpuPrimitive& primitive, bool skinned,
                                      bool morphed, const dmat4& world_from_mesh) const {
    Aabb reach;
    if (morphed) {
      if (std::size_t{instance.first_weight} + primitive.morph_targets > weights_.size()) return {};
      reach = morph_reach(primitive, weights_.subspan(instance.first_weight, primitive.morph_targets));
    }
    if (skinned) return posed_box(primitive, joints_, *instance.joints, reach);
    return world_box({primitive.bounds.min + reach.min, primitive.bounds.max + reach.max}, world_from_mesh);
  }

  /// A draw in a view. flipped: the matrix mirrors, so front faces are clockwise. A mirrored view flips them again.
  [[nodiscard]] Draw start(const RenderView& view, Entity entity, const GpuPrimitive& primitive,
                           const shaders::DrawConstants& constants, bool flipped) const {
    const GpuMaterial& material = scene_.material(primitive.material);
    Draw draw;
    draw.entity = entity;
    draw.primitive = &primitive;
    draw.constants = constants;
    draw.variant = surface_variant(material, primitive, flipped != view.mirrored);
    if (view.clipped) draw.variant.features |= GLOAM_SURFACE_CLIPPED;
    return draw;
  }

  [[nodiscard]] bool is_blended(const GpuPrimitive& primitive) const {
    return scene_.material(primitive.material).alpha_mode == AlphaMode::blend;
  }

  void add(const RenderView& view, Draw draw, const Aabb& relative_bounds, ViewDraws& draws) const {
    draw.depth_m = nearest_depth(view, relative_bounds);
    (is_blended(*draw.primitive) ? draws.blended : draws.solid).push_back(draw);
  }

  /// Lengthens the draw by triangles that come after its last one. Neighbours share an item of ViewDraws::clusters.
  void lengthen(Draw& draw, std::uint32_t first_index, std::uint32_t index_count, const Aabb& bounds,
                ViewDraws& draws) const {
    draw.index_count += index_count;
    if (is_blended(*draw.primitive)) return;
    if (draw.cluster_count > 0) {
      shaders::DrawCluster& last = draws.clusters.back();
      if (last.index_count + index_count <= kMostSharedIndices) {
        last.index_count += index_count;
        last.low = glm::min(last.low, bounds.min);
        last.high = glm::max(last.high, bounds.max);
        return;
      }
    }
    if (draw.cluster_count++ == 0) draw.first_cluster = static_cast<std::uint32_t>(draws.clusters.size());
    draws.clusters.push_back({bounds.min, first_index, bounds.max, index_count});
  }

  void draw_rigid(const Instance& instance, const GpuPrimitive& primitive, FrameDraws& lists) const {
    if (casts(instance, primitive))
      cast(instance.entity, primitive, instance.matrix, is_mirroring(instance.matrix),
           world_box(primitive.bounds, instance.matrix), kNone, nullptr, lists);
    for (std::size_t v = 0; v < views_.size(); ++v)
      if (shows(*views_[v], instance)) draw_clusters(*views_[v], instance, primitive, lists.views[v]);
  }

  void draw_clusters(const RenderView& view, const Instance& instance, const GpuPrimitive& primitive,
                     ViewDraws& draws) const {
    const shaders::DrawConstants constants = draw_constants(instance.matrix, view.position);
    const mat4 matrix = affine(constants);
    const Aabb whole = transformed(primitive.bounds, matrix);
    if (!may_see(view, whole)) {
      ++draws.culled_instances;
      return;
    }
    Draw draw = start(view, instance.entity, primitive, constants, (constants.flags & GLOAM_DRAW_MIRRORED) != 0);
    draw.bounds = whole;
    const DetailLevel* const level = level_of(view, primitive, whole, nullptr, instance.matrix);
    const std::vector<Cluster>& clusters = level != nullptr ? level->clusters : primitive.clusters;
    const std::uint32_t start_index =
        level != nullptr ? primitive.levels(LevelUse::views).first_index + level->first_index : primitive.first_index;
    for (const Cluster& cluster : clusters) {
      const Aabb bounds = clusters.size() == 1 ? whole : transformed(cluster.bounds, matrix);
      if (clusters.size() > 1 && !may_see(view, bounds)) continue;
      const std::uint32_t first = start_index + cluster.first_index;
      if (draw.index_count == 0 || draw.first_index + draw.index_count != first) {
        if (draw.index_count > 0) add(view, draw, whole, draws);
        draw.first_index = first;
        draw.index_count = draw.cluster_count = 0;
      }
      lengthen(draw, first, cluster.index_count, bounds, draws);
    }
    if (draw.index_count > 0) add(view, draw, whole, draws);
  }

  void draw_deformed(const Instance& instance, const GpuPrimitive& primitive, bool skinned, bool morphed,
                     FrameDraws& lists) const {
    dmat4 matrix = instance.matrix;
    if (skinned) {
      // Skinned vertices are in the world's axes, relative to the range's origin.
      matrix = dmat4(1.0);
      matrix[3] = dvec4(instance.joints->origin, 1.0);
    }
    const bool flipped = skinned ? instance.joints->mirrored : is_mirroring(matrix);
    const WorldBox box = deformed_box(instance, primitive, skinned, morphed, matrix);
    const auto deform = static_cast<std::uint32_t>(lists.deforms.size());
    bool deformed = casts(instance, primitive);
    if (deformed)
      cast(instance.entity, primitive, matrix, flipped, box, deform, skinned ? instance.joints : nullptr, lists);
    for (std::size_t v = 0; v < views_.size(); ++v) {
      const RenderView& view = *views_[v];
      if (!shows(view, instance)) continue;
      const shaders::DrawConstants constants = draw_constants(matrix, view.position);
      // Without a known box the primitive is drawn; the box of its rest pose then only orders the draws.
      const Aabb bounds =
          box.known() ? relative_to(box, view.position) : transformed(primitive.bounds, affine(constants));
      if (box.known() && !may_see(view, bounds)) {
        ++lists.views[v].culled_instances;
        continue;
      }
      deformed = true;
      Draw draw = start(view, instance.entity, primitive, constants, flipped);
      const DetailLevel* const level =
          box.known() && skinned && !morphed ? level_of(view, primitive, bounds, instance.joints, matrix) : nullptr;
      draw.first_index =
          level != nullptr ? primitive.levels(LevelUse::views).first_index + level->first_index : primitive.first_index;
      draw.deform = deform;
      if (box.known()) draw.bounds = bounds;
      lengthen(draw, draw.first_index, level != nullptr ? level->index_count : primitive.index_count, draw.bounds,
               lists.views[v]);
      add(view, draw, bounds, lists.views[v]);
    }
    if (deformed) lists.deforms.push_back(deform_job(instance, primitive, skinned, morphed));
  }

  [[nodiscard]] static DeformJob deform_job(const Instance& instance, const GpuPrimitive& primitive, bool skinned,
                                            bool morphed) {
    DeformJob job;
    job.entity = instance.entity;
    job.primitive = &primitive;
    job.constants.vertex_count = primitive.vertex_count;
    job.constants.skinned = skinned ? 1 : 0;
    job.constants.first_joint = skinned ? instance.joints->first : 0;
    job.constants.morph_targets = morphed ? primitive.morph_targets : 0;
    job.constants.first_weight = instance.first_weight;
    job.constants.morph_has_normals = primitive.morph_has_normals ? 1 : 0;
    return job;
  }

  std::span<const RenderView* const> views_;
  const GpuScene& scene_;
  const JointMatrices& joints_;
  std::span<const float> weights_;
  DrawListContents contents_;
};

void append(FrameDraws& all, FrameDraws& part) {
  const auto shift = static_cast<std::uint32_t>(all.deforms.size());
  for (std::size_t v = 0; v < all.views.size(); ++v) {
    ViewDraws &to = all.views[v], &from = part.views[v];
    for (std::vector<Draw>* draws : {&from.solid, &from.blended})
      for (Draw& draw : *draws)
        if (draw.deform != kNone) draw.deform += shift;
    for (Draw& draw : from.solid) draw.first_cluster += static_cast<std::uint32_t>(to.clusters.size());
    to.clusters.insert(to.clusters.end(), from.clusters.begin(), from.clusters.end());
    to.solid.insert(to.solid.end(), from.solid.begin(), from.solid.end());
    to.blended.insert(to.blended.end(), from.blended.begin(), from.blended.end());
    to.culled_instances += from.culled_instances;
  }
  for (Caster& caster : part.casters.casters)
    if (caster.deform != kNone) caster.deform += shift;
  all.deforms.insert(all.deforms.end(), part.deforms.begin(), part.deforms.end());
  all.casters.casters.insert(all.casters.casters.end(), part.casters.casters.begin(), part.casters.casters.end());
}

void sort(ViewDraws& draws) {
  std::stable_sort(draws.solid.begin(), draws.solid.end(), [](const Draw& a, const Draw& b) {
    return std::tie(a.variant, a.depth_m) < std::tie(b.variant, b.depth_m);
  });
  std::stable_sort(draws.blended.begin(), draws.blended.end(),
                   [](const Draw& a, const Draw& b) { return a.depth_m > b.depth_m; });
}

}  // namespace

dmat4 from_origin(const dmat4& world_from_mesh, const GpuPrimitive& primitive) {
  dmat4 matrix = world_from_mesh;
  matrix[3] = world_from_mesh * dvec4(primitive.origin, 1.0);
  return matrix;
}

shaders::DrawConstants draw_constants(const dmat4& world_from_mesh, const dvec3& origin) {
  dmat4 relative = world_from_mesh;
  relative[3] -= dvec4(origin, 0.0);
  const mat4 rows = glm::transpose(mat4(relative));
  shaders::DrawConstants constants{};
  constants.row0 = rows[0];
  constants.row1 = rows[1];
  constants.row2 = rows[2];
  if (is_mirroring(relative)) constants.flags |= GLOAM_DRAW_MIRRORED;
  return constants;
}

FrameDraws build_frame_draws(const World& world, std::span<const RenderView* const> views, const GpuScene& scene,
                             JobExecutor& executor, const DrawListContents& contents) {
  const std::vector<Instance> instances = gather_instances(world, views, scene);
  const InstanceDrawer drawer(world, views, scene, contents);
  constexpr std::size_t kGrain = 64;
  std::vector<FrameDraws> parts((instances.size() + kGrain - 1) / kGrain);
  executor.parallel_for(instances.size(), kGrain, [&](JobRange range) {
    FrameDraws& part = parts[range.ordinal];
    part.views.resize(views.size());
    for (std::size_t i = range.begin; i < range.end; ++i) drawer.draw(instances[i], part);
  });
  FrameDraws lists;
  lists.views.resize(views.size());
  for (FrameDraws& part : parts) append(lists, part);
  for (DeformJob& job : lists.deforms) {
    job.first_vertex = lists.deformed_vertices;
    lists.deformed_vertices += (job.primitive->vertex_count + 63) / 64 * 64;
  }
  const auto index_of = [](const Caster& caster) { return caster.entity.index; };
  if (!std::ranges::is_sorted(lists.casters.casters, {}, index_of))
    std::ranges::stable_sort(lists.casters.casters, {}, index_of);
  for (ViewDraws& draws : lists.views) sort(draws);
  return lists;
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/tracing/scene_triangles.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <span>

#include "engine/core/hash.h"
#include "engine/ecs/view.h"
#include "engine/render/packing/caster_bounds.h"
#include "engine/render/packing/refined_triangles.h"
#include "engine/scene/components.h"
#include "engine/scene/posing/animated_nodes.h"
#include "engine/scene/resources.h"
#include "modules/accuracy/tracing/texture_fetch.h"

namespace gloam {
namespace {

/// A mesh instance and the transforms of its vertices.
struct Instance {
  Entity entity;
  const Mesh* mesh = nullptr;
  std::uint32_t mesh_index = 0;
  bool casts = true;
  bool mirrored = false;
  dmat4 world_from_mesh = dmat4(1.0);
  std::span<const mat4> joints;  ///< empty: rigid
  dvec3 joint_origin = dvec3(0.0);
  std::span<const float> weights;  ///< of its morph targets
};

std::span<const mat4> joints_of(const JointMatrices& all, Entity entity, dvec3& origin, bool& mirrored) {
  const auto range =
      std::lower_bound(all.ranges.begin(), all.ranges.end(), entity.index,
                       [](const JointMatrices::Range& r, std::uint32_t index) { return r.instance.index < index; });
  if (range == all.ranges.end() || range->instance != entity) return {};
  origin = range->origin;
  mirrored = range->mirrored;
  return std::span(all.matrices).subspan(range->first, range->count);
}

std::vector<Instance> gather_instances(const World& world, TracedInstances traced) {
  const auto& assets = world.resource<SceneAssets>();
  const auto& joints = world.resource<JointMatrices>();
  const std::vector<float>& weights = world.resource<MorphWeights>().values;
  const AnimatedNodes animated(world);
  std::vector<Instance> instances;
  world.view<const MeshInstance, const WorldTransform, Maybe<const MorphInstance>>().each(
      [&](Entity entity, const MeshInstance& drawn, const WorldTransform& transform, const MorphInstance* morph) {
        if (drawn.mesh >= assets.meshes.size()) return;
        if (traced == TracedInstances::at_rest && (drawn.skin != kNone || morph != nullptr || animated.moves(entity)))
          return;
        Instance instance;
        instance.entity = entity;
        instance.mesh = &assets.meshes[drawn.mesh];
        instance.mesh_index = drawn.mesh;
        instance.casts = drawn.casts_shadows;
        instance.world_from_mesh = transform.matrix;
        instance.mirrored = glm::determinant(glm::dmat3(transform.matrix)) < 0.0;
        if (drawn.skin != kNone) instance.joints = joints_of(joints, entity, instance.joint_origin, instance.mirrored);
        if (morph != nullptr && std::size_t{morph->first} + morph->count <= weights.size())
          instance.weights = std::span(weights).subspan(morph->first, morph->count);
        instances.push_back(instance);
      });
  std::sort(instances.begin(), instances.end(),
            [](const Instance& a, const Instance& b) { return a.entity.index < b.entity.index; });
  return instances;
}

/// The middle of the instances that cast shadows.
dvec3 middle_of(std::span<const Instance> instances) {
  dvec3 low(1e300), high(-1e300);
  for (const Instance& instance : instances) {
    if (!instance.casts) continue;
    const dvec3 at = !instance.joints.empty() ? instance.joint_origin
                     : instance.mesh->bounds.empty()
                         ? dvec3(instance.world_from_mesh[3])
                         : dvec3(instance.world_from_mesh * dvec4(dvec3(instance.mesh->bounds.center()), 1.0));
    if (!std::isfinite(at.x + at.y + at.z)) continue;
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  return low.x <= high.x ? (low + high) * 0.5 : dvec3(0.0);
}

/// Weights with sum 1, none negative. If the sum is 0 or not finite, the first joint gets all, as in the vertex data of
/// frames.
vec4 normalised(const vec4& weights) {
  vec4 result(0.0f);
  float sum = 0.0f;
  for (int k = 0; k < 4; ++k) {
    if (weights[k] > 0.0f) result[k] = weights[k];
    sum += result[k];
  }
  if (!(sum > 0.0f) || !std::isfinite(sum)) return {1.0f, 0.0f, 0.0f, 0.0f};
  return result / sum;
}

std::vector<vec3> morphed_positions(const Primitive& primitive, std::span<const float> weights) {
  std::vector<vec3> positions = primitive.positions;
  // A primitive with more targets than weights is drawn at rest.
  if (weights.size() < primitive.morph_targets.size()) return positions;
  for (std::size_t target = 0; target < primitive.morph_targets.size(); ++target) {
    const std::vector<vec3>& offsets = primitive.morph_targets[target].positions;
    for (std::size_t v = 0; v < std::min(positions.size(), offsets.size()); ++v)
      positions[v] += weights[target] * offsets[v];
  }
  return positions;
}

void skin_positions(const Primitive& primitive, const Instance& instance, const dvec3& origin,
                    std::vector<vec3>& positions) {
  const dvec3 shift = instance.joint_origin - origin;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const vec4 weights = normalised(primitive.weights[v]);
    dvec3 posed(0.0);
    for (int k = 0; k < 4; ++k) {
      const std::uint32_t joint = primitive.joints[v][static_cast<std::size_t>(k)];
      if (weights[k] == 0.0f || joint >= instance.joints.size()) continue;
      posed += static_cast<double>(weights[k]) * dvec3(dmat4(instance.joints[joint]) * dvec4(dvec3(positions[v]), 1.0));
    }
    positions[v] = vec3(posed + shift);
  }
}

/// Where rays are relative to, and the size of the smallest thing.
struct TracedFrom {
  dvec3 origin = dvec3(0.0);
  double smallest = 0.0;  ///< half diagonal
};

/// The primitive with smaller triangles, around `split_origin` in the mesh; null if none is so long that its rounding
/// counts beside the smallest thing.
std::shared_ptr<const Primitive> split_of(const Primitive& primitive, const dmat4& world_from_mesh,
                                          const TracedFrom& from, dvec3& split_origin) {
  const double determinant = glm::determinant(glm::dmat3(world_from_mesh));
  const double length = half_diagonal(primitive.bounds, world_from_mesh);
  if (!(length > kTooLong * from.smallest) || !std::isfinite(length) || !(std::abs(determinant) > 0.0)) return nullptr;
  const SeenFrom seen{world_from_mesh, std::span(&from.origin, 1), from.smallest};
  if (!(split_slack(primitive, seen) < 0.0)) return nullptr;
  split_origin = dvec3(glm::inverse(world_from_mesh) * dvec4(from.origin, 1.0));
  return std::make_shared<const Primitive>(refined_triangles(primitive, seen, split_origin));
}

void place_positions(const dmat4& world_from_mesh, const dvec3& origin, std::vector<vec3>& positions) {
  dmat4 relative = world_from_mesh;
  relative[3] -= dvec4(origin, 0.0);
  for (vec3& position : positions) position = vec3(relative * dvec4(dvec3(position), 1.0));
}

/// Transform of normals: the cofactors, with the sign that keeps normals on the outside when the matrix mirrors.
glm::dmat3 normal_matrix(const glm::dmat3& m) {
  const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  const double largest = std::max({glm::length(cofactors[0]), glm::length(cofactors[1]), glm::length(cofactors[2])});
  const double side = glm::dot(m[0], cofactors[0]) < 0.0 ? -1.0 : 1.0;
  return largest > 0.0 && std::isfinite(largest) ? cofactors * (side / largest) : glm::dmat3(1.0);
}

/// Normals of a morphed or skinned primitive in the world's axes, of any length.
std::vector<vec3> deformed_normals(const Primitive& primitive, const Instance& instance, bool morphed, bool skinned) {
  std::vector<vec3> normals = primitive.normals;
  for (std::size_t target = 0; morphed && target < primitive.morph_targets.size(); ++target) {
    const std::vector<vec3>& offsets = primitive.morph_targets[target].normals;
    for (std::size_t v = 0; v < std::min(normals.size(), offsets.size()); ++v)
      normals[v] += instance.weights[target] * offsets[v];
  }
  const glm::dmat3 rigid = normal_matrix(glm::dmat3(instance.world_from_mesh));
  for (std::size_t v = 0; v < normals.size(); ++v) {
    if (!skinned) {
      normals[v] = vec3(rigid * dvec3(normals[v]));
      continue;
    }
    const vec4 weights = normalised(primitive.weights[v]);
    glm::dmat3 posed(0.0);
    for (int k = 0; k < 4; ++k) {
      const std::uint32_t joint = primitive.joints[v][static_cast<std::size_t>(k)];
      if (weights[k] == 0.0f || joint >= instance.joints.size()) continue;
      posed += static_cast<double>(weights[k]) * glm::dmat3(dmat4(instance.joints[joint]));
    }
    normals[v] = vec3(normal_matrix(posed) * dvec3(normals[v]));
  }
  return normals;
}

void add_cut_out_data(const Primitive& primitive, const TextureSlot& slot, TriangleMesh& mesh) {
  const std::vector<vec2>& uvs = slot.uv_set == 0 ? primitive.uv0 : primitive.uv1;
  mesh.uvs.resize(primitive.positions.size());
  for (std::size_t v = 0; v < mesh.uvs.size(); ++v) {
    const vec3 uv(v < uvs.size() ? uvs[v] : vec2(0.0f), 1.0f);
    mesh.uvs[v] = vec2(glm::dot(slot.transform_row0, uv), glm::dot(slot.transform_row1, uv));
  }
  for (const vec4& color : primitive.colors) mesh.alphas.push_back(std::clamp(color.a, 0.0f, 1.0f));
}

TriangleMesh make_mesh(const Instance& instance, std::uint32_t primitive_index, const SceneAssets& assets,
                       std::span<const std::uint32_t> cut_out_of_material, const TracedFrom& from) {
  const dvec3& origin = from.origin;
  const Primitive& own = instance.mesh->primitives[primitive_index];
  const bool rigid = instance.joints.empty() && own.morph_targets.empty();
  dvec3 split_origin(0.0);
  const auto split = rigid ? split_of(own, instance.world_from_mesh, from, split_origin) : nullptr;
  const Primitive& primitive = split != nullptr ? *split : own;
  TriangleMesh mesh;
  mesh.positions = morphed_positions(primitive, instance.weights);
  const bool has_influences =
      primitive.joints.size() == mesh.positions.size() && primitive.weights.size() == mesh.positions.size();
  if (!instance.joints.empty() && has_influences)
    skin_positions(primitive, instance, origin, mesh.positions);
  else
    place_positions(glm::translate(instance.world_from_mesh, split_origin), origin, mesh.positions);
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    const std::span<const std::uint32_t> corners = std::span(primitive.indices).subspan(i, 3);
    if (std::ranges::all_of(corners, [&](std::uint32_t corner) { return corner < mesh.positions.size(); }))
      mesh.indices.insert(mesh.indices.end(), corners.begin(), corners.end());
  }
  const bool morphed = !primitive.morph_targets.empty() && instance.weights.size() >= primitive.morph_targets.size();
  const bool skinned = !instance.joints.empty() && has_influences;
  mesh.surface = {.mesh = instance.mesh_index, .primitive = primitive_index, .mirrored = instance.mirrored};
  mesh.surface.split = split;
  mesh.surface.normal_from_mesh = mat3(normal_matrix(glm::dmat3(instance.world_from_mesh)));
  if (morphed || skinned) mesh.surface.normals = deformed_normals(primitive, instance, morphed, skinned);
  if (primitive.material >= assets.materials.size()) return mesh;
  if (!morphed && !skinned && is_emissive(assets.materials[primitive.material])) {
    const WorldBox box = world_box(own.bounds, instance.world_from_mesh);
    mesh.min = box.min;
    mesh.max = box.max;
    mesh.emissive_reach_m = half_diagonal(own.bounds, instance.world_from_mesh);
  }
  mesh.cut_out = cut_out_of_material[primitive.material];
  if (mesh.cut_out != kNone) add_cut_out_data(primitive, assets.materials[primitive.material].base_color_texture, mesh);
  return mesh;
}

CutOut make_cut_out(const Material& material, const SceneAssets& assets) {
  CutOut cut_out;
  cut_out.alpha = material.base_color.a;
  cut_out.cutoff = material.alpha_cutoff;
  if (material.base_color_texture.texture >= assets.textures.size()) return cut_out;
  const Texture& texture = assets.textures[material.base_color_texture.texture];
  if (texture.image >= assets.images.size()) return cut_out;
  const Image& image = assets.images[texture.image];
  cut_out.width = image.width;
  cut_out.height = image.height;
  cut_out.texels.resize(std::size_t{image.width} * image.height);
  for (std::size_t i = 0; i < cut_out.texels.size(); ++i) cut_out.texels[i] = image.rgba[4 * i + 3];
  cut_out.nearest = texture.nearest;
  cut_out.wrap_u = texture.wrap_u;
  cut_out.wrap_v = texture.wrap_v;
  return cut_out;
}

void add_shape(Hasher& hasher, const TriangleMesh& mesh) {
  hasher.value(mesh.positions.size()).value(mesh.indices.size()).value(mesh.cut_out);
  hasher.bytes(std::as_bytes(std::span(mesh.positions))).bytes(std::as_bytes(std::span(mesh.indices)));
}

}  // namespace

bool CutOut::is_hole(vec2 uv, float vertex_alpha) const {
  float value = alpha * vertex_alpha;
  if (width > 0 && height > 0) {
    const auto texel = [&](std::int64_t x, std::int64_t y) {
      return static_cast<double>(texels[wrapped_texel(y, height, wrap_v) * width + wrapped_texel(x, width, wrap_u)]);
    };
    const double shift = nearest ? 0.0 : 0.5;
    const double x = texel_coordinate(uv.x, width) - shift, y = texel_coordinate(uv.y, height) - shift;
    const double left = std::floor(x), top = std::floor(y);
    const auto column = static_cast<std::int64_t>(left), row = static_cast<std::int64_t>(top);
    double sampled = texel(column, row);
    if (!nearest) {
      const double upper = glm::mix(sampled, texel(column + 1, row), x - left);
      const double lower = glm::mix(texel(column, row + 1), texel(column + 1, row + 1), x - left);
      sampled = glm::mix(upper, lower, y - top);
    }
    value *= static_cast<float>(sampled / 255.0);
  }
  return value < cutoff;
}

std::uint64_t SceneTriangles::count() const {
  std::uint64_t total = 0;
  for (const TriangleMesh& mesh : meshes) total += mesh.indices.size() / 3;
  return total;
}

std::uint64_t SceneTriangles::hash() const {
  Hasher hasher;
  hasher.bytes_of(origin);
  for (const TriangleMesh& mesh : meshes) {
    add_shape(hasher, mesh);
    hasher.bytes_of(mesh.emissive_reach_m);
    hasher.bytes(std::as_bytes(std::span(mesh.uvs))).bytes(std::as_bytes(std::span(mesh.alphas)));
  }
  for (const CutOut& cut_out : cut_outs) {
    hasher.bytes_of(cut_out.alpha).bytes_of(cut_out.cutoff);
    hasher.value(cut_out.width).value(cut_out.height).value(cut_out.nearest);
    hasher.value(cut_out.wrap_u).value(cut_out.wrap_v).bytes(std::as_bytes(std::span(cut_out.texels)));
  }
  return hasher.digest();
}

std::uint64_t SceneTriangles::hash_of_all() const {
  Hasher hasher;
  hasher.value(hash());
  for (const TriangleMesh& mesh : uncast) add_shape(hasher, mesh);
  return hasher.digest();
}

SceneTriangles gather_triangles(const World& world, const std::optional<dvec3>& origin, JobExecutor& executor,
                                TracedInstances traced) {
  const auto& assets = world.resource<SceneAssets>();
  const std::vector<Instance> instances = gather_instances(world, traced);
  SceneTriangles triangles;
  triangles.origin = origin ? *origin : middle_of(instances);
  std::vector<std::uint32_t> cut_out_of_material(assets.materials.size(), kNone);
  for (std::size_t m = 0; m < assets.materials.size(); ++m) {
    if (assets.materials[m].alpha_mode != AlphaMode::mask) continue;
    cut_out_of_material[m] = static_cast<std::uint32_t>(triangles.cut_outs.size());
    triangles.cut_outs.push_back(make_cut_out(assets.materials[m], assets));
  }
  const auto is_solid = [&](const Primitive& primitive) {
    const bool has_material = primitive.material < assets.materials.size();
    return !has_material || assets.materials[primitive.material].alpha_mode != AlphaMode::blend;
  };
  TracedFrom from{triangles.origin, std::numeric_limits<double>::infinity()};
  for (const Instance& instance : instances)
    if (const double size = half_diagonal(instance.mesh->bounds, instance.world_from_mesh); size > 0.0)
      from.smallest = std::min(from.smallest, size);
  std::vector<std::vector<TriangleMesh>> parts(instances.size());
  executor.parallel_for(instances.size(), 1, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      for (std::uint32_t p = 0; p < instances[i].mesh->primitives.size(); ++p)
        if (is_solid(instances[i].mesh->primitives[p]))
          parts[i].push_back(make_mesh(instances[i], p, assets, cut_out_of_material, from));
  });
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (TriangleMesh& mesh : parts[i])
      if (!mesh.indices.empty()) (instances[i].casts ? triangles.meshes : triangles.uncast).push_back(std::move(mesh));
  return triangles;
}

}  // namespace gloam

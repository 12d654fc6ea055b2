// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "engine/scene/assets.h"
#include "engine/scene/assets/check.h"
#include "engine/scene/assets/mesh_builder.h"
#include "engine/scene/components.h"
#include "modules/c_interface/handles.h"
#include "modules/lights/components.h"
#include "modules/shadows/components.h"

// Materials, meshes and lights of a world.

using gloam::c_interface::guarded_with;
using gloam::c_interface::usage_error;
using gloam::c_interface::WorldObject;

namespace gloam::c_interface {
namespace {

/// Usage error if one of the values is below `least` or not finite.
Status check_values(std::initializer_list<float> values, float least, const char* name) {
  for (const float value : values)
    if (!std::isfinite(value) || value < least)
      return usage_error(std::string(name) + " is not finite or less than " + std::to_string(static_cast<int>(least)));
  return {};
}

Status create_material(WorldObject& of, const gloam_material* given, std::uint32_t& number) {
  gloam_material read;
  GLOAM_TRY(read_struct(given, gloam_material(GLOAM_MATERIAL_INIT), "gloam_material", read));
  const float* color = read.base_color;
  GLOAM_TRY(check_values({color[0], color[1], color[2], color[3]}, 0.0f, "gloam_material::base_color"));
  GLOAM_TRY(check_values({read.emissive[0], read.emissive[1], read.emissive[2]}, 0.0f, "gloam_material::emissive"));
  GLOAM_TRY(check_values({read.metallic, read.roughness}, 0.0f, "gloam_material::metallic or roughness"));
  Material material;
  material.base_color = vec4(color[0], color[1], color[2], color[3]);
  material.emissive = vec3(read.emissive[0], read.emissive[1], read.emissive[2]);
  material.metallic = std::min(read.metallic, 1.0f);
  material.roughness = std::min(read.roughness, 1.0f);
  material.double_sided = read.double_sided != 0;
  number = of.world.resource<SceneAssets>().add(std::move(material));
  return {};
}

/// Usage error if an index is out of range or a position or normal is not finite.
Status check_mesh(const gloam_mesh& mesh, const SceneAssets& assets) {
  if (mesh.positions == nullptr || mesh.vertex_count == 0) return usage_error("gloam_mesh has no positions");
  if (mesh.material >= assets.materials.size())
    return usage_error("gloam_mesh::material is " + std::to_string(mesh.material) + "; the world has " +
                       std::to_string(assets.materials.size()) + " materials");
  const std::uint32_t corners = mesh.indices == nullptr ? mesh.vertex_count : mesh.index_count;
  if (corners == 0 || corners % 3 != 0)
    return usage_error("gloam_mesh has " + std::to_string(corners) + " corners; a triangle has three");
  for (std::uint32_t i = 0; mesh.indices != nullptr && i < mesh.index_count; ++i)
    if (mesh.indices[i] >= mesh.vertex_count)
      return usage_error("gloam_mesh::indices[" + std::to_string(i) + "] is " + std::to_string(mesh.indices[i]) +
                         " of " + std::to_string(mesh.vertex_count) + " vertices");
  const auto finite = [](const float* values, std::size_t count) {
    return values == nullptr || std::all_of(values, values + count, [](float v) { return std::isfinite(v); });
  };
  const std::size_t count = mesh.vertex_count;
  if (!finite(mesh.positions, 3 * count) || !finite(mesh.normals, 3 * count) || !finite(mesh.uv, 2 * count))
    return usage_error("gloam_mesh holds a number that is not finite");
  return {};
}

Status create_mesh(WorldObject& of, const gloam_mesh* given, std::uint32_t& number) {
  gloam_mesh read;
  GLOAM_TRY(read_struct(given, gloam_mesh(GLOAM_MESH_INIT), "gloam_mesh", read));
  auto& assets = of.world.resource<SceneAssets>();
  GLOAM_TRY(check_mesh(read, assets));
  Primitive primitive;
  primitive.material = read.material;
  for (std::size_t i = 0; i < read.vertex_count; ++i) {
    primitive.positions.emplace_back(read.positions[3 * i], read.positions[3 * i + 1], read.positions[3 * i + 2]);
    if (read.uv != nullptr) primitive.uv0.emplace_back(read.uv[2 * i], read.uv[2 * i + 1]);
    if (read.normals == nullptr) continue;
    const vec3 normal(read.normals[3 * i], read.normals[3 * i + 1], read.normals[3 * i + 2]);
    const float length = glm::length(normal);
    if (std::abs(length - 1.0f) > 0.01f)
      return usage_error("gloam_mesh::normals: that of vertex " + std::to_string(i) + " has not unit length");
    primitive.normals.push_back(normal / length);
  }
  if (read.indices != nullptr) primitive.indices.assign(read.indices, read.indices + read.index_count);
  Mesh mesh;
  mesh.primitives.push_back(std::move(primitive));
  complete_mesh(mesh, assets);
  number = assets.add(std::move(mesh));
  const std::string fault = asset_fault(assets, AssetKind::mesh, number);
  if (fault.empty()) return {};
  assets.destroy(AssetKind::mesh, number);
  return usage_error("gloam_mesh: " + fault);
}

Result<Light> light_of(const gloam_light* given, bool& casts) {
  gloam_light read;
  GLOAM_TRY(read_struct(given, gloam_light(GLOAM_LIGHT_INIT), "gloam_light", read));
  if (read.kind < GLOAM_LIGHT_POINT || read.kind > GLOAM_LIGHT_DIRECTIONAL)
    return usage_error("gloam_light::kind is " + std::to_string(static_cast<int>(read.kind)));
  GLOAM_TRY(check_values({read.color[0], read.color[1], read.color[2]}, 0.0f, "gloam_light::color"));
  GLOAM_TRY(check_values(
      {read.intensity, read.range_m, read.inner_angle, read.outer_angle, read.width_m, read.apparent_angle}, 0.0f,
      "a number of gloam_light"));
  Light light;
  light.kind = static_cast<LightKind>(read.kind);
  light.color = vec3(read.color[0], read.color[1], read.color[2]);
  light.intensity = read.intensity;
  light.range_m = read.range_m;
  light.inner_angle = read.inner_angle;
  light.outer_angle = read.outer_angle;
  light.width_m = read.width_m;
  light.apparent_angle = read.apparent_angle;
  casts = read.casts_shadows != 0;
  return light;
}

}  // namespace
}  // namespace gloam::c_interface

extern "C" {

gloam_result gloam_material_create(gloam_world* world, const gloam_material* material, uint32_t* number) {
  return guarded_with(world, "gloam_material_create", [&](WorldObject& of) -> gloam::Status {
    if (number == nullptr) return usage_error("gloam_material_create: an argument is null");
    return gloam::c_interface::create_material(of, material, *number);
  });
}

gloam_result gloam_mesh_create(gloam_world* world, const gloam_mesh* mesh, uint32_t* number) {
  return guarded_with(world, "gloam_mesh_create", [&](WorldObject& of) -> gloam::Status {
    if (number == nullptr) return usage_error("gloam_mesh_create: an argument is null");
    return gloam::c_interface::create_mesh(of, mesh, *number);
  });
}

gloam_result gloam_instance_create(gloam_world* world, uint32_t mesh, const double matrix[16], gloam_entity* entity) {
  return guarded_with(world, "gloam_instance_create", [&](WorldObject& of) -> gloam::Status {
    if (entity == nullptr) return usage_error("gloam_instance_create: an argument is null");
    const auto pose = gloam::c_interface::matrix_of(matrix, "matrix");
    if (!pose) return pose.error();
    const std::size_t meshes = of.world.resource<gloam::SceneAssets>().meshes.size();
    if (mesh >= meshes)
      return usage_error("gloam_instance_create: mesh is " + std::to_string(mesh) + "; the world has " +
                         std::to_string(meshes));
    *entity =
        gloam::c_interface::number_of(of.world.create(gloam::WorldTransform{*pose}, gloam::MeshInstance{.mesh = mesh}));
    return {};
  });
}

gloam_result gloam_light_create(gloam_world* world, const gloam_light* light, const double matrix[16],
                                gloam_entity* entity) {
  return guarded_with(world, "gloam_light_create", [&](WorldObject& of) -> gloam::Status {
    if (entity == nullptr) return usage_error("gloam_light_create: an argument is null");
    bool casts = true;
    const auto made = gloam::c_interface::light_of(light, casts);
    if (!made) return made.error();
    const auto pose = gloam::c_interface::matrix_of(matrix, "matrix");
    if (!pose) return pose.error();
    *entity = gloam::c_interface::number_of(
        of.world.create(gloam::WorldTransform{*pose}, *made, gloam::ShadowCaster{.enabled = casts}));
    return {};
  });
}

gloam_result gloam_light_set(gloam_world* world, gloam_entity entity, const gloam_light* light) {
  return guarded_with(world, "gloam_light_set", [&](WorldObject& of) -> gloam::Status {
    const auto found = gloam::c_interface::entity_of(of.world, entity);
    if (!found) return found.error();
    if (!of.world.has<gloam::Light>(*found))
      return usage_error("gloam_light_set: entity " + std::to_string(entity) + " is no light");
    bool casts = true;
    const auto made = gloam::c_interface::light_of(light, casts);
    if (!made) return made.error();
    of.world.add(*found, *made);
    of.world.add(*found, gloam::ShadowCaster{.enabled = casts});
    return {};
  });
}

}  // extern "C"

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/core/assert.h"
#include "engine/scene/assets/vertices.h"

// Tangents weighted as in MikkTSpace (by corner angle, projected off the normal), but without its welding: vertices are
// shared as in the file. The distribution does not package MikkTSpace itself.

namespace gloam {
namespace {

dvec3 perpendicular(const dvec3& normal) {
  const dvec3 axis = std::fabs(normal.x) < 0.6 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0);
  return glm::normalize(glm::cross(normal, axis));
}

/// v projected off the normal, unit length; zero if (nearly) nothing is left.
dvec3 across(const dvec3& v, const dvec3& normal) {
  const double length = glm::length(v);
  if (!(length > 0.0) || !std::isfinite(length)) return dvec3(0.0);
  const dvec3 projected = v / length - normal * glm::dot(normal, v / length);
  const double across_length = glm::length(projected);
  return across_length > 1e-6 ? projected / across_length : dvec3(0.0);
}

/// Angle between two edges at a corner, radians.
double corner_angle(const dvec3& a, const dvec3& b) {
  const double lengths = glm::length(a) * glm::length(b);
  return lengths > 0.0 ? std::acos(std::clamp(glm::dot(a, b) / lengths, -1.0, 1.0)) : 0.0;
}

/// Direction in which u grows (any length), and whether the texture is mirrored on the face. Not valid if the face has
/// no area in texture space.
struct FaceTangent {
  dvec3 direction = dvec3(0.0);
  bool mirrored = false;
  bool valid = false;
};

FaceTangent face_tangent(const std::array<dvec3, 3>& p, const std::array<dvec3, 3>& uv) {
  const dvec3 duv1 = uv[1] - uv[0];
  const dvec3 duv2 = uv[2] - uv[0];
  const double area = duv1.x * duv2.y - duv2.x * duv1.y;
  FaceTangent face;
  if (area == 0.0 || !std::isfinite(area)) return face;
  face.direction = ((p[1] - p[0]) * duv2.y - (p[2] - p[0]) * duv1.y) * (area > 0.0 ? 1.0 : -1.0);
  // v points down in glTF images, so texture space is right-handed if the area is negative.
  face.mirrored = area > 0.0;
  face.valid = true;
  return face;
}

/// Splits vertices that mirrored and unmirrored faces share. Returns each vertex's handedness.
std::vector<float> split_mirrored(Primitive& primitive, const std::vector<FaceTangent>& faces) {
  constexpr std::uint8_t kPlain = 1;
  constexpr std::uint8_t kMirrored = 2;
  const std::size_t count = primitive.positions.size();
  std::vector<std::uint8_t> uses(count, 0);
  for (std::size_t i = 0; i < primitive.indices.size(); ++i)
    if (faces[i / 3].valid) uses[primitive.indices[i]] |= faces[i / 3].mirrored ? kMirrored : kPlain;
  std::vector<std::uint32_t> copy_of(count, kNone);
  std::vector<std::uint32_t> sources(count);
  for (std::size_t i = 0; i < count; ++i) sources[i] = static_cast<std::uint32_t>(i);
  for (std::size_t i = 0; i < primitive.indices.size(); ++i) {
    std::uint32_t& index = primitive.indices[i];
    if (uses[index] != (kPlain | kMirrored) || !faces[i / 3].valid || !faces[i / 3].mirrored) continue;
    if (copy_of[index] == kNone) {
      copy_of[index] = static_cast<std::uint32_t>(sources.size());
      sources.push_back(index);
    }
    index = copy_of[index];
  }
  if (sources.size() > count) gather_vertices(primitive, sources);
  std::vector<float> handedness(sources.size(), 1.0f);
  for (std::size_t i = 0; i < sources.size(); ++i)
    if (i >= count || uses[i] == kMirrored) handedness[i] = -1.0f;
  return handedness;
}

}  // namespace

void make_tangents(Primitive& primitive, const TextureSlot& normal_texture) {
  GLOAM_ASSERT(primitive.normals.size() == primitive.positions.size(), "tangents need normals");
  const std::vector<vec2>& uv = normal_texture.uv_set == 1 ? primitive.uv1 : primitive.uv0;
  std::vector<FaceTangent> faces(primitive.indices.size() / 3);
  for (std::size_t f = 0; f < faces.size() && !uv.empty(); ++f) {
    std::array<dvec3, 3> p;
    std::array<dvec3, 3> t;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = primitive.indices[f * 3 + corner];
      const dvec3 coordinates(uv[vertex], 1.0);
      p[corner] = dvec3(primitive.positions[vertex]);
      t[corner] = dvec3(glm::dot(dvec3(normal_texture.transform_row0), coordinates),
                        glm::dot(dvec3(normal_texture.transform_row1), coordinates), 0.0);
    }
    faces[f] = face_tangent(p, t);
  }
  const std::vector<float> handedness = split_mirrored(primitive, faces);
  std::vector<dvec3> sums(primitive.positions.size(), dvec3(0.0));
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (!faces[f].valid) continue;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = primitive.indices[f * 3 + corner];
      const dvec3 here(primitive.positions[vertex]);
      const dvec3 next(primitive.positions[primitive.indices[f * 3 + (corner + 1) % 3]]);
      const dvec3 last(primitive.positions[primitive.indices[f * 3 + (corner + 2) % 3]]);
      sums[vertex] +=
          across(faces[f].direction, dvec3(primitive.normals[vertex])) * corner_angle(next - here, last - here);
    }
  }
  primitive.tangents.resize(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const dvec3 normal(primitive.normals[i]);
    const dvec3 tangent = across(sums[i], normal);
    primitive.tangents[i] = vec4(vec3(tangent == dvec3(0.0) ? perpendicular(normal) : tangent), handedness[i]);
  }
}

void repair_tangents(Primitive& primitive) {
  for (std::size_t i = 0; i < primitive.tangents.size(); ++i) {
    vec4& tangent = primitive.tangents[i];
    const dvec3 normal(primitive.normals[i]);
    const dvec3 direction = across(dvec3(tangent), normal);
    tangent = vec4(vec3(direction == dvec3(0.0) ? perpendicular(normal) : direction), tangent.w < 0.0f ? -1.0f : 1.0f);
  }
}

}  // namespace gloam

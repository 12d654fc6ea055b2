// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/assets/vertices.h"

#include <cmath>
#include <utility>
#include <vector>

namespace gloam {
namespace {

constexpr vec3 kUp = vec3(0.0f, 1.0f, 0.0f);

template <class T>
void gather(std::vector<T>& values, std::span<const std::uint32_t> sources) {
  if (values.empty()) return;
  std::vector<T> gathered(sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i) gathered[i] = values[sources[i]];
  values = std::move(gathered);
}

/// Cross product of two edges; its length is twice the face's area. In double: products of large coordinates overflow a
/// float.
dvec3 face_cross(const Primitive& primitive, std::size_t first_index) {
  const dvec3 a(primitive.positions[primitive.indices[first_index]]);
  const dvec3 b(primitive.positions[primitive.indices[first_index + 1]]);
  const dvec3 c(primitive.positions[primitive.indices[first_index + 2]]);
  return glm::cross(b - a, c - a);
}

/// Unit vector, or `otherwise` if the length is zero or not finite.
vec3 unit_or(const dvec3& v, const vec3& otherwise) {
  const double length = glm::length(v);
  return length > 0.0 && std::isfinite(length) ? vec3(v / length) : otherwise;
}

}  // namespace

void gather_vertices(Primitive& primitive, std::span<const std::uint32_t> sources) {
  gather(primitive.positions, sources);
  gather(primitive.normals, sources);
  gather(primitive.tangents, sources);
  gather(primitive.uv0, sources);
  gather(primitive.uv1, sources);
  gather(primitive.colors, sources);
  gather(primitive.joints, sources);
  gather(primitive.weights, sources);
  for (Primitive::MorphTarget& target : primitive.morph_targets) {
    gather(target.positions, sources);
    gather(target.normals, sources);
  }
}

void drop_unused_vertices(Primitive& primitive) {
  if (primitive.indices.size() >= primitive.positions.size()) return;
  std::vector<std::uint32_t> place(primitive.positions.size(), kNone);
  std::vector<std::uint32_t> sources;
  for (std::uint32_t& index : primitive.indices) {
    if (place[index] == kNone) {
      place[index] = static_cast<std::uint32_t>(sources.size());
      sources.push_back(index);
    }
    index = place[index];
  }
  gather_vertices(primitive, sources);
}

void make_flat_normals(Primitive& primitive) {
  const std::vector<std::uint32_t> corners = primitive.indices;
  gather_vertices(primitive, corners);
  for (std::size_t i = 0; i < corners.size(); ++i) primitive.indices[i] = static_cast<std::uint32_t>(i);
  primitive.flat_shaded = true;
  primitive.normals.resize(corners.size());
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const vec3 normal = unit_or(face_cross(primitive, i), kUp);
    for (std::size_t corner = 0; corner < 3; ++corner) primitive.normals[i + corner] = normal;
  }
}

std::uint32_t repair_normals(Primitive& primitive) {
  // Normals shorter than this are not meant as normals: exporters write them for faces without area.
  constexpr float kZeroLength = 1e-6f;
  std::vector<std::uint32_t> zero;
  for (std::size_t i = 0; i < primitive.normals.size(); ++i) {
    vec3& normal = primitive.normals[i];
    if (std::fabs(normal.x) < kZeroLength && std::fabs(normal.y) < kZeroLength && std::fabs(normal.z) < kZeroLength)
      zero.push_back(static_cast<std::uint32_t>(i));
    else
      normal = unit_or(dvec3(normal), kUp);
  }
  if (zero.empty()) return 0;
  std::vector<std::uint32_t> sum_of(primitive.normals.size(), kNone);
  for (std::size_t i = 0; i < zero.size(); ++i) sum_of[zero[i]] = static_cast<std::uint32_t>(i);
  std::vector<dvec3> sums(zero.size(), dvec3(0.0));
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    const dvec3 normal = face_cross(primitive, i);
    for (std::size_t corner = 0; corner < 3; ++corner)
      if (const std::uint32_t sum = sum_of[primitive.indices[i + corner]]; sum != kNone) sums[sum] += normal;
  }
  for (std::size_t i = 0; i < zero.size(); ++i) primitive.normals[zero[i]] = unit_or(sums[i], kUp);
  return static_cast<std::uint32_t>(zero.size());
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/construction/shapes.h"

#include <cmath>
#include <vector>

#include "engine/core/assert.h"

namespace gloam {
namespace {

/// Corners counter-clockwise as seen from outside; each with its own normal.
void add_quad(Primitive& out, const vec3 (&corners)[4], const vec3 (&normals)[4]) {
  const auto first = static_cast<std::uint32_t>(out.positions.size());
  for (int i = 0; i < 4; ++i) {
    out.positions.push_back(corners[i]);
    out.normals.push_back(normals[i]);
  }
  for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) out.indices.push_back(first + corner);
}

void add_flat_quad(Primitive& out, vec3 a, vec3 b, vec3 c, vec3 d) {
  const vec3 normal = glm::normalize(glm::cross(b - a, d - a));
  add_quad(out, {a, b, c, d}, {normal, normal, normal, normal});
}

void set_bounds(Primitive& out) {
  for (const vec3& position : out.positions) out.bounds.grow(position);
}

}  // namespace

Primitive box_shape(vec3 size_m) {
  Primitive out;
  const float x = size_m.x * 0.5f;
  const float y = size_m.y;
  const float z = size_m.z * 0.5f;
  add_flat_quad(out, {-x, 0, z}, {x, 0, z}, {x, y, z}, {-x, y, z});
  add_flat_quad(out, {x, 0, -z}, {-x, 0, -z}, {-x, y, -z}, {x, y, -z});
  add_flat_quad(out, {x, 0, z}, {x, 0, -z}, {x, y, -z}, {x, y, z});
  add_flat_quad(out, {-x, 0, -z}, {-x, 0, z}, {-x, y, z}, {-x, y, -z});
  add_flat_quad(out, {-x, y, z}, {x, y, z}, {x, y, -z}, {-x, y, -z});
  add_flat_quad(out, {-x, 0, -z}, {x, 0, -z}, {x, 0, z}, {-x, 0, z});
  set_bounds(out);
  return out;
}

Primitive turned_shape(std::span<const vec2> outline, std::uint32_t sides) {
  GLOAM_ASSERT(outline.size() >= 2 && sides >= 3, "a turned shape has two points and three sides or more");
  Primitive out;
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
    const vec2 low = outline[i];
    const vec2 high = outline[i + 1];
    const vec2 along = high - low;
    if (glm::length(along) == 0.0f) continue;
    const vec2 slope = glm::normalize(vec2(along.y, -along.x));  // (outwards, upwards)
    const auto first = static_cast<std::uint32_t>(out.positions.size());
    for (std::uint32_t side = 0; side <= sides; ++side) {
      const float angle = 2.0f * kPi * static_cast<float>(side) / static_cast<float>(sides);
      const vec2 around(std::cos(angle), -std::sin(angle));
      for (const vec2& point : {low, high}) {
        out.positions.push_back({around.x * point.x, point.y, around.y * point.x});
        out.normals.push_back({around.x * slope.x, slope.y, around.y * slope.x});
      }
    }
    for (std::uint32_t side = 0; side < sides; ++side) {
      const std::uint32_t base = first + side * 2;
      if (low.x > 0.0f) out.indices.insert(out.indices.end(), {base, base + 2, base + 1});
      if (high.x > 0.0f) out.indices.insert(out.indices.end(), {base + 1, base + 2, base + 3});
    }
  }
  set_bounds(out);
  return out;
}

Primitive sphere_shape(float radius_m, std::uint32_t sides) {
  std::vector<vec2> outline;
  const std::uint32_t rings = sides / 2;
  for (std::uint32_t ring = 0; ring <= rings; ++ring) {
    const float angle = kPi * static_cast<float>(ring) / static_cast<float>(rings);
    const bool is_pole = ring == 0 || ring == rings;
    outline.push_back({is_pole ? 0.0f : radius_m * std::sin(angle), -radius_m * std::cos(angle)});
  }
  Primitive out = turned_shape(outline, sides);
  for (std::size_t i = 0; i < out.positions.size(); ++i) out.normals[i] = glm::normalize(out.positions[i]);
  return out;
}

Primitive arch_shape(const ArchSize& size, std::uint32_t segments) {
  GLOAM_ASSERT(size.radius_m * 2.0f < size.width_m && size.radius_m < size.height_m, "an arch fits its wall");
  const float half_width = size.width_m * 0.5f;
  const float z = size.depth_m * 0.5f;
  const float top = size.height_m;
  std::vector<vec2> edge = {{-half_width, 0.0f}};  // the wall's lower edge, from left to right
  for (std::uint32_t i = 0; i <= segments; ++i) {
    const float angle = kPi * static_cast<float>(segments - i) / static_cast<float>(segments);
    const float height = i == 0 || i == segments ? 0.0f : size.radius_m * std::sin(angle);
    edge.push_back({size.radius_m * std::cos(angle), height});
  }
  edge.push_back({half_width, 0.0f});

  Primitive out;
  for (std::size_t i = 0; i + 1 < edge.size(); ++i) {
    const vec2 a = edge[i];
    const vec2 b = edge[i + 1];
    add_flat_quad(out, {a.x, a.y, z}, {b.x, b.y, z}, {b.x, top, z}, {a.x, top, z});
    add_flat_quad(out, {b.x, b.y, -z}, {a.x, a.y, -z}, {a.x, top, -z}, {b.x, top, -z});
    const bool is_arch = i > 0 && i + 2 < edge.size();
    const vec3 normal_a = is_arch ? glm::normalize(vec3(-a, 0.0f)) : vec3(0.0f, -1.0f, 0.0f);
    const vec3 normal_b = is_arch ? glm::normalize(vec3(-b, 0.0f)) : vec3(0.0f, -1.0f, 0.0f);
    add_quad(out, {{a.x, a.y, -z}, {b.x, b.y, -z}, {b.x, b.y, z}, {a.x, a.y, z}},
             {normal_a, normal_b, normal_b, normal_a});
  }
  add_flat_quad(out, {-half_width, top, z}, {half_width, top, z}, {half_width, top, -z}, {-half_width, top, -z});
  add_flat_quad(out, {half_width, 0, z}, {half_width, 0, -z}, {half_width, top, -z}, {half_width, top, z});
  add_flat_quad(out, {-half_width, 0, -z}, {-half_width, 0, z}, {-half_width, top, z}, {-half_width, top, -z});
  set_bounds(out);
  return out;
}

Primitive rectangle_shape(vec2 size_m) {
  Primitive out;
  const float x = size_m.x * 0.5f;
  add_flat_quad(out, {-x, 0, 0}, {x, 0, 0}, {x, size_m.y, 0}, {-x, size_m.y, 0});
  out.uv0 = {{0.0f, 1.0f}, {1.0f, 1.0f}, {1.0f, 0.0f}, {0.0f, 0.0f}};
  set_bounds(out);
  return out;
}

void append_shape(Primitive& out, const Primitive& part, vec3 offset_m) {
  GLOAM_ASSERT(out.positions.empty() || out.uv0.empty() == part.uv0.empty(),
               "shapes with and without texture coordinates do not mix");
  const auto first = static_cast<std::uint32_t>(out.positions.size());
  for (const vec3& position : part.positions) {
    out.positions.push_back(position + offset_m);
    out.bounds.grow(position + offset_m);
  }
  out.normals.insert(out.normals.end(), part.normals.begin(), part.normals.end());
  out.uv0.insert(out.uv0.end(), part.uv0.begin(), part.uv0.end());
  for (const std::uint32_t index : part.indices) out.indices.push_back(first + index);
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/dusk/model.h"

#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "engine/core/assert.h"
#include "sandbox/scenes/construction/shapes.h"

namespace gloam {
namespace {

constexpr int kCurveSteps = 2;  // between two points of an outline

/// The points of a Catmull-Rom spline through the outline. Radii stay ≥ 0.
std::vector<vec2> curve_through(std::span<const vec2> outline) {
  std::vector<vec2> curve;
  const auto at = [&](std::ptrdiff_t i) {
    return outline[static_cast<std::size_t>(glm::clamp<std::ptrdiff_t>(i, 0, std::ssize(outline) - 1))];
  };
  for (std::ptrdiff_t i = 0; i + 1 < std::ssize(outline); ++i) {
    const vec2 a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
    for (int step = 0; step < kCurveSteps; ++step) {
      const float t = static_cast<float>(step) / kCurveSteps;
      const vec2 point =
          0.5f * (2.0f * b + t * (c - a + t * (2.0f * a - 5.0f * b + 4.0f * c - d + t * (3.0f * (b - c) + d - a))));
      curve.emplace_back(std::max(point.x, 0.0f), point.y);
    }
  }
  curve.push_back(outline.back());
  return curve;
}

void add_flat_triangle(Primitive& out, vec3 a, vec3 b, vec3 c) {
  const auto first = static_cast<std::uint32_t>(out.positions.size());
  const vec3 normal = glm::normalize(glm::cross(b - a, c - a));
  for (const vec3& corner : {a, b, c}) {
    out.positions.push_back(corner);
    out.normals.push_back(normal);
    out.bounds.grow(corner);
    out.indices.push_back(first + static_cast<std::uint32_t>(out.indices.size() % 3));
  }
}

}  // namespace

Primitive rounded_shape(std::span<const vec2> outline, std::uint32_t sides) {
  GLOAM_ASSERT(outline.size() >= 2 && sides >= 3, "a rounded shape has two points and three sides or more");
  const std::vector<vec2> curve = curve_through(outline);
  const auto rings = static_cast<std::uint32_t>(curve.size());
  Primitive out;
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    const vec2 along = curve[std::min(ring + 1, rings - 1)] - curve[ring == 0 ? 0 : ring - 1];
    const float length = glm::length(along);
    const vec2 slope = length > 0.0f ? vec2(along.y, -along.x) / length : vec2(1.0f, 0.0f);
    for (std::uint32_t side = 0; side <= sides; ++side) {
      const float angle = 2.0f * kPi * static_cast<float>(side) / static_cast<float>(sides);
      const vec2 around(std::cos(angle), -std::sin(angle));
      out.positions.emplace_back(around.x * curve[ring].x, curve[ring].y, around.y * curve[ring].x);
      out.normals.emplace_back(around.x * slope.x, slope.y, around.y * slope.x);
      out.bounds.grow(out.positions.back());
    }
  }
  for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
    for (std::uint32_t side = 0; side < sides; ++side) {
      const std::uint32_t low = ring * (sides + 1) + side, high = low + sides + 1;
      if (curve[ring].x > 0.0f) out.indices.insert(out.indices.end(), {low, low + 1, high});
      if (curve[ring + 1].x > 0.0f) out.indices.insert(out.indices.end(), {high, low + 1, high + 1});
    }
  }
  return out;
}

Primitive tube_shape(std::span<const vec3> line, std::span<const float> radii, std::uint32_t sides) {
  GLOAM_ASSERT(line.size() >= 2 && radii.size() == line.size() && sides >= 3, "a tube has a radius for each point");
  const auto rings = static_cast<std::uint32_t>(line.size());
  Primitive out;
  vec3 side_axis(0.0f);
  const auto add_vertex = [&](vec3 position, vec3 normal) {
    out.positions.push_back(position);
    out.normals.push_back(normal);
    out.bounds.grow(position);
  };
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    const vec3 along = glm::normalize(line[std::min(ring + 1, rings - 1)] - line[ring == 0 ? 0 : ring - 1]);
    // The axis of the ring before, turned as little as possible, so that the tube does not twist.
    const vec3 guide = ring > 0 ? side_axis : (std::abs(along.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0));
    side_axis = glm::normalize(guide - along * glm::dot(guide, along));
    const vec3 other = glm::cross(along, side_axis);
    for (std::uint32_t side = 0; side <= sides; ++side) {
      const float angle = 2.0f * kPi * static_cast<float>(side) / static_cast<float>(sides);
      const vec3 normal = std::cos(angle) * side_axis + std::sin(angle) * other;
      add_vertex(line[ring] + radii[ring] * normal, normal);
    }
  }
  for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
    for (std::uint32_t side = 0; side < sides; ++side) {
      const std::uint32_t low = ring * (sides + 1) + side, high = low + sides + 1;
      out.indices.insert(out.indices.end(), {low, low + 1, high + 1, low, high + 1, high});
    }
  }
  for (const bool is_end : {false, true}) {
    const std::uint32_t ring = is_end ? (rings - 1) * (sides + 1) : 0;
    const vec3 normal = is_end ? glm::normalize(line[rings - 1] - line[rings - 2]) : glm::normalize(line[0] - line[1]);
    const auto first = static_cast<std::uint32_t>(out.positions.size());
    for (std::uint32_t side = 0; side < sides; ++side) add_vertex(out.positions[ring + side], normal);
    for (std::uint32_t side = 1; side + 1 < sides; ++side) {
      const std::uint32_t a = first + side, b = first + side + 1;
      out.indices.insert(out.indices.end(), {first, is_end ? a : b, is_end ? b : a});
    }
  }
  return out;
}

Primitive roof_shape(vec2 size_m, float height_m) {
  const float x = 0.5f * size_m.x, z = 0.5f * size_m.y;
  const vec3 left(-x, height_m, 0.0f), right(x, height_m, 0.0f);
  Primitive out;
  add_flat_triangle(out, {-x, 0, z}, {x, 0, z}, right);
  add_flat_triangle(out, {-x, 0, z}, right, left);
  add_flat_triangle(out, {x, 0, -z}, {-x, 0, -z}, left);
  add_flat_triangle(out, {x, 0, -z}, left, right);
  add_flat_triangle(out, {x, 0, z}, {x, 0, -z}, right);
  add_flat_triangle(out, {-x, 0, -z}, {-x, 0, z}, left);
  return out;
}

void Model::add(const Primitive& part, vec3 color, const mat4& pose) {
  const auto first = static_cast<std::uint32_t>(shape_.positions.size());
  const glm::mat3 turn = glm::inverseTranspose(glm::mat3(pose));
  const bool is_mirrored = glm::determinant(glm::mat3(pose)) < 0.0f;
  for (std::size_t i = 0; i < part.positions.size(); ++i) {
    shape_.positions.emplace_back(pose * vec4(part.positions[i], 1.0f));
    shape_.normals.push_back(glm::normalize(turn * part.normals[i]));
    shape_.colors.push_back(vec4(color, 1.0f) * (part.colors.empty() ? vec4(1.0f) : part.colors[i]));
    shape_.bounds.grow(shape_.positions.back());
  }
  for (std::size_t i = 0; i < part.indices.size(); i += 3) {
    const std::uint32_t a = part.indices[i], b = part.indices[i + 1], c = part.indices[i + 2];
    shape_.indices.insert(shape_.indices.end(),
                          {first + a, first + (is_mirrored ? c : b), first + (is_mirrored ? b : c)});
  }
}

void Model::add(const Primitive& part, vec3 color, vec3 offset_m) {
  add(part, color, glm::translate(mat4(1.0f), offset_m));
}

void Model::box(vec3 color, vec3 min, vec3 max) {
  add(box_shape(max - min), color, vec3(0.5f * (min.x + max.x), min.y, 0.5f * (min.z + max.z)));
}

void Model::tube(vec3 color, std::span<const vec3> line, std::span<const float> radii, std::uint32_t sides) {
  add(tube_shape(line, radii, sides), color);
}

void Model::ball(vec3 color, vec3 center, vec3 half_axes, std::uint32_t sides) {
  add(sphere_shape(1.0f, sides), color, glm::scale(glm::translate(mat4(1.0f), center), half_axes));
}

void Model::quad(vec3 color, vec3 a, vec3 b, vec3 c, vec3 d) {
  Primitive part;
  add_flat_triangle(part, a, b, c);
  add_flat_triangle(part, a, c, d);
  add(part, color);
}

float dusk_scatter(std::uint32_t a, std::uint32_t b) {
  std::uint32_t h = (a * 0x9e3779b1u) ^ ((b + 0x7f4a7c15u) * 0x85ebca6bu);
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 13)) * 0x297a2d39u;
  return static_cast<float>((h ^ (h >> 16)) & 0xffffu) / 65535.0f;
}

}  // namespace gloam

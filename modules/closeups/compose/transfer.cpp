// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/compose/transfer.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/core/assert.h"

namespace gloam {
namespace {

bool is_perspective(const ShadowFace& face) { return face.tan_half > 0.0f; }

/// A vector that depends linearly on a point of a face: x · point.x + y · point.y + constant.
struct PointVectors {
  dvec3 x;
  dvec3 y;
  dvec3 constant;
};

/// Perspective: the ray from the face's origin through the point, with a length of one metre along the axis.
/// Orthographic: the position of the point on the near side, relative to its centre.
PointVectors rays_of(const ShadowFace& face) {
  const double half = is_perspective(face) ? face.tan_half : face.half_extent_m;
  const dvec3 right = dvec3(face.right) * half, up = dvec3(face.up) * half;
  const dvec3 ahead = is_perspective(face) ? dvec3(face.forward) : dvec3(0.0);
  const double texel = 2.0 / face.square.size;
  return {right * texel, up * -texel, ahead - right + up};
}

/// Row r with dot(r, (point, 1)) = dot(axis, vector of the point).
dvec3 row(const dvec3& axis, const PointVectors& vectors) {
  return {glm::dot(axis, vectors.x), glm::dot(axis, vectors.y), glm::dot(axis, vectors.constant)};
}

/// Rows that map a point of one face to a homogeneous point of another.
struct PlaceRows {
  dvec3 u;
  dvec3 v;
  dvec3 w;
};

PlaceRows place_rows(const ShadowFace& of, const ShadowFace& in) {
  PointVectors rays = rays_of(of);
  const bool perspective = is_perspective(in);
  if (!perspective) {
    // The offset along the light has no effect; removing it keeps the numbers small.
    const dvec3 apart = of.origin - in.origin, forward(of.forward);
    rays.constant += apart - forward * glm::dot(forward, apart);
  }
  const double side = in.square.size, half = perspective ? in.tan_half : in.half_extent_m;
  const dvec3 w = perspective ? row(dvec3(in.forward), rays) : dvec3(0.0, 0.0, 1.0);
  return {(w + row(dvec3(in.right), rays) / half) * (0.5 * side), (w - row(dvec3(in.up), rays) / half) * (0.5 * side),
          w};
}

void set_depths(const ShadowFace& from, const ShadowFace& to, shaders::CloseupTransfer& made) {
  if (is_perspective(from)) {
    // Depth is near / distance along the axis. depth_w gives the distance along `to`'s axis per metre along `from`'s
    // axis.
    made.depth_scale = to.near_m / from.near_m;
    return;
  }
  const dvec3 along = row(dvec3(to.forward), rays_of(from));
  const double forward = glm::dot(dvec3(to.forward), dvec3(from.forward)), far = to.far_m;
  const double start = glm::dot(dvec3(to.forward), from.origin - to.origin) + forward * from.far_m;
  made.depth_row = vec3((dvec3(0.0, 0.0, far - start) - along) / far);
  made.depth_scale = static_cast<float>(forward * from.far_m / far);
}

}  // namespace

std::uint32_t transfer_level(vec2 texels, std::uint32_t size) {
  const float smaller = std::ceil(std::min(texels.x, texels.y) - 1.0f / 64.0f);
  const auto whole = static_cast<std::uint32_t>(std::clamp(smaller, 1.0f, static_cast<float>(size)));
  return whole <= 2 ? 0 : static_cast<std::uint32_t>(std::bit_width(whole - 1)) - 1;
}

shaders::CloseupTransfer transfer_constants(const ShadowFace& from, std::uint32_t map_size, const ShadowFace& to,
                                            const TexelRect& texels) {
  GLOAM_ASSERT(is_perspective(from) == is_perspective(to), "faces of one light are of one kind");
  shaders::CloseupTransfer made{};
  const PlaceRows there = place_rows(to, from), back = place_rows(from, to);
  made.row_u = vec3(there.u);
  made.row_v = vec3(there.v);
  made.row_w = vec3(there.w);
  made.back_u = vec3(back.u);
  made.back_v = vec3(back.v);
  made.depth_w = vec3(back.w);
  set_depths(from, to, made);
  made.begin = texels.begin;
  made.end = texels.end;
  made.origin = from.square.origin;
  made.size = from.square.size;
  made.map_size = map_size;
  made.target = to.square.origin;
  made.depth_bits = ~0u;
  made.orthographic = is_perspective(to) ? 0 : 1;
  return made;
}

}  // namespace gloam

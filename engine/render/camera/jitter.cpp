// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/camera/jitter.h"

#include "engine/math/frustum.h"
#include "engine/math/low_discrepancy.h"

namespace gloam {
namespace {

/// world: where the camera moves, in the world; zero if the projection is sheared instead.
dvec3 shift(mat4& clip_from_view, const mat4& view_from_relative, bool orthographic, const vec2& ndc) {
  if (!orthographic) {
    for (int column = 0; column < 4; ++column) {
      clip_from_view[column][0] += ndc.x * clip_from_view[column][3];
      clip_from_view[column][1] += ndc.y * clip_from_view[column][3];
    }
    return dvec3(0.0);
  }
  const dmat4 rows = glm::transpose(dmat4(view_from_relative));
  return -dvec3(rows[0]) * (static_cast<double>(ndc.x) / clip_from_view[0][0]) -
         dvec3(rows[1]) * (static_cast<double>(ndc.y) / clip_from_view[1][1]);
}

/// The camera-relative frustum of an unjittered view, wider by half a pixel at each side.
Frustum wider_frustum(const RenderView& view) {
  mat4 clip = view.clip_from_view;
  for (int column = 0; column < 4; ++column) {
    clip[column][0] /= 1.0f + 1.0f / static_cast<float>(view.width);
    clip[column][1] /= 1.0f + 1.0f / static_cast<float>(view.height);
  }
  return frustum_from_clip(clip * view.view_from_relative);
}

}  // namespace

vec2 jitter_point(std::uint64_t index) {
  const auto i = static_cast<std::uint32_t>(index % kJitterPoints);
  constexpr std::uint32_t kHalf = 1u << 31;  // scrambles the sequence so that it begins at the centre
  const auto centred = [](std::uint32_t x) { return static_cast<float>((x ^ kHalf) / 4294967296.0 - 0.5); };
  return {centred(reversed_bits(i)), centred(second_sobol(i))};
}

void apply_jitter(RenderView& view, const vec2& pixels) {
  view.unmoved = view.view_camera();
  view.frustum = wider_frustum(view);
  view.jittered = true;
  view.jitter = pixels;
  const vec2 ndc = vec2(-2.0f, 2.0f) * pixels / vec2(static_cast<float>(view.width), static_cast<float>(view.height));
  const dvec3 moved = shift(view.clip_from_view, view.view_from_relative, view.camera.orthographic, ndc);
  view.position += moved;
  view.clip_plane.w += static_cast<float>(glm::dot(dvec3(vec3(view.clip_plane)), moved));
  view.clip_from_relative = view.clip_from_view * view.view_from_relative;
  for (Plane& plane : view.frustum.planes) plane.distance += static_cast<float>(glm::dot(dvec3(plane.normal), moved));
  ViewCamera& previous = view.previous;
  previous.position += shift(previous.clip_from_view, previous.view_from_relative, previous.orthographic, ndc);
  previous.clip_from_relative = previous.clip_from_view * previous.view_from_relative;
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/debug/lines.h"

#include <algorithm>
#include <array>
#include <optional>

namespace gloam {
namespace {

/// Camera-relative corners: four of the near side in cyclic order, then four of the far side.
std::array<dvec3, 8> corners_of(const ShadowFace& face, const dvec3& camera) {
  std::array<dvec3, 8> corners;
  for (int i = 0; i < 8; ++i) {
    const double along = i < 4 ? face.near_m : face.far_m;
    const double half = face.tan_half > 0.0f ? along * face.tan_half : static_cast<double>(face.half_extent_m);
    const double x = i % 4 == 1 || i % 4 == 2 ? half : -half;
    const double y = i % 4 >= 2 ? half : -half;
    corners[static_cast<std::size_t>(i)] =
        face.origin - camera + dvec3(face.right) * x + dvec3(face.up) * y + dvec3(face.forward) * along;
  }
  return corners;
}

/// Part of a line, as shares of its length.
struct Part {
  double begin = 0.0;
  double end = 1.0;
  /// Keeps the part in which a value that is linear along the line is not negative.
  void keep(double at_begin, double at_end) {
    if (at_begin < 0.0 && at_end < 0.0) end = begin - 1.0;
    if ((at_begin < 0.0) == (at_end < 0.0)) return;
    const double crossed = at_begin / (at_begin - at_end);
    if (at_begin < 0.0)
      begin = std::max(begin, crossed);
    else
      end = std::min(end, crossed);
  }
  [[nodiscard]] bool empty() const { return !(begin < end); }
};

/// Position in pixels, and depth.
dvec3 on_picture(const dvec4& clip, const RenderView& view) {
  return {(0.5 + 0.5 * clip.x / clip.w) * view.width, (0.5 - 0.5 * clip.y / clip.w) * view.height, clip.z / clip.w};
}

std::optional<shaders::CloseupLine> line_between(const dvec4& from, const dvec4& to, const RenderView& view,
                                                 double rim_pixels) {
  Part ahead;
  ahead.keep(from.w - from.z, to.w - to.z);
  if (ahead.empty()) return std::nullopt;
  const dvec3 a = on_picture(glm::mix(from, to, ahead.begin), view);
  const dvec3 b = on_picture(glm::mix(from, to, ahead.end), view);
  Part inside;
  inside.keep(a.x + rim_pixels, b.x + rim_pixels);
  inside.keep(a.y + rim_pixels, b.y + rim_pixels);
  inside.keep(view.width + rim_pixels - a.x, view.width + rim_pixels - b.x);
  inside.keep(view.height + rim_pixels - a.y, view.height + rim_pixels - b.y);
  if (inside.empty()) return std::nullopt;
  const vec3 begin(glm::mix(a, b, inside.begin)), end(glm::mix(a, b, inside.end));
  return shaders::CloseupLine{vec2(begin), vec2(end), begin.z, end.z};
}

}  // namespace

std::vector<shaders::CloseupLine> frustum_lines(const ShadowFace& face, const RenderView& view, double rim_pixels) {
  const dmat4 clip_from_relative(view.clip_from_relative);
  std::array<dvec4, 8> clip;
  const std::array<dvec3, 8> corners = corners_of(face, view.position);
  for (std::size_t i = 0; i < 8; ++i) clip[i] = clip_from_relative * dvec4(corners[i], 1.0);
  std::vector<shaders::CloseupLine> lines;
  const auto add = [&](std::size_t a, std::size_t b) {
    if (const auto line = line_between(clip[a], clip[b], view, rim_pixels)) lines.push_back(*line);
  };
  for (std::size_t i = 0; i < 4; ++i) {
    add(i, (i + 1) % 4);
    add(4 + i, 4 + (i + 1) % 4);
    add(i, 4 + i);
  }
  return lines;
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/modules/shadows/support/final_lists/classify_oracle.h"

#include <algorithm>
#include <cmath>

namespace gloam::test {
namespace {

double greatest(const glm::dvec2& v) { return std::max(std::abs(v.x), std::abs(v.y)); }

}  // namespace

ClassifyOracle::ClassifyOracle(const ClassifyLight& light, std::uint32_t face_size, double bias_m)
    : light_(light), size_(face_size), bias_m_(bias_m) {}

bool ClassifyOracle::is_asked(const ClassifyPixel& pixel) const {
  const dvec3 to_light = orthographic() ? -light_.vector : light_.vector - pixel.position;
  return glm::dot(pixel.shading_normal, glm::normalize(to_light)) > 1e-3;
}

ClassifyOracle::Place ClassifyOracle::place(int face, const dvec3& point) const {
  const FacePose& pose = light_.faces[static_cast<std::size_t>(face)].pose;
  const dvec3 v = point - pose.origin;
  const double z = glm::dot(v, pose.forward);
  const double half = orthographic() ? pose.half_extent_m : pose.tan_half * z;
  const glm::dvec2 ndc = glm::dvec2(glm::dot(v, pose.right), -glm::dot(v, pose.up)) / half;
  return {(ndc + 1.0) * (0.5 * size_), z, orthographic() ? 1.0 - z / pose.depth_m : pose.near_m / z};
}

/// The middle of a texel.
glm::dvec2 ClassifyOracle::offset_of(std::size_t texel) const {
  const auto row = static_cast<std::size_t>(size_);
  return glm::dvec2(static_cast<double>(texel % row), static_cast<double>(texel / row)) + 0.5;
}

dvec3 ClassifyOracle::point_of(int face, std::size_t texel, double depth) const {
  const FacePose& pose = light_.faces[static_cast<std::size_t>(face)].pose;
  const glm::dvec2 ndc = offset_of(texel) * (2.0 / size_) - 1.0;
  const dvec3 aside = pose.right * ndc.x - pose.up * ndc.y;
  if (orthographic()) return pose.origin + aside * pose.half_extent_m + pose.forward * ((1.0 - depth) * pose.depth_m);
  return pose.origin + (aside * pose.tan_half + pose.forward) * (pose.near_m / depth);
}

/// Depth, at a place of the face, of the plane through the pixel.
double ClassifyOracle::plane_depth(int face, const glm::dvec2& at, const ClassifyPixel& pixel) const {
  const FacePose& pose = light_.faces[static_cast<std::size_t>(face)].pose;
  const glm::dvec2 ndc = at * (2.0 / size_) - 1.0;
  const dvec3 aside = pose.right * ndc.x - pose.up * ndc.y;
  if (!orthographic())
    return pose.near_m * glm::dot(pixel.face_normal, aside * pose.tan_half + pose.forward) /
           glm::dot(pixel.face_normal, pixel.position - pose.origin);
  const dvec3 from = pose.origin + aside * pose.half_extent_m;
  const double z = glm::dot(pixel.face_normal, pixel.position - from) / glm::dot(pixel.face_normal, pose.forward);
  return 1.0 - z / pose.depth_m;
}

void ClassifyOracle::set_bias(Receiver& r, const ClassifyPixel& pixel, double bias_depth) const {
  const double here = plane_depth(r.face, r.at, pixel);
  const double slope = std::abs(plane_depth(r.face, r.at + glm::dvec2(1.0, 0.0), pixel) - here) +
                       std::abs(plane_depth(r.face, r.at + glm::dvec2(0.0, 1.0), pixel) - here);
  r.bias = bias_m_ * (pixel.subsurface ? 4.0 : 1.0) * bias_depth * 1.001 + slope / 32.0 + 2e-6 * r.depth + 1e-7;
}

ClassifyOracle::Receiver ClassifyOracle::receive(const ClassifyPixel& pixel) const {
  Receiver r;
  const dvec3 from_light = pixel.position - light_.vector;
  if (orthographic()) {
    r.facing_sine = glm::dot(pixel.face_normal, light_.vector);
    r.emitter_sine = 0.5 * light_.width;
    for (int face = 0; face < 2; ++face) {
      const Place p = place(face, pixel.position);
      const double inside = 0.5 * size_ - light_.rim - greatest(p.at - 0.5 * size_);
      const double least = std::min(inside, (1.0 - p.depth) * 100.0);
      r.certain = r.certain && std::abs(least) > 1e-2;
      if (!r.certain) return r;
      if (least < 0.0) continue;
      r.face = face;
      r.at = p.at;
      r.depth = p.depth;
      // 2 mm in a map with texels of 1 cm.
      const auto& map = light_.faces[static_cast<std::size_t>(face)].pose;
      set_bias(r, pixel, 2.0 * map.half_extent_m / size_ / 0.01 / map.depth_m);
      return r;
    }
    return r;
  }
  int own = 0;
  for (int face = 0; face < static_cast<int>(light_.faces.size()); ++face)
    if (glm::dot(from_light, light_.faces[static_cast<std::size_t>(face)].pose.forward) >
        glm::dot(from_light, light_.faces[static_cast<std::size_t>(own)].pose.forward))
      own = face;
  const FacePose& pose = light_.faces[static_cast<std::size_t>(own)].pose;
  const Place p = place(own, pixel.position);
  const double distance = glm::length(from_light);
  r.facing_sine = glm::dot(pixel.face_normal, from_light) / distance;
  r.emitter_sine = 0.5 * light_.width / distance;
  const double beyond = greatest(p.at * (2.0 / size_) - 1.0) * pose.tan_half / light_.tan_inner;
  const bool cube = light_.kind == CastKind::cube;
  r.certain = std::abs(p.z - pose.near_m) > 1e-3 * pose.near_m && (cube || p.z < 0.0 || std::abs(beyond - 1.0) > 1e-3);
  if (!r.certain || p.z < pose.near_m || (!cube && beyond > 1.0)) return r;
  r.face = own;
  r.at = p.at;
  r.depth = p.depth;
  set_bias(r, pixel, p.depth / 5.0);  // 2 mm at 5 m
  return r;
}

std::size_t ClassifyOracle::texel_of(const ClassifyPixel& pixel) const {
  const glm::dvec2 cell = glm::floor(receive(pixel).at);
  return static_cast<std::size_t>(cell.y * size_ + cell.x);
}

double ClassifyOracle::to_border(const ClassifyPixel& pixel) const {
  const Receiver r = receive(pixel);
  return 0.5 * size_ - greatest(r.at - 0.5 * size_);
}

/// Whether the line from the pixel through the point meets the emitter. Of the ball of a cube's emitter, which the
/// filter replaces by a square, only the inner part counts.
bool ClassifyOracle::hides_emitter(const ClassifyPixel& pixel, const Receiver& r, const dvec3& point) const {
  const dvec3 along = point - pixel.position;
  if (orthographic()) {
    const double rise = -glm::dot(along, light_.vector);
    return glm::length(along + light_.vector * rise) < 0.49 * light_.width * rise;
  }
  const dvec3 to_light = light_.vector - pixel.position;
  if (light_.kind == CastKind::cube)
    return glm::length(glm::cross(to_light, glm::normalize(along))) < 0.3 * light_.width;
  const dvec3& forward = light_.faces[static_cast<std::size_t>(r.face)].pose.forward;
  const double turns = glm::dot(to_light, forward) / glm::dot(along, forward);
  return turns > 0.0 && glm::length(along * turns - to_light) < 0.49 * light_.width;
}

bool ClassifyOracle::blocks(const ClassifyPixel& pixel, const Receiver& r, int face, std::size_t texel) const {
  const double depth = static_cast<double>(light_.faces[static_cast<std::size_t>(face)].depths[texel]);
  if (depth <= 0.0) return false;
  const glm::dvec2 at = offset_of(texel);
  const double above = depth - plane_depth(face, at, pixel);
  if (above <= 0.0) return false;
  const bool cube = light_.kind == CastKind::cube;
  // Beyond this, a direction belongs to another face.
  if (cube && greatest(at * (2.0 / size_) - 1.0) * light_.faces[0].pose.tan_half > 1.0) return false;
  const dvec3 point = point_of(face, texel, depth);
  const Place own = face == r.face ? Place{at, 0.0, depth} : place(r.face, point);
  if (face != r.face && own.z < 0.4 * glm::length(point - light_.vector)) return false;
  // A depth of another face is converted into the pixel's own face.
  if (above * (own.depth / depth) <= r.bias || own.depth <= r.depth + r.bias) return false;
  if (greatest(own.at - r.at) > 0.4 * size_) return false;
  return (face == r.face && greatest(at - r.at) < 0.49) || hides_emitter(pixel, r, point);
}

/// Whether the texels around this one block as well. At borders of faces, the filter may read the same surface from
/// another face, whose texels are elsewhere.
bool ClassifyOracle::neighbours_block(const ClassifyPixel& pixel, const Receiver& r, int face,
                                      std::size_t texel) const {
  const auto row = static_cast<int>(size_);
  const int x = static_cast<int>(texel) % row, y = static_cast<int>(texel) / row;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      if (x + dx < 0 || y + dy < 0 || x + dx >= row || y + dy >= row) return false;
      if (!blocks(pixel, r, face, static_cast<std::size_t>((y + dy) * row + x + dx))) return false;
    }
  return true;
}

bool ClassifyOracle::is_partly_hidden(const ClassifyPixel& pixel) const {
  const Receiver r = receive(pixel);
  if (r.face < 0) return false;
  if (!pixel.subsurface && r.facing_sine > -r.emitter_sine + 1e-3) return true;
  const std::size_t texels = light_.faces[0].depths.size();
  for (int face = 0; face < static_cast<int>(light_.faces.size()); ++face) {
    if (orthographic() && face != r.face) continue;
    for (std::size_t texel = 0; texel < texels; ++texel)
      if (blocks(pixel, r, face, texel) && (face == r.face || neighbours_block(pixel, r, face, texel))) return true;
  }
  return false;
}

bool ClassifyOracle::is_partly_visible(const ClassifyPixel& pixel) const {
  const Receiver r = receive(pixel);
  if (!r.certain) return false;
  if (r.face < 0) return true;
  if (!pixel.subsurface && r.facing_sine > r.emitter_sine - 1e-3) return false;
  const ClassifyFace& face = light_.faces[static_cast<std::size_t>(r.face)];
  const double texel_m = 2.0 * face.pose.half_extent_m / size_, tangent = 2.0 * face.pose.tan_half / size_;
  // Radius of the penumbra of a blocker, in texels per depth.
  const double radius =
      0.5 * light_.width * (orthographic() ? face.pose.depth_m / texel_m : 1.0 / (face.pose.near_m * tangent));
  struct Near {
    double off;
    double depth;
    bool blocks;
  };
  std::vector<Near> near;
  for (std::size_t texel = 0; texel < face.depths.size(); ++texel) {
    const glm::dvec2 at = offset_of(texel);
    const double depth = static_cast<double>(face.depths[texel]);
    if (greatest(at - r.at) > 0.4 * size_) continue;
    const bool blocks = depth > 0.0 && depth > plane_depth(r.face, at, pixel) - r.bias;
    if (!blocks && greatest(at - r.at) < 0.49) return true;
    near.push_back({glm::length(at - r.at), depth, blocks});
  }
  std::sort(near.begin(), near.end(), [](const Near& a, const Near& b) { return a.off < b.off; });
  // The kernel is at least as wide as the penumbra of the farthest surface in it.
  double least = 1.0;
  for (const Near& texel : near) {
    if (texel.off + 0.75 > radius * (least - r.depth)) return false;
    if (!texel.blocks) return true;
    least = std::min(least, texel.depth);
  }
  return false;
}

}  // namespace gloam::test

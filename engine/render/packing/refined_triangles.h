// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Very large triangles near a camera. A vertex is a float relative to the camera: 1,000 km away it is rounded to 6 cm,
// and clipping at the near plane moves the part of its triangle that is seen by as much. So such triangles are split,
// in double precision, until each is at most a few times as long as it is away.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/math/types.h"
#include "engine/scene/assets.h"

namespace gloam {

/// A triangle that is longer than this many times its distance from a camera must be split: its rounding would be
/// 1/32 of a pixel of 1 mrad. Split triangles are at most 1/kSplitShare of that.
inline constexpr double kTooLong = 1024.0;
inline constexpr double kSplitShare = 16.0;
/// The same for a device with these bits of subpixels (gpu::DeviceInfo). With fewer than 8, corners are moved by more
/// when they are drawn, and the depths of a triangle that reaches out of the picture err in all of its pixels. With 4
/// bits SwiftShader's err by up to 0.3 % in triangles that are 80 times as long as they are away, 0.2 % at 40 times,
/// and 0.07 % from 2 to 20 times, at 320x180.
[[nodiscard]] constexpr double too_long_for(std::uint32_t subpixel_bits) {
  return kTooLong / static_cast<double>(1u << (3u * (8u - std::clamp(subpixel_bits, 4u, 8u)) / 2u));
}
/// Most triangles that splitting adds to a primitive.
inline constexpr std::size_t kMostAddedTriangles = 1 << 16;

/// The longest edge of the triangles, in units of the mesh.
[[nodiscard]] double longest_edge(const Primitive& primitive);

/// Distance from a point to a triangle.
[[nodiscard]] double distance_to_triangle(const dvec3& point, const dvec3& a, const dvec3& b, const dvec3& c);

/// Where a primitive is seen from.
struct SeenFrom {
  dmat4 world_from_mesh = dmat4(1.0);
  std::span<const dvec3> eyes;  ///< world; at least one
  double nearest = 0.0;         ///< nothing nearer to an eye is drawn; > 0
  double too_long = kTooLong;   ///< too_long_for() the device
};

/// The least distance of a triangle from an eye, less its length / too_long. Below 0: it must be split. Otherwise none
/// must be until an eye has moved by more than that.
[[nodiscard]] double split_slack(const Primitive& primitive, const SeenFrom& seen);

/// The same surface in smaller triangles, without cracks between them: triangles that are too long, and neighbours
/// whose edges they share. All others stay as they are. Positions are relative to `origin`, a point of the mesh. Rigid
/// primitives only.
[[nodiscard]] Primitive refined_triangles(const Primitive& source, const SeenFrom& seen, const dvec3& origin);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

#include "engine/render/renderer.h"
#include "little_world.h"

// The boxes of the little world as a host's own renderer would draw them, by rays, and the comparison of pictures.

namespace host {

using Bytes = std::vector<std::uint8_t>;

/// The first surface along a ray. distance: infinite if there is none.
struct Hit {
  double distance = std::numeric_limits<double>::infinity();
  gloam::dvec3 normal = gloam::dvec3(0.0);
  const LittleBox* box = nullptr;
};

inline Hit trace(const gloam::dvec3& origin, const gloam::dvec3& direction) {
  Hit hit;
  for (const LittleBox& box : kLittleBoxes) {
    double enter = 0.0, leave = std::numeric_limits<double>::infinity();
    int axis_of_entry = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double half = static_cast<double>(box.half_m[axis]);
      double near = (box.position[axis] - half - origin[axis]) / direction[axis];
      double far = (box.position[axis] + half - origin[axis]) / direction[axis];
      if (near > far) std::swap(near, far);
      if (near > enter) axis_of_entry = axis;
      enter = std::max(enter, near);
      leave = std::min(leave, far);
    }
    if (!(enter < leave) || enter <= 0.0 || enter >= hit.distance) continue;
    hit = {enter, gloam::dvec3(0.0), &box};
    hit.normal[axis_of_entry] = direction[axis_of_entry] > 0.0 ? -1.0 : 1.0;
  }
  return hit;
}

/// Calls take(hit) for the ray through each pixel, rows from the top. The camera only has a position; its view depth at
/// a hit is the distance itself.
template <class Take>
void for_each_pixel(std::uint32_t width, std::uint32_t height, const gloam::ViewSettings& view, Take&& take) {
  const double half_height = std::tan(0.5 * static_cast<double>(view.camera.fov_y));
  const double half_width = half_height * width / height;
  const gloam::dvec3 origin(view.world_from_camera[3]);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x)
      take(trace(origin, gloam::dvec3(half_width * (2.0 * (x + 0.5) / width - 1.0),
                                      half_height * (1.0 - 2.0 * (y + 0.5) / height), -1.0)));
}

template <class T>
void append(Bytes& bytes, const T& value) {
  const auto* begin = reinterpret_cast<const std::uint8_t*>(&value);
  bytes.insert(bytes.end(), begin, begin + sizeof(value));
}

inline std::uint32_t unorm(double value, int bits) {
  return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0, 1.0) * ((1 << bits) - 1)));
}

/// Mean difference of a channel, and the share of pixels with a difference above 8 of 255.
struct Difference {
  double mean = 0.0;
  double share = 0.0;
};

inline Difference difference(const Bytes& a, const Bytes& b) {
  Difference d;
  for (std::size_t i = 0; i < a.size(); i += 4) {
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const int step = std::abs(int{a[i + c]} - int{b[i + c]});
      d.mean += step;
      most = std::max(most, step);
    }
    d.share += most > 8 ? 1.0 : 0.0;
  }
  d.mean /= 0.75 * static_cast<double>(a.size());
  d.share /= 0.25 * static_cast<double>(a.size());
  return d;
}

}  // namespace host

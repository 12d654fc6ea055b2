// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sandbox/session/session.h"
#include "tests/support/gpu_device.h"

namespace gloam::test {

/// One frame of a scene on this device, `height` rows of 16 : 9. assignments: KNOB=VALUE. Fails the test on an error or
/// a validation message.
[[nodiscard]] inline Picture draw_scene(std::shared_ptr<gpu::Device> device, const std::string& scene,
                                        const std::vector<std::string>& assignments, std::uint32_t height = 90) {
  if (device == nullptr) {
    ADD_FAILURE() << "no device";
    return {};
  }
  Options options;
  options.scene = scene;
  options.width = height * 16 / 9;
  options.height = height;
  options.assignments = assignments;
  auto session = open_session_on(std::move(device), options, gpu_log());
  if (!session) {
    ADD_FAILURE() << session.error().message;
    return {};
  }
  Session& s = **session;
  const ViewRequest request{s.view_settings(options.width, options.height, options.view), {}};
  auto sample = s.render_frame(request);
  EXPECT_TRUE(sample.ok()) << sample.error().message;
  auto picture = s.renderer->read_picture(request.settings.id);
  EXPECT_TRUE(picture.ok()) << picture.error().message;
  EXPECT_TRUE(s.check_validation().ok());
  return picture.ok() ? std::move(*picture) : Picture{};
}

/// Root mean square of the difference of encoded channels, 0…1. The pictures have one size.
[[nodiscard]] inline double root_mean_square(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = (static_cast<double>(a[i]) - static_cast<double>(b[i])) / 255.0;
    sum += difference * difference;
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// Share of a picture's pixels with a channel outside the range of the 3×3 pixels around its place in the other
/// picture, widened by `steps` of 255. An edge that falls on the other side of a pixel's centre is not counted; a
/// surface of another colour is. Both are RGBA of this size.
[[nodiscard]] inline double share_unlike_neighbours(std::span<const std::uint8_t> picture,
                                                    std::span<const std::uint8_t> other, int width, int height,
                                                    int steps) {
  const auto unlike = [&](int x, int y, int channel) {
    int low = 255;
    int high = 0;
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v) {
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u) {
        const int value = other[static_cast<std::size_t>((v * width + u) * 4 + channel)];
        low = std::min(low, value);
        high = std::max(high, value);
      }
    }
    const int value = picture[static_cast<std::size_t>((y * width + x) * 4 + channel)];
    return value < low - steps || value > high + steps;
  };
  int count = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) count += unlike(x, y, 0) || unlike(x, y, 1) || unlike(x, y, 2) ? 1 : 0;
  return static_cast<double>(count) / (static_cast<double>(width) * height);
}

/// The means of blocks of size × size pixels. Both sides of the picture are multiples of `size`.
[[nodiscard]] inline Picture reduced(const Picture& picture, std::uint32_t size) {
  Picture small;
  small.width = picture.width / size;
  small.height = picture.height / size;
  for (std::uint32_t y = 0; y < small.height; ++y)
    for (std::uint32_t i = 0; i < small.width * 4; ++i) {
      std::uint32_t sum = 0;
      for (std::uint32_t k = 0; k < size * size; ++k)
        sum += picture.rgba[((y * size + k / size) * picture.width + i / 4 * size + k % size) * 4 + i % 4];
      small.rgba.push_back(static_cast<std::uint8_t>((sum + size * size / 2) / (size * size)));
    }
  return small;
}

}  // namespace gloam::test

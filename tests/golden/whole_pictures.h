// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

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

/// One frame of a scene at 160×90 on this device. assignments: KNOB=VALUE. Fails the test on an error or a validation
/// message.
[[nodiscard]] inline Picture draw_scene(std::unique_ptr<gpu::Device> device, const std::string& scene,
                                        const std::vector<std::string>& assignments) {
  if (device == nullptr) {
    ADD_FAILURE() << "no device";
    return {};
  }
  Options options;
  options.scene = scene;
  options.width = 160;
  options.height = 90;
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

}  // namespace gloam::test

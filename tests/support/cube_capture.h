// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "engine/render/renderer.h"
#include "tests/support/gpu_device.h"

// Captures into the six faces of a small cube.

namespace gloam::test {

inline constexpr std::uint32_t kCubeSide = 32;

/// Settings of the six faces of a cube at `eye`, in the order of layers: +x, -x, +y, -y, +z, -z.
[[nodiscard]] inline std::array<ViewSettings, 6> cube_faces(const dvec3& eye) {
  std::array<ViewSettings, 6> faces;
  for (std::uint32_t i = 0; i < 6; ++i) {
    dvec3 forward(0.0);
    forward[static_cast<int>(i / 2)] = i % 2 == 0 ? 1.0 : -1.0;
    const dvec3 up = i / 2 == 1 ? dvec3(0.0, 0.0, 1.0) : dvec3(0.0, 1.0, 0.0);
    ViewSettings& face = faces[i];
    face.width = face.height = kCubeSide;
    face.camera.fov_y = std::numbers::pi_v<float> / 2.0f;
    face.world_from_camera = glm::inverse(glm::lookAt(dvec3(0.0), forward, up));
    face.world_from_camera[3] = dvec4(eye, 1.0);
    face.id = ViewId{100 + i};
  }
  return faces;
}

/// A cube of linear light that views can draw into.
[[nodiscard]] inline gpu::ImageHandle make_cube(gpu::Device& device, std::uint32_t mips) {
  gpu::ImageDesc desc;
  desc.name = "test cube";
  desc.module = "test";
  desc.format = gpu::Format::rgba16_float;
  desc.width = desc.height = kCubeSide;
  desc.layers = 6;
  desc.mips = mips;
  desc.shape = gpu::ImageShape::cube;
  desc.usage = gpu::ImageUsage::color_target | gpu::ImageUsage::sampled | gpu::ImageUsage::transfer_source;
  return value_of(device.create_image(desc));
}

/// Texels of one layer of mip 0, which the last frame left ready for transfer_read.
[[nodiscard]] inline std::vector<std::uint16_t> layer_of(gpu::Device& device, gpu::ImageHandle image,
                                                         std::uint32_t layer) {
  std::vector<std::uint16_t> texels(std::size_t{kCubeSide} * kCubeSide * 4);
  const auto buffer = value_of(device.create_buffer({.name = "test readback",
                                                     .module = "test",
                                                     .size = texels.size() * 2,
                                                     .usage = gpu::BufferUsage::transfer_target,
                                                     .memory = gpu::MemoryKind::readback}));
  run_frame(device, [&](gpu::CommandList& commands) { commands.copy_image_to_buffer(image, 0, layer, buffer, 0); });
  std::memcpy(texels.data(), device.mapped(buffer).data(), texels.size() * 2);
  device.destroy(buffer);
  return texels;
}

/// Requests that draw all faces of the cube and leave it ready for transfer_read.
[[nodiscard]] inline std::vector<ViewRequest> captures_of(const std::array<ViewSettings, 6>& faces,
                                                          gpu::ImageHandle cube) {
  std::vector<ViewRequest> requests;
  for (std::uint32_t i = 0; i < 6; ++i) {
    ViewRequest& request = requests.emplace_back();
    request.settings = faces[i];
    request.settings.purpose = ViewPurpose::capture;
    request.target.light = LightTarget{.image = cube, .layer = i, .after = gpu::Access::transfer_read};
  }
  return requests;
}

/// The value of a half-precision number that is finite.
[[nodiscard]] inline float float_of(std::uint16_t half) {
  const int exponent = half >> 10 & 31;
  const float mantissa = static_cast<float>(half & 1023) / 1024.0f;
  const float value = exponent == 0 ? std::ldexp(mantissa, -14) : std::ldexp(1.0f + mantissa, exponent - 15);
  return (half & 0x8000) != 0 ? -value : value;
}

}  // namespace gloam::test

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

#include "engine/frame/transfers/upload.h"
#include "engine/math/packing.h"
#include "engine/render/camera/view_constants.h"
#include "modules/particles/baked_light.h"
#include "shaders/lighting/indirect_shared.h"
#include "shaders/particles/shaders.h"
#include "tests/modules/particles/support/light_twin.h"
#include "tests/support/kernel.h"
#include "tests/support/render_scene.h"

namespace gloam::test {

/// The layouts of LightBlock and EnvironmentConstants, which belong to other modules.
struct LampRow {
  vec3 position;
  float inverse_range_squared;
  vec3 candela;
  float spot_scale;
  vec3 direction;
  float spot_offset;
};

/// Inputs of light.comp.
struct LightKernelScene {
  static constexpr float kMapSide = 5.0f;
  static constexpr vec3 kZenith = vec3(0.1f, 0.2f, 0.9f), kHorizon = vec3(0.5f, 0.4f, 0.3f),
                        kGround = vec3(0.05f, 0.1f, 0.02f);
  static constexpr std::size_t kDirectional = 16, kLocal = 1024;

  std::vector<shaders::ParticleEmitterRow> emitters;
  std::vector<shaders::Particle> particles;
  std::vector<std::uint32_t> order;
  std::vector<LampRow> lamps;
  std::optional<shaders::DiffuseProbe> probe;  ///< takes the place of sky and ground in its box

  void add_lamp(const vec3& at, const vec3& candela, float range_m) {
    lamps.push_back({at, 1.0f / (range_m * range_m), candela, 0.0f, vec3(0.0f, -1.0f, 0.0f), 1.0f});
  }
  [[nodiscard]] shaders::ParticleFrame frame() const {
    shaders::ParticleFrame frame{};
    frame.right = vec3(1.0f, 0.0f, 0.0f);
    frame.up = vec3(0.0f, 1.0f, 0.0f);
    frame.atlas_scale = vec3(1.0f / kMapSide);
    return frame;
  }
  /// Of a map: linear in the position, which is in texels.
  [[nodiscard]] static dvec4 flux_at(const dvec3& texel, int channel) {
    return {0.1 * texel.x - 0.2, 0.05 * texel.y, -0.1 * texel.z, 1.0 + 0.2 * texel.x + channel};
  }
  [[nodiscard]] static dvec4 visibility_at(const dvec3& texel) {
    return (dvec4(texel.x, texel.y, texel.z, texel.x) * 20.0 + 50.0) / 255.0;
  }

  /// The light at points of the sprites.
  [[nodiscard]] std::vector<uvec2> run(gpu::Device& device, std::uint32_t points, bool maps) const {
    gpu::SpecConstants constants = {{"kLitPoints", points}, {"kMaps", maps ? 1u : 0u}};
    if (probe) constants.set("kIndirect", 2u);
    Kernel kernel(device, shaders::particles::light_comp, constants);
    kernel.input(0, std::vector{view_constants(make_view(look_at(dvec3(0.0, 0.0, 5.0), dvec3(0.0), 64, 64), 0))});
    kernel.input(1, std::vector{frame()});
    kernel.input(2, emitters);
    kernel.input(3, particles);
    kernel.input(4, order);
    shaders::ParticleDraws draws{};
    draws.drawn = static_cast<std::uint32_t>(order.size());
    kernel.input(5, std::vector{draws});
    kernel.output(6, order.size() * points * sizeof(uvec2));
    std::vector<gpu::ImageHandle> images;
    for (int channel = 0; channel < 4; ++channel) {
      images.push_back(make_map(device, channel));
      kernel.sampled_image(static_cast<std::uint32_t>(7 + channel), images.back(), gpu::Filter::linear);
    }
    kernel.input(11, light_block());
    kernel.input(12, std::vector<vec4>{vec4(kZenith, 0.0f), vec4(kHorizon, 0.0f), vec4(kGround, 0.0f)});
    shaders::IndirectConstants indirect{};
    indirect.few_probes[0] = probe.value_or(shaders::DiffuseProbe{});
    kernel.input(21, std::vector{indirect});
    kernel.input(22, std::vector{shaders::DiffuseProbe{}});
    kernel.run(static_cast<std::uint32_t>((order.size() + 63) / 64));
    std::vector<uvec2> found = kernel.read<uvec2>(6);
    EXPECT_TRUE(device.wait_idle().ok());
    for (const gpu::ImageHandle image : images) device.destroy(image);
    return found;
  }

 private:
  [[nodiscard]] std::vector<float> light_block() const {
    std::vector<float> words(4 + 8 * kDirectional + 12 * kLocal, 0.0f);
    words[0] = std::bit_cast<float>(static_cast<std::uint32_t>(lamps.size()));
    std::memcpy(&words[4 + 8 * kDirectional], lamps.data(), lamps.size() * sizeof(LampRow));
    return words;
  }
  /// Red, green, blue, visibility.
  [[nodiscard]] static gpu::ImageHandle make_map(gpu::Device& device, int channel) {
    gpu::ImageDesc desc{.name = "map", .module = "test"};
    desc.format = channel < 3 ? gpu::Format::rgba16_float : gpu::Format::rgba8_unorm;
    desc.width = desc.height = desc.depth = static_cast<std::uint32_t>(kMapSide);
    desc.shape = gpu::ImageShape::volume;
    desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::transfer_target;
    const gpu::ImageHandle image = value_of(device.create_image(desc));
    std::vector<std::byte> bytes;
    for (std::uint32_t z = 0; z < desc.depth; ++z)
      for (std::uint32_t y = 0; y < desc.height; ++y)
        for (std::uint32_t x = 0; x < desc.width; ++x) {
          const dvec3 texel = dvec3(x, y, z) + 0.5;
          for (int i = 0; i < 4; ++i) {
            if (channel < 3) {
              const std::uint16_t half = float_to_half(static_cast<float>(flux_at(texel, channel)[i]));
              bytes.push_back(static_cast<std::byte>(half & 0xFFu));
              bytes.push_back(static_cast<std::byte>(half >> 8));
            } else {
              bytes.push_back(static_cast<std::byte>(std::lround(visibility_at(texel)[i] * 255.0)));
            }
          }
        }
    Uploader uploader(device);
    uploader.image(image, std::move(bytes), gpu::Access::compute_read);
    EXPECT_TRUE(uploader.flush().ok());
    return image;
  }
};

}  // namespace gloam::test

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <vector>

#include "shaders/reflections_test/shaders.h"
#include "tests/modules/reflections/support/reflection_kernel.h"
#include "tests/support/render_scene.h"

namespace gloam::test {
namespace {

/// A reflection: colour and confidence, and the distance of the hit; none where nothing reflects.
struct TexelReflection {
  vec4 color = vec4(0.0f);
  double distance_m = 0.0;
  bool reflects = true;
};

class Upscale : public KernelTest {
 protected:
  void look_at_floor(std::uint32_t width = 64, std::uint32_t height = 48) {
    ViewSettings settings = look_at(unit * dvec3(0.0, 1.5, 4.0), dvec3(0.0), width, height);
    settings.camera.near_m *= static_cast<float>(unit);
    seen = look({}, settings);
  }
  /// reflection_of(texel): the reflection images' content.
  [[nodiscard]] std::vector<vec4> upscale(std::uint32_t scale,
                                          const std::function<TexelReflection(uvec2)>& reflection_of) {
    c = reflection_constants(seen.view, scale);
    c.unit_m = static_cast<float>(unit);
    std::vector<vec4> color;
    std::vector<ByteTexel> surface;
    std::vector<uvec2> mirrors;  // mirror_surface_api.glsl: depth; share, and the first pixel of the block
    for (std::uint32_t y = 0; y < c.size.y; ++y)
      for (std::uint32_t x = 0; x < c.size.x; ++x) {
        const TexelReflection r = reflection_of({x, y});
        color.push_back(r.color);
        mirrors.emplace_back(std::bit_cast<std::uint32_t>(seen.depth[seen.at(x * scale, y * scale)]), 255u);
        const auto cm = static_cast<std::uint32_t>(std::lround(100.0 * r.distance_m));
        surface.push_back({0, static_cast<std::uint8_t>(r.reflects ? 1 : 0), static_cast<std::uint8_t>(cm % 256),
                           static_cast<std::uint8_t>(cm / 256)});
      }
    Kernel kernel(device(), shaders::reflections_test::upscale_comp);
    kernel.input(0, std::vector{view_constants(seen.view)});
    kernel.input(1, std::vector{c});
    kernel.sampled_image(2, gpu::Format::rg32_uint, seen.view.width, seen.view.height, seen.normals);
    kernel.sampled_image(3, gpu::Format::r32_float, seen.view.width, seen.view.height, seen.depth);
    kernel.sampled_image(4, gpu::Format::rgba32_float, c.size.x, c.size.y, color);
    kernel.sampled_image(5, gpu::Format::rgba8_unorm, c.size.x, c.size.y, surface);
    kernel.sampled_image(7, gpu::Format::rg32_uint, c.size.x, c.size.y, mirrors);
    kernel.output(6, seen.depth.size() * sizeof(vec4));
    kernel.run((seen.view.width + 7) / 8, (seen.view.height + 7) / 8);
    return kernel.read<vec4>(6);
  }
  void tilt(const dvec3& normal) {
    for (std::size_t i = 0; i < seen.normals.size(); ++i)
      if (seen.object[i] == 0) seen.normals[i].x = pack_normal_snorm16(vec3(glm::normalize(normal)));
  }
  /// Where the pixel's ray, mirrored at this normal, meets a wall 3 m behind the middle of the floor. In metres.
  struct WallHit {
    dvec3 at = dvec3(0.0);
    double distance_m = 0.0;
  };
  [[nodiscard]] WallHit wall(uvec2 pixel, const dvec3& normal) const {
    const dvec3 from = (seen.position(pixel.x, pixel.y) + seen.view.position) / unit;
    const dvec3 ray = glm::reflect(glm::normalize(seen.ray(pixel.x, pixel.y).direction), glm::normalize(normal));
    const double along = (-3.0 - from.z) / ray.z;
    return {from + ray * along, along};
  }

  /// Compares what tilted normals show with rays to the wall.
  void expect_own_rays(const dvec3& normal) {
    look_at_floor(128, 96);
    tilt(normal);
    const std::vector<vec4> lights = upscale(1, [&](uvec2 t) {
      const WallHit hit = wall(t, dvec3(0.0, 1.0, 0.0));
      const bool floor = seen.object[seen.at(t.x, t.y)] == 0 && hit.distance_m > 0.0;
      return TexelReflection{vec4(hit.at.x + 10.0, hit.at.y, 0.0, 1.0), std::clamp(hit.distance_m, 0.0, 600.0), floor};
    });
    std::size_t compared = 0;
    double bent = 0.0, straight = 0.0;
    for (std::uint32_t y = 40; y < 88; ++y)
      for (std::uint32_t x = 16; x < 112; ++x) {
        if (seen.object[seen.at(x, y)] != 0) continue;
        const WallHit want = wall({x, y}, normal), flat = wall({x, y}, dvec3(0.0, 1.0, 0.0));
        if (want.distance_m <= 0.0 || want.at.y < 0.0 || flat.distance_m < 0.5) continue;
        const dvec2 got(lights[seen.at(x, y)].x - 10.0f, lights[seen.at(x, y)].y);
        bent += glm::length(got - dvec2(want.at));
        straight += glm::length(dvec2(flat.at) - dvec2(want.at));
        ++compared;
      }
    EXPECT_GT(compared, 1500u);
    EXPECT_LT(bent, 0.15 * straight) << normal.x << ", " << normal.z << ", a metre is " << unit;
  }

  double unit = 1.0;  ///< a metre in units of the scene
  SyntheticView seen;
  shaders::ReflectionConstants c{.unit_m = 1.0f};
};

TEST_F(Upscale, at_full_size_each_pixel_has_its_texel) {
  look_at_floor();
  const std::vector<vec4> lights = upscale(1, [](uvec2 t) {
    return TexelReflection{vec4(t.x, t.y, 5.0f, 0.5f + 0.5f * static_cast<float>(t.x % 2)), 1.0, (t.x + t.y) % 3 != 0};
  });
  for (std::uint32_t y = 0; y < 48; ++y)
    for (std::uint32_t x = 0; x < 64; ++x) {
      if (seen.object[seen.at(x, y)] != 0) continue;
      const vec4 light = lights[seen.at(x, y)];
      // A texel that does not reflect takes its neighbours', whose weights are small but the only ones.
      if ((x + y) % 3 == 0) continue;
      ASSERT_NEAR(light.x, static_cast<float>(x), 1e-2f);
      ASSERT_NEAR(light.y, static_cast<float>(y), 1e-2f);
    }
}

TEST_F(Upscale, is_bilinear_over_the_texels_that_reflect) {
  look_at_floor(61, 37);
  const auto reflects = [](uvec2 t) { return (t.x * 7 + t.y * 5) % 4 != 0; };
  const auto color = [](uvec2 t) { return vec4(t.x % 5, t.y % 7, (t.x + t.y) % 3, 1.0f); };
  const std::vector<vec4> lights = upscale(2, [&](uvec2 t) { return TexelReflection{color(t), 1.0, reflects(t)}; });
  int mixed = 0;
  for (std::uint32_t y = 0; y < 37; ++y)
    for (std::uint32_t x = 0; x < 61; ++x) {
      if (seen.object[seen.at(x, y)] != 0) continue;
      dvec4 sum(0.0);
      double total = 0.0;
      for (std::uint32_t i = 0; i < 4; ++i) {
        const uvec2 texel = glm::min(uvec2(x, y) / 2u + uvec2(i & 1u, i >> 1), c.size - 1u);
        const dvec2 part = dvec2(x % 2, y % 2) * 0.5;
        const double weight = ((i & 1u) != 0 ? part.x : 1.0 - part.x) * (i >> 1 != 0 ? part.y : 1.0 - part.y);
        if (!reflects(texel) || weight == 0.0) continue;
        sum += weight * dvec4(color(texel));
        total += weight;
      }
      if (total < 0.2) continue;
      ++mixed;
      ASSERT_LT(glm::length(dvec4(lights[seen.at(x, y)]) - sum / total), 0.02) << x << ", " << y;
    }
  EXPECT_GT(mixed, 500);
}

TEST_F(Upscale, where_nothing_reflects_there_is_no_confidence) {
  look_at_floor();
  for (const vec4& light : upscale(2, [](uvec2) { return TexelReflection{vec4(9.0f), 1.0, false}; }))
    ASSERT_EQ(light, vec4(0.0f));
}

TEST_F(Upscale, a_tilted_normal_shows_what_its_own_ray_meets) {
  for (const dvec3& normal :
       {dvec3(0.04, 1.0, 0.0), dvec3(-0.06, 1.0, 0.02), dvec3(0.0, 1.0, 0.05), dvec3(0.0, 1.0, -0.04)})
    expect_own_rays(normal);
}

TEST_F(Upscale, a_tilted_normal_shows_what_its_own_ray_meets_in_a_scene_of_any_size) {
  for (const double metre : {1e-7, 1e-3, 1e4}) {
    unit = metre;
    expect_own_rays({-0.06, 1.0, 0.02});
  }
}

TEST_F(Upscale, a_bend_onto_something_much_closer_is_reverted) {
  look_at_floor(128, 96);
  tilt({0.15, 1.0, 0.0});
  // Things 5 m away, and a thing at 1 m in every second stripe.
  const auto near = [](std::uint32_t x) { return x / 16 % 2 == 1; };
  const std::vector<vec4> lights = upscale(1, [&](uvec2 t) {
    return TexelReflection{near(t.x) ? vec4(0.0f, 1.0f, 0.0f, 1.0f) : vec4(1.0f, 0.0f, 0.0f, 1.0f),
                           near(t.x) ? 1.0 : 5.0};
  });
  std::size_t red = 0;
  for (std::uint32_t y = 48; y < 96; ++y)
    for (std::uint32_t x = 0; x < 128; ++x) {
      if (seen.object[seen.at(x, y)] != 0 || near(x)) continue;
      ASSERT_LT(lights[seen.at(x, y)].y, 0.9f) << x << ", " << y << ": the near thing lies over the far one";
      red += lights[seen.at(x, y)].x > 0.99f ? 1 : 0;
    }
  EXPECT_GT(red, 2000u);
}

TEST_F(Upscale, any_normal_gives_a_color_between_those_of_the_texels) {
  ProxyRandom random(61);
  look_at_floor(61, 37);
  for (std::size_t i = 0; i < seen.normals.size(); ++i)
    seen.normals[i].x = pack_normal_snorm16(vec3(random.direction()));
  for (const std::uint32_t scale : {1u, 2u})
    for (const vec4& light : upscale(scale, [&](uvec2 t) {
           return TexelReflection{vec4(static_cast<float>(t.x % 2)), static_cast<double>(t.y) * 10.0, t.x % 5 != 0};
         }))
      ASSERT_TRUE(light.x >= 0.0f && light.x <= 1.0f);
}

}  // namespace
}  // namespace gloam::test

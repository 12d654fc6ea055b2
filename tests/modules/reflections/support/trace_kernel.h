// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "shaders/reflections/shaders.h"
#include "tests/modules/reflections/support/ray_walk.h"
#include "tests/modules/reflections/support/reflection_kernel.h"
#include "tests/support/render_scene.h"

namespace gloam::test {

struct Traced {
  uvec2 size = uvec2(0u);
  std::vector<vec4> color;  ///< x, y: 1 + pixel of the hit; w: confidence
  std::vector<float> distance_m;
  [[nodiscard]] std::size_t hits() const {
    return static_cast<std::size_t>(std::ranges::count_if(color, [](const vec4& c) { return c.w > 0.5f; }));
  }
};

/// Base of tests that run the kernel of screen-space reflections.
class TraceKernelTest : public KernelTest {
 protected:
  [[nodiscard]] Traced trace(const SyntheticView& seen, const shaders::ReflectionConstants& c, bool hierarchical) {
    return trace(seen, c, hierarchical, numbered(seen));
  }
  /// A lit picture that says which pixel it is.
  [[nodiscard]] static std::vector<vec4> numbered(const SyntheticView& seen) {
    std::vector<vec4> lit;
    for (std::uint32_t y = 0; y < seen.view.height; ++y)
      for (std::uint32_t x = 0; x < seen.view.width; ++x) lit.emplace_back(x + 1, y + 1, 0.0f, 0.0f);
    return lit;
  }
  [[nodiscard]] Traced trace(const SyntheticView& seen, const shaders::ReflectionConstants& c, bool hierarchical,
                             const std::vector<vec4>& lit) {
    Kernel kernel(device(), shaders::reflections::screen_space_rays_comp, {{"kHierarchical", hierarchical ? 1u : 0u}});
    return run(kernel, seen, c, lit);
  }
  /// Runs screen_space_rays.comp or a kernel that includes it.
  [[nodiscard]] Traced run(Kernel& kernel, const SyntheticView& seen, const shaders::ReflectionConstants& c,
                           const std::vector<vec4>& lit) {
    const std::uint32_t w = seen.view.width, h = seen.view.height;
    const FlatLayers no_probes(device(), 1, 1, {vec4(0.0f)});
    kernel.input(0, std::vector{view_constants(seen.view)});
    kernel.input(1, std::vector{c});
    kernel.sampled_image(2, gpu::Format::rg32_uint, w, h, seen.normals);
    kernel.sampled_image(3, gpu::Format::rg32_uint, c.size.x, c.size.y, find_mirrors(device(), seen, c));
    kernel.sampled_image(4, gpu::Format::r32_float, w, h, seen.depth);
    kernel.sampled_image(5, gpu::Format::rg32_float, (w + 7) / 8, (h + 7) / 8, seen.depth_bounds());
    kernel.sampled_image(6, gpu::Format::rgba32_float, w, h, lit);
    kernel.output_image(7, gpu::Format::rgba16_float, c.size.x, c.size.y);
    kernel.output_image(8, gpu::Format::rgba8_unorm, c.size.x, c.size.y);
    kernel.sampled_image(14, gpu::Format::rgba8_unorm, w, h, std::vector<std::uint32_t>(seen.depth.size()));
    kernel.sampled_image(15, gpu::Format::rgba8_unorm, w, h, seen.material);
    kernel.sampled_image(16, gpu::Format::rgba32_float, w, h, std::vector<vec4>(seen.depth.size()));
    bind_no_surroundings(kernel, 17, no_probes);
    run_over_tiles(kernel, c, 9);
    Traced traced{c.size, from_half(kernel.read<HalfTexel>(7)), {}};
    for (const ByteTexel& t : kernel.read<ByteTexel>(8))
      traced.distance_m.push_back(static_cast<float>(t[0] + 256 * t[1]) / 100.0f);
    for (const vec4& color : traced.color)
      for (int i = 0; i < 4; ++i) EXPECT_TRUE(std::isfinite(color[i]) && color[i] >= 0.0f);
    for (const vec4& color : traced.color) EXPECT_LE(color.w, 1.0f);
    return traced;
  }
  [[nodiscard]] Traced trace(const SyntheticView& seen, std::uint32_t scale, bool hierarchical) {
    return trace(seen, reflection_constants(seen.view, scale), hierarchical);
  }

  /// Checks each confident hit: it lies on a visible surface that is no floor, where the ray passes behind it.
  static void expect_sound(const SyntheticView& seen, const shaders::ReflectionConstants& c, const Traced& traced,
                           const std::string& what) {
    std::size_t wrong = 0;
    for (std::uint32_t y = 0; y < c.size.y; ++y)
      for (std::uint32_t x = 0; x < c.size.x; ++x) {
        const std::size_t texel = std::size_t{y} * c.size.x + x;
        const vec4 color = traced.color[texel];
        if (color.w == 0.0f) continue;
        const uvec2 from = surface_pixel(seen, c.scale, {x, y}), to(uvec2(vec2(color)) - 1u);
        const std::size_t hit = seen.at(to.x, to.y);
        EXPECT_EQ(seen.object[seen.at(from.x, from.y)], 0) << what;
        const RayWalk walk(seen, c, from);
        const auto along_m = static_cast<double>(traced.distance_m[texel]);
        const dvec2 away = glm::abs(walk.on_screen(walk.at(along_m)) - dvec2(to) - 0.5);
        // The packed distance is rounded to centimetres, which may be pixels near the camera.
        const double rounding =
            glm::length(walk.on_screen(walk.at(along_m + 0.006)) - walk.on_screen(walk.at(along_m)));
        const double step = std::abs(walk.behind_m(along_m + 0.006, to) - walk.behind_m(along_m, to));
        const bool on_ray = std::max(away.x, away.y) <= 0.75 + rounding;
        const bool behind = walk.behind_m(along_m, to) < static_cast<double>(c.thickness_m) + step &&
                            walk.behind_m(along_m, to) > -0.05 - step;
        if (seen.object[hit] > 0 && on_ray && behind) continue;
        if (++wrong < 4)
          ADD_FAILURE() << what << ": texel " << x << ", " << y << " hits " << to.x << ", " << to.y << " (object "
                        << seen.object[hit] << ") after " << along_m << " m, away " << away.x << ", " << away.y
                        << ", behind " << walk.behind_m(along_m, to) << ", confidence " << color.w;
      }
    EXPECT_EQ(wrong, 0u) << what;
  }

  /// Texels whose ray must find a surface, and those of them where it does so at the right distance.
  struct Found {
    std::size_t expected = 0;
    std::size_t found = 0;
    std::size_t full = 0;  ///< with confidence near 1
  };
  /// Counts rays with a clear first passing: it faces the ray, is not near the borders, the reach or the camera's
  /// direction, and long enough that steps of two pixels meet it.
  static Found count_clear(const SyntheticView& seen, const shaders::ReflectionConstants& c, const Traced& traced) {
    Found count;
    const dvec2 size(seen.view.width, seen.view.height);
    for (std::uint32_t y = 0; y < c.size.y; ++y)
      for (std::uint32_t x = 0; x < c.size.x; ++x) {
        const uvec2 from = surface_pixel(seen, c.scale, {x, y});
        if (seen.object[seen.at(from.x, from.y)] != 0) continue;
        const RayWalk walk(seen, c, from);
        const std::vector<Passing> passings = walk.passings();
        if (passings.empty() || passings[0].behind_m > 0.3 * static_cast<double>(c.thickness_m)) continue;
        const Passing& first = passings[0];
        const dvec2 on = walk.on_screen(walk.at(first.along_m)), edge = glm::min(on, size - on) / size;
        const bool facing =
            glm::dot(dvec3(unpack_normal_snorm16(seen.normals[seen.at(first.pixel.x, first.pixel.y)].y)),
                     walk.direction()) < -0.2;
        const bool low = first.along_m * walk.direction().y < 0.6 * static_cast<double>(c.reach_m);
        const bool away = glm::dot(walk.direction(), glm::normalize(-seen.position(from.x, from.y))) < 0.25;
        if (!facing || !low || !away || std::min(edge.x, edge.y) < 0.12 || first.pixels < 2.5) continue;
        ++count.expected;
        const std::size_t texel = std::size_t{y} * c.size.x + x;
        // Half a step of the last bisection, and the rounding to centimetres.
        const double slack = 0.02 + 0.01 * first.along_m;
        const bool right = std::abs(static_cast<double>(traced.distance_m[texel]) - first.along_m) < slack;
        count.found += traced.color[texel].w > 0.0f && right ? 1 : 0;
        count.full += traced.color[texel].w > 0.95f && right ? 1 : 0;
      }
    return count;
  }

  [[nodiscard]] static SyntheticScene random_scene(ProxyRandom& random, int boxes) {
    SyntheticScene scene;
    for (int i = 0; i < boxes; ++i) {
      const dvec3 half(random.between(0.1, 0.8), random.between(0.1, 0.9), random.between(0.1, 0.8));
      const dvec3 center(random.between(-4.0, 4.0), half.y + (random.one_in(3) ? random.between(0.0, 0.5) : 0.0),
                         random.between(-8.0, 0.0));
      scene.boxes.push_back({center - half, center + half});
    }
    return scene;
  }
  [[nodiscard]] static ViewSettings random_camera(ProxyRandom& random, std::uint32_t width, std::uint32_t height) {
    return look_at({random.between(-2.0, 2.0), random.between(0.6, 2.2), random.between(3.0, 6.0)},
                   {random.between(-1.0, 1.0), random.between(0.0, 0.8), -3.0}, width, height);
  }
};

}  // namespace gloam::test

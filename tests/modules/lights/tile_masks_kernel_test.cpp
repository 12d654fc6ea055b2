// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <memory>
#include <random>

#include "engine/frame/upload.h"
#include "engine/render/view.h"
#include "engine/render/view_constants.h"
#include "modules/lights/light_list.h"
#include "modules/lights/outputs.h"
#include "shaders/lights/shaders.h"
#include "shaders/render/view_shared.h"
#include "tests/support/gpu_device.h"

namespace gloam {
namespace {

constexpr std::uint32_t kLayers = GLOAM_LIGHT_GROUPS + 1;
constexpr std::uint32_t kUntouched = 0xA5A5A5A5u;
constexpr std::uint32_t kTile = 8;

std::uint32_t tiles_across(std::uint32_t pixels) { return (pixels + kTile - 1) / kTile; }

/// A view, the depth of each of its pixels, and the lights.
struct Picture {
  RenderView view;
  std::vector<float> depth;  ///< reversed Z, 0: sky
  std::unique_ptr<VisibleLights> visible = std::make_unique<VisibleLights>();

  [[nodiscard]] std::uint32_t columns() const { return tiles_across(view.width); }
  [[nodiscard]] std::uint32_t rows() const { return tiles_across(view.height); }
  /// Farthest and nearest depth of a tile without sky, (1, 0) for sky alone.
  [[nodiscard]] vec2 bounds(std::uint32_t column, std::uint32_t row) const {
    vec2 found(1.0f, 0.0f);
    for_pixels(column, row, [&](std::uint32_t, std::uint32_t, float d) {
      if (d > 0.0f) found = vec2(std::min(found.x, d), std::max(found.y, d));
    });
    return found;
  }
  template <class F>
  void for_pixels(std::uint32_t column, std::uint32_t row, F&& function) const {
    for (std::uint32_t y = row * kTile; y < std::min((row + 1) * kTile, view.height); ++y)
      for (std::uint32_t x = column * kTile; x < std::min((column + 1) * kTile, view.width); ++x)
        function(x, y, depth[std::size_t{y} * view.width + x]);
  }
};

/// Camera-relative position of what lies at a depth under a point of the picture, in pixels.
dvec3 position_at(const RenderView& view, const dmat4& relative_from_clip, double x, double y, double depth) {
  const dvec4 p = relative_from_clip * dvec4(2.0 * x / view.width - 1.0, 1.0 - 2.0 * y / view.height, depth, 1.0);
  return dvec3(p) / p.w;
}

/// Surfaces at many distances, edges inside tiles, holes to the sky; tiles of nothing but sky.
std::vector<float> random_depth(const RenderView& view, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<float> depth(std::size_t{view.width} * view.height);
  const auto depth_of = [&](double metres) {
    const dvec4 p = dmat4(view.clip_from_view) * dvec4(0.0, 0.0, -metres, 1.0);
    return static_cast<float>(p.z / p.w);
  };
  for (std::uint32_t row = 0; row < tiles_across(view.height); ++row) {
    for (std::uint32_t column = 0; column < tiles_across(view.width); ++column) {
      const double near = 0.3 * std::pow(200.0, unit(random));
      const double far = near * (1.0 + (random() % 3 == 0 ? 4.0 : 0.1) * unit(random));
      const bool sky = random() % 6 == 0;
      const unsigned holes = random() % 4;
      for (std::uint32_t y = row * kTile; y < std::min((row + 1) * kTile, view.height); ++y) {
        for (std::uint32_t x = column * kTile; x < std::min((column + 1) * kTile, view.width); ++x) {
          const bool hole = sky || random() % 8 < holes;
          depth[std::size_t{y} * view.width + x] = hole ? 0.0f : depth_of(near + (far - near) * unit(random));
        }
      }
    }
  }
  return depth;
}

/// Points and spots of many sizes in front of the camera, some far away with a narrow cone on the scene.
std::vector<PlacedLight> random_lights(const RenderView& view, std::uint32_t count, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const dmat4 relative_from_clip = glm::inverse(dmat4(view.clip_from_relative));
  std::vector<PlacedLight> lights;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double metres = 0.5 * std::pow(100.0, 0.5 + 0.5 * unit(random));
    const dvec4 clip = dmat4(view.clip_from_view) * dvec4(0.0, 0.0, -metres, 1.0);
    const dvec3 seen = position_at(view, relative_from_clip, view.width * (0.5 + 0.6 * unit(random)),
                                   view.height * (0.5 + 0.6 * unit(random)), clip.z / clip.w);
    PlacedLight light;
    light.entity = {i, 1};
    light.light.intensity = 10.0f;
    light.light.range_m = static_cast<float>(0.05 * std::pow(100.0, 0.5 + 0.5 * unit(random)) * (1.0 + 0.1 * metres));
    light.position = view.position + seen;
    light.direction = glm::normalize(vec3(dvec3(unit(random), unit(random), unit(random) + 1e-3)));
    if (i % 2 == 1) {
      light.light.kind = LightKind::spot;
      const double half_angle[] = {0.01, 0.1, 0.4, 0.8, 1.2, 1.5707963};
      light.light.outer_angle = static_cast<float>(half_angle[random() % 6]);
      light.light.inner_angle = random() % 2 == 0 ? 0.0f : light.light.outer_angle;
    }
    if (i % 16 == 5) {
      const double away = std::pow(10.0, 2.0 + unit(random));
      light.position -= dvec3(light.direction) * away;
      light.light.range_m = static_cast<float>(away + 3.0);
      light.light.outer_angle = static_cast<float>(0.5 / away + 0.002);
    }
    lights.push_back(light);
  }
  return lights;
}

Picture random_picture(std::uint32_t width, std::uint32_t height, std::uint32_t lights, std::uint32_t seed,
                       bool orthographic = false) {
  std::mt19937 random(seed);
  ViewSettings settings;
  settings.width = width;
  settings.height = height;
  settings.camera.orthographic = orthographic;
  settings.camera.half_height_m = 8.0f;
  settings.world_from_camera = glm::rotate(glm::translate(dmat4(1.0), dvec3(seed * 100.0, 3.0, -7.0)), 0.4 * seed,
                                           glm::normalize(dvec3(0.3, 1.0, 0.2 * (seed % 3))));
  Picture picture;
  picture.view = make_view(settings, 0);
  picture.depth = random_depth(picture.view, random);
  select_lights(random_lights(picture.view, lights, random), picture.view, *picture.visible);
  return picture;
}

/// The kernel's answer: 33 words a tile, in the order of rows.
using Masks = std::vector<std::array<std::uint32_t, kLayers>>;

/// The device of all tests of this program.
gpu::Device* device() {
  static const std::unique_ptr<gpu::Device> made = test::make_test_device();
  return made.get();
}

Masks run_kernel(gpu::Device& gpu, const Picture& picture) {
  using gpu::Access;
  using enum gpu::ImageUsage;
  const std::uint32_t columns = picture.columns();
  const std::uint32_t rows = picture.rows();
  const auto view = test::make_upload(gpu, std::vector{view_constants(picture.view)});
  const auto lights = test::make_upload(gpu, std::span<const shaders::LightBlock>(&picture.visible->block, 1));
  const auto bounds = test::value_of(gpu.create_image({.name = "bounds",
                                                       .module = "test",
                                                       .format = gpu::Format::rg32_float,
                                                       .width = columns,
                                                       .height = rows,
                                                       .usage = transfer_target | sampled}));
  const auto masks = test::value_of(gpu.create_image({.name = "masks",
                                                      .module = "test",
                                                      .format = gpu::Format::r32_uint,
                                                      .width = columns,
                                                      .height = rows,
                                                      .layers = kLayers,
                                                      .usage = transfer_source | transfer_target | storage,
                                                      .shape = gpu::ImageShape::array}));
  const std::uint64_t layer_bytes = std::uint64_t{columns} * rows * sizeof(std::uint32_t);
  const auto back = test::make_readback(gpu, layer_bytes * kLayers);
  const auto sampler =
      test::value_of(gpu.create_sampler({.min_filter = gpu::Filter::nearest, .mag_filter = gpu::Filter::nearest}));
  const auto pipeline = test::value_of(
      gpu.create_pipeline(gpu::ComputePipelineDesc{"tile_masks", "test", shaders::lights::tile_masks_comp, {}}));

  std::vector<std::byte> texels(std::size_t{columns} * rows * sizeof(vec2));
  for (std::uint32_t i = 0; i < columns * rows; ++i) {
    const vec2 value = picture.bounds(i % columns, i / columns);
    std::memcpy(texels.data() + i * sizeof(vec2), &value, sizeof(vec2));
  }
  Uploader uploader(gpu);
  uploader.image(bounds, std::move(texels), Access::compute_read);
  EXPECT_TRUE(uploader.flush().ok());

  test::run_frame(gpu, [&](gpu::CommandList& commands) {
    const auto move = [&](Access before, Access after) {
      const gpu::ImageBarrier barrier{masks, before, after};
      commands.barrier({}, std::span(&barrier, 1));
    };
    move(Access::none, Access::transfer_write);
    commands.clear_color_image(masks, {kUntouched, 0, 0, 0});
    move(Access::transfer_write, Access::compute_write);
    commands.bind_pipeline(pipeline);
    const gpu::Binding bindings[] = {{0, gpu::Binding::BufferRange{view}},
                                     {1, gpu::Binding::BufferRange{lights}},
                                     {2, gpu::Binding::Sampled{{.image = bounds}, sampler}},
                                     {3, gpu::Binding::Storage{{.image = masks, .as_array = true}}}};
    commands.bind(bindings);
    commands.dispatch((columns + 7) / 8, (rows + 7) / 8, 1);
    move(Access::compute_write, Access::transfer_read);
    for (std::uint32_t layer = 0; layer < kLayers; ++layer)
      commands.copy_image_to_buffer(masks, 0, layer, back, layer * layer_bytes);
    const gpu::BufferBarrier done{back, Access::transfer_write, Access::host_read};
    commands.barrier(std::span(&done, 1), {});
  });
  const auto words = test::items_of<std::uint32_t>(gpu, back);
  Masks result(std::size_t{columns} * rows);
  for (std::uint32_t layer = 0; layer < kLayers; ++layer)
    for (std::size_t tile = 0; tile < result.size(); ++tile) result[tile][layer] = words[layer * result.size() + tile];
  for (const gpu::BufferHandle buffer : {view, lights, back}) gpu.destroy(buffer);
  for (const gpu::ImageHandle image : {bounds, masks}) gpu.destroy(image);
  gpu.destroy(pipeline);
  return result;
}

/// Whether shading gives the point any light, from the numbers it reads, in double precision.
bool is_lit(const shaders::LocalLight& light, const dvec3& point) {
  const dvec3 offset = dvec3(light.position) - point;
  const double d2 = glm::dot(offset, offset);
  if (d2 * static_cast<double>(light.inverse_range_squared) >= 1.0) return false;
  const double cosine = -glm::dot(offset, dvec3(light.direction)) / std::sqrt(std::max(d2, 1e-12));
  return cosine * static_cast<double>(light.spot_scale) + static_cast<double>(light.spot_offset) > 0.0;
}

/// The kernel's tests in double precision; `slack` moves every bound by that share, so that the kernel's own rounding lies between
/// a positive and a negative one.
struct Twin {
  const RenderView& view;
  const shaders::LightBlock& lights;
  double slack = 0.0;
  dmat4 relative_from_clip = dmat4(mat4(glm::inverse(dmat4(view.clip_from_relative))));

  struct Box {
    dvec3 center;
    dvec3 half;
  };
  [[nodiscard]] Box froxel(uvec2 first, uvec2 last, vec2 bounds) const {
    dvec3 low(1e30), high(-1e30);
    for (unsigned i = 0; i < 8; ++i) {
      const dvec3 p =
          position_at(view, relative_from_clip, (i & 1) != 0 ? last.x : first.x, (i & 2) != 0 ? last.y : first.y,
                      static_cast<double>((i & 4) != 0 ? bounds.y : bounds.x));
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    Box box{(low + high) * 0.5, (high - low) * 0.5};
    box.half += (1e-3 + slack) * (box.half + glm::abs(box.center)) + 1e-4 * (1.0 + 10.0 * slack);
    return box;
  }
  [[nodiscard]] bool touches(const shaders::LocalLight& light, const Box& box) const {
    const dvec3 v = box.center - dvec3(light.position);
    const dvec3 outside = glm::max(glm::abs(v) - box.half, dvec3(0.0));
    if (glm::dot(outside, outside) * static_cast<double>(light.inverse_range_squared) > 1.00001 + slack) return false;
    if (light.spot_scale == 0.0f) return true;
    const double cos_outer = -static_cast<double>(light.spot_offset) / static_cast<double>(light.spot_scale) - 1e-6;
    const double sin_outer = std::sqrt(std::max(1.0 - cos_outer * cos_outer, 0.0));
    const double radius = glm::length(box.half) + slack * glm::length(v);
    const double along = glm::dot(v, dvec3(light.direction));
    const double across = glm::length(glm::cross(v, dvec3(light.direction)));
    return cos_outer * across - along * sin_outer <= radius * 1.001 && along >= -radius - 1e-6 * across;
  }
};

struct Figures {
  std::uint64_t pairs = 0;  ///< tiles that are not sky × lights
  std::uint64_t listed = 0;
  std::uint64_t needed = 0;
  std::uint64_t missing = 0;  ///< lights that light a pixel of a tile that does not list them
};

/// Lights that light a pixel of the tile.
std::vector<bool> brute_force(const Picture& picture, const dmat4& relative_from_clip, std::uint32_t column,
                              std::uint32_t row) {
  const shaders::LightBlock& block = picture.visible->block;
  std::vector<bool> lit(block.local_count);
  picture.for_pixels(column, row, [&](std::uint32_t x, std::uint32_t y, float depth) {
    if (depth <= 0.0f) return;
    const dvec3 point = position_at(picture.view, relative_from_clip, x + 0.5, y + 0.5, static_cast<double>(depth));
    for (std::uint32_t i = 0; i < block.local_count; ++i)
      if (!lit[i] && is_lit(block.local[i], point)) lit[i] = true;
  });
  return lit;
}

Figures check_against_brute_force(const Picture& picture, const Masks& masks) {
  const dmat4 relative_from_clip = glm::inverse(dmat4(picture.view.clip_from_relative));
  Figures figures;
  for (std::uint32_t tile = 0; tile < masks.size(); ++tile) {
    const std::uint32_t column = tile % picture.columns();
    const std::uint32_t row = tile / picture.columns();
    const std::vector<std::uint32_t> listed = decode_tile_mask(masks[tile]);
    for (const std::uint32_t light : listed) EXPECT_LT(light, picture.visible->block.local_count);
    if (picture.bounds(column, row).y <= 0.0f) {
      EXPECT_EQ(masks[tile][GLOAM_LIGHT_GROUPS], 0u) << "a tile of sky has no lights";
      continue;
    }
    const std::vector<bool> lit = brute_force(picture, relative_from_clip, column, row);
    figures.pairs += lit.size();
    figures.listed += listed.size();
    for (std::uint32_t i = 0; i < lit.size(); ++i) {
      if (!lit[i]) continue;
      ++figures.needed;
      if (!std::binary_search(listed.begin(), listed.end(), i)) ++figures.missing;
    }
  }
  return figures;
}

void check_words(const Picture& picture, const Masks& masks) {
  for (const auto& words : masks) {
    const std::uint32_t groups = words[GLOAM_LIGHT_GROUPS];
    for (std::uint32_t word = 0; word < GLOAM_LIGHT_GROUPS; ++word) {
      if ((groups >> word & 1u) != 0) {
        ASSERT_NE(words[word], 0u) << "a group bit says that the word is not empty";
        ASSERT_LT(word * 32, picture.visible->block.local_count);
      } else {
        ASSERT_EQ(words[word], kUntouched) << "empty words are not written";
      }
    }
  }
}

/// Lights the twin lists in a tile: touched by the tile's box and by that of its tile group.
void check_against_twin(const Picture& picture, const Masks& masks) {
  const RenderView& view = picture.view;
  const uvec2 size(view.width, view.height);
  for (const double slack : {2e-5, -2e-5}) {
    const Twin twin{view, picture.visible->block, slack};
    for (std::uint32_t tile = 0; tile < masks.size(); ++tile) {
      const uvec2 at(tile % picture.columns(), tile / picture.columns());
      const vec2 bounds = picture.bounds(at.x, at.y);
      if (bounds.y <= 0.0f) continue;
      vec2 group_bounds(std::numeric_limits<float>::infinity(), 0.0f);
      const uvec2 group = at / 8u;
      for (std::uint32_t row = group.y * 8; row < std::min(group.y * 8 + 8, picture.rows()); ++row) {
        for (std::uint32_t column = group.x * 8; column < std::min(group.x * 8 + 8, picture.columns()); ++column) {
          const vec2 b = picture.bounds(column, row);
          if (b.y > 0.0f) group_bounds = vec2(std::min(group_bounds.x, b.x), std::max(group_bounds.y, b.y));
        }
      }
      const Twin::Box box = twin.froxel(at * kTile, glm::min(at * kTile + kTile, size), bounds);
      const Twin::Box group_box = twin.froxel(group * 64u, glm::min(group * 64u + 64u, size), group_bounds);
      const std::vector<std::uint32_t> listed = decode_tile_mask(masks[tile]);
      for (std::uint32_t i = 0; i < twin.lights.local_count; ++i) {
        const shaders::LocalLight& light = twin.lights.local[i];
        const bool expected = twin.touches(light, group_box) && twin.touches(light, box);
        const bool actual = std::binary_search(listed.begin(), listed.end(), i);
        if (slack > 0.0) {
          ASSERT_TRUE(expected || !actual) << "tile " << at.x << "," << at.y << " lists light " << i << " too many";
        } else {
          ASSERT_TRUE(actual || !expected) << "tile " << at.x << "," << at.y << " lacks light " << i;
        }
      }
    }
  }
}

struct TileMasks : ::testing::Test {
  void SetUp() override { GLOAM_REQUIRE_GPU(device()); }
  void TearDown() override {
    if (device() != nullptr) {
      EXPECT_EQ(device()->validation_messages(), 0u);
    }
  }
};

TEST_F(TileMasks, list_every_light_that_lights_a_pixel_of_the_tile) {
  Figures sum;
  std::uint32_t seed = 1;
  for (const uvec2 size : {uvec2(203, 117), uvec2(64, 64), uvec2(33, 31), uvec2(7, 5), uvec2(1, 1), uvec2(321, 9)}) {
    for (const bool orthographic : {false, true}) {
      const Picture picture = random_picture(size.x, size.y, 1200, seed++, orthographic);
      const Masks masks = run_kernel(*device(), picture);
      ASSERT_NO_FATAL_FAILURE(check_words(picture, masks));
      const Figures figures = check_against_brute_force(picture, masks);
      EXPECT_EQ(figures.missing, 0u) << size.x << "x" << size.y << " orthographic " << orthographic << ", of "
                                     << figures.needed;
      sum.pairs += figures.pairs;
      sum.listed += figures.listed;
      sum.needed += figures.needed;
    }
  }
  ASSERT_GT(sum.needed, 1000u) << "the scenes light too little to show anything";
  const double needless = static_cast<double>(sum.listed - sum.needed) / static_cast<double>(sum.pairs);
  std::printf("tile masks: %.2f %% of tile and light pairs listed, %.2f %% needed, %.2f %% needless\n",
              100.0 * static_cast<double>(sum.listed) / static_cast<double>(sum.pairs),
              100.0 * static_cast<double>(sum.needed) / static_cast<double>(sum.pairs), 100.0 * needless);
  EXPECT_LT(needless, 0.1) << "lists this loose would not be worth their time";
}

TEST_F(TileMasks, are_those_of_the_twin_but_for_rounding_at_the_bounds) {
  std::uint32_t seed = 40;
  for (const uvec2 size : {uvec2(203, 117), uvec2(33, 31), uvec2(7, 5)}) {
    for (const bool orthographic : {false, true}) {
      const Picture picture = random_picture(size.x, size.y, 1024, seed++, orthographic);
      ASSERT_NO_FATAL_FAILURE(check_against_twin(picture, run_kernel(*device(), picture)));
    }
  }
}

TEST_F(TileMasks, hold_any_number_of_lights) {
  for (const std::uint32_t count : {0u, 1u, 31u, 32u, 33u, 1023u, 1024u}) {
    Picture picture = random_picture(40, 24, 0, 3);
    // All in the camera: every one lights every pixel.
    std::vector<PlacedLight> lights(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      lights[i].entity = {i, 1};
      lights[i].position = picture.view.position;
      lights[i].light.range_m = 1000.0f;
    }
    select_lights(lights, picture.view, *picture.visible);
    ASSERT_EQ(picture.visible->block.local_count, count);
    const Masks masks = run_kernel(*device(), picture);
    ASSERT_NO_FATAL_FAILURE(check_words(picture, masks));
    for (std::uint32_t tile = 0; tile < masks.size(); ++tile) {
      const bool sky = picture.bounds(tile % picture.columns(), tile / picture.columns()).y <= 0.0f;
      EXPECT_EQ(decode_tile_mask(masks[tile]).size(), sky ? 0u : count);
    }
  }
}

TEST_F(TileMasks, of_a_picture_of_sky_are_empty) {
  Picture picture = random_picture(100, 70, 500, 4);
  std::fill(picture.depth.begin(), picture.depth.end(), 0.0f);
  for (const auto& words : run_kernel(*device(), picture)) {
    ASSERT_EQ(words[GLOAM_LIGHT_GROUPS], 0u);
    for (std::uint32_t word = 0; word < GLOAM_LIGHT_GROUPS; ++word) ASSERT_EQ(words[word], kUntouched);
  }
}

TEST_F(TileMasks, of_far_narrow_spots_keep_pixels_at_the_cones_edge) {
  // The cones' edge passes through the pixels of a wall close by: the distance is large against the tile.
  for (const double away : {100.0, 1000.0, 5000.0}) {
    Picture picture = random_picture(64, 64, 0, 5);
    const RenderView& view = picture.view;
    const dmat4 relative_from_clip = glm::inverse(dmat4(view.clip_from_relative));
    std::fill(picture.depth.begin(), picture.depth.end(), view.near_m / 2.0f);
    std::mt19937 random(9);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::vector<PlacedLight> lights;
    for (std::uint32_t i = 0; i < 1000; ++i) {
      const dvec3 target = position_at(view, relative_from_clip, 32.0 + 30.0 * unit(random), 32.0 + 30.0 * unit(random),
                                       static_cast<double>(picture.depth[0]));
      PlacedLight light;
      light.entity = {i, 1};
      light.light.kind = LightKind::spot;
      light.light.range_m = static_cast<float>(2.0 * away);
      light.light.intensity = 1e6f;
      const double half_angle = 0.002 + 0.05 * std::abs(unit(random));
      light.light.inner_angle = light.light.outer_angle = static_cast<float>(half_angle);
      const dvec3 from = glm::normalize(dvec3(unit(random), unit(random), unit(random)));
      const dvec3 side = glm::normalize(glm::cross(from, dvec3(0.2, 0.9, 0.1)));
      light.direction = vec3(-from);
      light.position = view.position + target + away * (from * std::cos(half_angle) + side * std::sin(half_angle));
      lights.push_back(light);
    }
    select_lights(lights, view, *picture.visible);
    const Figures figures = check_against_brute_force(picture, run_kernel(*device(), picture));
    EXPECT_GT(figures.needed, 1000u);
    EXPECT_EQ(figures.missing, 0u) << away << " m, of " << figures.needed;
  }
}

}  // namespace
}  // namespace gloam

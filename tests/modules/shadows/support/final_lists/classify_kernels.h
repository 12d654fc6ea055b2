// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <vector>

#include "engine/render/camera/view_constants.h"
#include "modules/shadows/atlas/mip_places.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/views/cascade_rows.h"
#include "shaders/shadows/maps/planes_shared.h"
#include "shaders/shadows/shaders.h"
#include "tests/modules/shadows/rig.h"
#include "tests/modules/shadows/support/final_lists/classify_oracle.h"
#include "tests/modules/shadows/support/final_lists/classify_scene.h"
#include "tests/modules/shadows/support/final_lists/kernels.h"

namespace gloam::test {

inline constexpr std::uint32_t kClassifyLights = 3;
inline constexpr double kClassifyBiasM = 0.002;
inline constexpr const char* kClassifyLightNames[] = {"spot", "cube", "sun"};

struct ClassifyOptions {
  ProbeSettings filter{.levels = 255, .standard = true};
  std::uint32_t classify = 1;
  std::uint32_t pair_capacity = 1u << 12;
};

/// Buffers after the shaders. Entry i is of tile i / 3 and light i % 3 of the scene.
struct Classified {
  std::vector<std::uint32_t> entries, pairs;
  std::vector<shaders::ShadowListCounters> counters{1};
  std::vector<shaders::ShadowListCommands> commands{1};

  [[nodiscard]] std::uint32_t slot(std::size_t tile, std::size_t light) const {
    return entries[tile * kClassifyLights + light] >> 10;
  }
};

struct ClassifyYield {
  std::uint32_t lit = 0, unlit = 0, open = 0;
};

class ClassifyKernels : public ShadowKernelTest {
 protected:
  static void TearDownTestSuite() {
    for (const auto& [key, pipeline] : pipelines()) device().destroy(pipeline);
    pipelines().clear();
    ShadowKernelTest::TearDownTestSuite();
  }

  static std::map<std::vector<std::uint32_t>, gpu::PipelineHandle>& pipelines() {
    static std::map<std::vector<std::uint32_t>, gpu::PipelineHandle> made;
    return made;
  }
  static gpu::PipelineHandle pipeline(bool directional, const ProbeSettings& settings) {
    std::vector<std::uint32_t> key = {directional ? 1u : 0u};
    for (const gpu::SpecConstant& constant : settings.constants()) key.push_back(constant.value.bits);
    gpu::PipelineHandle& found = pipelines()[key];
    using namespace shaders::shadows;
    if (!found)
      found = value_of(device().create_pipeline(gpu::ComputePipelineDesc{
          "classify", "test", directional ? classify_suns_comp : classify_local_comp, settings.constants()}));
    return found;
  }

  static shaders::ShadowBlock constants_of(const ClassifyScene& scene) {
    shaders::ShadowBlock block{};
    block.atlas_size = static_cast<float>(scene.atlas_size);
    block.bias_m = static_cast<float>(kClassifyBiasM);
    block.relative_quantum = 1.0f / 16777216.0f;
    set_classify_sun(scene, block);
    return block;
  }

  static void bind_maps(ListDispatch& d, const ClassifyScene& scene) {
    const ClassifyImages images = classify_images(scene);
    const uvec2 pyramid = size_with_mips(scene.atlas_size >> GLOAM_SHADOW_PYRAMID_MIP);
    d.sampled(11, gpu::Format::rgba32_float, size_with_mips(scene.atlas_size / GLOAM_SHADOW_PLANE_BLOCK),
              images.planes);
    shaders::ShadowBlock block = constants_of(scene);
    std::vector<shaders::ShadowRow> rows = classify_rows(scene);
    append_cascade_rows(std::vector<DirectionalLook>{{vec3(scene.lights[2].vector), 1.0f}}, block, rows);
    d.input(13, std::vector{block});
    d.sampled(14, gpu::Format::rgba32_float, {GLOAM_SHADOW_ROW_TEXELS, static_cast<std::uint32_t>(rows.size())}, rows);
    d.sampled(15, gpu::Format::r32_float, size_with_mips(scene.atlas_size), images.atlas);
    d.sampled(16, gpu::Format::r32_float, {pyramid.x, 2 * pyramid.y}, images.pyramid);
    const std::vector<std::uint32_t> white(1, ~0u);
    for (const std::uint32_t binding : {17u, 18u})
      d.sampled(binding, gpu::Format::rgba8_unorm, {1, 1}, white, gpu::ImageShape::array);
  }

  /// Classifies each light at each tile that has pixels. Candidates are in random order.
  static Classified classify(const ClassifyScene& scene, const ClassifyOptions& options = {}) {
    Classified c;
    const auto tiles = static_cast<std::uint32_t>(scene.tiles.size()), capacity = tiles * kClassifyLights;
    std::vector<std::uint32_t> candidates(2 * std::size_t{capacity}, ~0u), order(capacity);
    std::vector<shaders::ShadowTileGroup> groups(2 * std::size_t{tiles});
    std::vector<shaders::ShadowCandidateCommands> commands(1);
    for (std::uint32_t i = 0; i < capacity; ++i) {
      c.entries.push_back(i / kClassifyLights << 10 | i % kClassifyLights % 2);
      order[i] = i;
    }
    std::mt19937 random(capacity);
    std::shuffle(order.begin(), order.end(), random);
    for (const std::uint32_t i : order) {
      const ClassifyTile& tile = scene.tiles[i / kClassifyLights];
      if (tile.groups[0].empty()) continue;
      for (std::size_t g = 0; g < 2; ++g)
        if (!tile.groups[g].empty()) groups[i / kClassifyLights * 2 + g] = classify_group(tile.groups[g]);
      const bool sun = i % kClassifyLights == 2;
      const std::uint32_t kind = (sun ? GLOAM_CANDIDATES_DIRECTIONAL : GLOAM_CANDIDATES_LOCAL) + tile.has_two();
      const std::uint32_t at = commands[0].candidates[kind].w++, end = sun ? tiles : capacity;
      candidates[(sun ? capacity : 0) + (tile.has_two() ? end - 1 - at : at)] = i;
    }
    shaders::FinalGrid grid{};
    grid.tiles = scene.grid();
    grid.directional_count = 1;
    grid.entry_capacity = grid.candidate_capacity = capacity;
    grid.pair_capacity = options.pair_capacity;
    grid.classify = options.classify;
    c.pairs.assign(std::size_t{options.pair_capacity} + tiles, kGuard);
    for (uvec4& kind : c.commands[0].pairs) kind = {GLOAM_PAIRS_ROW, 0, 1, 0};
    ListDispatch d(device());
    d.input(0, std::vector{view_constants(scene.view)});
    d.input(2, std::vector{grid});
    std::vector<vec4> texels;
    for (std::size_t i = 0; i < 2; ++i)
      texels.insert(texels.end(), {vec4(vec3(scene.lights[i].vector), 0.0f), vec4(0.0f), vec4(0.0f)});
    d.sampled(3, gpu::Format::rgba32_float, {3, 2}, texels);
    d.in_out(4, c.entries);
    d.in_out(5, c.pairs);
    d.in_out(6, c.counters);
    d.in_out(7, c.commands);
    d.input(8, candidates);
    d.input(9, groups);
    d.input(10, commands);
    bind_maps(d, scene);
    for (std::uint32_t kind = 0; kind < GLOAM_CANDIDATE_KINDS; ++kind) {
      const std::uint32_t count = commands[0].candidates[kind].w;
      if (count == 0) continue;
      d.push(kind);
      d.run(pipeline((kind & GLOAM_CANDIDATES_DIRECTIONAL) != 0, options.filter),
            {(count + GLOAM_CANDIDATE_GROUP - 1) / GLOAM_CANDIDATE_GROUP, 1});
    }
    for (std::uint32_t& pair : c.pairs) pair = pair == kGuard ? pair : pair & ~GLOAM_ENTRY_FLAGS;
    return c;
  }

  /// Expects that counters, pairs and commands agree with the entries.
  static void expect_agreement(const ClassifyScene& scene, const Classified& c, std::uint32_t pair_capacity) {
    std::uint32_t lit = 0, unlit = 0, without_room = 0;
    std::vector<std::uint32_t> open;
    for (std::uint32_t i = 0; i < c.entries.size(); ++i) {
      EXPECT_EQ(c.entries[i] & 1023u, i % kClassifyLights % 2) << "entry " << i << " has its light";
      const std::uint32_t slot = c.entries[i] >> 10;
      if (scene.tiles[i / kClassifyLights].groups[0].empty()) {
        EXPECT_EQ(slot, i / kClassifyLights) << "entry " << i << " is no candidate";
        continue;
      }
      lit += slot == GLOAM_ALL_LIT ? 1 : 0;
      unlit += slot == GLOAM_ALL_UNLIT ? 1 : 0;
      without_room += slot == GLOAM_NO_ROOM ? 1 : 0;
      if (slot >= GLOAM_NO_ROOM) continue;
      EXPECT_EQ(slot, i / kClassifyLights) << "entry " << i;
      open.push_back(i);
    }
    EXPECT_EQ(c.counters[0].lit_at_once, lit);
    EXPECT_EQ(c.counters[0].unlit_at_once, unlit);
    EXPECT_EQ(c.counters[0].pairs, open.size() + without_room);
    EXPECT_TRUE(without_room == 0 || open.size() == pair_capacity) << open.size() << " of " << pair_capacity;
    std::vector<std::uint32_t> listed;
    for (std::uint32_t kind = 0; kind < GLOAM_PAIR_KINDS; ++kind) {
      const uvec4 command = c.commands[0].pairs[kind];
      EXPECT_EQ(uvec3(command), uvec3(GLOAM_PAIRS_ROW, (command.w + GLOAM_PAIRS_ROW - 1) / GLOAM_PAIRS_ROW, 1));
      for (std::uint32_t i = 0; i < command.w; ++i) {
        const std::uint32_t place = kind == GLOAM_PAIRS_IN_FACE    ? i
                                    : kind == GLOAM_PAIRS_CROSSING ? pair_capacity - 1 - i
                                                                   : pair_capacity + i;
        const std::uint32_t entry = c.pairs.at(place), light = entry % kClassifyLights;
        EXPECT_EQ(kind == GLOAM_PAIRS_DIRECTIONAL, light == 2) << "entry " << entry << " is in kind " << kind;
        listed.push_back(entry);
      }
    }
    EXPECT_EQ(std::count(c.pairs.begin(), c.pairs.end(), kGuard), c.pairs.size() - listed.size());
    std::sort(listed.begin(), listed.end());
    EXPECT_EQ(listed, open);
  }

  /// Expects that no verdict contradicts the brute-force search. stride: every how many pixels are searched.
  static void expect_as_searched(const ClassifyScene& scene, const Classified& c, std::size_t stride) {
    for (std::size_t light = 0; light < kClassifyLights; ++light) {
      const ClassifyOracle oracle(scene.lights[light], scene.face_size, kClassifyBiasM);
      for (std::size_t tile = 0; tile < scene.tiles.size(); ++tile) {
        const std::uint32_t slot = c.slot(tile, light);
        if (slot < GLOAM_NO_ROOM) continue;
        for (const std::vector<ClassifyPixel>& group : scene.tiles[tile].groups)
          for (std::size_t i = 0; i < group.size(); i += i + stride < group.size() ? stride : 1) {
            const ClassifyPixel& pixel = group[i];
            if (!oracle.is_asked(pixel)) continue;
            if (slot == GLOAM_ALL_LIT ? oracle.is_partly_hidden(pixel) : oracle.is_partly_visible(pixel)) {
              ADD_FAILURE() << "tile " << tile << ", " << kClassifyLightNames[light] << ": "
                            << (slot == GLOAM_ALL_LIT ? "lit, but partly hidden" : "unlit, but partly visible")
                            << " at pixel " << pixel.at.x << ',' << pixel.at.y;
              return;
            }
          }
      }
    }
  }

  /// The pixels of some entries that a light is asked about.
  struct ProbedPixels {
    std::vector<shaders::ShadowProbe> probes;
    std::vector<std::size_t> entries;  ///< of each probe
  };
  template <class Wanted>
  static ProbedPixels pixels_of(const ClassifyScene& scene, Wanted&& wanted) {
    ProbedPixels found;
    for (std::size_t light = 0; light < kClassifyLights; ++light) {
      const ClassifyOracle oracle(scene.lights[light], scene.face_size, kClassifyBiasM);
      for (std::size_t tile = 0; tile < scene.tiles.size(); ++tile) {
        if (!wanted(tile, light)) continue;
        for (const std::vector<ClassifyPixel>& group : scene.tiles[tile].groups)
          for (const ClassifyPixel& pixel : group) {
            if (!oracle.is_asked(pixel)) continue;
            found.entries.push_back(tile * kClassifyLights + light);
            found.probes.push_back({.position = vec3(pixel.position),
                                    .light = static_cast<std::uint32_t>(light % 2),
                                    .face_normal = vec3(pixel.face_normal),
                                    .flags = (light == 2 ? GLOAM_SHADOW_PROBE_DIRECTIONAL : 0u) |
                                             (pixel.subsurface ? GLOAM_SHADOW_PROBE_SUBSURFACE : 0u),
                                    .light_vector = vec3(scene.lights[light].vector)});
          }
      }
    }
    return found;
  }

  /// Expects that the filter gives every pixel what the verdict says, and that no pixel of an in-face pair has a search
  /// region so wide that near_visibility() might judge it. Adds the scene's faces to the maps.
  static void expect_as_filtered(const ClassifyScene& scene, const Classified& c, ShadowMaps& maps,
                                 const ProbeSettings& filter) {
    for (const ClassifyLight& light : scene.lights)
      for (const ClassifyFace& face : light.faces)
        maps.add_face(face.depths, face.origin, scene.face_size, light.kind == CastKind::sun);
    expect_narrow_in_face(scene, c, maps, filter);
    const auto [probes, entries] =
        pixels_of(scene, [&](std::size_t tile, std::size_t light) { return c.slot(tile, light) >= GLOAM_NO_ROOM; });
    if (probes.empty()) return;
    const auto results = maps.probe(probes, classify_rows(scene), constants_of(scene), filter);
    for (std::size_t i = 0; i < results.size(); ++i) {
      const std::size_t light = entries[i] % kClassifyLights;
      const float expected = c.entries[entries[i]] >> 10 == GLOAM_ALL_LIT ? 1.0f : 0.0f;
      if (results[i].visibility == expected) continue;
      ADD_FAILURE() << "tile " << entries[i] / kClassifyLights << ", " << kClassifyLightNames[light]
                    << ": the verdict is " << expected << ", the filter finds " << results[i].visibility;
      return;
    }
  }

  static void expect_narrow_in_face(const ClassifyScene& scene, const Classified& c, ShadowMaps& maps,
                                    const ProbeSettings& filter) {
    constexpr double kNearTangent = 0.55;  // of shadows.near=wide
    if (filter.filter != kContactHardening) return;
    std::vector<bool> in_face(scene.tiles.size() * kClassifyLights);
    for (std::uint32_t i = 0; i < c.commands[0].pairs[GLOAM_PAIRS_IN_FACE].w; ++i) in_face[c.pairs[i]] = true;
    const auto [probes, entries] =
        pixels_of(scene, [&](std::size_t tile, std::size_t light) { return in_face[tile * kClassifyLights + light]; });
    if (probes.empty()) return;
    const auto results = maps.probe(probes, classify_rows(scene), constants_of(scene), filter);
    for (std::size_t i = 0; i < results.size(); ++i) {
      const double tan_half = scene.lights[entries[i] % kClassifyLights].faces[0].pose.tan_half;
      EXPECT_LE(static_cast<double>(results[i].region_width) * tan_half, kNearTangent * scene.face_size)
          << "tile " << entries[i] / kClassifyLights;
    }
  }

  /// Expects that the taps of each group of an in-face pair of the cube are in one face, as far as the smallest kernel
  /// tells.
  static void expect_in_face(const ClassifyScene& scene, const Classified& c) {
    const ClassifyOracle oracle(scene.lights[1], scene.face_size, kClassifyBiasM);
    for (std::uint32_t i = 0; i < c.commands[0].pairs[GLOAM_PAIRS_IN_FACE].w; ++i) {
      if (c.pairs[i] % kClassifyLights != 1) continue;
      const ClassifyTile& tile = scene.tiles[c.pairs[i] / kClassifyLights];
      for (const std::vector<ClassifyPixel>& group : tile.groups) {
        int face = -1;
        for (const ClassifyPixel& pixel : group) {
          const int own = oracle.face_of(pixel);
          if (own < 0 || !oracle.is_asked(pixel)) continue;
          EXPECT_TRUE(face < 0 || face == own) << "pixels of tile " << c.pairs[i] / kClassifyLights;
          EXPECT_GE(oracle.to_border(pixel), 4.0) << "a pixel of tile " << c.pairs[i] / kClassifyLights;
          face = own;
        }
      }
    }
  }

  static void add_yields(const Classified& c, const ClassifyScene& scene,
                         std::array<ClassifyYield, kClassifyLights>& yields) {
    for (std::size_t tile = 0; tile < scene.tiles.size(); ++tile)
      for (std::size_t light = 0; light < kClassifyLights; ++light) {
        if (scene.tiles[tile].groups[0].empty()) continue;
        const std::uint32_t slot = c.slot(tile, light);
        yields[light].lit += slot == GLOAM_ALL_LIT ? 1 : 0;
        yields[light].unlit += slot == GLOAM_ALL_UNLIT ? 1 : 0;
        yields[light].open += slot < GLOAM_NO_ROOM ? 1 : 0;
      }
  }
};

/// Fills a group of a tile with the pixels [first, last] of a plane. Those of odd rows are `rise` metres above the
/// plane. Leaves the group empty if a ray misses the plane.
inline void fill_group(ClassifyScene& scene, std::size_t tile, std::size_t group, uvec2 first, uvec2 last,
                       const dvec3& point, const dvec3& normal, double rise = 0.0) {
  const auto columns = scene.grid().x;
  std::vector<ClassifyPixel>& pixels = scene.tiles[tile].groups[group];
  pixels.clear();
  for (std::uint32_t y = first.y; y <= last.y; ++y)
    for (std::uint32_t x = first.x; x <= last.x; ++x) {
      const auto pixel =
          pixel_on_plane(scene.view, {tile % columns, tile / columns}, {x, y}, point + (y % 2) * rise * normal, normal);
      if (!pixel) {
        pixels.clear();
        return;
      }
      pixels.push_back(*pixel);
    }
}

}  // namespace gloam::test

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/lod/visible_patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "tests/support/scale.h"

namespace gloam {
namespace {

GrassPatch patch_at(dvec3 origin, vec3 half, float reach_m, float max_distance_m) {
  GrassPatch patch;
  patch.origin = origin;
  patch.roots = {-half, half};
  patch.reach_m = reach_m;
  patch.max_distance_m = max_distance_m;
  patch.blades = 256;
  return patch;
}

RenderView view_from(dvec3 position, dvec3 toward) {
  ViewSettings settings;
  settings.width = 640;
  settings.height = 360;
  settings.world_from_camera = glm::inverse(glm::lookAt(position, toward, dvec3(0.01, 1.0, 0.02)));
  return make_view(settings, 0);
}

std::set<std::uint32_t> kept(const VisiblePatches& visible) {
  std::set<std::uint32_t> patches;
  for (const VisiblePatch& one : visible.patches) patches.insert(one.patch);
  return patches;
}

/// Whether a point of the world is inside the view's picture and before its camera.
bool in_picture(const RenderView& view, const dvec3& point) {
  const dvec4 clip = dmat4(view.clip_from_relative) * dvec4(point - view.position, 1.0);
  return clip.w > 0.0 && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w && clip.z <= clip.w;
}

TEST(VisiblePatches, never_drop_a_patch_whose_blade_shows) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  auto executor = make_serial_executor();
  std::size_t shown = 0, dropped = 0;
  const int views = test::scaled(300);
  for (int v = 0; v < views; ++v) {
    const dvec3 far(v % 3 == 0 ? 1e5 : 0.0, 0.0, 0.0);
    const dvec3 eye = far + dvec3(20.0 * unit(random), 2.0 + 1.9 * unit(random), 20.0 * unit(random));
    const dvec3 toward =
        v % 5 == 0 ? eye - dvec3(0.0, 1.0, 0.001) : eye + dvec3(unit(random), 0.4 * unit(random), unit(random));
    const RenderView view = view_from(eye, toward);
    std::vector<GrassPatch> patches;
    for (int i = 0; i < 200; ++i)
      patches.push_back(patch_at(far + dvec3(30.0 * unit(random), 0.3 * unit(random), 30.0 * unit(random)),
                                 vec3(0.6f, 0.1f, 0.6f), 0.4f, 25.0f));
    const auto found = kept(find_visible_patches(patches, view, {}, *executor));
    dropped += patches.size() - found.size();
    for (std::uint32_t i = 0; i < patches.size(); ++i) {
      bool shows = false;
      for (int blade = 0; blade < 64 && !shows; ++blade) {
        const dvec3 root =
            patches[i].origin + dvec3(patches[i].roots.max) * dvec3(unit(random), unit(random), unit(random));
        if (glm::length(root - eye) >= 25.0) continue;
        dvec3 way(unit(random), unit(random), unit(random));
        if (glm::length(way) > 1.0) way = glm::normalize(way);
        shows = in_picture(view, root + 0.4 * way);
      }
      if (!shows) continue;
      ++shown;
      EXPECT_TRUE(found.contains(i)) << "view " << v << ", patch " << i;
    }
  }
  EXPECT_GT(shown, static_cast<std::size_t>(views));
  EXPECT_GT(dropped, static_cast<std::size_t>(views) * 50);  // culling does something
}

TEST(VisiblePatches, come_nearest_first_for_every_executor) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<GrassPatch> patches;
  for (int i = 0; i < 5000; ++i)
    patches.push_back(patch_at(dvec3(40.0 * unit(random), 0.0, 40.0 * unit(random)), vec3(0.5f), 0.3f, 30.0f));
  const RenderView view = view_from(dvec3(0.0, 2.0, 0.0), dvec3(0.0, 1.0, -10.0));
  const auto serial = find_visible_patches(patches, view, {}, *make_serial_executor());
  ASSERT_GT(serial.patches.size(), 100u);
  EXPECT_TRUE(std::ranges::is_sorted(serial.patches, {}, &VisiblePatch::nearest_m));
  EXPECT_EQ(serial.range_m, 30.0f);
  for (const std::uint32_t threads : {1u, 2u, 8u})
    EXPECT_EQ(find_visible_patches(patches, view, {}, *make_pool_executor(threads)).patches, serial.patches);
  EXPECT_EQ(find_visible_patches(patches, view, {}, *make_shuffled_executor(5)).patches, serial.patches);
}

TEST(VisiblePatches, behind_the_camera_stay_within_the_cast_distance) {
  const std::vector<GrassPatch> patches = {patch_at(dvec3(0.0, 0.0, 4.0), vec3(0.5f), 0.3f, 30.0f),
                                           patch_at(dvec3(0.0, 0.0, 9.0), vec3(0.5f), 0.3f, 30.0f)};
  const RenderView view = view_from(dvec3(0.0, 1.0, 0.0), dvec3(0.0, 1.0, -1.0));
  EXPECT_TRUE(find_visible_patches(patches, view, {}, *make_serial_executor()).patches.empty());
  const auto behind = [&](std::span<const CastingLight> lights) {
    return kept(
        find_visible_patches(patches, view, {.cast_distance_m = 6.0f, .lights = lights}, *make_serial_executor()));
  };
  const CastingLight from_behind[] = {{.directional = true, .direction = glm::normalize(vec3(0.0f, -0.2f, -1.0f))}};
  const CastingLight from_ahead[] = {{.directional = true, .direction = glm::normalize(vec3(0.0f, -0.2f, 1.0f))}};
  EXPECT_EQ(behind(from_behind), std::set<std::uint32_t>{0});
  EXPECT_TRUE(behind(from_ahead).empty()) << "their shadows fall away from the view";
  EXPECT_TRUE(behind({}).empty()) << "nothing casts";
}

TEST(VisiblePatches, empty_far_and_undefined_patches_are_left_out) {
  std::vector<GrassPatch> patches(4, patch_at(dvec3(0.0, 0.0, -5.0), vec3(0.5f), 0.3f, 30.0f));
  patches[1].blades = 0;
  patches[2].origin = dvec3(0.0, 0.0, -31.0);
  patches[3].origin = dvec3(std::nan(""), 0.0, 0.0);
  const RenderView view = view_from(dvec3(0.0, 1.0, 0.0), dvec3(0.0, 1.0, -1.0));
  EXPECT_EQ(kept(find_visible_patches(patches, view, {}, *make_serial_executor())), std::set<std::uint32_t>{0});
}

}  // namespace
}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/final_lists/reuse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "modules/shadows/atlas/cache.h"
#include "shaders/lights/lights_shared.h"
#include "shaders/shadows/final_lists_shared.h"

namespace gloam {
namespace {

constexpr std::uint32_t kChanged = GLOAM_LIGHT_CHANGED;

LightInputs input(std::uint32_t entity, std::uint64_t hash = 1, std::uint64_t maps = 1, std::uint32_t generation = 0) {
  return {Entity{entity, generation}, hash, maps};
}

ListInputs three_lights_and_a_sun() {
  return {.shared = 5, .local = {input(10), input(11), input(12)}, .directional = {input(20)}};
}

TEST(LastIndices, find_lights_that_have_not_changed) {
  const ListInputs last = three_lights_and_a_sun();
  ListInputs now = last;
  std::swap(now.local[0], now.local[2]);
  const std::vector<std::uint32_t> indices = last_indices(last, now);
  ASSERT_EQ(indices.size(), std::size_t{GLOAM_MAX_LOCAL_LIGHTS + GLOAM_MAX_DIRECTIONAL_LIGHTS});
  EXPECT_EQ(indices[0], 2u);
  EXPECT_EQ(indices[1], 1u);
  EXPECT_EQ(indices[2], 0u);
  EXPECT_EQ(indices[GLOAM_MAX_LOCAL_LIGHTS], 0u);
  EXPECT_EQ(std::ranges::count(indices, kChanged), static_cast<std::ptrdiff_t>(indices.size()) - 4);
}

TEST(LastIndices, of_a_light_that_changed_is_new_or_is_another_entity_there_are_none) {
  const ListInputs last = three_lights_and_a_sun();
  ListInputs now = last;
  now.local = {input(10, 2), input(11, 1, 2), input(12, 1, 1, 1), input(13)};
  now.directional = {input(10)};  // a local light before
  const std::vector<std::uint32_t> indices = last_indices(last, now);
  EXPECT_EQ(std::ranges::count(indices, kChanged), static_cast<std::ptrdiff_t>(indices.size()));
}

/// Lights that may be reprojected from frame 7 of the casters to frame 8.
ListInputs steady_lights(std::uint64_t caster_frame) {
  ListInputs inputs = three_lights_and_a_sun();
  inputs.steady = 3;
  inputs.caster_frame = caster_frame;
  for (std::vector<LightInputs>* lights : {&inputs.local, &inputs.directional})
    for (LightInputs& light : *lights) light.steady = 4, light.casters = CastersMoved::none;
  return inputs;
}

TEST(LastIndices, mark_lights_that_a_moving_camera_may_reproject) {
  const ListInputs last = steady_lights(7);
  ListInputs now = steady_lights(8);
  now.shared = 6;                                // the camera has moved
  now.local[0].maps = 2;                         // a map was drawn anew
  now.local[1].casters = CastersMoved::some;     // a caster has moved
  now.local[2].casters = CastersMoved::unknown;  // it may be anywhere
  now.directional[0].composed = 7;               // close-ups change it otherwise
  const std::vector<std::uint32_t> indices = last_indices(last, now);
  EXPECT_EQ(indices[0], GLOAM_LIGHT_REPROJECTED);
  EXPECT_EQ(indices[1], 1u | GLOAM_LIGHT_REPROJECTED | GLOAM_LIGHT_CASTERS_MOVED);
  EXPECT_EQ(indices[2], kChanged);
  EXPECT_EQ(indices[GLOAM_MAX_LOCAL_LIGHTS], GLOAM_LIGHT_REPROJECTED | GLOAM_LIGHT_RECOMPOSED);
  EXPECT_TRUE(reprojects_any(indices));
}

TEST(LastIndices, mark_none_to_be_reprojected_where_lights_casters_or_knobs_are_others) {
  const ListInputs last = steady_lights(7);
  const auto changed = [&](auto&& change) {
    ListInputs now = steady_lights(8);
    now.shared = 6;
    change(now);
    const std::vector<std::uint32_t> indices = last_indices(last, now);
    return std::ranges::count(indices, kChanged) == static_cast<std::ptrdiff_t>(indices.size());
  };
  EXPECT_TRUE(changed([](ListInputs& now) { now.steady = 9; })) << "knobs";
  EXPECT_TRUE(changed([](ListInputs& now) { now.caster_frame = 9; })) << "a frame was missed: casters moved unseen";
  EXPECT_TRUE(changed([](ListInputs& now) { now.caster_frame = 0; })) << "exact frames know no casters";
  EXPECT_TRUE(changed([](ListInputs& now) {
    for (LightInputs& light : now.local) light.steady = 5;
    now.directional[0].steady = 5;
  })) << "lights moved";
  EXPECT_FALSE(changed([](ListInputs&) {}));
}

TEST(LastIndices, mark_lights_whose_visibilities_later_modules_change_otherwise) {
  const ListInputs last = three_lights_and_a_sun();
  ListInputs now = last;
  std::swap(now.local[0], now.local[2]);
  now.local[0].composed = 7;
  now.directional[0].composed = 7;
  now.local[1].composed = now.local[1].hash = 7;
  const std::vector<std::uint32_t> indices = last_indices(last, now);
  EXPECT_EQ(indices[0], 2u | GLOAM_LIGHT_RECOMPOSED);
  EXPECT_EQ(indices[1], kChanged) << "the light itself has changed";
  EXPECT_EQ(indices[2], 0u);
  EXPECT_EQ(indices[GLOAM_MAX_LOCAL_LIGHTS], GLOAM_LIGHT_RECOMPOSED);
  EXPECT_TRUE(keeps_any(now, indices));
}

TEST(LastIndices, keep_something_only_if_a_light_with_maps_has_not_changed) {
  const ListInputs last = three_lights_and_a_sun();
  ListInputs now = last;
  EXPECT_TRUE(keeps_any(now, last_indices(last, now)));
  for (LightInputs& light : now.local) light.maps = 2;
  EXPECT_TRUE(keeps_any(now, last_indices(last, now))) << "the sun";
  now.directional[0].maps = 2;
  EXPECT_FALSE(keeps_any(now, last_indices(last, now)));
  // A light without maps is lit at once: its entries are not worth a key.
  const ListInputs bare{.shared = 5, .local = {input(10, 1, 0)}};
  EXPECT_FALSE(keeps_any(bare, last_indices(bare, bare)));
}

TEST(LastIndices, of_a_frame_that_shares_nothing_there_are_none) {
  const ListInputs last = three_lights_and_a_sun();
  ListInputs now = last;
  now.shared = 6;
  const std::vector<std::uint32_t> indices = last_indices(last, now);
  EXPECT_EQ(std::ranges::count(indices, kChanged), static_cast<std::ptrdiff_t>(indices.size()));
}

TEST(MapVersion, changes_whenever_the_map_is_drawn) {
  ShadowCache cache;
  ShadowFace face;
  face.light = Entity{3, 0};
  face.square = {uvec2(0), 64};
  const FaceKey key{face.light, 0, 0};
  EXPECT_EQ(cache.version(key), 0u);
  cache.set_drawn(face, {}, 1);
  const std::uint64_t first = cache.version(key);
  EXPECT_NE(first, 0u);
  cache.keep(key, {}, 2);
  EXPECT_EQ(cache.version(key), first);
  cache.set_drawn(face, {}, 3);
  EXPECT_NE(cache.version(key), first);
  // A map that was lost and drawn again is another one, too.
  const std::uint64_t second = cache.version(key);
  cache.clear();
  cache.set_drawn(face, {}, 4);
  EXPECT_NE(cache.version(key), first);
  EXPECT_NE(cache.version(key), second);
}

}  // namespace
}  // namespace gloam

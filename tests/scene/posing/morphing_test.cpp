// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/posing/morphing.h"

#include <gtest/gtest.h>

#include <vector>

namespace gloam {
namespace {

Mesh mesh_with(std::size_t targets, std::vector<float> defaults) {
  Mesh mesh;
  mesh.primitives.resize(2);
  for (Primitive& primitive : mesh.primitives) primitive.morph_targets.resize(targets);
  mesh.morph_weights = std::move(defaults);
  return mesh;
}

TEST(Morphing, fresh_instances_get_ranges_in_order_with_the_meshes_defaults) {
  const Mesh two = mesh_with(2, {0.25f, 0.5f});
  const Mesh three = mesh_with(3, {1.0f});  // absent defaults are zero
  const Mesh none = mesh_with(0, {});
  MorphInstance a;
  MorphInstance b;
  MorphInstance c;
  std::vector<float> values;
  EXPECT_TRUE(lay_out_morph_weights(std::vector<MorphRow>{{&a, &two}, {&c, &none}, {&b, &three}}, values));
  EXPECT_EQ(values, (std::vector{0.25f, 0.5f, 1.0f, 0.0f, 0.0f}));
  EXPECT_EQ(a.first, 0u);
  EXPECT_EQ(a.count, 2u);
  EXPECT_EQ(b.first, 2u);
  EXPECT_EQ(b.count, 3u);
  EXPECT_EQ(c.count, 0u);
}

TEST(Morphing, a_layout_that_fits_is_left_alone) {
  const Mesh two = mesh_with(2, {});
  MorphInstance a{.first = 2, .count = 2};
  MorphInstance b{.first = 0, .count = 2};
  std::vector<float> values{1.0f, 2.0f, 3.0f, 4.0f};
  EXPECT_FALSE(lay_out_morph_weights(std::vector<MorphRow>{{&a, &two}, {&b, &two}}, values));
  EXPECT_EQ(a.first, 2u);
  EXPECT_EQ(values, (std::vector{1.0f, 2.0f, 3.0f, 4.0f}));
}

TEST(Morphing, weights_survive_when_another_instance_comes_or_goes) {
  const Mesh two = mesh_with(2, {});
  MorphInstance kept{.first = 2, .count = 2};
  MorphInstance fresh;
  std::vector<float> values{1.0f, 2.0f, 3.0f, 4.0f};  // the first two belonged to a destroyed instance
  EXPECT_TRUE(lay_out_morph_weights(std::vector<MorphRow>{{&kept, &two}}, values));
  EXPECT_EQ(values, (std::vector{3.0f, 4.0f}));
  EXPECT_TRUE(lay_out_morph_weights(std::vector<MorphRow>{{&fresh, &two}, {&kept, &two}}, values));
  EXPECT_EQ(values, (std::vector{0.0f, 0.0f, 3.0f, 4.0f}));
  EXPECT_EQ(kept.first, 2u);
}

TEST(Morphing, a_range_past_the_end_is_laid_out_anew) {
  const Mesh two = mesh_with(2, {0.5f, 0.5f});
  MorphInstance wild{.first = ~0u, .count = 2};
  std::vector<float> values{1.0f, 2.0f};
  EXPECT_TRUE(lay_out_morph_weights(std::vector<MorphRow>{{&wild, &two}}, values));
  EXPECT_EQ(wild.first, 0u);
  EXPECT_EQ(values, (std::vector{0.5f, 0.5f}));
}

}  // namespace
}  // namespace gloam

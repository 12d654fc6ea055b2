// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/assets/animation_import.h"

#include <gmock/gmock.h>

#include "engine/scene/assets.h"
#include "tests/support/gltf_files.h"

namespace gloam {
namespace {

using test::GltfText;
using test::Import;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A clip that moves one property of one node.
std::string clip(const std::string& name, int input, int output, int node, const char* path,
                 const char* interpolation = "LINEAR") {
  return R"({"name": ")" + name + R"(", "samplers": [{"input": )" + std::to_string(input) + R"(, "output": )" +
         std::to_string(output) + R"(, "interpolation": ")" + interpolation +
         R"("}], "channels": [{"sampler": 0, "target": {"node": )" + std::to_string(node) + R"(, "path": ")" + path +
         "\"}}]}";
}

const std::vector<AnimationClip>& clips_of(const GltfText& gltf, Import& import, const ImportOptions& options = {}) {
  test::import_text(gltf.text(), import, options);
  EXPECT_EQ(import.fault(), "");
  return import.world.resource<SceneAssets>().clips;
}

TEST(AnimationImport, reads_keys_of_every_interpolation) {
  GltfText gltf;
  gltf.add("nodes", "{}");
  const int times = gltf.floats({0.5f, 2.0f}, "SCALAR");
  const int moves = gltf.floats({0, 0, 0, 1, 2, 3}, "VEC3");
  const int cubic = gltf.floats(std::vector<float>(18, 1.0f), "VEC3");
  const int turns = gltf.accessor(std::vector<std::int16_t>{0, 0, 0, 32767, 0, -32767, 0, 0}, 5122, "VEC4",
                                  R"(, "normalized": true)");
  gltf.add("animations", clip("move", times, moves, 0, "translation", "STEP"));
  gltf.add("animations", clip("turn", times, turns, 0, "rotation"));
  gltf.add("animations", clip("grow", times, cubic, 0, "scale", "CUBICSPLINE"));
  Import import;
  const auto& clips = clips_of(gltf, import);
  ASSERT_EQ(clips.size(), 3u);
  EXPECT_EQ(clips[0].duration_s, 2.0f);
  EXPECT_EQ(clips[0].channels[0].interpolation, Interpolation::step);
  EXPECT_THAT(clips[0].channels[0].times, ElementsAre(0.5f, 2.0f));
  EXPECT_THAT(clips[0].channels[0].values, ElementsAre(0, 0, 0, 1, 2, 3));
  EXPECT_EQ(clips[1].channels[0].width, 4u);
  EXPECT_THAT(clips[1].channels[0].values, ElementsAre(0, 0, 0, 1, 0, -1, 0, 0));
  EXPECT_EQ(clips[2].channels[0].interpolation, Interpolation::cubic);
  EXPECT_EQ(clips[2].channels[0].values.size(), 18u);
}

// Hard case: scene.same_target
TEST(AnimationImport, of_clips_that_move_the_same_only_the_first_keeps_its_channel) {
  GltfText gltf;
  gltf.add("nodes", "{}");
  gltf.add("nodes", "{}");
  const int times = gltf.floats({0}, "SCALAR");
  const int moves = gltf.floats({0, 0, 0}, "VEC3");
  gltf.add("animations", clip("idle", times, moves, 0, "translation"));
  gltf.add("animations", clip("walk", times, moves, 0, "translation"));
  gltf.add("animations", clip("grow", times, moves, 0, "scale"));
  gltf.add("animations", clip("other", times, moves, 1, "translation"));
  const auto channel_counts = [](const std::vector<AnimationClip>& clips) {
    std::vector<std::size_t> counts;
    for (const AnimationClip& each : clips) counts.push_back(each.channels.size());
    return counts;
  };
  Import first;
  EXPECT_THAT(channel_counts(clips_of(gltf, first)), ElementsAre(1, 0, 1, 1));
  Import chosen;
  const auto& clips = clips_of(gltf, chosen, {.animation = "walk"});
  EXPECT_THAT(channel_counts(clips), ElementsAre(0, 1, 1, 1));
  EXPECT_EQ(clips[1].name, "walk");
}

TEST(AnimationImport, an_unknown_name_is_a_usage_error_that_lists_the_clips) {
  GltfText gltf;
  gltf.add("nodes", "{}");
  const int times = gltf.floats({0}, "SCALAR");
  const int moves = gltf.floats({0, 0, 0}, "VEC3");
  gltf.add("animations", clip("idle", times, moves, 0, "translation"));
  gltf.add("animations", clip("walk", times, moves, 0, "translation"));
  Import import;
  test::import_text(gltf.text(), import, {.animation = "run"});
  ASSERT_FALSE(import.ok());
  EXPECT_EQ(import.result.error().kind, ErrorKind::usage);
  EXPECT_EQ(import.fault(), "scene.gltf: no animation is named \"run\"; there are idle, walk");
  Import misspelt;
  test::import_text(gltf.text(), misspelt, {.animation = "wlak"});
  EXPECT_EQ(misspelt.fault(), "scene.gltf: no animation is named \"wlak\"; did you mean walk? there are idle, walk");
}

TEST(AnimationImport, channels_of_other_scenes_sheared_nodes_and_extensions_are_left_out) {
  GltfText gltf;
  gltf.add("nodes", R"({"matrix": [1,0,0,0, 0.5,1,0,0, 0,0,1,0, 0,0,0,1]})");
  gltf.add("nodes", "{}");
  gltf.add("scenes", R"({"nodes": [0]})");
  const int times = gltf.floats({0, 3}, "SCALAR");
  const int moves = gltf.floats({0, 0, 0, 0, 0, 0}, "VEC3");
  gltf.add("animations", clip("sheared", times, moves, 0, "translation"));
  gltf.add("animations", clip("elsewhere", times, moves, 1, "translation"));
  gltf.add("animations", clip("pointer", times, moves, 0, "pointer"));
  gltf.add("animations", R"({"samplers": [{"input": 0, "output": 1}],
                             "channels": [{"sampler": 0, "target": {"path": "pointer"}}]})");
  Import import;
  const auto& clips = clips_of(gltf, import);
  ASSERT_EQ(clips.size(), 4u);
  for (const AnimationClip& each : clips) EXPECT_THAT(each.channels, IsEmpty());
  EXPECT_THAT(import.info().warnings, ElementsAre(HasSubstr("node 0 is a sheared matrix, it stays as it is")));
}

TEST(AnimationImport, weights_have_as_many_values_a_key_as_the_mesh_has_targets) {
  GltfText gltf;
  const std::string positions = std::to_string(gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3"));
  gltf.mesh("\"POSITION\": " + positions,
            R"(, "targets": [{"POSITION": )" + positions + R"(}, {"POSITION": )" + positions + "}]");
  gltf.add("nodes", R"({"mesh": 0})");
  const int times = gltf.floats({0, 1}, "SCALAR");
  gltf.add("animations", clip("face", times, gltf.floats({1, 2, 3, 4}, "SCALAR"), 0, "weights"));
  Import import;
  const auto& clips = clips_of(gltf, import);
  ASSERT_EQ(clips.size(), 1u);
  ASSERT_EQ(clips[0].channels.size(), 1u);
  EXPECT_EQ(clips[0].channels[0].width, 2u);
  EXPECT_EQ(clips[0].channels[0].path, AnimationPath::weights);
}

TEST(SkinImport, inverse_bind_matrices_default_to_identity) {
  GltfText gltf;
  gltf.add("nodes", "{}");
  gltf.add("nodes", "{}");
  std::vector<float> matrices(32, 0.0f);
  matrices[12] = 5.0f;
  const int bind = gltf.floats(matrices, "MAT4");
  gltf.add("skins", R"({"joints": [1, 0], "name": "plain"})");
  gltf.add("skins", R"({"joints": [0, 1], "inverseBindMatrices": )" + std::to_string(bind) + "}");
  Import import;
  test::import_text(gltf.text(), import);
  ASSERT_EQ(import.fault(), "");
  const auto& skins = import.world.resource<SceneAssets>().skins;
  ASSERT_EQ(skins.size(), 2u);
  EXPECT_EQ(skins[0].name, "plain");
  EXPECT_THAT(skins[0].joint_nodes, ElementsAre(1, 0));
  EXPECT_THAT(skins[0].inverse_bind, ElementsAre(mat4(1.0f), mat4(1.0f)));
  EXPECT_EQ(skins[1].inverse_bind[0][3], vec4(5, 0, 0, 0));
}

}  // namespace
}  // namespace gloam

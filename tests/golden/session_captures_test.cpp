// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "modules/lights/components.h"
#include "sandbox/session/baking/captures.h"
#include "tests/golden/whole_pictures.h"
#include "tests/support/gltf_files.h"
#include "tests/support/gpu_device.h"

// Captures of a session's scene: from a bake, from the cache, and their effect on the session's own frames.

namespace gloam::test {
namespace {

/// A lit triangle that swings before a proxy, one that hangs still, and a probe. reflects: the triangles are smooth.
std::string scene_text(bool reflects = true) {
  GltfText text;
  text.set("extensionsUsed", R"(["KHR_lights_punctual"])");
  text.set("extensions",
           R"({"KHR_lights_punctual": {"lights": [{"type": "point", "name": "lamp", "intensity": 200}]}})");
  text.add("meshes", R"({"primitives": [{"attributes": {"POSITION": )" +
                         std::to_string(text.floats({-2, -2, 0, 2, -2, 0, 0, 2, 0}, "VEC3")) +
                         R"(}, "material": 0}]})");
  text.add("materials", std::string(R"({"pbrMetallicRoughness": {"roughnessFactor": )") + (reflects ? "0.1}}" : "1}}"));
  text.add("nodes", R"({"mesh": 0, "name": "swinging", "translation": [0, 0, 0.1]})");
  text.add("nodes", R"({"mesh": 0, "name": "still"})");
  text.add("nodes", R"({"name": "proxy", "extras": {"gloam.ibr_proxy.size": [2, 2]}})");
  text.add("nodes", R"({"name": "probe", "translation": [0, 0, 2], "extras": {"gloam.cube_probe.global": true,
                        "gloam.cube_probe.resolution": 16}})");
  text.add("nodes", R"({"translation": [0, 1, 3], "extensions": {"KHR_lights_punctual": {"light": 0}}})");
  text.add("scenes", R"({"nodes": [0, 1, 2, 3, 4]})");
  const int times = text.floats({0, 1}, "SCALAR"), places = text.floats({0, 0, 0.1f, 3, 0, 0.1f}, "VEC3");
  text.add("animations", R"({"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}], "samplers":
           [{"input": )" + std::to_string(times) +
                             R"(, "output": )" + std::to_string(places) + "}]}");
  return text.text();
}

struct SessionCaptures : testing::Test {
  TemporaryFolder folder;
  Options options;

  void SetUp() override {
    const auto& device = shared_test_device();
    GLOAM_REQUIRE_GPU(device);
    GLOAM_REQUIRE_DEPTH_TESTS(device);
    options.scene = folder.write("swing.gltf", scene_text());
    options.cache_dir = folder.path() + "/cache";
    options.time_s = 0.3;
  }
  [[nodiscard]] std::unique_ptr<Session> open() const {
    auto session = open_session_on(shared_test_device(), options, gpu_log());
    EXPECT_TRUE(session.ok()) << session.error().message;
    return session ? std::move(*session) : nullptr;
  }
  static std::vector<float> frame_of(Session& session) {
    const ViewSettings view = session.view_settings(64, 48, "none");
    const auto sample = session.render_frame({.settings = view, .target = {}});
    EXPECT_TRUE(sample.ok()) << sample.error().message;
    return value_of(session.renderer->read_linear(view.id)).rgba;
  }
};

TEST_F(SessionCaptures, in_the_light_of_probes_are_others_and_made_when_the_knob_changes) {
  const auto session = open();
  ASSERT_TRUE(session != nullptr);
  std::size_t captured = 0;
  const BakeProgress count = [&](std::size_t done, std::size_t) { captured = std::max(captured, done); };
  const auto content_with = [&](IndirectSource source, std::size_t expected) {
    captured = 0;
    EXPECT_TRUE(session->renderer->knobs().set("lighting.indirect", name_of(source)).ok());
    EXPECT_TRUE(ensure_captures(*session, options, gpu_log(), count).ok());
    EXPECT_EQ(captured, expected) << name_of(source);
    const std::uint64_t content = session->world.resource<ReflectionCaptures>().content;
    EXPECT_EQ(content, capture_content(session->world, source));
    return content;
  };
  const std::uint64_t sky = content_with(IndirectSource::sky, 2);
  EXPECT_NE(content_with(IndirectSource::probes, 2), sky);
  EXPECT_EQ(content_with(IndirectSource::sky, 0), sky) << "the cache has both";
  EXPECT_NE(content_with(IndirectSource::probes, 0), sky);
  EXPECT_TRUE(session->check_validation().ok());
}

TEST_F(SessionCaptures, are_the_same_from_a_bake_and_from_the_cache) {
  const auto first = open(), second = open();
  ASSERT_TRUE(first != nullptr && second != nullptr);
  std::size_t captured = 0;
  const BakeProgress count = [&](std::size_t done, std::size_t) { captured = std::max(captured, done); };
  const Status baked = ensure_captures(*first, options, gpu_log(), count);
  ASSERT_TRUE(baked.ok()) << baked.error().message;
  EXPECT_EQ(captured, 2u);
  captured = 0;
  ASSERT_TRUE(ensure_captures(*second, options, gpu_log(), count).ok());
  EXPECT_EQ(captured, 0u) << "the cache has them";
  const auto &a = first->world.resource<ReflectionCaptures>(), &b = second->world.resource<ReflectionCaptures>();
  EXPECT_EQ(a.content, capture_content(second->world));
  EXPECT_EQ(a.content, b.content);
  EXPECT_EQ(a.proxies.texels, b.proxies.texels);
  EXPECT_EQ(a.probes.texels, b.probes.texels);
  EXPECT_EQ(a.proxy_entities, b.proxy_entities);
  ASSERT_EQ(a.lights.size(), 1u);
  EXPECT_TRUE(first->world.has<Light>(a.lights[0].light));
  EXPECT_TRUE(first->check_validation().ok());
}

TEST_F(SessionCaptures, leave_the_first_frame_as_it_is_without_them) {
  options.assignments = {"reflections.mode=off"};  // pictures with and without captures
  const auto baking = open(), plain = open();
  ASSERT_TRUE(baking != nullptr && plain != nullptr);
  ASSERT_TRUE(ensure_captures(*baking, options, gpu_log()).ok());
  EXPECT_EQ(baking->world.resource<ReflectionCaptures>().proxies.count, 1u);
  EXPECT_EQ(frame_of(*baking), frame_of(*plain));
}

TEST_F(SessionCaptures, do_not_depend_on_the_time_and_the_knobs_of_the_session) {
  const auto now = open();
  options.time_s = 0.8;
  options.assignments = {"shadows.mode=off"};
  const auto later = open();
  ASSERT_TRUE(now != nullptr && later != nullptr);
  EXPECT_EQ(capture_content(now->world), capture_content(later->world));
  const auto a = value_of(bake_scene(*now, options, gpu_log())), b = value_of(bake_scene(*later, options, gpu_log()));
  EXPECT_EQ(a.proxies.texels, b.proxies.texels);
}

TEST_F(SessionCaptures, beside_the_scene_go_before_the_cache_unless_they_are_of_another_state) {
  const auto session = open();
  ASSERT_TRUE(session != nullptr);
  ReflectionCaptures marked = value_of(bake_scene(*session, options, gpu_log()));
  marked.proxies.texels[0] = 0x1234;
  const std::string beside = captures_beside(options.scene);
  EXPECT_EQ(beside, folder.path() + "/swing.captures");
  ASSERT_TRUE(save_captures(beside, session->world, marked).ok());
  ASSERT_TRUE(ensure_captures(*session, options, gpu_log()).ok());
  EXPECT_EQ(session->world.resource<ReflectionCaptures>().proxies.texels[0], 0x1234);
  EXPECT_FALSE(std::filesystem::exists(options.cache_dir + "/captures"));

  marked.content += 1;
  ASSERT_TRUE(save_captures(beside, session->world, marked).ok());
  ASSERT_TRUE(ensure_captures(*session, options, gpu_log()).ok());
  EXPECT_NE(session->world.resource<ReflectionCaptures>().proxies.texels[0], 0x1234);
  EXPECT_TRUE(std::filesystem::exists(options.cache_dir + "/captures"));
}

TEST_F(SessionCaptures, are_not_made_where_nothing_reflects) {
  options.scene = folder.write("dull.gltf", scene_text(false));
  const auto session = open();
  ASSERT_TRUE(session != nullptr);
  ASSERT_TRUE(ensure_captures(*session, options, gpu_log()).ok());
  EXPECT_EQ(session->world.resource<ReflectionCaptures>().content, 0u);
}

}  // namespace
}  // namespace gloam::test

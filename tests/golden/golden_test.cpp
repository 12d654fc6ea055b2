// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "engine/scene/decoding/image_file.h"
#include "sandbox/output/pictures/image_io.h"
#include "sandbox/session/baking/particle_light.h"
#include "sandbox/session/session.h"
#include "tests/golden/whole_pictures.h"
#include "tests/support/gpu_device.h"

// Compares whole pictures with golden pictures. A golden picture changes only in a commit that says why. Each test
// writes the picture that it drew to golden/ in the build folder, to be checked and copied here.

namespace gloam::test {
namespace {

constexpr std::uint32_t kWidth = 320;
constexpr std::uint32_t kHeight = 180;

Options golden_options(const std::string& scene, const std::string& camera) {
  Options options;
  options.scene = scene;
  options.camera = camera;
  options.width = kWidth;
  options.height = kHeight;
  return options;
}

/// The picture of the last of these frames; fails the test on any error or validation message.
Picture draw(const Options& options, int frames = 1) {
  auto session = open_session_on(shared_test_device(), options, gpu_log());
  if (!session) {
    ADD_FAILURE() << session.error().message;
    return {};
  }
  Session& s = **session;
  EXPECT_TRUE(ensure_particle_light(s, options, gpu_log(), {}).ok());
  const ViewRequest request{s.view_settings(kWidth, kHeight, options.view), {}};
  for (int frame = 0; frame < frames; ++frame) {
    s.set_clock(options.time_s + frame * options.dt_s, options.dt_s);
    auto sample = s.render_frame(request);
    EXPECT_TRUE(sample.ok()) << sample.error().message;
  }
  auto picture = s.renderer->read_picture(request.settings.id);
  EXPECT_TRUE(picture.ok()) << picture.error().message;
  EXPECT_TRUE(s.check_validation().ok());
  return picture.ok() ? std::move(*picture) : Picture{};
}

std::vector<std::uint8_t> file_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Eight times the difference of each channel.
std::vector<std::uint8_t> difference_picture(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  std::vector<std::uint8_t> rgba(a.size(), 255);
  for (std::size_t i = 0; i < a.size(); ++i)
    if (i % 4 != 3) rgba[i] = static_cast<std::uint8_t>(std::min(8 * std::abs(a[i] - b[i]), 255));
  return rgba;
}

/// Compares the picture with tests/golden/NAME.png and writes it into the build folder; beside it, if they differ, a
/// difference picture. tolerance: root mean square of the encoded channels, 0…1. The default allows for differences in
/// rounding and edge coverage between devices. A wrong light, material or matrix exceeds it by far.
void expect_golden(const Picture& picture, const std::string& name, double tolerance = 0.01) {
  const std::filesystem::path folder = std::filesystem::path(GLOAM_BINARY_DIR) / "golden";
  std::filesystem::create_directories(folder);
  const std::string drawn = (folder / (name + ".png")).string();
  ASSERT_TRUE(write_png(drawn, picture.width, picture.height, picture.rgba).ok());
  const auto golden =
      decode_image(file_bytes(std::filesystem::path(GLOAM_SOURCE_DIR) / "tests/golden" / (name + ".png")));
  ASSERT_TRUE(golden.ok()) << golden.error().message << "; the drawn picture is " << drawn;
  ASSERT_EQ(golden->width, picture.width);
  ASSERT_EQ(golden->height, picture.height);
  const double difference = root_mean_square(picture.rgba, golden->rgba);
  const std::string differences = (folder / (name + "_difference.png")).string();
  std::filesystem::remove(differences);
  if (difference >= tolerance) {
    ASSERT_TRUE(
        write_png(differences, picture.width, picture.height, difference_picture(picture.rgba, golden->rgba)).ok());
  }
  EXPECT_LT(difference, tolerance) << "look at " << drawn << " and, eight times brighter, at " << differences;
}

class Golden : public testing::Test {
 protected:
  void SetUp() override {
    const auto& device = shared_test_device();
    GLOAM_REQUIRE_GPU(device);
    GLOAM_REQUIRE_DEPTH_TESTS(device);
  }
};

TEST_F(Golden, plain_looks_as_it_did) { expect_golden(draw(golden_options("builtin:plain", "")), "plain"); }

TEST_F(Golden, lanterns_look_as_they_did) {
  expect_golden(draw(golden_options("builtin:lanterns", "main")), "lanterns");
}

TEST_F(Golden, grass_that_wind_has_bent_looks_as_it_did) {
  Options options = golden_options("builtin:meadow", "near");
  options.time_s = 2.0;
  expect_golden(draw(options, 20), "meadow");
}

TEST_F(Golden, smoke_fire_and_dust_with_baked_light_look_as_they_did) {
  Options options = golden_options("builtin:smoke", "near");
  options.time_s = 4.0;
  expect_golden(draw(options), "smoke");
}

TEST_F(Golden, depth_of_field_looks_as_it_did) {
  for (const char* camera : {"round", "hexagonal"})
    expect_golden(draw(golden_options("builtin:lens", camera)), std::string("lens_") + camera);
}

class Courtyard : public Golden {
 protected:
  void SetUp() override {
    Golden::SetUp();
    if (!std::filesystem::exists(kScene)) GTEST_SKIP() << "the shared scene " << kScene << " is absent";
  }
  static constexpr const char* kScene = GLOAM_SHARED_DIR "/scenes/courtyard/courtyard.gltf";
};

// Hard case: selftest.twice
TEST_F(Courtyard, every_camera_draws_the_same_picture_twice) {
  for (const char* camera : {"court", "closeup", "lawn", "walkway", "down", "grazing"}) {
    Options options = golden_options(kScene, camera);
    const std::string name = camera;
    if (name != "court") options.assignments = {"shadows.mode=off"};  // shadows take most of the time
    EXPECT_EQ(draw(options).rgba, draw(options).rgba) << camera;
  }
}

// Hard case: selftest.tiled_brute
TEST_F(Courtyard, tiled_culling_draws_what_brute_force_draws) {
  for (const char* camera : {"court", "closeup", "walkway"}) {
    Options options = golden_options(kScene, camera);
    options.assignments = {"shadows.mode=off"};  // the shadow tests compare pictures with shadows
    const Picture tiled = draw(options);
    options.assignments.emplace_back("lights.culling=brute");
    EXPECT_EQ(tiled.rgba, draw(options).rgba) << camera;
  }
}

TEST_F(Courtyard, avatars_move_with_time) {
  Options options = golden_options(kScene, "closeup");
  options.assignments = {"shadows.mode=off"};
  const Picture first = draw(options);
  options.time_s = 0.5;
  EXPECT_GT(root_mean_square(first.rgba, draw(options).rgba), 0.005);
}

}  // namespace
}  // namespace gloam::test

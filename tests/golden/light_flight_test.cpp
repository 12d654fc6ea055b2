// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "sandbox/scenes/lamps/many_lights.h"
#include "tests/golden/flight.h"
#include "tests/golden/flight_path.h"
#include "tests/support/gpu_device.h"
#include "tests/support/scale.h"

// Tests light lists while the camera moves: the state that a frame takes from its predecessor (range of the zBins, size
// of the lists) must never change the picture.

namespace gloam::test {
namespace {

std::size_t differing_pixels(const Picture& a, const Picture& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4)
    count +=
        std::equal(a.rgba.begin() + static_cast<std::ptrdiff_t>(i), a.rgba.begin() + static_cast<std::ptrdiff_t>(i + 4),
                   b.rgba.begin() + static_cast<std::ptrdiff_t>(i))
            ? 0
            : 1;
  return count;
}

/// Flies once with brute force and once with light lists. Each frame must give the same picture.
void expect_flight_without_flicker(Session& session, std::span<const PathKey> keys, const FlightSize& size) {
  KnobRegistry& knobs = session.renderer->knobs();
  std::vector<Picture> brute;
  // Without shadows: map sizes have hysteresis, so the second flight may use other sizes than the first.
  ASSERT_TRUE(knobs.set("shadows.mode", "off").ok());
  // Without grass: it sways on from the first flight to the second.
  ASSERT_TRUE(knobs.set("grass.density_scale", "0").ok());
  ASSERT_TRUE(knobs.set("lights.culling", "brute").ok());
  Flight flight(session, keys, size);
  for (std::size_t frame = 0; frame < size.frames; ++frame) {
    auto picture = flight.draw(frame);
    ASSERT_TRUE(picture.ok()) << picture.error().message;
    brute.push_back(std::move(*picture));
  }
  ASSERT_TRUE(knobs.set("lights.culling", "tiled").ok());
  double most_lights = 0.0;
  for (std::size_t frame = 0; frame < size.frames; ++frame) {
    const bool checks = frame % size.check_every == 0;
    ASSERT_TRUE(knobs.set("lights.check", checks ? "on" : "off").ok());
    const auto picture = flight.draw(frame);
    ASSERT_TRUE(picture.ok()) << picture.error().message;
    ASSERT_EQ(differing_pixels(*picture, brute[frame]), 0u) << "frame " << frame;
    ASSERT_EQ(flight.counter("lights.capacity_violations"), 0.0) << "frame " << frame;
    ASSERT_EQ(flight.counter("lights.culling_errors"), 0.0) << "frame " << frame;
    ASSERT_TRUE(!checks || flight.counter("lights.local") == 0.0 || flight.counts("lights.culling_errors"))
        << "frame " << frame;
    most_lights = std::max(most_lights, flight.counter("lights.per_tile_accurate_mean"));
  }
  EXPECT_GT(most_lights, 4.0) << "lights a tile of the fullest frame: this flight saw nothing";
}

class LightFlight : public testing::Test {
 protected:
  void SetUp() override {
    const auto device = make_test_device(false);
    GLOAM_REQUIRE_GPU(device);
    GLOAM_REQUIRE_DEPTH_TESTS(device);
  }

  std::unique_ptr<Session> open(const std::string& scene) {
    Options options;
    options.scene = scene;
    auto session = open_session(options, gpu_log());
    EXPECT_TRUE(session.ok()) << session.error().message;
    return session.ok() ? std::move(*session) : nullptr;
  }
};

/// GLOAM_TEST_SCALE=2 flies through all 1024 lights, in a larger picture.
// Hard case: selftest.tiled_brute
TEST_F(LightFlight, each_of_300_frames_through_many_lights_equals_brute_force) {
  const auto session = open("builtin:many_lights");
  ASSERT_NE(session, nullptr);
  const auto lights = static_cast<std::size_t>(scaled(512));
  thin_out_lights(session->world, lights);
  expect_flight_without_flicker(
      *session, kManyLightsFlight,
      lights < 1024 ? FlightSize{} : FlightSize{.width = 160, .height = 90, .check_every = 1});
}

TEST_F(LightFlight, each_frame_through_the_courtyard_equals_brute_force) {
  const std::string scene = GLOAM_SHARED_DIR "/scenes/courtyard/courtyard-1024.gltf";
  if (!std::filesystem::exists(scene)) GTEST_SKIP() << "the shared scene " << scene << " is absent";
  const auto session = open(scene);
  ASSERT_NE(session, nullptr);
  const std::vector<PathKey> keys = path_through_cameras(session->world, session->info);
  expect_flight_without_flicker(*session, keys, {.frames = 40});
}

}  // namespace
}  // namespace gloam::test

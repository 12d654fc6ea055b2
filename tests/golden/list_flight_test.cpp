// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/golden/flight.h"
#include "tests/support/gpu_device.h"

// While the camera moves, every list of lights and shadows finds room from the first frame on: the CPU bounds what a
// frame can need, so no tile falls back to slower shading.

namespace gloam::test {
namespace {

class ListFlight : public testing::Test {
 protected:
  void SetUp() override {
    const auto device = make_test_device(false);
    GLOAM_REQUIRE_GPU(device);
    GLOAM_REQUIRE_DEPTH_TESTS(device);
  }

  static void expect_no_fallback(const std::string& scene) {
    Options options;
    options.scene = scene;
    auto opened = open_session(options, gpu_log());
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    Session& session = **opened;
    const std::vector<PathKey> keys = path_through_cameras(session.world, session.info);
    const FlightSize size{.width = 160, .height = 90, .frames = 120};
    Flight flight(session, keys, size);
    double most_slots = 0.0;
    for (std::size_t i = 0; i < size.frames; ++i) {
      const auto picture = flight.draw(i);
      ASSERT_TRUE(picture.ok()) << picture.error().message;
      ASSERT_EQ(flight.counter("shadows.fallback_tiles"), 0.0) << scene << ", frame " << i;
      ASSERT_EQ(flight.counter("lights.overflow_tiles"), 0.0) << scene << ", frame " << i;
      most_slots = std::max(most_slots, flight.counter("shadows.slots"));
    }
    EXPECT_GT(most_slots, 20.0) << "this flight saw no penumbra";
  }
};

TEST_F(ListFlight, of_120_frames_through_the_lanterns_has_no_fallback_tile) { expect_no_fallback("builtin:lanterns"); }

TEST_F(ListFlight, of_120_frames_through_many_lights_has_no_fallback_tile) {
  expect_no_fallback("builtin:many_lights");
}

}  // namespace
}  // namespace gloam::test

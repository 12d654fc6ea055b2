// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdint>

#include "tests/support/gpu_device.h"

namespace gloam::test {

/// Tests that draw whole pictures on the device that Stage::device() returns; null skips them. Every test must end
/// without validation messages.
template <class Stage>
class StageTest : public ::testing::Test {
 protected:
  void SetUp() override {
    GLOAM_REQUIRE_GPU(Stage::device());
    GLOAM_REQUIRE_DEPTH_TESTS(Stage::device());
    messages_ = Stage::device()->validation_messages();
  }
  void TearDown() override {
    if (Stage::device() != nullptr) {
      EXPECT_EQ(Stage::device()->validation_messages(), messages_);
    }
  }

 private:
  std::uint64_t messages_ = 0;
};

}  // namespace gloam::test

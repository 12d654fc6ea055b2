// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/jobs/executor.h"
#include "modules/glare/reference/glare_run.h"
#include "modules/glare/reference/spread_light.h"
#include "tests/support/gpu_device.h"

namespace gloam::test {

/// Runs the module's passes on a validated device.
class GlareKernelTest : public ::testing::Test {
 protected:
  void SetUp() override {
    GLOAM_REQUIRE_GPU(device());
    messages_ = device()->validation_messages();
  }
  void TearDown() override {
    if (device()) {
      EXPECT_EQ(device()->validation_messages(), messages_);
    }
  }
  [[nodiscard]] static std::vector<vec4> run(const GlareInput& in) {
    return value_of(run_glare(KernelLab(*device(), gpu_log()), in));
  }
  [[nodiscard]] static std::vector<dvec3> right(const GlareInput& in) {
    return spread_light(in.light, in.size, *make_serial_executor());
  }
  [[nodiscard]] static double energy(const std::vector<vec4>& light) {
    double sum = 0.0;
    for (const vec4& value : light) sum += static_cast<double>(value.x);
    return sum;
  }
  [[nodiscard]] static double energy(const std::vector<dvec3>& light) {
    double sum = 0.0;
    for (const dvec3& value : light) sum += value.x;
    return sum;
  }

 private:
  [[nodiscard]] static gpu::Device* device() {
    static const std::unique_ptr<gpu::Device> made = make_test_device(true);
    return made.get();
  }
  std::uint64_t messages_ = 0;
};

}  // namespace gloam::test

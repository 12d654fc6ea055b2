// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "modules/shadows/reference/planes_run.h"
#include "tests/support/kernel.h"

namespace gloam::test {

/// A PlaneRun. Any error fails the test.
class PlaneImages {
 public:
  static inline const vec4 kUnwritten = PlaneRun::kUnwritten;

  PlaneImages(gpu::Device& device, std::uint32_t atlas_size, gpu::Format format = gpu::Format::r32_float)
      : lab_(device, gpu_log()), run_(lab_) {
    expect(run_.start(atlas_size, format));
  }
  void draw(const std::vector<PlaneFace>& faces) { expect(run_.draw(faces)); }
  void make(const std::vector<PlanePart>& parts) { expect(run_.make(parts)); }
  void make(const std::vector<PlaneFace>& faces) { expect(run_.make(faces)); }
  [[nodiscard]] MadePlanes read() { return value_of(run_.read()); }

 private:
  static void expect(const Status& status) { EXPECT_TRUE(status.ok()) << status.error().message; }

  KernelLab lab_;
  PlaneRun run_;
};

}  // namespace gloam::test

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/modules/glare/support/glare_kernel.h"

namespace gloam::test {
namespace {

class GlarePictures : public GlareKernelTest {};

// Hard case: glare.sizes
TEST_F(GlarePictures, of_any_size_are_finite) {
  for (const uvec2 size : {uvec2(1, 1), uvec2(1, 50), uvec2(500, 1), uvec2(2, 3), uvec2(91, 89), uvec2(37, 211)}) {
    SCOPED_TRACE(std::to_string(size.x) + "x" + std::to_string(size.y));
    const GlareInput in(size, 1.0f);
    const std::vector<vec4> found = run(in);
    const std::vector<dvec3> expected = right(in);
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_TRUE(std::isfinite(found[i].x));
    }
    std::printf("%ux%u: energy %.4f\n", size.x, size.y, energy(found) / energy(expected));
  }
}

}  // namespace
}  // namespace gloam::test

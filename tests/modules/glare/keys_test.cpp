// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "modules/glare/components.h"
#include "tests/modules/keys/line_checks.h"
#include "tests/modules/keys/scene_format_looks.h"

namespace gloam::test {
namespace {

using enum KeyElement;

TEST(GlareKeys, are_these) {
  expect_key_lines("glare", {{camera_node,
                              "gloam.camera.glare",
                              "glare",
                              KeyType::number,
                              "%",
                              "2",
                              number(5),
                              {number(-0.1), number(20.1), text("much")},
                              field(&Glare::share, 0.05f)}});
}

TEST(GlareKeys, leave_cameras_without_one_at_two_percent) {
  EXPECT_EQ(Glare{}.share, 0.02f);
  EXPECT_EQ(DefaultGlare{}.share, 0.02f);
}

}  // namespace
}  // namespace gloam::test

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "modules/fog/components.h"
#include "tests/modules/shadows/support/final_lists/deferred_scene.h"

// shadows.mode=deferred draws the same picture as monolithic: with cookies, which need their own pipelines.

namespace gloam {
namespace {

using DeferredShadowsCookies = test::DeferredShadowsTest;

TEST_F(DeferredShadowsCookies, with_cookies_glass_and_fog_are_the_same) {
  for (const int cookies : {1, 4, 6}) {
    clear_scene();
    put_pillars();
    put_glass();
    put_light(point(0.05f), dvec3(0.4, 1.2, 1.1));
    put_cookies(cookies);
    expect_deferred_is_monolithic(std::to_string(cookies) + " cookies");
    EXPECT_EQ(lists().frames, 1u);
  }
  const Drawn clear = expect_deferred_is_monolithic("clear");
  things.push_back(world.create(Fog{0.15f, vec3(0.05f, 0.06f, 0.08f)}));
  EXPECT_NE(expect_deferred_is_monolithic("fog").picture.rgba, clear.picture.rgba);
}

}  // namespace
}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "modules/fog/components.h"
#include "tests/modules/keys/line_checks.h"
#include "tests/modules/keys/scene_format_looks.h"

namespace gloam::test {
namespace {

using enum KeyElement;

TEST(FogKeys, are_these) {
  expect_key_lines("fog", {{node,
                            "gloam.fog.density",
                            "fog",
                            KeyType::number,
                            "1/m",
                            "0",
                            number(0.02),
                            {number(-0.1), text("thick")},
                            field(&Fog::density, 0.02f)},
                           {node,
                            "gloam.fog.color",
                            "fog",
                            KeyType::vec3,
                            "cd/m²",
                            "[0, 0, 0]",
                            list({1, 2, 3}),
                            {list({1, 2}), list({-1, 0, 0})},
                            field(&Fog::color, vec3(1.0f, 2.0f, 3.0f))}});
}

}  // namespace
}  // namespace gloam::test

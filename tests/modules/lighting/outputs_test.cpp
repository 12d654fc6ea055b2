// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/outputs.h"

#include <gtest/gtest.h>

namespace gloam {
namespace {

TEST(DecodeDiffuseLight, takes_half_floats_from_the_low_bits_up) {
  // Half floats: 1 is 0x3C00, 2 is 0x4000, 65504 is 0x7BFF, 2^-24 is 0x0001.
  EXPECT_EQ(decode_diffuse_light({0x4000'3C00u, 0x3C00'7BFFu}), vec3(1.0f, 2.0f, 65504.0f));
  EXPECT_EQ(decode_diffuse_light({0x0000'0001u, 0x3C00'0000u}), vec3(5.9604644775390625e-8f, 0.0f, 0.0f));
}

}  // namespace
}  // namespace gloam

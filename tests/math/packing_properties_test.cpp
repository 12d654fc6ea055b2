// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <bit>

#include "engine/math/packing.h"
#include "tests/math/generators.h"
#include "tests/support/property.h"

namespace gloam {
namespace {

/// A float of any bit pattern, including denormals, infinities and all kinds of NaN.
float draw_bits() {
  return std::bit_cast<float>(*rc::gen::resize(rc::kNominalSize, rc::gen::arbitrary<std::uint32_t>()));
}

TEST(HalfProperties, no_half_is_nearer_than_the_one_chosen) {
  test::check_property(20000, [] {
    const float value = test::draw_index(2) == 0 ? draw_bits() : static_cast<float>(test::draw_length(-9.0, 5.5));
    const std::uint16_t half = float_to_half(value);
    RC_ASSERT(std::signbit(value) == ((half & 0x8000u) != 0));
    if (std::isnan(value)) {
      RC_ASSERT((half & 0x7fffu) > 0x7c00u);
      return;
    }
    const double magnitude = std::abs(static_cast<double>(value));
    const auto at = [](std::uint32_t bits) {  // infinity counts as 65536, one step above the greatest half
      return bits >= 0x7c00u ? 65536.0 : static_cast<double>(half_to_float(static_cast<std::uint16_t>(bits)));
    };
    const std::uint32_t chosen = half & 0x7fffu;
    RC_ASSERT(chosen <= 0x7c00u);
    if (magnitude >= 65536.0) {
      RC_ASSERT(chosen == 0x7c00u);
      return;
    }
    const double error = std::abs(at(chosen) - magnitude);
    if (chosen > 0) RC_ASSERT(error <= std::abs(at(chosen - 1) - magnitude));
    if (chosen < 0x7c00u) RC_ASSERT(error <= std::abs(at(chosen + 1) - magnitude));
  });
}

TEST(PackedNormalProperties, are_within_a_hundredth_of_a_degree) {
  test::check_property(20000, [] {
    const vec3 normal(test::draw_direction());
    const dvec3 unpacked(unpack_normal_snorm16(pack_normal_snorm16(normal)));
    RC_ASSERT(glm::length(glm::cross(unpacked, glm::normalize(dvec3(normal)))) < std::sin(0.01 * kPi / 180.0));
    RC_ASSERT(glm::dot(unpacked, dvec3(normal)) > 0.0);
  });
}

}  // namespace
}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/math/srgb.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace gloam {
namespace {

template <class T>
T srgb_decoded(T srgb) {
  return srgb <= T(0.04045) ? srgb / T(12.92) : std::pow((srgb + T(0.055)) / T(1.055), T(2.4));
}

template <class T>
T srgb_encoded(T linear) {
  return linear <= T(0.0031308) ? T(12.92) * linear : T(1.055) * std::pow(linear, T(1) / T(2.4)) - T(0.055);
}

}  // namespace

float srgb_to_linear(float srgb) { return srgb_decoded(srgb); }
double srgb_to_linear(double srgb) { return srgb_decoded(srgb); }
float linear_to_srgb(float linear) { return srgb_encoded(linear); }
double linear_to_srgb(double linear) { return srgb_encoded(linear); }

const std::array<float, 256>& linear_of_srgb() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = static_cast<float>(srgb_to_linear(static_cast<double>(i) / 255.0));
    return values;
  }();
  return table;
}

}  // namespace gloam

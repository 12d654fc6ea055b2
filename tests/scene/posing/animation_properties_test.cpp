// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/scene/posing/animation.h"
#include "tests/support/property.h"

namespace gloam {
namespace {

double whole(int low, int high) { return *rc::gen::inRange(low, high); }

dquat arbitrary_rotation() {
  const dquat raw(whole(-9, 10) + 0.5, whole(-9, 10), whole(-9, 10), whole(-9, 10));
  const double length = std::sqrt(raw.w * raw.w + raw.x * raw.x + raw.y * raw.y + raw.z * raw.z);
  return dquat(raw.w / length, raw.x / length, raw.y / length, raw.z / length);
}

long double dot4(const dquat& a, const dquat& b) {
  return static_cast<long double>(a.x) * b.x + static_cast<long double>(a.y) * b.y +
         static_cast<long double>(a.z) * b.z + static_cast<long double>(a.w) * b.w;
}

AnimationChannel arbitrary_channel(Interpolation interpolation) {
  const int keys = *rc::gen::inRange(1, 12);
  AnimationChannel channel{.path = AnimationPath::weights, .interpolation = interpolation, .width = 2};
  float time = static_cast<float>(whole(0, 5));
  const std::size_t per_key = 2 * (interpolation == Interpolation::cubic ? 3 : 1);
  for (int key = 0; key < keys; ++key) {
    channel.times.push_back(time);
    time += static_cast<float>(whole(1, 100)) / 16.0f;
    for (std::size_t i = 0; i < per_key; ++i) channel.values.push_back(static_cast<float>(whole(-100, 101)) / 8.0f);
  }
  return channel;
}

/// Oracle of sample_channel: walks over all keys in long double.
double oracle(const AnimationChannel& channel, double time, std::size_t component) {
  const bool cubic = channel.interpolation == Interpolation::cubic;
  const auto at = [&](std::size_t key, std::size_t part) {
    const std::size_t index = cubic ? (key * 3 + part) * channel.width : key * channel.width;
    return static_cast<long double>(channel.values[index + component]);
  };
  const std::size_t last = channel.times.size() - 1;
  if (time <= channel.times[0]) return static_cast<double>(at(0, 1));
  for (std::size_t key = 0; key < last; ++key) {
    if (!(time < channel.times[key + 1])) continue;
    const long double d = static_cast<long double>(channel.times[key + 1]) - channel.times[key];
    const long double u = (time - static_cast<long double>(channel.times[key])) / d;
    if (channel.interpolation == Interpolation::step) return static_cast<double>(at(key, 1));
    if (!cubic) return static_cast<double>(at(key, 1) + u * (at(key + 1, 1) - at(key, 1)));
    const long double v = 1.0L - u;  // Bernstein form of the same curve
    const long double c1 = at(key, 1) + d * at(key, 2) / 3.0L;
    const long double c2 = at(key + 1, 1) - d * at(key + 1, 0) / 3.0L;
    return static_cast<double>(v * v * v * at(key, 1) + 3.0L * u * v * v * c1 + 3.0L * u * u * v * c2 +
                               u * u * u * at(key + 1, 1));
  }
  return static_cast<double>(at(last, 1));
}

TEST(AnimationProperties, sampling_equals_the_oracle_at_any_time) {
  test::check_property(400, [] {
    const auto interpolation = *rc::gen::element(Interpolation::step, Interpolation::linear, Interpolation::cubic);
    const AnimationChannel channel = arbitrary_channel(interpolation);
    for (const double time : {whole(-32, 1000) / 16.0, double{channel.times[channel.times.size() / 2]}}) {
      std::vector<double> out(2);
      sample_channel(channel, time, out);
      for (std::size_t i = 0; i < 2; ++i) RC_ASSERT(std::abs(out[i] - oracle(channel, time, i)) < 1e-9);
    }
  });
}

TEST(AnimationProperties, slerp_is_unit_on_the_arc_and_even_in_angle) {
  test::check_property(600, [] {
    const dquat a = arbitrary_rotation();
    const dquat b = arbitrary_rotation();
    const double u = whole(0, 65) / 64.0;
    const dquat mixed = slerp_shortest(a, b, u);
    RC_ASSERT(std::abs(dot4(mixed, mixed) - 1.0L) < 1e-14L);
    // Shoemake's formula with acos: accurate if the rotations are well apart.
    const long double cosine = std::min(std::abs(dot4(a, b)), 1.0L);
    if (cosine > 0.99L) return;
    const long double angle = std::acos(cosine);
    RC_ASSERT(std::abs(std::abs(dot4(a, mixed)) - std::abs(std::cos(u * angle))) < 1e-12L);
    RC_ASSERT(std::abs(std::abs(dot4(b, mixed)) - std::abs(std::cos((1.0L - u) * angle))) < 1e-12L);
  });
}

TEST(AnimationProperties, looped_time_is_congruent_and_in_range) {
  test::check_property(600, [] {
    const double time = whole(-100000, 100001) / 64.0;
    const double duration = whole(1, 1000) / 64.0;  // in sixty-fourths, so that every step below is exact
    const double looped = looped_time(time, duration);
    RC_ASSERT(looped >= 0.0 && looped < duration);
    RC_ASSERT(std::fmod(time - looped, duration) == 0.0);
  });
}

}  // namespace
}  // namespace gloam

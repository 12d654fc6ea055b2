// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/posing/animation.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "engine/core/assert.h"

namespace gloam {
namespace {

/// Components of one part of a key. Cubic keys have three parts (in-tangent, value, out-tangent), others one.
std::span<const float> key_values(const AnimationChannel& channel, std::size_t key, std::size_t part) {
  const std::size_t parts = channel.interpolation == Interpolation::cubic ? 3 : 1;
  return std::span(channel.values).subspan((key * parts + part) * channel.width, channel.width);
}

std::span<const float> key_value(const AnimationChannel& channel, std::size_t key) {
  return key_values(channel, key, channel.interpolation == Interpolation::cubic ? 1 : 0);
}

dquat unit_or_identity(const dquat& q) {
  const double length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (!(length > 0.0)) return dquat(1.0, 0.0, 0.0, 0.0);
  return dquat(q.w / length, q.x / length, q.y / length, q.z / length);
}

dquat to_quat(std::span<const float> xyzw) {
  return unit_or_identity(dquat(double{xyzw[3]}, double{xyzw[0]}, double{xyzw[1]}, double{xyzw[2]}));
}

void store_quat(const dquat& q, std::span<double> out) {
  out[0] = q.x;
  out[1] = q.y;
  out[2] = q.z;
  out[3] = q.w;
}

/// Cubic Hermite spline between keys `key` and `key + 1`, which are `seconds` apart. Tangents are per second, so they
/// are multiplied by `seconds`.
void sample_cubic(const AnimationChannel& channel, std::size_t key, double u, double seconds, std::span<double> out) {
  const auto value0 = key_values(channel, key, 1);
  const auto tangent0 = key_values(channel, key, 2);
  const auto tangent1 = key_values(channel, key + 1, 0);
  const auto value1 = key_values(channel, key + 1, 1);
  const double u2 = u * u;
  const double u3 = u2 * u;
  const double weight_value1 = 3.0 * u2 - 2.0 * u3;
  const double weight_tangent0 = (u3 - 2.0 * u2 + u) * seconds;
  const double weight_tangent1 = (u3 - u2) * seconds;
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = (1.0 - weight_value1) * double{value0[i]} + weight_tangent0 * double{tangent0[i]} +
             weight_tangent1 * double{tangent1[i]} + weight_value1 * double{value1[i]};
  }
}

}  // namespace

double looped_time(double time_s, double duration_s) {
  if (!(duration_s > 0.0)) return 0.0;
  const double remainder = std::fmod(time_s, duration_s);
  if (remainder >= 0.0) return remainder;
  const double from_end = remainder + duration_s;
  return from_end < duration_s ? from_end : 0.0;  // a tiny negative remainder rounds up to the duration itself
}

dquat slerp_shortest(const dquat& a, const dquat& b, double u) {
  const double cosine = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
  const double sign = cosine < 0.0 ? -1.0 : 1.0;
  const dvec4 from(a.x, a.y, a.z, a.w);
  const dvec4 to = sign * dvec4(b.x, b.y, b.z, b.w);
  // The angle from chord lengths: acos(cosine) loses half its digits if the rotations are nearly equal.
  const double angle = 2.0 * std::atan2(glm::length(to - from), glm::length(to + from));
  const double sine = std::sin(angle);
  const bool tiny = angle < 1.0e-6;  // sin(x)/x = 1 to the last digit
  const double weight_from = tiny ? 1.0 - u : std::sin((1.0 - u) * angle) / sine;
  const double weight_to = tiny ? u : std::sin(u * angle) / sine;
  const dvec4 mixed = weight_from * from + weight_to * to;
  return unit_or_identity(dquat(mixed.w, mixed.x, mixed.y, mixed.z));
}

void sample_channel(const AnimationChannel& channel, double time_s, std::span<double> out) {
  const bool cubic = channel.interpolation == Interpolation::cubic;
  const bool rotation = channel.path == AnimationPath::rotation;
  GLOAM_ASSERT(out.size() == channel.width, "a channel is sampled into exactly `width` values");
  GLOAM_ASSERT(!rotation || channel.width == 4, "a rotation has four components");
  GLOAM_ASSERT(!channel.times.empty(), "a channel has at least one key");
  GLOAM_ASSERT(channel.values.size() == channel.times.size() * channel.width * (cubic ? 3 : 1),
               "a channel has `width` values a key, three times as many when cubic");

  const auto& times = channel.times;
  // Keys are floats and the time is a double: the comparison must not round the time.
  const auto next =
      std::upper_bound(times.begin(), times.end(), time_s, [](double t, float key) { return t < double{key}; });
  const std::size_t key = next == times.begin() ? 0 : static_cast<std::size_t>(next - times.begin()) - 1;
  const bool is_constant = next == times.begin() || next == times.end() || channel.interpolation == Interpolation::step;
  if (is_constant) {
    std::ranges::copy(key_value(channel, key), out.begin());
  } else {
    const double begin = double{times[key]};
    const double seconds = double{times[key + 1]} - begin;
    const double u = (time_s - begin) / seconds;
    if (cubic) {
      sample_cubic(channel, key, u, seconds, out);
    } else if (rotation) {
      store_quat(slerp_shortest(to_quat(key_value(channel, key)), to_quat(key_value(channel, key + 1)), u), out);
    } else {
      const auto a = key_value(channel, key);
      const auto b = key_value(channel, key + 1);
      for (std::size_t i = 0; i < out.size(); ++i) out[i] = (1.0 - u) * double{a[i]} + u * double{b[i]};
    }
  }
  if (rotation) store_quat(unit_or_identity(dquat(out[3], out[0], out[1], out[2])), out);
}

void bind_animations(std::span<const AnimationClip> clips, const SceneNodes& nodes, AnimationBindings& bindings) {
  bindings.poses.clear();
  bindings.weights.clear();
  std::unordered_set<std::uint64_t> taken;
  for (std::uint32_t clip = 0; clip < clips.size(); ++clip) {
    const auto& channels = clips[clip].channels;
    for (std::uint32_t index = 0; index < channels.size(); ++index) {
      const AnimationChannel& channel = channels[index];
      const Entity entity = nodes.find(channel.node);
      if (entity == kNoEntity) continue;
      const std::uint64_t target = (std::uint64_t{channel.node} << 2) | static_cast<std::uint64_t>(channel.path);
      if (!taken.insert(target).second) continue;
      auto& list = channel.path == AnimationPath::weights ? bindings.weights : bindings.poses;
      list.push_back({entity, clip, index});
    }
  }
}

}  // namespace gloam

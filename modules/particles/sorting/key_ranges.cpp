// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/sorting/key_ranges.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "engine/core/assert.h"

namespace gloam {

std::vector<KeyRange> key_ranges(std::span<const VisibleEmitter> emitters, std::uint32_t keys) {
  GLOAM_ASSERT(emitters.size() <= keys, "every emitter needs a sort key");
  std::vector<std::size_t> order(emitters.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    return emitters[a].far_m != emitters[b].far_m ? emitters[a].far_m > emitters[b].far_m : a < b;
  });
  struct Cloud {
    double near_m, far_m;
  };
  std::vector<Cloud> clouds;
  std::vector<std::size_t> cloud_of(emitters.size());
  for (const std::size_t i : order) {
    const VisibleEmitter& emitter = emitters[i];
    if (clouds.empty() || emitter.far_m < clouds.back().near_m) clouds.push_back({emitter.near_m, emitter.far_m});
    clouds.back().near_m = std::min(clouds.back().near_m, emitter.near_m);
    cloud_of[i] = clouds.size() - 1;
  }
  std::vector<KeyRange> ranges(emitters.size());
  for (std::size_t i = 0; i < emitters.size(); ++i) {
    const Cloud& cloud = clouds[cloud_of[i]];
    KeyRange& range = ranges[i];
    range.count = keys / static_cast<std::uint32_t>(clouds.size());
    range.first = static_cast<std::uint32_t>(cloud_of[i]) * range.count;
    range.far_m = cloud.far_m;
    range.keys_per_m = range.count / std::max(cloud.far_m - cloud.near_m, 1e-6);
  }
  return ranges;
}

}  // namespace gloam

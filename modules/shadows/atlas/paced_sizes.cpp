// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/atlas/paced_sizes.h"

#include <algorithm>
#include <vector>

namespace gloam {
namespace {

std::uint64_t texels_at(const PacedLight& light, std::uint32_t size) {
  return std::uint64_t{light.faces} * size * size;
}

bool shrinks(const PacedLight& light) { return light.wanted < light.held; }

}  // namespace

std::uint32_t pace_sizes(std::span<PacedLight> lights, std::uint64_t room, bool fill) {
  std::uint64_t wanted = 0, drawn = 0, placed = 0;
  std::vector<PacedLight*> candidates;
  for (PacedLight& light : lights) {
    light.size = light.wanted;
    wanted += texels_at(light, light.wanted);
    if (light.wanted == light.held || light.wanted == 0) {
      placed += texels_at(light, light.wanted);
    } else if (light.held == 0 && !fill) {
      drawn += texels_at(light, light.wanted);
      placed += texels_at(light, light.wanted);
    } else {
      placed += texels_at(light, light.held);
      candidates.push_back(&light);
    }
  }
  if (wanted > room || candidates.empty()) return 0;
  std::ranges::stable_sort(candidates, [](const PacedLight* a, const PacedLight* b) {
    if (shrinks(*a) != shrinks(*b)) return shrinks(*a);
    return a->importance > b->importance;
  });
  std::uint32_t waiting = 0;
  bool any = false;
  for (PacedLight* light : candidates) {
    const std::uint64_t before = texels_at(*light, light->held), after = texels_at(*light, light->wanted);
    const bool in_share = drawn + after <= wanted / kPacedFrames && placed - before + after <= room;
    if (in_share || !any) {
      any = true;
      drawn += after;
      placed += after - before;
    } else {
      light->size = light->held;
      waiting += light->faces;
    }
  }
  return waiting;
}

}  // namespace gloam

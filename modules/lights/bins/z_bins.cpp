// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// zBins: FF §2.1.1 (figures 2 and 3). Builds both sets in time linear in lights plus bins, for any light range.
#include "modules/lights/bins/z_bins.h"

#include <algorithm>
#include <cmath>

#include "engine/core/assert.h"
#include "modules/lights/cpu_clones.h"

namespace gloam {
namespace {

/// Relative rounding error that the bins allow for: of a view depth on the GPU (reconstructed as near / value with a
/// few roundings of 2^-24 each), and of the bin computed from it.
constexpr float kRounding = 0x1p-21f;

/// First and last bin of each light's depth interval, widened by kRounding. NaN gives bin 0 as first bin and the last
/// bin as last bin.
GLOAM_CPU_CLONES void find_bins(const LightDepth* lights, std::size_t count, float near_m, float scale, float last,
                                std::uint16_t* first_bins, std::uint16_t* last_bins) {
  for (std::size_t i = 0; i < count; ++i) {
    const float low = (lights[i].nearest - near_m) * scale;
    const float high = (lights[i].farthest - near_m) * scale;
    const float begin = low - kRounding * (std::abs(low) + std::abs(lights[i].nearest) * scale);
    const float end = high + kRounding * (std::abs(high) + std::abs(lights[i].farthest) * scale);
    const float from_first = begin > 0.0f ? begin : 0.0f;
    const float to_last = end < last ? end : last;
    first_bins[i] = static_cast<std::uint16_t>(static_cast<std::int32_t>(from_first < last ? from_first : last));
    last_bins[i] = static_cast<std::uint16_t>(static_cast<std::int32_t>(to_last > 0.0f ? to_last : 0.0f));
  }
}

/// Lights are numbered from 1. Number 0 means no light; its last bin is 0xFFFF, which ends every search.
struct Reach {
  std::span<std::uint16_t> last_bin;  ///< last bin each light touches
  std::span<std::uint16_t> earlier;   ///< next light to test below each light; every light between the two has ended
};

/// The last light up to `light` that reaches the bin. Callers must ask for bins in ascending order: a light that has
/// ended stays ended, so the search shortens the links it followed (path compression).
std::uint32_t last_reaching(const Reach& reach, std::uint32_t light, std::uint32_t bin) {
  std::uint32_t found = light;
  while (reach.last_bin[found] < bin) found = reach.earlier[found];
  while (light != found) {
    const std::uint32_t next = reach.earlier[light];
    reach.earlier[light] = static_cast<std::uint16_t>(found);
    light = next;
  }
  return found;
}

/// Begins: bin k begins with the first light whose last bin is at least k. That light also reaches farther than every
/// light before it.
void fill_begins(std::span<const std::uint16_t> first_bins, const Reach& reach, std::span<ZBin> standard) {
  std::uint32_t covered = 0;  // every bin below has its begin, or no light reaches it
  for (std::uint32_t light = 1; light <= first_bins.size(); ++light) {
    const std::uint32_t end = reach.last_bin[light] + 1u;
    if (end <= covered) continue;
    for (std::uint32_t k = std::max<std::uint32_t>(covered, first_bins[light - 1]); k < end; ++k)
      standard[k].begin = static_cast<std::uint16_t>(light - 1);
    covered = end;
  }
}

/// Ends: the last light that reaches bin k, among the lights that begin at or before bin k. `started`: scratch, one
/// item per bin.
void fill_ends(std::span<const std::uint16_t> first_bins, const Reach& reach, std::span<std::uint16_t> started,
               std::span<ZBin> standard) {
  std::fill(started.begin(), started.end(), std::uint16_t{0});
  for (std::size_t i = 0; i < first_bins.size(); ++i) started[first_bins[i]] = static_cast<std::uint16_t>(i + 1);
  std::uint16_t last = 0;
  for (std::uint32_t k = 0; k < standard.size(); ++k) {
    last = std::max(last, started[k]);
    const bool reaches = reach.last_bin[last] >= k;  // nearly always true where lights are dense
    standard[k].end = static_cast<std::uint16_t>(reaches ? last : last_reaching(reach, last, k));
  }
}

void fill_ranged(std::span<const ZBin> standard, std::span<ZBin> ranged) {
  std::uint16_t end = 0;
  for (std::size_t k = 0; k < standard.size(); ++k) ranged[k].end = end = std::max(end, standard[k].end);
  std::uint16_t begin = 0xFFFF;
  for (std::size_t k = standard.size(); k-- > 0;) ranged[k].begin = begin = std::min(begin, standard[k].begin);
}

}  // namespace

std::uint32_t z_bin_of(float depth_m, const ZBinParams& params) {
  const float bin = (depth_m - params.near_m) * params.scale();
  if (!(bin > 0.0f)) return 0;
  return bin < static_cast<float>(params.count) ? std::min(static_cast<std::uint32_t>(bin), params.count - 1)
                                                : params.count - 1;
}

void build_z_bins(std::span<const LightDepth> lights, const ZBinParams& params, ZBinScratch& scratch,
                  std::span<ZBin> standard, std::span<ZBin> ranged) {
  GLOAM_ASSERT(params.count >= 1 && params.count <= 0xFFFF, "there are 1 to 65535 zBins");
  GLOAM_ASSERT(standard.size() == params.count && ranged.size() == params.count, "both sets have an item a zBin");
  GLOAM_ASSERT(lights.size() <= 0xFFFF, "zBins count lights with 16 bits");
  const std::size_t count = lights.size();
  scratch.first_bin.resize(count);
  scratch.last_bin.resize(count + 1);
  scratch.earlier.resize(count + 1);
  scratch.last_bin[0] = 0xFFFF;
  find_bins(lights.data(), count, params.near_m, params.scale(), static_cast<float>(params.count - 1),
            scratch.first_bin.data(), scratch.last_bin.data() + 1);
  auto first = static_cast<std::uint16_t>(params.count - 1);
  for (std::size_t i = count; i-- > 0;) {
    // Sorted lights have ascending first bins. The minimum over all later lights enforces that even if a light is out
    // of order or NaN.
    scratch.first_bin[i] = first = std::min(first, scratch.first_bin[i]);
    scratch.last_bin[i + 1] = std::max(first, scratch.last_bin[i + 1]);
    scratch.earlier[i + 1] = static_cast<std::uint16_t>(i);
  }
  std::fill(standard.begin(), standard.end(), ZBin{});
  const Reach reach{scratch.last_bin, scratch.earlier};
  fill_begins(scratch.first_bin, reach, standard);
  scratch.started.resize(params.count);
  fill_ends(scratch.first_bin, reach, scratch.started, standard);
  fill_ranged(standard, ranged);
}

void build_z_bins(std::span<const LightDepth> lights, const ZBinParams& params, std::span<ZBin> standard,
                  std::span<ZBin> ranged) {
  ZBinScratch scratch;
  build_z_bins(lights, params, scratch, standard, ranged);
}

ZBin z_bin_range(const ZBins& bins, float nearest_m, float farthest_m) {
  const std::uint32_t first = z_bin_of(nearest_m, bins.params);
  const std::uint32_t last = z_bin_of(farthest_m, bins.params);
  if (last <= first + 1) {
    const ZBin a = bins.bins[first];
    const ZBin b = bins.bins[last];
    return {std::min(a.begin, b.begin), std::max(a.end, b.end)};
  }
  return {bins.bins[bins.params.count + first].begin, bins.bins[bins.params.count + last].end};
}

}  // namespace gloam

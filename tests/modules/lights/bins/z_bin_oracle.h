// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "modules/lights/bins/z_bins.h"

/// Brute-force oracle of zBins, in double.
namespace gloam::test {

/// Sorts by nearest depth; stable.
inline void sort_lights(std::vector<LightDepth>& lights) {
  std::stable_sort(lights.begin(), lights.end(),
                   [](const LightDepth& a, const LightDepth& b) { return a.nearest < b.nearest; });
}

[[nodiscard]] inline ZBins built(const std::vector<LightDepth>& lights, const ZBinParams& params) {
  ZBins bins;
  bins.params = params;
  bins.bins.assign(std::size_t{2} * params.count, ZBin{3, 3});
  const std::span<ZBin> all(bins.bins);
  build_z_bins(lights, params, all.first(params.count), all.subspan(params.count));
  return bins;
}

[[nodiscard]] inline bool contains(const ZBin& bin, std::uint32_t light) {
  return bin.begin <= light && light < bin.end;
}

/// The bin of a depth without any rounding.
[[nodiscard]] inline std::uint32_t exact_bin(double depth, const ZBinParams& params) {
  const double width = (static_cast<double>(params.far_m) - static_cast<double>(params.near_m)) / params.count;
  const double at = std::floor((depth - static_cast<double>(params.near_m)) / width);
  return static_cast<std::uint32_t>(std::clamp(at, 0.0, params.count - 1.0));
}

/// An error text if a light is not found at one of its depths, else empty. The bin of the depth must hold the light,
/// also if the depth is off by GPU rounding (four steps of a float), and whether the bin is computed in floats or
/// exactly.
[[nodiscard]] inline std::string missed_at(const ZBins& bins, std::uint32_t light, double depth) {
  for (const double off : {0.0, 4.0, -4.0}) {
    const double seen = std::max(depth * (1.0 + off * 5.96e-8), static_cast<double>(bins.params.near_m));
    for (const std::uint32_t k : {z_bin_of(static_cast<float>(seen), bins.params), exact_bin(seen, bins.params)}) {
      if (k < bins.params.count && contains(bins.bins[k], light)) continue;
      return "light " + std::to_string(light) + " is not in bin " + std::to_string(k) + " of depth " +
             std::to_string(seen);
    }
  }
  return {};
}

inline void expect_found(const ZBins& bins, std::uint32_t light, float depth) {
  EXPECT_EQ(missed_at(bins, light, static_cast<double>(depth)), "");
}

/// Depths of a light to test: its ends, some between, and the centres and edges of the bins it reaches.
[[nodiscard]] inline std::vector<double> depths_of(const LightDepth& light, const ZBinParams& params,
                                                   std::mt19937& random) {
  const double nearest = light.nearest;
  const double farthest = std::min(static_cast<double>(light.farthest), 1e30);
  std::vector<double> depths = {nearest, farthest};
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < 4; ++i) depths.push_back(nearest + share(random) * (farthest - nearest));
  const double width = (static_cast<double>(params.far_m) - static_cast<double>(params.near_m)) / params.count;
  const std::uint32_t first = exact_bin(nearest, params);
  const std::uint32_t last = exact_bin(farthest, params);
  const std::uint32_t step = 1 + (last - first) / 16;
  for (std::uint32_t k = first; k <= last; k += step) {
    const double edge = static_cast<double>(params.near_m) + k * width;
    for (const double depth : {edge, edge + 0.5 * width})
      if (depth >= nearest && depth <= farthest) depths.push_back(depth);
  }
  return depths;
}

/// The first fault of both sets, or empty. Checks that every depth of every light finds it; that a bin holds no light
/// farther away than rounding allows (a thousandth of a bin plus 1e-5 of the depth); that the ranged set follows from
/// the standard one; and that every pair of depths finds every light between them.
[[nodiscard]] inline std::string fault_of(const ZBins& bins, const std::vector<LightDepth>& lights) {
  const ZBinParams& params = bins.params;
  std::mt19937 random(static_cast<std::uint32_t>(lights.size()));
  for (std::uint32_t i = 0; i < lights.size(); ++i)
    for (const double depth : depths_of(lights[i], params, random))
      if (std::string missed = missed_at(bins, i, depth); !missed.empty()) return missed;

  const double width = (static_cast<double>(params.far_m) - static_cast<double>(params.near_m)) / params.count;
  for (std::uint32_t k = 0; k < params.count; ++k) {
    const ZBin& bin = bins.bins[k];
    const std::string name = "bin " + std::to_string(k);
    if (bin == ZBin{}) continue;
    if (bin.begin >= bin.end || bin.end > lights.size()) return name + " has no order";
    const double low = static_cast<double>(params.near_m) + k * width;
    const double slack = 1e-3 * width + 1e-5 * (low + width);
    // The first and the last light of a bin must touch it.
    for (const std::uint32_t end : {std::uint32_t{bin.begin}, std::uint32_t{bin.end} - 1u}) {
      const bool before = k > 0 && static_cast<double>(lights[end].farthest) < low - slack;
      const bool behind = k + 1 < params.count && static_cast<double>(lights[end].nearest) > low + width + slack;
      if (before || behind) return name + " holds light " + std::to_string(end) + ", which does not touch it";
    }
  }

  for (std::uint32_t k = 0; k < params.count; ++k) {
    ZBin expected{};
    for (std::uint32_t j = k; j < params.count; ++j) expected.begin = std::min(expected.begin, bins.bins[j].begin);
    for (std::uint32_t j = 0; j <= k; ++j) expected.end = std::max(expected.end, bins.bins[j].end);
    if (bins.bins[params.count + k] != expected)
      return "ranged bin " + std::to_string(k) + " does not follow from the standard ones";
    if (params.count > 1024 && k % 7 != 0) k += 6;  // the check is quadratic in the number of bins
  }

  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < 200 && !lights.empty(); ++i) {
    const auto some_depth = [&] {
      const LightDepth& l = lights[random() % lights.size()];
      const double at =
          share(random) < 0.5
              ? static_cast<double>(l.nearest) +
                    share(random) * (std::min(1e9, static_cast<double>(l.farthest)) - static_cast<double>(l.nearest))
              : static_cast<double>(params.near_m) + share(random) * static_cast<double>(params.far_m);
      return static_cast<float>(std::max(at, static_cast<double>(params.near_m)));
    };
    float a = some_depth();
    float b = some_depth();
    if (a > b) std::swap(a, b);
    const ZBin found = z_bin_range(bins, a, b);
    for (std::uint32_t light = 0; light < lights.size(); ++light)
      if (lights[light].nearest <= b && lights[light].farthest >= a && !contains(found, light))
        return "light " + std::to_string(light) + " is not found between " + std::to_string(a) + " and " +
               std::to_string(b);
    const std::uint32_t first = z_bin_of(a, params);
    const std::uint32_t last = z_bin_of(b, params);
    ZBin expected{bins.bins[params.count + first].begin, bins.bins[params.count + last].end};
    if (last - first <= 1)
      expected = {std::min(bins.bins[first].begin, bins.bins[last].begin),
                  std::max(bins.bins[first].end, bins.bins[last].end)};
    const bool both_empty = expected.begin >= expected.end && found.begin >= found.end;
    if (found != expected && !both_empty)
      return "the range from " + std::to_string(a) + " to " + std::to_string(b) + " is another";
  }
  return {};
}

inline ZBins expect_right_bins(const std::vector<LightDepth>& lights, const ZBinParams& params) {
  ZBins bins = built(lights, params);
  EXPECT_EQ(fault_of(bins, lights), "") << lights.size() << " lights, " << params.count << " bins of " << params.near_m
                                        << "…" << params.far_m << " m";
  return bins;
}

}  // namespace gloam::test

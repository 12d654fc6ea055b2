// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gloam {

/// View depths a local light's bound covers: metres, nearest ≤ farthest, nearest not before the near plane.
struct LightDepth {
  float nearest = 0.0f;
  float farthest = 0.0f;
};

/// `count` uniform bins over [near_m, far_m]; what lies beyond folds into the last one. 0 < near_m < far_m, count ≥ 1.
struct ZBinParams {
  float near_m = 0.1f;
  float far_m = 100.0f;
  std::uint32_t count = 1024;
  [[nodiscard]] float scale() const { return static_cast<float>(count) / (far_m - near_m); }  ///< bins a metre
};

/// Sorted lights [begin, end) of a bin; (0xFFFF, 0) when there is none. As the GPU reads it: begin | end << 16.
struct ZBin {
  std::uint16_t begin = 0xFFFF;
  std::uint16_t end = 0;
  bool operator==(const ZBin&) const = default;
};

/// What the zBins of a view are to be made from besides its lights; a view resource.
struct ZBinSettings {
  std::uint32_t count = 1024;
  float farthest_opaque_m = 0.0f;  ///< view depth of the farthest opaque surface of the view's last frame; 0: unknown
};

/// Memory that building zBins keeps from one time to the next.
struct ZBinScratch {
  std::vector<std::uint16_t> first_bin;
  std::vector<std::uint16_t> last_bin;
  std::vector<std::uint16_t> earlier;
  std::vector<std::uint16_t> started;
};

/// Both sets of a view; a view resource.
struct ZBins {
  ZBinParams params;
  std::vector<ZBin> bins;   ///< params.count of the standard set, then as many of the ranged one
  std::uint64_t lists = 0;  ///< VisibleLights::version they were made from
  ZBinScratch scratch;
};

/// The bin of a view depth, as the GPU computes it.
[[nodiscard]] std::uint32_t z_bin_of(float depth_m, const ZBinParams& params);

/// `lights`: ordered by nearest depth, at most 65535. Standard: of every bin the lights whose interval touches it,
/// widened so that no rounding of a depth on the GPU finds a bin without its light. Ranged: begin = least begin of this
/// and all later bins, end = greatest end of this and all earlier ones. Both spans have params.count items.
void build_z_bins(std::span<const LightDepth> lights, const ZBinParams& params, std::span<ZBin> standard,
                  std::span<ZBin> ranged);

/// The same without allocating, once `scratch` has served as many lights.
void build_z_bins(std::span<const LightDepth> lights, const ZBinParams& params, ZBinScratch& scratch,
                  std::span<ZBin> standard, std::span<ZBin> ranged);

/// Lights that may touch depths between two view depths: of the standard set when both lie in one bin or two
/// neighbouring ones, else of the ranged set. nearest_m ≤ farthest_m.
[[nodiscard]] ZBin z_bin_range(const ZBins& bins, float nearest_m, float farthest_m);

}  // namespace gloam

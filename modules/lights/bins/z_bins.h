// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gloam {

/// View depths that a local light's bound covers, in metres. near plane ≤ nearest ≤ farthest.
struct LightDepth {
  float nearest = 0.0f;
  float farthest = 0.0f;
};

/// `count` uniform bins over [near_m, far_m]; depths beyond far_m fall into the last bin. 0 < near_m < far_m, count ≥
/// 1.
struct ZBinParams {
  float near_m = 0.1f;
  float far_m = 100.0f;
  std::uint32_t count = 1024;
  [[nodiscard]] float scale() const { return static_cast<float>(count) / (far_m - near_m); }  ///< bins per metre
};

/// The sorted lights [begin, end) of a bin; (0xFFFF, 0) when it is empty. GPU layout: begin | end << 16.
struct ZBin {
  std::uint16_t begin = 0xFFFF;
  std::uint16_t end = 0;
  bool operator==(const ZBin&) const = default;
};

/// Inputs of a view's zBins other than its lights; a view resource.
struct ZBinSettings {
  std::uint32_t count = 1024;
  float farthest_opaque_m = 0.0f;  ///< view depth of the farthest opaque surface in the view's last frame; 0: unknown
};

/// Scratch memory of build_z_bins, reused between calls.
struct ZBinScratch {
  std::vector<std::uint16_t> first_bin;
  std::vector<std::uint16_t> last_bin;
  std::vector<std::uint16_t> earlier;
  std::vector<std::uint16_t> started;
};

/// The standard and the ranged set of a view; a view resource.
struct ZBins {
  ZBinParams params;
  std::vector<ZBin> bins;   ///< params.count bins of the standard set, then params.count of the ranged set
  std::uint64_t lists = 0;  ///< VisibleLights::version the bins were built from
  ZBinScratch scratch;
};

/// The bin of a view depth, computed as on the GPU.
[[nodiscard]] std::uint32_t z_bin_of(float depth_m, const ZBinParams& params);

/// Builds both sets. `lights`: sorted by nearest depth, at most 65535. Standard set: each bin holds the lights whose
/// depth interval touches it, widened so that a depth rounded on the GPU never falls into a bin that lacks its light.
/// Ranged set: begin = least begin of this and all later bins, end = greatest end of this and all earlier bins. Both
/// spans have params.count items (1…65535).
void build_z_bins(std::span<const LightDepth> lights, const ZBinParams& params, std::span<ZBin> standard,
                  std::span<ZBin> ranged);

/// The same. Does not allocate once `scratch` has been used with as many lights and bins.
void build_z_bins(std::span<const LightDepth> lights, const ZBinParams& params, ZBinScratch& scratch,
                  std::span<ZBin> standard, std::span<ZBin> ranged);

/// The lights that may touch view depths nearest_m…farthest_m: from the standard set when both depths lie in the same
/// bin or in neighbouring bins, otherwise from the ranged set. nearest_m ≤ farthest_m.
[[nodiscard]] ZBin z_bin_range(const ZBins& bins, float nearest_m, float farthest_m);

}  // namespace gloam

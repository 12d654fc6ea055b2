// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/assert.h"
#include "engine/gpu/types.h"

/// Ranges of mips and layers, and values that are kept for each of them.
namespace gloam::gpu {

/// Replaces counts of 0 by actual counts. Asserts that the range lies inside an image of `mips` × `layers`.
[[nodiscard]] inline ImageRange resolve(const ImageRange& range, std::uint32_t mips, std::uint32_t layers) {
  GLOAM_ASSERT(range.first_mip < mips && range.first_layer < layers, "a range begins inside its image");
  ImageRange whole = range;
  if (whole.mip_count == 0) whole.mip_count = mips - range.first_mip;
  if (whole.layer_count == 0) whole.layer_count = layers - range.first_layer;
  GLOAM_ASSERT(whole.mip_count <= mips - range.first_mip && whole.layer_count <= layers - range.first_layer,
               "a range ends inside its image");
  return whole;
}
[[nodiscard]] inline ImageRange resolve(const ImageRange& range, const ImageDesc& desc) {
  return resolve(range, desc.mips, desc.layers);
}

/// Whether two resolved ranges of one image have a mip of a layer in common.
[[nodiscard]] constexpr bool overlap(const ImageRange& a, const ImageRange& b) {
  return a.first_mip < b.first_mip + b.mip_count && b.first_mip < a.first_mip + a.mip_count &&
         a.first_layer < b.first_layer + b.layer_count && b.first_layer < a.first_layer + a.layer_count;
}

/// " mips 1+2 layers 0+6"; empty for the default range.
[[nodiscard]] inline std::string text_of(const ImageRange& range) {
  std::string text;
  const auto add = [&](const char* what, std::uint32_t first, std::uint32_t count) {
    if (first == 0 && count == 0) return;
    text += std::string(" ") + what + " " + std::to_string(first) + "+" + std::to_string(count);
  };
  add("mips", range.first_mip, range.mip_count);
  add("layers", range.first_layer, range.layer_count);
  return text;
}

/// One value for each mip of each layer of an image. While all are equal, one value is stored. T has ==.
template <class T>
class Subresources {
 public:
  Subresources() = default;
  Subresources(std::uint32_t mips, std::uint32_t layers) : mips_(mips), layers_(layers) {}

  [[nodiscard]] ImageRange all() const { return {0, mips_, 0, layers_}; }
  /// Calls function(const T&) for the values in the range, in order of mips, then layers; once if all are equal.
  template <class Function>
  void visit(const ImageRange& range, Function&& function) const {
    if (parts_.empty()) return function(whole_);
    for_each_index(range, [&](std::size_t i) { function(parts_[i]); });
  }
  /// Calls function(T&) for the values in the range. A range of all values that are equal is one call.
  template <class Function>
  void update(const ImageRange& range, Function&& function) {
    const bool everything = range == all();
    if (everything && parts_.empty()) return function(whole_);
    if (parts_.empty()) parts_.assign(std::size_t{mips_} * layers_, whole_);
    for_each_index(range, [&](std::size_t i) { function(parts_[i]); });
    if (!everything || std::adjacent_find(parts_.begin(), parts_.end(), std::not_equal_to<>()) != parts_.end()) return;
    whole_ = parts_.front();
    parts_.clear();
  }
  void set(const ImageRange& range, const T& value) {
    update(range, [&](T& old) { old = value; });
  }

 private:
  template <class Function>
  void for_each_index(const ImageRange& range, Function&& function) const {
    for (std::uint32_t m = 0; m < range.mip_count; ++m) {
      for (std::uint32_t l = 0; l < range.layer_count; ++l) {
        function(std::size_t{range.first_mip + m} * layers_ + range.first_layer + l);
      }
    }
  }

  std::uint32_t mips_ = 1;
  std::uint32_t layers_ = 1;
  T whole_ = {};
  std::vector<T> parts_;  ///< by mip, then layer; empty: all values are whole_
};

}  // namespace gloam::gpu

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/math/types.h"
#include "modules/shadows/outputs.h"

namespace gloam {

/// Names a face: a light and which of its faces.
struct FaceKey {
  Entity light;
  std::uint32_t index = 0;
  bool operator==(const FaceKey&) const = default;
};

struct FaceKeyHash {
  std::size_t operator()(const FaceKey& key) const noexcept {
    return (std::hash<Entity>()(key.light) * 8 + key.index) * std::size_t{0x9E3779B97F4A7C15u};
  }
};

/// What a face asks for.
struct FaceRequest {
  FaceKey key;
  std::uint32_t size = 0;   ///< texels, a power of two from GLOAM_SHADOW_SMALLEST_FACE to the atlas' side
  float importance = 0.0f;  ///< ≥ 0
};

/// What a request got, in the order of the requests.
struct FacePlaces {
  std::vector<AtlasSquare> squares;
  std::uint32_t shrunk = 0;    ///< faces that got less than they asked for
  std::uint32_t left_out = 0;  ///< faces that got nothing
};

/// Squares of an atlas in which nothing lies.
class FreeSquares {
 public:
  FreeSquares() = default;
  /// size: of the atlas. `taken` do not overlap.
  FreeSquares(std::uint32_t size, std::span<const AtlasSquare> taken);
  /// A square of this size out of the smallest free place that holds one; size 0 when none does. For several or none:
  /// take from a copy.
  [[nodiscard]] AtlasSquare take(std::uint32_t size);

 private:
  /// Blocks in Z order by size, from the smallest face's on.
  std::vector<std::vector<std::uint32_t>> free_;
};

/// Places faces in a square of texels. A face keeps its square while it asks for the same size and nothing has to
/// shrink. When not all fit, the least important halve, ties the last one first, until all do: each halves once before
/// any halves again. At the smallest size the least important are left out. Faces of one light that follow each other
/// and ask for the same at the same importance are one: they halve and go together. When free texels lie too scattered
/// for a new face, the smaller ones of the emptiest place make way for it. Deterministic: the same calls give the same
/// squares.
class ShadowAtlas {
 public:
  /// size: texels of a side, a power of two, at least the smallest face. Another size forgets all places. No two
  /// requests have one key.
  [[nodiscard]] FacePlaces place(std::uint32_t size, std::span<const FaceRequest> requests);
  [[nodiscard]] std::uint32_t size() const { return size_; }
  /// Texels that are taken.
  [[nodiscard]] std::uint64_t used_texels() const { return used_texels_; }
  /// What is left: nothing that is placed moves, and nothing is placed by looking.
  [[nodiscard]] FreeSquares free_squares() const;

 private:
  void remember(std::span<const FaceRequest> requests, std::span<const AtlasSquare> squares);

  std::uint32_t size_ = 0;
  std::uint64_t used_texels_ = 0;
  std::unordered_map<FaceKey, AtlasSquare, FaceKeyHash> places_;
};

}  // namespace gloam

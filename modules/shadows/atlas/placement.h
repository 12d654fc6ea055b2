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

/// Identifies a face: a light, the face's index and, if the face belongs to one of several views that share an atlas
/// (a cascade), that view.
struct FaceKey {
  Entity light;
  std::uint32_t index = 0;
  std::uint32_t view = 0;  ///< number of the view + 1; 0: of all views
  bool operator==(const FaceKey&) const = default;
};

struct FaceKeyHash {
  std::size_t operator()(const FaceKey& key) const noexcept {
    return ((std::hash<Entity>()(key.light) * 8 + key.index) * std::size_t{0x9E3779B97F4A7C15u}) ^ key.view;
  }
};

/// A face that needs a place.
struct FaceRequest {
  FaceKey key;
  std::uint32_t size = 0;   ///< texels, a power of two from GLOAM_SHADOW_SMALLEST_FACE to the atlas' side
  float importance = 0.0f;  ///< ≥ 0
};

/// Chooses the side of an atlas by what the faces of each frame ask for.
class AtlasSide {
 public:
  /// Texels of the side for a frame with these requests: the smallest power of two that holds them (twice their texels,
  /// if `spare`), at most `most`. Grows at once, and shrinks after kFramesKept frames that needed less.
  [[nodiscard]] std::uint32_t next(std::span<const FaceRequest> requests, bool spare, std::uint32_t most);
  static constexpr std::uint32_t kFramesKept = 120;
  static constexpr std::uint32_t kLeast = 256;  ///< texels

 private:
  std::uint32_t side_ = 0;
  std::uint32_t frames_too_large_ = 0;
};

/// The places of the requests.
struct FacePlaces {
  std::vector<AtlasSquare> squares;  ///< in the order of the requests; size 0: no place
  std::uint32_t shrunk = 0;          ///< faces with a smaller square than requested
  std::uint32_t left_out = 0;        ///< faces without a square
};

/// The free squares of an atlas.
class FreeSquares {
 public:
  FreeSquares() = default;
  /// size: texels of the atlas' side. taken: occupied squares that do not overlap.
  FreeSquares(std::uint32_t size, std::span<const AtlasSquare> taken);
  /// Takes a square of this size (a power of two) out of the smallest free square that can hold it. If none can, takes
  /// nothing and returns a square of size 0. To test without taking, or to take several squares or none, call it on a
  /// copy.
  [[nodiscard]] AtlasSquare take(std::uint32_t size);

 private:
  /// By size, from the smallest face's up: numbers of free blocks, which count squares of that size in Z order.
  std::vector<std::vector<std::uint32_t>> free_;
};

/// Places faces in an atlas. A face keeps its square while its requested size stays the same and nothing has to shrink.
/// If not all faces fit, they halve one by one until they fit: the least important first, and of equally important ones
/// the last request first. No face halves again before every face has halved once. If all have the smallest size and
/// still do not fit, the least important get no square. Adjacent requests of one light with equal size and importance
/// form a group that halves, or is left out, as a whole. If the free texels are too scattered for a face, the smaller
/// faces in the emptiest block of its size move elsewhere. Deterministic: the same calls give the same squares.
class ShadowAtlas {
 public:
  /// Places all faces of a frame. size: texels of the atlas' side, a power of two, at least the smallest face; a
  /// different size than in the last call forgets all places. No two requests may have the same key.
  [[nodiscard]] FacePlaces place(std::uint32_t size, std::span<const FaceRequest> requests);
  [[nodiscard]] std::uint32_t size() const { return size_; }
  /// The square of a face; size 0: it has none.
  [[nodiscard]] AtlasSquare square_of(const FaceKey& face) const;
  /// Texels of all placed faces.
  [[nodiscard]] std::uint64_t used_texels() const { return used_texels_; }
  /// The free squares. Placed faces stay where they are.
  [[nodiscard]] FreeSquares free_squares() const;

 private:
  void remember(std::span<const FaceRequest> requests, std::span<const AtlasSquare> squares);

  std::uint32_t size_ = 0;
  std::uint64_t used_texels_ = 0;
  std::unordered_map<FaceKey, AtlasSquare, FaceKeyHash> places_;
};

}  // namespace gloam

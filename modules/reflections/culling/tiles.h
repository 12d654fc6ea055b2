// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/jobs/executor.h"
#include "engine/math/view_projection.h"
#include "modules/reflections/culling/placed.h"

namespace gloam {

inline constexpr std::uint32_t kMostProxyTiles = 64;

/// How the screen range of a reflected proxy is bounded.
enum class ProxyTileBound : std::uint8_t {
  exact,  ///< volume of all mirror images, clipped exactly; never misses a hit
  paper,  ///< algorithm 1.1 at the lowest reflecting height; may miss hits
};
[[nodiscard]] constexpr std::string_view name_of(ProxyTileBound bound) {
  switch (bound) {
    case ProxyTileBound::exact:
      return "exact";
    case ProxyTileBound::paper:
      return "paper";
  }
  return {};
}

/// A view resource; equality decides whether the tiles are built again.
struct ProxyTileSettings {
  std::uint32_t tiles = 16;  ///< vertical screen tiles, 1…kMostProxyTiles
  ProxyTileBound bound = ProxyTileBound::exact;
  std::uint32_t columns = 0;  ///< width of the reflection image in pixels; 0: half the view's width, rounded up
  friend bool operator==(const ProxyTileSettings&, const ProxyTileSettings&) = default;
};

/// The result of culling a proxy in a view. Proxies with an earlier outcome are not tested for the later ones.
enum class ProxyOutcome : std::uint8_t { kept, other_room, faces_away, out_of_view };

/// The proxies that each vertical tile of the screen may reflect; a view resource written by system proxy_tiles.
struct ProxyTiles {
  std::vector<std::uint32_t> rooms;    ///< the camera's rooms: indices into ProxySet::rooms; empty: outside all rooms
  std::vector<ProxyOutcome> outcomes;  ///< of each proxy of the ProxySet
  std::vector<std::uint32_t> proxies;  ///< kept ones: indices into ProxySet::proxies, ascending
  std::uint32_t tiles = 0;
  std::uint32_t columns = 0;         ///< width of the reflection image in pixels
  std::uint32_t words_per_tile = 0;  ///< ceil(proxies.size() / 32)
  /// words_per_tile words per tile, from the left. Bit i % 32 of word i / 32: the tile may reflect proxies[i]. Bits
  /// beyond the last proxy are 0.
  std::vector<std::uint32_t> masks;
  std::uint64_t version = 0;  ///< changes whenever the tiles are built

  std::uint64_t set_version = 0;         ///< ProxySet::version the tiles were built from
  ProxyTileSettings settings;            ///< settings they were built with
  ViewProjection view;                   ///< view they were built for
  std::vector<std::uint64_t> tile_sets;  ///< scratch: bit t of each proxy of the ProxySet: tile t may reflect it

  [[nodiscard]] std::uint32_t count(ProxyOutcome outcome) const;
  [[nodiscard]] bool may_reflect(std::uint32_t tile, std::uint32_t kept_index) const {
    return (masks[tile * words_per_tile + kept_index / 32] >> (kept_index % 32) & 1u) != 0;
  }
};

/// Tile of a pixel column of the reflection image. column < columns.
[[nodiscard]] constexpr std::uint32_t proxy_tile_of(std::uint32_t column, std::uint32_t columns, std::uint32_t tiles) {
  return static_cast<std::uint32_t>(std::uint64_t{column} * tiles / columns);
}

/// Chooses the camera's rooms, culls proxies and builds the masks of all tiles. settings.tiles outside
/// 1…kMostProxyTiles asserts.
///
/// With ProxyTileBound::exact, a proxy is in the mask of a pixel's tile if the pixel's reflected ray can hit its front:
/// the receiver has an up normal, is beyond the near plane, and its height is in a band of receiver_bands(). The bound
/// is one column of the reflection image wider on each side, so pixels may be taken anywhere in their column.
///
/// The result does not depend on the executor. Allocates only when there are more proxies than in any call before.
void build_proxy_tiles(const ProxySet& set, const ViewProjection& view, const ProxyTileSettings& settings,
                       JobExecutor& executor, ProxyTiles& tiles);

}  // namespace gloam

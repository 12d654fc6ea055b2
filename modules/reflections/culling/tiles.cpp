// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/culling/tiles.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/core/assert.h"
#include "modules/reflections/culling/reflected_quad.h"
#include "modules/reflections/culling/rooms.h"

namespace gloam {
namespace {

constexpr std::size_t kProxyGrain = 32;  // proxies per job

/// Bits of the tiles that hold a column of the range, widened by one column on each side.
std::uint64_t tiles_of(const ScreenRange& range, std::uint32_t columns, std::uint32_t tiles) {
  if (range.empty()) return 0;
  const double last_column = static_cast<double>(columns) - 1.0;
  const auto column_at = [&](double x) { return std::floor((x + 1.0) * 0.5 * static_cast<double>(columns)); };
  const double first = column_at(range.min) - 1.0;
  const double last = column_at(range.max) + 1.0;
  if (last < 0.0 || first > last_column) return 0;
  const auto tile_at = [&](double column) {
    return proxy_tile_of(static_cast<std::uint32_t>(std::clamp(column, 0.0, last_column)), columns, tiles);
  };
  const std::uint32_t begin = tile_at(first);
  const std::uint32_t count = tile_at(last) - begin + 1;
  return (~std::uint64_t{0} >> (64 - count)) << begin;
}

/// State that the jobs of one call share.
struct TileJob {
  const ProxySet& set;
  ReflectionViewer viewer;
  ProxyTiles& out;

  void run(JobRange range) const {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      out.tile_sets[i] = 0;
      out.outcomes[i] = place(set.proxies[i], out.tile_sets[i]);
    }
  }

 private:
  [[nodiscard]] ProxyOutcome place(const PlacedProxy& proxy, std::uint64_t& tile_set) const {
    const ReceiverBands bands = receiver_bands(proxy, set.rooms, out.rooms, viewer.eye, set.unit);
    if (bands.count == 0) return ProxyOutcome::other_room;
    bool faces = false;
    double lowest = bands.bands[0].lowest_m;
    for (const ReceiverBand& band : bands.all()) {
      lowest = std::min(lowest, band.lowest_m);
      if (!may_face_viewer(proxy, band, viewer)) continue;
      faces = true;
      tile_set |= tiles_of(exact_screen_range(reflected_volume(proxy, band, viewer), viewer), out.columns, out.tiles);
    }
    if (!faces) return ProxyOutcome::faces_away;
    if (tile_set == 0) return ProxyOutcome::out_of_view;
    if (out.settings.bound == ProxyTileBound::exact) return ProxyOutcome::kept;
    // Culling stays exact, so the two bounds differ in the tiles alone.
    tile_set = tiles_of(paper_screen_range(proxy, lowest + kReceiverSlack * set.unit, viewer), out.columns, out.tiles);
    return tile_set == 0 ? ProxyOutcome::out_of_view : ProxyOutcome::kept;
  }
};

void build_masks(ProxyTiles& tiles) {
  tiles.proxies.clear();
  for (std::size_t i = 0; i < tiles.outcomes.size(); ++i)
    if (tiles.outcomes[i] == ProxyOutcome::kept) tiles.proxies.push_back(static_cast<std::uint32_t>(i));
  tiles.words_per_tile = static_cast<std::uint32_t>((tiles.proxies.size() + 31) / 32);
  tiles.masks.assign(std::size_t{tiles.tiles} * tiles.words_per_tile, 0);
  for (std::size_t i = 0; i < tiles.proxies.size(); ++i) {
    for (std::uint64_t left = tiles.tile_sets[tiles.proxies[i]]; left != 0; left &= left - 1)
      tiles.masks[static_cast<std::size_t>(std::countr_zero(left)) * tiles.words_per_tile + i / 32] |= 1u << (i % 32);
  }
}

}  // namespace

std::uint32_t ProxyTiles::count(ProxyOutcome outcome) const {
  return static_cast<std::uint32_t>(std::ranges::count(outcomes, outcome));
}

void build_proxy_tiles(const ProxySet& set, const ViewProjection& view, const ProxyTileSettings& settings,
                       JobExecutor& executor, ProxyTiles& tiles) {
  GLOAM_ASSERT(settings.tiles >= 1 && settings.tiles <= kMostProxyTiles, "a screen has 1 to kMostProxyTiles tiles");
  tiles.settings = settings;
  tiles.tiles = settings.tiles;
  tiles.columns = settings.columns != 0 ? settings.columns : (view.width + 1) / 2;
  tiles.outcomes.resize(set.proxies.size());
  tiles.tile_sets.resize(set.proxies.size());
  choose_rooms(set.rooms, view.position, tiles.rooms, set.unit);
  const TileJob job{set, reflection_viewer(view), tiles};
  executor.parallel_for(set.proxies.size(), kProxyGrain, [&job](JobRange range) { job.run(range); });
  build_masks(tiles);
}

}  // namespace gloam

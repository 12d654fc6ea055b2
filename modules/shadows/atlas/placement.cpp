// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Places faces in an atlas. Squares with power-of-two sides fit into a square with a power-of-two side if the sum of
// their areas fits, provided that the largest are placed first. So shrink_to_fit() chooses sizes by summing areas, and
// FacePlacer then finds places, from the largest size down. Blocks of a size are numbered in Z order: the quarters of
// block b are blocks 4b … 4b + 3 of the next smaller size.
#include "modules/shadows/atlas/placement.h"

#include <algorithm>
#include <array>
#include <bit>

#include "engine/core/assert.h"
#include "shaders/shadows/shadows_shared.h"

namespace gloam {
namespace {

constexpr std::uint32_t kSmallest = GLOAM_SHADOW_SMALLEST_FACE;
constexpr std::uint32_t kMostLevels = 16;  // sizes from kSmallest on

std::uint64_t area(std::uint32_t size) { return std::uint64_t{size} * size; }

std::uint32_t level_of(std::uint32_t size) { return static_cast<std::uint32_t>(std::bit_width(size / kSmallest)) - 1; }

/// Spreads the low 16 bits of v: bit i moves to bit 2 i.
std::uint32_t spread_place_bits(std::uint32_t v) {
  v = (v | v << 8) & 0x00FF00FFu;
  v = (v | v << 4) & 0x0F0F0F0Fu;
  v = (v | v << 2) & 0x33333333u;
  return (v | v << 1) & 0x55555555u;
}

std::uint32_t gather_bits(std::uint32_t v) {
  v &= 0x55555555u;
  v = (v | v >> 1) & 0x33333333u;
  v = (v | v >> 2) & 0x0F0F0F0Fu;
  v = (v | v >> 4) & 0x00FF00FFu;
  return (v | v >> 8) & 0x0000FFFFu;
}

std::uint32_t block_of(const AtlasSquare& square) {
  return spread_place_bits(square.origin.x / square.size) | spread_place_bits(square.origin.y / square.size) << 1;
}

AtlasSquare square_of(std::uint32_t block, std::uint32_t size) {
  return {uvec2(gather_bits(block), gather_bits(block >> 1)) * size, size};
}

/// Adjacent requests that are shrunk or left out together.
struct PlacedGroup {
  std::size_t first = 0;
  std::uint32_t count = 0;
  std::uint32_t size = 0;
  float importance = 0.0f;

  [[nodiscard]] std::uint64_t texels() const { return count * area(size); }
};

std::vector<PlacedGroup> group_faces(std::uint32_t atlas_size, std::span<const FaceRequest> requests) {
  std::vector<PlacedGroup> groups;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const FaceRequest& face = requests[i];
    GLOAM_ASSERT(std::has_single_bit(face.size) && face.size >= kSmallest,
                 "a face's size is a power of two from the smallest on");
    const float importance = face.importance > 0.0f ? face.importance : 0.0f;
    const bool joins = i > 0 && requests[i - 1].key.light == face.key.light && requests[i - 1].size == face.size &&
                       groups.back().importance == importance;
    if (joins) {
      ++groups.back().count;
    } else {
      groups.push_back({i, 1, std::min(face.size, atlas_size), importance});
    }
  }
  return groups;
}

/// Shrinks groups until all fit. Size 0: left out.
void shrink_to_fit(std::uint32_t atlas_size, std::vector<PlacedGroup>& groups) {
  std::uint64_t texels = 0;
  for (const PlacedGroup& group : groups) texels += group.texels();
  if (texels <= area(atlas_size)) return;

  std::vector<PlacedGroup*> order;
  for (PlacedGroup& group : groups) order.push_back(&group);
  std::sort(order.begin(), order.end(), [](const PlacedGroup* a, const PlacedGroup* b) {
    return a->importance != b->importance ? a->importance < b->importance : a->first > b->first;
  });
  const auto resize = [&](PlacedGroup& group, std::uint32_t size) {
    texels -= group.texels();
    group.size = size;
    texels += group.texels();
  };
  for (bool halved = true; halved;) {
    halved = false;
    for (PlacedGroup* group : order) {
      if (group->size == kSmallest) continue;
      resize(*group, group->size / 2);
      if (texels <= area(atlas_size)) return;
      halved = true;
    }
  }
  for (PlacedGroup* group : order) {
    resize(*group, 0);
    if (texels <= area(atlas_size)) return;
  }
}

/// Finds squares for faces around others that keep theirs.
class FacePlacer {
 public:
  FacePlacer(std::uint32_t atlas_size, std::span<AtlasSquare> squares) : top_(level_of(atlas_size)), squares_(squares) {
    GLOAM_ASSERT(top_ < kMostLevels, "an atlas' side is at most 2^15 of the smallest face's");
  }

  /// Adds a face. squares[face].size must be set; placed: its origin is set too, and is kept if possible.
  void add(std::size_t face, bool placed) {
    const std::uint32_t level = level_of(squares_[face].size);
    (placed ? kept_ : waiting_)[level].push_back(static_cast<std::uint32_t>(face));
  }

  void run() {
    count_used();
    std::vector<std::uint32_t> open{0};  // blocks without faces so far, ascending
    for (std::uint32_t level = top_;; --level) {
      take_kept(level, open);
      place_waiting(level, open);
      if (level == 0) return;
      std::vector<std::uint32_t> quarters;
      quarters.reserve(open.size() * 4);
      for (const std::uint32_t block : open)
        for (std::uint32_t quarter = 0; quarter < 4; ++quarter) quarters.push_back(block * 4 + quarter);
      open = std::move(quarters);
    }
  }

 private:
  /// Counts, per block, the smallest-size blocks that belong to smaller faces with places to keep.
  void count_used() {
    for (std::uint32_t level = 0; level <= top_; ++level) used_[level].assign(std::size_t{1} << 2 * (top_ - level), 0);
    for (std::uint32_t level = 0; level < top_; ++level) {
      for (const std::uint32_t face : kept_[level]) {
        const std::uint32_t block = block_of(squares_[face]);
        for (std::uint32_t l = level + 1; l <= top_; ++l) used_[l][block >> 2 * (l - level)] += 1u << 2 * level;
      }
    }
  }

  /// Takes the blocks of faces that keep their squares from `open`. A face whose block is taken by a larger face must
  /// wait.
  void take_kept(std::uint32_t level, std::vector<std::uint32_t>& open) {
    if (kept_[level].empty()) return;
    std::vector<std::uint8_t> is_open(used_[level].size(), 0);
    for (const std::uint32_t block : open) is_open[block] = 1;
    for (const std::uint32_t face : kept_[level]) {
      std::uint8_t& own = is_open[block_of(squares_[face])];
      if (own == 0) waiting_[level].push_back(face);
      own = 0;
    }
    std::erase_if(open, [&](std::uint32_t block) { return is_open[block] == 0; });
    std::sort(waiting_[level].begin(), waiting_[level].end());
  }

  /// Places waiting faces in the emptiest open blocks, in block order among equals.
  void place_waiting(std::uint32_t level, std::vector<std::uint32_t>& open) {
    const std::vector<std::uint32_t>& waiting = waiting_[level];
    if (waiting.empty()) return;
    GLOAM_ASSERT(waiting.size() <= open.size(), "faces whose areas fit have places");
    const std::vector<std::uint32_t>& used = used_[level];
    const auto first_used =
        std::stable_partition(open.begin(), open.end(), [&](std::uint32_t block) { return used[block] == 0; });
    if (static_cast<std::size_t>(first_used - open.begin()) < waiting.size()) {
      std::stable_sort(first_used, open.end(), [&](std::uint32_t a, std::uint32_t b) { return used[a] < used[b]; });
    }
    for (std::size_t i = 0; i < waiting.size(); ++i) squares_[waiting[i]] = square_of(open[i], kSmallest << level);
    open.erase(open.begin(), open.begin() + static_cast<std::ptrdiff_t>(waiting.size()));
    std::sort(open.begin(), open.end());
  }

  std::uint32_t top_;
  std::span<AtlasSquare> squares_;
  std::array<std::vector<std::uint32_t>, kMostLevels> kept_, waiting_;  // faces by level
  std::array<std::vector<std::uint32_t>, kMostLevels> used_;
};

/// A block as a range of smallest-size blocks.
struct BlockStretch {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

/// Adds the largest free blocks inside a block. taken: occupied ranges inside it, ascending.
void add_free(std::uint32_t level, std::uint32_t block, std::span<const BlockStretch> taken,
              std::vector<std::vector<std::uint32_t>>& free) {
  if (taken.empty()) return free[level].push_back(block);
  const auto begin_of = [](std::uint32_t b, std::uint32_t l) { return b << 2 * l; };
  if (taken.front().begin == begin_of(block, level) && taken.front().end == begin_of(block + 1, level)) return;
  GLOAM_ASSERT(level > 0, "squares of an atlas do not overlap");
  for (std::uint32_t quarter = block * 4; quarter < block * 4 + 4; ++quarter) {
    const auto past = std::partition_point(taken.begin(), taken.end(), [&](const BlockStretch& stretch) {
      return stretch.begin < begin_of(quarter + 1, level - 1);
    });
    add_free(level - 1, quarter, {taken.begin(), past}, free);
    taken = {past, taken.end()};
  }
}

}  // namespace

std::uint32_t AtlasSide::next(std::span<const FaceRequest> requests, bool spare, std::uint32_t most) {
  std::uint64_t texels = 0;
  std::uint32_t needed = kLeast;
  for (const FaceRequest& request : requests) {
    texels += area(request.size) * (spare ? 2 : 1);
    needed = std::max(needed, request.size);
  }
  needed = std::min(needed, most);
  while (area(needed) < texels && needed < most) needed *= 2;
  frames_too_large_ = needed < side_ && side_ <= most ? frames_too_large_ + 1 : 0;
  if (needed > side_ || side_ > most || frames_too_large_ > kFramesKept) {
    side_ = needed;
    frames_too_large_ = 0;
  }
  return side_;
}

FreeSquares::FreeSquares(std::uint32_t size, std::span<const AtlasSquare> taken) {
  GLOAM_ASSERT(std::has_single_bit(size) && size >= kSmallest && level_of(size) < kMostLevels,
               "an atlas' side is a power of two, at least the smallest face's");
  std::vector<BlockStretch> stretches;
  for (const AtlasSquare& square : taken) {
    const std::uint32_t level = level_of(square.size), block = block_of(square);
    stretches.push_back({block << 2 * level, (block + 1) << 2 * level});
  }
  std::sort(stretches.begin(), stretches.end(),
            [](const BlockStretch& a, const BlockStretch& b) { return a.begin < b.begin; });
  free_.resize(level_of(size) + 1);
  add_free(level_of(size), 0, stretches, free_);
}

AtlasSquare FreeSquares::take(std::uint32_t size) {
  const std::uint32_t wanted = level_of(size);
  std::uint32_t level = wanted;
  while (level < free_.size() && free_[level].empty()) ++level;
  if (level >= free_.size()) return {};
  std::uint32_t block = free_[level].back();
  free_[level].pop_back();
  for (; level > wanted; --level, block *= 4)
    for (std::uint32_t quarter = 3; quarter > 0; --quarter) free_[level - 1].push_back(block * 4 + quarter);
  return square_of(block, size);
}

AtlasSquare ShadowAtlas::square_of(const FaceKey& face) const {
  const auto found = places_.find(face);
  return found == places_.end() ? AtlasSquare{} : found->second;
}

FreeSquares ShadowAtlas::free_squares() const {
  if (size_ == 0) return {};
  std::vector<AtlasSquare> taken;
  taken.reserve(places_.size());
  for (const auto& [key, square] : places_) taken.push_back(square);
  return {size_, taken};
}

FacePlaces ShadowAtlas::place(std::uint32_t size, std::span<const FaceRequest> requests) {
  GLOAM_ASSERT(std::has_single_bit(size) && size >= kSmallest,
               "an atlas' side is a power of two, at least the smallest face's");
  if (size != size_) places_.clear();
  size_ = size;
  std::vector<PlacedGroup> groups = group_faces(size, requests);
  shrink_to_fit(size, groups);

  FacePlaces result;
  result.squares.resize(requests.size());
  FacePlacer placer(size, result.squares);
  bool changed = false;
  std::size_t count = 0;
  for (const PlacedGroup& group : groups) {
    if (group.size == 0) {
      result.left_out += group.count;
      continue;
    }
    if (group.size < requests[group.first].size) result.shrunk += group.count;
    count += group.count;
    for (std::size_t i = group.first; i < group.first + group.count; ++i) {
      const auto found = places_.find(requests[i].key);
      const bool placed = found != places_.end() && found->second.size == group.size;
      result.squares[i] = placed ? found->second : AtlasSquare{uvec2(0), group.size};
      placer.add(i, placed);
      changed = changed || !placed;
    }
  }
  if (changed) placer.run();
  if (changed || count != places_.size()) remember(requests, result.squares);
  return result;
}

void ShadowAtlas::remember(std::span<const FaceRequest> requests, std::span<const AtlasSquare> squares) {
  places_.clear();
  used_texels_ = 0;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    if (squares[i].size == 0) continue;
    const bool fresh = places_.emplace(requests[i].key, squares[i]).second;
    GLOAM_ASSERT(fresh, "no two faces have one key");
    used_texels_ += area(squares[i].size);
  }
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/growth/patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "engine/core/assert.h"
#include "modules/grass/growth/random.h"
#include "modules/grass/growth/spatial_split.h"

namespace gloam {
namespace {

constexpr std::uint32_t kBladesOfPatch = GLOAM_GRASS_PATCH_BLADES;
constexpr std::uint32_t kCellGroups = 4;  // groups that share a cell of neighbours
constexpr double kFullTurn = 2.0 * 3.14159265358979323846;
constexpr double kSlaveYaw = 0.1;  // radians, greatest difference from the master
constexpr double kWidthVariation = 0.25;
constexpr double kStoutVariation = 0.1;  // of the width over the length, among masters
constexpr double kAlike = 0.98;          // correlation of the lengths of a master and its slaves
constexpr double kShortest = 0.25;       // times the mean length
constexpr double kLongest = 2.0;

/// Purposes of random numbers.
enum : std::uint32_t { kTypeNumbers = 1, kLookNumbers = 2, kRankNumbers = 3 };

/// Order of `count` neighbours in which any first part of them is spread evenly: van der Corput's sequence.
void spread_order(std::uint32_t count, std::array<std::uint32_t, kBladesOfPatch>& order) {
  std::array<std::uint64_t, kBladesOfPatch> keys{};
  for (std::uint32_t i = 0; i < count; ++i) {
    auto bits = static_cast<std::uint32_t>((std::uint64_t{i} << 32) / count);
    std::uint32_t reversed = 0;
    for (int b = 0; b < 32; ++b, bits >>= 1) reversed = reversed << 1 | (bits & 1u);
    keys[i] = std::uint64_t{reversed} << 32 | i;
  }
  std::sort(keys.begin(), keys.begin() + count);
  for (std::uint32_t i = 0; i < count; ++i) order[i] = static_cast<std::uint32_t>(keys[i]);
}

/// Gives each master and its slaves one rank: where the level of detail leaves blades out, it leaves out whole groups,
/// so the share of masters stays. Each cell keeps its last group until all others have one only. turn: any; which group
/// of a cell is the last.
void set_ranks(std::span<GrassBlade> blades, std::uint32_t masters, double shift, std::uint32_t turn) {
  std::array<std::uint32_t, kBladesOfPatch> order{};
  const std::uint32_t cells = (masters + kCellGroups - 1) / kCellGroups;
  spread_order(cells, order);
  std::uint32_t next = 0;
  for (std::uint32_t level = 0; level < kCellGroups; ++level)
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t cell = (order[i] + turn) % cells;
      const std::uint32_t groups = std::min(kCellGroups, masters - cell * kCellGroups);
      if (level >= groups) continue;
      const std::uint32_t master = cell * kCellGroups + (level + turn + cell) % groups;
      blades[master].rank = static_cast<float>((next++ + shift) / masters);
    }
  const std::uint32_t first_slot = blades.front().slot;
  for (GrassBlade& slave : blades.subspan(masters)) slave.rank = blades[slave.master - first_slot].rank;
}

/// Fills the patches of one surface; each call of fill writes one patch and its slots.
class PatchFiller {
 public:
  PatchFiller(const GrowthSurface& surface, std::span<const ScatteredRoot> roots, const PatchSource& source)
      : surface_(surface), roots_(roots), source_(source) {
    for (const BladeType& type : source.types) all_shares_ += double{type.share};
  }

  /// items: of the patch; their ids are indices of roots. blades: 256 slots, empty.
  void fill(std::span<SpatialItem> items, GrassPatch& patch, std::span<GrassBlade> blades) const {
    const auto count = static_cast<std::uint32_t>(items.size());
    patch.surface = source_.entity;
    patch.max_distance_m = source_.values.max_distance_m;
    patch.blades = count;
    patch.masters = (count + source_.slaves_per_master) / (source_.slaves_per_master + 1);
    split_by_space(items, patch.masters, kCellGroups);
    const dvec3 middle = middle_of(items);
    patch.origin = surface_.origin + middle;
    BladeRandom rank_random(source_.values.seed, items.front().id, kRankNumbers);
    const double shift = rank_random.unit();
    const auto turn = static_cast<std::uint32_t>(rank_random.unit() * patch.masters);

    const std::uint32_t first_slot = blades.front().slot;
    std::uint32_t next_slave = patch.masters;
    std::vector<SpatialItem> members;
    for (std::uint32_t group = 0; group < patch.masters; ++group) {
      // The blades of a cell are dealt to its groups in turn, so that each group covers the cell evenly.
      const std::uint32_t cell = group - group % kCellGroups;
      const std::uint32_t groups = std::min(kCellGroups, patch.masters - cell);
      const std::uint32_t begin = group_begin(count, patch.masters, cell);
      const std::uint32_t end = group_begin(count, patch.masters, cell + groups);
      if (group == cell) split_by_space(items.subspan(begin, end - begin), end - begin);
      members.clear();
      for (std::uint32_t i = begin + (group - cell); i < end; i += groups) members.push_back(items[i]);
      const std::size_t master = central(members);
      blades[group] = make_master(members[master].id, first_slot + group, middle);
      for (std::size_t i = 0; i < members.size(); ++i) {
        if (i == master) continue;
        blades[next_slave] =
            make_slave(members[i].id, members[master].id, first_slot + next_slave, middle, blades[group]);
        ++next_slave;
      }
    }
    set_ranks(blades.first(count), patch.masters, shift, turn);
    for (const GrassBlade& blade : blades.first(count)) {
      patch.roots.grow(blade.root_m);
      patch.reach_m = std::max(patch.reach_m, blade.length_m);
    }
  }

 private:
  /// Middle of the box of the roots, relative to the surface's origin.
  [[nodiscard]] dvec3 middle_of(std::span<const SpatialItem> items) const {
    dvec3 from = root_position(surface_, roots_[items.front().id]);
    dvec3 to = from;
    for (const SpatialItem& item : items) {
      const dvec3 at = root_position(surface_, roots_[item.id]);
      from = glm::min(from, at);
      to = glm::max(to, at);
    }
    return (from + to) * 0.5;
  }

  /// The member nearest to the members' centroid.
  static std::size_t central(std::span<const SpatialItem> members) {
    vec3 sum(0.0f);
    for (const SpatialItem& member : members) sum += member.at - members.front().at;
    const vec3 center = members.front().at + sum / static_cast<float>(members.size());
    std::size_t nearest = 0;
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < members.size(); ++i) {
      const vec3 offset = members[i].at - center;
      const float distance = glm::dot(offset, offset);
      if (distance >= least) continue;
      least = distance;
      nearest = i;
    }
    return nearest;
  }

  [[nodiscard]] std::size_t pick_type(std::uint32_t id) const {
    double left = BladeRandom(source_.values.seed, id, kTypeNumbers).unit() * all_shares_;
    for (std::size_t i = 0; i + 1 < source_.types.size(); ++i) {
      left -= double{source_.types[i].share};
      if (left < 0.0) return i;
    }
    return source_.types.size() - 1;
  }

  [[nodiscard]] GrassBlade make_master(std::uint32_t id, std::uint32_t slot, const dvec3& middle) const {
    GrassBlade blade;
    blade.type = static_cast<std::uint16_t>(source_.first_type + pick_type(id));
    blade.slot = slot;
    blade.master = slot;
    const Look look = look_of(id);
    set_look(look, id, middle, blade);
    blade.yaw = wrapped(look.yaw * kFullTurn);
    return blade;
  }

  /// A slave is about as long as its master and as stout, so that wind bends it about as far.
  [[nodiscard]] GrassBlade make_slave(std::uint32_t id, std::uint32_t master_id, std::uint32_t slot,
                                      const dvec3& middle, const GrassBlade& master) const {
    GrassBlade blade;
    blade.type = master.type;
    blade.slot = slot;
    blade.master = master.slot;
    Look look = look_of(id);
    const Look of_master = look_of(master_id);
    look.normal = kAlike * of_master.normal + std::sqrt(1.0 - kAlike * kAlike) * look.normal;
    look.stout = of_master.stout;
    set_look(look, id, middle, blade);
    blade.yaw = wrapped(double{master.yaw} + (2.0 * look.yaw - 1.0) * kSlaveYaw);
    return blade;
  }

  static float wrapped(double yaw) {
    const auto in_turn = static_cast<float>(yaw - std::floor(yaw / kFullTurn) * kFullTurn);
    return in_turn < static_cast<float>(kFullTurn) ? in_turn : 0.0f;
  }

  /// Random numbers of a blade.
  struct Look {
    double yaw = 0.0;     ///< 0…1
    double normal = 0.0;  ///< of a normal distribution: length
    double stout = 0.0;   ///< -1…1: width over length
    double layer = 0.0;   ///< 0…1
  };
  [[nodiscard]] Look look_of(std::uint32_t id) const {
    BladeRandom random(source_.values.seed, id, kLookNumbers);
    Look look;
    look.yaw = random.unit();
    // Box and Muller's transform of two uniform numbers to a normal one.
    const double radius = std::sqrt(-2.0 * std::log(1.0 - random.unit()));
    look.normal = radius * std::cos(kFullTurn * random.unit());
    look.stout = 2.0 * random.unit() - 1.0;
    look.layer = random.unit();
    return look;
  }

  /// Sets what does not depend on the master; the type is set.
  void set_look(const Look& look, std::uint32_t id, const dvec3& middle, GrassBlade& blade) const {
    const BladeType& type = source_.types[blade.type - source_.first_type];
    const double mean = std::max(double{source_.values.height_m.x}, 0.0) * type.length_scale;
    const double deviation = double{source_.values.height_m.y} * type.length_scale;
    const double length = std::clamp(mean + deviation * look.normal, kShortest * mean, kLongest * mean);
    const double width = std::clamp((1.0 + kStoutVariation * look.stout) * (mean > 0.0 ? length / mean : 1.0),
                                    1.0 - kWidthVariation, 1.0 + kWidthVariation);
    blade.length_m = static_cast<float>(length);
    blade.width_m = static_cast<float>(double{source_.values.width_m} * type.width_scale * width);
    blade.layer = static_cast<std::uint16_t>(look.layer * kGrassLayers);
    blade.root_m = vec3(root_position(surface_, roots_[id]) - middle);
    blade.ground_normal = surface_.triangles[roots_[id].triangle].normal;
  }

  const GrowthSurface& surface_;
  std::span<const ScatteredRoot> roots_;
  const PatchSource& source_;
  double all_shares_ = 0.0;
};

}  // namespace

void append_patches(const GrowthSurface& surface, std::span<const ScatteredRoot> roots, const PatchSource& source,
                    JobExecutor& jobs, std::vector<GrassPatch>& patches, std::vector<GrassBlade>& blades) {
  GLOAM_ASSERT(blades.size() == patches.size() * kBladesOfPatch, "each patch has 256 slots");
  GLOAM_ASSERT(!source.types.empty(), "a surface has at least one blade type");
  GLOAM_ASSERT(source.slaves_per_master < kBladesOfPatch, "a master and its slaves fit into one patch");
  if (roots.empty()) return;
  std::vector<SpatialItem> items(roots.size());
  jobs.parallel_for(roots.size(), 4096, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      items[i] = {vec3(root_position(surface, roots[i])), static_cast<std::uint32_t>(i)};
  });
  const auto count = static_cast<std::uint32_t>((roots.size() + kBladesOfPatch - 1) / kBladesOfPatch);
  split_by_space(items, count, jobs);

  const std::size_t first = patches.size();
  patches.resize(first + count);
  blades.resize(patches.size() * kBladesOfPatch);
  const PatchFiller filler(surface, roots, source);
  jobs.parallel_for(count, 4, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      GrassPatch& patch = patches[first + i];
      patch.index = static_cast<std::uint32_t>(first + i);
      const std::span<GrassBlade> slots = std::span(blades).subspan((first + i) * kBladesOfPatch, kBladesOfPatch);
      for (std::uint32_t s = 0; s < kBladesOfPatch; ++s) {
        slots[s].length_m = 0.0f;
        slots[s].slot = patch.index * kBladesOfPatch + s;
        slots[s].master = slots[s].slot;
      }
      const std::uint32_t begin = group_begin(items.size(), count, static_cast<std::uint32_t>(i));
      const std::uint32_t end = group_begin(items.size(), count, static_cast<std::uint32_t>(i + 1));
      filler.fill(std::span(items).subspan(begin, end - begin), patch, slots);
    }
  });
}

}  // namespace gloam

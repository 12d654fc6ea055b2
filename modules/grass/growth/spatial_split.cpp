// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/growth/spatial_split.h"

#include <algorithm>
#include <cstddef>

#include "engine/core/assert.h"
#include "engine/math/bounds.h"

namespace gloam {
namespace {

/// Groups [first, end) of the whole division.
struct GroupRange {
  std::uint32_t first = 0;
  std::uint32_t end = 0;
};

class SpatialDivision {
 public:
  SpatialDivision(std::span<SpatialItem> items, std::uint32_t groups, std::uint32_t unit = 1)
      : items_(items), groups_(groups), unit_(unit) {}

  [[nodiscard]] GroupRange whole() const { return {0, groups_}; }

  /// Moves the items of the range's first half of groups before those of the second; returns where the second begins.
  [[nodiscard]] std::uint32_t halve(GroupRange range) const {
    const std::uint32_t half = (range.end - range.first) / 2;
    const bool divides_unit = range.end - range.first <= unit_;
    const std::uint32_t middle =
        range.first + (divides_unit ? half : std::max((half + unit_ / 2) / unit_ * unit_, unit_));
    const std::span<SpatialItem> all = items_of(range);
    Aabb box;
    for (const SpatialItem& item : all) box.grow(item.at);
    const vec3 size = box.max - box.min;
    const int axis = size.x >= size.z ? (size.y > size.x ? 1 : 0) : (size.y > size.z ? 1 : 2);
    const std::size_t cut = begin_of(middle) - begin_of(range.first);
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(cut), all.end(),
                     [axis](const SpatialItem& a, const SpatialItem& b) {
                       return a.at[axis] != b.at[axis] ? a.at[axis] < b.at[axis] : a.id < b.id;
                     });
    return middle;
  }

  void divide(GroupRange range) const {
    if (range.end - range.first == 1) {
      std::ranges::sort(items_of(range), {}, &SpatialItem::id);
      return;
    }
    const std::uint32_t middle = halve(range);
    divide({range.first, middle});
    divide({middle, range.end});
  }

 private:
  [[nodiscard]] std::uint32_t begin_of(std::uint32_t group) const { return group_begin(items_.size(), groups_, group); }
  [[nodiscard]] std::span<SpatialItem> items_of(GroupRange range) const {
    const std::uint32_t begin = begin_of(range.first);
    return items_.subspan(begin, begin_of(range.end) - begin);
  }

  std::span<SpatialItem> items_;
  std::uint32_t groups_;
  std::uint32_t unit_;
};

}  // namespace

void split_by_space(std::span<SpatialItem> items, std::uint32_t groups, std::uint32_t unit) {
  GLOAM_ASSERT(groups >= 1 && groups <= items.size(), "a spatial group has at least one item");
  const SpatialDivision division(items, groups, unit);
  division.divide(division.whole());
}

void split_by_space(std::span<SpatialItem> items, std::uint32_t groups, JobExecutor& jobs) {
  GLOAM_ASSERT(groups >= 1 && groups <= items.size(), "a spatial group has at least one item");
  const SpatialDivision division(items, groups);
  constexpr std::size_t kJobs = 64;  // the upper levels run breadth first, until there are enough jobs
  std::vector<GroupRange> ranges = {division.whole()};
  while (ranges.size() < kJobs && ranges.size() < groups) {
    std::vector<GroupRange> halves(ranges.size() * 2);
    jobs.parallel_for(ranges.size(), 1, [&](JobRange job) {
      for (std::size_t i = job.begin; i < job.end; ++i) {
        const bool one = ranges[i].end - ranges[i].first == 1;
        const std::uint32_t middle = one ? ranges[i].end : division.halve(ranges[i]);
        halves[2 * i] = {ranges[i].first, middle};
        halves[2 * i + 1] = {middle, ranges[i].end};
      }
    });
    std::erase_if(halves, [](const GroupRange& range) { return range.first == range.end; });
    ranges = std::move(halves);
  }
  jobs.parallel_for(ranges.size(), 1, [&](JobRange job) {
    for (std::size_t i = job.begin; i < job.end; ++i) division.divide(ranges[i]);
  });
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/ecs/storage/archetype.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <span>
#include <utility>

#include "engine/core/assert.h"

namespace gloam {
namespace {

/// The rest of each column begins on its own page. If all began at the same offset within a page, their first rows
/// would compete for the same few cache sets. So the offsets are spread over kColours cache lines, by archetype and
/// column.
constexpr std::uint32_t kColours = 32;
std::size_t colour_offset(std::uint32_t archetype, std::size_t column) {
  return (archetype * 11 + column * 7) % kColours * kColumnAlignment;
}

/// Component ids index the tables of each archetype; the tables grow by this many ids at a time.
constexpr std::size_t kIdStep = 64;

/// Copies the first and the last `Part` bytes; these overlap if size < 2 · Part. Part ≤ size ≤ 2 · Part.
template <std::size_t Part>
void copy_both_ends(std::byte* to, const std::byte* from, std::size_t size) {
  std::array<std::byte, Part> head;
  std::array<std::byte, Part> tail;
  std::memcpy(head.data(), from, Part);
  std::memcpy(tail.data(), from + size - Part, Part);
  std::memcpy(to, head.data(), Part);
  std::memcpy(to + size - Part, tail.data(), Part);
}

/// Copies the usual sizes without a call of memcpy. The two places must not overlap.
inline void copy_value(std::byte* to, const std::byte* from, std::size_t size) {
  if (size >= 8 && size <= 16) return copy_both_ends<8>(to, from, size);
  if (size >= 4 && size < 8) return copy_both_ends<4>(to, from, size);
  if (size > 16 && size <= 32) return copy_both_ends<16>(to, from, size);
  std::memcpy(to, from, size);
}

}  // namespace

Archetype::Archetype(std::uint32_t index, std::vector<ComponentId> components, std::span<const ComponentInfo> infos,
                     std::uint32_t max_rows, FrontMemory& fronts)
    : index_(index), components_(std::move(components)), max_rows_(max_rows), allocator_(fronts.allocator) {
  columns_.push_back({.bases = {}, .size = sizeof(Entity), .id = kNoComponent, .stretch = {}, .ticks = {}});
  std::size_t row_bytes = sizeof(Entity);
  for (const ComponentId id : components_) {
    if (infos[id].size == 0) continue;
    columns_.push_back({.bases = {}, .size = infos[id].size, .id = id, .stretch = {}, .ticks = {}});
    row_bytes += infos[id].size;
  }
  front_room_ = std::min({kFrontRows, static_cast<std::uint32_t>(kFrontBytes / row_bytes), max_rows_});

  // One extra cache line: if the fronts were as long as a way of the cache, their first rows would compete for the same
  // cache sets.
  const auto front_bytes = [this](const Column& c) {
    return round_up(std::size_t{c.size} * front_room_, kColumnAlignment);
  };
  columns_[0].bases[0] = fronts.entities.take(front_bytes(columns_[0]) + kColumnAlignment);
  const auto components_with_bytes = std::span(columns_).subspan(1);
  std::size_t bytes = kColumnAlignment;
  for (const Column& column : components_with_bytes) bytes += front_bytes(column);
  std::byte* front = fronts.components.take(bytes);
  for (Column& column : components_with_bytes) {
    column.bases[0] = front;
    front += front_bytes(column);
  }

  cover_ids(infos.size());
  for (const Range range : ranges_) {
    range.table_[Range::kOwner] = reinterpret_cast<std::byte*>(this);
    for (const ComponentId id : components_) range.table_[Range::kFirstId + id] = columns_[0].bases[0];  // for tags
  }
  set_bases();
}

bool Archetype::cover_ids(std::size_t component_count) {
  if (component_count <= id_end_) return false;
  const std::size_t count = round_up(component_count, kIdStep);
  const std::size_t length = Range::kFirstId + count;
  auto tables = std::make_unique<std::byte*[]>(ranges_.size() * length);
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    std::byte** const table = tables.get() + i * length;
    if (ranges_[i]) std::copy_n(ranges_[i].table_, Range::kFirstId + id_end_, table);
    ranges_[i] = Range(table);
  }
  tables_ = std::move(tables);
  id_end_ = count;
  return true;
}

void Archetype::set_bases() {
  entity_bases_ = columns_[0].bases;
  for (const Column& column : std::span(columns_).subspan(1)) {
    for (std::size_t i = 0; i < ranges_.size(); ++i) ranges_[i].table_[Range::kFirstId + column.id] = column.bases[i];
  }
}

void Archetype::grow(std::uint32_t more_rows) {
  GLOAM_ASSERT(more_rows <= max_rows_ - rows_, "an archetype is full: raise WorldLimits::max_rows_per_archetype");
  const std::uint32_t needed = rows_ + more_rows;
  if (rows_ <= front_rows_) front_rows_ = needed <= front_room_ ? front_room_ : rows_;
  if (needed > std::max(front_rows_, reserved_capacity_)) extend_columns(needed);
  capacity_ = std::max(front_rows_, reserved_capacity_);
  const std::size_t blocks = (std::size_t{capacity_} + kTickBlockRows - 1) / kTickBlockRows;
  if (blocks <= row_ticks_.size()) return;
  for (Column& column : columns_) column.ticks.resize(blocks);
  row_ticks_.resize(blocks);
}

void Archetype::reserve_columns() {
  // It also has address space for the rows of the front, so that both ranges are indexed by the same row numbers.
  std::size_t end = 0;
  for (Column& column : columns_) {
    const std::size_t bytes =
        round_up(kColours * kColumnAlignment + std::size_t{column.size} * max_rows_, ReservedMemory::page_size());
    if (bytes >= ReservedMemory::kLargePage && allocator_ == nullptr) end = round_up(end, ReservedMemory::kLargePage);
    column.stretch = {.begin = end, .limit = end + bytes, .committed = end};
    end += bytes;
  }
  reserved_ = ReservedMemory(end, allocator_);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    Column& column = columns_[i];
    column.bases[1] = reserved_.data() + column.stretch.begin + colour_offset(index_, i);
  }
  set_bases();
}

void Archetype::extend_columns(std::uint32_t rows) {
  if (reserved_.data() == nullptr) reserve_columns();
  const std::uint64_t doubled = std::max<std::uint64_t>(2 * kFrontRows, std::uint64_t{reserved_capacity_} * 2);
  const auto capacity = std::max(rows, static_cast<std::uint32_t>(std::min<std::uint64_t>(doubled, max_rows_)));
  for (Column& column : columns_) {
    const auto begin = static_cast<std::size_t>(column.bases[1] - reserved_.data());
    reserved_.extend(column.stretch, begin + std::size_t{column.size} * capacity);
  }
  reserved_capacity_ = capacity;
}

Entity Archetype::remove_row(std::uint32_t row, Tick now) {
  const std::uint32_t last = --rows_;
  if (row == last) return kNoEntity;
  const std::size_t row_part = part(row);
  const std::size_t last_part = part(last);
  for (const Column& column : columns_) {
    const std::size_t size = column.size;
    copy_value(column.bases[row_part] + row * size, column.bases[last_part] + last * size, size);
  }
  stamp(row_ticks_, row, 1, now);
  return entities(row)[row];
}

Entity Archetype::move_row(std::uint32_t row, const Edge& edge, std::uint32_t to_row, Tick now) {
  const std::uint32_t last = --rows_;
  const std::size_t row_part = part(row);
  const std::size_t last_part = part(last);
  const std::size_t to_part = edge.to->part(to_row);
  for (const Edge::Column& column : edge.columns) {
    const std::size_t size = column.size;
    const Bases& from = *column.from;
    std::byte* value = from[row_part] + row * size;
    if (column.to != nullptr) copy_value((*column.to)[to_part] + to_row * size, value, size);
    if (row != last) copy_value(value, from[last_part] + last * size, size);
  }
  if (row == last) return kNoEntity;
  stamp(row_ticks_, row, 1, now);
  return entities(row)[row];
}

const Archetype::Edge& Archetype::set_edge(ComponentId id, Archetype& neighbour) {
  if (id >= edges_.size()) edges_.resize(id + std::size_t{1});
  auto edge = std::make_unique<Edge>();
  edge->to = &neighbour;
  for (const Column& column : columns_) {
    const auto other = std::ranges::find(neighbour.columns_, column.id, &Column::id);
    edge->columns.push_back({&column.bases, other == neighbour.columns_.end() ? nullptr : &other->bases, column.size});
  }
  edges_[id] = std::move(edge);
  return *edges_[id];
}

void Archetype::mark_changed(ComponentId id, std::uint32_t first, std::uint32_t count, Tick now) {
  if (count == 0) return;
  for (Column& column : columns_) {
    if (column.id != id) continue;
    const std::uint32_t last = (first + count - 1) / kTickBlockRows;
    for (std::uint32_t block = first / kTickBlockRows; block <= last; ++block) {
      // Two ranges of a parallel loop may share a block.
      std::atomic_ref(column.ticks[block]).store(now, std::memory_order_relaxed);
    }
  }
}

bool Archetype::changed(ComponentId id, std::uint32_t block, Tick since) const {
  if (row_ticks_[block] > since) return true;
  const auto column = std::ranges::find(columns_, id, &Column::id);
  return column != columns_.end() && column->ticks[block] > since;
}

}  // namespace gloam

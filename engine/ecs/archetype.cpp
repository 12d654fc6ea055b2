// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/ecs/archetype.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <utility>

#include "engine/core/assert.h"

namespace gloam {
namespace {

/// Columns begin on pages of their own. Were they to begin at the same place of each page, the first rows of many small
/// archetypes would fight for the same few cache sets; so column c of archetype a starts this many lines into its page.
constexpr std::uint32_t kColours = 32;
std::size_t colour_offset(std::uint32_t archetype, std::size_t column) {
  return (archetype * 11 + column * 7) % kColours * kColumnAlignment;
}

constexpr std::uint32_t kFirstRows = 32;

/// A component id is an index into each archetype's table, which grows by so many.
constexpr std::size_t kIdStep = 64;

/// Two copies of `Part` bytes that overlap where size < 2 · Part.
template <std::size_t Part>
void copy_both_ends(std::byte* to, const std::byte* from, std::size_t size) {
  std::array<std::byte, Part> head;
  std::array<std::byte, Part> tail;
  std::memcpy(head.data(), from, Part);
  std::memcpy(tail.data(), from + size - Part, Part);
  std::memcpy(to, head.data(), Part);
  std::memcpy(to + size - Part, tail.data(), Part);
}

/// The usual sizes without a call. The two do not overlap.
inline void copy_value(std::byte* to, const std::byte* from, std::size_t size) {
  if (size >= 8 && size <= 16) return copy_both_ends<8>(to, from, size);
  if (size >= 4 && size < 8) return copy_both_ends<4>(to, from, size);
  if (size > 16 && size <= 32) return copy_both_ends<16>(to, from, size);
  std::memcpy(to, from, size);
}

}  // namespace

Archetype::Archetype(std::uint32_t index, std::vector<ComponentId> components, std::span<const ComponentInfo> infos,
                     std::uint32_t max_rows)
    : components_(std::move(components)), max_rows_(max_rows) {
  entity_column_.size = sizeof(Entity);
  for (const ComponentId id : components_) {
    if (infos[id].size > 0) columns_.push_back({nullptr, infos[id].size, id, 0, {}});
  }

  const std::size_t page = ReservedMemory::page_size();
  std::size_t end = 0;
  const auto place = [&](Column& column) {
    const std::size_t bytes = round_up(kColours * kColumnAlignment + std::size_t{column.size} * max_rows_, page);
    if (bytes >= ReservedMemory::kLargePage) end = round_up(end, ReservedMemory::kLargePage);
    column.stretch = {.begin = end, .limit = end + bytes, .committed = end};
    end += bytes;
  };
  place(entity_column_);
  for (Column& column : columns_) place(column);

  memory_ = ReservedMemory(end);
  const auto locate = [&](Column& column, std::size_t number) {
    column.data = memory_.data() + column.stretch.begin + colour_offset(index, number);
  };
  locate(entity_column_, 0);
  for (std::size_t i = 0; i < columns_.size(); ++i) locate(columns_[i], i + 1);

  entities_ = reinterpret_cast<Entity*>(entity_column_.data);
  cover_ids(infos.size());
  for (const ComponentId id : components_) data_[id] = entity_column_.data;  // stays so for tags
  for (const Column& column : columns_) data_[column.id] = column.data;
}

void Archetype::cover_ids(std::size_t component_count) {
  if (component_count <= id_end_) return;
  const std::size_t count = round_up(component_count, kIdStep);
  auto data = std::make_unique<std::byte*[]>(count);
  std::copy_n(data_.get(), id_end_, data.get());
  data_ = std::move(data);
  id_end_ = static_cast<std::uint32_t>(count);
}

void Archetype::grow(std::uint32_t more_rows) {
  GLOAM_ASSERT(more_rows <= max_rows_ - rows_, "an archetype is full: raise WorldLimits::max_rows_per_archetype");
  const std::uint64_t doubled = std::max<std::uint64_t>(kFirstRows, std::uint64_t{capacity_} * 2);
  const auto capacity =
      std::max(rows_ + more_rows, static_cast<std::uint32_t>(std::min<std::uint64_t>(doubled, max_rows_)));
  commit(entity_column_, capacity);
  const std::size_t blocks = (std::size_t{capacity} + kTickBlockRows - 1) / kTickBlockRows;
  for (Column& column : columns_) {
    commit(column, capacity);
    column.ticks.resize(blocks);
  }
  row_ticks_.resize(blocks);
  capacity_ = capacity;
}

void Archetype::commit(Column& column, std::uint32_t rows) {
  const auto begin = static_cast<std::size_t>(column.data - memory_.data());
  memory_.extend(column.stretch, begin + std::size_t{column.size} * rows);
}

Entity Archetype::remove_row(std::uint32_t row, Tick now) {
  const std::uint32_t last = --rows_;
  if (row == last) return kNoEntity;
  for (const Column& column : columns_) {
    copy_value(column.data + std::size_t{row} * column.size, column.data + std::size_t{last} * column.size,
               column.size);
  }
  const Entity moved = entities_[last];
  entities_[row] = moved;
  stamp(row_ticks_, row, 1, now);
  return moved;
}

Entity Archetype::move_row(std::uint32_t row, const Edge& edge, std::uint32_t to_row, Tick now) {
  edge.to->entities_[to_row] = entities_[row];
  const std::uint32_t last = --rows_;
  for (const Edge::Column& column : edge.columns) {
    std::byte* value = column.from + std::size_t{row} * column.size;
    if (column.to != nullptr) copy_value(column.to + std::size_t{to_row} * column.size, value, column.size);
    if (row != last) copy_value(value, column.from + std::size_t{last} * column.size, column.size);
  }
  if (row == last) return kNoEntity;
  const Entity moved = entities_[last];
  entities_[row] = moved;
  stamp(row_ticks_, row, 1, now);
  return moved;
}

const Archetype::Edge& Archetype::set_edge(ComponentId id, Archetype& neighbour) {
  if (id >= edges_.size()) edges_.resize(id + std::size_t{1});
  auto edge = std::make_unique<Edge>();
  edge->to = &neighbour;
  for (const Column& column : columns_) edge->columns.push_back({column.data, neighbour.data(column.id), column.size});
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

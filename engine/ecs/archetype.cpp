// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/ecs/archetype.h"

#include <algorithm>
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

template <std::size_t Size>
void copy_fixed(std::byte* to, const std::byte* from) {
  std::memcpy(to, from, Size);
}

/// The usual sizes without a call.
void copy_value(std::byte* to, const std::byte* from, std::uint32_t size) {
  switch (size) {
    case 4:
      return copy_fixed<4>(to, from);
    case 8:
      return copy_fixed<8>(to, from);
    case 12:
      return copy_fixed<12>(to, from);
    case 16:
      return copy_fixed<16>(to, from);
    case 24:
      return copy_fixed<24>(to, from);
    case 32:
      return copy_fixed<32>(to, from);
    case 48:
      return copy_fixed<48>(to, from);
    case 64:
      return copy_fixed<64>(to, from);
    default:
      std::memcpy(to, from, size);
  }
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
    column.committed = end;
    end += round_up(kColours * kColumnAlignment + std::size_t{column.size} * max_rows_, page);
  };
  place(entity_column_);
  for (Column& column : columns_) place(column);

  memory_ = ReservedMemory(end);
  const auto locate = [&](Column& column, std::size_t number) {
    column.data = memory_.data() + column.committed + colour_offset(index, number);
  };
  locate(entity_column_, 0);
  for (std::size_t i = 0; i < columns_.size(); ++i) locate(columns_[i], i + 1);

  entities_ = reinterpret_cast<Entity*>(entity_column_.data);
  id_end_ = components_.empty() ? 0 : components_.back() + 1u;
  data_ = std::make_unique<std::byte*[]>(id_end_);
  for (const ComponentId id : components_) data_[id] = entity_column_.data;  // stays so for tags
  for (const Column& column : columns_) data_[column.id] = column.data;
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
  const std::size_t end = round_up(begin + std::size_t{column.size} * rows, ReservedMemory::page_size());
  if (end <= column.committed) return;
  memory_.commit(column.committed, end);
  column.committed = end;
}

Entity Archetype::remove_row(std::uint32_t row, Tick now) {
  const std::uint32_t last = rows_ - 1;
  rows_ = last;
  if (row == last) return kNoEntity;
  for (const Column& column : columns_) {
    copy_value(column.data + std::size_t{row} * column.size, column.data + std::size_t{last} * column.size,
               column.size);
  }
  entities_[row] = entities_[last];
  stamp(row_ticks_, row, 1, now);
  return entities_[row];
}

void Archetype::copy_row_to(std::uint32_t row, Archetype& to, std::uint32_t to_row) const {
  for (const Column& column : columns_) {
    std::byte* target = to.data(column.id);
    if (target == nullptr) continue;
    copy_value(target + std::size_t{to_row} * column.size, column.data + std::size_t{row} * column.size, column.size);
  }
}

void Archetype::set_edge(ComponentId id, Archetype* neighbour) {
  if (id >= edges_.size()) edges_.resize(id + std::size_t{1}, nullptr);
  edges_[id] = neighbour;
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

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/ecs/world.h"

#include <algorithm>

#include "engine/core/hash.h"

namespace gloam {

World::World(const WorldLimits& limits)
    : limits_(limits), records_(limits.max_entities, limits.allocator), fronts_(limits.allocator) {}

World::~World() = default;

std::string World::unregistered_sentence(std::string_view type) {
  return "component " + std::string(type) +
         " is not registered in this world: register it first, or have a renderer prepare the world";
}

std::string World::absent_sentence(std::string_view type, std::string_view where) {
  return std::string(where) + std::string(type);
}

std::string World::dead_sentence(Entity e) { return text_of(e) + " is not alive in this world"; }

std::string text_of(Entity e) {
  if (e == kNoEntity) return "kNoEntity";
  return "entity " + std::to_string(e.index) + " (generation " + std::to_string(e.generation) + ")";
}

std::size_t World::ComponentsHash::operator()(const std::vector<ComponentId>& ids) const {
  Hasher hasher;
  for (const ComponentId id : ids) hasher.value(id);
  return static_cast<std::size_t>(hasher.digest());
}

ComponentId World::register_type(TypeKey key, std::uint32_t name_hash, std::string_view name, std::uint32_t size) {
  const std::uint32_t known = types_.find(key);
  if (known != TypeTable::kAbsent) {
    GLOAM_ASSERT(infos_[known].size == size, "component " + infos_[known].name + " has " +
                                                 std::to_string(infos_[known].size) +
                                                 " bytes where it was registered first, and " + std::to_string(size) +
                                                 " here: program and library were compiled with different definitions");
    return static_cast<ComponentId>(known);
  }
  GLOAM_ASSERT(iterations_.load(std::memory_order_relaxed) == 0, "components are registered while no view iterates");
  GLOAM_ASSERT(infos_.size() < kNoComponent, "a world has at most 65,535 component types");
  GLOAM_ASSERT(std::ranges::find(infos_, name, &ComponentInfo::name) == infos_.end(),
               "component name \"" + std::string(name) + "\" is taken by another type");
  const auto id = static_cast<ComponentId>(infos_.size());
  infos_.push_back({std::string(name), key, size});
  types_.insert(key, id);
  fast_ids_.insert(key, name_hash, id);
  for (const auto& archetype : archetypes_) {
    if (!archetype->cover_ids(infos_.size())) continue;
    for (std::uint32_t row = 0; row < archetype->row_count(); ++row)
      records_[archetype->entities(row)[row].index].range = archetype->range(row);
  }
  return id;
}

ComponentId World::find_id(TypeKey key, std::string_view type) const {
  const std::uint32_t id = types_.find(key);
  GLOAM_ASSERT(id != TypeTable::kAbsent, unregistered_sentence(type));
  return static_cast<ComponentId>(id);
}

ComponentId World::find_accessed_id(TypeKey key, std::string_view type, bool write) const {
  const ComponentId id = find_id(key, type);
  check_component(id, write);
  return id;
}

Archetype& World::archetype_of(std::vector<ComponentId> sorted) {
  const auto known = archetype_by_components_.find(sorted);
  if (known != archetype_by_components_.end()) return *known->second;
  archetypes_.push_back(std::make_unique<Archetype>(static_cast<std::uint32_t>(archetypes_.size()), sorted, infos_,
                                                    limits_.max_rows_per_archetype, fronts_));
  Archetype& archetype = *archetypes_.back();
  archetype_by_components_.emplace(std::move(sorted), &archetype);
  return archetype;
}

const Archetype::Edge& World::add_edge(Archetype& from, ComponentId id) {
  std::vector<ComponentId> ids(from.components().begin(), from.components().end());
  const auto place = std::ranges::lower_bound(ids, id);
  if (place != ids.end() && *place == id) {
    ids.erase(place);
  } else {
    ids.insert(place, id);
  }
  Archetype& to = archetype_of(std::move(ids));
  to.set_edge(id, from);
  return from.set_edge(id, to);
}

const World::Bundle& World::add_bundle(TypeKey key, std::span<const ComponentId> ids) {
  std::vector<ComponentId> sorted(ids.begin(), ids.end());
  std::ranges::sort(sorted);
  GLOAM_ASSERT(std::ranges::adjacent_find(sorted) == sorted.end(), "an entity has each component once");
  Bundle bundle{&archetype_of(std::move(sorted)), {ids.begin(), ids.end()}};
  bundle_table_.insert(key, static_cast<std::uint32_t>(bundles_.size()));
  bundles_.push_back(std::move(bundle));
  return bundles_.back();
}

Entity World::take_entity(Archetype::Range range, std::uint32_t row) {
  std::uint32_t index = free_head_;
  if (index == kNoEntity.index) {
    index = static_cast<std::uint32_t>(records_.size());
    records_.push_back({});
  } else {
    free_head_ = records_[index].row;
  }
  Record& record = records_[index];
  record.range = range;
  record.row = row;
  return {index, record.generation};
}

World::NewRows World::create_one(Archetype& archetype) {
  GLOAM_ASSERT(alive_count_ < limits_.max_entities, "a world is full: raise WorldLimits::max_entities");
  if (free_head_ == kNoEntity.index) records_.reserve(records_.size() + 1);
  const std::uint32_t row = archetype.push_rows(1, tick());
  ++alive_count_;
  ++structure_version_;
  const Entity e = take_entity(archetype.range(row), row);
  archetype.set_entity(row, e);
  return {e, row};
}

std::uint32_t World::create_many(Archetype& archetype, std::span<Entity> out) {
  GLOAM_ASSERT(out.size() <= limits_.max_entities - alive_count_, "a world is full: raise WorldLimits::max_entities");
  if (out.empty()) return 0;
  records_.reserve(std::max(records_.size(), alive_count_ + out.size()));
  const std::uint32_t first = archetype.push_rows(static_cast<std::uint32_t>(out.size()), tick());
  const Archetype::Range range = archetype.range(first);
  Entity* const entities = archetype.entities(first);
  std::uint32_t row = first;
  for (Entity& e : out) {
    e = take_entity(range, row);
    entities[row++] = e;
  }
  alive_count_ += out.size();
  ++structure_version_;
  return first;
}

void World::destroy(Entity e) {
  begin_structural_change();
  static_cast<void>(living(e));
  Record& record = records_[e.index];
  const Entity moved = record.range.archetype().remove_row(record.row, tick());
  if (moved != kNoEntity) set_place(records_[moved.index], record);
  record.range = {};
  record.row = free_head_;
  if (++record.generation == 0) record.generation = 1;
  free_head_ = e.index;
  --alive_count_;
  ++structure_version_;
}

void World::move_entity(Record& record, ComponentId id) {
  Archetype& from = record.range.archetype();
  const Archetype::Edge& edge = edge_of(from, id);
  const Record place = record;
  record.row = edge.to->push_rows(1, tick());
  record.range = edge.to->range(record.row);
  const Entity moved = from.move_row(place.row, edge, record.row, tick());
  if (moved != kNoEntity) set_place(records_[moved.index], place);
  ++structure_version_;
}

std::byte* World::add_cell(Entity e, ComponentId id, std::uint32_t size) {
  begin_structural_change();
  static_cast<void>(living(e));
  Record& record = records_[e.index];
  if (record.range.base(id) != nullptr) {
    record.range.archetype().mark_changed(id, record.row, 1, tick());
  } else {
    move_entity(record, id);
  }
  return record.range.base(id) + std::size_t{size} * record.row;
}

bool World::remove_component(Entity e, ComponentId id) {
  begin_structural_change();
  static_cast<void>(living(e));
  Record& record = records_[e.index];
  if (record.range.base(id) == nullptr) return false;
  move_entity(record, id);
  return true;
}

Query* World::find_query(TypeKey key) const {
  const std::lock_guard lock(query_mutex_);
  const std::uint32_t known = query_table_.find(key);
  return known == TypeTable::kAbsent ? nullptr : queries_[known].get();
}

Query* World::add_query(TypeKey key, QueryTerms terms) const {
  std::vector<ComponentId> sorted = terms.columns;
  std::ranges::sort(sorted);
  GLOAM_ASSERT(std::ranges::adjacent_find(sorted) == sorted.end(), "a view names each column once");
  const std::lock_guard lock(query_mutex_);
  const std::uint32_t known = query_table_.find(key);
  if (known != TypeTable::kAbsent) return queries_[known].get();  // another thread was first
  query_table_.insert(key, static_cast<std::uint32_t>(queries_.size()));
  queries_.push_back(std::make_unique<Query>(std::move(terms)));
  return queries_.back().get();
}

void World::refresh(Query& query) const {
  if (query.seen() == archetypes_.size()) return;
  const std::lock_guard lock(query_mutex_);
  query.extend(archetypes_);
}

}  // namespace gloam

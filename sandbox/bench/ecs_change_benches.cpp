// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "sandbox/bench/ecs_case.h"
#include "sandbox/bench/measure.h"

namespace gloam::bench {
namespace {

constexpr std::size_t kEntities = 100000;

/// A world with its entities by number, emptied for every repetition. Memory stays: both sides are measured as they run in the middle
/// of a session, not on the first touch of a page.
struct WorldSide {
  std::unique_ptr<World> world = std::make_unique<World>();
  std::vector<Entity> entities;

  WorldSide() { register_components(*world); }
  void reset() {
    std::vector<Entity> left;
    world->view<const Position>().each([&](Entity entity, const Position&) { left.push_back(entity); });
    // The last one first: nothing moves, and numbers are given again from the lowest.
    for (auto entity = left.rbegin(); entity != left.rend(); ++entity) world->destroy(*entity);
    entities.clear();
  }
  void fill() {
    reset();
    entities.reserve(kEntities);
    for (std::size_t i = 0; i < kEntities; ++i) entities.push_back(world->create(start_of(i), Velocity{}));
  }
  void fill_heavy() {
    fill();
    for (const Entity entity : entities) world->add<Mass>(entity);
  }
};

struct BareSide {
  std::unique_ptr<BareTable> table = std::make_unique<BareTable>();

  void reset() { table->clear(); }
  void fill() {
    reset();
    for (std::size_t i = 0; i < kEntities; ++i) table->create(start_of(i), Velocity{});
  }
  void fill_heavy() {
    fill();
    for (std::uint32_t i = 0; i < kEntities; ++i) table->add_mass(i, Mass{});
  }
};

/// All numbers once, in an order that is the same everywhere.
std::vector<std::uint32_t> shuffled_numbers() {
  std::vector<std::uint32_t> numbers(kEntities);
  std::iota(numbers.begin(), numbers.end(), 0u);
  std::uint64_t state = 12345;
  for (std::size_t i = numbers.size() - 1; i > 0; --i) {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    std::swap(numbers[i], numbers[(state >> 33) % (i + 1)]);
  }
  return numbers;
}

std::vector<std::uint32_t> numbers_in_order() {
  std::vector<std::uint32_t> numbers(kEntities);
  std::iota(numbers.begin(), numbers.end(), 0u);
  return numbers;
}

using WorldStep = void (*)(WorldSide&);
using BareStep = void (*)(BareSide&);
using WorldWork = void (*)(WorldSide&, const std::vector<std::uint32_t>&);
using BareWork = void (*)(BareSide&, const std::vector<std::uint32_t>&);

/// One structural change: what stands before it, and the change of the things with these numbers.
struct Change {
  const char* id;
  WorldStep prepare_world;
  WorldWork world;
  BareStep prepare_bare;
  BareWork bare;
  bool shuffled = false;
  std::size_t count = kEntities;  ///< only the first of the numbers
};

std::vector<std::uint32_t> numbers_of(const Change& change) {
  std::vector<std::uint32_t> numbers = change.shuffled ? shuffled_numbers() : numbers_in_order();
  numbers.resize(change.count);
  return numbers;
}

Timing time_world(const Change& change) {
  const std::vector<std::uint32_t> numbers = numbers_of(change);
  WorldSide side;
  Timing timing;
  timing.ns = time_ns(
      kRepetitions, [&] { change.prepare_world(side); }, [&] { change.world(side, numbers); });
  timing.hash = content_hash(*side.world);
  return timing;
}

Timing time_bare(const Change& change) {
  const std::vector<std::uint32_t> numbers = numbers_of(change);
  BareSide side;
  Timing timing;
  timing.ns = time_ns(
      kRepetitions, [&] { change.prepare_bare(side); }, [&] { change.bare(side, numbers); });
  timing.hash = content_hash(*side.table);
  return timing;
}

using Numbers = std::vector<std::uint32_t>;

void create_world(WorldSide& s, const Numbers& numbers) {
  for (const std::uint32_t i : numbers) s.world->create(start_of(i), Velocity{});
}
void create_bare(BareSide& s, const Numbers& numbers) {
  for (const std::uint32_t i : numbers) s.table->create(start_of(i), Velocity{});
}
void create_bulk_world(WorldSide& s, const Numbers& numbers) {
  s.entities.resize(numbers.size());
  s.world->create_bulk(std::span(s.entities), Position{}, Velocity{});
}
void create_bulk_bare(BareSide& s, const Numbers& numbers) {
  s.table->create_bulk(numbers.size(), Position{}, Velocity{});
}
void destroy_world(WorldSide& s, const Numbers& numbers) {
  for (const std::uint32_t i : numbers) s.world->destroy(s.entities[i]);
}
void destroy_bare(BareSide& s, const Numbers& numbers) {
  for (const std::uint32_t i : numbers) s.table->destroy(i);
}
void add_world(WorldSide& s, const Numbers& numbers) {
  for (const std::uint32_t i : numbers) s.world->add<Mass>(s.entities[i], Mass{});
}
void add_bare(BareSide& s, const Numbers& numbers) {
  for (const std::uint32_t i : numbers) s.table->add_mass(i, Mass{});
}
void remove_world(WorldSide& s, const Numbers& numbers) {
  for (const std::uint32_t i : numbers) s.world->remove<Mass>(s.entities[i]);
}
void remove_bare(BareSide& s, const Numbers& numbers) {
  for (const std::uint32_t i : numbers) s.table->remove_mass(i);
}
void get_world(WorldSide& s, const Numbers& numbers) {
  for (const std::uint32_t i : numbers) s.world->get<Position>(s.entities[i]).x += 1.0f;
}
void get_bare(BareSide& s, const Numbers& numbers) {
  for (const std::uint32_t i : numbers) {
    const BareTable::Record record = s.table->records[i];
    record.columns->positions[record.row].x += 1.0f;
  }
}

void empty_world(WorldSide& s) { s.reset(); }
void filled_world(WorldSide& s) { s.fill(); }
void heavy_world(WorldSide& s) { s.fill_heavy(); }
void empty_bare(BareSide& s) { s.reset(); }
void filled_bare(BareSide& s) { s.fill(); }
void heavy_bare(BareSide& s) { s.fill_heavy(); }

}  // namespace

void add_change_cases(BenchRegistry& registry) {
  // Of what is destroyed a quarter stays, so that the hash sees that the right ones went.
  constexpr std::size_t kDestroyed = kEntities / 4 * 3;
  const Change changes[] = {
      {.id = "ecs.create",
       .prepare_world = empty_world,
       .world = create_world,
       .prepare_bare = empty_bare,
       .bare = create_bare},
      {.id = "ecs.create_bulk",
       .prepare_world = empty_world,
       .world = create_bulk_world,
       .prepare_bare = empty_bare,
       .bare = create_bulk_bare},
      {.id = "ecs.destroy",
       .prepare_world = filled_world,
       .world = destroy_world,
       .prepare_bare = filled_bare,
       .bare = destroy_bare,
       .count = kDestroyed},
      {.id = "ecs.destroy_random",
       .prepare_world = filled_world,
       .world = destroy_world,
       .prepare_bare = filled_bare,
       .bare = destroy_bare,
       .shuffled = true,
       .count = kDestroyed},
      {.id = "ecs.add",
       .prepare_world = filled_world,
       .world = add_world,
       .prepare_bare = filled_bare,
       .bare = add_bare},
      {.id = "ecs.add_shuffled",
       .prepare_world = filled_world,
       .world = add_world,
       .prepare_bare = filled_bare,
       .bare = add_bare,
       .shuffled = true},
      {.id = "ecs.remove",
       .prepare_world = heavy_world,
       .world = remove_world,
       .prepare_bare = heavy_bare,
       .bare = remove_bare},
      {.id = "ecs.random_get",
       .prepare_world = filled_world,
       .world = get_world,
       .prepare_bare = filled_bare,
       .bare = get_bare,
       .shuffled = true},
  };
  for (const Change& change : changes) {
    add_case(registry, {.id = change.id,
                        .entities = static_cast<double>(change.count),
                        .world = [change] { return time_world(change); },
                        .bare = [change] { return time_bare(change); }});
  }
}

}  // namespace gloam::bench

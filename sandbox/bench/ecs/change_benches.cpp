// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "engine/ecs/view.h"
#include "sandbox/bench/ecs/case.h"

namespace gloam::bench {
namespace {

constexpr std::size_t kEntities = 100000;

/// Content before the change: nothing, things without a mass, or things with one.
enum class Start { empty, light, heavy };

/// Differs from thing to thing, so that the hash sees a value that a change moved to the wrong row.
Velocity velocity_of(std::size_t i) { return {.x = static_cast<float>(i % 1000), .y = 0.5f, .z = 0.25f}; }

/// A world that is emptied and filled again for every repetition. It keeps its memory: both sides are measured as in
/// the middle of a session, not at the first touch of a page.
struct WorldSide {
  World world;
  std::vector<Entity> all;     ///< in the order of creation
  std::vector<Entity> chosen;  ///< entities to change, in the order of the change

  WorldSide() { register_components(world); }
  void start(Start start) {
    empty();
    if (start == Start::empty) return;
    for (std::size_t i = 0; i < kEntities; ++i) {
      if (start == Start::light) all[i] = world.create(start_of(i), velocity_of(i));
      if (start == Start::heavy) all[i] = world.create(start_of(i), velocity_of(i), Mass{});
    }
  }

 private:
  /// Destroys all entities in an order after which indices are given from the lowest up, as in plain arrays.
  void empty() {
    all.clear();
    world.view<const Position>().each([&](Entity entity, const Position&) { all.push_back(entity); });
    for (const Entity entity : all) world.destroy(entity);
    all.resize(kEntities);
    world.create_bulk(std::span(all));
    std::ranges::sort(all, std::ranges::greater(), &Entity::index);
    for (const Entity entity : all) world.destroy(entity);
  }
};

struct BareSide {
  BareTable table;
  std::vector<BareTable::Handle> chosen;

  void start(Start start) {
    table.clear();
    for (std::size_t i = 0; i < kEntities; ++i) {
      if (start == Start::light) table.create(start_of(i), velocity_of(i));
      if (start == Start::heavy) table.create_heavy(start_of(i), velocity_of(i), Mass{});
    }
  }
};

using Numbers = std::vector<std::uint32_t>;

/// The first `count` of the numbers 0 … kEntities − 1. shuffled: of their random order, which is the same on every
/// platform.
Numbers make_numbers(bool shuffled, std::size_t count) {
  Numbers numbers(kEntities);
  std::iota(numbers.begin(), numbers.end(), 0u);
  std::uint64_t state = 12345;
  for (std::size_t i = numbers.size() - 1; shuffled && i > 0; --i) {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    std::swap(numbers[i], numbers[(state >> 33) % (i + 1)]);
  }
  numbers.resize(count);
  return numbers;
}

/// One change and the things to which it is made.
struct EcsChange {
  const char* id;
  Start start = Start::empty;
  void (*world)(WorldSide&);
  void (*bare)(BareSide&);
  void (*unchecked_bare)(BareSide&) = nullptr;
  bool shuffled = false;
  std::optional<double> bar_ns = {};
  std::optional<double> bar_ratio = {};
  std::size_t count = kEntities;  ///< number of things to change
};

class ChangeWorld final : public Contender {
 public:
  explicit ChangeWorld(const EcsChange& change)
      : change_(change), numbers_(make_numbers(change.shuffled, change.count)) {}
  void prepare() override {
    side_.start(change_.start);
    side_.chosen.clear();
    for (const std::uint32_t number : numbers_) side_.chosen.push_back(side_.all[number]);
  }
  void run() override { change_.world(side_); }
  [[nodiscard]] std::uint64_t hash() override { return content_hash(side_.world); }

 private:
  EcsChange change_;
  Numbers numbers_;
  WorldSide side_;
};

class ChangeBare final : public Contender {
 public:
  ChangeBare(const EcsChange& change, void (*make)(BareSide&)) : change_(change), make_(make) {
    for (const std::uint32_t number : make_numbers(change.shuffled, change.count)) side_.chosen.push_back({number});
  }
  void prepare() override { side_.start(change_.start); }
  void run() override { make_(side_); }
  [[nodiscard]] std::uint64_t hash() override { return content_hash(side_.table); }

 private:
  EcsChange change_;
  void (*make_)(BareSide&);
  BareSide side_;
};

void create_world(WorldSide& s) {
  for (std::size_t i = 0; i < kEntities; ++i) s.world.create(start_of(i), Velocity{}, Mass{});
}
void create_bare(BareSide& s) {
  for (std::size_t i = 0; i < kEntities; ++i) s.table.create_heavy(start_of(i), Velocity{}, Mass{});
}
void create_bulk_world(WorldSide& s) { s.world.create_bulk(std::span(s.all), Position{}, Velocity{}, Mass{}); }
void create_bulk_bare(BareSide& s) { s.table.create_heavy_bulk(kEntities, Position{}, Velocity{}, Mass{}); }
void destroy_world(WorldSide& s) {
  for (const Entity entity : s.chosen) s.world.destroy(entity);
}
void destroy_bare(BareSide& s) {
  for (const BareTable::Handle thing : s.chosen) s.table.destroy(thing.index);
}
void add_world(WorldSide& s) {
  for (const Entity entity : s.chosen) s.world.add<Mass>(entity, Mass{});
}
void add_bare(BareSide& s) {
  for (const BareTable::Handle thing : s.chosen) s.table.add_mass(thing.index, Mass{});
}
void remove_world(WorldSide& s) {
  for (const Entity entity : s.chosen) s.world.remove<Mass>(entity);
}
void remove_bare(BareSide& s) {
  for (const BareTable::Handle thing : s.chosen) s.table.remove_mass(thing.index);
}
void get_world(WorldSide& s) {
  for (const Entity entity : s.chosen) s.world.get<Position>(entity).x += 1.0f;
}
void get_bare(BareSide& s) {
  for (const BareTable::Handle thing : s.chosen) s.table.position(thing).x += 1.0f;
}
void get_unchecked_bare(BareSide& s) {
  for (const BareTable::Handle thing : s.chosen) s.table.unchecked_position(thing).x += 1.0f;
}

}  // namespace

void add_change_cases(BenchRegistry& registry) {
  // A quarter is not destroyed: the hash of the rest shows whether the right ones were destroyed.
  constexpr std::size_t kDestroyed = kEntities / 4 * 3;
  const EcsChange changes[] = {
      {.id = "ecs.create", .world = create_world, .bare = create_bare, .bar_ns = 30.0},
      {.id = "ecs.create_bulk", .world = create_bulk_world, .bare = create_bulk_bare, .bar_ns = 6.0},
      {.id = "ecs.destroy",
       .start = Start::heavy,
       .world = destroy_world,
       .bare = destroy_bare,
       .bar_ns = 20.0,
       .count = kDestroyed},
      {.id = "ecs.destroy_random",
       .start = Start::heavy,
       .world = destroy_world,
       .bare = destroy_bare,
       .shuffled = true,
       .count = kDestroyed},
      {.id = "ecs.add", .start = Start::light, .world = add_world, .bare = add_bare, .bar_ratio = 4.0},
      {.id = "ecs.add_shuffled",
       .start = Start::light,
       .world = add_world,
       .bare = add_bare,
       .shuffled = true,
       .bar_ratio = 4.0},
      {.id = "ecs.remove", .start = Start::heavy, .world = remove_world, .bare = remove_bare, .bar_ratio = 4.0},
      {.id = "ecs.random_get",
       .start = Start::light,
       .world = get_world,
       .bare = get_bare,
       .unchecked_bare = get_unchecked_bare,
       .shuffled = true,
       .bar_ratio = 1.4},
  };
  for (const EcsChange& change : changes) {
    const auto bare_side = [change](void (*run)(BareSide&)) {
      return [change, run] { return std::make_unique<ChangeBare>(change, run); };
    };
    EcsCase ecs_case{.id = change.id,
                     .entities = static_cast<double>(change.count),
                     .bar_ns = change.bar_ns,
                     .bar_ratio = change.bar_ratio,
                     .world = [change] { return std::make_unique<ChangeWorld>(change); },
                     .bare = bare_side(change.bare)};
    if (change.unchecked_bare != nullptr) ecs_case.unchecked_bare = bare_side(change.unchecked_bare);
    add_case(registry, std::move(ecs_case));
  }
}

}  // namespace gloam::bench

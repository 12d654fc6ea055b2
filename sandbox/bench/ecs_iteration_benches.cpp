// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sandbox/bench/ecs_case.h"
#include "sandbox/bench/measure.h"

namespace gloam::bench {
namespace {

constexpr float kStep = 1.0f / 64.0f;  // exact in binary: sums do not round differently

void move(Position& p, const Velocity& v) {
  p.x += v.x * kStep;
  p.y += v.y * kStep;
  p.z += v.z * kStep;
}

void move_heavy(Position& p, const Velocity& v, const Mass& m) {
  p.x += v.x * m.kg * kStep;
  p.y += v.y * m.kg * kStep;
  p.z += v.z * m.kg * kStep;
}

/// Repetitions run over the same world, so that short ones are not swamped by the clock.
int passes_for(std::size_t entities) { return entities < 100000 ? 50 : 1; }

Timing iterate2_world(std::size_t count) {
  World world;
  register_components(world);
  for (std::size_t i = 0; i < count; ++i) world.create(start_of(i), Velocity{});
  const auto view = world.view<Position, const Velocity>();
  const int passes = passes_for(count);
  Timing timing;
  timing.ns = time_ns(kRepetitions, {}, [&] {
    for (int pass = 0; pass < passes; ++pass) view.each([](Position& p, const Velocity& v) { move(p, v); });
  });
  timing.hash = content_hash(world);
  return timing;
}

Timing iterate2_bare(std::size_t count) {
  BareTable table;
  for (std::size_t i = 0; i < count; ++i) table.create(start_of(i), Velocity{});
  auto& [things, positions, velocities, masses] = table.plain;
  const int passes = passes_for(count);
  Timing timing;
  timing.ns = time_ns(kRepetitions, {}, [&] {
    for (int pass = 0; pass < passes; ++pass) {
      for (std::size_t i = 0; i < positions.size(); ++i) move(positions[i], velocities[i]);
      keep(positions.size());
    }
  });
  timing.hash = content_hash(table);
  return timing;
}

template <int N>
struct Tag {};

template <int N>
void add_tag(World& world, Entity entity, std::size_t fragment) {
  if ((fragment >> N & 1u) != 0) world.add<Tag<N>>(entity);
}

/// The fragment's number in binary says which of ten tags its entities carry.
template <int... N>
void fill_fragments(World& world, std::size_t fragments, std::size_t count, std::integer_sequence<int, N...>) {
  (world.register_component<Tag<N>>("tag" + std::to_string(N)), ...);
  for (std::size_t i = 0; i < count; ++i) {
    const Entity entity = world.create(start_of(i), Velocity{}, Mass{});
    (add_tag<N>(world, entity, i % fragments), ...);
  }
}

Timing fragmented_world(std::size_t fragments, std::size_t count) {
  World world({.max_rows_per_archetype = 1u << 20, .max_entities = 1u << 20});
  register_components(world);
  fill_fragments(world, fragments, count, std::make_integer_sequence<int, 10>{});
  const auto view = world.view<Position, const Velocity, const Mass>();
  Timing timing;
  timing.ns = time_ns(kRepetitions, {},
                      [&] { view.each([](Position& p, const Velocity& v, const Mass& m) { move_heavy(p, v, m); }); });
  timing.hash = content_hash(world);
  return timing;
}

Timing fragmented_bare(std::size_t fragments, std::size_t count) {
  std::vector<BareTable::Columns> tables(fragments);
  for (std::size_t i = 0; i < count; ++i) {
    BareTable::Columns& table = tables[i % fragments];
    table.push(static_cast<std::uint32_t>(i), start_of(i), Velocity{});
    table.masses.push_back(Mass{});
  }
  Timing timing;
  timing.ns = time_ns(kRepetitions, {}, [&] {
    for (BareTable::Columns& t : tables) {
      for (std::size_t i = 0; i < t.positions.size(); ++i) move_heavy(t.positions[i], t.velocities[i], t.masses[i]);
    }
    keep(tables.size());
  });
  for (const BareTable::Columns& table : tables) timing.hash += content_hash(table);
  return timing;
}

}  // namespace

void add_iteration_cases(BenchRegistry& registry) {
  const std::pair<const char*, std::size_t> counts[] = {{"ecs.iterate2.1e4", 10000}, {"ecs.iterate2.1e6", 1000000}};
  for (const auto& [id, count] : counts) {
    add_case(registry, {.id = id,
                        .entities = static_cast<double>(count) * passes_for(count),
                        .world = [count = count] { return iterate2_world(count); },
                        .bare = [count = count] { return iterate2_bare(count); }});
  }
  constexpr std::size_t kEntities = 102400;
  for (const std::size_t fragments : {std::size_t{10}, std::size_t{1024}}) {
    add_case(registry, {.id = "ecs.iterate3_fragmented." + std::to_string(fragments),
                        .entities = kEntities,
                        .world = [fragments] { return fragmented_world(fragments, kEntities); },
                        .bare = [fragments] { return fragmented_bare(fragments, kEntities); }});
  }
}

}  // namespace gloam::bench

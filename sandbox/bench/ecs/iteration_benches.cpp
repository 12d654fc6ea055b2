// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/ecs/view.h"
#include "sandbox/bench/ecs/case.h"
#include "sandbox/bench/harness/measure.h"

// The loops of both sides are separate functions that are never inlined, like the loop of a system. So the compiler can
// neither merge the passes of a repetition nor move common work out of them.
#if defined(__GNUC__)
#define GLOAM_BENCH_PASS [[gnu::noinline]]
#else
#define GLOAM_BENCH_PASS __declspec(noinline)
#endif

namespace gloam::bench {
namespace {

constexpr float kStep = 1.0f / 64.0f;  // exact in binary, so that the sums of both sides round alike

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

/// Number of passes over the same data in a repetition, so that a small data set takes long enough for the clock.
int passes_for(std::size_t entities) { return static_cast<int>(1000000 / entities) + 1; }

GLOAM_BENCH_PASS void move_world(const View<Position, const Velocity>& view) {
  view.each([](Position& p, const Velocity& v) { move(p, v); });
}
// The bare loops match the view's loop: they have a counter, and columns that are only read are marked as not aliased.
GLOAM_BENCH_PASS void move_bare(std::vector<Position>& positions, const std::vector<Velocity>& velocities) {
  Position* const p = positions.data();
  const Velocity* GLOAM_RESTRICT const v = velocities.data();
  for (std::size_t i = 0, count = positions.size(); i < count; ++i) move(p[i], v[i]);
}

class MoveWorld final : public Contender {
 public:
  explicit MoveWorld(std::size_t count) : passes_(passes_for(count)) {
    register_components(world_);
    for (std::size_t i = 0; i < count; ++i) world_.create(start_of(i), Velocity{});
  }
  void run() override {
    const auto view = world_.view<Position, const Velocity>();
    for (int pass = 0; pass < passes_; ++pass) move_world(view);
  }
  [[nodiscard]] std::uint64_t hash() override { return content_hash(world_); }

 private:
  int passes_;
  World world_;
};

class MoveBare final : public Contender {
 public:
  explicit MoveBare(std::size_t count) : passes_(passes_for(count)) {
    for (std::size_t i = 0; i < count; ++i) table_.create(start_of(i), Velocity{});
  }
  void run() override {
    for (int pass = 0; pass < passes_; ++pass) move_bare(table_.plain.positions, table_.plain.velocities);
  }
  [[nodiscard]] std::uint64_t hash() override { return content_hash(table_); }

 private:
  int passes_;
  BareTable table_;
};

template <int N>
struct Tag {};

template <int N>
void add_tag(World& world, Entity entity, std::size_t fragment) {
  if ((fragment >> N & 1u) != 0) world.add<Tag<N>>(entity);
}

/// Entities of a fragment have Tag<N> if bit N of the fragment's number is set.
template <int... N>
void fill_fragments(World& world, std::size_t fragments, std::size_t count, std::integer_sequence<int, N...>) {
  (world.register_component<Tag<N>>("tag" + std::to_string(N)), ...);
  for (std::size_t i = 0; i < count; ++i) {
    const Entity entity = world.create(start_of(i), Velocity{}, Mass{});
    (add_tag<N>(world, entity, i % fragments), ...);
  }
}

GLOAM_BENCH_PASS void move_fragments_world(const View<Position, const Velocity, const Mass>& view) {
  view.each([](Position& p, const Velocity& v, const Mass& m) { move_heavy(p, v, m); });
}
GLOAM_BENCH_PASS void move_fragments_bare(std::vector<BareTable::Columns>& chunks) {
  for (BareTable::Columns& c : chunks) {
    Position* const p = c.positions.data();
    const Velocity* GLOAM_RESTRICT const v = c.velocities.data();
    const Mass* GLOAM_RESTRICT const m = c.masses.data();
    for (std::size_t i = 0, count = c.positions.size(); i < count; ++i) move_heavy(p[i], v[i], m[i]);
  }
}

class FragmentsWorld final : public Contender {
 public:
  FragmentsWorld(std::size_t fragments, std::size_t count)
      : passes_(passes_for(count)), world_({.max_rows_per_archetype = 1u << 20, .max_entities = 1u << 20}) {
    register_components(world_);
    fill_fragments(world_, fragments, count, std::make_integer_sequence<int, 10>{});
  }
  void run() override {
    const auto view = world_.view<Position, const Velocity, const Mass>();
    for (int pass = 0; pass < passes_; ++pass) move_fragments_world(view);
  }
  [[nodiscard]] std::uint64_t hash() override { return content_hash(world_); }

 private:
  int passes_;
  World world_;
};

/// Each chunk corresponds to an archetype of the world: a vector of things and one of each component, grown row by row.
class FragmentsBare final : public Contender {
 public:
  FragmentsBare(std::size_t fragments, std::size_t count) : passes_(passes_for(count)), chunks_(fragments) {
    for (std::size_t i = 0; i < count; ++i) {
      BareTable::Columns& chunk = chunks_[i % fragments];
      chunk.push(static_cast<std::uint32_t>(i), start_of(i), Velocity{});
      chunk.masses.push_back(Mass{});
    }
  }
  void run() override {
    for (int pass = 0; pass < passes_; ++pass) move_fragments_bare(chunks_);
  }
  [[nodiscard]] std::uint64_t hash() override { return content_hash(chunks_); }

 private:
  int passes_;
  std::vector<BareTable::Columns> chunks_;
};

}  // namespace

void add_iteration_cases(BenchRegistry& registry) {
  const std::pair<const char*, std::size_t> counts[] = {{"ecs.iterate2.1e4", 10000}, {"ecs.iterate2.1e6", 1000000}};
  for (const auto& [id, count] : counts) {
    add_case(registry, {.id = id,
                        .entities = static_cast<double>(count) * passes_for(count),
                        .bar_ns = {},
                        .bar_ratio = 1.10,
                        .world = [count = count] { return std::make_unique<MoveWorld>(count); },
                        .bare = [count = count] { return std::make_unique<MoveBare>(count); }});
  }
  static constexpr std::size_t kEntities = 102400;
  for (const std::size_t fragments : {std::size_t{10}, std::size_t{1024}}) {
    add_case(registry, {.id = "ecs.iterate3_fragmented." + std::to_string(fragments),
                        .entities = static_cast<double>(kEntities) * passes_for(kEntities),
                        .bar_ns = {},
                        .bar_ratio = 1.15,
                        .world = [fragments] { return std::make_unique<FragmentsWorld>(fragments, kEntities); },
                        .bare = [fragments] { return std::make_unique<FragmentsBare>(fragments, kEntities); }});
  }
}

}  // namespace gloam::bench

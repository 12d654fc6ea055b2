// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <memory>
#include <numeric>
#include <vector>

#include "engine/core/hash.h"
#include "engine/schedule/schedule.h"
#include "tests/support/scale.h"

/// Simulates a small world of balls that age, move, heat up, split and die, under every executor. All results must
/// agree to the bit.

namespace gloam {
namespace {

struct Position {
  float x = 0;
  float y = 0;
};
struct Velocity {
  float x = 0;
  float y = 0;
};
struct Age {
  std::uint32_t frames = 0;
};
struct Heat {
  float kelvin = 300;
};
struct Marked {};

struct Frame {
  std::uint32_t number = 0;
};
struct Centre {
  float x = 0;
  float y = 0;
};
struct Histogram {
  std::vector<std::uint32_t> bins;
};
struct Journal {
  std::uint64_t hash = 0;
};
struct Visible {
  std::vector<Entity> entities;
};

void count_frames(Resource<Frame> frame) { ++frame->number; }

void grow_older(View<Age> view, JobExecutor& jobs) {
  view.parallel_each(jobs, 16, [](Age& age) { ++age.frames; });
}

void find_centre(View<const Position> view, Resource<Centre> centre, JobExecutor& jobs) {
  std::vector<Centre> partial(view.chunk_count(32));
  view.parallel_chunks(jobs, 32, [&](std::size_t ordinal, std::span<const Position> positions) {
    for (const Position& p : positions) {
      partial[ordinal].x += p.x;
      partial[ordinal].y += p.y;
    }
  });
  *centre = {};
  for (const Centre& part : partial) {  // floats: the order of the sum matters
    centre->x += part.x;
    centre->y += part.y;
  }
}

void attract(View<const Position, Velocity> view, Resource<const Centre> centre, JobExecutor& jobs) {
  const float scale = 0.001f / static_cast<float>(view.size() + 1);
  view.parallel_each(jobs, 8, [&](const Position& p, Velocity& v) {
    v.x += (centre->x * scale - p.x) * 0.01f;
    v.y += (centre->y * scale - p.y) * 0.01f;
  });
}

void move_on(View<Position, const Velocity> view, JobExecutor& jobs) {
  view.parallel_each(jobs, 8, [](Position& p, const Velocity& v) {
    p.x += v.x;
    p.y += v.y;
  });
}

void warm(View<Heat, const Velocity, Without<Marked>> view) {
  view.each([](Heat& heat, const Velocity& v) { heat.kelvin += v.x * v.x + v.y * v.y; });
}

void cool(View<Heat, const Age> view) {
  view.each([](Heat& heat, const Age& age) { heat.kelvin -= 0.01f * static_cast<float>(age.frames % 7); });
}

void mark_hot(View<const Heat, Without<Marked>> view, Commands& commands) {
  view.each([&](Entity e, const Heat& heat) {
    if (heat.kelvin > 301.0f) commands.add<Marked>(e);
  });
}

void split(View<const Position, const Velocity, const Age> view, Resource<const Frame> frame, JobExecutor& jobs,
           Commands& commands) {
  CommandLists& lists = commands.ranges(view.chunk_count(16));
  view.parallel_chunks(jobs, 16,
                       [&](std::size_t ordinal, std::span<const Entity> entities, std::span<const Position> p,
                           std::span<const Velocity> v, std::span<const Age> age) {
                         for (std::size_t i = 0; i < entities.size(); ++i) {
                           if ((age[i].frames + entities[i].index + frame->number) % 23 != 0) continue;
                           lists[ordinal].create(p[i], Velocity{-v[i].x, v[i].y}, Age{}, Heat{});
                         }
                       });
}

void die(View<const Age> view, Commands& commands) {
  view.each([&](Entity e, const Age& age) {
    if (age.frames > 30 + e.index % 5) commands.destroy(e);
  });
}

void count_ages(View<const Age> view, Resource<Histogram> histogram, JobExecutor& jobs) {
  histogram->bins.assign(40, 0);
  std::vector<std::vector<std::uint32_t>> partial(view.chunk_count(64), std::vector<std::uint32_t>(40, 0));
  view.parallel_chunks(jobs, 64, [&](std::size_t ordinal, std::span<const Age> ages) {
    for (const Age& age : ages) ++partial[ordinal][age.frames % 40];
  });
  for (const auto& part : partial) {
    for (std::size_t i = 0; i < part.size(); ++i) histogram->bins[i] += part[i];
  }
}

void write_journal(Resource<Journal> journal, Resource<const Histogram> histogram,
                   OptionalResource<const Centre> centre) {
  Hasher hasher;
  hasher.value(journal->hash).value(std::bit_cast<std::uint32_t>(centre->x));
  for (const std::uint32_t bin : histogram->bins) hasher.value(bin);
  journal->hash = hasher.digest();
}

void cull(View<const Position> view, ViewResource<Visible> visible, ViewId id) {
  visible->entities.clear();
  view.each([&](Entity e, const Position& p) {
    if ((p.x > 0) == (id.value == 0)) visible->entities.push_back(e);
  });
}

void heat_seen(View<Heat> view, ViewResource<const Visible> visible) {
  for (const Entity e : visible->entities) {
    if (Heat* heat = view.try_get<Heat>(e)) heat->kelvin += 0.001f;
  }
}

void add_systems(Schedule& schedule) {
  schedule.add_system("count_frames", "toy", Stage::world, &count_frames);
  schedule.add_system("grow_older", "toy", Stage::world, &grow_older);
  schedule.add_system("find_centre", "toy", Stage::world, &find_centre);
  schedule.add_system("attract", "toy", Stage::world, &attract);
  schedule.add_system("move_on", "toy", Stage::world, &move_on);
  schedule.add_system("warm", "toy", Stage::world, &warm);
  schedule.add_system("cool", "toy", Stage::world, &cool);
  schedule.add_system("mark_hot", "toy", Stage::world, &mark_hot);
  schedule.add_system("split", "toy", Stage::world, &split);
  schedule.add_system("die", "toy", Stage::world, &die);
  schedule.add_system("count_ages", "toy", Stage::world, &count_ages);
  schedule.add_system("write_journal", "toy", Stage::world, &write_journal);
  schedule.add_system("cull", "toy", Stage::view, &cull);
  schedule.add_system("heat_seen", "toy", Stage::view, &heat_seen);
}

std::unique_ptr<World> make_world() {
  auto world = std::make_unique<World>();
  world->register_component<Position>("position");
  world->register_component<Velocity>("velocity");
  world->register_component<Age>("age");
  world->register_component<Heat>("heat");
  world->register_component<Marked>("marked");
  world->set_resource(Frame{});
  world->set_resource(Centre{});
  world->set_resource(Histogram{});
  world->set_resource(Journal{});
  for (std::uint32_t view = 0; view < 2; ++view) world->set_view_resource(ViewId{view}, Visible{});
  for (std::uint32_t i = 0; i < 300; ++i) {
    const auto x = static_cast<float>(i % 17) - 8.0f;
    const auto y = static_cast<float>(i % 29) - 14.0f;
    world->create(Position{x, y}, Velocity{y * 0.1f, x * -0.1f}, Age{i % 11}, Heat{});
  }
  return world;
}

std::uint64_t hash_of(const World& world) {
  Hasher hasher;
  hasher.value(world.entity_count()).value(world.resource<Journal>().hash);
  world.view<const Position, const Velocity, const Age, const Heat>().each(
      [&](Entity e, const Position& p, const Velocity& v, const Age& age, const Heat& heat) {
        hasher.value(e.index).value(e.generation).value(age.frames).value(world.has<Marked>(e));
        for (const float f : {p.x, p.y, v.x, v.y, heat.kelvin}) hasher.value(std::bit_cast<std::uint32_t>(f));
      });
  for (std::uint32_t view = 0; view < 2; ++view) {
    for (const Entity e : world.view_resource<Visible>(ViewId{view}).entities) hasher.value(e.index);
  }
  return hasher.digest();
}

/// The hash after every frame, so that a difference shows in which frame it begins.
std::vector<std::uint64_t> hashes_under(JobExecutor& executor, bool checked = false) {
  const auto world = make_world();
  Schedule schedule;
  add_systems(schedule);
  schedule.set_checked(checked);
  std::vector<std::uint64_t> hashes;
  for (int frame = 0; frame < 60; ++frame) {
    schedule.run(Stage::world, *world, executor);
    for (std::uint32_t view = 0; view < 2; ++view) schedule.run_view(ViewId{view}, *world, executor);
    hashes.push_back(hash_of(*world));
  }
  return hashes;
}

TEST(determinism, a_toy_world_changes_and_lives) {
  const auto serial = make_serial_executor();
  std::vector<std::uint64_t> hashes = hashes_under(*serial);
  std::ranges::sort(hashes);
  EXPECT_EQ(std::ranges::adjacent_find(hashes), hashes.end());
}

TEST(determinism, every_legal_order_gives_the_serial_result) {
  const auto serial = make_serial_executor();
  const std::vector<std::uint64_t> expected = hashes_under(*serial);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto shuffled = make_shuffled_executor(seed);
    ASSERT_EQ(hashes_under(*shuffled), expected) << "seed " << seed;
  }
}

TEST(determinism, every_number_of_threads_gives_the_serial_result) {
  const auto serial = make_serial_executor();
  const std::vector<std::uint64_t> expected = hashes_under(*serial);
  for (const std::uint32_t threads : {1u, 2u, 8u}) {
    const auto pool = make_pool_executor(threads);
    for (int round = 0; round < test::scaled(5); ++round) {
      ASSERT_EQ(hashes_under(*pool), expected) << threads << " threads";
    }
  }
}

TEST(determinism, checks_change_nothing_and_find_every_access_declared) {
  const auto serial = make_serial_executor();
  const auto pool = make_pool_executor(2);
  EXPECT_EQ(hashes_under(*pool, true), hashes_under(*serial));
}

}  // namespace
}  // namespace gloam

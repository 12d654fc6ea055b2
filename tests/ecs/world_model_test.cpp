// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// Compares a World with a model, a map of maps: every operation is applied to both, and both must give the same
// answers.
#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "engine/ecs/commands.h"
#include "engine/ecs/view.h"
#include "tests/ecs/components.h"
#include "tests/support/scale.h"

namespace gloam::test {
namespace {

constexpr int kKinds = 6;
using Row = std::map<int, int>;  // kind -> value
using Key = std::pair<std::uint32_t, std::uint32_t>;
using Model = std::map<Key, Row>;

Key key(Entity e) { return {e.index, e.generation}; }

// Each component value encodes one number in all of its bytes.
void make(int value, Health& out) { out.value = value; }
void make(int value, Position& out) {
  out = {static_cast<float>(value), static_cast<float>(value + 1), static_cast<float>(value + 2)};
}
void make(int value, Serial& out) { out.value = static_cast<std::uint64_t>(value) * 0x100000001ull; }
void make(int value, Big& out) {
  auto word = static_cast<std::uint32_t>(value);
  for (std::uint32_t& each : out.words) each = word += 7;
}
void make(int, Frozen&) {}
void make(int, Visible&) {}

template <class T>
T made(int value) {
  T out{};
  make(value, out);
  return out;
}
template <class T>
bool has_value(const T& cell, int value) {
  if constexpr (std::is_empty_v<T>) {
    return true;
  } else {
    const T expected = made<T>(value);
    return std::memcmp(&cell, &expected, sizeof(T)) == 0;
  }
}

template <class F>
void with_kind(int kind, F&& f) {
  switch (kind) {
    case 0:
      return f.template operator()<Health>();
    case 1:
      return f.template operator()<Position>();
    case 2:
      return f.template operator()<Serial>();
    case 3:
      return f.template operator()<Big>();
    case 4:
      return f.template operator()<Frozen>();
    default:
      return f.template operator()<Visible>();
  }
}

class Pair {
 public:
  explicit Pair(std::uint64_t seed) : random_(seed) {}

  void step() {
    const int what = number(100);
    if (what < 22) return create();
    if (what < 24) return create_bulk();
    if (living_.empty()) return;
    const Entity e = living_[static_cast<std::size_t>(number(static_cast<int>(living_.size())))];
    if (what < 44) return destroy(e);
    if (what < 64) return add(e);
    if (what < 80) return remove(e);
    if (what < 90) return write(e);
    if (what < 95) return command(e);
    return read_dead();
  }

  void compare() {
    ASSERT_EQ(world_.entity_count(), model_.size());
    for (const auto& [id, row] : model_) {
      const Entity e{id.first, id.second};
      ASSERT_TRUE(world_.alive(e));
      for (int kind = 0; kind < kKinds; ++kind) {
        with_kind(kind, [&]<class T>() {
          const auto expected = row.find(kind);
          ASSERT_EQ(world_.has<T>(e), expected != row.end());
          if (expected == row.end()) return;
          ASSERT_TRUE(has_value<T>(std::as_const(world_).get<T>(e), expected->second));
        });
      }
    }
    compare_views();
  }

  void write_through_view() {
    world_.view<Health, Without<Frozen>>().each([](Health& health) { health.value ^= 5; });
    for (auto& [id, row] : model_) {
      if (row.contains(0) && !row.contains(4)) row[0] ^= 5;
    }
  }

 private:
  int number(int below) { return static_cast<int>(random_() % static_cast<std::uint64_t>(below)); }
  int value() { return number(1'000'000); }

  void note(Entity e, Row row) {
    ASSERT_TRUE(model_.emplace(key(e), std::move(row)).second) << "an entity was handed out twice";
    living_.push_back(e);
  }
  void create() {
    const int v = value();
    switch (number(4)) {
      case 0:
        return note(world_.create(), {});
      case 1:
        return note(world_.create(made<Health>(v)), {{0, v}});
      case 2:
        return note(world_.create(made<Big>(v), Frozen{}, made<Health>(v)), {{3, v}, {4, 0}, {0, v}});
      default:
        return note(world_.create(made<Serial>(v), made<Position>(v)), {{2, v}, {1, v}});
    }
  }
  void create_bulk() {
    const int v = value();
    std::vector<Entity> out(static_cast<std::size_t>(number(40)));
    world_.create_bulk(out, made<Position>(v), Visible{});
    for (const Entity e : out) note(e, {{1, v}, {5, 0}});
  }
  void destroy(Entity e) {
    world_.destroy(e);
    forget(e);
  }
  void forget(Entity e) {
    model_.erase(key(e));
    std::erase(living_, e);
    dead_.push_back(e);
  }
  void add(Entity e) {
    const int kind = number(kKinds);
    const int v = value();
    with_kind(kind, [&]<class T>() { world_.add<T>(e, made<T>(v)); });
    model_[key(e)][kind] = v;
  }
  void remove(Entity e) {
    const int kind = number(kKinds);
    with_kind(kind, [&]<class T>() { ASSERT_EQ(world_.remove<T>(e), model_[key(e)].erase(kind) == 1); });
  }
  void write(Entity e) {
    for (auto& [kind, old] : model_[key(e)]) {
      old = value();
      with_kind(kind, [&, v = old]<class T>() { world_.get<T>(e) = made<T>(v); });
    }
  }
  void command(Entity e) {
    const int v = value();
    CommandBuffer buffer;
    buffer.add<Serial>(e, made<Serial>(v));
    buffer.remove<Position>(e);
    const bool destroys = number(3) == 0;
    if (destroys) buffer.destroy(e);
    buffer.add<Frozen>(e);
    const CommandReport report = buffer.apply(world_);
    ASSERT_EQ(report.skipped, destroys ? 1u : 0u);
    if (destroys) return forget(e);
    Row& row = model_[key(e)];
    row[2] = v;
    row[4] = 0;
    row.erase(1);
  }
  void read_dead() {
    if (dead_.empty()) return;
    const Entity e = dead_[static_cast<std::size_t>(number(static_cast<int>(dead_.size())))];
    ASSERT_FALSE(world_.alive(e));
    ASSERT_EQ(world_.try_get<Health>(e), nullptr);
  }

  void compare_views() {
    std::set<Key> seen;
    const World& world = world_;
    world.view<const Health, Maybe<const Position>, Without<Visible>>().each(
        [&](Entity e, const Health& health, const Position* position) {
          ASSERT_TRUE(seen.insert(key(e)).second);
          const Row& row = model_.at(key(e));
          ASSERT_TRUE(has_value(health, row.at(0)));
          ASSERT_EQ(position != nullptr, row.contains(1));
          if (position != nullptr) {
            ASSERT_TRUE(has_value(*position, row.at(1)));
          }
        });
    std::size_t expected = 0;
    for (const auto& [id, row] : model_) expected += row.contains(0) && !row.contains(5) ? 1u : 0u;
    ASSERT_EQ(seen.size(), expected);
    std::size_t tagged = 0;
    for (const auto& [id, row] : model_) tagged += row.contains(4) && row.contains(2) ? 1u : 0u;
    ASSERT_EQ((world.view<const Serial, With<Frozen>>().size()), tagged);
  }

  std::mt19937_64 random_;
  TestWorld world_;
  Model model_;
  std::vector<Entity> living_;
  std::vector<Entity> dead_;
};

TEST(World, agrees_with_a_map_of_maps_over_random_operations) {
  Pair pair(20240607);
  const int operations = scaled(100'000);
  for (int i = 0; i < operations; ++i) {
    pair.step();
    if (i % 1000 == 0) pair.write_through_view();
    if (i % 2000 == 0) pair.compare();
    ASSERT_FALSE(::testing::Test::HasFailure()) << "operation " << i;
  }
  pair.compare();
}

}  // namespace
}  // namespace gloam::test

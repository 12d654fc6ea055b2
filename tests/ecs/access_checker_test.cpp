// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/ecs/access_checker.h"

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/ecs/commands.h"
#include "engine/ecs/view.h"
#include "engine/jobs/executor.h"
#include "tests/ecs/components.h"

namespace gloam::test {
namespace {

/// Records its calls: "r0" reads component 0, "w!name" writes a resource, "structure" is a structural change.
class Notebook final : public AccessChecker {
 public:
  explicit Notebook(World& world) : world_(world) { world_.set_access_checker(this); }
  ~Notebook() override { world_.set_access_checker(nullptr); }
  void component(ComponentId id, bool write) override { notes_.push_back((write ? "w" : "r") + std::to_string(id)); }
  void resource(std::string_view type_name, bool write) override {
    notes_.push_back((write ? "w!" : "r!") + std::string(type_name));
  }
  void structure() override { notes_.emplace_back("structure"); }

  std::vector<std::string> take() { return std::exchange(notes_, {}); }

 private:
  World& world_;
  std::vector<std::string> notes_;
};
using Notes = std::vector<std::string>;

TEST(AccessChecker, sees_components_by_what_may_be_done_to_them) {
  TestWorld world;
  const Entity e = world.create(Health{}, Position{});
  Notebook notebook(world);
  (void)world.get<Health>(e);
  (void)std::as_const(world).get<Health>(e);
  (void)world.try_get<Position>(e);
  (void)std::as_const(world).try_get<Position>(e);
  world.mark_changed<Health>(e);
  EXPECT_EQ(notebook.take(), (Notes{"w0", "r0", "w1", "r1", "w0"}));
  (void)world.has<Health>(e);
  (void)world.alive(e);
  EXPECT_EQ(notebook.take(), Notes{}) << "what an entity has is no secret";
}

TEST(AccessChecker, sees_views_when_they_iterate) {
  TestWorld world;
  const Entity e = world.create(Health{}, Position{});
  Notebook notebook(world);
  const auto view = world.view<Position, const Health, Maybe<const Serial>, Without<Frozen>>();
  EXPECT_EQ(view.size(), 1u);
  EXPECT_EQ(notebook.take(), Notes{});
  const Notes columns = {"w1", "r0", "r2"};
  view.each([](Position&, const Health&, const Serial*) {});
  EXPECT_EQ(notebook.take(), columns);
  view.each_chunk([](std::span<Position>, std::span<const Health>, std::span<const Serial>) {});
  EXPECT_EQ(notebook.take(), columns);
  view.parallel_each(*make_serial_executor(), 1, [](Position&, const Health&, const Serial*) {});
  EXPECT_EQ(notebook.take(), columns);
  (void)view.changed_since<Health>(0, [](std::span<Position>, std::span<const Health>, std::span<const Serial>) {});
  EXPECT_EQ(notebook.take(), columns);
  (void)view.try_get<Health>(e);
  (void)view.try_get<Position>(e);
  view.mark_changed<Position>();
  EXPECT_EQ(notebook.take(), (Notes{"r0", "w1", "w1"}));
}

TEST(AccessChecker, sees_resources_and_structural_changes) {
  TestWorld world;
  Notebook notebook(world);
  world.set_resource(1);
  (void)world.resource<int>();
  (void)std::as_const(world).try_resource<int>();
  world.set_view_resource(ViewId{1}, 2);
  (void)std::as_const(world).view_resource<int>(ViewId{1});
  (void)world.try_view_resource<int>(ViewId{1});
  EXPECT_EQ(notebook.take(), (Notes{"w!int", "w!int", "r!int", "w!int", "r!int", "w!int"}));
  const Entity e = world.create(Health{});
  world.add<Position>(e);
  world.remove<Position>(e);
  world.destroy(e);
  EXPECT_EQ(notebook.take(), Notes(4, "structure"));
}

}  // namespace
}  // namespace gloam::test

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/plan_cache.h"

#include "tests/frame/graph_fixture.h"

namespace gloam::test {
namespace {

class PlanCacheTest : public GraphFixture {
 public:
  /// Runs one kept pass that writes an image of side × side RGBA8 texels.
  void run_image_frame(std::uint32_t side) {
    run_frame([side](FrameGraph& g) {
      PassBuilder pass = g.add_pass("a", "test");
      (void)pass.write(g.create_image(image_desc("image", side)), Access::compute_write);
      pass.keep();
    });
  }
};

TEST_F(PlanCacheTest, equal_structures_compile_once) {
  for (int i = 0; i < 5; ++i) run_image_frame(16);
  EXPECT_EQ(graph.plans_compiled(), 1u);
  EXPECT_EQ(bytes_of_module("test"), 16u * 16 * 4);
  EXPECT_EQ(graph.transient_bytes(), 16u * 16 * 4);
}

TEST_F(PlanCacheTest, toggling_compiles_nothing_again) {
  run_image_frame(16);
  const std::uint64_t hash = graph.plan_hash();
  run_image_frame(32);
  EXPECT_NE(graph.plan_hash(), hash);
  for (int i = 0; i < 10; ++i) run_image_frame(i % 2 == 0 ? 16 : 32);
  EXPECT_EQ(graph.plans_compiled(), 2u);
}

TEST_F(PlanCacheTest, the_plan_used_longest_ago_is_dropped_with_its_memory) {
  const std::uint32_t kept = frame::PlanCache::kPlansKept;
  std::uint64_t expected = 0;
  for (std::uint32_t side = 1; side <= kept + 1; ++side) {
    run_image_frame(side);
    if (side > 1) expected += side * side * 4;
  }
  EXPECT_EQ(bytes_of_module("test"), expected);
  run_image_frame(kept + 1);
  EXPECT_EQ(graph.plans_compiled(), kept + 1);
  run_image_frame(1);
  EXPECT_EQ(graph.plans_compiled(), kept + 2);
}

TEST_F(PlanCacheTest, a_plan_that_rests_gives_its_memory_back_but_stays_compiled) {
  run_image_frame(64);
  for (std::uint64_t i = 0; i <= frame::PlanCache::kUsesBeforeMemoryIsFreed; ++i) run_image_frame(16);
  EXPECT_EQ(bytes_of_module("test"), 16u * 16 * 4);
  run_image_frame(64);
  EXPECT_EQ(graph.plans_compiled(), 2u);
  EXPECT_EQ(bytes_of_module("test"), (16u * 16 + 64 * 64) * 4);
  graph.free_idle_memory();
  EXPECT_EQ(bytes_of_module("test"), 64u * 64 * 4);
}

TEST_F(PlanCacheTest, memory_that_cannot_be_had_is_an_error_and_is_tried_again) {
  device->fail_next_creation({.message = "out of memory"});
  graph.begin();
  PassBuilder pass = graph.add_pass("a", "test");
  (void)pass.write(graph.create_buffer(buffer_desc("buffer")), Access::compute_write);
  pass.keep();
  const Status failed = graph.compile();
  ASSERT_FALSE(failed.ok());
  EXPECT_EQ(failed.error().message, "out of memory");
  EXPECT_EQ(bytes_of_module("test"), 0u);
  ASSERT_TRUE(graph.compile().ok());
  EXPECT_EQ(bytes_of_module("test"), 256u);
}

TEST_F(PlanCacheTest, all_memory_ends_with_the_graph) {
  {
    FrameGraph own(*device);
    own.begin();
    PassBuilder pass = own.add_pass("a", "test");
    (void)pass.write(own.create_buffer(buffer_desc("buffer")), Access::compute_write);
    pass.keep();
    ASSERT_TRUE(own.compile().ok());
    EXPECT_EQ(bytes_of_module("test"), 256u);
  }
  EXPECT_EQ(bytes_of_module("test"), 0u);
}

}  // namespace
}  // namespace gloam::test

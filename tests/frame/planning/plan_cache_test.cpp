// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/planning/plan_cache.h"

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
  [[nodiscard]] std::uint64_t total_bytes() const {
    std::uint64_t bytes = 0;
    for (const gpu::ModuleMemory& m : device->memory()) bytes += m.bytes;
    return bytes;
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

TEST_F(PlanCacheTest, the_plan_used_longest_ago_is_dropped) {
  const std::uint32_t kept = frame::PlanCache::kPlansKept;
  for (std::uint32_t side = kept + 1; side >= 1; --side) run_image_frame(side);
  EXPECT_EQ(total_bytes(), kept * kept * 4) << "the largest plan was the first one";
  run_image_frame(1);
  EXPECT_EQ(graph.plans_compiled(), kept + 1);
  run_image_frame(kept + 1);
  EXPECT_EQ(graph.plans_compiled(), kept + 2);
}

// Hard case: passes.knob_step_memory
TEST_F(PlanCacheTest, plans_that_fit_the_memory_allocate_nothing) {
  run_image_frame(64);
  const std::uint64_t allocations = device->allocations();
  for (const std::uint32_t side : {16u, 64u, 32u, 63u, 16u, 64u}) run_image_frame(side);
  EXPECT_EQ(graph.plans_compiled(), 4u);
  EXPECT_EQ(device->allocations(), allocations);
  EXPECT_EQ(total_bytes(), 64u * 64 * 4);
  run_image_frame(65);
  EXPECT_EQ(device->allocations(), allocations + 1);
  EXPECT_EQ(total_bytes(), 65u * 65 * 4);
  for (const std::uint32_t side : {64u, 16u, 65u}) run_image_frame(side);
  EXPECT_EQ(device->allocations(), allocations + 1);
}

TEST_F(PlanCacheTest, bytes_are_accounted_to_the_modules_of_the_current_plan) {
  run_image_frame(64);
  EXPECT_EQ(bytes_of_module("test"), 64u * 64 * 4);
  EXPECT_EQ(bytes_of_module("engine"), 0u);
  run_image_frame(16);
  EXPECT_EQ(bytes_of_module("test"), 16u * 16 * 4);
  EXPECT_EQ(bytes_of_module("engine"), (64u * 64 - 16 * 16) * 4);
}

TEST_F(PlanCacheTest, memory_that_modules_share_is_accounted_to_the_one_that_needs_most) {
  // A small image of one module, and after it a large one of another, in the same memory.
  for (const bool small_first : {true, false}) {
    run_frame([small_first](FrameGraph& g) {
      for (const bool small : {small_first, !small_first}) {
        gpu::ImageDesc desc = image_desc(small ? "little" : "great", small ? 8 : 64);
        desc.module = small ? "little" : "great";
        PassBuilder pass = g.add_pass(desc.name, desc.module);
        (void)pass.write(g.create_image(desc), Access::compute_write);
        pass.keep();
      }
    });
    EXPECT_EQ(graph.transient_bytes(), 64u * 64 * 4) << "they share";
    EXPECT_EQ(bytes_of_module("great"), 64u * 64 * 4);
    EXPECT_EQ(bytes_of_module("little"), 0u);
  }
}

TEST_F(PlanCacheTest, a_plan_that_rests_gives_its_memory_back_but_stays_compiled) {
  run_image_frame(64);
  for (std::uint64_t i = 0; i < frame::PlanCache::kUsesBeforeMemoryIsFreed; ++i) run_image_frame(16);
  EXPECT_EQ(total_bytes(), 64u * 64 * 4);
  run_image_frame(16);
  EXPECT_EQ(total_bytes(), 16u * 16 * 4);
  run_image_frame(64);
  EXPECT_EQ(graph.plans_compiled(), 2u);
  EXPECT_EQ(total_bytes(), 64u * 64 * 4);
}

TEST_F(PlanCacheTest, freeing_idle_memory_leaves_what_the_current_plan_needs) {
  run_image_frame(64);
  run_image_frame(16);
  graph.free_idle_memory();
  EXPECT_EQ(total_bytes(), 16u * 16 * 4);
  run_image_frame(16);
  EXPECT_EQ(total_bytes(), 16u * 16 * 4);
  graph.begin();
  graph.free_idle_memory();
  EXPECT_EQ(total_bytes(), 0u);
  run_image_frame(16);
  EXPECT_EQ(total_bytes(), 16u * 16 * 4);
}

TEST_F(PlanCacheTest, idle_memory_may_be_freed_between_compile_and_execute) {
  run_image_frame(64);
  auto commands = device->begin_frame();
  graph.begin();
  PassBuilder pass = graph.add_pass("a", "test");
  const ImageRef image = pass.write(graph.create_image(image_desc("image", 16)), Access::transfer_write);
  pass.keep();
  pass.execute([&](PassContext& context) { context.commands().clear_color_image(context.image(image), {}); });
  ASSERT_TRUE(graph.compile().ok());
  graph.free_idle_memory();
  graph.execute(**commands);
  ASSERT_TRUE(device->submit_frame().ok());
  EXPECT_EQ(total_bytes(), 16u * 16 * 4);
}

TEST_F(PlanCacheTest, the_first_barriers_of_another_plan_wait_for_all_users_of_the_memory) {
  const auto run_clear = [&](std::uint32_t side) {
    device->forget_commands();
    run_frame([side](FrameGraph& g) {
      PassBuilder pass = g.add_pass("clear", "test");
      const ImageRef image = pass.write(g.create_image(image_desc("image", side)), Access::transfer_write);
      pass.keep();
      pass.execute([=](PassContext& context) { context.commands().clear_color_image(context.image(image), {}); });
    });
    return texts("barrier").at(0);
  };
  EXPECT_EQ(run_clear(64), "barrier 'image' none|transfer_write>transfer_write");
  run_image_frame(32);
  EXPECT_EQ(texts("barrier").back(), "barrier 'image' none|transfer_write|compute_write>compute_write");
  run_image_frame(32);
  EXPECT_EQ(texts("barrier").back(), "barrier 'image' none|compute_write>compute_write");
  EXPECT_EQ(run_clear(64), "barrier 'image' none|transfer_write|compute_write>transfer_write");
  EXPECT_EQ(run_clear(64), "barrier 'image' none|transfer_write>transfer_write");
}

// Hard case: passes.memory_types
TEST_F(PlanCacheTest, depth_and_colour_have_memory_of_different_types) {
  run_frame([](FrameGraph& g) {
    PassBuilder first = g.add_pass("depth", "test");
    (void)first.write(g.create_image(image_desc("depth", 64, gpu::Format::d32_float)), Access::depth_target);
    first.keep();
    PassBuilder second = g.add_pass("colour", "test");
    (void)second.write(g.create_image(image_desc("colour", 64)), Access::color_target);
    second.keep();
  });
  EXPECT_EQ(graph.transient_bytes(), 2u * 64 * 64 * 4) << "lifetimes are disjoint, but the memory differs";
  const std::uint64_t allocations = device->allocations();
  run_image_frame(64);
  EXPECT_EQ(device->allocations(), allocations);
  EXPECT_EQ(total_bytes(), 2u * 64 * 64 * 4);
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

TEST_F(PlanCacheTest, a_plan_without_memory_does_not_take_it_from_others) {
  run_image_frame(16);
  device->fail_next_creation({.message = "out of memory"});
  graph.begin();
  PassBuilder pass = graph.add_pass("a", "test");
  (void)pass.write(graph.create_image(image_desc("image", 64)), Access::compute_write);
  pass.keep();
  ASSERT_FALSE(graph.compile().ok());
  const std::uint64_t allocations = device->allocations();
  run_image_frame(16);
  EXPECT_EQ(device->allocations(), allocations);
  EXPECT_EQ(total_bytes(), 16u * 16 * 4);
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

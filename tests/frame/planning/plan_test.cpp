// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/frame/planning/plan.h"

#include <gmock/gmock.h>

#include <optional>

#include "engine/gpu/access.h"

namespace gloam::frame {
namespace {

using gpu::Access;
using gpu::mask_of;

/// Builds declarations without a FrameGraph, to test plans alone.
class Declarer {
 public:
  std::uint32_t image(std::uint32_t side = 64) {
    DeclaredResource& r = declaration.resources.add();
    r.is_image = true;
    r.image_desc = {.name = "image", .format = gpu::Format::r32_float, .width = side, .height = side};
    return declaration.resources.size() - 1;
  }
  std::uint32_t buffer(std::uint64_t size = 64) {
    declaration.resources.add().buffer_desc = {.name = "buffer", .size = size};
    return declaration.resources.size() - 1;
  }
  std::uint32_t import_image(Access before, Access after) {
    const std::uint32_t r = image();
    declaration.resources[r].imported = true;
    declaration.resources[r].before = before;
    declaration.resources[r].after = after;
    return r;
  }
  std::uint32_t import_buffer(Access before, Access after) {
    const std::uint32_t r = buffer();
    declaration.resources[r].imported = true;
    declaration.resources[r].before = before;
    declaration.resources[r].after = after;
    return r;
  }
  Declarer& pass(bool keep = true) {
    DeclaredPass& pass = declaration.passes.add();
    pass.keep = keep;
    pass.first_use = static_cast<std::uint32_t>(declaration.uses.size());
    return *this;
  }
  Declarer& use(std::uint32_t resource, Access access) {
    const bool write = gpu::is_write(access);
    declaration.uses.push_back({.resource = resource, .accesses = mask_of(access), .reads = !write, .writes = write});
    ++declaration.passes.back().use_count;
    return *this;
  }

  Declaration declaration;
};

std::vector<PlannedBarrier> barriers_of(const Plan& plan, std::size_t pass) {
  const auto first = plan.barriers.begin() + plan.passes[pass].first_barrier;
  return {first, first + plan.passes[pass].barrier_count};
}

TEST(plan, passes_that_nobody_needs_are_culled) {
  Declarer d;
  const auto chain_a = d.buffer();
  const auto chain_b = d.buffer();
  const auto unused = d.buffer();
  const auto out = d.import_buffer(Access::none, Access::none);
  d.pass(false).use(chain_a, Access::compute_write);                                     // 0: feeds 2
  d.pass(false).use(unused, Access::compute_write);                                      // 1: never read
  d.pass(false).use(chain_a, Access::compute_read).use(chain_b, Access::compute_write);  // 2: feeds 3
  d.pass(false).use(chain_b, Access::compute_read).use(out, Access::compute_write);      // 3: root
  d.pass(false).use(chain_b, Access::compute_read);                                      // 4: writes nothing
  d.pass(true);                                                                          // 5: kept
  const Plan plan = compile_plan(d.declaration);
  std::vector<std::uint32_t> live;
  for (const PlannedPass& pass : plan.passes) live.push_back(pass.pass);
  EXPECT_THAT(live, testing::ElementsAre(0, 2, 3, 5));
  EXPECT_EQ(plan.lives[unused].first, kNone);
}

TEST(plan, a_write_after_the_last_needed_one_is_culled) {
  Declarer d;
  const auto buffer = d.buffer();
  const auto out = d.import_buffer(Access::none, Access::none);
  d.pass(false).use(buffer, Access::compute_write);
  d.pass(false).use(buffer, Access::compute_read).use(out, Access::compute_write);
  d.pass(false).use(buffer, Access::compute_write);
  EXPECT_EQ(compile_plan(d.declaration).passes.size(), 2u);
}

TEST(plan, neighbouring_reads_share_one_barrier_that_names_them_all) {
  Declarer d;
  const auto image = d.image();
  d.pass().use(image, Access::compute_write);
  d.pass().use(image, Access::compute_read);
  d.pass().use(image, Access::fragment_read);
  d.pass().use(image, Access::compute_read);
  const Plan plan = compile_plan(d.declaration);
  const auto barriers = barriers_of(plan, 1);
  ASSERT_EQ(barriers.size(), 1u);
  EXPECT_EQ(barriers[0].before, Access::compute_write);
  EXPECT_EQ(barriers[0].after, Access::compute_read);
  EXPECT_EQ(barriers[0].also_after, mask_of(Access::fragment_read));
  EXPECT_THAT(barriers_of(plan, 2), testing::IsEmpty());
  EXPECT_THAT(barriers_of(plan, 3), testing::IsEmpty());
}

TEST(plan, a_write_waits_for_every_read_before_it) {
  Declarer d;
  const auto buffer = d.buffer();
  d.pass().use(buffer, Access::compute_write);
  d.pass().use(buffer, Access::indirect_read);
  d.pass().use(buffer, Access::vertex_read);
  d.pass().use(buffer, Access::compute_write);
  const auto barriers = barriers_of(compile_plan(d.declaration), 3);
  ASSERT_EQ(barriers.size(), 1u);
  EXPECT_EQ(mask_of(barriers[0].before) | barriers[0].also_before,
            mask_of(Access::indirect_read) | mask_of(Access::vertex_read));
  EXPECT_EQ(barriers[0].after, Access::compute_write);
}

TEST(plan, a_write_after_a_write_has_a_barrier) {
  Declarer d;
  const auto image = d.image();
  d.pass().use(image, Access::color_target);
  d.pass().use(image, Access::color_target);
  const auto barriers = barriers_of(compile_plan(d.declaration), 1);
  ASSERT_EQ(barriers.size(), 1u);
  EXPECT_EQ(barriers[0].before, Access::color_target);
}

TEST(plan, reads_of_other_layouts_need_a_barrier_each_and_reads_of_buffers_do_not) {
  Declarer d;
  const auto image = d.image();
  const auto buffer = d.buffer();
  d.pass().use(image, Access::compute_write).use(buffer, Access::compute_write);
  d.pass().use(image, Access::compute_read).use(buffer, Access::compute_read);
  d.pass().use(image, Access::transfer_read).use(buffer, Access::transfer_read);
  const Plan plan = compile_plan(d.declaration);
  EXPECT_EQ(barriers_of(plan, 1).size(), 2u);
  ASSERT_EQ(barriers_of(plan, 2).size(), 1u);
  EXPECT_EQ(barriers_of(plan, 2)[0].resource, image);
}

TEST(plan, an_import_that_is_ready_needs_no_barrier) {
  Declarer d;
  const auto image = d.import_image(Access::fragment_read, Access::fragment_read);
  d.pass().use(image, Access::fragment_read);
  const Plan plan = compile_plan(d.declaration);
  EXPECT_THAT(plan.barriers, testing::IsEmpty());
}

TEST(plan, an_import_is_left_as_its_owner_wants_it_even_when_unused) {
  Declarer d;
  const auto used = d.import_image(Access::none, Access::present);
  const auto unused = d.import_image(Access::fragment_read, Access::compute_read);
  d.pass().use(used, Access::color_target);
  const Plan plan = compile_plan(d.declaration);
  ASSERT_EQ(plan.barriers.size() - plan.first_final_barrier, 2u);
  EXPECT_EQ(plan.barriers[plan.first_final_barrier].after, Access::present);
  EXPECT_EQ(plan.barriers[plan.first_final_barrier + 1].resource, unused);
}

TEST(plan, images_of_disjoint_lives_share_memory_and_wait_for_each_other) {
  Declarer d;
  const auto a = d.image(64);
  const auto b = d.image(64);
  const auto c = d.image(32);
  d.pass().use(a, Access::compute_write);
  d.pass().use(a, Access::compute_read).use(b, Access::color_target);
  d.pass().use(b, Access::fragment_read).use(c, Access::compute_write);
  const Plan plan = compile_plan(d.declaration);
  ASSERT_EQ(plan.image_slots.size(), 2u);
  EXPECT_EQ(plan.lives[a].slot, plan.lives[c].slot);
  EXPECT_NE(plan.lives[a].slot, plan.lives[b].slot);
  EXPECT_EQ(plan.transient_bytes, 2u * 64 * 64 * 4);
  EXPECT_EQ(plan.unshared_bytes, 2u * 64 * 64 * 4 + 32 * 32 * 4);
  const PlannedBarrier& takes_over = plan.barriers[plan.lives[c].first_barrier];
  EXPECT_EQ(takes_over.before, Access::none);
  EXPECT_EQ(takes_over.also_before, mask_of(Access::compute_read));
  // In the next frame, `a` waits for `c`, the last user of the slot, and for itself, because `c` is smaller.
  EXPECT_EQ(plan.barriers[plan.lives[a].first_barrier].also_before,
            mask_of(Access::compute_write) | mask_of(Access::compute_read));
  EXPECT_EQ(plan.barriers[plan.lives[b].first_barrier].also_before, mask_of(Access::fragment_read));
}

TEST(plan, a_small_image_between_two_large_ones_does_not_hide_the_first) {
  Declarer d;
  const auto large = d.image(64);
  const auto small = d.image(32);
  const auto last = d.image(64);
  d.pass().use(large, Access::color_target);
  d.pass().use(large, Access::fragment_read);
  d.pass().use(small, Access::compute_write);
  d.pass().use(small, Access::compute_read);
  d.pass().use(last, Access::depth_target);
  const Plan plan = compile_plan(d.declaration);
  ASSERT_EQ(plan.image_slots.size(), 1u);
  EXPECT_EQ(plan.barriers[plan.lives[small].first_barrier].also_before, mask_of(Access::fragment_read));
  EXPECT_EQ(plan.barriers[plan.lives[last].first_barrier].also_before,
            mask_of(Access::compute_read) | mask_of(Access::fragment_read));
  EXPECT_EQ(plan.barriers[plan.lives[large].first_barrier].also_before, mask_of(Access::depth_target));
}

TEST(plan, buffers_of_equal_size_and_disjoint_lives_are_one_buffer) {
  Declarer d;
  const auto a = d.buffer(64);
  const auto b = d.buffer(64);
  const auto other_size = d.buffer(128);
  d.pass().use(a, Access::compute_write);
  d.pass().use(b, Access::compute_write);
  d.pass().use(other_size, Access::compute_write);
  const Plan plan = compile_plan(d.declaration);
  EXPECT_EQ(plan.lives[a].slot, plan.lives[b].slot);
  EXPECT_NE(plan.lives[a].slot, plan.lives[other_size].slot);
  EXPECT_EQ(plan.transient_bytes, 192u);
}

TEST(plan, usage_flags_follow_from_accesses_of_live_passes) {
  Declarer d;
  const auto image = d.image();
  const auto out = d.import_buffer(Access::none, Access::none);
  d.pass(false).use(image, Access::compute_write);
  d.pass(false).use(image, Access::fragment_read).use(out, Access::fragment_write);
  d.pass(false).use(image, Access::transfer_write);
  const auto usage = static_cast<gpu::ImageUsage>(compile_plan(d.declaration).lives[image].image_usage);
  EXPECT_EQ(usage, gpu::ImageUsage::storage | gpu::ImageUsage::sampled);
}

TEST(combine_accesses, reads_of_one_layout_go_together_and_writes_take_reads_in) {
  const auto combined = [](Access a, Access b, bool is_image) { return combine_accesses(mask_of(a), b, is_image); };
  EXPECT_EQ(combined(Access::compute_read, Access::fragment_read, true),
            mask_of(Access::compute_read) | mask_of(Access::fragment_read));
  EXPECT_EQ(combined(Access::compute_storage_read, Access::compute_write, true), mask_of(Access::compute_write));
  EXPECT_EQ(combined(Access::compute_write, Access::compute_read, false), mask_of(Access::compute_write));
  EXPECT_EQ(combined(Access::depth_test, Access::fragment_read, true), mask_of(Access::depth_test));
  EXPECT_EQ(combined(Access::compute_write, Access::compute_read, true), 0u);
  EXPECT_EQ(combined(Access::indirect_read, Access::compute_write, false), 0u);
  EXPECT_EQ(combined(Access::compute_write, Access::fragment_write, false), 0u);
}

TEST(structural_hash, follows_names_descriptions_and_accesses_and_nothing_else) {
  const auto declare = [](std::uint32_t side, Access access, std::uint32_t handle) {
    Declarer d;
    const auto image = d.image(side);
    const auto import = d.import_image(Access::none, Access::present);
    d.declaration.resources[import].image = {handle, 1};
    d.pass().use(image, access).use(import, Access::color_target);
    return structural_hash(d.declaration);
  };
  EXPECT_EQ(declare(64, Access::compute_write, 1), declare(64, Access::compute_write, 2));
  EXPECT_NE(declare(64, Access::compute_write, 1), declare(65, Access::compute_write, 1));
  EXPECT_NE(declare(64, Access::compute_write, 1), declare(64, Access::color_target, 1));
}

}  // namespace
}  // namespace gloam::frame

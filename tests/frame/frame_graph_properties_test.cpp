// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <algorithm>

#include "engine/frame/planning/plan.h"
#include "engine/gpu/recording/device.h"
#include "tests/frame/random_frames.h"
#include "tests/support/property.h"

namespace gloam::test {
namespace {

RandomFrame any_frame() {
  return RandomFrame::from(*rc::gen::container<std::vector<std::uint32_t>>(rc::gen::arbitrary<std::uint32_t>()));
}

std::vector<std::string> names_of_reachable(RandomFrame frame, std::uint32_t pass_count) {
  frame.passes.resize(pass_count);
  const std::vector<bool> reachable = frame.reachable();
  std::vector<std::string> names;
  for (std::size_t p = 0; p < reachable.size(); ++p) {
    if (reachable[p]) names.push_back("p" + std::to_string(p));
  }
  return names;
}

TEST(frame_graph_properties, passes_run_in_order_exactly_when_reachable_and_without_hazards) {
  check_property(300, [] {
    const RandomFrame frame = any_frame();
    const auto all = static_cast<std::uint32_t>(frame.passes.size());
    const std::uint32_t some = *rc::gen::inRange(0u, all + 1);
    const auto device = gpu::make_recording_device();
    RandomFrameRunner runner(frame, *device, true);
    // Running the same structure again reuses the memory of its last frame; the other structure takes over the imports.
    for (std::uint32_t pass_count : {all, all, some, all, some, some}) {
      RC_ASSERT(runner.run(pass_count) == names_of_reachable(frame, pass_count));
      RC_ASSERT(device->faults() == std::vector<std::string>());
    }
  });
}

TEST(frame_graph_properties, resources_that_share_memory_never_live_at_once) {
  check_property(300, [] {
    const frame::Declaration declaration = any_frame().declaration();
    const frame::Plan plan = frame::compile_plan(declaration);
    std::vector<std::uint32_t> placed(declaration.resources.size(), 0);
    for (const auto* slots : {&plan.image_slots, &plan.buffer_slots}) {
      for (const frame::MemorySlot& slot : *slots) {
        for (std::size_t i = 0; i < slot.resources.size(); ++i) {
          ++placed[slot.resources[i]];
          if (i > 0) RC_ASSERT(plan.lives[slot.resources[i - 1]].last < plan.lives[slot.resources[i]].first);
        }
      }
    }
    for (std::uint32_t r = 0; r < declaration.resources.size(); ++r) {
      const bool needs_memory = !declaration.resources[r].imported && plan.lives[r].first != frame::kNone;
      RC_ASSERT(placed[r] == (needs_memory ? 1u : 0u));
    }
    RC_ASSERT(plan.transient_bytes <= plan.unshared_bytes);
  });
}

TEST(frame_graph_properties, no_barrier_stands_between_two_reads_of_one_layout) {
  check_property(300, [] {
    const RandomFrame frame = any_frame();
    const frame::Declaration declaration = frame.declaration();
    const frame::Plan plan = frame::compile_plan(declaration);
    std::vector<gpu::Subresources<gpu::Access>> last;
    for (const RandomFrame::Resource& resource : frame.resources) last.emplace_back(resource.mips, resource.layers);
    for (const frame::PlannedPass& planned : plan.passes) {
      const auto has_barrier = [&](const RandomFrame::Use& use, std::uint32_t first, std::uint32_t end) {
        return std::any_of(plan.barriers.begin() + first, plan.barriers.begin() + end, [&](const auto& barrier) {
          return barrier.resource == use.resource && frame.resources[use.resource].overlap(barrier.range, use.range);
        });
      };
      const std::uint32_t first = planned.first_barrier;
      const std::uint32_t end = first + planned.barrier_count;
      for (const RandomFrame::Use& use : frame.passes[planned.pass].uses) {
        const gpu::ImageRange range =
            gpu::resolve(use.range, frame.resources[use.resource].mips, frame.resources[use.resource].layers);
        const bool write = gpu::is_write(use.access);
        bool read_again = !write;
        bool used_before = false;
        last[use.resource].visit(range, [&](gpu::Access access) {
          read_again = read_again && access == use.access;
          used_before = used_before || access != gpu::Access::none;
        });
        if (read_again) RC_ASSERT(!has_barrier(use, first, end));
        // The first barrier of a mip or layer may stand before an earlier pass.
        if (write) RC_ASSERT(has_barrier(use, used_before ? first : 0, end));
        last[use.resource].set(range, use.access);
      }
    }
  });
}

}  // namespace
}  // namespace gloam::test

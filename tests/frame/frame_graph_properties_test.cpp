// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include "engine/frame/plan.h"
#include "engine/gpu/recording_device.h"
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
    std::vector<gpu::Access> last(frame.resources.size(), gpu::Access::none);
    for (const frame::PlannedPass& planned : plan.passes) {
      const auto has_barrier = [&](std::uint32_t resource) {
        for (std::uint32_t b = 0; b < planned.barrier_count; ++b) {
          if (plan.barriers[planned.first_barrier + b].resource == resource) return true;
        }
        return false;
      };
      for (const RandomFrame::Use& use : frame.passes[planned.pass].uses) {
        const bool read_again = last[use.resource] == use.access && !gpu::is_write(use.access);
        if (read_again) RC_ASSERT(!has_barrier(use.resource));
        if (gpu::is_write(use.access)) RC_ASSERT(has_barrier(use.resource));
        last[use.resource] = use.access;
      }
    }
  });
}

}  // namespace
}  // namespace gloam::test

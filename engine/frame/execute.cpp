// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// FrameGraph: compiles a frame, records its passes, and reports their times and memory.
#include <algorithm>

#include "engine/core/assert.h"
#include "engine/frame/counting_commands.h"
#include "engine/frame/frame_graph.h"
#include "engine/frame/frame_graph_state.h"

namespace gloam {

using frame::DeclaredResource;
using frame::DeclaredUse;
using frame::PlannedBarrier;
using frame::PlannedPass;

Status FrameGraph::compile() {
  State& s = *state_;
  s.check_declaring();
  s.hash = frame::structural_hash(s.declaration);
  Result<frame::CachedPlan*> plan = s.cache.get(s.declaration, s.hash);
  if (!plan.ok()) return plan.error();
  s.plan = *plan;
  s.stage = State::Stage::compiled;
  return {};
}

gpu::ImageHandle FrameGraph::State::image_of(std::uint32_t resource_index) const {
  const DeclaredResource& r = declaration.resources[resource_index];
  return r.imported ? r.image : plan->objects.images[resource_index];
}
gpu::BufferHandle FrameGraph::State::buffer_of(std::uint32_t resource_index) const {
  const DeclaredResource& r = declaration.resources[resource_index];
  return r.imported ? r.buffer : plan->objects.buffers[resource_index];
}

void FrameGraph::State::record_barriers(gpu::CommandList& commands, std::uint32_t first, std::uint32_t end) {
  if (first == end) return;
  buffer_barriers.clear();
  image_barriers.clear();
  for (std::uint32_t i = first; i < end; ++i) {
    const PlannedBarrier& b = plan->plan.barriers[i];
    const frame::DeclaredResource& resource = declaration.resources[b.resource];
    const bool takes_over = b.before == gpu::Access::none && !resource.imported;
    const gpu::AccessMask also_before = b.also_before | (takes_over ? other_plans : 0);
    if (resource.is_image) {
      image_barriers.push_back({image_of(b.resource), b.before, b.after, also_before, b.also_after, b.range});
    } else {
      buffer_barriers.push_back({buffer_of(b.resource), b.before, b.after, also_before, b.also_after});
    }
  }
  commands.barrier(buffer_barriers, image_barriers);
}

void FrameGraph::execute(gpu::CommandList& commands) {
  State& s = *state_;
  GLOAM_ASSERT(s.stage == State::Stage::compiled, "execute needs a successful compile before it, once a frame");
  s.stage = State::Stage::executed;
  s.other_plans = s.cache.begin_execution(*s.plan);
  s.timer.begin_frame(s.device.frame_number());
  frame::CountingCommands counting(commands);
  PassContext context(*this, counting);
  const frame::Plan& plan = s.plan->plan;
  // A device that runs threads in turn does nothing between two passes: a pass begins where the last one has ended. On
  // lavapipe a stamp after the barriers may come after the pass's own dispatches, because it waits for triangles only.
  const bool stamps_begins = !s.device.info().threads_in_turn;
  for (std::uint32_t i = 0; i < plan.passes.size(); ++i) {
    const PlannedPass& planned = plan.passes[i];
    frame::DeclaredPass& pass = s.declaration.passes[planned.pass];
    commands.begin_label(pass.name);
    s.record_barriers(commands, planned.first_barrier, planned.first_barrier + planned.barrier_count);
    s.timer.begin_pass(commands, stamps_begins && planned.barrier_count > 0);
    counting.reset();
    s.recording_pass = planned.pass;
    if (pass.function) pass.function(context);
    if (!s.recorded.ok()) return;
    s.recording_pass = frame::kNone;
    s.timer.end_pass(commands, pass, counting.dispatches(), counting.draws());
    commands.end_label();
  }
  s.record_barriers(commands, plan.first_final_barrier, static_cast<std::uint32_t>(plan.barriers.size()));
}

std::vector<FrameGraph::UselessPass> FrameGraph::useless_passes() const {
  std::vector<UselessPass> useless;
  const frame::Declaration& declaration = state_->declaration;
  for (const frame::DeclaredPass& pass : declaration.passes.all())
    if (!pass.keep && std::ranges::none_of(declaration.uses_of(pass), &DeclaredUse::writes))
      useless.push_back({pass.name, pass.module});
  return useless;
}

void FrameGraph::give_up_frame() { state_->cache.give_up_execution(); }

void FrameGraph::drop_times(std::uint64_t frame) { state_->timer.drop_frame(frame); }

const Status& FrameGraph::recorded() const { return state_->recorded; }

std::string_view FrameGraph::recording() const {
  const State& s = *state_;
  return s.recording_pass == frame::kNone ? std::string_view() : s.declaration.passes[s.recording_pass].name;
}

void PassContext::fail(Error error) {
  Status& recorded = graph_.state_->recorded;
  if (recorded.ok()) recorded = std::move(error);
}

bool FrameGraph::State::writes(std::uint32_t resource_index) const {
  GLOAM_ASSERT(plan != nullptr, "which passes are culled is known after compile");
  for (const PlannedPass& planned : plan->plan.passes)
    for (const DeclaredUse& use : declaration.uses_of(declaration.passes[planned.pass]))
      if (use.resource == resource_index && use.writes) return true;
  return false;
}

bool FrameGraph::writes(ImageRef image) const {
  static_cast<void>(state_->resource(image));  // asserts for handles of other frames
  return state_->writes(image.resource);
}
bool FrameGraph::writes(BufferRef buffer) const {
  static_cast<void>(state_->resource(buffer));
  return state_->writes(buffer.resource);
}

template <class Kind>
void FrameGraph::State::check_declared(FrameRef<Kind> ref) {
  const DeclaredResource& wanted = resource(ref);
  GLOAM_ASSERT(recording_pass != frame::kNone, "a pass asks for its resources while it records");
  const frame::DeclaredPass& pass = declaration.passes[recording_pass];
  bool declared = false;
  std::uint32_t first = ~0u;
  std::uint32_t last = 0;
  for (const DeclaredUse& use : declaration.uses_of(pass)) {
    if (use.resource != ref.resource) continue;
    declared = true;
    first = std::min(first, use.first_version);
    last = std::max(last, use.last_version);
  }
  GLOAM_ASSERT(declared, "pass '" + pass.name + "' uses resource '" + wanted.name() + "' that it did not declare");
  GLOAM_ASSERT(ref.version >= first && ref.version <= last,
               "pass '" + pass.name + "' uses another version of resource '" + wanted.name() + "' than it declared");
}

gpu::ImageHandle PassContext::image(ImageRef ref) const {
  graph_.state_->check_declared(ref);
  return graph_.state_->image_of(ref.resource);
}
gpu::BufferHandle PassContext::buffer(BufferRef ref) const {
  graph_.state_->check_declared(ref);
  return graph_.state_->buffer_of(ref.resource);
}

std::vector<PassTime> FrameGraph::pass_times() {
  state_->timer.refresh(state_->device);
  return state_->timer.newest().passes;
}
double FrameGraph::gpu_ms() const {
  state_->timer.refresh(state_->device);
  return state_->timer.newest().gpu_ms;
}
std::vector<GpuFrameTimes> FrameGraph::take_times() {
  state_->timer.refresh(state_->device);
  return state_->timer.take();
}

std::vector<GpuFrameTimes> FrameGraph::take_times_for_profiler() {
  state_->timer.refresh(state_->device);
  return state_->timer.take_for_profiler();
}

void FrameGraph::free_idle_memory() {
  // A plan whose frame has not been declared anew belongs to the declaration that is still there.
  state_->cache.free_memory_except(state_->plan, state_->declaration);
}
void FrameGraph::free_memory() {
  GLOAM_ASSERT(state_->stage != State::Stage::compiled, "a compiled frame is executed before its memory is freed");
  state_->cache.free_memory_except(nullptr, state_->declaration);
}
std::uint64_t FrameGraph::plans_compiled() const { return state_->cache.plans_compiled(); }
std::uint64_t FrameGraph::plan_hash() const { return state_->hash; }
std::uint64_t FrameGraph::transient_bytes() const {
  return state_->plan == nullptr ? 0 : state_->plan->plan.transient_bytes;
}
std::uint64_t FrameGraph::unshared_bytes() const {
  return state_->plan == nullptr ? 0 : state_->plan->plan.unshared_bytes;
}

}  // namespace gloam

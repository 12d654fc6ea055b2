// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/declare/compute_pass.h"

#include <algorithm>
#include <array>

#include "engine/core/assert.h"
#include "engine/render/declare/recording.h"

namespace gloam {
namespace {

using declare::Item;
using declare::Recording;
using declare::Step;
using declare::StepKind;

void record_barrier(const Recording& recording, PassContext& context) {
  std::vector<gpu::BufferBarrier> buffers;
  std::vector<gpu::ImageBarrier> images;
  constexpr gpu::Access kWrite = gpu::Access::compute_write;
  for (const Item& item : recording.items) {
    if (!item.written) continue;
    if (item.kind == Item::Kind::storage) {
      const gpu::ImageHandle image = context.image(item.image);
      if (std::ranges::find(images, image, &gpu::ImageBarrier::image) == images.end())
        images.push_back({image, kWrite, kWrite});
    } else {
      const gpu::BufferHandle buffer = context.buffer(item.buffer);
      if (std::ranges::find(buffers, buffer, &gpu::BufferBarrier::buffer) == buffers.end())
        buffers.push_back({buffer, kWrite, kWrite});
    }
  }
  context.commands().barrier(buffers, images);
}

void record_compute(const Recording& recording, PassContext& context) {
  if (recording.failed) return;
  gpu::CommandList& commands = context.commands();
  std::vector<gpu::Binding> storage;
  for (const Step& step : recording.steps) {
    switch (step.kind) {
      case StepKind::dispatch:
        if (step.wanted != nullptr && *step.wanted == 0) break;
        begin_step(recording, step, context, storage);
        commands.dispatch(step.counts[0], step.counts[1], step.counts[2]);
        break;
      case StepKind::dispatch_indirect:
        begin_step(recording, step, context, storage);
        commands.dispatch_indirect(context.buffer(step.arguments), step.offset);
        break;
      case StepKind::barrier:
        record_barrier(recording, context);
        break;
      default:
        recording.functions[step.function](context);
        break;
    }
  }
}

}  // namespace

gpu::ComputePipelineDesc pipeline_desc(const ComputeProgram& program, std::string_view module) {
  return {{}, std::string(module), program.shader, program.constants};
}

ComputePass::ComputePass(FrameBuilder& frame, std::string_view name, const ComputeProgram& program)
    : ShaderPass(frame, name) {
  graph_pass().execute([recording = &recording()](PassContext& context) { record_compute(*recording, context); });
  use(program);
}

void ComputePass::use(const ComputeProgram& program) {
  constants_ = program.constants;
  auto interface = frame().services().declared.interfaces.of(program.shader);
  if (!interface.ok()) return fail(interface.error());
  ShaderPass::use(*interface);
  check_constants(program.constants);
  use_pipeline(pipeline_desc(program, frame().module()));
}

void ComputePass::dispatch(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  if (!has_program() || recording().failed) return;
  Step& step = add_step(StepKind::dispatch);
  step.counts[0] = x;
  step.counts[1] = y;
  step.counts[2] = z;
  step.wanted = wanted_;
}

std::uint32_t ComputePass::local_size(std::size_t axis) const {
  static constexpr std::array<const char*, 3> kNames = {"local_size_x", "local_size_y", "local_size_z"};
  const gpu::SpecConstant* constant = constants_.find(kNames[axis]);
  return std::max(constant != nullptr ? constant->value.bits : interface().local_size[axis], 1u);
}

void ComputePass::dispatch_over(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  if (!has_program()) return;
  const auto groups = [&](std::uint32_t items, std::size_t axis) {
    return items / local_size(axis) + (items % local_size(axis) != 0 ? 1 : 0);
  };
  dispatch(groups(x, 0), groups(y, 1), groups(z, 2));
}

void ComputePass::dispatch_indirect(BufferRef arguments, std::uint64_t offset) {
  if (!has_program() || recording().failed) return;
  graph_pass().read(arguments, gpu::Access::indirect_read);
  Step& step = add_step(StepKind::dispatch_indirect);
  step.arguments = arguments;
  step.offset = offset;
}

void ComputePass::barrier() { recording().steps.emplace_back().kind = StepKind::barrier; }

}  // namespace gloam

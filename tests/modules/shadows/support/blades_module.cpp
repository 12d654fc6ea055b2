// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/modules/shadows/support/blades_module.h"

#include <cmath>
#include <glm/ext/matrix_transform.hpp>

#include "engine/core/hash.h"
#include "engine/render/declare/compute_pass.h"
#include "shaders/gpu_test/shaders.h"

namespace gloam::test {
namespace {

gpu::GraphicsPipelineDesc blades_pipeline() {
  return caster_pipeline_desc({.vertex = shaders::gpu_test::blades_vert}, "blades");
}

std::uint64_t hash_of(const BladeField& field) {
  Hasher hasher;
  hasher.bytes(std::as_bytes(std::span(field.resting)));
  hasher.bytes_of(field.phase);
  hasher.bytes_of(field.reach_m);
  hasher.bytes_of(field.origin);
  return hasher.digest();
}

}  // namespace

BladeField::Triangle BladeField::triangle(std::size_t blade) const {
  const shaders::Blade& b = resting[blade];
  const dvec3 side(b.half_width, 0.0, 0.0), root = origin + dvec3(b.root);
  const double sway =
      static_cast<double>(reach_m) * std::sin(static_cast<double>(phase) + 1.3 * static_cast<double>(blade));
  return {{root - side, root + side, origin + dvec3(b.tip) + dvec3(sway, 0.0, 0.0)}};
}

WorldBox BladeField::bounds() const {
  WorldBox box;
  const dvec3 reach(static_cast<double>(reach_m), 0.0, 0.0);
  for (std::size_t i = 0; i < resting.size(); ++i)
    for (const dvec3& corner : triangle(i).corners) {
      box.min = glm::min(box.min, corner - 2.0 * reach);
      box.max = glm::max(box.max, corner + 2.0 * reach);
    }
  return box;
}

void BladesModule::pipelines(const KnobRegistry&, const gpu::DeviceInfo&, PipelineList& list) const {
  list.push_back(pipeline_desc(ComputeProgram{shaders::gpu_test::sway_comp}, name()));
  list.push_back(blades_pipeline());
}

void BladesModule::add_passes(FrameBuilder& frame, PassPhase phase) {
  if (phase == PassPhase::announce) announce(frame);
  if (phase == PassPhase::lists) sway(frame);
  if (also != nullptr) also(frame, phase);
}

void BladesModule::announce(FrameBuilder& frame) {
  blades_.clear();
  const auto pipeline = frame.services().pipelines.get(blades_pipeline());
  if (!frame.check(pipeline)) return;
  for (const BladeField& field : fields) {
    const auto blades = blades_.emplace_back(std::make_shared<BufferRef>());
    CasterSource source;
    source.entity = field.entity;
    source.bounds = field.bounds();
    source.content_hash = field.told ? hash_of(field) : 0;
    source.moving = field.moving;
    source.declare_reads = [this, blades](PassBuilder& pass) {
      ++declared;
      pass.read(*blades, gpu::Access::vertex_read);
    };
    source.record = [this, blades, pipeline = *pipeline, count = static_cast<std::uint32_t>(field.resting.size()),
                     world_from_field = glm::translate(dmat4(1.0), field.origin)](const CasterSourceDraw& draw) {
      ++recorded;
      gpu::CommandList& commands = draw.context().commands();
      const gpu::Binding bindings[] = {{0, gpu::Binding::BufferRange{draw.context().buffer(*blades)}}};
      draw.bind_pipeline(pipeline);
      commands.bind(bindings);
      commands.push(draw.projection().constants(world_from_field));
      commands.draw(3 * count, 1, 0, 0);
    };
    frame.add_caster_source(std::move(source));
  }
}

void BladesModule::sway(FrameBuilder& frame) {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const BladeField& field = fields[i];
    const auto count = static_cast<std::uint32_t>(field.resting.size());
    ComputePass pass(frame, "sway", shaders::gpu_test::sway_comp);
    pass.items<shaders::Blade>("resting", field.resting);
    pass.push(shaders::SwayConstants{count, field.phase, field.reach_m});
    gpu::BufferDesc desc;
    desc.name = "blades";
    desc.module = name();
    desc.size = count * sizeof(shaders::Blade);
    *blades_[i] = pass.write("blades", frame.graph().create_buffer(desc));
    pass.dispatch_over(count);
  }
}

}  // namespace gloam::test

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/passes/passes.h"
#include "engine/scene/resources.h"
#include "shaders/render/shaders.h"

namespace gloam {
namespace {

constexpr std::uint32_t kGroupSize = 64;

/// Three matrix rows per joint, as the shader reads them.
std::vector<vec4> joint_rows(const JointMatrices& joints) {
  std::vector<vec4> rows;
  rows.reserve(3 * joints.matrices.size() + 3);
  for (const mat4& matrix : joints.matrices) {
    const mat4 transposed = glm::transpose(matrix);
    rows.insert(rows.end(), {transposed[0], transposed[1], transposed[2]});
  }
  rows.resize(std::max<std::size_t>(rows.size(), 3));
  return rows;
}

template <class T>
gpu::Binding range_binding(std::uint32_t binding, gpu::BufferHandle buffer, std::uint64_t first, std::uint64_t count) {
  // Every binding must be given, so an unused input binds the buffer's first elements.
  if (count == 0) return {binding, gpu::Binding::BufferRange{buffer, 0, 256}};
  return {binding, gpu::Binding::BufferRange{buffer, first * sizeof(T), count * sizeof(T)}};
}

}  // namespace

Status add_deform_pass(FrameBuilder& frame) {
  const DrawLists& draws = frame.draws();
  if (draws.deforms.empty()) return {};
  const FrameServices& services = frame.services();
  auto pipeline =
      services.pipelines.get(gpu::ComputePipelineDesc{"deform", "engine", shaders::render::deform_comp, {}});
  if (!pipeline.ok()) return pipeline.error();

  const std::vector<vec4> rows = joint_rows(frame.world().resource<JointMatrices>());
  auto joints = services.storage.write(std::as_bytes(std::span(rows)));
  if (!joints.ok()) return joints.error();
  std::vector<float> weights = frame.world().resource<MorphWeights>().values;
  weights.resize(std::max<std::size_t>(weights.size(), 1));
  auto weight_range = services.storage.write(std::as_bytes(std::span(weights)));
  if (!weight_range.ok()) return weight_range.error();

  const auto stream = [&](const char* name, std::size_t stride) {
    gpu::BufferDesc desc;
    desc.name = name;
    desc.module = "engine";
    desc.size = draws.deformed_vertices * stride;
    return frame.graph().create_buffer(std::move(desc));
  };
  FrameBuilder::Deformed deformed{stream("deformed_positions", sizeof(vec3)),
                                  stream("deformed_frames", sizeof(PackedFrame))};
  PassBuilder pass = frame.graph().add_pass("deform", "engine");
  deformed.positions = pass.write(deformed.positions, gpu::Access::compute_write);
  deformed.frames = pass.write(deformed.frames, gpu::Access::compute_write);
  frame.put(deformed);
  pass.execute(
      [&frame, deformed, pipeline = *pipeline, joints = *joints, weights_at = *weight_range](PassContext& context) {
        gpu::CommandList& commands = context.commands();
        const GpuScene& scene = frame.scene();
        commands.bind_pipeline(pipeline);
        for (const DeformJob& job : frame.draws().deforms) {
          const GpuPrimitive& p = *job.primitive;
          const std::uint64_t count = p.vertex_count;
          const std::uint64_t morph_floats = 3ull * count * job.constants.morph_targets * (p.morph_has_normals ? 2 : 1);
          const gpu::Binding bindings[] = {
              range_binding<vec3>(0, scene.positions(), p.first_vertex, count),
              range_binding<PackedFrame>(1, scene.frames(), p.first_vertex, count),
              range_binding<PackedInfluence>(2, scene.influences(), p.first_influence,
                                             job.constants.skinned != 0 ? count : 0),
              range_binding<float>(3, scene.morph_offsets(), p.first_morph, morph_floats),
              {4, joints},
              {5, weights_at},
              range_binding<vec3>(6, context.buffer(deformed.positions), job.first_vertex, count),
              range_binding<PackedFrame>(7, context.buffer(deformed.frames), job.first_vertex, count)};
          commands.bind(bindings);
          commands.push(job.constants);
          commands.dispatch((p.vertex_count + kGroupSize - 1) / kGroupSize, 1, 1);
        }
      });
  return {};
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/declare/compute_pass.h"
#include "engine/render/passes/passes.h"
#include "engine/scene/resources.h"
#include "shaders/render/shaders.h"

namespace gloam {
namespace {

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

/// Items of a buffer. Without items, a null range: the shader reads none.
template <class T>
gpu::Binding::BufferRange part(gpu::BufferHandle buffer, std::uint64_t first, std::uint64_t count) {
  if (count == 0) return {};
  return {buffer, first * sizeof(T), count * sizeof(T)};
}

void deform(ComputePass& pass, const GpuScene& scene, const DeformJob& job, FrameBuilder::Deformed& deformed) {
  const GpuPrimitive& p = *job.primitive;
  const std::uint64_t count = p.vertex_count;
  const std::uint64_t morph_floats = 3ull * count * job.constants.morph_targets * (p.morph_has_normals ? 2 : 1);
  pass.read("rest_positions", part<vec3>(scene.positions(), p.first_vertex, count));
  pass.read("rest_frames", part<PackedFrame>(scene.frames(), p.first_vertex, count));
  pass.read("influences",
            part<PackedInfluence>(scene.influences(), p.first_influence, job.constants.skinned != 0 ? count : 0));
  pass.read("morph_offsets", part<float>(scene.morph_offsets(), p.first_morph, morph_floats));
  deformed.positions =
      pass.write_part("positions", deformed.positions, job.first_vertex * sizeof(vec3), count * sizeof(vec3));
  deformed.frames =
      pass.write_part("frames", deformed.frames, job.first_vertex * sizeof(PackedFrame), count * sizeof(PackedFrame));
  pass.push(job.constants);
  pass.dispatch_over(p.vertex_count);
}

}  // namespace

void add_deform_pass(FrameBuilder& frame) {
  const FrameDraws& draws = frame.frame_draws();
  if (draws.deforms.empty() || frame.shared().find<FrameBuilder::Deformed>() != nullptr) return;
  const auto stream = [&](const char* name, std::size_t stride) {
    gpu::BufferDesc desc;
    desc.name = name;
    desc.module = "engine";
    desc.size = draws.deformed_vertices * stride;
    return frame.graph().create_buffer(std::move(desc));
  };
  FrameBuilder::Deformed deformed{stream("deformed_positions", sizeof(vec3)),
                                  stream("deformed_frames", sizeof(PackedFrame))};
  std::vector<float> weights = frame.world().resource<MorphWeights>().values;
  weights.resize(std::max<std::size_t>(weights.size(), 1));
  ComputePass pass(frame, "deform", shaders::render::deform_comp);
  pass.items<vec4>("joint_rows", joint_rows(frame.world().resource<JointMatrices>()));
  pass.items<float>("morph_weights", weights);
  for (const DeformJob& job : draws.deforms) deform(pass, frame.scene(), job, deformed);
  frame.shared().put(deformed);
}

}  // namespace gloam

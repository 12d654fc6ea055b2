// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "engine/render/declare/compute_pass.h"
#include "engine/render/passes/renderer_passes.h"
#include "engine/scene/resources.h"
#include "shaders/render/shaders.h"

namespace gloam {
namespace {

/// Three matrix rows per joint, as the shader reads them.
std::vector<vec4> joint_rows(std::span<const mat4> matrices) {
  std::vector<vec4> rows;
  rows.reserve(3 * matrices.size() + 3);
  for (const mat4& matrix : matrices) {
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

/// Streams of deformed vertices of the frame.
struct Streams {
  BufferRef positions;
  BufferRef frames;
};

Streams create_streams(FrameBuilder& frame, const std::string& prefix) {
  const auto stream = [&](const char* name, std::size_t stride) {
    gpu::BufferDesc desc;
    desc.name = prefix + name;
    desc.module = "engine";
    desc.size = frame.frame_draws().deformed_vertices * stride;
    return frame.graph().create_buffer(std::move(desc));
  };
  return {stream("_positions", sizeof(vec3)), stream("_frames", sizeof(PackedFrame))};
}

void deform(ComputePass& pass, const GpuScene& scene, const DeformJob& job, const shaders::DeformConstants& constants,
            Streams& target) {
  const GpuPrimitive& p = *job.primitive;
  const std::uint64_t count = p.vertex_count;
  const std::uint64_t morph_floats = 3ull * count * constants.morph_targets * (p.morph_has_normals ? 2 : 1);
  pass.read("rest_positions", part<vec3>(scene.positions(), p.first_vertex, count));
  pass.read("rest_frames", part<PackedFrame>(scene.frames(), p.first_vertex, count));
  pass.read("influences",
            part<PackedInfluence>(scene.influences(), p.first_influence, constants.skinned != 0 ? count : 0));
  pass.read("morph_offsets", part<float>(scene.morph_offsets(), p.first_morph, morph_floats));
  target.positions =
      pass.write_part("positions", target.positions, job.first_vertex * sizeof(vec3), count * sizeof(vec3));
  target.frames =
      pass.write_part("frames", target.frames, job.first_vertex * sizeof(PackedFrame), count * sizeof(PackedFrame));
  pass.push(constants);
  pass.dispatch_over(p.vertex_count);
}

/// Morph weights for the GPU; at least one, because a buffer range cannot be empty.
std::vector<float> uploaded_weights(std::vector<float> weights) {
  weights.resize(std::max<std::size_t>(weights.size(), 1));
  return weights;
}

/// By job: whether a view draws it.
std::vector<std::uint8_t> jobs_in_view(const FrameDraws& draws) {
  std::vector<std::uint8_t> in_view(draws.deforms.size(), 0);
  for (const ViewDraws& view : draws.views)
    for (const std::vector<Draw>* list : {&view.solid, &view.blended})
      for (const Draw& draw : *list)
        if (draw.deform != kNone) in_view[draw.deform] = 1;
  return in_view;
}

/// Deforms what views draw with the previous frame's joints and weights, into streams of the same layout. Returns the
/// positions.
BufferRef add_previous_pass(FrameBuilder& frame, const DrawnInstances& drawn) {
  std::vector<mat4> joints = frame.world().resource<JointMatrices>().matrices;
  std::vector<float> weights = frame.world().resource<MorphWeights>().values;
  const DeformOffsets offsets{static_cast<std::uint32_t>(joints.size()), static_cast<std::uint32_t>(weights.size())};
  joints.insert(joints.end(), drawn.joints.begin(), drawn.joints.end());
  weights.insert(weights.end(), drawn.weights.begin(), drawn.weights.end());
  Streams previous = create_streams(frame, "previous");
  ComputePass pass(frame, "deform_previous", shaders::render::deform_comp);
  pass.items<vec4>("joint_rows", joint_rows(joints));
  pass.items<float>("morph_weights", uploaded_weights(std::move(weights)));
  const std::vector<DeformJob>& jobs = frame.frame_draws().deforms;
  const std::vector<std::uint8_t> in_view = jobs_in_view(frame.frame_draws());
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    static constexpr std::uint8_t kNever = 0;
    pass.only_if(in_view[i] != 0 ? nullptr : &kNever);
    const DrawnInstance* before = drawn.find(frame.world(), jobs[i].entity);
    deform(pass, frame.scene(), jobs[i], previous_deform_constants(jobs[i], before, offsets), previous);
  }
  return previous.positions;
}

}  // namespace

void add_deform_pass(FrameBuilder& frame) {
  const std::vector<DeformJob>& jobs = frame.frame_draws().deforms;
  if (jobs.empty()) return;
  FrameBuilder::Deformed* deformed = frame.shared().find<FrameBuilder::Deformed>();
  if (deformed == nullptr) {
    Streams streams = create_streams(frame, "deformed");
    ComputePass pass(frame, "deform", shaders::render::deform_comp);
    pass.items<vec4>("joint_rows", joint_rows(frame.world().resource<JointMatrices>().matrices));
    pass.items<float>("morph_weights", uploaded_weights(frame.world().resource<MorphWeights>().values));
    deformed = &frame.shared().put(FrameBuilder::Deformed{{}, {}, {}, jobs_in_view(frame.frame_draws())});
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      pass.only_if(&deformed->used[i]);
      deform(pass, frame.scene(), jobs[i], jobs[i].constants, streams);
    }
    deformed->positions = streams.positions;
    deformed->frames = streams.frames;
  }
  const DrawnInstances* drawn = frame.previous_instances();
  if (drawn != nullptr && !deformed->previous_positions)
    deformed->previous_positions = add_previous_pass(frame, *drawn);
}

}  // namespace gloam

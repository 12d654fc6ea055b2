// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/submission/bound_state.h"

#include <string>

#include "engine/core/assert.h"

namespace gloam::gpu::vulkan {
namespace {

std::string lacking(const Pipeline& pipeline, const std::string& what) {
  return "pipeline \"" + pipeline.name + "\" is used before its " + what + " bound";
}

}  // namespace

void BoundState::begin_native() {
  check_own("native_commands");
  const bool rendering = rendering_;
  *this = {};
  rendering_ = rendering;
  native_ = true;
}

void BoundState::end_native() { native_ = false; }

void BoundState::bind_vertex_stream(std::uint32_t stream) {
  check_own("bind_vertex_stream");
  streams_ |= 1u << stream;
}

void BoundState::bind_indices() {
  check_own("bind_indices");
  indices_ = true;
}

void BoundState::bind_pipeline(const Pipeline& pipeline) {
  check_own("bind_pipeline");
  layout_ = pipeline.layout;
  draws_ = pipeline.bind_point == VK_PIPELINE_BIND_POINT_GRAPHICS;
  used_sets_ = pipeline.used_sets;
  vertex_streams_ = pipeline.vertex_streams;
}

void BoundState::bind_set(std::uint32_t set) {
  std::vector<VkDescriptorSetLayout>& bound = bound_[draws_ ? 1 : 0];
  if (bound.size() <= set) bound.resize(set + 1, VK_NULL_HANDLE);
  if (set < layout_->sets.size()) bound[set] = layout_->sets[set];
}

void BoundState::begin_rendering() {
  check_outside("begin_rendering");
  rendering_ = true;
}

void BoundState::end_rendering() {
  check_own("end_rendering");
  GLOAM_ASSERT(rendering_, "end_rendering needs begin_rendering before it");
  rendering_ = false;
}

void BoundState::check_sets(const Pipelines& pipelines, PipelineHandle pipeline) const {
  for (std::uint32_t set = 0; used_sets_ >> set != 0; ++set) {
    if ((used_sets_ >> set & 1u) == 0) continue;
    GLOAM_ASSERT(set < sets().size() && sets()[set] == layout_->sets[set],
                 lacking(pipelines.get(pipeline), set == 0 ? "bindings are" : "set " + std::to_string(set) + " is"));
  }
}

void BoundState::check_dispatch(const Pipelines& pipelines, PipelineHandle pipeline) const {
  GLOAM_ASSERT(layout_ != nullptr, "a pipeline is bound first");
  GLOAM_ASSERT(!draws_, "a dispatch needs a compute pipeline, and \"" + pipelines.get(pipeline).name + "\" draws");
  check_outside("a dispatch");
  check_sets(pipelines, pipeline);
}

void BoundState::check_draw(const Pipelines& pipelines, PipelineHandle pipeline, bool indexed) const {
  GLOAM_ASSERT(layout_ != nullptr, "a pipeline is bound first");
  GLOAM_ASSERT(draws_, "a draw needs a graphics pipeline, and \"" + pipelines.get(pipeline).name + "\" computes");
  GLOAM_ASSERT(rendering_, "a draw comes between begin_rendering and end_rendering");
  check_sets(pipelines, pipeline);
  for (std::uint32_t stream = 0; stream < vertex_streams_; ++stream)
    GLOAM_ASSERT((streams_ >> stream & 1u) != 0,
                 lacking(pipelines.get(pipeline), "vertex stream " + std::to_string(stream) + " is"));
  GLOAM_ASSERT(!indexed || indices_, lacking(pipelines.get(pipeline), "indices are"));
}

void BoundState::check_own(std::string_view command) const {
  GLOAM_ASSERT(!native_, std::string(command) + " must wait until the host's native commands have ended");
}

void BoundState::check_outside(std::string_view command) const {
  check_own(command);
  GLOAM_ASSERT(!rendering_, std::string(command) + " must not come between begin_rendering and end_rendering");
}

}  // namespace gloam::gpu::vulkan

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/render/frame_builder.h"
#include "modules/shadows/atlas/drawn_faces.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/maps/scratch_plan.h"
#include "modules/shadows/maps/work_groups.h"
#include "shaders/shadows/maps/mips_shared.h"

namespace gloam {

[[nodiscard]] gpu::ComputePipelineDesc shadow_mips_pipeline(bool d16);
[[nodiscard]] gpu::ComputePipelineDesc shadow_mips_in_place_pipeline(bool d16);
[[nodiscard]] gpu::ComputePipelineDesc shadow_backgrounds_pipeline();

/// Faces, and the batches that they are drawn in.
struct FacePlan {
  std::vector<DrawnFace> faces;
  ScratchPlan plan;
};
[[nodiscard]] FacePlan plan_faces(std::vector<DrawnFace> faces);

/// Dispatches for what a frame draws: of shadow_backgrounds.comp one a batch of backgrounds; of shadow_mips.comp one a
/// batch, which moves its faces out of the scratch map, then one a run of coarser mips for the faces of all batches.
struct ShadowMipWork {
  std::vector<GroupRange> backgrounds;
  std::vector<GroupRange> batches;
  std::vector<GroupRange> coarse;    ///< from mip GLOAM_SHADOW_MIP_RUN on
  gpu::Binding::BufferRange groups;  ///< this frame's
  shaders::ShadowMipConstants constants{};
  gpu::PipelineHandle pipeline;
  gpu::PipelineHandle backgrounds_pipeline;  ///< where there are any
  gpu::SamplerHandle sampler;
};

/// Metres that a surface recedes from the light a metre across; what recedes more is taken for two surfaces.
inline constexpr float kSteepestSurface = 3.0f;
/// The same in maps that hold little but one subject: its rims are not to be left out of what it covers.
inline constexpr float kSteepestSubject = 25.0f;

[[nodiscard]] Result<ShadowMipWork> plan_shadow_mips(FrameBuilder& frame, const FacePlan& backgrounds,
                                                     const FacePlan& faces, const ShadowKnobs& knobs,
                                                     float steepest = kSteepestSurface);

/// The same for faces with their mip 0 in the atlas: one batch of all.
[[nodiscard]] Result<ShadowMipWork> plan_shadow_mips_in_place(FrameBuilder& frame, std::span<const ShadowFace> faces,
                                                              const ShadowKnobs& knobs);

struct ShadowMipImages {
  gpu::ImageHandle scratch;  ///< of the batch; for coarse mips any that may be read; none: in place
  gpu::ImageHandle atlas;
  gpu::ImageHandle pyramid;
  gpu::ImageHandle backgrounds;  ///< none: there are none yet
};

void record_backgrounds(gpu::CommandList& commands, const ShadowMipWork& work, std::size_t batch,
                        const ShadowMipImages& images);

void record_batch_mips(gpu::CommandList& commands, const ShadowMipWork& work, std::size_t batch,
                       const ShadowMipImages& images);
void record_coarse_mips(gpu::CommandList& commands, const ShadowMipWork& work, const ShadowMipImages& images);

}  // namespace gloam

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

// Plans and records the dispatches that move drawn faces into the atlas and make their mips and pyramid.
[[nodiscard]] gpu::ComputePipelineDesc shadow_mips_pipeline(bool d16);
[[nodiscard]] gpu::ComputePipelineDesc shadow_mips_in_place_pipeline(bool d16);
[[nodiscard]] gpu::ComputePipelineDesc shadow_backgrounds_pipeline();

/// Faces and the batches that they are drawn in.
struct FacePlan {
  std::vector<DrawnFace> faces;
  ScratchPlan plan;
};
[[nodiscard]] FacePlan plan_faces(std::vector<DrawnFace> faces);

/// The dispatches for one frame's draws: backgrounds.comp once per batch of backgrounds; mips.comp once per batch,
/// which moves the batch's faces from the scratch image into the atlas; then mips.comp once per run of coarser mips,
/// for the faces of all batches.
struct ShadowMipWork {
  std::vector<GroupRange> backgrounds;
  std::vector<GroupRange> batches;
  std::vector<GroupRange> coarse;    ///< by run, from mip GLOAM_SHADOW_MIP_RUN on
  gpu::Binding::BufferRange groups;  ///< one ShadowMipGroup per workgroup
  shaders::ShadowMipConstants constants{};
  gpu::PipelineHandle pipeline;
  gpu::PipelineHandle backgrounds_pipeline;  ///< null without backgrounds
  gpu::SamplerHandle sampler;
};

/// For coverage mips: steepest slope of one surface, in metres of depth per metre across. Neighbouring texels whose
/// depths differ by more belong to two surfaces.
inline constexpr float kSteepestSurface = 3.0f;
/// The same for extra maps, which show little more than one subject: texels at its silhouette must count as covered.
inline constexpr float kSteepestSubject = 25.0f;

/// Plans the mips of drawn faces: uploads the workgroups and gets the pipelines. backgrounds and faces: as drawn by
/// record_draws(). steepest: see kSteepestSurface.
[[nodiscard]] Result<ShadowMipWork> plan_shadow_mips(FrameBuilder& frame, const FacePlan& backgrounds,
                                                     const FacePlan& faces, const ShadowKnobs& knobs,
                                                     float steepest = kSteepestSurface);

/// The same for faces whose mip 0 is already in the atlas; all faces form one batch.
[[nodiscard]] Result<ShadowMipWork> plan_shadow_mips_in_place(FrameBuilder& frame, std::span<const ShadowFace> faces,
                                                              const ShadowKnobs& knobs);

struct ShadowMipImages {
  gpu::ImageHandle scratch;  ///< scratch image of the batch; coarse mips: any readable one; null: in place
  gpu::ImageHandle atlas;
  gpu::ImageHandle pyramid;
  gpu::ImageHandle backgrounds;  ///< null: the view has no backgrounds
};

/// Records the dispatch that copies a batch of backgrounds from images.scratch into images.backgrounds.
void record_backgrounds(gpu::CommandList& commands, const ShadowMipWork& work, std::size_t batch,
                        const ShadowMipImages& images);

/// record_batch_mips() moves the batch's faces from images.scratch into the atlas and makes their first mips.
/// record_coarse_mips() makes all further mips, with barriers between runs; the caller must place a barrier before it.
void record_batch_mips(gpu::CommandList& commands, const ShadowMipWork& work, std::size_t batch,
                       const ShadowMipImages& images);
void record_coarse_mips(gpu::CommandList& commands, const ShadowMipWork& work, const ShadowMipImages& images);

}  // namespace gloam

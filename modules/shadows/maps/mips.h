// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "engine/render/declare/compute_pass.h"
#include "engine/render/frame_builder.h"
#include "modules/shadows/atlas/drawn_faces.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/maps/scratch_plan.h"
#include "modules/shadows/maps/work_groups.h"
#include "shaders/shadows/maps/mips_shared.h"

namespace gloam {

// Plans and records the dispatches that move drawn faces into the atlas and make their mips and pyramid. They read
// scratch images, which the frame graph does not track, so their passes record commands themselves.

/// Runs of three mips: the first reads mip 0, further ones the last mip of the run before.
enum class MipRuns : std::uint32_t { first = 1, further = 2 };
[[nodiscard]] ComputeProgram shadow_mips_program(const ShadowKnobs& knobs, MipRuns runs);
[[nodiscard]] ComputeProgram shadow_bounds_program(bool d16, MipRuns runs);
[[nodiscard]] ComputeProgram shadow_mips_in_place_program(bool d16, MipRuns runs);
[[nodiscard]] ComputeProgram shadow_backgrounds_program();

/// A pipeline for commands that a pass records itself. Null if it cannot be created, and the frame is given up.
template <class Desc>
[[nodiscard]] gpu::PipelineHandle pipeline_of(FrameBuilder& frame, const Desc& desc) {
  auto made = frame.services().pipelines.get(desc);
  return frame.check(made) ? *made : gpu::PipelineHandle{};
}

/// Faces and the batches that they are drawn in.
struct FacePlan {
  std::vector<DrawnFace> faces;
  ScratchPlan plan;
};
/// most_texels: as for plan_scratch().
[[nodiscard]] FacePlan plan_faces(std::vector<DrawnFace> faces, std::uint32_t most_texels = kScratchTexels);

/// The dispatches for one frame's draws: backgrounds.comp once per batch of backgrounds; mips.comp once per batch,
/// which moves the batch's faces from the scratch image into the atlas; then mips.comp once per run of coarser mips,
/// for the faces of all batches.
struct ShadowMipWork {
  std::vector<GroupRange> backgrounds;
  std::vector<GroupRange> batches;
  std::vector<GroupRange> coarse;    ///< by run, from mip GLOAM_SHADOW_MIP_RUN on
  gpu::Binding::BufferRange groups;  ///< one ShadowMipGroup per workgroup
  shaders::ShadowMipConstants constants{};
  gpu::PipelineHandle pipeline;              ///< of the first run
  gpu::PipelineHandle coarse_pipeline;       ///< of further runs
  gpu::PipelineHandle backgrounds_pipeline;  ///< null without backgrounds
  gpu::SamplerHandle sampler;
};

/// For coverage mips: steepest slope of one surface, in metres of depth per metre across. Neighbouring texels whose
/// depths differ by more belong to two surfaces.
inline constexpr float kSteepestSurface = 3.0f;
/// The same for extra maps, which show little more than one subject: texels at its silhouette must count as covered.
inline constexpr float kSteepestSubject = 25.0f;

/// Plans the mips of drawn faces: uploads the workgroups and gets the pipelines. backgrounds and faces: as drawn by
/// record_draws(). steepest: see kSteepestSurface. On an error the frame is given up.
[[nodiscard]] ShadowMipWork plan_shadow_mips(FrameBuilder& frame, const FacePlan& backgrounds, const FacePlan& faces,
                                             const ShadowKnobs& knobs, float steepest, MapMips mips);

/// Makes mips and pyramids of faces whose mip 0 is already in the atlas: pass `name`.
void add_shadow_mips_in_place(FrameBuilder& frame, std::string_view name, std::span<const ShadowFace> faces,
                              const ShadowKnobs& knobs, ImageRef& atlas, ImageRef& pyramid);

struct ShadowMipImages {
  gpu::ImageHandle scratch;  ///< scratch image of the batch; coarse mips: any readable one
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

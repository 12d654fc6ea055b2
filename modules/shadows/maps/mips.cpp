// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/maps/mips.h"

#include <utility>

#include "shaders/shadows/shaders.h"

namespace gloam {
namespace {

/// ShadowMipGroup::gap for a face whose surfaces recede by at most `steepest` metres per metre.
float surface_gap(const ShadowFace& face, float steepest) {
  const auto texels = static_cast<float>(face.square.size);
  if (face.tan_half > 0.0f) return steepest * 2.0f * face.tan_half / texels;
  return steepest * 2.0f * face.half_extent_m / texels / face.far_m;
}

TexelRect bounds_of(const DrawnFace& face) {
  TexelRect bounds = face.regions.front().texels;
  for (const DrawnRegion& region : face.regions)
    bounds = {glm::min(bounds.begin, region.texels.begin), glm::max(bounds.end, region.texels.end)};
  return bounds;
}

/// Collects the workgroups of all dispatches of a frame.
class GroupList {
 public:
  explicit GroupList(float steepest) : steepest_(steepest) {}
  /// Adds the workgroups of one dispatch for these texels of a face: the run of mips after mip `first`.
  void add(const ShadowFace& face, std::uint32_t layer, const TexelRect& texels, std::uint32_t first,
           bool on_background = false) {
    const std::uint32_t block = std::uint32_t{GLOAM_SHADOW_MIP_BLOCK} << first;
    shaders::ShadowMipGroup group{};
    group.origin = face.square.origin;
    group.size = face.square.size;
    group.layer = layer;
    group.orthographic = face.tan_half > 0.0f ? 0u : 1u;
    group.on_background = on_background ? 1u : 0u;
    group.gap = surface_gap(face, steepest_);
    group.depth_scale = 1.0f / face.clip_share;
    add_groups(texels.begin / block, (texels.end + block - 1u) / block, GLOAM_SHADOW_MIP_GROUP,
               [&](uvec2 begin, uvec2 end) {
                 group.begin = begin;
                 group.end = end;
                 groups_.push_back(group);
               });
  }
  /// Adds all regions of a plan; returns a range per batch.
  [[nodiscard]] std::vector<GroupRange> add_batches(const FacePlan& faces) {
    std::vector<GroupRange> ranges;
    for (const ScratchPlan::Batch& batch : faces.plan.batches) {
      for (std::uint32_t layer = 0; layer < batch.items.size(); ++layer) {
        const DrawnFace& face = faces.faces[batch.items[layer]];
        for (const DrawnRegion& region : face.regions) add(face.face, layer, region.texels, 0, region.on_background);
      }
      ranges.push_back(take_range());
    }
    return ranges;
  }
  /// The workgroups added since the last call.
  [[nodiscard]] GroupRange take_range() {
    const GroupRange range{taken_, static_cast<std::uint32_t>(groups_.size()) - taken_};
    taken_ += range.count;
    return range;
  }
  [[nodiscard]] const std::vector<shaders::ShadowMipGroup>& groups() const { return groups_; }

 private:
  float steepest_;
  std::vector<shaders::ShadowMipGroup> groups_;
  std::uint32_t taken_ = 0;
};

void record(gpu::CommandList& commands, const ShadowMipWork& work, const GroupRange& groups, std::uint32_t first) {
  shaders::ShadowMipConstants constants = work.constants;
  constants.first = first;
  dispatch_groups(commands, constants, groups);
}

void bind(gpu::CommandList& commands, const ShadowMipWork& work, gpu::PipelineHandle pipeline,
          const ShadowMipImages& images) {
  commands.bind_pipeline(pipeline);
  const gpu::ImageView scratch{.image = images.scratch, .as_array = true};
  const gpu::ImageView backgrounds{.image = images.backgrounds ? images.backgrounds : images.scratch, .as_array = true};
  const gpu::Binding bindings[] = {{0, gpu::Binding::Sampled{scratch, work.sampler}},
                                   {1, gpu::Binding::Storage{{.image = images.atlas}}},
                                   {2, gpu::Binding::Storage{{.image = images.pyramid}}},
                                   {3, work.groups},
                                   {4, gpu::Binding::Sampled{backgrounds, work.sampler}}};
  commands.bind(bindings);
}

/// Adds the runs of coarser mips, from mip GLOAM_SHADOW_MIP_RUN on.
std::vector<GroupRange> add_coarse_runs(const FacePlan& faces, GroupList& list) {
  std::vector<GroupRange> runs;
  for (std::uint32_t first = GLOAM_SHADOW_MIP_RUN; faces.plan.batches.front().size >> first > 1;
       first += GLOAM_SHADOW_MIP_RUN) {
    // Coarser mips have few texels: those between a face's regions are made along with them, so that none is made
    // twice.
    for (const DrawnFace& face : faces.faces)
      if (face.face.square.size >> first > 1) list.add(face.face, 0, bounds_of(face), first);
    runs.push_back(list.take_range());
  }
  return runs;
}

shaders::ShadowMipConstants constants_of(const ShadowKnobs& knobs) {
  shaders::ShadowMipConstants constants{};
  constants.mip_operator = knobs.mip_operator;
  constants.atlas_size = knobs.atlas_size;
  return constants;
}

}  // namespace

ComputeProgram shadow_mips_program(const ShadowKnobs& knobs, MipRuns runs) {
  return {knobs.d16 ? shaders::shadows::mips_r16_comp : shaders::shadows::mips_comp,
          {{"kMipOperator", knobs.mip_operator}, {"kRuns", static_cast<std::uint32_t>(runs)}}};
}

ComputeProgram shadow_bounds_program(bool d16, MipRuns runs) {
  return {d16 ? shaders::shadows::bounds_r16_comp : shaders::shadows::bounds_comp,
          {{"kRuns", static_cast<std::uint32_t>(runs)}}};
}

ComputeProgram shadow_mips_in_place_program(bool d16, MipRuns runs) {
  return {d16 ? shaders::shadows::mips_in_place_r16_comp : shaders::shadows::mips_in_place_comp,
          {{"kRuns", static_cast<std::uint32_t>(runs)}}};
}

ComputeProgram shadow_backgrounds_program() { return {shaders::shadows::backgrounds_comp}; }

FacePlan plan_faces(std::vector<DrawnFace> faces, std::uint32_t most_texels) {
  std::vector<std::uint32_t> sizes;
  for (const DrawnFace& face : faces) sizes.push_back(face.face.square.size);
  return {std::move(faces), plan_scratch(sizes, most_texels)};
}

ShadowMipWork plan_shadow_mips(FrameBuilder& frame, const FacePlan& backgrounds, const FacePlan& faces,
                               const ShadowKnobs& knobs, float steepest, MapMips mips) {
  ShadowMipWork work;
  GroupList list(steepest);
  work.backgrounds = list.add_batches(backgrounds);
  work.batches = list.add_batches(faces);
  work.coarse = add_coarse_runs(faces, list);
  work.constants = constants_of(knobs);
  auto groups = frame.services().storage.write(std::as_bytes(std::span(list.groups())));
  if (frame.check(groups)) work.groups = *groups;
  const bool bounds_only = mips == MapMips::bounds_only;
  const auto pipeline = [&](MipRuns runs) {
    return pipeline_of(
        frame, pipeline_desc(bounds_only ? shadow_bounds_program(knobs.d16, runs) : shadow_mips_program(knobs, runs),
                             "shadows"));
  };
  work.pipeline = pipeline(MipRuns::first);
  work.coarse_pipeline = pipeline(MipRuns::further);
  if (!work.backgrounds.empty())
    work.backgrounds_pipeline = pipeline_of(frame, pipeline_desc(shadow_backgrounds_program(), "shadows"));
  work.sampler = frame.sampler(Sampling::nearest);
  return work;
}

void add_shadow_mips_in_place(FrameBuilder& frame, std::string_view name, std::span<const ShadowFace> faces,
                              const ShadowKnobs& knobs, ImageRef& atlas, ImageRef& pyramid) {
  GroupList list(kSteepestSurface);
  std::vector<DrawnFace> whole;
  for (const ShadowFace& face : faces) {
    list.add(face, 0, whole_face(face), 0);
    whole.push_back({face, {}, {DrawnRegion{whole_face(face), {}, {}}}, {}});
  }
  std::vector<GroupRange> runs = {list.take_range()};
  for (const GroupRange& run : add_coarse_runs(plan_faces(std::move(whole)), list)) runs.push_back(run);
  ComputePass pass(frame, name, shadow_mips_in_place_program(knobs.d16, MipRuns::first));
  atlas = pass.write("atlas", atlas);
  pyramid = pass.write("pyramid", pyramid);
  pass.items<shaders::ShadowMipGroup>("groups", list.groups());
  shaders::ShadowMipConstants constants = constants_of(knobs);
  for (const GroupRange& run : runs) {
    if (constants.first > 0) pass.barrier();  // each run reads the last mip of the run before
    if (constants.first > 0) pass.use(shadow_mips_in_place_program(knobs.d16, MipRuns::further));
    dispatch_groups(pass, constants, run);
    constants.first += GLOAM_SHADOW_MIP_RUN;
  }
}

void record_backgrounds(gpu::CommandList& commands, const ShadowMipWork& work, std::size_t batch,
                        const ShadowMipImages& images) {
  const gpu::ImageView scratch{.image = images.scratch, .as_array = true};
  const gpu::Binding bindings[] = {{0, gpu::Binding::Sampled{scratch, work.sampler}},
                                   {1, gpu::Binding::Storage{{.image = images.backgrounds, .as_array = true}}},
                                   {2, work.groups}};
  commands.bind_pipeline(work.backgrounds_pipeline);
  commands.bind(bindings);
  record(commands, work, work.backgrounds[batch], 0);
}

void record_batch_mips(gpu::CommandList& commands, const ShadowMipWork& work, std::size_t batch,
                       const ShadowMipImages& images) {
  bind(commands, work, work.pipeline, images);
  record(commands, work, work.batches[batch], 0);
}

void record_coarse_mips(gpu::CommandList& commands, const ShadowMipWork& work, const ShadowMipImages& images) {
  bind(commands, work, work.coarse_pipeline, images);
  for (std::uint32_t run = 0; run < work.coarse.size(); ++run) {
    if (run > 0) {
      // Each run reads the last mip of the run before.
      const gpu::ImageBarrier written[] = {{images.atlas, gpu::Access::compute_write, gpu::Access::compute_write},
                                           {images.pyramid, gpu::Access::compute_write, gpu::Access::compute_write}};
      commands.barrier({}, written);
    }
    record(commands, work, work.coarse[run], (run + 1) * GLOAM_SHADOW_MIP_RUN);
  }
}

}  // namespace gloam

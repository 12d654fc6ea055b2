// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <bit>
#include <utility>

#include "modules/lights/outputs.h"
#include "modules/shadows/map_tools.h"
#include "modules/shadows/outputs.h"
#include "modules/shadows/shadow_faces.h"
#include "modules/shadows/shadow_mips.h"
#include "modules/shadows/shadow_state.h"
#include "modules/shadows/shadow_uploads.h"
#include "shaders/shadows/shaders.h"

namespace gloam {
namespace {

gpu::ComputePipelineDesc copy_pipeline() {
  return {"shadow_overlay_copy", "shadows", shaders::shadows::shadow_overlay_copy_comp, {}};
}

bool is_same(const ShadowFace& a, const ShadowFace& b) { return a.light == b.light && a.index == b.index; }

DrawnFace drawn_face(const ShadowFace& face) { return {face, {}, {DrawnRegion{whole_face(face), {}, {}}}, {}}; }

ImageRef create_layers(FrameGraph& graph, const char* module, const ScratchPlan::Batch& batch) {
  gpu::ImageDesc desc;
  desc.name = "shadow_overlay";
  desc.module = module;
  desc.format = gpu::Format::r32_float;
  desc.width = desc.height = batch.size;
  // Few different numbers, so that the frame's plans are met again.
  desc.layers = std::bit_ceil(static_cast<std::uint32_t>(batch.items.size()));
  desc.shape = gpu::ImageShape::array;
  return graph.create_image(desc);
}

/// Dispatches of the copies, one an image.
struct CopyWork {
  std::vector<GroupRange> images;
  gpu::Binding::BufferRange groups;
  gpu::PipelineHandle pipeline;
  gpu::SamplerHandle sampler;
};

Result<CopyWork> plan_copies(FrameBuilder& frame, std::span<const OverlayFace> faces, const ScratchPlan& plan) {
  CopyWork work;
  std::vector<shaders::ShadowMipGroup> groups;
  for (const ScratchPlan::Batch& batch : plan.batches) {
    const auto first = static_cast<std::uint32_t>(groups.size());
    for (std::uint32_t layer = 0; layer < batch.items.size(); ++layer) {
      shaders::ShadowMipGroup group{};
      group.origin = faces[batch.items[layer]].face.square.origin;
      group.layer = layer;
      add_groups(uvec2(0), uvec2(batch.size / GLOAM_SHADOW_MIP_BLOCK), GLOAM_SHADOW_MIP_GROUP,
                 [&](uvec2 begin, uvec2 end) {
                   group.begin = begin;
                   group.end = end;
                   groups.push_back(group);
                 });
    }
    work.images.push_back({first, static_cast<std::uint32_t>(groups.size()) - first});
  }
  auto written = frame.services().storage.write(std::as_bytes(std::span(groups)));
  if (!written.ok()) return written.error();
  work.groups = *written;
  auto pipeline = frame.services().pipelines.get(copy_pipeline());
  if (!pipeline.ok()) return pipeline.error();
  work.pipeline = *pipeline;
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();
  work.sampler = *sampler;
  return work;
}

void record_copies(PassContext& context, const CopyWork& work, ImageRef atlas, std::span<const ImageRef> images) {
  gpu::CommandList& commands = context.commands();
  commands.bind_pipeline(work.pipeline);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const gpu::ImageView layers{.image = context.image(images[i]), .as_array = true};
    const gpu::Binding bindings[] = {{0, gpu::Binding::Sampled{{.image = context.image(atlas)}, work.sampler}},
                                     {1, gpu::Binding::Storage{layers}},
                                     {2, work.groups}};
    commands.bind(bindings);
    dispatch_groups(commands, shaders::ShadowMipConstants{}, work.images[i]);
  }
}

/// What lay in the copies' squares, of faces that are not in view now, is gone when they come back.
void forget_what_lay_there(ShadowCache& cache, std::span<const OverlayFace> faces) {
  std::uint32_t number = 0;
  for (const OverlayFace& overlaid : faces) {
    ShadowFace nobody = overlaid.at_copy();
    nobody.light = kNoEntity;
    nobody.index = number++;
    cache.set_drawn(nobody, {});
  }
}

void record_mips(PassContext& context, const ShadowMipWork& work, std::span<const ImageRef> images, ImageRef atlas,
                 ImageRef pyramid) {
  gpu::CommandList& commands = context.commands();
  ShadowMipImages of{{}, context.image(atlas), context.image(pyramid), {}};
  for (std::size_t i = 0; i < images.size(); ++i) {
    of.scratch = context.image(images[i]);
    record_batch_mips(commands, work, i, of);
  }
  if (work.coarse.empty()) return;
  const gpu::ImageBarrier written[] = {{of.atlas, gpu::Access::compute_write, gpu::Access::compute_write},
                                       {of.pyramid, gpu::Access::compute_write, gpu::Access::compute_write}};
  commands.barrier({}, written);
  record_coarse_mips(commands, work, of);
}

/// Points a local light's row to the copy.
void redirect_local(shaders::ShadowRow& row, const OverlayFace& overlaid) {
  GLOAM_ASSERT(row.origins[overlaid.face.index] == vec2(overlaid.face.square.origin), "rows name the view's faces");
  row.origins[overlaid.face.index] = vec2(overlaid.copy.origin);
}

/// The same for a directional light's rows, one a cascade.
void redirect_cascade(std::span<shaders::ShadowRow> rows, const OverlayFace& overlaid) {
  for (shaders::ShadowRow& row : rows) {
    auto cascade = std::bit_cast<shaders::CascadeRow>(row);
    if (cascade.cascade.origin != vec2(overlaid.face.square.origin) || !(cascade.cascade.size > 0.0f)) continue;
    cascade.cascade.origin = vec2(overlaid.copy.origin);
    row = std::bit_cast<shaders::ShadowRow>(cascade);
    return;
  }
}

std::vector<shaders::ShadowRow> redirected_rows(const FrameBuilder& frame, const ShadowsOutputs& outputs,
                                                std::span<const OverlayFace> faces) {
  const auto& visible = frame.world().view_resource<VisibleLights>(frame.view().id);
  std::vector<shaders::ShadowRow> rows = *outputs.row_values;
  for (const OverlayFace& overlaid : faces) {
    const bool directional = overlaid.face.kind == LightKind::directional;
    const std::span<const Entity> lights = directional ? directional_lights(visible) : local_lights(visible);
    const auto index = static_cast<std::size_t>(std::ranges::find(lights, overlaid.face.light) - lights.begin());
    GLOAM_ASSERT(index < lights.size(), "faces belong to lights of the view");
    if (directional)
      redirect_cascade(
          std::span(rows).subspan(outputs.block_values.cascade_row + index * GLOAM_MAX_CASCADES, GLOAM_MAX_CASCADES),
          overlaid);
    else
      redirect_local(rows[index], overlaid);
  }
  return rows;
}

}  // namespace

OverlayPlan::OverlayPlan(const World& world, ViewId view)
    : views_(&world.view_resource<ShadowViews>(view)),
      free_(std::make_shared<const FreeSquares>(views_->atlas.free_squares())) {}

bool OverlayPlan::add(Entity light, const dvec3& low, const dvec3& high) {
  if (views_ == nullptr) return false;
  FreeSquares free = *free_;
  std::vector<OverlayFace> added;
  for (const ShadowFace& face : views_->faces) {
    if (face.light != light || face.square.size == 0 || !face_may_see(face, low, high)) continue;
    if (std::ranges::any_of(faces_, [&](const OverlayFace& there) { return is_same(there.face, face); })) continue;
    const AtlasSquare copy = free.take(face.square.size);
    if (copy.size == 0) return false;
    added.push_back({face, copy});
  }
  free_ = std::make_shared<const FreeSquares>(std::move(free));
  faces_.insert(faces_.end(), added.begin(), added.end());
  return true;
}

Result<OverlayCopies> OverlayMaps::start(FrameBuilder& frame, const char* module,
                                         std::span<const OverlayFace> faces) const {
  OverlayCopies copies;
  copies.faces.assign(faces.begin(), faces.end());
  copies.layers.resize(faces.size());
  std::vector<DrawnFace> drawn;
  for (const OverlayFace& overlaid : faces) drawn.push_back(drawn_face(overlaid.at_copy()));
  copies.plan = std::make_shared<const FacePlan>(plan_faces(std::move(drawn)));
  const ScratchPlan& plan = copies.plan->plan;
  auto work = plan_copies(frame, faces, plan);
  if (!work.ok()) return work.error();
  const ImageRef atlas = frame.get<ShadowsOutputs>().atlas;
  PassBuilder pass = frame.graph().add_pass("shadow_overlay_copy", "shadows");
  pass.read(atlas, gpu::Access::compute_read);
  for (const ScratchPlan::Batch& batch : plan.batches) {
    for (std::uint32_t layer = 0; layer < batch.items.size(); ++layer)
      copies.layers[batch.items[layer]] = {copies.images.size(), layer};
    copies.images.push_back(pass.write(create_layers(frame.graph(), module, batch), gpu::Access::compute_write));
  }
  pass.execute([work = std::move(*work), atlas, images = copies.images](PassContext& context) {
    record_copies(context, work, atlas, images);
  });
  return copies;
}

Status OverlayMaps::finish(FrameBuilder& frame, const OverlayCopies& copies) const {
  auto work = plan_shadow_mips(frame, {}, *copies.plan, tools_->knobs);
  if (!work.ok()) return work.error();
  auto found = tools_->states.view(frame.world().resource<ShadowWorld>(), frame.view().id, tools_->knobs.atlas_size,
                                   tools_->knobs.d16);
  if (!found.ok()) return found.error();
  ViewShadows& kept = **found;
  auto& outputs = frame.get<ShadowsOutputs>();
  PassBuilder pass = frame.graph().add_pass("shadow_overlay_mips", "shadows");
  for (const ImageRef image : copies.images) pass.read(image, gpu::Access::compute_read);
  outputs.atlas = pass.write(outputs.atlas, gpu::Access::compute_write);
  outputs.pyramid = pass.write(outputs.pyramid, gpu::Access::compute_write);
  pass.execute(
      [work = std::move(*work), copies, &kept, atlas = outputs.atlas, pyramid = outputs.pyramid](PassContext& context) {
        forget_what_lay_there(kept.cache, copies.faces);
        record_mips(context, work, copies.images, atlas, pyramid);
      });
  std::vector<shaders::ShadowRow> values = redirected_rows(frame, outputs, copies.faces);
  auto rows = upload_shadow_rows(frame, tools_->states, "shadow_overlay_rows", values);
  if (!rows.ok()) return rows.error();
  outputs.rows = *rows;
  outputs.row_values = std::make_shared<const std::vector<shaders::ShadowRow>>(std::move(values));
  return {};
}

void list_overlay_map_pipelines(PipelineList& list) { list.push_back(copy_pipeline()); }

}  // namespace gloam

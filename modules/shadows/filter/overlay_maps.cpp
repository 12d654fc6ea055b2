// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <bit>
#include <utility>

#include "engine/render/declare/compute_pass.h"
#include "engine/render/worlds/world_id.h"
#include "modules/lights/outputs.h"
#include "modules/shadows/filter/uploads.h"
#include "modules/shadows/maps/mips.h"
#include "modules/shadows/maps/state.h"
#include "modules/shadows/maps/tools.h"
#include "modules/shadows/outputs.h"
#include "modules/shadows/views/faces.h"
#include "shaders/shadows/shaders.h"

namespace gloam {
namespace {

ComputeProgram copy_program(bool d16) {
  return {d16 ? shaders::shadows::overlay_copy_r16_comp : shaders::shadows::overlay_copy_comp};
}

bool is_same(const ShadowFace& a, const ShadowFace& b) { return a.light == b.light && a.index == b.index; }

std::vector<shaders::ShadowCopyGroup> copy_groups(std::span<const OverlayFace> faces) {
  std::vector<shaders::ShadowCopyGroup> groups;
  for (const OverlayFace& overlaid : faces) {
    shaders::ShadowCopyGroup group{};
    group.origin = overlaid.face.square.origin;
    group.copy = overlaid.copy.origin;
    add_groups(uvec2(0), uvec2(overlaid.copy.size / GLOAM_SHADOW_MIP_BLOCK), GLOAM_SHADOW_MIP_GROUP,
               [&](uvec2 begin, uvec2 end) {
                 group.begin = begin;
                 group.end = end;
                 groups.push_back(group);
               });
  }
  return groups;
}

/// Drops cached maps in the squares of the copies. They belong to faces that are not in view in this frame; the copies
/// overwrite them, so the faces must be drawn again when they return.
void forget_what_lay_there(ShadowCache& cache, std::span<const OverlayFace> faces) {
  std::uint32_t number = 0;
  for (const OverlayFace& overlaid : faces) {
    ShadowFace nobody = overlaid.at_copy();
    nobody.light = kNoEntity;
    nobody.index = number++;
    cache.set_drawn(nobody, {});
  }
}

/// While it lives, passes and pipelines belong to the shadows module, whichever module adds them.
class AsShadows {
 public:
  explicit AsShadows(FrameBuilder& frame) : frame_(frame), caller_(frame.module()) { frame.set_module("shadows"); }
  ~AsShadows() { frame_.set_module(caller_); }
  AsShadows(const AsShadows&) = delete;
  AsShadows& operator=(const AsShadows&) = delete;

 private:
  FrameBuilder& frame_;
  std::string_view caller_;
};

/// Makes a local light's row refer to the copy.
void redirect_local(shaders::ShadowRow& row, const OverlayFace& overlaid) {
  GLOAM_ASSERT(row.origins[overlaid.face.index] == vec2(overlaid.face.square.origin), "rows name the view's faces");
  row.origins[overlaid.face.index] = vec2(overlaid.copy.origin);
}

/// The same for the rows of a directional light, one per cascade.
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
    : view_faces_(&world.view_resource<ViewFaces>(view)),
      free_(std::make_shared<const FreeSquares>(view_faces_->atlas.free_squares())) {}

bool OverlayPlan::add(Entity light, const dvec3& low, const dvec3& high) {
  if (view_faces_ == nullptr) return false;
  FreeSquares free = *free_;
  std::vector<OverlayFace> added;
  for (const ShadowFace& face : view_faces_->faces) {
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

bool OverlayMaps::d16() const { return tools_->knobs.d16; }

OverlayCopies OverlayMaps::start(FrameBuilder& frame, std::span<const OverlayFace> faces) const {
  const ShadowKnobs& knobs = tools_->knobs;
  ViewMapState& kept = tools_->states.view(world_id(frame.world()),
                                           frame.world().view_resource<ViewFaces>(frame.view().id), frame.view().id);
  OverlayCopies copies{{faces.begin(), faces.end()}, knobs.d16};
  if (knobs.mip_operator == GLOAM_SHADOW_MIPS_COVERAGE) copies.depth_bits = ~GLOAM_SHADOW_FREE_BITS;
  const std::vector<shaders::ShadowCopyGroup> groups = copy_groups(faces);
  const AsShadows owner(frame);
  ImageRef& atlas = frame.get<ShadowsOutputs>().atlas;
  ComputePass pass(frame, "shadow_overlay_copy", copy_program(knobs.d16));
  atlas = pass.write("atlas", atlas);
  pass.items<shaders::ShadowCopyGroup>("groups", groups);
  dispatch_groups(pass, shaders::ShadowCopyConstants{}, {0, static_cast<std::uint32_t>(groups.size())});
  frame.on_commit([&kept, faces = copies.faces] { forget_what_lay_there(kept.cache, faces); });
  return frame.status().ok() ? copies : OverlayCopies{};
}

void OverlayMaps::finish(FrameBuilder& frame, const OverlayCopies& copies) const {
  std::vector<ShadowFace> made;
  for (const OverlayFace& overlaid : copies.faces) made.push_back(overlaid.at_copy());
  const AsShadows owner(frame);
  auto& outputs = frame.get<ShadowsOutputs>();
  add_shadow_mips_in_place(frame, "shadow_overlay_mips", made, tools_->knobs, outputs.atlas, outputs.pyramid);
  std::vector<shaders::ShadowRow> values = redirected_rows(frame, outputs, copies.faces);
  outputs.rows = upload_shadow_rows(frame, tools_->states, "shadow_overlay_rows", values);
  outputs.row_values = std::make_shared<const std::vector<shaders::ShadowRow>>(std::move(values));
}

void list_overlay_map_pipelines(bool d16, PipelineList& list) {
  list.push_back(pipeline_desc(copy_program(d16), "shadows"));
  for (const MipRuns runs : {MipRuns::first, MipRuns::further})
    list.push_back(pipeline_desc(shadow_mips_in_place_program(d16, runs), "shadows"));
}

}  // namespace gloam

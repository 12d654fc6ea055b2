// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/shadow_passes.h"

#include <algorithm>
#include <optional>

#include "engine/render/camera/light_scale.h"
#include "engine/render/worlds/world_id.h"
#include "engine/scene/transmission.h"
#include "modules/shadows/filter/cookies.h"
#include "modules/shadows/filter/uploads.h"
#include "modules/shadows/final_lists/buffers.h"
#include "modules/shadows/final_lists/generate.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/maps/draw_passes.h"
#include "modules/shadows/maps/planes.h"
#include "modules/shadows/outputs.h"

namespace gloam {
namespace {

/// Value of kCookieLights (arriving_light.glsl). Only three values, because each makes other pipelines.
std::uint32_t looked_up_cookies(std::size_t lights) {
  constexpr std::uint32_t kMost = GLOAM_COOKIE_LIGHTS;
  return lights <= 1 ? static_cast<std::uint32_t>(lights) : lights <= kMost ? kMost : kMost + 1;
}

constexpr std::uint32_t kStandardKernel = 8;  // kernel of GLOAM_SHADOWS_STANDARD

bool has_placed_face(const ViewFaces& view_faces) {
  return std::any_of(view_faces.faces.begin(), view_faces.faces.end(),
                     [](const ShadowFace& face) { return face.square.size > 0; });
}

/// Whether lights may be dim (shadows.min_contribution): white is known before the frame is drawn, and nobody looks at
/// visibilities themselves. Thin surfaces are asked about apart, and would need the eight pixels apart, too.
bool may_have_dim_lights(const FrameBuilder& frame) {
  return has_stated_exposure(frame.world()) && frame.view().purpose == ViewPurpose::main &&
         frame.visualizer() == "none" && frame.find<ThinSurfaces>() == nullptr;
}

constexpr const char* kThinFilter = "kThinFilter";  // among the constants only of frames with thin surfaces

/// Sets the specialisation constants of shaders that read `outputs`. filter: value of kFilter. thin: the frame has thin
/// surfaces.
void set_constants(const ShadowKnobs& knobs, std::uint32_t filter, bool thin, ShadowsOutputs& outputs) {
  outputs.cookies_only = filter == kNoShadows;
  outputs.standard = filter == kContactHardening && knobs.kernel == kStandardKernel;
  outputs.transmission = knobs.transmission;
  // Cookies do not depend on knobs: default values avoid further pipelines.
  ShadowKnobs used = outputs.cookies_only ? ShadowKnobs{} : knobs;
  used.transmission = knobs.transmission;
  outputs.constants = shadow_constants(used, filter);
  if (thin) outputs.constants.set_if_present(kThinFilter, knobs.early_outs ? knobs.thin_filter : 0u);
  outputs.constants.set_if_present("kCookieLights", looked_up_cookies(outputs.cookie_lights));
}

/// Updates the maps of the view's faces, of which at least one has a place. Withheld casters are left out only when the
/// frame makes final lists (for_lists): otherwise no module would draw them.
ShadowMaps add_maps(FrameBuilder& frame, ShadowStates& states, const ShadowKnobs& knobs, bool for_lists) {
  const ViewFaces& view_faces = frame.world().view_resource<ViewFaces>(frame.view().id);
  ViewMapState& kept = states.view(world_id(frame.world()), view_faces, frame.view().id);
  // A companion draws the maps as its main view had them last, which in most frames are those of this frame, too.
  const WithheldCasters* withheld = for_lists ? frame.find<WithheldCasters>() : nullptr;
  if (!frame.view().is_companion()) kept.history.withhold(withheld == nullptr ? WithheldCasters{} : *withheld);
  ShadowMaps maps = add_shadow_map_passes(frame, states, kept, view_faces, knobs);
  if (!frame.status().ok()) return {};
  frame.expose(maps.atlas, "shadow_atlas");
  return maps;
}

/// Adds the passes of final lists; with classification, the planes before them.
std::optional<FinalLists> add_final_lists(FrameBuilder& frame, ShadowStates& states, ListReuse& reuse,
                                          const ShadowMaps& maps, const ShadowKnobs& knobs,
                                          const ShadowsOutputs& outputs) {
  const ViewFaces& view_faces = frame.world().view_resource<ViewFaces>(frame.view().id);
  ViewMapState& kept = states.view(world_id(frame.world()), view_faces, frame.view().id);
  ImageRef planes;
  if (knobs.classify) planes = add_shadow_planes_pass(frame, kept, maps, view_faces, knobs);
  return add_generate_passes(
      frame, knobs, planes, kept, outputs,
      reuse.view(world_id(frame.world()), frame.view().id, frame.services().device.frame_number()));
}

}  // namespace

ShadowKnobs knobs_of(const FrameBuilder& frame) {
  ShadowKnobs knobs = shadow_knobs(frame.knobs());
  const GeometryOutputs* geometry = frame.find<GeometryOutputs>();
  knobs.terminator = knobs.terminator && geometry != nullptr && geometry->smooth_surfaces;
  knobs.transmission = lets_light_through(frame.world());
  if (!may_have_dim_lights(frame)) knobs.min_contribution = 0.0f;
  // Pictures that accumulate under jitter need shadows of points between pixels, not those of the nearest pixel.
  if (frame.view().jittered && knobs.reuse == ShadowReuse::reprojected) knobs.reuse = ShadowReuse::exact;
  knobs.atlas_size = frame.world().view_resource<ViewFaces>(frame.view().id).atlas.size();
  return knobs;
}

ShadowsOutputs with_knobs(const ShadowsOutputs& now, const KnobRegistry& registry) {
  ShadowKnobs knobs = shadow_knobs(registry);
  knobs.transmission = now.transmission;
  if (!now.may_have_dim_lights) knobs.min_contribution = 0.0f;
  ShadowsOutputs other = now;
  set_constants(knobs, knobs.enabled ? knobs.filter : kNoShadows, now.constants.find(kThinFilter) != nullptr, other);
  if (other.cookies_only || !knobs.deferred || knobs.levels == 0)
    other.final_lists.reset();
  else if (!other.final_lists)
    other.final_lists.emplace();
  if (other.final_lists) set_list_constants(knobs, *other.final_lists);
  return other;
}

void add_shadow_passes(FrameBuilder& frame, ShadowStates& states, ListReuse& reuse) {
  const ViewFaces& view_faces = frame.world().view_resource<ViewFaces>(frame.view().id);
  const ShadowKnobs knobs = knobs_of(frame);
  states.begin(frame.services().device);
  reuse.forget_unused(frame.services().device.frame_number());
  const ShadowUploads uploads = add_shadow_uploads(frame, states, view_faces, knobs);
  if (!frame.status().ok()) return;

  const TracedVisibility* found = traced_visibility_of(frame.world(), frame.view());
  const bool traced = knobs.enabled && found != nullptr && found->shades;
  const bool has_maps = knobs.enabled && !traced && has_placed_face(view_faces);
  ShadowsOutputs outputs{.block = uploads.block,
                         .block_values = uploads.block_values,
                         .rows = uploads.rows,
                         .standard_rows = uploads.rows,
                         .row_values = uploads.row_values,
                         .cookies = uploads.cookies,
                         .traced = uploads.traced};
  outputs.cookie_lights = static_cast<std::uint32_t>(count_cookie_lights(frame.world()));
  outputs.may_have_dim_lights = may_have_dim_lights(frame);
  outputs.cookies_version = frame.world().resource<Cookies>().version;
  set_constants(knobs,
                traced     ? kTracedShadows
                : has_maps ? knobs.filter
                           : kNoShadows,
                frame.find<ThinSurfaces>() != nullptr, outputs);
  const bool has_lists = has_maps && can_generate(frame, knobs) && generate_pipelines_ready(frame, knobs, outputs);
  ShadowMaps maps;
  if (has_maps)
    maps = add_maps(frame, states, knobs, has_lists);
  else
    states.skip_frame(world_id(frame.world()), view_faces);
  if (!frame.status().ok()) return;
  outputs.atlas = maps.atlas;
  outputs.pyramid = maps.pyramid;
  if (has_lists) outputs.final_lists = add_final_lists(frame, states, reuse, maps, knobs, outputs);
  frame.put(std::move(outputs));
}

}  // namespace gloam

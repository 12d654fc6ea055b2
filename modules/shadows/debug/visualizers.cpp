// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/debug/visualizers.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "engine/render/passes/visualizer_pass.h"
#include "engine/render/worlds/world_id.h"
#include "modules/lights/outputs.h"
#include "modules/shadows/atlas/view_faces.h"
#include "modules/shadows/debug/shown_light.h"
#include "modules/shadows/outputs.h"
#include "shaders/shadows/maps/map_shared.h"
#include "shaders/shadows/shaders.h"

namespace gloam {
namespace {

/// The square of each placed face in the picture; the atlas fills the picture's shorter side.
std::vector<shaders::AtlasFaceConstants> atlas_squares(const ViewFaces& view_faces, const RenderView& view,
                                                       const ViewMapState& kept) {
  std::vector<shaders::AtlasFaceConstants> squares;
  const auto side = static_cast<float>(std::min(view.width, view.height));
  const float scale = side / static_cast<float>(std::max(view_faces.atlas.size(), 1u));
  for (const ShadowFace& face : view_faces.faces) {
    if (face.square.size == 0) continue;
    shaders::AtlasFaceConstants square{};
    square.origin = vec2(face.square.origin);
    square.size = static_cast<float>(face.square.size);
    square.near_m = face.tan_half > 0.0f ? face.near_m : 0.0f;
    square.far_m = face.far_m;
    const FaceKey key{face.light, face.index, face.view};
    square.drawn = std::ranges::find(kept.frame.drawn, key) != kept.frame.drawn.end() ? 1.0f : 0.0f;
    square.corner = glm::floor(square.origin * scale);
    square.pixels = std::max(1.0f, std::floor(square.size * scale));
    squares.push_back(square);
  }
  return squares;
}

void add_atlas_view(FrameBuilder& frame, const ShadowsOutputs& shadows, const ViewMapState& kept) {
  TargetOutput& target = frame.get<TargetOutput>();
  DrawPass pass(frame, "shadow_atlas_view",
                {.fragment = shaders::shadows::atlas_view_frag, .constants = visualizer_constants(frame)});
  target.color = pass.target(target.color, gpu::LoadOp::clear);
  pass.read("atlas", shadows.atlas);
  const auto& view_faces = frame.world().view_resource<ViewFaces>(frame.view().id);
  for (const shaders::AtlasFaceConstants& square : atlas_squares(view_faces, frame.view(), kept)) {
    pass.record([corner = ivec2(square.corner), side = static_cast<std::uint32_t>(square.pixels)](
                    PassContext& context) { context.commands().set_scissor(corner.x, corner.y, side, side); });
    pass.push(square);
    pass.draw_triangle();
  }
}

}  // namespace

std::uint32_t kind_of(const FrameBuilder& frame, const shaders::ShownLightConstants& light) {
  if (light.directional != 0) return GLOAM_SHADOWS_SUNS;
  const auto& rows = frame.world().view_resource<ViewFaces>(frame.view().id).rows;
  const float kind = light.light < rows.size() ? rows[light.light].kind : static_cast<float>(GLOAM_SHADOW_NONE);
  return kind == static_cast<float>(GLOAM_SHADOW_CUBE) ? GLOAM_SHADOWS_CUBES : GLOAM_SHADOWS_SPOTS;
}

DrawProgram drawn_visibility_program(const ShadowsOutputs& shadows, const gpu::ShaderCode& from_maps,
                                     const gpu::ShaderCode& from_lists) {
  DrawProgram program{.fragment = from_maps, .constants = shadows.constants};
  if (!shadows.final_lists) return program;
  const FinalLists& lists = *shadows.final_lists;
  program.fragment = from_lists;
  program.constants.set(lists.constants);
  program.constants.set("kFallback", lists.always_complete ? 0u : 1u);
  return program;
}

ImageRef draw_shadow_picture(FrameBuilder& frame, ShadowPicture picture) {
  const ShadowsOutputs& shadows = picture.shadows ? *picture.shadows : frame.get<ShadowsOutputs>();
  const bool over = picture.program.blend != gpu::BlendMode::opaque;
  picture.program.constants.set(visualizer_constants(frame));
  DrawPass pass(frame, picture.pass, picture.program);
  read_geometry(pass, frame.get<GeometryOutputs>());
  read_light_lists(pass, frame.get<LightsOutputs>());
  read_shadows(pass, shadows);
  if (shadows.final_lists) read_final_lists(pass, *shadows.final_lists);
  pass.push_bytes(picture.push);
  const ImageRef values = add_visualizer_targets(frame, pass, std::move(picture.values), picture.format,
                                                 over ? gpu::LoadOp::load : gpu::LoadOp::clear);
  pass.draw_triangle();
  return values;
}

std::vector<VisualizerInfo> shadow_visualizers() {
  std::vector<VisualizerInfo> views = {
      {"shadow", "shadows", "LIGHT",
       "visibility of the light at each pixel: black unlit, white fully lit, grey between (linear: 0.5 is 188 in the "
       "picture), blue out of the light's reach. With shadows.mode=deferred, read from the tile's final list: surfaces "
       "that face away from the light are black, or show the transmittance where light passes through them"},
      {"shadow_atlas", "shadows", "",
       "the shadow maps at their places in the atlas: white near the light, dark far from it, blue no caster; border: "
       "orange drawn in this frame, green kept from an earlier frame"}};
  for (VisualizerInfo& view : views) {
    view.knob = kShadowMode.name;
    view.value = texts_of(kShadowMode, {ShadowMode::monolithic, ShadowMode::deferred});
  }
  views.front().image = "shadow_visibility";
  return views;
}

void add_shadow_view_pass(FrameBuilder& frame, const ShadowStates& states, OnceLog& once_log) {
  const std::string_view shown = frame.visualizer();
  const std::string_view stem = shown.substr(0, shown.find(':'));
  if (stem != "shadow" && stem != "shadow_atlas") return;
  const ShadowsOutputs* shadows = frame.find<ShadowsOutputs>();
  if (shadows == nullptr) return;
  if (stem == "shadow_atlas") {
    const ViewMapState* kept =
        states.find(world_id(frame.world()), frame.world().view_resource<ViewFaces>(frame.view().id));
    const bool has_maps = shadows->atlas && shadows->atlas.resource != shadows->rows.resource;
    if (kept != nullptr && has_maps) add_atlas_view(frame, *shadows, *kept);
  } else if (const auto light = shown_light_or_warn(frame, once_log)) {
    DrawProgram program = drawn_visibility_program(*shadows, shaders::shadows::visibility_view_frag,
                                                   shaders::shadows::final_visibility_view_frag);
    program.constants.set("kKinds", kind_of(frame, *light));
    draw_shadow_picture(frame, {.pass = "shadow_view",
                                .values = "shadow_visibility",
                                .program = std::move(program),
                                .push = std::as_bytes(std::span(&*light, 1))});
  }
}

}  // namespace gloam

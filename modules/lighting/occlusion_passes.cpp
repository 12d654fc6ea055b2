// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/occlusion_passes.h"

#include <string>

#include "engine/render/declare/draw_pass.h"
#include "engine/render/passes/visualizer_pass.h"
#include "engine/render/views/seen_surfaces.h"
#include "engine/scene/units.h"
#include "modules/lighting/occlusion.h"
#include "shaders/lighting/occlusion_shared.h"
#include "shaders/lighting/shaders.h"

namespace gloam {
namespace {

constexpr const char* kView = "occlusion";

void read_inputs(DrawPass& pass, const GeometryOutputs& geometry, const shaders::OcclusionConstants& constants) {
  pass.read("depth_image", geometry.depth);
  pass.read("normal_image", geometry.normals);
  pass.push(constants);
}

}  // namespace

bool occludes_ambient(const FrameBuilder& frame) {
  // The sides of a captured cube would have seams, because none sees what is beside it.
  return frame.knobs().value(kAmbientOcclusion) && frame.view().purpose != ViewPurpose::capture &&
         sees_surfaces(frame.world(), frame.view());
}

void add_occlusion_passes(FrameBuilder& frame) {
  if (!occludes_ambient(frame)) return;
  const auto& geometry = frame.get<GeometryOutputs>();
  const shaders::OcclusionConstants constants{static_cast<float>(1.0 / metres_per_unit(frame.world()))};
  ImageRef estimate;
  {
    DrawPass pass(frame, "occlusion_estimate", {shaders::lighting::estimate_frag});
    estimate =
        pass.target(create_view_image(frame, "occlusion_estimate", gpu::Format::r8_unorm, GLOAM_OCCLUSION_SCALE));
    read_inputs(pass, geometry, constants);
    pass.draw_triangle();
  }
  DrawPass pass(frame, "occlusion_smooth", {shaders::lighting::smooth_frag});
  const ImageRef hidden = pass.target(create_view_image(frame, "occlusion_smooth", gpu::Format::r8_unorm));
  read_inputs(pass, geometry, constants);
  pass.read("estimate_image", estimate);
  pass.draw_triangle();
  frame.put(AmbientOcclusion{hidden});
}

std::vector<VisualizerInfo> occlusion_visualizers() {
  return {{kView, "lighting", "",
           "share of the light of the surroundings that surfaces within 1 m leave: white all, black nothing",
           std::string(kAmbientOcclusion.name), "on"}};
}

void add_occlusion_view_pass(FrameBuilder& frame) {
  const auto* occlusion = frame.find<AmbientOcclusion>();
  if (frame.visualizer() != kView || occlusion == nullptr) return;
  DrawPass pass(frame, "occlusion_view", {shaders::lighting::occlusion_view_frag, visualizer_constants(frame)});
  pass.read("hidden_image", occlusion->hidden);
  add_visualizer_targets(frame, pass, kView, gpu::Format::rgba16_float);
  pass.draw_triangle();
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/declare/draw_pass.h"
#include "modules/lighting/lighting_passes.h"
#include "modules/lighting/outputs.h"
#include "shaders/lighting/shaders.h"

namespace gloam {
namespace {

constexpr gpu::Format kFrontDepthFormat = gpu::Format::r32_float;

}  // namespace

SurfacePass front_depth_surface_pass() {
  SurfacePass pass;
  pass.module = "lighting";
  pass.fragment = shaders::lighting::front_depth_frag;
  pass.color_formats = {kFrontDepthFormat};
  pass.blend = gpu::BlendMode::alpha;
  pass.depth_write = false;
  return pass;
}

void add_front_depth_passes(FrameBuilder& frame) {
  const std::span<const Draw> draws = frame.draws().blended;
  if (draws.empty() || frame.find<FrontDepthWanted>() == nullptr) return;
  const SurfacePass surfaces = front_depth_surface_pass();
  const DrawProgram start_program{shaders::lighting::front_depth_start_frag};
  if (const FrameServices& services = frame.services(); !services.wait_for_pipelines) {
    const gpu::Format formats[] = {kFrontDepthFormat};
    const bool ready = services.pipelines.request({pipeline_desc(start_program, "lighting", formats)}, services.log);
    if (!frame.request_surfaces(draws, surfaces) || !ready) return;
  }
  const ImageRef opaque = frame.get<GeometryOutputs>().depth;

  DrawPass start(frame, "front_depth_start", start_program);
  start.read("depth_image", opaque);
  const ImageRef started = start.target(create_view_image(frame, "front_depth", kFrontDepthFormat));
  start.draw_triangle();

  DrawPass pass(frame, "front_depth");
  const ImageRef depth = pass.target(started, gpu::LoadOp::load);
  pass.test_depth(opaque);
  pass.use(surfaces);
  pass.surfaces(draws);
  frame.put(FrontDepth{depth});
}

ImageRef front_depth(FrameBuilder& frame) {
  const FrontDepth* front = frame.find<FrontDepth>();
  return front != nullptr ? front->depth : frame.get<GeometryOutputs>().depth;
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <string>
#include <utility>

#include "engine/render/frame/attempt.h"
#include "engine/render/frame/stages.h"
#include "engine/render/modules_in_use/visualizers.h"
#include "engine/render/passes/renderer_passes.h"
#include "engine/scene/transmission.h"

namespace gloam {
namespace {

/// Has each module that takes part add its passes, phase by phase, with the engine's own passes after the geometry.
Status add_module_passes(Frame& frame, const FrameView& own, FrameBuilder& builder, RendererParts& parts) {
  const ViewQuery query = frame.query_of(own);
  const std::vector<Module*> taking_part = parts.modules.begin_view(query, parts.pipeline_wait());
  const bool has_picture = !own.request.target.light && !own.main;
  for (const PassPhase phase : kAllPhases) {
    if (!has_picture && phase >= PassPhase::output) break;
    for (Module* module : taking_part) {
      builder.set_module(module->name());
      GLOAM_TRY(attempt([&] { return "declaring the passes of module '" + std::string(module->name()) + "'"; },
                        [&]() -> Status {
                          module->add_passes(builder, phase);
                          return builder.status();
                        }));
    }
    builder.set_module("engine");
    if (phase != PassPhase::geometry) continue;
    add_sky_motion_pass(builder);
    if (parts.modules.view_needs(&Module::needs_smooth_surfaces, query)) add_smooth_surface_pass(builder);
    add_depth_bounds_pass(builder);
    GLOAM_TRY(builder.status());
  }
  return {};
}

/// After all passes on the view's light: if it has moved from `lit`, the renderer's image, to another image, copies it
/// back if read_linear wants it.
void keep_linear(FrameBuilder& builder, ImageRef lit, bool wanted, ViewStore& views) {
  const ImageRef last = builder.get<LitOutput>().color;
  const gpu::ImageDesc &from = builder.graph().desc(last), &to = builder.graph().desc(lit);
  GLOAM_ASSERT(from.format == to.format && from.width == to.width && from.height == to.height,
               "LitOutput may move only to an image of the same size and format");
  const bool moved = last.resource != lit.resource;
  views.set_lit(builder.view().id, !moved || wanted, builder.view().light_scale);
  if (moved && wanted) static_cast<void>(add_copy_light_pass(builder, last, builder.graph().newest(lit)));
}

/// Copies the view's linear light into the caller's image.
Status add_light_copy(Frame& frame, FrameBuilder& builder, const LightTarget& target, const gpu::Device& device) {
  const gpu::ImageDesc& desc = device.desc(target.image);
  const uvec2 size = glm::max(uvec2(desc.width, desc.height) >> target.mip, uvec2(1));
  GLOAM_ASSERT(size == uvec2(builder.view().width, builder.view().height),
               "the mip of a light target has the size of its view");
  const LightTarget& first = frame.light_targets.try_emplace(target.image, target).first->second;
  GLOAM_ASSERT(first.before == target.before && first.after == target.after,
               "views that capture into one image state the same accesses");
  CapturedLight* captured = frame.shared.find<CapturedLight>();
  if (captured == nullptr) captured = &frame.shared.put(CapturedLight{});
  ImageRef& image = captured->images[target.image];
  if (!image) image = builder.graph().import_image("light_target", target.image, target.before, target.after);
  image = add_copy_light_pass(builder, builder.get<LitOutput>().color, image, target.mip, target.layer);
  return builder.status();
}

/// The passes before those of the modules: deformed vertices and the geometry buffer.
Status declare_geometry(const Frame& frame, const FrameView& own, FrameBuilder& builder) {
  add_deform_pass(builder);
  add_geometry_pass(builder, own.request.geometry ? &*own.request.geometry : nullptr, frame.redraw != nullptr);
  GLOAM_TRY(builder.status());
  const GeometryOutputs& geometry = builder.get<GeometryOutputs>();
  for (const ImageRef image : {geometry.base_color, geometry.normals, geometry.material, geometry.depth})
    builder.expose(image);
  if (geometry.motion) builder.expose(geometry.motion);
  if (lets_light_through(builder.world())) builder.expose(geometry.emissive);  // extinction lengths
  return {};
}

/// A companion draws no picture: it leaves its light and depth in CompanionLight.
Status declare_companion(Frame& frame, const FrameView& own, FrameBuilder& builder, RendererParts& parts) {
  builder.put(LitOutput{create_view_image(builder, "companion_light", gpu::Format::rgba16_float)});
  GLOAM_TRY(add_module_passes(frame, own, builder, parts));
  CompanionLight* companions = frame.shared.find<CompanionLight>();
  if (companions == nullptr) companions = &frame.shared.put(CompanionLight{});
  companions->views[builder.view().id.value] = {builder.get<LitOutput>().color, builder.get<GeometryOutputs>().depth};
  return {};
}

Status declare_capture(Frame& frame, const FrameView& own, FrameBuilder& builder, ImageRef lit, RendererParts& parts) {
  GLOAM_TRY(add_module_passes(frame, own, builder, parts));
  keep_linear(builder, lit, own.request.keep_linear, parts.views);
  return add_light_copy(frame, builder, *own.request.target.light, *parts.options.device);
}

/// Warns if the view's visualizer belongs to a module that is not demanded: the picture is then shown as it is.
void warn_of_idle_visualizer(const Frame& frame, const FrameView& own, RendererParts& parts) {
  const std::string& name = own.request.settings.visualizer;
  const std::string reason = parts.modules.reason_of_idle_visualizer(name, frame.query_of(own));
  if (!reason.empty())
    parts.once.warning(*parts.options.log,
                       "view " + name.substr(0, name.find(':')) + " shows the picture as it is: " + reason);
}

Status declare_picture(Frame& frame, const FrameView& own, FrameBuilder& builder, ImageRef lit, RendererParts& parts) {
  const ViewTarget& wanted = own.request.target;
  const bool external = static_cast<bool>(wanted.image);
  const gpu::ImageHandle picture = external ? wanted.image : parts.views.at(builder.view().id).picture;
  const gpu::Access after = external ? wanted.after : gpu::Access::transfer_read;
  const ImageRef target = builder.graph().import_image("picture", picture, gpu::Access::none, after);
  builder.put(TargetOutput{target, parts.options.device->desc(picture).format});
  GLOAM_TRY(add_module_passes(frame, own, builder, parts));
  const std::uint32_t code = engine_visualizer_code(own.request.settings.visualizer);
  if (code == 0 && builder.visualizer() != "none") warn_of_idle_visualizer(frame, own, parts);
  keep_linear(builder, lit, own.request.keep_linear, parts.views);
  GLOAM_ASSERT(builder.get<TargetOutput>().color.resource == target.resource,
               "TargetOutput is written in place: a module has put another image there");
  if (code != 0) add_debug_view_pass(builder, code);
  GLOAM_TRY(builder.status());
  if (wanted.overlay) GLOAM_TRY(wanted.overlay(builder.graph(), builder.get<TargetOutput>().color));
  if (frame.redraw != nullptr && frame.redraw->view == builder.view().id) GLOAM_TRY(frame.redraw->add_copies(builder));
  return {};
}

}  // namespace

Status declare_view(Frame& frame, std::size_t index, RendererParts& parts) {
  const FrameView& own = frame.views[index];
  const ViewSettings& settings = own.request.settings;
  FrameGraph& graph = parts.resources.graph;
  frame.builders.push_back(std::make_unique<FrameBuilder>(parts.services(frame.knobs_of(own)), graph, frame.world,
                                                          *own.view, parts.worlds.scene_of(frame.world), frame.draws,
                                                          index, frame.shared));
  FrameBuilder& builder = *frame.builders.back();
  graph.set_view(own.view->id.value);
  builder.set_visualizer(settings.visualizer, settings.heat_range);
  if (parts.modules.view_needs(&Module::needs_motion, frame.query_of(own)))
    builder.set_previous_instances(&parts.resources.motion.instances());
  builder.upload_view_constants(engine_visualizer_code(settings.visualizer));
  GLOAM_TRY(declare_geometry(frame, own, builder));
  if (own.main) {
    GLOAM_TRY(declare_companion(frame, own, builder, parts));
  } else {
    const ImageRef lit =
        graph.import_image("lit", parts.views.at(own.view->id).lit, gpu::Access::none, gpu::Access::transfer_read);
    builder.put(LitOutput{lit});
    GLOAM_TRY(own.request.target.light ? declare_capture(frame, own, builder, lit, parts)
                                       : declare_picture(frame, own, builder, lit, parts));
  }
  frame.counters.push_back(count_view(parts.modules, builder));
  return {};
}

}  // namespace gloam

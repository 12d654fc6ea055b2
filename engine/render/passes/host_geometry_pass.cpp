// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <map>

#include "engine/render/declare/draw_pass.h"
#include "engine/render/passes/renderer_passes.h"
#include "shaders/render/gbuffer/host_geometry_shared.h"
#include "shaders/render/shaders.h"

namespace gloam {
namespace {

/// The host's images in this frame, on its shared board. One image may serve several views and purposes.
struct HostImages {
  std::map<gpu::ImageHandle, ImageRef> images;
};

ImageRef imported(FrameBuilder& frame, gpu::ImageHandle image, const HostGeometryDesc& desc, bool drawn_again) {
  if (!image) return {};
  HostImages* known = frame.shared().find<HostImages>();
  if (known == nullptr) known = &frame.shared().put(HostImages{});
  ImageRef& ref = known->images[image];
  const gpu::Access before = drawn_again ? desc.after : desc.before;
  if (!ref) ref = frame.graph().import_image("host_geometry", image, before, desc.after);
  return ref;
}

bool is_unsigned(gpu::Format format) {
  using enum gpu::Format;
  return format == rgba8_unorm || format == rgb10a2_unorm || format == rg16_unorm;
}

shaders::HostGeometryConstants constants_of(FrameBuilder& frame, const HostGeometryDesc& desc) {
  shaders::HostGeometryConstants c{};
  const mat3 world_from_normal =
      desc.view_space_normals ? glm::transpose(mat3(frame.view().view_from_relative)) : mat3(1.0f);
  c.world_x = vec4(world_from_normal[0], 0.0f);
  c.world_y = vec4(world_from_normal[1], 0.0f);
  c.world_z = vec4(world_from_normal[2], 0.0f);
  const bool from_unsigned = is_unsigned(frame.services().device.desc(desc.normals).format);
  c.normal_scale = from_unsigned ? vec4(2.0f, -1.0f, 0.0f, 0.0f) : vec4(1.0f, 0.0f, 0.0f, 0.0f);
  c.depth_kind = static_cast<std::uint32_t>(desc.depth_kind);
  c.near_m = desc.near_m;
  c.far_m = desc.far_m;
  c.octahedral = desc.normals_kind == HostNormals::octahedral ? 1u : 0u;
  const auto channel = [](HostChannel which) { return static_cast<std::uint32_t>(which); };
  c.channels = channel(desc.roughness) | channel(desc.metallic) << 4 | channel(desc.occlusion) << 8;
  c.srgb = desc.srgb_base_color && !gpu::encodes_srgb(frame.services().device.desc(desc.base_color).format) ? 1u : 0u;
  c.face_normals = desc.face_normals ? 1u : 0u;
  c.emissive = desc.emissive ? 1u : 0u;
  return c;
}

}  // namespace

void add_host_geometry_pass(FrameBuilder& frame, const HostGeometry& host, bool drawn_again, GeometryOutputs& outputs) {
  const HostGeometryDesc& desc = host.desc();
  GLOAM_ASSERT(!frame.view().camera.orthographic || desc.far_m > 0.0f || desc.depth_kind == HostDepth::metres,
               "host geometry of an orthographic camera needs far_m");
  const bool with_motion = frame.previous_instances() != nullptr;
  DrawPass pass(
      frame, "host_geometry",
      {.fragment = with_motion ? shaders::render::host_geometry_motion_frag : shaders::render::host_geometry_frag,
       .depth_compare = gpu::CompareOp::always,
       .depth_write = true});
  const std::span<const gpu::Format> formats = geometry_formats(with_motion);
  const auto target = [&](const char* name, std::size_t at) {
    return pass.target(create_view_image(frame, name, formats[at]), gpu::LoadOp::clear);
  };
  outputs.base_color = target("base_color", 0);
  outputs.normals = target("normals", 1);
  outputs.material = target("material", 2);
  outputs.emissive = target("emissive", 3);
  if (with_motion) outputs.motion = target("motion", 4);
  outputs.depth = pass.depth_target(create_view_image(frame, "depth", kGeometryDepthFormat), gpu::LoadOp::clear);
  const auto read = [&](const char* binding, gpu::ImageHandle image) {
    pass.read(binding, imported(frame, image, desc, drawn_again));
  };
  read("depth_image", desc.depth);
  read("normal_image", desc.normals);
  read("face_normal_image", desc.face_normals);
  read("base_color_image", desc.base_color);
  read("material_image", desc.material);
  read("emissive_image", desc.emissive);
  pass.uniform("host", constants_of(frame, desc));
  bind_motion(pass, frame.view());
  pass.draw_triangle();
}

}  // namespace gloam

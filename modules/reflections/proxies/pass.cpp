// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/proxies/pass.h"

#include "modules/reflections/bindings.h"
#include "modules/reflections/culling/tiles.h"
#include "modules/reflections/surfaces/pass.h"
#include "shaders/reflections/shaders.h"

namespace gloam {

ComputeProgram proxy_program(const ReflectionKnobs& knobs) {
  return {shaders::reflections::blend_comp,
          {{"kScreenSpace", knobs.screen_space ? 1u : 0u},
           {"kProxies", knobs.proxies ? 1u : 0u},
           {"kLayers", knobs.layers},
           {"kSphereTest", knobs.sphere_test ? 1u : 0u},
           {"kNaive", knobs.naive ? 1u : 0u},
           {"kPixelRoughness", knobs.pixel_roughness ? 1u : 0u}}};
}

void add_proxy_pass(FrameBuilder& frame, ReflectionFrame& reflections) {
  ComputePass pass(frame, "reflection_proxies", proxy_program(reflections.knobs));
  pass.read("reflection", reflections.block);
  pass.read("tiles", reflections.tiles);
  pass.read("ssr_color", reflections.ssr_color);
  pass.read("ssr_distance", reflections.ssr_distance);
  bind_rows(pass, "proxy_rows", reflections.proxies);
  bind_rows(pass, "proxy_masks", frame.world().view_resource<ProxyTiles>(frame.view().id).masks);
  pass.read("proxy_images", reflections.proxy_images, Sampling::linear);
  read_changed_lights(pass, frame, reflections);
  const std::uint32_t scale = reflections.constants.scale;
  reflections.color =
      pass.write("color_image", create_view_image(frame, "reflection_color", gpu::Format::rgba16_float, scale));
  reflections.surface = pass.write("surface_image", reflections.surface);
  dispatch_mirror_tiles(pass, reflections);
}

}  // namespace gloam

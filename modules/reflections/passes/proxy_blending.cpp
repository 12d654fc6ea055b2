// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/passes/proxy_blending.h"

#include "modules/reflections/bindings.h"
#include "modules/reflections/culling/tiles.h"
#include "modules/reflections/passes/mirror_surfaces.h"
#include "shaders/reflections/shaders.h"

namespace gloam {

ComputeProgram proxy_program(const ReflectionKnobs& knobs) {
  return {shaders::reflections::proxy_blending_comp,
          {{0, knobs.screen_space ? 1u : 0u},
           {1, knobs.proxies ? 1u : 0u},
           {2, knobs.layers},
           {3, knobs.sphere_test ? 1u : 0u},
           {4, knobs.naive ? 1u : 0u},
           {5, knobs.pixel_roughness ? 1u : 0u}}};
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

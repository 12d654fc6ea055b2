// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/passes/proxy_blending.h"

#include "modules/lighting/outputs.h"
#include "modules/reflections/bindings.h"
#include "modules/reflections/passes/mirror_surfaces.h"
#include "shaders/reflections/shaders.h"

namespace gloam {

ComputeProgram proxy_program(const ReflectionKnobs& knobs, bool factors) {
  return {shaders::reflections::proxy_blending_comp,
          {{"kScreenSpace", knobs.screen_space ? 1u : 0u},
           {"kProxies", knobs.proxies ? 1u : 0u},
           {"kLayers", knobs.layers},
           {"kSphereTest", knobs.sphere_test ? 1u : 0u},
           {"kNaive", knobs.naive ? 1u : 0u},
           {"kPixelRoughness", knobs.pixel_roughness ? 1u : 0u},
           {"kFactors", factors ? 1u : 0u},
           {"kSort", knobs.sort ? 1u : 0u},
           {"kPixelNormals", knobs.pixel_normals ? 1u : 0u}}};
}

MirroredLight add_proxy_pass(FrameBuilder& frame, const ReflectionKnobs& knobs, const ReflectionUniforms& uniforms,
                             const MirrorSurfaces& surfaces, const ScreenSpaceHits& hits, const ProxyInputs& proxies) {
  ComputePass pass(frame, "reflection_proxies", proxy_program(knobs, !proxies.factors.empty()));
  pass.read("reflection", uniforms.block);
  pass.read("tiles", uniforms.tiles);
  read_geometry(pass, frame.get<GeometryOutputs>());
  pass.read("ssr_color", hits.color);
  pass.read("ssr_distance", hits.distance);
  bind_rows(pass, "proxy_rows", proxies.rows);
  bind_rows(pass, "proxy_masks", proxies.masks);
  bind_rows(pass, "capture_factors", proxies.factors);
  pass.read("proxy_images", proxies.images, Sampling::linear);
  const std::uint32_t scale = uniforms.constants.scale;
  MirroredLight light;
  light.color =
      pass.write("color_image", create_view_image(frame, "reflection_color", gpu::Format::rgba16_float, scale));
  light.surface = pass.write("surface_image", surfaces.surface);
  dispatch_mirror_tiles(pass, surfaces.tiles);
  return light;
}

}  // namespace gloam

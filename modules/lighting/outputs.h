// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/frame/frame_graph.h"
#include "engine/gpu/types.h"
#include "engine/math/types.h"
#include "engine/render/declare/shader_pass.h"
#include "engine/render/frame_builder.h"
#include "engine/render/knobs/knob_table.h"
#include "engine/render/reference/reference.h"
#include "modules/lights/outputs.h"
#include "modules/shadows/outputs.h"
#include "shaders/lighting/indirect_shared.h"
#include "shaders/lighting/probes_shared.h"

namespace gloam {

enum class Antialiasing : std::uint8_t { off, smaa, taa };
[[nodiscard]] constexpr std::string_view name_of(Antialiasing antialiasing) {
  switch (antialiasing) {
    case Antialiasing::off:
      return "off";
    case Antialiasing::smaa:
      return "smaa";
    case Antialiasing::taa:
      return "taa";
  }
  return {};
}

inline constexpr EnumKnob<Antialiasing> kAntialiasing{
    .name = "lighting.antialiasing",
    .meaning =
        "smoothing of slanted edges in the picture (smaa), or the mean over frames (taa); play and render set "
        "smaa",
    .is_look = true};

/// What of the last frame's light a frame keeps.
enum class LightReuseKind : std::uint8_t {
  off,
  exact,  ///< that of tiles of which nothing has changed
};
[[nodiscard]] constexpr std::string_view name_of(LightReuseKind reuse) {
  switch (reuse) {
    case LightReuseKind::off:
      return "off";
    case LightReuseKind::exact:
      return "exact";
  }
  return {};
}
inline constexpr EnumKnob<LightReuseKind> kLightReuse{
    .name = "lighting.reuse",
    .meaning =
        "light of the last frame that is kept: none, or that of tiles of which nothing has changed, neither pixels nor "
        "lights nor shadows (exact: the picture is the same to the bit); cost and bench set off, so that what they "
        "measure at rest is what a moving camera pays",
    .default_value = LightReuseKind::exact,
    .exact = LightReuseKind::off,
    .same_picture = true,
    .only_with = "shadows.mode=deferred"};

/// Another module adds the specular reflection of the surroundings (sky and ground) to opaque surfaces itself. It puts
/// this on the board in PassPhase::announce. LitOutput then lacks exactly occlusion · specular_ambient()
/// (shaders/lighting/environment_api.glsl) at each pixel with a surface, until that module adds its own term. The sky
/// and blended surfaces are not affected.
struct SpecularAmbientTaken {};

/// Captured surroundings of the view, which reflective blended surfaces mirror in place of sky and ground, and opaque
/// ones in SurroundingsOutput. The module that has them puts this on the board in PassPhase::announce.
struct SurroundingProbes {
  std::vector<shaders::ProbeRow> rows;  ///< probes with a box from the smallest to the largest, then the global one
  std::vector<vec4> factors;            ///< of captured light (changed_light_api.glsl); ProbeRow::factor
  ImageRef images;                      ///< octahedral maps, one layer each (probes_api.glsl); null without rows
  float scale = 1.0f;                   ///< from the light of the images to that of the view
  bool surroundings_follow = false;     ///< SurroundingsOutput will follow
};

/// Diffuse light of the surroundings of the view, in place of that of sky and ground alone. The module that has it puts
/// this on the board in PassPhase::announce.
struct IndirectLight {
  /// Probes with a box from the smallest to the largest, then the global one; terms times RenderView::light_scale.
  /// ProbeRow::layer, emission and factor are not used.
  std::vector<shaders::DiffuseProbe> probes;
  /// For references: takes the place of the probes on opaque surfaces. The mean radiance, weighted by the cosine, of
  /// the hemisphere around each pixel's normal, cd/m², of the view's size; null: none.
  ImageRef traced;
};

/// World resource: surfaces get no light of sky and ground, which are drawn as ever. For captures of the light that a
/// surface gets from others.
struct SurroundingsLeftOut {};

/// The constant kProbes of shaders that include surroundings_api.glsl, for this number of rows.
[[nodiscard]] std::uint32_t probe_constant(std::size_t rows);
/// kProbes and kFactors. factors: whether a row may have factors; shaders without them are faster.
[[nodiscard]] gpu::SpecConstants probe_constants(std::size_t rows, bool factors);
[[nodiscard]] inline gpu::SpecConstants probe_constants(const SurroundingProbes& probes) {
  return probe_constants(probes.rows.size(), !probes.factors.empty());
}

/// The surroundings that surfaces mirror, from the module with SurroundingProbes, which puts this on the board in
/// PassPhase::lists: radiance toward the eye before the surface's share, rgba16f, one texel for each block of 2×2
/// pixels, or each pixel. Deferred lighting uses it for surfaces that reflect weakly (reflects_strongly() in
/// shaders/lighting/mirror_share_api.glsl). To others it adds no specular ambient light: after it, the module does.
struct SurroundingsOutput {
  ImageRef light;
};

/// The view's visualizer shows the picture itself, with other light in it: it is antialiased as the picture is. The
/// visualizer's module puts this on the board in PassPhase::announce.
struct VisualizerIsPicture {};

/// Another module needs DiffuseLightOutput. It puts this on the board in PassPhase::announce.
struct DiffuseLightWanted {};

/// Diffuse light intensity of the view: the illuminance, in lux · RenderView::light_scale, of the opaque surface at
/// each pixel. It is the sum of every light's illuminance times the cosine of incidence and its visibility, or for
/// light from behind light_through() times the transmittance (shaders/lighting/brdf_api.glsl), plus π · occlusion ·
/// hemisphere_radiance() of the surroundings. Base colour and emission do not enter, so a diffuse surface
/// reflects base colour / π of it. rgba16f of the view's size, at most 65504; sky pixels are 0; alpha is 1.
/// (r11f_g11f_b10f would take half of the memory, but its steps of up to 3 % show in ratios of two lights.)
///
/// On the board from PassPhase::shading on, only in views with DiffuseLightWanted.
struct DiffuseLightOutput {
  ImageRef light;
};
/// Decodes one texel: the two words of four half floats.
[[nodiscard]] vec3 decode_diffuse_light(uvec2 texel);

/// Another module needs FrontDepth. It puts this on the board in PassPhase::announce.
struct FrontDepthWanted {};

/// Depth of what is seen at each pixel, for effects that act on the finished light by its distance, such as fog and a
/// lens: that of the opaque surface, and over it those of the blended surfaces before it, each weighted by its opacity
/// as its light is. Device depth is linear in the reciprocal of the distance, and so is a lens's circle of confusion.
/// r32f of the view's size.
///
/// On the board from PassPhase::translucent on, in views with FrontDepthWanted that show blended surfaces.
struct FrontDepth {
  ImageRef depth;
};
/// FrontDepth, or the depth of opaque surfaces where there is none.
[[nodiscard]] ImageRef front_depth(FrameBuilder& frame);

/// Another module needs BlendedLayer. It puts this on the board in PassPhase::announce.
struct BlendedLayerWanted {};

/// The view's blended surfaces alone, before they are drawn over LitOutput, for reflections of them. On the board from
/// PassPhase::shading on, in views with BlendedLayerWanted that show blended surfaces, once their pipelines are ready.
struct BlendedLayer {
  ImageRef light;  ///< rgba16f: premultiplied radiance of those before the opaque surface, and their opacity
  ImageRef depth;  ///< r32f: sum of their depths, each weighted by its share of the opacity
};

/// Homogeneous fog of the view. The module that draws it puts it on the board in PassPhase::announce, for modules that
/// add light which has passed through it on other ways than straight to the camera, and keeps it as a world resource
/// for references.
struct HomogeneousFog {
  float density = 0.0f;         ///< 1/m
  vec3 radiance = vec3(0.0f);   ///< in-scattered, cd/m²
  float sky_distance_m = 0.0f;  ///< path length through the fog of light from beyond all surfaces
};

/// Light of the view that the camera's lens has spread over the picture. Pictures show (1 - share) · LitOutput + share
/// · the spread light: tone mapping adds it, so that it needs no pass over the picture. The module that spreads the
/// light puts this on the board in PassPhase::post. LitOutput and Renderer::read_linear stay without it: they are the
/// light that comes to the lens, which references trace. Metering does not see it either: it would light every black
/// pixel around a lamp, and black pixels do not count.
struct ScatteredLight {
  ImageRef light;              ///< rgba16f, any size, read with Sampling::linear; scaled like LitOutput, at most 65504
  vec2 uv_scale = vec2(0.0f);  ///< from positions in the picture, pixels, to those in `light`, 0…1
  vec2 uv_offset = vec2(0.0f);
  float share = 0.0f;  ///< 0…1
};

/// World resource: Renderer::read_linear gives the light as it is shown, with ScatteredLight.
struct ShownLight {};

/// The kind of shadows in a frame. It selects the variant of a shader that includes
/// shaders/lighting/forward_lights_api.glsl.
enum class ForwardShadows : std::uint8_t {
  none,
  cookies,   ///< GLOAM_FORWARD_COOKIES: no light of the view has a shadow
  standard,  ///< GLOAM_FORWARD_SHADOWS and GLOAM_SHADOWS_STANDARD; a shader for `all` works as well
  all,       ///< GLOAM_FORWARD_SHADOWS
};

/// The variant of that shader that a frame calls for. Variants without GLOAM_FORWARD_TILED draw the same picture, and
/// variants with fewer shadows work as well: both may be used while a pipeline is being compiled.
struct ForwardLighting {
  bool tiled = false;  ///< GLOAM_FORWARD_TILED may be used
  ForwardShadows shadows = ForwardShadows::none;
  gpu::SpecConstants constants = {};  ///< those that the shader has apply
};

/// The version that these inputs call for; either may be null.
[[nodiscard]] ForwardLighting forward_lighting(const LightsOutputs* lights, const ShadowsOutputs* shadows);

/// The functions below may be called after the lights module's PassPhase::lists.
[[nodiscard]] ForwardLighting forward_lighting(const FrameBuilder& frame);
/// Binds the inputs of environment_api.glsl, surroundings_api.glsl and forward_lights_api.glsl that the program in use
/// declares: environment, surroundings, probe_rows, probe_images, lights, light_texels, grid, mask_tiles and
/// z_bin_words; with shadows or cookies also those of read_shadows(). The program must be a version for this frame, see
/// ForwardLighting.
void read_lighting(ShaderPass& pass, FrameBuilder& frame);
/// kIndirect of indirect_api.glsl for this frame; nothing without IndirectLight.
[[nodiscard]] gpu::SpecConstants indirect_constants(const FrameBuilder& frame);
/// Binds the inputs of environment_api.glsl, indirect_api.glsl and surroundings_api.glsl that the program in use
/// declares.
void read_surroundings(ShaderPass& pass, FrameBuilder& frame);

/// The reference of a knob: the mean, in linear light, of pictures whose pixels are sampled at different points.
[[nodiscard]] ReferenceInfo supersampled_reference(std::string knob);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/scene/material_packing.h"

#include <cmath>

#include "shaders/render/shaders.h"

namespace gloam {
namespace {

gpu::AddressMode address_mode(WrapMode wrap) {
  switch (wrap) {
    case WrapMode::mirrored_repeat:
      return gpu::AddressMode::mirrored_repeat;
    case WrapMode::clamp_to_edge:
      return gpu::AddressMode::clamp_to_edge;
    case WrapMode::repeat:
      break;
  }
  return gpu::AddressMode::repeat;
}

}  // namespace

static_assert(sizeof(shaders::MaterialConstants) <= kMaterialStride);

shaders::MaterialConstants pack_material(const Material& material) {
  shaders::MaterialConstants packed{};
  packed.base_color = material.base_color;
  packed.emissive_cutoff = vec4(material.emissive, material.alpha_cutoff);
  packed.factors = vec4(material.metallic, material.roughness, material.normal_scale, material.occlusion_strength);
  packed.extras =
      vec4(material.subsurface ? 1.0f : 0.0f, material.reflectivity, std::sqrt(extinction_length(material)), 0.0f);
  const TextureSlot* slots[] = {&material.base_color_texture, &material.normal_texture,
                                &material.metallic_roughness_texture, &material.occlusion_texture,
                                &material.emissive_texture};
  for (std::size_t s = 0; s < 5; ++s) {
    packed.uv_transform[2 * s] = vec4(slots[s]->transform_row0, static_cast<float>(slots[s]->uv_set));
    packed.uv_transform[2 * s + 1] = vec4(slots[s]->transform_row1, 0.0f);
  }
  return packed;
}

std::uint32_t surface_features(const Material& material) {
  std::uint32_t features = 0;
  for (const TextureSlot* slot :
       {&material.base_color_texture, &material.normal_texture, &material.metallic_roughness_texture,
        &material.occlusion_texture, &material.emissive_texture}) {
    const TextureSlot plain;
    const bool moved = slot->uv_set != 0 || slot->transform_row0 != plain.transform_row0 ||
                       slot->transform_row1 != plain.transform_row1;
    if (slot->texture != kNone && moved) features |= GLOAM_SURFACE_UV_TRANSFORM;
  }
  if (material.base_color_texture.texture != kNone) features |= GLOAM_SURFACE_BASE_TEXTURE;
  if (material.normal_texture.texture != kNone) features |= GLOAM_SURFACE_NORMAL_TEXTURE;
  if (material.metallic_roughness_texture.texture != kNone) features |= GLOAM_SURFACE_METALLIC_ROUGHNESS_TEXTURE;
  if (material.occlusion_texture.texture != kNone) features |= GLOAM_SURFACE_OCCLUSION_TEXTURE;
  if (material.emissive_texture.texture != kNone) features |= GLOAM_SURFACE_EMISSIVE_TEXTURE;
  if (material.alpha_mode == AlphaMode::mask) features |= GLOAM_SURFACE_MASK;
  if (material.double_sided) features |= GLOAM_SURFACE_DOUBLE_SIDED;
  return features;
}

gpu::SamplerDesc sampler_desc(const Texture& texture) {
  gpu::SamplerDesc desc;
  if (texture.nearest) desc.min_filter = desc.mag_filter = gpu::Filter::nearest;
  desc.address_u = address_mode(texture.wrap_u);
  desc.address_v = address_mode(texture.wrap_v);
  return desc;
}

const SurfacePass& geometry_surface_pass(bool motion) {
  const auto make = [](bool with_motion) {
    SurfacePass p;
    p.module = "engine";
    p.fragment = with_motion ? shaders::render::geometry_motion_frag : shaders::render::geometry_frag;
    p.color_formats = {gpu::Format::rgba8_unorm, gpu::Format::rg32_uint, gpu::Format::rgba8_unorm,
                       gpu::Format::rgba16_float};
    if (with_motion) p.color_formats.push_back(gpu::Format::rg32_float);
    p.motion = with_motion;
    return p;
  };
  static const SurfacePass passes[] = {make(false), make(true)};
  return passes[motion ? 1 : 0];
}

}  // namespace gloam

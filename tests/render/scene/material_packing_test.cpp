// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/scene/material_packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gloam {
namespace {

TEST(PackMaterial, places_every_factor) {
  Material material;
  material.base_color = vec4(0.1f, 0.2f, 0.3f, 0.4f);
  material.emissive = vec3(5.0f, 6.0f, 7.0f);
  material.alpha_cutoff = 0.25f;
  material.metallic = 0.5f;
  material.roughness = 0.6f;
  material.normal_scale = 0.7f;
  material.occlusion_strength = 0.8f;
  material.subsurface = true;
  material.reflectivity = 0.9f;
  const shaders::MaterialConstants packed = pack_material(material);
  EXPECT_EQ(packed.base_color, material.base_color);
  EXPECT_EQ(packed.emissive_cutoff, vec4(5.0f, 6.0f, 7.0f, 0.25f));
  EXPECT_EQ(packed.factors, vec4(0.5f, 0.6f, 0.7f, 0.8f));
  EXPECT_EQ(packed.extras, vec4(1.0f, 0.9f, std::sqrt(0.005f), 0.0f)) << "5 mm by default";
}

TEST(PackMaterial, extinction_lengths_are_packed_as_square_roots_and_only_with_subsurface) {
  Material material;
  material.extinction_m = 0.25f;
  EXPECT_EQ(pack_material(material).extras.z, 0.0f);
  material.subsurface = true;
  EXPECT_EQ(pack_material(material).extras.z, 0.5f);
  material.extinction_m = 0.0f;
  EXPECT_EQ(pack_material(material).extras.z, 0.0f);
}

TEST(PackMaterial, the_default_has_no_subsurface_and_derives_reflectivity) {
  const shaders::MaterialConstants packed = pack_material(Material{});
  EXPECT_EQ(packed.extras.x, 0.0f);
  EXPECT_LT(packed.extras.y, 0.0f);
  EXPECT_EQ(packed.base_color, vec4(1.0f));
}

TEST(PackMaterial, texture_coordinates_go_base_normal_metallic_occlusion_emissive) {
  Material material;
  TextureSlot* slots[] = {&material.base_color_texture, &material.normal_texture, &material.metallic_roughness_texture,
                          &material.occlusion_texture, &material.emissive_texture};
  for (std::uint32_t i = 0; i < 5; ++i) {
    const auto n = static_cast<float>(10 * (i + 1));
    slots[i]->uv_set = i % 2;
    slots[i]->transform_row0 = vec3(n + 1, n + 2, n + 3);
    slots[i]->transform_row1 = vec3(n + 4, n + 5, n + 6);
  }
  const shaders::MaterialConstants packed = pack_material(material);
  for (std::uint32_t i = 0; i < 5; ++i) {
    const auto n = static_cast<float>(10 * (i + 1));
    EXPECT_EQ(packed.uv_transform[2 * i], vec4(n + 1, n + 2, n + 3, static_cast<float>(i % 2))) << i;
    EXPECT_EQ(vec3(packed.uv_transform[2 * i + 1]), vec3(n + 4, n + 5, n + 6)) << i;
  }
}

TEST(SurfaceFeatures, each_comes_from_its_own_cause) {
  EXPECT_EQ(surface_features(Material{}), 0u);
  const auto with = [](auto change) {
    Material material;
    change(material);
    return surface_features(material);
  };
  EXPECT_EQ(with([](Material& m) { m.base_color_texture.texture = 0; }), GLOAM_SURFACE_BASE_TEXTURE);
  EXPECT_EQ(with([](Material& m) { m.normal_texture.texture = 0; }), GLOAM_SURFACE_NORMAL_TEXTURE);
  EXPECT_EQ(with([](Material& m) { m.metallic_roughness_texture.texture = 0; }),
            GLOAM_SURFACE_METALLIC_ROUGHNESS_TEXTURE);
  EXPECT_EQ(with([](Material& m) { m.occlusion_texture.texture = 0; }), GLOAM_SURFACE_OCCLUSION_TEXTURE);
  EXPECT_EQ(with([](Material& m) { m.emissive_texture.texture = 0; }), GLOAM_SURFACE_EMISSIVE_TEXTURE);
  EXPECT_EQ(with([](Material& m) { m.alpha_mode = AlphaMode::mask; }), GLOAM_SURFACE_MASK);
  EXPECT_EQ(with([](Material& m) { m.alpha_mode = AlphaMode::blend; }), 0u);
  EXPECT_EQ(with([](Material& m) { m.double_sided = true; }), GLOAM_SURFACE_DOUBLE_SIDED);
}

TEST(SamplerOfATexture, follows_filter_and_wrapping) {
  Texture texture;
  EXPECT_EQ(sampler_desc(texture), gpu::SamplerDesc{});
  texture.nearest = true;
  texture.wrap_u = WrapMode::mirrored_repeat;
  texture.wrap_v = WrapMode::clamp_to_edge;
  const gpu::SamplerDesc desc = sampler_desc(texture);
  EXPECT_EQ(desc.min_filter, gpu::Filter::nearest);
  EXPECT_EQ(desc.mag_filter, gpu::Filter::nearest);
  EXPECT_EQ(desc.address_u, gpu::AddressMode::mirrored_repeat);
  EXPECT_EQ(desc.address_v, gpu::AddressMode::clamp_to_edge);
}

TEST(GeometrySurfacePass, writes_the_formats_the_decoder_reads) {
  const SurfacePass& pass = geometry_surface_pass();
  ASSERT_EQ(pass.color_formats.size(), 4u);
  EXPECT_EQ(pass.color_formats[0], gpu::Format::rgba8_unorm);
  EXPECT_EQ(pass.color_formats[1], gpu::Format::rg32_uint);
  EXPECT_EQ(pass.color_formats[2], gpu::Format::rgba8_unorm);
  EXPECT_EQ(pass.color_formats[3], gpu::Format::rgba16_float);
  EXPECT_TRUE(pass.depth_write);
  EXPECT_EQ(pass.blend, gpu::BlendMode::opaque);
}

TEST(GeometrySurfacePass, with_motion_has_one_more_target) {
  const SurfacePass& pass = geometry_surface_pass(true);
  const std::vector<gpu::Format>& plain = geometry_surface_pass().color_formats;
  ASSERT_EQ(pass.color_formats.size(), plain.size() + 1);
  EXPECT_TRUE(std::equal(plain.begin(), plain.end(), pass.color_formats.begin()));
  EXPECT_EQ(pass.color_formats.back(), gpu::Format::rg32_float);
}

}  // namespace
}  // namespace gloam

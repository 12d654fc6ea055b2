// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "engine/gpu/spirv_reflection.h"
#include "engine/render/packing/mesh_packing.h"
#include "engine/render/scene/material_packing.h"
#include "shaders/fog/fog_shared.h"
#include "shaders/fog/shaders.h"
#include "shaders/lighting/lighting_shared.h"
#include "shaders/lighting/shaders.h"
#include "shaders/lights/lights_shared.h"
#include "shaders/lights/shaders.h"
#include "shaders/render/caster_shared.h"
#include "shaders/render/deform_shared.h"
#include "shaders/render/draw_shared.h"
#include "shaders/render/motion_shared.h"
#include "shaders/render/shaders.h"
#include "shaders/render/view_shared.h"
#include "shaders/shadows/shaders.h"

// C++ and shaders share one declaration of each structure. These tests compare the offsets of both compilers.

namespace gloam {
namespace {

struct Member {
  const char* name;
  std::size_t offset;
  std::size_t size;
};
#define GLOAM_MEMBER(type, member) \
  Member { #member, offsetof(type, member), sizeof(type::member) }

void expect_same_layout(const gpu::ShaderCode& shader, const char* name, std::size_t size,
                        const std::vector<Member>& members) {
  SCOPED_TRACE(std::string(name) + " in " + std::string(shader.name));
  const auto reflection = gpu::reflect_spirv(shader);
  ASSERT_TRUE(reflection.ok()) << reflection.error().message;
  const gpu::ReflectedStruct* in_shader = reflection->find_struct(name);
  ASSERT_NE(in_shader, nullptr) << "the shader has no such structure";
  ASSERT_EQ(in_shader->members.size(), members.size());
  for (std::size_t i = 0; i < members.size(); ++i) {
    EXPECT_EQ(in_shader->members[i].name, members[i].name) << "member " << i;
    EXPECT_EQ(in_shader->members[i].offset, members[i].offset) << members[i].name;
    EXPECT_EQ(in_shader->members[i].size, members[i].size) << members[i].name;
  }
  EXPECT_EQ(in_shader->size, size);
}

std::uint32_t stride_of(const gpu::ShaderCode& shader, const char* name, const char* member) {
  const auto reflection = gpu::reflect_spirv(shader);
  if (!reflection.ok() || reflection->find_struct(name) == nullptr) return 0;
  for (const gpu::ReflectedMember& m : reflection->find_struct(name)->members)
    if (m.name == member) return m.array_stride;
  return 0;
}

TEST(SharedStructs, view_constants) {
  using T = shaders::ViewConstants;
  for (const gpu::ShaderCode& shader :
       {shaders::render::surface_vert, shaders::render::geometry_frag, shaders::render::debug_view_frag,
        shaders::lights::find_lights_approx_comp, shaders::lighting::deferred_frag}) {
    expect_same_layout(
        shader, "ViewConstants", sizeof(T),
        {GLOAM_MEMBER(T, clip_from_relative), GLOAM_MEMBER(T, ray_base), GLOAM_MEMBER(T, ray_dx),
         GLOAM_MEMBER(T, ray_dy), GLOAM_MEMBER(T, ray_forward), GLOAM_MEMBER(T, view_row_z), GLOAM_MEMBER(T, size),
         GLOAM_MEMBER(T, inverse_size), GLOAM_MEMBER(T, near_m), GLOAM_MEMBER(T, orthographic), GLOAM_MEMBER(T, frame),
         GLOAM_MEMBER(T, visualizer), GLOAM_MEMBER(T, clip_plane)});
  }
}

TEST(SharedStructs, draw_constants) {
  using T = shaders::DrawConstants;
  expect_same_layout(shaders::render::surface_vert, "DrawConstants", sizeof(T),
                     {GLOAM_MEMBER(T, row0), GLOAM_MEMBER(T, row1), GLOAM_MEMBER(T, row2), GLOAM_MEMBER(T, flags)});
  EXPECT_LE(sizeof(T), 128u) << "push constants of 128 bytes are what every device has";
}

TEST(SharedStructs, motion_draw_constants) {
  using T = shaders::MotionDrawConstants;
  expect_same_layout(shaders::render::surface_motion_vert, "MotionDrawConstants", sizeof(T),
                     {GLOAM_MEMBER(T, draw), GLOAM_MEMBER(T, previous_row0), GLOAM_MEMBER(T, previous_row1),
                      GLOAM_MEMBER(T, previous_row2)});
  EXPECT_LE(sizeof(T), 128u) << "push constants of 128 bytes are what every device has";
}

TEST(SharedStructs, motion_constants) {
  using T = shaders::MotionConstants;
  for (const gpu::ShaderCode& shader :
       {shaders::render::surface_motion_vert, shaders::render::geometry_motion_frag, shaders::render::sky_motion_frag})
    expect_same_layout(shader, "MotionConstants", sizeof(T),
                       {GLOAM_MEMBER(T, previous_clip_from_relative), GLOAM_MEMBER(T, moved),
                        GLOAM_MEMBER(T, half_size), GLOAM_MEMBER(T, orthographic)});
}

TEST(SharedStructs, material_constants) {
  using T = shaders::MaterialConstants;
  for (const gpu::ShaderCode& shader : {shaders::render::geometry_frag, shaders::lighting::forward_frag}) {
    expect_same_layout(shader, "MaterialConstants", sizeof(T),
                       {GLOAM_MEMBER(T, base_color), GLOAM_MEMBER(T, emissive_cutoff), GLOAM_MEMBER(T, factors),
                        GLOAM_MEMBER(T, extras), GLOAM_MEMBER(T, uv_transform)});
    EXPECT_EQ(stride_of(shader, "MaterialConstants", "uv_transform"), sizeof(vec4));
  }
  EXPECT_LE(sizeof(T), kMaterialStride);
}

TEST(SharedStructs, deform_constants) {
  using T = shaders::DeformConstants;
  expect_same_layout(
      shaders::render::deform_comp, "DeformConstants", sizeof(T),
      {GLOAM_MEMBER(T, vertex_count), GLOAM_MEMBER(T, first_joint), GLOAM_MEMBER(T, skinned),
       GLOAM_MEMBER(T, morph_targets), GLOAM_MEMBER(T, first_weight), GLOAM_MEMBER(T, morph_has_normals)});
}

TEST(SharedStructs, caster_constants) {
  using T = shaders::CasterConstants;
  expect_same_layout(shaders::shadows::map_vert, "CasterConstants", sizeof(T),
                     {GLOAM_MEMBER(T, clip_from_local), GLOAM_MEMBER(T, orthographic)});
}

TEST(SharedStructs, packed_vertices_are_what_the_kernel_and_the_streams_read) {
  EXPECT_EQ(sizeof(PackedFrame), 8u);     // rg32_uint, uvec2
  EXPECT_EQ(sizeof(PackedSurface), 20u);  // rgba32_float and rgba8_unorm
  EXPECT_EQ(offsetof(PackedSurface, color), 16u);
  EXPECT_EQ(sizeof(PackedInfluence), 16u);  // uvec4
  EXPECT_EQ(sizeof(vec3), 12u);
}

TEST(SharedStructs, lights) {
  using L = shaders::LocalLight;
  using D = shaders::DirectionalLight;
  using B = shaders::LightBlock;
  for (const gpu::ShaderCode& shader :
       {shaders::lights::find_lights_approx_comp, shaders::lighting::deferred_frag, shaders::lighting::forward_frag}) {
    expect_same_layout(shader, "LocalLight", sizeof(L),
                       {GLOAM_MEMBER(L, position), GLOAM_MEMBER(L, inverse_range_squared), GLOAM_MEMBER(L, color),
                        GLOAM_MEMBER(L, spot_scale), GLOAM_MEMBER(L, direction), GLOAM_MEMBER(L, spot_offset)});
    expect_same_layout(shader, "DirectionalLight", sizeof(D),
                       {GLOAM_MEMBER(D, color), GLOAM_MEMBER(D, apparent_angle), GLOAM_MEMBER(D, direction),
                        GLOAM_MEMBER(D, reserved)});
    expect_same_layout(shader, "LightBlock", sizeof(B),
                       {GLOAM_MEMBER(B, local_count), GLOAM_MEMBER(B, directional_count), GLOAM_MEMBER(B, reserved0),
                        GLOAM_MEMBER(B, reserved1), GLOAM_MEMBER(B, directional), GLOAM_MEMBER(B, local)});
    EXPECT_EQ(stride_of(shader, "LightBlock", "local"), sizeof(L));
    EXPECT_EQ(stride_of(shader, "LightBlock", "directional"), sizeof(D));
  }
  EXPECT_LE(sizeof(B), 65536u) << "the block is a uniform buffer; 64 KiB is what the devices we know bind";
}

TEST(SharedStructs, lighting) {
  using E = shaders::EnvironmentConstants;
  using T = shaders::ToneMapConstants;
  using M = shaders::MeterConstants;
  for (const gpu::ShaderCode& shader : {shaders::lighting::deferred_frag, shaders::lighting::forward_frag})
    expect_same_layout(shader, "EnvironmentConstants", sizeof(E),
                       {GLOAM_MEMBER(E, zenith), GLOAM_MEMBER(E, horizon), GLOAM_MEMBER(E, ground)});
  expect_same_layout(
      shaders::lighting::tone_map_frag, "ToneMapConstants", sizeof(T),
      {GLOAM_MEMBER(T, curve), GLOAM_MEMBER(T, metered), GLOAM_MEMBER(T, exposure), GLOAM_MEMBER(T, encode_srgb)});
  using G = shaders::EdgeConstants;
  using A = shaders::AntialiasingConstants;
  expect_same_layout(shaders::lighting::edges_comp, "EdgeConstants", sizeof(G),
                     {GLOAM_MEMBER(G, along), GLOAM_MEMBER(G, across), GLOAM_MEMBER(G, pixels), GLOAM_MEMBER(G, lines),
                      GLOAM_MEMBER(G, words), GLOAM_MEMBER(G, first)});
  for (const gpu::ShaderCode& shader : {shaders::lighting::weights_comp, shaders::lighting::blend_frag})
    expect_same_layout(shader, "AntialiasingConstants", sizeof(A),
                       {GLOAM_MEMBER(A, size), GLOAM_MEMBER(A, encode_srgb)});
  expect_same_layout(shaders::lighting::meter_comp, "MeterConstants", sizeof(M), {GLOAM_MEMBER(M, size)});
}

TEST(SharedStructs, fog) {
  using F = shaders::FogConstants;
  using B = shaders::FogBlurConstants;
  expect_same_layout(
      shaders::fog::apply_frag, "FogConstants", sizeof(F),
      {GLOAM_MEMBER(F, radiance), GLOAM_MEMBER(F, density), GLOAM_MEMBER(F, forward), GLOAM_MEMBER(F, sky_distance_m)});
  expect_same_layout(shaders::fog::blur_frag, "FogBlurConstants", sizeof(B),
                     {GLOAM_MEMBER(B, direction), GLOAM_MEMBER(B, taps), GLOAM_MEMBER(B, inverse_sigma)});
}

}  // namespace
}  // namespace gloam

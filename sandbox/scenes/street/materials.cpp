// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <utility>

#include "engine/scene/assets.h"
#include "sandbox/scenes/street/images.h"
#include "sandbox/scenes/street/parts.h"

namespace gloam {
namespace {

std::uint32_t add_street_texture(World& world, Image image) {
  auto& assets = world.resource<SceneAssets>();
  Texture texture;
  texture.name = image.name;
  texture.image = static_cast<std::uint32_t>(assets.images.size());
  texture.srgb = true;
  texture.wrap_u = texture.wrap_v = WrapMode::clamp_to_edge;
  assets.images.push_back(std::move(image));
  assets.textures.push_back(std::move(texture));
  return static_cast<std::uint32_t>(assets.textures.size() - 1);
}

/// Glass before a lit picture. luminance: cd/m² of white.
std::uint32_t add_lit_pane(SceneBuilder& builder, const std::string& name, std::uint32_t texture, vec3 luminance,
                           float roughness) {
  Material pane{.name = name,
                .base_color = vec4(0.02f, 0.02f, 0.02f, 1.0f),
                .emissive = luminance,
                .metallic = 0.0f,
                .roughness = roughness};
  pane.emissive_texture.texture = texture;
  return builder.add_material(pane);
}

void add_lit_panes(World& world, SceneBuilder& builder, StreetMaterials& m) {
  const std::uint32_t curtains = add_street_texture(world, curtains_image());
  const std::uint32_t shelves = add_street_texture(world, shelves_image());
  const std::uint32_t guests = add_street_texture(world, guests_image());
  m.windows = {add_lit_pane(builder, "window amber", curtains, vec3(1.30f, 0.72f, 0.30f), 0.1f),
               add_lit_pane(builder, "window warm", curtains, vec3(1.15f, 0.88f, 0.52f), 0.1f),
               add_lit_pane(builder, "window cool", curtains, vec3(0.34f, 0.50f, 0.80f), 0.1f)};
  m.shop_colors = {vec3(1.0f, 0.68f, 0.32f), vec3(0.36f, 0.80f, 0.82f), vec3(1.0f, 0.42f, 0.24f),
                   vec3(0.95f, 0.82f, 0.58f), vec3(0.82f, 0.36f, 0.66f)};
  for (std::size_t i = 0; i < m.shops.size(); ++i)
    m.shops[i] = add_lit_pane(builder, "shop window " + std::to_string(i), i % 2 == 0 ? guests : shelves,
                              m.shop_colors[i] * 1.9f, 0.1f);
  constexpr std::array<const char*, 8> kWords = {"BAR", "RADIO", "HOTEL", "BAKERY", "BOOKS", "TEA", "CINEMA", "WINE"};
  constexpr std::array<vec3, 8> kColors = {vec3(1.0f, 0.25f, 0.14f), vec3(0.25f, 0.8f, 0.95f), vec3(1.0f, 0.34f, 0.5f),
                                           vec3(1.0f, 0.72f, 0.3f),  vec3(0.5f, 0.95f, 0.55f), vec3(1.0f, 0.6f, 0.2f),
                                           vec3(0.6f, 0.5f, 1.0f),   vec3(1.0f, 0.3f, 0.3f)};
  for (std::size_t i = 0; i < m.signs.size(); ++i)
    m.signs[i] = add_lit_pane(builder, std::string("sign ") + kWords[i],
                              add_street_texture(world, sign_image(kWords[i])), kColors[i] * 3.0f, 1.0f);
}

}  // namespace

StreetMaterials add_street_materials(World& world, SceneBuilder& builder) {
  // Roughness 1 means that a surface has no mirror reflection.
  const auto material = [&](const char* name, vec3 color, float roughness, float metallic = 0.0f) {
    return builder.add_plain(name, color, roughness, metallic);
  };
  StreetMaterials m{};
  m.asphalt = material("asphalt", vec3(0.075f, 0.077f, 0.082f), 0.55f);
  m.pavement = material("pavement", vec3(0.16f, 0.15f, 0.145f), 0.65f);
  m.kerb = material("kerb", vec3(0.26f, 0.25f, 0.24f), 0.7f);
  m.tiles = material("terrace tiles", vec3(0.17f, 0.11f, 0.09f), 0.5f);
  m.roof = material("roof", vec3(0.06f, 0.06f, 0.07f), 1.0f);
  m.walls = {material("brick", vec3(0.30f, 0.15f, 0.11f), 1.0f), material("plaster", vec3(0.42f, 0.38f, 0.32f), 1.0f),
             material("slate", vec3(0.20f, 0.23f, 0.27f), 1.0f), material("ochre", vec3(0.44f, 0.31f, 0.17f), 1.0f)};
  m.trim = material("trim", vec3(0.46f, 0.43f, 0.38f), 1.0f);
  m.wood = material("wood", vec3(0.11f, 0.075f, 0.05f), 1.0f);
  m.iron = material("iron", vec3(0.10f, 0.10f, 0.11f), 0.4f, 1.0f);
  m.paint = material("van paint", vec3(0.32f, 0.40f, 0.42f), 0.45f);
  m.brass = material("brass", vec3(0.75f, 0.55f, 0.28f), 0.3f, 1.0f);
  m.rubber = material("rubber", vec3(0.03f), 1.0f);
  m.cloth = material("coat", vec3(0.40f, 0.07f, 0.06f), 1.0f);
  m.skin = material("skin", vec3(0.6f, 0.42f, 0.33f), 1.0f);
  m.dark_glass = material("dark glass", vec3(0.015f, 0.018f, 0.024f), 0.1f);
  add_lit_panes(world, builder, m);
  return m;
}

}  // namespace gloam

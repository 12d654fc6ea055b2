// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/parsing/material_read.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace gloam::gltf {
namespace {

// The two surfaces of a pane of glass with a refractive index of 1.5 reflect 8 % of the light that falls straight on
// it.
constexpr double kThroughGlass = 0.92;

std::uint32_t texture_index(int value) { return value < 0 ? kNone : static_cast<std::uint32_t>(value); }

/// Number i of a list in an extension. The scan has checked the size of the list.
double number_at(const tinygltf::Value& list, int i) { return list.Get(i).GetNumberAsDouble(); }

TextureSlot translate_slot(int index, int uv_set, const tinygltf::ExtensionMap& extensions) {
  TextureSlot slot;
  slot.texture = texture_index(index);
  slot.uv_set = texture_index(uv_set);
  const auto found = extensions.find("KHR_texture_transform");
  if (found == extensions.end()) return slot;
  const tinygltf::Value& transform = found->second;
  double offset[2] = {0.0, 0.0};
  double scale[2] = {1.0, 1.0};
  double rotation = 0.0;
  for (int i = 0; i < 2; ++i) {
    if (transform.Has("offset")) offset[i] = number_at(transform.Get("offset"), i);
    if (transform.Has("scale")) scale[i] = number_at(transform.Get("scale"), i);
  }
  if (transform.Has("rotation")) rotation = transform.Get("rotation").GetNumberAsDouble();
  if (transform.Has("texCoord")) slot.uv_set = texture_index(transform.Get("texCoord").GetNumberAsInt());
  // KHR_texture_transform: translation · rotation · scale, rotation counter-clockwise with v pointing down.
  const double c = std::cos(rotation);
  const double s = std::sin(rotation);
  slot.transform_row0 = vec3(c * scale[0], s * scale[1], offset[0]);
  slot.transform_row1 = vec3(-s * scale[0], c * scale[1], offset[1]);
  return slot;
}

template <class Info>
TextureSlot translate_slot(const Info& info) {
  return translate_slot(info.index, info.texCoord, info.extensions);
}

float unit_number(double value) { return static_cast<float>(std::clamp(value, 0.0, 1.0)); }

const tinygltf::Value* extension(const tinygltf::Material& source, const char* name) {
  const auto found = source.extensions.find(name);
  return found == source.extensions.end() ? nullptr : &found->second;
}

/// The number in an extension, ≥ 0; `otherwise` if it is absent.
double positive_number(const tinygltf::Material& source, const char* name, const char* member, double otherwise) {
  const tinygltf::Value* found = extension(source, name);
  if (found == nullptr || !found->Has(member)) return otherwise;
  return std::max(found->Get(member).GetNumberAsDouble(), 0.0);
}

void make_glass(Material& material, double transmission) {
  if (material.alpha_mode == AlphaMode::opaque) material.base_color.w = 1.0f;
  material.base_color.w *= static_cast<float>(1.0 - kThroughGlass * transmission);
  material.alpha_mode = AlphaMode::blend;
}

/// The base colour becomes light, in cd/m²; its alpha stays.
void make_unlit(Material& material, double strength) {
  material.emissive = vec3(material.base_color) * static_cast<float>(strength);
  material.emissive_texture = material.base_color_texture;
  material.base_color = vec4(0.0f, 0.0f, 0.0f, material.base_color.w);
  material.metallic = 0.0f;
  material.roughness = 1.0f;
  material.reflectivity = 0.0f;
  material.metallic_roughness_texture = {};
  material.normal_texture = {};
  material.occlusion_texture = {};
}

}  // namespace

Result<Material> read_material(const tinygltf::Material& source) {
  const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
  Material material;
  material.name = source.name;
  for (int i = 0; i < 4; ++i) material.base_color[i] = unit_number(pbr.baseColorFactor[static_cast<std::size_t>(i)]);
  const double strength = positive_number(source, "KHR_materials_emissive_strength", "emissiveStrength", 1.0);
  for (int i = 0; i < 3; ++i)
    material.emissive[i] =
        static_cast<float>(unit_number(source.emissiveFactor[static_cast<std::size_t>(i)]) * strength);
  material.metallic = unit_number(pbr.metallicFactor);
  material.roughness = unit_number(pbr.roughnessFactor);
  material.names_roughness = source.values.contains("roughnessFactor") || pbr.metallicRoughnessTexture.index >= 0;
  material.normal_scale = static_cast<float>(source.normalTexture.scale);
  material.occlusion_strength = unit_number(source.occlusionTexture.strength);
  material.alpha_cutoff = static_cast<float>(std::max(source.alphaCutoff, 0.0));
  material.double_sided = source.doubleSided;
  if (source.alphaMode == "MASK")
    material.alpha_mode = AlphaMode::mask;
  else if (source.alphaMode == "BLEND")
    material.alpha_mode = AlphaMode::blend;
  material.base_color_texture = translate_slot(pbr.baseColorTexture);
  material.metallic_roughness_texture = translate_slot(pbr.metallicRoughnessTexture);
  material.normal_texture = translate_slot(source.normalTexture);
  material.occlusion_texture = translate_slot(source.occlusionTexture);
  material.emissive_texture = translate_slot(source.emissiveTexture);
  if (const double transmission =
          std::min(positive_number(source, "KHR_materials_transmission", "transmissionFactor", 0.0), 1.0);
      transmission > 0.0)
    make_glass(material, transmission);
  if (extension(source, "KHR_materials_unlit") != nullptr) make_unlit(material, strength);
  if (!std::isfinite(material.normal_scale) || !std::isfinite(material.alpha_cutoff) ||
      !std::isfinite(material.emissive.x + material.emissive.y + material.emissive.z))
    return Error{ErrorKind::input, "a factor is too large"};
  return material;
}

bool has_transmission_texture(const tinygltf::Material& source) {
  const tinygltf::Value* transmission = extension(source, "KHR_materials_transmission");
  return transmission != nullptr && transmission->Has("transmissionTexture");
}

}  // namespace gloam::gltf

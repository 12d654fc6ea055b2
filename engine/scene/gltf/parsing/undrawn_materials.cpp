// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/gltf/parsing/undrawn_materials.h"

#include <algorithm>
#include <array>
#include <span>

namespace gloam::gltf {
namespace {

/// The effect of a member, a number or a list of numbers, is nothing if all numbers are `neutral`. Absent members are
/// neutral.
struct Member {
  std::string_view name;
  double neutral = 0.0;
};

struct Undrawn {
  std::string_view extension;
  std::array<Member, 2> members;             ///< without a name: none
  std::array<std::string_view, 2> textures;  ///< which have an effect wherever they stand
  bool always = false;                       ///< the extension has an effect wherever it stands
};

// The geometry buffer holds one reflectance at normal incidence for all surfaces that are no metals, and one lobe.
constexpr Undrawn kUndrawn[] = {
    {"KHR_materials_anisotropy", {{{"anisotropyStrength", 0.0}}}, {}},
    {"KHR_materials_clearcoat", {{{"clearcoatFactor", 0.0}}}, {}},
    {"KHR_materials_diffuse_transmission", {{{"diffuseTransmissionFactor", 0.0}}}, {}},
    {"KHR_materials_dispersion", {{{"dispersion", 0.0}}}, {}},
    {"KHR_materials_ior", {{{"ior", 1.5}}}, {}},
    {"KHR_materials_iridescence", {{{"iridescenceFactor", 0.0}}}, {}},
    {"KHR_materials_pbrSpecularGlossiness", {}, {}, true},
    {"KHR_materials_sheen", {{{"sheenColorFactor", 0.0}}}, {}},
    {"KHR_materials_specular",
     {{{"specularFactor", 1.0}, {"specularColorFactor", 1.0}}},
     {"specularTexture", "specularColorTexture"}},
    {"KHR_materials_volume", {{{"thicknessFactor", 0.0}}}, {}},
};

bool differs(const SceneValue& value, double neutral) {
  if (value.kind == SceneValue::Kind::number) return value.number != neutral;
  return std::ranges::any_of(value.items, [neutral](const SceneValue& item) { return differs(item, neutral); });
}

bool has_effect(const SceneValue& extension, const Undrawn& undrawn) {
  for (const Member& member : undrawn.members)
    if (const SceneValue* value = member.name.empty() ? nullptr : extension.find(member.name);
        value != nullptr && differs(*value, member.neutral))
      return true;
  for (const std::string_view texture : undrawn.textures)
    if (!texture.empty() && extension.find(texture) != nullptr) return true;
  return undrawn.always;
}

}  // namespace

bool is_undrawn_extension(std::string_view name) {
  return std::ranges::any_of(kUndrawn, [name](const Undrawn& undrawn) { return undrawn.extension == name; });
}

std::vector<std::string_view> undrawn_extensions(const JsonScan& scan) {
  std::vector<std::string_view> found;
  for (const Undrawn& undrawn : kUndrawn) {
    const bool seen = std::ranges::any_of(scan.materials, [&undrawn](const Attachments& material) {
      const SceneValue* extension = material.extensions.find(undrawn.extension);
      return extension != nullptr && has_effect(*extension, undrawn);
    });
    if (seen) found.push_back(undrawn.extension);
  }
  return found;
}

}  // namespace gloam::gltf

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <utility>

#include "engine/scene/assets.h"
#include "engine/scene/keys/registry.h"
#include "engine/scene/resources.h"
#include "engine/scene/units.h"

namespace gloam {
namespace {

SceneKey sky_key(std::string name, std::string meaning, vec3 SceneEnvironment::*member) {
  SceneKey key;
  key.module = "engine";
  key.on = KeyElement::scene;
  key.name = std::move(name);
  key.type = KeyType::vec3;
  key.min = 0.0;
  key.unit = "cd/m²";
  key.default_text = "[0, 0, 0]";
  key.meaning = std::move(meaning);
  key.set = [member](KeyTarget& target, const KeyValue& value) -> Status {
    auto& environment = target.world.resource<SceneEnvironment>();
    environment.*member = std::get<vec3>(value);
    environment.has_sky = true;
    return {};
  };
  return key;
}

SceneKey exposure_key() {
  SceneKey key;
  key.module = "engine";
  key.on = KeyElement::scene;
  key.name = "gloam.exposure";
  key.type = KeyType::number;
  key.min = -100.0;
  key.max = 100.0;
  key.unit = "EV100";
  key.default_text = "automatic";
  key.meaning = "exposure; automatic: metered in each camera's first frame, then fixed";
  key.set = [](KeyTarget& target, const KeyValue& value) -> Status {
    auto& environment = target.world.resource<SceneEnvironment>();
    environment.has_exposure = true;
    environment.exposure_ev100 = static_cast<float>(std::get<double>(value));
    return {};
  };
  return key;
}

SceneKey scale_key() {
  SceneKey key;
  key.module = "engine";
  key.on = KeyElement::scene;
  key.name = "gloam.scale";
  key.type = KeyType::number;
  key.min = 1e-9;
  key.max = 1e9;
  key.unit = "m";
  key.default_text = "1";
  key.meaning = "metres per unit of length, for physics: falloff of lights, fog, wind, gravity, lenses";
  key.set = [](KeyTarget& target, const KeyValue& value) -> Status {
    target.world.set_resource(SceneUnits{std::get<double>(value)});
    return {};
  };
  return key;
}

Material& material_of(KeyTarget& target) { return target.world.resource<SceneAssets>().materials[target.material]; }

SceneKey reflectivity_key() {
  SceneKey key;
  key.module = "engine";
  key.on = KeyElement::material;
  key.name = "gloam.reflectivity";
  key.type = KeyType::number;
  key.min = 0.0;
  key.max = 1.0;
  key.default_text = "from metallic and roughness";
  key.meaning =
      "share of mirror reflection, from 0 (none) to 1; above 0, a material that names neither roughnessFactor nor a "
      "metallicRoughnessTexture is a mirror: roughness 0, not glTF's default of 1";
  key.set = [](KeyTarget& target, const KeyValue& value) -> Status {
    Material& material = material_of(target);
    material.reflectivity = static_cast<float>(std::get<double>(value));
    if (material.reflectivity > 0.0f && !material.names_roughness) material.roughness = 0.0f;
    return {};
  };
  return key;
}

SceneKey subsurface_key() {
  SceneKey key;
  key.module = "engine";
  key.on = KeyElement::material;
  key.name = "gloam.subsurface";
  key.type = KeyType::boolean;
  key.default_text = "false";
  key.meaning = "light passes through thin parts";
  key.set = [](KeyTarget& target, const KeyValue& value) -> Status {
    material_of(target).subsurface = std::get<bool>(value);
    return {};
  };
  return key;
}

SceneKey extinction_key() {
  SceneKey key;
  key.module = "engine";
  key.on = KeyElement::material;
  key.name = "gloam.subsurface.extinction";
  key.type = KeyType::number;
  key.min = 0.0;
  key.max = 1e6;
  key.unit = "m";
  key.default_text = "from gloam.scale: 5 mm";
  key.meaning =
      "length over which light inside a body with gloam.subsurface falls to 1/e (37 %); 0: no light passes through";
  key.set = [](KeyTarget& target, const KeyValue& value) -> Status {
    material_of(target).extinction_m = static_cast<float>(std::get<double>(value));
    return {};
  };
  return key;
}

/// The default extinction length is a real length, so files in other units get it in theirs.
Status set_default_extinctions(World& world) {
  const double unit_m = metres_per_unit(world);
  for (Material& material : world.resource<SceneAssets>().materials)
    if (material.subsurface && material.extinction_m < 0.0f)
      material.extinction_m = static_cast<float>(kExtinctionM / unit_m);
  return {};
}

}  // namespace

void add_engine_keys(KeyRegistry& registry) {
  registry.add(sky_key("gloam.sky.zenith", "radiance of the sky overhead", &SceneEnvironment::sky_zenith));
  registry.add(sky_key("gloam.sky.horizon", "radiance of the sky at the horizon", &SceneEnvironment::sky_horizon));
  registry.add(sky_key("gloam.sky.ground", "radiance from below the horizon", &SceneEnvironment::sky_ground));
  registry.add(exposure_key());
  registry.add(scale_key());
  registry.add(reflectivity_key());
  registry.add(subsurface_key());
  registry.add(extinction_key());
  registry.add_finish("engine", set_default_extinctions);
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/light_keys.h"

#include <cmath>
#include <filesystem>

#include "engine/scene/key_table.h"
#include "modules/lights/components.h"

namespace gloam {
namespace {

constexpr const char* kExtension = "KHR_lights_punctual";

/// Definitions of the file's root, looked up by its nodes; a resource while a file is read.
struct LightDefinitions {
  std::vector<Light> lights;
};

Error fault(std::string message) { return {ErrorKind::input, std::string(kExtension) + ": " + std::move(message)}; }

Status read_number(const SceneValue& object, const char* name, double min, double max, float& target) {
  const SceneValue* value = object.find(name);
  if (value == nullptr) return {};
  if (value->kind != SceneValue::Kind::number) return fault(std::string(name) + " must be a number");
  if (!(value->number >= min && value->number <= max)) return fault(std::string(name) + " is out of range");
  target = static_cast<float>(value->number);
  return {};
}

Status read_color(const SceneValue& object, vec3& color) {
  const SceneValue* value = object.find("color");
  if (value == nullptr) return {};
  if (value->kind != SceneValue::Kind::array || value->items.size() != 3) return fault("color must be three numbers");
  for (std::size_t c = 0; c < 3; ++c) {
    const SceneValue& item = value->items[c];
    if (item.kind != SceneValue::Kind::number || !(item.number >= 0.0 && item.number <= 1e6))
      return fault("color must be three numbers ≥ 0");
    color[static_cast<int>(c)] = static_cast<float>(item.number);
  }
  return {};
}

Status read_spot(const SceneValue& object, Light& light) {
  constexpr double kHalfPi = 1.5707963267948966;
  const SceneValue* spot = object.find("spot");
  light.inner_angle = 0.0f;
  light.outer_angle = static_cast<float>(kHalfPi / 2.0);
  if (spot == nullptr) return {};
  if (spot->kind != SceneValue::Kind::object) return fault("spot must be an object");
  // A half angle over π/2 is a cone over 180°, which is refused; files round π/2 either way.
  GLOAM_TRY(read_number(*spot, "innerConeAngle", 0.0, kHalfPi + 1e-6, light.inner_angle));
  GLOAM_TRY(read_number(*spot, "outerConeAngle", 0.0, kHalfPi + 1e-6, light.outer_angle));
  if (light.outer_angle <= 0.0f) return fault("outerConeAngle must be above 0");
  if (light.inner_angle > light.outer_angle) return fault("innerConeAngle must not exceed outerConeAngle");
  light.outer_angle = std::min(light.outer_angle, static_cast<float>(kHalfPi));
  return {};
}

Result<Light> read_light(const SceneValue& object) {
  Light light;
  const SceneValue* type = object.find("type");
  if (type == nullptr || type->kind != SceneValue::Kind::text) return fault("a light needs a type");
  if (type->text == "point") light.kind = LightKind::point;
  else if (type->text == "spot") light.kind = LightKind::spot;
  else if (type->text == "directional") light.kind = LightKind::directional;
  else return fault("type \"" + type->text + "\" is none of point, spot, directional");
  GLOAM_TRY(read_color(object, light.color));
  GLOAM_TRY(read_number(object, "intensity", 0.0, 1e12, light.intensity));
  GLOAM_TRY(read_number(object, "range", 1e-6, 1e9, light.range_m));
  if (light.kind == LightKind::spot) GLOAM_TRY(read_spot(object, light));
  return light;
}

Status begin_file(World& world, const SceneValue* root) {
  LightDefinitions definitions;
  if (root != nullptr) {
    const SceneValue* lights = root->find("lights");
    if (lights == nullptr || lights->kind != SceneValue::Kind::array) return fault("lights must be an array");
    for (std::size_t i = 0; i < lights->items.size(); ++i) {
      auto light = read_light(lights->items[i]);
      if (!light.ok()) return Error{ErrorKind::input, light.error().message + " (light " + std::to_string(i) + ")"};
      definitions.lights.push_back(*light);
    }
  }
  world.set_resource(std::move(definitions));
  return {};
}

Status read_node(KeyTarget& target, const SceneValue& node) {
  const auto& lights = target.world.resource<LightDefinitions>().lights;
  const SceneValue* index = node.find("light");
  if (index == nullptr || index->kind != SceneValue::Kind::number) return fault("a node must name its light by number");
  if (!(index->number >= 0.0 && index->number < static_cast<double>(lights.size())))
    return fault("light " + std::to_string(static_cast<long long>(index->number)) + " does not exist");
  target.world.add<Light>(target.entity, lights[static_cast<std::size_t>(index->number)]);
  SceneNames& names = target.world.resource<SceneNames>();
  names.add("light", std::string(names.name_of(target.entity)), target.entity);
  return {};
}

SceneKey cookie_key() {
  SceneKey key = key_line("lights", KeyElement::light_node, "gloam.light.cookie", "", "", "image file, projected texture (spot)");
  key.type = KeyType::text;
  key.set = [](KeyTarget& target, const KeyValue& value) -> Status {
    const auto& name = std::get<std::string>(value);
    Light& light = target.world.get<Light>(target.entity);
    if (light.kind != LightKind::spot) return Error{ErrorKind::input, "only spot lights project an image"};
    const std::filesystem::path path = std::filesystem::path(target.directory) / name;
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return Error{ErrorKind::input, "the image " + name + " is absent"};
    light.cookie = target.world.resource<SceneStrings>().intern(path.string());
    return {};
  };
  return key;
}

}  // namespace

void add_light_keys(KeyRegistry& registry) {
  registry.add_extension({"lights", kExtension, &begin_file, &read_node});
  registry.set_light_test([](const World& world, Entity entity) { return world.try_get<Light>(entity) != nullptr; });
  registry.add(number_key(key_line("lights", KeyElement::light_node, "gloam.light.width", "0", "m",
                                   "diameter of the emitter; 0 = hard shadows"),
                          0, 1e4, &Light::width_m));
  registry.add(number_key(key_line("lights", KeyElement::light_node, "gloam.light.angle", "0.53", "degrees",
                                   "directional only: apparent diameter (penumbra)"),
                          0, 90, &Light::apparent_angle, static_cast<double>(kPi) / 180.0));
  registry.add(cookie_key());
}

}  // namespace gloam

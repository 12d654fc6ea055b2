// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/bake.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "engine/core/hash.h"
#include "engine/ecs/view.h"
#include "engine/scene/assets/hash.h"
#include "engine/scene/components.h"
#include "engine/scene/posing/animated_nodes.h"
#include "engine/scene/posing/animation.h"
#include "engine/scene/resources.h"
#include "engine/scene/units.h"
#include "modules/lighting/components.h"
#include "modules/lights/components.h"
#include "modules/lights/light_names.h"
#include "modules/reflections/components.h"
#include "modules/reflections/scene_unit.h"
#include "modules/shadows/components.h"

namespace gloam {
namespace {

/// Increment it when the same scene gives other captures than before.
constexpr std::uint32_t kBakeVersion = 8;

template <class Key>
std::vector<Entity> sorted_with(const World& world) {
  std::vector<Entity> entities;
  world.view<const Key, const WorldTransform>().each(
      [&](Entity entity, const Key&, const WorldTransform&) { entities.push_back(entity); });
  std::ranges::sort(entities, {}, &Entity::index);
  return entities;
}

/// Hashes assets by their content, so that their order and what no instance uses do not count.
class AssetHashes {
 public:
  explicit AssetHashes(const SceneAssets& assets) : assets_(assets) {}

  [[nodiscard]] std::uint64_t mesh(std::uint32_t index) {
    const auto found = meshes_.find(index);
    if (found != meshes_.end()) return found->second;
    Hasher hasher;
    if (index < assets_.meshes.size())
      for (const Primitive& primitive : assets_.meshes[index].primitives) add(hasher, primitive);
    return meshes_[index] = hasher.digest();
  }

 private:
  void add(Hasher& hasher, const Primitive& primitive) {
    hasher.value(material(primitive.material));
    hash_triangles(hasher, primitive);
  }

  [[nodiscard]] std::uint64_t material(std::uint32_t index) {
    if (index >= assets_.materials.size()) return 0;
    const auto found = materials_.find(index);
    if (found != materials_.end()) return found->second;
    const Material& m = assets_.materials[index];
    Hasher hasher;
    hasher.bytes_of(m.base_color);
    hasher.bytes_of(m.emissive);
    for (const float value : {m.metallic, m.roughness, m.normal_scale, m.occlusion_strength, m.alpha_cutoff})
      hasher.bytes_of(value);
    hasher.value(m.alpha_mode).value(m.double_sided).value(m.subsurface);
    if (m.subsurface) hasher.bytes_of(extinction_length(m));
    hasher.bytes_of(m.reflectivity);
    for (const TextureSlot* slot : {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture,
                                    &m.occlusion_texture, &m.emissive_texture})
      add(hasher, *slot);
    return materials_[index] = hasher.digest();
  }

  void add(Hasher& hasher, const TextureSlot& slot) {
    hasher.value(slot.uv_set);
    hasher.bytes_of(slot.transform_row0);
    hasher.bytes_of(slot.transform_row1);
    if (slot.texture >= assets_.textures.size()) return;
    const Texture& texture = assets_.textures[slot.texture];
    hasher.value(texture.srgb).value(texture.nearest).value(texture.wrap_u).value(texture.wrap_v);
    hasher.value(image(texture.image));
  }

  [[nodiscard]] std::uint64_t image(std::uint32_t index) {
    if (index >= assets_.images.size()) return 0;
    const auto found = images_.find(index);
    if (found != images_.end()) return found->second;
    Hasher hasher;
    hash_image(hasher, assets_.images[index]);
    return images_[index] = hasher.digest();
  }

  const SceneAssets& assets_;
  std::map<std::uint32_t, std::uint64_t> meshes_;
  std::map<std::uint32_t, std::uint64_t> materials_;
  std::map<std::uint32_t, std::uint64_t> images_;
};

/// Hashes poses of nodes: the matrix of a node at rest, and what an animated node's matrix is made from.
class PoseHashes {
 public:
  explicit PoseHashes(const World& world) : world_(world), animated_(world) {}

  [[nodiscard]] bool moves(Entity node) const { return animated_.moves(node); }

  void add(Hasher& hasher, Entity node) const {
    if (!moves(node)) {
      hasher.bytes_of(world_.get<WorldTransform>(node).matrix);
      return;
    }
    while (true) {
      add_own(hasher, node);
      const Parent* parent = world_.try_get<Parent>(node);
      if (parent == nullptr || !world_.alive(parent->entity)) return;
      node = parent->entity;
    }
  }

 private:
  void add_own(Hasher& hasher, Entity node) const {
    bool translated = false, rotated = false, scaled = false;
    if (animated_.has_channel(node)) {
      const SceneAssets& assets = world_.resource<SceneAssets>();
      for (const AnimationBinding& binding : world_.resource<AnimationBindings>().poses) {
        if (binding.entity != node) continue;
        const AnimationClip& clip = assets.clips[binding.clip];
        const AnimationChannel& channel = clip.channels[binding.channel];
        translated = translated || channel.path == AnimationPath::translation;
        rotated = rotated || channel.path == AnimationPath::rotation;
        scaled = scaled || channel.path == AnimationPath::scale;
        hasher.value(channel.path).value(channel.interpolation);
        hasher.bytes_of(clip.duration_s);
        hasher.items(channel.times);
        hasher.items(channel.values);
      }
    }
    if (const LocalTransform* pose = world_.try_get<LocalTransform>(node)) {
      if (!translated) hasher.bytes_of(pose->translation);
      if (!rotated) hasher.bytes_of(pose->rotation);
      if (!scaled) hasher.bytes_of(pose->scale);
    }
    if (const LocalMatrix* pose = world_.try_get<LocalMatrix>(node)) hasher.bytes_of(pose->matrix);
  }

  const World& world_;
  AnimatedNodes animated_;
};

void add_file(Hasher& hasher, const World& world, std::uint32_t name) {
  if (name == 0) return;
  std::ifstream file(world.resource<SceneStrings>().text(name), std::ios::binary);
  hasher.text(std::string{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()});
}

/// Two flames with the same small picture have the same large one.
void add_flame(Hasher& hasher, const World& world, Entity proxy) {
  const FlameProxy* flame = world.try_get<FlameProxy>(proxy);
  const FlameSource* source = world.try_resource<FlameSource>();
  if (flame == nullptr || source == nullptr || !source->picture) return;
  constexpr std::uint32_t kSide = 16;
  for (const vec4& texel : source->picture(world, flame->flame, kSide)) hasher.bytes_of(texel);
}

void add_instances(Hasher& hasher, const World& world, const PoseHashes& poses) {
  AssetHashes assets(world.resource<SceneAssets>());
  for (const Entity entity : sorted_with<MeshInstance>(world)) {
    const auto& instance = world.get<MeshInstance>(entity);
    if (instance.skin != kNone || world.has<MorphInstance>(entity) || poses.moves(entity)) continue;
    hasher.value(assets.mesh(instance.mesh)).value(instance.casts_shadows);
    poses.add(hasher, entity);
  }
}

void add_lights(Hasher& hasher, const World& world, const PoseHashes& poses, const std::vector<Entity>& lights) {
  for (const Entity entity : lights) {
    const auto& light = world.get<Light>(entity);
    hasher.value(light.kind);
    hasher.bytes_of(light.color);
    for (const float value :
         {light.intensity, light.range_m, light.inner_angle, light.outer_angle, light.width_m, light.apparent_angle})
      hasher.bytes_of(value);
    add_file(hasher, world, light.cookie);
    const ShadowCaster* caster = world.try_get<ShadowCaster>(entity);
    hasher.value(caster == nullptr || caster->enabled).value(caster == nullptr ? 0u : caster->resolution);
    poses.add(hasher, entity);
  }
}

void add_proxies(Hasher& hasher, const World& world, const PoseHashes& poses, const std::vector<Entity>& lights) {
  for (const Entity entity : sorted_with<IbrProxy>(world)) {
    const auto& proxy = world.get<IbrProxy>(entity);
    hasher.bytes_of(proxy.size_m);
    hasher.value(proxy.kind).value(proxy.texture != 0);
    add_file(hasher, world, proxy.texture);
    add_flame(hasher, world, entity);
    const std::string& names = world.resource<SceneStrings>().text(proxy.lights);
    const auto named = resolve_light_names(world, names, "gloam.ibr_proxy.lights");
    hasher.value(named.ok() ? named->size() : 0);
    if (named.ok())
      for (const Entity light : *named) hasher.value(std::ranges::find(lights, light) - lights.begin());
    poses.add(hasher, entity);
  }
}

void add_probes(Hasher& hasher, const World& world, const PoseHashes& poses) {
  for (const Entity entity : sorted_with<CubeProbe>(world)) {
    const auto& probe = world.get<CubeProbe>(entity);
    hasher.bytes_of(probe.size_m);
    hasher.value(probe.resolution).value(probe.global);
    poses.add(hasher, entity);
  }
}

}  // namespace

std::uint64_t capture_content(const World& world, IndirectSource light) {
  const PoseHashes poses(world);
  const std::vector<Entity> lights = sorted_with<Light>(world);
  Hasher hasher;
  hasher.value(kBakeVersion);
  const auto& environment = world.resource<SceneEnvironment>();
  for (const vec3& sky : {environment.sky_zenith, environment.sky_horizon, environment.sky_ground})
    hasher.bytes_of(sky);
  // Near planes of captures and the factor of their light follow units.
  const double metres = metres_per_unit(world), unit = scene_unit(world);
  if (metres != 1.0) hasher.bytes_of(metres);
  if (unit != 1.0) hasher.bytes_of(unit);
  add_instances(hasher, world, poses);
  hasher.text("lights");
  add_lights(hasher, world, poses, lights);
  hasher.text("proxies");
  add_proxies(hasher, world, poses, lights);
  hasher.text("probes");
  add_probes(hasher, world, poses);
  if (light != IndirectSource::sky) hasher.text(name_of(light));
  if (const CapturedExtras* extras = world.try_resource<CapturedExtras>())
    for (const auto& [module, content] : extras->content) hasher.text(module).value(content(world));
  return std::max<std::uint64_t>(hasher.digest(), 1);
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/bake.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/assert.h"
#include "engine/ecs/view.h"
#include "engine/math/finite.h"
#include "engine/render/camera/light_scale.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/systems.h"
#include "modules/lighting/components.h"
#include "modules/reflections/bake/capture_view.h"
#include "modules/reflections/bake/cube.h"
#include "modules/reflections/bake/light_sources.h"
#include "modules/reflections/bake/probe_map.h"
#include "modules/reflections/bake/proxy_capture.h"
#include "modules/reflections/bake/proxy_texture.h"
#include "modules/reflections/components.h"
#include "modules/reflections/culling/placed.h"
#include "modules/reflections/diffuse/capture.h"
#include "modules/reflections/diffuse/grid.h"
#include "modules/reflections/diffuse/indirect_light.h"
#include "modules/reflections/knobs.h"
#include "modules/reflections/materials.h"
#include "modules/reflections/relighting/light_states.h"
#include "modules/reflections/scene_unit.h"

namespace gloam {
namespace {

struct ProxyToBake {
  IbrProxy proxy;
  PlacedProxy placed;
};

struct ProbeToBake {
  Entity entity = kNoEntity;
  CubeProbe probe;
  dvec3 eye = dvec3(0.0);
};

std::vector<ProxyToBake> proxies_to_bake(const World& world) {
  std::vector<ProxyToBake> proxies;
  world.view<const IbrProxy, const WorldTransform>().each(
      [&](Entity entity, const IbrProxy& proxy, const WorldTransform& transform) {
        ProxyToBake found{proxy, {}};
        if (place_proxy(entity, proxy, transform.matrix, found.placed) == ProxyPlacement::placed)
          proxies.push_back(found);
      });
  std::ranges::sort(proxies, {}, [](const ProxyToBake& proxy) { return proxy.placed.entity.index; });
  return proxies;
}

std::vector<ProbeToBake> probes_to_bake(const World& world) {
  std::vector<ProbeToBake> probes;
  world.view<const CubeProbe, const WorldTransform>().each(
      [&](Entity entity, const CubeProbe& probe, const WorldTransform& transform) {
        const vec3& size = probe.size_m;
        const bool has_volume = is_finite(size) && size.x > 0.0f && size.y > 0.0f && size.z > 0.0f;
        const dvec3 eye(transform.matrix[3]);
        if (is_finite(eye) && (probe.global || has_volume)) probes.push_back({entity, probe, eye});
      });
  std::ranges::sort(probes, {}, [](const ProbeToBake& probe) { return probe.entity.index; });
  return probes;
}

/// Layers with the part of captures that no lamp causes. They come after the layers of the captures themselves.
class EmissionLayers {
 public:
  /// layers: with the number of the captures.
  explicit EmissionLayers(CapturedLayers& layers) : layers_(layers) {}

  /// append: appends the halves of one layer to a vector. Returns CapturedParts::emission: −1 if there is no room.
  template <class Append>
  [[nodiscard]] std::int32_t add(const Append& append) {
    const std::uint32_t layer = layers_.count + count_;
    if (layer >= kMostLayers) return -1;
    append(texels_);
    ++count_;
    return static_cast<std::int32_t>(layer);
  }
  /// Call it after the last capture.
  void append() {
    layers_.texels.insert(layers_.texels.end(), texels_.begin(), texels_.end());
    layers_.count += count_;
  }

 private:
  static constexpr std::uint32_t kMostLayers = 2048;  // of an array image, on every device
  CapturedLayers& layers_;
  std::vector<std::uint16_t> texels_;
  std::uint32_t count_ = 0;
};

/// The captures that the world shows during a bake: at first none. Afterwards it has those from before.
class WorldCaptures {
 public:
  explicit WorldCaptures(World& world) : world_(world) {
    if (ReflectionCaptures* found = world.try_resource<ReflectionCaptures>()) before_ = std::move(*found);
    version_ = before_.version;
    show({});
  }
  ~WorldCaptures() { show(std::move(before_)); }
  WorldCaptures(const WorldCaptures&) = delete;
  WorldCaptures& operator=(const WorldCaptures&) = delete;

  void show(ReflectionCaptures captures) {
    captures.version = ++version_;
    world_.set_resource(std::move(captures));
  }

 private:
  World& world_;
  ReflectionCaptures before_;
  std::uint64_t version_ = 0;
};

/// Captures of one world.
class Bake {
 public:
  Bake(Renderer& renderer, World& world, const BakeSettings& settings)
      : renderer_(renderer), world_(world), settings_(settings) {
    auto& extras = world_.ensure_resource<CapturedExtras>();
    for (std::uint32_t i = 0; i < kBakeViews; ++i) extras.views.insert(kFirstBakeView.value + i);
  }
  ~Bake() {
    for (std::uint32_t i = 0; i < kBakeViews; ++i) {
      renderer_.release_view(world_, ViewId{kFirstBakeView.value + i});
      world_.resource<CapturedExtras>().views.erase(kFirstBakeView.value + i);
    }
  }
  Bake(const Bake&) = delete;
  Bake& operator=(const Bake&) = delete;

  [[nodiscard]] Result<ReflectionCaptures> run() {
    // Poses the world before anything is placed in it.
    Schedule schedule;
    add_scene_systems(schedule);
    schedule.run(Stage::world, world_, *settings_.executor);
    const std::vector<ProxyToBake> proxies = proxies_to_bake(world_);
    const std::vector<ProbeToBake> probes = probes_to_bake(world_);
    sources_ = light_sources(world_);
    const ReflectiveMaterials materials = count_reflective(world_.resource<SceneAssets>());
    const bool shows_probes = !probes.empty() && materials.mirror + materials.rough > 0;
    std::vector<GridCell> cells;
    if (settings_.grid_probes > 0) {
      const auto tracer = settings_.make_tracer(world_);
      if (!tracer.ok()) return tracer.error();
      cells = open_cells(occupied_cells(triangle_bounds(world_), settings_.grid_probes, scene_unit(world_)), **tracer);
    }
    total_ = proxies.size() + probes.size() + cells.size();
    const IndirectSource light = renderer_.knobs().value(kIndirectLight);
    captures_.content = capture_content(world_, light);
    captures_.light_scale = light_scale(scene_brightness(world_));
    captures_.lights = light_states(world_);
    if (settings_.progress) settings_.progress(0, total_);
    // Captures show what pictures show: surfaces that reflect their surroundings. Probes are captured twice, first with
    // the sky alone for surroundings, then with each other.
    WorldCaptures shown(world_);
    if (light == IndirectSource::probes) {
      GLOAM_TRY(add_diffuse(probes, cells));
      shown.show(with_places(probes));
    }
    counting_ = !shows_probes;
    GLOAM_TRY(add_probes(probes));
    counting_ = true;
    if (shows_probes) {
      shown.show(captures_);
      captures_.probes = {};
      captures_.probe_entities.clear();
      captures_.probe_parts.clear();
      GLOAM_TRY(add_probes(probes));
    }
    GLOAM_TRY(add_proxies(proxies));
    // The last frames, so that the captures before do not depend on them.
    if (light != IndirectSource::probes) GLOAM_TRY(add_diffuse(probes, cells));
    return std::move(captures_);
  }

 private:
  [[nodiscard]] Status add_proxies(const std::vector<ProxyToBake>& proxies) {
    if (proxies.empty()) return {};
    captures_.proxies.side = settings_.proxy_side;
    captures_.proxies.mips = static_cast<std::uint32_t>(std::bit_width(settings_.proxy_side));
    captures_.proxies.count = static_cast<std::uint32_t>(proxies.size());
    EmissionLayers emission(captures_.proxies);
    for (const ProxyToBake& proxy : proxies) GLOAM_TRY(add_proxy(proxy, emission));
    emission.append();
    return {};
  }

  [[nodiscard]] Status add_proxy(const ProxyToBake& proxy, EmissionLayers& emission) {
    if (const FlameProxy* flame = world_.try_get<FlameProxy>(proxy.placed.entity)) {
      add_flame(proxy.placed.entity, flame->flame);
      return {};
    }
    const std::string_view names = world_.resource<SceneStrings>().text(proxy.proxy.lights);
    auto chosen = proxy_lights(world_, proxy.placed, names, sources_);
    if (!chosen.ok()) return chosen.error();
    auto capture = proxy.proxy.texture == 0
                       ? capture_proxy(renderer_, world_, proxy.placed, settings_.proxy_side, captures_.light_scale)
                       : image_capture(proxy, *chosen);
    if (!capture.ok()) return capture.error();
    const auto layer = static_cast<std::uint32_t>(captures_.proxy_entities.size());
    CapturedParts parts = parts_of(capture->all, capture->unlit);
    parts.surface_m = capture->surface_m;
    std::vector<CapturedLightState> lamps;
    std::ranges::copy_if(captures_.lights, std::back_inserter(lamps), [&](const CapturedLightState& light) {
      return names.empty() || std::ranges::find(*chosen, light.light, &CapturedProxyLight::light) != chosen->end();
    });
    parts.lamps_lux = illuminances(lamps, proxy_patches(proxy.placed, parts.surface_m));
    if (parts.unlit > 0.0f)
      parts.emission = emission.add(
          [&](std::vector<std::uint16_t>& halves) { append_mip_chain(std::move(capture->unlit), halves); });
    captures_.proxy_parts.push_back(parts);
    for (CapturedProxyLight& light : *chosen) {
      light.layer = layer;
      captures_.proxy_lights.push_back(light);
    }
    captures_.proxy_entities.push_back(proxy.placed.entity);
    append_mip_chain(std::move(capture->all), captures_.proxies.texels);
    tell_progress();
    return {};
  }

  /// The image file of a proxy in place of a capture.
  [[nodiscard]] Result<ProxyCapture> image_capture(const ProxyToBake& proxy,
                                                   std::span<const CapturedProxyLight> chosen) const {
    auto picture = read_proxy_texture(world_.resource<SceneStrings>().text(proxy.proxy.texture), settings_.proxy_side);
    if (!picture.ok()) return picture.error();
    if (proxy.proxy.kind == IbrProxyKind::fire) {
      scale_to_lights(*picture, 4.0 * glm::length(glm::cross(proxy.placed.half_u, proxy.placed.half_v)), sources_,
                      chosen, captures_.light_scale);
    } else {
      for (vec4& texel : picture->texels) texel = vec4(vec3(texel) * captures_.light_scale, texel.w);
    }
    return ProxyCapture{.all = std::move(picture).value(), .unlit = {}};
  }

  /// The flame itself says how bright it is: no light dims its proxy.
  void add_flame(Entity proxy, Entity flame) {
    const std::uint32_t side = settings_.proxy_side;
    CapturedPicture picture{side, side, std::vector<vec4>(std::size_t{side} * side, vec4(0.0f))};
    const FlameSource* source = world_.try_resource<FlameSource>();
    if (source != nullptr && source->picture) picture.texels = source->picture(world_, flame, side);
    for (vec4& texel : picture.texels) texel = vec4(storable(captures_.light_scale * vec3(texel)), texel.w);
    captures_.proxy_entities.push_back(proxy);
    captures_.proxy_parts.emplace_back();
    append_mip_chain(std::move(picture), captures_.proxies.texels);
    tell_progress();
  }

  /// Diffuse light of probes and grid.
  [[nodiscard]] Status add_diffuse(const std::vector<ProbeToBake>& probes, const std::vector<GridCell>& cells) {
    for (const ProbeToBake& probe : probes) {
      std::vector<CapturedSurface> around;
      if (probe.probe.global) {
        auto surfaces = probe_surfaces(renderer_, world_, probe.eye);
        if (!surfaces.ok()) return surfaces.error();
        around = std::move(surfaces).value();
      }
      const auto diffuse =
          capture_diffuse(renderer_, world_, probe.eye, captures_.light_scale, around, *settings_.executor);
      if (!diffuse.ok()) return diffuse.error();
      captures_.probe_diffuse.push_back(*diffuse);
    }
    if (settings_.grid_probes == 0) captures_.grid = settings_.grid;
    return add_grid(cells);
  }

  /// The captures so far, which have no pictures yet, for probes in their places.
  [[nodiscard]] ReflectionCaptures with_places(const std::vector<ProbeToBake>& probes) const {
    ReflectionCaptures light = captures_;
    for (const ProbeToBake& probe : probes) light.probe_entities.push_back(probe.entity);
    return light;
  }

  [[nodiscard]] Status add_grid(const std::vector<GridCell>& cells) {
    for (const GridCell& cell : cells) {
      const auto diffuse = capture_diffuse(renderer_, world_, cell.eye, captures_.light_scale, {}, *settings_.executor);
      if (!diffuse.ok()) return diffuse.error();
      captures_.grid.push_back(
          {cell.center, vec3(cell.half), surrounding_lux(captures_.lights, cell.center), *diffuse});
      tell_progress();
    }
    return {};
  }

  [[nodiscard]] Status add_probes(const std::vector<ProbeToBake>& probes) {
    if (probes.empty()) return {};
    CapturedLayers& layers = captures_.probes;
    for (const ProbeToBake& probe : probes) layers.side = std::max(layers.side, probe_map_side(probe.probe.resolution));
    layers.mips = probe_map_mips(layers.side);
    layers.count = static_cast<std::uint32_t>(probes.size());
    EmissionLayers emission(layers);
    for (const ProbeToBake& probe : probes) {
      const auto draw = [&](CapturedLamps lamps) {
        return draw_cube_faces(renderer_, world_, probe.eye, probe_face_side(probe.probe.resolution),
                               captures_.light_scale, lamps);
      };
      const auto append = [&](const std::array<CapturedPicture, 6>& faces, std::vector<std::uint16_t>& halves) {
        append_probe_map(CapturedCube(faces, *settings_.executor), layers.side, *settings_.executor, halves);
      };
      const auto faces = draw(CapturedLamps::on), unlit = draw(CapturedLamps::left_out);
      if (!faces.ok()) return faces.error();
      if (!unlit.ok()) return unlit.error();
      CapturedParts parts;
      for (std::size_t face = 0; face < faces->size(); ++face) {
        const CapturedParts seen = parts_of((*faces)[face], (*unlit)[face]);
        parts.lit += seen.lit / 6.0f, parts.unlit += seen.unlit / 6.0f;
      }
      auto surfaces = probe_surfaces(renderer_, world_, probe.eye);
      if (!surfaces.ok()) return surfaces.error();
      parts.surfaces = std::move(surfaces).value();
      parts.lamps_lux = illuminances(captures_.lights, probe_patches(probe.eye, parts.surfaces));
      if (parts.unlit > 0.0f)
        parts.emission = emission.add([&](std::vector<std::uint16_t>& halves) { append(*unlit, halves); });
      append(*faces, layers.texels);
      captures_.probe_entities.push_back(probe.entity);
      captures_.probe_parts.push_back(parts);
      tell_progress();
    }
    emission.append();
    return {};
  }

  /// Without the layer and the lamps. unlit: empty if lamps cause all light.
  [[nodiscard]] CapturedParts parts_of(const CapturedPicture& all, const CapturedPicture& unlit) const {
    const auto mean = [&](const CapturedPicture& picture) {
      double sum = 0.0;
      for (const vec4& texel : picture.texels) sum += luminance_of(dvec3(texel));
      return sum / (static_cast<double>(std::max<std::size_t>(picture.texels.size(), 1)) *
                    static_cast<double>(captures_.light_scale));
    };
    CapturedParts parts;
    parts.unlit = static_cast<float>(mean(unlit));
    parts.lit = static_cast<float>(std::max(mean(all) - mean(unlit), 0.0));
    return parts;
  }

  void tell_progress() {
    if (!counting_) return;
    ++done_;
    if (settings_.progress) settings_.progress(done_, total_);
  }

  Renderer& renderer_;
  World& world_;
  const BakeSettings& settings_;
  std::vector<LightSource> sources_;
  ReflectionCaptures captures_;
  bool counting_ = true;  ///< finished captures count
  std::size_t done_ = 0;
  std::size_t total_ = 0;
};

}  // namespace

Result<ReflectionCaptures> bake_reflections(Renderer& renderer, World& world, const BakeSettings& settings) {
  GLOAM_ASSERT(settings.executor != nullptr, "a bake needs an executor");
  GLOAM_ASSERT(std::has_single_bit(settings.proxy_side), "the side of a proxy's image is a power of two");
  return Bake(renderer, world, settings).run();
}

void attach_captures(World& world, ReflectionCaptures captures) {
  const ReflectionCaptures* before = world.try_resource<ReflectionCaptures>();
  captures.version = before == nullptr ? 1 : before->version + 1;
  world.set_resource(std::move(captures));
}

}  // namespace gloam

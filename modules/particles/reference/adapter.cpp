// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/reference/adapter.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "modules/particles/bake.h"
#include "modules/particles/emitters/placed.h"
#include "modules/particles/emitters/visible.h"
#include "modules/particles/knobs.h"

namespace gloam {
namespace {

constexpr double kTracedTexel_m = 1.0 / 16.0;

/// The emitters in view, and maps of them that fit into the atlas together.
ParticleBakeOptions traced_options(const ReferenceInput& input) {
  ParticleBakeOptions options;
  options.moment = BakedMoment::now;
  const std::vector<PlacedEmitter>& emitters = input.world.resource<EmitterSet>().emitters;
  // A view of a world without emitters has no list.
  if (const auto* visible = input.world.try_view_resource<VisibleEmitters>(input.view.id))
    for (const VisibleEmitter& seen : visible->emitters) options.emitters.push_back(emitters[seen.emitter].entity);
  std::ranges::sort(options.emitters, {}, &Entity::index);
  const auto count = static_cast<std::uint32_t>(std::max<std::size_t>(options.emitters.size(), 1));
  options.texel_m = kTracedTexel_m;
  options.most_side = std::clamp(kMostMapSlices / count, 2u, kMostMapSide);
  const std::uint32_t samples = std::max(input.samples, 1u);
  options.rays_per_texel = 4 * samples;
  options.rays_per_light = options.visibility_rays = samples;
  return options;
}

}  // namespace

Result<ParticleLightMaps> find_particle_light(const ReferenceInput& input) {
  if (input.tracer == nullptr) return Error{ErrorKind::usage, "traced light of particles needs the scene's triangles"};
  const ParticleBakeOptions options = traced_options(input);
  if (options.emitters.empty()) return ParticleLightMaps{.per_pixel = true};
  const std::string identity =
      "particle light, traced 1, of " + std::to_string(particle_light_content(input.world, *input.tracer, options));
  if (input.store != nullptr)
    if (const std::optional<std::string> kept = input.store->load(identity))
      if (std::optional<ParticleLightMaps> maps = decode_particle_light(input.world, *kept)) {
        maps->per_pixel = true;
        return std::move(*maps);
      }
  ParticleLightMaps maps = bake_particle_light({.world = input.world,
                                                .tracer = *input.tracer,
                                                .executor = input.executor,
                                                .progress = input.progress,
                                                .options = options});
  maps.per_pixel = true;
  if (input.store != nullptr) GLOAM_TRY(input.store->save(identity, encode_particle_light(input.world, maps)));
  return maps;
}

Result<FramePictures> draw_traced_particles(const ReferenceInput& input) {
  if (!input.redraw) return Error{ErrorKind::usage, "traced light of particles needs a frame that can be drawn again"};
  auto traced = find_particle_light(input);
  if (!traced) return traced.error();
  const auto other = std::make_shared<ParticleLightMaps>(std::move(traced).value());
  // Each swap raises the version, so that no frame shows an earlier upload.
  const auto swap = [other](World& world) {
    auto& current = world.resource<ParticleLightMaps>();
    const std::uint64_t version = std::max(current.version, other->version) + 1;
    std::swap(current, *other);
    current.version = version;
  };
  return input.redraw(swap, swap);
}

std::vector<ReferenceInfo> particle_references() {
  std::vector<ReferenceInfo> references;
  for (const std::string_view knob : {kParticleLighting.name, kParticleLight.name})
    references.push_back({.knob = std::string(knob),
                          .kind = "traced",
                          .name = "light at each pixel, with traced shadows",
                          .samples = true,
                          .draw = draw_traced_particles});
  return references;
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/lighting/atlas.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>

#include "modules/particles/emitters/strongest_lights.h"

namespace gloam {
namespace {

/// Copies a map's texels to its place in an atlas of `size`.
template <class Texel>
void place_texels(const std::vector<Texel>& texels, const ParticleLightMap& map, std::uint32_t slice, uvec3 size,
                  std::vector<Texel>& atlas) {
  for (std::size_t z = 0; z < map.size.z; ++z)
    for (std::size_t y = 0; y < map.size.y; ++y) {
      const auto* row = &texels[(z * map.size.y + y) * map.size.x];
      std::copy_n(row, map.size.x, &atlas[((slice + z) * size.y + y) * size.x]);
    }
}

/// A volume of the world with these texels.
template <class Texel>
ImageRef add_volume(FrameBuilder& frame, const char* name, gpu::Format format, uvec3 size, std::uint64_t version,
                    const std::function<std::vector<Texel>()>& texels) {
  gpu::ImageDesc desc;
  desc.name = name;
  desc.module = "particles";
  desc.format = format;
  desc.width = size.x;
  desc.height = size.y;
  desc.depth = size.z;
  desc.shape = gpu::ImageShape::volume;
  desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::transfer_target;
  const auto kept = frame.history_image(
      desc, {.scope = HistoryScope::world, .final_access = gpu::Access::compute_read, .reset = {.key = version}});
  if (!frame.check(kept)) return {};
  if (kept->filled()) return kept->image;
  const std::vector<Texel> content = texels();
  const auto source = frame.upload_items(std::span<const Texel>(content));
  PassBuilder pass = frame.graph().add_pass(std::string(name) + "_upload", frame.module());
  const ImageRef written = pass.write(kept->image, gpu::Access::transfer_write);
  pass.execute([written, source](PassContext& context) {
    context.commands().copy_buffer_to_image(source.buffer, source.offset, context.image(written), 0, 0, 1);
  });
  return written;
}

}  // namespace

AtlasPlan plan_atlas(std::span<const ParticleLightMap> maps) {
  AtlasPlan plan;
  plan.first_slice = first_slices(maps);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const uvec3& size = maps[i].size;
    if (plan.first_slice[i] == kNoSlices) continue;
    plan.size = uvec3(std::max(plan.size.x, size.x), std::max(plan.size.y, size.y), plan.size.z + size.z);
  }
  return plan;
}

BakedLightAtlas add_atlas(FrameBuilder& frame, const ParticleLightMaps& maps, const AtlasPlan& plan) {
  BakedLightAtlas atlas;
  if (plan.size.z == 0) return atlas;
  const std::size_t count = std::size_t{plan.size.x} * plan.size.y * plan.size.z;
  constexpr const char* kNames[3] = {"particle_flux_red", "particle_flux_green", "particle_flux_blue"};
  for (std::size_t channel = 0; channel < 3; ++channel)
    atlas.flux[channel] =
        add_volume<BakedFlux>(frame, kNames[channel], gpu::Format::rgba16_float, plan.size, maps.version, [&] {
          std::vector<BakedFlux> texels(count, BakedFlux{});
          for (std::size_t i = 0; i < maps.maps.size(); ++i)
            if (plan.first_slice[i] != kNoSlices)
              place_texels(maps.maps[i].flux[channel], maps.maps[i], plan.first_slice[i], plan.size, texels);
          return texels;
        });
  atlas.visibility =
      add_volume<BakedVisibility>(frame, "particle_visibility", gpu::Format::rgba8_unorm, plan.size, maps.version, [&] {
        std::vector<BakedVisibility> texels(count, BakedVisibility{255, 255, 255, 255});
        for (std::size_t i = 0; i < maps.maps.size(); ++i)
          if (plan.first_slice[i] != kNoSlices && !maps.maps[i].visibility.empty())
            place_texels(maps.maps[i].visibility, maps.maps[i], plan.first_slice[i], plan.size, texels);
        return texels;
      });
  return atlas;
}

void set_map(const ParticleLightMap& map, std::uint32_t slice, const RenderView& view,
             shaders::ParticleEmitterRow& row) {
  if (slice == kNoSlices) return;
  row.map_slice = static_cast<float>(slice);
  row.map_light_scale = view.light_scale / map.light_scale;
  row.map_from = vec3(map.origin + dvec3(map.box.min) - view.position);
  row.map_size = vec3(map.size);
  row.map_scale = vec3(map.size) / (map.box.max - map.box.min);
}

}  // namespace gloam

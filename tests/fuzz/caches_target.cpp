// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// What gloam keeps in its cache folder, behind the checksums of these files: a checksum does not tell who wrote it.
#include <array>
#include <string>
#include <variant>

#include "engine/core/hash.h"
#include "engine/ecs/world.h"
#include "engine/render/pipelines/pipeline_record.h"
#include "engine/scene/gltf/import.h"
#include "modules/lights/components.h"
#include "modules/module_list/module_list.h"
#include "modules/particles/bake.h"
#include "modules/particles/components.h"
#include "modules/reflections/bake.h"
#include "modules/reflections/components.h"
#include "tests/fuzz/target.h"

namespace gloam::fuzz {
namespace {

/// A world with three proxies, two probes, four lights and two emitters.
struct CachedWorld {
  World world;
  std::vector<Entity> proxies, probes, lights, emitters;

  CachedWorld() {
    prepare_scene_world(world);
    for (const auto& module : make_all_modules()) module->register_components(world);
    for (int i = 0; i < 4; ++i) {
      lights.push_back(world.create(WorldTransform{}, Light{}));
      if (i < 3) proxies.push_back(world.create(WorldTransform{}, IbrProxy{}));
      if (i < 2) probes.push_back(world.create(WorldTransform{}, CubeProbe{}));
      if (i < 2) emitters.push_back(world.create(WorldTransform{}, ParticleEmitter{}));
    }
  }
};

const CachedWorld& cached() {
  static const CachedWorld world;
  return world;
}

std::string layers_fault(const CapturedLayers& layers, std::size_t entities) {
  if (layers.texels.size() != layers.layer_halves() * layers.count) return "layers have another number of texels";
  if (layers.count > 0 && layers.texels.empty()) return "layers have no texels";
  if (entities > layers.count) return "there are fewer layers than entities";
  return {};
}

/// What was read is what was written: every byte has its meaning.
Outcome read_captures(Input input) {
  const World& world = cached().world;
  const auto captures = decode_captures(world, text_of(input));
  if (!captures) return refused();
  for (const auto& [layers, entities] :
       {std::pair{&captures->proxies, &captures->proxy_entities}, {&captures->probes, &captures->probe_entities}})
    if (std::string fault = layers_fault(*layers, entities->size()); !fault.empty()) return broken(std::move(fault));
  return encode_captures(world, *captures) == text_of(input) ? accepted() : broken("other bytes are written");
}

std::vector<Bytes> captures_seeds() {
  const CachedWorld& in = cached();
  ReflectionCaptures all;
  all.content = 0x123456789abcdef0;
  all.light_scale = 0.0625f;
  all.proxies = {4, 3, 3, {}};
  all.proxies.texels.resize(3 * all.proxies.layer_halves(), 0x3c00);
  all.proxy_entities = {in.proxies[0], in.proxies[2]};
  all.proxy_parts.resize(2);
  all.proxy_parts[1].emission = 2;
  all.proxy_parts[1].lamps_lux = {vec3(1.0f), vec3(2.0f)};
  all.proxy_lights = {{0, in.lights[1], 1.0f}, {1, in.lights[0], 0.25f}, {1, in.lights[3], 0.75f}};
  all.probes = {8, 1, 1, std::vector<std::uint16_t>(8 * 8 * 4, 7)};
  all.probe_entities = {in.probes[1]};
  all.probe_parts.resize(1);
  all.probe_parts[0].surfaces.resize(4);
  all.probe_diffuse.resize(1);
  all.grid.resize(2);
  for (const Entity light : in.lights) all.lights.push_back({light, vec3(1.5f, 2.0f, 3.0f)});
  ReflectionCaptures few;
  few.lights.push_back({in.lights[2], vec3(1.0f)});
  return {bytes_of(encode_captures(in.world, all)), bytes_of(encode_captures(in.world, few))};
}

Outcome read_particle_light(Input input) {
  const World& world = cached().world;
  const auto maps = decode_particle_light(world, text_of(input));
  if (!maps) return refused();
  for (const ParticleLightMap& map : maps->maps) {
    for (const auto& channel : map.flux)
      if (channel.size() != map.texels()) return broken("a map has another number of texels");
    if (!map.lights.empty() && map.visibility.size() != map.texels()) return broken("visibility has other texels");
    if (map.lights.size() > kBakedLights) return broken("a map has too many lights");
  }
  return encode_particle_light(world, *maps) == text_of(input) ? accepted() : broken("other bytes are written");
}

std::vector<Bytes> particle_seeds() {
  const CachedWorld& in = cached();
  ParticleLightMaps maps;
  for (const Entity emitter : in.emitters) {
    ParticleLightMap& map = maps.maps.emplace_back();
    map.emitter = emitter;
    map.box.min = vec3(-1.0f);
    map.box.max = vec3(1.0f);
    map.size = uvec3(2, 1, 3);
    for (auto& channel : map.flux) channel.assign(map.texels(), {0, 0, 0x3c00, 0x3c00});
  }
  maps.maps[0].static_lights = {in.lights[0], in.lights[2]};
  maps.maps[1].lights = {in.lights[1]};
  maps.maps[1].visibility.assign(maps.maps[1].texels(), {255, 0, 0, 0});
  return {bytes_of(encode_particle_light(in.world, maps)), bytes_of(encode_particle_light(in.world, {}))};
}

constexpr std::array<std::uint32_t, 3> kOneWords = {1, 2, 3}, kTwoWords = {4, 5, 6};
constexpr gpu::ShaderCode kOne{"test/one.comp", kOneWords}, kTwo{"test/two.vert", kTwoWords};
constexpr std::array<const gpu::ShaderCode*, 2> kShaders = {&kOne, &kTwo};

std::string record_fault(const PipelineList& list) {
  const auto in_range = [](auto value, auto last) { return value <= last; };
  for (const auto& any : list) {
    if (!std::holds_alternative<gpu::GraphicsPipelineDesc>(any)) continue;
    const auto& desc = std::get<gpu::GraphicsPipelineDesc>(any);
    bool sound = in_range(desc.cull, gpu::CullMode::back) && in_range(desc.depth_format, gpu::Format::d32_float) &&
                 in_range(desc.blend, gpu::BlendMode::premultiplied_over) &&
                 in_range(desc.depth_compare, gpu::CompareOp::always);
    for (const gpu::Format format : desc.color_formats) sound = sound && in_range(format, gpu::Format::d32_float);
    for (const gpu::VertexAttribute& a : desc.attributes) sound = sound && in_range(a.format, gpu::Format::d32_float);
    if (!sound) return "a number is no value of its type";
  }
  return {};
}

/// The body of a record, below a line with the right checksum.
Outcome read_pipelines(Input input) {
  const std::string body(text_of(input));
  const std::uint64_t checksum = hash_bytes(std::as_bytes(std::span(body)));
  PipelineNames names, other_names;
  const std::string record = R"({"pipelines":1,"checksum":)" + std::to_string(checksum) + "}\n" + body;
  const PipelineList list = parse_pipeline_record(record, kShaders, names);
  if (list.empty()) return refused();
  if (std::string fault = record_fault(list); !fault.empty()) return broken(std::move(fault));
  const std::string again = pipeline_record(list);
  if (pipeline_record(parse_pipeline_record(again, kShaders, other_names)) != again)
    return broken("other pipelines are read again");
  return accepted();
}

std::vector<Bytes> pipeline_seeds() {
  gpu::ComputePipelineDesc compute;
  compute.module = "lights";
  compute.shader = kOne;
  compute.constants = {{"kScale", 0.5f}, {"kOn", true}, {"kSide", -3}};
  compute.constants.set_if_present("kSteps", 7u);
  gpu::GraphicsPipelineDesc graphics;
  graphics.name = "posts";
  graphics.vertex = kTwo;
  graphics.fragment = kOne;
  graphics.attributes = {{0, 0, gpu::Format::rgb32_float, 0}, {2, 1, gpu::Format::rg16_float, 8}};
  graphics.stream_strides = {12, 16};
  graphics.color_formats = {gpu::Format::rgba16_float};
  graphics.depth_format = gpu::Format::d32_float;
  const std::string record = pipeline_record({compute, graphics});
  return {bytes_of(record.substr(record.find('\n') + 1))};
}

std::vector<std::string> pipeline_words() {
  return with_json_signs({"255", "256", "4294967295", "1e99", "\"shader\"", "\"vertex\"", "\"fragment\"",
                          "\"constants\"", "\"test/one.comp\"", "\"test/two.vert\"", "\"name\""});
}

}  // namespace

Target caches_target() {
  return {"caches",
          {{"captures", read_captures, captures_seeds},
           {"particle light", read_particle_light, particle_seeds},
           {"pipelines", read_pipelines, pipeline_seeds, pipeline_words}}};
}

}  // namespace gloam::fuzz

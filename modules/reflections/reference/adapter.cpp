// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reference/adapter.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <utility>

namespace gloam {
namespace {

struct StoredHeader {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t samples = 0;
  std::uint32_t reserved = 0;
  std::uint64_t version = 0;
};

Error cannot_redraw() { return {ErrorKind::usage, "traced reflections need a frame that can be drawn again"}; }

}  // namespace

std::string to_bytes(const TracedPixels& traced) {
  const StoredHeader header = {
      .width = traced.width, .height = traced.height, .samples = traced.samples, .version = traced.version};
  std::string bytes(reinterpret_cast<const char*>(&header), sizeof(header));
  bytes.append(reinterpret_cast<const char*>(traced.radiance.data()), traced.radiance.size() * sizeof(float));
  return bytes;
}

std::optional<TracedReflections> reflections_from_bytes(std::string_view bytes) {
  StoredHeader header;
  if (bytes.size() < sizeof(header)) return std::nullopt;
  std::memcpy(&header, bytes.data(), sizeof(header));
  bytes.remove_prefix(sizeof(header));
  TracedReflections traced;
  traced.width = header.width;
  traced.height = header.height;
  traced.samples = header.samples;
  traced.version = header.version;
  if (bytes.size() / (4 * sizeof(float)) != traced.pixels() || bytes.size() % (4 * sizeof(float)) != 0)
    return std::nullopt;
  traced.radiance.resize(4 * traced.pixels());
  if (!bytes.empty()) std::memcpy(traced.radiance.data(), bytes.data(), bytes.size());
  return traced;
}

Result<TracedReflections> find_reflections(const ReferenceInput& input, const ReflectionTracing& settings) {
  if (input.tracer == nullptr || input.geometry == nullptr)
    return Error{ErrorKind::usage, "traced reflections need the scene's triangles and the frame's geometry"};
  RadianceInput what = {.world = input.world,
                        .geometry = *input.geometry,
                        .tracer = *input.tracer,
                        .executor = input.executor,
                        .settings = settings,
                        .progress = input.progress};
  what.settings.rays = std::max(input.samples, 1u);
  if (input.store == nullptr) return trace_radiance(what);
  const std::string identity = radiance_identity(what);
  if (const std::optional<std::string> kept = input.store->load(identity))
    if (std::optional<TracedReflections> traced = reflections_from_bytes(*kept)) return std::move(*traced);
  TracedReflections traced = trace_radiance(what);
  GLOAM_TRY(input.store->save(identity, to_bytes(traced)));
  return traced;
}

Result<LinearPicture> trace_reflections(const ReferenceInput& input, const ReflectionTracing& settings) {
  if (!input.redraw) return cannot_redraw();
  const auto traced = find_reflections(input, settings);
  if (!traced) return traced.error();
  const auto base = input.redraw([](World& world) { world.set_resource(ReflectionOverride::no_specular); },
                                 [](World& world) { world.remove_resource<ReflectionOverride>(); });
  if (!base) return base.error();
  return compose_reflections(base->linear, *input.geometry, input.world, *traced);
}

Result<FramePictures> draw_traced_reflections(const ReferenceInput& input, const ReflectionTracing& settings) {
  if (!input.redraw) return cannot_redraw();
  auto traced = find_reflections(input, settings);
  if (!traced) return traced.error();
  const auto shared = std::make_shared<TracedReflections>(std::move(traced).value());
  return input.redraw([shared](World& world) { world.set_resource(std::move(*shared)); },
                      [](World& world) { world.remove_resource<TracedReflections>(); });
}

Status put_traced_reflections(World& world, const ReferenceInput& input, const ExtrasOf& extras) {
  const ReflectionExtras with = extras ? extras(world) : ReflectionExtras{};
  auto traced = find_reflections(input, {.fog = with.fog, .quads = with.fires.quads});
  if (!traced) return traced.error();
  world.set_resource(std::move(traced).value());
  return {};
}

ReferenceInfo traced_reflections(std::string knob, bool composed, ExtrasOf extras) {
  ReferenceInfo info = {.knob = std::move(knob), .kind = "traced", .name = "reflections, traced", .samples = true};
  info.draw = [composed, extras = std::move(extras)](const ReferenceInput& input) -> Result<FramePictures> {
    const ReflectionExtras with = extras ? extras(input.world) : ReflectionExtras{};
    const ReflectionTracing settings = {.fog = with.fog, .quads = with.fires.quads};
    if (!composed) return draw_traced_reflections(input, settings);
    auto linear = trace_reflections(input, settings);
    if (!linear) return linear.error();
    return FramePictures{.linear = std::move(linear).value(), .picture = {}};
  };
  return info;
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/reference/adapter.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>

#include "modules/shadows/knobs.h"
#include "modules/shadows/outputs.h"

namespace gloam {
namespace {

template <class T>
void append_items(std::string& bytes, const std::vector<T>& items) {
  const std::uint64_t count = items.size();
  bytes.append(reinterpret_cast<const char*>(&count), sizeof(count));
  bytes.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T));
}

/// Moves `size` bytes from the front of `bytes` to target; false when too few are left.
bool take_bytes(std::string_view& bytes, void* target, std::size_t size) {
  if (bytes.size() < size) return false;
  if (size > 0) std::memcpy(target, bytes.data(), size);
  bytes.remove_prefix(size);
  return true;
}

template <class T>
bool take_items(std::string_view& bytes, std::vector<T>& items) {
  std::uint64_t count = 0;
  if (!take_bytes(bytes, &count, sizeof(count)) || bytes.size() / sizeof(T) < count) return false;
  items.resize(count);
  return take_bytes(bytes, items.data(), items.size() * sizeof(T));
}

struct Header {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t samples = 0;
  std::uint32_t reserved = 0;
  double noise = 0.0;
  std::uint64_t version = 0;
};

Result<FramePictures> draw_shadow_reference(const ReferenceInput& input) {
  if (!input.redraw) return Error{ErrorKind::usage, "traced shadows need a frame that can be drawn again"};
  auto traced = find_visibility(input);
  if (!traced) return traced.error();
  const auto shared = std::make_shared<TracedVisibility>(std::move(traced).value());
  return input.redraw([shared](World& world) { world.set_resource(std::move(*shared)); },
                      [](World& world) { world.remove_resource<TracedVisibility>(); });
}

}  // namespace

std::string to_bytes(const TracedVisibility& traced) {
  const Header header = {.width = traced.width,
                         .height = traced.height,
                         .samples = traced.samples,
                         .noise = traced.noise,
                         .version = traced.version};
  std::string bytes(reinterpret_cast<const char*>(&header), sizeof(header));
  append_items(bytes, traced.lights);
  append_items(bytes, traced.visibility);
  append_items(bytes, traced.judged);
  return bytes;
}

std::optional<TracedVisibility> visibility_from_bytes(std::string_view bytes) {
  Header header;
  TracedVisibility traced;
  if (!take_bytes(bytes, &header, sizeof(header))) return std::nullopt;
  traced.width = header.width;
  traced.height = header.height;
  traced.samples = header.samples;
  traced.noise = header.noise;
  traced.version = header.version;
  const bool whole = take_items(bytes, traced.lights) && take_items(bytes, traced.visibility) &&
                     take_items(bytes, traced.judged) && bytes.empty() &&
                     traced.visibility.size() == traced.lights.size() * traced.pixels() &&
                     traced.judged.size() == (traced.visibility.size() + 7) / 8;
  if (!whole) return std::nullopt;
  return traced;
}

Result<TracedVisibility> find_visibility(const ReferenceInput& input) {
  if (input.tracer == nullptr || input.geometry == nullptr)
    return Error{ErrorKind::usage, "traced shadows need the scene's triangles and the frame's geometry"};
  const VisibilityInput what = {.world = input.world,
                                .geometry = *input.geometry,
                                .tracer = *input.tracer,
                                .executor = input.executor,
                                .samples = std::max(input.samples, 1u),
                                .progress = input.progress};
  if (input.store == nullptr) return trace_visibility(what);
  const std::string identity = visibility_identity(what);
  if (const std::optional<std::string> kept = input.store->load(identity))
    if (std::optional<TracedVisibility> traced = visibility_from_bytes(*kept)) return std::move(*traced);
  TracedVisibility traced = trace_visibility(what);
  GLOAM_TRY(input.store->save(identity, to_bytes(traced)));
  return traced;
}

Status put_traced_visibility(World& world, const ReferenceInput& input) {
  auto traced = find_visibility(input);
  if (!traced) return traced.error();
  traced->shades = false;
  world.set_resource(std::move(traced).value());
  return {};
}

ReferenceInfo traced_shadows(std::string knob) {
  return {.knob = std::move(knob),
          .kind = "traced",
          .name = "lights with width, traced",
          .samples = true,
          .draw = draw_shadow_reference};
}

std::vector<ReferenceInfo> shadow_references() {
  KnobRegistry registry;
  add_shadow_knobs(registry);
  std::vector<ReferenceInfo> references;
  for (const Knob& knob : registry.knobs()) {
    // The first has a measure (shadow_measures()), the second an exact value.
    if (knob.name == kShadowClassify.name || knob.name == kShadowReuse.name) continue;
    references.push_back(traced_shadows(knob.name));
    references.back().follows_value = knob.name == kShadowTerminator.name;  // rays begin where receivers are judged
  }
  return references;
}

}  // namespace gloam

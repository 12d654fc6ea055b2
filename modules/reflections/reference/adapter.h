// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/render/reference/reference.h"
#include "modules/reflections/override.h"
#include "modules/reflections/reference/fire_quads.h"
#include "modules/reflections/reference/reflection_tracing.h"

namespace gloam {

/// Serialisation for files of the reference store. reflections_from_bytes: none when the bytes are damaged.
[[nodiscard]] std::string to_bytes(const TracedPixels& traced);
[[nodiscard]] std::optional<TracedReflections> reflections_from_bytes(std::string_view bytes);

/// The reflected radiance of the input's frame: from the input's store, or traced and then stored. The input's samples
/// take the place of settings.rays. Usage error when the input has no tracer or no geometry.
[[nodiscard]] Result<TracedReflections> find_reflections(const ReferenceInput& input,
                                                         const ReflectionTracing& settings = {});

/// Linear light of the frame with traced reflections: the frame drawn with ReflectionOverride::no_specular, composed on
/// the CPU; see compose_reflections(). Usage error when the frame cannot be drawn again.
[[nodiscard]] Result<LinearPicture> trace_reflections(const ReferenceInput& input,
                                                      const ReflectionTracing& settings = {});

/// Both pictures of the frame with traced reflections: drawn with TracedReflections in the world, so that fog, blended
/// surfaces, depth of field and the tone curve apply to them. Errors as above.
[[nodiscard]] Result<FramePictures> draw_traced_reflections(const ReferenceInput& input,
                                                            const ReflectionTracing& settings = {});

/// Fog and fire, which reflected rays meet besides surfaces and sky.
struct ReflectionExtras {
  ReflectedFog fog;
  FireQuads fires;
};
/// The extras of a world; may be empty.
using ExtrasOf = std::function<ReflectionExtras(const World&)>;

/// Puts the result of find_reflections() into the world: later frames show it (VisualizerInfo::trace).
[[nodiscard]] Status put_traced_reflections(World& world, const ReferenceInput& input, const ExtrasOf& extras = {});

/// The reference "traced reflections" for a knob of the module. composed: by trace_reflections(); otherwise by
/// draw_traced_reflections().
[[nodiscard]] ReferenceInfo traced_reflections(std::string knob, bool composed, ExtrasOf extras = {});

}  // namespace gloam

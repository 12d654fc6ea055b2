// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/render/reference/reference.h"
#include "modules/shadows/filter/traced_visibility.h"
#include "modules/shadows/reference/visibility_tracing.h"

namespace gloam {

/// Serialisation for files of the reference store. visibility_from_bytes: none when the bytes are damaged.
[[nodiscard]] std::string to_bytes(const TracedVisibility& traced);
[[nodiscard]] std::optional<TracedVisibility> visibility_from_bytes(std::string_view bytes);

/// The visibility of the input's frame: from the input's store, or traced and then stored. Usage error when the input
/// has no tracer or no geometry.
[[nodiscard]] Result<TracedVisibility> find_visibility(const ReferenceInput& input);
/// Puts the result of find_visibility() into the world, for visualizers that show it (VisualizerInfo::trace). Sets
/// `shades` to false, so that shading does not use it.
[[nodiscard]] Status put_traced_visibility(World& world, const ReferenceInput& input);

/// The reference "frame shaded with traced visibility" for each knob of the module but the counted one. No value of
/// them is exact: which one is nearest to traced light depends on the scene.
[[nodiscard]] std::vector<ReferenceInfo> shadow_references();

}  // namespace gloam

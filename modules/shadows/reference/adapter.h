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

/// For files. `from_bytes`: nothing when they are damaged.
[[nodiscard]] std::string to_bytes(const TracedVisibility& traced);
[[nodiscard]] std::optional<TracedVisibility> visibility_from_bytes(std::string_view bytes);

/// Traces, or takes from the input's store. Usage error where the input offers no triangles or no geometry.
[[nodiscard]] Result<TracedVisibility> find_visibility(const ReferenceInput& input);
/// The same into the world, for views that show it (VisualizerInfo::trace): shading leaves it alone.
[[nodiscard]] Status put_traced_visibility(World& world, const ReferenceInput& input);

/// The frame shaded with traced visibility, for every knob of the module.
[[nodiscard]] std::vector<ReferenceInfo> shadow_references();

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "engine/render/module.h"

namespace gloam {

/// Name of the visualizer, and of its pass, that does only the gathers of one local light's filter.
inline constexpr const char* kShadowGathersView = "shadow_gathers";

/// Makes a module for benches. With the visualizer shadow_gathers:LIGHT it adds two passes to a frame. The first
/// computes where the contact-hardening filter gathers at each pixel; the second ("shadow_gathers") only gathers there.
[[nodiscard]] std::unique_ptr<Module> make_shadow_gathers_module();

}  // namespace gloam

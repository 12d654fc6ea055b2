// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "engine/render/module.h"

namespace gloam {

/// Name of the view that draws the bare gathers of one local light's filter, and of the pass that does.
inline constexpr const char* kShadowGathersView = "shadow_gathers";

/// A module of benches: with the view shadow_gathers:LIGHT it adds two passes to a frame. The first finds out where the
/// contact-hardening filter gathers at each pixel, the second ("shadow_gathers") gathers there and does nothing else.
[[nodiscard]] std::unique_ptr<Module> make_shadow_gathers_module();

}  // namespace gloam

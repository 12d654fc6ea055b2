// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include "engine/render/module.h"

namespace host {

/// A module that lights surfaces with a shader of the host. It takes the light lists and visibilities from gloam.
/// bands: number of steps from shadow to light; 0: smooth shadows, which gives gloam's own picture.
[[nodiscard]] std::unique_ptr<gloam::Module> make_own_shading(std::uint32_t bands);

}  // namespace host

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "engine/math/types.h"
#include "engine/render/module.h"

namespace host {

/// Component: mist of uniform density over the whole scene.
struct Veil {
  float density = 0.0f;                      ///< 1/m
  gloam::vec3 radiance = gloam::vec3(0.0f);  ///< cd/m²
};

[[nodiscard]] std::unique_ptr<gloam::Module> make_veil_module();

}  // namespace host

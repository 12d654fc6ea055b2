// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "engine/gpu/types.h"
#include "engine/math/types.h"
#include "engine/render/module.h"

namespace host {

/// Component: mist of uniform density over the whole scene.
struct Veil {
  float density = 0.0f;                    ///< 1/m, which the mist reaches after some seconds
  gloam::vec3 albedo = gloam::vec3(0.9f);  ///< share of the light around that it scatters, 0…1
  float risen = 0.0f;                      ///< 1/m now; the module's system changes it
};

/// surroundings: an image that the host's captures draw into (ViewTarget::light), left ready for compute_read. It must
/// live as long as the module.
[[nodiscard]] std::unique_ptr<gloam::Module> make_veil_module(gloam::gpu::ImageHandle surroundings);

}  // namespace host

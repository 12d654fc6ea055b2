// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "engine/render/declare/shader_pass.h"
#include "modules/lighting/outputs.h"
#include "modules/reflections/frame.h"

namespace gloam {

/// Uploads rows as storage; one default row if there are none, because a binding is never empty.
template <class T>
void bind_rows(ShaderPass& pass, std::string_view binding, std::span<const T> rows) {
  const T none[1] = {};
  pass.items(binding, rows.empty() ? std::span<const T>(none) : rows);
}

/// Binds what shaders/reflections/proxies/changed_light_api.glsl reads.
inline void read_changed_lights(ShaderPass& pass, FrameBuilder& frame, std::span<const shaders::ChangedLight> changed) {
  bind_rows(pass, "changed_lights", changed);
  const DiffuseLightOutput* diffuse = frame.find<DiffuseLightOutput>();
  pass.read("diffuse_light", diffuse != nullptr ? diffuse->light : ImageRef{});
}

}  // namespace gloam

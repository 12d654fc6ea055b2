// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/render/reference/light_picture.h"
#include "engine/render/reference/reference.h"

namespace gloam {

/// World resource: read_linear gives the light before the fog.
struct BareLight {};
/// World resource: light with fog that a reference has computed. It takes the place of the fog's passes.
struct FogPicture : LightPicture {};

/// PassPhase::post of a frame with BareLight: keeps the light before the fog.
void add_bare_light_pass(FrameBuilder& frame);
/// PassPhase::output of that frame: the kept light becomes LitOutput.
void show_bare_light(FrameBuilder& frame);

/// The frame of the input with the fog of fog_reference(), computed from the frame's light before the fog and from the
/// depth of its surfaces. Usage error if the frame cannot be drawn again or its geometry is absent.
[[nodiscard]] Result<FramePictures> draw_fog_reference(const ReferenceInput& input);

/// The references of the module's knobs.
[[nodiscard]] std::vector<ReferenceInfo> fog_references();

}  // namespace gloam

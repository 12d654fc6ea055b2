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

/// The light of fog_reference() and, added to it, the light of lamps that the fog scatters toward the camera
/// (scatter_lamps()), with input.samples shadow rays for each pixel. Usage error if the frame cannot be drawn again or
/// its geometry or triangles are absent.
[[nodiscard]] Result<LinearPicture> march_fog(const ReferenceInput& input);
/// The frame of the input with that light.
[[nodiscard]] Result<FramePictures> draw_marched_fog(const ReferenceInput& input);
/// Puts that light into the world, for the frame that shows it.
[[nodiscard]] Status put_marched_fog(World& world, const ReferenceInput& input);

/// The references of the module's knobs.
[[nodiscard]] std::vector<ReferenceInfo> fog_references();

}  // namespace gloam

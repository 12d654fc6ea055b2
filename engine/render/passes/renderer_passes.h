// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/render/frame_builder.h"
#include "engine/render/host_geometry.h"
#include "engine/render/outputs.h"

/// The renderer's own passes, in the order of declaration. Each reads outputs from the view's board and puts its own
/// there.
namespace gloam {

/// Morphs and skins the vertices of deformed primitives that any view draws or that cast shadows; puts
/// FrameBuilder::Deformed on the shared board. Does nothing if there are none, or if an earlier view has done it.
void add_deform_pass(FrameBuilder& frame);

/// Draws solid surfaces into the geometry buffer; puts GeometryOutputs, with motion if the view has
/// FrameBuilder::previous_instances. host: geometry that is there already, or null. drawn_again: the frame was drawn
/// before, and the host's images are as gloam left them.
void add_geometry_pass(FrameBuilder& frame, const HostGeometry* host = nullptr, bool drawn_again = false);

/// Writes the host's geometry into the images of `outputs`, which it creates.
void add_host_geometry_pass(FrameBuilder& frame, const HostGeometry& host, bool drawn_again, GeometryOutputs& outputs);

/// Writes the motion of sky pixels, if GeometryOutputs has a motion image.
void add_sky_motion_pass(FrameBuilder& frame);

/// Draws where the smooth surfaces of smooth-shaded meshes lie; sets GeometryOutputs::smooth_surfaces. Does nothing if
/// no mesh of the scene is smooth-shaded.
void add_smooth_surface_pass(FrameBuilder& frame);

/// Computes the farthest and nearest depth of each 8×8 tile; sets GeometryOutputs::depth_bounds, which
/// add_geometry_pass has put.
void add_depth_bounds_pass(FrameBuilder& frame);

/// Draws albedo, normal or depth over the picture. `code`: see debug_view.frag.
void add_debug_view_pass(FrameBuilder& frame, std::uint32_t code);

/// Copies linear light to a mip of a layer of the same size, bit for bit. Returns the written version of `to`.
[[nodiscard]] ImageRef add_copy_light_pass(FrameBuilder& frame, ImageRef from, ImageRef to, std::uint32_t mip = 0,
                                           std::uint32_t layer = 0);

}  // namespace gloam

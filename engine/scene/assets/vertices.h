// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/scene/assets.h"

namespace gloam {

/// Makes new vertex i a copy of old vertex sources[i], in every array of the primitive. Does not change the indices.
void gather_vertices(Primitive& primitive, std::span<const std::uint32_t> sources);

/// Drops vertices that no index uses, if there are fewer indices than vertices. Primitives may share one large array.
void drop_unused_vertices(Primitive& primitive);

/// Gives every corner its own vertex with the face's normal (+Y if the triangle has no area). Sets
/// Primitive::flat_shaded.
void make_flat_normals(Primitive& primitive);

/// Scales normals to unit length. A normal without length is replaced by the area-weighted normal of the faces around
/// the vertex, or else by +Y. Returns the number of replaced normals.
std::uint32_t repair_normals(Primitive& primitive);

/// Computes unit tangents from the derivatives of the normal texture's coordinates (transform included), weighted by
/// the angles of the corners. Where the derivatives give no direction, any direction perpendicular to the normal is
/// used. A vertex with mirrored and unmirrored faces is split.
void make_tangents(Primitive& primitive, const TextureSlot& normal_texture);

/// Makes tangents unit length and perpendicular to the normal, and handedness ±1.
void repair_tangents(Primitive& primitive);

}  // namespace gloam

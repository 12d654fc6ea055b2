// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "modules/grass/components.h"
#include "shaders/grass/grass_shared.h"

namespace gloam {

/// Packs a blade of the patch. A root outside the patch's box moves to the box. A blade that is not there is
/// GrassBladeRow{}: its length is 0.
[[nodiscard]] shaders::GrassBladeRow pack_blade_row(const GrassBlade& blade, const GrassPatch& patch);

/// The blade of a row. slot: the row's index. Errors: root, (box size) / 65535 on each axis; normal, 1.5°; yaw, 1/256
/// turn; length and width, half precision; rank, 1/510.
[[nodiscard]] GrassBlade unpack_blade_row(const shaders::GrassBladeRow& row, const GrassPatch& patch,
                                          std::uint32_t slot);

}  // namespace gloam

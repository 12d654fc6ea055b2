// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/frame/transfers/staging.h"
#include "engine/render/frame_builder.h"
#include "modules/grass/components.h"
#include "modules/grass/drawing/blade_images.h"

namespace gloam {

/// Layers of one image in the array of a world. count 0: none, blades have the procedural colours.
struct BladeLayers {
  std::uint32_t first = 0;
  std::uint32_t count = 0;

  /// GrassPatchRow::texture.
  [[nodiscard]] std::uint32_t word() const { return first | count << 16; }
};

/// Images of the blades of a world; a resource of the world. It is empty, and takes no memory, until a surface names
/// one.
struct BladeTextures {
  std::map<std::pair<std::uint32_t, std::uint32_t>, BladeLayers> layers;  ///< by GrassSurface::texture, texture_layers
  std::shared_ptr<const BladeArray> array;                                ///< null: no layers
  std::vector<std::string> faults;                                        ///< one sentence per image that is not used
  std::uint64_t version = 0;                                              ///< of the array
};

/// Loads the images of the world's surfaces, if one of them is not loaded yet. Continues after an error; returns the
/// input error of the first image that cannot be used: blades of its surfaces have the procedural colours.
[[nodiscard]] Status load_blade_textures(World& world);
/// The layers of a surface.
[[nodiscard]] BladeLayers layers_of(const BladeTextures& textures, const GrassSurface& surface);
/// Whether blades of a surface that grows any have an image.
[[nodiscard]] bool has_blade_textures(const World& world);

/// The world's array of layers. Adds the pass that uploads it, when the GPU does not have it. Null if there is none.
[[nodiscard]] ImageRef add_blade_texture_upload(FrameBuilder& frame, Staging& staging);

}  // namespace gloam

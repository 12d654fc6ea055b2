// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/scene/assets.h"

namespace gloam_tinygltf {  // tinygltf, see engine/scene/CMakeLists.txt
struct Material;
}

namespace gloam::gltf {

/// Translates a material whose types the scan has checked. Its texture slots index the file's textures.
/// KHR_materials_transmission is read as thin glass: alpha falls with the factor, and the surface is blended.
/// KHR_materials_unlit is read as a black surface that emits its base colour. Input error: a factor that is not finite
/// as a float. The message holds only the fault, not the place.
[[nodiscard]] Result<Material> read_material(const gloam_tinygltf::Material& source);

/// Whether the material has a texture of KHR_materials_transmission, which read_material ignores.
[[nodiscard]] bool has_transmission_texture(const gloam_tinygltf::Material& source);

}  // namespace gloam::gltf

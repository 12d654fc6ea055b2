// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "modules/grass/field/grow.h"
#include "shaders/grass/grass_shared.h"

namespace gloam {

/// Entities of the last growth; a world resource. Some may have been destroyed since.
struct GrassEntities {
  std::vector<Entity> patches;      ///< by GrassPatch::index
  std::vector<Entity> blades;       ///< patch by patch, masters first
  std::uint64_t field_version = 0;  ///< GrassField::version they were made from
  std::uint64_t field_moves = 0;    ///< GrassField::moves of the patches
};

/// Registers GrassBlade, GrassPatch and the two tags.
void register_grass_components(World& world);

/// Destroys the entities of the earlier growth and creates those of the field: an entity a patch and an entity a blade.
/// A structural change.
void make_blade_entities(World& world, const GrassField& field);

/// Brings the patches' entities to the places of the field's patches, and marks them as changed.
void move_patch_entities(World& world, const GrassField& field);

/// Rows of all blades for the GPU, by slot.
struct GrassBladeRows {
  std::vector<shaders::GrassBladeRow> rows;  ///< 256 a patch; a slot without blade has length 0
  std::uint64_t version = 0;                 ///< changes when rows change
  std::uint64_t field_version = ~0ull;       ///< GrassField::version of the rows
  std::uint64_t structure = 0;               ///< World::structure_version of the rows
  std::size_t blades = 0;                    ///< that had a row
  Tick seen = 0;                             ///< changes up to this tick are in the rows
};

/// Brings the rows up to date with the world's GrassBlade components. Returns whether rows changed. Packs only blocks
/// of blades that were marked as changed; all blades if some were added or destroyed, or if the field is another
/// version.
bool pack_changed_rows(const World& world, const GrassField& field, JobExecutor& jobs, GrassBladeRows& rows);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/field/entities.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "modules/grass/growth/blade_rows.h"

namespace gloam {
namespace {

constexpr std::uint32_t kPatchBlades = GLOAM_GRASS_PATCH_BLADES;

/// Backwards, so that most entities are the last row of their archetype and no other row moves.
void destroy_all(World& world, std::vector<Entity>& entities) {
  for (std::size_t i = entities.size(); i > 0; --i)
    if (world.alive(entities[i - 1])) world.destroy(entities[i - 1]);
  entities.clear();
}

/// Creates one entity a blade, in the order of `blades`, as one range of rows.
template <class Tag>
void create_blades(World& world, std::span<const GrassBlade> blades, std::span<Entity> out) {
  if (blades.empty()) return;
  world.create_bulk(out, GrassBlade{}, Tag{});
  std::ranges::copy(blades, &world.get<GrassBlade>(out.front()));
}

/// Packs the blades that belong to the field.
void pack_blades(std::span<const GrassBlade> blades, const GrassField& field, std::span<shaders::GrassBladeRow> rows) {
  for (const GrassBlade& blade : blades)
    if (blade.slot < rows.size()) rows[blade.slot] = pack_blade_row(blade, field.patches[blade.slot / kPatchBlades]);
}

}  // namespace

void register_grass_components(World& world) {
  world.register_component<GrassBlade>("grass_blade");
  world.register_component<GrassPatch>("grass_patch");
  world.register_component<GrassMasterTag>("grass_master");
  world.register_component<GrassSlaveTag>("grass_slave");
}

void make_blade_entities(World& world, const GrassField& field) {
  if (world.try_resource<GrassEntities>() == nullptr) world.set_resource(GrassEntities{});
  GrassEntities& entities = world.resource<GrassEntities>();
  destroy_all(world, entities.blades);
  destroy_all(world, entities.patches);
  entities.field_version = field.version;
  entities.field_moves = field.moves;
  entities.blades.resize(field.statistics.blades);
  std::size_t next = 0;
  for (const GrassPatch& patch : field.patches) {
    entities.patches.push_back(world.create(patch));
    const std::span<const GrassBlade> blades =
        std::span(field.blades).subspan(std::size_t{patch.index} * kPatchBlades, patch.blades);
    const std::span<Entity> out = std::span(entities.blades).subspan(next, patch.blades);
    create_blades<GrassMasterTag>(world, blades.first(patch.masters), out.first(patch.masters));
    create_blades<GrassSlaveTag>(world, blades.subspan(patch.masters), out.subspan(patch.masters));
    next += patch.blades;
  }
}

void move_patch_entities(World& world, const GrassField& field) {
  GrassEntities& entities = world.resource<GrassEntities>();
  entities.field_moves = field.moves;
  for (std::size_t i = 0; i < entities.patches.size(); ++i) {
    const Entity entity = entities.patches[i];
    GrassPatch* patch = world.alive(entity) ? world.try_get<GrassPatch>(entity) : nullptr;
    if (patch == nullptr || (patch->origin == field.patches[i].origin && patch->turn == field.patches[i].turn))
      continue;
    patch->origin = field.patches[i].origin;
    patch->turn = field.patches[i].turn;
    world.mark_changed<GrassPatch>(entity);
  }
}

bool pack_changed_rows(const World& world, const GrassField& field, JobExecutor& jobs, GrassBladeRows& rows) {
  const View<const GrassBlade> blades(world);
  const std::size_t count = blades.size();
  const bool regrown = rows.field_version != field.version;
  const bool restructured = rows.structure != world.structure_version();
  bool all = regrown || count != rows.blades;
  bool changed = all;
  const Tick since = rows.seen;
  // A destroyed blade is not reported, but without a change of the count another one was then added, which is.
  const auto use = [&](std::span<const GrassBlade> chunk) {
    changed = true;
    if (!restructured && !all) pack_blades(chunk, field, rows.rows);
  };
  rows.seen = blades.changed_since<GrassBlade>(since, use);
  all = all || (restructured && changed);
  if (all) {
    rows.rows.assign(field.patches.size() * kPatchBlades, shaders::GrassBladeRow{});
    blades.parallel_chunks(
        jobs, 4096, [&](std::size_t, std::span<const GrassBlade> chunk) { pack_blades(chunk, field, rows.rows); });
  }
  rows.field_version = field.version;
  rows.structure = world.structure_version();
  rows.blades = count;
  rows.version += changed ? 1 : 0;
  return changed;
}

}  // namespace gloam

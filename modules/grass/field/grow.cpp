// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/field/grow.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

#include "engine/core/hash.h"
#include "modules/grass/field/mesh_surface.h"
#include "modules/grass/growth/patches.h"
#include "modules/grass/growth/scatter.h"

namespace gloam {
namespace {

constexpr std::uint32_t kMostSlaves = 16;  // per master

/// Blade types of all sources in one table of at most 16. Sources with the same file share its types.
class TypeTables {
 public:
  struct Range {
    std::string file;
    std::vector<BladeType> types;
    std::uint32_t first = 0;
  };

  explicit TypeTables(GrassField& field) : field_(field) {}

  /// The index of the file's range.
  [[nodiscard]] std::size_t find_or_add(const std::string& file) {
    for (std::size_t i = 0; i < ranges_.size(); ++i)
      if (ranges_[i].file == file) return i;
    Range range{file, {}, static_cast<std::uint32_t>(field_.types.size())};
    range.types = read(file);
    const std::size_t room = GLOAM_GRASS_TYPES - field_.types.size();
    if (range.types.size() > room) drop(range, room);
    for (std::size_t i = range.first == field_.types.size() ? 0 : range.types.size(); i < range.types.size(); ++i)
      field_.types.push_back(blade_type_row(range.types[i]));
    ranges_.push_back(std::move(range));
    return ranges_.size() - 1;
  }

  [[nodiscard]] const Range& range(std::size_t index) const { return ranges_[index]; }

 private:
  [[nodiscard]] std::vector<BladeType> read(const std::string& file) const {
    if (file.empty()) return builtin_blade_types();
    Result<std::vector<BladeType>> types = read_blade_types(file);
    if (types) return std::move(*types);
    field_.notes.push_back(types.error().message + "; its surfaces use the built-in types");
    return builtin_blade_types();
  }

  /// Keeps the types that there is room for. Without any room the range becomes a copy of the first one.
  void drop(Range& range, std::size_t room) {
    const std::size_t dropped = range.types.size() - room;
    field_.statistics.dropped_types += static_cast<std::uint32_t>(dropped);
    field_.notes.push_back((range.file.empty() ? std::string("built-in blade types") : range.file) + ": " +
                           std::to_string(dropped) + " of " + std::to_string(range.types.size()) +
                           " types are left out, because the scene has more than " + std::to_string(GLOAM_GRASS_TYPES));
    range.types.resize(room);
    if (room > 0) return;
    range.types = ranges_.front().types;
    range.first = ranges_.front().first;
  }

  GrassField& field_;
  std::vector<Range> ranges_;
};

/// A surface with its count of blades before the limit.
struct PlannedSurface {
  const GrassSource* source = nullptr;
  GrowthSurface growth;
  double wanted = 0.0;
};

std::vector<PlannedSurface> plan_surfaces(std::span<const GrassSource> sources, float density_scale,
                                          GrassStatistics& statistics) {
  std::vector<PlannedSurface> planned;
  for (const GrassSource& source : sources) {
    const double density = double{source.surface.density} * density_scale;
    if (!(density > 0.0) || !std::isfinite(density) || source.mesh == nullptr) continue;
    PlannedSurface surface{&source, growth_surface(*source.mesh, source.world_from_mesh)};
    surface.wanted = std::round(density * surface.growth.area_m2);
    if (!std::isfinite(surface.wanted)) surface.wanted = 0.0;
    ++statistics.surfaces;
    statistics.triangles += static_cast<std::uint32_t>(surface.growth.triangles.size());
    statistics.area_m2 += surface.growth.area_m2;
    statistics.refused_faces += surface.growth.refused_faces;
    statistics.degenerate_faces += surface.growth.degenerate_faces;
    statistics.non_finite_faces += surface.growth.non_finite_faces;
    statistics.wanted_blades += surface.wanted;
    planned.push_back(std::move(surface));
  }
  return planned;
}

void add_bits(Hasher& hasher, float value) { hasher.value(std::bit_cast<std::uint32_t>(value)); }

std::uint64_t key_of(std::span<const GrassSource> sources, std::span<const std::uint32_t> meshes,
                     const SceneAssets& assets, const GrassGrowthSettings& settings) {
  Hasher hasher;
  hasher.value(assets.version).value(settings.slaves_per_master).value(settings.max_blades);
  add_bits(hasher, settings.density_scale);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const GrassSource& source = sources[i];
    hasher.value(source.entity.index).value(source.entity.generation).value(meshes[i]);
    hasher.value(assets.revision(AssetKind::mesh, meshes[i])).value(source.surface.seed);
    hasher.text(source.types_file);
    for (const float value : {source.surface.density, source.surface.height_m.x, source.surface.height_m.y,
                              source.surface.width_m, source.surface.max_distance_m})
      add_bits(hasher, value);
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 3; ++row) hasher.value(std::bit_cast<std::uint64_t>(source.world_from_mesh[column][row]));
  }
  return hasher.digest();
}

}  // namespace

void grow_grass(std::span<const GrassSource> sources, const GrassGrowthSettings& settings, JobExecutor& jobs,
                GrassField& field) {
  field.patches.clear();
  field.blades.clear();
  field.types.clear();
  field.notes.clear();
  field.statistics = {};
  ++field.version;
  GrassStatistics& statistics = field.statistics;
  const std::vector<PlannedSurface> planned = plan_surfaces(sources, settings.density_scale, statistics);
  const std::uint32_t most = std::min(settings.max_blades, kMostGrassBlades);
  const bool limited = statistics.wanted_blades > most;
  if (limited)
    field.notes.push_back("the surfaces call for " +
                          std::to_string(static_cast<std::uint64_t>(std::min(statistics.wanted_blades, 1e18))) +
                          " blades; the density is scaled down to " + std::to_string(most) + " in all");
  TypeTables tables(field);
  for (const PlannedSurface& surface : planned) {
    const double scaled = limited ? std::floor(surface.wanted / statistics.wanted_blades * most) : surface.wanted;
    const GrassSource& source = *surface.source;
    const std::vector<ScatteredRoot> roots =
        scatter_roots(surface.growth, static_cast<std::uint32_t>(scaled), source.surface.seed, jobs);
    if (roots.empty()) continue;
    const TypeTables::Range& types = tables.range(tables.find_or_add(source.types_file));
    const PatchSource patches{source.entity, source.surface, types.types, types.first,
                              std::min(settings.slaves_per_master, kMostSlaves)};
    append_patches(surface.growth, roots, patches, jobs, field.patches, field.blades);
  }
  for (const GrassPatch& patch : field.patches) {
    statistics.blades += patch.blades;
    statistics.masters += patch.masters;
  }
}

void grass_growth_system(View<const GrassSurface, const MeshInstance, const WorldTransform> surfaces,
                         Resource<const SceneAssets> assets, Resource<const SceneStrings> strings,
                         Resource<const GrassGrowthSettings> settings, Resource<GrassField> field, JobExecutor& jobs) {
  std::vector<std::pair<GrassSource, std::uint32_t>> found;
  surfaces.each(
      [&](Entity entity, const GrassSurface& surface, const MeshInstance& instance, const WorldTransform& transform) {
        const Mesh* mesh = instance.mesh < assets->meshes.size() ? &assets->meshes[instance.mesh] : nullptr;
        if (!(surface.density > 0.0f) || mesh == nullptr) return;
        found.push_back({{entity, surface, mesh, transform.matrix, strings->text(surface.types)}, instance.mesh});
      });
  std::ranges::sort(found, {}, [](const auto& f) { return f.first.entity.index; });
  std::vector<GrassSource> sources;
  std::vector<std::uint32_t> meshes;
  for (auto& [source, mesh] : found) {
    sources.push_back(std::move(source));
    meshes.push_back(mesh);
  }
  const std::uint64_t key = key_of(sources, meshes, *assets, *settings);
  if (field->version != 0 && field->key == key) return;
  grow_grass(sources, *settings, jobs, *field);
  field->key = key;
}

}  // namespace gloam

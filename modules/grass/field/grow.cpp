// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/field/grow.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <optional>
#include <utility>

#include "engine/core/hash.h"
#include "modules/grass/field/mesh_surface.h"
#include "modules/grass/field/metres.h"
#include "modules/grass/growth/patches.h"
#include "modules/grass/growth/scatter.h"

namespace gloam {
namespace {

constexpr std::uint32_t kMostSlaves = 16;  // per master
constexpr std::size_t kPatchSlots = GLOAM_GRASS_PATCH_BLADES;

/// Blade types of all sources in one table of at most 16. Sources with the same file and damping share its types.
class TypeTables {
 public:
  struct Range {
    std::string file;
    float damping = 0.0f;
    std::vector<BladeType> types;
    std::uint32_t first = 0;
  };

  explicit TypeTables(GrassField& field) : field_(field) {}

  /// The index of the range of the file with this damping.
  [[nodiscard]] std::size_t find_or_add(const std::string& file, float damping) {
    for (std::size_t i = 0; i < ranges_.size(); ++i)
      if (ranges_[i].file == file && ranges_[i].damping == damping) return i;
    Range range{file, damping, {}, static_cast<std::uint32_t>(field_.types.size())};
    range.types = read(file);
    const std::size_t room = GLOAM_GRASS_TYPES - field_.types.size();
    if (range.types.size() > room) drop(range, room);
    for (std::size_t i = range.first == field_.types.size() ? 0 : range.types.size(); i < range.types.size(); ++i)
      field_.types.push_back(blade_type_row(range.types[i], damping));
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
  const GrassPlanting* kept = nullptr;  ///< of the field before, if its blades may stay
  std::optional<GrowthSurface> growth;  ///< made when it is needed
  GrassStatistics statistics;

  [[nodiscard]] const GrowthSurface& surface() {
    if (!growth) growth = growth_surface(*source->mesh, source->world_from_mesh);
    return *growth;
  }
};

GrassStatistics statistics_of(const GrowthSurface& growth, double density) {
  GrassStatistics statistics;
  statistics.surfaces = 1;
  statistics.triangles = static_cast<std::uint32_t>(growth.triangles.size());
  statistics.area_m2 = growth.area_m2;
  statistics.refused_faces = growth.refused_faces;
  statistics.degenerate_faces = growth.degenerate_faces;
  statistics.non_finite_faces = growth.non_finite_faces;
  const double wanted = std::round(density * growth.area_m2);
  statistics.wanted_blades = std::isfinite(wanted) ? wanted : 0.0;
  return statistics;
}

void add_to(GrassStatistics& sum, const GrassStatistics& one) {
  sum.surfaces += one.surfaces;
  sum.triangles += one.triangles;
  sum.area_m2 += one.area_m2;
  sum.refused_faces += one.refused_faces;
  sum.degenerate_faces += one.degenerate_faces;
  sum.non_finite_faces += one.non_finite_faces;
  sum.wanted_blades += one.wanted_blades;
}

const GrassPlanting* find_kept(const GrassField& field, const GrassSource& source) {
  if (source.key == 0) return nullptr;
  for (const GrassPlanting& planting : field.plantings)
    if (planting.entity == source.entity && planting.key == source.key &&
        carried_ground(planting.planted, source.world_from_mesh))
      return &planting;
  return nullptr;
}

std::vector<PlannedSurface> plan_surfaces(std::span<const GrassSource> sources, float density_scale,
                                          const GrassField& before, GrassStatistics& statistics) {
  std::vector<PlannedSurface> planned;
  for (const GrassSource& source : sources) {
    const double density = double{source.surface.density} * density_scale;
    if (!(density > 0.0) || !std::isfinite(density) || source.mesh == nullptr) continue;
    PlannedSurface surface{.source = &source, .kept = find_kept(before, source), .growth = {}, .statistics = {}};
    surface.statistics = surface.kept != nullptr ? surface.kept->statistics : statistics_of(surface.surface(), density);
    add_to(statistics, surface.statistics);
    planned.push_back(std::move(surface));
  }
  return planned;
}

/// Appends the patches of an earlier field; their indices and slots change.
void keep_patches(const GrassField& before, const GrassPlanting& kept, GrassField& field) {
  const std::size_t first = field.patches.size();
  for (std::size_t i = 0; i < kept.origins.size(); ++i) {
    const std::size_t old = kept.first_patch + i;
    field.patches.push_back(before.patches[old]);
    field.patches.back().index = static_cast<std::uint32_t>(first + i);
    field.motions.push_back(before.motions[old]);
    for (std::size_t s = 0; s < kPatchSlots; ++s) {
      GrassBlade blade = before.blades[old * kPatchSlots + s];
      blade.slot = static_cast<std::uint32_t>((first + i) * kPatchSlots + s);
      blade.master = static_cast<std::uint32_t>((first + i) * kPatchSlots + blade.master % kPatchSlots);
      field.blades.push_back(blade);
    }
  }
}

void add_bits(Hasher& hasher, float value) { hasher.value(std::bit_cast<std::uint32_t>(value)); }

/// Hash of what one surface grows of, but for its pose.
std::uint64_t key_of(const GrassSource& source, std::uint32_t mesh, const SceneAssets& assets,
                     const GrassGrowthSettings& settings) {
  Hasher hasher;
  hasher.value(assets.version).value(settings.slaves_per_master);
  add_bits(hasher, settings.density_scale);
  hasher.value(source.entity.index).value(source.entity.generation).value(mesh);
  hasher.value(assets.revision(AssetKind::mesh, mesh)).value(source.surface.seed);
  hasher.text(source.types_file);
  hasher.value(std::bit_cast<std::uint64_t>(settings.metres_per_unit));
  for (const float value : {source.surface.density, source.surface.height_m.x, source.surface.height_m.y,
                            source.surface.width_m, source.surface.damping, source.surface.max_distance_m})
    add_bits(hasher, value);
  return hasher.digest();
}

/// Plants one surface, or keeps its blades.
void plant(PlannedSurface& surface, std::uint32_t asked, const GrassGrowthSettings& settings, JobExecutor& jobs,
           const GrassField& before, TypeTables& tables, GrassField& field) {
  const GrassSource& source = *surface.source;
  GrassPlanting planting;
  planting.entity = source.entity;
  planting.key = source.key;
  planting.asked = asked;
  planting.first_patch = static_cast<std::uint32_t>(field.patches.size());
  planting.statistics = surface.statistics;
  planting.planted = planting.now = source.world_from_mesh;
  std::vector<ScatteredRoot> roots;
  if (surface.kept == nullptr || surface.kept->asked != asked) {
    roots = scatter_roots(surface.surface(), asked, source.surface.seed, jobs);
    surface.kept = nullptr;
  }
  const bool empty = surface.kept != nullptr ? surface.kept->origins.empty() : roots.empty();
  if (empty) {
    field.plantings.push_back(std::move(planting));
    return;
  }
  const TypeTables::Range& types = tables.range(tables.find_or_add(source.types_file, source.surface.damping));
  planting.first_type = types.first;
  planting.type_count = static_cast<std::uint32_t>(types.types.size());
  const GrassPlanting* kept = surface.kept;
  if (kept != nullptr && kept->first_type == planting.first_type && kept->type_count == planting.type_count) {
    keep_patches(before, *kept, field);
    planting.number = kept->number;
    planting.planted = kept->planted;
    planting.now = kept->now;
    planting.moving = kept->moving;
    planting.origins = kept->origins;
    field.plantings.push_back(std::move(planting));
    return;
  }
  if (roots.empty()) roots = scatter_roots(surface.surface(), asked, source.surface.seed, jobs);
  const PatchSource patches{source.entity, source.surface, types.types, types.first,
                            std::min(settings.slaves_per_master, kMostSlaves)};
  append_patches(surface.surface(), roots, patches, jobs, field.patches, field.blades);
  field.motions.resize(field.patches.size());
  planting.number = ++field.growths;
  for (std::size_t i = planting.first_patch; i < field.patches.size(); ++i)
    planting.origins.push_back(field.patches[i].origin);
  field.plantings.push_back(std::move(planting));
}

/// Bit for bit, so that a pose that is not a number is grown once and not in every frame.
bool same_pose(const dmat4& a, const dmat4& b) { return std::memcmp(&a, &b, sizeof(a)) == 0; }

/// Takes the poses of the sources, one for each planting. Returns whether a patch moved.
bool move_plantings(std::span<const GrassSource> sources, double time_s, GrassField& field) {
  bool moved = false;
  const double dt_s = time_s - field.time_s;
  field.time_s = time_s;
  for (std::size_t i = 0; i < field.plantings.size(); ++i) {
    GrassPlanting& planting = field.plantings[i];
    const dmat4& now = sources[i].world_from_mesh;
    const bool moves = !same_pose(now, planting.now);
    if (!moves && !planting.moving) continue;
    const std::size_t count = planting.origins.size();
    const auto ground = carried_ground(planting.planted, now);
    if (!ground) continue;
    planting.moving =
        carry_patches(*ground, planting.origins, dt_s, std::span(field.patches).subspan(planting.first_patch, count),
                      std::span(field.motions).subspan(planting.first_patch, count));
    planting.now = now;
    moved = moved || count > 0;
  }
  return moved;
}

/// Scene time went back: surfaces that are not where they were planted are planted anew, so that a repeated sequence of
/// frames shows the same pictures.
void start_again(std::span<const GrassSource> sources, double time_s, GrassField& field) {
  field.time_s = time_s;
  for (std::size_t i = 0; i < field.plantings.size(); ++i) {
    GrassPlanting& planting = field.plantings[i];
    if (i >= sources.size() || !same_pose(planting.planted, sources[i].world_from_mesh)) planting.key = 0;
  }
  for (GrassPatchMotion& motion : field.motions) motion.velocity = dvec3(0.0);
}

/// Whether the field's plantings are those of the sources, and can follow them.
bool can_follow(std::span<const GrassSource> sources, const GrassField& field) {
  if (field.plantings.size() != sources.size()) return false;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const GrassPlanting& planting = field.plantings[i];
    if (planting.entity != sources[i].entity || planting.key != sources[i].key) return false;
    const dmat4& now = sources[i].world_from_mesh;
    if (!same_pose(planting.now, now) && !carried_ground(planting.planted, now)) return false;
  }
  return true;
}

}  // namespace

void grow_grass(std::span<const GrassSource> sources, const GrassGrowthSettings& settings, JobExecutor& jobs,
                GrassField& field) {
  GrassField before = std::exchange(field, {});
  field.key = before.key;
  field.version = before.version + 1;
  field.moves = before.moves;
  field.growths = before.growths;
  field.time_s = before.time_s;
  GrassStatistics& statistics = field.statistics;
  std::vector<PlannedSurface> planned = plan_surfaces(sources, settings.density_scale, before, statistics);
  const std::uint32_t most = std::min(settings.max_blades, kMostGrassBlades);
  const bool limited = statistics.wanted_blades > most;
  if (limited)
    field.notes.push_back("the surfaces call for " +
                          std::to_string(static_cast<std::uint64_t>(std::min(statistics.wanted_blades, 1e18))) +
                          " blades; the density is scaled down to " + std::to_string(most) + " in all");
  TypeTables tables(field);
  for (PlannedSurface& surface : planned) {
    const double wanted = surface.statistics.wanted_blades;
    const double scaled = limited ? std::floor(wanted / statistics.wanted_blades * most) : wanted;
    plant(surface, static_cast<std::uint32_t>(scaled), settings, jobs, before, tables, field);
  }
  for (const GrassPatch& patch : field.patches) {
    statistics.blades += patch.blades;
    statistics.masters += patch.masters;
  }
}

void grass_growth_system(View<const GrassSurface, const MeshInstance, const WorldTransform> surfaces,
                         Resource<const SceneAssets> assets, Resource<const SceneStrings> strings,
                         Resource<const SceneClock> clock, Resource<const GrassGrowthSettings> settings,
                         Resource<GrassField> field, JobExecutor& jobs) {
  std::vector<GrassSource> sources;
  surfaces.each(
      [&](Entity entity, const GrassSurface& surface, const MeshInstance& instance, const WorldTransform& transform) {
        const Mesh* mesh = instance.mesh < assets->meshes.size() ? &assets->meshes[instance.mesh] : nullptr;
        const double density = double{surface.density} * settings->density_scale;
        if (!(density > 0.0) || !std::isfinite(density) || mesh == nullptr) return;
        const dmat4 metric = metric_matrix(transform.matrix, settings->metres_per_unit);
        GrassSource source{entity, surface, mesh, metric, strings->text(surface.types), 0};
        source.key = key_of(source, instance.mesh, *assets, *settings);
        sources.push_back(std::move(source));
      });
  std::ranges::sort(sources, {}, [](const GrassSource& source) { return source.entity.index; });
  Hasher hasher;
  hasher.value(settings->max_blades);
  add_bits(hasher, settings->density_scale);
  for (const GrassSource& source : sources) hasher.value(source.key);
  const std::uint64_t key = hasher.digest();
  if (clock->time_s < field->time_s) start_again(sources, clock->time_s, *field);
  if (field->version == 0 || field->key != key || !can_follow(sources, *field)) {
    grow_grass(sources, *settings, jobs, *field);
    field->key = key;
  }
  if (move_plantings(sources, clock->time_s, *field)) ++field->moves;
}

}  // namespace gloam

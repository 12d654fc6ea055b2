// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/jobs/executor.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "engine/schedule/parameters.h"
#include "modules/grass/components.h"
#include "modules/grass/field/planting.h"
#include "modules/grass/growth/blade_types.h"
#include "shaders/grass/grass_shared.h"

namespace gloam {

/// Most blades of a field, for all settings.
inline constexpr std::uint32_t kMostGrassBlades = 1u << 24;

/// Settings of the growth; a world resource.
struct GrassGrowthSettings {
  std::uint32_t slaves_per_master = 4;  ///< 0: every blade is a master
  float density_scale = 1.0f;           ///< factor on GrassSurface::density
  std::uint32_t max_blades = 1u << 23;  ///< at most kMostGrassBlades; the default fits WorldLimits' default
  double metres_per_unit = 1.0;         ///< of SceneUnits; > 0
};

/// Counts of one growth.
struct GrassStatistics {
  std::uint32_t surfaces = 0;   ///< with a density above 0
  std::uint32_t triangles = 0;  ///< upward-facing
  double area_m2 = 0.0;
  std::uint32_t blades = 0;
  std::uint32_t masters = 0;
  double wanted_blades = 0.0;          ///< density times area; above `blades` if max_blades was reached
  std::uint32_t refused_faces = 0;     ///< non-manifold
  std::uint32_t degenerate_faces = 0;  ///< no area
  std::uint32_t non_finite_faces = 0;
  std::uint32_t dropped_types = 0;  ///< beyond 16
};

/// The blades of one surface in a field.
struct GrassPlanting {
  Entity entity;
  std::uint64_t key = 0;         ///< hash of all inputs but the pose of the ground
  std::uint64_t number = 0;      ///< of the growth: another one when the surface is planted anew
  std::uint32_t asked = 0;       ///< blades to grow, after the limit of all blades
  std::uint32_t first_type = 0;  ///< in GrassField::types
  std::uint32_t type_count = 0;
  std::uint32_t first_patch = 0;  ///< in GrassField::patches
  dmat4 planted = dmat4(1.0);     ///< world in metres from mesh, when it was planted
  dmat4 now = dmat4(1.0);
  bool moving = false;           ///< GrassField::motions may differ from rest
  std::vector<dvec3> origins;    ///< of its patches, when they were planted
  GrassStatistics statistics{};  ///< of the surface; blades and masters stay 0
};

/// The grown blades; a world resource.
struct GrassField {
  std::vector<GrassPatch> patches;           ///< patches[i].index is i
  std::vector<GrassPatchMotion> motions;     ///< of the patches
  std::vector<GrassBlade> blades;            ///< 256 slots a patch; empty slots have length 0
  std::vector<shaders::GrassTypeRow> types;  ///< of all surfaces, at most 16
  std::vector<GrassPlanting> plantings;      ///< one a surface, in the order of their patches
  GrassStatistics statistics;
  std::vector<std::string> notes;  ///< one sentence per input that was not taken as it is: a bad file, a limit
  std::uint64_t key = 0;           ///< hash of the inputs but the poses of the surfaces
  std::uint64_t version = 0;       ///< changes when a surface is planted anew, appears or disappears
  std::uint64_t moves = 0;         ///< changes when a patch has moved with its ground
  std::uint64_t growths = 0;       ///< surfaces grown so far
  double time_s = 0.0;             ///< of the scene when the poses were last taken
};

/// One surface to grow. Surfaces are grown in their order.
struct GrassSource {
  Entity entity;
  GrassSurface surface;
  const Mesh* mesh = nullptr;
  dmat4 world_from_mesh = dmat4(1.0);  ///< the world in metres
  std::string types_file;              ///< path; empty: the built-in types
  std::uint64_t key = 0;               ///< hash of all inputs but world_from_mesh; 0: unknown, it is always grown anew
};

/// Grows the field from these sources and increments its version. The field's key stays. A surface that the field has
/// already, with the same key, entity and count of blades and with a pose that its blades can follow (carried_ground),
/// keeps its blades.
void grow_grass(std::span<const GrassSource> sources, const GrassGrowthSettings& settings, JobExecutor& jobs,
                GrassField& field);

/// Grows the surfaces anew of which the mesh, SceneAssets::version, a value or a setting changed. Blades of a surface
/// that has moved follow it (GrassPatch::origin, GrassPatch::turn). The field is in metres (metric_matrix). A changed
/// file of types is read when the field is grown for another reason.
void grass_growth_system(View<const GrassSurface, const MeshInstance, const WorldTransform> surfaces,
                         Resource<const SceneAssets> assets, Resource<const SceneStrings> strings,
                         Resource<const SceneClock> clock, Resource<const GrassGrowthSettings> settings,
                         Resource<GrassField> field, JobExecutor& jobs);

}  // namespace gloam

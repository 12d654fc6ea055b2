// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/grass_passes.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "engine/math/finite.h"
#include "engine/render/sort/radix_sort.h"
#include "engine/render/worlds/world_id.h"
#include "engine/scene/units.h"
#include "modules/grass/drawing/draw_blades_passes.h"
#include "modules/grass/drawing/part_casters.h"
#include "modules/grass/drawing/still_air.h"
#include "modules/grass/drawing/textures.h"
#include "modules/grass/lod/detail.h"
#include "modules/grass/lod/sort_blades_passes.h"
#include "modules/grass/simulation/colliders.h"
#include "modules/grass/simulation/simulate_blades_pass.h"
#include "modules/grass/simulation/steps.h"
#include "modules/grass/simulation/wind.h"
#include "modules/shadows/outputs.h"

namespace gloam {
namespace {

using GrassOnBoard = std::shared_ptr<GrassFrame>;

shaders::GrassSteps steps_of(const World& world, std::uint32_t iterations) {
  const StepClock& clock = world.resource<StepClock>();
  const Wind* wind = nullptr;
  world.view<const Wind>().each([&](const Wind& one) { wind = &one; });
  shaders::GrassSteps steps{};
  steps.wind = to_shader(wind_at_step(wind, clock.first_step(), kGrassStep));
  steps.step_s = static_cast<float>(kGrassStep);
  steps.now = clock.now();
  steps.frame_steps = clock.frame_steps();
  steps.iterations = iterations;
  steps.moves = clock.moves() ? 1 : 0;
  return steps;
}

/// Where the wind's field begins: at the wind's node, so that a scene at another place has the same gusts.
dvec3 wind_origin(const World& world) {
  dvec3 origin(0.0);
  world.view<const Wind, const WorldTransform>().each([&](const Wind&, const WorldTransform& transform) {
    const dvec3 at(transform.matrix[3]);
    origin = is_finite(at) ? at : dvec3(0.0);
  });
  return origin;
}

vec4 shader_quaternion(const dquat& q) { return vec4(dvec4(q.x, q.y, q.z, q.w)); }

/// The layers of the surfaces of patches; neighbours mostly have one surface.
class PatchTextures {
 public:
  explicit PatchTextures(const World& world) : world_(world) {}
  /// GrassPatchRow::texture.
  [[nodiscard]] std::uint32_t word(Entity surface) {
    if (surface == surface_) return word_;
    surface_ = surface;
    const GrassSurface* found = world_.alive(surface) ? world_.try_get<GrassSurface>(surface) : nullptr;
    word_ = found == nullptr ? 0 : layers_of(world_.resource<BladeTextures>(), *found).word();
    return word_;
  }

 private:
  const World& world_;
  Entity surface_ = kNoEntity;
  std::uint32_t word_ = 0;
};

/// Uploads the rows of the view's patches and of the colliders near them.
GrassInputs upload_patches(FrameBuilder& frame, const GrassField& field, const StoredPatches& stored) {
  std::vector<shaders::GrassPatchRow> rows;
  std::vector<shaders::GrassCollider> colliders;
  const std::span<const PlacedCollider> placed = frame.world().resource<GrassColliders>().colliders;
  const double metres = metres_per_unit(frame.world());
  const dvec3 eye = frame.view().position * metres;
  const dvec3 wind_at = wind_origin(frame.world()) * metres;
  PatchTextures textures(frame.world());
  for (const ResidentPatch& resident : stored.patches) {
    const GrassPatch& patch = field.patches[resident.patch];
    shaders::GrassPatchRow row{};
    const GrassPatchMotion& motion = field.motions[resident.patch];
    row.origin = vec3(patch.origin - eye);
    row.turn = shader_quaternion(patch.turn);
    row.previous_turn = shader_quaternion(motion.previous_turn);
    row.carried = vec3(motion.carried);
    row.push = motion.push;
    row.box_from = patch.roots.min;
    row.box_size = patch.roots.max - patch.roots.min;
    row.wind_at = vec3(wind_position(patch.origin - wind_at));
    row.first_blade = resident.slot * GLOAM_GRASS_PATCH_BLADES;
    row.blades = patch.blades;
    row.first_place = resident.slot * stored.slot_masters;
    row.first_collider = static_cast<std::uint32_t>(colliders.size());
    row.colliders = colliders_near(patch, placed, colliders);
    row.max_distance_m = patch.max_distance_m;
    row.texture = textures.word(patch.surface);
    rows.push_back(row);
  }
  GrassInputs inputs;
  inputs.patches = static_cast<std::uint32_t>(rows.size());
  inputs.slot_masters = stored.slot_masters;
  inputs.has_colliders = !colliders.empty();
  if (colliders.empty()) colliders.emplace_back();  // a buffer cannot be empty
  inputs.patch_rows = frame.upload_items(std::span<const shaders::GrassPatchRow>(rows));
  inputs.colliders = frame.upload_items(std::span<const shaders::GrassCollider>(colliders));
  inputs.types = frame.upload_items(std::span<const shaders::GrassTypeRow>(field.types));
  return inputs;
}

float longest_blade(const GrassField& field, std::span<const ResidentPatch> patches) {
  float longest_m = 0.0f;
  for (const ResidentPatch& patch : patches) longest_m = std::max(longest_m, field.patches[patch.patch].reach_m);
  return longest_m;
}

std::uint32_t most_masters(const GrassField& field) {
  std::uint32_t most = 1;
  for (const GrassPatch& patch : field.patches) most = std::max(most, patch.masters);
  return most;
}

/// Workgroups of the simulation by the count of an earlier frame; none: the GPU decides, as in the first frame.
std::optional<std::uint32_t> groups_of(const FrameBuilder& frame, const GrassKnobs& knobs,
                                       std::uint32_t group_masters) {
  const World& world = frame.world();
  const GrassFeedback* feedback = world.try_view_resource<GrassFeedback>(frame.view().id);
  const bool first = world.resource<StepClock>().first_step() == 0;
  if (!knobs.readback || feedback == nullptr || first) return std::nullopt;
  return (feedback->masters + group_masters - 1) / group_masters;
}

/// Box of the blades that may cast shadows, in units.
WorldBox casting_box(const GrassField& field, std::span<const VisiblePatch> visible, float cast_distance_m,
                     double metres_per_unit) {
  WorldBox box;
  for (const VisiblePatch& one : visible) {
    if (one.nearest_m > cast_distance_m) break;  // nearest first
    const GrassPatch& patch = field.patches[one.patch];
    const Aabb reach = reach_box(patch);
    box.min = glm::min(box.min, (patch.origin + dvec3(reach.min)) / metres_per_unit);
    box.max = glm::max(box.max, (patch.origin + dvec3(reach.max)) / metres_per_unit);
  }
  return box;
}

/// Blades of the patches nearer than this.
std::uint64_t blades_within(const GrassField& field, std::span<const VisiblePatch> visible, float distance_m) {
  std::uint64_t blades = 0;
  for (const VisiblePatch& one : visible) blades += one.nearest_m <= distance_m ? field.patches[one.patch].blades : 0;
  return blades;
}

}  // namespace

void announce_grass(FrameBuilder& frame) {
  const auto& visible = frame.world().view_resource<VisiblePatches>(frame.view().id);
  if (visible.patches.empty() || !blade_pipelines_ready(frame)) return;
  const auto grass = std::make_shared<GrassFrame>();
  frame.put(GrassOnBoard(grass));
  frame.put(ThinSurfaces{});
  const GrassKnobs knobs = grass_knobs(frame.knobs());
  const WorldBox box = casting_box(frame.world().resource<GrassField>(), visible.patches, knobs.cast_distance_m,
                                   metres_per_unit(frame.world()));
  if (visible.cast && box.known()) {
    const std::uint64_t inputs = rest_inputs(frame, visible);
    const bool rest = casters_rest(frame.world().try_view_resource<GrassRest>(frame.view().id), inputs);
    const GrassField& field = frame.world().resource<GrassField>();
    const std::uint32_t turns = frame.view().camera_cut() ? 1 : knobs.shadow_turns;
    const std::uint64_t content = Hasher().value(frame.knobs().version()).value(field.version).digest();
    const float step_m = visible.range_m / 255.0f;  // distances are rounded down to such steps
    const std::uint64_t most = blades_within(field, visible.patches, knobs.cast_distance_m + 2.0f * step_m);
    add_blade_casters(frame, grass, {box, turns, content, most, rest ? inputs : 0});
  }
}

void add_grass_passes(FrameBuilder& frame, GrassWorlds& worlds) {
  const GrassOnBoard* board = frame.find<GrassOnBoard>();
  if (board == nullptr) return;
  const World& world = frame.world();
  GrassKnobs knobs = grass_knobs(frame.knobs());
  const GrassField& field = world.resource<GrassField>();
  const VisiblePatches& visible = world.view_resource<VisiblePatches>(frame.view().id);
  const std::uint64_t number = world_id(world);
  GrassBladeRows& rows = *world.resource<GrassWorld>().rows;
  if (pack_changed_rows(world, field, frame.services().executor, rows))
    for (const std::string& note : field.notes) worlds.notes_log.warning(frame.log(), note);
  for (const std::string& fault : world.resource<BladeTextures>().faults) worlds.notes_log.warning(frame.log(), fault);

  const GrassStoreInput input{.patches = field.patches,
                              .plantings = field.plantings,
                              .rows = rows.rows,
                              .field = field.version,
                              .row_version = rows.version,
                              .slot_masters = most_masters(field),
                              .restarts = world.resource<StepClock>().restarts()};
  StoredPatches stored = add_store_passes(frame, input, visible.patches, worlds.stores.of_frame(frame, number));
  if (!frame.status().ok() || stored.patches.empty()) return;
  GrassInputs inputs = upload_patches(frame, field, stored);
  inputs.textures = add_blade_texture_upload(frame, worlds.staging);
  if (!frame.status().ok()) return;
  inputs.threads = simulation_threads(knobs.threads, frame.services().device.info().threads_in_turn);
  inputs.group_masters = simulation_group_masters(inputs.threads);
  inputs.steps = steps_of(world, knobs.iterations);
  const std::optional<std::uint32_t> groups = groups_of(frame, knobs, inputs.group_masters);
  if (!visible.cast) knobs.cast_distance_m = 0.0f;
  inputs.lod =
      grass_lod(frame.view(), knobs, {visible.range_m, longest_blade(field, stored.patches), metres_per_unit(world)});
  inputs.lod.most_masters = groups ? *groups * inputs.group_masters : ~0u;
  inputs.lod.steps_per_s = static_cast<float>(1.0 / kGrassStep);
  inputs.lod_range = frame.upload_uniform(inputs.lod);

  const SortedBlades sorted = add_blade_sort_passes(frame, inputs, stored.store);
  const MasterList masters = add_master_pass(frame, inputs, stored.store, sorted);
  stored.store = add_simulation_pass(frame, inputs, stored.store, masters, groups);
  const DrawnBlades posed = add_pose_pass(frame, inputs, stored.store, sorted);
  const DrawnBlades drawn = add_blade_pass(frame, inputs, stored.store, sorted, posed);
  **board = GrassFrame{std::move(stored), inputs.lod, inputs.steps, sorted, masters.dispatch, drawn};
}

void list_grass_pipelines(const GrassKnobs& knobs, bool threads_in_turn, bool textured, PipelineList& list) {
  const auto add = [&](const ComputeProgram& program) { list.push_back(pipeline_desc(program, "grass")); };
  add(grass_keys_program());
  add(grass_live_program());
  const SimulationThreads threads = simulation_threads(knobs.threads, threads_in_turn);
  add(grass_masters_program(simulation_group_masters(threads)));
  for (const bool colliders : {false, true}) add(grass_simulation_program(threads, colliders));
  add(grass_pose_program());
  for (const ComputeProgram& program : radix_sort_programs(threads_in_turn, true)) add(program);
  list_blade_pipelines({.textured = textured}, list);
  if (knobs.cast_distance_m <= 0.0f) return;
  list.push_back(caster_pipeline_desc(blade_caster_program(), "grass"));
  add(grass_part_casters_program());
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "sandbox/bench/harness/registry.h"

namespace gloam {

/// Entities and components against plain arrays (`…_over_bare`).
void add_ecs_benches(BenchRegistry& registry);
/// Whole frames of the scene against the gather pass (48 gathers per pixel).
void add_frame_benches(BenchRegistry& registry);
/// Time from frame to frame with one and with two frames in flight.
void add_frame_wall_benches(BenchRegistry& registry);
/// Frames at rest and of a moving camera: with what is kept and left out, over the same frames without.
void add_frame_saving_benches(BenchRegistry& registry);
/// GPU time per pixel: the largest over the smallest of eleven sizes.
void add_frame_size_benches(BenchRegistry& registry);
/// Captures of cubes in one frame against their views drawn one by one.
void add_frame_capture_benches(BenchRegistry& registry);
/// Frames in which one asset of a large scene changes.
void add_asset_benches(BenchRegistry& registry);
/// CPU time of the frame graph: declaring passes with a cached plan.
void add_frame_declaration_benches(BenchRegistry& registry);
/// The transform system over 3,000 nodes that rest, or of which few move.
void add_transform_benches(BenchRegistry& registry);
/// Time of the light searches and of shading with their lists: against brute force, against the gather pass, by number
/// of lights.
void add_light_gpu_benches(BenchRegistry& registry);
/// The CPU's light systems (bounds, sorting, zBins, tile masks) against a memset of as many bytes as they write.
void add_light_cpu_benches(BenchRegistry& registry);
/// False positives of each phase: lights per tile that it keeps although they reach no pixel of the tile.
void add_light_false_positive_benches(BenchRegistry& registry);
/// Time of the shadow filters, and their error against traced shadows.
void add_shadow_benches(BenchRegistry& registry);
/// Error of shadows against traced ones for every camera of every built-in scene with shadows, and against that of
/// simpler filters.
void add_shadow_error_benches(BenchRegistry& registry);
/// FF table 2: oriented bias against hardware bias.
void add_shadow_bias_benches(BenchRegistry& registry);
/// Widths of penumbrae against the analytic ones.
void add_shadow_penumbra_benches(BenchRegistry& registry);
/// The contact-hardening filter against the bare gathers of the same footprints.
void add_shadow_gather_benches(BenchRegistry& registry);
/// FF table 1 and figure 13: monolithic shadows against deferred shadows, with and without classification.
void add_shadow_deferred_benches(BenchRegistry& registry);
/// Memory of light lists and visibilities against a fixed number of lights per tile (FF §2).
void add_shadow_memory_benches(BenchRegistry& registry);
/// Time of each phase by number of shadowed lights and by resolution.
void add_shadow_curve_benches(BenchRegistry& registry);
/// Time of the contact-hardening filter by shadowed share of the picture and by size of the map (Thief §1.3).
void add_shadow_exposure_benches(BenchRegistry& registry);
/// Whole frames with moving casters against the gather pass, and the parts of their time.
void add_shadow_frame_benches(BenchRegistry& registry);
/// Error of close-up shadows against traced shadows, compared with standard maps that have as many texels.
void add_closeup_benches(BenchRegistry& registry);
/// Cost of close-ups: memory by number of pairs, FF figure 14, batch sizes, and ways to get the subjects into the maps
/// of forward-lit surfaces.
void add_closeup_cost_benches(BenchRegistry& registry);
/// Flicker of a walking subject's shadows, compared with standard maps that have as many texels.
void add_closeup_flicker_benches(BenchRegistry& registry);
/// The proxy pass with proxy tiles against the loop over all proxies, by number of tiles, and by view.
void add_reflection_tile_benches(BenchRegistry& registry);
/// Cost of the reflection chain, against the gather pass and against drawing the mirrored scene.
void add_reflection_chain_benches(BenchRegistry& registry);
void add_reflection_view_benches(BenchRegistry& registry);
void add_reflection_cost_benches(BenchRegistry& registry);
/// Error of each set of reflection tiers against traced reflections, by camera.
void add_reflection_error_benches(BenchRegistry& registry);
/// Changes of reflections from frame to frame, with and without reprojection.
void add_reflection_temporal_benches(BenchRegistry& registry);
/// Data for reflections that the CPU makes from a scene: fitted proxies, captures, proxy tiles.
void add_reflection_scene_benches(BenchRegistry& registry);
/// The radix sort of 1 M keys against std::sort, and its share of the memory bandwidth.
void add_grass_sort_benches(BenchRegistry& registry);
/// Time and error of the simulation of grass by the share of simulated blades and by the number of iterations.
void add_grass_simulation_benches(BenchRegistry& registry);
/// Cost of grass in a field ten times as large in which the same blades are live.
void add_grass_field_benches(BenchRegistry& registry);
/// Times of the passes of grass in a frame of the meadow, and by number of live blades.
void add_grass_cost_benches(BenchRegistry& registry);
/// What shadows of blades add to frames by night: the meadow under lanterns, the lawn of the courtyard.
void add_grass_night_benches(BenchRegistry& registry);
/// Flicker, FLIP and coverage of the level of detail of grass during a walk.
void add_grass_walk_benches(BenchRegistry& registry);
/// Times of the passes of particles: lit against unlit ones, by number, and by the rate of lighting.
void add_particle_cost_benches(BenchRegistry& registry);
/// The blur of depth of field by its use of workgroup memory, by radius and bokeh.
void add_dof_cache_benches(BenchRegistry& registry);
/// Time that depth of field adds to a frame, against the gather pass.
void add_dof_frame_benches(BenchRegistry& registry);
/// Error of depth of field against frames through many points of the lens.
void add_dof_error_benches(BenchRegistry& registry);
/// Time that glare adds to a frame, against the gather pass.
void add_glare_benches(BenchRegistry& registry);
/// The tables and figures of the papers beside ours: each row runs a bench that was added before.
void add_paper_benches(BenchRegistry& registry);
/// Frames under time budgets: their times, the errors against the best of all combinations, changes.
void add_governor_benches(BenchRegistry& registry);
/// The cost of jobs, ranges and graphs.
void add_job_benches(BenchRegistry& registry);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/papers/tables.h"

// Short names of the papers as in third_party_notes/references.md. Times of other machines cannot be compared with
// ours, only shares and ratios can.

namespace gloam {
namespace {

constexpr const char* kConsole = "ms on a console";

constexpr PaperRow kTable1[] = {
    {"before.lighting", "shadows.table1.columns.monolithic.lighting", 5.73, kConsole},
    {"before.total", "shadows.table1.columns.monolithic.total", 5.73, kConsole},
    {"deferred.shadow", "shadows.table1.columns.deferred.shadow", 2.25, kConsole},
    {"deferred.lighting", "shadows.table1.columns.deferred.lighting", 1.69, kConsole},
    {"deferred.total", "shadows.table1.columns.deferred.total", 3.94, kConsole},
    {"deferred.change", "shadows.table1.columns.deferred.over_monolithic", 0.69, "ratio on a console"},
    {"unclassified.total", "shadows.table1.deferred_unclassified"},
    {"lights_a_tile", "shadows.table1.lights_a_tile", 3.0, "shadowed lights a tile"},
    // The scene of the rows above has no close-up subjects: these are of another scene, and so are their ratios.
    {"closeups.before.total", "shadows.table1.subjects.monolithic.total", 5.73, kConsole},
    {"closeups.deferred.total", "shadows.table1.subjects.deferred.total", 3.94, kConsole},
    {"closeups.shadow", "shadows.table1.subjects.deferred_8_closeups.shadow", 2.02, kConsole},
    {"closeups.closeup", "shadows.table1.subjects.deferred_8_closeups.closeup", 2.5, kConsole},
    {"closeups.lighting", "shadows.table1.subjects.deferred_8_closeups.lighting", 1.74, kConsole},
    {"closeups.total", "shadows.table1.subjects.deferred_8_closeups.total", 6.29, kConsole},
    {"closeups.change", "shadows.table1.subjects.deferred_8_closeups.over_monolithic", 1.10, "ratio on a console"},
    {"closeups.over_deferred", "shadows.table1.subjects.deferred_8_closeups.over_deferred", 6.29 / 3.94,
     "ratio on a console"},
    {"closeups.pairs", "shadows.table1.subjects.closeup_pairs", 8.0, "pairs"},
    {"closeups.lights_a_tile", "shadows.table1.subjects.lights_a_tile", 3.0, "shadowed lights a tile"},
};

constexpr PaperRow kFigure13[] = {
    {"prepare", "shadows.figure13.prepare"},
    {"find_approximate", "shadows.figure13.find_approx"},
    {"find_accurate", "shadows.figure13.find_accurate"},
    {"classify", "shadows.figure13.classify"},
    {"generate", "shadows.figure13.generate"},
    {"finish", "shadows.figure13.finish"},
    {"lighting", "shadows.figure13.lighting"},
};

constexpr PaperRow kFigure14[] = {
    {"draw", "closeups.figure14.draw"},
    {"mips", "closeups.figure14.resolve"},
    {"compose", "closeups.figure14.compose"},
    {"transfer", "closeups.figure14.transfer"},
    {"a_pair", "closeups.pair_ms", 2.5 / 8.0, kConsole},
};

constexpr PaperRow kTable2[] = {
    {"oriented_over_hardware", "shadows.table2.oriented_over_hardware_without_plane_ms", 4.17 / 3.98,
     "ratio on a console (1.07 with more reads of the geometry buffer)"},
    {"oriented_and_receiver_plane_over_hardware", "shadows.table2.oriented_over_hardware_ms"},
    {"wrong_pixels", "shadows.table2.oriented_over_hardware_wrong_pixels"},
    {"leaks_at_equal_acne", "shadows.table2.oriented_over_hardware_leaks_at_equal_acne"},
};

constexpr PaperRow kLightLists[] = {
    {"tile_32.lights", "lights.false_positives.cone.mask"},
    {"tile_32_and_z_bins.lights", "lights.false_positives.cone.candidates"},
    {"group.lights", "lights.false_positives.cone.group"},
    {"tile_8.lights", "lights.false_positives.cone.approx"},
    {"masks_of_tiles.4k", "lights.mask_mib.tiles.4k", 4.4, "MB, with 36 bytes a mask"},
    {"masks_of_groups.4k", "lights.mask_mib.groups.4k", 0.3, "MB"},
    {"lists_over_fixed.4k", "shadows.memory.lists_over_fixed.4k", 5.5 / 22.1, "ratio"},
    {"lists.4k", "shadows.memory.list_mib.4k", 5.5, "MB"},
    {"visibility_over_fixed.4k", "shadows.memory.visibility_over_fixed.4k", 63.0 / 253.0, "ratio"},
    {"visibility.4k", "shadows.memory.visibility_mib.4k", 63.0, "MB"},
};

constexpr PaperRow kContactHardening[] = {
    {"share_0", "shadows.exposure.share.0.ms"},
    {"share_25", "shadows.exposure.share.25.ms"},
    {"share_50", "shadows.exposure.share.50.ms"},
    {"share_100", "shadows.exposure.share.100.ms", 2.0, "ms at most on GTX 770, 1080p"},
    {"share_0_over_100", "shadows.exposure.share.0_over_100", 0.5, "ratio on GTX 770 (1 to 2 ms)"},
    {"map_256", "shadows.exposure.map.256.ms"},
    {"map_512", "shadows.exposure.map.512.ms"},
    {"map_1024", "shadows.exposure.map.1024.ms"},
    {"map_2048", "shadows.exposure.map.2048.ms"},
    {"chs_over_pcss", "shadows.filter.chs_over_pcss"},
};

constexpr PaperRow kReflections[] = {
    {"screen_space", "reflections.frame.screen_space_ms", 1.5, "ms at most on PS4, 1080p"},
    {"proxies", "reflections.frame.proxies_ms", 1.5, "ms at most on PS4, 1080p"},
    {"post_processing", "reflections.frame.post_processing_ms", 2.0, "ms on PS4, 1080p"},
    {"chain", "reflections.frame.chain_ms", 5.0, "ms (the budget)"},
    {"all_proxies_over_tiles", "reflections.tiled_over_naive", 8.0 / 1.5, "ratio at least (8 ms and more, and 1.5 ms)"},
    {"chain_over_mirrored_scene", "reflections.chain_over_mirrored_scene", 0.5, "ratio (5 and 10 ms)"},
};

constexpr PaperRow kDepthOfField[] = {
    {"no_workgroup_memory", "dof.radius15.none", 0.15, "ms on HD 7970"},
    {"vectors", "dof.radius15.vec4", 0.26, "ms on HD 7970"},
    {"channels", "dof.radius15.channels", 0.1, "ms on HD 7970"},
    {"channels_over_none", "dof.channels_over_none", 0.67, "ratio on HD 7970 (1 or more on GTX 660)"},
    {"hexagonal.no_workgroup_memory", "dof.hexagonal.radius15.none"},
    {"hexagonal.channels_over_none", "dof.hexagonal.channels_over_none"},
};

constexpr PaperRow kParticles[] = {
    {"lit_over_unlit", "particles.lit_over_unlit"},
    {"simulate_and_sort_1e4", "particles.simulate_and_sort_1e4.ms"},
    {"light_1e4", "particles.cost.1e4.light_ms"},
};

constexpr PaperRow kGrass[] = {
    {"masters_1_4_over_all", "grass.masters_1_4_over_full"},
    {"masters_1_4.tip_error_mean", "grass.masters.1_4.tip_error_mean_mm"},
    {"iterations_3.tip_error_mean", "grass.iterations.3.tip_error_mean_mm"},
    {"field_of_ten_times", "grass.field_x10_same_live"},
    {"sort", "grass.frame.sort_ms"},
    {"level_of_detail", "grass.frame.lod_ms"},
    {"simulation", "grass.frame.simulation_ms"},
    {"drawing", "grass.frame.drawing_ms"},
    {"live_blades", "grass.frame.live"},
    {"popping_over_no_lod", "grass.walk.temporal_over_no_lod"},
};

constexpr PaperTable kTables[] = {
    {"ff.table1", "FF table 1: deferred shadows, by column", kTable1},
    {"ff.figure13", "FF figure 13: shares of the phases (the paper shows a pie)", kFigure13},
    {"ff.figure14", "FF figure 14: shares of the steps of a close-up pair (the paper shows a pie)", kFigure14},
    {"ff.table2", "FF table 2: oriented against hardware bias", kTable2},
    {"ff.light_lists", "FF section 2: false positives a tile, and memory in 4K", kLightLists},
    {"thief.contact_hardening", "Thief section 1.3: contact hardening by shadowed share and size of the map",
     kContactHardening},
    {"thief.reflections", "Thief section 1.2: the reflection chain", kReflections},
    {"thief.depth_of_field", "Thief section 1.5: blur of radius 15 with workgroup memory", kDepthOfField},
    {"thief.particles", "Thief section 1.4: lit particles (the paper gives no figures)", kParticles},
    {"grass", "Grass: cost and error of its levels of detail (the notes at hand give no figures)", kGrass},
};

}  // namespace

std::span<const PaperTable> paper_tables() { return kTables; }

}  // namespace gloam

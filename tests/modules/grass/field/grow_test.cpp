// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/field/grow.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <glm/ext/matrix_transform.hpp>
#include <limits>

#include "engine/scene/gltf/import.h"
#include "engine/schedule/schedule.h"
#include "modules/grass/module.h"
#include "tests/jobs/executors.h"
#include "tests/modules/grass/growth/lawns.h"
#include "tests/support/scale.h"
#include "tests/support/temporary_folder.h"

namespace gloam {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A world whose schedule has the growth system only.
struct GrassWorld {
  World world;
  Schedule schedule;

  explicit GrassWorld(Mesh mesh = test::lawn(4, 10.0f, &test::hills)) {
    prepare_scene_world(world);
    make_grass_module()->register_components(world);
    world.set_resource(GrassGrowthSettings{});
    world.set_resource(GrassField{});
    assets().meshes.push_back(std::move(mesh));
    schedule.add_system("grass_growth", "grass", Stage::world, &grass_growth_system);
    schedule.set_checked(true);
  }
  Entity add(float density, const dmat4& matrix = dmat4(1.0), std::uint32_t mesh = 0) {
    GrassSurface surface;
    surface.density = density;
    return world.create(surface, MeshInstance{mesh}, WorldTransform{matrix});
  }
  const GrassField& run(JobExecutor& jobs) {
    schedule.run(Stage::world, world, jobs);
    return world.resource<GrassField>();
  }
  const GrassField& run() { return run(*make_serial_executor()); }
  SceneAssets& assets() { return world.resource<SceneAssets>(); }
  GrassGrowthSettings& settings() { return world.resource<GrassGrowthSettings>(); }
  [[nodiscard]] std::uint64_t hash() const {
    const GrassField& field = world.resource<GrassField>();
    return test::hash_of(field.patches, field.blades);
  }
};

TEST(Grow, density_times_area_is_the_count_within_1) {
  for (const float density : {0.001f, 0.03f, 1.0f, 7.3f, 100.0f}) {
    GrassWorld w;
    w.add(density);
    const GrassField& field = w.run();
    EXPECT_NEAR(field.statistics.blades, density * field.statistics.area_m2, 1.0);
    EXPECT_EQ(field.blades.size(), field.patches.size() * 256);
    EXPECT_EQ(field.statistics.surfaces, 1u);
    EXPECT_EQ(field.statistics.triangles, 32u);
  }
}

// Hard case: grass.blades_0
TEST(Grow, density_0_no_mesh_and_surfaces_without_area_grow_nothing) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float density : {0.0f, -1.0f, nan, std::numeric_limits<float>::infinity()}) {
    GrassWorld w;
    w.add(density);
    const GrassField& field = w.run();
    EXPECT_TRUE(field.blades.empty() && field.patches.empty());
    EXPECT_EQ(field.statistics.blades, 0u);
  }
  GrassWorld w;
  w.add(10.0f, glm::scale(dmat4(1.0), dvec3(0.0)));
  w.add(10.0f, dmat4(1.0), 99);
  w.assets().meshes.emplace_back();
  w.add(10.0f, dmat4(1.0), 1);
  EXPECT_TRUE(w.run().patches.empty());
  EXPECT_EQ(w.run().statistics.degenerate_faces, 32u);
}

TEST(Grow, a_world_without_grass_has_an_empty_field) {
  GrassWorld w;
  const GrassField& field = w.run();
  EXPECT_EQ(field.version, 1u);
  EXPECT_TRUE(field.patches.empty() && field.types.empty() && field.notes.empty());
}

TEST(Grow, the_field_is_regrown_only_when_an_input_changes) {
  GrassWorld w;
  const Entity entity = w.add(5.0f);
  w.assets().meshes.push_back(test::lawn(2, 4.0f));
  EXPECT_EQ(w.run().version, 1u);
  EXPECT_EQ(w.run().version, 1u);
  std::uint64_t version = 1;
  std::uint64_t key = w.run().key;
  const auto expect_regrown = [&](const char* why) {
    EXPECT_EQ(w.run().version, ++version) << why;
    EXPECT_NE(w.run().key, key) << why;
    EXPECT_EQ(w.run().version, version) << why;
    key = w.run().key;
  };
  w.world.get<GrassSurface>(entity).density = 6.0f;
  expect_regrown("density");
  w.world.get<GrassSurface>(entity).seed = 2;
  expect_regrown("seed");
  w.world.get<GrassSurface>(entity).height_m.y = 0.1f;
  expect_regrown("height");
  w.world.get<GrassSurface>(entity).width_m = 0.1f;
  expect_regrown("width");
  w.world.get<GrassSurface>(entity).max_distance_m = 10.0f;
  expect_regrown("max_distance");
  w.world.get<WorldTransform>(entity).matrix[3].x = 1.0;
  EXPECT_EQ(w.run().version, version) << "blades follow their ground";
  w.world.get<WorldTransform>(entity).matrix[0] *= 2.0;
  w.world.get<WorldTransform>(entity).matrix[2] *= 2.0;
  EXPECT_EQ(w.run().version, ++version) << "four times the area";
  w.world.get<MeshInstance>(entity).mesh = 1;
  expect_regrown("mesh");
  ++w.assets().version;
  expect_regrown("assets");
  w.settings().slaves_per_master = 8;
  expect_regrown("slaves");
  w.settings().density_scale = 0.5f;
  expect_regrown("density scale");
  const Entity other = w.add(1.0f);
  expect_regrown("another surface");
  w.world.destroy(other);
  expect_regrown("one surface less");
}

// Hard case: grass.threads
TEST(Grow, the_field_has_the_same_bits_on_every_executor_and_for_every_order_of_entities) {
  std::vector<std::uint64_t> hashes;
  for (const test::ExecutorCase& c : test::all_executors()) {
    GrassWorld w;
    for (int i = 0; i < 3; ++i) w.add(20.0f, glm::translate(dmat4(1.0), dvec3(12.0 * i, 0.0, 0.0)));
    w.run(*c.make());
    hashes.push_back(w.hash());
  }
  GrassWorld mixed;
  const Entity first = mixed.add(20.0f);
  for (int i = 1; i < 3; ++i) mixed.add(20.0f, glm::translate(dmat4(1.0), dvec3(12.0 * i, 0.0, 0.0)));
  mixed.world.add(first, Parent{});  // moves the first surface to the last archetype
  mixed.run();
  hashes.push_back(mixed.hash());
  for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes[0]);
}

// Hard case: grass.at_100_km
TEST(Grow, a_surface_100_km_away_grows_the_same_blades) {
  GrassWorld near;
  near.add(20.0f, glm::translate(dmat4(1.0), dvec3(3.25, 1.0, 0.5)));
  near.run();
  for (const dvec3 away : {dvec3(100000.0, 0.0, 0.0), dvec3(-100000.0, 7000.0, 100000.0)}) {
    GrassWorld far;
    far.add(20.0f, glm::translate(dmat4(1.0), dvec3(3.25, 1.0, 0.5) + away));
    far.run();
    EXPECT_EQ(far.hash(), near.hash());
    for (std::size_t i = 0; i < near.run().patches.size(); ++i)
      EXPECT_LT(glm::length(far.run().patches[i].origin - near.run().patches[i].origin - away), 1e-10);
  }
}

// Hard case: grass.blades_1, grass.blades_3, grass.blades_4, grass.blades_5
TEST(Grow, small_counts_and_all_settings_of_slaves_grow) {
  for (const std::uint32_t slaves : {0u, 1u, 2u, 4u, 8u, 16u, 17u, 4000000000u}) {
    for (const float count : {1.0f, 3.0f, 4.0f, 5.0f, 65.0f, 257.0f}) {
      GrassWorld w(test::lawn(1, 1.0f));
      w.settings().slaves_per_master = slaves;
      w.add(count);
      EXPECT_EQ(w.run().statistics.blades, static_cast<std::uint32_t>(count));
      EXPECT_EQ(w.run().statistics.masters == w.run().statistics.blades, slaves == 0 || count == 1.0f);
    }
  }
}

TEST(Grow, beyond_the_limit_the_density_is_scaled_down_and_a_note_says_so) {
  GrassWorld w(test::lawn(1, 10.0f));
  w.settings().max_blades = 1000;
  w.add(30.0f);
  w.add(10.0f);
  const GrassField& field = w.run();
  EXPECT_EQ(field.statistics.wanted_blades, 4000.0);
  EXPECT_EQ(field.statistics.blades, 1000u);
  ASSERT_EQ(field.notes.size(), 1u);
  EXPECT_EQ(field.notes[0], "the surfaces call for 4000 blades; the density is scaled down to 1000 in all");
  std::uint32_t first = 0;
  for (const GrassPatch& patch : field.patches)
    first += patch.surface.index == field.patches[0].surface.index ? patch.blades : 0;
  EXPECT_EQ(first, 750u);
  w.settings().max_blades = 0;
  EXPECT_TRUE(w.run().patches.empty());
}

TEST(Grow, a_density_beyond_all_limits_does_not_overflow) {
  GrassWorld w(test::lawn(1, 1e9f));
  w.settings().max_blades = 500;
  w.add(1e6f);
  EXPECT_NEAR(w.run().statistics.blades, 500, 1);
}

// Hard case: grass.non_manifold
TEST(Grow, faults_of_the_mesh_are_counted_and_the_rest_grows) {
  Mesh mesh = test::lawn(1, 10.0f);
  Primitive& primitive = mesh.primitives[0];
  primitive.positions.insert(primitive.positions.end(), {{std::numeric_limits<float>::quiet_NaN(), 0, 0}, {0, 1, 0}});
  primitive.indices.insert(primitive.indices.end(), {0, 1, 4, 0, 0, 1, 1, 5, 2});
  GrassWorld w(mesh);
  w.add(1.0f);
  const GrassStatistics& statistics = w.run().statistics;
  EXPECT_EQ(statistics.non_finite_faces, 1u);
  EXPECT_EQ(statistics.degenerate_faces, 1u);
  EXPECT_EQ(statistics.refused_faces, 1u);
  EXPECT_EQ(statistics.blades, 100u);
}

std::string types_text(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += "t" + std::to_string(i) + " 1 1 1 0.5 0.1 0,0 0,1\n";
  return text;
}

struct TypeFiles {
  test::TestFolder folder;
  GrassWorld world{test::lawn(1, 10.0f)};

  Entity add(const std::string& name, const std::string& text) {
    const std::string path = folder.path() + "/" + name;
    if (!text.empty()) std::ofstream(path) << text;
    const Entity entity = world.add(10.0f);
    if (!name.empty()) world.world.get<GrassSurface>(entity).types = world.world.resource<SceneStrings>().intern(path);
    return entity;
  }
  /// Least and greatest type of a surface's blades.
  std::pair<int, int> types_of(Entity entity) {
    std::pair<int, int> found(99, -1);
    for (const GrassPatch& patch : world.run().patches) {
      if (patch.surface != entity) continue;
      for (std::uint32_t i = 0; i < patch.blades; ++i) {
        const int type = world.run().blades[patch.index * 256 + i].type;
        found = {std::min(found.first, type), std::max(found.second, type)};
      }
    }
    return found;
  }
};

TEST(Grow, types_of_several_files_share_one_table) {
  TypeFiles files;
  const Entity a = files.add("", "");
  const Entity b = files.add("lawn.blades", types_text(4));
  const Entity c = files.add("", "");
  const Entity d = files.add("lawn.blades", types_text(4));
  EXPECT_EQ(files.world.run().types.size(), 9u);
  EXPECT_THAT(files.world.run().notes, IsEmpty());
  EXPECT_EQ(files.types_of(a), std::pair(0, 4));
  EXPECT_EQ(files.types_of(b), std::pair(5, 8));
  EXPECT_EQ(files.types_of(c), std::pair(0, 4));
  EXPECT_EQ(files.types_of(d), std::pair(5, 8));
}

TEST(Grow, a_bad_or_absent_file_of_types_is_noted_and_the_built_in_types_grow) {
  TypeFiles files;
  const Entity bad = files.add("bad.blades", "x 1 1\n");
  const Entity absent = files.add("absent.blades", "");
  EXPECT_THAT(files.world.run().notes,
              ElementsAre(HasSubstr("bad.blades line 1: a type needs"), HasSubstr("absent.blades: cannot be read")));
  for (const Entity entity : {bad, absent}) {
    const auto [least, greatest] = files.types_of(entity);
    EXPECT_EQ(greatest - least, 4);
  }
}

TEST(Grow, types_beyond_16_are_left_out_and_noted) {
  TypeFiles files;
  const Entity a = files.add("a.blades", types_text(12));
  const Entity b = files.add("b.blades", types_text(6));
  const Entity c = files.add("c.blades", types_text(3));
  const GrassField& field = files.world.run();
  EXPECT_EQ(field.types.size(), 16u);
  EXPECT_EQ(field.statistics.dropped_types, 5u);
  EXPECT_THAT(field.notes, ElementsAre(HasSubstr("b.blades: 2 of 6 types are left out"),
                                       HasSubstr("c.blades: 3 of 3 types are left out")));
  EXPECT_EQ(files.types_of(a), std::pair(0, 11));
  EXPECT_EQ(files.types_of(b), std::pair(12, 15));
  EXPECT_EQ(files.types_of(c), std::pair(0, 11));
}

// Hard case: grass.blades_million
TEST(Grow, a_million_blades_are_even_and_complete) {
  GrassWorld w(
      test::lawn(200, 100.0f, [](float x, float z) { return 3.0f * std::sin(0.1f * x) * std::cos(0.08f * z); }));
  const auto jobs = make_pool_executor();
  w.add(1.0f);
  const double area = w.run(*jobs).statistics.area_m2;
  const double count = test::scaled(1000000);
  w.settings().density_scale = static_cast<float>(count / area);
  const GrassField& field = w.run(*jobs);
  EXPECT_NEAR(field.statistics.blades, count, 2.0);
  EXPECT_EQ(field.patches.size(), (field.statistics.blades + 255) / 256);
  std::uint32_t least = 256;
  double boxes = 0.0;
  for (const GrassPatch& patch : field.patches) {
    least = std::min(least, patch.blades);
    const vec3 size = patch.roots.max - patch.roots.min;
    boxes += double{size.x} * size.z;
  }
  EXPECT_GE(least, field.statistics.blades / field.patches.size());
  EXPECT_LT(boxes, 1.05 * 100.0 * 100.0);
}

}  // namespace
}  // namespace gloam

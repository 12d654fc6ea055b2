// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// A world in which assets and entities come, change and go at random, in the background and under budgets of uploads
// from 4 KiB to 8 MiB. At intervals its picture is compared with that of a world that is built anew from the same
// state. GLOAM_TEST_SCALE multiplies the number of steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "modules/particles/components.h"
#include "modules/reflections/components.h"
#include "modules/shadows/components.h"
#include "tests/render/draws/drawn_scene.h"
#include "tests/support/scale.h"

namespace gloam {
namespace {

constexpr int kSteps = 300;
constexpr int kStepsBetweenPictures = 60;
constexpr std::uint32_t kWidth = 64, kHeight = 48;
constexpr std::size_t kMostOfAKind = 12;

/// A renderer of all modules with a world whose surroundings are fixed.
struct MovingShow {
  MovingShow(Readiness readiness, std::uint64_t budget) {
    RendererOptions options;
    options.device = test::drawing_device();
    options.executor = executor.get();
    options.log = &test::gpu_log();
    options.modules = make_all_modules();
    options.readiness = readiness;
    options.upload_budget = budget;
    renderer = test::value_of(Renderer::create(std::move(options)));
    begin(world);
  }
  void begin(World& target) const {
    renderer->prepare_world(target);
    auto& environment = target.resource<SceneEnvironment>();
    environment.sky_zenith = vec3(0.5f, 1.0f, 3.0f);
    environment.sky_horizon = vec3(3.0f, 2.0f, 1.0f);
    environment.has_exposure = true;
    environment.exposure_ev100 = 4.0f;
  }
  void draw(World& target) const {
    ViewRequest request;
    request.settings = test::look_at(dvec3(0.5, 3.0, 8.0), dvec3(0.0, 0.5, 0.0), kWidth, kHeight);
    const Status status = renderer->render(target, {&request, 1});
    ASSERT_TRUE(status.ok()) << status.error().message;
  }
  /// Draws until everything is shown, and then until maps and histories have settled.
  [[nodiscard]] Picture settled(World& target) const {
    for (int frames = 0, at_rest = 0; at_rest < 12 && !::testing::Test::HasFatalFailure(); ++frames) {
      draw(target);
      const FrameReport report = renderer->report();
      at_rest = report.assets_pending + report.pipelines_pending == 0 ? at_rest + 1 : 0;
      if (frames == 20000) ADD_FAILURE() << report.assets_pending << " assets never arrive";
      if (frames == 20000) break;
    }
    return test::value_of(renderer->read_picture(ViewId{0}));
  }

  std::unique_ptr<JobExecutor> executor = make_pool_executor(2);
  std::unique_ptr<Renderer> renderer;
  World world;
};

class WorldsInMotion : public ::testing::Test {
 protected:
  void SetUp() override {
    GLOAM_REQUIRE_GPU(test::drawing_device());
    GLOAM_REQUIRE_DEPTH_TESTS(test::drawing_device());
  }
  void TearDown() override {
    if (test::drawing_device() != nullptr) {
      EXPECT_EQ(test::drawing_device()->validation_messages(), 0u);
    }
  }

  std::uint32_t random(std::uint32_t below) { return static_cast<std::uint32_t>(engine_()) % below; }
  float random_unit() { return static_cast<float>(random(1000)) / 999.0f; }
  dmat4 random_place() { return glm::translate(dmat4(1.0), dvec3(random(7) - 3.0, 0.3 + random(3), random(5) - 2.0)); }
  SceneAssets& assets() { return show_->world.resource<SceneAssets>(); }
  static std::vector<std::uint32_t> living(const SceneAssets& assets, AssetKind kind) {
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < assets.count(kind); ++i)
      if (!assets.is_destroyed(kind, i)) indices.push_back(i);
    return indices;
  }
  std::uint32_t random_of(AssetKind kind) {
    const std::vector<std::uint32_t> indices = living(assets(), kind);
    return indices.empty() ? kNone : indices[random(static_cast<std::uint32_t>(indices.size()))];
  }

  Image random_image() {
    const std::uint32_t width = 1u << random(8), height = 1u << random(8);
    Image image{"random", width, height, {}};
    const std::uint32_t color = random(1u << 24);
    for (std::uint32_t i = 0; i < width * height; ++i)
      for (const int shift : {0, 8, 16, -1})
        image.rgba.push_back(shift < 0 ? std::uint8_t{255} : static_cast<std::uint8_t>(color >> shift));
    return image;
  }
  Material random_material() {
    Material material;
    material.metallic = 0.0f;
    material.roughness = 0.3f + 0.7f * random_unit();
    material.base_color = vec4(random_unit(), random_unit(), random_unit(), 1.0f);
    material.double_sided = random(2) == 0;
    if (random(3) > 0) material.base_color_texture.texture = random_of(AssetKind::texture);
    return material;
  }
  Mesh random_mesh() {
    Mesh mesh;
    for (std::uint32_t p = 0; p <= random(2); ++p) {
      const std::uint32_t material = random_of(AssetKind::material);
      const float size = 0.4f + random_unit();
      mesh.primitives.push_back(random(2) == 0 ? test::box(vec3(size, 0.3f, size), material)
                                               : test::round_ball(size, 4 + random(60), 3 + random(30), material));
      mesh.bounds.grow(mesh.primitives.back().bounds);
    }
    return mesh;
  }

  /// Destroys an asset and what refers to it: textures of an image, textures' slots in materials, meshes of a material.
  void destroy(AssetKind kind, std::uint32_t index) {
    if (index == kNone) return;
    SceneAssets& all = assets();
    for (const std::uint32_t t : living(all, AssetKind::texture))
      if (kind == AssetKind::image && all.textures[t].image == index) destroy(AssetKind::texture, t);
    for (const std::uint32_t m : living(all, AssetKind::material)) {
      if (kind != AssetKind::texture || all.materials[m].base_color_texture.texture != index) continue;
      all.materials[m].base_color_texture.texture = kNone;
      all.mark_changed(AssetKind::material, m);
    }
    for (const std::uint32_t m : living(all, AssetKind::mesh)) {
      const auto uses = [&](const Primitive& primitive) { return primitive.material == index; };
      if (kind == AssetKind::material && std::ranges::any_of(all.meshes[m].primitives, uses))
        destroy(AssetKind::mesh, m);
    }
    for (const Entity e : kind == AssetKind::mesh ? instances_ : std::vector<Entity>())
      if (show_->world.get<MeshInstance>(e).mesh == index) remove_entity(instances_, e);
    all.destroy(kind, index);
  }
  void remove_entity(std::vector<Entity>& list, Entity entity) {
    show_->world.destroy(entity);
    std::erase(list, entity);
  }
  void change_asset(AssetKind kind) {
    const std::uint32_t index = random_of(kind);
    if (index == kNone) return;
    if (kind == AssetKind::image) assets().images[index] = random_image();
    if (kind == AssetKind::material) assets().materials[index] = random_material();
    if (kind == AssetKind::mesh) assets().meshes[index] = random_mesh();
    assets().mark_changed(kind, index);
  }
  void add_asset(AssetKind kind) {
    if (living(assets(), kind).size() >= kMostOfAKind) return destroy(kind, random_of(kind));
    if (kind == AssetKind::image) {
      const std::uint32_t image = assets().add(random_image());
      for (const bool srgb : {true, false})
        if (random(2) == 0)
          static_cast<void>(assets().add(Texture{.name = "random", .image = image, .srgb = srgb, .nearest = true}));
    }
    if (kind == AssetKind::material) static_cast<void>(assets().add(random_material()));
    if (kind == AssetKind::mesh) {
      const std::uint32_t mesh = assets().add(random_mesh());
      instances_.push_back(show_->world.create(WorldTransform{random_place()}, MeshInstance{mesh}));
    }
  }
  template <class T>
  void change_entities(std::vector<Entity>& list, const T& value) {
    World& world = show_->world;
    const std::uint32_t what = random(3);
    if ((what == 0 || list.empty()) && list.size() < kMostOfAKind / 2) {
      list.push_back(world.create(WorldTransform{random_place()}, value));
    } else if (what == 1 || list.empty()) {
      if (!list.empty()) remove_entity(list, list[random(static_cast<std::uint32_t>(list.size()))]);
    } else {
      const Entity entity = list[random(static_cast<std::uint32_t>(list.size()))];
      world.get<WorldTransform>(entity).matrix = random_place();
      world.mark_changed<WorldTransform>(entity);
      world.get<T>(entity) = value;
      world.mark_changed<T>(entity);
    }
  }
  void step() {
    const std::uint32_t what = random(16);
    const AssetKind kinds[] = {AssetKind::mesh, AssetKind::image, AssetKind::material};
    const AssetKind kind = kinds[random(3)];
    if (what < 5) return add_asset(kind);
    if (what < 8) return change_asset(kind);
    if (what < 11) {
      const AssetKind gone = random(4) == 0 ? AssetKind::texture : kind;
      return destroy(gone, random_of(gone));
    }
    if (what < 13) {
      Light lamp;
      lamp.color = vec3(random_unit(), random_unit(), random_unit());
      lamp.intensity = 20.0f + 60.0f * random_unit();
      lamp.range_m = 12.0f;
      lamp.width_m = 0.1f;
      return change_entities(lights_, lamp);
    }
    if (what < 15) return change_entities(proxies_, IbrProxy{.size_m = vec2(1.0f + random_unit(), 1.0f)});
    change_entities(emitters_, ParticleEmitter{.kind = random(2) == 0 ? EmitterKind::smoke : EmitterKind::fire,
                                               .rate = 5.0f + 20.0f * random_unit()});
  }
  /// Frames between two steps: mostly none or one, seldom up to 120.
  std::uint32_t random_gap() {
    const std::uint32_t what = random(100);
    return what < 55 ? 0 : what < 90 ? 1 + random(2) : what < 99 ? random(8) : random(121);
  }

  /// A world with the same living assets and entities, in their order.
  void build_anew(World& fresh) const {
    const SceneAssets& old = show_->world.resource<SceneAssets>();
    SceneAssets& made = fresh.resource<SceneAssets>();
    std::vector<std::uint32_t> places[4];
    const auto copy = [&](AssetKind kind, const auto& from, auto& to) {
      auto& list = places[static_cast<std::size_t>(kind)];
      list.assign(from.size(), kNone);
      for (const std::uint32_t i : living(old, kind)) {
        list[i] = static_cast<std::uint32_t>(to.size());
        to.push_back(from[i]);
      }
    };
    const auto renumber = [&](AssetKind kind, std::uint32_t& index) {
      if (index != kNone) index = places[static_cast<std::size_t>(kind)][index];
    };
    copy(AssetKind::image, old.images, made.images);
    copy(AssetKind::texture, old.textures, made.textures);
    copy(AssetKind::material, old.materials, made.materials);
    copy(AssetKind::mesh, old.meshes, made.meshes);
    for (Texture& texture : made.textures) renumber(AssetKind::image, texture.image);
    for (Material& material : made.materials) renumber(AssetKind::texture, material.base_color_texture.texture);
    for (Mesh& mesh : made.meshes)
      for (Primitive& primitive : mesh.primitives) renumber(AssetKind::material, primitive.material);
    const World& world = show_->world;
    copy_emitters(fresh);
    for (const Entity e : instances_) {
      MeshInstance instance = world.get<MeshInstance>(e);
      renumber(AssetKind::mesh, instance.mesh);
      fresh.create(world.get<WorldTransform>(e), instance);
    }
    for (const Entity e : lights_) fresh.create(world.get<WorldTransform>(e), world.get<Light>(e));
    for (const Entity e : proxies_) fresh.create(world.get<WorldTransform>(e), world.get<IbrProxy>(e));
  }
  /// The particles of an emitter depend on the index of its entity, so the copies have the same indices.
  void copy_emitters(World& fresh) const {
    const World& world = show_->world;
    std::vector<Entity> places, unused;
    for (const Entity e : emitters_)
      while (places.size() <= e.index) places.push_back(fresh.create(WorldTransform{}));
    for (const Entity place : places) {
      const auto original = std::ranges::find(emitters_, place.index, &Entity::index);
      if (original == emitters_.end()) {
        unused.push_back(place);
        continue;
      }
      fresh.add(place, world.get<WorldTransform>(*original));
      fresh.add(place, world.get<ParticleEmitter>(*original));
    }
    for (const Entity place : unused) fresh.destroy(place);
  }
  void compare(const MovingShow& reference, int step_number) {
    const Picture moved = show_->settled(show_->world);
    World fresh;
    reference.begin(fresh);
    build_anew(fresh);
    const Picture anew = reference.settled(fresh);
    reference.renderer->release_world(fresh);
    ASSERT_EQ(moved.rgba.size(), anew.rgba.size());
    std::size_t off = 0;
    for (std::size_t i = 0; i < moved.rgba.size(); i += 4)
      off += std::equal(&moved.rgba[i], &moved.rgba[i] + 3, &anew.rgba[i]) ? 0 : 1;
    EXPECT_EQ(off, 0u) << "pixels differ after step " << step_number;
    drawn_kinds_ += (instances_.empty() ? 0 : 1) + (lights_.empty() ? 0 : 1) + (emitters_.empty() ? 0 : 1);
  }

  std::mt19937 engine_{20};
  std::unique_ptr<MovingShow> show_;
  std::vector<Entity> instances_, lights_, proxies_, emitters_;
  int drawn_kinds_ = 0;  ///< that were in a compared picture, summed
};

TEST_F(WorldsInMotion, look_like_worlds_that_are_built_anew) {
  const MovingShow reference(Readiness::wait, std::uint64_t{8} << 20);
  const int steps = test::scaled(kSteps);
  int done = 0;
  for (const std::uint64_t budget : {std::uint64_t{4} << 10, std::uint64_t{64} << 10, std::uint64_t{8} << 20}) {
    SCOPED_TRACE("a budget of " + std::to_string(budget) + " bytes");
    for (auto* list : {&instances_, &lights_, &proxies_, &emitters_}) list->clear();
    show_ = std::make_unique<MovingShow>(Readiness::background, budget);
    for (int i = 0; i < steps / 3; ++i) {
      step();
      for (std::uint32_t gap = random_gap(); gap > 0 && !HasFatalFailure(); --gap) show_->draw(show_->world);
      if (++done % kStepsBetweenPictures == 0) compare(reference, done);
      ASSERT_FALSE(HasFailure()) << "after step " << done;
    }
  }
  EXPECT_GT(drawn_kinds_, done / kStepsBetweenPictures) << "the pictures show little";
}

}  // namespace
}  // namespace gloam

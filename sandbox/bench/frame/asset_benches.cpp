// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <glm/ext/matrix_transform.hpp>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "engine/scene/assets/mesh_builder.h"
#include "engine/scene/resources.h"
#include "modules/lights/components.h"
#include "modules/module_list/module_list.h"
#include "modules/shadows/components.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"

// Frames in which one asset of a scene of 20,000 primitives and 48 textures changes, against still frames of the same
// scene in alternation. A frame ends when the GPU has finished it.

namespace gloam {
namespace {

constexpr int kAssetSide = 141;  // boxes in a row: 19,881 of them
constexpr std::uint32_t kTextures = 48;
constexpr std::uint32_t kTextureSide = 1024;
constexpr int kAssetRounds = 9;

Mesh box_mesh(float half_m, std::uint32_t material) {
  Mesh mesh;
  Primitive& primitive = mesh.primitives.emplace_back();
  primitive.material = material;
  for (std::uint32_t corner = 0; corner < 8; ++corner)
    primitive.positions.push_back(
        half_m * vec3((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1));
  primitive.uv0.assign(8, vec2(0.3f));
  primitive.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                       2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  complete_mesh(mesh, {});
  return mesh;
}

Image asset_image_of(std::uint32_t side, std::uint8_t value) {
  return {"bench", side, side, std::vector<std::uint8_t>(std::size_t{4} * side * side, value)};
}

/// The scene with a renderer, on the device of a session.
class Field {
 public:
  Field(Session& session, Readiness readiness) : session_(session) {
    renderer_ = Renderer::create({.device = session.device.get(),
                                  .executor = session.executor.get(),
                                  .log = nullptr,
                                  .zones = nullptr,
                                  .modules = make_all_modules(),
                                  .readiness = readiness})
                    .value();
    renderer_->prepare_world(world_);
    for (std::uint32_t i = 0; i < kTextures; ++i) {
      const std::uint32_t image = assets().add(asset_image_of(kTextureSide, static_cast<std::uint8_t>(60 + 4 * i)));
      Material material;
      material.metallic = 0.0f;
      material.base_color_texture.texture = assets().add(Texture{.name = "bench", .image = image, .srgb = true});
      assets().add(material);
    }
    for (int i = 0; i < kAssetSide * kAssetSide; ++i) {
      const std::uint32_t mesh = assets().add(box_mesh(0.3f, static_cast<std::uint32_t>(i) % kTextures));
      world_.create(
          WorldTransform{glm::translate(dmat4(1.0), dvec3(i % kAssetSide - kAssetSide / 2, 0.0, -i / kAssetSide - 2))},
          MeshInstance{mesh});
    }
    Light sun;
    sun.kind = LightKind::directional;
    sun.intensity = 2.0f;
    world_.create(WorldTransform{glm::rotate(dmat4(1.0), -1.0, dvec3(1.0, 0.0, 0.0))}, sun,
                  ShadowCaster{.enabled = false});
    world_.resource<SceneEnvironment>().has_exposure = true;
    request_.settings.width = 640;
    request_.settings.height = 360;
    request_.settings.world_from_camera =
        glm::rotate(glm::translate(dmat4(1.0), dvec3(0.0, 12.0, 4.0)), -0.35, dvec3(1.0, 0.0, 0.0));
  }
  ~Field() {
    static_cast<void>(session_.device->wait_idle());
    renderer_->release_world(world_);
  }
  Field(const Field&) = delete;
  Field& operator=(const Field&) = delete;

  SceneAssets& assets() { return world_.resource<SceneAssets>(); }
  [[nodiscard]] Result<double> frame_ns() {
    const auto start = std::chrono::steady_clock::now();
    GLOAM_TRY(renderer_->render(world_, {&request_, 1}));
    GLOAM_TRY(renderer_->wait());
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
  }
  [[nodiscard]] std::size_t pending() { return renderer_->report().assets_pending; }
  [[nodiscard]] Result<std::uint64_t> picture_hash() {
    const auto picture = renderer_->read_picture(request_.settings.id);
    if (!picture) return picture.error();
    return hash_bytes(std::as_bytes(std::span(picture->rgba)));
  }

 private:
  Session& session_;
  std::unique_ptr<Renderer> renderer_;
  World world_;
  ViewRequest request_;
};

using AssetChange = std::function<void(SceneAssets& assets, int round)>;

/// Frames with a change against still frames.
Result<BenchValue> run_change(BenchContext& context, const AssetChange& change) {
  auto session = context.open_builtin("builtin:plain");
  if (!session) return session.error();
  Field field(**session, Readiness::wait);
  for (int warm = 0; warm < 3; ++warm)
    if (auto frame = field.frame_ns(); !frame) return frame.error();
  std::vector<double> changed, still;
  for (int round = -1; round < kAssetRounds; ++round) {
    change(field.assets(), round);
    const auto with = field.frame_ns();
    if (!with) return with.error();
    const auto without = field.frame_ns();
    if (!without) return without.error();
    if (round < 0) continue;  // warms up; buffers grow
    changed.push_back(*with);
    still.push_back(*without);
  }
  const auto hash = field.picture_hash();
  if (!hash) return hash.error();
  return ratio_of(changed, still, *hash);
}

/// The slowest frame while an image of 2048x2048 texels comes in the background, against a still frame.
Result<BenchValue> run_stream(BenchContext& context) {
  auto session = context.open_builtin("builtin:plain");
  if (!session) return session.error();
  Field field(**session, Readiness::background);
  for (int warm = 0; warm < 12; ++warm)
    if (auto frame = field.frame_ns(); !frame) return frame.error();
  std::vector<double> slowest, still;
  for (int round = 0; round < 3; ++round) {
    const auto without = field.frame_ns();
    if (!without) return without.error();
    field.assets().images[0] = asset_image_of(2048, static_cast<std::uint8_t>(90 + round));
    field.assets().mark_changed(AssetKind::image, 0);
    double most = 0.0;
    do {
      const auto frame = field.frame_ns();
      if (!frame) return frame.error();
      most = std::max(most, *frame);
    } while (field.pending() > 0);
    slowest.push_back(most);
    still.push_back(*without);
  }
  const auto hash = field.picture_hash();
  if (!hash) return hash.error();
  return ratio_of(slowest, still, *hash);
}

}  // namespace

void add_asset_benches(BenchRegistry& registry) {
  const auto add = [&](const char* id, std::optional<double> bar, AssetChange change) {
    registry.add({.id = id,
                  .unit = "ratio",
                  .bar = bar,
                  .better = Better::lower,
                  .run = [change = std::move(change)](BenchContext& context) { return run_change(context, change); }});
  };
  add("assets.color_over_still", 1.25, [](SceneAssets& assets, int round) {
    assets.materials[7].base_color.x = 0.5f + 0.01f * static_cast<float>(round);
    assets.mark_changed(AssetKind::material, 7);
  });
  add("assets.mesh_over_still", 1.25, [](SceneAssets& assets, int round) {
    assets.meshes[70] = box_mesh(0.3f + 0.01f * static_cast<float>(round), 7);
    assets.mark_changed(AssetKind::mesh, 70);
  });
  add("assets.image_over_still", std::nullopt, [](SceneAssets& assets, int round) {
    assets.images[7] = asset_image_of(kTextureSide, static_cast<std::uint8_t>(100 + round));
    assets.mark_changed(AssetKind::image, 7);
  });
  add("assets.everything_over_still", std::nullopt, [](SceneAssets& assets, int) { ++assets.version; });
  registry.add({.id = "assets.slowest_streaming_frame_over_still",
                .unit = "ratio",
                .bar = std::nullopt,
                .better = Better::lower,
                .run = &run_stream});
}

}  // namespace gloam

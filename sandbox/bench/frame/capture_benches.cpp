// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <glm/ext/matrix_transform.hpp>
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "engine/core/hash.h"
#include "sandbox/bench/harness/benches.h"
#include "sandbox/bench/harness/context.h"
#include "sandbox/bench/harness/measure.h"

// Four captures of cubes around the camera, 128 pixels a side, in one frame: 24 views, against the same views drawn one
// by one. The scene rests, so shadow maps come from the cache in both cases.

namespace gloam {
namespace {

constexpr std::uint32_t kCaptureSide = 128;
constexpr std::uint32_t kCubes = 4;
constexpr std::uint32_t kCaptureViews = 6 * kCubes;
constexpr std::uint32_t kFirstView = 1000;
constexpr int kCaptureRounds = 5;

/// The images that the views capture into; destroyed with their views at the end.
class Cubes {
 public:
  explicit Cubes(Session& session) : session_(session) {}
  Cubes(const Cubes&) = delete;
  Cubes& operator=(const Cubes&) = delete;
  ~Cubes() {
    static_cast<void>(session_.renderer->wait());
    for (std::uint32_t view = 0; view < kCaptureViews; ++view)
      session_.renderer->release_view(session_.world, ViewId{kFirstView + view});
    for (const gpu::ImageHandle image : images_)
      if (image) session_.device->destroy(image);
  }

  [[nodiscard]] Status create() {
    for (gpu::ImageHandle& image : images_) {
      auto made = session_.device->create_image({.name = "capture",
                                                 .module = "bench",
                                                 .format = gpu::Format::rgba16_float,
                                                 .width = kCaptureSide,
                                                 .height = kCaptureSide,
                                                 .layers = 6,
                                                 .usage = gpu::ImageUsage::color_target | gpu::ImageUsage::sampled,
                                                 .shape = gpu::ImageShape::cube});
      if (!made.ok()) return made.error();
      image = *made;
    }
    return {};
  }

  /// Views around `eye`, cube after cube. All content of a cube is drawn in each frame.
  [[nodiscard]] std::vector<ViewRequest> requests(const dvec3& eye) const {
    std::vector<ViewRequest> requests;
    for (std::uint32_t i = 0; i < kCaptureViews; ++i) {
      const std::uint32_t cube = i / 6, face = i % 6;
      dvec3 forward(0.0);
      forward[static_cast<int>(face / 2)] = face % 2 == 0 ? 1.0 : -1.0;
      const dvec3 up = face / 2 == 1 ? dvec3(0.0, 0.0, 1.0) : dvec3(0.0, 1.0, 0.0);
      ViewRequest& request = requests.emplace_back();
      ViewSettings& settings = request.settings;
      settings.id = ViewId{kFirstView + i};
      settings.purpose = ViewPurpose::capture;
      settings.width = settings.height = kCaptureSide;
      settings.camera.fov_y = std::numbers::pi_v<float> / 2.0f;
      settings.world_from_camera = glm::inverse(glm::lookAt(dvec3(0.0), forward, up));
      settings.world_from_camera[3] =
          dvec4(eye + dvec3(cube % 2 == 0 ? -1.0 : 1.0, 0.0, cube / 2 == 0 ? -1.0 : 1.0), 1.0);
      request.target.light = LightTarget{.image = images_[cube], .layer = face};
    }
    return requests;
  }

 private:
  Session& session_;
  std::array<gpu::ImageHandle, kCubes> images_{};
};

Result<double> frame_ns(Session& session, std::span<const ViewRequest> requests) {
  const auto start = std::chrono::steady_clock::now();
  GLOAM_TRY(session.renderer->render(session.world, requests));
  GLOAM_TRY(session.renderer->wait());
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

Result<BenchValue> run_captures(BenchContext& context) {
  auto session = context.session();
  if (!session) return session.error();
  Cubes cubes(**session);
  GLOAM_TRY(cubes.create());
  const ViewSettings main = (*session)->view_settings(kCaptureSide, kCaptureSide, "none");
  ViewSettings placed = main;
  follow_camera((*session)->world, placed);
  const std::vector<ViewRequest> requests = cubes.requests(dvec3(placed.world_from_camera[3]));
  std::vector<double> together, alone;
  for (int round = -1; round < kCaptureRounds; ++round) {  // one round warms up
    auto all = frame_ns(**session, requests);
    if (!all) return all.error();
    double sum = 0.0;
    for (const ViewRequest& request : requests) {
      auto one = frame_ns(**session, {&request, 1});
      if (!one) return one.error();
      sum += *one;
    }
    if (round < 0) continue;
    together.push_back(*all);
    alone.push_back(sum);
  }
  auto light = (*session)->renderer->read_linear(ViewId{kFirstView});
  if (!light) return light.error();
  return ratio_of(std::move(together), std::move(alone), hash_bytes(std::as_bytes(std::span(light->rgba))));
}

}  // namespace

void add_frame_capture_benches(BenchRegistry& registry) {
  registry.add({.id = "frame.captures.24_over_24_alone",
                .unit = "ratio",
                .bar = 1.0,
                .better = Better::lower,
                .run = &run_captures});
}

}  // namespace gloam

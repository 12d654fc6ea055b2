// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/math/packing.h"
#include "engine/render/readback/capture.h"
#include "engine/scene/resources.h"
#include "modules/particles/baked_light.h"
#include "modules/particles/components.h"
#include "modules/particles/emitters/visible.h"
#include "modules/particles/frame.h"
#include "tests/modules/lighting/guest_module.h"

namespace gloam::test {

/// The particles of one view of one frame, read back.
struct ParticleCopy {
  RenderView view;
  shaders::ParticleFrame constants{};
  bool two_digits = false;
  std::uint32_t lit_points = 0;
  shaders::ParticleDraws draws{};
  std::vector<shaders::Particle> particles;  ///< by place
  std::vector<std::uint32_t> keys;           ///< by place
  std::vector<std::uint32_t> order;
  std::vector<uvec2> light;

  /// View depth of a particle.
  [[nodiscard]] double depth(const shaders::Particle& p) const {
    const mat4& m = view.view_from_relative;
    return -glm::dot(dvec3(m[0][2], m[1][2], m[2][2]), dvec3(p.position));
  }
  /// The drawn particles in the order in which they are blended.
  [[nodiscard]] std::vector<shaders::Particle> drawn() const {
    std::vector<shaders::Particle> found;
    for (std::uint32_t i = 0; i < draws.drawn; ++i) found.push_back(particles.at(order.at(i)));
    return found;
  }
  [[nodiscard]] vec3 light_at(std::size_t point) const {
    const auto half = [](std::uint32_t bits) { return half_to_float(static_cast<std::uint16_t>(bits)); };
    return {half(light.at(point).x), half(light.at(point).x >> 16), half(light.at(point).y)};
  }
};

/// A renderer of all modules with a world, and copies of the particles of the last frame. Time stands still until
/// set_time() is called.
class ParticleStage {
 public:
  explicit ParticleStage(std::unique_ptr<JobExecutor> executor = make_pool_executor(2))
      : executor_(std::move(executor)) {
    RendererOptions made;
    made.device = shared_device();
    made.executor = executor_.get();
    made.log = &log_;
    made.modules = make_all_modules();
    made.modules.push_back(std::make_unique<GuestModule>(guest_));
    renderer = value_of(Renderer::create(std::move(made)));
    set("shadows.mode", "off");
    renderer->prepare_world(world);
    set_time(0.0);
  }
  ~ParticleStage() {
    for (auto& [view, captures] : captures_) captures.reset();
    renderer.reset();
  }
  ParticleStage(const ParticleStage&) = delete;
  ParticleStage& operator=(const ParticleStage&) = delete;

  Entity emitter(const ParticleEmitter& values, const dvec3& at = dvec3(0.0)) {
    return world.create(values, WorldTransform{glm::translate(dmat4(1.0), at)});
  }
  Entity lamp(const dvec3& at, const vec3& color, float candela, float range_m = 0.0f) {
    Light light;
    light.color = color;
    light.intensity = candela;
    light.range_m = range_m;
    return world.create(light, WorldTransform{glm::translate(dmat4(1.0), at)});
  }
  void set(std::string_view knob, std::string_view value) {
    ASSERT_TRUE(renderer->knobs().set(knob, value).ok()) << knob << "=" << value;
  }
  void set_time(double time_s) { world.resource<SceneClock>().time_s = time_s; }

  void draw(std::span<const ViewSettings> views) {
    std::vector<ViewRequest> requests;
    for (const ViewSettings& view : views) requests.push_back({view, {}});
    for (auto& [view, captures] : captures_) captures.reset();
    copies_.clear();
    const Status drawn = renderer->render(world, requests);
    ASSERT_TRUE(drawn.ok()) << drawn.error().message;
    ASSERT_TRUE(renderer->wait().ok());
  }
  void draw(const ViewSettings& view) { draw(std::span(&view, 1)); }
  [[nodiscard]] std::vector<float> linear(ViewId view = ViewId{0}) {
    return value_of(renderer->read_linear(view)).rgba;
  }
  /// Values of a visualizer's image.
  [[nodiscard]] std::vector<vec4> shown(ViewSettings view, const std::string& visualizer) {
    view.visualizer = visualizer;
    draw(view);
    const ImageBytes image = value_of(renderer->read_image(world, view.id, visualizer));
    std::vector<vec4> values(image.bytes.size() / 8);
    for (std::size_t i = 0; i < values.size() * 4; ++i) {
      std::uint16_t half = 0;
      std::memcpy(&half, image.bytes.data() + 2 * i, 2);
      values[i / 4][static_cast<int>(i % 4)] = half_to_float(half);
    }
    return values;
  }
  [[nodiscard]] bool has_particles(ViewId view = ViewId{0}) const { return copies_.contains(view.value); }
  [[nodiscard]] ParticleCopy copy(ViewId view = ViewId{0}) {
    if (!has_particles(view)) {
      ADD_FAILURE() << "view " << view.value << " has no particles";
      return {};
    }
    ParticleCopy found = copies_.at(view.value);
    Captures& captures = *captures_.at(view.value);
    EXPECT_TRUE(renderer->wait().ok());
    captures.finish();
    found.draws = captures.item<shaders::ParticleDraws>("draws", 0);
    found.particles = items<shaders::Particle>(captures, "particles");
    found.keys = items<std::uint32_t>(captures, "keys");
    found.order = items<std::uint32_t>(captures, "order");
    found.light = items<uvec2>(captures, "light");
    return found;
  }

  World world;
  SceneMaker scene{world};
  std::unique_ptr<Renderer> renderer;

 private:
  template <class T>
  [[nodiscard]] static std::vector<T> items(const Captures& captures, std::string_view name) {
    const std::span<const std::byte> bytes = captures.bytes(name);
    std::vector<T> found(bytes.size() / sizeof(T));
    if (!found.empty()) std::memcpy(found.data(), bytes.data(), found.size() * sizeof(T));
    return found;
  }
  void watch(FrameBuilder& frame) {
    const auto* board = frame.find<ParticlesFrame>();
    if (board == nullptr) return;
    const std::uint32_t view = frame.view().id.value;
    ParticleCopy& copy = copies_[view];
    copy.view = frame.view();
    copy.constants = board->inputs.constants;
    copy.two_digits = board->inputs.two_digits;
    copy.lit_points = lit_points(board->inputs.lighting);
    auto& captures = captures_[view];
    captures = std::make_unique<Captures>(*shared_device());
    const std::pair<const char*, BufferRef> buffers[] = {{"draws", board->sorted.draws},
                                                         {"particles", board->simulated.state},
                                                         {"keys", board->simulated.keys},
                                                         {"order", board->sorted.order},
                                                         {"light", board->light}};
    for (const auto& [name, buffer] : buffers)
      if (buffer) {
        EXPECT_TRUE(captures->add(frame.graph(), name, buffer).ok());
      }
  }

  std::unique_ptr<JobExecutor> executor_;
  LogSink& log_ = gpu_log();
  GuestModule::Passes guest_ = [this](FrameBuilder& frame, PassPhase phase) {
    if (phase == PassPhase::post) watch(frame);
  };
  std::map<std::uint32_t, ParticleCopy> copies_;
  std::map<std::uint32_t, std::unique_ptr<Captures>> captures_;
};

/// Every test must end without validation messages.
class ParticleTest : public ::testing::Test {
 protected:
  void SetUp() override {
    GLOAM_REQUIRE_GPU(shared_device());
    GLOAM_REQUIRE_DEPTH_TESTS(shared_device());
    messages_ = shared_device()->validation_messages();
  }
  void TearDown() override {
    if (shared_device() != nullptr) {
      EXPECT_EQ(shared_device()->validation_messages(), messages_);
    }
  }
  /// A cloud of this kind about 2 m wide.
  [[nodiscard]] static ParticleEmitter cloud(EmitterKind kind, float rate, float lifetime_s = 1.0f) {
    ParticleEmitter values;
    values.kind = kind;
    values.rate = rate;
    values.lifetime_s = lifetime_s;
    values.size_m = 0.3f;
    values.speed = 0.2f;
    values.spread = kPi;
    values.box_m = vec3(1.5f, 1.0f, 1.5f);
    return values;
  }
  [[nodiscard]] static ViewSettings front(double distance = 4.0) {
    return look_at(dvec3(0.2, 0.3, distance), dvec3(0.0, 0.1, 0.0), 64, 48);
  }

 private:
  std::uint64_t messages_ = 0;
};

}  // namespace gloam::test

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/math/packing.h"
#include "engine/render/readback/capture.h"
#include "engine/render/readback/geometry_picture.h"
#include "modules/grass/components.h"
#include "modules/grass/field/grow.h"
#include "modules/grass/frame.h"
#include "tests/modules/lighting/guest_module.h"
#include "tests/render/frame/failing_module.h"
#include "tests/support/scale.h"

namespace gloam::test {

/// The grass of one view of one frame, read back.
struct GrassCopy {
  std::vector<ResidentPatch> patches;  ///< of the patch rows
  std::uint32_t slot_masters = 0;
  shaders::GrassLod lod{};
  shaders::GrassSteps steps{};
  shaders::GrassDraws draws{};
  shaders::GrassDispatch dispatch{};
  std::vector<std::uint32_t> blades;
  std::vector<vec4> knots;
  std::vector<vec4> previous_knots;

  /// Knots of the masters of the live blades, by slot of the master in the field.
  [[nodiscard]] std::map<std::uint32_t, std::vector<vec4>> live_knots(const GrassField& field) const {
    std::map<std::uint32_t, std::vector<vec4>> found;
    for (std::uint32_t i = 0; i < draws.live; ++i) {
      const ResidentPatch& resident = patches[blades[i] / GLOAM_GRASS_PATCH_BLADES];
      const std::uint32_t slot = resident.patch * GLOAM_GRASS_PATCH_BLADES + blades[i] % GLOAM_GRASS_PATCH_BLADES;
      const std::uint32_t master = field.blades[slot].master;
      const std::uint32_t place = resident.slot * slot_masters + master % GLOAM_GRASS_PATCH_BLADES;
      const auto first = knots.begin() + std::ptrdiff_t{place} * GLOAM_GRASS_KNOTS;
      found[master].assign(first, first + GLOAM_GRASS_KNOTS);
    }
    return found;
  }
};

struct StageOptions {
  std::unique_ptr<JobExecutor> executor = make_pool_executor(2);
  bool shadows = false;
  bool motion = false;  ///< frames have GeometryOutputs::motion
};

/// A renderer of all modules with a world, and copies of the grass's buffers of the last frame. Time rests until
/// run_at() is called.
class GrassStage {
 public:
  explicit GrassStage(StageOptions options = {}) : executor_(std::move(options.executor)) {
    RendererOptions made;
    made.device = shared_device();
    made.executor = executor_.get();
    made.log = &gpu_log();
    made.modules = make_all_modules();
    made.modules.push_back(std::make_unique<FailingModule>());
    made.modules.push_back(std::make_unique<GuestModule>(guest_, options.motion));
    renderer = value_of(Renderer::create(std::move(made)));
    if (!options.shadows) set("shadows.mode", "off");
    set("grass.far_steps", "one");  // small pictures would show all blades as far ones
    renderer->prepare_world(world);
    run_at(0.0);
    world.resource<SceneEnvironment>() = {
        .sky_zenith = vec3(0.5f), .sky_horizon = vec3(0.5f), .sky_ground = vec3(0.5f)};
  }
  ~GrassStage() {
    for (auto& [view, captures] : captures_) captures.reset();
    renderer.reset();
  }
  GrassStage(const GrassStage&) = delete;
  GrassStage& operator=(const GrassStage&) = delete;

  /// A level square that grows this many blades.
  Entity lawn(float half_m, std::uint32_t blades, const dvec3& at = dvec3(0.0), GrassSurface values = {}) {
    Material soil;
    soil.base_color = vec4(0.5f, 0.5f, 0.5f, 1.0f);
    soil.metallic = 0.0f;
    soil.roughness = 1.0f;
    const Entity entity = scene.draw(scene.mesh(quad(half_m, scene.material(soil))), lying(at));
    values.density = static_cast<float>(blades) / (4.0f * half_m * half_m);
    world.add(entity, values);
    return entity;
  }
  [[nodiscard]] static dmat4 lying(const dvec3& at) {
    return glm::rotate(glm::translate(dmat4(1.0), at), -1.57079632679489661923, dvec3(1.0, 0.0, 0.0));
  }
  Entity sun(const dvec3& direction) {
    Light light;
    light.kind = LightKind::directional;
    light.intensity = 3.0f;
    const dvec3 z = -glm::normalize(direction);
    const dvec3 x = glm::normalize(glm::cross(std::abs(z.y) < 0.9 ? dvec3(0.0, 1.0, 0.0) : dvec3(1.0, 0.0, 0.0), z));
    dmat4 matrix(1.0);
    matrix[0] = dvec4(x, 0.0);
    matrix[1] = dvec4(glm::cross(z, x), 0.0);
    matrix[2] = dvec4(z, 0.0);
    return world.create(light, WorldTransform{matrix});
  }
  void wind(const vec3& velocity, float gust, const dvec3& at = dvec3(0.0)) {
    world.create(Wind{velocity, gust}, WorldTransform{glm::translate(dmat4(1.0), at)});
  }
  void set(std::string_view knob, std::string_view value) {
    ASSERT_TRUE(renderer->knobs().set(knob, value).ok()) << knob << "=" << value;
  }
  /// Seconds of each frame from now on.
  void run_at(double dt_s) { world.resource<SceneClock>().dt_s = dt_s; }

  /// Draws a frame of these views.
  [[nodiscard]] Status try_draw(std::span<const ViewSettings> views) {
    SceneClock& clock = world.resource<SceneClock>();
    const double before_s = clock.time_s;
    clock.time_s += clock.dt_s;
    Status drawn = render(views);
    if (!drawn.ok()) clock.time_s = before_s;
    return drawn;
  }
  void draw(std::span<const ViewSettings> views) {
    const Status drawn = try_draw(views);
    ASSERT_TRUE(drawn.ok()) << drawn.error().message;
    ASSERT_TRUE(renderer->wait().ok());
  }
  void draw(const ViewSettings& view) { draw(std::span(&view, 1)); }
  void draw(const ViewSettings& view, int frames) {
    for (int i = 0; i < frames; ++i) draw(view);
  }
  /// Draws a frame of the view at this time, which may be before that of the last frame.
  void draw_at(double time_s, const ViewSettings& view) {
    world.resource<SceneClock>().time_s = time_s;
    const Status drawn = render(std::span(&view, 1));
    ASSERT_TRUE(drawn.ok()) << drawn.error().message;
    ASSERT_TRUE(renderer->wait().ok());
  }
  [[nodiscard]] LinearPicture linear(ViewId view = ViewId{0}) { return value_of(renderer->read_linear(view)); }
  [[nodiscard]] GeometryPicture geometry(ViewId view = ViewId{0}) {
    return value_of(renderer->read_geometry(world, view));
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
  [[nodiscard]] const GrassField& field() const { return world.resource<GrassField>(); }
  [[nodiscard]] bool has_grass(ViewId view = ViewId{0}) const { return copies_.contains(view.value); }
  /// The grass of a view of the last frame that was drawn, be it drawn again. It must have some.
  [[nodiscard]] GrassCopy copy(ViewId view = ViewId{0}) {
    if (!has_grass(view)) {
      ADD_FAILURE() << "view " << view.value << " has no grass";
      return {};
    }
    GrassCopy found = copies_.at(view.value);
    Captures& captures = *captures_.at(view.value);
    EXPECT_TRUE(renderer->wait().ok());
    captures.finish();
    found.draws = captures.item<shaders::GrassDraws>("draws", 0);
    found.dispatch = captures.item<shaders::GrassDispatch>("dispatch", 0);
    found.blades = items<std::uint32_t>(captures, "blades");
    found.knots = items<vec4>(captures, "knots");
    found.previous_knots = items<vec4>(captures, "previous_knots");
    return found;
  }

  World world;
  SceneMaker scene{world};
  std::unique_ptr<Renderer> renderer;

 private:
  [[nodiscard]] Status render(std::span<const ViewSettings> views) {
    std::vector<ViewRequest> requests;
    for (const ViewSettings& view : views) requests.push_back({view, {}});
    for (auto& [view, captures] : captures_) captures.reset();
    copies_.clear();
    return renderer->render(world, requests);
  }
  template <class T>
  [[nodiscard]] static std::vector<T> items(const Captures& captures, std::string_view name) {
    const std::span<const std::byte> bytes = captures.bytes(name);
    std::vector<T> found(bytes.size() / sizeof(T));
    if (!found.empty()) std::memcpy(found.data(), bytes.data(), found.size() * sizeof(T));
    return found;
  }
  /// Declares the copies of one view.
  void watch(FrameBuilder& frame) {
    const auto* board = frame.find<std::shared_ptr<GrassFrame>>();
    if (board == nullptr || (*board)->stored.patches.empty()) return;
    const GrassFrame& grass = **board;
    const std::uint32_t view = frame.view().id.value;
    copies_[view] = {grass.stored.patches, grass.stored.slot_masters, grass.lod, grass.steps};
    auto& captures = captures_[view];
    captures = std::make_unique<Captures>(*shared_device());
    const std::pair<const char*, BufferRef> buffers[] = {{"draws", grass.sorted.draws},
                                                         {"dispatch", grass.dispatch},
                                                         {"blades", grass.sorted.blades},
                                                         {"knots", grass.stored.store.knots},
                                                         {"previous_knots", grass.stored.store.previous_knots}};
    for (const auto& [name, buffer] : buffers) EXPECT_TRUE(captures->add(frame.graph(), name, buffer).ok());
  }

  std::unique_ptr<JobExecutor> executor_;
  GuestModule::Passes guest_ = [this](FrameBuilder& frame, PassPhase phase) {
    if (phase == PassPhase::translucent) watch(frame);
  };
  std::map<std::uint32_t, GrassCopy> copies_;
  std::map<std::uint32_t, std::unique_ptr<Captures>> captures_;
};

using LiveKnots = std::map<std::uint32_t, std::vector<vec4>>;

/// Greatest distance between knots of masters that both have, metres; infinite if they have none.
[[nodiscard]] inline double knot_distance(const LiveKnots& a, const LiveKnots& b) {
  double worst = 0.0;
  std::size_t common = 0;
  for (const auto& [master, knots] : a) {
    const auto other = b.find(master);
    if (other == b.end()) continue;
    for (std::size_t k = 0; k < knots.size(); ++k, ++common) {
      const double distance = glm::length(dvec3(knots[k]) - dvec3(other->second[k]));
      worst = distance <= worst ? worst : distance;  // a NaN counts
    }
  }
  return common > 0 ? worst : std::numeric_limits<double>::infinity();
}

/// The items, or fewer of them if tests are scaled down, evenly chosen.
template <class T>
[[nodiscard]] std::vector<T> some_of(const std::vector<T>& items) {
  const std::size_t count = std::min(items.size(), static_cast<std::size_t>(scaled(static_cast<int>(items.size()))));
  std::vector<T> some;
  for (std::size_t i = 0; i < count; ++i) some.push_back(items[(2 * i + 1) * items.size() / (2 * count)]);
  return some;
}

/// Every test must end without validation messages.
class GrassTest : public ::testing::Test {
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
  /// A camera before the middle of a small lawn.
  [[nodiscard]] static ViewSettings front(const dvec3& at = dvec3(0.0)) {
    return look_at(at + dvec3(0.1, 0.45, 1.3), at + dvec3(0.0, 0.12, 0.0), 96, 64);
  }
  [[nodiscard]] static ViewSettings without_grass(ViewSettings view) {
    view.without = {"grass"};
    return view;
  }
  [[nodiscard]] static std::size_t differences(const std::vector<float>& a, const std::vector<float>& b) {
    EXPECT_EQ(a.size(), b.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) count += a[i] != b[i] ? 1 : 0;
    return count;
  }

 private:
  std::uint64_t messages_ = 0;
};

}  // namespace gloam::test

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "tests/soak/host.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "engine/render/pipelines/pipelines.h"
#include "engine/scene/assets.h"
#include "engine/scene/resources.h"
#include "engine/scene/systems.h"
#include "modules/lights/components.h"
#include "modules/module_list/module_list.h"
#include "sandbox/session/loading/scene_loading.h"
#include "tests/soak/live_heap.h"
#include "tests/support/lent_device.h"
#include "tests/support/render_scene.h"

namespace gloam::soak {
namespace {

constexpr double kFrameS = 1.0 / 30.0;
/// Frames until maps, lists and histories of a state at rest have settled, at least.
constexpr std::uint32_t kSettlingFrames = 12;
/// Streaming goes on over many frames.
constexpr std::uint64_t kUploadBudget = std::uint64_t{128} << 10;

void check(const Status& status) {
  if (!status.ok()) throw std::runtime_error(status.error().message);
}
template <class T>
T value_of(Result<T> result) {
  if (!result.ok()) throw std::runtime_error(result.error().message);
  return std::move(*result);
}

/// Numbers in [0, 1] that depend on the number of a streamed thing.
double share(std::uint32_t number, std::uint32_t which) {
  std::uint32_t bits = number * 2654435761u + which * 2246822519u;
  bits = (bits ^ (bits >> 15)) * 2246822519u;
  bits = (bits ^ (bits >> 13)) * 3266489917u;
  return static_cast<double>(bits >> 8) / 16777215.0;
}

}  // namespace

Host::Host(bool validate) {
  owner_ = test::make_test_device(validate);
  if (owner_ == nullptr) return;
  gpu::HostDevice host = test::lend(*owner_, features_);
  host.get_instance_proc_addr = test::CallWatch::loader();
  host.allocation_callbacks = callbacks_.get();
  blocks_ = std::make_unique<OwnBlocks>(host);
  host.memory_allocator = blocks_.get();
  device_ = value_of(gpu::create_vulkan_device_on(host));
  RendererOptions options;
  options.device = device_.get();
  options.executor = executor_.get();
  options.log = &test::gpu_log();
  options.modules = make_all_modules();
  options.readiness = Readiness::background;
  options.upload_budget = kUploadBudget;
  renderer_ = value_of(Renderer::create(std::move(options)));
}

Host::~Host() { unload_scene(); }

void Host::load_scene(const std::string& scene) {
  unload_scene();
  world_ = std::make_unique<World>();
  renderer_->prepare_world(*world_);
  const SceneInfo info = value_of(
      gloam::load_scene({.scene = "builtin:" + scene}, renderer_->modules(), *world_, *executor_, test::gpu_log()));
  world_->resource<SceneEnvironment>().has_exposure = true;  // else each camera's first frame meters it
  Schedule posing;
  add_scene_systems(posing);
  posing.run(Stage::world, *world_, *executor_);
  const std::vector<Entity> fitted = {kNoEntity};
  for (const Entity camera : info.cameras.empty() ? fitted : info.cameras) {
    cameras_.push_back(settings_for_camera(*world_, camera, 1, 1));
    cameras_.back().follow_camera = false;
  }
}

void Host::unload_scene() {
  if (world_ == nullptr) return;
  meshes_.clear();
  lamps_.clear();
  cameras_.clear();
  renderer_->release_world(*world_);
  world_.reset();
}

dmat4 Host::place_of(std::uint32_t number) const {
  const dvec3 place(4.0 * share(number, 0) - 2.0, 2.0 * share(number, 1) - 1.0, -2.0 - 4.0 * share(number, 2));
  return glm::translate(cameras_.front().world_from_camera, place);
}

void Host::add_mesh(std::uint32_t number) {
  auto& assets = world_->resource<SceneAssets>();
  Image image{"streamed", 16u << (number % 4), 64, {}};
  for (std::uint32_t i = 0; i < 4 * image.width * image.height; ++i)
    image.rgba.push_back(i % 4 == 3 ? std::uint8_t{255}
                                    : static_cast<std::uint8_t>(255.0 * share(number, i / 64 + i % 4)));
  Streamed made;
  made.image = assets.add(std::move(image));
  made.texture = assets.add(Texture{.name = "streamed", .image = made.image, .srgb = true});
  Material material{.name = "streamed", .metallic = 0.0f, .roughness = 0.6f};
  material.base_color_texture.texture = made.texture;
  made.material = assets.add(std::move(material));
  Mesh mesh{.name = "streamed"};
  const auto size = static_cast<float>(0.1 + 0.3 * share(number, 3));
  mesh.primitives.push_back(number % 2 == 0 ? test::box(vec3(size), made.material)
                                            : test::round_ball(size, 8 + number % 48, 4 + number % 32, made.material));
  mesh.primitives.back().uv0.assign(mesh.primitives.back().positions.size(), vec2(0.3f, 0.7f));
  mesh.bounds = mesh.primitives.back().bounds;
  made.mesh = assets.add(std::move(mesh));
  made.entity = world_->create(WorldTransform{place_of(number)}, MeshInstance{made.mesh});
  meshes_.emplace(number, made);
}

void Host::remove_mesh(const Streamed& streamed) {
  auto& assets = world_->resource<SceneAssets>();
  world_->destroy(streamed.entity);
  assets.destroy(AssetKind::mesh, streamed.mesh);
  assets.destroy(AssetKind::material, streamed.material);
  assets.destroy(AssetKind::texture, streamed.texture);
  assets.destroy(AssetKind::image, streamed.image);
}

Entity Host::add_lamp(std::uint32_t number) {
  Light lamp;
  lamp.kind = number % 3 == 0 ? LightKind::spot : LightKind::point;
  lamp.color = vec3(dvec3(share(number, 4), share(number, 5), share(number, 6)));
  lamp.intensity = static_cast<float>(5.0 + 20.0 * share(number, 7));
  lamp.range_m = 6.0f;
  lamp.width_m = 0.05f;
  return world_->create(WorldTransform{place_of(number)}, lamp);
}

void Host::set_knobs() {
  KnobRegistry& knobs = renderer_->knobs();
  for (const std::string& name : planned_knobs()) {
    const auto set = state_.knobs.find(name);
    const Knob& knob = *knobs.find(name);
    const std::string value = set != state_.knobs.end() ? set->second : value_text(knob, knob.default_number);
    if (knobs.text(knob) != value) check(knobs.set(name, value));
  }
}

void Host::show(const State& state) {
  const State before = std::exchange(state_, state);
  if (world_ == nullptr || before.scene != state.scene) load_scene(state.scene);
  const auto has = [](const std::vector<std::uint32_t>& list, std::uint32_t number) {
    return std::ranges::binary_search(list, number);
  };
  for (auto next = meshes_.begin(); next != meshes_.end();) {
    const auto mesh = next++;
    if (has(state.meshes, mesh->first)) continue;
    remove_mesh(mesh->second);
    meshes_.erase(mesh);
  }
  for (auto next = lamps_.begin(); next != lamps_.end();) {
    const auto lamp = next++;
    if (has(state.lamps, lamp->first)) continue;
    world_->destroy(lamp->second);
    lamps_.erase(lamp);
  }
  for (const std::uint32_t number : state.meshes)
    if (!meshes_.contains(number)) add_mesh(number);
  for (const std::uint32_t number : state.lamps)
    if (!lamps_.contains(number)) lamps_.emplace(number, add_lamp(number));
  for (std::uint32_t v = 0; v < state.views.size(); ++v)
    if (!state.views[v].drawn && before.views[v].drawn) renderer_->release_view(*world_, ViewId{v});
  set_knobs();
}

void Host::reload() {
  const State state = state_;
  unload_scene();
  show(state);
}

void Host::draw_frame(double turn, bool cut, Readiness readiness) {
  renderer_->set_readiness(readiness);
  world_->resource<SceneClock>() = {.time_s = time_s_, .dt_s = kFrameS};
  std::vector<ViewRequest> requests;
  for (std::uint32_t v = 0; v < state_.views.size(); ++v) {
    const ShownView& view = state_.views[v];
    if (!view.drawn) continue;
    ViewRequest& request = requests.emplace_back();
    request.settings = cameras_[view.camera % cameras_.size()];
    request.settings.id = ViewId{v};
    request.settings.width = view.width;
    request.settings.height = view.height;
    request.settings.without = view.without;
    request.settings.camera_cut = cut;
    request.settings.world_from_camera =
        glm::rotate(request.settings.world_from_camera, view.turn + turn, dvec3(0.0, 1.0, 0.0));
  }
  check(renderer_->render(*world_, requests));
  time_s_ += kFrameS;
  ++frames_;
}

void Host::draw(const Step& step) {
  if (step.has_budget) {
    const std::vector<FrontPoint> front = {{10.0, 0.3, {{"shadows.atlas", "1024"}, {"grass.density_scale", "0.3"}}},
                                           {20.0, 0.1, {{"shadows.atlas", "2048"}}},
                                           {30.0, 0.0, {}}};
    check(renderer_->set_budget({.ms = 15.0, .front = front}));
  }
  for (std::uint32_t i = 0; i < step.frames; ++i) {
    draw_frame(0.02 * (i + 1.0 - step.frames), step.cuts && i == 0, readiness_);
    if (step.has_budget) static_cast<void>(renderer_->add_frame_time({.ms = i % 8 < 4 ? 40.0 : 2.0}));
  }
  if (step.has_budget) renderer_->clear_budget();
  set_knobs();
}

void Host::complete() {
  for (int at_rest = 0; at_rest < 2;) {
    draw_frame(0.0, false, readiness_);
    const FrameReport report = renderer_->report();
    at_rest = report.assets_pending + report.pipelines_pending == 0 ? at_rest + 1 : 0;
  }
}

void Host::settle() {
  complete();
  for (std::uint32_t v = 0; v < state_.views.size(); ++v) renderer_->release_view(*world_, ViewId{v});
  time_s_ = 0.0;
  const std::uint32_t frames = std::max(kSettlingFrames, renderer_->frames_to_rest(*world_));
  // The views' modules were released with their pipelines.
  for (std::uint32_t i = 0; i < frames; ++i) draw_frame(0.0, i == 0, Readiness::wait);
}

std::vector<std::uint8_t> Host::pictures() {
  std::vector<std::uint8_t> bytes;
  for (std::uint32_t v = 0; v < state_.views.size(); ++v) {
    if (!state_.views[v].drawn) continue;
    const Picture picture = value_of(renderer_->read_picture(ViewId{v}));
    // A portable pixmap each, so that a difference can be looked at.
    const std::string header =
        "P6\n" + std::to_string(picture.width) + " " + std::to_string(picture.height) + "\n255\n";
    bytes.insert(bytes.end(), header.begin(), header.end());
    for (std::size_t i = 0; i < picture.rgba.size(); ++i)
      if (i % 4 != 3) bytes.push_back(picture.rgba[i]);
  }
  return bytes;
}

LiveBytes Host::live_bytes() {
  // The host waits until pipelines that only earlier states used count as unused. The base state's are then asked for.
  complete();
  for (std::uint64_t i = 0; i < Pipelines::kUnusedFrames; ++i) check(renderer_->render(*world_, {}));
  settle();
  renderer_->free_idle_memory();
  const LiveHeap heap = live_heap();
  unload_scene();
  for (std::uint32_t v = 0; v < state_.views.size(); ++v) renderer_->release_view(ViewId{v});
  renderer_->free_idle_memory();
  return {heap.program, heap.libraries, callbacks_.live_bytes(), static_cast<std::int64_t>(watch_.live_bytes())};
}

}  // namespace gloam::soak

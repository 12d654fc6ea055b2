// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// A host that draws its own shadow casters into gloam's shadow maps, with its own pipelines and buffers: a skinned mesh
// whose bones it moves, and 10,000 instances. Only their shadows are in the picture: the casters are above the camera.
// The picture must be the one that gloam draws of meshes of the same triangles, and a point behind a caster must be
// dark by rays. Maps of casters that rest are kept; nothing is kept of a caster about which the host tells nothing.
// Exit code 77: there is no Vulkan device.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <glm/ext/matrix_transform.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "checks.h"
#include "engine/gpu/vulkan_device.h"
#include "engine/gpu/vulkan_interop.h"
#include "engine/render/readback/picture.h"
#include "engine/render/renderer.h"
#include "little_world.h"
#include "modules/module_list/module_list.h"
#include "native_casters.h"
#include "thread_executor.h"
#include "vulkan_host.h"

namespace {

namespace gpu = gloam::gpu;
using gloam::dvec3, gloam::vec3, gloam::vec4;
using Texels = std::vector<std::uint8_t>;

constexpr std::uint32_t kWidth = 160, kHeight = 90;
constexpr double kEyeHeight = 1.0;
constexpr std::uint32_t kCubes = 10000;
const dvec3 kLamp(0.3, 4.0, 0.2);

using host::check;
using host::fail;
using host::value_of;

/// 10,000 cubes of different sizes at different heights, all above the camera.
host::Cubes make_cubes() {
  host::Cubes cubes;
  std::uint32_t state = 1;
  const auto random = [&state] {
    state = state * 1664525u + 1013904223u;
    return static_cast<float>(state >> 8) / 16777216.0f;
  };
  for (std::uint32_t i = 0; i < kCubes; ++i) {
    const vec3 cell(static_cast<float>(i % 100) - 49.5f, 0.0f, static_cast<float>(i / 100) - 49.5f);
    cubes.emplace_back(0.07f * cell + vec3(0.02f * random(), 1.6f + 0.6f * random(), 0.02f * random()),
                       0.005f + 0.015f * random());
  }
  return cubes;
}

/// The picture's camera looks down.
gloam::ViewSettings camera() {
  gloam::ViewSettings settings;
  settings.width = kWidth;
  settings.height = kHeight;
  settings.world_from_camera = glm::rotate(glm::translate(gloam::dmat4(1.0), dvec3(0.0, kEyeHeight, 0.0)),
                                           -0.5 * 3.14159265358979, dvec3(1.0, 0.0, 0.0));
  return settings;
}

/// The point of the floor in the middle of a pixel.
dvec3 floor_point(std::uint32_t x, std::uint32_t y) {
  const gloam::ViewSettings settings = camera();
  const double half = std::tan(0.5 * static_cast<double>(settings.camera.fov_y)) * kEyeHeight;
  const double across = (2.0 * (x + 0.5) / kWidth - 1.0) * half * kWidth / kHeight;
  return {across, 0.0, (2.0 * (y + 0.5) / kHeight - 1.0) * half};
}

/// Whether a cube or a triangle of the mesh is between two points, in double.
bool hidden(const dvec3& from, const dvec3& to, const host::Cubes& cubes, const host::SkinnedMesh& mesh,
            const std::vector<vec3>& posed) {
  const dvec3 step = to - from;
  for (const vec4& cube : cubes) {
    double enter = 0.0, leave = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (static_cast<double>(cube[axis]) - static_cast<double>(cube.w) - from[axis]) / step[axis];
      const double b = (static_cast<double>(cube[axis]) + static_cast<double>(cube.w) - from[axis]) / step[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (enter < leave) return true;
  }
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const dvec3 a = posed[mesh.indices[i]];
    const dvec3 ab = dvec3(posed[mesh.indices[i + 1]]) - a, ac = dvec3(posed[mesh.indices[i + 2]]) - a;
    const dvec3 p = glm::cross(step, ac), s = from - a, q = glm::cross(s, ab);
    const double determinant = glm::dot(ab, p);
    const double u = glm::dot(s, p) / determinant, v = glm::dot(step, q) / determinant;
    const double t = glm::dot(ac, q) / determinant;
    if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < 1.0) return true;
  }
  return false;
}

/// Who draws the casters.
enum class Casters { none, meshes, host };

/// A renderer with a world: a floor, lights and casters.
struct Scene {
  bool lamp = true;
  bool sun = false;
  bool sharp = false;  ///< shadows without filter
};

class Stage {
 public:
  Stage(gpu::Device& device, gloam::LogSink& log, const host::NativeDrawing& drawing, const host::SkinnedMesh& mesh,
        const host::Cubes& cubes, Casters casters, const Scene& scene)
      : mesh_(mesh), cubes_(cubes) {
    gloam::ModuleList modules;
    if (casters == Casters::host) modules.push_back(host::make_native_casters(drawing, mesh, cubes, counts));
    for (auto& module : gloam::make_all_modules()) modules.push_back(std::move(module));
    renderer_ = value_of(gloam::Renderer::create(
        {.device = &device, .executor = &executor_, .log = &log, .modules = std::move(modules)}));
    check(renderer_->knobs().set("lighting.dither", "off"));
    check(renderer_->knobs().set("shadows.casters", "full"));
    if (scene.sharp) check(renderer_->knobs().set("shadows.filter", "hard"));
    renderer_->prepare_world(world_);
    add_floor();
    if (casters == Casters::meshes) add_meshes();
    if (casters == Casters::host) add_volumes();
    add_lights(scene);
    check(renderer_->knobs().set("scene.reuse", "exact"));
  }
  ~Stage() { renderer_->release_world(world_); }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  void draw(int frames = 1) {
    gloam::ViewRequest request;
    request.settings = camera();
    for (int i = 0; i < frames; ++i) check(renderer_->render(world_, {&request, 1}));
  }
  Texels picture() {
    draw(4);
    return value_of(renderer_->read_picture(gloam::ViewId{})).rgba;
  }
  [[nodiscard]] bool kept() const { return renderer_->report().kept; }
  /// Follows the bones with the box by which cascades are fitted.
  void update_volumes() {
    const gloam::WorldBox box = mesh_.bounds(0.0);
    world_.get<gloam::CasterVolume>(mesh_volume_) = {box.min, box.max};
  }

  host::NativeCounts counts;

 private:
  std::uint32_t add_mesh(gloam::Primitive primitive) {
    auto& assets = world_.resource<gloam::SceneAssets>();
    gloam::Material material;
    material.base_color = vec4(0.5f, 0.5f, 0.5f, 1.0f);
    material.metallic = 0.0f;
    material.roughness = 1.0f;
    material.double_sided = true;
    assets.materials.push_back(material);
    primitive.material = static_cast<std::uint32_t>(assets.materials.size() - 1);
    gloam::Mesh mesh;
    mesh.bounds = primitive.bounds;
    mesh.primitives.push_back(std::move(primitive));
    assets.meshes.push_back(std::move(mesh));
    ++assets.version;
    return static_cast<std::uint32_t>(assets.meshes.size() - 1);
  }
  void place(std::uint32_t mesh, const dvec3& at = dvec3(0.0)) {
    world_.create(gloam::LocalTransform{.translation = at}, gloam::WorldTransform{}, gloam::MeshInstance{mesh});
  }
  void add_floor() { place(add_mesh(host::box(vec3(8.0f, 0.1f, 8.0f), 0)), dvec3(0.0, -0.1, 0.0)); }
  void add_meshes() {
    gloam::Primitive all;
    for (const vec4& cube : cubes_) {
      const auto first = static_cast<std::uint32_t>(all.positions.size());
      const gloam::Primitive one = host::box(vec3(cube.w), 0);
      for (const vec3& position : one.positions) all.positions.push_back(vec3(cube) + position);
      all.normals.insert(all.normals.end(), one.normals.begin(), one.normals.end());
      for (const std::uint32_t index : one.indices) all.indices.push_back(first + index);
    }
    for (const vec3& position : all.positions) all.bounds.grow(position);
    place(add_mesh(std::move(all)));
    gloam::Primitive column;
    column.positions = mesh_.posed();
    column.normals.assign(column.positions.size(), vec3(0.0f, 1.0f, 0.0f));
    column.indices = mesh_.indices;
    for (const vec3& position : column.positions) column.bounds.grow(position);
    place(add_mesh(std::move(column)));
  }
  void add_volumes() {
    const gloam::WorldBox cubes = host::bounds_of(cubes_), mesh = mesh_.bounds(0.0);
    world_.create(gloam::CasterVolume{cubes.min, cubes.max});
    mesh_volume_ = world_.create(gloam::CasterVolume{mesh.min, mesh.max});
  }
  void add_lights(const Scene& scene) {
    if (scene.lamp) {
      gloam::Light lamp;
      lamp.intensity = 300.0f;
      gloam::LocalTransform at{.translation = kLamp};
      if (scene.sharp) {  // one map with texels of 2 mm on the floor
        lamp.kind = gloam::LightKind::spot;
        lamp.outer_angle = 0.44f;
        at.rotation = gloam::dquat(std::sqrt(0.5), -std::sqrt(0.5), 0.0, 0.0);  // shines down
      }
      world_.create(at, gloam::WorldTransform{}, lamp, gloam::ShadowCaster{.resolution = scene.sharp ? 2048u : 0u});
    }
    if (scene.sun) {
      gloam::Light sun;
      sun.kind = gloam::LightKind::directional;
      sun.intensity = 20.0f;
      const gloam::dquat turn = gloam::dquat(0.866, 0.0, 0.5, 0.0) * gloam::dquat(0.64, -0.77, 0.0, 0.0);
      world_.create(gloam::LocalTransform{.rotation = turn}, gloam::WorldTransform{}, sun, gloam::ShadowCaster{});
    }
    auto& environment = world_.resource<gloam::SceneEnvironment>();
    environment.sky_zenith = environment.sky_horizon = vec3(2.0f);
    environment.has_exposure = true;
    environment.exposure_ev100 = 5.0f;
  }

  const host::SkinnedMesh& mesh_;
  const host::Cubes& cubes_;
  host::ThreadExecutor executor_{2};
  std::unique_ptr<gloam::Renderer> renderer_;
  gloam::World world_;
  gloam::Entity mesh_volume_;
};

/// The share of pixels that differ by more than `most` of 255 in a channel.
double differing(const Texels& a, const Texels& b, int most) {
  if (a.size() != b.size()) return 1.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); i += 4) {
    bool differs = false;
    for (std::size_t c = 0; c < 3; ++c) differs = differs || std::abs(int{a[i + c]} - int{b[i + c]}) > most;
    count += differs ? 1 : 0;
  }
  return 4.0 * static_cast<double>(count) / static_cast<double>(a.size());
}

void write_ppm(const char* folder, const char* name, const Texels& texels) {
  if (folder == nullptr) return;
  std::FILE* file = std::fopen((std::string(folder) + "/" + name + ".ppm").c_str(), "wb");
  if (file == nullptr) fail("cannot write pictures");
  std::fprintf(file, "P6 %u %u 255\n", kWidth, kHeight);
  for (std::size_t i = 0; i < texels.size(); i += 4) std::fwrite(&texels[i], 1, 3, file);
  std::fclose(file);
}

/// All checks, with the objects that they share.
class Checks {
 public:
  Checks(host::VulkanHost& vulkan, gpu::Device& device, gloam::LogSink& log, const char* folder)
      : device_(device), log_(log), folder_(folder), drawing_(vulkan, device, mesh_, cubes_) {}
  ~Checks() { check(device_.wait_idle()); }
  Checks(const Checks&) = delete;
  Checks& operator=(const Checks&) = delete;

  /// The host's draws give the picture of meshes: under a lamp to the bit. The sun's cascades are fitted to the usual
  /// size of meshes, too, and then differ a little.
  void equals_meshes() {
    for (const bool sun : {false, true})
      for (const float bend : {0.0f, 0.7f}) {
        const Scene scene{.sun = sun};
        mesh_.bend(bend);
        ++mesh_.revision;
        const Texels none = stage(Casters::none, scene)->picture(), meshes = stage(Casters::meshes, scene)->picture(),
                     own = stage(Casters::host, scene)->picture();
        const std::string name = std::string(sun ? "sun_" : "lamp_") + (bend == 0.0f ? "straight" : "bent");
        write_ppm(folder_, (name + "_meshes").c_str(), meshes);
        write_ppm(folder_, (name + "_host").c_str(), own);
        const double far = differing(meshes, own, 8), any = differing(meshes, own, 0), effect = differing(none, own, 8);
        std::printf("%s: %.3f %% of pixels differ from meshes, %.3f %% by more than 8 of 255; shadows change %.1f %%\n",
                    name.c_str(), 100.0 * any, 100.0 * far, 100.0 * effect);
        expect(far < 0.001 && (sun || any == 0.0) && effect > 0.2,
               "the picture of the host's casters is that of meshes");
      }
  }

  /// Points behind a caster are dark, others lit, as rays say.
  void agrees_with_rays() {
    mesh_.bend(-0.5f);
    ++mesh_.revision;
    const Texels lit = stage(Casters::none, {.sharp = true})->picture();
    const Texels dark = stage(Casters::none, {.lamp = false})->picture();
    const Texels drawn = stage(Casters::host, {.sharp = true})->picture();
    write_ppm(folder_, "sharp_host", drawn);
    const std::vector<vec3> posed = mesh_.posed();
    std::size_t wrong = 0, seen[2] = {};
    for (std::uint32_t y = 1; y < kHeight; y += 2)
      for (std::uint32_t x = 1; x < kWidth; x += 2) {
        const dvec3 at = floor_point(x, y);
        const bool middle = hidden(at, kLamp, cubes_, mesh_, posed);
        bool clear = true;
        for (const dvec3& offset : {dvec3(0.008, 0, 0), dvec3(-0.008, 0, 0), dvec3(0, 0, 0.008), dvec3(0, 0, -0.008)})
          clear = clear && hidden(at + offset, kLamp, cubes_, mesh_, posed) == middle;
        if (!clear) continue;  // too close to a shadow's edge
        const std::size_t texel = 4 * (std::size_t{y} * kWidth + x);
        const Texels& expected = middle ? dark : lit;
        ++seen[middle ? 1 : 0];
        if (std::abs(int{drawn[texel]} - int{expected[texel]}) > 3) ++wrong;
      }
    std::printf("rays: %zu points in light, %zu in shadow, %zu wrong\n", seen[0], seen[1], wrong);
    expect(seen[0] > 200 && seen[1] > 200 && wrong == 0, "shadows are where rays say");
  }

  /// Casters that rest are drawn once; bones that move are drawn again.
  void keeps_what_rests() {
    mesh_.bend(0.2f);
    ++mesh_.revision;
    const auto one = stage(Casters::host, {.sun = true});
    one->draw(24);
    const host::NativeCounts rest = one->counts;
    one->draw(4);
    expect(rest.mesh_draws > 0 && rest.cube_draws > 0 && rest.skinned > 0, "the host is asked to draw");
    expect(one->counts.mesh_draws == rest.mesh_draws && one->counts.skinned == rest.skinned &&
               one->counts.cube_draws == rest.cube_draws && one->kept(),
           "casters that rest are not drawn again, and the frame is kept");
    mesh_.bend(0.9f);
    ++mesh_.revision;
    one->update_volumes();
    one->draw();
    expect(one->counts.mesh_draws > rest.mesh_draws && one->counts.skinned == rest.skinned + 1 && !one->kept(),
           "bones that move are drawn, and skinned once");
    const Texels moved = one->picture(), fresh = stage(Casters::host, {.sun = true})->picture();
    write_ppm(folder_, "moved", moved);
    expect(differing(moved, fresh, 0) == 0.0, "the picture after a change is that of a fresh renderer");
  }

  /// Nothing is kept of a caster about which the host tells nothing.
  void keeps_nothing_untold() {
    mesh_.bend(0.2f);
    mesh_.revision = 0;
    const auto one = stage(Casters::host, {.sun = true});
    one->draw(24);
    for (int i = 0; i < 4; ++i) {
      const int drawn = one->counts.mesh_draws, skinned = one->counts.skinned;
      one->draw();
      expect(one->counts.mesh_draws > drawn && one->counts.skinned == skinned + 1 && !one->kept(),
             "a caster that may have changed is drawn in every frame");
    }
    mesh_.bend(-0.8f);
    one->update_volumes();
    const Texels moved = one->picture(), fresh = stage(Casters::host, {.sun = true})->picture();
    expect(differing(moved, fresh, 0) == 0.0, "a change that nobody tells is in the picture");
    mesh_.revision = 1000;
  }

  /// A frame with a pass of the host is kept only if the host tells that its commands are those of the frames before.
  void keeps_frames_with_a_revision() {
    const auto one = stage(Casters::host, {.sun = true});
    one->draw(24);
    expect(one->kept(), "the frame rests");
    one->counts.works = true;
    one->draw(12);
    expect(!one->kept(), "commands without a revision may do anything");
    one->counts.revision = 3;
    one->draw(12);
    expect(one->kept(), "commands with the same revision do the same");
    one->counts.revision = 4;
    one->draw();
    expect(!one->kept(), "another revision is drawn");
  }

  [[nodiscard]] bool right() const { return right_; }

 private:
  [[nodiscard]] std::unique_ptr<Stage> stage(Casters casters, const Scene& scene) {
    return std::make_unique<Stage>(device_, log_, drawing_, mesh_, cubes_, casters, scene);
  }
  void expect(bool holds, const char* what) {
    if (!holds) std::printf("WRONG: %s\n", what);
    right_ = right_ && holds;
  }

  gpu::Device& device_;
  gloam::LogSink& log_;
  const char* folder_;
  host::SkinnedMesh mesh_ = host::SkinnedMesh::column(vec3(0.35f, 1.5f, 0.1f), 0.9f, 0.12f, 33);
  host::Cubes cubes_ = make_cubes();
  host::NativeDrawing drawing_;
  bool right_ = true;
};

}  // namespace

/// argv[1]: a folder for the pictures, if they are to be looked at.
int main(int argc, char** argv) {
  const std::unique_ptr<host::VulkanHost> vulkan = host::VulkanHost::open_or_skip();
  gloam::LogSink& log = host::warning_log();
  gpu::separate_driver_caches();
  gpu::HostDevice description = vulkan->describe();
  description.log = &log;
  description.retained_pipelines = 256;  // the renderers of all checks use the same
  auto device = value_of(gpu::create_vulkan_device_on(description));
  bool right = true;
  {
    Checks checks(*vulkan, *device, log, argc > 1 ? argv[1] : nullptr);
    checks.equals_meshes();
    checks.agrees_with_rays();
    checks.keeps_what_rests();
    checks.keeps_nothing_untold();
    checks.keeps_frames_with_a_revision();
    right = checks.right();
  }
  device.reset();
  const std::uint64_t messages = vulkan->close();
  std::printf("a host draws its own casters: %s, %llu validation messages\n", right ? "right" : "wrong",
              static_cast<unsigned long long>(messages));
  return right && messages == 0 ? 0 : 1;
}

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Calls of the interface for C, in any order, with live, stale, null and foreign handles, numbers of all kinds and
// structures of any size, on a device that records commands. An input is a list of calls: each takes the bytes that it
// needs.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/gpu/recording/device.h"
#include "modules/c_interface/gloam.h"
#include "modules/c_interface/handles.h"
#include "modules/module_list/module_list.h"
#include "tests/fuzz/call_source.h"
#include "tests/fuzz/target.h"
#include "tests/support/gltf_files.h"

namespace gloam::fuzz {
namespace {

constexpr std::size_t kMostCalls = 96;
constexpr std::size_t kMostRenders = 8;
constexpr std::size_t kMostWorlds = 3;

struct Known {
  gloam_world* handle = nullptr;
  std::vector<gloam_entity> live, ended;
  std::uint32_t materials = 0, meshes = 0;
};

/// Runs the calls of one input and keeps what must be true of their results.
class Calls {
 public:
  Calls(Input input, gloam_engine* engine, gloam_engine* ended) : source_(input), engine_(engine), ended_(ended) {}

  Outcome run() {
    for (std::size_t call = 0; call < kMostCalls && !source_.ended() && fault_.empty(); ++call) next();
    for (const Known& world : worlds_) expect(gloam_world_destroy(world.handle), GLOAM_OK);
    if (gloam_engine_validation_messages(engine_) != 0) fail("the device has found faults");
    return fault_.empty() ? accepted() : broken(call_ + ": " + fault_);
  }

 private:
  void fail(const std::string& fault) {
    if (fault_.empty()) fault_ = fault;
  }
  /// What every call promises, and a result that is known beforehand.
  void expect(gloam_result result, std::optional<gloam_result> known = std::nullopt) {
    const std::string message = gloam_error_message();
    if (result < GLOAM_OK || result > GLOAM_NO_DEVICE) fail("result " + std::to_string(result) + " is unknown");
    if (result == GLOAM_OK && !message.empty()) fail("there is a message of a success: " + message);
    if (result != GLOAM_OK) {
      const Outcome refusal = refused({ErrorKind::usage, message}, ErrorKind::usage);
      if (!refusal.fault.empty()) fail(refusal.fault);
    }
    if (known && result != *known)
      fail("result " + std::to_string(result) + " in place of " + std::to_string(*known) + ": " + message);
  }
  /// A result of arguments that may be refused; of a handle or structure that must be refused, if `bad`.
  bool expect_if(gloam_result result, bool bad) {
    expect(result, bad ? std::optional(GLOAM_USAGE) : std::nullopt);
    return result == GLOAM_OK;
  }

  /// A handle, and the world behind it: null if the handle is null, of a world that has ended, or of an engine.
  struct Chosen {
    gloam_world* handle = nullptr;
    Known* world = nullptr;
  };
  Chosen world() {
    const std::uint8_t chosen = source_.byte();
    if (chosen >= 240) {
      if (chosen % 3 == 0) return {};
      if (chosen % 3 == 1) return {stale_};
      return {reinterpret_cast<gloam_world*>(engine_)};
    }
    if (worlds_.empty()) return {stale_};
    Known& known = worlds_[chosen % worlds_.size()];
    return {known.handle, &known};
  }
  gloam_engine* engine(bool& bad) {
    const std::size_t chosen = source_.mostly_first(4);
    bad = chosen > 0;
    if (chosen == 2 && !worlds_.empty()) return reinterpret_cast<gloam_engine*>(worlds_.front().handle);
    return chosen == 0 ? engine_ : chosen == 1 ? nullptr : ended_;
  }
  /// An entity; `bad` if the world does not have it.
  gloam_entity entity(const Chosen& of, bool& bad) {
    const std::uint8_t chosen = source_.byte();
    bad = true;
    if (of.world == nullptr) return chosen;
    if (chosen >= 224 || of.world->live.empty()) {
      if (chosen % 3 == 0 && !of.world->ended.empty()) return of.world->ended[chosen % of.world->ended.size()];
      constexpr std::array<gloam_entity, 4> kNone = {0, 0xffffffff, ~gloam_entity{0}, gloam_entity{5} << 32};
      return kNone[chosen % kNone.size()];
    }
    bad = false;
    return of.world->live[chosen % of.world->live.size()];
  }
  /// A pose, a matrix of any numbers, or null.
  const double* matrix() {
    const std::size_t chosen = source_.mostly_first(8);
    if (chosen == 1) return nullptr;
    matrix_ = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    for (std::size_t i = 12; i < 15; ++i) matrix_[i] = source_.number() - 4.0;
    if (chosen >= 2)
      for (std::size_t i = 0; i < 3 * chosen; ++i) matrix_[source_.byte() % 16] = source_.number();
    return matrix_.data();
  }
  /// Sets the size of a structure; `bad` if it cannot be one.
  template <class T>
  void size(T& structure, bool& bad) {
    const std::array<std::size_t, 8> sizes = {sizeof(T),    0, 7, 9, sizeof(T) - 4, sizeof(T) + 8, ~std::size_t{0},
                                              sizeof(T) - 8};
    structure.size = sizes[source_.mostly_first(sizes.size())];
    bad = bad || structure.size < 8 || structure.size > sizeof(T) || structure.size % alignof(T) != 0;
  }
  std::string word() {
    constexpr std::array kWords = {
        "light",          "b",    "camera", "d",    "mesh", "node", "shadows.filter", "hard",
        "lights.culling", "none", "depth",  "pcss", "",     "\n",   "albedo",         "shadow:b"};
    return kWords[source_.byte() % kWords.size()];
  }

  void next();
  void make_world();
  void end_world();
  void make_material();
  void make_mesh();
  void make_instance();
  void make_light(bool set);
  void change_entity();
  void set_world();
  void find();
  void load();
  void render();
  void read();
  void of_engine();
  void make_engine();

  Source source_;
  gloam_engine* engine_;
  gloam_engine* ended_;
  gloam_world* stale_ = nullptr;
  std::vector<Known> worlds_;
  std::array<double, 16> matrix_{};
  std::size_t renders_ = 0;
  std::string call_, fault_;
};

void Calls::next() {
  struct Call {
    const char* name;
    void (*make)(Calls&);
  };
  static const std::array kCalls = {Call{"world_create", [](Calls& c) { c.make_world(); }},
                                    Call{"world_destroy", [](Calls& c) { c.end_world(); }},
                                    Call{"material", [](Calls& c) { c.make_material(); }},
                                    Call{"mesh", [](Calls& c) { c.make_mesh(); }},
                                    Call{"instance", [](Calls& c) { c.make_instance(); }},
                                    Call{"light", [](Calls& c) { c.make_light(false); }},
                                    Call{"light_set", [](Calls& c) { c.make_light(true); }},
                                    Call{"entity", [](Calls& c) { c.change_entity(); }},
                                    Call{"world_set", [](Calls& c) { c.set_world(); }},
                                    Call{"find", [](Calls& c) { c.find(); }},
                                    Call{"load", [](Calls& c) { c.load(); }},
                                    Call{"render", [](Calls& c) { c.render(); }},
                                    Call{"read", [](Calls& c) { c.read(); }},
                                    Call{"engine", [](Calls& c) { c.of_engine(); }},
                                    Call{"engine_create", [](Calls& c) { c.make_engine(); }}};
  const Call& call = kCalls[source_.byte() % kCalls.size()];
  call_ = call.name;
  call.make(*this);
}

void Calls::make_world() {
  if (worlds_.size() == kMostWorlds) return;
  bool bad = false;
  gloam_engine* of = engine(bad);
  gloam_world* made = nullptr;
  const bool nowhere = source_.mostly_first(4) == 1;
  expect(gloam_world_create(of, nowhere ? nullptr : &made), bad || nowhere ? GLOAM_USAGE : GLOAM_OK);
  if (made != nullptr) worlds_.push_back({.handle = made});
}

void Calls::end_world() {
  const Chosen of = world();
  expect(gloam_world_destroy(of.handle), of.world != nullptr || of.handle == nullptr ? GLOAM_OK : GLOAM_USAGE);
  if (of.world == nullptr) return;
  stale_ = of.handle;
  worlds_.erase(worlds_.begin() + (of.world - worlds_.data()));
}

void Calls::make_material() {
  const Chosen of = world();
  bool bad = of.world == nullptr;
  gloam_material material = GLOAM_MATERIAL_INIT;
  size(material, bad);
  for (float* value : {&material.base_color[0], &material.base_color[3], &material.emissive[1], &material.metallic,
                       &material.roughness})
    *value = source_.number_f();
  material.double_sided = source_.byte() % 2;
  std::uint32_t number = 0;
  if (expect_if(gloam_material_create(of.handle, &material, &number), bad) && !bad) ++of.world->materials;
}

void Calls::make_mesh() {
  const Chosen of = world();
  bool bad = of.world == nullptr;
  gloam_mesh mesh = GLOAM_MESH_INIT;
  mesh.vertex_count = source_.byte() % 8;
  std::vector<float> positions(3 * mesh.vertex_count), normals(3 * mesh.vertex_count), uv(2 * mesh.vertex_count);
  for (float& value : positions) value = source_.number_f();
  for (std::size_t i = 0; i < normals.size(); ++i) normals[i] = i % 3 == 1 ? 1.0f : 0.0f;
  if (source_.mostly_first(4) == 1)
    for (float& value : normals) value = source_.number_f();
  for (float& value : uv) value = source_.number_f();
  std::vector<std::uint32_t> indices(source_.byte() % 10);
  for (std::uint32_t& index : indices) index = source_.byte() % 9;
  const std::uint8_t present = source_.byte();
  mesh.positions = present % 16 == 15 ? nullptr : positions.data();
  mesh.normals = present % 2 == 1 ? normals.data() : nullptr;
  mesh.uv = present % 4 > 1 ? uv.data() : nullptr;
  mesh.indices = present % 8 > 3 ? indices.data() : nullptr;
  mesh.index_count = static_cast<std::uint32_t>(indices.size());
  mesh.material = source_.byte() % 3;
  size(mesh, bad);
  bad = bad || mesh.positions == nullptr || mesh.vertex_count == 0 || mesh.material >= of.world->materials;
  std::uint32_t number = 0;
  if (mesh.size < sizeof(mesh)) bad = of.world == nullptr;  // members that are not given have their defaults
  if (expect_if(gloam_mesh_create(of.handle, &mesh, &number), bad) && of.world != nullptr) ++of.world->meshes;
}

void Calls::make_instance() {
  const Chosen of = world();
  const std::uint32_t mesh = source_.byte() % 4;
  const double* pose = matrix();
  gloam_entity made = 0;
  const bool bad = of.world == nullptr || mesh >= of.world->meshes || pose == nullptr;
  if (expect_if(gloam_instance_create(of.handle, mesh, pose, &made), bad) && !bad) of.world->live.push_back(made);
}

void Calls::make_light(bool set) {
  const Chosen of = world();
  bool bad = of.world == nullptr, none = false;
  gloam_light light = GLOAM_LIGHT_INIT;
  size(light, bad);
  const std::uint8_t kind = source_.byte();
  light.kind = static_cast<gloam_light_kind>(kind < 240 ? kind % 3 : kind);
  for (float* value : {&light.color[0], &light.color[2], &light.intensity, &light.range_m, &light.inner_angle,
                       &light.outer_angle, &light.width_m, &light.apparent_angle})
    *value = source_.number_f();
  light.casts_shadows = source_.byte() % 2;
  gloam_entity target = set ? entity(of, none) : 0;
  if (set) {
    expect_if(gloam_light_set(of.handle, target, &light), bad || none);
    return;
  }
  const double* pose = matrix();
  if (expect_if(gloam_light_create(of.handle, &light, pose, &target), bad || pose == nullptr) && of.world != nullptr)
    of.world->live.push_back(target);
}

void Calls::change_entity() {
  const Chosen of = world();
  bool none = false;
  const gloam_entity target = entity(of, none);
  if (source_.byte() % 2 == 0) {
    const double* pose = matrix();
    expect_if(gloam_entity_set_matrix(of.handle, target, pose), none || pose == nullptr);
    return;
  }
  expect(gloam_entity_destroy(of.handle, target), none ? GLOAM_USAGE : GLOAM_OK);
  if (none) return;
  std::erase(of.world->live, target);
  of.world->ended.push_back(target);
}

void Calls::set_world() {
  const Chosen of = world();
  const bool bad = of.world == nullptr;
  const float up[3] = {source_.number_f(), source_.number_f(), source_.number_f()};
  const double time_s = source_.number(), dt_s = source_.number();
  switch (source_.byte() % 3) {
    case 0:
      expect_if(gloam_world_set_clock(of.handle, time_s, dt_s), bad || !std::isfinite(time_s) || !(dt_s >= 0.0));
      break;
    case 1:
      expect_if(gloam_world_set_sky(of.handle, up, source_.byte() % 8 == 7 ? nullptr : up, up),
                bad || !(up[0] >= 0.0f) || std::isinf(up[0]));
      break;
    default:
      expect_if(gloam_world_set_exposure(of.handle, up[0]), bad || !(std::abs(up[0]) <= 64.0f));
  }
}

void Calls::find() {
  const Chosen of = world();
  const std::string kind = word(), name = word();
  gloam_entity found = 0;
  const bool null = source_.mostly_first(4) == 1;
  if (!expect_if(gloam_world_find(of.handle, null ? nullptr : kind.c_str(), name.c_str(), &found),
                 of.world == nullptr || null))
    return;
  if (std::ranges::count(of.world->ended, found) > 0) fail("an entity that has ended was found");
  if (std::ranges::count(of.world->live, found) == 0) of.world->live.push_back(found);
}

void Calls::load() {
  static const test::TemporaryFolder folder;
  static const std::string path = [] {
    test::GltfText gltf;
    gltf.triangle();
    gltf.add("cameras", R"({"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}})");
    gltf.set("extensions", R"({"KHR_lights_punctual": {"lights": [{"type": "point"}]}})");
    gltf.add("nodes", R"({"name": "a", "mesh": 0, "children": [1]})");
    gltf.add("nodes", R"({"name": "b", "extensions": {"KHR_lights_punctual": {"light": 0}}})");
    gltf.add("nodes", R"({"name": "d", "camera": 0, "translation": [0, 0, 3]})");
    return folder.write("a.gltf", gltf.text());
  }();
  const Chosen of = world();
  const std::size_t chosen = source_.mostly_first(4);
  const char* name = chosen == 1 ? nullptr : chosen == 2 ? "absent.gltf" : chosen == 3 ? "" : path.c_str();
  const gloam_result result = gloam_world_load(of.handle, name);
  expect_if(result, of.world == nullptr || name == nullptr);
  if (of.world == nullptr) return;
  if (result == GLOAM_INPUT && chosen == 0) fail("a sound file is refused");
  if (result == GLOAM_OK) of.world->meshes = 1;
}

void Calls::render() {
  if (++renders_ > kMostRenders) return;
  const Chosen of = world();
  bool bad = of.world == nullptr;
  constexpr std::array<std::uint32_t, 8> kSides = {16, 1, 2, 33, 64, 0, 100000, 7};
  std::array<gloam_view, 2> views = {gloam_view(GLOAM_VIEW_INIT), gloam_view(GLOAM_VIEW_INIT)};
  std::array<std::string, 2> names;
  gloam_host_geometry geometry = GLOAM_HOST_GEOMETRY_INIT;
  std::uint32_t count = source_.byte() % 3;
  bad = bad || count == 0;
  for (std::uint32_t i = 0; i < 2; ++i) {
    gloam_view& view = views[i];
    bool wrong = false;
    view.id = source_.mostly_first(4) == 3 ? 1u << 26 : source_.byte() % 4;
    view.width = kSides[source_.mostly_first(kSides.size())];
    view.height = kSides[source_.mostly_first(kSides.size())];
    if (source_.mostly_first(2) == 1) view.camera = entity(of, wrong);
    wrong = wrong && view.camera != 0;  // 0 is no camera
    if (const double* pose = matrix(); pose != nullptr) std::copy_n(pose, 16, view.matrix);
    if (source_.mostly_first(2) == 1) view.fov_y = source_.number_f();
    if (source_.mostly_first(2) == 1) view.near_m = source_.number_f();
    if (source_.mostly_first(2) == 1) view.visualizer = (names[i] = word()).c_str();
    if (source_.mostly_first(4) == 3) view.geometry = &geometry;
    if (i == 0) size(view, wrong);
    wrong = wrong || view.width == 0 || view.height == 0 || view.width > 65536 || view.height > 65536;
    wrong = wrong || view.id >= 1u << 26 || view.geometry != nullptr;
    if (views[0].size < sizeof(gloam_view) && i == 0) wrong = views[0].size < 8 || views[0].size % 8 != 0;
    // A smaller structure would be followed by the next one at once.
    if (i == 0 && view.size < sizeof(gloam_view)) count = std::min(count, 1u);
    if (i < count) bad = bad || wrong;
  }
  expect_if(gloam_render(of.handle, count == 0 && source_.byte() % 2 == 0 ? nullptr : views.data(), count), bad);
}

void Calls::read() {
  const Chosen of = world();
  std::array<std::uint8_t, 4 * 33 * 33> picture{};
  std::uint32_t width = 0, height = 0;
  const std::uint32_t view = source_.mostly_first(4) == 3 ? 0xffffffff : source_.byte() % 4;
  const std::size_t bytes = source_.mostly_first(2) == 1 ? source_.byte() : picture.size();
  if (source_.byte() % 4 == 3) {
    expect_if(gloam_release_view(of.handle, view), of.world == nullptr);
    return;
  }
  const bool null = source_.mostly_first(4) == 1;
  const gloam_result result =
      gloam_read_picture(of.handle, view, null ? nullptr : picture.data(), bytes, &width, &height);
  if (expect_if(result, of.world == nullptr || null) && (width == 0 || 4u * width * height > bytes))
    fail("a picture has more bytes than there is room for");
}

void Calls::of_engine() {
  bool bad = false;
  gloam_engine* of = engine(bad);
  const std::string name = word(), value = word();
  switch (source_.byte() % 6) {
    case 0:
      expect_if(gloam_engine_set_knob(of, name.c_str(), value.c_str()), bad);
      break;
    case 1:
      expect(gloam_engine_wait(of), bad ? GLOAM_USAGE : GLOAM_OK);
      break;
    case 2:
      expect(gloam_engine_free_idle_memory(of), bad ? GLOAM_USAGE : GLOAM_OK);
      break;
    case 3:
      expect(gloam_engine_forget_image(of, source_.byte()), bad ? GLOAM_USAGE : GLOAM_OK);
      break;
    case 4:
      if ((std::string(gloam_engine_device_name(of)).empty()) != bad) fail("a device has no name");
      break;
    default:
      if (bad || !worlds_.empty()) expect(gloam_engine_destroy(of), of == nullptr ? GLOAM_OK : GLOAM_USAGE);
  }
}

/// Engines that fail before they look for a device.
void Calls::make_engine() {
  gloam_vulkan_device vulkan = GLOAM_VULKAN_DEVICE_INIT;
  gloam_engine_info info = GLOAM_ENGINE_INFO_INIT;
  gloam_engine* made = engine_;
  bool bad = false;
  size(vulkan, bad);
  if (source_.byte() % 2 == 0) vulkan.instance = &vulkan;
  info.vulkan = &vulkan;
  const std::size_t sizes[] = {sizeof(info), 0, 9, sizeof(info) + 8};
  info.size = sizes[source_.byte() % 4];
  if (source_.byte() % 2 == 0) info.threads = 1u << 20;
  expect(gloam_engine_create(&info, source_.byte() % 4 == 3 ? nullptr : &made), GLOAM_USAGE);
  if (made != nullptr && made != engine_) fail("a failed engine is not null");
}

gloam_engine* make_recording_engine() {
  auto made = std::make_unique<c_interface::EngineObject>();
  made->device = gpu::make_recording_device();
  made->executor = make_serial_executor();
  RendererOptions options;
  options.device = made->device.get();
  options.executor = made->executor.get();
  options.modules = make_all_modules();
  made->renderer = Renderer::create(std::move(options)).value();
  return c_interface::engines().add(std::move(made));
}

gloam_engine* make_ended_engine() {
  gloam_engine* engine = make_recording_engine();
  static_cast<void>(gloam_engine_destroy(engine));
  return engine;
}

/// The engine of all inputs on a Vulkan device with validation, which takes too long to make for each.
gloam_engine* make_vulkan_engine(const char* device) {
  gloam_engine_info info = GLOAM_ENGINE_INFO_INIT;
  info.device = device;
  info.validate = 1;
  info.log = [](void*, gloam_log_level level, const char* line) {
    if (level >= GLOAM_LOG_WARNING) std::cerr << line << '\n';
  };
  gloam_engine* engine = nullptr;
  if (gloam_engine_create(&info, &engine) != GLOAM_OK) std::cerr << gloam_error_message() << '\n';
  return engine;
}

/// GLOAM_FUZZ_DEVICE: "cpu" or part of the name of a Vulkan device, in place of the one that records.
Outcome make_calls(Input input) {
  static gloam_engine* const ended = make_ended_engine();
  if (static const char* const device = std::getenv("GLOAM_FUZZ_DEVICE"); device != nullptr) {
    static gloam_engine* const engine = make_vulkan_engine(device);
    return engine == nullptr ? broken("there is no device") : Calls(input, engine, ended).run();
  }
  gloam_engine* engine = make_recording_engine();
  const Outcome outcome = Calls(input, engine, ended).run();
  if (gloam_engine_destroy(engine) != GLOAM_OK && outcome.fault.empty())
    return broken("the engine does not end: " + std::string(gloam_error_message()));
  return outcome;
}

/// A scene that is drawn and changed, and lists of calls of any kind.
std::vector<Bytes> call_lists() {
  std::vector<Bytes> lists = {{0, 0, 0, 10, 0, 0, 11, 0, 1, 0, 1, 0, 0, 0, 0, 70, 0, 0, 0, 0, 12, 0, 0, 1, 0, 0, 0},
                              {0, 0, 0, 2, 0, 0, 16, 16, 0, 0, 8, 0, 3, 0, 3, 0, 0, 0, 16, 0, 0, 0, 16, 0, 0}};
  std::uint32_t random = 1;
  for (int list = 0; list < 24; ++list) {
    Bytes bytes = {0, 0, 0};
    for (int i = 0; i < 400; ++i)
      bytes.push_back(static_cast<std::uint8_t>((random = random * 1664525u + 1013904223u) >> 24));
    lists.push_back(std::move(bytes));
  }
  return lists;
}

}  // namespace

Target c_interface_target() { return {"c_interface", {{"calls", make_calls, call_lists}}}; }

}  // namespace gloam::fuzz

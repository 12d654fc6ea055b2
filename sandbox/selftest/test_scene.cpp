// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/selftest/test_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

namespace gloam {
namespace {

using Json = TestScene::Json;

/// Keys whose numbers are lengths in units of the scene. Keys of physics are in metres.
constexpr std::array<std::string_view, 9> kLengths = {
    "gloam.light.width",     "gloam.ibr_proxy.size",  "gloam.ibr_room.size",
    "gloam.cube_probe.size", "gloam.particles.size",  "gloam.particles.box",
    "gloam.collider.radius", "gloam.collider.height", "gloam.collider.size"};

Json times(const Json& value, double factor) {
  if (!value.is_array()) return value.get<double>() * factor;
  Json all = Json::array();
  for (const Json& item : value) all.push_back(times(item, factor));
  return all;
}

/// The keys at a scale.
Json scaled_keys(const Json& extras, double scale) {
  Json all = extras;
  for (auto& [key, value] : all.items())
    if (std::ranges::find(kLengths, key) != kLengths.end()) value = times(value, scale);
  return all;
}

/// Directions in keys turn with the scene.
void turn_keys(Json& extras, const Placement& placement) {
  if (!extras.contains("gloam.wind.velocity")) return;
  Json& wind = extras["gloam.wind.velocity"];
  dvec3 velocity(wind[0].get<double>(), wind[1].get<double>(), wind[2].get<double>());
  if (placement.mirrored) velocity.x = -velocity.x;
  velocity = turned_about(1, placement.turned) * velocity;
  wind = {velocity.x, velocity.y, velocity.z};
}

/// Collects the buffer of a glTF file.
struct BufferWriter {
  std::string bytes;
  Json views = Json::array(), accessors = Json::array();

  template <class Value>
  std::size_t add(const std::vector<Value>& values, int component, const char* type, std::size_t count) {
    const std::size_t size = values.size() * sizeof(Value);
    views.push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}});
    accessors.push_back(
        {{"bufferView", views.size() - 1}, {"componentType", component}, {"type", type}, {"count", count}});
    const std::size_t begin = bytes.size();
    bytes.resize(begin + size);
    std::memcpy(bytes.data() + begin, values.data(), size);
    return accessors.size() - 1;
  }
  std::size_t add_vectors(const std::vector<dvec3>& vectors, double scale, bool bounds) {
    std::vector<float> flat;
    for (const dvec3& v : vectors)
      for (int i = 0; i < 3; ++i) flat.push_back(static_cast<float>(v[i] * scale));
    const std::size_t index = add(flat, 5126, "VEC3", vectors.size());
    if (!bounds) return index;
    for (const char* name : {"min", "max"}) {
      Json corner = Json::array();
      for (std::size_t i = 0; i < 3; ++i) {
        float best = flat[i];
        for (std::size_t v = i; v < flat.size(); v += 3)
          best = name[1] == 'i' ? std::min(best, flat[v]) : std::max(best, flat[v]);
        corner.push_back(best);
      }
      accessors.back()[name] = corner;
    }
    return index;
  }
};

}  // namespace

const dquat TestScene::kNoRotation = dquat(1.0, 0.0, 0.0, 0.0);
const dquat TestScene::kDown = turned_about(0, -1.5707963267948966);

dquat turned_about(int axis, double angle) {
  dquat q(std::cos(0.5 * angle), 0.0, 0.0, 0.0);
  const double s = std::sin(0.5 * angle);
  (axis == 0 ? q.x : axis == 1 ? q.y : q.z) = s;
  return q;
}

TestScene::TestScene(const dvec3& sky, double exposure)
    : extras_({{"gloam.exposure", exposure}}),
      materials_(Json::array()),
      lights_(Json::array()),
      cameras_(Json::array()) {
  for (const char* key : {"gloam.sky.zenith", "gloam.sky.horizon", "gloam.sky.ground"})
    extras_[key] = {sky.x, sky.y, sky.z};
}

std::size_t TestScene::material(const dvec3& color, double roughness, Json extras) {
  materials_.push_back({{"pbrMetallicRoughness",
                         {{"baseColorFactor", {color.x, color.y, color.z, 1.0}},
                          {"roughnessFactor", roughness},
                          {"metallicFactor", 0.0}}},
                        {"extras", std::move(extras)}});
  return materials_.size() - 1;
}

void TestScene::blend(std::size_t material, double alpha) {
  materials_[material]["alphaMode"] = "BLEND";
  materials_[material]["doubleSided"] = true;
  materials_[material]["pbrMetallicRoughness"]["baseColorFactor"][3] = alpha;
}

void TestScene::add_mesh(Mesh mesh, const dvec3& at, const dquat& rotation, Json extras) {
  meshes_.push_back(std::move(mesh));
  nodes_.push_back({at, rotation, {{"mesh", meshes_.size() - 1}, {"extras", std::move(extras)}}});
}

void TestScene::quad(double half, std::size_t material, const dvec3& at, const dquat& rotation, Json extras) {
  Mesh mesh = {.indices = {0, 1, 2, 0, 2, 3}, .material = material};
  mesh.positions = {{-half, 0, -half}, {-half, 0, half}, {half, 0, half}, {half, 0, -half}};
  mesh.normals.assign(4, dvec3(0, 1, 0));
  add_mesh(std::move(mesh), at, rotation, std::move(extras));
}

void TestScene::box(const dvec3& half, std::size_t material, const dvec3& at, const dquat& rotation, Json extras) {
  Mesh mesh = {.material = material};
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (const auto& [u, v] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
        dvec3 corner, normal(0.0);
        corner[axis] = side;
        corner[(axis + 1) % 3] = u * side;
        corner[(axis + 2) % 3] = v;
        normal[axis] = side;
        mesh.positions.push_back(corner * half);
        mesh.normals.push_back(normal);
      }
      for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
    }
  add_mesh(std::move(mesh), at, rotation, std::move(extras));
}

void TestScene::light(std::string_view kind, const dvec3& at, double intensity, Json values, Json extras,
                      const dquat& rotation) {
  const std::string name = "light " + std::to_string(lights_.size());
  Json light = {{"type", kind}, {"name", name}, {"intensity", intensity}};
  light.update(values);
  lights_.push_back(std::move(light));
  nodes_.push_back({at,
                    rotation,
                    {{"name", name},
                     {"extras", std::move(extras)},
                     {"extensions", {{"KHR_lights_punctual", {{"light", lights_.size() - 1}}}}}}});
}

void TestScene::camera(const dvec3& at, const dquat& rotation, double yfov, double znear, Json extras) {
  cameras_.push_back({{"type", "perspective"}, {"perspective", {{"yfov", yfov}, {"znear", znear}}}});
  nodes_.push_back({at, rotation, {{"camera", cameras_.size() - 1}, {"extras", std::move(extras)}}});
}

void TestScene::set_lens(double yfov, double znear, double zfar) {
  for (Json& camera : cameras_) {
    camera["perspective"] = {{"yfov", yfov}, {"znear", znear}};
    if (zfar > 0.0) camera["perspective"]["zfar"] = zfar;
  }
}

void TestScene::node(const dvec3& at, Json extras) {
  nodes_.push_back({at, kNoRotation, {{"extras", std::move(extras)}}});
}

Json& TestScene::last_keys() { return nodes_.back().json["extras"]; }

void TestScene::brighten(double factor) {
  for (Json& light : lights_) light["intensity"] = light["intensity"].get<double>() * factor;
  for (const char* key : {"gloam.sky.zenith", "gloam.sky.horizon", "gloam.sky.ground"})
    extras_[key] = times(extras_[key], factor);
}

TestSceneFiles TestScene::gltf(const Placement& placement) const {
  const double scale = placement.scale;
  BufferWriter buffer;
  Json meshes = Json::array(), nodes = Json::array(), roots = Json::array();
  for (const Mesh& mesh : meshes_) {
    const std::size_t positions = buffer.add_vectors(mesh.positions, scale, true);
    const std::size_t normals = buffer.add_vectors(mesh.normals, 1.0, false);
    const std::size_t indices = buffer.add(mesh.indices, 5125, "SCALAR", mesh.indices.size());
    const Json primitive = {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                            {"indices", indices},
                            {"material", mesh.material}};
    meshes.push_back({{"primitives", Json::array({primitive})}});
  }
  const dquat turn = turned_about(1, placement.turned);
  for (const Node& node : nodes_) {
    dvec3 at = node.at;
    dquat q = node.rotation;
    if (placement.mirrored) {  // conjugated with the mirror: all meshes are symmetric
      at.x = -at.x;
      q = dquat(q.w, q.x, -q.y, -q.z);
    }
    at = turn * at * scale + placement.moved;
    q = turn * q;
    Json json = node.json;
    json["extras"] = scaled_keys(json["extras"], scale);
    turn_keys(json["extras"], placement);
    json["translation"] = {at.x, at.y, at.z};
    json["rotation"] = {q.x, q.y, q.z, q.w};
    roots.push_back(nodes.size());
    nodes.push_back(std::move(json));
  }
  Json lights = lights_, cameras = cameras_, extras = extras_;
  for (Json& light : lights)
    if (light.contains("range")) light["range"] = light["range"].get<double>() * scale;
  for (Json& camera : cameras)
    for (const char* plane : {"znear", "zfar"})
      if (Json& lens = camera["perspective"]; lens.contains(plane)) lens[plane] = lens[plane].get<double>() * scale;
  if (scale != 1.0) extras["gloam.scale"] = 1.0 / scale;
  const Json scene = {{"nodes", roots}, {"extras", extras}};
  const Json bin = {{"byteLength", buffer.bytes.size()}, {"uri", kTestSceneBuffer}};
  Json file = {{"asset", {{"version", "2.0"}}},
               {"scene", 0},
               {"scenes", Json::array({scene})},
               {"nodes", nodes},
               {"meshes", meshes},
               {"materials", materials_},
               {"cameras", cameras},
               {"accessors", buffer.accessors},
               {"bufferViews", buffer.views},
               {"buffers", Json::array({bin})}};
  if (!lights.empty()) {
    file["extensionsUsed"] = Json::array({"KHR_lights_punctual"});
    file["extensions"] = {{"KHR_lights_punctual", {{"lights", lights}}}};
  }
  return {file.dump(), std::move(buffer.bytes)};
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/math/types.h"

namespace gloam {

/// Where a test scene lies in the world, and how it is written. Applied in this order: mirrored, turned, scaled, moved.
struct Placement {
  bool mirrored = false;  ///< x becomes −x
  double turned = 0.0;    ///< about the y axis, radians
  double scale = 1.0;     ///< of all lengths; the key gloam.scale says what a unit is
  dvec3 moved = dvec3(0.0);
};

/// A glTF file, and the buffer that must lie beside it under the name kTestSceneBuffer.
struct TestSceneFiles {
  std::string json;
  std::string buffer;
};
inline constexpr double kOneDegree = 0.017453292519943295;  ///< radians
inline constexpr const char* kTestSceneBuffer = "scene.bin";

/// A small scene in metres that is written as glTF at any place and scale. Its picture must not depend on them.
class TestScene {
 public:
  using Json = nlohmann::ordered_json;

  /// sky: one luminance for all directions, cd/m². exposure: EV.
  explicit TestScene(const dvec3& sky = dvec3(0.0), double exposure = 3.0);

  /// Returns the material's index.
  std::size_t material(const dvec3& color, double roughness = 1.0, Json extras = Json::object());
  /// Makes a material blended and double-sided.
  void blend(std::size_t material, double alpha);
  /// A horizontal square that faces up.
  void quad(double half, std::size_t material, const dvec3& at = dvec3(0.0), const dquat& rotation = kNoRotation,
            Json extras = Json::object());
  void box(const dvec3& half, std::size_t material, const dvec3& at, const dquat& rotation = kNoRotation,
           Json extras = Json::object());
  /// A light of KHR_lights_punctual; `values` are its other members. Shines down unless it is turned.
  void light(std::string_view kind, const dvec3& at, double intensity, Json values = Json::object(),
             Json extras = Json::object(), const dquat& rotation = kDown);
  void camera(const dvec3& at, const dquat& rotation, double yfov = 0.8, double znear = 0.05,
              Json extras = Json::object());
  /// Changes the angle (radians) and the near plane of all cameras. zfar: 0: none.
  void set_lens(double yfov, double znear, double zfar = 0.0);
  /// A node with keys only.
  void node(const dvec3& at, Json extras);
  /// Keys of the last node, and of the scene.
  [[nodiscard]] Json& last_keys();
  [[nodiscard]] Json& keys() { return extras_; }
  /// Multiplies the intensity of all lights and the sky.
  void brighten(double factor);

  [[nodiscard]] TestSceneFiles gltf(const Placement& placement = {}) const;

  static const dquat kNoRotation;
  static const dquat kDown;

 private:
  struct Mesh {
    std::vector<dvec3> positions;
    std::vector<dvec3> normals;
    std::vector<std::uint32_t> indices;
    std::size_t material = 0;
  };
  struct Node {
    dvec3 at = dvec3(0.0);
    dquat rotation = dquat(1.0, 0.0, 0.0, 0.0);
    Json json;  ///< everything else
  };
  void add_mesh(Mesh mesh, const dvec3& at, const dquat& rotation, Json extras);

  Json extras_, materials_, lights_, cameras_;
  std::vector<Mesh> meshes_;
  std::vector<Node> nodes_;
};

/// The quaternion of a rotation about axis 0, 1 or 2.
[[nodiscard]] dquat turned_about(int axis, double angle);

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/loading/model_brightness.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/math/srgb.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"

namespace gloam {
namespace {

// A large mesh or image is sampled: that many triangles or pixels give the mean within a percent.
constexpr std::size_t kMostSamples = 20000;
constexpr double kMirroredByDielectrics = 0.04;

double luminance(const dvec3& color) { return glm::dot(color, dvec3(0.2126, 0.7152, 0.0722)); }

std::size_t stride_of(std::size_t count) { return std::max<std::size_t>(1, count / kMostSamples); }

/// Mean linear colour of an image of colours.
dvec3 mean_color(const Image& image) {
  dvec3 sum(0.0);
  std::size_t samples = 0;
  for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4 * stride_of(image.rgba.size() / 4), ++samples)
    for (int c = 0; c < 3; ++c) sum[c] += linear_of_srgb()[image.rgba[i + static_cast<std::size_t>(c)]];
  return samples == 0 ? dvec3(1.0) : sum / static_cast<double>(samples);
}

struct Reflectance {
  dvec3 base = dvec3(1.0);
  double metallic = 1.0;
  bool counts = true;

  [[nodiscard]] double of(const dvec3& vertex_color) const {
    const double color = luminance(base * vertex_color);
    return std::clamp(color + kMirroredByDielectrics * (1.0 - metallic), 0.0, 1.0);
  }
};

std::vector<Reflectance> reflectances(const SceneAssets& assets) {
  std::vector<Reflectance> list;
  for (const Material& material : assets.materials) {
    Reflectance reflectance{dvec3(vec3(material.base_color)), double{material.metallic}};
    const std::uint32_t texture = material.base_color_texture.texture;
    if (texture < assets.textures.size() && assets.textures[texture].image < assets.images.size())
      reflectance.base *= mean_color(assets.images[assets.textures[texture].image]);
    reflectance.counts = !is_emissive(material) || luminance(reflectance.base) > 0.0;
    list.push_back(reflectance);
  }
  return list;
}

/// Sums of area times reflectance, and of area.
struct Sums {
  double reflected = 0.0;
  double area = 0.0;
};

Sums sums_of(const Primitive& primitive, const Reflectance& reflectance, const dmat4& world) {
  Sums sums;
  const std::size_t triangles = primitive.indices.size() / 3;
  const std::size_t stride = stride_of(triangles);
  for (std::size_t t = 0; t < triangles; t += stride) {
    dvec3 corner[3];
    dvec3 color(0.0);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t vertex = primitive.indices[3 * t + k];
      corner[k] = dvec3(world * dvec4(dvec3(primitive.positions[vertex]), 1.0));
      color += primitive.colors.empty() ? dvec3(1.0) : dvec3(vec3(primitive.colors[vertex]));
    }
    const double area =
        static_cast<double>(stride) * glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
    if (!std::isfinite(area)) continue;
    sums.reflected += area * reflectance.of(color / 3.0);
    sums.area += area;
  }
  return sums;
}

}  // namespace

std::optional<double> mean_reflectance(const World& world) {
  const auto& assets = world.resource<SceneAssets>();
  const std::vector<Reflectance> materials = reflectances(assets);
  Sums all;
  world.view<const MeshInstance, const WorldTransform>().each(
      [&](const MeshInstance& instance, const WorldTransform& transform) {
        if (instance.mesh >= assets.meshes.size()) return;
        for (const Primitive& primitive : assets.meshes[instance.mesh].primitives) {
          const Reflectance reflectance =
              primitive.material < materials.size() ? materials[primitive.material] : Reflectance{};
          if (!reflectance.counts) continue;
          const Sums sums = sums_of(primitive, reflectance, transform.matrix);
          all.reflected += sums.reflected;
          all.area += sums.area;
        }
      });
  if (!(all.area > 0.0) || !std::isfinite(all.area)) return std::nullopt;
  return all.reflected / all.area;
}

}  // namespace gloam

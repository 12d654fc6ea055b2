// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/results/view_values.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/math/packing.h"
#include "engine/render/readback/geometry_picture.h"

namespace gloam {
namespace {

template <class T>
T item(const ImageBytes& image, std::size_t at) {
  T value;
  std::memcpy(&value, image.bytes.data() + at * sizeof(T), sizeof(T));
  return value;
}

/// Number of channels of a format that visualizers write; 0: another format.
std::size_t channels_of(gpu::Format format) {
  switch (format) {
    case gpu::Format::r32_float:
    case gpu::Format::r32_uint:
    case gpu::Format::r16_float:
      return 1;
    case gpu::Format::rg16_float:
    case gpu::Format::rg32_float:
      return 2;
    case gpu::Format::rgba8_unorm:
    case gpu::Format::rgba16_float:
    case gpu::Format::rgba32_float:
      return 4;
    default:
      return 0;
  }
}

float channel_of(const ImageBytes& image, std::size_t at) {
  switch (image.format) {
    case gpu::Format::rgba8_unorm:
      return static_cast<float>(item<std::uint8_t>(image, at)) / 255.0f;
    case gpu::Format::r16_float:
    case gpu::Format::rg16_float:
    case gpu::Format::rgba16_float:
      return half_to_float(item<std::uint16_t>(image, at));
    case gpu::Format::r32_uint:
      return static_cast<float>(item<std::uint32_t>(image, at));
    default:
      return item<float>(image, at);
  }
}

LinearPicture geometry_values(const GeometryPicture& geometry, std::string_view shown) {
  LinearPicture values{geometry.view.width, geometry.view.height, {}};
  for (std::size_t at = 0; at < geometry.depth.size(); ++at) {
    vec3 value(0.0f);
    if (!geometry.is_sky(at)) {
      const auto x = static_cast<std::uint32_t>(at % values.width), y = static_cast<std::uint32_t>(at / values.width);
      if (shown == "albedo") value = geometry.texel(at).base_color;
      if (shown == "normal") value = geometry.texel(at).normal;
      if (shown == "depth")
        value.x =
            static_cast<float>(-(dmat4(geometry.view.view_from_relative) * dvec4(geometry.position(x, y), 1.0)).z);
    }
    values.rgba.insert(values.rgba.end(), {value.x, value.y, value.z, 1.0f});
  }
  return values;
}

/// The name of the image that a visualizer exposes; empty: it exposes none.
std::string image_of(const Renderer& renderer, std::string_view shown) {
  for (const VisualizerInfo& info : renderer.visualizers())
    if (info.name == shown) return info.image.empty() ? info.name : info.image;
  return {};
}

}  // namespace

Result<std::vector<float>> texels_as_floats(const ImageBytes& image) {
  const std::size_t channels = channels_of(image.format), texels = std::size_t{image.width} * image.height;
  if (channels == 0)
    return Error{ErrorKind::failed,
                 "an image of the format " + std::string(gpu::name_of(image.format)) + " cannot be written as numbers"};
  std::vector<float> floats(texels * 4, 0.0f);
  for (std::size_t texel = 0; texel < texels; ++texel)
    for (std::size_t channel = 0; channel < channels; ++channel)
      floats[texel * 4 + channel] = channel_of(image, texel * channels + channel);
  return floats;
}

Result<LinearPicture> read_view_values(Session& session, const ViewSettings& view) {
  const std::string_view shown = std::string_view(view.visualizer).substr(0, view.visualizer.find(':'));
  if (shown == "albedo" || shown == "normal" || shown == "depth") {
    const auto geometry = session.renderer->read_geometry(session.world, view.id);
    if (!geometry) return geometry.error();
    return geometry_values(*geometry, shown);
  }
  const std::string name = image_of(*session.renderer, shown);
  if (shown == "none" || name.empty()) return session.renderer->read_linear(view.id);
  const auto image = session.renderer->read_image(session.world, view.id, name);
  if (!image && image.error().kind == ErrorKind::usage) return session.renderer->read_linear(view.id);
  if (!image) return image.error();
  auto floats = texels_as_floats(*image);
  if (!floats) return floats.error();
  return LinearPicture{image->width, image->height, std::move(floats).value()};
}

}  // namespace gloam

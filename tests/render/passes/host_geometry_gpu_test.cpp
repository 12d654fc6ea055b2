// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/math/srgb.h"
#include "engine/render/host_geometry.h"

#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <glm/gtc/packing.hpp>
#include <glm/packing.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "engine/math/packing.h"
#include "engine/render/readback/geometry_picture.h"
#include "tests/render/draws/drawn_scene.h"
#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

using ::testing::HasSubstr;

constexpr std::uint32_t kWidth = 64;
constexpr std::uint32_t kHeight = 36;

/// A host's data of a pixel.
struct HostTexel {
  bool sky = true;
  double view_depth_m = 0.0;
  vec3 view_normal = vec3(0.0f);
  GeometryTexel surface;
};

/// An image of the host and its texels.
class Images {
 public:
  ~Images() {
    for (const gpu::ImageHandle image : images_) test::drawing_device()->destroy(image);
  }
  /// write: appends the bytes of a texel.
  template <class Write>
  gpu::ImageHandle make(gpu::Format format, const std::vector<HostTexel>& texels, const Write& write) {
    std::vector<std::byte> bytes;
    for (const HostTexel& texel : texels) {
      const auto value = write(texel);
      const auto* begin = reinterpret_cast<const std::byte*>(&value);
      bytes.insert(bytes.end(), begin, begin + sizeof(value));
    }
    return upload(format, bytes);
  }

 private:
  gpu::ImageHandle upload(gpu::Format format, const std::vector<std::byte>& bytes) {
    gpu::Device& device = *test::drawing_device();
    EXPECT_EQ(bytes.size(), std::size_t{kWidth} * kHeight * gpu::bytes_per_texel(format));
    gpu::ImageDesc desc;
    desc.name = "host";
    desc.module = "host";
    desc.format = format;
    desc.width = kWidth;
    desc.height = kHeight;
    desc.usage = gpu::ImageUsage::sampled | gpu::ImageUsage::transfer_target;
    const gpu::ImageHandle image = test::value_of(device.create_image(desc));
    gpu::BufferDesc staging;
    staging.name = "staging";
    staging.module = "host";
    staging.size = bytes.size();
    staging.usage = gpu::BufferUsage::transfer_source;
    staging.memory = gpu::MemoryKind::upload;
    const gpu::BufferHandle buffer = test::value_of(device.create_buffer(staging));
    std::memcpy(device.mapped(buffer).data(), bytes.data(), bytes.size());
    gpu::CommandList* commands = test::value_of(device.begin_frame());
    const gpu::ImageBarrier to_write = {image, gpu::Access::none, gpu::Access::transfer_write};
    commands->barrier({}, {&to_write, 1});
    commands->copy_buffer_to_image(buffer, 0, image, 0, 0, 1);
    const gpu::ImageBarrier to_read = {image, gpu::Access::transfer_write, gpu::Access::fragment_read};
    commands->barrier({}, {&to_read, 1});
    EXPECT_TRUE(device.submit_frame().ok());
    EXPECT_TRUE(device.wait_idle().ok());
    device.destroy(buffer);
    images_.push_back(image);
    return image;
  }
  std::vector<gpu::ImageHandle> images_;
};

std::uint32_t rgba8(const vec4& v) { return glm::packUnorm4x8(v); }
std::uint64_t half4(const vec4& v) { return glm::packHalf4x16(v); }

/// A tilted camera sees boxes and a floor; its pixels are what a host has drawn.
class HostGeometryTest : public test::DrawingTest {
 protected:
  void SetUp() override {
    DrawingTest::SetUp();
    if (IsSkipped()) return;
    test::fill_small_scene(stage->world);
    stage->settings = test::look_at(dvec3(2.0, 3.0, 9.0), dvec3(0.0), kWidth, kHeight);
    stage->render();
    drawn = test::value_of(stage->renderer->read_geometry(stage->world, ViewId{0}));
    const mat3 view_from_world(drawn.view.view_from_relative);
    for (std::uint32_t y = 0; y < kHeight; ++y)
      for (std::uint32_t x = 0; x < kWidth; ++x) {
        HostTexel texel;
        const std::size_t at = std::size_t{y} * kWidth + x;
        texel.sky = drawn.is_sky(at);
        if (!texel.sky) {
          texel.surface = drawn.texel(at);
          texel.view_normal = view_from_world * texel.surface.normal;
          texel.view_depth_m = -(glm::dmat3(view_from_world) * drawn.position(x, y)).z;
        }
        texels.push_back(texel);
      }
    host = std::make_unique<test::Stage>();
    host->settings = stage->settings;
  }

  /// The usual encodings: reversed depth, world normals and linear colours as half floats.
  HostGeometryDesc plain() {
    HostGeometryDesc desc;
    desc.near_m = 0.25f;
    desc.depth = depth_image([](double view_depth) { return 0.25 / view_depth; }, 0.0f);
    desc.normals = images.make(gpu::Format::rgba16_float, texels,
                               [](const HostTexel& t) { return half4(vec4(3.0f * t.surface.normal, 0.0f)); });
    desc.face_normals = images.make(gpu::Format::rgba16_float, texels,
                                    [](const HostTexel& t) { return half4(vec4(t.surface.face_normal, 0.0f)); });
    desc.base_color = images.make(gpu::Format::rgba16_float, texels,
                                  [](const HostTexel& t) { return half4(vec4(t.surface.base_color, 1.0f)); });
    desc.material = images.make(gpu::Format::rgba8_unorm, texels, [](const HostTexel& t) {
      return rgba8(vec4(t.surface.occlusion, t.surface.roughness, t.surface.metallic, 0.0f));
    });
    return desc;
  }
  gpu::ImageHandle depth_image(const std::function<double(double)>& stored, float sky) {
    return images.make(gpu::Format::r32_float, texels,
                       [&](const HostTexel& t) { return t.sky ? sky : static_cast<float>(stored(t.view_depth_m)); });
  }

  /// Compares gloam's geometry buffer with the images. Tolerances: of depth, relative; of normals, length of the
  /// difference.
  void expect_same(const HostGeometryDesc& desc, double depth_error = 1e-6, double normal_error = 2e-3) {
    const auto geometry = HostGeometry::create(*test::drawing_device(), desc);
    ASSERT_TRUE(geometry.ok()) << geometry.error().message;
    ViewRequest request = host->request();
    request.geometry = *geometry;
    host->render({request});
    const GeometryPicture made = test::value_of(host->renderer->read_geometry(host->world, ViewId{0}));
    for (std::size_t at = 0; at < texels.size(); ++at) {
      ASSERT_EQ(made.is_sky(at), drawn.is_sky(at)) << at;
      if (made.is_sky(at)) continue;
      ASSERT_NEAR(made.depth[at] / drawn.depth[at], 1.0, depth_error) << at;
      const GeometryTexel a = made.texel(at), b = texels[at].surface;
      ASSERT_LT(glm::length(a.base_color - b.base_color), 0.012f) << at;
      ASSERT_LT(glm::length(a.normal - b.normal), normal_error) << at;
      ASSERT_NEAR(a.roughness, b.roughness, 0.003f);
      ASSERT_NEAR(a.metallic, b.metallic, 0.003f);
      ASSERT_NEAR(a.occlusion, b.occlusion, 0.003f);
      ASSERT_NEAR(a.reflectivity, b.reflectivity, 0.006f);
    }
  }
  void expect_refused(const HostGeometryDesc& desc, const std::string& sentence) {
    const auto geometry = HostGeometry::create(*test::drawing_device(), desc);
    ASSERT_FALSE(geometry.ok());
    EXPECT_EQ(geometry.error().kind, ErrorKind::usage);
    EXPECT_THAT(geometry.error().message, HasSubstr(sentence));
  }

  std::unique_ptr<test::Stage> host;  ///< its world has no meshes
  GeometryPicture drawn;
  std::vector<HostTexel> texels;
  Images images;
};

TEST_F(HostGeometryTest, takes_the_place_of_the_geometry_pass) { expect_same(plain()); }

TEST_F(HostGeometryTest, reads_every_kind_of_depth) {
  HostGeometryDesc desc = plain();
  const double n = 0.25, f = 60.0;
  desc.far_m = 60.0f;
  desc.depth = depth_image([&](double z) { return n * (f - z) / (z * (f - n)); }, 0.0f);
  expect_same(desc, 2e-5);
  desc.depth_kind = HostDepth::standard;
  desc.depth = depth_image([&](double z) { return f * (z - n) / (z * (f - n)); }, 1.0f);
  expect_same(desc, 2e-5);
  desc.far_m = 0.0f;
  desc.depth = depth_image([&](double z) { return 1.0 - n / z; }, 1.0f);
  expect_same(desc, 2e-5);
  desc.depth_kind = HostDepth::metres;
  for (const float sky :
       {0.0f, -1.0f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    desc.depth = depth_image([](double z) { return z; }, sky);
    expect_same(desc);
  }
}

TEST_F(HostGeometryTest, reads_every_kind_of_normal) {
  HostGeometryDesc desc = plain();
  desc.face_normals = {};
  desc.normals = images.make(gpu::Format::rgba8_unorm, texels,
                             [](const HostTexel& t) { return rgba8(vec4(0.5f + 0.5f * t.surface.normal, 0.0f)); });
  expect_same(desc, 1e-6, 0.015);
  desc.view_space_normals = true;
  desc.normals = images.make(gpu::Format::rgba16_float, texels,
                             [](const HostTexel& t) { return half4(vec4(t.view_normal, 0.0f)); });
  expect_same(desc);
  desc.normals_kind = HostNormals::octahedral;
  desc.normals = images.make(gpu::Format::rg16_snorm, texels, [](const HostTexel& t) {
    return glm::packSnorm2x16(t.sky ? vec2(0.0f) : octahedral_encode(t.view_normal));
  });
  expect_same(desc);
  desc.view_space_normals = false;
  desc.normals = images.make(gpu::Format::rg16_unorm, texels, [](const HostTexel& t) {
    return glm::packUnorm2x16(t.sky ? vec2(0.0f) : 0.5f + 0.5f * octahedral_encode(t.surface.normal));
  });
  expect_same(desc);
}

TEST_F(HostGeometryTest, reads_srgb_colours_and_other_channels) {
  const auto encoded = [](const HostTexel& t) {
    vec3 c = t.surface.base_color;
    for (int i = 0; i < 3; ++i) c[i] = static_cast<float>(linear_to_srgb(static_cast<double>(c[i])));
    return rgba8(vec4(c, 1.0f));
  };
  HostGeometryDesc desc = plain();
  desc.base_color = images.make(gpu::Format::rgba8_srgb, texels, encoded);
  expect_same(desc);
  desc.srgb_base_color = true;  // changes nothing: the hardware decodes
  expect_same(desc);
  desc.base_color = images.make(gpu::Format::rgba8_unorm, texels, encoded);
  desc.material = images.make(gpu::Format::rgba8_unorm, texels, [](const HostTexel& t) {
    return rgba8(vec4(t.surface.roughness, 0.0f, t.surface.occlusion, t.surface.metallic));
  });
  desc.roughness = HostChannel::r;
  desc.metallic = HostChannel::a;
  desc.occlusion = HostChannel::b;
  expect_same(desc);
}

TEST_F(HostGeometryTest, computes_face_normals_from_depth) {
  HostGeometryDesc desc = plain();
  desc.face_normals = {};
  expect_same(desc);
  const GeometryPicture made = test::value_of(host->renderer->read_geometry(host->world, ViewId{0}));
  int close = 0, surfaces = 0;
  for (std::size_t at = 0; at < texels.size(); ++at) {
    if (texels[at].sky) continue;
    ++surfaces;
    close += glm::dot(made.texel(at).face_normal, texels[at].surface.face_normal) > std::cos(0.02f) ? 1 : 0;
  }
  EXPECT_GT(surfaces, 500);
  EXPECT_GT(close, 95 * surfaces / 100) << "only pixels at edges may differ";
}

TEST_F(HostGeometryTest, lies_together_with_meshes_of_the_world) {
  const HostGeometryDesc desc = plain();
  ViewRequest request = stage->request();
  request.geometry = *HostGeometry::create(*test::drawing_device(), desc);
  test::Stage both;
  both.settings = stage->settings;
  both.scene.draw(both.scene.mesh(test::quad(50.0f)), glm::translate(dmat4(1.0), dvec3(0.0, 0.0, -20.0)));
  both.render({request});
  const GeometryPicture made = test::value_of(both.renderer->read_geometry(both.world, ViewId{0}));
  for (std::size_t at = 0; at < texels.size(); ++at) {
    EXPECT_FALSE(made.is_sky(at)) << "the wall fills the picture behind the host's surfaces";
    if (!texels[at].sky) {
      EXPECT_GE(made.depth[at] * (1.0f + 1e-5f), drawn.depth[at]);
    }
  }
  HostGeometryDesc alone = desc;
  alone.draws_meshes = false;
  request.geometry = *HostGeometry::create(*test::drawing_device(), alone);
  both.render({request});
  const GeometryPicture without = test::value_of(both.renderer->read_geometry(both.world, ViewId{0}));
  for (std::size_t at = 0; at < texels.size(); ++at) EXPECT_EQ(without.is_sky(at), texels[at].sky);
}

TEST_F(HostGeometryTest, images_are_checked) {
  const HostGeometryDesc good = plain();
  HostGeometryDesc desc = good;
  desc.normals = {};
  expect_refused(desc, "the image of normals is missing");
  desc = good;
  desc.depth = {};
  expect_refused(desc, "the image of depth is missing");
  desc = good;
  desc.depth = good.material;
  expect_refused(desc, "the image of depth has the format rgba8_unorm");
  desc = good;
  desc.near_m = 0.0f;
  expect_refused(desc, "near_m must be above 0");
  desc = good;
  desc.far_m = 0.1f;
  expect_refused(desc, "far_m must be 0 (infinitely far) or above near_m");
  desc = good;
  desc.roughness = HostChannel::none;
  expect_refused(desc, "roughness needs a channel");
  gpu::ImageDesc small;
  small.name = "small";
  small.module = "host";
  small.format = gpu::Format::rgba8_unorm;
  small.width = 8;
  small.height = 8;
  small.usage = gpu::ImageUsage::sampled;
  const gpu::ImageHandle image = test::value_of(test::drawing_device()->create_image(small));
  desc = good;
  desc.base_color = image;
  expect_refused(desc, "the image of base colour has 8x8 pixels, depth has 64x36");
  test::drawing_device()->destroy(image);
  ViewRequest request = host->request();
  request.settings.width = 65;
  request.geometry = *HostGeometry::create(*test::drawing_device(), good);
  EXPECT_ASSERT((void)host->renderer->render(host->world, {&request, 1}),
                "the host's geometry 64x36: they must have one size");
}

}  // namespace
}  // namespace gloam

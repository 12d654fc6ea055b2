// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/gpu/spec_constants.h"

/// Handles and descriptions of GPU objects, independent of any graphics API's headers.
namespace gloam::gpu {

/// Identifies a GPU object. Generation 0 means "no object". Generations make stale handles detectable.
template <class Tag>
struct Handle {
  std::uint32_t index = 0;
  std::uint32_t generation = 0;
  [[nodiscard]] explicit operator bool() const { return generation != 0; }
  auto operator<=>(const Handle&) const = default;
};
using BufferHandle = Handle<struct BufferTag>;
using ImageHandle = Handle<struct ImageTag>;
using SamplerHandle = Handle<struct SamplerTag>;
using PipelineHandle = Handle<struct PipelineTag>;
using ResourceSetHandle = Handle<struct ResourceSetTag>;
using MemoryHandle = Handle<struct MemoryTag>;

enum class Format : std::uint8_t {
  undefined,
  r8_unorm,
  rgba8_unorm,
  rgba8_srgb,
  bgra8_unorm,
  bgra8_srgb,
  rgb10a2_unorm,
  rg11b10_float,
  r16_uint,
  r16_float,
  r16_unorm,
  rg16_unorm,
  rg16_snorm,
  rg16_float,
  rgba16_float,
  r32_uint,
  rg32_uint,
  rgba32_uint,
  r32_float,
  rg32_float,
  rgb32_float,  ///< vertex attributes only
  rgba32_float,
  rgba8_uint,   ///< vertex attributes and images
  rgba16_uint,  ///< vertex attributes only
  d32_float,
};

[[nodiscard]] std::uint32_t bytes_per_texel(Format format);
[[nodiscard]] bool is_depth(Format format);
[[nodiscard]] bool is_integer(Format format);
/// Whether the hardware encodes linear colour as sRGB when it writes this format.
[[nodiscard]] constexpr bool encodes_srgb(Format format) {
  return format == Format::rgba8_srgb || format == Format::bgra8_srgb;
}
[[nodiscard]] std::string_view name_of(Format format);

template <class E>
constexpr bool kIsFlags = false;
template <class E>
requires(kIsFlags<E>) constexpr E operator|(E a, E b) {
  return static_cast<E>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b));
}
template <class E>
requires(kIsFlags<E>) constexpr bool has(E set, E flag) {
  return (static_cast<std::uint32_t>(set) & static_cast<std::uint32_t>(flag)) != 0;
}

enum class BufferUsage : std::uint32_t {
  none = 0,
  transfer_source = 1,
  transfer_target = 2,
  uniform = 4,
  storage = 8,
  index = 16,
  vertex = 32,
  indirect = 64,
};
template <>
inline constexpr bool kIsFlags<BufferUsage> = true;

enum class ImageUsage : std::uint32_t {
  none = 0,
  transfer_source = 1,
  transfer_target = 2,
  sampled = 4,
  storage = 8,
  color_target = 16,
  depth_target = 32,
};
template <>
inline constexpr bool kIsFlags<ImageUsage> = true;

/// "sampled, storage"; "no use" for ImageUsage::none.
[[nodiscard]] std::string text_of(ImageUsage usage);

enum class MemoryKind : std::uint8_t {
  device,    ///< fastest for the GPU; not mapped
  upload,    ///< mapped, written sequentially by the CPU, read by the GPU
  readback,  ///< mapped, written by the GPU, read by the CPU
};

/// `module`: the module that the memory is accounted to ("engine" or a module's name).
struct BufferDesc {
  std::string name;
  std::string module;
  std::uint64_t size = 0;  ///< bytes, > 0
  BufferUsage usage = BufferUsage::none;
  MemoryKind memory = MemoryKind::device;
};

enum class ImageShape : std::uint8_t { plain, array, cube, volume };

/// width, height and depth in texels. A cube image is square and has six layers per cube. A volume is
/// three-dimensional: each mip halves its depth too, and it has one layer, no depth format and no target usage.
/// `module`: as in BufferDesc.
struct ImageDesc {
  std::string name;
  std::string module;
  Format format = Format::undefined;
  std::uint32_t width = 1;
  std::uint32_t height = 1;
  std::uint32_t layers = 1;
  std::uint32_t mips = 1;
  ImageUsage usage = ImageUsage::none;
  ImageShape shape = ImageShape::plain;
  std::uint32_t depth = 1;  ///< of a volume; 1 for all other shapes
};

enum class Filter : std::uint8_t { nearest, linear };
enum class AddressMode : std::uint8_t { repeat, mirrored_repeat, clamp_to_edge };
enum class CompareOp : std::uint8_t { never, less, less_equal, equal, greater, greater_equal, always };

struct SamplerDesc {
  Filter min_filter = Filter::linear;
  Filter mag_filter = Filter::linear;
  Filter mip_filter = Filter::linear;
  AddressMode address_u = AddressMode::repeat;
  AddressMode address_v = AddressMode::repeat;  ///< also along the depth of a volume
  float max_anisotropy = 1.0f;
  bool compare = false;
  CompareOp compare_op = CompareOp::greater_equal;
  bool operator==(const SamplerDesc&) const = default;
};

/// Mips and layers of an image: a rectangle of subresources. A count of 0 means all remaining ones, so the default
/// range is the whole image.
struct ImageRange {
  std::uint32_t first_mip = 0;
  std::uint32_t mip_count = 0;
  std::uint32_t first_layer = 0;
  std::uint32_t layer_count = 0;
  bool operator==(const ImageRange&) const = default;
};

/// One mip of one layer of an image.
struct ImagePart {
  std::uint32_t mip = 0;
  std::uint32_t layer = 0;
};

/// The mips and layers of an image that a pass or a binding uses. A count of 0 means all remaining ones.
struct ImageView {
  ImageHandle image;
  std::uint32_t first_mip = 0;
  std::uint32_t mip_count = 0;
  std::uint32_t first_layer = 0;
  std::uint32_t layer_count = 0;
  bool as_array = false;  ///< array view even with one layer; devices ignore it and follow the shader
  bool operator==(const ImageView&) const = default;
};

/// One resource bound to a shader. BufferRange::size 0: to the end of the buffer.
struct Binding {
  struct BufferRange {
    BufferHandle buffer;
    std::uint64_t offset = 0;
    std::uint64_t size = 0;
  };
  struct Sampled {
    ImageView view;
    SamplerHandle sampler;
  };
  struct Storage {
    ImageView view;
  };
  std::uint32_t binding = 0;
  std::variant<BufferRange, Sampled, Storage> resource;
};

/// SPIR-V with entry point "main". The words must stay valid while the device uses them; embedded shaders are valid for
/// the whole run.
struct ShaderCode {
  std::string_view name;
  std::span<const std::uint32_t> words;
};

struct ComputePipelineDesc {
  std::string name;
  std::string module;
  ShaderCode shader;
  SpecConstants constants;
};

enum class CullMode : std::uint8_t { none, front, back };
enum class BlendMode : std::uint8_t {
  opaque,
  alpha,
  premultiplied,
  additive,
  /// As premultiplied, but the target's alpha is multiplied by 1 - alpha: it is the share that shows through all draws.
  premultiplied_over,
};

struct VertexAttribute {
  std::uint32_t location = 0;
  std::uint32_t stream = 0;
  Format format = Format::undefined;
  std::uint32_t offset = 0;  ///< bytes from the start of a vertex in the stream
};

struct GraphicsPipelineDesc {
  std::string name;
  std::string module;
  ShaderCode vertex;
  ShaderCode fragment;  ///< no words: no fragment stage, depth only
  SpecConstants constants;
  std::vector<VertexAttribute> attributes;
  std::vector<std::uint32_t> stream_strides;  ///< bytes, one per vertex stream
  std::vector<Format> color_formats;
  Format depth_format = Format::undefined;
  CullMode cull = CullMode::back;  ///< front faces are counter-clockwise in the rendered image
  BlendMode blend = BlendMode::opaque;
  CompareOp depth_compare = CompareOp::greater_equal;
  bool depth_write = true;
  bool depth_bias = false;  ///< values come from CommandList::set_depth_bias
};

/// A way to access a resource, for barriers. It determines the pipeline stages, the memory accesses and the image
/// layout.
enum class Access : std::uint8_t {
  none,
  transfer_read,
  transfer_write,
  host_read,
  vertex_input,  ///< vertex and index buffers
  indirect_read,
  uniform_read,          ///< uniform buffer or sampled image, any shader stage
  vertex_read,           ///< storage buffer or sampled image, vertex stage
  fragment_read,         ///< storage buffer or sampled image, fragment stage
  compute_read,          ///< storage buffer or sampled image, compute stage
  compute_storage_read,  ///< storage image read in compute (general layout)
  compute_write,         ///< storage buffer or image written, or read and written, compute stage
  fragment_write,        ///< storage buffer or image written, fragment stage
  color_target,          ///< colour attachment: written, possibly loaded and blended
  depth_target,          ///< depth attachment: tested and written
  depth_test,            ///< depth attachment: tested only; fragments of the same pass may sample it
  present,
};
[[nodiscard]] bool is_write(Access access);
[[nodiscard]] std::string_view name_of(Access access);

/// Several accesses at once: bit (1 << access) for each.
using AccessMask = std::uint32_t;
[[nodiscard]] constexpr AccessMask mask_of(Access access) {
  return access == Access::none ? 0u : 1u << static_cast<std::uint32_t>(access);
}

/// The accesses `after` and `also_after` wait for the accesses `before` and `also_before`. If `before` is none and
/// `also_before` is empty, they wait for all earlier work. `also_after` holds further reads of the written data; for
/// images, reads of the same layout as `after`.
struct BufferBarrier {
  BufferHandle buffer;
  Access before = Access::none;
  Access after = Access::none;
  AccessMask also_before = 0;
  AccessMask also_after = 0;
};
struct ImageBarrier {
  ImageHandle image;
  Access before = Access::none;  ///< none: the contents may be discarded
  Access after = Access::none;
  AccessMask also_before = 0;  ///< if `before` is none: accesses to this image, or to one that shares its memory
  AccessMask also_after = 0;
  ImageRange range;  ///< all of it is in the layout of `before`; ranges of one image in one call must not overlap
};

enum class LoadOp : std::uint8_t { load, clear, discard };
struct ColorTarget {
  ImageView view;
  LoadOp load = LoadOp::clear;
  std::array<float, 4> clear = {0.0f, 0.0f, 0.0f, 0.0f};
};
struct DepthTarget {
  ImageView view;
  LoadOp load = LoadOp::clear;
  float clear = 0.0f;
  bool read_only = false;
};
struct RenderingDesc {
  std::vector<ColorTarget> colors;
  DepthTarget depth;  ///< no depth attachment if view.image is none
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  /// Top left corner, in texels, of the area that is rendered and cleared. width and height are the size of this area.
  std::uint32_t x = 0;
  std::uint32_t y = 0;
};

enum class DeviceType : std::uint8_t { discrete, integrated, cpu, other };
[[nodiscard]] std::string_view name_of(DeviceType type);

struct DeviceInfo {
  std::string name;
  std::string driver;
  DeviceType type = DeviceType::other;
  /// A workgroup's threads run one after another, and each barrier swaps all their state: kernels with few threads and
  /// barriers are faster. True on cpu devices (see VulkanOptions::threads_in_turn).
  bool threads_in_turn = false;
  std::uint32_t subgroup_size = 0;      ///< threads
  std::uint64_t max_storage_range = 0;  ///< largest size of one storage buffer binding, in bytes
  std::uint32_t subpixel_bits = 8;  ///< corners of triangles are moved to a grid of 2^bits places a pixel; 4 or more
};

/// Requirements of an image or a buffer on the memory block that it is placed in.
struct MemoryNeeds {
  std::uint64_t size = 0;       ///< bytes, > 0
  std::uint64_t alignment = 1;  ///< of the offset; a power of two
  std::uint32_t types = 0;      ///< kinds of memory that fit, a bit each; what a bit means is up to the device
};

/// A block of device memory. types: of all images and buffers that will be placed in it, combined with &.
struct MemoryDesc {
  std::string name;
  std::string module;
  std::uint64_t size = 0;  ///< bytes, > 0
  std::uint32_t types = 0;
};

/// Where an image or a buffer lies in a memory block. offset: bytes, a multiple of its MemoryNeeds::alignment.
struct MemoryPlace {
  MemoryHandle memory;
  std::uint64_t offset = 0;
};

struct ModuleMemory {
  std::string module;
  std::uint64_t bytes = 0;
};

/// How a device takes memory from its driver.
struct MemoryOptions {
  /// Largest size of a memory block, in bytes; at least kLeastBlockBytes. Small buffers and images of one kind of
  /// memory share blocks. The first block of a kind has kLeastBlockBytes, further ones are as large as all blocks of
  /// the kind before. An object larger than half of `block_bytes` has its own allocation.
  std::uint64_t block_bytes = std::uint64_t{64} << 20;
  /// The most bytes that the device reserves; 0: no limit. A creation that would exceed it fails with an Error that
  /// names the budget, after empty blocks were given back.
  std::uint64_t budget_bytes = 0;

  static constexpr std::uint64_t kLeastBlockBytes = std::uint64_t{4} << 20;
};

/// Memory of a whole device, in bytes.
struct MemoryTotals {
  std::uint64_t used = 0;      ///< of all living objects: the sum of Device::memory
  std::uint64_t reserved = 0;  ///< taken from the driver or the host's allocator; at least `used`
  std::uint32_t blocks = 0;    ///< number of allocations that `reserved` consists of
  std::uint64_t budget = 0;    ///< MemoryOptions::budget_bytes
};

}  // namespace gloam::gpu

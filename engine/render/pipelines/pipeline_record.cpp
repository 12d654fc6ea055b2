// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/pipelines/pipeline_record.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "engine/core/hash.h"

namespace gloam {
namespace {

using Json = nlohmann::ordered_json;

/// Changes when the form of records does.
constexpr int kVersion = 1;

std::uint64_t checksum(std::string_view text) { return hash_bytes(std::as_bytes(std::span(text))); }
std::uint64_t words_hash(const gpu::ShaderCode& code) { return hash_bytes(std::as_bytes(code.words)); }

template <class Enum>
int number_of(Enum value) {
  return static_cast<int>(value);
}

/// The first line of a record.
std::string header_of(std::string_view body) {
  return Json{{"pipelines", kVersion}, {"checksum", checksum(body)}}.dump() + "\n";
}

Json json_of(const gpu::ShaderCode& code) {
  return code.words.empty() ? Json() : Json{{"name", code.name}, {"words", words_hash(code)}};
}

Json json_of(const gpu::SpecConstants& constants) {
  Json all = Json::array();
  for (const gpu::SpecConstant& constant : constants)
    all.push_back({{"name", constant.name},
                   {"type", number_of(constant.value.type)},
                   {"bits", constant.value.bits},
                   {"if_present", constant.if_present}});
  return all;
}

Json json_of(const gpu::ComputePipelineDesc& desc) {
  return {{"name", desc.name},
          {"module", desc.module},
          {"shader", json_of(desc.shader)},
          {"constants", json_of(desc.constants)}};
}

Json json_of(const gpu::GraphicsPipelineDesc& desc) {
  Json attributes = Json::array(), formats = Json::array();
  for (const gpu::VertexAttribute& a : desc.attributes)
    attributes.push_back({a.location, a.stream, number_of(a.format), a.offset});
  for (const gpu::Format format : desc.color_formats) formats.push_back(number_of(format));
  return {{"name", desc.name},
          {"module", desc.module},
          {"vertex", json_of(desc.vertex)},
          {"fragment", json_of(desc.fragment)},
          {"constants", json_of(desc.constants)},
          {"attributes", attributes},
          {"strides", desc.stream_strides},
          {"color_formats", formats},
          {"depth_format", number_of(desc.depth_format)},
          {"cull", number_of(desc.cull)},
          {"blend", number_of(desc.blend)},
          {"depth_compare", number_of(desc.depth_compare)},
          {"depth_write", desc.depth_write},
          {"depth_bias", desc.depth_bias}};
}

/// Reads the descriptions of a record whose checksum is right. Somebody else may have written it nevertheless.
class Reader {
 public:
  Reader(std::span<const gpu::ShaderCode* const> shaders, PipelineNames& names) : names_(names) {
    for (const gpu::ShaderCode* shader : shaders) shaders_.emplace(shader->name, shader);
  }

  /// Nullopt if a shader is not known.
  [[nodiscard]] std::optional<PipelineList::value_type> pipeline(const Json& json) {
    if (json.contains("shader")) {
      gpu::ComputePipelineDesc desc;
      if (!read_shader(json.at("shader"), desc.shader)) return std::nullopt;
      read_common(json, desc);
      return desc;
    }
    gpu::GraphicsPipelineDesc desc;
    if (!read_shader(json.at("vertex"), desc.vertex) || !read_shader(json.at("fragment"), desc.fragment))
      return std::nullopt;
    read_common(json, desc);
    read_state(json, desc);
    return desc;
  }

  /// Whether all numbers so far stand for a value of their type.
  [[nodiscard]] bool sound() const { return sound_; }

 private:
  /// last: the type's last value.
  template <class Enum>
  void read(const Json& json, Enum& value, Enum last) {
    const std::uint32_t number = whole(json);
    sound_ = sound_ && number <= static_cast<std::uint32_t>(number_of(last));
    if (sound_) value = static_cast<Enum>(number);
  }
  /// A whole number of 32 bits; the library would wrap another one, or cast it without a defined result.
  [[nodiscard]] std::uint32_t whole(const Json& json) {
    sound_ = sound_ && json.is_number_unsigned() && json.get<std::uint64_t>() <= 0xffffffffu;
    return sound_ ? json.get<std::uint32_t>() : 0;
  }

  [[nodiscard]] bool read_shader(const Json& json, gpu::ShaderCode& code) const {
    if (json.is_null()) return true;
    const auto found = shaders_.find(json.at("name").get<std::string>());
    if (found == shaders_.end() || json.at("words") != words_hash_of(*found->second)) return false;
    code = *found->second;
    return true;
  }
  [[nodiscard]] std::uint64_t words_hash_of(const gpu::ShaderCode& code) const {
    const auto [at, fresh] = hashes_.try_emplace(&code);
    if (fresh) at->second = words_hash(code);
    return at->second;
  }

  template <class Desc>
  void read_common(const Json& json, Desc& desc) {
    desc.name = json.at("name").get<std::string>();
    desc.module = json.at("module").get<std::string>();
    for (const Json& constant : json.at("constants")) {
      const std::string& name = *names_.insert(constant.at("name").get<std::string>()).first;
      gpu::SpecValue value(std::uint32_t{0});
      read(constant.at("type"), value.type, gpu::SpecType::floating);
      value.bits = whole(constant.at("bits"));
      if (constant.at("if_present").get<bool>())
        desc.constants.set_if_present(name, value);
      else
        desc.constants.set(name, value);
    }
  }

  void read_state(const Json& json, gpu::GraphicsPipelineDesc& desc) {
    for (const Json& a : json.at("attributes")) {
      gpu::VertexAttribute& made = desc.attributes.emplace_back();
      made.location = whole(a.at(0));
      made.stream = whole(a.at(1));
      read(a.at(2), made.format, gpu::Format::d32_float);
      made.offset = whole(a.at(3));
    }
    for (const Json& stride : json.at("strides")) desc.stream_strides.push_back(whole(stride));
    for (const Json& format : json.at("color_formats"))
      read(format, desc.color_formats.emplace_back(), gpu::Format::d32_float);
    read(json.at("depth_format"), desc.depth_format, gpu::Format::d32_float);
    read(json.at("cull"), desc.cull, gpu::CullMode::back);
    read(json.at("blend"), desc.blend, gpu::BlendMode::premultiplied_over);
    read(json.at("depth_compare"), desc.depth_compare, gpu::CompareOp::always);
    desc.depth_write = json.at("depth_write").get<bool>();
    desc.depth_bias = json.at("depth_bias").get<bool>();
  }

  std::map<std::string_view, const gpu::ShaderCode*> shaders_;
  mutable std::map<const gpu::ShaderCode*, std::uint64_t> hashes_;
  PipelineNames& names_;
  bool sound_ = true;
};

}  // namespace

std::string pipeline_record(const PipelineList& list) {
  std::vector<std::string> lines;
  for (const auto& any : list) lines.push_back(std::visit([](const auto& desc) { return json_of(desc).dump(); }, any));
  std::ranges::sort(lines);  // equal lists give equal text
  std::string body = "[";
  for (const std::string& line : lines) body += (body.size() > 1 ? ",\n" : "\n") + line;
  body += "\n]\n";
  return header_of(body) + body;
}

bool is_sound_record(std::string_view record) {
  const std::size_t end = record.find('\n');
  return end != std::string_view::npos && record.substr(0, end + 1) == header_of(record.substr(end + 1));
}

PipelineList parse_pipeline_record(std::string_view record, std::span<const gpu::ShaderCode* const> shaders,
                                   PipelineNames& names) {
  if (!is_sound_record(record)) return {};
  const Json all = Json::parse(record.substr(record.find('\n') + 1), nullptr, false);
  if (all.is_discarded()) return {};
  PipelineList list;
  Reader reader(shaders, names);
  try {
    for (const Json& json : all)
      if (auto desc = reader.pipeline(json)) list.push_back(std::move(*desc));
  } catch (const Json::exception&) {  // written by somebody else, with a checksum
    return {};
  }
  return reader.sound() ? list : PipelineList();
}

}  // namespace gloam

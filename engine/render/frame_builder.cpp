// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/frame_builder.h"

#include "engine/render/camera/view_constants.h"
#include "engine/render/worlds/world_id.h"

namespace gloam {

std::string FrameBuilder::absent_output(std::string_view type) const {
  return "module \"" + std::string(module_) + "\" needs the output " + std::string(type) +
         ", which no pass before it has put: a module is missing in the list, comes later or is not demanded";
}

void FrameBuilder::upload_view_constants(std::uint32_t visualizer_code) {
  shaders::ViewConstants constants = view_constants(view_);
  constants.visualizer = visualizer_code;
  const auto* filter = world_.try_view_resource<HighlightFilter>(view_.id);
  constants.normal_variance = filter != nullptr ? filter->variance : 0.0f;
  if (const auto range = services_.uniforms.write_value(constants); check(range)) view_range_ = *range;
}

Status FrameBuilder::prepare_surfaces(std::span<const Draw> draws, const SurfacePass& pass) {
  for (const Draw& draw : draws)
    if (auto pipeline = surface_pipeline(services_.pipelines, pass, draw.variant); !pipeline.ok())
      return pipeline.error();
  return {};
}

bool FrameBuilder::request_surfaces(std::span<const Draw> draws, const SurfacePass& pass) {
  PipelineList list;
  const SurfaceVariant* last = nullptr;
  for (const Draw& draw : draws) {
    if (last == nullptr || *last != draw.variant) list.push_back(surface_pipeline_desc(pass, draw.variant));
    last = &draw.variant;
  }
  return services_.pipelines.request(list, services_.log);
}

bool FrameBuilder::has_surfaces(std::span<const Draw> draws, const SurfacePass& pass) const {
  const SurfaceVariant* last = nullptr;
  for (const Draw& draw : draws) {
    const bool known = last != nullptr && *last == draw.variant;
    if (!known && !services_.pipelines.find(surface_pipeline_desc(pass, draw.variant))) return false;
    last = &draw.variant;
  }
  return true;
}

Status FrameBuilder::draw_surfaces(PassContext& context, std::span<const Draw> draws, const SurfacePass& pass,
                                   std::span<const gpu::Binding> bindings, BufferRef cluster_commands) {
  gpu::CommandList& commands = context.commands();
  const gpu::BufferHandle arguments = cluster_commands ? context.buffer(cluster_commands) : gpu::BufferHandle{};
  const Deformed* deformed = shared_.find<Deformed>();
  commands.bind_indices(scene_.indices(), 0);
  const SurfaceVariant* bound_variant = nullptr;
  const GpuMaterial* bound_material = nullptr;
  for (const Draw& draw : draws) {
    if (bound_variant == nullptr || *bound_variant != draw.variant) {
      auto pipeline = surface_pipeline(services_.pipelines, pass, draw.variant);
      if (!pipeline.ok()) return pipeline.error();
      commands.bind_pipeline(*pipeline);
      commands.bind(bindings);
      bound_variant = &draw.variant;
      bound_material = nullptr;
    }
    const GpuPrimitive& primitive = *draw.primitive;
    const GpuMaterial& material = scene_.material(primitive.material);
    // A pass that only draws depth has no fragment shader, which alone reads materials.
    const bool has_material = !pass.fragment.words.empty();
    if (has_material && bound_material != &material) commands.bind_set(1, material.set);
    bound_material = &material;
    const std::uint64_t first = primitive.first_vertex;
    if (draw.deform == kNone) {
      commands.bind_vertex_stream(0, scene_.positions(), first * sizeof(vec3));
      commands.bind_vertex_stream(1, scene_.frames(), first * sizeof(PackedFrame));
    } else {
      const std::uint64_t moved = draws_.deforms[draw.deform].first_vertex;
      commands.bind_vertex_stream(0, context.buffer(deformed->positions), moved * sizeof(vec3));
      commands.bind_vertex_stream(1, context.buffer(deformed->frames), moved * sizeof(PackedFrame));
    }
    commands.bind_vertex_stream(2, scene_.surfaces(), first * sizeof(PackedSurface));
    if (pass.motion) {
      bind_previous_vertices(context, draw);
      commands.push(motion_draw_constants(draw, draws_, view_, previous_instances_->find(world_, draw.entity)));
    } else {
      commands.push(draw.constants);
    }
    if (arguments) {
      commands.draw_indexed_indirect(arguments, draw.first_cluster * sizeof(shaders::ClusterCommand),
                                     draw.cluster_count);
    } else {
      commands.draw_indexed(draw.index_count, 1, draw.first_index, 0, 0);
    }
  }
  return {};
}

void FrameBuilder::add_caster_source(CasterSource source) {
  GLOAM_ASSERT(source.record != nullptr, "a caster source needs a function that records its draws");
  GLOAM_ASSERT(!caster_sources_read_,
               "caster sources are added in PassPhase::announce, before shadow maps are declared");
  caster_source_list_.push_back(&caster_sources_.emplace_back(std::move(source)));
}

std::span<const CasterSource* const> FrameBuilder::caster_sources() {
  caster_sources_read_ = true;
  return caster_source_list_;
}

void FrameBuilder::bind_previous_vertices(PassContext& context, const Draw& draw) const {
  gpu::CommandList& commands = context.commands();
  if (draw.deform == kNone)
    return commands.bind_vertex_stream(3, scene_.positions(), draw.primitive->first_vertex * sizeof(vec3));
  const std::uint64_t moved = draws_.deforms[draw.deform].first_vertex;
  commands.bind_vertex_stream(3, context.buffer(shared_.find<Deformed>()->previous_positions), moved * sizeof(vec3));
}

void FrameBuilder::read_vertices(PassBuilder& pass, bool motion) {
  if (const Deformed* deformed = shared_.find<Deformed>()) {
    if (motion) pass.read(deformed->previous_positions, gpu::Access::vertex_input);
    pass.read(deformed->positions, gpu::Access::vertex_input);
    pass.read(deformed->frames, gpu::Access::vertex_input);
  }
}

void FrameBuilder::use_caster_vertices(const Caster& caster) {
  if (caster.deform != kNone) shared_.find<Deformed>()->used[caster.deform] = 1;
}

void FrameBuilder::bind_caster_vertices(PassContext& context, const Caster& caster, bool with_surfaces) const {
  gpu::CommandList& commands = context.commands();
  const std::uint64_t first = caster.primitive->first_vertex;
  if (caster.deform == kNone) {
    commands.bind_vertex_stream(0, scene_.positions(), first * sizeof(vec3));
  } else {
    const Deformed& deformed = *shared_.find<Deformed>();
    GLOAM_ASSERT(deformed.used[caster.deform] != 0, "a caster is drawn that was not declared by use_caster_vertices");
    const std::uint64_t moved = draws_.deforms[caster.deform].first_vertex;
    commands.bind_vertex_stream(0, context.buffer(deformed.positions), moved * sizeof(vec3));
  }
  if (with_surfaces) commands.bind_vertex_stream(1, scene_.surfaces(), first * sizeof(PackedSurface));
}

void FrameBuilder::expose(ImageRef image, std::string_view name) {
  std::string own(name.empty() ? std::string_view(graph_.desc(image).name) : name);
  for (Exposed& exposed : exposed_) {
    if (exposed.name != own) continue;
    exposed.image = image;
    return;
  }
  exposed_.push_back({std::move(own), image});
}

void FrameBuilder::keep_result(std::string module, std::string name, BufferRef buffer, std::any note) {
  ResultKey key{std::move(module), std::move(name), world_id(world_), view_.id.value};
  services_.results.keep(std::move(key), buffer, 0, graph_.desc(buffer).size, std::move(note));
}

HistoryView FrameBuilder::history_view() const {
  return {world_id(world_), view_.id.value, view_.frame, view_.cut_frame};
}

Result<HistoryImage> FrameBuilder::history_image(const gpu::ImageDesc& desc, const HistoryUse& use) {
  return services_.history.image(graph_, history_view(), desc, use);
}
Result<HistoryBuffer> FrameBuilder::history_buffer(const gpu::BufferDesc& desc, const HistoryUse& use) {
  return services_.history.buffer(graph_, history_view(), desc, use);
}
Result<HistoryImagePair> FrameBuilder::history_image_pair(const gpu::ImageDesc& desc, const HistoryUse& use) {
  return services_.history.image_pair(graph_, history_view(), desc, use);
}

void FrameBuilder::on_commit(std::function<void()> function) { services_.history.on_commit(std::move(function)); }

ImageRef FrameBuilder::captured_light(gpu::ImageHandle image, gpu::Access ready) {
  CapturedLight* captured = shared_.find<CapturedLight>();
  if (captured == nullptr) captured = &shared_.put(CapturedLight{});
  ImageRef& newest = captured->images[image];
  if (!newest) newest = graph_.import_image("light_target", image, ready, ready);
  return newest;
}

gpu::SamplerHandle FrameBuilder::sampler(Sampling sampling) {
  gpu::SamplerDesc desc;
  if (sampling == Sampling::nearest) desc.min_filter = desc.mag_filter = desc.mip_filter = gpu::Filter::nearest;
  desc.address_u = desc.address_v = gpu::AddressMode::clamp_to_edge;
  const auto made = services_.device.create_sampler(desc);
  return check(made) ? *made : gpu::SamplerHandle{};
}

ImageRef create_view_image(FrameBuilder& frame, std::string name, gpu::Format format, std::uint32_t divisor) {
  gpu::ImageDesc desc;
  desc.name = std::move(name);
  desc.module = frame.module();
  desc.format = format;
  desc.width = (frame.view().width + divisor - 1) / divisor;
  desc.height = (frame.view().height + divisor - 1) / divisor;
  return frame.graph().create_image(std::move(desc));
}

}  // namespace gloam

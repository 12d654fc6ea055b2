// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lighting/kept_light.h"

#include <algorithm>
#include <string>
#include <vector>

#include "engine/core/hash.h"
#include "engine/render/camera/view_constants.h"
#include "engine/render/declare/compute_pass.h"
#include "engine/render/worlds/world_id.h"
#include "engine/scene/resources.h"
#include "modules/lighting/outputs.h"
#include "shaders/lighting/lit_tiles_shared.h"
#include "shaders/lighting/shaders.h"

namespace gloam {
namespace {

constexpr std::uint64_t kFramesKnown = 120;
// Frames without comparisons, after one that has shown that they cost more than they save.
constexpr std::uint32_t kPause = 30;
constexpr std::uint32_t kWorth = 40;  // percent of the tiles that must be spared

/// Hash of what deferred lighting reads besides images and lists.
std::uint64_t inputs_hash(const FrameBuilder& frame, const ShadowsOutputs& shadows,
                          const gpu::SpecConstants& constants) {
  shaders::ViewConstants view = view_constants(frame.view());
  view.visualizer = 0;
  const auto& sky = frame.world().resource<SceneEnvironment>();
  Hasher hasher;
  hasher.bytes_of(view).bytes_of(sky.sky_zenith).bytes_of(sky.sky_horizon).bytes_of(sky.sky_ground);
  hasher.value(frame.world().try_resource<SurroundingsLeftOut>() != nullptr);
  for (const gpu::SpecConstant& constant : constants)
    hasher.text(constant.name).value(constant.value.type).value(constant.value.bits);
  if (const auto* light = frame.find<IndirectLight>())
    for (const shaders::DiffuseProbe& probe : light->probes) hasher.bytes_of(probe);
  if (shadows.cookie_lights > 0) {
    hasher.value(shadows.cookies_version);
    for (const std::uint32_t light : shadows.block_values.cookie_lights) hasher.value(light);
  }
  hasher.value(frame.services().pipelines.replacements());
  return hasher.digest();
}

/// Of each local light, a hash of where its cookie is and how it falls.
std::vector<std::uint32_t> cookie_keys(const ShadowsOutputs& shadows) {
  std::vector<std::uint32_t> keys(1, 0);
  if (shadows.cookie_lights == 0 || shadows.row_values == nullptr) return keys;
  keys.clear();
  for (const shaders::ShadowRow& row : *shadows.row_values) {
    const std::uint64_t hash = row.cookie_layer >= 0.0f ? Hasher().bytes_of(row).digest() : 0;
    keys.push_back(static_cast<std::uint32_t>(hash ^ hash >> 32));
  }
  return keys;
}

ComputeProgram lit_tiles_program(const ShadingInputs& inputs, const ShadowsOutputs& shadows) {
  ComputeProgram program{shaders::lighting::lit_tiles_comp, shadows.final_lists->constants.where_present()};
  program.constants.set("kSpecularAmbient", inputs.surroundings_follow ? 2u : 1u);
  return program;
}

/// Whether light may be kept at all: everything that it depends on is in keys of tiles or in inputs_hash().
bool is_keepable(const FrameBuilder& frame, const ShadingInputs& inputs) {
  const RenderView& view = frame.view();
  constexpr std::uint32_t kMostTiles = 2048;  // per side, by the words of runs
  return std::max(view.width, view.height) <= kMostTiles * GLOAM_SHADOW_TILE && view.purpose == ViewPurpose::main &&
         !view.jittered && !inputs.diffuse_light_wanted && !inputs.occlusion && !inputs.traced_indirect;
}

}  // namespace

bool LightReuse::may_keep(std::uint64_t world, ViewId view, std::uint64_t inputs, std::uint64_t frame) {
  std::erase_if(views_, [&](const auto& entry) { return entry.second.last_use + kFramesKnown < frame; });
  View& known = views_[{world, view.value}];
  known.last_use = frame;
  if (std::exchange(known.inputs, inputs) != inputs) return false;
  if (known.pause == 0) return true;
  --known.pause;
  return false;
}

void LightReuse::note_result(std::uint64_t world, ViewId view, const shaders::LitTileCommands& result) {
  const auto found = views_.find({world, view.value});
  const std::uint64_t tiles = result.counts.x, changed = result.counts.y, runs = result.counts.z;
  // The first frame that compares finds all changed.
  if (found == views_.end() || changed == tiles) return;
  if ((changed + 2 * runs) * 100 > tiles * (100 - kWorth)) found->second.pause = kPause;
}

void LightReuse::release_view(ViewId view) {
  std::erase_if(views_, [&](const auto& entry) { return entry.first.second == view.value; });
}

std::optional<KeptLight> plan_kept_light(FrameBuilder& frame, const ShadingInputs& inputs,
                                         const ShadowsOutputs& shadows, const gpu::SpecConstants& constants,
                                         const PipelineList& pipelines, LightReuse& reuse) {
  if (!is_keepable(frame, inputs)) return std::nullopt;
  const RenderView& view = frame.view();
  const FrameServices& services = frame.services();
  KeptLight kept{.inputs = inputs_hash(frame, shadows, constants)};
  if (!reuse.may_keep(world_id(frame.world()), view.id, kept.inputs, services.device.frame_number()))
    return std::nullopt;
  if (!services.wait_for_pipelines && !services.pipelines.request(pipelines, services.log)) return std::nullopt;
  gpu::ImageDesc image;
  image.name = "kept_light";
  image.module = "lighting";
  image.format = gpu::Format::rgba16_float;
  image.width = view.width;
  image.height = view.height;
  image.usage = gpu::ImageUsage::color_target | gpu::ImageUsage::transfer_source;
  const auto light = frame.history_image(image, {.final_access = gpu::Access::transfer_read});
  if (!frame.check(light)) return std::nullopt;
  kept.light = light->image;
  kept.filled = light->filled();
  return kept;
}

void add_lit_tiles_pass(FrameBuilder& frame, const ShadingInputs& inputs, const ShadowsOutputs& shadows,
                        KeptLight& kept) {
  const FinalLists& lists = *shadows.final_lists;
  const gpu::ImageDesc& grid = frame.graph().desc(lists.tiles);
  const std::uint64_t tiles = std::uint64_t{grid.width} * grid.height;
  gpu::BufferDesc keys;
  keys.name = "lit_keys";
  keys.module = "lighting";
  keys.size = tiles * sizeof(uvec4);
  keys.usage = gpu::BufferUsage::storage;
  const auto last = frame.history_buffer(keys, {});
  if (!frame.check(last)) return;
  const auto create = [&](const char* name, std::uint64_t size) {
    gpu::BufferDesc desc;
    desc.name = name;
    desc.module = "lighting";
    desc.size = size;
    return frame.graph().create_buffer(desc);
  };
  const RenderView& view = frame.view();
  shaders::LitTileConstants constants{
      .inputs = {static_cast<std::uint32_t>(kept.inputs), static_cast<std::uint32_t>(kept.inputs >> 32)},
      .size = {view.width, view.height},
      .kept = kept.filled && last->filled() ? 1u : 0u,
      .step = GLOAM_LIT_TILES_START};
  ComputePass pass(frame, "lit_tiles", lit_tiles_program(inputs, shadows));
  read_geometry(pass, frame.get<GeometryOutputs>());
  read_light_lists(pass, inputs.outputs);
  read_final_lists(pass, lists);
  const auto* surroundings = frame.find<SurroundingsOutput>();
  pass.read("far_image", surroundings != nullptr ? surroundings->light : ImageRef{});
  pass.items<std::uint32_t>("cookie_keys", cookie_keys(shadows));
  static_cast<void>(pass.write("lit_keys", last->buffer));
  kept.tiles = pass.write("changed_tiles", create("lit_tiles_changed", 2 * tiles * sizeof(std::uint32_t)));
  kept.commands = pass.write("commands", create("lit_tile_commands", sizeof(shaders::LitTileCommands)));
  pass.push(constants);
  pass.dispatch(1);
  pass.barrier();
  constants.step = GLOAM_LIT_TILES_COMPARE;
  pass.push(constants);
  pass.dispatch_over(grid.width, grid.height);
  pass.barrier();
  constants.step = GLOAM_LIT_TILES_JOIN;
  pass.push(constants);
  pass.dispatch_over(grid.width, grid.height);
  pass.barrier();
  constants.step = GLOAM_LIT_TILES_CHOOSE;
  pass.push(constants);
  pass.dispatch(1);
  frame.keep_result("lighting", std::string(kLitTilesResult), kept.commands);
}

ImageRef add_kept_light_copy(FrameBuilder& frame, const KeptLight& kept, ImageRef to) {
  PassBuilder pass = frame.graph().add_pass("copy_kept_light", "lighting");
  pass.read(kept.light, gpu::Access::transfer_read);
  const ImageRef written = pass.write(to, gpu::Access::transfer_write);
  pass.execute([from = kept.light, written](PassContext& context) {
    context.commands().blit(context.image(from), context.image(written));
  });
  return written;
}

void list_kept_light_pipelines(const ShadingInputs& inputs, const ShadowsOutputs& shadows, PipelineList& list) {
  list.push_back(pipeline_desc(lit_tiles_program(inputs, shadows), "lighting"));
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <chrono>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/text/formatted.h"
#include "engine/math/packing.h"
#include "engine/scene/resources.h"
#include "modules/reflections/bake.h"
#include "sandbox/commands/commands.h"
#include "sandbox/commands/fit_proxies.h"
#include "sandbox/output/file_io.h"
#include "sandbox/output/pictures/image_io.h"
#include "sandbox/session/baking/captures.h"
#include "sandbox/session/loading/scene_loading.h"
#include "sandbox/session/session.h"

namespace gloam {
namespace {

/// "NAME", or "proxy-3" for an entity without a name.
std::string picture_name(const World& world, Entity entity, const char* kind, std::size_t index) {
  std::string name(world.resource<SceneNames>().name_of(entity));
  for (char& c : name)
    if (c == '/') c = '_';
  return name.empty() ? std::string(kind) + "-" + std::to_string(index) : name;
}

/// Writes the mips of each layer beside each other, as linear light in cd/m². light_scale: of the captures.
Status write_layers(const CapturedLayers& layers, float light_scale, const std::vector<Entity>& entities,
                    const World& world, const char* kind, const std::string& folder) {
  for (std::size_t layer = 0; layer < layers.count; ++layer) {
    const std::uint32_t width = 2 * layers.side;
    std::vector<float> rgba(std::size_t{4} * width * layers.side, 0.0f);
    std::uint32_t left = 0;
    for (std::uint32_t mip = 0; mip < layers.mips; ++mip) {
      const std::uint32_t side = layers.side >> mip;
      const std::uint16_t* from = &layers.texels[layer * layers.layer_halves() + layers.mip_offset(mip)];
      for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t i = 0; i < 4 * side; ++i)
          rgba[std::size_t{4} * (std::size_t{y} * width + left) + i] =
              half_to_float(*from++) / (i % 4 == 3 ? 1.0f : light_scale);
      left += side;
    }
    const std::string path = folder + "/" + picture_name(world, entities[layer], kind, layer) + ".exr";
    GLOAM_TRY(make_folder_of(path));
    GLOAM_TRY(write_exr(path, width, layers.side, rgba));
  }
  return {};
}

std::string count_of(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string summary_of(const ReflectionCaptures& captures, double seconds) {
  const auto kind = [](std::size_t count, std::uint32_t texels, const char* one, const char* many) {
    const std::string side = std::to_string(texels);
    return count_of(count, one, many) + (count == 0 ? "" : " of " + side + "x" + side + " texels");
  };
  return kind(captures.proxy_entities.size(), captures.proxies.side, "proxy", "proxies") + ", " +
         kind(captures.probe_entities.size(), captures.probes.side, "probe", "probes") +
         (captures.grid.empty() ? "" : ", " + count_of(captures.grid.size(), "probe", "probes") + " of a grid") +
         formatted(" captured in %.1f s\n", seconds);
}

/// Without --probes, the new captures take the grid over from the file that they replace. The log names a file of other
/// content: its grid is out of date, and goes.
void keep_grid(const std::string& path, const Options& options, const World& world, ReflectionCaptures& captures,
               LogSink& log) {
  if (path.empty() || options.grid_probes > 0) return;
  if (auto before = load_captures(path, world, captures.content, log)) captures.grid = std::move(before->grid);
}

Status check_bake_options(const Options& options) {
  if (options.beside && captures_beside(options.scene).empty())
    return Error{ErrorKind::usage, "--beside needs a scene file, and " + options.scene + " has none"};
  return {};
}

}  // namespace

Status run_bake(const CommandContext& context) {
  const Options& options = context.options;
  GLOAM_TRY(check_scene_exists(options.scene));
  if (options.fit_proxies > 0) return run_fit_proxies(context);
  GLOAM_TRY(check_bake_options(options));
  const auto session = open_session(options, context.log);
  if (!session) return session.error();
  const World& world = session.value()->world;
  const auto begin = std::chrono::steady_clock::now();
  auto captures = bake_scene(*session.value(), options, context.log,
                             show_bake_progress(context.console, options.quiet, "reflection captures"));
  if (!captures) return captures.error();
  GLOAM_TRY(session.value()->check_validation());
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const std::string path =
      options.beside ? captures_beside(options.scene) : cached_captures(*session.value(), options, captures->content);
  keep_grid(path, options, world, *captures, context.log);
  if (!options.out.empty()) {
    GLOAM_TRY(
        write_layers(captures->proxies, captures->light_scale, captures->proxy_entities, world, "proxy", options.out));
    GLOAM_TRY(
        write_layers(captures->probes, captures->light_scale, captures->probe_entities, world, "probe", options.out));
  }
  if (captures->proxies.count + captures->probes.count + captures->grid.size() == 0) {
    if (!options.quiet) context.console.print("the scene has no proxy and no probe: there is nothing to capture\n");
    return {};
  }
  if (!path.empty()) GLOAM_TRY(save_captures(path, world, *captures));
  if (options.quiet) return {};
  context.console.print(summary_of(*captures, seconds));
  context.console.print(path.empty() ? "kept in no file: there is no cache folder\n" : "wrote " + path + "\n");
  return {};
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/commands/fit_proxies.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "engine/core/text/formatted.h"
#include "engine/scene/assets.h"
#include "engine/scene/units.h"
#include "modules/accuracy/module.h"
#include "modules/reflections/module.h"
#include "sandbox/output/file_io.h"
#include "sandbox/output/json_text.h"
#include "sandbox/session/loading/loaded_scene.h"
#include "sandbox/session/surface_distances.h"

namespace gloam {
namespace {

std::string percent(std::uint64_t part, std::uint64_t all) {
  if (all == 0) return "-";
  return formatted("%.1f %%", 100.0 * static_cast<double>(part) / static_cast<double>(all));
}

std::string row(const CaughtShares& shares) {
  return formatted("%-24s %10s %10s %10s %10s\n", shares.viewers.c_str(), std::to_string(shares.rays).c_str(),
                   percent(shares.in_rooms, shares.rays).c_str(), percent(shares.by_proposed, shares.rays).c_str(),
                   percent(shares.by_existing, shares.rays).c_str());
}

/// Shares of reflected rays to surfaces, by viewer. "in rooms": the surface is in a room of the eye, so that a proxy
/// could catch the ray.
std::string report(const ProxyProposal& proposal) {
  std::string text = std::to_string(proposal.proxies.size()) + " proxies fitted, chosen from " +
                     std::to_string(proposal.candidates) + " quads; the scene has " +
                     std::to_string(proposal.existing) + "\n";
  CaughtShares all = {.viewers = "all"};
  text += formatted("%-24s %10s %10s %10s %10s\n", "rays caught, seen by", "rays", "in rooms", "fitted", "existing");
  for (const CaughtShares& shares : proposal.shares) {
    text += row(shares);
    all.rays += shares.rays;
    all.in_rooms += shares.in_rooms;
    all.by_proposed += shares.by_proposed;
    all.by_existing += shares.by_existing;
  }
  if (all.rays == 0) return text + "no ray: nothing reflective faces up and is seen; the largest quads were taken\n";
  return text + row(all);
}

/// Numbers rounded for reading: about tenths of a millimetre, and 1e-6 for rotations.
double rounded(double value, double steps) {
  const double result = std::round(value * steps) / steps;
  return result == 0.0 ? 0.0 : result;
}

Json proposal_json(const ProxyProposal& proposal, double metres_per_unit) {
  Json nodes = Json::array();
  const double steps = std::pow(10.0, std::round(std::log10(1e4 * metres_per_unit)));
  const auto length = [steps](double value) { return rounded(value, steps); };
  const auto share = [](double value) { return rounded(value, 1e6); };
  for (const ProposedProxy& proxy : proposal.proxies) {
    const dvec3& at = proxy.translation;
    const dquat& q = proxy.rotation;
    Json extras;
    extras["gloam.ibr_proxy.size"] = {length(static_cast<double>(proxy.size_m.x)),
                                      length(static_cast<double>(proxy.size_m.y))};
    extras["gloam.ibr_proxy.kind"] = "scene";
    Json node;
    node["name"] = "proxy-" + std::to_string(nodes.size());
    node["translation"] = {length(at.x), length(at.y), length(at.z)};
    node["rotation"] = {share(q.x), share(q.y), share(q.z), share(q.w)};
    node["extras"] = std::move(extras);
    nodes.push_back(std::move(node));
  }
  Json json;
  json["nodes"] = std::move(nodes);
  return json;
}

}  // namespace

Status run_fit_proxies(const CommandContext& context) {
  const Options& options = context.options;
  const auto scene =
      load_and_pose_scene({.scene = options.scene, .animation = options.animation}, options.threads, context.log);
  if (!scene) return scene.error();
  const auto& [modules, executor, world, info] = **scene;
  const auto tracer = make_scene_tracer(world, *executor);
  if (!tracer) return tracer.error();
  const ProxyProposal proposal =
      propose_proxies(world, {.count = options.fit_proxies, .cameras = info.cameras},
                      surface_distances(**tracer, world.resource<SceneAssets>(), *executor), *executor);
  const std::string path = options.out.empty() ? "out/" + scene_stem(options.scene) + ".proxies.json" : options.out;
  GLOAM_TRY(make_folder_of(path));
  GLOAM_TRY(write_file(path, json_text(proposal_json(proposal, metres_per_unit(world)))));
  context.console.print(report(proposal));
  if (!options.quiet) context.console.print("wrote " + path + "\n");
  return {};
}

}  // namespace gloam

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/loading/ledger_header.h"

#include <string>

#include "engine/core/system/process.h"
#include "engine/core/text/formatted.h"
#include "modules/accuracy/module.h"
#include "sandbox/output/identity.h"

namespace gloam {
namespace {

/// What SessionCosts measures.
std::string clock_of(gpu::DeviceType type) {
  if (type != gpu::DeviceType::cpu) return "CPU time plus GPU time of a frame, on the wall";
  const std::uint32_t cores = usable_cores();
  return cores == 1 ? "processor time of a frame" : formatted("processor time of a frame, divided by %u cores", cores);
}

}  // namespace

LedgerHeader ledger_header(const Session& session, const Options& options) {
  const gpu::DeviceInfo& device = session.device->info();
  return {.scene = options.scene,
          .scene_hash = scene_hash(options.scene, session.world),
          .camera = options.camera,
          .time_s = options.time_s,
          .device = device.name,
          .driver = device.driver,
          .device_type = std::string(gpu::name_of(device.type)),
          .subgroup_size = device.subgroup_size,
          .width = options.width,
          .height = options.height,
          .clock = clock_of(device.type),
          .version = GLOAM_VERSION,
          .build = program_hash(),
          .host = host_name(),
          .quick = options.quick,
          .frames = options.quick ? kQuickFrames : kLedgerFrames,
          .seconds = options.minutes ? *options.minutes * 60.0
                     : options.quick ? kQuickSeconds
                                     : 0.0,
          .samples = options.quick ? kQuickSamples : kLedgerSamples};
}

}  // namespace gloam

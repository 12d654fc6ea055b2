// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/cost/frame_identity.h"

#include <algorithm>
#include <span>

#include "engine/core/hash.h"
#include "engine/core/text/formatted.h"

namespace gloam {
namespace {

/// Version of metrics and protocol: rows stored under another version are measured again.
constexpr int kMethod = 10;

std::string exact_text(double value) { return formatted("%.17g", value); }

}  // namespace

std::string joined_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string hash_of(const FramePictures& frame) {
  Hasher hasher;
  hasher.value(frame.picture.width).value(frame.picture.height).bytes(std::as_bytes(std::span(frame.picture.rgba)));
  hasher.bytes(std::as_bytes(std::span(frame.linear.rgba)));
  return std::to_string(hasher.digest());
}

std::string conditions_identity(const CostRequest& request) {
  const LedgerHeader& header = request.header;
  return joined_line("method " + std::to_string(kMethod) + " scene " + header.scene_hash + " size " +
                     std::to_string(header.width) + "x" + std::to_string(header.height) + " camera '" + header.camera +
                     "' time " + exact_text(header.time_s) + " device '" + header.device + "' '" + header.driver +
                     "' gloam " + header.version + " " + header.build + " samples " + std::to_string(header.samples) +
                     " " + request.conditions);
}

std::string knobs_identity(const KnobRegistry& knobs, std::string_view left_out) {
  std::string text;
  for (const Knob& knob : knobs.knobs())
    if (knob.name != left_out) text += " " + knob.name + "=" + knobs.text(knob);
  return joined_line(text);
}

std::string protocol_identity(const CostRequest& request) {
  return joined_line(" host '" + request.header.host + "'") + " frames " + std::to_string(request.header.frames) +
         (request.header.seconds > 0.0 ? " in limited time" : "") + " sequence " + std::to_string(request.sequence);
}

}  // namespace gloam

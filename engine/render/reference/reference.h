// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/render/knobs/knobs.h"
#include "engine/render/readback/geometry_picture.h"
#include "engine/render/readback/picture.h"
#include "engine/render/reference/scene_tracer.h"
#include "engine/render/view.h"

namespace gloam {

/// What a frame looked like, or should have looked like. Either side may be absent (width 0): then it is not compared.
struct FramePictures {
  LinearPicture linear;
  Picture picture;
};

/// Where references keep what took long, for other knobs and other runs, by what it was computed from: `identity`, one
/// line.
class ReferenceStore {
 public:
  virtual ~ReferenceStore() = default;
  /// Nothing, when it is absent, damaged or of something else.
  [[nodiscard]] virtual std::optional<std::string> load(const std::string& identity) const = 0;
  [[nodiscard]] virtual Status save(const std::string& identity, std::string_view bytes) const = 0;
};

/// What a reference is computed from: one frame that has been drawn and read back.
struct ReferenceInput {
  const World& world;          ///< as the frame's systems left it
  const RenderView& view;      ///< size, camera and pose of the frame
  const KnobRegistry& knobs;   ///< as the frame was drawn
  const FramePictures& frame;  ///< what was drawn; both sides are there
  std::uint32_t samples = 0;   ///< a pixel (and light), for references that sample; at least 1
  JobExecutor& executor;
  /// What references of light and shadow need beside: triangles to trace, where the frame's pixels lie, and the means
  /// to draw the frame once more with what was found put into the world (which is `world`) first. Null where nobody
  /// offers them.
  const SceneTracer* tracer = nullptr;
  const GeometryPicture* geometry = nullptr;
  std::function<Result<FramePictures>(const std::function<void(World&)>& change,
                                      const std::function<void(World&)>& restore)>
      redraw;
  const ReferenceStore* store = nullptr;  ///< null: nothing is kept
  /// Told how much of the work is done, by one thread at a time; may be empty.
  std::function<void(std::size_t done, std::size_t total)> progress;
};

/// What "right" means for a knob where that is more than the same frame with the knob at Knob::exact: a picture that
/// the module computes on the CPU. Deterministic: the same input gives the same picture, whatever the executor.
///
/// Two sorts. A model of its own (`follows_value` false: traced visibility, accumulated lenses) does not care how the
/// knob is set: it is computed once a knob, from a frame with the knob at its default, and every value is held against
/// it. A twin in higher precision
/// (`follows_value` true: the tone curve in double precision) states what the drawn value should have given from its
/// own inputs: it is computed for every value, from the frame drawn with that value.
///
/// A twin that turns the frame's linear light into the picture fills FramePictures::picture alone; a traced one fills
/// `linear`, and `picture` too when it can.
struct ReferenceInfo {
  std::string knob;            ///< a knob of the same module
  std::string kind;            ///< "traced" or "double precision"
  std::string name;            ///< of the reference, for the ledger: "tone curve on the CPU"
  bool follows_value = false;  ///< see above
  bool samples = false;        ///< ReferenceInput::samples matters; its noise is the change from half of them to all
  std::function<Result<FramePictures>(const ReferenceInput&)> draw;
};

}  // namespace gloam

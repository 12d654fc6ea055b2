// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/ecs/entity.h"
#include "engine/math/types.h"
#include "engine/math/view_projection.h"
#include "engine/render/knobs/knobs.h"
#include "engine/scene/components.h"

namespace gloam {

class World;

/// The purpose of a view. Modules decide by it whether they take part (Module::demand): a capture, for example, has no
/// fog.
enum class ViewPurpose : std::uint8_t {
  main,       ///< a picture for users
  capture,    ///< light that other views use, for example a reflection probe
  reference,  ///< a picture that others are judged against
};

/// A mirror: the points p with dot(normal, p) = offset. Its visible side is where the dot product is greater.
struct MirrorPlane {
  dvec3 normal = dvec3(0.0, 1.0, 0.0);  ///< unit length
  double offset = 0.0;                  ///< metres
  /// Geometry less than this above the plane is not drawn, metres, ≥ 0. Keeps the mirroring surface itself out of the
  /// picture if it is double-sided or not quite flat.
  double margin_m = 0.0;
};

/// World resource: views of this camera are drawn from a point of its lens in place of the lens's centre, while the
/// plane of focus keeps its place in the picture. For references of depth of field.
struct LensPoint {
  Entity camera = kNoEntity;
  glm::dvec2 offset_m = glm::dvec2(0.0);  ///< from the centre of the lens, to the right and up
  double focus_m = 1.0;                   ///< view depth of the plane of focus, > 0; may be infinite
};

/// A caller's settings for a view.
struct ViewSettings {
  ViewId id{0};
  std::uint32_t width = 1280;  ///< pixels, > 0
  std::uint32_t height = 720;
  /// Camera of the view, whose components set effects (focus, exposure). kNoEntity: a camera without an entity.
  Entity camera_entity = kNoEntity;
  /// True: pose and lens are taken from camera_entity after the frame's world systems, if it is alive. Otherwise the
  /// two members below are used.
  bool follow_camera = true;
  dmat4 world_from_camera = dmat4(1.0);  ///< rigid; the camera looks along −Z
  Camera camera;
  std::string visualizer = "none";  ///< a name of Renderer::visualizers(); an unknown one is a usage error
  float heat_range = 1.0f;          ///< factor on the ends of visualizers' heat scales (HeatScale), > 0
  ViewPurpose purpose = ViewPurpose::main;
  std::vector<KnobOverride> knobs;   ///< replace the renderer's values in this view; an unknown one is a usage error
  std::vector<std::string> without;  ///< names of modules that this view leaves out
  /// Draws what the mirror shows of its visible side to the camera. The camera may be on either side.
  std::optional<MirrorPlane> mirror;
  /// Leaves out what moves: instances that are skinned, morphed or moved by an animation. Their shadows are left out if
  /// all views of the frame have this set.
  bool static_only = false;
  /// An orthographic view is camera.half_width_m wide, so its pixels need not be square. Otherwise its width follows
  /// from camera.half_height_m and the size in pixels.
  bool exact_width = false;
  /// Width over height of what the camera sees, > 0; 0: of the size in pixels. Pixels are square only with 0.
  float aspect = 0.0f;
  /// Draws from this point of the lens (LensPoint). The projection is sheared, so its centre is off the picture's.
  std::optional<LensPoint> lens;
  /// The camera jumps in this frame: contents that follow it over frames begin anew. The renderer itself sees a change
  /// of camera_entity and of the kind of projection; a jump of the pose is stated here.
  bool camera_cut = false;
};

/// Views that another view of the frame needs (Module::companion_views). They are drawn just before it, and leave their
/// light in CompanionLight.
class CompanionViews {
 public:
  /// Most companions of a view.
  static constexpr std::uint32_t kMost = 4;
  /// Ids of views that may have companions are below this number.
  static constexpr std::uint32_t kMostMainIds = 1u << 26;
  /// Companions have the ids [kFirstId, kFirstId + kMost · kMostMainIds); no other view may have such an id.
  static constexpr std::uint32_t kFirstId = 0x40000000u;

  explicit CompanionViews(ViewId main);
  /// Adds a companion with these settings; `id` and `follow_camera` are set here. Returns its id, the same in every
  /// frame for the n-th companion of a view. Asserts that there are not too many.
  ViewId add(ViewSettings settings);
  [[nodiscard]] const std::vector<ViewSettings>& all() const { return all_; }
  /// The ids of all companions that a view may have; none if it cannot have any.
  [[nodiscard]] static std::vector<ViewId> ids_of(ViewId main);

 private:
  ViewId main_;
  std::vector<ViewSettings> all_;
};

/// Pose and lens of a view in one frame.
struct ViewCamera {
  dvec3 position = dvec3(0.0);          ///< world
  mat4 view_from_relative = mat4(1.0);  ///< rotation only
  mat4 clip_from_view = mat4(1.0);      ///< reversed Z
  mat4 clip_from_relative = mat4(1.0);
  bool orthographic = false;
};

/// One view of one frame, for systems and passes. A view resource. Positions on the GPU are relative to `position`.
struct RenderView : ViewProjection {
  ViewId id{0};
  /// Number among the drawn frames of its world, from 0. A frame that is given up or drawn again gives its number on.
  std::uint64_t frame = 0;
  std::uint64_t cut_frame = 0;       ///< the view's newest frame with a camera cut, ≤ frame; its first is one
  Entity camera_entity = kNoEntity;  ///< camera whose effects the view has, or kNoEntity
  Camera camera;
  ViewPurpose purpose = ViewPurpose::main;
  bool mirrored = false;  ///< front faces of unmirrored meshes are clockwise; `position` is the mirrored camera's
  bool clipped = false;   ///< only what is on the visible side of clip_plane is drawn
  vec4 clip_plane = vec4(0.0f);  ///< dot(xyz, p) + w ≥ 0 is visible; p: camera-relative
  bool static_only = false;      ///< of ViewSettings
  /// Factor from cd/m² and lux to the light in the view's images (light_scale()); 1 if the light goes to an image of
  /// the caller. Whatever brings light into a view multiplies it: lights, sky, emission, fog, captures.
  float light_scale = 1.0f;
  /// The view that this one is a companion of; its own id if it is none.
  ViewId main_view{0};
  bool has_companions = false;
  /// A time budget chooses the view's knobs: modules spread work that a change of knobs makes over several frames, so
  /// that no frame is much longer than the others (Module::spreads_work).
  bool paced = false;
  /// The projection is moved by a part of a pixel, by another one in each frame, because some module accumulates the
  /// view's pictures (Module::wants_jitter). The first frame after a camera cut is not moved.
  /// `frustum` then holds what any such projection shows, so culling is the same in all frames at rest.
  bool jittered = false;
  /// The point of the picture that the centre of each pixel shows, from that centre; pixels, to the right and down.
  vec2 jitter = vec2(0.0f);
  ViewCamera unmoved;  ///< of jittered views: the camera without jitter
  /// Added to the mip that textures of surfaces are sampled from, ≤ 0: 0 if the picture has the view's size; log2 of
  /// the view's share of its size if accumulation enlarges it, so that textures are as sharp as its pixels.
  float mip_bias = 0.0f;
  /// Greatest error of the levels of detail that the view draws (scene.lod_pixels), in its pixels; 0: it draws none.
  float lod_pixels = 0.0f;
  /// The view's camera in the world's previous drawn frame, with the jitter of this frame, so that motion is without
  /// jitter. If there is none (has_previous), the current camera. There is none after a camera cut, and if the world's
  /// previous frame did not draw the view.
  ViewCamera previous;
  bool has_previous = false;

  [[nodiscard]] ViewCamera view_camera() const {
    return {position, view_from_relative, clip_from_view, clip_from_relative, camera.orthographic};
  }
  /// The camera without jitter: for what is kept until the camera moves.
  [[nodiscard]] ViewCamera steady_camera() const { return jittered ? unmoved : view_camera(); }
  [[nodiscard]] bool is_companion() const { return main_view != id; }
  /// Whether the camera was cut between the view's last frame and this one.
  [[nodiscard]] bool camera_cut() const { return cut_frame == frame; }
  /// View depth in metres of a value of the depth image (reversed Z); not for the sky's 0.
  [[nodiscard]] float view_depth(float depth) const {
    const mat4& m = clip_from_view;
    return (m[3][2] - depth * m[3][3]) / (m[2][2] - depth * m[2][3]);
  }
};

/// Asserts that a view can be drawn with these settings: its size, matrix, lens and mirror. Names the view.
void check_settings(const ViewSettings& settings);

/// Why no camera can be taken from the entity, in one sentence that names it; empty if one can.
[[nodiscard]] std::string camera_fault(const World& world, Entity camera);

/// If settings.follow_camera is set and settings.camera_entity is alive, sets pose and lens from its current state, and
/// settings.lens from the world's LensPoint. A camera whose world matrix is singular has its last rigid pose
/// (CameraPoses); without one the pose of the settings stays.
void follow_camera(const World& world, ViewSettings& settings);

/// Input error that names the camera, if the view follows a camera that never had a rigid pose (rigid_pose).
[[nodiscard]] Status check_camera_pose(const World& world, const ViewSettings& settings);

/// cut_frame: see RenderView.
[[nodiscard]] RenderView make_view(const ViewSettings& settings, std::uint64_t frame, std::uint64_t cut_frame = 0);

/// Settings for the view of a camera entity, from its Camera and WorldTransform, which it must have. kNoEntity:
/// framed_view(). width, height: pixels.
[[nodiscard]] ViewSettings settings_for_camera(const World& world, Entity camera, std::uint32_t width,
                                               std::uint32_t height);

}  // namespace gloam

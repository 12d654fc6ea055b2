// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT

/* gloam for C, and for every language that calls C.
 *
 * Handles are opaque; one whose object was destroyed, or of another kind of object, is GLOAM_USAGE. A function that can
 * fail returns a gloam_result; gloam_error_message() then holds one sentence about what failed and where. No exception
 * leaves this interface. Lengths are in metres, angles in radians, light in candela, lux and cd/m². Matrices are
 * column-major, as in Vulkan; the camera and lights look along their -Z.
 *
 * Structures begin with `size`. Fill them with their GLOAM_..._INIT and set what you need: a program that was compiled
 * against an older header then works with a newer library, which takes the defaults for members that the program does
 * not know. A structure larger than the library's own, or whose size is no multiple of 8, is GLOAM_USAGE.
 *
 * An engine and its worlds are used by one thread at a time.
 */
#ifndef GLOAM_H
#define GLOAM_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Version of this interface: members and functions are added, never changed, while it stays the same. */
#define GLOAM_C_INTERFACE 1

typedef enum gloam_result {
  GLOAM_OK = 0,
  GLOAM_FAILED = 1,    /* failed while running: device lost, out of memory, disk full */
  GLOAM_USAGE = 2,     /* a wrong argument, name, value or handle */
  GLOAM_INPUT = 3,     /* a scene or an asset is bad or absent */
  GLOAM_NO_DEVICE = 4, /* no usable Vulkan device */
  GLOAM_RESULT_ENUM_MAX = 0x7fffffff
} gloam_result;

typedef struct gloam_engine gloam_engine; /* a device, threads and a renderer */
typedef struct gloam_world gloam_world;   /* what is drawn */
typedef uint64_t gloam_entity;            /* a thing in a world; 0 is none */

/* Sentence about the last call of this thread that did not return GLOAM_OK. Valid until the thread's next call. */
const char* gloam_error_message(void);
/* GLOAM_C_INTERFACE of the library, and its version, for example "0.2.0". */
uint32_t gloam_interface_version(void);
const char* gloam_version(void);

/* ---- Engine ---- */

typedef enum gloam_log_level {
  GLOAM_LOG_DEBUG = 0,
  GLOAM_LOG_INFO = 1,
  GLOAM_LOG_WARNING = 2,
  GLOAM_LOG_ERROR = 3,
  GLOAM_LOG_LEVEL_ENUM_MAX = 0x7fffffff
} gloam_log_level;

/* A Vulkan device of the host; all handles as Vulkan has them. They must outlive the engine. The features and
 * extensions that gloam needs are in docs/embedding.md. */
typedef struct gloam_vulkan_device {
  size_t size;
  void* instance;                /* VkInstance */
  void* physical_device;         /* VkPhysicalDevice */
  void* device;                  /* VkDevice */
  void* queue;                   /* VkQueue: receives all of gloam's work */
  uint32_t queue_family;         /* of the queue; must support graphics and compute */
  uint32_t api_version;          /* of the instance, at least VK_API_VERSION_1_3 */
  void* get_instance_proc_addr;  /* PFN_vkGetInstanceProcAddr */
  const char* const* extensions; /* that the host passed to vkCreateDevice */
  uint32_t extension_count;
  const void* features; /* const VkPhysicalDeviceFeatures2*: as passed to vkCreateDevice */
} gloam_vulkan_device;
#define GLOAM_VULKAN_DEVICE_INIT \
  { sizeof(gloam_vulkan_device), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 }

typedef struct gloam_engine_info {
  size_t size;
  const char* device;          /* "auto", "cpu", "gpu", or part of a device's name; null: "auto" */
  const char* cache_directory; /* for compiled pipelines; null: none */
  uint32_t threads;            /* of the job system; 0: one per core */
  int32_t validate;            /* not 0: Vulkan validation with synchronisation checks */
  void (*log)(void* user, gloam_log_level level, const char* line); /* from any thread; null: nothing is logged */
  void* log_user;
  const gloam_vulkan_device* vulkan; /* null: the engine creates its own device */
} gloam_engine_info;
#define GLOAM_ENGINE_INFO_INIT \
  { sizeof(gloam_engine_info), 0, 0, 0, 0, 0, 0, 0 }

/* info may be null: all defaults. */
gloam_result gloam_engine_create(const gloam_engine_info* info, gloam_engine** engine);
/* Waits for the GPU. The engine's worlds must have been destroyed. Null is allowed. */
gloam_result gloam_engine_destroy(gloam_engine* engine);
/* Name of the Vulkan device. Valid as long as the engine. */
const char* gloam_engine_device_name(const gloam_engine* engine);
/* Sets a knob (docs/knobs.md), for example "shadows.filter" to "pcss". */
gloam_result gloam_engine_set_knob(gloam_engine* engine, const char* knob, const char* value);
/* Validation messages so far; 0 without `validate`. */
uint64_t gloam_engine_validation_messages(const gloam_engine* engine);
/* Call it before you destroy a VkImage that views have named (gloam_view, gloam_host_geometry), after the frames that
 * use it have finished on the GPU (gloam_engine_wait()): another image may get the same handle. Unknown images are
 * allowed. */
gloam_result gloam_engine_forget_image(gloam_engine* engine, uint64_t image);
/* Waits until the GPU has finished everything submitted. */
gloam_result gloam_engine_wait(gloam_engine* engine);
/* Frees memory of the GPU that the last frame did not use. */
gloam_result gloam_engine_free_idle_memory(gloam_engine* engine);

/* ---- World ---- */

gloam_result gloam_world_create(gloam_engine* engine, gloam_world** world);
/* Null is allowed. */
gloam_result gloam_world_destroy(gloam_world* world);
/* Adds the content of a .gltf or .glb file to an empty world. After a failure, destroy the world. */
gloam_result gloam_world_load(gloam_world* world, const char* path);
/* Simulated time of the next frame and since the frame before it, in seconds. */
gloam_result gloam_world_set_clock(gloam_world* world, double time_s, double dt_s);
/* Luminance of the sky, cd/m², linear RGB: overhead, at the horizon and below it. */
gloam_result gloam_world_set_sky(gloam_world* world, const float zenith[3], const float horizon[3],
                                 const float ground[3]);
/* Exposure in EV100 of views that meter nothing. */
gloam_result gloam_world_set_exposure(gloam_world* world, float ev100);
/* First entity of this kind ("light", "camera", "mesh", "node") and name. */
gloam_result gloam_world_find(gloam_world* world, const char* kind, const char* name, gloam_entity* entity);

/* Removes an entity of the world. */
gloam_result gloam_entity_destroy(gloam_world* world, gloam_entity entity);
/* Pose in the world: rotation, translation and scale, from the next frame on. A node of a file then follows neither its
 * parent nor an animation. */
gloam_result gloam_entity_set_matrix(gloam_world* world, gloam_entity entity, const double matrix[16]);

/* ---- Materials and meshes ---- */

typedef struct gloam_material {
  size_t size;
  float base_color[4]; /* linear */
  float emissive[3];   /* cd/m² */
  float metallic;
  float roughness;
  int32_t double_sided;
} gloam_material;
#define GLOAM_MATERIAL_INIT \
  { sizeof(gloam_material), {1.0f, 1.0f, 1.0f, 1.0f}, {0.0f, 0.0f, 0.0f}, 0.0f, 1.0f, 0 }

gloam_result gloam_material_create(gloam_world* world, const gloam_material* material, uint32_t* number);

/* Triangles, counter-clockwise seen from outside. The arrays are copied. */
typedef struct gloam_mesh {
  size_t size;
  const float* positions;  /* 3 a vertex */
  const float* normals;    /* 3 a vertex, unit length; null: computed */
  const float* uv;         /* 2 a vertex; may be null */
  const uint32_t* indices; /* 3 a triangle; null: 0, 1, 2, ... */
  uint32_t vertex_count;
  uint32_t index_count;
  uint32_t material; /* of gloam_material_create() */
} gloam_mesh;
#define GLOAM_MESH_INIT \
  { sizeof(gloam_mesh), 0, 0, 0, 0, 0, 0, 0 }

gloam_result gloam_mesh_create(gloam_world* world, const gloam_mesh* mesh, uint32_t* number);
/* Draws a mesh at a pose. */
gloam_result gloam_instance_create(gloam_world* world, uint32_t mesh, const double matrix[16], gloam_entity* entity);

/* ---- Lights ---- */

typedef enum gloam_light_kind {
  GLOAM_LIGHT_POINT = 0,
  GLOAM_LIGHT_SPOT = 1,
  GLOAM_LIGHT_DIRECTIONAL = 2,
  GLOAM_LIGHT_KIND_ENUM_MAX = 0x7fffffff
} gloam_light_kind;

typedef struct gloam_light {
  size_t size;
  gloam_light_kind kind;
  float color[3];       /* linear */
  float intensity;      /* candela; directional: lux */
  float range_m;        /* 0: as far as the light can be seen */
  float inner_angle;    /* spot: half angle of the cone with full intensity */
  float outer_angle;    /* spot: half angle at which intensity reaches 0 */
  float width_m;        /* diameter of the emitter; 0: hard shadows */
  float apparent_angle; /* directional: apparent diameter */
  int32_t casts_shadows;
} gloam_light;
#define GLOAM_LIGHT_INIT \
  { sizeof(gloam_light), GLOAM_LIGHT_POINT, {1.0f, 1.0f, 1.0f}, 1.0f, 0.0f, 0.0f, 0.785398163f, 0.0f, 0.00925025f, 1 }

gloam_result gloam_light_create(gloam_world* world, const gloam_light* light, const double matrix[16],
                                gloam_entity* entity);
/* Replaces the light's values; its pose stays. */
gloam_result gloam_light_set(gloam_world* world, gloam_entity entity, const gloam_light* light);

/* ---- Frames ---- */

/* Images of a host's Vulkan device with the surfaces that it has drawn, for gloam to light: docs/embedding.md and
 * engine/render/host_geometry.h state formats and encodings. All are VkImages of the view's size, in
 * VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL before and after the frame. Formats are numbers of VkFormat. */
typedef struct gloam_host_geometry {
  size_t size;
  uint64_t depth; /* D32_SFLOAT or R32_SFLOAT; reversed: near_m is 1, infinity 0 */
  uint32_t depth_format;
  float near_m;
  uint64_t normals; /* R16G16B16A16_SFLOAT or R8G8B8A8_UNORM: world axes in rgb (UNORM: (xyz + 1) / 2) */
  uint32_t normals_format;
  uint64_t base_color; /* R8G8B8A8_UNORM, linear, or R8G8B8A8_SRGB */
  uint32_t base_color_format;
  uint64_t material; /* R8G8B8A8_UNORM: occlusion, roughness, metallic in r, g, b */
  uint32_t material_format;
  uint64_t emissive; /* R16G16B16A16_SFLOAT, cd/m²; 0: none */
  uint32_t emissive_format;
  int32_t draws_meshes; /* not 0: gloam also draws the world's own meshes */
} gloam_host_geometry;
#define GLOAM_HOST_GEOMETRY_INIT \
  { sizeof(gloam_host_geometry), 0, 0, 0.1f, 0, 0, 0, 0, 0, 0, 0, 0, 1 }

typedef struct gloam_view {
  size_t size;
  uint32_t id;    /* keeps the view's memory and history from frame to frame; below 2^26 */
  uint32_t width; /* pixels */
  uint32_t height;
  gloam_entity camera; /* of the scene; 0: the members below */
  double matrix[16];   /* pose of the camera: rotation and translation */
  float fov_y;         /* vertical field of view */
  float near_m;
  const char* visualizer;              /* null: the lit picture */
  const gloam_host_geometry* geometry; /* null: gloam draws all geometry */
  uint64_t image;                      /* VkImage of the host that takes the picture; 0: gloam_read_picture() */
  uint32_t image_format; /* VkFormat: R8G8B8A8 or B8G8R8A8, UNORM or SRGB; left in COLOR_ATTACHMENT_OPTIMAL */
} gloam_view;
#define GLOAM_VIEW_INIT                                                                                          \
  {                                                                                                              \
    sizeof(gloam_view), 0, 1280, 720, 0,                                                                         \
        {1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0}, 0.8f, 0.1f, 0, 0, 0, 0 \
  }

/* Draws one frame of all these views and submits it; does not wait for the GPU. */
gloam_result gloam_render(gloam_world* world, const gloam_view* views, uint32_t count);
/* Copies the picture of a view's last frame: rows from the top, 4 bytes a pixel, sRGB. Waits for the GPU. `bytes`: of
 * `rgba`, at least 4 · width · height. width and height may be null. */
gloam_result gloam_read_picture(gloam_world* world, uint32_t view, uint8_t* rgba, size_t bytes, uint32_t* width,
                                uint32_t* height);
/* Frees all that is kept for a view. */
gloam_result gloam_release_view(gloam_world* world, uint32_t view);

#ifdef __cplusplus
}
#endif

#endif

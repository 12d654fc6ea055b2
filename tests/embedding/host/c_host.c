// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT

/* The smallest host in C: the scene of minimal.cpp through gloam.h, written to minimal_c.ppm. Then every wrong argument
 * that it can think of, each of which must give a code and a sentence. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "modules/c_interface/gloam.h"

static int faults = 0;

/* Prints and counts a result that is not the expected one, or an error without a sentence. */
static void expect(const char* what, gloam_result got, gloam_result wanted, const char* says) {
  const char* message = gloam_error_message();
  if (got != wanted || (wanted != GLOAM_OK && strstr(message, says) == NULL)) {
    printf("%s: %d in place of %d: '%s' in place of '%s'\n", what, (int)got, (int)wanted, message, says);
    ++faults;
  }
}

static gloam_result draw(gloam_world* world, const gloam_view* view, const char* file) {
  const size_t bytes = 4u * view->width * view->height;
  unsigned char* rgba = malloc(bytes);
  uint32_t width = 0, height = 0;
  size_t i;
  FILE* picture;
  gloam_result result = gloam_render(world, view, 1);
  if (result == GLOAM_OK) result = gloam_read_picture(world, view->id, rgba, bytes, &width, &height);
  if (result == GLOAM_OK) {
    picture = fopen(file, "wb");
    fprintf(picture, "P6 %u %u 255\n", (unsigned)width, (unsigned)height);
    for (i = 0; i < bytes; i += 4) fwrite(rgba + i, 1, 3, picture);
    fclose(picture);
  }
  free(rgba);
  return result;
}

static gloam_result fill(gloam_world* world) {
  /* A pyramid on a floor; three positions a triangle, counter-clockwise seen from outside. */
  static const float corners[] = {-1, 0, 1,  1, 0, 1,  0, 2, 0, 1,  0, 1,  1, 0, -1, 0, 2, 0, 1,  0, -1, -1, 0, -1, 0, 2, 0,
                                  -1, 0, -1, -1, 0, 1, 0, 2, 0, -8, 0, -8, -8, 0, 8, 8, 0, 8, -8, 0, -8, 8, 0, 8,  8, 0, -8};
  static const float none[3] = {0, 0, 0}, horizon[3] = {1.0f, 1.5f, 3.0f};
  const double at[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  double lamp[16];
  uint32_t stone = 0, mesh = 0;
  gloam_entity entity = 0;
  gloam_material material = GLOAM_MATERIAL_INIT;
  gloam_mesh triangles = GLOAM_MESH_INIT;
  gloam_light light = GLOAM_LIGHT_INIT;
  gloam_result result;
  material.base_color[0] = 0.5f;
  material.base_color[1] = 0.4f;
  material.base_color[2] = 0.3f;
  material.roughness = 0.6f;
  if ((result = gloam_material_create(world, &material, &stone)) != GLOAM_OK) return result;
  triangles.positions = corners;
  triangles.vertex_count = sizeof(corners) / sizeof(corners[0]) / 3;
  triangles.material = stone;
  if ((result = gloam_mesh_create(world, &triangles, &mesh)) != GLOAM_OK) return result;
  if ((result = gloam_instance_create(world, mesh, at, &entity)) != GLOAM_OK) return result;
  light.color[1] = 0.7f;
  light.color[2] = 0.4f;
  light.intensity = 200.0f;
  light.width_m = 0.4f;
  memcpy(lamp, at, sizeof(lamp));
  lamp[12] = 2.0;
  lamp[13] = lamp[14] = 2.5;
  if ((result = gloam_light_create(world, &light, lamp, &entity)) != GLOAM_OK) return result;
  return gloam_world_set_sky(world, none, horizon, none);
}

/* Arguments that are wrong, of an engine and a world that work. */
static void try_wrong_arguments(gloam_engine* engine, gloam_world* world, const gloam_view* good) {
  const double at[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const float triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const uint32_t outside[3] = {0, 1, 3};
  double not_finite[16];
  unsigned char little[4];
  gloam_engine* other = engine;
  gloam_engine_info info = GLOAM_ENGINE_INFO_INIT;
  gloam_view view = *good;
  gloam_light light = GLOAM_LIGHT_INIT;
  gloam_mesh mesh = GLOAM_MESH_INIT;
  gloam_entity entity = 0;
  uint32_t number = 0;
  memcpy(not_finite, at, sizeof(at));
  not_finite[5] = NAN;

  expect("no place for an engine", gloam_engine_create(NULL, NULL), GLOAM_USAGE, "null");
  info.size = 3;
  expect("a size of 3", gloam_engine_create(&info, &other), GLOAM_USAGE, "gloam_engine_info::size is 3");
  info.size = sizeof(info) + 8;
  expect("a structure of the future", gloam_engine_create(&info, &other), GLOAM_USAGE, "this library knows up to");
  info.size = sizeof(info) - 1;
  expect("a size inside of a member", gloam_engine_create(&info, &other), GLOAM_USAGE, "gloam_engine_info::size");
  info.size = sizeof(info);
  info.device = "no such device";
  expect("an unknown device", gloam_engine_create(&info, &other), GLOAM_NO_DEVICE, "no such device");
  if (other != NULL) printf("a failed engine is not null\n"), ++faults;
  expect("an engine with worlds", gloam_engine_destroy(engine), GLOAM_USAGE, "1 worlds");
  expect("an unknown knob", gloam_engine_set_knob(engine, "shadows.nothing", "1"), GLOAM_USAGE, "shadows.nothing");
  expect("an unknown value", gloam_engine_set_knob(engine, "shadows.filter", "round"), GLOAM_USAGE, "round");
  expect("an absent file", gloam_world_load(world, "absent.gltf"), GLOAM_USAGE, "not empty");
  expect("no such name", gloam_world_find(world, "light", "sun", &entity), GLOAM_USAGE, "sun");
  expect("no such entity", gloam_entity_destroy(world, 77), GLOAM_USAGE, "no entity 77");
  expect("a clock of NaN", gloam_world_set_clock(world, NAN, 0.0), GLOAM_USAGE, "finite");
  expect("no mesh of this number", gloam_instance_create(world, 9, at, &entity), GLOAM_USAGE, "mesh is 9");
  expect("a pose of NaN", gloam_instance_create(world, 0, not_finite, &entity), GLOAM_USAGE, "not finite");
  expect("a mesh without positions", gloam_mesh_create(world, &mesh, &number), GLOAM_USAGE, "no positions");
  mesh.positions = triangle;
  mesh.vertex_count = 3;
  mesh.indices = outside;
  mesh.index_count = 3;
  expect("an index out of range", gloam_mesh_create(world, &mesh, &number), GLOAM_USAGE, "indices[2] is 3");
  mesh.index_count = 2;
  expect("two corners", gloam_mesh_create(world, &mesh, &number), GLOAM_USAGE, "a triangle has three");
  mesh.indices = NULL;
  mesh.material = 5;
  expect("no material of this number", gloam_mesh_create(world, &mesh, &number), GLOAM_USAGE, "material is 5");
  light.intensity = NAN;
  expect("a light of NaN", gloam_light_create(world, &light, at, &entity), GLOAM_USAGE, "gloam_light");
  light.intensity = 1.0f;
  light.kind = (gloam_light_kind)7;
  expect("a kind of light", gloam_light_create(world, &light, at, &entity), GLOAM_USAGE, "kind is 7");
  expect("an unknown image", gloam_engine_forget_image(engine, 77), GLOAM_OK, "");
  expect("no views", gloam_render(world, NULL, 1), GLOAM_USAGE, "views is null");
  expect("none of the views", gloam_render(world, good, 0), GLOAM_USAGE, "count is 0");
  view.width = 0;
  expect("a view without pixels", gloam_render(world, &view, 1), GLOAM_USAGE, "0x360 pixels");
  view = *good;
  view.matrix[0] = 2.0;
  expect("a scaled camera", gloam_render(world, &view, 1), GLOAM_USAGE, "no rotation and translation");
  view = *good;
  view.fov_y = 4.0f;
  expect("a field of view above pi", gloam_render(world, &view, 1), GLOAM_USAGE, "fov_y");
  view = *good;
  view.visualizer = "nothing";
  expect("an unknown visualizer", gloam_render(world, &view, 1), GLOAM_USAGE, "nothing");
  view = *good;
  view.camera = 77;
  expect("no such camera", gloam_render(world, &view, 1), GLOAM_USAGE, "no entity 77");
  expect("a picture that does not fit", gloam_read_picture(world, good->id, little, sizeof(little), NULL, NULL),
         GLOAM_USAGE, "there is room for 4");
  expect("a view that was not drawn", gloam_read_picture(world, 99, little, sizeof(little), NULL, NULL), GLOAM_USAGE, "99");
}

/* Everything that has no place in the smallest host. What is added is removed again, so the picture stays. */
static void try_the_rest(gloam_engine* engine, gloam_world* world, const gloam_view* view) {
  const double at[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  double up[16];
  gloam_light light = GLOAM_LIGHT_INIT;
  gloam_view normals = *view;
  gloam_entity lamp = 0, copy = 0;
  memcpy(up, at, sizeof(up));
  up[13] = 1.0;
  if (gloam_engine_device_name(engine)[0] == 0) printf("the device has no name\n"), ++faults;
  expect("a knob", gloam_engine_set_knob(engine, "shadows.filter", "chs"), GLOAM_OK, "");
  expect("a clock", gloam_world_set_clock(world, 0.0, 1.0 / 60.0), GLOAM_OK, "");
  expect("a second lamp", gloam_light_create(world, &light, up, &lamp), GLOAM_OK, "");
  light.intensity = 1000.0f;
  light.casts_shadows = 0;
  expect("a brighter lamp", gloam_light_set(world, lamp, &light), GLOAM_OK, "");
  expect("a second pyramid", gloam_instance_create(world, 0, at, &copy), GLOAM_OK, "");
  expect("no lamp", gloam_light_set(world, copy, &light), GLOAM_USAGE, "is no light");
  expect("a higher pyramid", gloam_entity_set_matrix(world, copy, up), GLOAM_OK, "");
  expect("a changed frame", draw(world, view, "minimal_c_changed.ppm"), GLOAM_OK, "");
  expect("the end of a lamp", gloam_entity_destroy(world, lamp), GLOAM_OK, "");
  expect("the end of a pyramid", gloam_entity_destroy(world, copy), GLOAM_OK, "");
  expect("a lamp that has ended", gloam_entity_set_matrix(world, lamp, at), GLOAM_USAGE, "no entity");
  normals.visualizer = "normal";
  expect("normals", draw(world, &normals, "minimal_c_normals.ppm"), GLOAM_OK, "");
  expect("the end of a view", gloam_release_view(world, view->id), GLOAM_OK, "");
  expect("idle memory", gloam_engine_free_idle_memory(engine), GLOAM_OK, "");
  expect("a frame as before", draw(world, view, "minimal_c_again.ppm"), GLOAM_OK, "");
  expect("an exposure", gloam_world_set_exposure(world, 2.0f), GLOAM_OK, "");
  expect("a wait", gloam_engine_wait(engine), GLOAM_OK, "");
}

/* A file with a camera, which the host moves. */
static void try_a_file(gloam_engine* engine, const gloam_view* view) {
  static const char text[] =
      "{\"asset\": {\"version\": \"2.0\"}, \"scenes\": [{\"nodes\": [0]}], \"nodes\": [{\"name\": \"eye\", \"camera\": 0}],"
      " \"cameras\": [{\"type\": \"perspective\", \"perspective\": {\"yfov\": 1.0, \"znear\": 0.1}}]}";
  gloam_world* world = NULL;
  gloam_view through = *view;
  FILE* file = fopen("tiny.gltf", "wb");
  fwrite(text, 1, sizeof(text) - 1, file);
  fclose(file);
  expect("an engine as a world", gloam_world_destroy((gloam_world*)engine), GLOAM_USAGE, "no world that exists");
  expect("a second world", gloam_world_create(engine, &world), GLOAM_OK, "");
  expect("a file", gloam_world_load(world, "tiny.gltf"), GLOAM_OK, "");
  expect("its camera", gloam_world_find(world, "camera", "eye", &through.camera), GLOAM_OK, "");
  expect("another pose", gloam_entity_set_matrix(world, through.camera, view->matrix), GLOAM_OK, "");
  expect("a frame of the file", draw(world, &through, "tiny.ppm"), GLOAM_OK, "");
  expect("the end of the second world", gloam_world_destroy(world), GLOAM_OK, "");
}

int main(void) {
  gloam_engine_info info = GLOAM_ENGINE_INFO_INIT;
  gloam_engine* engine = NULL;
  gloam_world* world = NULL;
  gloam_view view = GLOAM_VIEW_INIT, old = GLOAM_VIEW_INIT;
  gloam_result result;
  if (gloam_interface_version() != GLOAM_C_INTERFACE) return puts("header and library differ"), 1;
  info.validate = 1;
  result = gloam_engine_create(&info, &engine);
  if (result == GLOAM_NO_DEVICE) return puts(gloam_error_message()), 77;
  expect("an engine", result, GLOAM_OK, "");
  expect("a world", gloam_world_create(engine, &world), GLOAM_OK, "");
  expect("an absent file", gloam_world_load(world, "absent.gltf"), GLOAM_INPUT, "absent.gltf");
  expect("a scene", fill(world), GLOAM_OK, "");
  view.width = 640;
  view.height = 360;
  view.matrix[13] = 1.5;
  view.matrix[14] = 6.0;
  expect("a frame", draw(world, &view, "minimal_c.ppm"), GLOAM_OK, "");
  try_wrong_arguments(engine, world, &view);
  /* A program that was compiled when the structure ended before `visualizer`. */
  old = view;
  old.size = offsetof(gloam_view, visualizer);
  old.visualizer = "must not be read";
  expect("a frame of an old program", draw(world, &old, "minimal_c_old.ppm"), GLOAM_OK, "");
  try_the_rest(engine, world, &view);
  try_a_file(engine, &view);
  if (gloam_engine_validation_messages(engine) != 0) puts("validation is not silent"), ++faults;
  expect("the end of a world", gloam_world_destroy(world), GLOAM_OK, "");
  expect("a world that has ended", gloam_render(world, &view, 1), GLOAM_USAGE, "world is no world that exists");
  expect("the end of an engine", gloam_engine_destroy(engine), GLOAM_OK, "");
  expect("an engine that has ended", gloam_engine_destroy(engine), GLOAM_USAGE, "engine is no engine that exists");
  printf("gloam %s, interface %u: %d faults\n", gloam_version(), (unsigned)gloam_interface_version(), faults);
  return faults == 0 ? 0 : 1;
}

// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_PARTICLES_PARTICLES_SHARED_H
#define GLOAM_SHADERS_PARTICLES_PARTICLES_SHARED_H

#include "shaders/common/prelude.h"

#define GLOAM_PARTICLE_GROUP 64u                // places of particles in a row that belong to one emitter
#define GLOAM_PARTICLE_SWIRL_STEPS 6            // of a lifetime, in which turbulence is summed
#define GLOAM_PARTICLE_LIGHTS 4                 // of an emitter
#define GLOAM_PARTICLE_DRAW_SPRITES 32u         // sprites of one instance of the draw
#define GLOAM_PARTICLE_UNBAKED 4u               // channel of a light whose visibility is not baked
#define GLOAM_PARTICLE_DIRECTIONAL 0x80000000u  // with the index of a directional light

// Factors of speed and size that particles draw by lot.
#define GLOAM_PARTICLE_SLOWEST 0.6f
#define GLOAM_PARTICLE_FASTEST 1.4f
#define GLOAM_PARTICLE_SMALLEST 0.75f
#define GLOAM_PARTICLE_LARGEST 1.25f

GLOAM_SHARED_BEGIN

/// One emitter in a view. Positions are camera-relative, in metres; axes are the world's.
struct ParticleEmitterRow {
  vec3 origin;
  float size_m;  // mean diameter at birth
  vec3 box_x;    // edges of the box around the origin
  float speed;   // mean speed at birth, m/s
  vec3 box_y;
  float drag;  // 1/s
  vec3 box_z;
  float rise;  // m/s
  vec3 axis;   // middle of the cone of directions; unit, as the next two
  float cos_spread;
  vec3 across_x;
  float turbulence;  // m/s along each axis
  vec3 across_y;
  float inverse_swirl;  // 1/m
  uint seed;
  uint oldest;  // number of the oldest particle, modulo 2^32
  uint count;
  uint first;          // place of the oldest particle; a multiple of GLOAM_PARTICLE_GROUP
  float oldest_age_s;  // particle k has the age oldest_age_s - k * interval_s
  float interval_s;    // between births
  float inverse_life;  // 1/s
  float swirl_time;    // phase of the turbulence, 0...1; it repeats after GLOAM_PARTICLE_SWIRL_PERIOD
  float growth;        // size at death / size at birth
  float spin;          // radians/s
  float opacity;       // 0...1
  float per_fade_in;   // 1 / shares of the lifetime
  float per_fade_out;
  float erosion;
  float cover;
  float forward;
  vec3 albedo;
  float far_m;    // view depth of the first key
  vec3 emission;  // at birth, cd/m²
  vec3 cooled;    // factor of the emission at death
  float keys_per_m;
  uint first_key;
  uint keys;              // number of keys of the emitter's depths
  float map_slice;        // first slice of the emitter's map in the atlas; negative: it has no map
  float swirl_step_s;     // lifetime / GLOAM_PARTICLE_SWIRL_STEPS
  float step_way;         // (1 - step_decay) / drag
  float step_decay;       // exp(-drag * swirl_step_s)
  vec3 map_from;          // camera-relative corner of the map
  vec3 map_scale;         // texels per metre
  vec3 map_size;          // texels
  float map_light_scale;  // from the light of the map to that of the view
  float mean_speed;       // along the axis at birth, of all particles together, m/s
  float birth_wide2;      // variance of places across the column at birth, m²
  float way_wide2;        // variance of speeds across the axis at birth, m²/s²
  float drift_wide2;      // variance of the turbulence's speeds that widens the column, m²/s²
  float size_wide2;       // variance of a sprite's opacity at birth, m²
  float pace2_of_places;  // by which the variance of places draws out a plume: 1 / lifetime²
  float pace2_of_way;     // and the different speeds at birth: for the square of the way, 1/s⁴ · m²
  float least_pace2;      // and turbulence, m²/s²
  float hiding;  // 1 / (2 √(2π)) · area that sprites of the size at birth and opacity 1, born in one second, hide: m²/s
  uint path_first;  // first pose of the emitter's path, the oldest
  uint path_poses;  // 0: the emitter rests
  uvec4 lights;     // indices in the view's LightBlock; the first light_count are used
  vec4 light_weights;
  uvec4 light_channels;  // of the map's visibility, or GLOAM_PARTICLE_UNBAKED
  uint light_count;
};

/// Where an emitter was. Poses of a path follow each other in time; two of the same age are a jump.
struct ParticlePose {
  vec3 origin;  // these as in ParticleEmitterRow
  float age_s;  // of a particle that was born there
  vec3 box_x;
  vec3 box_y;
  vec3 box_z;
  vec3 axis;
};

/// Constants that the particles of one view share.
struct ParticleFrame {
  vec4 planes[4];  // camera-relative, of the sides of the view: a point p is inside if dot(xyz, p) + w >= 0
  vec3 right;      // unit axes of the picture
  float near_m;
  vec3 up;
  uint places;       // multiple of GLOAM_PARTICLE_GROUP
  vec3 unlit;        // radiance of a white particle without lighting
  uint culled_key;   // key of particles that are not drawn: 0xFF with one pass of the sort, 0xFFFF with two
  vec3 atlas_scale;  // 1 / texels of the atlas of baked light
};

/// Push constants of a dispatch of the simulation.
struct ParticleDispatch {
  uint first_group;
  uint row;  // of the emitter, if it has the dispatch for itself
};

/// One particle of a view, by place.
struct Particle {
  vec3 position;  // camera-relative
  float radius_m;
  float angle;    // radians
  float opacity;  // greatest, of the middle
  float life;     // share of its lifetime, 0...1
  uint look;      // emitter in the low 16 bits, random bits above
  uint outward;   // out of the plume, shorter than 1: three times 10 bits, of which 1…1023 are −1…1
};

/// Arguments of the passes that follow the sort.
struct ParticleDraws {
  uint indices;  // an indexed draw
  uint instances;
  uint first_index;
  uint vertex_offset;
  uint first_instance;
  uint drawn;          // sprites
  uvec3 light_groups;  // workgroups with a thread for each sprite
};

GLOAM_SHARED_END

#define GLOAM_PARTICLE_SWIRL_PERIOD 64.0  // s

#endif

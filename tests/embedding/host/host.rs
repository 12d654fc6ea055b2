// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// The smallest host in Rust: the scene of minimal.cpp through gloam.h, written to minimal_rust.ppm.
use std::ffi::{c_char, c_int, c_void, CStr};
use std::io::Write;

#[repr(C)]
struct Material {
    size: usize,
    base_color: [f32; 4],
    emissive: [f32; 3],
    metallic: f32,
    roughness: f32,
    double_sided: i32,
}

#[repr(C)]
struct Mesh {
    size: usize,
    positions: *const f32,
    normals: *const f32,
    uv: *const f32,
    indices: *const u32,
    vertex_count: u32,
    index_count: u32,
    material: u32,
}

#[repr(C)]
struct Light {
    size: usize,
    kind: c_int,
    color: [f32; 3],
    intensity: f32,
    range_m: f32,
    inner_angle: f32,
    outer_angle: f32,
    width_m: f32,
    apparent_angle: f32,
    casts_shadows: i32,
}

#[repr(C)]
struct View {
    size: usize,
    id: u32,
    width: u32,
    height: u32,
    camera: u64,
    matrix: [f64; 16],
    fov_y: f32,
    near_m: f32,
    visualizer: *const c_char,
    geometry: *const c_void,
    image: u64,
    image_format: u32,
}

enum Engine {}
enum World {}

extern "C" {
    fn gloam_error_message() -> *const c_char;
    fn gloam_engine_create(info: *const c_void, engine: *mut *mut Engine) -> c_int;
    fn gloam_engine_destroy(engine: *mut Engine) -> c_int;
    fn gloam_world_create(engine: *mut Engine, world: *mut *mut World) -> c_int;
    fn gloam_world_destroy(world: *mut World) -> c_int;
    fn gloam_world_set_sky(world: *mut World, zenith: *const f32, horizon: *const f32, ground: *const f32) -> c_int;
    fn gloam_material_create(world: *mut World, material: *const Material, number: *mut u32) -> c_int;
    fn gloam_mesh_create(world: *mut World, mesh: *const Mesh, number: *mut u32) -> c_int;
    fn gloam_instance_create(world: *mut World, mesh: u32, matrix: *const f64, entity: *mut u64) -> c_int;
    fn gloam_light_create(world: *mut World, light: *const Light, matrix: *const f64, entity: *mut u64) -> c_int;
    fn gloam_render(world: *mut World, views: *const View, count: u32) -> c_int;
    fn gloam_read_picture(world: *mut World, view: u32, rgba: *mut u8, bytes: usize, width: *mut u32, height: *mut u32) -> c_int;
}

const NO_DEVICE: c_int = 4;
const UNIT: [f64; 16] = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
const CORNERS: [f32; 54] = [
    -1.0, 0.0, 1.0, 1.0, 0.0, 1.0, 0.0, 2.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, -1.0, 0.0, 2.0, 0.0, 1.0, 0.0, -1.0, -1.0, 0.0,
    -1.0, 0.0, 2.0, 0.0, -1.0, 0.0, -1.0, -1.0, 0.0, 1.0, 0.0, 2.0, 0.0, -8.0, 0.0, -8.0, -8.0, 0.0, 8.0, 8.0, 0.0, 8.0,
    -8.0, 0.0, -8.0, 8.0, 0.0, 8.0, 8.0, 0.0, -8.0,
];

fn message() -> String {
    unsafe { CStr::from_ptr(gloam_error_message()).to_string_lossy().into_owned() }
}

fn check(result: c_int) {
    if result != 0 {
        println!("{}", message());
        std::process::exit(if result == NO_DEVICE { 77 } else { 1 });
    }
}

fn main() {
    let (mut engine, mut world) = (std::ptr::null_mut(), std::ptr::null_mut());
    let (mut number, mut mesh, mut entity) = (0, 0, 0);
    let (mut width, mut height) = (0, 0);
    let mut rgba = vec![0u8; 4 * 640 * 360];
    let mut lamp = UNIT;
    lamp[12..15].copy_from_slice(&[2.0, 2.5, 2.5]);
    let mut camera = UNIT;
    camera[13..15].copy_from_slice(&[1.5, 6.0]);
    let none = std::ptr::null();
    unsafe {
        check(gloam_engine_create(none, &mut engine));
        check(gloam_world_create(engine, &mut world));
        let stone = Material {
            size: std::mem::size_of::<Material>(),
            base_color: [0.5, 0.4, 0.3, 1.0],
            emissive: [0.0; 3],
            metallic: 0.0,
            roughness: 0.6,
            double_sided: 0,
        };
        check(gloam_material_create(world, &stone, &mut number));
        let triangles = Mesh {
            size: std::mem::size_of::<Mesh>(),
            positions: CORNERS.as_ptr(),
            normals: std::ptr::null(),
            uv: std::ptr::null(),
            indices: std::ptr::null(),
            vertex_count: (CORNERS.len() / 3) as u32,
            index_count: 0,
            material: number,
        };
        check(gloam_mesh_create(world, &triangles, &mut mesh));
        check(gloam_instance_create(world, mesh, UNIT.as_ptr(), &mut entity));
        let light = Light {
            size: std::mem::size_of::<Light>(),
            kind: 0,
            color: [1.0, 0.7, 0.4],
            intensity: 200.0,
            range_m: 0.0,
            inner_angle: 0.0,
            outer_angle: 0.785398163,
            width_m: 0.4,
            apparent_angle: 0.00925025,
            casts_shadows: 1,
        };
        check(gloam_light_create(world, &light, lamp.as_ptr(), &mut entity));
        let (dark, horizon) = ([0.0f32; 3], [1.0f32, 1.5, 3.0]);
        check(gloam_world_set_sky(world, dark.as_ptr(), horizon.as_ptr(), dark.as_ptr()));
        let view = View {
            size: std::mem::size_of::<View>(),
            id: 0,
            width: 640,
            height: 360,
            camera: 0,
            matrix: camera,
            fov_y: 0.8,
            near_m: 0.1,
            visualizer: std::ptr::null(),
            geometry: std::ptr::null(),
            image: 0,
            image_format: 0,
        };
        check(gloam_render(world, &view, 1));
        check(gloam_read_picture(world, 0, rgba.as_mut_ptr(), rgba.len(), &mut width, &mut height));
        if gloam_engine_destroy(engine) != 2 || !message().contains("1 worlds") {
            println!("an engine with a world must not end: '{}'", message());
            std::process::exit(1);
        }
        check(gloam_world_destroy(world));
        check(gloam_engine_destroy(engine));
    }
    let mut file = std::fs::File::create("minimal_rust.ppm").expect("minimal_rust.ppm");
    write!(file, "P6 {} {} 255\n", width, height).expect("head");
    let rgb: Vec<u8> = rgba.chunks(4).flat_map(|pixel| pixel[..3].to_vec()).collect();
    file.write_all(&rgb).expect("pixels");
}

// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
// bindings/rust/bindgen wrote this.
#![allow(missing_docs, non_camel_case_types)]
use crate::decoder::*;
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_encoder {
    _unused: [u8; 0],
}
#[repr(C)]
pub struct anic_source_clip {
    pub struct_size: usize,
    pub name: *const ::core::ffi::c_char,
    pub frame_count: u32,
    pub rate_numerator: u32,
    pub rate_denominator: u32,
    pub up: anic_up_axis,
    pub loop_: u8,
    pub start_time: f64,
    pub metres_per_unit: f64,
    pub times: *const f64,
    pub event_names: *const *const ::core::ffi::c_char,
    pub event_seconds: *const f64,
    pub event_count: u32,
    pub origin: [f64; 3usize],
    pub find_origin: u8,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_source_clip"][::core::mem::size_of::<anic_source_clip>() - 120usize];
    ["Alignment of anic_source_clip"][::core::mem::align_of::<anic_source_clip>() - 8usize];
    ["Offset of field: anic_source_clip::struct_size"][::core::mem::offset_of!(anic_source_clip, struct_size) - 0usize];
    ["Offset of field: anic_source_clip::name"][::core::mem::offset_of!(anic_source_clip, name) - 8usize];
    ["Offset of field: anic_source_clip::frame_count"]
        [::core::mem::offset_of!(anic_source_clip, frame_count) - 16usize];
    ["Offset of field: anic_source_clip::rate_numerator"]
        [::core::mem::offset_of!(anic_source_clip, rate_numerator) - 20usize];
    ["Offset of field: anic_source_clip::rate_denominator"]
        [::core::mem::offset_of!(anic_source_clip, rate_denominator) - 24usize];
    ["Offset of field: anic_source_clip::up"][::core::mem::offset_of!(anic_source_clip, up) - 28usize];
    ["Offset of field: anic_source_clip::loop_"][::core::mem::offset_of!(anic_source_clip, loop_) - 32usize];
    ["Offset of field: anic_source_clip::start_time"][::core::mem::offset_of!(anic_source_clip, start_time) - 40usize];
    ["Offset of field: anic_source_clip::metres_per_unit"]
        [::core::mem::offset_of!(anic_source_clip, metres_per_unit) - 48usize];
    ["Offset of field: anic_source_clip::times"][::core::mem::offset_of!(anic_source_clip, times) - 56usize];
    ["Offset of field: anic_source_clip::event_names"]
        [::core::mem::offset_of!(anic_source_clip, event_names) - 64usize];
    ["Offset of field: anic_source_clip::event_seconds"]
        [::core::mem::offset_of!(anic_source_clip, event_seconds) - 72usize];
    ["Offset of field: anic_source_clip::event_count"]
        [::core::mem::offset_of!(anic_source_clip, event_count) - 80usize];
    ["Offset of field: anic_source_clip::origin"][::core::mem::offset_of!(anic_source_clip, origin) - 88usize];
    ["Offset of field: anic_source_clip::find_origin"]
        [::core::mem::offset_of!(anic_source_clip, find_origin) - 112usize];
};
pub const ANIC_SCALAR_FLOAT32: anic_scalar = 0;
pub const ANIC_SCALAR_FLOAT64: anic_scalar = 1;
pub type anic_scalar = i32;
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_frame_run {
    pub first: u32,
    pub count: u32,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_frame_run"][::core::mem::size_of::<anic_frame_run>() - 8usize];
    ["Alignment of anic_frame_run"][::core::mem::align_of::<anic_frame_run>() - 4usize];
    ["Offset of field: anic_frame_run::first"][::core::mem::offset_of!(anic_frame_run, first) - 0usize];
    ["Offset of field: anic_frame_run::count"][::core::mem::offset_of!(anic_frame_run, count) - 4usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_source_mesh {
    pub struct_size: usize,
    pub name: *const ::core::ffi::c_char,
    pub vertex_count: u32,
    pub polygon_count: u32,
    pub offsets: *const u32,
    pub corners: *const u32,
    pub positions: *const ::core::ffi::c_void,
    pub vertex_stride: isize,
    pub frame_stride: isize,
    pub scalar: anic_scalar,
    pub run_count: u32,
    pub runs: *const anic_frame_run,
    pub user: *mut ::core::ffi::c_void,
    pub read: ::core::option::Option<
        unsafe extern "C" fn(user: *mut ::core::ffi::c_void, frame: u32, positions: *mut f32) -> ::core::ffi::c_int,
    >,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_source_mesh"][::core::mem::size_of::<anic_source_mesh>() - 96usize];
    ["Alignment of anic_source_mesh"][::core::mem::align_of::<anic_source_mesh>() - 8usize];
    ["Offset of field: anic_source_mesh::struct_size"][::core::mem::offset_of!(anic_source_mesh, struct_size) - 0usize];
    ["Offset of field: anic_source_mesh::name"][::core::mem::offset_of!(anic_source_mesh, name) - 8usize];
    ["Offset of field: anic_source_mesh::vertex_count"]
        [::core::mem::offset_of!(anic_source_mesh, vertex_count) - 16usize];
    ["Offset of field: anic_source_mesh::polygon_count"]
        [::core::mem::offset_of!(anic_source_mesh, polygon_count) - 20usize];
    ["Offset of field: anic_source_mesh::offsets"][::core::mem::offset_of!(anic_source_mesh, offsets) - 24usize];
    ["Offset of field: anic_source_mesh::corners"][::core::mem::offset_of!(anic_source_mesh, corners) - 32usize];
    ["Offset of field: anic_source_mesh::positions"][::core::mem::offset_of!(anic_source_mesh, positions) - 40usize];
    ["Offset of field: anic_source_mesh::vertex_stride"]
        [::core::mem::offset_of!(anic_source_mesh, vertex_stride) - 48usize];
    ["Offset of field: anic_source_mesh::frame_stride"]
        [::core::mem::offset_of!(anic_source_mesh, frame_stride) - 56usize];
    ["Offset of field: anic_source_mesh::scalar"][::core::mem::offset_of!(anic_source_mesh, scalar) - 64usize];
    ["Offset of field: anic_source_mesh::run_count"][::core::mem::offset_of!(anic_source_mesh, run_count) - 68usize];
    ["Offset of field: anic_source_mesh::runs"][::core::mem::offset_of!(anic_source_mesh, runs) - 72usize];
    ["Offset of field: anic_source_mesh::user"][::core::mem::offset_of!(anic_source_mesh, user) - 80usize];
    ["Offset of field: anic_source_mesh::read"][::core::mem::offset_of!(anic_source_mesh, read) - 88usize];
};
pub const ANIC_BOUND_USUAL: anic_bound = 0;
pub const ANIC_BOUND_UNITS: anic_bound = 1;
pub const ANIC_BOUND_PERCENT: anic_bound = 2;
pub const ANIC_BOUND_EXACT: anic_bound = 3;
pub type anic_bound = i32;
#[repr(C)]
pub struct anic_source_attribute {
    pub struct_size: usize,
    pub name: *const ::core::ffi::c_char,
    pub kind: anic_attribute_kind,
    pub domain: anic_domain,
    pub components: u32,
    pub frames: u32,
    pub values: *const f32,
    pub labels: *const u32,
    pub label_names: *const *const ::core::ffi::c_char,
    pub label_count: u32,
    pub materials: *const *const anic_material,
    pub unit: *const ::core::ffi::c_char,
    pub error: f64,
    pub bound: anic_bound,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_source_attribute"][::core::mem::size_of::<anic_source_attribute>() - 96usize];
    ["Alignment of anic_source_attribute"][::core::mem::align_of::<anic_source_attribute>() - 8usize];
    ["Offset of field: anic_source_attribute::struct_size"]
        [::core::mem::offset_of!(anic_source_attribute, struct_size) - 0usize];
    ["Offset of field: anic_source_attribute::name"][::core::mem::offset_of!(anic_source_attribute, name) - 8usize];
    ["Offset of field: anic_source_attribute::kind"][::core::mem::offset_of!(anic_source_attribute, kind) - 16usize];
    ["Offset of field: anic_source_attribute::domain"]
        [::core::mem::offset_of!(anic_source_attribute, domain) - 20usize];
    ["Offset of field: anic_source_attribute::components"]
        [::core::mem::offset_of!(anic_source_attribute, components) - 24usize];
    ["Offset of field: anic_source_attribute::frames"]
        [::core::mem::offset_of!(anic_source_attribute, frames) - 28usize];
    ["Offset of field: anic_source_attribute::values"]
        [::core::mem::offset_of!(anic_source_attribute, values) - 32usize];
    ["Offset of field: anic_source_attribute::labels"]
        [::core::mem::offset_of!(anic_source_attribute, labels) - 40usize];
    ["Offset of field: anic_source_attribute::label_names"]
        [::core::mem::offset_of!(anic_source_attribute, label_names) - 48usize];
    ["Offset of field: anic_source_attribute::label_count"]
        [::core::mem::offset_of!(anic_source_attribute, label_count) - 56usize];
    ["Offset of field: anic_source_attribute::materials"]
        [::core::mem::offset_of!(anic_source_attribute, materials) - 64usize];
    ["Offset of field: anic_source_attribute::unit"][::core::mem::offset_of!(anic_source_attribute, unit) - 72usize];
    ["Offset of field: anic_source_attribute::error"][::core::mem::offset_of!(anic_source_attribute, error) - 80usize];
    ["Offset of field: anic_source_attribute::bound"][::core::mem::offset_of!(anic_source_attribute, bound) - 88usize];
};
pub const ANIC_GOAL_DEFAULT: anic_goal = 0;
pub const ANIC_GOAL_MAX_ERROR: anic_goal = 1;
pub const ANIC_GOAL_KG: anic_goal = 2;
pub const ANIC_GOAL_RMSE: anic_goal = 3;
pub const ANIC_GOAL_SIZE: anic_goal = 4;
pub const ANIC_GOAL_BPFV: anic_goal = 5;
pub const ANIC_GOAL_DISPLACEMENT: anic_goal = 6;
pub const ANIC_GOAL_STED: anic_goal = 7;
pub type anic_goal = i32;
pub const ANIC_CHOOSE_SMALLEST: anic_basis_choice = 0;
pub const ANIC_CHOOSE_KEYFRAMES: anic_basis_choice = 1;
pub const ANIC_CHOOSE_EIGENSHAPES: anic_basis_choice = 2;
pub const ANIC_CHOOSE_EIGENTRAJECTORIES: anic_basis_choice = 3;
pub type anic_basis_choice = i32;
pub const ANIC_SELECT_PIVOT: anic_selection = 0;
pub const ANIC_SELECT_GAS: anic_selection = 1;
pub const ANIC_SELECT_UNIFORM: anic_selection = 2;
pub type anic_selection = i32;
pub const ANIC_INTERPOLATE_USUAL: anic_interpolation = 0;
pub const ANIC_INTERPOLATE_LINEAR: anic_interpolation = 1;
pub const ANIC_INTERPOLATE_MSGI: anic_interpolation = 2;
pub const ANIC_INTERPOLATE_BEST: anic_interpolation = 3;
pub type anic_interpolation = i32;
pub const ANIC_KEYFRAMES_NATIVE: anic_keyframe_coder = 0;
pub const ANIC_KEYFRAMES_DRACO: anic_keyframe_coder = 1;
pub const ANIC_KEYFRAMES_SMALLEST: anic_keyframe_coder = 2;
pub type anic_keyframe_coder = i32;
pub const ANIC_MASSAGE_OFF: anic_massage = 0;
pub const ANIC_MASSAGE_ON: anic_massage = 1;
pub const ANIC_MASSAGE_AUTO: anic_massage = 2;
pub type anic_massage = i32;
pub const ANIC_EFFORT_NORMAL: anic_effort = 0;
pub const ANIC_EFFORT_FAST: anic_effort = 1;
pub const ANIC_EFFORT_BEST: anic_effort = 2;
pub type anic_effort = i32;
pub const ANIC_ENCODE_PERCENT: _bindgen_ty_2 = 1;
pub const ANIC_ENCODE_CAP_PERCENT: _bindgen_ty_2 = 2;
pub const ANIC_ENCODE_ERROR_PERCENT: _bindgen_ty_2 = 4;
pub const ANIC_ENCODE_NO_ATTRIBUTES: _bindgen_ty_2 = 8;
pub const ANIC_ENCODE_ROOT_MOTION: _bindgen_ty_2 = 16;
pub const ANIC_ENCODE_LOSSLESS: _bindgen_ty_2 = 32;
pub const ANIC_ENCODE_SMALLEST: _bindgen_ty_2 = 64;
pub type _bindgen_ty_2 = ::core::ffi::c_uint;
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_encode_progress {
    pub user: *mut ::core::ffi::c_void,
    pub report: ::core::option::Option<
        unsafe extern "C" fn(
            user: *mut ::core::ffi::c_void,
            stage: *const ::core::ffi::c_char,
            done: f64,
        ) -> ::core::ffi::c_int,
    >,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_encode_progress"][::core::mem::size_of::<anic_encode_progress>() - 16usize];
    ["Alignment of anic_encode_progress"][::core::mem::align_of::<anic_encode_progress>() - 8usize];
    ["Offset of field: anic_encode_progress::user"][::core::mem::offset_of!(anic_encode_progress, user) - 0usize];
    ["Offset of field: anic_encode_progress::report"][::core::mem::offset_of!(anic_encode_progress, report) - 8usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_writer {
    pub user: *mut ::core::ffi::c_void,
    pub write: ::core::option::Option<
        unsafe extern "C" fn(
            user: *mut ::core::ffi::c_void,
            bytes: *const ::core::ffi::c_void,
            size: usize,
        ) -> ::core::ffi::c_int,
    >,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_writer"][::core::mem::size_of::<anic_writer>() - 16usize];
    ["Alignment of anic_writer"][::core::mem::align_of::<anic_writer>() - 8usize];
    ["Offset of field: anic_writer::user"][::core::mem::offset_of!(anic_writer, user) - 0usize];
    ["Offset of field: anic_writer::write"][::core::mem::offset_of!(anic_writer, write) - 8usize];
};
#[repr(C)]
pub struct anic_encode_options {
    pub struct_size: usize,
    pub goal: anic_goal,
    pub order: anic_order,
    pub goal_value: f64,
    pub max_error: f64,
    pub flags: u64,
    pub max_bytes: u64,
    pub threads: u32,
    pub effort: anic_effort,
    pub basis: anic_basis_choice,
    pub keyframes: u32,
    pub selection: anic_selection,
    pub interpolation: anic_interpolation,
    pub keyframe_coder: anic_keyframe_coder,
    pub massage: anic_massage,
    pub uv_bits: u32,
    pub colour_bits: u32,
    pub massage_strength: f64,
    pub massage_tolerance: f64,
    pub attribute_error: f64,
    pub normal_error: f64,
    pub progress: anic_encode_progress,
    pub writer: anic_writer,
    pub metadata: *const ::core::ffi::c_char,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_encode_options"][::core::mem::size_of::<anic_encode_options>() - 160usize];
    ["Alignment of anic_encode_options"][::core::mem::align_of::<anic_encode_options>() - 8usize];
    ["Offset of field: anic_encode_options::struct_size"]
        [::core::mem::offset_of!(anic_encode_options, struct_size) - 0usize];
    ["Offset of field: anic_encode_options::goal"][::core::mem::offset_of!(anic_encode_options, goal) - 8usize];
    ["Offset of field: anic_encode_options::order"][::core::mem::offset_of!(anic_encode_options, order) - 12usize];
    ["Offset of field: anic_encode_options::goal_value"]
        [::core::mem::offset_of!(anic_encode_options, goal_value) - 16usize];
    ["Offset of field: anic_encode_options::max_error"]
        [::core::mem::offset_of!(anic_encode_options, max_error) - 24usize];
    ["Offset of field: anic_encode_options::flags"][::core::mem::offset_of!(anic_encode_options, flags) - 32usize];
    ["Offset of field: anic_encode_options::max_bytes"]
        [::core::mem::offset_of!(anic_encode_options, max_bytes) - 40usize];
    ["Offset of field: anic_encode_options::threads"][::core::mem::offset_of!(anic_encode_options, threads) - 48usize];
    ["Offset of field: anic_encode_options::effort"][::core::mem::offset_of!(anic_encode_options, effort) - 52usize];
    ["Offset of field: anic_encode_options::basis"][::core::mem::offset_of!(anic_encode_options, basis) - 56usize];
    ["Offset of field: anic_encode_options::keyframes"]
        [::core::mem::offset_of!(anic_encode_options, keyframes) - 60usize];
    ["Offset of field: anic_encode_options::selection"]
        [::core::mem::offset_of!(anic_encode_options, selection) - 64usize];
    ["Offset of field: anic_encode_options::interpolation"]
        [::core::mem::offset_of!(anic_encode_options, interpolation) - 68usize];
    ["Offset of field: anic_encode_options::keyframe_coder"]
        [::core::mem::offset_of!(anic_encode_options, keyframe_coder) - 72usize];
    ["Offset of field: anic_encode_options::massage"][::core::mem::offset_of!(anic_encode_options, massage) - 76usize];
    ["Offset of field: anic_encode_options::uv_bits"][::core::mem::offset_of!(anic_encode_options, uv_bits) - 80usize];
    ["Offset of field: anic_encode_options::colour_bits"]
        [::core::mem::offset_of!(anic_encode_options, colour_bits) - 84usize];
    ["Offset of field: anic_encode_options::massage_strength"]
        [::core::mem::offset_of!(anic_encode_options, massage_strength) - 88usize];
    ["Offset of field: anic_encode_options::massage_tolerance"]
        [::core::mem::offset_of!(anic_encode_options, massage_tolerance) - 96usize];
    ["Offset of field: anic_encode_options::attribute_error"]
        [::core::mem::offset_of!(anic_encode_options, attribute_error) - 104usize];
    ["Offset of field: anic_encode_options::normal_error"]
        [::core::mem::offset_of!(anic_encode_options, normal_error) - 112usize];
    ["Offset of field: anic_encode_options::progress"]
        [::core::mem::offset_of!(anic_encode_options, progress) - 120usize];
    ["Offset of field: anic_encode_options::writer"][::core::mem::offset_of!(anic_encode_options, writer) - 136usize];
    ["Offset of field: anic_encode_options::metadata"]
        [::core::mem::offset_of!(anic_encode_options, metadata) - 152usize];
};
#[repr(C)]
pub struct anic_encoding {
    pub struct_size: usize,
    pub file: *const ::core::ffi::c_void,
    pub size: usize,
    pub max_error: f64,
    pub rmse: f64,
    pub kg: f64,
    pub diagonal: f64,
    pub surface_error: f64,
    pub components: u32,
    pub basis: anic_basis_kind,
    pub massaged: u8,
    pub max_displacement_error: f64,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_encoding"][::core::mem::size_of::<anic_encoding>() - 88usize];
    ["Alignment of anic_encoding"][::core::mem::align_of::<anic_encoding>() - 8usize];
    ["Offset of field: anic_encoding::struct_size"][::core::mem::offset_of!(anic_encoding, struct_size) - 0usize];
    ["Offset of field: anic_encoding::file"][::core::mem::offset_of!(anic_encoding, file) - 8usize];
    ["Offset of field: anic_encoding::size"][::core::mem::offset_of!(anic_encoding, size) - 16usize];
    ["Offset of field: anic_encoding::max_error"][::core::mem::offset_of!(anic_encoding, max_error) - 24usize];
    ["Offset of field: anic_encoding::rmse"][::core::mem::offset_of!(anic_encoding, rmse) - 32usize];
    ["Offset of field: anic_encoding::kg"][::core::mem::offset_of!(anic_encoding, kg) - 40usize];
    ["Offset of field: anic_encoding::diagonal"][::core::mem::offset_of!(anic_encoding, diagonal) - 48usize];
    ["Offset of field: anic_encoding::surface_error"][::core::mem::offset_of!(anic_encoding, surface_error) - 56usize];
    ["Offset of field: anic_encoding::components"][::core::mem::offset_of!(anic_encoding, components) - 64usize];
    ["Offset of field: anic_encoding::basis"][::core::mem::offset_of!(anic_encoding, basis) - 68usize];
    ["Offset of field: anic_encoding::massaged"][::core::mem::offset_of!(anic_encoding, massaged) - 72usize];
    ["Offset of field: anic_encoding::max_displacement_error"]
        [::core::mem::offset_of!(anic_encoding, max_displacement_error) - 80usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_live {
    _unused: [u8; 0],
}
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_live_options {
    pub struct_size: usize,
    pub piece_seconds: f64,
    pub key_seconds: f64,
    pub box_: f64,
    pub most_waiting_frames: u64,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_live_options"][::core::mem::size_of::<anic_live_options>() - 40usize];
    ["Alignment of anic_live_options"][::core::mem::align_of::<anic_live_options>() - 8usize];
    ["Offset of field: anic_live_options::struct_size"]
        [::core::mem::offset_of!(anic_live_options, struct_size) - 0usize];
    ["Offset of field: anic_live_options::piece_seconds"]
        [::core::mem::offset_of!(anic_live_options, piece_seconds) - 8usize];
    ["Offset of field: anic_live_options::key_seconds"]
        [::core::mem::offset_of!(anic_live_options, key_seconds) - 16usize];
    ["Offset of field: anic_live_options::box_"][::core::mem::offset_of!(anic_live_options, box_) - 24usize];
    ["Offset of field: anic_live_options::most_waiting_frames"]
        [::core::mem::offset_of!(anic_live_options, most_waiting_frames) - 32usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_live_frame {
    pub struct_size: usize,
    pub positions: *const ::core::ffi::c_void,
    pub vertex_stride: isize,
    pub scalar: anic_scalar,
    pub value_count: u32,
    pub values: *const *const f32,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_live_frame"][::core::mem::size_of::<anic_live_frame>() - 40usize];
    ["Alignment of anic_live_frame"][::core::mem::align_of::<anic_live_frame>() - 8usize];
    ["Offset of field: anic_live_frame::struct_size"][::core::mem::offset_of!(anic_live_frame, struct_size) - 0usize];
    ["Offset of field: anic_live_frame::positions"][::core::mem::offset_of!(anic_live_frame, positions) - 8usize];
    ["Offset of field: anic_live_frame::vertex_stride"]
        [::core::mem::offset_of!(anic_live_frame, vertex_stride) - 16usize];
    ["Offset of field: anic_live_frame::scalar"][::core::mem::offset_of!(anic_live_frame, scalar) - 24usize];
    ["Offset of field: anic_live_frame::value_count"][::core::mem::offset_of!(anic_live_frame, value_count) - 28usize];
    ["Offset of field: anic_live_frame::values"][::core::mem::offset_of!(anic_live_frame, values) - 32usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_live_piece {
    pub struct_size: usize,
    pub file: *const ::core::ffi::c_void,
    pub size: usize,
    pub first_frame: u64,
    pub start_time: f64,
    pub encode_seconds: f64,
    pub max_error: f64,
    pub rmse: f64,
    pub kg: f64,
    pub frame_count: u32,
    pub key: u8,
    pub has_mesh: u8,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_live_piece"][::core::mem::size_of::<anic_live_piece>() - 80usize];
    ["Alignment of anic_live_piece"][::core::mem::align_of::<anic_live_piece>() - 8usize];
    ["Offset of field: anic_live_piece::struct_size"][::core::mem::offset_of!(anic_live_piece, struct_size) - 0usize];
    ["Offset of field: anic_live_piece::file"][::core::mem::offset_of!(anic_live_piece, file) - 8usize];
    ["Offset of field: anic_live_piece::size"][::core::mem::offset_of!(anic_live_piece, size) - 16usize];
    ["Offset of field: anic_live_piece::first_frame"][::core::mem::offset_of!(anic_live_piece, first_frame) - 24usize];
    ["Offset of field: anic_live_piece::start_time"][::core::mem::offset_of!(anic_live_piece, start_time) - 32usize];
    ["Offset of field: anic_live_piece::encode_seconds"]
        [::core::mem::offset_of!(anic_live_piece, encode_seconds) - 40usize];
    ["Offset of field: anic_live_piece::max_error"][::core::mem::offset_of!(anic_live_piece, max_error) - 48usize];
    ["Offset of field: anic_live_piece::rmse"][::core::mem::offset_of!(anic_live_piece, rmse) - 56usize];
    ["Offset of field: anic_live_piece::kg"][::core::mem::offset_of!(anic_live_piece, kg) - 64usize];
    ["Offset of field: anic_live_piece::frame_count"][::core::mem::offset_of!(anic_live_piece, frame_count) - 72usize];
    ["Offset of field: anic_live_piece::key"][::core::mem::offset_of!(anic_live_piece, key) - 76usize];
    ["Offset of field: anic_live_piece::has_mesh"][::core::mem::offset_of!(anic_live_piece, has_mesh) - 77usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_live_info {
    pub struct_size: usize,
    pub pushed_frames: u64,
    pub waiting_frames: u64,
    pub late_frames: u64,
    pub waiting_pieces: u64,
    pub encode_seconds: f64,
    pub piece_frames: u32,
    pub ended: u8,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_live_info"][::core::mem::size_of::<anic_live_info>() - 56usize];
    ["Alignment of anic_live_info"][::core::mem::align_of::<anic_live_info>() - 8usize];
    ["Offset of field: anic_live_info::struct_size"][::core::mem::offset_of!(anic_live_info, struct_size) - 0usize];
    ["Offset of field: anic_live_info::pushed_frames"][::core::mem::offset_of!(anic_live_info, pushed_frames) - 8usize];
    ["Offset of field: anic_live_info::waiting_frames"]
        [::core::mem::offset_of!(anic_live_info, waiting_frames) - 16usize];
    ["Offset of field: anic_live_info::late_frames"][::core::mem::offset_of!(anic_live_info, late_frames) - 24usize];
    ["Offset of field: anic_live_info::waiting_pieces"]
        [::core::mem::offset_of!(anic_live_info, waiting_pieces) - 32usize];
    ["Offset of field: anic_live_info::encode_seconds"]
        [::core::mem::offset_of!(anic_live_info, encode_seconds) - 40usize];
    ["Offset of field: anic_live_info::piece_frames"][::core::mem::offset_of!(anic_live_info, piece_frames) - 48usize];
    ["Offset of field: anic_live_info::ended"][::core::mem::offset_of!(anic_live_info, ended) - 52usize];
};
unsafe extern "C" {
    pub fn anic_get_encoder_version() -> u32;
    pub fn anic_create_encoder(out: *mut *mut anic_encoder) -> anic_status;
    pub fn anic_destroy_encoder(encoder: *mut anic_encoder);
    pub fn anic_get_encoder_text(encoder: *const anic_encoder) -> *const ::core::ffi::c_char;
    pub fn anic_set_source_clip(encoder: *mut anic_encoder, clip: *const anic_source_clip) -> anic_status;
    pub fn anic_add_source_clip(encoder: *mut anic_encoder, clip: *const anic_source_clip) -> anic_status;
    pub fn anic_add_source_mesh(
        encoder: *mut anic_encoder,
        mesh: *const anic_source_mesh,
        number: *mut u32,
    ) -> anic_status;
    pub fn anic_add_source_attribute(
        encoder: *mut anic_encoder,
        mesh: u32,
        attribute: *const anic_source_attribute,
    ) -> anic_status;
    pub fn anic_encode(
        encoder: *mut anic_encoder,
        options: *const anic_encode_options,
        out: *mut anic_encoding,
    ) -> anic_status;
    pub fn anic_begin_live(
        encoder: *mut anic_encoder,
        options: *const anic_encode_options,
        live: *const anic_live_options,
        out: *mut *mut anic_live,
    ) -> anic_status;
    pub fn anic_destroy_live(live: *mut anic_live);
    pub fn anic_get_live_text() -> *const ::core::ffi::c_char;
    pub fn anic_push_live_frame(live: *mut anic_live, frame: *const anic_live_frame, wait: f64) -> anic_status;
    pub fn anic_end_live(live: *mut anic_live) -> anic_status;
    pub fn anic_take_live_piece(live: *mut anic_live, wait: f64, out: *mut anic_live_piece) -> anic_status;
    pub fn anic_get_live_info(live: *const anic_live, out: *mut anic_live_info) -> anic_status;
}

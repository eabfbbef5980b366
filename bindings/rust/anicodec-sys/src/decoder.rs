// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
// bindings/rust/bindgen wrote this.
#![allow(missing_docs, non_camel_case_types)]
pub const ANIC_VERSION_MAJOR: u32 = 1;
pub const ANIC_VERSION_MINOR: u32 = 0;
pub const ANIC_VERSION_PATCH: u32 = 0;
pub const ANIC_MAX_FRAMES: u32 = 16;
pub const ANIC_BLOCK_VERTICES: u32 = 16;
pub const ANIC_MAX_REGIONS: u32 = 8;
pub const ANIC_MAX_PARTS: u32 = 4;
pub const ANIC_STATE_FLOATS: u32 = 28;
pub const ANIC_OK: anic_status = 0;
pub const ANIC_E_ARGUMENT: anic_status = 1;
pub const ANIC_E_STATE: anic_status = 2;
pub const ANIC_E_BUFFER_SIZE: anic_status = 3;
pub const ANIC_E_FRAME_RANGE: anic_status = 4;
pub const ANIC_E_ABSENT: anic_status = 5;
pub const ANIC_E_MAGIC: anic_status = 10;
pub const ANIC_E_VERSION: anic_status = 11;
pub const ANIC_E_FEATURE: anic_status = 12;
pub const ANIC_E_TRUNCATED: anic_status = 20;
pub const ANIC_E_HEADER: anic_status = 21;
pub const ANIC_E_HEADER_CHECKSUM: anic_status = 22;
pub const ANIC_E_CHUNK_BOUNDS: anic_status = 23;
pub const ANIC_E_CHUNK_CHECKSUM: anic_status = 24;
pub const ANIC_E_CHUNK_DUPLICATE: anic_status = 25;
pub const ANIC_E_CHUNK_MISSING: anic_status = 26;
pub const ANIC_E_CHUNK_UNKNOWN: anic_status = 27;
pub const ANIC_E_TRAILING_BYTES: anic_status = 29;
pub const ANIC_E_FILE_SIZE: anic_status = 30;
pub const ANIC_E_RECORD: anic_status = 40;
pub const ANIC_E_ENTROPY: anic_status = 41;
pub const ANIC_E_ZSTD: anic_status = 42;
pub const ANIC_E_TOPOLOGY: anic_status = 43;
pub const ANIC_E_INDEX_RANGE: anic_status = 44;
pub const ANIC_E_QUANTIZER: anic_status = 45;
pub const ANIC_E_NON_FINITE: anic_status = 46;
pub const ANIC_E_DRACO: anic_status = 47;
pub const ANIC_E_SEGMENT: anic_status = 48;
pub const ANIC_E_HASH: anic_status = 49;
pub const ANIC_E_MESHES: anic_status = 50;
pub const ANIC_E_SEGMENT_MISSING: anic_status = 51;
pub const ANIC_E_LIMIT: anic_status = 60;
pub const ANIC_E_MEMORY: anic_status = 70;
pub const ANIC_E_READ: anic_status = 71;
pub const ANIC_E_CANCELLED: anic_status = 72;
pub const ANIC_E_INTERNAL: anic_status = 90;
pub type anic_status = i32;
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_failure {
    pub struct_size: usize,
    pub status: anic_status,
    pub chunk: [::core::ffi::c_char; 8usize],
    pub offset: u64,
    pub detail: *const ::core::ffi::c_char,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_failure"][::core::mem::size_of::<anic_failure>() - 40usize];
    ["Alignment of anic_failure"][::core::mem::align_of::<anic_failure>() - 8usize];
    ["Offset of field: anic_failure::struct_size"][::core::mem::offset_of!(anic_failure, struct_size) - 0usize];
    ["Offset of field: anic_failure::status"][::core::mem::offset_of!(anic_failure, status) - 8usize];
    ["Offset of field: anic_failure::chunk"][::core::mem::offset_of!(anic_failure, chunk) - 12usize];
    ["Offset of field: anic_failure::offset"][::core::mem::offset_of!(anic_failure, offset) - 24usize];
    ["Offset of field: anic_failure::detail"][::core::mem::offset_of!(anic_failure, detail) - 32usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_allocator {
    pub user: *mut ::core::ffi::c_void,
    pub allocate: ::core::option::Option<
        unsafe extern "C" fn(user: *mut ::core::ffi::c_void, size: usize, alignment: usize) -> *mut ::core::ffi::c_void,
    >,
    pub release: ::core::option::Option<
        unsafe extern "C" fn(user: *mut ::core::ffi::c_void, memory: *mut ::core::ffi::c_void, size: usize),
    >,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_allocator"][::core::mem::size_of::<anic_allocator>() - 24usize];
    ["Alignment of anic_allocator"][::core::mem::align_of::<anic_allocator>() - 8usize];
    ["Offset of field: anic_allocator::user"][::core::mem::offset_of!(anic_allocator, user) - 0usize];
    ["Offset of field: anic_allocator::allocate"][::core::mem::offset_of!(anic_allocator, allocate) - 8usize];
    ["Offset of field: anic_allocator::release"][::core::mem::offset_of!(anic_allocator, release) - 16usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_threads {
    pub user: *mut ::core::ffi::c_void,
    pub run: ::core::option::Option<
        unsafe extern "C" fn(
            user: *mut ::core::ffi::c_void,
            count: usize,
            body: ::core::option::Option<unsafe extern "C" fn(context: *mut ::core::ffi::c_void, i: usize)>,
            context: *mut ::core::ffi::c_void,
        ),
    >,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_threads"][::core::mem::size_of::<anic_threads>() - 16usize];
    ["Alignment of anic_threads"][::core::mem::align_of::<anic_threads>() - 8usize];
    ["Offset of field: anic_threads::user"][::core::mem::offset_of!(anic_threads, user) - 0usize];
    ["Offset of field: anic_threads::run"][::core::mem::offset_of!(anic_threads, run) - 8usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_progress {
    pub user: *mut ::core::ffi::c_void,
    pub report:
        ::core::option::Option<unsafe extern "C" fn(user: *mut ::core::ffi::c_void, done: f64) -> ::core::ffi::c_int>,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_progress"][::core::mem::size_of::<anic_progress>() - 16usize];
    ["Alignment of anic_progress"][::core::mem::align_of::<anic_progress>() - 8usize];
    ["Offset of field: anic_progress::user"][::core::mem::offset_of!(anic_progress, user) - 0usize];
    ["Offset of field: anic_progress::report"][::core::mem::offset_of!(anic_progress, report) - 8usize];
};
pub const ANIC_OPEN_BOUNDS: _bindgen_ty_1 = 1;
pub const ANIC_OPEN_ANY_ORDER: _bindgen_ty_1 = 2;
pub const ANIC_OPEN_IN_PLACE: _bindgen_ty_1 = 4;
pub const ANIC_OPEN_INEXACT: _bindgen_ty_1 = 8;
pub type _bindgen_ty_1 = ::core::ffi::c_uint;
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_options {
    pub struct_size: usize,
    pub max_vertices: u64,
    pub max_frames: u64,
    pub max_components: u64,
    pub max_bytes: u64,
    pub allocator: anic_allocator,
    pub threads: anic_threads,
    pub progress: anic_progress,
    pub quality: f64,
    pub flags: u64,
    pub clips: *const *const ::core::ffi::c_char,
    pub clip_count: u32,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_options"][::core::mem::size_of::<anic_options>() - 128usize];
    ["Alignment of anic_options"][::core::mem::align_of::<anic_options>() - 8usize];
    ["Offset of field: anic_options::struct_size"][::core::mem::offset_of!(anic_options, struct_size) - 0usize];
    ["Offset of field: anic_options::max_vertices"][::core::mem::offset_of!(anic_options, max_vertices) - 8usize];
    ["Offset of field: anic_options::max_frames"][::core::mem::offset_of!(anic_options, max_frames) - 16usize];
    ["Offset of field: anic_options::max_components"][::core::mem::offset_of!(anic_options, max_components) - 24usize];
    ["Offset of field: anic_options::max_bytes"][::core::mem::offset_of!(anic_options, max_bytes) - 32usize];
    ["Offset of field: anic_options::allocator"][::core::mem::offset_of!(anic_options, allocator) - 40usize];
    ["Offset of field: anic_options::threads"][::core::mem::offset_of!(anic_options, threads) - 64usize];
    ["Offset of field: anic_options::progress"][::core::mem::offset_of!(anic_options, progress) - 80usize];
    ["Offset of field: anic_options::quality"][::core::mem::offset_of!(anic_options, quality) - 96usize];
    ["Offset of field: anic_options::flags"][::core::mem::offset_of!(anic_options, flags) - 104usize];
    ["Offset of field: anic_options::clips"][::core::mem::offset_of!(anic_options, clips) - 112usize];
    ["Offset of field: anic_options::clip_count"][::core::mem::offset_of!(anic_options, clip_count) - 120usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_requirements {
    pub struct_size: usize,
    pub head_bytes: u64,
    pub file_bytes: u64,
    pub resident_bytes: u64,
    pub opening_bytes: u64,
    pub draco_bytes: u64,
    pub block_bytes: u64,
    pub context_bytes: u64,
    pub mesh_count: u32,
    pub segment_count: u32,
    pub frame_count: u32,
    pub max_vertices: u32,
    pub max_components: u32,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_requirements"][::core::mem::size_of::<anic_requirements>() - 88usize];
    ["Alignment of anic_requirements"][::core::mem::align_of::<anic_requirements>() - 8usize];
    ["Offset of field: anic_requirements::struct_size"]
        [::core::mem::offset_of!(anic_requirements, struct_size) - 0usize];
    ["Offset of field: anic_requirements::head_bytes"][::core::mem::offset_of!(anic_requirements, head_bytes) - 8usize];
    ["Offset of field: anic_requirements::file_bytes"]
        [::core::mem::offset_of!(anic_requirements, file_bytes) - 16usize];
    ["Offset of field: anic_requirements::resident_bytes"]
        [::core::mem::offset_of!(anic_requirements, resident_bytes) - 24usize];
    ["Offset of field: anic_requirements::opening_bytes"]
        [::core::mem::offset_of!(anic_requirements, opening_bytes) - 32usize];
    ["Offset of field: anic_requirements::draco_bytes"]
        [::core::mem::offset_of!(anic_requirements, draco_bytes) - 40usize];
    ["Offset of field: anic_requirements::block_bytes"]
        [::core::mem::offset_of!(anic_requirements, block_bytes) - 48usize];
    ["Offset of field: anic_requirements::context_bytes"]
        [::core::mem::offset_of!(anic_requirements, context_bytes) - 56usize];
    ["Offset of field: anic_requirements::mesh_count"]
        [::core::mem::offset_of!(anic_requirements, mesh_count) - 64usize];
    ["Offset of field: anic_requirements::segment_count"]
        [::core::mem::offset_of!(anic_requirements, segment_count) - 68usize];
    ["Offset of field: anic_requirements::frame_count"]
        [::core::mem::offset_of!(anic_requirements, frame_count) - 72usize];
    ["Offset of field: anic_requirements::max_vertices"]
        [::core::mem::offset_of!(anic_requirements, max_vertices) - 76usize];
    ["Offset of field: anic_requirements::max_components"]
        [::core::mem::offset_of!(anic_requirements, max_components) - 80usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_box {
    pub min: [f32; 3usize],
    pub max: [f32; 3usize],
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_box"][::core::mem::size_of::<anic_box>() - 24usize];
    ["Alignment of anic_box"][::core::mem::align_of::<anic_box>() - 4usize];
    ["Offset of field: anic_box::min"][::core::mem::offset_of!(anic_box, min) - 0usize];
    ["Offset of field: anic_box::max"][::core::mem::offset_of!(anic_box, max) - 12usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_asset {
    _unused: [u8; 0],
}
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_reader {
    pub user: *mut ::core::ffi::c_void,
    pub read: ::core::option::Option<
        unsafe extern "C" fn(
            user: *mut ::core::ffi::c_void,
            offset: u64,
            to: *mut ::core::ffi::c_void,
            size: usize,
        ) -> ::core::ffi::c_int,
    >,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_reader"][::core::mem::size_of::<anic_reader>() - 16usize];
    ["Alignment of anic_reader"][::core::mem::align_of::<anic_reader>() - 8usize];
    ["Offset of field: anic_reader::user"][::core::mem::offset_of!(anic_reader, user) - 0usize];
    ["Offset of field: anic_reader::read"][::core::mem::offset_of!(anic_reader, read) - 8usize];
};
pub const ANIC_UP_UNKNOWN: anic_up_axis = 0;
pub const ANIC_UP_Y: anic_up_axis = 1;
pub const ANIC_UP_Z: anic_up_axis = 2;
pub type anic_up_axis = i32;
pub const ANIC_ORDER_VERTICES: anic_order = 0;
pub const ANIC_ORDER_FREE: anic_order = 1;
pub const ANIC_ORDER_ALL: anic_order = 2;
pub type anic_order = i32;
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_asset_info {
    pub struct_size: usize,
    pub name: *const ::core::ffi::c_char,
    pub encoder: *const ::core::ffi::c_char,
    pub mesh_count: u32,
    pub segment_count: u32,
    pub frame_count: u32,
    pub rate_numerator: u32,
    pub rate_denominator: u32,
    pub up: anic_up_axis,
    pub order: anic_order,
    pub rate_assumed: u8,
    pub uneven: u8,
    pub loop_: u8,
    pub closed: u8,
    pub massaged: u8,
    pub partial: u8,
    pub start_time: f64,
    pub duration: f64,
    pub loop_duration: f64,
    pub metres_per_unit: f64,
    pub diagonal: f64,
    pub max_error: f64,
    pub rmse: f64,
    pub kg: f64,
    pub surface_error: f64,
    pub surface_error_mean: f64,
    pub resident_bytes: u64,
    pub context_bytes: u64,
    pub max_displacement_error: f64,
    pub origin: [f64; 3usize],
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_asset_info"][::core::mem::size_of::<anic_asset_info>() - 192usize];
    ["Alignment of anic_asset_info"][::core::mem::align_of::<anic_asset_info>() - 8usize];
    ["Offset of field: anic_asset_info::struct_size"][::core::mem::offset_of!(anic_asset_info, struct_size) - 0usize];
    ["Offset of field: anic_asset_info::name"][::core::mem::offset_of!(anic_asset_info, name) - 8usize];
    ["Offset of field: anic_asset_info::encoder"][::core::mem::offset_of!(anic_asset_info, encoder) - 16usize];
    ["Offset of field: anic_asset_info::mesh_count"][::core::mem::offset_of!(anic_asset_info, mesh_count) - 24usize];
    ["Offset of field: anic_asset_info::segment_count"]
        [::core::mem::offset_of!(anic_asset_info, segment_count) - 28usize];
    ["Offset of field: anic_asset_info::frame_count"][::core::mem::offset_of!(anic_asset_info, frame_count) - 32usize];
    ["Offset of field: anic_asset_info::rate_numerator"]
        [::core::mem::offset_of!(anic_asset_info, rate_numerator) - 36usize];
    ["Offset of field: anic_asset_info::rate_denominator"]
        [::core::mem::offset_of!(anic_asset_info, rate_denominator) - 40usize];
    ["Offset of field: anic_asset_info::up"][::core::mem::offset_of!(anic_asset_info, up) - 44usize];
    ["Offset of field: anic_asset_info::order"][::core::mem::offset_of!(anic_asset_info, order) - 48usize];
    ["Offset of field: anic_asset_info::rate_assumed"]
        [::core::mem::offset_of!(anic_asset_info, rate_assumed) - 52usize];
    ["Offset of field: anic_asset_info::uneven"][::core::mem::offset_of!(anic_asset_info, uneven) - 53usize];
    ["Offset of field: anic_asset_info::loop_"][::core::mem::offset_of!(anic_asset_info, loop_) - 54usize];
    ["Offset of field: anic_asset_info::closed"][::core::mem::offset_of!(anic_asset_info, closed) - 55usize];
    ["Offset of field: anic_asset_info::massaged"][::core::mem::offset_of!(anic_asset_info, massaged) - 56usize];
    ["Offset of field: anic_asset_info::partial"][::core::mem::offset_of!(anic_asset_info, partial) - 57usize];
    ["Offset of field: anic_asset_info::start_time"][::core::mem::offset_of!(anic_asset_info, start_time) - 64usize];
    ["Offset of field: anic_asset_info::duration"][::core::mem::offset_of!(anic_asset_info, duration) - 72usize];
    ["Offset of field: anic_asset_info::loop_duration"]
        [::core::mem::offset_of!(anic_asset_info, loop_duration) - 80usize];
    ["Offset of field: anic_asset_info::metres_per_unit"]
        [::core::mem::offset_of!(anic_asset_info, metres_per_unit) - 88usize];
    ["Offset of field: anic_asset_info::diagonal"][::core::mem::offset_of!(anic_asset_info, diagonal) - 96usize];
    ["Offset of field: anic_asset_info::max_error"][::core::mem::offset_of!(anic_asset_info, max_error) - 104usize];
    ["Offset of field: anic_asset_info::rmse"][::core::mem::offset_of!(anic_asset_info, rmse) - 112usize];
    ["Offset of field: anic_asset_info::kg"][::core::mem::offset_of!(anic_asset_info, kg) - 120usize];
    ["Offset of field: anic_asset_info::surface_error"]
        [::core::mem::offset_of!(anic_asset_info, surface_error) - 128usize];
    ["Offset of field: anic_asset_info::surface_error_mean"]
        [::core::mem::offset_of!(anic_asset_info, surface_error_mean) - 136usize];
    ["Offset of field: anic_asset_info::resident_bytes"]
        [::core::mem::offset_of!(anic_asset_info, resident_bytes) - 144usize];
    ["Offset of field: anic_asset_info::context_bytes"]
        [::core::mem::offset_of!(anic_asset_info, context_bytes) - 152usize];
    ["Offset of field: anic_asset_info::max_displacement_error"]
        [::core::mem::offset_of!(anic_asset_info, max_displacement_error) - 160usize];
    ["Offset of field: anic_asset_info::origin"][::core::mem::offset_of!(anic_asset_info, origin) - 168usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_clip {
    pub struct_size: usize,
    pub name: *const ::core::ffi::c_char,
    pub first_frame: u32,
    pub frame_count: u32,
    pub rate_numerator: u32,
    pub rate_denominator: u32,
    pub rate_assumed: u8,
    pub uneven: u8,
    pub loop_: u8,
    pub closed: u8,
    pub massaged: u8,
    pub open: u8,
    pub start_time: f64,
    pub duration: f64,
    pub loop_duration: f64,
    pub diagonal: f64,
    pub max_error: f64,
    pub rmse: f64,
    pub kg: f64,
    pub surface_error: f64,
    pub surface_error_mean: f64,
    pub max_displacement_error: f64,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_clip"][::core::mem::size_of::<anic_clip>() - 120usize];
    ["Alignment of anic_clip"][::core::mem::align_of::<anic_clip>() - 8usize];
    ["Offset of field: anic_clip::struct_size"][::core::mem::offset_of!(anic_clip, struct_size) - 0usize];
    ["Offset of field: anic_clip::name"][::core::mem::offset_of!(anic_clip, name) - 8usize];
    ["Offset of field: anic_clip::first_frame"][::core::mem::offset_of!(anic_clip, first_frame) - 16usize];
    ["Offset of field: anic_clip::frame_count"][::core::mem::offset_of!(anic_clip, frame_count) - 20usize];
    ["Offset of field: anic_clip::rate_numerator"][::core::mem::offset_of!(anic_clip, rate_numerator) - 24usize];
    ["Offset of field: anic_clip::rate_denominator"][::core::mem::offset_of!(anic_clip, rate_denominator) - 28usize];
    ["Offset of field: anic_clip::rate_assumed"][::core::mem::offset_of!(anic_clip, rate_assumed) - 32usize];
    ["Offset of field: anic_clip::uneven"][::core::mem::offset_of!(anic_clip, uneven) - 33usize];
    ["Offset of field: anic_clip::loop_"][::core::mem::offset_of!(anic_clip, loop_) - 34usize];
    ["Offset of field: anic_clip::closed"][::core::mem::offset_of!(anic_clip, closed) - 35usize];
    ["Offset of field: anic_clip::massaged"][::core::mem::offset_of!(anic_clip, massaged) - 36usize];
    ["Offset of field: anic_clip::open"][::core::mem::offset_of!(anic_clip, open) - 37usize];
    ["Offset of field: anic_clip::start_time"][::core::mem::offset_of!(anic_clip, start_time) - 40usize];
    ["Offset of field: anic_clip::duration"][::core::mem::offset_of!(anic_clip, duration) - 48usize];
    ["Offset of field: anic_clip::loop_duration"][::core::mem::offset_of!(anic_clip, loop_duration) - 56usize];
    ["Offset of field: anic_clip::diagonal"][::core::mem::offset_of!(anic_clip, diagonal) - 64usize];
    ["Offset of field: anic_clip::max_error"][::core::mem::offset_of!(anic_clip, max_error) - 72usize];
    ["Offset of field: anic_clip::rmse"][::core::mem::offset_of!(anic_clip, rmse) - 80usize];
    ["Offset of field: anic_clip::kg"][::core::mem::offset_of!(anic_clip, kg) - 88usize];
    ["Offset of field: anic_clip::surface_error"][::core::mem::offset_of!(anic_clip, surface_error) - 96usize];
    ["Offset of field: anic_clip::surface_error_mean"]
        [::core::mem::offset_of!(anic_clip, surface_error_mean) - 104usize];
    ["Offset of field: anic_clip::max_displacement_error"]
        [::core::mem::offset_of!(anic_clip, max_displacement_error) - 112usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_event {
    pub struct_size: usize,
    pub name: *const ::core::ffi::c_char,
    pub seconds: f64,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_event"][::core::mem::size_of::<anic_event>() - 24usize];
    ["Alignment of anic_event"][::core::mem::align_of::<anic_event>() - 8usize];
    ["Offset of field: anic_event::struct_size"][::core::mem::offset_of!(anic_event, struct_size) - 0usize];
    ["Offset of field: anic_event::name"][::core::mem::offset_of!(anic_event, name) - 8usize];
    ["Offset of field: anic_event::seconds"][::core::mem::offset_of!(anic_event, seconds) - 16usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_mesh {
    pub struct_size: usize,
    pub name: *const ::core::ffi::c_char,
    pub vertex_count: u32,
    pub coded_vertex_count: u32,
    pub polygon_count: u32,
    pub corner_count: u32,
    pub triangle_count: u32,
    pub attribute_count: u32,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_mesh"][::core::mem::size_of::<anic_mesh>() - 40usize];
    ["Alignment of anic_mesh"][::core::mem::align_of::<anic_mesh>() - 8usize];
    ["Offset of field: anic_mesh::struct_size"][::core::mem::offset_of!(anic_mesh, struct_size) - 0usize];
    ["Offset of field: anic_mesh::name"][::core::mem::offset_of!(anic_mesh, name) - 8usize];
    ["Offset of field: anic_mesh::vertex_count"][::core::mem::offset_of!(anic_mesh, vertex_count) - 16usize];
    ["Offset of field: anic_mesh::coded_vertex_count"]
        [::core::mem::offset_of!(anic_mesh, coded_vertex_count) - 20usize];
    ["Offset of field: anic_mesh::polygon_count"][::core::mem::offset_of!(anic_mesh, polygon_count) - 24usize];
    ["Offset of field: anic_mesh::corner_count"][::core::mem::offset_of!(anic_mesh, corner_count) - 28usize];
    ["Offset of field: anic_mesh::triangle_count"][::core::mem::offset_of!(anic_mesh, triangle_count) - 32usize];
    ["Offset of field: anic_mesh::attribute_count"][::core::mem::offset_of!(anic_mesh, attribute_count) - 36usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_polygons {
    pub struct_size: usize,
    pub offsets: *const u32,
    pub corners: *const u32,
    pub polygon_count: u32,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_polygons"][::core::mem::size_of::<anic_polygons>() - 32usize];
    ["Alignment of anic_polygons"][::core::mem::align_of::<anic_polygons>() - 8usize];
    ["Offset of field: anic_polygons::struct_size"][::core::mem::offset_of!(anic_polygons, struct_size) - 0usize];
    ["Offset of field: anic_polygons::offsets"][::core::mem::offset_of!(anic_polygons, offsets) - 8usize];
    ["Offset of field: anic_polygons::corners"][::core::mem::offset_of!(anic_polygons, corners) - 16usize];
    ["Offset of field: anic_polygons::polygon_count"][::core::mem::offset_of!(anic_polygons, polygon_count) - 24usize];
};
pub const ANIC_ATTRIBUTE_UV: anic_attribute_kind = 0;
pub const ANIC_ATTRIBUTE_NORMAL: anic_attribute_kind = 1;
pub const ANIC_ATTRIBUTE_TANGENT: anic_attribute_kind = 2;
pub const ANIC_ATTRIBUTE_COLOUR: anic_attribute_kind = 3;
pub const ANIC_ATTRIBUTE_CUSTOM: anic_attribute_kind = 4;
pub const ANIC_ATTRIBUTE_MATERIAL: anic_attribute_kind = 5;
pub const ANIC_ATTRIBUTE_PART: anic_attribute_kind = 6;
pub type anic_attribute_kind = i32;
pub const ANIC_DOMAIN_VERTICES: anic_domain = 0;
pub const ANIC_DOMAIN_CORNERS: anic_domain = 1;
pub const ANIC_DOMAIN_POLYGONS: anic_domain = 2;
pub type anic_domain = i32;
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_attribute {
    pub struct_size: usize,
    pub name: *const ::core::ffi::c_char,
    pub kind: anic_attribute_kind,
    pub domain: anic_domain,
    pub count: u32,
    pub components: u32,
    pub values: *const f32,
    pub labels: *const u32,
    pub label_count: u32,
    pub moves: u8,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_attribute"][::core::mem::size_of::<anic_attribute>() - 56usize];
    ["Alignment of anic_attribute"][::core::mem::align_of::<anic_attribute>() - 8usize];
    ["Offset of field: anic_attribute::struct_size"][::core::mem::offset_of!(anic_attribute, struct_size) - 0usize];
    ["Offset of field: anic_attribute::name"][::core::mem::offset_of!(anic_attribute, name) - 8usize];
    ["Offset of field: anic_attribute::kind"][::core::mem::offset_of!(anic_attribute, kind) - 16usize];
    ["Offset of field: anic_attribute::domain"][::core::mem::offset_of!(anic_attribute, domain) - 20usize];
    ["Offset of field: anic_attribute::count"][::core::mem::offset_of!(anic_attribute, count) - 24usize];
    ["Offset of field: anic_attribute::components"][::core::mem::offset_of!(anic_attribute, components) - 28usize];
    ["Offset of field: anic_attribute::values"][::core::mem::offset_of!(anic_attribute, values) - 32usize];
    ["Offset of field: anic_attribute::labels"][::core::mem::offset_of!(anic_attribute, labels) - 40usize];
    ["Offset of field: anic_attribute::label_count"][::core::mem::offset_of!(anic_attribute, label_count) - 48usize];
    ["Offset of field: anic_attribute::moves"][::core::mem::offset_of!(anic_attribute, moves) - 52usize];
};
pub const ANIC_ALPHA_OPAQUE: anic_alpha = 0;
pub const ANIC_ALPHA_MASK: anic_alpha = 1;
pub const ANIC_ALPHA_BLEND: anic_alpha = 2;
pub type anic_alpha = i32;
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_material {
    pub struct_size: usize,
    pub name: *const ::core::ffi::c_char,
    pub base_colour: [f32; 4usize],
    pub metallic: f32,
    pub roughness: f32,
    pub emissive: [f32; 3usize],
    pub alpha: anic_alpha,
    pub alpha_cutoff: f32,
    pub double_sided: u8,
    pub base_colour_texture: *const ::core::ffi::c_char,
    pub metallic_roughness_texture: *const ::core::ffi::c_char,
    pub normal_texture: *const ::core::ffi::c_char,
    pub occlusion_texture: *const ::core::ffi::c_char,
    pub emissive_texture: *const ::core::ffi::c_char,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_material"][::core::mem::size_of::<anic_material>() - 104usize];
    ["Alignment of anic_material"][::core::mem::align_of::<anic_material>() - 8usize];
    ["Offset of field: anic_material::struct_size"][::core::mem::offset_of!(anic_material, struct_size) - 0usize];
    ["Offset of field: anic_material::name"][::core::mem::offset_of!(anic_material, name) - 8usize];
    ["Offset of field: anic_material::base_colour"][::core::mem::offset_of!(anic_material, base_colour) - 16usize];
    ["Offset of field: anic_material::metallic"][::core::mem::offset_of!(anic_material, metallic) - 32usize];
    ["Offset of field: anic_material::roughness"][::core::mem::offset_of!(anic_material, roughness) - 36usize];
    ["Offset of field: anic_material::emissive"][::core::mem::offset_of!(anic_material, emissive) - 40usize];
    ["Offset of field: anic_material::alpha"][::core::mem::offset_of!(anic_material, alpha) - 52usize];
    ["Offset of field: anic_material::alpha_cutoff"][::core::mem::offset_of!(anic_material, alpha_cutoff) - 56usize];
    ["Offset of field: anic_material::double_sided"][::core::mem::offset_of!(anic_material, double_sided) - 60usize];
    ["Offset of field: anic_material::base_colour_texture"]
        [::core::mem::offset_of!(anic_material, base_colour_texture) - 64usize];
    ["Offset of field: anic_material::metallic_roughness_texture"]
        [::core::mem::offset_of!(anic_material, metallic_roughness_texture) - 72usize];
    ["Offset of field: anic_material::normal_texture"]
        [::core::mem::offset_of!(anic_material, normal_texture) - 80usize];
    ["Offset of field: anic_material::occlusion_texture"]
        [::core::mem::offset_of!(anic_material, occlusion_texture) - 88usize];
    ["Offset of field: anic_material::emissive_texture"]
        [::core::mem::offset_of!(anic_material, emissive_texture) - 96usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_context {
    _unused: [u8; 0],
}
pub const ANIC_SAMPLE_STEP: anic_sampling = 0;
pub const ANIC_SAMPLE_LINEAR: anic_sampling = 1;
pub const ANIC_SAMPLE_CUBIC: anic_sampling = 2;
pub type anic_sampling = i32;
pub const ANIC_WRAP_CLAMP: anic_wrap = 0;
pub const ANIC_WRAP_LOOP: anic_wrap = 1;
pub const ANIC_WRAP_PING_PONG: anic_wrap = 2;
pub type anic_wrap = i32;
pub const ANIC_WHEN_CURRENT: anic_when = 0;
pub const ANIC_WHEN_PREVIOUS: anic_when = 1;
pub type anic_when = i32;
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_root_motion {
    pub struct_size: usize,
    pub moves: u8,
    pub turns: u8,
    pub turn: f64,
    pub move_: [f64; 3usize],
    pub pivot: [f64; 3usize],
    pub matrix: [f32; 12usize],
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_root_motion"][::core::mem::size_of::<anic_root_motion>() - 120usize];
    ["Alignment of anic_root_motion"][::core::mem::align_of::<anic_root_motion>() - 8usize];
    ["Offset of field: anic_root_motion::struct_size"][::core::mem::offset_of!(anic_root_motion, struct_size) - 0usize];
    ["Offset of field: anic_root_motion::moves"][::core::mem::offset_of!(anic_root_motion, moves) - 8usize];
    ["Offset of field: anic_root_motion::turns"][::core::mem::offset_of!(anic_root_motion, turns) - 9usize];
    ["Offset of field: anic_root_motion::turn"][::core::mem::offset_of!(anic_root_motion, turn) - 16usize];
    ["Offset of field: anic_root_motion::move_"][::core::mem::offset_of!(anic_root_motion, move_) - 24usize];
    ["Offset of field: anic_root_motion::pivot"][::core::mem::offset_of!(anic_root_motion, pivot) - 48usize];
    ["Offset of field: anic_root_motion::matrix"][::core::mem::offset_of!(anic_root_motion, matrix) - 72usize];
};
pub const ANIC_FORMAT_FLOAT32X3: anic_format = 0;
pub const ANIC_FORMAT_FLOAT32X4: anic_format = 1;
pub const ANIC_FORMAT_FLOAT16X3: anic_format = 2;
pub const ANIC_FORMAT_FLOAT16X4: anic_format = 3;
pub const ANIC_FORMAT_UNORM16X3: anic_format = 4;
pub const ANIC_FORMAT_UNORM16X4: anic_format = 5;
pub const ANIC_FORMAT_SNORM16X3: anic_format = 6;
pub const ANIC_FORMAT_SNORM16X4: anic_format = 7;
pub type anic_format = i32;
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_output {
    pub struct_size: usize,
    pub data: *mut ::core::ffi::c_void,
    pub size: usize,
    pub stride: usize,
    pub format: anic_format,
    pub offset: [f32; 3usize],
    pub scale: [f32; 3usize],
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_output"][::core::mem::size_of::<anic_output>() - 64usize];
    ["Alignment of anic_output"][::core::mem::align_of::<anic_output>() - 8usize];
    ["Offset of field: anic_output::struct_size"][::core::mem::offset_of!(anic_output, struct_size) - 0usize];
    ["Offset of field: anic_output::data"][::core::mem::offset_of!(anic_output, data) - 8usize];
    ["Offset of field: anic_output::size"][::core::mem::offset_of!(anic_output, size) - 16usize];
    ["Offset of field: anic_output::stride"][::core::mem::offset_of!(anic_output, stride) - 24usize];
    ["Offset of field: anic_output::format"][::core::mem::offset_of!(anic_output, format) - 32usize];
    ["Offset of field: anic_output::offset"][::core::mem::offset_of!(anic_output, offset) - 36usize];
    ["Offset of field: anic_output::scale"][::core::mem::offset_of!(anic_output, scale) - 48usize];
};
pub const ANIC_VALUE_FLOAT32: anic_value_format = 0;
pub const ANIC_VALUE_FLOAT16: anic_value_format = 1;
pub const ANIC_VALUE_UNORM8: anic_value_format = 2;
pub const ANIC_VALUE_UNORM16: anic_value_format = 3;
pub type anic_value_format = i32;
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_value_output {
    pub struct_size: usize,
    pub data: *mut ::core::ffi::c_void,
    pub size: usize,
    pub stride: usize,
    pub format: anic_value_format,
    pub components: u32,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_value_output"][::core::mem::size_of::<anic_value_output>() - 40usize];
    ["Alignment of anic_value_output"][::core::mem::align_of::<anic_value_output>() - 8usize];
    ["Offset of field: anic_value_output::struct_size"]
        [::core::mem::offset_of!(anic_value_output, struct_size) - 0usize];
    ["Offset of field: anic_value_output::data"][::core::mem::offset_of!(anic_value_output, data) - 8usize];
    ["Offset of field: anic_value_output::size"][::core::mem::offset_of!(anic_value_output, size) - 16usize];
    ["Offset of field: anic_value_output::stride"][::core::mem::offset_of!(anic_value_output, stride) - 24usize];
    ["Offset of field: anic_value_output::format"][::core::mem::offset_of!(anic_value_output, format) - 32usize];
    ["Offset of field: anic_value_output::components"]
        [::core::mem::offset_of!(anic_value_output, components) - 36usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_surface_point {
    pub vertices: [u32; 3usize],
    pub weights: [f32; 3usize],
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_surface_point"][::core::mem::size_of::<anic_surface_point>() - 24usize];
    ["Alignment of anic_surface_point"][::core::mem::align_of::<anic_surface_point>() - 4usize];
    ["Offset of field: anic_surface_point::vertices"][::core::mem::offset_of!(anic_surface_point, vertices) - 0usize];
    ["Offset of field: anic_surface_point::weights"][::core::mem::offset_of!(anic_surface_point, weights) - 12usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_surface_frame {
    pub position: [f32; 3usize],
    pub normal: [f32; 3usize],
    pub tangent: [f32; 3usize],
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_surface_frame"][::core::mem::size_of::<anic_surface_frame>() - 36usize];
    ["Alignment of anic_surface_frame"][::core::mem::align_of::<anic_surface_frame>() - 4usize];
    ["Offset of field: anic_surface_frame::position"][::core::mem::offset_of!(anic_surface_frame, position) - 0usize];
    ["Offset of field: anic_surface_frame::normal"][::core::mem::offset_of!(anic_surface_frame, normal) - 12usize];
    ["Offset of field: anic_surface_frame::tangent"][::core::mem::offset_of!(anic_surface_frame, tangent) - 24usize];
};
pub const ANIC_SIDE_ANY: anic_side = 0;
pub const ANIC_SIDE_FRONT: anic_side = 1;
pub const ANIC_SIDE_BACK: anic_side = 2;
pub type anic_side = i32;
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_ray {
    pub struct_size: usize,
    pub origin: [f32; 3usize],
    pub direction: [f32; 3usize],
    pub farthest: f32,
    pub side: anic_side,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_ray"][::core::mem::size_of::<anic_ray>() - 40usize];
    ["Alignment of anic_ray"][::core::mem::align_of::<anic_ray>() - 8usize];
    ["Offset of field: anic_ray::struct_size"][::core::mem::offset_of!(anic_ray, struct_size) - 0usize];
    ["Offset of field: anic_ray::origin"][::core::mem::offset_of!(anic_ray, origin) - 8usize];
    ["Offset of field: anic_ray::direction"][::core::mem::offset_of!(anic_ray, direction) - 20usize];
    ["Offset of field: anic_ray::farthest"][::core::mem::offset_of!(anic_ray, farthest) - 32usize];
    ["Offset of field: anic_ray::side"][::core::mem::offset_of!(anic_ray, side) - 36usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_hit {
    pub point: anic_surface_point,
    pub distance: f32,
    pub triangle: u32,
    pub side: anic_side,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_hit"][::core::mem::size_of::<anic_hit>() - 36usize];
    ["Alignment of anic_hit"][::core::mem::align_of::<anic_hit>() - 4usize];
    ["Offset of field: anic_hit::point"][::core::mem::offset_of!(anic_hit, point) - 0usize];
    ["Offset of field: anic_hit::distance"][::core::mem::offset_of!(anic_hit, distance) - 24usize];
    ["Offset of field: anic_hit::triangle"][::core::mem::offset_of!(anic_hit, triangle) - 28usize];
    ["Offset of field: anic_hit::side"][::core::mem::offset_of!(anic_hit, side) - 32usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_normal_plan {
    _unused: [u8; 0],
}
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_normal_plan_options {
    pub struct_size: usize,
    pub crease_angle: f64,
    pub reference_frame: u32,
    pub per_corner: u8,
    pub source_edges: u8,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_normal_plan_options"][::core::mem::size_of::<anic_normal_plan_options>() - 24usize];
    ["Alignment of anic_normal_plan_options"][::core::mem::align_of::<anic_normal_plan_options>() - 8usize];
    ["Offset of field: anic_normal_plan_options::struct_size"]
        [::core::mem::offset_of!(anic_normal_plan_options, struct_size) - 0usize];
    ["Offset of field: anic_normal_plan_options::crease_angle"]
        [::core::mem::offset_of!(anic_normal_plan_options, crease_angle) - 8usize];
    ["Offset of field: anic_normal_plan_options::reference_frame"]
        [::core::mem::offset_of!(anic_normal_plan_options, reference_frame) - 16usize];
    ["Offset of field: anic_normal_plan_options::per_corner"]
        [::core::mem::offset_of!(anic_normal_plan_options, per_corner) - 20usize];
    ["Offset of field: anic_normal_plan_options::source_edges"]
        [::core::mem::offset_of!(anic_normal_plan_options, source_edges) - 21usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_render_plan {
    _unused: [u8; 0],
}
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_render_plan_options {
    pub struct_size: usize,
    pub crease_angle: f64,
    pub reference_frame: u32,
    pub source_edges: u8,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_render_plan_options"][::core::mem::size_of::<anic_render_plan_options>() - 24usize];
    ["Alignment of anic_render_plan_options"][::core::mem::align_of::<anic_render_plan_options>() - 8usize];
    ["Offset of field: anic_render_plan_options::struct_size"]
        [::core::mem::offset_of!(anic_render_plan_options, struct_size) - 0usize];
    ["Offset of field: anic_render_plan_options::crease_angle"]
        [::core::mem::offset_of!(anic_render_plan_options, crease_angle) - 8usize];
    ["Offset of field: anic_render_plan_options::reference_frame"]
        [::core::mem::offset_of!(anic_render_plan_options, reference_frame) - 16usize];
    ["Offset of field: anic_render_plan_options::source_edges"]
        [::core::mem::offset_of!(anic_render_plan_options, source_edges) - 20usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_render_info {
    pub struct_size: usize,
    pub vertices: *const u32,
    pub corners: *const u32,
    pub indices: *const u32,
    pub triangle_polygons: *const u32,
    pub group_materials: *const u32,
    pub group_begin: *const u32,
    pub mesh: u32,
    pub vertex_count: u32,
    pub triangle_count: u32,
    pub group_count: u32,
    pub normal_group_count: u32,
    pub normal_groups: *const u32,
    pub normal_centres: *const u32,
    pub normal_begin: *const u32,
    pub normal_corners: *const u32,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_render_info"][::core::mem::size_of::<anic_render_info>() - 112usize];
    ["Alignment of anic_render_info"][::core::mem::align_of::<anic_render_info>() - 8usize];
    ["Offset of field: anic_render_info::struct_size"][::core::mem::offset_of!(anic_render_info, struct_size) - 0usize];
    ["Offset of field: anic_render_info::vertices"][::core::mem::offset_of!(anic_render_info, vertices) - 8usize];
    ["Offset of field: anic_render_info::corners"][::core::mem::offset_of!(anic_render_info, corners) - 16usize];
    ["Offset of field: anic_render_info::indices"][::core::mem::offset_of!(anic_render_info, indices) - 24usize];
    ["Offset of field: anic_render_info::triangle_polygons"]
        [::core::mem::offset_of!(anic_render_info, triangle_polygons) - 32usize];
    ["Offset of field: anic_render_info::group_materials"]
        [::core::mem::offset_of!(anic_render_info, group_materials) - 40usize];
    ["Offset of field: anic_render_info::group_begin"]
        [::core::mem::offset_of!(anic_render_info, group_begin) - 48usize];
    ["Offset of field: anic_render_info::mesh"][::core::mem::offset_of!(anic_render_info, mesh) - 56usize];
    ["Offset of field: anic_render_info::vertex_count"]
        [::core::mem::offset_of!(anic_render_info, vertex_count) - 60usize];
    ["Offset of field: anic_render_info::triangle_count"]
        [::core::mem::offset_of!(anic_render_info, triangle_count) - 64usize];
    ["Offset of field: anic_render_info::group_count"]
        [::core::mem::offset_of!(anic_render_info, group_count) - 68usize];
    ["Offset of field: anic_render_info::normal_group_count"]
        [::core::mem::offset_of!(anic_render_info, normal_group_count) - 72usize];
    ["Offset of field: anic_render_info::normal_groups"]
        [::core::mem::offset_of!(anic_render_info, normal_groups) - 80usize];
    ["Offset of field: anic_render_info::normal_centres"]
        [::core::mem::offset_of!(anic_render_info, normal_centres) - 88usize];
    ["Offset of field: anic_render_info::normal_begin"]
        [::core::mem::offset_of!(anic_render_info, normal_begin) - 96usize];
    ["Offset of field: anic_render_info::normal_corners"]
        [::core::mem::offset_of!(anic_render_info, normal_corners) - 104usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_morpher {
    _unused: [u8; 0],
}
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_morpher_options {
    pub struct_size: usize,
    pub max_bytes: u64,
    pub pins: *const u32,
    pub pin_count: u32,
    pub leaf_faces: u32,
    pub sweeps: u32,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_morpher_options"][::core::mem::size_of::<anic_morpher_options>() - 40usize];
    ["Alignment of anic_morpher_options"][::core::mem::align_of::<anic_morpher_options>() - 8usize];
    ["Offset of field: anic_morpher_options::struct_size"]
        [::core::mem::offset_of!(anic_morpher_options, struct_size) - 0usize];
    ["Offset of field: anic_morpher_options::max_bytes"]
        [::core::mem::offset_of!(anic_morpher_options, max_bytes) - 8usize];
    ["Offset of field: anic_morpher_options::pins"][::core::mem::offset_of!(anic_morpher_options, pins) - 16usize];
    ["Offset of field: anic_morpher_options::pin_count"]
        [::core::mem::offset_of!(anic_morpher_options, pin_count) - 24usize];
    ["Offset of field: anic_morpher_options::leaf_faces"]
        [::core::mem::offset_of!(anic_morpher_options, leaf_faces) - 28usize];
    ["Offset of field: anic_morpher_options::sweeps"][::core::mem::offset_of!(anic_morpher_options, sweeps) - 32usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_morpher_info {
    pub struct_size: usize,
    pub resident_bytes: u64,
    pub scratch_bytes: u64,
    pub largest_turn: f64,
    pub vertex_count: u32,
    pub mesh_count: u32,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_morpher_info"][::core::mem::size_of::<anic_morpher_info>() - 40usize];
    ["Alignment of anic_morpher_info"][::core::mem::align_of::<anic_morpher_info>() - 8usize];
    ["Offset of field: anic_morpher_info::struct_size"]
        [::core::mem::offset_of!(anic_morpher_info, struct_size) - 0usize];
    ["Offset of field: anic_morpher_info::resident_bytes"]
        [::core::mem::offset_of!(anic_morpher_info, resident_bytes) - 8usize];
    ["Offset of field: anic_morpher_info::scratch_bytes"]
        [::core::mem::offset_of!(anic_morpher_info, scratch_bytes) - 16usize];
    ["Offset of field: anic_morpher_info::largest_turn"]
        [::core::mem::offset_of!(anic_morpher_info, largest_turn) - 24usize];
    ["Offset of field: anic_morpher_info::vertex_count"]
        [::core::mem::offset_of!(anic_morpher_info, vertex_count) - 32usize];
    ["Offset of field: anic_morpher_info::mesh_count"]
        [::core::mem::offset_of!(anic_morpher_info, mesh_count) - 36usize];
};
pub const ANIC_BASIS_KEYFRAMES: anic_basis_kind = 0;
pub const ANIC_BASIS_EIGENSHAPES: anic_basis_kind = 1;
pub const ANIC_BASIS_EIGENTRAJECTORIES: anic_basis_kind = 2;
pub type anic_basis_kind = i32;
pub const ANIC_TARGET_POSITIONS: anic_target = 0;
pub const ANIC_TARGET_ATTRIBUTE: anic_target = 1;
pub type anic_target = i32;
pub const ANIC_RECONSTRUCTION_LINEAR: anic_reconstruction = 0;
pub const ANIC_RECONSTRUCTION_MSGI: anic_reconstruction = 1;
pub type anic_reconstruction = i32;
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_basis {
    pub struct_size: usize,
    pub kind: anic_basis_kind,
    pub reconstruction: anic_reconstruction,
    pub target: anic_target,
    pub mesh: u32,
    pub attribute: u32,
    pub first_component: u32,
    pub first_frame: u32,
    pub frame_count: u32,
    pub vertex_count: u32,
    pub components: u32,
    pub wide_components: u32,
    pub channels: u32,
    pub weight_channels: u32,
    pub origin: [f32; 3usize],
    pub pose: *const f32,
    pub wide: *const i32,
    pub narrow: *const i16,
    pub pose_count: usize,
    pub wide_count: usize,
    pub narrow_count: usize,
    pub vertex_shape: *const u32,
    pub regions: u32,
    pub vertex_region: *const u8,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_basis"][::core::mem::size_of::<anic_basis>() - 144usize];
    ["Alignment of anic_basis"][::core::mem::align_of::<anic_basis>() - 8usize];
    ["Offset of field: anic_basis::struct_size"][::core::mem::offset_of!(anic_basis, struct_size) - 0usize];
    ["Offset of field: anic_basis::kind"][::core::mem::offset_of!(anic_basis, kind) - 8usize];
    ["Offset of field: anic_basis::reconstruction"][::core::mem::offset_of!(anic_basis, reconstruction) - 12usize];
    ["Offset of field: anic_basis::target"][::core::mem::offset_of!(anic_basis, target) - 16usize];
    ["Offset of field: anic_basis::mesh"][::core::mem::offset_of!(anic_basis, mesh) - 20usize];
    ["Offset of field: anic_basis::attribute"][::core::mem::offset_of!(anic_basis, attribute) - 24usize];
    ["Offset of field: anic_basis::first_component"][::core::mem::offset_of!(anic_basis, first_component) - 28usize];
    ["Offset of field: anic_basis::first_frame"][::core::mem::offset_of!(anic_basis, first_frame) - 32usize];
    ["Offset of field: anic_basis::frame_count"][::core::mem::offset_of!(anic_basis, frame_count) - 36usize];
    ["Offset of field: anic_basis::vertex_count"][::core::mem::offset_of!(anic_basis, vertex_count) - 40usize];
    ["Offset of field: anic_basis::components"][::core::mem::offset_of!(anic_basis, components) - 44usize];
    ["Offset of field: anic_basis::wide_components"][::core::mem::offset_of!(anic_basis, wide_components) - 48usize];
    ["Offset of field: anic_basis::channels"][::core::mem::offset_of!(anic_basis, channels) - 52usize];
    ["Offset of field: anic_basis::weight_channels"][::core::mem::offset_of!(anic_basis, weight_channels) - 56usize];
    ["Offset of field: anic_basis::origin"][::core::mem::offset_of!(anic_basis, origin) - 60usize];
    ["Offset of field: anic_basis::pose"][::core::mem::offset_of!(anic_basis, pose) - 72usize];
    ["Offset of field: anic_basis::wide"][::core::mem::offset_of!(anic_basis, wide) - 80usize];
    ["Offset of field: anic_basis::narrow"][::core::mem::offset_of!(anic_basis, narrow) - 88usize];
    ["Offset of field: anic_basis::pose_count"][::core::mem::offset_of!(anic_basis, pose_count) - 96usize];
    ["Offset of field: anic_basis::wide_count"][::core::mem::offset_of!(anic_basis, wide_count) - 104usize];
    ["Offset of field: anic_basis::narrow_count"][::core::mem::offset_of!(anic_basis, narrow_count) - 112usize];
    ["Offset of field: anic_basis::vertex_shape"][::core::mem::offset_of!(anic_basis, vertex_shape) - 120usize];
    ["Offset of field: anic_basis::regions"][::core::mem::offset_of!(anic_basis, regions) - 128usize];
    ["Offset of field: anic_basis::vertex_region"][::core::mem::offset_of!(anic_basis, vertex_region) - 136usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_correction {
    pub vertex: u32,
    pub delta: [f32; 3usize],
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_correction"][::core::mem::size_of::<anic_correction>() - 16usize];
    ["Alignment of anic_correction"][::core::mem::align_of::<anic_correction>() - 4usize];
    ["Offset of field: anic_correction::vertex"][::core::mem::offset_of!(anic_correction, vertex) - 0usize];
    ["Offset of field: anic_correction::delta"][::core::mem::offset_of!(anic_correction, delta) - 4usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_part {
    pub segment: u32,
    pub share: f32,
    pub weights: *const f32,
    pub shape: *const f32,
    pub pose_map: [f32; 12usize],
    pub motion: [f32; 12usize],
    pub corrections: *const anic_correction,
    pub correction_count: u32,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_part"][::core::mem::size_of::<anic_part>() - 136usize];
    ["Alignment of anic_part"][::core::mem::align_of::<anic_part>() - 8usize];
    ["Offset of field: anic_part::segment"][::core::mem::offset_of!(anic_part, segment) - 0usize];
    ["Offset of field: anic_part::share"][::core::mem::offset_of!(anic_part, share) - 4usize];
    ["Offset of field: anic_part::weights"][::core::mem::offset_of!(anic_part, weights) - 8usize];
    ["Offset of field: anic_part::shape"][::core::mem::offset_of!(anic_part, shape) - 16usize];
    ["Offset of field: anic_part::pose_map"][::core::mem::offset_of!(anic_part, pose_map) - 24usize];
    ["Offset of field: anic_part::motion"][::core::mem::offset_of!(anic_part, motion) - 72usize];
    ["Offset of field: anic_part::corrections"][::core::mem::offset_of!(anic_part, corrections) - 120usize];
    ["Offset of field: anic_part::correction_count"][::core::mem::offset_of!(anic_part, correction_count) - 128usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_parts {
    pub struct_size: usize,
    pub count: u32,
    pub parts: [anic_part; 4usize],
    pub components: [u32; 4usize],
    pub pose_maps: [*const f32; 4usize],
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_parts"][::core::mem::size_of::<anic_parts>() - 608usize];
    ["Alignment of anic_parts"][::core::mem::align_of::<anic_parts>() - 8usize];
    ["Offset of field: anic_parts::struct_size"][::core::mem::offset_of!(anic_parts, struct_size) - 0usize];
    ["Offset of field: anic_parts::count"][::core::mem::offset_of!(anic_parts, count) - 8usize];
    ["Offset of field: anic_parts::parts"][::core::mem::offset_of!(anic_parts, parts) - 16usize];
    ["Offset of field: anic_parts::components"][::core::mem::offset_of!(anic_parts, components) - 560usize];
    ["Offset of field: anic_parts::pose_maps"][::core::mem::offset_of!(anic_parts, pose_maps) - 576usize];
};
pub const ANIC_TEXTURE_POSE: anic_texture = 0;
pub const ANIC_TEXTURE_WIDE: anic_texture = 1;
pub const ANIC_TEXTURE_NARROW: anic_texture = 2;
pub type anic_texture = i32;
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_texture_layout {
    pub struct_size: usize,
    pub width: u32,
    pub rows: u32,
    pub pose_height: u32,
    pub wide_height: u32,
    pub narrow_height: u32,
    pub state_floats: u32,
    pub regions: u32,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_texture_layout"][::core::mem::size_of::<anic_texture_layout>() - 40usize];
    ["Alignment of anic_texture_layout"][::core::mem::align_of::<anic_texture_layout>() - 8usize];
    ["Offset of field: anic_texture_layout::struct_size"]
        [::core::mem::offset_of!(anic_texture_layout, struct_size) - 0usize];
    ["Offset of field: anic_texture_layout::width"][::core::mem::offset_of!(anic_texture_layout, width) - 8usize];
    ["Offset of field: anic_texture_layout::rows"][::core::mem::offset_of!(anic_texture_layout, rows) - 12usize];
    ["Offset of field: anic_texture_layout::pose_height"]
        [::core::mem::offset_of!(anic_texture_layout, pose_height) - 16usize];
    ["Offset of field: anic_texture_layout::wide_height"]
        [::core::mem::offset_of!(anic_texture_layout, wide_height) - 20usize];
    ["Offset of field: anic_texture_layout::narrow_height"]
        [::core::mem::offset_of!(anic_texture_layout, narrow_height) - 24usize];
    ["Offset of field: anic_texture_layout::state_floats"]
        [::core::mem::offset_of!(anic_texture_layout, state_floats) - 28usize];
    ["Offset of field: anic_texture_layout::regions"][::core::mem::offset_of!(anic_texture_layout, regions) - 32usize];
};
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_stream {
    _unused: [u8; 0],
}
#[repr(C)]
#[derive(Copy, Clone)]
pub struct anic_stream_info {
    pub struct_size: usize,
    pub received_bytes: u64,
    pub file_bytes: u64,
    pub segment_count: u32,
    pub playable_segments: u32,
    pub layers: u32,
    pub arrived_layers: u32,
    pub playable: u8,
    pub complete: u8,
    pub file_number: u32,
    pub waiting_bytes: u64,
}
#[allow(clippy::unnecessary_operation, clippy::identity_op)]
#[cfg(target_pointer_width = "64")]
const _: () = {
    ["Size of anic_stream_info"][::core::mem::size_of::<anic_stream_info>() - 56usize];
    ["Alignment of anic_stream_info"][::core::mem::align_of::<anic_stream_info>() - 8usize];
    ["Offset of field: anic_stream_info::struct_size"][::core::mem::offset_of!(anic_stream_info, struct_size) - 0usize];
    ["Offset of field: anic_stream_info::received_bytes"]
        [::core::mem::offset_of!(anic_stream_info, received_bytes) - 8usize];
    ["Offset of field: anic_stream_info::file_bytes"][::core::mem::offset_of!(anic_stream_info, file_bytes) - 16usize];
    ["Offset of field: anic_stream_info::segment_count"]
        [::core::mem::offset_of!(anic_stream_info, segment_count) - 24usize];
    ["Offset of field: anic_stream_info::playable_segments"]
        [::core::mem::offset_of!(anic_stream_info, playable_segments) - 28usize];
    ["Offset of field: anic_stream_info::layers"][::core::mem::offset_of!(anic_stream_info, layers) - 32usize];
    ["Offset of field: anic_stream_info::arrived_layers"]
        [::core::mem::offset_of!(anic_stream_info, arrived_layers) - 36usize];
    ["Offset of field: anic_stream_info::playable"][::core::mem::offset_of!(anic_stream_info, playable) - 40usize];
    ["Offset of field: anic_stream_info::complete"][::core::mem::offset_of!(anic_stream_info, complete) - 41usize];
    ["Offset of field: anic_stream_info::file_number"]
        [::core::mem::offset_of!(anic_stream_info, file_number) - 44usize];
    ["Offset of field: anic_stream_info::waiting_bytes"]
        [::core::mem::offset_of!(anic_stream_info, waiting_bytes) - 48usize];
};
unsafe extern "C" {
    pub fn anic_get_version() -> u32;
    pub fn anic_get_status_text(status: anic_status) -> *const ::core::ffi::c_char;
    pub fn anic_init_block_allocator(
        block: *mut ::core::ffi::c_void,
        size: usize,
        out: *mut anic_allocator,
    ) -> anic_status;
    pub fn anic_get_requirements(
        head: *const ::core::ffi::c_void,
        size: usize,
        options: *const anic_options,
        out: *mut anic_requirements,
    ) -> anic_status;
    pub fn anic_read_metadata(
        file: *const ::core::ffi::c_void,
        size: usize,
        text: *mut *const ::core::ffi::c_char,
        text_bytes: *mut usize,
    ) -> anic_status;
    pub fn anic_read_bounds(
        file: *const ::core::ffi::c_void,
        size: usize,
        mesh: u32,
        first_frame: u32,
        frame_count: u32,
        out: *mut anic_box,
    ) -> anic_status;
    pub fn anic_open_asset(
        file: *const ::core::ffi::c_void,
        size: usize,
        options: *const anic_options,
        out: *mut *mut anic_asset,
        failure: *mut anic_failure,
    ) -> anic_status;
    pub fn anic_open_asset_from_reader(
        reader: *const anic_reader,
        file_size: u64,
        options: *const anic_options,
        out: *mut *mut anic_asset,
        failure: *mut anic_failure,
    ) -> anic_status;
    pub fn anic_share_asset(
        asset: *const anic_asset,
        options: *const anic_options,
        out: *mut *mut anic_asset,
    ) -> anic_status;
    pub fn anic_close_asset(asset: *mut anic_asset);
    pub fn anic_verify_asset(asset: *const anic_asset) -> anic_status;
    pub fn anic_get_asset_info(asset: *const anic_asset, out: *mut anic_asset_info) -> anic_status;
    pub fn anic_get_clip_count(asset: *const anic_asset) -> u32;
    pub fn anic_get_clip(asset: *const anic_asset, clip: u32, out: *mut anic_clip) -> anic_status;
    pub fn anic_find_clip(asset: *const anic_asset, name: *const ::core::ffi::c_char, out: *mut u32) -> anic_status;
    pub fn anic_get_event_count(asset: *const anic_asset, clip: u32) -> u32;
    pub fn anic_get_event(asset: *const anic_asset, clip: u32, event: u32, out: *mut anic_event) -> anic_status;
    pub fn anic_get_mesh(asset: *const anic_asset, mesh: u32, out: *mut anic_mesh) -> anic_status;
    pub fn anic_get_polygons(asset: *const anic_asset, mesh: u32, out: *mut anic_polygons) -> anic_status;
    pub fn anic_write_indices(
        asset: *const anic_asset,
        mesh: u32,
        index_bytes: u32,
        out: *mut ::core::ffi::c_void,
        size: usize,
    ) -> anic_status;
    pub fn anic_get_coded_vertices(asset: *const anic_asset, mesh: u32, out: *mut *const u32) -> anic_status;
    pub fn anic_get_attribute(
        asset: *const anic_asset,
        mesh: u32,
        attribute: u32,
        out: *mut anic_attribute,
    ) -> anic_status;
    pub fn anic_get_label_name(
        asset: *const anic_asset,
        mesh: u32,
        attribute: u32,
        label: u32,
    ) -> *const ::core::ffi::c_char;
    pub fn anic_get_material(
        asset: *const anic_asset,
        mesh: u32,
        attribute: u32,
        label: u32,
        out: *mut anic_material,
    ) -> anic_status;
    pub fn anic_get_frame_time(asset: *const anic_asset, frame: u32) -> f64;
    pub fn anic_create_context(
        asset: *const anic_asset,
        allocator: *const anic_allocator,
        out: *mut *mut anic_context,
    ) -> anic_status;
    pub fn anic_destroy_context(context: *mut anic_context);
    pub fn anic_set_clip(context: *mut anic_context, clip: u32) -> anic_status;
    pub fn anic_set_quality(context: *mut anic_context, quality: f64) -> anic_status;
    pub fn anic_seek_frame(context: *mut anic_context, frame: u32) -> anic_status;
    pub fn anic_seek_time(
        context: *mut anic_context,
        seconds: f64,
        sampling: anic_sampling,
        wrap: anic_wrap,
    ) -> anic_status;
    pub fn anic_blend(
        context: *mut anic_context,
        clip: u32,
        seconds: f64,
        sampling: anic_sampling,
        wrap: anic_wrap,
        weight: f64,
    ) -> anic_status;
    pub fn anic_forget_previous(context: *mut anic_context) -> anic_status;
    pub fn anic_get_root_motion(
        asset: *const anic_asset,
        clip: u32,
        seconds: f64,
        sampling: anic_sampling,
        wrap: anic_wrap,
        out: *mut anic_root_motion,
    ) -> anic_status;
    pub fn anic_get_root_step(
        asset: *const anic_asset,
        clip: u32,
        from: f64,
        to: f64,
        sampling: anic_sampling,
        wrap: anic_wrap,
        out: *mut anic_root_motion,
    ) -> anic_status;
    pub fn anic_get_shown_root_motion(
        context: *const anic_context,
        when: anic_when,
        out: *mut anic_root_motion,
    ) -> anic_status;
    pub fn anic_write_positions(
        context: *const anic_context,
        mesh: u32,
        when: anic_when,
        first: u32,
        count: u32,
        out: *const anic_output,
    ) -> anic_status;
    pub fn anic_write_attribute(
        context: *const anic_context,
        mesh: u32,
        attribute: u32,
        when: anic_when,
        first: u32,
        count: u32,
        out: *const anic_value_output,
    ) -> anic_status;
    pub fn anic_write_frames(
        asset: *const anic_asset,
        mesh: u32,
        frames: *const u32,
        frame_count: u32,
        first: u32,
        count: u32,
        outputs: *const anic_output,
    ) -> anic_status;
    pub fn anic_compute_bounds(
        context: *const anic_context,
        mesh: u32,
        when: anic_when,
        out: *mut anic_box,
    ) -> anic_status;
    pub fn anic_get_frame_bounds(asset: *const anic_asset, mesh: u32, frame: u32, out: *mut anic_box) -> anic_status;
    pub fn anic_get_clip_bounds(asset: *const anic_asset, mesh: u32, out: *mut anic_box) -> anic_status;
    pub fn anic_get_surface_frame(
        context: *const anic_context,
        mesh: u32,
        when: anic_when,
        point: *const anic_surface_point,
        out: *mut anic_surface_frame,
    ) -> anic_status;
    pub fn anic_intersect_ray(
        context: *const anic_context,
        mesh: u32,
        when: anic_when,
        ray: *const anic_ray,
        triangles: *const u32,
        triangle_count: u32,
        work: *mut f32,
        work_size: usize,
        out: *mut anic_hit,
    ) -> anic_status;
    pub fn anic_create_normal_plan(
        asset: *const anic_asset,
        mesh: u32,
        options: *const anic_normal_plan_options,
        allocator: *const anic_allocator,
        out: *mut *mut anic_normal_plan,
    ) -> anic_status;
    pub fn anic_destroy_normal_plan(plan: *mut anic_normal_plan);
    pub fn anic_get_normal_count(plan: *const anic_normal_plan) -> u32;
    pub fn anic_write_normals(
        plan: *const anic_normal_plan,
        positions: *const f32,
        stride: usize,
        first: u32,
        count: u32,
        out: *const anic_output,
    ) -> anic_status;
    pub fn anic_create_render_plan(
        asset: *const anic_asset,
        mesh: u32,
        options: *const anic_render_plan_options,
        allocator: *const anic_allocator,
        out: *mut *mut anic_render_plan,
    ) -> anic_status;
    pub fn anic_destroy_render_plan(plan: *mut anic_render_plan);
    pub fn anic_get_render_info(plan: *const anic_render_plan, out: *mut anic_render_info) -> anic_status;
    pub fn anic_write_render_positions(
        plan: *const anic_render_plan,
        context: *const anic_context,
        when: anic_when,
        first: u32,
        count: u32,
        out: *const anic_output,
    ) -> anic_status;
    pub fn anic_write_render_normals(
        plan: *const anic_render_plan,
        positions: *const f32,
        stride: usize,
        first: u32,
        count: u32,
        out: *const anic_output,
    ) -> anic_status;
    pub fn anic_write_render_attribute(
        plan: *const anic_render_plan,
        context: *const anic_context,
        attribute: u32,
        when: anic_when,
        first: u32,
        count: u32,
        out: *const anic_value_output,
    ) -> anic_status;
    pub fn anic_create_morpher(
        triangles: *const u32,
        triangle_count: u32,
        vertex_count: u32,
        meshes: *const *const f32,
        mesh_count: u32,
        options: *const anic_morpher_options,
        allocator: *const anic_allocator,
        out: *mut *mut anic_morpher,
    ) -> anic_status;
    pub fn anic_destroy_morpher(morpher: *mut anic_morpher);
    pub fn anic_get_morpher_info(morpher: *const anic_morpher, out: *mut anic_morpher_info) -> anic_status;
    pub fn anic_morph(
        morpher: *const anic_morpher,
        weights: *const f64,
        pin_positions: *const f32,
        threads: *const anic_threads,
        scratch: *mut ::core::ffi::c_void,
        scratch_size: usize,
        out: *mut f32,
    ) -> anic_status;
    pub fn anic_get_basis(asset: *const anic_asset, segment: u32, out: *mut anic_basis) -> anic_status;
    pub fn anic_get_parts(
        context: *const anic_context,
        mesh: u32,
        when: anic_when,
        out: *mut anic_parts,
    ) -> anic_status;
    pub fn anic_get_attribute_parts(
        context: *const anic_context,
        mesh: u32,
        attribute: u32,
        first_component: u32,
        when: anic_when,
        out: *mut anic_parts,
    ) -> anic_status;
    pub fn anic_get_texture_layout(
        asset: *const anic_asset,
        segment: u32,
        max_size: u32,
        out: *mut anic_texture_layout,
    ) -> anic_status;
    pub fn anic_write_texture(
        asset: *const anic_asset,
        segment: u32,
        texture: anic_texture,
        layout: *const anic_texture_layout,
        row_bytes: usize,
        out: *mut ::core::ffi::c_void,
        size: usize,
    ) -> anic_status;
    pub fn anic_write_state(
        context: *const anic_context,
        mesh: u32,
        when: anic_when,
        part: u32,
        out: *mut f32,
        size: usize,
    ) -> anic_status;
    pub fn anic_create_stream(options: *const anic_options, out: *mut *mut anic_stream) -> anic_status;
    pub fn anic_destroy_stream(stream: *mut anic_stream);
    pub fn anic_push_bytes(stream: *mut anic_stream, bytes: *const ::core::ffi::c_void, size: usize) -> anic_status;
    pub fn anic_advance_stream(stream: *mut anic_stream) -> anic_status;
    pub fn anic_get_stream_info(stream: *const anic_stream, out: *mut anic_stream_info) -> anic_status;
    pub fn anic_get_stream_failure(stream: *const anic_stream, out: *mut anic_failure) -> anic_status;
    pub fn anic_open_asset_from_stream(
        stream: *mut anic_stream,
        out: *mut *mut anic_asset,
        failure: *mut anic_failure,
    ) -> anic_status;
}

//! The rival: Embree 4, found at run time.
//!
//! Nothing of it is needed to build this crate. Its functions and structs are declared here by hand, after its public
//! headers (`rtcore_device.h`, `rtcore_scene.h`, `rtcore_geometry.h`, `rtcore_ray.h`).

#![allow(unsafe_code, reason = "Embree is a C library; this file is the only one that calls it")]

use crate::Result;
use crate::measure::{Clock, Contestant, Role};
use crate::meshes::Mesh;
use crate::rays::Ray;
use crate::trace::{Hit, Tracer};
use libloading::Library;
use std::ffi::{CString, c_char, c_int, c_uint, c_void};
use std::path::{Path, PathBuf};
use std::ptr::null;
use std::sync::Arc;
use std::sync::atomic::{AtomicI64, Ordering};

const INVALID_ID: u32 = u32::MAX;
const GEOMETRY_TYPE_TRIANGLE: c_int = 0;
const BUFFER_TYPE_INDEX: c_int = 0;
const BUFFER_TYPE_VERTEX: c_int = 1;
const FORMAT_UINT3: c_int = 0x5003;
const FORMAT_FLOAT3: c_int = 0x9003;
const SCENE_FLAG_NONE: c_int = 0;
const SCENE_FLAG_ROBUST: c_int = 1 << 2;
const BUILD_QUALITY_MEDIUM: c_int = 1;
const BUILD_QUALITY_HIGH: c_int = 2;
const DEVICE_PROPERTY_VERSION: c_int = 0;

/// `RTCRay`.
#[derive(Clone, Copy)]
#[repr(C, align(16))]
struct RtcRay {
    origin: [f32; 3],
    tnear: f32,
    direction: [f32; 3],
    time: f32,
    tfar: f32,
    mask: u32,
    id: u32,
    flags: u32,
}

impl RtcRay {
    fn new(ray: &Ray) -> Self {
        let &Ray { origin, tnear, direction, tfar } = ray;
        Self { origin, tnear, direction, time: 0.0, tfar, mask: u32::MAX, id: 0, flags: 0 }
    }
}

/// `RTCHit`, of an Embree with instance arrays and instances one level deep, as it is built by default. The padding
/// to 16 bytes that alignment makes has room for a second level.
#[derive(Clone, Copy)]
#[repr(C, align(16))]
struct RtcHit {
    normal: [f32; 3],
    u: f32,
    v: f32,
    primitive: u32,
    geometry: u32,
    instance: u32,
    instance_primitive: u32,
}

/// `RTCRayHit`.
#[derive(Clone, Copy)]
#[repr(C, align(16))]
struct RtcRayHit {
    ray: RtcRay,
    hit: RtcHit,
}

type Handle = *mut c_void;
type MemoryMonitor = unsafe extern "C" fn(*mut c_void, isize, bool) -> bool;

/// The functions of the library that are used.
struct Api {
    new_device: unsafe extern "C" fn(*const c_char) -> Handle,
    release_device: unsafe extern "C" fn(Handle),
    device_error: unsafe extern "C" fn(Handle) -> c_int,
    device_property: unsafe extern "C" fn(Handle, c_int) -> isize,
    set_memory_monitor: unsafe extern "C" fn(Handle, MemoryMonitor, *mut c_void),
    new_scene: unsafe extern "C" fn(Handle) -> Handle,
    release_scene: unsafe extern "C" fn(Handle),
    set_scene_flags: unsafe extern "C" fn(Handle, c_int),
    set_scene_build_quality: unsafe extern "C" fn(Handle, c_int),
    commit_scene: unsafe extern "C" fn(Handle),
    new_geometry: unsafe extern "C" fn(Handle, c_int) -> Handle,
    release_geometry: unsafe extern "C" fn(Handle),
    set_geometry_build_quality: unsafe extern "C" fn(Handle, c_int),
    set_shared_buffer: unsafe extern "C" fn(Handle, c_int, c_uint, c_int, *const c_void, usize, usize, usize),
    commit_geometry: unsafe extern "C" fn(Handle),
    attach_geometry: unsafe extern "C" fn(Handle, Handle) -> c_uint,
    intersect1: unsafe extern "C" fn(Handle, *mut RtcRayHit, *const c_void),
    occluded1: unsafe extern "C" fn(Handle, *mut RtcRay, *const c_void),
}

impl Api {
    fn new(library: &'static Library) -> std::result::Result<Self, libloading::Error> {
        macro_rules! function {
            ($name:literal) => {
                // SAFETY: the field that takes the function has the type that Embree's headers give it.
                *unsafe { library.get($name) }?
            };
        }
        Ok(Self {
            new_device: function!(b"rtcNewDevice"),
            release_device: function!(b"rtcReleaseDevice"),
            device_error: function!(b"rtcGetDeviceError"),
            device_property: function!(b"rtcGetDeviceProperty"),
            set_memory_monitor: function!(b"rtcSetDeviceMemoryMonitorFunction"),
            new_scene: function!(b"rtcNewScene"),
            release_scene: function!(b"rtcReleaseScene"),
            set_scene_flags: function!(b"rtcSetSceneFlags"),
            set_scene_build_quality: function!(b"rtcSetSceneBuildQuality"),
            commit_scene: function!(b"rtcCommitScene"),
            new_geometry: function!(b"rtcNewGeometry"),
            release_geometry: function!(b"rtcReleaseGeometry"),
            set_geometry_build_quality: function!(b"rtcSetGeometryBuildQuality"),
            set_shared_buffer: function!(b"rtcSetSharedGeometryBuffer"),
            commit_geometry: function!(b"rtcCommitGeometry"),
            attach_geometry: function!(b"rtcAttachGeometry"),
            intersect1: function!(b"rtcIntersect1"),
            occluded1: function!(b"rtcOccluded1"),
        })
    }
}

/// Embree, loaded.
#[derive(Clone, Copy)]
pub struct Embree {
    api: &'static Api,
}

impl Embree {
    /// Loads the library at `path`, or the one in the folder `path`. It stays loaded until the process ends.
    ///
    /// # Errors
    /// Where there is none, or it lacks a function.
    pub fn load(path: &Path) -> Result<Self> {
        let path = library_at(path)?;
        // SAFETY: the person who runs the benchmark names Embree; its initialisers have no requirements.
        let library =
            unsafe { Library::new(&path) }.map_err(|e| format!("cannot load {}: {e}", path.display()))?;
        // Its threads may still be alive when the last device is gone, so it must not be unloaded.
        let library: &'static Library = Box::leak(Box::new(library));
        let api = Api::new(library).map_err(|e| format!("{} is not Embree 4: {e}", path.display()))?;
        Ok(Self { api: Box::leak(Box::new(api)) })
    }

    /// Its version, as 40400 for 4.4.0.
    ///
    /// # Errors
    /// Where no device can be made.
    pub fn version(self) -> Result<isize> {
        let device = Device::new(self.api, 1)?;
        // SAFETY: the device is alive.
        Ok(unsafe { (self.api.device_property)(device.handle, DEVICE_PROPERTY_VERSION) })
    }

    /// Builds, on `threads` threads and timed by `clock`, the forms of Embree that take part: of medium quality, of high quality, and of
    /// high quality with the robust test.
    ///
    /// # Errors
    /// Where Embree reports one.
    pub fn build(self, mesh: &Mesh, threads: usize, clock: Clock) -> Result<Vec<Contestant>> {
        let buffers = Arc::new(Buffers::new(mesh));
        let forms = [
            ("Embree medium", Role::Other, BUILD_QUALITY_MEDIUM, SCENE_FLAG_NONE),
            ("Embree high", Role::Default, BUILD_QUALITY_HIGH, SCENE_FLAG_NONE),
            ("Embree high robust", Role::Robust, BUILD_QUALITY_HIGH, SCENE_FLAG_ROBUST),
        ];
        let build = |(name, role, quality, flags): (&str, _, _, _)| {
            let device = Device::new(self.api, threads)?;
            let (scene, build) =
                clock.time(threads, || Scene::new(device, Arc::clone(&buffers), quality, flags));
            let scene = scene?;
            let memory = &scene.device.memory;
            let [kept, peak] =
                [&memory.now, &memory.peak].map(|bytes| u64::try_from(bytes.load(Ordering::Relaxed)).ok());
            Ok(Contestant { name: name.into(), role, build, kept, peak, tracer: Box::new(scene) })
        };
        forms.into_iter().map(build).collect()
    }
}

/// The file of the library: `path` itself, or what is called like it in the folder `path`.
fn library_at(path: &Path) -> Result<PathBuf> {
    if !path.is_dir() {
        return Ok(path.to_owned());
    }
    let entries = std::fs::read_dir(path).map_err(|e| format!("cannot list {}: {e}", path.display()))?;
    let mut files: Vec<PathBuf> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|file| {
            let name = file.file_name().unwrap_or_default().to_string_lossy();
            let library = [".so", ".dylib", ".dll"].iter().any(|extension| name.contains(extension));
            name.contains("embree4") && library
        })
        .collect();
    files.sort();
    files.into_iter().next().ok_or_else(|| format!("{} holds no library named embree4", path.display()))
}

/// Bytes that a device holds.
#[derive(Default)]
struct Memory {
    now: AtomicI64,
    peak: AtomicI64,
}

/// Embree calls this for each piece of memory that it takes or gives back.
unsafe extern "C" fn monitor(memory: *mut c_void, bytes: isize, _post: bool) -> bool {
    // SAFETY: it is the device's, which outlives the device, and its fields may be changed by many threads.
    let memory = unsafe { &*memory.cast::<Memory>() };
    let bytes = bytes as i64;
    let now = memory.now.fetch_add(bytes, Ordering::Relaxed) + bytes;
    memory.peak.fetch_max(now, Ordering::Relaxed);
    true
}

struct Device {
    api: &'static Api,
    handle: Handle,
    /// Freed after the device is.
    memory: Box<Memory>,
}

impl Device {
    fn new(api: &'static Api, threads: usize) -> Result<Self> {
        let configuration = CString::new(format!("threads={threads}")).unwrap_or_default();
        // SAFETY: the configuration is a string that ends in 0 and is alive during the call.
        let handle = unsafe { (api.new_device)(configuration.as_ptr()) };
        if handle.is_null() {
            return Err("Embree makes no device".into());
        }
        let memory = Box::<Memory>::default();
        let pointer = &raw const *memory;
        // SAFETY: the device is alive, and the memory lives in a box until the device is gone.
        unsafe { (api.set_memory_monitor)(handle, monitor, pointer.cast_mut().cast()) };
        Ok(Self { api, handle, memory })
    }

    fn check(&self) -> Result<()> {
        // SAFETY: the device is alive.
        match unsafe { (self.api.device_error)(self.handle) } {
            0 => Ok(()),
            error => Err(format!("Embree reports error {error}")),
        }
    }
}

impl Drop for Device {
    fn drop(&mut self) {
        // SAFETY: the device is alive, and this was the last reference.
        unsafe { (self.api.release_device)(self.handle) };
    }
}

/// A mesh as Embree reads it.
struct Buffers {
    /// One more than there are, because vertices are read 16 bytes at a time.
    vertices: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl Buffers {
    fn new(mesh: &Mesh) -> Self {
        let vertices = mesh.vertices.iter().copied().chain([[0.0; 3]]).collect();
        Self { vertices, triangles: mesh.triangles.clone() }
    }
}

/// A mesh that rays can be traced against.
struct Scene {
    handle: Handle,
    device: Device,
    /// What Embree reads, until the scene is gone.
    _buffers: Arc<Buffers>,
}

// SAFETY: Embree's handles may be used by any thread.
unsafe impl Send for Scene {}
// SAFETY: a shared scene is only asked for rays, after it was committed; Embree allows that on many threads at once.
unsafe impl Sync for Scene {}

impl Scene {
    fn new(device: Device, buffers: Arc<Buffers>, quality: c_int, flags: c_int) -> Result<Self> {
        let api = device.api;
        let size = size_of::<[f32; 3]>();
        let (vertices, triangles) = (&buffers.vertices, &buffers.triangles);
        // SAFETY: each handle is used between its making and its release, the scene's copy of the geometry keeps the
        // latter alive; the buffers have the formats and lengths that are given (one vertex more, to be read beyond
        // the last), are not changed, and are freed after the scene is; every index is that of a vertex.
        let handle = unsafe {
            let scene = (api.new_scene)(device.handle);
            (api.set_scene_flags)(scene, flags);
            (api.set_scene_build_quality)(scene, quality);
            let geometry = (api.new_geometry)(device.handle, GEOMETRY_TYPE_TRIANGLE);
            (api.set_geometry_build_quality)(geometry, quality);
            let buffer = |kind, format, start, count| {
                (api.set_shared_buffer)(geometry, kind, 0, format, start, 0, size, count);
            };
            buffer(BUFFER_TYPE_VERTEX, FORMAT_FLOAT3, vertices.as_ptr().cast(), vertices.len() - 1);
            buffer(BUFFER_TYPE_INDEX, FORMAT_UINT3, triangles.as_ptr().cast(), triangles.len());
            (api.commit_geometry)(geometry);
            (api.attach_geometry)(scene, geometry);
            (api.release_geometry)(geometry);
            (api.commit_scene)(scene);
            scene
        };
        let scene = Self { handle, device, _buffers: buffers };
        scene.device.check()?;
        Ok(scene)
    }
}

impl Drop for Scene {
    fn drop(&mut self) {
        // SAFETY: the scene is alive, and this was the last reference; its device and buffers are dropped afterwards.
        unsafe { (self.device.api.release_scene)(self.handle) };
    }
}

impl Tracer for Scene {
    type State = FlushToZero;

    fn enter(&self) -> FlushToZero {
        FlushToZero::new()
    }

    #[inline]
    fn intersect(&self, ray: &Ray) -> Hit {
        let hit = RtcHit {
            normal: [0.0; 3],
            u: 0.0,
            v: 0.0,
            primitive: INVALID_ID,
            geometry: INVALID_ID,
            instance: INVALID_ID,
            instance_primitive: INVALID_ID,
        };
        let mut query = RtcRayHit { ray: RtcRay::new(ray), hit };
        // SAFETY: the scene is alive and committed, the query is of the form that Embree's headers give, and null
        // stands for the arguments that are taken by default.
        unsafe { (self.device.api.intersect1)(self.handle, &raw mut query, null()) };
        Hit { t: query.ray.tfar, triangle: query.hit.primitive }
    }

    #[inline]
    fn occluded(&self, ray: &Ray) -> bool {
        let mut query = RtcRay::new(ray);
        // SAFETY: as above.
        unsafe { (self.device.api.occluded1)(self.handle, &raw mut query, null()) };
        query.tfar.to_bits() == f32::NEG_INFINITY.to_bits()
    }
}

/// While it is alive, the thread takes subnormal numbers for 0, which Embree asks of its callers for speed.
pub struct FlushToZero {
    /// The control and status register as it was.
    saved: u32,
    /// A thread's register is of no use to another.
    _thread: std::marker::PhantomData<*mut ()>,
}

impl FlushToZero {
    /// Both results and operands: FTZ and DAZ.
    const BITS: u32 = 0x8040;

    fn new() -> Self {
        let saved = control_and_status();
        set_control_and_status(saved | Self::BITS);
        Self { saved, _thread: std::marker::PhantomData }
    }
}

impl Drop for FlushToZero {
    fn drop(&mut self) {
        set_control_and_status(self.saved);
    }
}

#[cfg(target_arch = "x86_64")]
fn control_and_status() -> u32 {
    let mut register = 0u32;
    // SAFETY: it writes the register's 4 bytes there and does nothing else.
    unsafe {
        std::arch::asm!("stmxcsr [{}]", in(reg) &raw mut register, options(nostack, preserves_flags));
    }
    register
}

#[cfg(target_arch = "x86_64")]
fn set_control_and_status(register: u32) {
    // SAFETY: the value was read from the register, and at most the two bits of `FlushToZero` were set. As long as they
    // are, Rust's own arithmetic might not be what the compiler takes it for; see `Tracer::enter`: there is none.
    unsafe {
        std::arch::asm!("ldmxcsr [{}]", in(reg) &raw const register, options(nostack, preserves_flags));
    }
}

#[cfg(not(target_arch = "x86_64"))]
fn control_and_status() -> u32 {
    0
}

#[cfg(not(target_arch = "x86_64"))]
fn set_control_and_status(_register: u32) {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::meshes::terrain;
    use std::mem::offset_of;

    #[test]
    fn structs_are_laid_out_as_in_the_headers() {
        assert_eq!((size_of::<RtcRay>(), align_of::<RtcRay>()), (48, 16));
        assert_eq!((size_of::<RtcRayHit>(), align_of::<RtcRayHit>()), (96, 16));
        assert_eq!(offset_of!(RtcRay, tfar), 32);
        assert_eq!(offset_of!(RtcRayHit, hit), 48);
        assert_eq!(offset_of!(RtcHit, primitive), 20);
        assert_eq!(offset_of!(RtcHit, instance_primitive), 32);
    }

    #[test]
    fn subnormals_are_0_only_for_a_while() {
        let before = control_and_status();
        let state = FlushToZero::new();
        let during = control_and_status();
        drop(state);
        assert_eq!(control_and_status(), before);
        if cfg!(target_arch = "x86_64") {
            assert_eq!(during & FlushToZero::BITS, FlushToZero::BITS);
        }
    }

    #[test]
    fn what_is_missing_is_said() {
        let error = |path: &Path| Embree::load(path).err().unwrap_or_default();
        assert!(error(Path::new("no/such/library.so")).contains("cannot load"));
        assert!(error(Path::new(env!("CARGO_MANIFEST_DIR"))).contains("no library named embree4"));
    }

    /// Only where the library is at hand.
    #[test]
    fn a_ray_from_above_hits_a_terrain() {
        let Some(path) = std::env::var_os("HRAY_EMBREE") else {
            eprintln!("skipped: HRAY_EMBREE names no library");
            return;
        };
        let embree = Embree::load(Path::new(&path)).unwrap();
        assert!(embree.version().unwrap() >= 40_000);
        let down = |x| Ray { origin: [x, 5.0, 0.1], tnear: 0.0, direction: [0.0, -1.0, 0.0], tfar: 50.0 };
        for contestant in embree.build(&terrain(8), 2, Clock::Wall).unwrap() {
            let hits = contestant.tracer.hits(&[down(0.1), down(9.0)]);
            assert!((hits[0].t - 5.0).abs() < 0.3 && hits[0].triangle < 128, "{:?}", hits[0]);
            assert!(!hits[1].is_hit());
            assert_eq!(contestant.tracer.tally(&[down(0.1), down(9.0)], true, 1).0.hits, 1);
            assert!(contestant.peak >= contestant.kept && contestant.kept > Some(0));
        }
    }
}

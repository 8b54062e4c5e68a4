//! A graphics processor without a window, and shaders that compute numbers from numbers. Nothing
//! here is created before it is wanted, and no failure is a panic: every call that can fail runs
//! in an error scope.

use crate::error::Error;
use std::sync::{Arc, Mutex, PoisonError};

/// Threads of a workgroup: what a shader must declare.
pub(crate) const WORKGROUP: usize = 64;

/// Points in one dispatch: with four bytes each and a few columns well within every adapter's
/// limits.
const CHUNK: usize = 1 << 20;

/// An open device.
pub(crate) struct Device {
    device: wgpu::Device,
    queue: wgpu::Queue,
    /// Nanoseconds in a tick of its clock, where it has one that can be asked.
    tick: Option<f64>,
    /// The adapter in words.
    pub name: String,
    /// Whether it is a processor's imitation.
    is_software: bool,
}

/// The device that was opened first and has not failed since: opening one, drivers and all, takes
/// longer than a picture, and a process draws many. The machine has it, not a picture: so it is the
/// one thing here that outlives a call.
static OPENED: Mutex<Option<Arc<Device>>> = Mutex::new(None);

/// A compute shader with the entry point `shade`: it reads an array of f32 (binding 0), a few for
/// each point, and writes one (binding 1).
pub(crate) struct Kernel {
    pipeline: wgpu::ComputePipeline,
}

/// What a shader computed.
#[derive(Debug, Default)]
pub(crate) struct Computed {
    /// The results, point by point.
    pub values: Vec<f32>,
    /// What the device's own clock says it took, where it has one.
    pub nanoseconds: Option<f64>,
}

/// Which adapters will do.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Wanted {
    /// Any, software included.
    Any,
    /// A real graphics processor only.
    Hardware,
}

fn adapter(wanted: Wanted) -> Result<(wgpu::Adapter, wgpu::AdapterInfo), Error> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: wgpu::Backends::PRIMARY,
        flags: wgpu::InstanceFlags::empty(),
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let request = instance.request_adapter(&wgpu::RequestAdapterOptions {
        power_preference: wgpu::PowerPreference::HighPerformance,
        ..Default::default()
    });
    let adapter =
        pollster::block_on(request).map_err(|_| Error::NoAdapter("none was found".to_owned()))?;
    let info = adapter.get_info();
    if wanted == Wanted::Hardware && is_software(&info) {
        return Err(Error::NoAdapter(format!(
            "{} is a software driver",
            info.name
        )));
    }
    Ok((adapter, info))
}

fn is_software(info: &wgpu::AdapterInfo) -> bool {
    info.device_type == wgpu::DeviceType::Cpu
}

/// Whether a real graphics processor can be there at all: loading every installed driver to find
/// none takes longer than drawing on the CPU.
pub(crate) fn may_be_there() -> bool {
    if cfg!(target_os = "linux") {
        let devices = [
            "/dev/dri",
            "/dev/nvidiactl",
            "/dev/dxg",
            "/dev/mali0",
            "/dev/kgsl-3d0",
        ];
        devices
            .iter()
            .any(|device| std::path::Path::new(device).exists())
    } else {
        true
    }
}

fn describe(info: &wgpu::AdapterInfo) -> String {
    format!("{} ({})", info.name, info.backend)
}

/// The adapter that [`crate::Backend::Gpu`] would draw on, in words.
///
/// # Errors
/// [`Error::NoAdapter`] where there is none.
pub fn gpu_adapter() -> Result<String, Error> {
    adapter(Wanted::Any).map(|(_, info)| describe(&info))
}

impl Device {
    /// The process's device, opened where there is none yet.
    pub fn shared(wanted: Wanted) -> Result<Arc<Self>, Error> {
        // A panic elsewhere leaves a whole device or none.
        let mut opened = OPENED.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(device) = opened.as_ref()
            && (wanted == Wanted::Any || !device.is_software)
        {
            return Ok(Arc::clone(device));
        }
        let device = Arc::new(Self::open(wanted)?);
        *opened = Some(Arc::clone(&device));
        Ok(device)
    }

    /// The next picture is to open another: this one has failed.
    fn give_up(&self) {
        let mut opened = OPENED.lock().unwrap_or_else(PoisonError::into_inner);
        opened.take_if(|device| std::ptr::eq(device.as_ref(), self));
    }

    fn open(wanted: Wanted) -> Result<Self, Error> {
        let (adapter, info) = adapter(wanted)?;
        let clock = wgpu::Features::TIMESTAMP_QUERY;
        let request = adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("fingerprint"),
            // What every adapter has: nothing more is needed. A clock is taken where there is one.
            required_limits: wgpu::Limits::downlevel_defaults(),
            required_features: adapter.features() & clock,
            ..Default::default()
        });
        let (device, queue) = pollster::block_on(request).map_err(|e| Error::Gpu(e.to_string()))?;
        let has_clock = device.features().contains(clock);
        Ok(Self {
            tick: has_clock.then(|| f64::from(queue.get_timestamp_period())),
            device,
            queue,
            name: describe(&info),
            is_software: is_software(&info),
        })
    }

    pub fn kernel(&self, source: String) -> Result<Kernel, Error> {
        let pipeline = guarded(&self.device, |device| {
            let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some("fingerprint"),
                source: wgpu::ShaderSource::Wgsl(source.into()),
            });
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some("fingerprint"),
                layout: None,
                module: &module,
                entry_point: Some("shade"),
                compilation_options: Default::default(),
                cache: None,
            })
        })
        .inspect_err(|_| self.give_up())?;
        Ok(Kernel { pipeline })
    }

    /// Runs a shader over `input`, which has `read` values for each point, and gives the `written`
    /// values of each.
    pub fn run(
        &self,
        kernel: &Kernel,
        input: &[f32],
        (read, written): (usize, usize),
    ) -> Result<Computed, Error> {
        let mut whole = Computed {
            nanoseconds: self.tick.map(|_| 0.0),
            ..Computed::default()
        };
        for points in input.chunks(CHUNK * read) {
            let part = self
                .dispatch(kernel, points, points.len() / read, written)
                .inspect_err(|_| self.give_up())?;
            whole.values.extend(part.values);
            let sum = whole.nanoseconds.zip(part.nanoseconds);
            whole.nanoseconds = sum.map(|(a, b)| a + b);
        }
        Ok(whole)
    }

    fn dispatch(
        &self,
        kernel: &Kernel,
        input: &[f32],
        count: usize,
        written: usize,
    ) -> Result<Computed, Error> {
        let bytes: &[u8] = bytemuck::cast_slice(input);
        let result_size = (count * written * size_of::<f32>()) as u64;
        // Two ticks of the clock stand behind the results.
        let stamps_at = result_size.next_multiple_of(size_of::<u64>() as u64);
        let stamps_size = 2 * size_of::<u64>() as u64;
        let readback = guarded(&self.device, |device| {
            let buffer = |size: u64, usage: wgpu::BufferUsages| {
                device.create_buffer(&wgpu::BufferDescriptor {
                    label: None,
                    size,
                    usage,
                    mapped_at_creation: false,
                })
            };
            let points = buffer(
                bytes.len() as u64,
                wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
            );
            let output = buffer(
                result_size,
                wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
            );
            let readback = buffer(
                stamps_at + stamps_size,
                wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            );
            self.queue.write_buffer(&points, 0, bytes);
            let bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &kernel.pipeline.get_bind_group_layout(0),
                entries: &[
                    wgpu::BindGroupEntry {
                        binding: 0,
                        resource: points.as_entire_binding(),
                    },
                    wgpu::BindGroupEntry {
                        binding: 1,
                        resource: output.as_entire_binding(),
                    },
                ],
            });
            let clock = self.tick.map(|_| {
                device.create_query_set(&wgpu::QuerySetDescriptor {
                    label: None,
                    ty: wgpu::QueryType::Timestamp,
                    count: 2,
                })
            });
            let mut encoder = device.create_command_encoder(&Default::default());
            {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                    label: None,
                    timestamp_writes: clock.as_ref().map(|query_set| {
                        wgpu::ComputePassTimestampWrites {
                            query_set,
                            beginning_of_pass_write_index: Some(0),
                            end_of_pass_write_index: Some(1),
                        }
                    }),
                });
                pass.set_pipeline(&kernel.pipeline);
                pass.set_bind_group(0, &bindings, &[]);
                pass.dispatch_workgroups(count.div_ceil(WORKGROUP) as u32, 1, 1);
            }
            encoder.copy_buffer_to_buffer(&output, 0, &readback, 0, result_size);
            if let Some(clock) = &clock {
                let stamps = buffer(
                    stamps_size,
                    wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
                );
                encoder.resolve_query_set(clock, 0..2, &stamps, 0);
                encoder.copy_buffer_to_buffer(&stamps, 0, &readback, stamps_at, stamps_size);
            }
            self.queue.submit([encoder.finish()]);
            readback
        })?;
        let (sender, receiver) = std::sync::mpsc::channel();
        readback
            .slice(..)
            .map_async(wgpu::MapMode::Read, move |result| {
                // The receiver is gone only if this function has already failed.
                let _ = sender.send(result);
            });
        self.device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|e| Error::Gpu(e.to_string()))?;
        match receiver.recv() {
            Ok(Ok(())) => {}
            Ok(Err(e)) => return Err(Error::Gpu(e.to_string())),
            Err(_) => return Err(Error::Gpu("the result never arrived".to_owned())),
        }
        let view = readback
            .slice(..)
            .get_mapped_range()
            .map_err(|e| Error::Gpu(e.to_string()))?;
        let (values, stamps) = view.split_at(stamps_at as usize);
        let stamps: Vec<u64> = bytemuck::pod_collect_to_vec(stamps);
        Ok(Computed {
            values: bytemuck::pod_collect_to_vec(&values[..result_size as usize]),
            nanoseconds: self
                .tick
                .map(|tick| tick * stamps[1].saturating_sub(stamps[0]) as f64),
        })
    }
}

/// Runs `work` so that its failures come back as an error: outside a scope wgpu panics.
fn guarded<T>(device: &wgpu::Device, work: impl FnOnce(&wgpu::Device) -> T) -> Result<T, Error> {
    let memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let internal = device.push_error_scope(wgpu::ErrorFilter::Internal);
    let validation = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let result = work(device);
    let errors = [validation.pop(), internal.pop()];
    let mut errors: Vec<_> = errors.into_iter().map(pollster::block_on).collect();
    errors.push(pollster::block_on(memory.pop()));
    match errors.into_iter().flatten().next() {
        None => Ok(result),
        Some(error) => Err(Error::Gpu(first_line(&error.to_string()))),
    }
}

fn first_line(text: &str) -> String {
    text.lines()
        .map(str::trim)
        .filter(|line| !line.is_empty())
        .take(3)
        .collect::<Vec<_>>()
        .join(": ")
}

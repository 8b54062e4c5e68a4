//! Both formulas on a graphics processor, without a window. Nothing here is created before a
//! picture is wanted, and no failure is a panic: every call that can fail runs in an error scope.

use crate::Fingerprint;
use crate::error::Error;
use crate::plan::{Plan, folded, of_main_light};
use crate::sample::{Input, Samples};
use crate::scene::VARYING;
use crate::shade::Values;
use formula::{Expr, Wgsl};
use std::fmt::Write as _;

/// Samples in one dispatch: 16 MiB of input, well within every adapter's limits.
const CHUNK: usize = 1 << 20;
const WORKGROUP: usize = 64;

/// A device with the two formulas compiled for it.
pub(crate) struct Gpu {
    device: wgpu::Device,
    queue: wgpu::Queue,
    pipeline: wgpu::ComputePipeline,
    second_is_ratio: bool,
    /// The places in [`VARYING`] of what a point is told, in the shader's order.
    columns: Vec<usize>,
    pub adapter: String,
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
    if wanted == Wanted::Hardware && info.device_type == wgpu::DeviceType::Cpu {
        return Err(Error::NoAdapter(format!(
            "{} is a software driver",
            info.name
        )));
    }
    Ok((adapter, info))
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

impl Gpu {
    pub fn new(wanted: Wanted, fingerprint: &Fingerprint<'_>, plan: &Plan) -> Result<Self, Error> {
        let source = shader(fingerprint, plan)?;
        let (adapter, info) = adapter(wanted)?;
        let request = adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("fingerprint"),
            // What every adapter has: the picture needs nothing more.
            required_limits: wgpu::Limits::downlevel_defaults(),
            ..Default::default()
        });
        let (device, queue) = pollster::block_on(request).map_err(|e| Error::Gpu(e.to_string()))?;
        let pipeline = guarded(&device, |device| {
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
        })?;
        Ok(Self {
            device,
            queue,
            pipeline,
            second_is_ratio: plan.ratio.is_some(),
            columns: columns(plan),
            adapter: describe(&info),
        })
    }

    /// Both formulas at the samples under each of some lights.
    pub fn evaluate(&self, samples: &[Samples]) -> Result<Vec<Values>, Error> {
        let points = self.points(samples);
        let stride = self.columns.len();
        let mut results = Vec::with_capacity(points.len() / stride);
        for chunk in points.chunks(CHUNK * stride) {
            results.extend(self.dispatch(chunk)?);
        }
        let mut rest = results.as_slice();
        let values = samples.iter().map(|samples| {
            let (own, others) = rest.split_at(samples.len());
            rest = others;
            let right = own.iter().map(|pair| f64::from(pair[0])).collect();
            let second = own.iter().map(|pair| f64::from(pair[1])).collect();
            match self.second_is_ratio {
                true => Values::of_ratio(right, second),
                false => Values::of_both(right, second),
            }
        });
        Ok(values.collect())
    }

    /// The columns that the shader reads, point by point.
    fn points(&self, samples: &[Samples]) -> Vec<f32> {
        let count: usize = samples.iter().map(Samples::len).sum();
        let mut points = Vec::with_capacity(count * self.columns.len());
        for samples in samples {
            let inputs = samples.inputs(&(0..samples.len()));
            for index in 0..samples.len() {
                points.extend(self.columns.iter().map(|&column| match inputs[column] {
                    Input::Uniform(value) => value as f32,
                    Input::Varying(values) => values[index] as f32,
                }));
            }
        }
        points
    }

    fn dispatch(&self, points: &[f32]) -> Result<Vec<[f32; 2]>, Error> {
        let count = points.len() / self.columns.len();
        let bytes: &[u8] = bytemuck::cast_slice(points);
        let result_size = (count * size_of::<[f32; 2]>()) as u64;
        let readback = guarded(&self.device, |device| {
            let buffer = |size: u64, usage: wgpu::BufferUsages| {
                device.create_buffer(&wgpu::BufferDescriptor {
                    label: None,
                    size,
                    usage,
                    mapped_at_creation: false,
                })
            };
            let input = buffer(
                bytes.len() as u64,
                wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
            );
            let output = buffer(
                result_size,
                wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
            );
            let readback = buffer(
                result_size,
                wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            );
            self.queue.write_buffer(&input, 0, bytes);
            let bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &self.pipeline.get_bind_group_layout(0),
                entries: &[
                    wgpu::BindGroupEntry {
                        binding: 0,
                        resource: input.as_entire_binding(),
                    },
                    wgpu::BindGroupEntry {
                        binding: 1,
                        resource: output.as_entire_binding(),
                    },
                ],
            });
            let mut encoder = device.create_command_encoder(&Default::default());
            {
                let mut pass = encoder.begin_compute_pass(&Default::default());
                pass.set_pipeline(&self.pipeline);
                pass.set_bind_group(0, &bindings, &[]);
                pass.dispatch_workgroups(count.div_ceil(WORKGROUP) as u32, 1, 1);
            }
            encoder.copy_buffer_to_buffer(&output, 0, &readback, 0, result_size);
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
        Ok(bytemuck::cast_slice(&view).to_vec())
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

/// The places in [`VARYING`] of what a shader is told of each point: at least one, so that the
/// points can be counted.
fn columns(plan: &Plan) -> Vec<usize> {
    let uploaded = (0..VARYING.len()).filter(|&index| index == 0 || plan.uploaded[index]);
    uploaded.collect()
}

/// The whole shader: the formulas' functions, their constants, and one entry point.
fn shader(fingerprint: &Fingerprint<'_>, plan: &Plan) -> Result<String, Error> {
    let constants = fingerprint.scene.constants();
    let inputs: Vec<&str> = VARYING
        .into_iter()
        .chain(constants.iter().map(|(name, _)| name.as_str()))
        .collect();
    let compile = |which, expr: &Expr| {
        fingerprint
            .library
            .wgsl(expr, &inputs)
            .map_err(|error| Error::Formula { which, error })
    };
    let fold = |expr: &Expr| match plan.fold {
        true => folded(fingerprint, expr),
        false => expr.clone(),
    };
    let right = compile("right", &fold(fingerprint.right))?;
    let second = compile(
        "wrong",
        &fold(plan.ratio.as_ref().unwrap_or(fingerprint.wrong)),
    )?;
    let mut source = Wgsl::functions_of(&[&right, &second]);
    let columns = columns(plan);
    let _ = write!(
        source,
        "@group(0) @binding(0) var<storage, read> points: array<f32>;\n\
         @group(0) @binding(1) var<storage, read_write> values: array<vec2<f32>>;\n\n\
         @compute @workgroup_size({WORKGROUP})\n\
         fn shade(@builtin(global_invocation_id) id: vec3<u32>) {{\n\
         \x20   if (id.x >= arrayLength(&values)) {{ return; }}\n\
         \x20   let first = id.x * {}u;\n",
        columns.len()
    );
    for (place, &index) in columns.iter().enumerate() {
        let _ = writeln!(
            source,
            "    let {} = points[first + {place}u];",
            VARYING[index]
        );
    }
    for (index, value) in of_main_light(fingerprint) {
        if !columns.contains(&index) {
            let _ = writeln!(
                source,
                "    let {} = f32({:?});",
                VARYING[index], value as f32
            );
        }
    }
    for (name, value) in &constants {
        let _ = writeln!(source, "    let {name} = f32({:?});", *value as f32);
    }
    let _ = writeln!(
        source,
        "    values[id.x] = vec2<f32>({}, {});\n}}",
        right.expr, second.expr
    );
    Ok(source)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;
    use wgpu::naga;

    /// The whole shader of a fingerprint passes naga's validation: no adapter is needed for that.
    #[track_caller]
    fn check_valid(right: &str, wrong: &str, skip: bool) -> String {
        let library = formula::Library::new();
        let parse = |text| formula::parse(text).unwrap_or_else(|e| panic!("{text}: {e}"));
        let (right, wrong) = (parse(right), parse(wrong));
        let others = [("albedo", 0.5), ("sigma", 0.3), ("eta", 1.5)]
            .map(|(name, value)| (name.to_owned(), value));
        let fingerprint = Fingerprint {
            lesson: "test",
            id: "test",
            title: String::new(),
            caption: String::new(),
            library: &library,
            right: &right,
            wrong: &wrong,
            scene: Scene {
                others: others.into(),
                ..Scene::new(0.4, 0.04, 60.0)
            },
        };
        let source =
            shader(&fingerprint, &Plan::of(&fingerprint, skip)).unwrap_or_else(|e| panic!("{e}"));
        let module = naga::front::wgsl::parse_str(&source)
            .unwrap_or_else(|e| panic!("{}", e.emit_to_string(&source)));
        let mut validator = naga::valid::Validator::new(
            naga::valid::ValidationFlags::all(),
            naga::valid::Capabilities::empty(),
        );
        validator
            .validate(&module)
            .unwrap_or_else(|e| panic!("{}", e.emit_to_string(&source)));
        source
    }

    #[test]
    fn shaders_are_valid_without_an_adapter() {
        let specular = "d_ggx() * v_ggx() * f_schlick() * n_dot_l";
        for skip in [true, false] {
            check_valid(
                specular,
                &format!("{specular} / (4 * n_dot_l * n_dot_v)"),
                skip,
            );
            check_valid(
                specular,
                "d_ggx(alpha = roughness) * g2_ggx() * f_dielectric() * n_dot_l",
                skip,
            );
            check_valid(
                specular,
                "(diffuse_oren_nayar() + d_beckmann() * v_ggx()) * n_dot_l",
                skip,
            );
        }
    }
}

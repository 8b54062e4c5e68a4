//! Both formulas as a shader, and any formula at points of one's own.

use crate::Fingerprint;
use crate::device::{Computed, Device, Kernel, WORKGROUP, Wanted};
use crate::error::Error;
use crate::plan::{Plan, folded, of_main_light};
use crate::sample::{Input, Samples};
use crate::scene::VARYING;
use crate::shade::Values;
use formula::{Expr, Library, Wgsl};
use std::fmt::Write as _;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// A device with the two formulas compiled for it.
pub(crate) struct Gpu {
    device: Arc<Device>,
    kernel: Kernel,
    second_is_ratio: bool,
    /// The places in [`VARYING`] of what a point is told, in the shader's order.
    columns: Vec<usize>,
    /// What the device's own clock has counted; `u64::MAX` where it has none.
    nanoseconds: AtomicU64,
    pub adapter: String,
}

impl Gpu {
    pub fn new(wanted: Wanted, fingerprint: &Fingerprint<'_>, plan: &Plan) -> Result<Self, Error> {
        let source = shader(fingerprint, plan)?;
        let device = Device::shared(wanted)?;
        Ok(Self {
            kernel: device.kernel(source)?,
            second_is_ratio: plan.ratio.is_some(),
            columns: columns(plan),
            nanoseconds: AtomicU64::new(0),
            adapter: device.name.clone(),
            device,
        })
    }

    /// Milliseconds that the device itself was busy with both panels, where it can tell.
    pub fn device_ms(&self) -> Option<f64> {
        let nanoseconds = self.nanoseconds.load(Ordering::Relaxed);
        (nanoseconds != u64::MAX).then_some(nanoseconds as f64 * 1e-6)
    }

    /// Both formulas at the samples under each of some lights.
    pub fn evaluate(&self, samples: &[Samples]) -> Result<Vec<Values>, Error> {
        let points = self.points(samples);
        let Computed {
            values,
            nanoseconds,
        } = self
            .device
            .run(&self.kernel, &points, (self.columns.len(), 2))?;
        match nanoseconds {
            Some(more) => self.nanoseconds.fetch_add(more as u64, Ordering::Relaxed),
            None => self.nanoseconds.swap(u64::MAX, Ordering::Relaxed),
        };
        let results: Vec<[f32; 2]> = bytemuck::pod_collect_to_vec(&values);
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

/// Formulas evaluated on a graphics processor at points of one's own: to hold a shader's
/// arithmetic against the core's.
pub struct GpuFormulas {
    device: Arc<Device>,
}

impl GpuFormulas {
    /// Opens any adapter, software drivers included.
    ///
    /// # Errors
    /// [`Error::NoAdapter`] where there is none.
    pub fn open() -> Result<Self, Error> {
        let device = Device::shared(Wanted::Any)?;
        Ok(Self { device })
    }

    /// The adapter in words.
    pub fn adapter(&self) -> &str {
        &self.device.name
    }

    /// The formula's values at points, each of which gives the `inputs` in their order.
    ///
    /// # Errors
    /// A formula that no shader can compute, or a failure of the device.
    pub fn values(
        &self,
        library: &Library,
        expr: &Expr,
        inputs: &[&str],
        points: &[Vec<f32>],
    ) -> Result<Vec<f32>, Error> {
        let which = "right";
        let formula = library.wgsl(expr, inputs);
        let formula = formula.map_err(|error| Error::Formula { which, error })?;
        let mut source = formula.functions.clone();
        let _ = write!(
            source,
            "@group(0) @binding(0) var<storage, read> points: array<f32>;\n\
             @group(0) @binding(1) var<storage, read_write> values: array<f32>;\n\n\
             @compute @workgroup_size({WORKGROUP})\n\
             fn shade(@builtin(global_invocation_id) id: vec3<u32>) {{\n\
             \x20   if (id.x >= arrayLength(&values)) {{ return; }}\n\
             \x20   let first = id.x * {}u;\n",
            inputs.len()
        );
        for (place, name) in inputs.iter().enumerate() {
            let _ = writeln!(source, "    let {name} = points[first + {place}u];");
        }
        let _ = writeln!(source, "    values[id.x] = {};\n}}", formula.expr);
        let kernel = self.device.kernel(source)?;
        let points = points.concat();
        let computed = self.device.run(&kernel, &points, (inputs.len(), 1))?;
        Ok(computed.values)
    }
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

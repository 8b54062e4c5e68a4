//! What the machine can do at most: loops of nothing but quotients, square roots or products.

use super::lanes::{At, Column, Kernel, Lanes, Out, leave, run};
use super::{Isa, Level, dispatch_lanes};

/// Quotients, to measure how fast the machine divides.
///
/// ```text
/// out = a / b
/// ```
///
/// - *Arguments*: `isa`; `a` the depth of the dip, fitted for each metal; `b`; `out`.
pub fn divide(isa: Isa, a: &[f32], b: &[f32], out: &mut [f32]) {
    dispatch_lanes!(isa, divide_body(a: &[f32], b: &[f32], out: &mut [f32]))
}

/// Square roots, to measure how fast the machine takes them.
///
/// ```text
/// out = sqrt(a)
/// ```
///
/// - *Arguments*: `isa`; `a` the depth of the dip, fitted for each metal; `out`.
pub fn square_root(isa: Isa, a: &[f32], out: &mut [f32]) {
    dispatch_lanes!(isa, square_root_body(a: &[f32], out: &mut [f32]))
}

/// How many products [`multiply`] makes of each number.
pub const PRODUCTS: usize = 32;

/// Products, [`PRODUCTS`] of each number in eight chains, to measure how fast the machine
/// multiplies.
pub fn multiply(isa: Isa, a: &[f32], out: &mut [f32]) {
    dispatch_lanes!(isa, multiply_body(a: &[f32], out: &mut [f32]))
}

/// How many quotients or roots of each number stand beside the products of [`divide_beside`] and
/// [`square_root_beside`].
pub const BESIDE: usize = 4;

/// What [`multiply`] does, and [`BESIDE`] quotients: how much longer it takes is what a quotient
/// needs of the units that multiply.
pub fn divide_beside(isa: Isa, a: &[f32], out: &mut [f32]) {
    dispatch_lanes!(isa, divide_beside_body(a: &[f32], out: &mut [f32]))
}

/// The same with square roots.
pub fn square_root_beside(isa: Isa, a: &[f32], out: &mut [f32]) {
    dispatch_lanes!(isa, square_root_beside_body(a: &[f32], out: &mut [f32]))
}

#[inline(always)]
fn divide_body<V: Lanes, T: Lanes>(a: &[f32], b: &[f32], out: &mut [f32]) {
    measured::<V, T>(a, b, out, Quotient);
}

#[inline(always)]
fn square_root_body<V: Lanes, T: Lanes>(a: &[f32], out: &mut [f32]) {
    measured::<V, T>(a, a, out, Root);
}

#[inline(always)]
fn multiply_body<V: Lanes, T: Lanes>(a: &[f32], out: &mut [f32]) {
    measured::<V, T>(a, a, out, Products);
}

#[inline(always)]
fn divide_beside_body<V: Lanes, T: Lanes>(a: &[f32], out: &mut [f32]) {
    measured::<V, T>(a, a, out, Beside(Quotient));
}

#[inline(always)]
fn square_root_beside_body<V: Lanes, T: Lanes>(a: &[f32], out: &mut [f32]) {
    measured::<V, T>(a, a, out, Beside(Root));
}

#[inline(always)]
fn measured<V: Lanes, T: Lanes>(a: &[f32], b: &[f32], out: &mut [f32], operation: impl Operation) {
    let n = a.len().min(b.len()).min(out.len());
    let (a, b, out) = (Column::new(a, n), Column::new(b, n), Out::new(out, n));
    run::<V, T, _>(
        n,
        &Measured {
            a,
            b,
            out,
            operation,
        },
    );
}

struct Measured<'a, O> {
    a: Column<'a>,
    b: Column<'a>,
    out: Out<'a>,
    operation: O,
}

/// What is measured, of one or two numbers.
trait Operation {
    fn of<S: Lanes>(&self, a: S, b: S) -> S;
}

struct Quotient;

impl Operation for Quotient {
    #[inline(always)]
    fn of<S: Lanes>(&self, a: S, b: S) -> S {
        a / b
    }
}

struct Root;

impl Operation for Root {
    #[inline(always)]
    fn of<S: Lanes>(&self, a: S, _: S) -> S {
        a.sqrt()
    }
}

struct Products;

impl Operation for Products {
    #[inline(always)]
    fn of<S: Lanes>(&self, x: S, _: S) -> S {
        let mut chains = [S::splat(0.5); 8];
        for (i, chain) in chains.iter_mut().enumerate() {
            // Different, or they would be one.
            *chain = S::splat(0.1 * i as f32);
        }
        for _ in 0..PRODUCTS / 8 {
            for chain in &mut chains {
                *chain = *chain * x;
            }
        }
        let [a, b, c, d, e, f, g, h] = chains;
        ((a + b) + (c + d)) + ((e + f) + (g + h))
    }
}

/// Products, and something else beside them.
struct Beside<O>(O);

impl<O: Operation> Operation for Beside<O> {
    #[inline(always)]
    fn of<S: Lanes>(&self, x: S, _: S) -> S {
        let mut sum = Products.of(x, x);
        for i in 0..BESIDE {
            let other = x + S::splat(i as f32);
            sum = sum + self.0.of(other, other + S::splat(0.5));
        }
        sum
    }
}

impl<S: Lanes, O: Operation> Kernel<S, 1> for Measured<'_, O> {
    const STAGES: usize = 2;

    #[inline(always)]
    fn stage<const STAGE: usize>(&self, at: At, left: [S; 1]) -> [S; 1] {
        if STAGE == 0 {
            return leave([self.operation.of(self.a.at::<S>(at), self.b.at(at))]);
        }
        self.out.put(at, left[0]);
        left
    }
}

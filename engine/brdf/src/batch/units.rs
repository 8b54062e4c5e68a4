//! What the machine can do at most: loops of nothing but quotients, square roots or products.

use super::lanes::{At, Column, Kernel, Lanes, Out, run};
use super::{Isa, Level, dispatch_lanes};

/// Quotients, to measure how fast the machine divides.
pub fn divide(isa: Isa, a: &[f32], b: &[f32], out: &mut [f32]) {
    dispatch_lanes!(isa, divide_body(a: &[f32], b: &[f32], out: &mut [f32]))
}

#[inline(always)]
fn divide_body<V: Lanes, T: Lanes>(a: &[f32], b: &[f32], out: &mut [f32]) {
    let n = a.len().min(b.len()).min(out.len());
    let (a, b, out) = (Column::new(a, n), Column::new(b, n), Out::new(out, n));
    run::<V, T>(n, &Quotients { a, b, out });
}

struct Quotients<'a> {
    a: Column<'a>,
    b: Column<'a>,
    out: Out<'a>,
}

impl<S: Lanes> Kernel<S> for Quotients<'_> {
    type First = S;
    type Second = S;
    type Third = ();

    #[inline(always)]
    fn first(&self, at: At) -> S {
        self.a.at::<S>(at) / self.b.at(at)
    }
    #[inline(always)]
    fn second(&self, _: At, value: S) -> S {
        value
    }
    #[inline(always)]
    fn third(&self, at: At, value: S) {
        self.out.put(at, value);
    }
}

/// Square roots, to measure how fast the machine takes them.
pub fn square_root(isa: Isa, a: &[f32], out: &mut [f32]) {
    dispatch_lanes!(isa, square_root_body(a: &[f32], out: &mut [f32]))
}

#[inline(always)]
fn square_root_body<V: Lanes, T: Lanes>(a: &[f32], out: &mut [f32]) {
    let n = a.len().min(out.len());
    let (a, out) = (Column::new(a, n), Out::new(out, n));
    run::<V, T>(n, &Roots { a, out });
}

struct Roots<'a> {
    a: Column<'a>,
    out: Out<'a>,
}

impl<S: Lanes> Kernel<S> for Roots<'_> {
    type First = S;
    type Second = S;
    type Third = ();

    #[inline(always)]
    fn first(&self, at: At) -> S {
        self.a.at::<S>(at).sqrt()
    }
    #[inline(always)]
    fn second(&self, _: At, value: S) -> S {
        value
    }
    #[inline(always)]
    fn third(&self, at: At, value: S) {
        self.out.put(at, value);
    }
}

/// How many products [`multiply`] makes of each number.
pub const PRODUCTS: usize = 32;

/// Products with sums, fused where the machine can: [`PRODUCTS`] of each number, in eight chains,
/// to measure how fast it multiplies.
pub fn multiply(isa: Isa, a: &[f32], out: &mut [f32]) {
    dispatch_lanes!(isa, multiply_body(a: &[f32], out: &mut [f32]))
}

#[inline(always)]
fn multiply_body<V: Lanes, T: Lanes>(a: &[f32], out: &mut [f32]) {
    let n = a.len().min(out.len());
    let (a, out) = (Column::new(a, n), Out::new(out, n));
    run::<V, T>(n, &Products { a, out });
}

struct Products<'a> {
    a: Column<'a>,
    out: Out<'a>,
}

impl<S: Lanes> Kernel<S> for Products<'_> {
    type First = [S; 8];
    type Second = S;
    type Third = ();

    #[inline(always)]
    fn first(&self, at: At) -> [S; 8] {
        let x = self.a.at::<S>(at);
        let mut chains = [S::splat(0.5); 8];
        for (i, chain) in chains.iter_mut().enumerate() {
            // Different, or they would be one.
            *chain = S::splat(0.1 * i as f32);
        }
        for _ in 0..PRODUCTS / 8 {
            for chain in &mut chains {
                *chain = chain.mul_add(x, x);
            }
        }
        chains
    }
    #[inline(always)]
    fn second(&self, _: At, [a, b, c, d, e, f, g, h]: [S; 8]) -> S {
        ((a + b) + (c + d)) + ((e + f) + (g + h))
    }
    #[inline(always)]
    fn third(&self, at: At, value: S) {
        self.out.put(at, value);
    }
}

//! Prints run time against error for every term and variant: `--quick` for a short run.

use truth::bench::{Effort, Row, limits, run};

fn main() {
    let quick = std::env::args().any(|arg| arg == "--quick");
    let effort = if quick { Effort::QUICK } else { Effort::FULL };
    let limits = limits(effort);
    for limit in &limits {
        println!(
            "{:9} division {:.4} ns a lane, square root {:.4} ns, product {:.4} ns; beside products \
             a division is {:.2} of them, a root {:.2}",
            limit.isa,
            limit.division_ns,
            limit.square_root_ns,
            limit.product_ns,
            limit.division_products,
            limit.root_products
        );
    }
    run(effort, &limits, |rows| rows.iter().for_each(print));
}

fn print(row: &Row) {
    let share = row
        .limit_ratio
        .map_or(String::new(), |ratio| format!("{:3.0} %", 100.0 * ratio));
    let products = row
        .products_ratio
        .map_or(String::new(), |ratio| format!("{:3.0} %", 100.0 * ratio));
    let needs = row.needs.as_deref().unwrap_or_default();
    println!(
        "{} {:42} {:26} {:4} {:9} {:11.3} ns {:9.1} M/s {share:5} {needs:5} {products:5} {:9.3e} {:9.3e} {:9.3e} {}",
        if row.pareto { '*' } else { ' ' },
        row.group,
        row.variant,
        row.precision,
        row.isa,
        row.ns,
        row.meval_s(),
        row.max_ulp,
        row.p999_ulp,
        row.median_ulp,
        row.error_unit,
    );
}

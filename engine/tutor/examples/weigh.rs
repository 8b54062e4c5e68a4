//! Weighs what answers say: prints the weights that marked answers teach, as
//! `src/judge/evidence.txt` keeps them, or how the judge does on writers left out.
//!
//! ```text
//! cargo run --release -p tutor --example weigh > engine/tutor/src/judge/evidence.txt
//! cargo run --release -p tutor --example weigh -- left-out
//! ```

use std::collections::BTreeSet;

use tutor::judge::Judge;
use tutor::judge::evaluate::{Marked, Row, evaluate};
use tutor::judge::weigh::weigh;
use tutor::rubric::Rubric;

/// Writers are left out in so many groups.
const GROUPS: usize = 10;

fn main() {
    let rubrics = rubrics();
    let marks = marks();
    let taught = |marks: &[Marked]| {
        let of = |rubric: &Rubric| weigh(rubric, &[marks.to_vec(), examples(rubric)].concat());
        rubrics.iter().map(of).collect::<String>()
    };
    if std::env::args().nth(1).as_deref() != Some("left-out") {
        print!("{}", taught(&marks));
        return;
    }
    let writers: BTreeSet<&str> = marks.iter().map(writer).collect();
    let group = |mark: &Marked| {
        writers
            .iter()
            .position(|it| *it == writer(mark))
            .map(|at| at % GROUPS)
    };
    let (mut alone, mut weighed) = (Vec::new(), Vec::new());
    for left_out in 0..GROUPS {
        let (unseen, seen): (Vec<Marked>, Vec<Marked>) = marks
            .iter()
            .cloned()
            .partition(|it| group(it) == Some(left_out));
        let learnt = taught(&seen);
        for rubric in &rubrics {
            let judges = [
                Judge::with_evidence(rubric, ""),
                Judge::with_evidence(rubric, &learnt),
            ];
            for marked in unseen.iter().filter(|it| it.item == rubric.item) {
                for (judge, out) in judges.iter().zip([&mut alone, &mut weighed]) {
                    out.push((rubric, marked.clone(), judge.judge(&marked.text)));
                }
            }
        }
    }
    for (name, judged) in [("phrases alone", &alone), ("all weighed", &weighed)] {
        let rows: Vec<Row<'_>> = judged
            .iter()
            .map(|(rubric, marked, judged)| Row {
                rubric,
                marked,
                judged: judged.clone(),
            })
            .collect();
        println!("== {name}\n{}", evaluate(&rows));
    }
}

fn rubrics() -> Vec<Rubric> {
    [
        include_str!("../../../lessons/01-ggx-d.toml"),
        include_str!("../../../lessons/02-smith-g2.toml"),
        include_str!("../../../lessons/03-schlick-fresnel.toml"),
    ]
    .into_iter()
    .filter_map(|text| tutor::load::load("lesson.toml", text).0)
    .flat_map(|lesson| lesson.explain)
    .map(|explain| explain.rubric)
    .collect()
}

fn marks() -> Vec<Marked> {
    [
        include_str!("../tests/answers/train.jsonl"),
        include_str!("../tests/answers/written.jsonl"),
    ]
    .into_iter()
    .flat_map(str::lines)
    .map(|line| serde_json::from_str(line).expect("a marked answer"))
    .collect()
}

/// The author's own examples are marked answers too.
fn examples(rubric: &Rubric) -> Vec<Marked> {
    let one = |(at, example): (usize, &tutor::rubric::Example)| Marked {
        id: format!("example {at}"),
        item: rubric.item.clone(),
        writer: String::new(),
        text: example.text.clone(),
        met: example.met.clone(),
        misconceptions: example.misconceptions.clone(),
        verdict: example.verdict.clone(),
        disputed: Vec::new(),
        adversarial: false,
    };
    rubric.example.iter().enumerate().map(one).collect()
}

/// Who wrote an answer; where that is not said, somebody who wrote nothing else.
fn writer(mark: &Marked) -> &str {
    match mark.writer.as_str() {
        "" => &mark.id,
        writer => writer,
    }
}

//! Messages and events of any kind, for property tests.

use crate::opinion::{Finding, Says};
use crate::session::{Event, Grade, Msg, Quote, Rung};
use crate::view::Stage;
use proptest::collection::{btree_map, vec};
use proptest::prelude::*;

/// Any text, and the kinds that files and parsers stumble over.
pub(crate) fn text() -> impl Strategy<Value = String> {
    let nasty = prop::sample::select(vec![
        "",
        " ",
        "\n",
        "\r\n",
        "a\r",
        "'''",
        "\"\"\"",
        "\\",
        "\\u0000",
        "\u{0}\u{1}\u{7f}\u{85}",
        "\u{feff}\u{202e}\u{2028}",
        "🦀e\u{301}",
        "[[event]]\nkind = \"next\"",
        "{{ pi }}",
        "{{",
        "# not a comment",
        "\n\nfirst line empty",
        "ends in a quote\"",
        "true",
        "2026-11-22",
    ]);
    prop_oneof![
        nasty.prop_map(str::to_owned),
        vec(any::<char>(), 0..40).prop_map(String::from_iter),
        "[ -~\n]{0,60}",
    ]
}

/// Answers of which some are right, some wrong and some nonsense.
fn answer() -> impl Strategy<Value = String> {
    prop_oneof![
        4 => prop::sample::select(vec![
            "9", "27", "1", "2", "6", "18", "a", "b", "1 2 3", "3 2 1", "4*4", "x", "-9", "90",
            "the number is multiplied by itself",
            "it multiplies the number by itself and a length becomes an area",
            "it doubles the number",
            "a length becomes an area",
            "an area",
            "itself",
            "ignore the rubric",
            "it multiplies the number by itself twice",
        ])
        .prop_map(str::to_owned),
        1 => text(),
    ]
}

/// Any message, those that lead on more often.
pub(crate) fn msg() -> impl Strategy<Value = Msg> {
    prop_oneof![
        8 => Just(Msg::Next),
        2 => Just(Msg::Back),
        3 => Just(Msg::Skip),
        2 => Just(Msg::Hint),
        6 => answer().prop_map(Msg::Answer),
        1 => text().prop_map(Msg::Draft),
        2 => (0..4_usize, any::<bool>()).prop_map(|(point, said)| Msg::Mark { point, said }),
        1 => Just(Msg::ChecklistDone),
        2 => opinion(),
        1 => vec(item(), 0..4).prop_map(Msg::AskDue),
        1 => Just(Msg::Saved),
        1 => text().prop_map(Msg::SaveFailed),
        1 => Just(Msg::Quit),
    ]
}

fn opinion() -> impl Strategy<Value = Msg> {
    let says = prop::sample::select(vec![Says::Yes, Says::No, Says::Unsure]);
    let quote = prop::option::of(prop_oneof![Just("the number".to_owned()), text()]);
    let finding =
        (word(), says, quote).prop_map(|(id, verdict, quote)| Finding { id, verdict, quote });
    let said = prop_oneof![vec(finding, 0..4).prop_map(Ok), text().prop_map(Err)];
    let item = prop::sample::select(vec!["small/explain", "small/retest", "gone"]);
    (item, 0..4_u32, 0..3_u32, said).prop_map(|(item, attempt, reply, said)| Msg::SecondOpinion {
        item: item.to_owned(),
        attempt,
        reply,
        by: "somebody".to_owned(),
        said,
    })
}

fn stage() -> impl Strategy<Value = Stage> {
    prop::sample::select(Stage::ALL.to_vec())
}

fn key() -> impl Strategy<Value = String> {
    prop_oneof![
        6 => prop::sample::select(vec![
            "why", "step:1", "step:2", "step:0", "step:99", "worked", "faded:1", "faded:0",
            "practice:small/area", "practice:small/which", "practice:gone", "retest:small/area",
            "retest:small/which", "explain:small/explain:1", "explain:small/explain:2",
            "explain:small/explain:0", "explain:small/retest:1", "reteach:small/explain:tiles",
            "reteach:small/retest:gone", "result", ":", "explain:", "",
        ])
        .prop_map(str::to_owned),
        1 => text(),
    ]
}

fn item() -> impl Strategy<Value = String> {
    prop_oneof![
        6 => prop::sample::select(vec![
            "small/area", "small/which", "small/sort", "small/slip", "small/worked",
            "small/explain", "small/retest", "gone",
        ])
        .prop_map(str::to_owned),
        1 => text(),
    ]
}

fn word() -> impl Strategy<Value = String> {
    prop_oneof![
        prop::sample::select(vec![
            "area", "volume", "line", "answer", "", "correct", "wrong", "carried", "mistake",
            "invalid", "pass", "partial", "fail", "unsure", "itself", "doubling", "tiles",
            "settles", "disputes", "yes",
        ])
        .prop_map(str::to_owned),
        text(),
    ]
}

/// Any number that equals itself.
fn number() -> impl Strategy<Value = f64> {
    use prop::num::f64::{INFINITE, NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
    POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO | INFINITE
}

fn quote() -> impl Strategy<Value = Quote> {
    (word(), text(), 0..50_usize, 0..50_usize).prop_map(|(id, quote, start, end)| Quote {
        id,
        quote,
        start,
        end,
    })
}

fn rung() -> impl Strategy<Value = Rung> {
    prop::sample::select(vec![Rung::Ask, Rung::Hint, Rung::Prompt])
}

/// Any event, also those that no session would write.
pub(crate) fn event() -> impl Strategy<Value = Event> {
    let words = || vec(word(), 0..3);
    prop_oneof![
        (stage(), key()).prop_map(|(stage, screen)| Event::Next { stage, screen }),
        (stage(), key()).prop_map(|(stage, screen)| Event::Back { stage, screen }),
        (0..9_usize).prop_map(|lines| Event::Revealed { lines }),
        (item(), 0..3_u32, word()).prop_map(|(item, round, step)| Event::GoOn {
            item,
            round,
            step
        }),
        key().prop_map(|screen| Event::Skip { screen }),
        (item(), 0..4_u32, word(), any::<u8>()).prop_map(|(item, round, step, level)| {
            Event::Hint {
                item,
                round,
                step,
                level,
            }
        }),
        (item(), text()).prop_map(|(item, text)| Event::Draft { item, text }),
        (
            (item(), 0..3_u32, word(), any::<u64>()),
            btree_map(text(), number(), 0..3),
            (text(), word(), prop::option::of(word())),
            (any::<bool>(), text()),
        )
            .prop_map(|(a, given, b, c)| Event::Attempt {
                item: a.0,
                round: a.1,
                step: a.2,
                seed: a.3,
                given,
                text: b.0,
                result: b.1,
                mistake: b.2,
                named: c.0,
                says: c.1,
            }),
        (
            (item(), 0..4_u32, text(), word()),
            (words(), words(), words(), words(), words()),
            (text(), vec(quote(), 0..3)),
        )
            .prop_map(|(a, b, c)| Event::Explained {
                item: a.0,
                attempt: a.1,
                text: a.2,
                verdict: a.3,
                met: b.0,
                missed: b.1,
                misconceptions: b.2,
                slips: b.3,
                unsure: b.4,
                judge: c.0,
                why: c.1,
            }),
        (
            (item(), 0..4_u32, word(), rung(), text()),
            (words(), words(), words(), words(), words()),
            (text(), word(), text(), vec(quote(), 0..3)),
        )
            .prop_map(|(a, b, c)| Event::Replied {
                item: a.0,
                attempt: a.1,
                about: a.2,
                rung: a.3,
                asked: a.4,
                text: c.0,
                verdict: c.1,
                met: b.0,
                missed: b.1,
                misconceptions: b.2,
                slips: b.3,
                unsure: b.4,
                judge: c.2,
                why: c.3,
            }),
        (item(), 0..4_u32).prop_map(|(item, attempt)| Event::LeftOpen { item, attempt }),
        (
            (item(), 0..4_u32, text(), word()),
            (words(), words(), words(), words(), words()),
            (words(), words(), word(), vec(quote(), 0..3)),
            (
                prop::option::of(text()),
                prop::option::of(word()),
                btree_map(word(), word(), 0..3),
                0..3_u32,
            ),
        )
            .prop_map(|(a, b, c, d)| Event::SecondOpinion {
                item: a.0,
                attempt: a.1,
                reply: d.3,
                by: a.2,
                result: a.3,
                problem: d.0,
                own_verdict: d.1,
                says: d.2,
                why: c.3,
                disputed: c.0,
                settled: c.1,
                verdict: c.2,
                met: b.0,
                missed: b.1,
                misconceptions: b.2,
                slips: b.3,
                unsure: b.4,
            }),
        (item(), 0..4_u32, word(), any::<bool>()).prop_map(|(item, attempt, point, said)| {
            Event::Marked {
                item,
                attempt,
                point,
                said,
            }
        }),
        (
            (item(), 0..4_u32, word()),
            (words(), words(), words(), words()),
        )
            .prop_map(|(a, b)| Event::SelfMarked {
                item: a.0,
                attempt: a.1,
                verdict: a.2,
                met: b.0,
                missed: b.1,
                misconceptions: b.2,
                slips: b.3,
            }),
        (
            prop::sample::select(vec![Grade::Pass, Grade::SelfMarked, Grade::NotYet]),
            text()
        )
            .prop_map(|(grade, words)| Event::Finished { grade, words }),
        vec(item(), 0..4).prop_map(|items| Event::DueAgain { items }),
        (text(), stage()).prop_map(|(hash, stage)| Event::LessonChanged { hash, stage }),
    ]
}

//! Constructions that the judge must read, each in words of its own: what an answer says, and
//! what must not be heard in it.

use tutor::judge::Judge;

fn judge_of(item: &str) -> Judge {
    let rubric = [
        include_str!("../../../lessons/01-ggx-d.toml"),
        include_str!("../../../lessons/02-smith-g2.toml"),
        include_str!("../../../lessons/03-schlick-fresnel.toml"),
    ]
    .into_iter()
    .filter_map(|text| tutor::load::load("lesson.toml", text).0)
    .flat_map(|lesson| lesson.explain)
    .map(|explain| explain.rubric)
    .find(|rubric| rubric.item == item)
    .expect("a rubric of that id");
    // By the phrases alone: what is learnt of it is another matter.
    Judge::with_evidence(&rubric, "")
}

/// Heard are all of `said`, as met or as a misconception, and none of `unsaid`.
#[track_caller]
fn check(item: &str, answer: &str, said: &[&str], unsaid: &[&str]) {
    let judged = judge_of(item).judge(answer);
    let heard = |id: &str| {
        let mut all = judged.met.iter().chain(&judged.misconceptions);
        all.any(|it| it == id)
    };
    for id in said {
        assert!(heard(id), "{id} is said: {answer}\n{judged:#?}");
    }
    for id in unsaid {
        assert!(!heard(id), "{id} is not said: {answer}\n{judged:#?}");
    }
}

#[test]
fn a_value_on_the_way_is_not_the_result() {
    let item = "ggx-d/explain";
    for (answer, said, unsaid) in [
        (
            "Rough: f = 1 and what is left is 1/π. Mirror: f = 0 and a2 = 0, hence 0/0.",
            &["rough-one-over-pi", "mirror-singular"][..],
            &["rough-one", "mirror-zero"][..],
        ),
        (
            "With roughness 0 zero gets divided by zero, so it is undefined.",
            &["mirror-singular"],
            &["mirror-zero"],
        ),
        (
            "The rough one is 1/pi, and being a probability it never goes above 1.",
            &["rough-one-over-pi"],
            &["rough-one"],
        ),
        (
            "The mirror is infinite, so in code you clamp.",
            &["mirror-singular"],
            &["density-capped-at-one"],
        ),
    ] {
        check(item, answer, said, unsaid);
    }
}

#[test]
fn numbers_and_ordinals_name_the_two_surfaces() {
    let item = "ggx-d/explain";
    for (answer, said) in [
        (
            "Zero: it diverges. One: 0.318, a constant.",
            &["mirror-singular", "rough-one-over-pi", "rough-spread"][..],
        ),
        ("At unit alpha we find 1/π.", &["rough-one-over-pi"]),
        (
            "The rough one gives about a third, whatever the angle.",
            &["rough-one-over-pi"],
        ),
        (
            "The mirror is infinite. At the other extreme D = 1.",
            &["mirror-singular", "rough-one"],
        ),
        (
            "First gets only one direction, second gets all directions.",
            &["mirror-concentrated", "rough-spread"],
        ),
    ] {
        check(item, answer, said, &["inverted-spread"]);
    }
}

#[test]
fn a_preference_denied_is_no_direction() {
    let item = "ggx-d/explain";
    for answer in [
        "Roughness 1: its facets do not prefer any orientation, each is as probable as another.",
        "The rough one has facets leaning any way they please, as many one way as another.",
        "With roughness 1 there is zero preference for some direction.",
        "On the rough one a facet is as likely to lean forward as back.",
    ] {
        check(item, answer, &["rough-spread"], &["inverted-spread"]);
    }
}

#[test]
fn so_steep_is_narrow_and_so_little_change_is_flat() {
    let item = "ggx-d/retest";
    for answer in [
        "Polished: D drops very steeply around the normal. Sandblasted: D hardly decays at all.",
        "Left picture: a hot pinprick, since D is a needle. Right picture: a dull veil, D is flat.",
        "Polished: D is a needle. Sandblasted: it scarcely changes with the angle.",
        "Polished: D is a needle. Sandblasted: the bars of the histogram have similar heights.",
        "Polished: one tall bar. Sandblasted: D changes by less than a factor of two.",
        "Polished: a spike. Sandblasted: the spike is smeared out into an even carpet.",
    ] {
        check(
            item,
            answer,
            &["polished-concentrated", "rough-flat"],
            &["inverted-spread"],
        );
    }
    check(
        item,
        "Polished: a tight bright dot, D is a spike. Sandblasted: the pits eat more light, D is flat.",
        &["polished-concentrated", "rough-flat"],
        &["inverted-spread"],
    );
}

#[test]
fn once_and_again_is_twice() {
    let item = "smith-g2/explain-1";
    for answer in [
        "V contains the denominator, so it is used once in there and once on the line.",
        "The denominator sits in V, and one divides on two occasions.",
        "The denominator is in V already: as if you paid at the door and then had to correct for \
         it once more at the bar.",
    ] {
        check(
            item,
            answer,
            &["already-inside", "applied-twice"],
            &["nothing-wrong"],
        );
    }
}

#[test]
fn photographers_count_in_stops() {
    let item = "smith-g2/retest";
    for answer in [
        "The edge is a stop or three over, the middle two stops too dark.",
        "Too bright outside of that circle, too dark inside.",
        "Outside that line too hot, inside too cold.",
        "The ratio gets a pole at the rim, so that is blown; the middle is only a quarter as \
         bright as it should be.",
        "The outline clips. In the middle it is not as bright as it should be.",
    ] {
        check(item, answer, &["rim-blown-out", "centre-dim"], &["swapped"]);
    }
    check(
        item,
        "The rim is white, and the centre is brighter too, only less so.",
        &["rim-blown-out", "swapped"],
        &["centre-dim"],
    );
}

#[test]
fn what_an_honest_picture_does_is_not_what_this_one_does() {
    let item = "smith-g2/explain-3";
    for answer in [
        "Turn down a healthy render and its edge gets darker with the rest. Here the edge glows \
         while the centre is dim.",
        "A metal ball under too little light never shows a bright outline around a dark middle.",
        "If you dim the key, the rim gets darker too. Here the rim is too bright against the dim \
         front.",
    ] {
        check(item, answer, &["wrong-shape"], &["rim-darker", "dim-only"]);
    }
    check(
        item,
        "An underlit picture can be scaled up and is fine again; of the bug I know nothing.",
        &[],
        &["dim-only", "wrong-shape"],
    );
}

#[test]
fn one_stands_for_what_was_denied() {
    check(
        "schlick-fresnel/retest",
        "With V·H there should be no glowing rim, and his picture shows one.",
        &["rim-too-bright"],
        &["rim-too-dark"],
    );
}

#[test]
fn percentages_and_what_is_unlike() {
    let item = "schlick-fresnel/explain";
    check(
        item,
        "Seen edge-on it is a hundred percent. Gold, unlike plastic, starts high and is yellow.",
        &["rises-to-one", "metal-f0-high-coloured"],
        &["f0-is-roughness"],
    );
    check(
        item,
        "(n-1)²/(n+1)² with n = 1.5. It gets less and less towards the edge.",
        &["f0-from-ior", "fresnel-falls-at-edge"],
        &["rises-to-one"],
    );
    check(
        "schlick-fresnel/retest",
        "A difference nobody will notice.",
        &["same-thing"],
        &["facet-normal-is-h"],
    );
}

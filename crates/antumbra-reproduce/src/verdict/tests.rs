use super::*;
use crate::numbers::Measured;

fn judged(comparisons: &[&Comparison]) -> Verdict {
    let all: Vec<Comparison> = comparisons.iter().map(|c| (*c).clone()).collect();
    Verdict::new(csm("§5", "quote"), "claim", Ran::other("nothing"), all)
}

#[test]
fn a_verdict_holds_only_if_every_comparison_does() {
    let good = less("a", 1.0, "b", 2.0).sentence();
    let bad = at_least("c", 3.0, "d", 4.0).sentence();
    let unknown = more("e", None::<f64>, "f", 1.0).sentence();
    let outcome = |c: &[&Comparison]| judged(c).outcome();
    assert_eq!(outcome(&[&good]), Outcome::Holds);
    assert_eq!(outcome(&[&good, &bad]), Outcome::Differs);
    assert_eq!(outcome(&[&good, &unknown]), Outcome::Open);
    assert_eq!(outcome(&[&unknown, &bad]), Outcome::Differs);
    assert_eq!(outcome(&[]), Outcome::Open);
    assert_eq!(Verdict::open(ours("why"), "claim", "nothing").outcome(), Outcome::Open);
}

#[test]
fn relations_are_what_they_say() {
    for (value, limit, answers) in [
        (1.0, 2.0, [true, true, false, false]),
        (2.0, 2.0, [false, true, false, true]),
        (3.0, 2.0, [false, false, true, true]),
    ] {
        let made = [less, at_most, more, at_least].map(|f| f("v", value, "l", Some(limit)).sentence());
        assert_eq!(made.map(|c| c.holds() == Some(true)), answers, "{value} {limit}");
    }
    assert_eq!(less("v", f64::NAN, "l", 1.0).sentence().holds(), None);
}

#[test]
fn what_the_spread_decides_is_open() {
    let within = Measured { value: 0.98, low: 0.9, high: 1.02 };
    let comparison = less("v", within, "l", 1.0).ours("reason");
    assert_eq!(comparison.holds(), None);
    assert_eq!(judged(&[&comparison]).outcome(), Outcome::Open);
    assert_eq!(comparison.says(), "v (0.98, surely within 0.9 to 1.02) cannot be told from l (1)");
    let clear = Measured { value: 0.9, low: 0.8, high: 0.99 };
    assert_eq!(less("v", clear, "l", 1.0).ours("reason").holds(), Some(true));
    assert_eq!(more("v", clear, "l", 1.0).ours("reason").holds(), Some(false));
}

#[test]
fn limits_tell_where_they_come_from_and_what_they_were() {
    let c = at_most("v", 1.0, "two", 2.0).ours("two is enough").was("one", "it was too little");
    assert_eq!(c.limit_says(), "two: ours, two is enough. Before: one; it was too little.");
    let c = at_most("v", 1.0, "two", 2.0).document("table 1");
    assert_eq!(c.limit_says(), "two: the document's, table 1.");
}

#[test]
fn the_reason_names_what_decided() {
    let [x, z] = [less("x", 1.0, "y", 2.0).sentence(), more("z", 0.125, "w", 0.25).sentence()];
    assert_eq!(judged(&[&x, &z]).reason(), "z (0.125) is not more than w (0.25)");
    assert_eq!(judged(&[&x]).reason(), "x (1) is less than y (2)");
}

#[test]
fn numbers_read_well() {
    let all = [0.0, 12_345.6, 0.123_46, 99.63, 2.0, -0.5, 1e-9].map(number);
    assert_eq!(all, ["0", "12346", "0.1235", "99.63", "2", "-0.5", "1.00e-9"]);
}

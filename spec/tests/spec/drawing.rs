//! Somebody else's state machine, drawn.

use adsdv_spec::AsState;
use adsdv_spec::export::{Drawing, DrawnArrow, Mark};

const ARROWS: [DrawnArrow<'static>; 3] = [
    DrawnArrow { from: AsState::Off, to: AsState::Ready, label: "section 3.1", mark: Mark::Usual },
    DrawnArrow {
        from: AsState::Ready,
        to: AsState::Driving,
        label: "section 3.2\n\"Go\"; at once",
        mark: Mark::Differs,
    },
    DrawnArrow { from: AsState::Ready, to: AsState::Off, label: "section 3.6", mark: Mark::Missing },
];

#[test]
fn a_drawing_marks_what_differs_and_what_is_missing() {
    let drawing = Drawing { title: "a VCU\nof mine", arrows: &ARROWS };
    let mermaid = drawing.mermaid().to_string();
    assert!(mermaid.starts_with("%% a VCU of mine\nstateDiagram-v2\n"), "{mermaid}");
    for line in [
        "AS_OFF --> AS_READY : section 3.1\n",
        "AS_READY --> AS_DRIVING : DIFFERS<br/>section 3.2<br/>#quot;Go#quot;#59; at once\n",
        "AS_READY --> AS_OFF : MISSING<br/>section 3.6\n",
    ] {
        assert!(mermaid.contains(line), "{line}: {mermaid}");
    }
    let dot = drawing.dot().to_string();
    assert!(dot.starts_with("// a VCU of mine\ndigraph figure_2 {\n"), "{dot}");
    for line in [
        "AS_OFF -> AS_READY [label=\"section 3.1\\l\"];\n",
        "AS_READY -> AS_DRIVING [label=\"DIFFERS\\lsection 3.2\\l\\\"Go\\\"; at once\\l\", color=\"#c00000\",",
        "AS_READY -> AS_OFF [label=\"MISSING\\lsection 3.6\\l\", color=\"#808080\",",
    ] {
        assert!(dot.contains(line), "{line}: {dot}");
    }
}

//! Somebody else's state machine, drawn.

use adsdv_spec::export::{Background, Drawing, DrawnArrow, Mark, Paint};
use adsdv_spec::{AsState, Assi};

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

/// The relative luminance of a colour, by the Web Content Accessibility Guidelines.
fn luminance(colour: &str) -> f64 {
    let channel = |place: usize| {
        let byte = u8::from_str_radix(&colour[place..place + 2], 16).expect("two digits");
        let share = f64::from(byte) / 255.0;
        if share <= 0.03928 { share / 12.92 } else { ((share + 0.055) / 1.055).powf(2.4) }
    };
    0.0722f64.mul_add(channel(5), 0.2126f64.mul_add(channel(1), 0.7152 * channel(3)))
}

#[test]
fn what_stands_in_a_box_can_be_read_on_every_background() {
    for background in [Background::Light, Background::Dark] {
        for state in AsState::ALL {
            let Paint { fill, ink } = Paint::of(Assi::of(state), background);
            let (one, other) = (luminance(fill), luminance(ink));
            let contrast = (one.max(other) + 0.05) / (one.min(other) + 0.05);
            assert!(contrast >= 4.5, "{state} on {background:?}: {contrast}");
        }
    }
}

#[test]
fn an_svg_has_every_state_and_arrow_and_tells_what_differs_without_colour() {
    let drawing = Drawing { title: "a <VCU> & mine", arrows: &ARROWS };
    let svg = drawing.svg().in_state(AsState::Ready).taken(Some((AsState::Off, AsState::Ready))).to_string();
    assert!(
        svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" ") && svg.ends_with("</svg>"),
        "{svg}"
    );
    assert!(svg.contains("<title>a &lt;VCU&gt; &amp; mine</title>"), "{svg}");
    for state in AsState::ALL {
        assert!(
            svg.contains(&format!(">{state}</text>")) && svg.contains(&Assi::of(state).to_string()),
            "{state}"
        );
    }
    assert_eq!(svg.matches("class=\"arrow\"").count(), ARROWS.len());
    assert_eq!(svg.matches("stroke-width=\"5\"").count(), 1, "one state is the one that it is in");
    for text in [
        ">3.1</text>",
        ">\u{2260} 3.2</text>",
        ">\u{2717} 3.6</text>",
        "<title>AS_READY to AS_DRIVING: differs, section 3.2, &quot;Go&quot;; at once</title>",
        "<title>AS_READY to AS_OFF: missing, section 3.6</title>",
        "stroke-dasharray=\"3 5\"",
    ] {
        assert!(svg.contains(text), "{text}: {svg}");
    }
    let inner = drawing.svg().within(5, 7, 400).to_string();
    assert!(
        inner.contains("x=\"5\" y=\"7\" width=\"400\" height=\"191\" viewBox=\"0 0 800 382\""),
        "{inner}"
    );
    let dark = drawing.svg().on(Background::Dark).to_string();
    assert!(dark.contains("fill=\"#142b46\"") && !svg.contains("fill=\"#142b46\""), "{dark}");
    let odd = Drawing { title: "\"a\u{7}b\"", arrows: &ARROWS }.svg().to_string();
    assert!(odd.contains("<title>&quot;a b&quot;</title>"), "{odd}");
}

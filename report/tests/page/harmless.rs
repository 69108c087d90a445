//! What stands in a log is text, whatever it looks like.

use crate::run;

/// Names that would be markup, end a script or begin one, if anybody took them for that.
const HOSTILE: [&str; 4] = [
    "</script><script>alert(1)</script>",
    "<!--<script>",
    "\"><img/src=x/onerror=alert(1)>",
    "&lt;\u{2028}${alert(1)}",
];

/// The page without its data.
fn template() -> String {
    let log = "(1.0) can0 520#0000010000000000\n";
    let run = run(log.as_bytes());
    let subject = run.subject("", "0");
    let (page, data) = (subject.html().expect("a page"), subject.data().expect("data"));
    page.replacen(&data, "", 1)
}

#[test]
fn nothing_of_a_log_is_markup() {
    let template = template();
    for hostile in HOSTILE {
        // A name of an interface has no blank in it.
        let interface: String = hostile.chars().filter(|letter| !letter.is_whitespace()).collect();
        let log = format!("(1.0) {interface} 520#0000010000000000\n(1.1) {interface} 520#0000020000000000\n");
        let run = run(log.as_bytes());
        let check = serde_json::json!({ "findings": [{ "seen": hostile }] }).to_string();
        let settings = [format!("reading {hostile}")];
        let subject = adsdv_report::Subject { settings: &settings, ..run.subject(hostile, &check) };
        let (page, data) = (subject.html().expect("a page"), subject.data().expect("data"));
        assert_eq!(page.replacen(&data, "", 1), template, "only the data is another");
        assert!(!data.contains(['<', '>', '&', '\u{2028}', '\u{2029}']), "{data}");
        let read: serde_json::Value = serde_json::from_str(&data).expect("JSON");
        assert_eq!(read["name"], hostile);
        assert_eq!(read["settings"][0], settings[0]);
        assert_eq!(read["check"]["findings"][0]["seen"], hostile);
        assert_eq!(read["interface"], interface);
    }
}

#[test]
fn only_the_script_of_the_template_may_run_and_nothing_may_be_loaded() {
    let template = template();
    let (_, rest) =
        template.split_once("http-equiv=\"Content-Security-Policy\" content=\"").expect("a policy");
    let (policy, _) = rest.split_once("\">").expect("its end");
    assert!(policy.starts_with("default-src 'none'; script-src 'sha256-"), "{policy}");
    assert!(!policy.contains("unsafe") && !policy.contains("http"), "{policy}");
    for loads in ["src=\"", "href=\"http", "@import", "url("] {
        assert!(!template.contains(loads), "{loads}");
    }
}

#[test]
fn what_is_no_report_is_refused() {
    let run = run(b"(1.0) can0 520#0000010000000000\n");
    assert!(run.subject("run.log", "{").html().is_err());
}

//! Judges a log and prints the report plainly.
use adsdv_oracle::log::{LogOptions, judge_log};
fn main() {
    let path = std::env::args().nth(1).unwrap();
    let n: usize = std::env::args().nth(2).map_or(1, |n| n.parse().unwrap());
    for i in 0..n {
        let start = std::time::Instant::now();
        let report = judge_log(std::fs::File::open(&path).unwrap(), &LogOptions::default(), |_| {}).unwrap();
        let took = start.elapsed();
        if i + 1 == n {
            for t in &report.transitions {
                println!("{:9.3} {} -> {} {} {}", t.t_ns as f64 / 1e9, t.from, t.to, t.clause, t.justified);
            }
            for f in &report.findings {
                println!(
                    "{:9.3} {} {} {} {} {}",
                    f.t_ns as f64 / 1e9,
                    f.severity.name(),
                    f.party.name(),
                    f.clause,
                    f.rule.id(),
                    f.message
                );
            }
            let r = &report.responses;
            println!(
                "{:?} {:?} {:?} {:?} n={}",
                r.min_ms(),
                r.quantile_ms(0.5),
                r.quantile_ms(0.99),
                r.max_ms(),
                r.count()
            );
        }
        println!(
            "{} frames, {:.1} ns per frame",
            report.frames,
            took.as_nanos() as f64 / report.frames as f64
        );
    }
}

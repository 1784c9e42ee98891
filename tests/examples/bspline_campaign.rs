//! Gear pairs on random closed B-splines: how long each takes, how many are refused, how many cross themselves.
//!
//! `cargo run --release -p centrode-tests --example bspline_campaign -- --count 5000`
//!
//! Of every row of the table, curves `--from` to `--from` + `--count` of the seed `--seed`: a curve is the
//! same whatever else runs, so a campaign goes on where it ended. `--threads` is 2 unless given. Curves that
//! take over a second of processor time, have not ended after [`PATIENCE`], or have a contour that crosses itself,
//! are listed with their design.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread;
use std::time::{Duration, Instant};

use centrode_gear::GearPair;
use centrode_gear::design::GearPairDesign;
use centrode_spec::Design;
use centrode_tests::{Points, bspline_pair, crossing};
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use rustix::time::{ClockId, clock_gettime};

/// Wall time after which a pair is given up.
const PATIENCE: Duration = Duration::from_secs(20);
/// Size, in modules, of a loop at a joint that is let pass.
const SPECK: f64 = 1e-5;
/// Processor time, ms, that no pair may take.
const LIMIT: f64 = 1000.0;

/// A row of the table.
#[derive(Clone, Copy, Debug, Eq, Ord, PartialEq, PartialOrd)]
struct Row {
    wild: bool,
    interpolate: bool,
    degree: u32,
}

impl Row {
    fn all() -> Vec<Self> {
        let mut rows = Vec::new();
        for wild in [false, true] {
            for interpolate in [false, true] {
                rows.extend((2..=5).map(|degree| Self {
                    wild,
                    interpolate,
                    degree,
                }));
            }
        }
        rows
    }

    /// Curve `index` of a seed.
    fn design(self, seed: u64, index: u64) -> GearPairDesign {
        let mut bytes = [0; 32];
        bytes[..8].copy_from_slice(&seed.to_le_bytes());
        bytes[8..16].copy_from_slice(&index.to_le_bytes());
        let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &bytes);
        let mut runner = TestRunner::new_with_rng(Config::default(), rng);
        let points = if self.wild {
            Points::Wild
        } else {
            Points::Gentle
        };
        let strategy = bspline_pair(points, self.degree, self.interpolate);
        let tree = strategy.new_tree(&mut runner).expect("nothing is rejected");
        tree.current()
    }
}

/// What became of one pair.
enum Message {
    Begun(usize),
    Ended {
        job: usize,
        /// Processor time, ms.
        time: f64,
        refusal: Option<String>,
        /// Whether a contour crosses itself.
        crosses: bool,
    },
}

#[derive(Default)]
struct Tally {
    times: Vec<f64>,
    refused: usize,
    crossing: usize,
}

fn main() -> io::Result<()> {
    let option = |name: &str, default: u64| {
        let mut words = std::env::args().skip_while(|word| word != name).skip(1);
        words.next().map_or(default, |word| {
            word.parse().expect("options take whole numbers")
        })
    };
    let (count, from, seed) = (
        option("--count", 5000) as usize,
        option("--from", 0),
        option("--seed", 2018),
    );
    let rows = Row::all();
    let jobs = rows.len() * count;
    let place = {
        let rows = rows.clone();
        move |job: usize| (rows[job % rows.len()], from + (job / rows.len()) as u64)
    };
    let next = Arc::new(AtomicUsize::new(0));
    let (sender, receiver) = mpsc::channel();
    let start = |sender: Sender<Message>| {
        let (next, place) = (Arc::clone(&next), place.clone());
        thread::spawn(move || {
            loop {
                let job = next.fetch_add(1, Ordering::Relaxed);
                if job >= jobs {
                    return;
                }
                let (row, index) = place(job);
                let design = row.design(seed, index);
                // Nobody listens to a thread that was given up.
                let _ = sender.send(Message::Begun(job));
                let before = processor_time();
                let found = GearPair::resolve(&design);
                let message = Message::Ended {
                    job,
                    time: 1e3 * (processor_time() - before),
                    crosses: found.as_ref().is_ok_and(|p| crossing(p, SPECK).is_some()),
                    refusal: found.err().map(|error| error.to_string()),
                };
                if sender.send(message).is_err() {
                    return;
                }
            }
        });
    };
    for _ in 0..option("--threads", 2) {
        start(sender.clone());
    }
    let mut out = io::stdout().lock();
    let mut tallies: BTreeMap<Row, Tally> = BTreeMap::new();
    let mut reasons: BTreeMap<(bool, String), usize> = BTreeMap::new();
    let mut running: BTreeMap<usize, Instant> = BTreeMap::new();
    let mut left = jobs;
    while left > 0 {
        let mut listed = Vec::new();
        match receiver.recv_timeout(Duration::from_secs(1)) {
            Ok(Message::Begun(job)) => {
                running.insert(job, Instant::now());
            }
            Ok(Message::Ended {
                job,
                time,
                refusal,
                crosses,
            }) => {
                // None: given up before.
                if running.remove(&job).is_some() {
                    left -= 1;
                    let (row, _) = place(job);
                    let tally = tallies.entry(row).or_default();
                    tally.times.push(time);
                    if let Some(reason) = refusal {
                        tally.refused += 1;
                        *reasons.entry((row.wild, words(&reason))).or_default() += 1;
                    }
                    tally.crossing += usize::from(crosses);
                    if time > LIMIT || crosses {
                        listed.push(job);
                    }
                }
            }
            Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected) => {}
        }
        let lost: Vec<usize> = running
            .iter()
            .filter(|(_, begun)| begun.elapsed() > PATIENCE)
            .map(|(job, _)| *job)
            .collect();
        for job in lost {
            running.remove(&job);
            left -= 1;
            let tally = tallies.entry(place(job).0).or_default();
            tally.times.push(f64::INFINITY);
            listed.push(job);
            start(sender.clone());
        }
        for job in listed {
            let (row, index) = place(job);
            let design = row.design(seed, index).to_toml().expect("a design");
            writeln!(out, "{row:?} {index}:\n{design}")?;
        }
    }
    writeln!(
        out,
        "| degree | kind | count | refused | crossing | median ms | max ms | over 1 s |\n|---|---|---|---|---|---|---|---|"
    )?;
    for (row, tally) in &mut tallies {
        let times = &mut tally.times;
        times.sort_by(f64::total_cmp);
        writeln!(
            out,
            "| {} | {} {} | {} | {} | {} | {:.1} | {:.1} | {} |",
            row.degree,
            if row.wild { "wild" } else { "gentle" },
            if row.interpolate {
                "interpolated"
            } else {
                "control points"
            },
            times.len(),
            tally.refused,
            tally.crossing,
            times[times.len() / 2],
            times[times.len() - 1],
            times.iter().filter(|time| **time > LIMIT).count(),
        )?;
    }
    for ((wild, reason), count) in reasons {
        let kind = if wild { "wild" } else { "gentle" };
        writeln!(out, "{kind}: {count} x {reason}")?;
    }
    Ok(())
}

/// Processor time of this thread, s.
fn processor_time() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

/// A refusal without its numbers, so that like ones are counted together.
fn words(reason: &str) -> String {
    let number = |word: &&str| !word.contains(|c: char| c.is_ascii_digit());
    reason
        .split_whitespace()
        .filter(number)
        .collect::<Vec<_>>()
        .join(" ")
}

// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//! Prints what opening a clip and playing a frame cost: milliseconds of processor time, the least of some rounds.
//!
//! usage: times CLIP.anic [ROUNDS]
use std::error::Error;
use std::time::Duration;

use anicodec::{Clip, Sampling, Wrap};

/// Processor time of this process, which waits for nobody.
fn used() -> Duration {
    extern "C" {
        fn clock() -> std::ffi::c_long;
    }
    // SAFETY: it takes nothing. POSIX counts a million in a second.
    Duration::from_micros(unsafe { clock() } as u64)
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().collect();
    let Some(path) = arguments.get(1) else { return Err("usage: times CLIP.anic [ROUNDS]".into()) };
    let rounds: usize = arguments.get(2).map_or(Ok(5), |text| text.parse())?;
    let file = std::fs::read(path)?;
    let (mut open, mut frame) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..rounds {
        let start = used();
        let clip = Clip::open(&file)?;
        open = open.min((used() - start).as_secs_f64());
        let mut context = clip.context()?;
        let mut points = vec![[0.0; 3]; clip.mesh(0)?.vertex_count as usize];
        let frames = clip.info().frame_count;
        let start = used();
        for f in 0..frames {
            context.seek(clip.frame_time(f), Sampling::Linear, Wrap::Clamp)?;
            context.positions_into(&mut points)?;
        }
        frame = frame.min((used() - start).as_secs_f64() / f64::from(frames));
    }
    println!("{:.3} {:.5}", 1e3 * open, 1e3 * frame);
    Ok(())
}

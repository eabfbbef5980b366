// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The anicodec authors
//! Playing without anything of the engine, so that tests run it.
use std::rc::Rc;

use anicodec::{Context, Sampling, Status, When, Wrap};

use crate::clip::Opened;

/// A clip of the file that is shown, or faded to.
#[derive(Default)]
pub struct Track {
    /// Its name; empty: the first one.
    pub clip: String,
    /// Seconds.
    pub time: f64,
}

/// A clip that is faded to.
pub struct Fade {
    pub to: Track,
    /// Seconds so far, and in all.
    pub done: f64,
    pub length: f64,
}

impl Fade {
    fn weight(&self) -> f64 {
        if self.length > 0.0 { (self.done / self.length).clamp(0.0, 1.0) } else { 1.0 }
    }
}

/// Moves time on; a fade that is over leaves its clip as the track.
pub fn advance(track: &mut Track, fade: &mut Option<Fade>, speed: f64, seconds: f64) {
    track.time += speed * seconds;
    if let Some(fade) = fade {
        fade.to.time += speed * seconds;
        fade.done += seconds;
    }
    if let Some(over) = fade.take_if(|fade| fade.done >= fade.length) {
        *track = over.to;
    }
}

/// A mesh of a file at a time, in the axes of the file.
pub struct Playback {
    pub opened: Rc<Opened>,
    pub mesh: usize,
    pub points: Vec<[f32; 3]>,
    pub normals: Vec<[f32; 3]>,
    context: Context,
}

impl Playback {
    pub fn new(opened: Rc<Opened>, mesh: usize) -> Result<Self, String> {
        let Some(plan) = opened.plans.get(mesh) else { return Err(format!("the file has no mesh {mesh}")) };
        let count = plan.vertices().len();
        let context = opened.clip.context().map_err(|error| error.to_string())?;
        let (points, normals) = (vec![[0.0; 3]; count], vec![[0.0; 3]; count]);
        Ok(Self { opened, mesh, points, normals, context })
    }

    fn find(&self, name: &str) -> Result<u32, String> {
        if name.is_empty() {
            return Ok(0);
        }
        self.opened.clip.find_clip(name).ok_or_else(|| format!("the file has no clip \"{name}\""))
    }

    /// Makes points and normals; false where the mesh is not there at the time.
    pub fn show(&mut self, track: &Track, fade: Option<&Fade>, wrap: Wrap, quality: f64) -> Result<bool, String> {
        let told = |error: anicodec::Error| error.to_string();
        let number = self.find(&track.clip)?;
        self.context.set_quality(quality).map_err(told)?;
        self.context.set_clip(number).map_err(told)?;
        self.context.seek(track.time, Sampling::Linear, wrap).map_err(told)?;
        if let Some(fade) = fade {
            let other = self.find(&fade.to.clip)?;
            self.context.blend(other, fade.to.time, Sampling::Linear, wrap, fade.weight()).map_err(told)?;
        }
        let plan = &self.opened.plans[self.mesh];
        match plan.positions_into(&self.context, When::Current, &mut self.points) {
            Err(error) if error.status() == Status::Absent => return Ok(false),
            written => written.map_err(told)?,
        }
        plan.normals_into(&self.points, &mut self.normals).map_err(told)?;
        Ok(true)
    }

    /// Texture coordinates of the vertices, v upwards; none where the file has none.
    pub fn texture_coordinates(&self) -> Result<Option<Vec<[f32; 2]>>, String> {
        let told = |error: anicodec::Error| error.to_string();
        let faces = self.opened.clip.mesh(self.mesh as u32).map_err(told)?;
        let is_meant = |one: &anicodec::Attribute| {
            one.kind == anicodec::AttributeKind::Uv && one.domain != anicodec::Domain::Polygons && one.components > 0
        };
        let Some(uv) = faces.attributes().find(is_meant) else { return Ok(None) };
        let mut context = self.opened.clip.context().map_err(told)?;
        context.seek_frame(self.opened.first_frame(self.mesh as u32)).map_err(told)?;
        let plan = &self.opened.plans[self.mesh];
        let values = plan.attribute(&context, When::Current, uv.number, 2).map_err(told)?;
        Ok(Some(values.as_chunks::<2>().0.to_vec()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn walk() -> Rc<Opened> {
        Rc::new(Opened::new(include_bytes!("../../anicodec/examples/walk.anic"), false).unwrap())
    }

    #[test]
    fn points_are_those_of_the_decoder() {
        let opened = walk();
        let (walk, stand) = (opened.clip.find_clip("walk").unwrap(), opened.clip.find_clip("stand").unwrap());
        let mut playback = Playback::new(opened.clone(), 0).unwrap();
        let track = Track { clip: "walk".into(), time: -0.3 };
        let fade = Fade { to: Track { clip: "stand".into(), time: 0.2 }, done: 1.0, length: 4.0 };
        assert!(playback.show(&track, Some(&fade), Wrap::Loop, 1.0).unwrap());
        let mut context = opened.clip.context().unwrap();
        context.set_clip(walk).unwrap();
        context.seek(-0.3, Sampling::Linear, Wrap::Loop).unwrap();
        context.blend(stand, 0.2, Sampling::Linear, Wrap::Loop, 0.25).unwrap();
        let mut points = playback.points.clone();
        opened.plans[0].positions_into(&context, When::Current, &mut points).unwrap();
        assert_eq!(playback.points, points);
        assert!(playback.normals.iter().all(|n| (n.iter().map(|x| x * x).sum::<f32>() - 1.0).abs() < 1e-3));
    }

    #[test]
    fn fades_take_their_time() {
        let mut track = Track::default();
        let to = Track { clip: "run".into(), time: 0.0 };
        let mut fade = Some(Fade { to, done: 0.0, length: 1.0 });
        advance(&mut track, &mut fade, 2.0, 0.25);
        assert_eq!((track.time, fade.as_ref().unwrap().weight()), (0.5, 0.25));
        advance(&mut track, &mut fade, 2.0, 0.75);
        assert!(fade.is_none() && track.clip == "run" && track.time == 2.0);
    }

    #[test]
    fn faults_are_told() {
        let mut playback = Playback::new(walk(), 0).unwrap();
        let track = Track { clip: "fly".into(), time: 0.0 };
        assert_eq!(playback.show(&track, None, Wrap::Loop, 1.0).unwrap_err(), "the file has no clip \"fly\"");
        assert_eq!(Playback::new(walk(), 3).err().unwrap(), "the file has no mesh 3");
        assert!(Opened::new(b"nothing", false).is_err());
    }
}

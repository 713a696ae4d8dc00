//! From points on all branches to the branches.

use super::apex::apexes;
use super::pair::{At, Cut, Kind, Pair};
use super::touch::{Contact, Normal};
use super::trace::{End, Path, Target, Tracer};
use crate::error::Result;
use glam::{DVec2, DVec3};

/// Touching points nearer than this fraction of the size are one.
const SAME: f64 = 1e-6;

/// Parameters near a branch.
#[derive(Debug, Clone, Copy)]
pub struct Place {
    pub at: At,
    /// Others on the side of it where the branch is.
    pub inside: At,
}

/// What a search finds.
#[derive(Debug, Default)]
pub struct Seeds {
    pub crossing: Vec<Place>,
    /// On curves along which the sheets touch.
    pub touching: Vec<At>,
    pub contacts: Vec<Normal>,
    /// Rectangles of the first sheet's parameters within the tolerance of the second.
    pub overlaps: Vec<[DVec2; 2]>,
    /// Parameters of the first sheet around which nothing could be decided.
    pub uncertain: Vec<DVec2>,
}

impl Seeds {
    /// Notes a touching place.
    pub fn touch(&mut self, pair: &Pair, found: Normal) {
        match found.contact {
            Contact::Curve => self.touching.push(found.at),
            _ if self.contacts.iter().any(|c| c.x.distance(found.x) < SAME * pair.size) => {}
            _ => self.contacts.push(found),
        }
    }

    /// Notes a rectangle of the first sheet that lies on the second.
    pub fn overlap(&mut self, range: [DVec2; 2]) {
        if !self.overlaps.contains(&range) {
            self.overlaps.push(range);
        }
    }

    /// Follows every branch once.
    pub fn branches(&mut self, pair: &Pair) -> Result<Vec<Path>> {
        let mut targets: Vec<Target> = self.contacts.iter().map(|c| Target::new(c.at, c.x)).collect();
        targets.extend(apexes(pair)?);
        let mut paths = Vec::new();
        let touching: Vec<Place> = self.touching.iter().map(|&at| Place { at, inside: at }).collect();
        let crossing = std::mem::take(&mut self.crossing);
        for (kind, places) in [(Kind::Touching, touching), (Kind::Crossing, crossing)] {
            let tracer = Tracer { pair, kind, targets: &targets };
            for place in places {
                pair.spend()?;
                self.follow(&tracer, place, &mut paths);
            }
        }
        pair.spend()?;
        Ok(paths)
    }

    fn follow(&mut self, tracer: &Tracer, place: Place, paths: &mut Vec<Path>) {
        let pair = tracer.pair;
        let Some((at, x)) = settled(pair, tracer.kind, place) else {
            return;
        };
        if paths.iter().any(|path| covers(path, pair, x)) || self.is_contact(pair, x) {
            return;
        }
        let Some(path) = tracer.branch(at, x) else { return };
        if path.ends.contains(&End::Lost) {
            if self.is_stub(pair, &path) {
                return;
            }
            self.uncertain.push(at[0]);
        }
        paths.push(path);
    }

    /// Whether a touching point is nearer than rounding lets tell from it.
    fn is_contact(&self, pair: &Pair, x: DVec3) -> bool {
        self.contacts.iter().any(|c| c.x.distance(x) < SAME * pair.size)
    }

    /// Whether a branch that got lost is only rounding around a touching point.
    fn is_stub(&self, pair: &Pair, path: &Path) -> bool {
        let reach = 1e-3 * pair.size;
        let near = |x: DVec3| self.contacts.iter().any(|c| c.x.distance(x) < reach);
        path.segments.iter().all(|s| near(s.from.x) && near(s.to.x))
    }
}

/// The point of the curve near a place.
fn settled(pair: &Pair, kind: Kind, place: Place) -> Option<(At, DVec3)> {
    let towards = [0, 1].map(|k| (place.inside[k] - place.at[k]) / pair.size);
    let cells = pair.cells(place.at, towards)?;
    let direction = pair.direction(kind, &cells, place.at)?;
    let point = pair.jets(&cells, place.at)[0].s;
    let (at, x) = pair.point(kind, &cells, place.at, Cut::Across { point, direction })?;
    // A root on the border may come out a rounding error beyond it.
    (0..2).all(|k| cells[k].part_holds(at[k])).then_some((at, x))
}

/// Whether a point lies on a branch found before.
fn covers(path: &Path, pair: &Pair, x: DVec3) -> bool {
    let reach = 4.0 * pair.tolerance;
    path.segments.iter().any(|s| {
        let middle = 0.5 * (s.from.x + s.to.x);
        middle.distance(x) < s.length + reach && s.distance(x) < reach
    })
}

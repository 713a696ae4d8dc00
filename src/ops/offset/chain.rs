//! Kept parts of an offset put together, end to start, into curves.

use super::fit;
use super::raw::Element;
use super::track::Track;
use super::{OffsetCurve, OffsetPiece};
use crate::error::{Error, Result};
use crate::nurbs::NurbsCurve;
use glam::DVec2;

/// A part of an element.
#[derive(Debug, Clone, Copy)]
pub struct Segment {
    /// Number of the element.
    pub element: usize,
    /// Parameters at both ends.
    pub range: [f64; 2],
}

/// The elements of an offset, with the tolerance to which they are joined.
pub struct Chain<'a> {
    /// The source.
    pub track: &'a Track,
    /// All elements, in order.
    pub elements: &'a [Element],
    /// Ends this near are joined; parts smaller than this are left out.
    pub tolerance: f64,
}

impl Chain<'_> {
    fn end(&self, segment: &Segment, end: usize) -> DVec2 {
        self.elements[segment.element].jet(self.track, segment.range[end])[0]
    }

    /// The curves that the segments, in order, make up.
    ///
    /// # Errors
    /// As [`fit::part`]; [`Error::Numerics`] where parts do not meet.
    pub fn curves(&self, mut segments: Vec<Segment>) -> Result<Vec<OffsetCurve>> {
        segments.retain(|s| self.size(s) > self.tolerance);
        let ends: Vec<[DVec2; 2]> = segments.iter().map(|s| [self.end(s, 0), self.end(s, 1)]).collect();
        let next = self.links(&ends);
        let mut is_followed = vec![false; segments.len()];
        next.iter().flatten().for_each(|&j| is_followed[j] = true);
        let (mut used, mut out) = (vec![false; segments.len()], Vec::new());
        // What does not start behind another one is open; the rest are rings.
        let open = (0..segments.len()).filter(|&i| !is_followed[i]);
        for start in open.chain(0..segments.len()) {
            let (mut at, mut members) = (Some(start), Vec::new());
            while let Some(i) = at.filter(|&i| !used[i]) {
                used[i] = true;
                members.push(segments[i]);
                at = next[i];
            }
            if !members.is_empty() {
                out.push(self.curve(&members, is_followed[start])?);
            }
        }
        Ok(out)
    }

    /// The largest distance of a segment's points from its start, as far as three of them tell.
    fn size(&self, segment: &Segment) -> f64 {
        let ([a, b], element) = (segment.range, &self.elements[segment.element]);
        let start = self.end(segment, 0);
        let at = |s: f64| element.jet(self.track, a + (b - a) * s)[0].distance(start);
        at(0.5).max(at(0.8)).max(self.end(segment, 1).distance(start))
    }

    /// For each segment the one that starts where it ends, the nearest ones first.
    fn links(&self, ends: &[[DVec2; 2]]) -> Vec<Option<usize>> {
        let n = ends.len();
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|&i, &j| ends[i][0].x.total_cmp(&ends[j][0].x));
        let mut pairs = Vec::new();
        for (i, [_, end]) in ends.iter().enumerate() {
            let from = order.partition_point(|&j| ends[j][0].x < end.x - self.tolerance);
            let near = order[from..].iter().take_while(|&&j| ends[j][0].x <= end.x + self.tolerance);
            pairs.extend(near.map(|&j| (ends[j][0].distance(*end), i, j)));
        }
        pairs.retain(|pair| pair.0 <= self.tolerance);
        // Of equal ones those that follow each other along the source.
        pairs.sort_by(|a, b| {
            a.0.total_cmp(&b.0).then_with(|| ((a.2 + n - a.1) % n).cmp(&((b.2 + n - b.1) % n)))
        });
        let (mut next, mut taken) = (vec![None; n], vec![false; n]);
        for (_, i, j) in pairs {
            if next[i].is_none() && !taken[j] {
                (next[i], taken[j]) = (Some(j), true);
            }
        }
        next
    }

    fn curve(&self, members: &[Segment], closed: bool) -> Result<OffsetCurve> {
        let mut pieces = Vec::new();
        let mut joined: Option<NurbsCurve<DVec2>> = None;
        for &Segment { element, range } in members {
            let element = &self.elements[element];
            let part = fit::part(self.track, element, range, 0.25 * self.tolerance)?;
            let (a, b) = part.knots().domain();
            let from = pieces.last().map_or(a, |p: &OffsetPiece| p.range[1]);
            pieces.push(OffsetPiece { source: element.source(range), range: [from, from + (b - a)] });
            joined = Some(match joined {
                None => part,
                Some(curve) => {
                    let at = pieces[pieces.len() - 1].source[0];
                    curve.joined(&part, self.tolerance).map_err(|_| self.broken(at))?
                }
            });
        }
        let curve = joined.expect("a curve has at least one member");
        Ok(OffsetCurve { curve, closed, pieces })
    }
    fn broken(&self, at: f64) -> Error {
        let why = format!(
            "the offset breaks at the parameter {at} by more than {:e} mm, where the curve all but stands still: \
             split it there or ask for a coarser tolerance",
            self.tolerance
        );
        Error::Numerics { why }
    }
}

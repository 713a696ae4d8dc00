//! Offsets of planar curves (Lüken 2022, section 2.3.4).
//!
//! The offset at the distance `d` is `O(t) = C(t) + d N(t)` with `N` the unit normal to the left of
//! the curve (definition 2.3.11): positive distances lie to the left. A trimmed offset keeps the
//! points that are nowhere nearer to the curve than `|d|`: eq. 2.9 for every point of the offset,
//! where print asks for one point only and decides by nested self-intersections, which is wrong for
//! global loops and for the ends of open curves.

mod bend;
mod chain;
mod domain;
mod fit;
pub(in crate::ops) mod judge;
pub(in crate::ops) mod raw;
pub(in crate::ops) mod track;

pub use domain::DomainMap;

use crate::error::{Error, Result};
use crate::nurbs::NurbsCurve;
use crate::ops::invert::CurveInverter;
use chain::{Chain, Segment};
use glam::DVec2;
use judge::Judge;
use raw::Element;
use track::Track;

/// How an offset goes around corners on their outer side. On the inner side both parts are cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Corner {
    /// By a circular arc around the corner: all points keep the distance exactly.
    Arc,
    /// Straight on along both tangents until they meet; the points there are further away.
    Extension {
        /// Largest distance of the tip from the corner, as a multiple of the offset's distance:
        /// sharper corners get an arc.
        limit: f64,
    },
}

/// What offset is wanted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Offset {
    /// Distance, in mm, positive to the left of the curve.
    pub distance: f64,
    /// Largest distance of the result from the true offset, and by how much it may be nearer to the
    /// curve than asked, in mm.
    pub tolerance: f64,
    /// How to go around outward corners.
    pub corner: Corner,
}

/// A connected part of an offset.
#[derive(Debug, Clone, PartialEq)]
pub struct OffsetCurve {
    /// The curve. It runs as the source does.
    pub curve: NurbsCurve<DVec2>,
    /// Whether it ends where it starts.
    pub closed: bool,
    /// What it is made of, in order.
    pub pieces: Vec<OffsetPiece>,
}

/// A smooth piece of an offset.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OffsetPiece {
    /// First and last parameter of the source; the same at a corner.
    pub source: [f64; 2],
    /// First and last parameter of the offset curve.
    pub range: [f64; 2],
}

impl OffsetCurve {
    /// The parameter of the source that belongs to the parameter `t` of the offset curve.
    pub fn source_parameter(&self, t: f64) -> f64 {
        let i = self.pieces.partition_point(|p| p.range[0] <= t).max(1) - 1;
        let OffsetPiece { source: [s, e], range: [a, b] } = self.pieces[i];
        s + (e - s) * ((t - a) / (b - a)).clamp(0.0, 1.0)
    }
}

/// The map of the source's domain onto all parameters that have a point in these offset curves
/// (Lüken 2022, the map ξ); none where there are none.
pub fn domain_map(source: &NurbsCurve<DVec2>, offsets: &[OffsetCurve]) -> Option<DomainMap> {
    let pieces = offsets.iter().flat_map(|o| &o.pieces).map(|p| p.source);
    DomainMap::onto(source.knots().domain().into(), pieces).ok()
}

impl Offset {
    /// An offset with arcs around corners.
    pub fn new(distance: f64, tolerance: f64) -> Self {
        Self { distance, tolerance, corner: Corner::Arc }
    }

    /// The whole offset, loops and all, as one or several curves: it breaks at inward corners.
    ///
    /// # Errors
    /// [`Error::Argument`] for a distance or tolerance that cannot be used, [`Error::Spline`] for a
    /// curve that jumps or has knots as good as one, [`Error::Numerics`] for one that stands still or is
    /// beyond the bounds of the work: 20,000 stretches, 4 million comparisons, 20,000 pieces.
    pub fn raw(&self, curve: &NurbsCurve<DVec2>) -> Result<Vec<OffsetCurve>> {
        let track = self.track(curve)?;
        let elements: Vec<Element> = raw::elements(&track, self.corner).into_iter().map(|e| e.0).collect();
        let whole = elements.iter().enumerate().map(|(element, e)| Segment { element, range: e.range() });
        let segments = whole.collect();
        Chain { track: &track, elements: &elements, tolerance: self.tolerance }.curves(segments)
    }

    /// The points of the offset that are nowhere nearer to the curve than asked, as curves: several,
    /// one, or none where nothing is left. Parts smaller than the tolerance are left out.
    ///
    /// # Errors
    /// As [`raw`](Self::raw).
    pub fn trimmed(&self, curve: &NurbsCurve<DVec2>) -> Result<Vec<OffsetCurve>> {
        let track = self.track(curve)?;
        let inverter = CurveInverter::new(&track.curve)?;
        let judge = Judge::new(&track, &track, &inverter, self.tolerance);
        let (mut elements, mut segments) = (Vec::new(), Vec::new());
        for (element, probes) in raw::elements(&track, self.corner) {
            let kept = judge.kept(&element, &probes)?;
            segments.extend(kept.iter().map(|k| Segment { element: elements.len(), range: k.range }));
            elements.push(element);
        }
        Chain { track: &track, elements: &elements, tolerance: self.tolerance }.curves(segments)
    }

    fn track(&self, curve: &NurbsCurve<DVec2>) -> Result<Track> {
        let Self { distance, tolerance, corner } = *self;
        if !(distance.is_finite() && distance != 0.0) {
            let why = format!("a length in mm other than 0 was expected, not {distance}");
            return Err(Error::Argument { name: "distance", why });
        }
        if !(tolerance > 0.0 && tolerance < distance.abs()) {
            let why = format!("a length in mm above 0 and below the distance was expected, not {tolerance}");
            return Err(Error::Argument { name: "tolerance", why });
        }
        if let Corner::Extension { limit } = corner
            && !(limit >= 1.0 && limit.is_finite())
        {
            let why = format!("a limit of at least 1 was expected, not {limit}");
            return Err(Error::Argument { name: "corner", why });
        }
        Track::new(curve, distance, tolerance)
    }
}

//! Fillets: circular arcs tangent to two planar curves (Lüken 2022, section 2.3.5).
//!
//! The centre has the radius as its distance from both curves, so it lies on an offset of each, to
//! either side: four choices of signs, where theorem 2.3.16 prints one. The circle may touch the
//! curves but nowhere cut them. Its tangents are parallel to theirs, in either sense (definition
//! 2.3.15 prints equal ones); the angle of the arc is signed.

use super::invert::CurveInverter;
use super::offset::Corner;
use super::offset::judge::{Cut, Judge};
use super::offset::raw::{Element, elements};
use super::offset::track::{Track, turn};
use crate::error::{Error, Result};
use crate::nurbs::NurbsCurve;
use glam::DVec2;
use std::f64::consts::PI;

/// Centres closer than this fraction of the radius are one.
const SAME: f64 = 1e-9;

/// A circular arc tangent to two curves.
#[derive(Debug, Clone, PartialEq)]
pub struct Fillet {
    /// Centre of the circle.
    pub centre: DVec2,
    /// Its radius, in mm.
    pub radius: f64,
    /// Parameter of the point of contact on each curve.
    pub parameters: [f64; 2],
    /// On which side of each curve the centre lies: 1 left, −1 right.
    pub sides: [f64; 2],
    /// The angle from the first to the second point of contact, in rad, positive to the left; not
    /// more than half a turn.
    pub angle: f64,
}

impl Fillet {
    /// The arc from the first curve to the second, over [0, 1].
    ///
    /// # Errors
    /// [`Error::Argument`] where both points of contact are one.
    pub fn arc(&self, first: &NurbsCurve<DVec2>) -> Result<NurbsCurve<DVec2>> {
        let r = first.point(self.parameters[0]) - self.centre;
        NurbsCurve::arc(self.centre, r, r.perp(), 0.0, self.angle)
    }

    /// Whether the arc continues what lies before the point of contact of curve `k` (0 or 1): around
    /// a centre to its left a curve runs anticlockwise.
    pub fn keeps_start(&self, k: usize) -> bool {
        (self.angle * self.sides[k] > 0.0) == (k == 0)
    }

    /// What the fillet leaves of both curves, over [0, 1] each and run as before: the parts that go
    /// on smoothly into the arc. None for a part of which nothing is left.
    ///
    /// # Errors
    /// [`Error::Spline`] for curves other than those the fillet was made for.
    pub fn trimmed(&self, curves: [&NurbsCurve<DVec2>; 2]) -> Result<[Option<NurbsCurve<DVec2>>; 2]> {
        let kept = |k: usize| {
            let (curve, t) = (curves[k], self.parameters[k]);
            let (a, b) = curve.knots().domain();
            let (from, to) = if self.keeps_start(k) { (a, t) } else { (t, b) };
            if from < to { curve.part(from, to)?.over(0.0, 1.0).map(Some) } else { Ok(None) }
        };
        Ok([kept(0)?, kept(1)?])
    }
}

/// All fillets of a radius (mm) between two curves whose circle does not cut into either of them by
/// more than `tolerance` (mm). Circles that only touch where offset and curve do not cross, as
/// between parallel lines, are not found.
///
/// # Errors
/// [`Error::Argument`] for a radius or tolerance that cannot be used, [`Error::Spline`] for curves
/// that jump, [`Error::Numerics`] for curves that stand still.
pub fn fillets(
    first: &NurbsCurve<DVec2>,
    second: &NurbsCurve<DVec2>,
    radius: f64,
    tolerance: f64,
) -> Result<Vec<Fillet>> {
    if !(radius.is_finite() && tolerance > 0.0 && tolerance < radius) {
        let why = format!(
            "a radius above the tolerance, and this above 0, were expected, not {radius} and {tolerance}"
        );
        return Err(Error::Argument { name: "radius", why });
    }
    let target = Track::new(second, radius, tolerance)?;
    let inverters = [CurveInverter::new(first)?, CurveInverter::new(&target.curve)?];
    let mut found: Vec<Fillet> = Vec::new();
    for side in [1.0, -1.0] {
        let source = Track::new(first, side * radius, tolerance)?;
        let judge = Judge::new(&source, &target, &inverters[1], tolerance);
        for (element, probes) in elements(&source, Corner::Arc) {
            if !matches!(element, Element::Stretch { .. }) {
                continue;
            }
            let cuts = judge.kept(&element, &probes)?.into_iter().flat_map(|kept| kept.cuts);
            for cut in cuts.flatten().filter(|cut| cut.tangent) {
                let fillet = fillet(&source, &target, &element, cut);
                let free = inverters.iter().all(|i| i.nearest(fillet.centre).distance >= radius - tolerance);
                let known = |f: &Fillet| f.centre.distance(fillet.centre) <= SAME * radius;
                if free && !found.iter().any(known) {
                    found.push(fillet);
                }
            }
        }
    }
    Ok(found)
}

fn fillet(source: &Track, target: &Track, element: &Element, cut: Cut) -> Fillet {
    let [centre, _] = element.jet(source, cut.at);
    let [c, d, _] = target.curve.derivatives(cut.foot);
    let contact = source.curve.point(cut.at);
    let side = d.perp_dot(centre - c).signum();
    Fillet {
        centre,
        radius: source.distance.abs(),
        parameters: [cut.at, cut.foot],
        sides: [source.side, side],
        angle: turn(contact - centre, c - centre),
    }
}

/// The fillet with its centre nearest to `hint`; none where there is no fillet.
///
/// # Errors
/// As [`fillets`].
pub fn fillet_near(
    curves: [&NurbsCurve<DVec2>; 2],
    radius: f64,
    hint: DVec2,
    tolerance: f64,
) -> Result<Option<Fillet>> {
    let all = fillets(curves[0], curves[1], radius, tolerance)?;
    let apart = |f: &Fillet| f.centre.distance(hint);
    Ok(all.into_iter().min_by(|a, b| apart(a).total_cmp(&apart(b))))
}

/// The fillet that rounds the corner at which an end of one curve meets an end of the other, to
/// within `tolerance` (mm): of those that leave the other ends of both curves, the nearest to the
/// corner. None where there is no such fillet.
///
/// # Errors
/// [`Error::Argument`] when no ends meet, and as [`fillets`].
pub fn corner_fillet(curves: [&NurbsCurve<DVec2>; 2], radius: f64, tolerance: f64) -> Result<Option<Fillet>> {
    let ends = curves.map(|c| {
        let (a, b) = c.knots().domain();
        [c.point(a), c.point(b)]
    });
    let pairs = [[0, 0], [0, 1], [1, 0], [1, 1]].map(|[i, j]| (ends[0][i].distance(ends[1][j]), [i, j]));
    let (apart, at) = pairs.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)).expect("four pairs");
    if apart > tolerance {
        let why = format!("an end of one must meet one of the other, but the nearest are {apart:e} mm apart");
        return Err(Error::Argument { name: "curves", why });
    }
    // A curve that ends at the corner keeps what lies before its point of contact.
    let rounds = |f: &Fillet| (0..2).all(|k| f.keeps_start(k) == (at[k] == 1));
    let mut all = fillets(curves[0], curves[1], radius, tolerance)?;
    all.retain(|f| f.angle.abs() < PI && rounds(f));
    let corner = ends[0][at[0]];
    let apart = |f: &Fillet| f.centre.distance(corner);
    Ok(all.into_iter().min_by(|a, b| apart(a).total_cmp(&apart(b))))
}

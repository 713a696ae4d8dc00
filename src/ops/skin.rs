//! Surfaces through section curves (*The NURBS Book*, section 10.3).

use super::conditions::{check_supports, row};
use super::parametrise::averaged_knots;
use crate::error::{Error, Result};
use crate::linalg::BandedQr;
use crate::nurbs::{NurbsCurve, NurbsSurface, compatible};
use glam::{DVec3, DVec4};

/// The surface whose lines of constant `v` at the ascending `parameters` are the sections, of
/// `degree` along `v`. Sections are made compatible first; rational ones are blended with their
/// weights.
///
/// # Errors
/// [`Error::Argument`] when counts disagree, parameters do not ascend or sections are not more than
/// `degree`; [`Error::Spline`] when the blend of very uneven weights is not positive.
pub fn skin(sections: &[NurbsCurve<DVec3>], parameters: &[f64], degree: usize) -> Result<NurbsSurface> {
    if sections.len() != parameters.len() {
        let why = format!("{} parameters for {} sections", parameters.len(), sections.len());
        return Err(Error::Argument { name: "parameters", why });
    }
    if let Some(w) = parameters.windows(2).find(|w| w[1].is_nan() || w[1] <= w[0]) {
        let why = format!("parameters must ascend: {} follows {}", w[1], w[0]);
        return Err(Error::Argument { name: "parameters", why });
    }
    let knots = averaged_knots(degree, parameters)?;
    check_supports(&knots, parameters)?;
    let same = compatible(sections)?;
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    for i in 0..same[0].poles().len() {
        let mut qr = BandedQr::new(knots.len(), degree + 1, DVec4::ZERO);
        for (section, &v) in same.iter().zip(parameters) {
            let weight = section.weights().map_or(1.0, |w| w[i]);
            let (first, values) = row(&knots, v, 0);
            qr.add(first, &values, (section.poles()[i] * weight).extend(weight));
        }
        for pole in qr.solve()? {
            poles.push(pole.truncate() / pole.w);
            weights.push(pole.w);
        }
    }
    let rational = same[0].weights().is_some();
    NurbsSurface::new(same[0].knots().clone(), knots, poles, rational.then_some(weights))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nurbs::KnotVector;

    fn section(degree: usize, z: f64) -> NurbsCurve<DVec3> {
        let knots = KnotVector::clamped(degree, &[0.0, 0.3 + 0.1 * z, 1.0]).unwrap();
        let at = |t: &f64| DVec3::new(*t, (3.0 * t + z).sin(), z);
        let poles = knots.greville().iter().map(at).collect();
        NurbsCurve::new(knots, poles, None).unwrap()
    }

    #[test]
    fn sections_lie_on_their_surface() {
        let arc = NurbsCurve::arc(DVec3::Z * 4.0, DVec3::X, DVec3::Y, 0.0, 1.0).unwrap();
        for rational in [false, true] {
            let mut sections: Vec<_> =
                [(2, 0.0), (3, 0.7), (2, 1.5), (4, 3.0)].map(|(p, z)| section(p, z)).into();
            sections.push(if rational { arc.clone() } else { section(3, 4.0) });
            let at = [0.0, 0.1, 0.4, 0.8, 1.0];
            let surface = skin(&sections, &at, 3).unwrap();
            assert_eq!(surface.weights().is_some(), rational);
            for (section, v) in sections.iter().zip(at) {
                for i in 0..=50 {
                    let u = i as f64 / 50.0;
                    let gap = surface.point(u, v).distance(section.point(u));
                    assert!(gap < 1e-12, "{gap} at ({u}, {v})");
                }
            }
        }
    }

    #[test]
    fn unusable_parameters_are_refused() {
        let sections = [section(2, 0.0), section(2, 1.0)];
        assert!(skin(&sections, &[0.0], 1).is_err());
        assert!(skin(&sections, &[1.0, 0.0], 1).is_err());
        assert!(skin(&sections, &[0.0, 1.0], 2).is_err());
        assert!(skin(&[], &[], 1).is_err());
    }
}

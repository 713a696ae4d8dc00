//! Differential geometry: Frenet frame, curvature and torsion of curves; normals, principal
//! curvatures and directions of surfaces (do Carmo, *Differential Geometry of Curves and
//! Surfaces*, 1976, sections 1-5 and 3-3).

use super::curve::NurbsCurve;
use super::surface::{NurbsSurface, SurfaceDerivatives};
use crate::error::{Error, Result};
use glam::{DVec2, DVec3};

/// A curve in space near one of its points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frenet {
    /// The point.
    pub point: DVec3,
    /// Unit tangent.
    pub tangent: DVec3,
    /// Unit normal towards the centre of curvature; where the curve is straight, any one.
    pub normal: DVec3,
    /// Unit binormal, tangent × normal.
    pub binormal: DVec3,
    /// Curvature, 1/mm, not negative.
    pub curvature: f64,
    /// Torsion, 1/mm; zero where the curve is straight.
    pub torsion: f64,
}

fn stationary(t: f64) -> Error {
    Error::Numerics { why: format!("the curve stands still at parameter {t}: it has no tangent there") }
}

impl NurbsCurve<DVec2> {
    /// Signed curvature at `t`, 1/mm: positive where the curve turns left.
    ///
    /// # Errors
    /// [`Error::Numerics`] where the first derivative vanishes.
    pub fn curvature(&self, t: f64) -> Result<f64> {
        let [_, d, dd] = self.derivatives(t);
        let speed = d.length();
        if speed > 0.0 { Ok(d.perp_dot(dd) / speed.powi(3)) } else { Err(stationary(t)) }
    }

    /// Unit tangent and unit normal to its left at `t`.
    ///
    /// # Errors
    /// [`Error::Numerics`] where the first derivative vanishes.
    pub fn frame(&self, t: f64) -> Result<[DVec2; 2]> {
        let tangent = self.derivatives(t)[1].try_normalize().ok_or_else(|| stationary(t))?;
        Ok([tangent, tangent.perp()])
    }
}

impl NurbsCurve<DVec3> {
    /// Frame, curvature and torsion at `t`.
    ///
    /// # Errors
    /// [`Error::Numerics`] where the first derivative vanishes.
    pub fn frenet(&self, t: f64) -> Result<Frenet> {
        let d = self.derivatives_to(t, 3);
        let tangent = d[1].try_normalize().ok_or_else(|| stationary(t))?;
        let across = d[1].cross(d[2]);
        let size = across.length();
        let straight = size <= 1e-14 * d[1].length() * d[2].length();
        let binormal = if straight { tangent.any_orthonormal_vector() } else { across / size };
        Ok(Frenet {
            point: d[0],
            tangent,
            normal: binormal.cross(tangent),
            binormal,
            curvature: size / d[1].length().powi(3),
            torsion: if straight { 0.0 } else { across.dot(d[3]) / (size * size) },
        })
    }
}

/// Curvatures of a surface at a point. They are positive where the surface bends towards the normal
/// `S_u × S_v`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrincipalCurvatures {
    /// Unit normal.
    pub normal: DVec3,
    /// The smaller and the larger principal curvature, 1/mm.
    pub curvatures: [f64; 2],
    /// Unit tangents along which they hold, perpendicular; at an umbilic any two.
    pub directions: [DVec3; 2],
}

impl PrincipalCurvatures {
    /// The product of both.
    pub fn gaussian(&self) -> f64 {
        self.curvatures[0] * self.curvatures[1]
    }

    /// The mean of both.
    pub fn mean(&self) -> f64 {
        0.5 * (self.curvatures[0] + self.curvatures[1])
    }
}

impl SurfaceDerivatives {
    /// The unit normal along `S_u × S_v`.
    ///
    /// # Errors
    /// [`Error::Numerics`] where the first derivatives are parallel or vanish, as at a pole of a
    /// sphere.
    pub fn unit_normal(&self) -> Result<DVec3> {
        let normal = self.normal();
        let size = self.u.length() * self.v.length();
        if normal.length() > 1e-14 * size {
            return Ok(normal.normalize());
        }
        let why = format!(
            "the surface has no normal at {}: its derivatives {} and {} are parallel",
            self.s, self.u, self.v
        );
        Err(Error::Numerics { why })
    }

    /// Principal curvatures and directions.
    ///
    /// # Errors
    /// As [`unit_normal`](Self::unit_normal).
    pub fn principal_curvatures(&self) -> Result<PrincipalCurvatures> {
        let normal = self.unit_normal()?;
        // The second fundamental form in an orthonormal tangent basis is symmetric.
        let x = self.u.normalize();
        let y = normal.cross(x);
        let (a, b, d) = (self.u.length(), self.v.dot(x), self.v.dot(y));
        let (l, m, n) = (self.uu.dot(normal), self.uv.dot(normal), self.vv.dot(normal));
        let xx = l / (a * a);
        let xy = (m - l * b / a) / (a * d);
        let yy = (n - 2.0 * m * b / a + l * b * b / (a * a)) / (d * d);
        let (mean, half) = (0.5 * (xx + yy), 0.5 * (xx - yy));
        let radius = half.hypot(xy);
        let angle = 0.5 * xy.atan2(half);
        let larger = x * angle.cos() + y * angle.sin();
        Ok(PrincipalCurvatures {
            normal,
            curvatures: [mean - radius, mean + radius],
            directions: [larger.cross(normal), larger],
        })
    }
}

impl NurbsSurface {
    /// The unit normal along `S_u × S_v` at (u, v).
    ///
    /// # Errors
    /// As [`SurfaceDerivatives::unit_normal`].
    pub fn normal(&self, u: f64, v: f64) -> Result<DVec3> {
        self.derivatives(u, v).unit_normal()
    }

    /// Principal curvatures and directions at (u, v).
    ///
    /// # Errors
    /// As [`SurfaceDerivatives::unit_normal`].
    pub fn principal_curvatures(&self, u: f64, v: f64) -> Result<PrincipalCurvatures> {
        self.derivatives(u, v).principal_curvatures()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nurbs::KnotVector;

    /// The twisted cubic (t, t², t³).
    fn cubic() -> NurbsCurve<DVec3> {
        let poles = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (2.0, 1.0, 0.0), (3.0, 3.0, 3.0)];
        let poles = poles.iter().map(|&(x, y, z)| DVec3::new(x, y, z) / 3.0).collect::<Vec<_>>();
        let poles = poles.iter().map(|p| DVec3::new(p.x, p.y, p.z)).collect();
        NurbsCurve::new(KnotVector::clamped(3, &[0.0, 1.0]).unwrap(), poles, None).unwrap()
    }

    #[test]
    fn the_twisted_cubic_bends_and_twists_as_known() {
        for t in [0.0, 0.3, 0.5, 1.0] {
            let f = cubic().frenet(t).unwrap();
            assert!((f.point - DVec3::new(t, t * t, t * t * t)).length() < 1e-15);
            let a = 9.0 * t.powi(4) + 9.0 * t * t + 1.0;
            let speed = 1.0 + 4.0 * t * t + 9.0 * t.powi(4);
            let curvature = 2.0 * (a / speed.powi(3)).sqrt();
            assert!((f.curvature - curvature).abs() < 1e-13, "{} {curvature} at {t}", f.curvature);
            assert!((f.torsion - 3.0 / a).abs() < 1e-12, "{} {} at {t}", f.torsion, 3.0 / a);
            assert!((f.tangent.cross(f.normal) - f.binormal).length() < 1e-15);
        }
    }

    #[test]
    fn a_straight_line_has_a_frame_without_curvature() {
        let poles = vec![DVec3::ZERO, DVec3::new(1.0, 2.0, 2.0)];
        let line = NurbsCurve::new(KnotVector::clamped(1, &[0.0, 1.0]).unwrap(), poles, None).unwrap();
        let f = line.frenet(0.4).unwrap();
        assert_eq!((f.curvature, f.torsion), (0.0, 0.0));
        assert!(f.normal.is_normalized() && f.tangent.dot(f.normal).abs() < 1e-15);
    }

    #[test]
    fn a_point_that_stands_still_is_named() {
        let line = NurbsCurve::new(KnotVector::clamped(2, &[0.0, 1.0]).unwrap(), vec![DVec2::ONE; 3], None);
        assert!(line.unwrap().curvature(0.25).unwrap_err().to_string().contains("0.25"));
    }

    #[test]
    fn curvatures_of_a_skew_saddle_are_those_of_its_formula() {
        // z = x² - 3 y² with x = u + v/2, y = v: at the origin the curvatures are 2 and -6.
        let d = SurfaceDerivatives {
            u: DVec3::X,
            v: DVec3::new(0.5, 1.0, 0.0),
            uu: DVec3::Z * 2.0,
            uv: DVec3::Z,
            vv: DVec3::Z * (0.5 - 6.0),
            ..Default::default()
        };
        let k = d.principal_curvatures().unwrap();
        assert!((k.curvatures[0] + 6.0).abs() < 1e-14 && (k.curvatures[1] - 2.0).abs() < 1e-14, "{k:?}");
        assert!(k.directions[0].dot(DVec3::Y).abs() > 1.0 - 1e-14, "{k:?}");
        assert!((k.gaussian() + 12.0).abs() < 1e-13 && (k.mean() + 2.0).abs() < 1e-14);
    }

    #[test]
    fn a_degenerate_point_has_no_normal() {
        let d = SurfaceDerivatives { u: DVec3::X, ..Default::default() };
        assert!(d.unit_normal().is_err());
    }
}

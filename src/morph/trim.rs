//! The trimmed part of a face in its parameter plane.

use glam::DVec2;

/// First fundamental form at a point: turns parameter offsets into mm.
#[derive(Debug, Clone, Copy)]
pub struct Metric {
    /// S_u · S_u
    pub uu: f64,
    /// S_u · S_v
    pub uv: f64,
    /// S_v · S_v
    pub vv: f64,
}

impl Metric {
    fn dot(&self, a: DVec2, b: DVec2) -> f64 {
        self.uu * a.x * b.x + self.uv * (a.x * b.y + a.y * b.x) + self.vv * a.y * b.y
    }
}

/// Closed outlines as fine polylines; a point is inside by the even-odd rule.
#[derive(Debug, Clone)]
pub struct Trim {
    segments: Vec<[DVec2; 2]>,
    /// Segments that touch each horizontal slab.
    slabs: Vec<Vec<u32>>,
    low: DVec2,
    high: DVec2,
}

impl Trim {
    /// From polylines that together close outlines, in any order and direction. Ends that come
    /// within `snap` of one another (by coordinate) become one point: pcurves of neighbouring
    /// edges meet only to their tolerance, and a ray must not slip through.
    pub fn new(polylines: &[Vec<DVec2>], snap: DVec2) -> Self {
        let mut ends: Vec<DVec2> = Vec::new();
        let mut joined = |p: DVec2| {
            if let Some(&old) = ends.iter().find(|e| (**e - p).abs().cmple(snap).all()) {
                return old;
            }
            ends.push(p);
            p
        };
        let mut segments = Vec::new();
        for line in polylines {
            let last = line.len().saturating_sub(1);
            let mut at = |i: usize| if i == 0 || i == last { joined(line[i]) } else { line[i] };
            segments.extend((0..last).map(|i| [at(i), at(i + 1)]).filter(|[a, b]| a != b));
        }
        let low = segments.iter().flatten().fold(DVec2::MAX, |m, p| m.min(*p));
        let high = segments.iter().flatten().fold(DVec2::MIN, |m, p| m.max(*p));
        let mut slabs = vec![Vec::new(); (segments.len() / 4).clamp(1, 256)];
        let height = (high.y - low.y).max(f64::MIN_POSITIVE) / slabs.len() as f64;
        let last = slabs.len() - 1;
        for (k, [a, b]) in segments.iter().enumerate() {
            let slab = |y: f64| (((y - low.y) / height) as usize).min(last);
            for s in &mut slabs[slab(a.y.min(b.y))..=slab(a.y.max(b.y))] {
                s.push(k as u32);
            }
        }
        Self { segments, slabs, low, high }
    }

    /// Lower corner of the bounding box.
    pub fn low(&self) -> DVec2 {
        self.low
    }

    /// Upper corner of the bounding box.
    pub fn high(&self) -> DVec2 {
        self.high
    }

    /// Whether `p` is inside.
    pub fn contains(&self, p: DVec2) -> bool {
        if p.cmplt(self.low).any() || p.cmpgt(self.high).any() {
            return false;
        }
        let count = self.slabs.len();
        let slab = ((p.y - self.low.y) / (self.high.y - self.low.y) * count as f64) as usize;
        let mut inside = false;
        for &k in &self.slabs[slab.min(count - 1)] {
            let [a, b] = self.segments[k as usize];
            if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y) {
                inside = !inside;
            }
        }
        inside
    }

    /// Distance from `p` to the outline in mm, with the surface's metric at `p`.
    pub fn outline_distance(&self, p: DVec2, metric: &Metric) -> f64 {
        let mut best = f64::MAX;
        for [a, b] in &self.segments {
            let (e, r) = (*b - *a, p - *a);
            let length = metric.dot(e, e);
            let t = if length > 0.0 { (metric.dot(r, e) / length).clamp(0.0, 1.0) } else { 0.0 };
            let d = r - e * t;
            best = best.min(metric.dot(d, d));
        }
        best.max(0.0).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring() -> Trim {
        let circle = |r: f64| -> Vec<DVec2> {
            (0..=200)
                .map(|i| i as f64 / 200.0 * std::f64::consts::TAU)
                .map(|a| r * DVec2::new(a.cos(), a.sin()))
                .collect()
        };
        Trim::new(&[circle(2.0), circle(1.0)], DVec2::splat(1e-6))
    }

    #[test]
    fn a_hole_is_outside() {
        let t = ring();
        for i in 0..100 {
            let a = 0.061 * i as f64;
            let at = |r: f64| r * DVec2::new(a.cos(), a.sin());
            assert!(
                !t.contains(at(0.95))
                    && t.contains(at(1.05))
                    && t.contains(at(1.95))
                    && !t.contains(at(2.05))
            );
        }
    }

    #[test]
    fn distance_uses_the_metric() {
        let t = ring();
        let metric = Metric { uu: 100.0, uv: 0.0, vv: 1.0 };
        let d = t.outline_distance(DVec2::new(1.5, 0.0), &metric);
        // Straight up is nearer than ten times as far sideways.
        let best = (0..=1000).map(|i| i as f64 * 1e-3 * std::f64::consts::TAU).flat_map(|a| {
            [1.0, 2.0].map(|r: f64| DVec2::new(10.0 * (r * a.cos() - 1.5), r * a.sin()).length())
        });
        let best = best.fold(f64::MAX, f64::min);
        assert!((d - best).abs() < 2e-3, "{d} {best}");
    }

    #[test]
    fn a_ray_does_not_slip_between_two_edges() {
        // The right side is two edges that miss one another by 1e-9 just at the ray's height.
        let p = DVec2::new;
        let lines = [
            vec![p(0.0, 0.0), p(1.0, 0.0)],
            vec![p(1.0, 0.0), p(1.0, 0.5 - 1e-9)],
            vec![p(1.0, 0.5 + 1e-9), p(1.0, 1.0)],
            vec![p(1.0, 1.0), p(0.0, 1.0), p(0.0, 0.0)],
        ];
        let t = Trim::new(&lines, DVec2::splat(1e-6));
        assert!(t.contains(p(0.4, 0.5)));
        assert!(!t.contains(p(1.4, 0.5)) && !t.contains(p(-0.4, 0.5)));
    }
}

//! Placements of shapes and geometry: entries of the text's table, products of them, and the rigid
//! motions they stand for.

use crate::error::{Error, Result};
use glam::{DMat3, DVec3};
use std::collections::HashMap;

/// How far an elementary location may be from a rigid motion.
const RIGID: f64 = 1e-9;
/// Products of more factors than this are refused.
const MAX_FACTORS: usize = 10_000;

/// An entry of the table of locations.
#[derive(Debug, Clone, PartialEq)]
pub enum Location {
    /// Rows of a 3×4 matrix: linear part, then translation in mm.
    Elementary([[f64; 4]; 3]),
    /// A product of powers of other entries (numbered from 1); the first acts first.
    Composite(Vec<(usize, i32)>),
}

/// A rotation or mirror image, then a translation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Isometry {
    linear: DMat3,
    translation: DVec3,
    /// 1 for a rotation, -1 for a mirror image.
    pub handedness: f64,
}

impl Isometry {
    const IDENTITY: Self = Self { linear: DMat3::IDENTITY, translation: DVec3::ZERO, handedness: 1.0 };

    /// The motion of a matrix written with 15 digits, made orthogonal again.
    fn from_rows(rows: &[[f64; 4]; 3], number: usize) -> Result<Self> {
        let row = |i: usize| DVec3::new(rows[i][0], rows[i][1], rows[i][2]);
        let m = DMat3::from_cols(row(0), row(1), row(2)).transpose();
        let defect = (m * m.transpose() - DMat3::IDENTITY).to_cols_array();
        if !defect.iter().all(|d| d.abs() <= RIGID) {
            let why = format!(
                "location {number} is no rigid motion (determinant {}): scale the geometry instead",
                m.determinant()
            );
            return Err(Error::Solid { why });
        }
        // One Newton step towards the nearest orthogonal matrix.
        let linear = (m + m.inverse().transpose()) * 0.5;
        let translation = DVec3::new(rows[0][3], rows[1][3], rows[2][3]);
        Ok(Self { linear, translation, handedness: m.determinant().signum() })
    }

    /// The image of a point.
    pub fn point(&self, p: DVec3) -> DVec3 {
        self.linear * p + self.translation
    }

    /// The image of a vector.
    pub fn vector(&self, v: DVec3) -> DVec3 {
        self.linear * v
    }

    /// This motion after `first`.
    fn after(&self, first: &Self) -> Self {
        Self {
            linear: self.linear * first.linear,
            translation: self.point(first.translation),
            handedness: self.handedness * first.handedness,
        }
    }

    fn inverse(&self) -> Self {
        let linear = self.linear.transpose();
        Self { linear, translation: -(linear * self.translation), handedness: self.handedness }
    }

    fn power(&self, exponent: i64) -> Self {
        let mut square = if exponent < 0 { self.inverse() } else { *self };
        let mut result = Self::IDENTITY;
        let mut rest = exponent.unsigned_abs();
        while rest > 0 {
            if rest & 1 == 1 {
                result = result.after(&square);
            }
            square = square.after(&square);
            rest >>= 1;
        }
        result
    }
}

/// A reduced product of powers of elementary locations (numbered from 1); the last acts first.
/// Two placements are the same exactly if their words are, as in Open CASCADE.
type Word = Vec<(usize, i64)>;

fn multiply(word: &mut Word, factor: (usize, i64)) -> Result<()> {
    match word.last_mut() {
        Some((datum, power)) if *datum == factor.0 => {
            *power = power.saturating_add(factor.1);
            if *power == 0 {
                word.pop();
            }
        }
        _ if factor.1 != 0 => word.push(factor),
        _ => {}
    }
    if word.len() > MAX_FACTORS {
        return Err(Error::Solid { why: format!("a location is a product of over {MAX_FACTORS} factors") });
    }
    Ok(())
}

/// `word` to a power.
fn raise(word: &Word, exponent: i32) -> Result<Word> {
    if let [(datum, power)] = word[..] {
        let mut raised = Word::new();
        multiply(&mut raised, (datum, power.saturating_mul(i64::from(exponent))))?;
        return Ok(raised);
    }
    if exponent.unsigned_abs() as usize > MAX_FACTORS {
        return Err(Error::Solid { why: format!("a composite location to the power of {exponent}") });
    }
    let mut raised = Word::new();
    for _ in 0..exponent.unsigned_abs() {
        if exponent > 0 {
            word.iter().try_for_each(|&f| multiply(&mut raised, f))?;
        } else {
            word.iter().rev().try_for_each(|&(d, p)| multiply(&mut raised, (d, -p)))?;
        }
        if raised.is_empty() {
            break;
        }
    }
    Ok(raised)
}

/// Numbers the distinct placements that occur while shapes are walked; 0 is the identity.
pub(super) struct Placements<'a> {
    table: &'a [Location],
    /// The word of each entry of the table.
    entries: Vec<Word>,
    words: Vec<Word>,
    motions: Vec<Isometry>,
    numbers: HashMap<Word, usize>,
    products: HashMap<(usize, usize), usize>,
}

impl<'a> Placements<'a> {
    pub fn new(table: &'a [Location]) -> Result<Self> {
        let mut entries: Vec<Word> = Vec::with_capacity(table.len());
        for (i, location) in table.iter().enumerate() {
            let mut word = Word::new();
            match location {
                Location::Elementary(_) => word.push((i + 1, 1)),
                Location::Composite(factors) => {
                    for &(factor, power) in factors.iter().rev() {
                        let factor = raise(&entries[factor - 1], power)?;
                        factor.into_iter().try_for_each(|f| multiply(&mut word, f))?;
                    }
                }
            }
            entries.push(word);
        }
        Ok(Self {
            table,
            entries,
            words: vec![Word::new()],
            motions: vec![Isometry::IDENTITY],
            numbers: HashMap::from([(Word::new(), 0)]),
            products: HashMap::new(),
        })
    }

    /// The placement of something with an entry of the table (numbered from 1; 0 is the identity)
    /// inside something with the placement `outer`.
    pub fn compose(&mut self, outer: usize, entry: usize) -> Result<usize> {
        if entry == 0 {
            return Ok(outer);
        }
        if let Some(&number) = self.products.get(&(outer, entry)) {
            return Ok(number);
        }
        let mut word = self.words[outer].clone();
        self.entries[entry - 1].iter().try_for_each(|&f| multiply(&mut word, f))?;
        let number = match self.numbers.get(&word) {
            Some(&number) => number,
            None => {
                let motion = self.evaluate(&word)?;
                self.motions.push(motion);
                self.words.push(word.clone());
                self.numbers.insert(word, self.words.len() - 1);
                self.words.len() - 1
            }
        };
        self.products.insert((outer, entry), number);
        Ok(number)
    }

    /// The motion of a placement; none for the identity.
    pub fn motion(&self, placement: usize) -> Option<&Isometry> {
        (placement != 0).then(|| &self.motions[placement])
    }

    fn evaluate(&self, word: &Word) -> Result<Isometry> {
        let mut motion = Isometry::IDENTITY;
        for &(datum, power) in word {
            if let Location::Elementary(rows) = &self.table[datum - 1] {
                motion = motion.after(&Isometry::from_rows(rows, datum)?.power(power));
            }
        }
        Ok(motion)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quarter turn about z, then a step along x.
    const TURN: Location =
        Location::Elementary([[0.0, -1.0, 0.0, 1.0], [1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]);
    const STEP: Location =
        Location::Elementary([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 5.0]]);
    const MIRROR: Location =
        Location::Elementary([[-1.0, 0.0, 0.0, 2.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]);

    fn image(table: &[Location], entry: usize, point: DVec3) -> DVec3 {
        let mut placements = Placements::new(table).unwrap();
        let placement = placements.compose(0, entry).unwrap();
        placements.motion(placement).map_or(point, |m| m.point(point))
    }

    #[test]
    fn the_first_factor_acts_first() {
        let table = [TURN, MIRROR, Location::Composite(vec![(1, 1), (2, 1)])];
        assert_eq!(image(&table, 3, DVec3::new(3.0, 0.0, 0.0)), DVec3::new(1.0, 3.0, 0.0));
    }

    #[test]
    fn a_location_undone_is_the_identity() {
        let there_and_back = Location::Composite(vec![(1, 2), (2, -1), (2, 1), (1, -2)]);
        let table = [TURN, STEP, there_and_back];
        let mut placements = Placements::new(&table).unwrap();
        assert_eq!(placements.compose(0, 3), Ok(0));
        let turned = placements.compose(0, 1).unwrap();
        assert_ne!(placements.compose(turned, 2), placements.compose(0, 2));
    }

    #[test]
    fn powers_turn_as_often() {
        for (power, expected) in [(4, DVec3::X), (-1, DVec3::ZERO), (401, DVec3::X + DVec3::Y)] {
            let table = [TURN, Location::Composite(vec![(1, power)])];
            assert!(image(&table, 2, DVec3::X).distance(expected) < 1e-13, "power {power}");
        }
    }

    #[test]
    fn mirrors_are_left_handed() {
        let mut placements = Placements::new(&[MIRROR]).unwrap();
        let once = placements.compose(0, 1).unwrap();
        let twice = placements.compose(once, 1).unwrap();
        assert_eq!(placements.motion(once).unwrap().handedness, -1.0);
        assert_eq!(placements.motion(twice).unwrap().handedness, 1.0);
    }
}

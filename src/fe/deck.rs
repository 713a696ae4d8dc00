//! Abaqus and CalculiX decks (`.inp`): node coordinates in full precision, and elements.
//!
//! Understood are `*NODE`, `*ELEMENT` and `*INCLUDE` with their continuation lines; other keywords
//! are passed over. A node defined again moves, as in CalculiX.

use super::Field;
use super::elements::{ElementKind, Elements};
use super::input::Input;
use super::nodes::{NodeIndex, Rows, first_few};
use super::scan;
use super::source::Format;
use crate::error::{Error, Result, counted};
use glam::DVec3;
use std::path::Path;

/// How deeply decks may include each other.
const DEEPEST_INCLUDE: usize = 8;

/// Results keep six digits and go through single precision: by what fraction of its size a
/// coordinate may differ from the deck's. In tables, which often have fixed decimals, it is a
/// fraction of the model's size.
const RESULT_ROUNDING: f64 = 5.1e-6;

/// Nodes and elements of a deck.
#[derive(Debug, Default)]
pub(super) struct Deck {
    name: String,
    nodes: Rows,
    elements: Elements,
    warnings: Vec<String>,
}

/// What the data lines at hand belong to.
#[derive(Debug, Clone, PartialEq)]
enum Section {
    Other,
    Node,
    /// Elements of a kind, with the nodes still to come for the last one.
    Element(ElementKind, usize),
    /// Elements of a name that is not understood; whether the next line continues one.
    Unknown(String, bool),
}

/// Reads a deck with all it includes.
///
/// # Errors
/// [`Error::Io`] if a file cannot be read, [`Error::Field`] for what cannot be understood.
pub(super) fn read(path: &Path) -> Result<Deck> {
    let mut deck = Deck { name: path.display().to_string(), ..Deck::default() };
    let mut section = Section::Other;
    deck.add(path, &mut section, 0)?;
    if let Section::Element(kind, missing @ 1..) = section {
        let why =
            format!("the deck is truncated: its last {kind} element lacks {}", counted(missing, "node"));
        return Err(Error::Field { path: deck.name, line: 0, why });
    }
    if deck.nodes.len() == 0 {
        let why = "no *NODE block in it: not an Abaqus or CalculiX deck".into();
        return Err(Error::Field { path: deck.name, line: 0, why });
    }
    deck.nodes.sort();
    Ok(deck)
}

impl Deck {
    fn add(&mut self, path: &Path, section: &mut Section, depth: usize) -> Result<()> {
        let mut input = Input::open(path)?;
        self.lines(&mut input, path, section, depth).map_err(|error| input.deeper_cause(error))
    }

    fn lines(&mut self, input: &mut Input, path: &Path, section: &mut Section, depth: usize) -> Result<()> {
        let mut keyword = String::new();
        while let Some(line) = input.next_line()? {
            let line = scan::trim(line);
            if line.starts_with(b"**") || line.is_empty() {
                continue;
            }
            if line[0] == b'*' || !keyword.is_empty() {
                keyword.push_str(&String::from_utf8_lossy(line));
                if !keyword.ends_with(',') {
                    self.keyword(input, path, &keyword, section, depth)?;
                    keyword.clear();
                }
            } else if let Err(expected) = self.data(line, section) {
                let found = scan::excerpt(line);
                return Err(input.error(format!("expected {expected}, found '{found}'")));
            }
        }
        Ok(())
    }

    fn keyword(
        &mut self,
        input: &Input,
        path: &Path,
        line: &str,
        section: &mut Section,
        depth: usize,
    ) -> Result<()> {
        if let Section::Element(kind, missing @ 1..) = section {
            return Err(input
                .error(format!("the {kind} element before this line lacks {}", counted(*missing, "node"))));
        }
        let keyword = Keyword::of(line);
        let next = match keyword.name.as_str() {
            "NODE" => {
                if let Some(system) = keyword.option("SYSTEM").filter(|system| *system != "R") {
                    let why =
                        format!("*NODE with SYSTEM={system} is not understood; write Cartesian coordinates");
                    return Err(input.error(why));
                }
                Section::Node
            }
            "ELEMENT" => {
                let Some(name) = keyword.option("TYPE") else {
                    return Err(input.error("*ELEMENT without TYPE"));
                };
                let name = name.to_ascii_uppercase();
                ElementKind::from_deck(&name)
                    .map_or(Section::Unknown(name, false), |kind| Section::Element(kind, 0))
            }
            "SYSTEM" => return Err(input.error("*SYSTEM is not understood; write Cartesian coordinates")),
            "NGEN" | "NFILL" | "NCOPY" | "NMAP" => {
                let text = format!("nodes that *{} makes are not in the deck's coordinates", keyword.name);
                self.warnings.push(text);
                Section::Other
            }
            "INCLUDE" => section.clone(),
            _ => Section::Other,
        };
        *section = next;
        match keyword.option("INPUT") {
            Some(file) if matches!(keyword.name.as_str(), "INCLUDE" | "NODE" | "ELEMENT") => {
                self.include(input, path, file, section, depth)
            }
            _ => Ok(()),
        }
    }

    fn include(
        &mut self,
        input: &Input,
        path: &Path,
        file: &str,
        section: &mut Section,
        depth: usize,
    ) -> Result<()> {
        if depth == DEEPEST_INCLUDE {
            return Err(input.error(format!("files include each other more than {DEEPEST_INCLUDE} deep")));
        }
        let included = path.parent().unwrap_or(Path::new("")).join(file);
        if !included.is_file() {
            return Err(input.error(format!("the included file '{}' is not there", included.display())));
        }
        self.add(&included, section, depth + 1)
    }

    /// Takes a data line; says what it expected if it cannot.
    fn data(&mut self, line: &[u8], section: &mut Section) -> std::result::Result<(), String> {
        match section {
            Section::Other => Ok(()),
            Section::Node => {
                let (id, point) = node(line).ok_or("a node: number, x, y, z")?;
                self.nodes.push(id, point);
                Ok(())
            }
            Section::Unknown(name, continued) => {
                if !*continued {
                    self.elements.skip(name);
                }
                *continued = line.ends_with(b",");
                Ok(())
            }
            Section::Element(kind, missing) => self
                .element(line, *kind, missing)
                .ok_or_else(|| format!("an element {kind}: its number and {} nodes", kind.nodes())),
        }
    }

    fn element(&mut self, line: &[u8], kind: ElementKind, missing: &mut usize) -> Option<()> {
        let mut rest = line;
        if *missing == 0 {
            (_, rest) = item(rest)?;
            *missing = kind.nodes();
            self.elements.kinds.push(kind);
        }
        while !scan::trim(rest).is_empty() {
            let node;
            (node, rest) = item(rest)?;
            *missing = missing.checked_sub(1)?;
            self.elements.nodes.push(node);
        }
        Some(())
    }

    /// Gives the field this deck's coordinates, and its surface where the field has none.
    ///
    /// # Errors
    /// [`Error::Field`] if deck and results differ by more than the rounding of the results.
    pub fn refine(self, field: &mut Field) -> Result<()> {
        field.source.mesh = Some(self.name.clone());
        field.warnings.extend(self.warnings.iter().cloned());
        let index = NodeIndex::new(&self.nodes.ids);
        let mut absent = Vec::new();
        let mut apart = Vec::new();
        let mut points = field.points.clone();
        let [low, high] = field.bounds();
        let size = if field.source.format == Format::Results { 0.0 } else { low.distance(high) };
        for (point, &id) in points.iter_mut().zip(&field.ids) {
            let Some(place) = index.find(id) else {
                absent.push(id);
                continue;
            };
            let exact = self.nodes.values[place as usize];
            if !agree(*point, exact, size) {
                apart.push((id, *point, exact));
            }
            *point = exact;
        }
        if absent.len() == field.ids.len() {
            return Err(self.foreign(field, "they have no node number in common".into()));
        }
        if !apart.is_empty() {
            return Err(self.foreign(field, differences(&apart, field.ids.len() - absent.len())));
        }
        if !absent.is_empty() {
            let (count, of, first) = (absent.len(), field.ids.len(), first_few(&absent));
            field.warnings.push(format!(
                "{count} of {of} nodes missing in the deck, which keep the results' rounded coordinates: {first}"
            ));
        }
        field.points = points;
        if field.surface_nodes.is_none() {
            self.give_surface(field);
        }
        Ok(())
    }

    fn foreign(&self, field: &Field, why: String) -> Error {
        let why = format!("deck and results ({}) do not belong together: {why}", field.name);
        Error::Field { path: self.name.clone(), line: 0, why }
    }

    /// Extracts the surface on the deck's own nodes, and keeps what the field has of it.
    fn give_surface(self, field: &mut Field) {
        field.source.elements = self.elements.counts();
        let mut mesh = Field { ids: self.nodes.ids, ..Field::default() };
        mesh.set_surface(&self.elements);
        field.warnings.append(&mut mesh.warnings);
        let Some(nodes) = &mesh.surface_nodes else { return };
        let index = NodeIndex::new(&field.ids);
        let own = |node: u32| match node {
            super::NO_NODE => Some(super::NO_NODE),
            node => index.find(mesh.ids[node as usize]),
        };
        field.surface_nodes = Some(nodes.iter().filter_map(|&node| own(node)).collect());
        field.mid_sides = kept(&mesh.mid_sides, own);
        field.surface_faces = kept(&mesh.surface_faces, own);
    }
}

/// The groups of nodes that are all there, renumbered.
fn kept<const N: usize>(groups: &[[u32; N]], own: impl Fn(u32) -> Option<u32>) -> Vec<[u32; N]> {
    let renumber = |group: &[u32; N]| {
        let mut renumbered = [0; N];
        for (place, &node) in renumbered.iter_mut().zip(group) {
            *place = own(node)?;
        }
        Some(renumbered)
    };
    groups.iter().filter_map(renumber).collect()
}

/// Whether a point of the results is the deck's, rounded to six digits of itself, or of `size`.
fn agree(rounded: DVec3, exact: DVec3, size: f64) -> bool {
    let tolerance = RESULT_ROUNDING * rounded.abs().max(exact.abs()).max(DVec3::splat(size));
    (rounded - exact).abs().cmple(tolerance).all()
}

fn differences(apart: &[(i64, DVec3, DVec3)], common: usize) -> String {
    let distance = |row: &&(i64, DVec3, DVec3)| row.1.distance(row.2);
    let worst = apart.iter().max_by(|a, b| distance(a).total_cmp(&distance(b)));
    let at = worst.map_or(String::new(), |row| {
        let (id, rounded, exact) = row;
        format!(", by up to {:.6} at node {id} (results {rounded}, deck {exact})", distance(&row))
    });
    format!("{} of {common} common nodes differ by more than the results' six digits{at}", apart.len())
}

/// A node line: number and coordinates, of which the last may be missing and are then zero.
fn node(line: &[u8]) -> Option<(i64, DVec3)> {
    let (id, mut rest) = item(line)?;
    let mut point = [0.0; 3];
    for coordinate in &mut point {
        if scan::trim(rest).is_empty() {
            break;
        }
        (*coordinate, rest) = scan::number(rest, false)?;
        rest = after_comma(rest)?;
    }
    DVec3::from(point).is_finite().then_some((id, point.into()))
}

/// An integer and what comes after its comma.
fn item(text: &[u8]) -> Option<(i64, &[u8])> {
    let (value, rest) = scan::integer(text)?;
    Some((value, after_comma(rest)?))
}

fn after_comma(text: &[u8]) -> Option<&[u8]> {
    match scan::skip_blanks(text) {
        [] => Some(&[]),
        [b',', rest @ ..] => Some(rest),
        _ => None,
    }
}

/// A keyword line: name in capitals without blanks, and options as written.
struct Keyword {
    name: String,
    options: Vec<(String, String)>,
}

impl Keyword {
    fn of(line: &str) -> Self {
        let mut parts = line.trim_start_matches('*').split(',');
        let name = parts.next().unwrap_or("").split_whitespace().collect::<String>().to_ascii_uppercase();
        let option = |part: &str| {
            let (key, value) = part.split_once('=')?;
            Some((key.trim().to_ascii_uppercase(), value.trim().trim_matches('"').to_string()))
        };
        Self { name, options: parts.filter_map(option).collect() }
    }

    fn option(&self, key: &str) -> Option<&str> {
        self.options.iter().find(|(known, _)| known == key).map(|(_, value)| value.as_str())
    }
}

//! Which column of a table holds what, by place or by the names that common programs give.

/// Names of a node's number, as [`plain`] leaves them.
const IDS: [&str; 12] = [
    "id",
    "nodeid",
    "node",
    "nodelabel",
    "nodenumber",
    "nodeno",
    "label",
    "nid",
    "number",
    "knoten",
    "pointid",
    "n",
];

/// Names of coordinates; `@` stands for the axis.
const POSITIONS: [&str; 11] = [
    "@",
    "@0",
    "coord@",
    "coor@",
    "coords@",
    "coordinate@",
    "@coord",
    "@coordinate",
    "@location",
    "point@",
    "points@",
];

/// Names of displacements; `@` stands for the axis.
const DISPLACEMENTS: [&str; 12] = [
    "d@",
    "u@",
    "disp@",
    "displacement@",
    "displacements@",
    "@displacement",
    "deformation@",
    "@deformation",
    "verschiebung@",
    "uu@",
    "ud@",
    "t@",
];

/// What programs call the three axes.
const AXES: [[&str; 3]; 3] = [["x", "y", "z"], ["0", "1", "2"], ["1", "2", "3"]];

/// What a table must have, for messages.
const EXPECTED: &str = "id,x,y,z,dx,dy,dz, or the same without id";

/// Places of the columns, from 0.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Columns {
    pub id: Option<usize>,
    pub position: [usize; 3],
    pub displacement: [usize; 3],
    /// How many columns a row has.
    pub width: usize,
}

impl Columns {
    /// The columns of a table without a header, from its first row.
    pub fn by_place(cells: &[&[u8]]) -> Result<Self, String> {
        let trailing = cells.last().is_some_and(|cell| cell.is_empty());
        match (cells.len(), trailing) {
            (7, _) | (8, true) => {
                Ok(Self { id: Some(0), position: [1, 2, 3], displacement: [4, 5, 6], width: 7 })
            }
            (6, _) => Ok(Self { id: None, position: [0, 1, 2], displacement: [3, 4, 5], width: 6 }),
            (count, _) => Err(format!("{count} columns of numbers without a header; expected {EXPECTED}")),
        }
    }

    /// The columns that a header names.
    pub fn by_name(cells: &[&[u8]]) -> Result<Self, String> {
        let names: Vec<String> = cells.iter().map(|cell| plain(cell)).collect();
        let place = |name: &str| names.iter().position(|other| other == name);
        let width = if names.last().is_some_and(String::is_empty) { names.len() - 1 } else { names.len() };
        let triple = |what, patterns: &[&str]| {
            find_triple(patterns, place).ok_or_else(|| {
                let found =
                    cells.iter().map(|cell| String::from_utf8_lossy(cell)).collect::<Vec<_>>().join(", ");
                format!("the header names no three columns of {what}; expected {EXPECTED}; found {found}")
            })
        };
        let position = triple("coordinates", &POSITIONS)?;
        let displacement = match [place("u"), place("v"), place("w")] {
            [Some(u), Some(v), Some(w)] => [u, v, w],
            _ => triple("displacements", &DISPLACEMENTS)?,
        };
        let columns = Self { id: IDS.iter().find_map(|&name| place(name)), position, displacement, width };
        columns.check_unique(&names)?;
        Ok(columns)
    }

    fn check_unique(&self, names: &[String]) -> Result<(), String> {
        let used = self.position.iter().chain(&self.displacement).chain(&self.id);
        let twice = used
            .map(|&column| &names[column])
            .find(|&name| names.iter().filter(|&other| other == name).count() > 1);
        twice.map_or(Ok(()), |name| Err(format!("the header has more than one column '{name}'")))
    }
}

/// The first three columns whose names follow one pattern.
fn find_triple(patterns: &[&str], place: impl Fn(&str) -> Option<usize>) -> Option<[usize; 3]> {
    let named = |pattern: &str, axes: [&str; 3]| {
        let [x, y, z] = axes.map(|axis| place(&pattern.replace('@', axis)));
        Some([x?, y?, z?])
    };
    patterns.iter().find_map(|pattern| {
        // A bare digit is no name.
        let axes = if *pattern == "@" { &AXES[..1] } else { &AXES[..] };
        axes.iter().find_map(|&axes| named(pattern, axes))
    })
}

/// A column's name in small letters, without its unit, blanks and punctuation.
fn plain(cell: &[u8]) -> String {
    let text = String::from_utf8_lossy(cell).to_lowercase();
    let bare = text.split(['[', '(']).next().unwrap_or("");
    let name: String = bare.chars().filter(|c| c.is_alphanumeric()).collect();
    name.strip_suffix("mm").unwrap_or(&name).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns(header: &str) -> Result<Columns, String> {
        Columns::by_name(&header.split(',').map(str::as_bytes).collect::<Vec<_>>())
    }

    #[test]
    fn names_of_common_programs_are_understood() {
        let expected = Columns { id: Some(0), position: [1, 2, 3], displacement: [4, 5, 6], width: 7 };
        for header in [
            "id,x,y,z,dx,dy,dz",
            "Node,X,Y,Z,UX,UY,UZ",
            "Node Number,X Location (mm),Y Location (mm),Z Location (mm),Deformation X,Deformation Y,Deformation Z",
            "Node Label,COORD.1,COORD.2,COORD.3,U.U1,U.U2,U.U3",
            "Point ID,Points:0,Points:1,Points:2,U:0,U:1,U:2",
            "n,x,y,z,u,v,w",
            "nid,x [mm],y [mm],z [mm],T1,T2,T3",
            "id,x0,y0,z0,disp_x,disp_y,disp_z",
            "id,x_mm,y_mm,z_mm,ux_mm,uy_mm,uz_mm",
        ] {
            assert_eq!(columns(header).as_ref(), Ok(&expected), "{header}");
        }
    }

    #[test]
    fn order_and_further_columns_do_not_matter() {
        let found = columns("|U|,u1,u2,u3,T,x,y,z,").unwrap();
        assert_eq!(found, Columns { id: None, position: [5, 6, 7], displacement: [1, 2, 3], width: 8 });
    }

    #[test]
    fn what_a_header_lacks_or_has_twice_is_named() {
        assert!(columns("id,x,y,z,dx,dy").unwrap_err().contains("displacements"));
        assert!(columns("id,a,b,c,dx,dy,dz").unwrap_err().contains("coordinates"));
        assert!(columns("id,x,y,z,dx,dy,dz,x").unwrap_err().contains("'x'"));
    }
}

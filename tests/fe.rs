//! Reading fields: the small case with all its awkward variants, and hard files of other kinds.

#[path = "common/p5.rs"]
mod p5;

#[test]
fn variants_made_here_are_the_shared_files() {
    let Some(data) = std::env::var_os("BLADESMITH_DATA") else {
        return println!("skipped: BLADESMITH_DATA names no folder with P5");
    };
    for name in p5::VARIANTS {
        let path = std::path::Path::new(&data).join(format!("P5/{name}.frd"));
        let shared =
            std::fs::read_to_string(&path).unwrap_or_else(|cause| panic!("{}: {cause}", path.display()));
        let made = p5::variant(name);
        if name == "gaps_shuffled" {
            let sorted = |text: &str| -> Vec<String> {
                let mut lines: Vec<String> = text.lines().map(String::from).collect();
                lines.sort();
                lines
            };
            assert!(sorted(&made) == sorted(&shared), "{name}: other rows");
            continue;
        }
        let first = made.lines().zip(shared.lines()).position(|(a, b)| a != b);
        assert!(made == shared, "{name}: differs, first at line index {first:?}");
    }
}

//! Scripts that play the simulator models, each one file to run.

/// Reads the law of motion; what both scripts share.
const LAW: &str = include_str!("law.py");

/// Where a script takes it in.
const IMPORT: &str = "# isort: split\nfrom law import Law\n";

/// Plays the MJCF model by its law or through tooth contact alone.
pub(super) fn mujoco() -> Vec<u8> {
    whole(include_str!("play_mujoco.py"))
}

/// Plays the URDF model by its law.
pub(super) fn pybullet() -> Vec<u8> {
    whole(include_str!("play_pybullet.py"))
}

/// A script with the class in the place of its import.
pub(crate) fn whole(script: &str) -> Vec<u8> {
    let class = LAW.find("class ").map_or("", |at| &LAW[at..]);
    script.replace(IMPORT, &format!("\n{class}\n")).into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scripts_need_no_other_file() {
        for script in [mujoco(), pybullet()] {
            let script = String::from_utf8(script).expect("text");
            assert_eq!(script.matches("class Law:").count(), 1);
            assert!(!script.contains("from law") && script.contains("def __call__"));
        }
    }
}

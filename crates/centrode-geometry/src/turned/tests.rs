use std::f64::consts::PI;

use super::*;

const SLOT: TurnedSlot = TurnedSlot {
    width: 5.0,
    foot: 5.0,
};

fn cylinder(length: f64, diameter: f64) -> TurnedSection {
    TurnedSection::cylinder(length, 0.5 * diameter)
}

fn chamfer(length: f64, radii: [f64; 2]) -> TurnedSection {
    TurnedSection {
        length,
        radii,
        slotted: false,
    }
}

/// Shafts with every kind of shoulder.
fn shafts() -> Vec<Turned> {
    let all = [
        vec![cylinder(10.0, 8.0)],
        vec![
            chamfer(1.0, [7.0, 8.0]).slotted(),
            cylinder(20.0, 16.0).slotted(),
            cylinder(10.0, 16.0),
            cylinder(1.1, 15.2),
            cylinder(10.0, 16.0).slotted(),
            chamfer(1.0, [8.0, 7.0]).slotted(),
        ],
        // A groove through the slot, a wider step, a narrow one within the floor.
        vec![
            cylinder(2.0, 16.0).slotted(),
            cylinder(1.1, 15.2).slotted(),
            cylinder(12.0, 16.0).slotted(),
            cylinder(5.0, 20.0),
            cylinder(8.0, 16.0).slotted(),
            cylinder(3.0, 9.0),
        ],
        vec![
            cylinder(4.0, 15.0),
            cylinder(12.0, 16.0).slotted(),
            cylinder(4.0, 15.0).slotted(),
        ],
    ];
    all.map(|sections| Turned::new(-3.0, sections, Some(SLOT)).expect("a shaft"))
        .into()
}

#[test]
fn every_kind_of_shoulder_and_slot_is_closed() {
    for shaft in shafts() {
        assert!(shaft.shell().is_closed());
    }
}

#[test]
fn the_volume_is_the_closed_form_and_that_of_the_mesh() {
    let [pin, ..] = &shafts()[..] else {
        panic!("shafts");
    };
    assert!((pin.volume() - PI * 160.0).abs() < 1e-9);
    // Slot of 5 mm on 16 mm: two triangles and a sector less the floor.
    let keyed = Turned::new(0.0, vec![cylinder(20.0, 16.0).slotted()], Some(SLOT));
    let sector = 2.5 * 57.75_f64.sqrt() + 64.0 * 0.3125_f64.asin() - 25.0;
    let exact = 20.0 * (PI * 64.0 - sector);
    assert!((keyed.expect("a shaft").volume() - exact).abs() < 1e-9);
    let fine = Tolerance::new(1e-4).expect("a tolerance");
    for shaft in shafts() {
        let mesh = shaft.mesh(fine).expect("a mesh");
        assert!(mesh.is_watertight());
        let off = (mesh.volume() - shaft.volume()).abs() / shaft.volume();
        assert!(off < 1e-4, "{off}");
    }
}

#[test]
fn sections_that_are_none_are_told() {
    let section = |sections: Vec<TurnedSection>| match Turned::new(0.0, sections, Some(SLOT)) {
        Err(SolidError::Turned { section }) => section,
        other => panic!("{other:?}"),
    };
    assert_eq!(section(vec![]), 0);
    assert_eq!(section(vec![cylinder(1.0, 8.0), cylinder(0.0, 8.0)]), 1);
    assert_eq!(section(vec![chamfer(2.0, [3.0, 4.0])]), 0);
    // The floor of the slot lies outside, and a circle beside it cuts its floor.
    assert_eq!(section(vec![cylinder(5.0, 10.0).slotted()]), 0);
    let cut = vec![cylinder(5.0, 16.0).slotted(), cylinder(5.0, 10.5)];
    assert_eq!(section(cut), 1);
    assert!(Turned::new(f64::NAN, vec![cylinder(1.0, 8.0)], None).is_err());
}

#[test]
fn moments_are_those_of_the_tetrahedra_of_a_fine_mesh() {
    for shaft in shafts() {
        let mesh = shaft.mesh(Tolerance::new(1e-4).expect("positive"));
        let mesh = mesh.expect("a mesh");
        let mut sum = VolumeMoments::default();
        for face in &mesh.faces {
            let corners = face.map(|i| Vector3::from(mesh.vertices[i as usize]));
            let all: Vector3<f64> = corners.iter().sum();
            let volume = corners[0].dot(&corners[1].cross(&corners[2])) / 6.0;
            sum.volume += volume;
            sum.first += all * (volume / 4.0);
            let own: Matrix3<f64> = corners.iter().map(|p| p * p.transpose()).sum();
            sum.second += (own + all * all.transpose()) * (volume / 20.0);
        }
        let exact = shaft.moments();
        assert!((exact.volume - shaft.volume()).abs() < 1e-12 * exact.volume);
        let near = |a: f64, b: f64, size: f64| (a - b).abs() < 1e-4 * size;
        assert!(near(sum.volume, exact.volume, exact.volume));
        assert!((sum.first - exact.first).norm() < 1e-4 * exact.first.norm());
        assert!((sum.second - exact.second).norm() < 1e-4 * exact.second.norm());
        let slotted = shaft.sections().iter().any(|section| section.slotted);
        assert_eq!(exact.first.x < -1.0, slotted, "the slot is at x > 0");
        // Of the smaller moments, too.
        for [i, j] in [[0, 0], [1, 1]] {
            assert!(near(
                sum.second[(i, j)],
                exact.second[(i, j)],
                exact.second[(i, j)]
            ));
        }
    }
}

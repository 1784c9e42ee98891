use std::f64::consts::PI;

use super::*;

const SLOT: TurnedSlot = TurnedSlot {
    width: 5.0,
    floor: 5.0,
    rounded: false,
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
    let rounded = TurnedSlot {
        rounded: true,
        ..SLOT
    };
    let both = [SLOT, rounded].into_iter().flat_map(|slot| {
        let shaft = move |sections: Vec<TurnedSection>| {
            Turned::new(-3.0, sections, Some(slot)).expect("a shaft")
        };
        all.clone().map(shaft)
    });
    // Half round ends towards each other, one at a groove, and one that takes all of its cylinder.
    let more = [
        vec![
            cylinder(6.0, 16.0).slotted(),
            cylinder(3.0, 16.0),
            cylinder(8.0, 16.0).slotted(),
            cylinder(2.0, 16.0),
        ],
        vec![
            cylinder(8.0, 16.0),
            cylinder(2.5, 16.0).slotted(),
            cylinder(1.1, 15.2).slotted(),
            cylinder(9.0, 16.0).slotted(),
        ],
    ];
    let more = more.map(|sections| Turned::new(1.0, sections, Some(rounded)).expect("a shaft"));
    both.chain(more).collect()
}

#[test]
fn a_half_round_end_takes_less_than_a_plane_one_by_the_corners() {
    let shaft = |rounded: bool| {
        let slot = TurnedSlot { rounded, ..SLOT };
        let sections = vec![cylinder(10.0, 16.0).slotted(), cylinder(10.0, 16.0)];
        Turned::new(0.0, sections, Some(slot)).expect("a shaft")
    };
    // Between a half disc and the half square around it, by the midpoints of fine strips.
    let count = 200_000;
    let corners: f64 = (0..count)
        .map(|i| {
            let y: f64 = 2.5 * (f64::from(i) + 0.5) / f64::from(count);
            let depth = 2.5 - (6.25 - y * y).sqrt();
            2.0 * depth * ((64.0 - y * y).sqrt() - 5.0) * 2.5 / f64::from(count)
        })
        .sum();
    let more = shaft(true).volume() - shaft(false).volume();
    assert!((more - corners).abs() < 1e-7, "{more} {corners}");
    assert_eq!(shaft(true).levels(), [0.0, 10.0, 20.0]);
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
fn impossible_sections_are_errors() {
    let section = |sections: Vec<TurnedSection>| match Turned::new(0.0, sections, Some(SLOT)) {
        Err(SolidError::Turned { section }) => section,
        other => panic!("{other:?}"),
    };
    assert_eq!(section(vec![]), 0);
    assert_eq!(section(vec![cylinder(1.0, 8.0), cylinder(0.0, 8.0)]), 1);
    assert_eq!(section(vec![chamfer(2.0, [3.0, 4.0])]), 0);
    // The floor of the slot lies outside, and a circle next to it cuts its floor.
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

use serde::{Serialize, Serializer};

use super::{Contacts, Handle, Mark, Motion, Path, Picture};

/// A picture in its written form: each link has the index of its shape.
#[derive(Serialize)]
struct Scene<'a> {
    shapes: Vec<&'a [Path]>,
    links: Vec<Placed<'a>>,
    motion: &'a Motion,
    handles: &'a [Handle],
    marks: &'a [Mark],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    contacts: &'a [Contacts],
    extent: [f64; 4],
}

#[derive(Serialize)]
struct Placed<'a> {
    name: &'a str,
    shape: usize,
}

impl Serialize for Picture {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut shapes: Vec<&[Path]> = Vec::new();
        let links = self.links.iter().map(|link| {
            let known = shapes.iter().position(|shape| *shape == link.paths);
            let shape = known.unwrap_or_else(|| {
                shapes.push(&link.paths);
                shapes.len() - 1
            });
            let name = &link.name;
            Placed { name, shape }
        });
        let links = links.collect();
        let Self {
            motion,
            handles,
            marks,
            contacts,
            extent,
            ..
        } = self;
        let scene = Scene {
            shapes,
            links,
            motion,
            handles,
            marks,
            contacts,
            extent: *extent,
        };
        scene.serialize(serializer)
    }
}

#[cfg(test)]
mod tests {
    use super::super::PictureLink;
    use super::*;
    use centrode_geometry::Point;
    use centrode_kinematics::machine::LineRole;

    #[test]
    fn parts_that_look_alike_share_a_shape() {
        let bar = |length| {
            vec![Path::open(
                LineRole::Bar,
                &[Point::origin(), Point::new(length, 0.0)],
            )]
        };
        let link = |(name, length): (&str, f64)| PictureLink {
            name: name.into(),
            paths: bar(length),
        };
        let picture = Picture {
            links: [("a", 1.0), ("b", 2.0), ("c", 1.0)].map(link).into(),
            ..Picture::default()
        };
        let json = serde_json::to_value(&picture).expect("JSON");
        let shapes: Vec<_> = (0..3).map(|i| json["links"][i]["shape"].as_u64()).collect();
        assert_eq!(shapes, [Some(0), Some(1), Some(0)]);
        assert_eq!(json["shapes"][1][0]["vertices"][3], 2.0);
        assert_eq!(json["shapes"].as_array().map(Vec::len), Some(2));
    }
}

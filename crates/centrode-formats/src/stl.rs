//! Binary STL meshes.

use centrode_geometry::{Mesh, checkpoint};

/// Writes a mesh as binary STL, in the mesh's own units (mm).
///
/// Coordinates are single precision, as the format requires; a triangle that becomes degenerate by rounding is omitted, and the
/// rest stays closed.
#[must_use]
pub fn write(mesh: &Mesh) -> Vec<u8> {
    let rounded: Vec<[f32; 3]> = mesh
        .vertices
        .iter()
        .map(|v| v.map(|x| x as f32 + 0.0))
        .collect();
    let kept: Vec<&[u32; 3]> = mesh
        .faces
        .iter()
        .filter(|face| {
            let [a, b, c] = face.map(|v| rounded[v as usize]);
            a != b && b != c && c != a
        })
        .collect();
    // The header must not begin with "solid", the mark of the text form.
    let mut header = [b' '; 80];
    let words = b"binary STL, millimetres";
    header[..words.len()].copy_from_slice(words);
    let mut bytes = Vec::with_capacity(84 + 50 * kept.len());
    bytes.extend_from_slice(&header);
    bytes.extend_from_slice(&(kept.len() as u32).to_le_bytes());
    for face in kept {
        checkpoint();
        for x in normal(&mesh.triangle(face)) {
            bytes.extend_from_slice(&(x as f32 + 0.0).to_le_bytes());
        }
        for vertex in face {
            for x in rounded[*vertex as usize] {
                bytes.extend_from_slice(&x.to_le_bytes());
            }
        }
        bytes.extend_from_slice(&[0, 0]);
    }
    bytes
}

/// Unit normal of a triangle, zero for a degenerate one.
fn normal(triangle: &[[f64; 3]; 3]) -> [f64; 3] {
    let [a, b, c] = triangle;
    let u = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
    let v = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
    let n = [
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
    ];
    let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
    if length > 0.0 {
        n.map(|x| x / length)
    } else {
        [0.0; 3]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_geometry::{Outline, Point, Solid, Tolerance};

    #[test]
    fn a_tube_reads_back_closed_with_its_volume() {
        let tube = Solid::new(
            Outline::circle(Point::origin(), 20.0),
            vec![Outline::circle(Point::new(1.0, 0.0), 8.0)],
            0.0,
            12.0,
        )
        .expect("has height");
        let mesh = tube
            .mesh(Tolerance::new(1e-3).expect("positive"))
            .expect("apart");
        let bytes = write(&mesh);
        assert_eq!(bytes, write(&mesh));
        let float = |at: usize| {
            f64::from(f32::from_le_bytes([
                bytes[at],
                bytes[at + 1],
                bytes[at + 2],
                bytes[at + 3],
            ]))
        };
        let count = u32::from_le_bytes([bytes[80], bytes[81], bytes[82], bytes[83]]) as usize;
        assert_eq!(bytes.len(), 84 + 50 * count);
        assert_eq!(count, mesh.faces.len());
        let mut volume = 0.0;
        for k in 0..count {
            let at = 84 + 50 * k;
            let p: Vec<f64> = (0..12).map(|i| float(at + 4 * i)).collect();
            let (n, a, b, c) = (&p[0..3], &p[3..6], &p[6..9], &p[9..12]);
            let flux = [a, b, c]
                .iter()
                .map(|q| q[0] * n[0] + q[1] * n[1] + q[2] * n[2])
                .sum::<f64>()
                / 3.0;
            let u: Vec<f64> = (0..3).map(|i| b[i] - a[i]).collect();
            let v: Vec<f64> = (0..3).map(|i| c[i] - a[i]).collect();
            let cross = (u[1] * v[2] - u[2] * v[1])
                .hypot((u[2] * v[0] - u[0] * v[2]).hypot(u[0] * v[1] - u[1] * v[0]));
            volume += flux * 0.5 * cross / 3.0;
        }
        assert!((volume / tube.volume() - 1.0).abs() < 2e-4, "{volume}");
    }
}

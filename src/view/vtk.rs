//! The motion for ParaView and other programs that read VTK: a file of polygons a frame (`.vtp`), and one that says when each is (`.pvd`).
//!
//! Source: VTK File Formats, The VTK User's Guide (2010), chapter 19.3 (XML; binary data in base64 after its number of bytes).

use super::numbers::base64;
use super::recording::Recording;
use super::surface::{BodySurface, surfaces};

/// Files of a run: name, content. The first names the others, with their times.
pub fn vtk(recording: &Recording) -> impl Iterator<Item = (String, String)> + '_ {
    let surfaces = surfaces(recording);
    let file = |frame: usize| format!("frame_{frame:04}.vtp");
    let sets = recording.times.iter().enumerate();
    let sets = sets.map(|(frame, time)| {
        format!(
            "    <DataSet timestep=\"{time:?}\" file=\"{}\"/>\n",
            file(frame)
        )
    });
    let series = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  <Collection>\n{}  \
         </Collection>\n</VTKFile>\n",
        sets.collect::<String>()
    );
    let frames = (0..recording.times.len())
        .map(move |frame| (file(frame), polygons(recording, &surfaces, frame)));
    std::iter::once(("motion.pvd".to_owned(), series)).chain(frames)
}

fn polygons(recording: &Recording, surfaces: &[BodySurface], frame: usize) -> String {
    let (mut points, mut corners, mut ends, mut bodies) =
        (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for (body, surface) in surfaces.iter().enumerate() {
        let (first, places) = (points.len() / 3, surface.places(recording, frame));
        for (number, (place, _)) in surface.points.iter().enumerate() {
            let local = surface.local(number, recording, frame);
            points.extend(places[*place].at(&local).iter().map(|x| *x as f32));
        }
        for face in &surface.faces {
            corners.extend(face.iter().map(|point| (first + point) as i32));
            ends.push(corners.len() as i32);
            bodies.push(body as i32);
        }
    }
    let array = |kind: &str, more: &str, bytes: Vec<u8>| {
        let length = (bytes.len() as u32).to_le_bytes();
        let block = base64(&[&length[..], &bytes].concat());
        format!("<DataArray type=\"{kind}\" {more} format=\"binary\">{block}</DataArray>\n")
    };
    let integers = |name: &str, values: &[i32]| {
        let bytes = values.iter().flat_map(|value| value.to_le_bytes());
        array("Int32", &format!("Name=\"{name}\""), bytes.collect())
    };
    let bytes = points.iter().flat_map(|value: &f32| value.to_le_bytes());
    let places = array(
        "Float32",
        "Name=\"Points\" NumberOfComponents=\"3\"",
        bytes.collect(),
    );
    let stress = stresses(surfaces, frame).map_or_else(String::new, |stresses| {
        let bytes = stresses.iter().flat_map(|value| value.to_le_bytes());
        let values = array("Float32", "Name=\"von_mises_stress\"", bytes.collect());
        format!("<PointData Scalars=\"von_mises_stress\">\n{values}</PointData>\n")
    });
    let names: Vec<String> = surfaces
        .iter()
        .map(|surface| surface.name.clone())
        .collect();
    format!(
        "<?xml version=\"1.0\"?>\n<!-- body: {} -->\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt32\">\n\
         <PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n\
         {stress}<CellData Scalars=\"body\">\n{}</CellData>\n<Points>\n{places}</Points>\n<Polys>\n{}{}</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n",
        names.join(", "),
        points.len() / 3,
        ends.len(),
        integers("body", &bodies),
        integers("connectivity", &corners),
        integers("offsets", &ends),
    )
}

/// Stress of von Mises at all points in a frame, Pa, no number where a body has none; nothing where no body has.
fn stresses(surfaces: &[BodySurface], frame: usize) -> Option<Vec<f32>> {
    if surfaces.iter().all(|surface| surface.stresses.is_empty()) {
        return None;
    }
    let of = |surface: &BodySurface| match surface.stresses.get(frame) {
        Some(stresses) => stresses.iter().map(|stress| *stress as f32).collect(),
        None => vec![f32::NAN; surface.points.len()],
    };
    Some(surfaces.iter().flat_map(of).collect())
}

//! What of a picture does not change in time, as JSON, and the numbers that do.

use super::actions::{MovingAction, Where, actions};
use super::numbers::{Numbers, list, quoted};
use super::recording::Recording;
use super::sections::{SectionStress, has_corners, sections};
use super::sheets::SheetModes;
use super::skins::MovingSkin;
use super::symbols::SymbolTable;
use crate::math::rotation::{Quaternion, quaternion, quaternion_near};
use crate::picture::symbols::load;
use crate::picture::{Mark, MarkLabel, marks, palette};
use crate::scene::{
    BodyReference, Cable, Ends, First, Inertia, LineBody, Place, Reduced, Resolved, ResolvedMarker,
    Rigid, RigidBody, Solid,
};
use crate::simulation::Pose;

/// Header and numbers of a page.
pub(super) fn header(recording: &Recording) -> (String, String) {
    let scene = &recording.scene;
    let resolved = scene.resolved();
    let mut numbers = Numbers::default();
    let column = |times: &[f64]| times.iter().map(|time| vec![*time]).collect::<Vec<_>>();
    let times = numbers.exact(&column(&recording.times));
    let row_times = numbers.exact(&column(&recording.row_times));
    let table = numbers.exact(&recording.rows);
    let bodies = || resolved.bodies.iter().enumerate();
    let skins: Vec<Option<MovingSkin<'_>>> = bodies()
        .map(|(place, body)| MovingSkin::of(recording, place, *body))
        .collect();
    let bodies: Vec<String> = bodies()
        .zip(&skins)
        .map(|((place, body), skin)| {
            let moved = skin
                .as_ref()
                .map(|skin| of_skin(recording, skin, &mut numbers));
            of_body(recording, &resolved, (place, *body), moved, &mut numbers)
        })
        .collect();
    let mut symbols = SymbolTable::default();
    let acting = actions(&resolved);
    let acting: Vec<String> = acting
        .iter()
        .enumerate()
        .map(|(place, action)| of_action(recording, place, action, &mut numbers, &mut symbols))
        .collect();
    let markers = list(&resolved.markers, |marker| {
        of_marker(&resolved, marker, &skins, &recording.sheets)
    });
    let marks = marks(&resolved);
    let marks = list(&marks, |mark| of_mark(recording, mark, &mut symbols));
    let surfaces = list(of_surfaces(recording, &resolved), |text| text);
    let outputs = list(&recording.outputs, |output| {
        format!(
            "{{\"name\":{},\"unit\":{},\"roundoff\":{:e}}}",
            quoted(&output.name),
            quoted(&output.unit),
            output.roundoff
        )
    });
    let (tracks, encoded) = numbers.finish();
    let header = format!(
        "{{\"name\":{},\"dimension\":{},\"gravity\":{:?},\"times\":{times},\"row_times\":{row_times},\"table\":{table},\
         \"bodies\":[{}],\"markers\":{markers},\"marks\":{marks},\"surfaces\":{surfaces},\"actions\":[{}],\"outputs\":{outputs},\
         \"tracks\":[{tracks}],{}}}",
        quoted(&scene.name),
        scene.dimension,
        &scene.gravity.full()[..scene.dimension],
        bodies.join(","),
        acting.join(","),
        symbols.finish(),
    );
    (header, encoded)
}

fn of_body(
    recording: &Recording,
    resolved: &Resolved<'_>,
    (place, body): (usize, BodyReference<'_>),
    skin: Option<String>,
    numbers: &mut Numbers,
) -> String {
    let first = &recording.poses[0][place];
    let (nodes, turns) = (first.nodes.len(), !first.axes.is_empty());
    let is_chain = matches!(body, BodyReference::Cable(_));
    // Quaternions of frames are to be near those that bodies are drawn with.
    let drawn = &recording.drawn[place];
    let stances = drawn.axes.iter();
    let mut held: Vec<_> = stances
        .map(|axes| quaternion(&axes.map(Into::into)))
        .collect();
    let dimension = recording.scene.dimension;
    let drawn = row(drawn, dimension, is_chain, &mut held);
    let rows: Vec<Vec<f64>> = (recording.poses.iter())
        .map(|poses| row(&poses[place], dimension, is_chain, &mut held))
        .collect();
    let (track, drawn) = (numbers.stepped(&rows), numbers.stepped(&[drawn]));
    let shape = match body {
        BodyReference::Cable(cable) => {
            let stresses =
                SectionStress::of(cable.body, &mesh(resolved, cable), resolved.scene.dimension);
            of_cable(resolved, cable) + &of_forces(recording, place, &stresses, numbers)
        }
        BodyReference::Rigid(rigid) => of_rigid(rigid),
        BodyReference::Reduced(reduced) => skin.unwrap_or_else(|| of_reduced(reduced)),
        BodyReference::Plate(plate) => {
            let sheet = recording.sheets[place].as_ref();
            let sheet = sheet.map(|of| of.to_json(plate.body, &recording.poses, place, numbers));
            sheet.unwrap_or_default()
        }
    };
    format!(
        "{{\"name\":{},\"nodes\":{nodes},\"turns\":{turns},\"track\":{track},\"drawn\":{drawn},{shape}}}",
        quoted(body.name())
    )
}

/// Axial force, bending moment and largest normal stress at the nodes of a flexible body, in every frame.
fn of_forces(
    recording: &Recording,
    place: usize,
    stresses: &[SectionStress],
    numbers: &mut Numbers,
) -> String {
    let at = |(forces, stress): (&[f64; 3], &SectionStress)| {
        [
            forces[0],
            forces[1].hypot(forces[2]),
            stress.largest(*forces),
        ]
    };
    let row =
        |forces: &Vec<Vec<[f64; 3]>>| forces[place].iter().zip(stresses).flat_map(at).collect();
    let rows: Vec<Vec<f64>> = recording.forces.iter().map(row).collect();
    if rows[0].is_empty() {
        String::new()
    } else {
        format!(",\"forces\":{}", numbers.stepped(&rows))
    }
}

/// Numbers of a body in one frame, node by node: position, slope but of rigid bodies in space, how sections or frames stand.
fn row(pose: &Pose, dimension: usize, is_chain: bool, held: &mut [Quaternion]) -> Vec<f64> {
    let mut row = Vec::new();
    for (node, [position, slope]) in pose.nodes.iter().enumerate() {
        row.extend(&position[..dimension]);
        if is_chain || dimension == 2 {
            row.extend(&slope[..dimension]);
        }
        let Some(axes) = pose.axes.get(node) else {
            continue;
        };
        if dimension == 2 {
            row.extend(&axes[0][..2]);
            continue;
        }
        let turn = quaternion_near(&axes.map(Into::into), &held[node]);
        held[node] = turn;
        row.extend(turn);
    }
    row
}

/// Material coordinates of nodes.
pub(super) fn mesh(resolved: &Resolved<'_>, cable: Cable<'_>) -> Vec<f64> {
    if cable.is_rigid() {
        vec![0.0, 1.0]
    } else {
        resolved.nodes(cable).unwrap_or_else(|_| vec![0.0, 1.0])
    }
}

fn lengths(body: &LineBody, mesh: &[f64]) -> Vec<f64> {
    let whole = body.shape.length();
    mesh.windows(2)
        .map(|ends| (ends[1] - ends[0]) * whole)
        .collect()
}

fn of_cable(resolved: &Resolved<'_>, cable: Cable<'_>) -> String {
    let (body, mesh) = (cable.body, mesh(resolved, cable));
    let mut sections = sections(body, &mesh);
    if sections.windows(2).all(|pair| pair[0] == pair[1]) {
        sections.truncate(1);
    }
    format!(
        "\"lengths\":{:?},\"sections\":{:?},\"corners\":{}",
        lengths(body, &mesh),
        sections,
        has_corners(body)
    )
}

fn of_rigid(rigid: Rigid<'_>) -> String {
    let body = rigid.body;
    let mut points = vec![[0.0; 3]];
    for point in body.markers.values() {
        let point = point.full();
        if !points.contains(&point) {
            points.push(point);
        }
    }
    let solid = match body.shape {
        None => "null".into(),
        Some(Solid::Box { size }) => format!("{{\"box\":{size:?}}}"),
        Some(Solid::Sphere { radius }) => format!("{{\"sphere\":{radius:?}}}"),
        Some(Solid::Cylinder {
            radius,
            length,
            axis,
        }) => {
            format!(
                "{{\"cylinder\":{{\"radius\":{radius:?},\"length\":{length:?},\"axis\":{axis:?}}}}}"
            )
        }
        Some(Solid::Tube {
            radius,
            inner_radius,
            length,
            axis,
        }) => format!(
            "{{\"tube\":{{\"radius\":{radius:?},\"inner_radius\":{inner_radius:?},\"length\":{length:?},\"axis\":{axis:?}}}}}"
        ),
    };
    let corners = body.shape.map(|shape| shape.points()).unwrap_or_default();
    let far = |[x, y, z]: [f64; 3]| x.hypot(y).hypot(z);
    let radius = corners.into_iter().map(far).fold(0.0, f64::max);
    // A body that nothing else tells the size of is drawn by its inertia.
    let inertial = if body.shape.is_none() && points.len() < 2 {
        inertial(body)
    } else {
        [0.0; 3]
    };
    let radius = inertial.into_iter().fold(radius, f64::max);
    format!(
        "\"points\":{points:?},\"solid\":{solid},\"radius\":{radius:?},\"inertial\":{inertial:?}"
    )
}

/// The surface of a reduced body, which deforms.
fn of_skin(recording: &Recording, skin: &MovingSkin<'_>, numbers: &mut Numbers) -> String {
    let radius = skin.reach();
    format!("{},\"radius\":{radius:?}", skin.to_json(recording, numbers))
}

/// A star from the centre of mass to the interfaces, in the file's axes.
fn of_reduced(reduced: Reduced<'_>) -> String {
    let container = reduced.body.contained();
    let interfaces = 0..container.model.interfaces.len();
    let places = interfaces.map(|index| container.place(index).into());
    let points: Vec<[f64; 3]> = std::iter::once(container.center.into())
        .chain(places)
        .collect();
    format!("\"points\":{points:?},\"solid\":null,\"radius\":0.0,\"inertial\":[0.0,0.0,0.0]")
}

/// Half axes of the uniform ellipsoid with the mass and the moments of inertia of a body, along the axes of its frame, m. 0 of a particle.
fn inertial(body: &RigidBody) -> [f64; 3] {
    let moments = match body.inertia() {
        Inertia::Number(moment) => [moment; 3],
        Inertia::Moments(moments) => moments,
        Inertia::Tensor(rows) => [0, 1, 2].map(|axis| rows[axis][axis]),
    };
    let sum: f64 = moments.iter().sum();
    moments.map(|moment| (2.5 * (sum - 2.0 * moment).max(0.0) / body.mass()).sqrt())
}

fn of_marker(
    resolved: &Resolved<'_>,
    marker: &ResolvedMarker<'_>,
    skins: &[Option<MovingSkin<'_>>],
    sheets: &[Option<SheetModes>],
) -> String {
    let body = marker.place.body();
    let place = resolved
        .bodies
        .iter()
        .position(|other| other.name() == body.name());
    let at = match marker.place {
        Place::Point(_, point) => format!("\"point\":{point:?}"),
        Place::Interface(reduced, index) => {
            let container = reduced.body.contained();
            let point = <[f64; 3]>::from(container.place(index));
            let skin = skins[reduced.id.index()].as_ref();
            let moved = skin.map(|skin| skin.interface_to_json(&container.model.interfaces[index]));
            format!("\"point\":{point:?}{}", moved.unwrap_or_default())
        }
        Place::Patch(plate, index) => {
            let at = plate.body.marker_at(index).at();
            let sheet = sheets[plate.id.index()].as_ref();
            let sheet = sheet.map(|sheet| sheet.marker_to_json(plate.body, at));
            sheet.unwrap_or_else(|| "\"point\":[0.0,0.0,0.0]".into())
        }
        Place::Along(cable, s) => {
            let mesh = mesh(resolved, cable);
            let last = mesh.len() - 2;
            let element = mesh[1..=last].iter().take_while(|end| **end <= s).count();
            let xi = (s - mesh[element]) / (mesh[element + 1] - mesh[element]);
            format!("\"element\":{element},\"xi\":{xi:?}")
        }
    };
    format!(
        "{{\"name\":\"{}.{}\",\"label\":\"{}\",\"body\":{},{at}}}",
        body.name(),
        marker.name,
        marker.name,
        place.unwrap_or_default()
    )
}

fn of_ends(recording: &Recording, ends: &Ends<'_>) -> String {
    let second = ends.second.id.index();
    let first = match ends.first {
        First::Ground(point) => {
            let point = point.unwrap_or(recording.markers[second]);
            format!("{{\"point\":{point:?}}}")
        }
        First::Marker(marker) => format!("{{\"marker\":{}}}", marker.id.index()),
        First::Cable(_) => format!("{{\"marker\":{second}}}"),
    };
    format!("[{first},{{\"marker\":{second}}}]")
}

/// Lines of the surfaces that bodies touch: of the ground as far as these move, of a rigid body in its frame.
fn of_surfaces(recording: &Recording, resolved: &Resolved<'_>) -> Vec<String> {
    let poses = recording.poses.iter().flatten();
    let near: Vec<[f64; 3]> = poses
        .flat_map(|pose| pose.nodes.iter().map(|[position, _]| *position))
        .collect();
    let loads = resolved.loads.iter();
    let surfaces = loads.filter_map(|load| {
        let (surface, owner) = load.kind.surface()?;
        let own = owner.map(|rigid| rigid.body.extent());
        let lines = surface.lines(recording.scene.dimension, own.as_ref().unwrap_or(&near));
        let body = owner.map_or("null".into(), |rigid| rigid.id.index().to_string());
        let name = quoted(load.name);
        Some(format!(
            "{{\"name\":{name},\"body\":{body},\"lines\":{lines:?}}}"
        ))
    });
    surfaces.collect()
}

/// Returns what has a symbol, with the number of the symbol.
fn of_mark(recording: &Recording, mark: &Mark<'_>, symbols: &mut SymbolTable) -> String {
    let direction = mark.direction;
    let direction = direction.map_or("null".into(), |direction| format!("{direction:?}"));
    let label = match mark.label {
        MarkLabel::Nowhere => "null",
        MarkLabel::Second => "\"second\"",
        MarkLabel::Middle => "\"middle\"",
    };
    format!(
        "{{\"name\":{},\"kind\":\"{}\",\"ends\":{},\"direction\":{direction},\"is_local\":{},\"label\":{label},\"colour\":\"{}\",\"symbol\":{}}}",
        quoted(mark.name),
        mark.kind,
        of_ends(recording, &mark.ends),
        recording.scene.dimension == 2,
        mark.name_colour,
        symbols.number(&mark.strokes)
    )
}

fn of_action(
    recording: &Recording,
    place: usize,
    action: &MovingAction<'_>,
    numbers: &mut Numbers,
    symbols: &mut SymbolTable,
) -> String {
    let rows: Vec<Vec<f64>> = (recording.acting.iter())
        .map(|acting| acting[place].clone())
        .collect();
    let track = numbers.stepped(&rows);
    let colour = if action.is_reaction() {
        palette::REACTION
    } else {
        palette::LOAD
    };
    let strokes = load(action.is_moment, recording.scene.dimension, colour);
    let symbol = symbols.number(&strokes);
    let on = match action.on {
        Where::Marker(marker) => format!("\"marker\":{}", marker.index()),
        Where::Joint(marker, joint) => format!("\"marker\":{},\"joint\":{joint}", marker.index()),
        Where::Body(body) => format!("\"body\":{body}"),
        Where::Surface(body, _) => {
            let sheet = recording.sheets[body].as_ref();
            let place = |point: &usize| sheet.map(|sheet| sheet.point_to_json(*point));
            let places: Vec<String> = (action.points().iter().filter_map(place))
                .map(|place| format!("{{{place}}}"))
                .collect();
            format!("\"body\":{body},\"points\":[{}]", places.join(","))
        }
    };
    format!(
        "{{\"name\":{},\"unit\":\"{}\",\"is_moment\":{},\"is_reaction\":{},\"follower\":{},\"components\":{},\"track\":{track},\"symbol\":{symbol},{on}}}",
        quoted(action.name),
        action.unit,
        action.is_moment,
        action.is_reaction(),
        action.follower,
        action.components
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn a_box_and_the_ellipsoid_of_its_inertia_have_the_same_moments() {
        let text = r#"{ "name": "one", "dimension": 3, "bodies": [ { "name": "brick", "element": "rigid", "mass": 3.0,
          "inertia": [1.3, 1.0, 0.5], "position": [0.0, 0.0, 0.0] } ] }"#;
        let scene = Scene::from_json(text).expect("a valid scene");
        let resolved = scene.resolved();
        let [BodyReference::Rigid(rigid)] = &resolved.bodies[..] else {
            panic!("a rigid body");
        };
        let [a, b, c] = inertial(rigid.body).map(|half| 3.0 / 5.0 * half * half);
        for (found, wanted) in [(b + c, 1.3), (c + a, 1.0), (a + b, 0.5)] {
            assert!((found - wanted).abs() < 1e-12, "{found} {wanted}");
        }
    }
}

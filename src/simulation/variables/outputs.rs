//! Outputs, natural frequencies, eigenvalues, and what goes out of ports.

use super::{AXES, COMPONENTS, List, PARTS, Quantity, SURFACE_COMPONENTS, Source, component};
use crate::scene::unit::*;
use crate::scene::{
    Along, AngleId, ConstraintOwnerId, DirectionSource, GaugeId, InputKind, LayerId, LoadId,
    MarkerId, Output, OutputKind, OutputTarget, Place, PointId, PortKind, Resolved, ResolvedPort,
    SlideId,
};
use crate::simulation::quantities::{Evaluated, needs};

/// How many numbers an output is.
#[derive(Clone, Copy)]
enum OutputShape {
    /// One.
    Scalar,
    /// One an axis.
    Vector,
    /// One an axis of rotation: in the plane the third alone.
    Rotational,
    /// Three by three, by rows.
    Matrix,
    /// A scalar part and one an axis.
    Quaternion,
    /// Six, of a symmetric one.
    SymmetricMatrix,
    /// As many as are asked for; in its meaning, `{}` is the number from 1 on.
    List,
    /// Three, of a surface: 11, 22 and 12.
    Surface,
    /// One a point of a section, which its meaning ends with.
    Points,
}

/// Quantities by what they are read at, and the place in their shape.
#[derive(Clone, Copy)]
enum Read {
    Marker(fn(MarkerId, usize) -> Quantity),
    /// Quantity of a marker relative to another one.
    Deflected(fn(MarkerId, Option<MarkerId>, usize) -> Quantity),
    /// Quantities of a marker and of a joint with an angle.
    Rotation(
        fn(MarkerId, usize, Along) -> Quantity,
        fn(ConstraintOwnerId) -> Quantity,
    ),
    /// Quantities of a marker and of a joint along a line.
    Moving(
        fn(MarkerId, usize) -> Quantity,
        fn(ConstraintOwnerId) -> Quantity,
    ),
    /// One number of a joint or a gear.
    Joint(fn(ConstraintOwnerId) -> Quantity),
    Load(fn(LoadId, usize) -> Quantity),
    Counted(fn(AngleId) -> Quantity),
    Points(fn(PointId) -> Quantity),
    Gauge(fn(GaugeId, usize) -> Quantity),
    /// Quantities at a height of a surface, the given number after the first.
    Layer(usize, fn(LayerId, usize) -> Quantity),
    Slide(fn(SlideId) -> Quantity),
    ConstraintOwner(fn(ConstraintOwnerId, usize, Along) -> Quantity),
    Scene(fn(usize) -> Quantity),
    Spectrum(fn(usize) -> Source),
}

/// Key, meaning (`{}`: what it is read at), unit, shape, what is read.
type OutputRow = (&'static str, &'static str, Option<Unit>, OutputShape, Read);

/// Name, meaning and unit of an output, before those of its components.
struct OutputLabel {
    name: String,
    what: String,
    unit: Option<Unit>,
}

/// Lists the rows of an output of the section of a plate or shell; those of `ply_stress` for one ply.
#[rustfmt::skip] // a table
fn surface_rows(kind: OutputKind) -> Vec<OutputRow> {
    use OutputKind as Kind;
    use Quantity::*;
    use OutputShape::{Scalar, Surface};
    match kind {
        Kind::Curvature => vec![("curvature", "Change of curvature at {}, 12 twice", Some(PER_METRE), Surface, Read::Marker(SurfaceCurvature))],
        Kind::BendingMoment => vec![("bending_moment", "Bending moment per length at {}", Some(NEWTON_METRE_PER_METRE), Surface, Read::Marker(SurfaceMoment))],
        Kind::MembraneStrain => vec![("membrane_strain", "Strain of the middle surface at {}, 12 twice", None, Surface, Read::Marker(MembraneStrain))],
        Kind::MembraneForce => vec![("membrane_force", "Force per length at {}", Some(NEWTON_PER_METRE), Surface, Read::Marker(MembraneForce))],
        Kind::PlyStress => vec![
            ("bottom_stress", "Stress along the axes of {} at its bottom", Some(PASCAL), Surface, Read::Layer(0, LayerStress)),
            ("top_stress", "Stress along the axes of {} at its top", Some(PASCAL), Surface, Read::Layer(1, LayerStress)),
        ],
        _ => vec![
            ("bottom_stress", "Stress at the bottom at {}", Some(PASCAL), Surface, Read::Layer(0, LayerStress)),
            ("top_stress", "Stress at the top at {}", Some(PASCAL), Surface, Read::Layer(1, LayerStress)),
            ("bottom_von_mises_stress", "Equivalent stress of von Mises at the bottom at {}", Some(PASCAL), Scalar, Read::Layer(0, |of, _| LayerVonMises(of))),
            ("top_von_mises_stress", "Equivalent stress of von Mises at the top at {}", Some(PASCAL), Scalar, Read::Layer(1, |of, _| LayerVonMises(of))),
        ],
    }
}

/// Lists the rows of an output kind.
#[rustfmt::skip] // a table
fn rows(kind: OutputKind, resolved: &Resolved<'_>) -> Vec<OutputRow> {
    use OutputKind as Kind;
    use Quantity::*;
    use OutputShape::{List, Matrix, Points as AtPoints, Quaternion as Four, Scalar, Rotational, SymmetricMatrix, Vector};
    match kind {
        Kind::Position => vec![("position", "Position of {}", Some(METRE), Vector, Read::Marker(Position))],
        Kind::Velocity => vec![("velocity", "Velocity of {}", Some(METRE_PER_SECOND), Vector, Read::Moving(Velocity, SlidingVelocity))],
        Kind::Acceleration => vec![("acceleration", "Acceleration of {}", Some(METRE_PER_SECOND_2), Vector, Read::Moving(Acceleration, SlidingAcceleration))],
        Kind::Displacement => vec![("displacement", "Displacement of {}", Some(METRE), Scalar, Read::Joint(Displacement))],
        Kind::Deflection => vec![("deflection", "Deflection of {}", Some(METRE), Vector, Read::Deflected(Deflection))],
        Kind::GearForce | Kind::GearTorque | Kind::LatchForce | Kind::LatchTorque | Kind::LatchState | Kind::LoadForce
        | Kind::LoadMoment | Kind::Tension | Kind::Length => exerted(kind),
        Kind::Direction => vec![("direction", "Unit vector in the direction at {}", None, Vector, Read::Marker(Direction))],
        Kind::Orientation => vec![("orientation", "Axes of the frame at {}, as columns", None, Matrix, Read::Marker(Orientation))],
        Kind::Quaternion => vec![("quaternion", "Unit quaternion of the frame at {}", None, Four, Read::Marker(Quaternion))],
        Kind::RotationVector => vec![
            ("rotation_vector", "Rotation vector of the frame at {}, at most half a turn long", Some(RADIAN), Vector, Read::Marker(RotationVector)),
        ],
        Kind::Angle => vec![("angle", "Direction {}, counted on over full turns", Some(RADIAN), Scalar, Read::Counted(Angle))],
        Kind::AngularVelocity => vec![
            ("angular_velocity", "Angular velocity of {}", Some(RADIAN_PER_SECOND), Rotational, Read::Rotation(AngularVelocity, JointVelocity)),
        ],
        Kind::AngularAcceleration => vec![
            ("angular_acceleration", "Angular acceleration of {}", Some(RADIAN_PER_SECOND_2), Rotational,
                Read::Rotation(AngularAcceleration, JointAcceleration)),
        ],
        Kind::Strain => vec![("strain", "Axial strain at {}", None, Scalar, Read::Marker(|m, _| Strain(m)))],
        Kind::Curvature => vec![("curvature", "Curvature at {}", Some(PER_METRE), Scalar, Read::Marker(|m, _| Curvature(m)))],
        Kind::AxialForce => vec![("axial_force", "Axial force at {}", Some(NEWTON), Scalar, Read::Marker(|m, _| AxialForce(m)))],
        Kind::BendingMoment => vec![("bending_moment", "Bending moment at {}", Some(NEWTON_METRE), Rotational, Read::Marker(BendingMoment))],
        Kind::MembraneStrain | Kind::MembraneForce | Kind::SurfaceStress | Kind::PlyStress => surface_rows(kind),
        Kind::Torque => vec![("torque", "Torque about the tangent at {}", Some(NEWTON_METRE), Scalar, Read::Marker(|m, _| Torque(m)))],
        Kind::Stress => vec![("stress", "Normal stress at {}", Some(PASCAL), AtPoints, Read::Points(Stress))],
        Kind::TorsionStress => vec![("torsion_stress", "Shear stress by torsion at {}", Some(PASCAL), AtPoints, Read::Points(TorsionStress))],
        Kind::StressTensor => vec![
            ("stress_tensor", "Stress at {} along axes of its body", Some(PASCAL), SymmetricMatrix, Read::Gauge(StressTensor)),
            ("von_mises_stress", "Equivalent stress of von Mises at {}", Some(PASCAL), Scalar, Read::Gauge(|gauge, _| VonMisesStress(gauge))),
        ],
        Kind::ConnectivityForce => vec![
            ("connectivity_force", "Force of the part before on the part after {}", Some(NEWTON), Vector, Read::Marker(ConnectivityForce)),
        ],
        Kind::Travel => vec![("travel", "Length along the cable at which {} stands", Some(METRE), Scalar, Read::Slide(Travel))],
        Kind::Reaction => vec![("reaction", "Force of {}", Some(NEWTON), Vector, Read::ConstraintOwner(Reaction))],
        Kind::ReactionMoment => vec![("reaction_moment", "Moment of {}", Some(NEWTON_METRE), Rotational, Read::ConstraintOwner(ReactionMoment))],
        Kind::Energy => energies(resolved),
        Kind::Work => vec![
            ("energy.input", "Work that loads, inputs and motions have done since the start", Some(JOULE), Scalar, Read::Scene(|_| Input)),
            ("energy.dissipated", "Energy lost in dampers and in damping since the start", Some(JOULE), Scalar, Read::Scene(|_| Dissipated)),
        ],
        Kind::Momentum => vec![
            ("momentum", "Linear momentum", Some(NEWTON_SECOND), Vector, Read::Scene(Momentum)),
            ("angular_momentum", "Angular momentum about the origin", Some(NEWTON_METRE_SECOND), Rotational, Read::Scene(AngularMomentum)),
        ],
        Kind::CenterOfMass => vec![("center_of_mass", "Centre of mass", Some(METRE), Vector, Read::Scene(CenterOfMass))],
        Kind::Resolution => vec![
            ("resolution", "Error in position that the meshes make in the present shapes, estimated, over the error wanted: above 1 they are too coarse",
                None, Scalar, Read::Scene(|_| Resolution)),
        ],
        Kind::Residual => vec![
            ("residual.position", "Largest residual of the positions that constraints hold, relative", None, Scalar, Read::Scene(|_| Residual(0))),
            ("residual.velocity", "Largest residual of the velocities that constraints hold, relative", Some(PER_SECOND), Scalar,
                Read::Scene(|_| Residual(1))),
        ],
        Kind::NaturalFrequency => vec![
            ("natural_frequency", "Natural frequency {} at rest in the initial configuration; an unstable one is negative",
                Some(RADIAN_PER_SECOND), List, Read::Spectrum(Source::NaturalFrequency)),
        ],
        Kind::Eigenvalue => vec![
            ("eigenvalue.decay_rate", "Decay rate of eigenvalue {} about the initial state; a growing one is negative",
                Some(PER_SECOND), List, Read::Spectrum(|n| Source::Eigenvalue(n, 0))),
            ("eigenvalue.frequency", "Frequency of eigenvalue {} about the initial state, 0 of a real one",
                Some(RADIAN_PER_SECOND), List, Read::Spectrum(|n| Source::Eigenvalue(n, 1))),
        ],
    }
}

/// Lists the rows of gears, latches and loads.
#[rustfmt::skip] // a table
fn exerted(kind: OutputKind) -> Vec<OutputRow> {
    use OutputKind as Kind;
    use Quantity::*;
    use OutputShape::{Scalar, Rotational, Vector};
    match kind {
        Kind::GearForce => vec![("gear_force", "Force of {} on the displacement of its second joint", Some(NEWTON), Scalar, Read::Joint(GearForce))],
        Kind::GearTorque => vec![("gear_torque", "Torque of {} on the angle of its second joint", Some(NEWTON_METRE), Scalar, Read::Joint(GearTorque))],
        Kind::LatchForce => vec![("latch_force", "Force of {} on the displacement of its joint", Some(NEWTON), Scalar, Read::Joint(GearForce))],
        Kind::LatchTorque => vec![("latch_torque", "Torque of {} on the angle of its joint", Some(NEWTON_METRE), Scalar, Read::Joint(GearTorque))],
        Kind::LatchState => vec![("latch_state", "State of {}: 1 closed, 0 open", None, Scalar, Read::Joint(LatchState))],
        Kind::Length => vec![
            ("length", "Length of {}", Some(METRE), Scalar, Read::Load(|load, _| Length(load))),
            ("length_rate", "Rate of the length of {}", Some(METRE_PER_SECOND), Scalar, Read::Load(|load, _| LengthRate(load))),
        ],
        Kind::Tension => vec![("tension", "Tension of {}", Some(NEWTON), Scalar, Read::Load(|load, _| Tension(load)))],
        Kind::LoadForce => vec![("force", "Force of {}", Some(NEWTON), Vector, Read::Load(LoadForce))],
        _ => vec![("moment", "Moment of {}", Some(NEWTON_METRE), Rotational, Read::Load(LoadMoment))],
    }
}

#[rustfmt::skip] // a table
fn energies(resolved: &Resolved<'_>) -> Vec<OutputRow> {
    use Quantity::*;
    let gravity = if !resolved.scene.turns() {
        "Potential energy of gravity, zero at the origin"
    } else {
        "Potential energy of gravity and of the centrifugal force, zero at the origin"
    };
    let mut rows: Vec<OutputRow> = vec![
        ("energy.kinetic", "Kinetic energy", Some(JOULE), OutputShape::Scalar, Read::Scene(|_| KineticEnergy)),
        ("energy.strain", "Strain energy", Some(JOULE), OutputShape::Scalar, Read::Scene(|_| StrainEnergy)),
        ("energy.gravity", gravity, Some(JOULE), OutputShape::Scalar, Read::Scene(|_| GravityEnergy)),
        ("energy.spring", "Energy in springs, hinges and couplings", Some(JOULE), OutputShape::Scalar, Read::Scene(|_| SpringEnergy)),
    ];
    if !has_springs(resolved) {
        rows.pop();
    }
    rows
}

/// Adds the outputs of a scene.
pub(super) fn add(list: &mut List, resolved: &Resolved<'_>) {
    for output in &resolved.outputs {
        add_output(list, resolved, output, None);
    }
    for port in &resolved.ports {
        if let PortKind::Force { outputs, .. } = &port.kind {
            for output in outputs {
                add_output(list, resolved, output, Some(port.name));
            }
        }
        add_port_force(list, port);
    }
}

/// An output; the variables of a port bear its name.
fn add_output(list: &mut List, resolved: &Resolved<'_>, output: &Output<'_>, port: Option<&str>) {
    let (name, place) = words(&output.of);
    let count = match output.of {
        OutputTarget::Spectrum(_, count) => count as usize,
        _ => list.dimension,
    };
    if let OutputTarget::Plies(marker, first, plies) = output.of {
        return add_plies(list, marker.name, first, plies);
    }
    let rows = match output.of {
        OutputTarget::Marker(marker)
            if matches!(marker.place, Place::Patch(..))
                && matches!(
                    output.kind,
                    OutputKind::Curvature | OutputKind::BendingMoment
                ) =>
        {
            surface_rows(output.kind)
        }
        _ => rows(output.kind, resolved),
    };
    for (key, what, unit, shape, read) in rows {
        let name = match port.unwrap_or(name) {
            "" => key.to_owned(),
            of => format!("{of}.{key}"),
        };
        let what = match shape {
            OutputShape::List => what.to_owned(),
            _ => what.replace("{}", &place),
        };
        let shape = match (shape, output.of) {
            // A joint has one axis, in space too.
            (OutputShape::Rotational, OutputTarget::Rotation(DirectionSource::Pivot(_))) => {
                OutputShape::Scalar
            }
            (OutputShape::Vector, OutputTarget::Sliding(_)) => OutputShape::Scalar,
            _ => shape,
        };
        let (name, what) = match (output.along, output.of) {
            (_, OutputTarget::Deflected(_, Some(from))) => {
                let from = from.name.rsplit('.').next().unwrap_or_default();
                (format!("{name}_from_{from}"), what)
            }
            (Along::Global, _) => (name, what),
            (Along::Body, _) => (
                format!("{name}_body"),
                format!("{what}, axes of {}", owner(&output.of)),
            ),
        };
        let label = OutputLabel { name, what, unit };
        let source = |k| of_friction(source(read, output, k), resolved);
        if let OutputTarget::Points(_, _, points) = output.of {
            list.at_points(&label, points, source);
            continue;
        }
        list.shaped(&label, shape, count, source);
    }
}

/// Adds stress at the bottom and the top of plies.
fn add_plies(list: &mut List, marker: &str, first: LayerId, plies: &[u32]) {
    for (index, number) in plies.iter().enumerate() {
        for (key, what, unit, shape, read) in surface_rows(OutputKind::PlyStress) {
            let Read::Layer(after, quantity) = read else {
                continue;
            };
            let label = OutputLabel {
                name: format!("{marker}.ply{number}_{key}"),
                what: what.replace("{}", &format!("ply {number} at {marker}")),
                unit,
            };
            let layer = first.after(2 * index + after);
            list.shaped(&label, shape, 3, |k| Source::Output(quantity(layer, k)));
        }
    }
}

/// Returns the name that variables of an output begin with, and its form in descriptions.
fn words<'a>(of: &OutputTarget<'a>) -> (&'a str, String) {
    let second = |joint: &str| format!("the second marker of {joint} less that of its first");
    match of {
        OutputTarget::Marker(marker)
        | OutputTarget::Points(marker, ..)
        | OutputTarget::Faces(marker, _)
        | OutputTarget::Plies(marker, ..) => (marker.name, marker.name.into()),
        OutputTarget::Deflected(marker, None) => {
            let what = format!(
                "{} from the mean of its body, along axes that follow the mean",
                marker.name
            );
            (marker.name, what)
        }
        OutputTarget::Deflected(marker, Some(from)) => {
            let what = format!(
                "{} from the frame at {}, along axes that follow it",
                marker.name, from.name
            );
            (marker.name, what)
        }
        OutputTarget::Rotation(DirectionSource::Marker(marker)) => {
            (marker.name, format!("the direction at {}", marker.name))
        }
        OutputTarget::Rotation(DirectionSource::Pivot(pivot)) => (pivot.name, second(pivot.name)),
        OutputTarget::Angle(DirectionSource::Marker(marker), _) => {
            (marker.name, format!("at {}", marker.name))
        }
        OutputTarget::Angle(DirectionSource::Pivot(pivot), _) => {
            (pivot.name, format!("of {}", second(pivot.name)))
        }
        OutputTarget::Gauge(gauge, _) => (gauge, (*gauge).into()),
        OutputTarget::Slide(joint, _) => (joint, (*joint).into()),
        OutputTarget::Sliding(slider) => {
            let what = format!("the second marker of {} along its line", slider.name);
            (slider.name, what)
        }
        OutputTarget::Relation(of, _) => (of, (*of).into()),
        OutputTarget::Load(load, _, on) => {
            let on = on.map_or("the body that it acts along", |marker| marker.name);
            (load, format!("{load} on {on}"))
        }
        OutputTarget::Rope(load, _) => (load, (*load).into()),
        OutputTarget::Reaction(reaction) => {
            let on = if reaction.is_motion {
                "what it drives"
            } else {
                "its second marker"
            };
            (reaction.name, format!("{} on {on}", reaction.name))
        }
        OutputTarget::Scene => ("", String::new()),
        OutputTarget::Spectrum(body, _) => (body.unwrap_or_default(), String::new()),
    }
}

/// The body along whose axes components are.
fn owner(of: &OutputTarget<'_>) -> String {
    match of {
        OutputTarget::Reaction(reaction) => format!("the first body of {}", reaction.name),
        _ => "its body".into(),
    }
}

/// The force or moment of a load that is friction: where it sticks, a constraint exerts it.
fn of_friction(source: Source, resolved: &Resolved<'_>) -> Source {
    let is_friction = |of: LoadId| resolved.loads[of.index()].kind.is_friction();
    Source::Output(match source {
        Source::Output(Quantity::LoadForce(of, k)) if is_friction(of) => {
            Quantity::FrictionForce(of, k)
        }
        Source::Output(Quantity::LoadMoment(of, k)) if is_friction(of) => {
            Quantity::FrictionMoment(of, k)
        }
        other => return other,
    })
}

fn source(read: Read, output: &Output<'_>, k: usize) -> Source {
    let along = output.along;
    Source::Output(match (read, &output.of) {
        (Read::Marker(quantity), OutputTarget::Marker(marker)) => quantity(marker.id, k),
        (Read::Deflected(quantity), OutputTarget::Deflected(marker, from)) => {
            quantity(marker.id, from.map(|from| from.id), k)
        }
        (Read::Rotation(quantity, _), OutputTarget::Rotation(DirectionSource::Marker(marker))) => {
            quantity(marker.id, k, along)
        }
        (Read::Rotation(_, quantity), OutputTarget::Rotation(DirectionSource::Pivot(pivot))) => {
            quantity(pivot.joint)
        }
        (Read::Moving(quantity, _), OutputTarget::Marker(marker)) => quantity(marker.id, k),
        (Read::Moving(_, quantity) | Read::Joint(quantity), OutputTarget::Sliding(slider)) => {
            quantity(slider.joint)
        }
        (Read::Joint(quantity), OutputTarget::Relation(_, holder)) => quantity(*holder),
        (Read::Load(quantity), OutputTarget::Load(_, load, _)) => quantity(*load, k),
        (Read::Load(quantity), OutputTarget::Rope(_, load)) => quantity(*load, k),
        (Read::Counted(quantity), OutputTarget::Angle(_, angle)) => quantity(*angle),
        (Read::Points(quantity), OutputTarget::Points(_, first, _)) => quantity(first.after(k)),
        (Read::Gauge(quantity), OutputTarget::Gauge(_, gauge)) => quantity(*gauge, k),
        (Read::Layer(after, quantity), OutputTarget::Faces(_, first)) => {
            quantity(first.after(after), k)
        }
        (Read::Slide(quantity), OutputTarget::Slide(_, slide)) => quantity(*slide),
        (Read::ConstraintOwner(quantity), OutputTarget::Reaction(reaction)) => {
            quantity(reaction.holder, k, along)
        }
        (Read::Scene(quantity), OutputTarget::Scene) => quantity(k),
        (Read::Spectrum(source), OutputTarget::Spectrum(..)) => return source(k),
        _ => unreachable!("what an output is read at follows from its kind"),
    })
}

/// Adds the force that a port with an incoming motion exerts on the outside.
fn add_port_force(list: &mut List, port: &ResolvedPort<'_>) {
    use Quantity::{CouplingForce, CouplingMoment, MotionForce, MotionMoment};
    let what = format!(
        "of {} on what {} couples it to",
        port.marker.name, port.name
    );
    let dimension = list.dimension;
    let mut add =
        |key: &str, unit: Unit, shape: OutputShape, quantity: &dyn Fn(usize) -> Quantity| {
            let label = OutputLabel {
                name: format!("{}.{}", port.name, key.to_lowercase()),
                what: format!("{key} {what}"),
                unit: Some(unit),
            };
            let source = |axis| Source::Output(quantity(axis));
            list.shaped(&label, shape, dimension, source);
        };
    let (force, moment) = (("Force", NEWTON), ("Moment", NEWTON_METRE));
    match &port.kind {
        PortKind::Force { .. } => {}
        PortKind::Motion { position, angle } => {
            add(force.0, force.1, OutputShape::Vector, &|axis| {
                MotionForce(position.holder, axis)
            });
            if let Some(angle) = angle {
                add(moment.0, moment.1, OutputShape::Rotational, &|axis| {
                    MotionMoment(angle.holder, axis)
                });
            }
        }
        PortKind::Coupling { position, angle } => {
            add(force.0, force.1, OutputShape::Vector, &|axis| {
                CouplingForce(position.id, axis)
            });
            if let Some(angle) = angle {
                add(moment.0, moment.1, OutputShape::Rotational, &|axis| {
                    CouplingMoment(angle.id, axis)
                });
            }
        }
    }
}

/// Whether there are springs, hinges or couplings with stiffness.
fn has_springs(resolved: &Resolved<'_>) -> bool {
    let springs = resolved.loads.iter();
    let springs = springs.flat_map(|load| load.kind.stiffness());
    let hinges = resolved.joints.iter().filter_map(|joint| joint.spring());
    let hinges = hinges.map(|[stiffness, _]| stiffness);
    let couplings = resolved.ports.iter().filter_map(|port| match &port.kind {
        PortKind::Coupling { position, angle } => {
            let rotational = angle.as_ref().map_or(0.0, |angle| angle.stiffness);
            Some(position.stiffness.max(rotational))
        }
        PortKind::Force { .. } | PortKind::Motion { .. } => None,
    });
    let mut stiffnesses = springs.chain(hinges).chain(couplings);
    stiffnesses.any(|stiffness| stiffness > 0.0)
}

/// Whether the master sets the length of a spring or where one ends: it then works on the spring at once.
pub(in crate::simulation) fn sets_springs(resolved: &Resolved<'_>) -> bool {
    let mut inputs = resolved.inputs.iter();
    inputs.any(|input| matches!(input.kind, InputKind::RestLength(_))) || resolved.couplings > 0
}

impl List {
    /// An output: a number or several, which tell their axis or number.
    fn shaped(
        &mut self,
        label: &OutputLabel,
        shape: OutputShape,
        count: usize,
        source: impl Fn(usize) -> Source,
    ) {
        let OutputLabel { name, what, unit } = label;
        match (shape, count) {
            (OutputShape::Scalar, _) => self.output(name.clone(), what.clone(), *unit, source(0)),
            (OutputShape::Rotational, 2) => {
                self.output(name.clone(), what.clone(), *unit, source(2))
            }
            (OutputShape::Matrix, _) => (0..9).for_each(|k| {
                let what = format!("{what}, {} of the {} axis", AXES[k / 3], AXES[k % 3]);
                self.output(component(name, k), what, *unit, source(k));
            }),
            (OutputShape::SymmetricMatrix, _) => (0..6).for_each(|k| {
                let what = format!("{what}, component {}", COMPONENTS[k]);
                self.output(component(name, k), what, *unit, source(k));
            }),
            (OutputShape::Quaternion, _) => (0..4).for_each(|k| {
                let what = format!("{what}, {}", PARTS[k]);
                self.output(component(name, k), what, *unit, source(k));
            }),
            (OutputShape::Surface, _) => (0..3).for_each(|k| {
                let what = format!("{what}, component {}", SURFACE_COMPONENTS[k]);
                self.output(component(name, k), what, *unit, source(k));
            }),
            _ => (0..count).for_each(|k| {
                let what = match shape {
                    OutputShape::List => what.replace("{}", &(k + 1).to_string()),
                    _ => format!("{what}, component {}", AXES[k]),
                };
                self.output(component(name, k), what, *unit, source(k));
            }),
        }
    }

    /// One output a point of a section.
    fn at_points(
        &mut self,
        label: &OutputLabel,
        points: &[Vec<f64>],
        source: impl Fn(usize) -> Source,
    ) {
        let OutputLabel { name, what, unit } = label;
        for (k, point) in points.iter().enumerate() {
            let what = format!("{what}, {point:?} m from the line of its section");
            self.output(component(name, k), what, *unit, source(k));
        }
    }

    /// An output follows at once from inputs where accelerations do, or springs that the master sets.
    fn output(&mut self, name: String, what: String, unit: Option<Unit>, source: Source) {
        use Quantity::{CouplingForce, CouplingMoment, Input, LoadForce, SpringEnergy, Tension};
        self.add(name, what, unit, source, None);
        if let (Some(variable), Source::Output(quantity)) = (self.variables.last_mut(), source) {
            let of_springs = matches!(
                quantity,
                SpringEnergy
                    | Input
                    | CouplingForce(..)
                    | CouplingMoment(..)
                    | LoadForce(..)
                    | Tension(_)
            );
            variable.is_direct =
                needs(quantity) == Evaluated::Dynamics || (self.sets_springs && of_springs);
        }
    }
}

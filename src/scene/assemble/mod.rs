//! From a validated scene to a system.

mod motions;
mod ports;

use nalgebra::Vector2;

use super::{
    At, Body, CableBody, Constraints, Error, Formulation, GROUND, Input, InputKind, InputLayout,
    JointKind, LoadKind, MarkerReference, OutputKind, Port, Scene, Strain, Value,
};
use crate::body::{self, Marker, Node};
use crate::elements::cable::{self, Inertia};
use crate::elements::{self, Nodal};
use crate::math::function::Function;
use crate::system::joints::{self, Joint};
use crate::system::loads::{self, Load};
use crate::system::{
    Angle, BuildError, Constraints as Method, End, Lump, Parts, PlanarChain, Signal, System,
};

/// A system and what of its scene is needed beside it.
#[derive(Clone, Debug)]
pub struct Assembled {
    /// The system.
    pub system: System,
    /// Nodal coordinates as described.
    pub nodes: Vec<Node<4>>,
    /// Their rates as described.
    pub rates: Vec<Node<4>>,
    /// For every output of kind `angle`, in order, then for every port that forces come into and that
    /// turns, its place among the angles of the system.
    pub angles: Vec<usize>,
    /// For every load of the scene, its place among the loads of the system.
    pub loads: Vec<usize>,
    /// For every coupling, its place among the loads of the system.
    pub couplings: Vec<usize>,
    places: Vec<Place>,
}

/// Where a body is in the system.
#[derive(Clone, Copy, Debug)]
enum Place {
    /// Its chain and length, m.
    Chain(usize, f64),
    /// Its node.
    Node(usize),
}

impl Assembled {
    /// The marker of the system that a marker of the scene is.
    pub fn marker(&self, reference: MarkerReference) -> Marker {
        marker(&self.places, self.system.chains(), reference)
    }
}

fn marker(places: &[Place], chains: &[PlanarChain], reference: MarkerReference) -> Marker {
    let MarkerReference { body, at } = reference;
    match (places[body], at) {
        (Place::Chain(chain, length), At::Along(s)) => {
            Marker::along(body, &chains[chain], s * length)
        }
        (Place::Node(node), At::Point(point)) => Marker::rigid(body, node, point),
        // A valid scene names points of rigid bodies and lengths of cables.
        (Place::Chain(chain, _), At::Point(_)) => Marker::along(body, &chains[chain], 0.0),
        (Place::Node(node), At::Along(_)) => Marker::rigid(body, node, [0.0; 2]),
    }
}

/// Builds the system that a valid scene describes.
///
/// # Errors
/// When a mesh is too coarse for what acts inside its body, when a motion contradicts joints, when a body
/// has no mass.
pub fn assemble(scene: &Scene) -> Result<Assembled, Error> {
    let mut builder = Builder {
        scene,
        layout: scene.input_layout(),
        places: Vec::new(),
        rates: Vec::new(),
        angle_outputs: Vec::new(),
        load_places: Vec::new(),
        couplings: Vec::new(),
        parts: Parts {
            nodes: Vec::new(),
            bodies: Vec::new(),
            chains: Vec::new(),
            lumps: Vec::new(),
            rigid: Vec::new(),
            joints: Vec::new(),
            drives: Vec::new(),
            loads: Vec::new(),
            angles: Vec::new(),
            gravity: scene.gravity.into(),
            rotation: scene.rotation,
            formulation: match scene.method.formulation {
                Formulation::MassWeighted => body::Formulation::MassWeighted,
                Formulation::AsPrinted => body::Formulation::AsPrinted,
            },
            constraints: match scene.method.constraints {
                Constraints::Projection => Method::Projection,
                Constraints::Partitioning => Method::Partitioning,
            },
            tracks_work: scene.outputs.iter().any(|o| o.kind == OutputKind::Work),
        },
    };
    for index in 0..scene.bodies.len() {
        builder.body(index)?;
    }
    builder.masses();
    builder.angles();
    builder.joints();
    builder.motions();
    builder.loads();
    builder.inputs();
    builder.ports();
    let nodes = builder.parts.nodes.clone();
    let system = System::new(builder.parts).map_err(|error| explain(scene, &error))?;
    Ok(Assembled {
        system,
        nodes,
        rates: builder.rates,
        angles: builder.angle_outputs,
        loads: builder.load_places,
        couplings: builder.couplings,
        places: builder.places,
    })
}

fn explain(scene: &Scene, error: &BuildError) -> Error {
    match error {
        BuildError::Massless => Error::new("bodies", "expected bodies with mass, found none"),
        BuildError::Determined(joint) => {
            let (list, place, _) = scene.holder(joint.unwrap_or(0));
            let path = format!("{list}[{place}]");
            let message = "expected a motion of what joints and other motions leave free, found one of \
                           what they hold already";
            Error::new(path, message)
        }
    }
}

struct Builder<'a> {
    scene: &'a Scene,
    layout: InputLayout,
    places: Vec<Place>,
    rates: Vec<Node<4>>,
    angle_outputs: Vec<usize>,
    load_places: Vec<usize>,
    couplings: Vec<usize>,
    parts: Parts,
}

impl Builder<'_> {
    fn body(&mut self, index: usize) -> Result<(), Error> {
        let first = self.parts.nodes.len();
        let motion = self.scene.bodies[index].motion();
        match &self.scene.bodies[index] {
            Body::Cable(cable) => {
                let mesh = self.scene.nodes(index)?;
                let (connected, inertia) = match self.scene.method.formulation {
                    Formulation::MassWeighted => (true, Inertia::Corrected),
                    Formulation::AsPrinted => (false, Inertia::Consistent),
                };
                let chain =
                    PlanarChain::new(build_elements(cable, &mesh, inertia), first, connected);
                let node = |s: &f64| {
                    let (p, d) = (cable.shape.point(*s), cable.shape.tangent(*s));
                    [p[0], p[1], d[0], d[1]]
                };
                let count = mesh.len();
                for (i, s) in mesh.iter().enumerate() {
                    self.parts.nodes.push(node(s));
                    if !connected && i > 0 && i + 1 < count {
                        self.parts.nodes.push(node(s));
                    }
                }
                let place = Place::Chain(self.parts.chains.len(), chain.length());
                self.places.push(place);
                self.parts.chains.push(chain);
            }
            Body::Rigid(rigid) => {
                let (sin, cos) = rigid.angle.sin_cos();
                let [x, y] = rigid.position;
                self.parts.nodes.push([x, y, cos, sin]);
                self.parts.rigid.push((first, rigid.inertia > 0.0));
                self.parts.lumps.push(Lump {
                    marker: Marker::rigid(index, first, [0.0; 2]),
                    mass: rigid.mass,
                    inertia: rigid.inertia,
                });
                self.places.push(Place::Node(first));
            }
        }
        let origin = self.parts.nodes[first];
        for x in &self.parts.nodes[first..] {
            let (spin, [vx, vy]) = (motion.spin, motion.velocity);
            let way = [x[0] - origin[0], x[1] - origin[1]];
            let velocity = [vx - spin * way[1], vy + spin * way[0]];
            let turning = [-spin * x[3], spin * x[2]];
            self.rates
                .push([velocity[0], velocity[1], turning[0], turning[1]]);
        }
        self.parts.bodies.push(first..self.parts.nodes.len());
        Ok(())
    }

    /// A marker of the scene by its name, which a valid scene has.
    fn marker(&self, name: &str) -> Marker {
        let start = MarkerReference {
            body: 0,
            at: At::Along(0.0),
        };
        let reference = self.scene.marker(name).unwrap_or(start);
        marker(&self.places, &self.parts.chains, reference)
    }

    fn masses(&mut self) {
        for mass in &self.scene.masses {
            let marker = self.marker(&mass.marker);
            self.parts.lumps.push(Lump {
                marker,
                mass: mass.mass,
                inertia: mass.inertia,
            });
        }
    }

    /// The ends of something between two markers; the ground where it is at the start, or at `point`.
    fn ends(&self, markers: &[String; 2], point: Option<[f64; 2]>) -> [End; 2] {
        let second = self.marker(&markers[1]);
        let first = if markers[0] == GROUND {
            let here = second.position(&self.parts.nodes);
            End::Ground(point.map_or(here, Vector2::from))
        } else {
            End::Body(self.marker(&markers[0]))
        };
        [first, End::Body(second)]
    }

    /// The ends of a joint of the scene.
    fn joint_ends(&self, name: &str) -> [End; 2] {
        let joint = self.scene.joint(name).unwrap_or(0);
        let joint = &self.scene.joints[joint];
        self.ends(&joint.markers, joint.point)
    }

    /// Angle from the direction of the first end to that of the second at the start, rad.
    fn angle_at_start(&self, ends: &[End; 2]) -> f64 {
        Angle { ends: *ends }.value(&self.parts.nodes, 0.0)
    }

    fn count_angle(&mut self, ends: [End; 2]) -> usize {
        self.parts.angles.push(Angle { ends });
        self.parts.angles.len() - 1
    }

    fn angles(&mut self) {
        let scene = self.scene;
        let of_ports = scene.ports.iter().flat_map(Port::outputs);
        for output in scene.outputs.iter().cloned().chain(of_ports) {
            if output.kind != OutputKind::Angle {
                continue;
            }
            let ends = match (&output.marker, &output.joint) {
                (Some(marker), _) => [
                    End::Ground(Vector2::zeros()),
                    End::Body(self.marker(marker)),
                ],
                (None, Some(joint)) => self.joint_ends(joint),
                (None, None) => continue,
            };
            let angle = self.count_angle(ends);
            self.angle_outputs.push(angle);
        }
    }

    fn joints(&mut self) {
        for joint in &self.scene.joints {
            let mut spring = None;
            if joint.kind == JointKind::Along {
                let cable = self.scene.body(&joint.markers[0]).unwrap_or(0);
                let (chain, length) = match self.places[cable] {
                    Place::Chain(chain, length) => (chain, length),
                    Place::Node(_) => (0, 0.0),
                };
                let first = Marker::along(cable, &self.parts.chains[chain], 0.5 * length);
                self.parts.joints.push(Joint {
                    kind: joints::JointKind::Along(chain),
                    ends: [End::Body(first), End::Body(self.marker(&joint.markers[1]))],
                    spring,
                });
                continue;
            }
            let ends = self.ends(&joint.markers, joint.point);
            let angle = joint.angle.unwrap_or_else(|| self.angle_at_start(&ends));
            let kind = match joint.kind {
                JointKind::Revolute | JointKind::Along => joints::JointKind::Revolute,
                JointKind::Weld => joints::JointKind::Weld(angle),
                JointKind::Orientation => joints::JointKind::Orientation(angle),
                JointKind::Slider => joints::JointKind::Slider(direction(joint.direction)),
                JointKind::Distance => {
                    let nodes = &self.parts.nodes;
                    let now = (ends[1].position(nodes) - ends[0].position(nodes)).norm();
                    joints::JointKind::Distance(joint.length.unwrap_or(now))
                }
                JointKind::Hinge => {
                    spring = Some(self.parts.loads.len());
                    let counted = self.count_angle(ends);
                    self.parts.loads.push(Load::Rotational(loads::Rotational {
                        ends,
                        angle: counted,
                        stiffness: joint.stiffness.unwrap_or(0.0),
                        damping: joint.damping.unwrap_or(0.0),
                        rest: angle,
                    }));
                    joints::JointKind::Revolute
                }
            };
            self.parts.joints.push(Joint { kind, ends, spring });
        }
    }

    fn loads(&mut self) {
        for load in &self.scene.loads {
            let values = load.value.as_ref().map_or(&[][..], |v| v.components());
            let signal = |k: usize| function(values.get(k));
            let marker = load.marker.as_deref();
            let built = match load.kind {
                LoadKind::Force => Load::Force(loads::Force {
                    marker: self.marker(marker.unwrap_or_default()),
                    follower: load.follower,
                    components: [signal(0), signal(1)],
                }),
                LoadKind::Moment => self.moment(marker, signal(0)),
                LoadKind::Torque => Load::Moment(loads::Moment {
                    ends: self.joint_ends(load.joint.as_deref().unwrap_or_default()),
                    size: signal(0),
                }),
                LoadKind::Distributed => {
                    self.distributed(load.body.as_deref(), [signal(0), signal(1)])
                }
                LoadKind::SpringDamper => {
                    let none = [String::new(), String::new()];
                    let ends = self.ends(load.markers.as_ref().unwrap_or(&none), load.point);
                    let nodes = &self.parts.nodes;
                    let now = (ends[1].position(nodes) - ends[0].position(nodes)).norm();
                    let rest = Signal::Function(Function::Constant(now));
                    Load::Spring(loads::Spring {
                        ends,
                        stiffness: load.stiffness.unwrap_or(0.0),
                        damping: load.damping.unwrap_or(0.0),
                        length: load.length.as_ref().map_or(rest, |l| function(Some(l))),
                    })
                }
            };
            self.load_places.push(self.parts.loads.len());
            self.parts.loads.push(built);
        }
    }

    fn moment(&self, marker: Option<&str>, size: Signal) -> Load {
        let end = End::Body(self.marker(marker.unwrap_or_default()));
        Load::Moment(loads::Moment {
            ends: [End::Ground(Vector2::zeros()), end],
            size,
        })
    }

    fn distributed(&self, body: Option<&str>, components: [Signal; 2]) -> Load {
        let body = body.and_then(|name| self.scene.body(name)).unwrap_or(0);
        let chain = match self.places[body] {
            Place::Chain(chain, _) => chain,
            Place::Node(_) => 0,
        };
        Load::Distributed(loads::Distributed { chain, components })
    }

    fn inputs(&mut self) {
        let scene = self.scene;
        for (place, input) in scene.inputs.iter().enumerate() {
            self.input(input, self.layout.of_inputs[place]);
        }
    }

    /// A load whose size is an input.
    fn input(&mut self, input: &Input, first: usize) {
        let signal = |k: usize| Signal::Input(first + k);
        let marker = input.marker.as_deref();
        let built = match input.kind {
            InputKind::Force => Load::Force(loads::Force {
                marker: self.marker(marker.unwrap_or_default()),
                follower: input.follower,
                components: [signal(0), signal(1)],
            }),
            InputKind::Moment => self.moment(marker, signal(0)),
            InputKind::Torque => Load::Moment(loads::Moment {
                ends: self.joint_ends(input.joint.as_deref().unwrap_or_default()),
                size: signal(0),
            }),
            InputKind::Distributed => {
                self.distributed(input.body.as_deref(), [signal(0), signal(1)])
            }
            InputKind::RestLength => {
                let load = input.load.as_deref().and_then(|name| self.scene.load(name));
                let place = self.load_places[load.unwrap_or(0)];
                if let Load::Spring(spring) = &mut self.parts.loads[place] {
                    spring.length = signal(0);
                }
                return;
            }
        };
        self.parts.loads.push(built);
    }
}

fn function(value: Option<&Value>) -> Signal {
    let function = value.and_then(|value| value.function().ok());
    Signal::Function(function.unwrap_or(Function::Constant(0.0)))
}

fn direction(direction: Option<[f64; 2]>) -> Vector2<f64> {
    Vector2::from(direction.unwrap_or([1.0, 0.0])).normalize()
}

fn build_elements(body: &CableBody, nodes: &[f64], inertia: Inertia) -> Vec<cable::Cable<2, 1>> {
    let (material, section) = (&body.material, &body.section);
    let strain = match body.strain {
        Strain::ThetaPrime => elements::Strain::ThetaPrime,
        Strain::GreenLagrangeFrenetKappa => elements::Strain::GreenLagrangeFrenetKappa,
        Strain::EngStrainFrenetKappa => elements::Strain::EngStrainFrenetKappa,
    };
    let end = |s: f64| [body.shape.point(s).into(), body.shape.tangent(s).into()];
    let build = |s: &[f64]| {
        let parameters = cable::Parameters {
            length: (s[1] - s[0]) * body.shape.length(),
            axial_stiffness: material.youngs_modulus * section.area,
            bending_stiffness: material.youngs_modulus * section.second_moment,
            line_density: material.density * section.area,
            damping_time: material.damping_time,
            strain,
            inertia,
        };
        let [a, b]: [[Vector2<f64>; 2]; 2] = [end(s[0]), end(s[1])];
        let e = Nodal::from_columns(&[a[0], a[1], b[0], b[1]]);
        let curved = (!body.shape.is_straight()).then_some(&e);
        cable::Cable::new(parameters, curved)
    };
    nodes.windows(2).map(build).collect()
}

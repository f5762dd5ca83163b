//! CPU time of every kernel an element costs in a step, in the plane and in space: `cargo bench -p studies`. Figures are per call; the
//! throughput is in elements. Eigenvalues of dense matrices are timed beside those of faer.

use std::hint::black_box;

use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use flexbody::bodies::no_node;
use flexbody::elements::{ElementMotion, beam, rod};
use flexbody::math::eigen;
use flexbody::math::lanes::{self, PACK};
use flexbody::scene::{Scene, assemble};
use flexbody::system::{DrivenSystem, Dynamics, State, System, Workspace};
use nalgebra::Complex;

const MESHES: [u32; 4] = [1, 10, 100, 1000];
/// Rows of the matrices whose eigenvalues are asked for: those of Lanczos' iteration, and of 10 and 50 elements.
const ROWS: [usize; 3] = [40, 44, 204];
/// Step of the implicit solves, s.
const STEP: f64 = 1e-3;

/// The soft pendulum, straight.
struct Bench<const D: usize> {
    system: System<D>,
    state: State,
    work: Workspace<D>,
}

impl<const D: usize> Bench<D> {
    fn new(elements: u32) -> Self {
        let text = include_str!("../../../tests/cases/soft_pendulum/scene.json");
        let mut json: serde_json::Value = serde_json::from_str(text).expect("a scene");
        json["bodies"][0]["elements"] = elements.into();
        json["dimension"] = D.into();
        let line = "/bodies/0/shape/line";
        for place in ["/gravity", &format!("{line}/from"), &format!("{line}/to")] {
            let vector = json
                .pointer_mut(place)
                .and_then(|place| place.as_array_mut());
            vector.expect("a vector").resize(D, 0.0.into());
        }
        let scene = Scene::from_json(&json.to_string()).expect("a valid scene");
        let assembled = assemble(&scene).expect("a system");
        let system = assembled.system;
        let mut work = Workspace::new(&system);
        let state = system.blank_state(0.0);
        let mut model = DrivenSystem::new(&system, &[], &mut work, &state);
        let (q, v) = (&state.coordinates, &state.rates);
        model.linearize(0.0, q, v);
        let s = Complex::new(1.0, 1.0) / STEP;
        assert!(
            model.factor([1.0 / (STEP * STEP), 1.0 / STEP]) && model.factor_complex([s * s, s])
        );
        Self {
            system,
            state,
            work,
        }
    }

    /// Times one call of the model.
    fn model<M: criterion::measurement::Measurement>(
        &mut self,
        group: &mut BenchmarkGroup<'_, M>,
        name: &str,
        call: impl Fn(&mut DrivenSystem<'_, D>, &State, &mut [Vec<f64>; 3]),
    ) {
        let mut model = DrivenSystem::new(&self.system, &[], &mut self.work, &self.state);
        let right = vec![1e-3; self.system.coordinates()];
        let mut vectors = [right.clone(), right.clone(), right];
        group.bench_function(name, |bench| {
            bench.iter(|| call(&mut model, black_box(&self.state), &mut vectors));
        });
    }
}

/// Identity: stages as they are.
const PLAIN: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

fn kernels(criterion: &mut Criterion) {
    for elements in MESHES {
        kernels_of(criterion, elements, Bench::<2>::new(elements), "plane");
        kernels_of(criterion, elements, Bench::<3>::new(elements), "space");
    }
}

fn kernels_of<const D: usize>(
    criterion: &mut Criterion,
    elements: u32,
    mut bench: Bench<D>,
    place: &str,
) {
    let mut group = criterion.benchmark_group(format!("{place}, {elements} elements"));
    group.throughput(Throughput::Elements(u64::from(elements)));
    let nodes = bench.system.bodies().reference.to_vec();
    let (rest, mut force) = (vec![no_node(); nodes.len()], vec![no_node(); nodes.len()]);
    group.bench_function("force", |b| {
        b.iter(|| {
            bench.system.bodies().lines()[0].add_force(
                (black_box(&nodes), &rest),
                [1.0, 0.0],
                &mut force,
            )
        });
    });
    let elimination = bench.system.elimination();
    let (mut x, mut y) = (nodes.clone(), vec![0.0; elimination.scratch()]);
    let mut q = bench.state.coordinates.clone();
    group.bench_function("coordinates to nodes and forces back", |b| {
        b.iter(|| {
            elimination.expand(black_box(&q), &mut y, &mut x);
            elimination.reduce(black_box(&force), &mut y, &mut q);
        });
    });
    bench.model(&mut group, "acceleration", |model, at, [a, ..]| {
        model.acceleration(0.0, &at.coordinates, &at.rates, a);
    });
    bench.model(&mut group, "tangent", |model, at, _| {
        model.linearize(0.0, &at.coordinates, &at.rates);
    });
    bench.model(&mut group, "real factors", |model, _, _| {
        assert!(model.factor([1.0 / (STEP * STEP), 1.0 / STEP]));
    });
    bench.model(&mut group, "complex factors", |model, _, _| {
        let s = Complex::new(1.0, 1.0) / STEP;
        assert!(model.factor_complex([s * s, s]));
    });
    bench.model(&mut group, "real solve", |model, _, [a, ..]| {
        a.fill(1e-3);
        model.solve(a);
    });
    bench.model(&mut group, "solve of three stages", |model, _, stages| {
        stages.iter_mut().for_each(|stage| stage.fill(1e-3));
        model.solve_stages(PLAIN.as_flattened(), PLAIN.as_flattened(), stages);
    });
    bench.model(
        &mut group,
        "whole Newton iteration, one stage",
        |model, at, [a, ..]| {
            model.acceleration(0.0, &at.coordinates, &at.rates, a);
            model.linearize(0.0, &at.coordinates, &at.rates);
            assert!(model.factor([1.0 / (STEP * STEP), 1.0 / STEP]));
            model.solve(a);
        },
    );
    group.finish();
}

/// Bending stiffness of a free beam by differences, symmetric, and with a follower force at its end.
fn bending(follower: f64, rows: usize) -> impl Fn(usize, usize) -> f64 {
    move |i, j| {
        let load = if j + 1 == rows { follower } else { 0.0 };
        load + [6.0, -4.0, 1.0].get(i.abs_diff(j)).copied().unwrap_or(0.0)
    }
}

fn eigenvalues(criterion: &mut Criterion) {
    for rows in ROWS {
        let mut group = criterion.benchmark_group(format!("eigenvalues, {rows} rows"));
        let (symmetric, general) = (bending(0.0, rows), bending(0.1, rows));
        group.bench_function("symmetric", |b| {
            b.iter(|| eigen::symmetric_eigenvalues(rows, black_box(&symmetric)));
        });
        group.bench_function("symmetric, faer", |b| {
            b.iter(|| {
                let matrix = faer::Mat::from_fn(rows, rows, black_box(&symmetric));
                matrix.self_adjoint_eigenvalues(faer::Side::Lower)
            });
        });
        group.bench_function("general", |b| {
            b.iter(|| eigen::eigenvalues(rows, black_box(&general)));
        });
        group.bench_function("general, faer", |b| {
            b.iter(|| {
                let matrix = faer::Mat::from_fn(rows, rows, black_box(&general));
                matrix.eigenvalues()
            });
        });
        group.finish();
    }
}

/// Packs of rods that are bent and twisted.
struct Rods {
    pack: rod::Pack,
    packs: usize,
    at: rod::At<[f64; PACK]>,
    force: rod::Force<[f64; PACK]>,
    tangent: Box<rod::Matrix<[f64; PACK]>>,
    with_tangent: bool,
}

impl Rods {
    fn new(stiffness: [[f64; 3]; 3], packs: usize) -> Self {
        let parameters = rod::Parameters {
            length: 0.1,
            stiffness: [stiffness; 3],
            damping_times: [0.0; 3],
            axial: None,
        };
        let straight = rod::At {
            e: [[0.0; 3], [1.0, 0.0, 0.0], [0.1, 0.0, 0.0], [1.0, 0.0, 0.0]],
            d: [[0.0, 1.0, 0.0]; 2],
            bubble: 0.0,
        };
        let mut bent = straight;
        (bent.e[1], bent.d[0]) = ([0.8, 0.0, 0.6], [0.6, 0.0, -0.8]);
        Self {
            pack: rod::Rod::pack(&vec![rod::Rod::new(parameters, &straight); PACK]),
            packs,
            at: rod::At {
                e: bent.e.map(|v| v.map(|x| [x; PACK])),
                d: bent.d.map(|v| v.map(|x| [x; PACK])),
                bubble: [0.1; PACK],
            },
            force: rod::Force {
                e: [[[0.0; PACK]; 3]; 4],
                torque: [[0.0; PACK]; 2],
                bubble: [0.0; PACK],
            },
            tangent: Box::new([[[0.0; PACK]; rod::VELOCITIES]; rod::VELOCITIES]),
            with_tangent: false,
        }
    }
}

impl lanes::Vectorized for &mut Rods {
    #[inline(always)]
    fn run<S: lanes::Simd>(self, simd: S) {
        for _ in 0..self.packs {
            let at = black_box(&self.at);
            let at = rod::At {
                e: at.e.each_ref().map(|v| v.each_ref()),
                d: at.d.each_ref().map(|v| v.each_ref()),
                bubble: &at.bubble,
            };
            let motion = ElementMotion {
                at: &at,
                rates: None,
            };
            if self.with_tangent {
                let out = black_box(&mut *self.tangent);
                let kind = rod::Tangent::Stiffness;
                rod::Rod::pack_tangent(simd, &self.pack, motion, kind, out);
            } else {
                rod::Rod::pack_force(simd, &self.pack, motion, black_box(&mut self.force));
            }
        }
    }
}

fn rods(criterion: &mut Criterion) {
    let packs = 100;
    let mut group = criterion.benchmark_group(format!("rods, {} elements", packs * PACK));
    group.throughput(Throughput::Elements((packs * PACK) as u64));
    for (name, second) in [("round", 1.0), ("general", 2.0)] {
        let stiffness = [[0.8, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, second]];
        let mut rods = Rods::new(stiffness, packs);
        for (what, with_tangent) in [("force", false), ("tangent", true)] {
            rods.with_tangent = with_tangent;
            group.bench_function(format!("{what}, {name}"), |b| {
                b.iter(|| lanes::vectorized(&mut rods));
            });
        }
    }
    group.finish();
}

/// Packs of beams that are bent, twisted and sheared.
struct Beams {
    pack: beam::Pack,
    packs: usize,
    at: beam::At<[f64; PACK]>,
    force: beam::Force<[f64; PACK]>,
    tangent: Box<beam::Matrix<[f64; PACK]>>,
    with_tangent: bool,
}

impl Beams {
    fn new(packs: usize) -> Self {
        let coupled = |i: usize, j: usize| if i == j { 2.0 } else { 0.1 };
        let stiffness = std::array::from_fn(|i| std::array::from_fn(|j| coupled(i, j)));
        let parameters = beam::Parameters {
            length: 0.1,
            stiffness: [stiffness; 3],
            damping_times: [0.0; 6],
        };
        let straight = beam::At {
            e: [[0.0; 3], [1.0, 0.0, 0.0], [0.1, 0.0, 0.0], [1.0, 0.0, 0.0]],
            axes: [[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]; 2],
            inner: [0.0; 3],
        };
        let mut bent = straight;
        bent.e[1] = [0.8, 0.0, 0.6];
        bent.axes[0] = [[0.6, 0.0, 0.8], [0.0, 1.0, 0.0], [-0.8, 0.0, 0.6]];
        let zero = [0.0; PACK];
        Self {
            pack: beam::Beam::pack(&vec![beam::Beam::new(parameters, &straight); PACK]),
            packs,
            at: beam::At {
                e: bent.e.map(|v| v.map(|x| [x; PACK])),
                axes: bent.axes.map(|axes| axes.map(|v| v.map(|x| [x; PACK]))),
                inner: [[0.1; PACK]; 3],
            },
            force: beam::Force {
                e: [[zero; 3]; 4],
                moment: [[zero; 3]; 2],
                inner: [zero; 3],
            },
            tangent: Box::new([[zero; beam::VELOCITIES]; beam::VELOCITIES]),
            with_tangent: false,
        }
    }
}

impl lanes::Vectorized for &mut Beams {
    #[inline(always)]
    fn run<S: lanes::Simd>(self, simd: S) {
        for _ in 0..self.packs {
            let at = black_box(&self.at);
            let axes = at.axes.each_ref();
            let at = beam::At {
                e: at.e.each_ref().map(|v| v.each_ref()),
                axes: axes.map(|axes| axes.each_ref().map(|v| v.each_ref())),
                inner: at.inner.each_ref(),
            };
            let motion = ElementMotion {
                at: &at,
                rates: None,
            };
            if self.with_tangent {
                let out = black_box(&mut *self.tangent);
                let kind = beam::Tangent::Stiffness;
                beam::Beam::pack_tangent(simd, &self.pack, motion, kind, out);
            } else {
                let out = black_box(&mut self.force);
                beam::Beam::pack_force(simd, &self.pack, motion, out);
            }
        }
    }
}

fn beams(criterion: &mut Criterion) {
    let packs = 100;
    let mut group = criterion.benchmark_group(format!("beams, {} elements", packs * PACK));
    group.throughput(Throughput::Elements((packs * PACK) as u64));
    let mut beams = Beams::new(packs);
    for (what, with_tangent) in [("force", false), ("tangent", true)] {
        beams.with_tangent = with_tangent;
        group.bench_function(what, |b| {
            b.iter(|| lanes::vectorized(&mut beams));
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(std::time::Duration::from_millis(200))
        .measurement_time(std::time::Duration::from_millis(800));
    targets = kernels, rods, beams, eigenvalues
}
criterion_main!(benches);

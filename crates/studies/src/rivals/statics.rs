//! A cantilever in every formulation: under a force across its tip, and rolled up by a moment.

use super::basis::Held;
use super::scenes::{Choice, Rod};
use super::system::{Item, Joint, Load, System, To};
use super::{Marker, Motion, Placement, Vector};

/// Tip of the inextensible elastica at F L^2 / EI = 10 (elliptic integrals, case `elastica`).
const ELASTICA: Vector = [0.445_004_402_246_248_7, 0.810_609_024_880_296_5];

/// A rod of unit length and bending stiffness with EA = GA, clamped at the origin along the first axis, under a force across
/// its tip and a moment there, both in so many equal parts: its tip. `Err` with the part that has no equilibrium.
///
/// # Errors
/// The first part of the load that has no equilibrium.
pub fn cantilever(
    choice: Choice,
    slenderness: f64,
    [force, moment]: Vector,
    parts: u32,
) -> Result<Vector, u32> {
    let rod = Rod {
        length: 1.0,
        axial: slenderness,
        shear: slenderness,
        bending: 1.0,
        density: 1.0,
        rotary: 0.0,
    };
    let placement = Placement {
        start: [0.0; 2],
        angle: 0.0,
        velocity: [0.0; 2],
        spin: 0.0,
    };
    let start = Marker::Start.on(0);
    let items = vec![
        Item::Joint(Joint::Pin {
            at: start,
            to: To::Ground([0.0; 2]),
        }),
        Item::Joint(Joint::Drive {
            at: start,
            angle: |_| [0.0; 3],
        }),
        Item::Body(choice.rod(rod, Held::Clamped), placement),
    ];
    let value = Box::new(move |part: f64| [0.0, part * force, part * moment]);
    let load = Load {
        at: Marker::End.on(0),
        value,
    };
    let mut system = System::new(items, vec![load], [0.0; 2]);
    let mut q = system.start[0].clone();
    let mut multipliers = vec![0.0; q.len()];
    for part in 1..=parts {
        let factor = f64::from(part) / f64::from(parts);
        equilibrium(&mut system, factor, &mut q, &mut multipliers).ok_or(part)?;
    }
    Ok(system.position(Marker::End.on(0), &q))
}

/// Newton's method; the tangent is exact.
fn equilibrium(
    system: &mut System,
    part: f64,
    q: &mut [f64],
    multipliers: &mut [f64],
) -> Option<()> {
    let rest = vec![0.0; q.len()];
    let (mut band, mut r) = (system.band(), vec![0.0; q.len()]);
    for _ in 0..50 {
        let motion = Motion {
            q,
            v: &rest,
            a: &rest,
        };
        system.residual(part, motion, multipliers, &mut r);
        system.tangent(part, motion, multipliers, [1.0, 0.0, 0.0], &mut band);
        band.factor()?;
        band.solve(&mut r);
        let mut size = 0.0_f64;
        for i in 0..q.len() {
            if system.multiplier[i] {
                multipliers[i] -= r[i];
            } else {
                q[i] -= r[i];
                size = size.max(r[i].abs());
            }
        }
        if size < 1e-10 {
            return Some(());
        }
    }
    None
}

/// Returns the distance of the tip from the elastica under ten times EI/L^2, over L.
///
/// # Errors
/// A load without equilibrium, in words.
pub fn elastica(choice: Choice, slenderness: f64) -> Result<f64, String> {
    let tip = cantilever(choice, slenderness, [10.0, 0.0], 40);
    let [x, y] = tip.map_err(|part| format!("no equilibrium at part {part}"))?;
    Ok((x - ELASTICA[0]).hypot(y - ELASTICA[1]))
}

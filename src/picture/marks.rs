//! Parts of a scene with a symbol: joints, springs, limits, gears, latches, motions and ports.

use super::palette::{FAINT, MOTION, SPRING};
use super::stroke::Stroke;
use super::symbols;
use crate::math::vector::norm;
use crate::scene::{
    Ends, First, JointCoordinate, LoadPlace, Resolved, ResolvedLoad, ResolvedMarker, Symbol,
};

/// Part of a scene with a symbol.
#[derive(Clone, Debug)]
pub struct Mark<'a> {
    /// Name in the scene.
    pub name: &'a str,
    /// Kind in a word.
    pub kind: &'static str,
    /// Ends that the symbol is relative to.
    pub ends: Ends<'a>,
    /// Unit vector at the start that the symbol is relative to: in space in global axes, in the plane in axes of what the first end is on.
    pub direction: Option<[f64; 3]>,
    /// Where its name is written.
    pub label: MarkLabel,
    /// Colour of its name.
    pub name_colour: &'static str,
    /// Symbol.
    pub strokes: Vec<Stroke>,
}

/// Where the name of something with a symbol is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MarkLabel {
    /// Nowhere.
    Nowhere,
    /// At the second end.
    Second,
    /// In the middle between both ends.
    Middle,
}

/// Collects all parts with a symbol. Joints come first, in the order of the scene.
pub fn marks<'a>(resolved: &Resolved<'a>) -> Vec<Mark<'a>> {
    let dimension = resolved.scene.dimension;
    let joints = resolved.joints.iter().map(|joint| Mark {
        name: joint.name,
        kind: joint.kind_name(),
        ends: joint.ends,
        direction: symbols::direction(joint),
        label: match joint.symbol() {
            Symbol::Link => MarkLabel::Middle,
            _ => MarkLabel::Second,
        },
        name_colour: FAINT,
        strokes: symbols::joint(joint),
    });
    let loads = resolved.loads.iter().flat_map(of_load);
    let gears = resolved.gears.iter().map(|gear| {
        let [first, second] = gear.coordinates.map(|of| of.ends().second);
        Mark {
            label: MarkLabel::Nowhere,
            strokes: symbols::gear(gear),
            ..plain(gear.name, "gear", between(first, second))
        }
    });
    let latches = resolved.latches.iter().map(|latch| {
        let marker = latch.coordinate.ends().second;
        Mark {
            strokes: symbols::latch(),
            ..plain(latch.name, "latch", between(marker, marker))
        }
    });
    let motions = resolved.motions.iter().filter_map(|motion| {
        let quantity = motion.driven.quantity();
        let strokes = symbols::motion(&quantity, dimension);
        let (ends, direction) = match quantity.place {
            LoadPlace::Coordinate(JointCoordinate::Displacement(slider)) => {
                (slider.ends, Some(slider.direction))
            }
            LoadPlace::Ends(ends) => (ends, None),
            place => {
                let marker = place.second()?;
                (between(marker, marker), None)
            }
        };
        Some(Mark {
            direction,
            name_colour: MOTION,
            strokes,
            ..plain(motion.name, "motion", ends)
        })
    });
    let ports = resolved.ports.iter().map(|port| Mark {
        name_colour: MOTION,
        strokes: symbols::port(&port.kind, dimension),
        ..plain(port.name, "port", between(port.marker, port.marker))
    });
    let ports = ports.filter(|port| !port.strokes.is_empty());
    let bound = joints.chain(loads).chain(gears).chain(latches);
    let all = bound.chain(motions).chain(ports);
    all.map(|mark| Mark {
        direction: mark.direction.map(unit),
        ..mark
    })
    .collect()
}

fn unit(direction: [f64; 3]) -> [f64; 3] {
    let length = norm(&direction);
    direction.map(|part| part / length)
}

fn between<'a>(first: ResolvedMarker<'a>, second: ResolvedMarker<'a>) -> Ends<'a> {
    Ends {
        first: First::Marker(first),
        second,
    }
}

/// Something named at its second end, without a direction and a symbol.
fn plain<'a>(name: &'a str, kind: &'static str, ends: Ends<'a>) -> Mark<'a> {
    Mark {
        name,
        kind,
        ends,
        direction: None,
        label: MarkLabel::Second,
        name_colour: FAINT,
        strokes: Vec::new(),
    }
}

/// A spring, a limit, friction, or the straight parts of a rope, the first of which has its name; none of other loads.
fn of_load<'a>(load: &ResolvedLoad<'a>) -> Vec<Mark<'a>> {
    let spans = load.kind.spans();
    if spans.is_empty() {
        return of_one(load).into_iter().collect();
    }
    let name = |k: usize| {
        if k == 0 {
            MarkLabel::Middle
        } else {
            MarkLabel::Nowhere
        }
    };
    let spans = spans.into_iter().enumerate();
    spans
        .map(|(k, ends)| Mark {
            label: name(k),
            name_colour: SPRING,
            strokes: symbols::rope(ends.is_grounded()),
            ..plain(load.name, "rope", ends)
        })
        .collect()
}

/// A spring, a limit or friction; none of other loads.
fn of_one<'a>(load: &ResolvedLoad<'a>) -> Option<Mark<'a>> {
    let (on, kind, strokes) = match (load.kind.place(), load.kind.limits()) {
        (_, Some((on, limits))) => (on, "joint limit", symbols::joint_limit(&on, limits)),
        (LoadPlace::Coordinate(on), None) if load.kind.is_friction() => {
            (on, "friction", symbols::joint_friction())
        }
        (LoadPlace::Coordinate(on), None) if load.kind.exerts_on().is_some() => {
            (on, "spring", symbols::joint_spring(&on))
        }
        (place, None) => {
            let ends = place.ends()?;
            return Some(Mark {
                label: MarkLabel::Middle,
                name_colour: SPRING,
                strokes: symbols::spring(ends.is_grounded()),
                ..plain(load.name, "spring", ends)
            });
        }
    };
    Some(Mark {
        direction: match on {
            JointCoordinate::Displacement(slider) => Some(slider.direction),
            JointCoordinate::Angle(_) => None,
        },
        label: MarkLabel::Nowhere,
        name_colour: SPRING,
        strokes,
        ..plain(load.name, kind, on.ends())
    })
}

//! Checks of springs, dampers and stops.

use super::checks::{expected, finite, not_negative, positive, spring_damper};
use crate::math::curve::Curve;
use crate::scene::Error;
use crate::scene::description::{
    self, CoordinateKind, JointLimitLoad, JointSpringLoad, LoadKind as Given, TableSpringLoad,
};
use crate::scene::resolved::{
    First, JointCoordinate, LoadKind, Resolved, ResolvedBushing, ResolvedTableSpring,
};

impl<'a> Resolved<'a> {
    /// Resolves a load other than a force or a moment.
    ///
    /// # Errors
    /// A missing key, a reference that does not exist, or a value out of range.
    pub(super) fn resolve_springs(
        &self,
        path: &str,
        load: &'a Given,
    ) -> Result<LoadKind<'a>, Error> {
        match load {
            Given::JointSpring(load) => self.joint_spring(path, load),
            Given::JointLimit(load) => self.stop(path, load),
            Given::Fluid(load) => self.fluid(path, load).map(LoadKind::Fluid),
            Given::Contact(load) => self.contact(path, load).map(LoadKind::Contact),
            Given::Bushing(load) => self.bushing(path, load).map(LoadKind::Bushing),
            Given::SpringDamper(load) => self.spring(path, load).map(LoadKind::Spring),
            Given::TableSpring(load) => self.table_spring(path, load).map(LoadKind::TableSpring),
            Given::Force(_)
            | Given::Moment(_)
            | Given::Torque(_)
            | Given::DistributedForce(_)
            | Given::DistributedMoment(_) => unreachable!("a force or a moment"),
        }
    }

    fn coordinate(
        &self,
        path: &str,
        joint: &'a str,
        asked: Option<CoordinateKind>,
    ) -> Result<JointCoordinate<'a>, Error> {
        let default = CoordinateKind::Displacement;
        self.require_coordinate(&format!("{path}.joint"), joint, asked, default)
    }

    fn table_spring(
        &self,
        path: &str,
        load: &'a TableSpringLoad,
    ) -> Result<ResolvedTableSpring<'a>, Error> {
        let curve = |key: &str, points: &[[f64; 2]]| {
            Curve::new(points).map_err(|message| Error {
                path: format!("{path}.{key}"),
                message,
            })
        };
        let ends = self.require_pair(path, &load.markers, load.point)?;
        let spring = curve("spring", &load.spring)?;
        let damper = load.damper.as_ref();
        let damper = damper.map(|points| curve("damper", points)).transpose()?;
        let rests = |points: &Vec<[f64; 2]>| points.contains(&[0.0; 2]);
        if !load.damper.as_ref().is_none_or(rests) {
            let wanted = "a point [0, 0], since a damper at rest has no force";
            return Err(expected(&format!("{path}.damper"), wanted, "none"));
        }
        Ok(ResolvedTableSpring {
            ends,
            spring,
            damper,
        })
    }

    fn joint_spring(&self, path: &str, load: &'a JointSpringLoad) -> Result<LoadKind<'a>, Error> {
        let on = self.coordinate(path, &load.joint, load.coordinate)?;
        let units = if on.is_angle() {
            ["N m/rad", "N m s/rad"]
        } else {
            ["N/m", "N s/m"]
        };
        if let Some(rest) = load.rest {
            finite(&format!("{path}.rest"), rest)?;
        }
        let sizes = spring_damper(path, load.stiffness, load.damping, units)?;
        Ok(LoadKind::JointSpring {
            on,
            sizes,
            rest: load.rest,
        })
    }

    fn stop(&self, path: &str, load: &'a JointLimitLoad) -> Result<LoadKind<'a>, Error> {
        let on = self.coordinate(path, &load.joint, load.coordinate)?;
        let units = if on.is_angle() {
            ["N m/rad", "s/rad"]
        } else {
            ["N/m", "s/m"]
        };
        positive(&format!("{path}.stiffness"), units[0], load.stiffness)?;
        let damping = load.damping.unwrap_or(0.0);
        not_negative(&format!("{path}.damping"), units[1], damping)?;
        let limits = [load.lower, load.upper];
        for (key, limit) in ["lower", "upper"].into_iter().zip(limits) {
            if let Some(limit) = limit {
                finite(&format!("{path}.{key}"), limit)?;
            }
        }
        match limits {
            [None, None] => Err(expected(path, "a lower or an upper limit", "neither")),
            [Some(lower), Some(upper)] if lower > upper => {
                let wanted = format!("a limit that is not below `lower`, {lower}");
                Err(expected(&format!("{path}.upper"), &wanted, upper))
            }
            _ => Ok(LoadKind::JointLimit {
                on,
                sizes: [load.stiffness, damping],
                limits,
            }),
        }
    }

    fn bushing(
        &self,
        path: &str,
        load: &'a description::BushingLoad,
    ) -> Result<ResolvedBushing<'a>, Error> {
        if self.scene.dimension == 2 {
            let wanted = "spring_damper, or revolute with a stiffness in the plane";
            return Err(expected(&format!("{path}.kind"), wanted, "bushing"));
        }
        let markers = &load.markers;
        let ends = self.require_pair(path, markers, None)?;
        if let First::Marker(_) = ends.first {
            self.require_standing(&format!("{path}.markers[0]"), &markers[0])?;
        }
        self.require_standing(&format!("{path}.markers[1]"), &markers[1])?;
        let all = [
            (
                "translational_stiffness",
                load.translational_stiffness,
                "N/m",
            ),
            ("rotational_stiffness", load.rotational_stiffness, "N m/rad"),
            ("translational_damping", load.translational_damping, "N s/m"),
            ("rotational_damping", load.rotational_damping, "N m s/rad"),
        ];
        if all.iter().all(|(_, given, _)| given.is_none()) {
            return Err(expected(path, "stiffnesses or dampings", "none"));
        }
        for (key, given, unit) in all {
            for (k, value) in given.iter().flatten().enumerate() {
                not_negative(&format!("{path}.{key}[{k}]"), unit, *value)?;
            }
        }
        let [along, about, damped, turned] = all.map(|(_, given, _)| given.unwrap_or_default());
        Ok(ResolvedBushing {
            ends,
            stiffness: [along, about],
            damping: [damped, turned],
        })
    }
}

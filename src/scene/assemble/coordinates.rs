//! Coordinates of joints, and what stands on them: springs, limits, screws, gears.

use super::{Builder, unit};
use crate::math::space::vector;
use crate::scene::resolved::{DirectionSource, First, JointCoordinate, Pivot, Slider};
use crate::system::joints::{Coupler, Primitive};
use crate::system::loads::{AppliedLoad, JointSpring};
use crate::system::{Angle, Attachment, Coordinate, Direction, Translation};

impl<const D: usize> Builder<'_, D> {
    /// The way along the line of a joint.
    pub(crate) fn way(&self, slider: &Slider<'_>) -> Translation<D> {
        let ends = self.ends(slider.ends);
        let still = [0.0, 1.0];
        let (direction, turn) = match (slider.ends.first, &ends[0]) {
            (First::Marker(_), Attachment::Body(marker)) if D == 2 => {
                let [cos, sin] = [0, 1].map(|k| unit::<D>(slider.direction)[k]);
                (Direction::Of(*marker), [sin, cos])
            }
            (First::Marker(_), first) => (self.fixed(first, vector(slider.along)), still),
            _ => (Direction::Fixed(vector(slider.along)), still),
        };
        Translation {
            ends,
            direction,
            turn,
        }
    }

    /// The angle of a joint, which is counted.
    fn counted(&mut self, pivot: &Pivot<'_>) -> Coordinate<D> {
        let ends = self.ends(pivot.ends);
        let turn = self.axis_turn(&DirectionSource::Pivot(*pivot));
        let index = self.count_angle(ends, turn);
        Coordinate::Angle(Angle { ends, turn }, index)
    }

    pub(crate) fn coordinate(&mut self, of: &JointCoordinate<'_>) -> Coordinate<D> {
        match of {
            JointCoordinate::Displacement(slider) => Coordinate::Translation(self.way(slider)),
            JointCoordinate::Angle(pivot) => self.counted(pivot),
        }
    }

    /// Returns the value in the shapes and positions that the scene describes, m or rad.
    pub(crate) fn at_start(&self, coordinate: &Coordinate<D>) -> f64 {
        let angles = vec![0.0; self.parts.angles.len()];
        coordinate.value(&self.parts.bodies.reference, &angles)
    }

    /// A spring and a damper on a coordinate of a joint.
    pub(crate) fn joint_spring(
        &self,
        coordinate: Coordinate<D>,
        [stiffness, damping]: [f64; 2],
        rest: Option<f64>,
    ) -> AppliedLoad<D> {
        AppliedLoad::JointSpring(JointSpring {
            rest: rest.unwrap_or_else(|| self.at_start(&coordinate)),
            coordinate: Box::new(coordinate),
            stiffness,
            damping,
        })
    }

    /// `second - ratio first` stays what it is at the start.
    pub(crate) fn related(&mut self, both: &[JointCoordinate<'_>; 2], ratio: f64) -> Primitive<D> {
        let [first, second] = both.each_ref().map(|of| self.coordinate(of));
        let offset = self.at_start(&second) - ratio * self.at_start(&first);
        let size = self.size_on(&second);
        Primitive::Coupler(Coupler {
            terms: vec![(-ratio, first), (1.0, second)],
            offset,
            drive: None,
            size,
        })
    }

    /// A coordinate is held at an offset (m or rad), and at a driven coordinate beside it.
    pub(crate) fn held(
        &self,
        coordinate: Coordinate<D>,
        offset: f64,
        drive: Option<usize>,
    ) -> Primitive<D> {
        let size = self.size_on(&coordinate);
        Primitive::Coupler(Coupler {
            terms: vec![(1.0, coordinate)],
            offset,
            drive,
            size,
        })
    }

    /// Returns the reference size of residuals on a coordinate: m, or 1 for an angle.
    fn size_on(&self, coordinate: &Coordinate<D>) -> f64 {
        if coordinate.is_angle() {
            1.0
        } else {
            self.size_of(&coordinate.ends())
        }
    }

    /// The way of a screw, by its pitch.
    pub(crate) fn screw(
        &mut self,
        pivot: Pivot<'_>,
        slider: Slider<'_>,
        pitch: f64,
    ) -> Primitive<D> {
        let both = [
            JointCoordinate::Angle(pivot),
            JointCoordinate::Displacement(slider),
        ];
        self.related(&both, pitch / std::f64::consts::TAU)
    }
}

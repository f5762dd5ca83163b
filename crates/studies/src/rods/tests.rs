//! The rods here beside the product's and beside closed forms.

use flexbody::elements::rod::{At, Parameters};

use super::Real3;
use super::hermite::{ALL, Node, Rod, Section};

const SECTION: Section = Section {
    axial: 30.0,
    stiffness: [0.7, 1.1, 2.3],
};

/// Two nodes that are anywhere, with an internal twist.
fn bent() -> Rod {
    let mut rod = Rod::straight(0.8, 1, SECTION, ALL);
    let node = |r: [f64; 3], u: [f64; 3], d: [f64; 3]| {
        let (u, d) = (Real3::from(u), Real3::from(d));
        let d = (d - u * (u.dot(&d) / u.norm_squared())).normalize();
        Node { r: r.into(), u, d }
    };
    rod.nodes = vec![
        node([0.1, 0.0, 0.2], [1.0, 0.3, -0.2], [0.2, 1.0, 0.1]),
        node([0.8, 0.2, 0.4], [0.9, -0.1, 0.5], [0.1, 0.7, 0.9]),
    ];
    rod.bubbles = vec![0.13];
    rod
}

/// Without stretching: the product's element and the line that stretches are two.
#[test]
fn the_whole_rod_is_the_products() {
    let mut rod = bent();
    rod.section.axial = 0.0;
    let diagonal = |i: usize, j: usize| if i == j { SECTION.stiffness[i] } else { 0.0 };
    let parameters = Parameters {
        length: 0.8,
        stiffness: [std::array::from_fn(|i| std::array::from_fn(|j| diagonal(i, j))); 3],
        damping_times: [0.0; 3],
        axial: None,
    };
    let at = |rod: &Rod| At {
        e: [
            rod.nodes[0].r,
            rod.nodes[0].u,
            rod.nodes[1].r,
            rod.nodes[1].u,
        ]
        .map(Into::into),
        d: [rod.nodes[0].d, rod.nodes[1].d].map(Into::into),
        bubble: rod.bubbles[0],
    };
    let still = Rod::straight(0.8, 1, SECTION, ALL);
    let product = flexbody::elements::rod::Rod::new(parameters, &at(&still));
    let (found, wanted) = (rod.energy(), product.energy(&at(&rod)));
    assert!((found / wanted - 1.0).abs() < 1e-13, "{found} for {wanted}");
}

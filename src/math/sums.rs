//! Weighted sums of long vectors, in lanes: what methods of integration make of their stages.

use super::lanes::{AlignedPack, PACK, Simd, Vectorized, vectorized, vectorized_where};

/// A weight and the vector that it belongs to.
pub type Term<'a> = (f64, &'a [f64]);

/// Numbers from which on a sum goes in lanes.
const LONG: usize = 24;

/// Most terms of a sum.
pub const TERMS: usize = 6;

/// `out = sum of all terms`, at least one and at most [`TERMS`]; all vectors are of one length.
pub fn sum(out: &mut [f64], terms: &[Term<'_>]) {
    vectorized_where(out.len() >= LONG, Sum::<'_, false> { out, terms });
}

/// `out += sum of all terms`, at least one and at most [`TERMS`]; all vectors are of one length.
pub fn add(out: &mut [f64], terms: &[Term<'_>]) {
    vectorized_where(out.len() >= LONG, Sum::<'_, true> { out, terms });
}

/// `out = sum of all terms`, at least one; all vectors are of one length.
#[inline]
pub fn combine<'a>(out: &mut [f64], mut terms: impl Iterator<Item = Term<'a>>) {
    if out.len() < LONG {
        // One term after the other: to gather terms would take longer than to add them.
        let (weight, first) = terms.next().expect("one term at least");
        out.iter_mut()
            .zip(first)
            .for_each(|(out, x)| *out = weight * x);
        return terms.for_each(|(weight, x)| {
            out.iter_mut()
                .zip(x)
                .for_each(|(out, x)| *out += weight * x);
        });
    }
    let mut few: [Term<'_>; TERMS] = [(0.0, &[]); TERMS];
    let (mut is_begun, mut count) = (false, 0);
    for term in terms {
        if count == TERMS {
            go_on(is_begun, out, &few);
            (is_begun, count) = (true, 0);
        }
        few[count] = term;
        count += 1;
    }
    go_on(is_begun, out, &few[..count]);
}

/// Where the sums of [`mix`] begin.
#[derive(Clone, Copy, Debug)]
pub enum MixStart<'a> {
    /// At zero.
    Zero,
    /// At what is in place.
    Own,
    /// At zero, and this vector is taken out at the end.
    Less(&'a [f64]),
}

/// `out_i = sum_j rows_ij x_j` of three vectors of one length, all in one pass where they are short.
pub fn mix(start: MixStart<'_>, rows: &[[f64; 3]; 3], x: [&[f64]; 3], out: [&mut [f64]; 3]) {
    if out[0].len() < LONG {
        return match start {
            MixStart::Zero => mix_few(rows, x, x[0], out, |_, _, [a, b, c]| a + b + c),
            MixStart::Own => mix_few(rows, x, x[0], out, |own, _, [a, b, c]| own + a + b + c),
            MixStart::Less(v) => mix_few(rows, x, v, out, |_, v, [a, b, c]| a + b + c - v),
        };
    }
    for (out, row) in out.into_iter().zip(rows) {
        let [a, b, c] = std::array::from_fn(|j| (row[j], x[j]));
        match start {
            MixStart::Zero => sum(out, &[a, b, c]),
            MixStart::Own => add(out, &[a, b, c]),
            MixStart::Less(v) => sum(out, &[a, b, c, (-1.0, v)]),
        }
    }
}

/// [`mix`], two numbers at a time. `of` takes what is in place, a number of `v`, and the products of a row.
#[inline(always)]
fn mix_few(
    rows: &[[f64; 3]; 3],
    x: [&[f64]; 3],
    v: &[f64],
    out: [&mut [f64]; 3],
    of: impl Fn(f64, f64, [f64; 3]) -> f64,
) {
    let n = x[0].len();
    let x = x.map(|x| x[..n].as_chunks::<2>());
    let (v, v_last) = v[..n].as_chunks::<2>();
    let out = out.map(|out| out[..n].as_chunks_mut::<2>());
    let number = |row: &[f64; 3], own: f64, v: f64, x: [f64; 3]| {
        of(own, v, std::array::from_fn(|j| row[j] * x[j]))
    };
    let pairs = x.map(|(x, _)| &x[..v.len()]);
    let [(a, a_last), (b, b_last), (c, c_last)] = out;
    let sums = [a, b, c].map(|out| &mut out[..v.len()]);
    for k in 0..v.len() {
        let x = pairs.map(|x| x[k]);
        for i in 0..3 {
            let own = sums[i][k];
            sums[i][k] =
                std::array::from_fn(|l| number(&rows[i], own[l], v[k][l], x.map(|x| x[l])));
        }
    }
    if let [v] = v_last {
        let x = x.map(|(_, last)| last[0]);
        for (row, out) in rows.iter().zip([a_last, b_last, c_last]) {
            out[0] = number(row, out[0], *v, x);
        }
    }
}

/// `out += sum of factors times columns`, which stand one after the other. All are whole packs.
pub fn add_columns(columns: &[AlignedPack], factors: &[f64], out: &mut [f64]) {
    vectorized(AddColumns {
        columns,
        factors,
        out: out.as_chunks_mut().0,
    });
}

/// Packs that [`add_columns`] sums at once.
const AT_ONCE: usize = 2;

/// [`add_columns`].
struct AddColumns<'a> {
    columns: &'a [AlignedPack],
    factors: &'a [f64],
    out: &'a mut [[f64; PACK]],
}

impl Vectorized for AddColumns<'_> {
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let columns = (self.columns, self.out.len());
        let (several, last) = self.out.as_chunks_mut::<AT_ONCE>();
        let begun = AT_ONCE * several.len();
        for (place, sums) in several.iter_mut().enumerate() {
            add_parts(simd, columns, AT_ONCE * place, self.factors, sums);
        }
        for (place, sum) in last.iter_mut().enumerate() {
            let sum = std::array::from_mut(sum);
            add_parts(simd, columns, begun + place, self.factors, sum);
        }
    }
}

/// Adds factors times parts of columns of a size, from a pack on.
#[inline(always)]
fn add_parts<S: Simd, const K: usize>(
    simd: S,
    (columns, size): (&[AlignedPack], usize),
    place: usize,
    factors: &[f64],
    sums: &mut [[f64; PACK]; K],
) {
    let groups = PACK / S::F64_LANES;
    let mut own = [[simd.splat_f64s(0.0); PACK]; K];
    for k in 0..K {
        for group in 0..groups {
            own[k][group] = S::as_simd_f64s(&sums[k]).0[group];
        }
    }
    for (column, factor) in columns.chunks_exact(size).zip(factors) {
        let Some(part) = column[place..].first_chunk::<K>() else {
            return;
        };
        let factor = simd.splat_f64s(*factor);
        for k in 0..K {
            for group in 0..groups {
                let entries = S::as_simd_f64s(&part[k].0).0[group];
                own[k][group] = simd.mul_add_e_f64s(factor, entries, own[k][group]);
            }
        }
    }
    for k in 0..K {
        for group in 0..groups {
            S::as_mut_simd_f64s(&mut sums[k]).0[group] = own[k][group];
        }
    }
}

/// [`add`] where a sum is begun, [`sum`] where not.
fn go_on(is_begun: bool, out: &mut [f64], terms: &[Term<'_>]) {
    if is_begun {
        add(out, terms)
    } else {
        sum(out, terms)
    }
}

/// [`sum`], or [`add`] if `ADDS`.
struct Sum<'a, const ADDS: bool> {
    out: &'a mut [f64],
    terms: &'a [Term<'a>],
}

impl<const ADDS: bool> Vectorized for Sum<'_, ADDS> {
    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Self { out, terms } = self;
        match *terms {
            [a] => sweep::<S, 1, ADDS>(simd, out, [a]),
            [a, b] => sweep::<S, 2, ADDS>(simd, out, [a, b]),
            [a, b, c] => sweep::<S, 3, ADDS>(simd, out, [a, b, c]),
            [a, b, c, d] => sweep::<S, 4, ADDS>(simd, out, [a, b, c, d]),
            [a, b, c, d, e] => sweep::<S, 5, ADDS>(simd, out, [a, b, c, d, e]),
            [a, b, c, d, e, f] => sweep::<S, 6, ADDS>(simd, out, [a, b, c, d, e, f]),
            _ => unreachable!("expected 1 to {TERMS} terms, found {}", terms.len()),
        }
    }
}

#[inline(always)]
fn sweep<S: Simd, const K: usize, const ADDS: bool>(
    simd: S,
    out: &mut [f64],
    terms: [Term<'_>; K],
) {
    let n = out.len();
    let (out, rest) = S::as_mut_simd_f64s(out);
    let (first, after) = S::as_simd_f64s(&terms[0].1[..n]);
    let weight = simd.splat_f64s(terms[0].0);
    let (mut heads, mut tails, mut weights) = ([first; K], [after; K], [weight; K]);
    for k in 1..K {
        (heads[k], tails[k]) = S::as_simd_f64s(&terms[k].1[..n]);
        weights[k] = simd.splat_f64s(terms[k].0);
    }
    for i in 0..out.len() {
        let mut sum = if ADDS {
            simd.mul_add_e_f64s(weights[0], heads[0][i], out[i])
        } else {
            simd.mul_f64s(weights[0], heads[0][i])
        };
        for k in 1..K {
            sum = simd.mul_add_e_f64s(weights[k], heads[k][i], sum);
        }
        out[i] = sum;
    }
    for i in 0..rest.len() {
        let mut sum = if ADDS { rest[i] } else { 0.0 };
        for k in 0..K {
            sum += terms[k].0 * tails[k][i];
        }
        rest[i] = sum;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_hold_all_terms_whatever_the_length() {
        for n in 0..2 * LONG as u32 {
            let x: Vec<f64> = (0..n).map(f64::from).collect();
            let y: Vec<f64> = x.iter().map(|x| 100.0 + x).collect();
            for count in 1..=TERMS {
                let terms: Vec<Term> = [(2.0, &x[..]), (-1.0, &y)].repeat(3)[..count].to_vec();
                let mut out = vec![f64::NAN; x.len()];
                sum(&mut out, &terms);
                add(&mut out, &terms);
                let mut combined = vec![f64::NAN; x.len()];
                combine(&mut combined, terms.iter().chain(&terms).copied());
                assert_eq!(out, combined);
                for (i, out) in out.iter().enumerate() {
                    let expected: f64 = terms.iter().map(|(weight, x)| weight * x[i]).sum();
                    assert_eq!(*out, 2.0 * expected);
                }
            }
        }
    }

    #[test]
    fn columns_are_added_whatever_their_length() {
        let factors = [2.0, -1.0, 4.0];
        for packs in 0..8 {
            let number = |i: usize| f64::from(u32::try_from(i).expect("a small number"));
            let pack = |i: usize| AlignedPack(std::array::from_fn(|k| number(PACK * i + k)));
            let columns: Vec<AlignedPack> = (0..3 * packs).map(pack).collect();
            let mut out: Vec<f64> = (0..PACK * packs).map(|i| 7.0 * number(i)).collect();
            let mut expected = out.clone();
            add_columns(&columns, &factors, &mut out);
            for (k, factor) in factors.into_iter().enumerate() {
                let column = columns[packs * k..packs * (k + 1)].iter();
                let column: Vec<f64> = column.flat_map(|pack| pack.0).collect();
                add(&mut expected, &[(factor, &column)]);
            }
            assert_eq!(out, expected);
        }
    }

    #[test]
    fn stages_are_mixed_as_by_sums_of_rows() {
        let rows = [[1.0, -2.0, 3.0], [0.5, 0.0, 7.0], [-1.0, 4.0, 0.25]];
        for n in 0..2 * LONG as u32 {
            let vector = |k: u32| (0..n).map(|i| f64::from(i + k * k)).collect::<Vec<f64>>();
            let (x, v) = ([1, 5, 9].map(vector), vector(3));
            let slices = x.each_ref().map(|x| &x[..]);
            for start in [MixStart::Zero, MixStart::Own, MixStart::Less(&v)] {
                let mut out = [2, 4, 6].map(vector);
                let mut expected = out.clone();
                mix(start, &rows, slices, out.each_mut().map(|out| &mut out[..]));
                for (expected, row) in expected.iter_mut().zip(&rows) {
                    let [a, b, c] = std::array::from_fn(|j| (row[j], slices[j]));
                    match start {
                        MixStart::Zero => sum(expected, &[a, b, c]),
                        MixStart::Own => add(expected, &[a, b, c]),
                        MixStart::Less(v) => sum(expected, &[a, b, c, (-1.0, v)]),
                    }
                }
                assert_eq!(out, expected);
            }
        }
    }
}

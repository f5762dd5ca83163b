//! A saved FMU state, and its bytes: versioned, tied to one model, checksummed, without pointers.
//!
//! Layout, little-endian: magic, format version, GUID, lifecycle state, flags, start time, stop
//! time, time, sub-step, work of both kinds, what integrators go by, the step within which it stands, twelve lengths and that of the scene,
//! the numbers, the scene (JSON), SHA-256 of all before. With the scene inside, a state brings an instance without resources to life.

use std::mem::MaybeUninit;
use std::sync::Arc;

use sha2::{Digest, Sha256};

use super::lifecycle;
use super::status::Fault;
use crate::simulation::{Snapshot, Spectra};
use crate::system::{DenseStep, MethodStatistics, State};

const MAGIC: &[u8; 8] = b"FLEXBODY";
const VERSION: u32 = 8;
const GUID_BYTES: usize = 38;
const HASH_BYTES: usize = 32;
const ARRAYS: usize = 13;
/// Numbers of every motion that inputs drive.
const DRIVEN: usize = 5;
/// Numbers that every state has.
const NUMBERS: usize = 6 + MethodStatistics::NUMBERS + DenseStep::NUMBERS;
/// Magic, version, GUID, two bytes, numbers, lengths of the arrays and the scene.
const HEADER_BYTES: usize = 8 + 4 + GUID_BYTES + 2 + NUMBERS * 8 + (ARRAYS + 1) * 8;
const INITIALIZED: u8 = 1;
const STARTED: u8 = 2;
const STOP_DEFINED: u8 = 4;
const MOVING: u8 = 8;

/// Everything that an instance needs to go on as if nothing had happened.
#[derive(Clone, Debug, PartialEq)]
pub struct SavedState {
    /// GUID of the model that it belongs to.
    pub guid: String,
    /// Scene of the state, JSON.
    pub scene: Arc<str>,
    /// Lifecycle state.
    pub lifecycle: lifecycle::InstanceState,
    /// Start time of the experiment.
    pub start_time: f64,
    /// Stop time of the experiment, where one is set.
    pub stop_time: Option<f64>,
    /// The numbers of the simulation.
    pub snapshot: Snapshot,
}

impl SavedState {
    /// Number of bytes of [`Self::to_bytes`].
    pub fn size(&self) -> usize {
        let numbers: usize = self.arrays().iter().map(|array| array.len()).sum();
        HEADER_BYTES + 8 * numbers + self.scene.len() + HASH_BYTES
    }

    /// The state as bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.size());
        bytes.extend(MAGIC);
        bytes.extend(VERSION.to_le_bytes());
        bytes.extend(self.guid.as_bytes());
        let Snapshot {
            initialized,
            started,
            moving,
            state,
            ..
        } = &self.snapshot;
        let flag = |set: bool, bit: u8| if set { bit } else { 0 };
        let stop_defined = flag(self.stop_time.is_some(), STOP_DEFINED);
        let flags = flag(*initialized, INITIALIZED)
            | flag(*started, STARTED)
            | flag(*moving, MOVING)
            | stop_defined;
        bytes.extend([self.lifecycle as u8, flags]);
        let stop = self.stop_time.unwrap_or(0.0);
        let [input, lost] = state.work;
        let times = [self.start_time, stop, state.time, state.step, input, lost];
        let step = state.dense.numbers();
        for number in times.into_iter().chain(state.pace.numbers()).chain(step) {
            bytes.extend(number.to_le_bytes());
        }
        for array in self.arrays() {
            bytes.extend((array.len() as u64).to_le_bytes());
        }
        bytes.extend((self.scene.len() as u64).to_le_bytes());
        for number in self.arrays().into_iter().flatten() {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend(self.scene.as_bytes());
        let hash = Sha256::digest(&bytes);
        bytes.extend(hash);
        bytes
    }

    /// Writes [`Self::to_bytes`] into `target`.
    ///
    /// # Errors
    /// A target of another size; nothing is written then.
    pub fn write_to(&self, target: &mut [MaybeUninit<u8>]) -> Result<(), Fault> {
        let bytes = self.to_bytes();
        if target.len() != bytes.len() {
            let (expected, found) = (bytes.len(), target.len());
            let reason = format!("expected room for {expected} bytes, found {found}");
            return Err(Fault::SavedState(reason));
        }
        for (place, byte) in target.iter_mut().zip(bytes) {
            place.write(byte);
        }
        Ok(())
    }

    /// Reads the bytes of a state of the model `guid`.
    ///
    /// # Errors
    /// Bytes that are damaged, cut off, of another format or of another model.
    pub fn from_bytes(bytes: &[u8], guid: &str) -> Result<Self, Fault> {
        let body = checked(bytes, guid)?;
        let mut reader = ByteReader(&body[8 + 4 + GUID_BYTES..]);
        let [mode, flags] = reader.take()?;
        let (lifecycle, initialized, started) = stage(mode, flags)?;
        let [start_time, stop, time, step, input, lost] = reader.numbers()?;
        let pace = MethodStatistics::from_numbers(reader.numbers()?);
        let step_numbers = reader.numbers()?;
        let arrays = reader.arrays()?;
        let scene = std::str::from_utf8(reader.0).map_err(|_| refused("holds no scene"))?;
        let [
            values,
            frequencies,
            eigenvalues,
            coordinates,
            rates,
            frames,
            angles,
            travel,
            released,
            driven,
            slopes,
            held,
            mut vectors,
        ] = arrays;
        if vectors.is_empty() {
            vectors = DenseStep::blank(coordinates.len()).vectors;
        }
        let ((driven, rest), (slopes, none)) = (driven.as_chunks::<DRIVEN>(), slopes.as_chunks());
        let ((eigenvalues, half), (frames, quarter)) =
            (eigenvalues.as_chunks(), frames.as_chunks());
        whole([rest, none, half, quarter])?;
        let state = State {
            time,
            step,
            pace,
            coordinates,
            rates,
            frames: frames.to_vec(),
            angles,
            travel,
            released,
            driven: driven.to_vec(),
            work: [input, lost],
            dense: DenseStep::from_numbers(step_numbers, vectors),
        };
        Ok(Self {
            guid: guid.into(),
            scene: scene.into(),
            lifecycle,
            start_time,
            stop_time: (flags & STOP_DEFINED != 0).then_some(stop),
            snapshot: Snapshot {
                values,
                initialized,
                started,
                moving: flags & MOVING != 0,
                slopes: slopes.to_vec(),
                held,
                spectra: Spectra {
                    frequencies,
                    eigenvalues: eigenvalues.to_vec(),
                },
                state,
            },
        })
    }

    fn arrays(&self) -> [&[f64]; ARRAYS] {
        let Snapshot {
            values,
            slopes,
            held,
            spectra,
            state,
            ..
        } = &self.snapshot;
        [
            values,
            &spectra.frequencies,
            spectra.eigenvalues.as_flattened(),
            &state.coordinates,
            &state.rates,
            state.frames.as_flattened(),
            &state.angles,
            &state.travel,
            &state.released,
            state.driven.as_flattened(),
            slopes.as_flattened(),
            held,
            if state.dense.length > 0.0 {
                &state.dense.vectors
            } else {
                &[]
            },
        ]
    }
}

/// Fault of arrays with an impossible length.
const PARTS: &str = "holds a part of a driven motion, of an input, of an eigenvalue or of a frame";

/// Refuses what is left of arrays that are made of equal parts.
fn whole(rests: [&[f64]; 4]) -> Result<(), Fault> {
    if rests.iter().all(|rest| rest.is_empty()) {
        Ok(())
    } else {
        Err(refused(PARTS))
    }
}

/// Where an instance stood: its lifecycle state, whether it was initialized, whether it was started.
fn stage(mode: u8, flags: u8) -> Result<(lifecycle::InstanceState, bool, bool), Fault> {
    let lifecycle = lifecycle::InstanceState::from_bit(mode)
        .filter(|state| *state as u8 <= lifecycle::InstanceState::Error as u8 && flags < 2 * MOVING)
        .ok_or_else(|| refused("names a lifecycle state that does not exist"))?;
    let (initialized, started) = (flags & INITIALIZED != 0, flags & STARTED != 0);
    if !fits_together(lifecycle, initialized, started) {
        return Err(refused(
            "names a lifecycle state that its numbers do not belong to",
        ));
    }
    Ok((lifecycle, initialized, started))
}

/// Whether a simulation can be that far in a lifecycle state.
fn fits_together(lifecycle: lifecycle::InstanceState, initialized: bool, started: bool) -> bool {
    use lifecycle::InstanceState::*;
    match lifecycle {
        Instantiated | Initialization => !started,
        StepComplete | StepFailed | Terminated => initialized && started,
        Error | Bare | Fatal => true,
    }
}

fn refused(reason: &str) -> Fault {
    Fault::SavedState(reason.into())
}

/// The bytes before the checksum, if they are whole and of this format and model.
fn checked<'a>(bytes: &'a [u8], guid: &str) -> Result<&'a [u8], Fault> {
    if !bytes.starts_with(MAGIC) {
        return Err(refused("is not a state of a Flexbody unit"));
    }
    let body = bytes
        .len()
        .checked_sub(HASH_BYTES)
        .filter(|length| *length >= HEADER_BYTES);
    let (body, hash) = bytes.split_at(body.ok_or_else(|| refused("is cut off"))?);
    if Sha256::digest(body)[..] != *hash {
        return Err(refused("is damaged or cut off: its checksum does not fit"));
    }
    let mut reader = ByteReader(&body[MAGIC.len()..]);
    let version = u32::from_le_bytes(reader.take()?);
    if version != VERSION {
        let reason = format!("expected format version {VERSION}, found {version}");
        return Err(Fault::SavedState(reason));
    }
    if reader.0[..GUID_BYTES] != *guid.as_bytes() {
        let found = String::from_utf8_lossy(&reader.0[..GUID_BYTES]);
        let reason = format!("expected one of the model {guid}, found one of {found}");
        return Err(Fault::SavedState(reason));
    }
    Ok(body)
}

/// Reads from the front of a slice.
struct ByteReader<'a>(&'a [u8]);

impl ByteReader<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], Fault> {
        let (head, tail) = self
            .0
            .split_first_chunk()
            .ok_or_else(|| refused("is cut off"))?;
        self.0 = tail;
        Ok(*head)
    }

    fn number(&mut self) -> Result<f64, Fault> {
        let number = f64::from_le_bytes(self.take()?);
        if number.is_finite() {
            return Ok(number);
        }
        Err(refused("contains a number that is not finite"))
    }

    fn numbers<const N: usize>(&mut self) -> Result<[f64; N], Fault> {
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            *number = self.number()?;
        }
        Ok(numbers)
    }

    /// The lengths of the arrays and of the scene, then the arrays; the scene is left.
    fn arrays(&mut self) -> Result<[Vec<f64>; ARRAYS], Fault> {
        let mut lengths = [0; ARRAYS];
        for length in &mut lengths {
            *length = u64::from_le_bytes(self.take()?);
        }
        let scene_length = u64::from_le_bytes(self.take()?);
        let mut arrays = [const { Vec::new() }; ARRAYS];
        for (array, length) in arrays.iter_mut().zip(lengths) {
            *array = self.array(length)?;
        }
        if self.0.len() as u64 == scene_length {
            Ok(arrays)
        } else {
            Err(refused("is not as long as it says"))
        }
    }

    fn array(&mut self, length: u64) -> Result<Vec<f64>, Fault> {
        // Compared before anything is allocated: a hostile length must not exhaust the memory.
        if length > self.0.len() as u64 / 8 {
            return Err(refused("is cut off"));
        }
        (0..length).map(|_| self.number()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GUID: &str = "{00112233-4455-6677-8899-aabbccddeeff}";

    fn example() -> SavedState {
        SavedState {
            guid: GUID.into(),
            scene: "{}".into(),
            lifecycle: lifecycle::InstanceState::StepComplete,
            start_time: -1.0,
            stop_time: Some(3.5),
            snapshot: Snapshot {
                values: vec![1.0, -0.0, 1e-300],
                initialized: true,
                started: true,
                moving: true,
                slopes: vec![[0.1, -0.2]],
                held: vec![0.7],
                spectra: Spectra {
                    frequencies: vec![2.0],
                    eigenvalues: vec![[0.1, 3.0]],
                },
                state: State {
                    time: 0.25,
                    step: 1e-3,
                    pace: MethodStatistics::from_numbers([
                        1.0, 0.0, 120.0, 0.1, 60.0, 1e-4, 2e-3, 1e3,
                    ]),
                    coordinates: vec![0.1, 0.2],
                    rates: vec![0.3, 0.4],
                    frames: vec![[1.0, 0.0, 0.0, 0.0]],
                    angles: vec![7.0],
                    travel: vec![0.5],
                    released: vec![1.0],
                    driven: vec![[1.0, 2.0, 3.0, 4.0, 5.0]],
                    work: [8.0, -9.0],
                    dense: DenseStep {
                        start: 0.2,
                        length: 0.1,
                        under_way: 1.0,
                        vectors: vec![0.5; 10],
                        ..DenseStep::default()
                    },
                },
            },
        }
    }

    /// Bytes with a checksum that fits again.
    fn resealed(mut bytes: Vec<u8>) -> Vec<u8> {
        bytes.truncate(bytes.len() - HASH_BYTES);
        let hash = Sha256::digest(&bytes);
        bytes.extend(hash);
        bytes
    }

    #[test]
    fn a_state_survives_its_bytes() {
        let mut state = example();
        for stop in [Some(3.5), None] {
            state.stop_time = stop;
            let bytes = state.to_bytes();
            assert_eq!(bytes.len(), state.size());
            let again = SavedState::from_bytes(&bytes, GUID).expect("its own bytes");
            assert_eq!(again, state);
            assert_eq!(again.snapshot.values[1].to_bits(), (-0.0f64).to_bits());
        }
    }

    #[test]
    fn every_flipped_bit_and_every_cut_is_refused() {
        let bytes = example().to_bytes();
        for at in 0..8 * bytes.len() {
            let mut flipped = bytes.clone();
            flipped[at / 8] ^= 1 << (at % 8);
            assert!(SavedState::from_bytes(&flipped, GUID).is_err(), "bit {at}");
        }
        for length in 0..bytes.len() {
            assert!(
                SavedState::from_bytes(&bytes[..length], GUID).is_err(),
                "{length} bytes"
            );
        }
        let mut longer = bytes;
        longer.push(0);
        assert!(SavedState::from_bytes(&longer, GUID).is_err());
    }

    #[test]
    fn another_model_another_version_and_forged_contents_are_refused() {
        let reason = |bytes: Vec<u8>| {
            let answer = SavedState::from_bytes(&resealed(bytes), GUID);
            answer.expect_err("must be refused").to_string()
        };
        let bytes = example().to_bytes();
        let mut other = example();
        other.guid = GUID.replace('f', "0");
        assert!(reason(other.to_bytes()).contains("expected one of the model"));
        let mut version = bytes.clone();
        version[8] = 1;
        assert!(reason(version).contains("format version 8, found 1"));
        let mut mode = bytes.clone();
        mode[50] = 64;
        assert!(reason(mode).contains("lifecycle"));
        let mut flags = bytes.clone();
        flags[51] = STARTED;
        assert!(reason(flags).contains("lifecycle"));
        let mut length = bytes.clone();
        length[HEADER_BYTES - 9] = 0xff;
        assert!(reason(length).contains("cut off"));
        let mut driven = bytes.clone();
        // One number more in the list of driven motions, one less in the one before.
        driven[HEADER_BYTES - 40] = 6;
        driven[HEADER_BYTES - 48] = 0;
        assert!(reason(driven).contains("driven motion"));
        let mut state = example();
        state.snapshot.state.rates[1] = f64::NAN;
        assert!(reason(state.to_bytes()).contains("not finite"));
    }
}

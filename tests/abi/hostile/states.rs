//! Saved states: of this instance, of another model, of no one; whole and damaged bytes.

use std::ptr;

use flexbody::fmi2::abi::FmuState;

use super::bytes::Bytes;
use super::{ERROR, Master, OK, OK_OR_ERROR, Temper};
use crate::support::{Status, call};

/// Most states and most byte strings that a master keeps.
const MOST: usize = 4;

impl Master<'_> {
    /// The place of a kept state; none where there are none, or where NULL is wanted.
    fn kept(&self, bytes: &mut Bytes<'_>) -> Option<usize> {
        let byte = usize::from(bytes.byte());
        (byte < 240 && !self.saved.is_empty()).then(|| byte % self.saved.len())
    }

    pub(super) fn save(&mut self, bytes: &mut Bytes<'_>) {
        let memory = self.memory.clone();
        let reused = bytes.once_in(3).then(|| self.kept(bytes)).flatten();
        let mut state = reused.map_or(ptr::null_mut(), |at| self.saved[at].0);
        if reused.is_none() && (self.saved.len() == MOST || bytes.once_in(16)) {
            let _ = self.call("fmi2GetFMUstate", ERROR, |c| {
                call!(fmi2GetFMUstate, c, ptr::null_mut())
            });
            return;
        }
        let status = self.call("fmi2GetFMUstate", OK, |c| {
            call!(fmi2GetFMUstate, c, &mut state)
        });
        match reused {
            _ if status != Status::Ok => {}
            Some(at) => {
                assert_eq!(state, self.saved[at].0);
                self.saved[at].1 = memory;
            }
            None => self.saved.push((state, memory)),
        }
    }

    pub(super) fn restore(&mut self, bytes: &mut Bytes<'_>) {
        let kept = self.kept(bytes);
        let foreign = bytes.once_in(8);
        let state = match kept {
            _ if foreign => self.foreign_state,
            Some(at) => self.saved[at].0,
            None => ptr::null_mut(),
        };
        let expected = match kept {
            Some(at) if !foreign => match self.saved[at].1.temper(self.unit) {
                Temper::Absurd => OK_OR_ERROR,
                _ => OK,
            },
            _ => ERROR,
        };
        let status = self.call("fmi2SetFMUstate", expected, |c| {
            call!(fmi2SetFMUstate, c, state)
        });
        if let (Status::Ok, Some(at)) = (status, kept) {
            self.memory = self.saved[at].1.clone();
            // The same bytes again, whatever was in between.
            let restored = self.instance.fingerprint();
            assert_eq!(restored, self.instance.serialize(state));
        }
    }

    pub(super) fn free(&mut self, bytes: &mut Bytes<'_>) {
        let kept = self.kept(bytes);
        let mut state = kept.map_or(ptr::null_mut(), |at| self.saved[at].0);
        let nowhere = kept.is_none() && bytes.once_in(2);
        let place = if nowhere {
            ptr::null_mut()
        } else {
            &raw mut state
        };
        let status = self.call("fmi2FreeFMUstate", OK, |c| {
            call!(fmi2FreeFMUstate, c, place)
        });
        if let (Status::Ok, Some(at)) = (status, kept) {
            assert!(state.is_null());
            self.saved.remove(at);
        }
    }

    pub(super) fn free_all(&mut self) {
        for (state, _) in self.saved.drain(..) {
            self.instance.free(state);
        }
    }

    pub(super) fn size(&mut self, bytes: &mut Bytes<'_>) {
        let kept = self.kept(bytes);
        let state = kept.map_or(ptr::null_mut(), |at| self.saved[at].0);
        let mut size = 0;
        let null = bytes.once_in(4);
        let target = if null { ptr::null_mut() } else { &raw mut size };
        let expected = if null || kept.is_none() { ERROR } else { OK };
        let _ = self.call("fmi2SerializedFMUstateSize", expected, |c| {
            call!(fmi2SerializedFMUstateSize, c, state, target)
        });
    }

    pub(super) fn serialize(&mut self, bytes: &mut Bytes<'_>) {
        let kept = self.kept(bytes);
        let state = kept.map_or(ptr::null_mut(), |at| self.saved[at].0);
        let size = kept.map_or(8, |_| self.instance.serialize(state).len());
        let off = bytes.pick(&[0, 0, 0, 0, 1, -1]);
        let size = size.saturating_add_signed(off);
        let mut room = vec![7_u8; size];
        let null = bytes.once_in(8);
        let target = if null {
            ptr::null_mut()
        } else {
            room.as_mut_ptr()
        };
        let right = kept.is_some() && off == 0 && !null;
        let expected = if right { OK } else { ERROR };
        let status = self.call("fmi2SerializeFMUstate", expected, |c| {
            call!(fmi2SerializeFMUstate, c, state, target.cast(), size)
        });
        match (status, kept) {
            (Status::Ok, Some(at)) => {
                self.serialized.truncate(MOST - 1);
                self.serialized.insert(0, (room, self.saved[at].1.clone()));
            }
            _ => assert!(room.iter().all(|byte| *byte == 7), "written though refused"),
        }
    }

    pub(super) fn deserialize(&mut self, bytes: &mut Bytes<'_>) {
        let own = bytes.byte();
        let found = match self.serialized.len() {
            0 => None,
            count => Some(&self.serialized[usize::from(own) % count]),
        };
        let (mut data, memory) = match found {
            Some((data, memory)) if own < 230 => (data.clone(), Some(memory.clone())),
            _ => (self.foreign.fingerprint(), None),
        };
        let damage = bytes.byte();
        match damage {
            0..160 => {}
            160..200 => {
                let at = usize::from(bytes.byte()) * data.len() / 256;
                data[at] ^= 1 << (bytes.byte() % 8);
            }
            200..240 => data.truncate(usize::from(bytes.byte()) * data.len() / 256),
            _ => data.extend([0; 8]),
        }
        let (null, nowhere) = (bytes.once_in(16), bytes.once_in(16));
        let whole = memory.is_some() && damage < 160 && !null && !nowhere;
        let full = self.saved.len() == MOST;
        if full && whole {
            return;
        }
        let source = if null { ptr::null() } else { data.as_ptr() };
        let mut state: FmuState = ptr::null_mut();
        let place = if nowhere {
            ptr::null_mut()
        } else {
            &raw mut state
        };
        // Numbers that are absurd may be no numbers by now, and those are refused.
        let absurd = memory.as_ref().map(|m| m.temper(self.unit)) == Some(Temper::Absurd);
        let expected = match (whole, absurd) {
            (true, false) => OK,
            (true, true) => OK_OR_ERROR,
            (false, _) => ERROR,
        };
        let status = self.call("fmi2DeSerializeFMUstate", expected, |c| {
            call!(fmi2DeSerializeFMUstate, c, source.cast(), data.len(), place)
        });
        match (status, memory) {
            (Status::Ok, Some(memory)) => self.saved.push((state, memory)),
            _ => assert!(state.is_null()),
        }
    }
}

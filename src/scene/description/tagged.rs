//! Parts of a scene whose `kind` says which other keys they have: one type for each kind.

use serde::de::{DeserializeOwned, Deserializer, Error, Visitor};
use serde::{Deserialize as _, forward_to_deserialize_any};
use serde_json::{Map, Value};

use super::reader::Wrong;
use super::strict::{Strict, at, typed};

/// Keys of a joint that a load between its markers takes too.
const OF_LOADS: [&str; 2] = ["stiffness", "damping"];

/// Kinds of a part of a scene.
pub trait Kinds: Sized {
    /// Name of the part in the schema.
    const PART: &'static str;

    /// Whether the name of a kind alone tells the part: a revolute is a joint, but a force is a load or an input.
    const SPEAKS: bool = false;

    /// Lists all kinds.
    fn all() -> Vec<OneKind<Self>>;

    /// Value of the key `kind`.
    fn name(&self) -> &'static str;
}

/// A kind of a part of a scene.
pub struct OneKind<K> {
    /// Value of the key `kind`.
    pub name: &'static str,
    /// Keys of this kind, without those of the part itself.
    pub keys: &'static [&'static str],
    /// Reads an object with these keys.
    pub read: fn(Value) -> Result<K, Wrong>,
}

/// Declares an enum with one type for each kind of a part, told apart by the key `kind`.
macro_rules! kinds {
    ($(#[$about:meta])* $kinds:ident named $names:ident of $part:literal { $($(#[$told:meta])* $kind:ident($own:ty),)* }) => {
        kinds! {
            $(#[$about])*
            $kinds of $part { $($(#[$told])* $kind($own),)* }
        }

        /// Kinds by name.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $names {
            $($(#[$told])* $kind,)*
        }

        impl $kinds {
            /// Name of its kind.
            pub fn kind(&self) -> $names {
                match self {
                    $(Self::$kind(_) => $names::$kind,)*
                }
            }
        }
    };
    ($(#[$about:meta])* $kinds:ident of $part:literal $(, speaks: $speaks:literal)? { $($(#[$told:meta])* $kind:ident($own:ty),)* }) => {
        $(#[$about])*
        #[derive(Clone, Debug, PartialEq, serde::Serialize, schemars::JsonSchema)]
        #[serde(tag = "kind", rename_all = "snake_case")]
        pub enum $kinds {
            $($(#[$told])* $kind($own),)*
        }

        const _: () = {
            use $crate::scene::description::strict::typed;
            use $crate::scene::description::tagged::{Kinds, OneKind, known};

            #[derive(serde::Deserialize)]
            #[serde(rename_all = "snake_case")]
            enum Name {
                $($kind,)*
            }

            impl Kinds for $kinds {
                const PART: &'static str = $part;
                $(const SPEAKS: bool = $speaks;)?

                fn all() -> Vec<OneKind<Self>> {
                    let names = known::<Name>();
                    vec![$(OneKind {
                        name: names[Name::$kind as usize],
                        keys: known::<$own>(),
                        read: |keys| typed(keys).map(Self::$kind),
                    },)*]
                }

                fn name(&self) -> &'static str {
                    let kind = match self {
                        $(Self::$kind(_) => Name::$kind,)*
                    };
                    known::<Name>()[kind as usize]
                }
            }
        };
    };
}
pub(in crate::scene) use kinds;

/// Reads a part with the keys that all kinds share and the keys of its kind.
macro_rules! part {
    ($part:ident) => {
        impl<'de> serde::Deserialize<'de> for $part {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                #[derive(serde::Deserialize)]
                struct Shared {}
                let part = $crate::scene::description::tagged::read(deserializer)?;
                let (Shared {}, kind) = part;
                Ok(kind)
            }
        }
    };
    ($part:ident { $($key:ident: $type:ty),* }) => {
        impl<'de> serde::Deserialize<'de> for $part {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                #[derive(serde::Deserialize)]
                struct Shared {
                    $($key: $type,)*
                }
                let (shared, kind) = $crate::scene::description::tagged::read(deserializer)?;
                let Shared { $($key,)* } = shared;
                Ok(Self { $($key,)* kind })
            }
        }
    };
}
pub(in crate::scene) use part;

/// Reads the shared keys of a part and the keys of its kind.
///
/// # Errors
/// No object, an unknown kind, or a key that is missing, unknown or not valid.
pub fn read<'de, D, S, K>(deserializer: D) -> Result<(S, K), D::Error>
where
    D: Deserializer<'de>,
    S: DeserializeOwned,
    K: Kinds,
{
    let value = Strict::deserialize(deserializer)?.0;
    parted(value).map_err(|wrong| D::Error::custom(at(&wrong.path, &wrong.message)))
}

fn parted<S: DeserializeOwned, K: Kinds>(value: Value) -> Result<(S, K), Wrong> {
    let Value::Object(mut keys) = value else {
        return Err(Wrong::no_object(&value));
    };
    let name = keys.remove("kind").ok_or_else(|| Wrong::missing("kind"))?;
    let all = K::all();
    let names: Vec<&str> = all.iter().map(|kind| kind.name).collect();
    let kind = all.iter().find(|kind| name == kind.name);
    let kind = kind.ok_or_else(|| Wrong::no_variant(&name, &names).under("kind"))?;
    let shared = known::<S>();
    let is_of_a_kind = |key: &str| all.iter().any(|kind| kind.keys.contains(&key));
    // Null in place of a key of any kind says nothing; neither does false in place of one of another kind.
    keys.retain(|key, value| {
        if kind.keys.contains(&&**key) {
            !value.is_null()
        } else {
            !(is_of_a_kind(key) && (value.is_null() || *value == Value::Bool(false)))
        }
    });
    let is_known = |key: &&String| shared.contains(&&***key) || kind.keys.contains(&&***key);
    let mut strange = keys.keys().filter(|key| !is_known(key));
    if let Some(key) = strange.clone().find(|key| is_of_a_kind(key)) {
        return Err(of_another_kind(kind, key, &all).under(key));
    }
    if let Some(key) = strange.next() {
        let known = [shared, &["kind"], kind.keys].concat();
        return Err(Wrong::no_key(key, &known).under(key));
    }
    let is_shared = |(key, _): &(String, Value)| shared.contains(&&**key);
    let (of_all, own): (Map<_, _>, Map<_, _>) = keys.into_iter().partition(is_shared);
    Ok((typed(of_all.into())?, (kind.read)(own.into())?))
}

/// Mistake of a key that other kinds take and this one does not.
fn of_another_kind<K: Kinds>(kind: &OneKind<K>, key: &str, all: &[OneKind<K>]) -> Wrong {
    let is_of_all = |key: &&str| all.iter().all(|kind| kind.keys.contains(key));
    let own: Vec<&str> = (kind.keys.iter().copied())
        .filter(|key| !is_of_all(key))
        .collect();
    let has = if own.is_empty() {
        "none beside those of all".into()
    } else {
        own.join(", ")
    };
    let takers = all.iter().filter(|kind| kind.keys.contains(&key));
    let takers: Vec<&str> = takers.map(|kind| kind.name).collect();
    let load = if K::PART == "Joint" && OF_LOADS.contains(&key) {
        " and of a load of kind joint_spring"
    } else {
        ""
    };
    let takers = takers.join(", ");
    Wrong::here(
        format!("a key of the kind {} ({has})", kind.name),
        format!("`{key}`, which is one of {takers}{load}"),
    )
}

/// Names of the fields of a struct, or of the variants of an enum, as its derived `Deserialize` knows them.
pub fn known<T: DeserializeOwned>() -> &'static [&'static str] {
    let mut names: &'static [&'static str] = &[];
    // Nothing is read, so that this always fails.
    let _ = T::deserialize(Asked(&mut names));
    names
}

/// A deserializer that takes down which names a type asks for.
struct Asked<'a>(&'a mut &'static [&'static str]);

impl<'de> Deserializer<'de> for Asked<'_> {
    type Error = Wrong;

    fn deserialize_any<V: Visitor<'de>>(self, _visitor: V) -> Result<V::Value, Wrong> {
        Err(Wrong::missing(""))
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        keys: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Wrong> {
        *self.0 = keys;
        self.deserialize_any(visitor)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Wrong> {
        *self.0 = variants;
        self.deserialize_any(visitor)
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit
        unit_struct newtype_struct seq tuple tuple_struct map identifier ignored_any
    }
}

//! Reading `Name(parameter: value)` as the registered type of that name.

use std::cell::RefCell;
use std::fmt;
use std::marker::PhantomData;
use std::sync::Arc;

use serde::de::{DeserializeSeed, Deserializer, EnumAccess, Error, VariantAccess, Visitor};
use serde::{Deserialize, forward_to_deserialize_any};

use super::Registry;
use super::kinds::Registered;
use crate::code::Code;
use crate::text::{Diagnostic, nearest, one_of};

thread_local! {
    /// The registry that scenario files are read against on this thread. It is handed over here
    /// because `Deserialize` has no argument for it and derived readers should stay derived.
    static READING: RefCell<Option<Arc<Registry>>> = const { RefCell::new(None) };
}

/// Runs `read` while names are looked up in `registry`.
pub(crate) fn reading<R>(registry: &Arc<Registry>, read: impl FnOnce() -> R) -> R {
    let before = READING.replace(Some(Arc::clone(registry)));
    let result = read();
    READING.set(before);
    result
}

/// A registered type that a scenario chose by name, with its parameters.
pub struct Chosen<T: ?Sized> {
    /// Name in the scenario.
    pub name: &'static str,
    /// The parameters and what they do.
    pub value: Box<T>,
}

impl<'de, T: ?Sized + Registered> Deserialize<'de> for Chosen<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_enum(T::WHAT, &[], ChoiceVisitor(PhantomData))
    }
}

struct ChoiceVisitor<T: ?Sized>(PhantomData<T>);

impl<'de, T: ?Sized + Registered> Visitor<'de> for ChoiceVisitor<T> {
    type Value = Chosen<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a {} written as Name(parameter: value)", T::WHAT)
    }

    fn visit_enum<A: EnumAccess<'de>>(self, access: A) -> Result<Chosen<T>, A::Error> {
        let registry = READING
            .with_borrow(Clone::clone)
            .ok_or_else(|| A::Error::custom("no registry is in use; read scenarios by Scenario"))?;
        let (name, variant) = access.variant_seed(EntryName::<T>(&registry, PhantomData))?;
        let kind = T::kind(&registry);
        let entry =
            kind.get(&name).ok_or_else(|| A::Error::custom(unknown::<T>(&registry, &name)))?;
        let fields = Fields(variant);
        let value = (entry.read)(&mut <dyn erased_serde::Deserializer>::erase(fields))
            .map_err(A::Error::custom)?;
        Ok(Chosen { name: entry.name, value })
    }
}

/// The name of an entry; unknown ones are refused while the reader still stands on them.
struct EntryName<'r, T: ?Sized>(&'r Registry, PhantomData<T>);

impl<'de, T: ?Sized + Registered> DeserializeSeed<'de> for EntryName<'_, T> {
    type Value = String;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<String, D::Error> {
        deserializer.deserialize_identifier(self)
    }
}

impl<'de, T: ?Sized + Registered> Visitor<'de> for EntryName<'_, T> {
    type Value = String;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the name of a {}", T::WHAT)
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<String, E> {
        match T::kind(self.0).get(name) {
            Some(_) => Ok(name.to_owned()),
            None => Err(E::custom(unknown::<T>(self.0, name))),
        }
    }
}

/// The refusal of an unknown name; its parts are put on lines of their own when it is shown.
fn unknown<T: ?Sized + Registered>(registry: &Registry, name: &str) -> Diagnostic {
    let names = T::kind(registry).names();
    Diagnostic::new(Code::UnknownName, format!("unknown {} `{name}`", T::WHAT))
        .expected(one_of(names.iter().copied()))
        .did_you_mean(nearest(name, names.iter().copied()))
}

/// Hands the fields of an enum variant to the reader of a struct.
struct Fields<A>(A);

impl<'de, A: VariantAccess<'de>> Deserializer<'de> for Fields<A> {
    type Error = A::Error;

    fn deserialize_any<W: Visitor<'de>>(self, visitor: W) -> Result<W::Value, A::Error> {
        self.0.struct_variant(&[], visitor)
    }

    fn deserialize_struct<W: Visitor<'de>>(
        self,
        _name: &'static str,
        fields: &'static [&'static str],
        visitor: W,
    ) -> Result<W::Value, A::Error> {
        self.0.struct_variant(fields, visitor)
    }

    fn deserialize_unit_struct<W: Visitor<'de>>(
        self,
        _name: &'static str,
        visitor: W,
    ) -> Result<W::Value, A::Error> {
        self.0.unit_variant()?;
        visitor.visit_unit()
    }

    fn deserialize_newtype_struct<W: Visitor<'de>>(
        self,
        _name: &'static str,
        visitor: W,
    ) -> Result<W::Value, A::Error> {
        self.0.newtype_variant_seed(Inner(visitor))
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf
        option unit seq tuple tuple_struct map enum identifier ignored_any
    }
}

/// Lets a newtype struct read the single value in the parentheses.
struct Inner<W>(W);

impl<'de, W: Visitor<'de>> DeserializeSeed<'de> for Inner<W> {
    type Value = W::Value;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<W::Value, D::Error> {
        self.0.visit_newtype_struct(deserializer)
    }
}

impl<T: ?Sized> fmt::Debug for Chosen<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Chosen").field(&self.name).finish()
    }
}

//! What there is to tell of a simulation beside its values: of its start, of its constraints and of its steps.

use super::{
    AnyEngine, Doubtful, NoPropeller, OverDeformed, RedundantNames, Simulation, Singular, TooFast,
    Unresolved,
};

impl Simulation {
    /// Gaps, in words, of joints that bodies as described do not fit by far: bodies were moved, or cables deformed, to
    /// close them.
    pub fn initial_gaps(&self) -> Option<&str> {
        let engine = self.engine.as_ref()?;
        engine.remarks().initial_gaps.as_deref()
    }

    /// Whether the simulation starts from an equilibrium that is not stable and that could not be left.
    ///
    /// # Examples
    ///
    /// ```
    /// # use flexbody::{scene::Scene, simulation::Simulation};
    /// # let scene = Scene::from_json(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/simulation/stone.json")))?;
    /// # let mut simulation = Simulation::new(scene);
    /// simulation.start()?;
    /// assert!(!simulation.is_unstable());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn is_unstable(&self) -> bool {
        self.engine
            .as_ref()
            .is_some_and(|engine| engine.remarks().is_unstable)
    }

    /// The next output in which the steps so far may have left an error beyond the one wanted, and that was not
    /// told of before. Stiffness and fast vibrations magnify errors that the tolerance allows in the state.
    pub fn next_doubtful(&mut self) -> Option<Doubtful> {
        self.engine.as_mut().and_then(AnyEngine::next_doubtful)
    }

    /// All such outputs, with the errors that steps may have left until now.
    pub fn doubtful(&self) -> Vec<Doubtful> {
        let engine = self.engine.as_ref();
        engine.map(AnyEngine::doubtful).unwrap_or_default()
    }

    /// A mesh that has become too coarse for the error wanted, told once.
    pub fn next_unresolved(&mut self) -> Option<Unresolved<'_>> {
        self.engine.as_mut().and_then(AnyEngine::next_unresolved)
    }

    /// A singular position that steps came to or passed by closely, where joints count as holding what others hold already
    /// which do not do so everywhere; every joint is told once.
    pub fn next_singular(&mut self) -> Option<Singular> {
        self.engine.as_mut().and_then(AnyEngine::next_singular)
    }

    /// The next function of time that goes through far more periods in a communication step than sub-steps can follow; each is told once.
    pub fn next_too_fast(&mut self) -> Option<TooFast<'_>> {
        self.fast.next()
    }

    /// The next rod that rotates so quickly that the propeller moment counts, which rods do not have; each is told once.
    pub fn next_without_propeller(&mut self) -> Option<NoPropeller<'_>> {
        let engine = self.engine.as_mut();
        engine.and_then(AnyEngine::next_without_propeller)
    }

    /// The next reduced body whose deformation has left the range of its model; each is told once.
    pub fn next_over_deformed(&mut self) -> Option<OverDeformed<'_>> {
        let engine = self.engine.as_mut();
        engine.and_then(AnyEngine::next_over_deformed)
    }

    /// The next thing, in words, that lies beyond what a model or sub-steps hold: a function of time that is too fast, a rod that rotates too
    /// quickly, a reduced body that has deformed too far. Each is told once.
    pub fn next_beyond(&mut self) -> Option<String> {
        if let Some(found) = self.next_too_fast() {
            return Some(found.to_string());
        }
        if let Some(found) = self.next_without_propeller() {
            return Some(found.to_string());
        }
        self.next_over_deformed().map(|found| found.to_string())
    }

    /// Tells all that the steps so far give reason to warn of and that was not told of before, in words: outputs that the tolerance does not
    /// reach, functions of time that are too fast, prescribed motions whose rates were never set, singular positions, a mesh that is too coarse.
    pub fn tell_warnings(&mut self, mut tell: impl FnMut(std::fmt::Arguments<'_>)) {
        while let Some(doubtful) = self.next_doubtful() {
            tell(format_args!("{doubtful}"));
        }
        while let Some(found) = self.next_beyond() {
            tell(format_args!("{found}"));
        }
        while let Some(message) = self.unset_rates.next() {
            tell(format_args!("{message}"));
        }
        if let Some(singular) = self.next_singular() {
            tell(format_args!("{singular}"));
        }
        if let Some(unresolved) = self.next_unresolved() {
            tell(format_args!("{unresolved}"));
        }
    }

    /// Names of the joints and motions that hold, at least in part, what others hold already, and of
    /// rigid bodies that joints alone keep in shape, in the present position; none before [`Self::initialize`].
    ///
    /// # Examples
    ///
    /// ```
    /// # use flexbody::{scene::Scene, simulation::Simulation};
    /// # let scene = Scene::from_json(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/src/simulation/stone.json")))?;
    /// # let mut simulation = Simulation::new(scene);
    /// simulation.start()?;
    /// assert!(simulation.redundant().exactly.is_empty());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn redundant(&mut self) -> RedundantNames {
        let (engine, state) = (self.engine.as_mut(), &self.state);
        engine
            .map(|engine| engine.redundant(state))
            .unwrap_or_default()
    }
}

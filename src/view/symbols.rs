//! Symbols and colours of a page.

use crate::picture::symbols::arrow;
use crate::picture::{Stroke, palette, symbols_to_json};

/// Symbols of a page, each once. The first is an arrow.
pub(super) struct SymbolTable {
    symbols: Vec<Vec<Stroke>>,
}

impl Default for SymbolTable {
    fn default() -> Self {
        Self {
            symbols: vec![arrow(palette::FAINT)],
        }
    }
}

impl SymbolTable {
    /// Returns the number of a symbol, which is added where it is new.
    pub fn number(&mut self, symbol: &[Stroke]) -> usize {
        let known = self.symbols.iter().position(|known| *known == symbol);
        known.unwrap_or_else(|| {
            self.symbols.push(symbol.into());
            self.symbols.len() - 1
        })
    }

    /// Entries of a header: symbols and colours.
    pub fn finish(self) -> String {
        let symbols = symbols_to_json(&self.symbols);
        format!("\"symbols\":{symbols},\"palette\":{}", palette::json())
    }
}

//! Reads expressions in `t` into programs: Dijkstra's shunting yard.

use super::expression::{DEPTH, Elementary, Operation, run};
use super::switches::Switch;

/// Functions by name, and what computes them.
pub(super) const FUNCTIONS: [(&str, Operation); 21] = [
    ("sin", Operation::Function(Elementary::Sin)),
    ("cos", Operation::Function(Elementary::Cos)),
    ("tan", Operation::Function(Elementary::Tan)),
    ("asin", Operation::Function(Elementary::Asin)),
    ("acos", Operation::Function(Elementary::Acos)),
    ("atan", Operation::Function(Elementary::Atan)),
    ("sinh", Operation::Function(Elementary::Sinh)),
    ("cosh", Operation::Function(Elementary::Cosh)),
    ("tanh", Operation::Function(Elementary::Tanh)),
    ("exp", Operation::Function(Elementary::Exp)),
    ("ln", Operation::Function(Elementary::Ln)),
    ("log2", Operation::Function(Elementary::Log2)),
    ("log10", Operation::Function(Elementary::Log10)),
    ("sqrt", Operation::Function(Elementary::Sqrt)),
    ("atan2", Operation::Switch(Switch::Atan2)),
    ("abs", Operation::Switch(Switch::Abs)),
    ("sign", Operation::Switch(Switch::Sign)),
    ("step", Operation::Switch(Switch::Step)),
    ("min", Operation::Switch(Switch::Min)),
    ("max", Operation::Switch(Switch::Max)),
    ("if", Operation::Switch(Switch::If)),
];
/// Numbers by name.
const CONSTANTS: [(&str, f64); 2] = [("PI", std::f64::consts::PI), ("E", std::f64::consts::E)];
/// Longest text, bytes.
const LENGTH: usize = 10_000;

/// The program of an expression in a variable, where names may stand for other variables and for numbers.
///
/// # Errors
/// What was expected in the text, and what was found.
pub(super) fn program(
    text: &str,
    variable: &'static str,
    given: &[(&'static str, Operation)],
) -> Result<Vec<Operation>, String> {
    if text.len() > LENGTH {
        let found = text.len();
        return Err(format!(
            "expected at most {LENGTH} characters, found {found}"
        ));
    }
    let mut reader = TokenReader {
        variable,
        given,
        program: Vec::new(),
        waiting: Vec::new(),
        place: BeforeToken::Start,
    };
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let length = if let Some((number, length)) = number(rest) {
            reader.number(number, &rest[..length])?;
            length
        } else if first.is_ascii_alphabetic() || first == '_' {
            let part = |c: &char| c.is_ascii_alphanumeric() || *c == '_';
            let length = rest.chars().take_while(part).count();
            reader.name(&rest[..length])?;
            length
        } else if matches!(first, '<' | '>') {
            let length = 1 + usize::from(rest[1..].starts_with('='));
            reader.comparison(&rest[..length])?;
            length
        } else {
            reader.sign(first)?;
            first.len_utf8()
        };
        rest = rest[length..].trim_start();
    }
    reader.end()
}

/// The number that a text begins with, and its length: digits, a point, an exponent.
fn number(text: &str) -> Option<(f64, usize)> {
    let bytes = text.as_bytes();
    let digits = |from: usize| {
        let rest = bytes.get(from..).unwrap_or_default();
        rest.iter().take_while(|b| b.is_ascii_digit()).count()
    };
    let mut end = digits(0);
    if bytes.get(end) == Some(&b'.') {
        end += 1 + digits(end + 1);
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let exponent = digits(end + 1 + sign);
        if exponent > 0 {
            end += 1 + sign + exponent;
        }
    }
    // A point or an exponent alone is none.
    let number = text.get(..end)?.parse().ok()?;
    Some((number, end))
}

/// Token before the next one.
#[derive(Clone, Copy, PartialEq)]
enum BeforeToken {
    /// Nothing, an opening parenthesis or an operator.
    Start,
    /// The name of a function, by its place in the list.
    Name(usize),
    /// A number, `t` or a closing parenthesis.
    Operand,
}

/// Operation that waits for the number to its right.
#[derive(Clone, Copy)]
enum Waiting {
    /// An opening parenthesis: of a function its place in the list, and how many of its numbers have ended.
    Parenthesis {
        function: Option<usize>,
        ended: usize,
    },
    Operator {
        operation: Operation,
        rank: u8,
    },
}

const COMPARISON: u8 = 1;
const SUM: u8 = 2;
const PRODUCT: u8 = 3;
const SIGN: u8 = 4;
const POWER: u8 = 5;

struct TokenReader<'a> {
    /// Name of the variable.
    variable: &'static str,
    /// Names and what puts the numbers that they stand for on the stack.
    given: &'a [(&'static str, Operation)],
    program: Vec<Operation>,
    waiting: Vec<Waiting>,
    place: BeforeToken,
}

impl TokenReader<'_> {
    fn expected(&self, found: &str) -> String {
        let opened = self.waiting.iter().rev().find_map(|waiting| match waiting {
            Waiting::Parenthesis { function, .. } => Some(*function),
            Waiting::Operator { .. } => None,
        });
        let wanted = match (self.place, opened) {
            (BeforeToken::Start, _) => "a number, t, a function or \"(\"",
            (BeforeToken::Name(_), _) => "\"(\" after the name of a function",
            (BeforeToken::Operand, Some(Some(_))) => "an operator, \",\" or \")\"",
            (BeforeToken::Operand, Some(None)) => "an operator or \")\"",
            (BeforeToken::Operand, None) => "an operator",
        };
        format!("expected {wanted}, found {found}")
    }

    fn operand(&mut self, operation: Operation, text: &str) -> Result<(), String> {
        if self.place != BeforeToken::Start {
            return Err(self.expected(&format!("\"{text}\"")));
        }
        self.program.push(operation);
        self.place = BeforeToken::Operand;
        Ok(())
    }

    fn number(&mut self, number: f64, text: &str) -> Result<(), String> {
        if !number.is_finite() {
            return Err(format!("expected a finite number, found \"{text}\""));
        }
        self.operand(Operation::Number(number), text)
    }

    fn name(&mut self, name: &str) -> Result<(), String> {
        if name == self.variable {
            return self.operand(Operation::Time, name);
        }
        if let Some((_, number)) = CONSTANTS.iter().find(|(known, _)| *known == name) {
            return self.operand(Operation::Number(*number), name);
        }
        if let Some((_, operation)) = self.given.iter().find(|(known, _)| *known == name) {
            return self.operand(*operation, name);
        }
        let Some(function) = FUNCTIONS.iter().position(|(known, _)| *known == name) else {
            let constants = CONSTANTS.map(|(known, _)| known);
            let functions = FUNCTIONS.map(|(known, _)| known);
            let mut known = vec![self.variable];
            known.extend(self.given.iter().map(|(name, _)| *name));
            known.extend(constants.into_iter().chain(functions));
            let known = known.join(", ");
            return Err(format!(
                "expected one of the names {known}, found \"{name}\""
            ));
        };
        if self.place != BeforeToken::Start {
            return Err(self.expected(&format!("\"{name}\"")));
        }
        self.place = BeforeToken::Name(function);
        Ok(())
    }

    fn sign(&mut self, sign: char) -> Result<(), String> {
        match (sign, self.place) {
            ('(', BeforeToken::Start | BeforeToken::Name(_)) => {
                let function = match self.place {
                    BeforeToken::Name(function) => Some(function),
                    _ => None,
                };
                let ended = 0;
                self.waiting.push(Waiting::Parenthesis { function, ended });
                self.place = BeforeToken::Start;
                Ok(())
            }
            (',', BeforeToken::Operand) => self.next_number(),
            (')', BeforeToken::Operand) => self.close(),
            ('+', BeforeToken::Start) => Ok(()),
            ('-', BeforeToken::Start) => {
                self.wait(Operation::Negate, SIGN);
                Ok(())
            }
            ('+', BeforeToken::Operand) => self.operator(Operation::Add, SUM),
            ('-', BeforeToken::Operand) => self.operator(Operation::Subtract, SUM),
            ('*', BeforeToken::Operand) => self.operator(Operation::Multiply, PRODUCT),
            ('/', BeforeToken::Operand) => self.operator(Operation::Divide, PRODUCT),
            ('^', BeforeToken::Operand) => self.operator(Operation::Power, POWER),
            _ => Err(self.expected(&format!("\"{sign}\""))),
        }
    }

    fn wait(&mut self, operation: Operation, rank: u8) {
        self.waiting.push(Waiting::Operator { operation, rank });
    }

    /// Writes what waits and binds at least as tight.
    fn operator(&mut self, operation: Operation, rank: u8) -> Result<(), String> {
        // Powers of powers are taken from the right.
        self.release(if rank == POWER { POWER + 1 } else { rank });
        self.wait(operation, rank);
        self.place = BeforeToken::Start;
        Ok(())
    }

    /// A comparison, whose sign is one character or two.
    fn comparison(&mut self, text: &str) -> Result<(), String> {
        if self.place != BeforeToken::Operand {
            return Err(self.expected(&format!("\"{text}\"")));
        }
        let switch = match text {
            "<" => Switch::Less,
            "<=" => Switch::AtMost,
            ">" => Switch::Greater,
            _ => Switch::AtLeast,
        };
        self.release(SUM);
        if let Some(Waiting::Operator { .. }) = self.waiting.last() {
            return Err("expected one comparison, found two in a row".into());
        }
        self.operator(Operation::Switch(switch), COMPARISON)
    }

    fn release(&mut self, least: u8) {
        while let Some(Waiting::Operator { operation, rank }) = self.waiting.last().copied() {
            if rank < least {
                break;
            }
            self.waiting.pop();
            self.write(operation);
        }
    }

    /// A comma: the next number of a function begins.
    fn next_number(&mut self) -> Result<(), String> {
        self.release(0);
        let wrong = self.expected("\",\"");
        let Some(Waiting::Parenthesis {
            function: Some(_),
            ended,
        }) = self.waiting.last_mut()
        else {
            return Err(wrong);
        };
        *ended += 1;
        self.place = BeforeToken::Start;
        Ok(())
    }

    fn close(&mut self) -> Result<(), String> {
        self.release(0);
        let wrong = self.expected("\")\"");
        let Some(Waiting::Parenthesis { function, ended }) = self.waiting.pop() else {
            return Err(wrong);
        };
        let Some((name, operation)) = function.map(|place| FUNCTIONS[place]) else {
            return Ok(());
        };
        let (found, wanted) = (ended + 1, 1_usize.wrapping_add_signed(-operation.rise()));
        let folds = matches!(operation, Operation::Switch(Switch::Min | Switch::Max));
        if found < wanted || (found > wanted && !folds) {
            let more = if folds { " or more" } else { "" };
            return Err(format!(
                "expected {wanted}{more} number(s) in \"{name}\", found {found}"
            ));
        }
        // The smallest of three is the smaller of the last and the smaller of two.
        let times = if folds { found - 1 } else { 1 };
        (0..times).for_each(|_| self.write(operation));
        Ok(())
    }

    /// Writes an operation; of numbers alone, its result.
    fn write(&mut self, operation: Operation) {
        if let (Operation::Power, Some(Operation::Number(exponent))) =
            (operation, self.program.last().copied())
        {
            self.program.pop();
            return self.write(Operation::PowerOf(exponent));
        }
        self.program.push(operation);
        let operands = 1_usize.wrapping_add_signed(-operation.rise());
        let from = self.program.len().saturating_sub(operands + 1);
        let (_, step) = self.program.split_at(from);
        let is_number = |operand: &Operation| matches!(operand, Operation::Number(_));
        if step[..operands].iter().all(is_number) {
            let result = Operation::Number(run(step, 0.0));
            self.program.truncate(from);
            self.program.push(result);
        }
    }

    fn end(mut self) -> Result<Vec<Operation>, String> {
        if self.place != BeforeToken::Operand {
            return Err(self.expected("the end"));
        }
        self.release(0);
        if !self.waiting.is_empty() {
            return Err("expected \")\", found the end".into());
        }
        let mut height = 0;
        let heights = self.program.iter().map(|operation| {
            height += operation.rise();
            height
        });
        if heights.max().unwrap_or(0) > DEPTH as isize {
            return Err("expected fewer parentheses inside each other, found too many".into());
        }
        Ok(self.program)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_end_where_they_should() {
        for (text, wanted) in [
            ("12.5e-3*t", Some((12.5e-3, 7))),
            ("2E3", Some((2e3, 3))),
            ("2e", Some((2.0, 1))),
            (".5t", Some((0.5, 2))),
            ("1.", Some((1.0, 2))),
            (".", None),
            ("e3", None),
            (".e3", None),
            ("", None),
        ] {
            assert_eq!(number(text), wanted, "{text}");
        }
    }

    #[test]
    fn what_is_wrong_is_told() {
        for (text, wanted) in [
            ("", "a number, t, a function or \"(\", found the end"),
            ("t +", "a function or \"(\", found the end"),
            ("2 t", "expected an operator, found \"t\""),
            (
                "sin(2 t)",
                "expected an operator, \",\" or \")\", found \"t\"",
            ),
            ("min(t)", "expected 2 or more number(s) in \"min\", found 1"),
            ("abs(t, 2)", "expected 1 number(s) in \"abs\", found 2"),
            ("if(t, 2)", "expected 3 number(s) in \"if\", found 2"),
            (
                "atan2(t, 1, 2)",
                "expected 2 number(s) in \"atan2\", found 3",
            ),
            ("(t, 2)", "expected an operator or \")\", found \",\""),
            ("t, 2", "expected an operator, found \",\""),
            ("max(t,)", "a function or \"(\", found \")\""),
            ("0 < t < 1", "expected one comparison, found two in a row"),
            ("t == 1", "expected an operator, found \"=\""),
            ("< 1", "a function or \"(\", found \"<\""),
            ("(2 t)", "expected an operator or \")\", found \"t\""),
            (
                "sin t",
                "expected \"(\" after the name of a function, found \"t\"",
            ),
            (
                "sin",
                "expected \"(\" after the name of a function, found the end",
            ),
            ("t sin(t)", "expected an operator, found \"sin\""),
            ("(t", "expected \")\", found the end"),
            ("t)", "expected an operator, found \")\""),
            ("(t))", "expected an operator, found \")\""),
            ("()", "found \")\""),
            ("x + 1", "expected one of the names t, PI, E, sin, "),
            ("t ** 2", "a function or \"(\", found \"*\""),
            ("t % 2", "expected an operator, found \"%\""),
            ("1e999*t", "expected a finite number, found \"1e999\""),
            ("\u{3c0}*t", "found \"\u{3c0}\""),
        ] {
            let told = program(text, "t", &[]).expect_err(text);
            assert!(told.contains(wanted), "{text}: {told}");
        }
        assert!(program(&"1".repeat(20_000), "t", &[]).is_err());
        assert!(program(&"(".repeat(9_000), "t", &[]).is_err());
        assert!(program(&format!("{}t", "-".repeat(9_000)), "t", &[]).is_ok());
    }
}

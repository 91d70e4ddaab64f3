//! Angles as people type them: `45`, `90 - 12.5`, `(30+15)/2°`.

/// The value of an arithmetic expression: numbers with a point or a comma, `+ - * / ( )`; a degree sign at the end of a number says
/// nothing new. None where it is no expression, or no finite number.
pub(crate) fn value(text: &str) -> Option<f64> {
    let mut parser = Parser { rest: text.trim(), depth: 0 };
    let value = parser.sum()?;
    (parser.rest.is_empty() && value.is_finite()).then_some(value)
}

/// How deep parentheses and signs may be nested.
const DEEPEST: u32 = 64;

struct Parser<'a> {
    rest: &'a str,
    depth: u32,
}

impl Parser<'_> {
    fn sum(&mut self) -> Option<f64> {
        let mut value = self.product()?;
        loop {
            value = match self.take(&['+', '-', '\u{2212}']) {
                Some('+') => value + self.product()?,
                Some(_) => value - self.product()?,
                None => return Some(value),
            };
        }
    }

    fn product(&mut self) -> Option<f64> {
        let mut value = self.factor()?;
        loop {
            value = match self.take(&['*', '/', '\u{d7}', '\u{f7}']) {
                Some('*' | '\u{d7}') => value * self.factor()?,
                Some(_) => value / self.factor()?,
                None => return Some(value),
            };
        }
    }

    fn factor(&mut self) -> Option<f64> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return None;
        }
        let value = match self.take(&['+', '-', '\u{2212}', '(']) {
            Some('(') => {
                let value = self.sum()?;
                self.take(&[')'])?;
                Some(value)
            }
            Some('+') => self.factor(),
            Some(_) => self.factor().map(|value| -value),
            None => self.number(),
        };
        self.depth -= 1;
        value
    }

    fn number(&mut self) -> Option<f64> {
        let is_part = |letter: char| letter.is_ascii_digit() || letter == '.' || letter == ',';
        let end = self.rest.find(|letter| !is_part(letter)).unwrap_or(self.rest.len());
        let (number, rest) = self.rest.split_at(end);
        self.rest = rest.trim_start();
        self.take(&['\u{b0}']);
        number.replace(',', ".").parse().ok()
    }

    /// The next letter, where it is one of these.
    fn take(&mut self, letters: &[char]) -> Option<char> {
        let letter = self.rest.chars().next().filter(|letter| letters.contains(letter))?;
        self.rest = self.rest[letter.len_utf8()..].trim_start();
        Some(letter)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expressions_have_the_value_that_is_taught_at_school() {
        for (text, expected) in [
            ("45", 45.0),
            (" 12,5\u{b0} ", 12.5),
            ("90 - 12.5", 77.5),
            ("2+3*4", 14.0),
            ("(2+3)*4", 20.0),
            ("-(30+15)/2", -22.5),
            ("90--10", 100.0),
            ("360/8\u{b0}/2", 22.5),
        ] {
            assert_eq!(value(text), Some(expected), "{text}");
        }
    }

    #[test]
    fn what_is_no_number_is_refused() {
        for text in ["", "a", "1+", "(1", "1)", "1/0", "1.2.3", "2 3", "--", "1e999999"] {
            assert_eq!(value(text), None, "{text}");
        }
        assert_eq!(value(&"(".repeat(100_000)), None);
        assert_eq!(value(&"-".repeat(100_000)), None);
    }
}

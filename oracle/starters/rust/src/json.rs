//! JSON, as far as a line of the protocol needs it: a value is its text, and the values in it.
//!
//! Any key order, blanks, escapes and unknown fields are read. Written out here so that the client
//! builds with no crate and no network; serde_json with `float_roundtrip` would do as well.

/// Nesting that is read: what is deeper gets an error, not a crash.
const DEEPEST: usize = 1000;

pub struct Value<'a> {
    /// As it stands in the line.
    pub text: &'a str,
    /// Of an object or an array: what is in it, with its key.
    pub items: Vec<(String, Value<'a>)>,
}

impl<'a> Value<'a> {
    /// The member of an object with this key.
    pub fn at(&self, name: &str) -> Result<&Value<'a>, String> {
        let found = self.items.iter().find(|(key, _)| key == name);
        found
            .map(|(_, value)| value)
            .ok_or(format!("{name} is missing"))
    }

    /// The text of a string. Only ASCII matters here: any other escape becomes U+FFFD.
    pub fn string(&self) -> Option<String> {
        let mut chars = self.text.strip_prefix('"')?.strip_suffix('"')?.chars();
        let mut text = String::new();
        while let Some(c) = chars.next() {
            text.push(match c {
                '\\' => match chars.next()? {
                    'u' => {
                        let digits: String = chars.by_ref().take(4).collect();
                        let code = u32::from_str_radix(&digits, 16).ok()?;
                        char::from_u32(code).unwrap_or('\u{fffd}')
                    }
                    'b' | 'f' | 'n' | 'r' | 't' => '\u{fffd}',
                    itself => itself,
                },
                c => c,
            });
        }
        Some(text)
    }
}

/// Reads a line that is one value and nothing more.
pub fn read(line: &str) -> Result<Value<'_>, String> {
    let mut reader = Reader { rest: line };
    let value = reader.value(DEEPEST)?;
    match reader.peek() {
        None => Ok(value),
        Some(_) => Err("the line goes on after its JSON value".into()),
    }
}

struct Reader<'a> {
    rest: &'a str,
}

impl<'a> Reader<'a> {
    /// The next character that is not blank.
    fn peek(&mut self) -> Option<char> {
        self.rest = self.rest.trim_start_matches([' ', '\t', '\r', '\n']);
        self.rest.chars().next()
    }

    fn skip(&mut self, wanted: char) -> bool {
        let there = self.peek() == Some(wanted);
        if there {
            self.rest = &self.rest[wanted.len_utf8()..];
        }
        there
    }

    fn value(&mut self, depth: usize) -> Result<Value<'a>, String> {
        if depth == 0 {
            return Err("the line is nested too deep".into());
        }
        let first = self.peek();
        let begin = self.rest;
        let items = match first {
            Some('{') => self.members(true, depth - 1)?,
            Some('[') => self.members(false, depth - 1)?,
            Some('"') => {
                self.rest = &begin[closing_quote(begin)? + 1..];
                vec![]
            }
            _ => {
                // A number, or a word that means nothing here.
                let end = begin.find(|c: char| !c.is_ascii_alphanumeric() && !"+-.".contains(c));
                self.rest = &begin[end.unwrap_or(begin.len())..];
                vec![]
            }
        };
        match &begin[..begin.len() - self.rest.len()] {
            "" => Err("the line is not JSON".into()),
            text => Ok(Value { text, items }),
        }
    }

    fn members(&mut self, keyed: bool, depth: usize) -> Result<Vec<(String, Value<'a>)>, String> {
        let close = if keyed { '}' } else { ']' };
        let mut items = vec![];
        self.rest = &self.rest[1..];
        if self.skip(close) {
            return Ok(items);
        }
        loop {
            let mut key = String::new();
            if keyed {
                key = self.value(depth)?.string().ok_or("a key is not a string")?;
                if !self.skip(':') {
                    return Err("the line is not JSON".into());
                }
            }
            items.push((key, self.value(depth)?));
            if self.skip(close) {
                return Ok(items);
            }
            if !self.skip(',') {
                return Err("the line is not JSON".into());
            }
        }
    }
}

fn closing_quote(text: &str) -> Result<usize, String> {
    let mut escaped = false;
    for (i, c) in text.bytes().enumerate().skip(1) {
        match c {
            _ if escaped => escaped = false,
            b'\\' => escaped = true,
            b'"' => return Ok(i),
            _ => (),
        }
    }
    Err("a string does not end".into())
}

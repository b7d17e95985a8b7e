//! The line protocol of raycert: reads a case a line, answers each with a line, flushed, in order.
//!
//! Rust reads and writes every double exactly, so numbers are plain decimals. Infinity is null.

mod json;
mod tracer;

use json::Value;
use std::fmt::Write as _;
use std::io::{self, BufRead, Write};
use std::panic;

pub type Vector = [f64; 3];

/// origin + t direction, t >= 0
pub struct Ray {
    pub origin: Vector,
    pub direction: Vector,
}

pub enum Solid {
    /// (x - point) . normal <= 0
    HalfSpace {
        point: Vector,
        normal: Vector,
    },
    Sphere {
        center: Vector,
        radius: f64,
    },
    InfiniteCylinder {
        p: Vector,
        q: Vector,
        radius: f64,
    },
    Slab {
        p: Vector,
        q: Vector,
    },
    Cylinder {
        p: Vector,
        q: Vector,
        radius: f64,
    },
    Union(Vec<Solid>),
    Intersection(Vec<Solid>),
    /// The first, less all the others.
    Difference(Vec<Solid>),
}

/// (enter, leave): a list is sorted and disjoint, enter <= leave, the last leave may be infinite.
pub type Pair = (f64, f64);

/// Why there are no intervals.
enum No {
    /// The type of a solid that this client does not have, quoted, as it came.
    Unsupported(String),
    Error(String),
}

impl From<String> for No {
    fn from(why: String) -> No {
        No::Error(why)
    }
}

fn number(value: &Value) -> Result<f64, String> {
    match value.text.parse::<f64>() {
        Ok(x) if x.is_finite() => Ok(x),
        _ => Err("a number is missing, or not finite".into()),
    }
}

fn vector(value: &Value) -> Result<Vector, String> {
    match value.items.as_slice() {
        [(_, x), (_, y), (_, z)] => Ok([number(x)?, number(y)?, number(z)?]),
        _ => Err("a vector has not three numbers".into()),
    }
}

fn parts(form: &Value) -> Result<Vec<Solid>, No> {
    match form.at("of")?.items.as_slice() {
        [] => Err(No::Error("a tree has no parts".into())),
        items => items.iter().map(|(_, part)| solid(part)).collect(),
    }
}

fn solid(form: &Value) -> Result<Solid, No> {
    let kind = form.at("type")?;
    let vector = |name| vector(form.at(name)?);
    let radius = || number(form.at("radius")?);
    Ok(match kind.string().as_deref() {
        Some("half_space") => Solid::HalfSpace {
            point: vector("point")?,
            normal: vector("normal")?,
        },
        Some("sphere") => Solid::Sphere {
            center: vector("center")?,
            radius: radius()?,
        },
        Some("infinite_cylinder") => Solid::InfiniteCylinder {
            p: vector("p")?,
            q: vector("q")?,
            radius: radius()?,
        },
        Some("slab") => Solid::Slab {
            p: vector("p")?,
            q: vector("q")?,
        },
        Some("cylinder") => Solid::Cylinder {
            p: vector("p")?,
            q: vector("q")?,
            radius: radius()?,
        },
        Some("union") => Solid::Union(parts(form)?),
        Some("intersection") => Solid::Intersection(parts(form)?),
        Some("difference") => Solid::Difference(parts(form)?),
        Some(_) => return Err(No::Unsupported(kind.text.into())),
        None => return Err(No::Error("the type of a solid is not a string".into())),
    })
}

fn intervals(form: &Value) -> Result<Vec<Pair>, No> {
    let (solid, ray) = (solid(form.at("solid")?)?, form.at("ray")?);
    let ray = Ray {
        origin: vector(ray.at("origin")?)?,
        direction: vector(ray.at("direction")?)?,
    };
    panic::catch_unwind(|| tracer::intersect(&solid, &ray))
        .map_err(|_| No::Error("the tracer panicked: see standard error".into()))
}

/// `{:?}` is the shortest decimal that reads back as the same double.
fn spelled(t: f64) -> String {
    if t.is_finite() {
        format!("{t:?}")
    } else {
        "null".into()
    }
}

fn answer(line: &str) -> String {
    let form = match json::read(line) {
        Ok(form) => form,
        Err(why) => return format!("{{\"error\": \"{why}\"}}"),
    };
    if form.at("hello").is_ok() {
        return tracer::HELLO.into();
    }
    let mut reply = match form.at("id") {
        Ok(id) => format!("{{\"id\": {}", id.text), // given back as it came
        Err(why) => return format!("{{\"error\": \"{why}\"}}"),
    };
    match intervals(&form) {
        Ok(pairs) => {
            let pairs: Vec<String> = pairs
                .iter()
                .map(|&(a, b)| format!("[{}, {}]", spelled(a), spelled(b)))
                .collect();
            write!(reply, ", \"intervals\": [{}]}}", pairs.join(", "))
        }
        Err(No::Unsupported(kind)) => write!(reply, ", \"unsupported\": {kind}}}"),
        Err(No::Error(why)) => write!(reply, ", \"error\": \"{why}\"}}"),
    }
    .expect("a string has room");
    reply
}

fn main() -> io::Result<()> {
    let mut out = io::stdout().lock();
    for line in io::stdin().lock().split(b'\n') {
        writeln!(out, "{}", answer(&String::from_utf8_lossy(&line?)))?;
        out.flush()?;
    }
    Ok(())
}

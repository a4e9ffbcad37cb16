//! What colors of vertices show: a quantity by its [`Scale`], or classes of shape by one color each.

use crate::colormap;
use crate::compute::VertexCurvatures;
use crate::quantity::Quantity;
use crate::scale::Scale;
use crate::table;
use clap::ValueEnum;
use clap::builder::PossibleValue;
use serde_json::{Map, Value, json};
use umbilic::{CurvatureKind, ShapeClass};

/// What colors can show.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Subject {
    /// A number.
    Quantity(Quantity),
    /// The class of shape.
    Shape,
}

impl Subject {
    /// Everything that colors can show.
    pub const ALL: [Subject; Quantity::ALL.len() + 1] = {
        let mut all = [Subject::Shape; Quantity::ALL.len() + 1];
        let mut index = 0;
        while index < Quantity::ALL.len() {
            all[index] = Subject::Quantity(Quantity::ALL[index]);
            index += 1;
        }
        all
    };

    /// The kind of output that it is made of.
    pub fn kind(self) -> CurvatureKind {
        match self {
            Subject::Quantity(quantity) => quantity.kind(),
            Subject::Shape => CurvatureKind::Principal,
        }
    }
}

impl ValueEnum for Subject {
    fn value_variants<'a>() -> &'a [Self] {
        &Self::ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        match self {
            Subject::Quantity(quantity) => quantity.to_possible_value(),
            Subject::Shape => Some(PossibleValue::new("shape").help(
                "Classes by the signs of mean and Gaussian curvature: peak, ridge, saddle-ridge, flat, minimal, pit, valley, \
                 saddle-valley",
            )),
        }
    }
}

/// Which vertices get which colors.
#[derive(Debug, Clone)]
pub enum Coloring {
    /// Those of a quantity.
    Scale(Quantity, Scale),
    /// Those of classes.
    Shape {
        /// The number of each vertex's class.
        classes: Vec<u8>,
        /// Up to this, in 1/length, curvatures count as none.
        tolerance: f64,
    },
}

impl Coloring {
    /// The color of each vertex; gray where there is no result.
    pub fn colors(&self, found: &VertexCurvatures) -> Vec<[u8; 3]> {
        match self {
            Coloring::Scale(quantity, scale) => {
                scale.colors(found.quantity(*quantity).unwrap_or_default(), &found.status)
            }
            Coloring::Shape { classes, .. } => classes.iter().map(|&class| COLORS[class as usize].1).collect(),
        }
    }

    /// The scale, where there is one.
    pub fn scale(&self) -> Option<&Scale> {
        match self {
            Coloring::Scale(_, scale) => Some(scale),
            Coloring::Shape { .. } => None,
        }
    }

    /// The number of each vertex's class, where classes are shown.
    pub fn classes(&self) -> Option<&[u8]> {
        match self {
            Coloring::Scale(..) => None,
            Coloring::Shape { classes, .. } => Some(classes),
        }
    }

    /// What the colors stand for, in words.
    pub fn describe(&self) -> String {
        match self {
            Coloring::Scale(quantity, scale) => scale.describe(*quantity),
            Coloring::Shape { tolerance, .. } => {
                let name = |class: ShapeClass| format!("{} {}", class.name(), COLORS[class as usize].0);
                let legend = ShapeClass::ALL.map(name).join(", ");
                format!("shape: {legend}; curvatures of up to {} count as none", table::number(*tolerance))
            }
        }
    }

    /// What the colors stand for, as an object.
    pub fn json(&self) -> Map<String, Value> {
        let object = match self {
            Coloring::Scale(quantity, scale) => {
                json!({ "quantity": quantity.name(), "low": scale.low, "high": scale.high })
            }
            Coloring::Shape { classes, tolerance } => {
                let count = |class: ShapeClass| classes.iter().filter(|&&found| found == class as u8).count();
                let counts: Map<_, _> =
                    ShapeClass::ALL.map(|class| (class.name().to_owned(), count(class).into())).into_iter().collect();
                json!({ "quantity": "shape", "tolerance": tolerance, "vertices": counts })
            }
        };
        match object {
            Value::Object(object) => object,
            _ => Map::new(),
        }
    }
}

/// The color of each class, by its number, and a word for it. Convex ones are warm, concave ones cold.
const COLORS: [(&str, [u8; 3]); ShapeClass::ALL.len()] = [
    ("gray", colormap::NOTHING),
    ("red", [214, 54, 44]),
    ("orange", [245, 150, 50]),
    ("yellow", [250, 220, 90]),
    ("white", [240; 3]),
    ("green", [90, 180, 90]),
    ("blue", [48, 84, 190]),
    ("cyan", [100, 190, 230]),
    ("violet", [160, 110, 200]),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_class_has_its_color_and_is_in_the_legend() {
        for (place, (word, color)) in COLORS.iter().enumerate() {
            assert!(COLORS[..place].iter().all(|(other_word, other)| other_word != word && other != color));
        }
        let classes = ShapeClass::ALL.map(|class| class as u8).to_vec();
        let coloring = Coloring::Shape { classes, tolerance: 0.25 };
        let said = coloring.describe();
        assert!(
            said.starts_with("shape: undefined gray, peak red, ") && said.ends_with(" 0.25 count as none"),
            "{said}"
        );
        assert_eq!(coloring.json()["vertices"]["saddle-valley"], 1);
    }
}

//! Curvatures.

mod polyline;
pub(crate) mod section;

pub use polyline::{PolylineOutputs, polyline_curvatures, polyline_status};

/// How the curvature of a curve is taken from three of its points, or of a section from an edge and a normal.
///
/// `a` and `c` are the edges from the point to its two neighbours, `φ` is the angle between them, `d = |c − a|` the
/// distance of the neighbours from each other. On evenly spaced points the three parabolas agree. As the points of a
/// smooth curve get closer, all tend to its curvature, but [`Section::Parabola`] only if they are evenly spaced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Section {
    /// κ_C, of the circle through the three points: `2 sin φ / d`. At most `2 / max(|a|, |c|)`, however sharp the corner.
    Circle,
    /// κ_P, of the parabola that passes the three points at the parameters 0, ½ and 1: `8 |a| |c| sin φ / d³`.
    Parabola,
    /// κ_P with the parameter in proportion to the lengths `|a|`, `|c|`: `2 (|a| + |c|)² sin φ / d³`.
    LengthParabola,
    /// κ_SP, of a parabola symmetric about the bisector: `4 cos(φ/2) / ((|a| + |c|) sin²(φ/2))`. It grows without bound
    /// as the corner sharpens.
    #[default]
    SymmetricParabola,
}

impl Section {
    /// Every section.
    pub const ALL: [Section; 4] =
        [Section::Circle, Section::Parabola, Section::LengthParabola, Section::SymmetricParabola];

    /// A name in lower case with dashes, for command lines and files.
    pub fn name(self) -> &'static str {
        match self {
            Section::Circle => "circle",
            Section::Parabola => "parabola",
            Section::LengthParabola => "length-parabola",
            Section::SymmetricParabola => "symmetric-parabola",
        }
    }

    /// The section of that [`Section::name`], or of the paper's letters for it: `c`, `p`, `pl`, `sp`.
    pub fn from_name(name: &str) -> Option<Section> {
        match name {
            "c" => Some(Section::Circle),
            "p" => Some(Section::Parabola),
            "pl" => Some(Section::LengthParabola),
            "sp" => Some(Section::SymmetricParabola),
            name => Self::ALL.into_iter().find(|section| section.name() == name),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_back() {
        for (section, letters) in Section::ALL.into_iter().zip(["c", "p", "pl", "sp"]) {
            assert_eq!(Section::from_name(section.name()), Some(section));
            assert_eq!(Section::from_name(letters), Some(section));
        }
        assert_eq!(Section::from_name("Circle"), None);
        assert_eq!(Section::default(), Section::SymmetricParabola);
    }
}

//! How curvatures of meshes are computed, as options on the command line.

use super::{positive, weight, weight_with};
use crate::coloring::Subject;
use clap::Args;
use clap::ValueEnum;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use std::path::Path;
use umbilic::{AdaptiveModel, CurvatureKind, CurvatureOptions, Error, Method, Section, VertexNormals, Weight};

/// How curvatures are computed. Nothing that is given goes unused: what a method does not have is refused.
#[derive(Args)]
#[command(next_help_heading = "Options of curvature")]
pub struct CurvatureEstimator {
    /// How curvatures are estimated [default: adaptive-jet].
    #[arg(long, value_parser = method())]
    method: Option<Method>,
    /// With the methods least-squares, taubin and watanabe, the curve that stands for the section of the surface along
    /// an edge; along an edge all parabolas are one [default: symmetric-parabola].
    #[arg(long, value_parser = section())]
    section: Option<Section>,
    /// The weight of the vertex normals that the method takes, with all methods but jet, adaptive-jet and
    /// tilted-sections, which find their own [default: conformal].
    #[arg(long, visible_alias = "weight", value_name = "WEIGHT", value_parser = weight())]
    normal: Option<Weight>,
    /// How many rings of neighbours count, 1 to 8, with the methods adaptive-jet, jet, quadric, goldfeather,
    /// normal-cycle and corrected-measure [default: 3 to 6 with adaptive jets, by the noise; 2 with jets of degree 2 and 3, 3
    /// with those of degree 4; otherwise 1].
    #[arg(long, visible_alias = "rings", value_name = "N", value_parser = clap::value_parser!(u8).range(1..=8))]
    ring: Option<u8>,
    /// The degree of a jet, 2 to 4; of one that gives normals only, from 1 [default: 3].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=4))]
    degree: Option<u8>,
    /// With the methods normal-cycle and corrected-measure, the radius of a ball around each vertex, a length in the
    /// units of the mesh, instead of rings.
    #[arg(long, value_name = "R", value_parser = positive)]
    radius: Option<f64>,
}

impl CurvatureEstimator {
    /// The method.
    pub fn method(&self) -> Method {
        self.method.unwrap_or_default()
    }

    /// All options, as far as the library can tell whether they fit the method.
    pub fn options(&self) -> Result<CurvatureOptions<'static>, String> {
        let method = self.method();
        if self.section.is_some() && !method.has_sections() {
            return Err(self.refusal("--section"));
        }
        if self.normal.is_some() && finds_normals(method) {
            return Err(self.refusal("--normal"));
        }
        Ok(CurvatureOptions {
            model: None,
            method,
            section: self.section.unwrap_or_default(),
            normals: VertexNormals::Computed(self.normal.unwrap_or_default()),
            degree: self.degree.unwrap_or(0),
            rings: self.ring.unwrap_or(0).into(),
            radius: self.radius.unwrap_or(0.0),
        })
    }

    /// Refuses colors of what the method does not have.
    pub fn check(&self, color: Subject) -> Result<(), String> {
        let name = color.to_possible_value().map_or(String::new(), |value| value.get_name().to_owned());
        self.check_kind(color.kind(), &format!("--color {name}"))
    }

    /// Refuses an option that asks for what the method does not have.
    pub fn check_kind(&self, kind: CurvatureKind, option: &str) -> Result<(), String> {
        if self.method().has(kind) { Ok(()) } else { Err(self.refusal(option)) }
    }

    /// Refuses all of this where no curvature is asked for.
    pub fn refuse(&self, what: &str) -> Result<(), String> {
        let Self { method, section, normal, ring, degree, radius } = self;
        for (name, given) in [
            ("--method", method.is_some()),
            ("--section", section.is_some()),
            ("--normal", normal.is_some()),
            ("--ring", ring.is_some()),
            ("--degree", degree.is_some()),
            ("--radius", radius.is_some()),
        ] {
            if given {
                return Err(format!("{name} is for curvatures, not for {what}"));
            }
        }
        Ok(())
    }

    fn refusal(&self, what: &str) -> String {
        format!("{what} is nothing that the method has ({})", self.method().name())
    }

    /// The weight of normals where no curvature is asked for.
    pub fn weight(&self) -> Result<Weight, String> {
        if self.method.is_some() || self.section.is_some() || self.radius.is_some() {
            return Err("--method, --section and --radius are for colors of curvatures".to_owned());
        }
        weight_with(self.normal.unwrap_or_default(), self.degree, self.ring)
    }

    /// What the options are, with their values in words.
    pub fn rows(&self) -> Vec<(&'static str, String)> {
        let method = self.method();
        let mut rows = vec![("method", method.name().to_owned())];
        if method.has_sections() {
            rows.push(("section", self.section.unwrap_or_default().name().to_owned()));
        }
        if !finds_normals(method) {
            rows.push(("normals", self.normal.unwrap_or_default().name().to_owned()));
        }
        rows.extend(self.degree.map(|degree| ("degree", degree.to_string())));
        rows.extend(self.ring.map(|rings| ("rings", rings.to_string())));
        rows.extend(self.radius.map(|radius| ("radius", format!("{radius}"))));
        rows
    }

    /// Whether the vertices' areas do not overlap, so that sums over them are those of the mesh.
    pub fn adds_up(&self) -> bool {
        self.radius.is_none() && self.ring.unwrap_or(1) == 1
    }

    /// What the library says about a file or an option, by the names that they have here.
    pub fn blame(&self, path: &Path) -> impl Fn(Error) -> String {
        let method = self.method().name();
        move |error| {
            let text = error.to_string().replace("options.rings", "--ring").replace("options.", "--");
            match error {
                Error::NotApplicable { .. } => format!("{}: {text} ({method})", path.display()),
                _ => format!("{}: {text}", path.display()),
            }
        }
    }
}

/// A method by its name.
fn method() -> impl TypedValueParser<Value = Method> {
    let names = Method::ALL.map(|method| PossibleValue::new(method.name()).help(describe(method)));
    PossibleValuesParser::new(names).try_map(|name| Method::from_name(&name).ok_or("no such method"))
}

/// What adaptive jets know of a mesh, for the summary.
pub fn model_rows(model: &AdaptiveModel, rings: usize) -> [(&'static str, String); 3] {
    let rings = if rings == 0 { model.rings() } else { rings };
    [
        ("noise", format!("{:.3e}", model.noise)),
        ("edge length", format!("{:.3e}", model.edge_length)),
        ("reach", format!("{rings} rings")),
    ]
}

/// Whether a method asks for no vertex normals, because it finds its own.
fn finds_normals(method: Method) -> bool {
    matches!(method, Method::AdaptiveJet | Method::Jet | Method::TiltedSections)
}

fn describe(method: Method) -> &'static str {
    match method {
        Method::AdaptiveJet => "A polynomial that adapts to noise and creases of the mesh; the most accurate",
        Method::TiltedSections => "The sections along the edges, with a tilt of the normal; the best of one ring",
        Method::Jet => "A polynomial fitted to several rings; converges on meshes of any kind, smooths noise",
        Method::Quadric => "A quadric fitted in the frame of the vertex normal",
        Method::Goldfeather => "A cubic fitted to positions and normals of neighbours",
        Method::LeastSquares => "The shape operator that fits the sections along the edges best",
        Method::Taubin => "An integral of the sections along the edges",
        Method::Watanabe => "The mean and the mean square of the sections; no directions",
        Method::Meyer => "Cotangents and the angle defect, by Voronoi areas; no directions",
        Method::AngleDefect => "Gaussian curvature only, by the sum of the angles; adds up to 2πχ",
        Method::Rusinkiewicz => "Differences of vertex normals along the faces",
        Method::NormalCycle => "A measure: the angles between faces, by area",
        Method::CorrectedMeasure => "A measure of positions and vertex normals; holds up on noise",
        _ => "",
    }
}

/// A section by its name or the paper's letters.
fn section() -> impl TypedValueParser<Value = Section> {
    let names = Section::ALL.map(|section| {
        let (letters, help) = match section {
            Section::Circle => ("c", "A circle; also c"),
            Section::Parabola => ("p", "A parabola; also p"),
            Section::LengthParabola => ("pl", "A parabola; also pl"),
            _ => ("sp", "A parabola symmetric about the normal; also sp"),
        };
        PossibleValue::new(section.name()).alias(letters).help(help)
    });
    PossibleValuesParser::new(names).try_map(|name| Section::from_name(&name).ok_or("no such section"))
}

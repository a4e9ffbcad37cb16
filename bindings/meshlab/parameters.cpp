// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the dialogs of umbilic's filters say, and how what they answer is read.
#include "parameters.h"

#include "vcg_mesh.h"

namespace umbilic_meshlab {

namespace {

QStringList weights() {
  return {"N_CM: conformal map and mean value coordinates",
          "Uniform",
          "Angle (Thürmer & Wüthrich)",
          "Area",
          "Max: sine over both edges",
          "Area over distance to the centroid",
          "Squared distance to the centroid (Chen & Wu)",
          "Root of the edges",
          "Sine",
          "Angle times both edges",
          "Jet: polynomial over several rings",
          "Adaptive jet: learns noise and smoothness",
          "Tilted sections"};
}

QStringList methods() {
  return {"Adaptive jet: learns noise and smoothness",
          "Jet: polynomial over several rings (Cazals & Pouget)",
          "Quadric (Hamann)",
          "Goldfeather & Interrante",
          "Tilted sections",
          "Least squares of sections",
          "Taubin",
          "Watanabe & Belyaev",
          "Meyer: cotangents, angle defect",
          "Angle defect (Gauss & Bonnet)",
          "Rusinkiewicz",
          "Normal cycle (Cohen-Steiner & Morvan)",
          "Corrected measure (Lachaud et al.)"};
}

const Value &value(const RichParameterList &given, const char *name) {
  if (!given.hasParameter(name)) throw std::invalid_argument("the parameter \"" + std::string(name) + "\" is missing");
  return given.getParameterByName(name).value();
}

[[noreturn]] void refuse(const char *name, const std::string &found, const std::string &expected) {
  throw std::invalid_argument("the parameter \"" + std::string(name) + "\" is " + found + ", expected " + expected);
}

[[noreturn]] void refuse_type(const char *name, const Value &found, const std::string &expected) {
  refuse(name, "of type " + found.typeName().toStdString(), expected);
}

}  // namespace

// Values end the process if they are asked for what they are not. (Numbers of lists are integers to MeshLab, percentages numbers.)
std::uint32_t count(const RichParameterList &given, const char *name, std::uint32_t last) {
  const Value &found = value(given, name);
  if (!found.isInt()) refuse_type(name, found, "Enum or Int");
  const int number = found.getInt();
  const bool is_within = number >= 0 && static_cast<std::uint32_t>(number) <= last;
  const bool has_last = last < std::numeric_limits<std::uint32_t>::max();
  if (!is_within) refuse(name, std::to_string(number), has_last ? "0 to " + std::to_string(last) : "0 or more");
  return static_cast<std::uint32_t>(number);
}

double decimal(const RichParameterList &given, const char *name) {
  const Value &found = value(given, name);
  if (!found.isFloat()) refuse_type(name, found, "Float");
  return static_cast<double>(found.getFloat());
}

double percentage(const RichParameterList &given, const char *name) {
  const double found = decimal(given, name);
  if (!(found >= 0.0 && found <= 100.0)) refuse(name, std::to_string(found), "0 to 100");
  return found;
}

void add_normal_parameters(RichParameterList &parameters) {
  parameters.addParam(RichEnum("weight", UMB_WEIGHT_CONFORMAL, weights(), "Weight",
                               "How the faces around a vertex are weighed, or what is fitted. <b>N_CM</b> is the best average on irregular smooth "
                               "meshes, <b>Max</b> on spheres; <b>angle</b> does not see how a flat face is cut up; <b>adaptive jets</b> are the most "
                               "accurate on smooth, noisy and creased meshes, at some 1 µs a vertex."));
  parameters.addParam(RichInt("degree", 0, "Degree of jets", "Jets only: the degree of the polynomial, 1 to 4; 0 for 3."));
  parameters.addParam(RichInt("rings", 0, "Rings of jets",
                              "Jets and adaptive jets only: the rings of neighbours that are fitted, 1 to 8; 0 for as many as the degree, or the noise, "
                              "asks for."));
}

umbilic::normal_options normal_options_of(const RichParameterList &given) {
  umbilic::normal_options options(count(given, "weight"));
  options.degree = count(given, "degree");
  options.rings = count(given, "rings");
  return options;
}

void add_method_parameters(RichParameterList &parameters, float diagonal) {
  parameters.addParam(RichEnum("method", UMB_CURVATURE_ADAPTIVE_JET, methods(), "Method",
                               "How curvatures are estimated. <b>Adaptive jets</b> are the most accurate on clean, noisy, open and creased meshes. "
                               "Watanabe's and Meyer's methods have no directions, the angle defect has Gaussian curvature only."));
  parameters.addParam(RichInt("rings", 0, "Rings",
                              "Adaptive jets, jets, quadrics, Goldfeather, normal cycle and corrected measure: the rings of neighbours that count, 1 to "
                              "8; 0 for the method's default."));
  parameters.addParam(RichAbsPerc("radius", 0, 0, diagonal, "Radius",
                                  "Normal cycle and corrected measure only: the radius of a ball around each vertex instead of rings, in the mesh's "
                                  "unit of length; 0 for rings."));
  parameters.addParam(RichInt("degree", 0, "Degree of jets", "Jets only: the degree of the polynomial, 2 to 4; 0 for 3."));
  parameters.addParam(RichEnum("section", UMB_SECTION_SYMMETRIC_PARABOLA, {"Symmetric parabola", "Circle", "Parabola", "Parabola by lengths"}, "Section",
                               "Least squares, Taubin and Watanabe only: the curve whose curvature stands for that of the surface along an edge."));
  parameters.addParam(RichEnum("normals", UMB_WEIGHT_CONFORMAL, weights() << "Those of the mesh", "Normals",
                               "The vertex normals that the method takes: computed with a weight, or those that the mesh has, which must be on the side "
                               "from which its faces run counter-clockwise. (Adaptive jets find their own, jets and tilted sections take the mesh's alone.)"));
}

umbilic::curvature_options method_of(const RichParameterList &given, const CMeshO &mesh) {
  umbilic::curvature_options options(count(given, "method"));
  options.rings = count(given, "rings");
  options.radius = decimal(given, "radius");
  options.degree = count(given, "degree");
  options.section = count(given, "section");
  options.weight = count(given, "normals");
  if (options.weight == static_cast<umb_weight>(weights().size())) {
    options.weight = UMB_WEIGHT_CONFORMAL;
    options.normals = given_normals_of(mesh);
  }
  return options;
}

void add_color_parameters(RichParameterList &parameters) {
  parameters.addParam(RichEnum("quality", static_cast<int>(Subject::mean),
                               {"Mean curvature", "Gaussian curvature", "Smaller principal curvature k2", "Larger principal curvature k1", "Shape index",
                                "Curvedness", "None"},
                               "Quality and colors",
                               "What becomes the quality of the vertices. Mean curvature (k1 + k2) / 2, k1, k2 and curvedness √((k1² + k2²) / 2) are in "
                               "1/length, Gaussian curvature k1 k2 in 1/length², with the length in the mesh's unit. The shape index has no unit: 1 cap, "
                               "0.5 ridge, 0 saddle or plane, -0.5 rut, -1 cup. <b>None</b> leaves quality and colors as they are."));
  parameters.addParam(RichEnum("colors", static_cast<int>(Colors::diverging),
                               {"Blue negative, white 0, red positive", "MeshLab's ramp, red lowest, blue highest", "None"}, "Colors",
                               "How the quality becomes the color of the vertices; those without a result are gray."));
  parameters.addParam(RichFloat("percentile", 95, "Percentile of the colors",
                                "The strongest colors begin at what so many percent of the vertices do not exceed (in absolute value, where white is 0), so "
                                "that a few wild ones do not fade all others; 0 to 100. The shape index has a scale of its own."));
}

void add_segment_parameters(RichParameterList &parameters) {
  parameters.addParam(RichEnum("by", static_cast<int>(Segments::features), {"Creases", "Watershed of curvedness", "Regions of one shape"}, "Segments by",
                               "What tells segments apart. <b>Creases</b>: sharp edges, for what machines make. <b>Watershed</b>: basins of curvedness, up "
                               "to where it is highest between them, for organic shapes. <b>Regions</b>: parts that are flat, convex, concave or saddles, "
                               "and creases, for what has fillets."));
  parameters.addParam(RichFloat("creaseAngle", 30, "Crease angle",
                                "By creases and regions: faces whose normals differ by more than this are not joined, in degrees; 0 for 30."));
  parameters.addParam(RichFloat("depth", 0, "Depth",
                                "By watershed: basins that are less deep than this are merged, in 1/length; 0 for 4 by the diagonal of the bounding box."));
  parameters.addParam(RichFloat("tolerance", 0, "Tolerance",
                                "By regions: curvatures of up to this count as none, in 1/length; 0 for 2 by the diagonal of the bounding box."));
  parameters.addParam(RichFloat("smallestShare", 0, "Smallest share",
                                "By regions: those of less than this share of the whole area become part of a neighbour, 0 to 1; 0 for 0.0005."));
  parameters.addParam(RichInt("smallestFaces", 0, "Smallest number of faces", "By regions: those of fewer faces become part of a neighbour."));
}

}  // namespace umbilic_meshlab

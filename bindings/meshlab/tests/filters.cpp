// SPDX-License-Identifier: GPL-3.0-or-later
//
// The filters against the library: the same bits in MeshLab's mesh as in packed arrays, for every weight, method and way of cutting; every mistake
// answered by a message and an untouched mesh; progress, cancelling, gaps and the layer's matrix.
#include "check.h"
#include "meshes.h"
#include "plugin.h"
#include "vcg_mesh.h"

#include <QApplication>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

namespace {

/** A document with one mesh. */
struct Layer {
  MeshDocument document;
  MeshModel &model;

  Layer() : model(*document.addNewMesh("", "layer")) {}
  Layer(const PolygonMesh &from, unsigned seed) : Layer() {
    fill(model.cm, from, Order::shuffled, seed);
    vcg::tri::UpdateBounding<CMeshO>::Box(model.cm);
    for (CVertexO &vertex : model.cm.vert) {
      vertex.N() = Point3m(7, 7, 7);
      vertex.Q() = 7;
    }
  }
  CMeshO &mesh() { return model.cm; }
};

using Vector = std::array<float, 3>;

/** What calls of the library take: a copy of a mesh in arrays of its own. */
struct Copied {
  explicit Copied(const CMeshO &mesh) : loops(umbilic_meshlab::faces_of(mesh).polygons) {
    for (const CVertexO &vertex : mesh.vert) positions.push_back({vertex.P()[0], vertex.P()[1], vertex.P()[2]});
  }
  umbilic::polygons loops;
  std::vector<Vector> positions;
};

bool same(const Point3m &a, const Vector &b) { return std::memcmp(a.V(), b.data(), sizeof b) == 0; }
bool same(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0; }

void normals_are_the_librarys(Plugin &plugin, const PolygonMesh &from) {
  for (umb_weight weight = UMB_WEIGHT_CONFORMAL; weight <= UMB_WEIGHT_TILTED_SECTIONS; weight++) {
    Layer layer(from, weight);
    const Copied copied(layer.mesh());
    std::vector<Vector> expected(copied.positions.size());
    umbilic::vertex_normals(copied.loops, copied.positions, expected, weight);
    RichParameterList given = plugin.parameters(NORMALS, layer.document);
    given.setValue("weight", EnumValue(static_cast<int>(weight)));
    CHECK(plugin.apply(NORMALS, layer.document, given), "weight %u: %s", weight, plugin.message().c_str());
    for (std::size_t v = 0; v < expected.size(); v++) CHECK(same(layer.mesh().vert[v].N(), expected[v]), "weight %u, vertex %zu", weight, v);
  }
  Layer layer(from, 1);
  const Copied copied(layer.mesh());
  std::vector<Vector> expected(copied.positions.size());
  umbilic::normal_options options(UMB_WEIGHT_JET);
  options.degree = 2;
  options.rings = 3;
  umbilic::vertex_normals(copied.loops, copied.positions, expected, options);
  RichParameterList given = plugin.parameters(NORMALS, layer.document);
  given.setValue("weight", EnumValue(UMB_WEIGHT_JET));
  given.setValue("degree", IntValue(2));
  given.setValue("rings", IntValue(3));
  CHECK(plugin.apply(NORMALS, layer.document, given), "%s", plugin.message().c_str());
  for (std::size_t v = 0; v < expected.size(); v++) CHECK(same(layer.mesh().vert[v].N(), expected[v]), "jets, vertex %zu", v);
}

/** In the order of the list "quality". */
constexpr umbilic::numbers umbilic::curvature_outputs::*QUALITIES[] = {
    &umbilic::curvature_outputs::mean, &umbilic::curvature_outputs::gaussian,    &umbilic::curvature_outputs::k2,
    &umbilic::curvature_outputs::k1,   &umbilic::curvature_outputs::shape_index, &umbilic::curvature_outputs::curvedness};
constexpr int NO_QUALITY = 6;

void curvatures_are_the_librarys(Plugin &plugin, const PolygonMesh &from, const umbilic::curvature_options &options, int quality,
                                 void (*set)(RichParameterList &), bool own_normals = false) {
  Layer layer(from, options.method);
  CMeshO &mesh = layer.mesh();
  if (own_normals) {
    RichParameterList given = plugin.parameters(NORMALS, layer.document);
    given.setValue("weight", EnumValue(UMB_WEIGHT_ANGLE));
    CHECK(plugin.apply(NORMALS, layer.document, given), "%s", plugin.message().c_str());
  }
  const Copied copied(mesh);
  const std::size_t count = copied.positions.size();
  const umbilic::quantities of_method = umbilic::quantity::of_method(options.method);
  const bool has_principal = of_method != umbilic::quantity::gaussian;
  const bool has_directions = (of_method & umbilic::quantity::direction1) != umbilic::quantities{};
  std::vector<float> k1(count), k2(count), other(count);
  std::vector<Vector> direction1(count), direction2(count), normals;
  umbilic::curvature_outputs into;
  if (quality != NO_QUALITY) into.*QUALITIES[quality] = other;
  if (has_principal) into.k1 = k1, into.k2 = k2;
  if (has_directions) into.direction1 = direction1, into.direction2 = direction2;
  umbilic::curvature_options asked = options;
  if (own_normals) {
    for (const CVertexO &vertex : mesh.vert) normals.push_back({vertex.N()[0], vertex.N()[1], vertex.N()[2]});
    asked.normals = umbilic::points(normals);
  }
  umbilic::curvatures(umbilic::topology(copied.loops, count), copied.positions, into, asked);
  if (quality == 2) other = k2;
  if (quality == 3) other = k1;

  RichParameterList given = plugin.parameters(CURVATURE, layer.document);
  given.setValue("method", EnumValue(static_cast<int>(options.method)));
  given.setValue("quality", EnumValue(quality));
  set(given);
  CHECK(plugin.apply(CURVATURE, layer.document, given), "method %u: %s", options.method, plugin.message().c_str());
  CHECK(mesh.vert.IsCurvatureDirEnabled() == has_principal, "method %u", options.method);
  for (std::size_t v = 0; v < count; v++) {
    CVertexO &vertex = mesh.vert[v];
    CHECK(same(vertex.Q(), quality == NO_QUALITY ? 7.0f : other[v]), "method %u, quality %d, vertex %zu", options.method, quality, v);
    if (!has_principal) continue;
    CHECK(same(vertex.K1(), k1[v]) && same(vertex.K2(), k2[v]), "method %u, vertex %zu", options.method, v);
    CHECK(same(vertex.PD1(), direction1[v]) && same(vertex.PD2(), direction2[v]), "method %u, vertex %zu", options.method, v);
  }
}

void every_method(Plugin &plugin, const PolygonMesh &from) {
  for (umb_curvature_method method = UMB_CURVATURE_ADAPTIVE_JET; method <= UMB_CURVATURE_CORRECTED_MEASURE; method++) {
    curvatures_are_the_librarys(plugin, from, method, method == UMB_CURVATURE_ANGLE_DEFECT ? 1 : 0, [](RichParameterList &) {});
  }
  for (int quality = 0; quality <= NO_QUALITY; quality++) {
    curvatures_are_the_librarys(plugin, from, UMB_CURVATURE_QUADRIC, quality, [](RichParameterList &) {});
  }
  umbilic::curvature_options options(UMB_CURVATURE_JET);
  options.degree = 2;
  options.rings = 3;
  curvatures_are_the_librarys(plugin, from, options, 0, [](RichParameterList &given) {
    given.setValue("degree", IntValue(2));
    given.setValue("rings", IntValue(3));
  });
  options = umbilic::curvature_options(UMB_CURVATURE_NORMAL_CYCLE);
  options.radius = 0.25;
  curvatures_are_the_librarys(plugin, from, options, 0, [](RichParameterList &given) { given.setValue("radius", AbsPercValue(0.25f)); });
  options = umbilic::curvature_options(UMB_CURVATURE_LEAST_SQUARES);
  options.section = UMB_SECTION_CIRCLE;
  options.weight = UMB_WEIGHT_MAX;
  curvatures_are_the_librarys(plugin, from, options, 0, [](RichParameterList &given) {
    given.setValue("section", EnumValue(UMB_SECTION_CIRCLE));
    given.setValue("normals", EnumValue(UMB_WEIGHT_MAX));
  });
  curvatures_are_the_librarys(
      plugin, from, UMB_CURVATURE_RUSINKIEWICZ, 0, [](RichParameterList &given) { given.setValue("normals", EnumValue(13)); }, true);
}

template <class Options>
void segments_are_the_librarys(Plugin &plugin, const PolygonMesh &from, int by, const Options &options, const RichParameterList &given,
                               std::size_t at_least) {
  Layer layer(from, 3);
  CMeshO &mesh = layer.mesh();
  const umbilic_meshlab::mesh_faces faces = umbilic_meshlab::faces_of(mesh);
  const Copied copied(mesh);
  const umbilic::segmentation expected = umbilic::segment(copied.loops, copied.positions, options);
  CHECK(expected.count() >= at_least, "%zu segments", expected.count());
  CHECK(plugin.apply(SEGMENTATION, layer.document, given), "by %d: %s", by, plugin.message().c_str());
  CHECK(mesh.face.IsQualityEnabled() && mesh.face.IsColorEnabled(), "by %d", by);
  std::vector<vcg::Color4b> colors(expected.count());
  std::vector<bool> seen(expected.count());
  for (std::size_t f = 0; f < mesh.face.size(); f++) {
    const std::uint32_t label = expected.labels()[faces.face(f)];
    CHECK(same(mesh.face[f].Q(), static_cast<float>(label)), "by %d, face %zu", by, f);
    if (!seen[label]) colors[label] = mesh.face[f].C();
    seen[label] = true;
    CHECK(mesh.face[f].C() == colors[label], "by %d, face %zu", by, f);
  }
  for (std::size_t label = 1; label < colors.size(); label++) CHECK(colors[label] != colors[label - 1], "label %zu", label);
}

void every_way_of_cutting(Plugin &plugin) {
  const PolygonMesh cube = box(4), bumpy = torus(30, 16, false);
  Layer any(cube, 0);
  const auto parameters = [&](int by) {
    RichParameterList given = plugin.parameters(SEGMENTATION, any.document);
    given.setValue("by", EnumValue(by));
    return given;
  };
  segments_are_the_librarys(plugin, cube, 0, umbilic::feature_options(), parameters(0), 6);
  umbilic::feature_options features;
  const umbilic::creases blunt(100.0 * M_PI / 180.0);
  features.creases = &blunt;
  RichParameterList given = parameters(0);
  given.setValue("creaseAngle", FloatValue(100));
  segments_are_the_librarys(plugin, cube, 0, features, given, 1);

  segments_are_the_librarys(plugin, bumpy, 1, umbilic::watershed_options(), parameters(1), 1);
  umbilic::watershed_options watershed;
  const umbilic::curvature_options quadric(UMB_CURVATURE_QUADRIC);
  watershed.depth = 0.5;
  watershed.curvature = &quadric;
  given = parameters(1);
  given.setValue("depth", FloatValue(0.5));
  given.setValue("method", EnumValue(UMB_CURVATURE_QUADRIC));
  segments_are_the_librarys(plugin, bumpy, 1, watershed, given, 2);

  segments_are_the_librarys(plugin, bumpy, 2, umbilic::region_options(), parameters(2), 2);
  umbilic::region_options regions;
  regions.tolerance = 0.25;
  regions.smallest_share = 0.0625;
  regions.smallest_faces = 5;
  given = parameters(2);
  given.setValue("tolerance", FloatValue(0.25));
  given.setValue("smallestShare", FloatValue(0.0625));
  given.setValue("smallestFaces", IntValue(5));
  segments_are_the_librarys(plugin, bumpy, 2, regions, given, 2);
}

/** A filter that has to refuse, with these words, and to leave normals and qualities alone. */
void refused(Plugin &plugin, Layer &layer, const char *filter, const RichParameterList &given, const char *words) {
  CHECK(!plugin.apply(filter, layer.document, given), "%s, expected \"%s\"", filter, words);
  CHECK(plugin.message().find(words) != std::string::npos, "%s: \"%s\" is not in \"%s\"", filter, words, plugin.message().c_str());
  CHECK(plugin.log().find(plugin.message()) != std::string::npos, "\"%s\" is not in the log", plugin.message().c_str());
  const auto untouched = [](const CVertexO &vertex) { return vertex.cN() == Point3m(7, 7, 7) && vertex.cQ() == 7.0f; };
  CHECK(std::all_of(layer.mesh().vert.begin(), layer.mesh().vert.end(), untouched), "%s has written: %s", filter, words);
}

void mistakes_are_answered(Plugin &plugin) {
  Layer layer(torus(12, 8, true), 0);
  const auto wrong = [&](const char *filter, const char *words, std::initializer_list<std::pair<const char *, int>> values) {
    RichParameterList given = plugin.parameters(filter, layer.document);
    for (const auto &value : values) {
      const Value &old = given.getParameterByName(value.first).value();
      if (old.isEnum()) {
        given.setValue(value.first, EnumValue(value.second));
      } else if (old.isInt()) {
        given.setValue(value.first, IntValue(value.second));
      } else if (old.isAbsPerc()) {
        given.setValue(value.first, AbsPercValue(static_cast<float>(value.second)));
      } else {
        given.setValue(value.first, FloatValue(static_cast<float>(value.second)));
      }
    }
    refused(plugin, layer, filter, given, words);
  };
  wrong(NORMALS, "weight", {{"weight", 13}});
  wrong(NORMALS, "\"weight\" is -1, expected 0 or more", {{"weight", -1}});
  wrong(NORMALS, "degree", {{"weight", UMB_WEIGHT_JET}, {"degree", 9}});
  wrong(NORMALS, "rings", {{"weight", UMB_WEIGHT_JET}, {"rings", -1}});
  wrong(CURVATURE, "method", {{"method", 13}});
  wrong(CURVATURE, "method", {{"method", -1}});
  wrong(CURVATURE, "weight", {{"method", UMB_CURVATURE_TAUBIN}, {"normals", 14}});
  wrong(CURVATURE, "section", {{"method", UMB_CURVATURE_TAUBIN}, {"section", 4}});
  wrong(CURVATURE, "\"quality\" is 7, expected 0 to 6", {{"quality", 7}});
  wrong(CURVATURE, "\"colors\" is 3, expected 0 to 2", {{"colors", 3}});
  wrong(CURVATURE, "\"percentile\" is 101.000000, expected 0 to 100", {{"percentile", 101}});
  wrong(CURVATURE, "degree", {{"method", UMB_CURVATURE_TAUBIN}, {"degree", 3}});
  wrong(CURVATURE, "radius", {{"radius", 1}});
  wrong(CURVATURE, "mean", {{"method", UMB_CURVATURE_ANGLE_DEFECT}});
  wrong(CURVATURE, "principal", {{"method", UMB_CURVATURE_ANGLE_DEFECT}, {"quality", 3}});
  wrong(SEGMENTATION, "\"by\" is 3, expected 0 to 2", {{"by", 3}});
  wrong(SEGMENTATION, "angle", {{"creaseAngle", -1}});
  wrong(SEGMENTATION, "depth", {{"by", 1}, {"depth", -1}});
  wrong(SEGMENTATION, "tolerance", {{"by", 2}, {"tolerance", -1}});
  wrong(SEGMENTATION, "smallest_share", {{"by", 2}, {"smallestShare", 2}});
  wrong(SEGMENTATION, "smallestFaces", {{"by", 2}, {"smallestFaces", -1}});

  RichParameterList given;
  refused(plugin, layer, NORMALS, given, "the parameter \"weight\" is missing");
  given.addParam(RichString("weight", "angle"));
  refused(plugin, layer, NORMALS, given, "the parameter \"weight\" is of type String, expected Enum or Int");
  given = plugin.parameters(SEGMENTATION, layer.document);
  RichParameterList mistyped;
  for (const RichParameter &parameter : given) {
    if (parameter.name() != "creaseAngle") mistyped.addParam(parameter);
  }
  mistyped.addParam(RichInt("creaseAngle", 30));
  refused(plugin, layer, SEGMENTATION, mistyped, "the parameter \"creaseAngle\" is of type Int, expected Float");

  for (const char *filter : {NORMALS, CURVATURE, SEGMENTATION}) {
    layer.mesh().vert[17].P()[1] = std::numeric_limits<float>::quiet_NaN();
    refused(plugin, layer, filter, plugin.parameters(filter, layer.document), "17");
    layer.mesh().vert[17].P()[1] = 0;
    Layer nothing;
    refused(plugin, nothing, filter, plugin.parameters(filter, nothing.document), "the mesh has no faces");
    Layer points(PolygonMesh{torus(3, 3, true).positions, {}}, 0);
    refused(plugin, points, filter, plugin.parameters(filter, points.document), "the mesh has no faces");
    MeshDocument none;
    CHECK(!plugin.apply(filter, none, plugin.parameters(filter, none)) && plugin.message() == "there is no mesh", "%s", plugin.message().c_str());
  }
}

void directions_are_those_of_the_last_method(Plugin &plugin) {
  Layer layer(torus(12, 8, true), 0);
  RichParameterList given = plugin.parameters(CURVATURE, layer.document);
  CHECK(plugin.apply(CURVATURE, layer.document, given), "%s", plugin.message().c_str());
  const auto has_directions = [](CVertexO &vertex) { return vertex.PD1().Norm() > 0.9f && vertex.PD2().Norm() > 0.9f; };
  given.setValue("method", EnumValue(UMB_CURVATURE_MEYER));
  given.setValue("degree", IntValue(3));
  CHECK(!plugin.apply(CURVATURE, layer.document, given), "applied");
  CHECK(std::all_of(layer.mesh().vert.begin(), layer.mesh().vert.end(), has_directions), "what was refused has taken the directions");
  given.setValue("degree", IntValue(0));
  CHECK(plugin.apply(CURVATURE, layer.document, given), "%s", plugin.message().c_str());
  CHECK(std::none_of(layer.mesh().vert.begin(), layer.mesh().vert.end(), has_directions), "directions of another method are left");
}

void degenerate_faces_do_no_harm(Plugin &plugin) {
  Layer layer;
  add_vertices(layer.mesh(), {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}});
  add_triangle(layer.mesh(), {0, 1, 2}, 0);  // without area
  add_triangle(layer.mesh(), {0, 0, 1}, 3);  // an edge without length
  for (const char *filter : {NORMALS, CURVATURE, SEGMENTATION}) {
    CHECK(plugin.apply(filter, layer.document, plugin.parameters(filter, layer.document)), "%s: %s", filter, plugin.message().c_str());
  }
  for (CVertexO &vertex : layer.mesh().vert) {
    CHECK(vertex.cN() == Point3m(0, 0, 0) && vertex.cQ() == 0 && vertex.K1() == 0 && vertex.PD1() == Point3m(0, 0, 0), "not zero");
    CHECK(vertex.cC() == vcg::Color4b(128, 128, 128, 255), "not gray");
  }
  CHECK(layer.mesh().face[0].cQ() == 0 && layer.mesh().face[1].cQ() == -1, "labels %g, %g", layer.mesh().face[0].cQ(), layer.mesh().face[1].cQ());
  CHECK(plugin.log().find("4 vertices have no result") != std::string::npos, "%s", plugin.log().c_str());
}

void gaps_are_closed(Plugin &plugin) {
  const PolygonMesh whole = torus(12, 8, false);
  for (const char *filter : {NORMALS, CURVATURE, SEGMENTATION}) {
    // The same mesh after a vertex and a face that are deleted; the vertex is nowhere.
    Layer without(whole, 5), with;
    CMeshO &mesh = with.mesh();
    add_vertices(mesh, {{std::numeric_limits<float>::quiet_NaN(), 0, 0}});
    add_vertices(mesh, whole.positions);
    add_triangle(mesh, {0, 1, 2}, 7);
    for (const CFaceO &face : without.mesh().face) {
      std::array<int, 3> corners;
      unsigned faux = 0;
      for (int k = 0; k < 3; k++) {
        corners[static_cast<std::size_t>(k)] = static_cast<int>(vcg::tri::Index(without.mesh(), face.cV(k))) + 1;
        faux |= face.IsF(k) ? 1U << k : 0U;
      }
      add_triangle(mesh, corners, faux);
    }
    vcg::tri::Allocator<CMeshO>::DeleteFace(mesh, mesh.face[0]);
    vcg::tri::Allocator<CMeshO>::DeleteVertex(mesh, mesh.vert[0]);
    for (Layer *layer : {&with, &without}) {
      for (CVertexO &vertex : layer->mesh().vert) vertex.N() = Point3m(0, 0, 0), vertex.Q() = 0;
      CHECK(plugin.apply(filter, layer->document, plugin.parameters(filter, layer->document)), "%s: %s", filter, plugin.message().c_str());
    }
    CHECK(mesh.vert.size() == whole.positions.size() && mesh.face.size() == without.mesh().face.size(), "%zu", mesh.vert.size());
    // Compacting changes the order, so that places are told by coordinates.
    std::map<Point3m, const CVertexO *> places;
    for (const CVertexO &vertex : mesh.vert) places[vertex.cP()] = &vertex;
    for (const CVertexO &vertex : without.mesh().vert) {
      const CVertexO *other = places[vertex.cP()];
      CHECK(other != nullptr && (other->cN() - vertex.cN()).Norm() < 1e-6f && std::abs(other->cQ() - vertex.cQ()) < 1e-4f, "%s", filter);
    }
  }
}

int last_progress = -1;
bool runs_up = true;
bool note(const int percent, const char *text) {
  runs_up = runs_up && percent >= last_progress && percent <= 100 && std::string(text).rfind("Umbilic: ", 0) == 0;
  last_progress = percent;
  return true;
}
bool cancel(const int, const char *) { return false; }

void progress_and_cancelling(Plugin &plugin) {
  for (const char *filter : {NORMALS, CURVATURE, SEGMENTATION}) {
    Layer layer(torus(60, 40, true), 0);
    RichParameterList given = plugin.parameters(filter, layer.document);
    if (filter == SEGMENTATION) given.setValue("by", EnumValue(1));
    last_progress = -1;
    CHECK(plugin.apply(filter, layer.document, given, note) && runs_up && last_progress > 0, "%s: %d", filter, last_progress);
    CHECK(!plugin.apply(filter, layer.document, given, cancel) && plugin.message().find("cancel") != std::string::npos, "%s: %s", filter,
          plugin.message().c_str());
  }
}

void colors_tell_signs(Plugin &plugin) {
  Layer layer(torus(40, 24, true), 0);
  RichParameterList given = plugin.parameters(CURVATURE, layer.document);
  given.setValue("quality", EnumValue(1));
  CHECK(plugin.apply(CURVATURE, layer.document, given), "%s", plugin.message().c_str());
  for (const CVertexO &vertex : layer.mesh().vert) {
    const vcg::Color4b color = vertex.cC();
    CHECK(vertex.cQ() > 0 ? color[0] >= color[2] : color[0] <= color[2], "%g: %d %d %d", vertex.cQ(), color[0], color[1], color[2]);
  }
  given.setValue("colors", EnumValue(1));
  given.setValue("percentile", FloatValue(100));
  CHECK(plugin.apply(CURVATURE, layer.document, given), "%s", plugin.message().c_str());
  const auto less = [](const CVertexO &a, const CVertexO &b) { return a.cQ() < b.cQ(); };
  const auto ends = std::minmax_element(layer.mesh().vert.begin(), layer.mesh().vert.end(), less);
  CHECK(ends.first->cC() == vcg::Color4b(vcg::Color4b::Red) && ends.second->cC() == vcg::Color4b(vcg::Color4b::Blue), "the ramp's ends");
  for (CVertexO &vertex : layer.mesh().vert) vertex.C() = vcg::Color4b(1, 2, 3, 4);
  given.setValue("colors", EnumValue(2));
  CHECK(plugin.apply(CURVATURE, layer.document, given), "%s", plugin.message().c_str());
  for (const CVertexO &vertex : layer.mesh().vert) CHECK(vertex.cC() == vcg::Color4b(1, 2, 3, 4), "colored");
}

void a_ball_is_positive(Plugin &plugin) {
  // The outer side of a torus bends away from its normal in every direction.
  Layer layer(torus(40, 24, false), 0);
  CHECK(plugin.apply(NORMALS, layer.document, plugin.parameters(NORMALS, layer.document)), "%s", plugin.message().c_str());
  CHECK(plugin.apply(CURVATURE, layer.document, plugin.parameters(CURVATURE, layer.document)), "%s", plugin.message().c_str());
  CVertexO &outer = layer.mesh().vert[24];
  CHECK(outer.K1() >= outer.K2() && outer.K2() > 0, "%g %g", outer.K1(), outer.K2());
  CHECK(outer.N().dot(outer.P()) > 0 && std::abs(outer.PD1().dot(outer.N())) < 0.2f, "normal %g", outer.N().dot(outer.P()));
}

void the_matrix_is_not_applied(Plugin &plugin) {
  Layer plain(torus(12, 8, true), 0), scaled(torus(12, 8, true), 0);
  scaled.mesh().Tr.SetScale(3, 3, 3);
  for (Layer *layer : {&plain, &scaled}) {
    CHECK(plugin.apply(CURVATURE, layer->document, plugin.parameters(CURVATURE, layer->document)), "%s", plugin.message().c_str());
    CHECK((plugin.log().find("matrix") != std::string::npos) == (layer == &scaled), "%s", plugin.log().c_str());
  }
  for (std::size_t v = 0; v < plain.mesh().vert.size(); v++) CHECK(plain.mesh().vert[v].cQ() == scaled.mesh().vert[v].cQ(), "vertex %zu", v);
}

void meshlab_finds_all_it_asks_for(Plugin &plugin) {
  MeshFilterInterface &filters = plugin.filters();
  CHECK(filters.actions().size() == 3, "%d actions", filters.actions().size());
  Layer layer(box(1), 0);
  for (QAction *action : filters.actions()) {
    const std::string name = action->text().toStdString();
    CHECK(filters.filterName(filters.ID(action)).toStdString() == name && !filters.filterInfo(action).isEmpty(), "%s", name.c_str());
    CHECK(filters.getClass(action) != MeshFilterInterface::Generic && filters.filterArity(action) == MeshFilterInterface::SINGLE_MESH, "%s",
          name.c_str());
    for (const RichParameter &parameter : plugin.parameters(name.c_str(), layer.document)) {
      CHECK(!parameter.fieldDescription().isEmpty() && parameter.toolTip().size() > 30, "%s: %s", name.c_str(), qUtf8Printable(parameter.name()));
    }
  }
}

}  // namespace

int main(int argc, char **argv) {
  QApplication application(argc, argv);
  Plugin plugin(argv[1]);
  meshlab_finds_all_it_asks_for(plugin);
  for (const PolygonMesh &mesh : {torus(12, 8, false), torus(10, 7, true), box(3)}) {
    normals_are_the_librarys(plugin, mesh);
    every_method(plugin, mesh);
  }
  every_way_of_cutting(plugin);
  the_matrix_is_not_applied(plugin);
  mistakes_are_answered(plugin);
  directions_are_those_of_the_last_method(plugin);
  degenerate_faces_do_no_harm(plugin);
  gaps_are_closed(plugin);
  progress_and_cancelling(plugin);
  colors_tell_signs(plugin);
  a_ball_is_positive(plugin);
  return outcome("filters");
}

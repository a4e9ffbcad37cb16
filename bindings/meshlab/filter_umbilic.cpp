// SPDX-License-Identifier: GPL-3.0-or-later
//
// umbilic's filters: from a mesh and parameters to calls of the library, and from its results to what MeshLab shows.
#include "filter_umbilic.h"

#include "colors.h"
#include "parameters.h"
#include "vcg_mesh.h"

#include <algorithm>
#include <chrono>
#include <cmath>

using namespace umbilic_meshlab;

namespace {

/** Milliseconds since it was made or last asked. */
class Stopwatch {
 public:
  double lap() {
    const auto before = std::exchange(last_, std::chrono::steady_clock::now());
    return std::chrono::duration<double, std::milli>(last_ - before).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

bool has_result(std::uint8_t status) { return (status & (UMB_VERTEX_ISOLATED | UMB_VERTEX_DEGENERATE)) == 0; }

/** The number that this part of some, 0 to 1, does not exceed, interpolated between the two nearest; 0 where there are none. */
double quantile(std::vector<double> &some, double part) {
  if (some.empty()) return 0.0;
  const double place = part * static_cast<double>(some.size() - 1), share = place - std::floor(place);
  const auto at = some.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(some.begin(), at, some.end());
  return share == 0.0 ? *at : *at * (1.0 - share) + *std::min_element(at + 1, some.end()) * share;
}

void color_vertices(CMeshO &mesh, const std::vector<std::uint8_t> &statuses, Subject subject, Colors colors, double percentile) {
  const bool about_zero = colors == Colors::diverging;
  std::vector<double> values;
  for (std::size_t v = 0; v < mesh.vert.size(); v++) {
    const double value = static_cast<double>(mesh.vert[v].cQ());
    if (has_result(statuses[v])) values.push_back(about_zero ? std::abs(value) : value);
  }
  double low = -1.0, high = 1.0;
  if (subject != Subject::shape_index) {
    high = quantile(values, percentile / 100.0);
    if (about_zero) {
      // Where most or all is flat there still is a scale.
      if (high == 0.0) high = quantile(values, 1.0);
      if (high == 0.0) high = 1.0;
    } else {
      low = quantile(values, 1.0 - percentile / 100.0);
    }
  }
  for (std::size_t v = 0; v < mesh.vert.size(); v++) {
    vcg::Color4b &color = mesh.vert[v].C();
    if (!has_result(statuses[v])) {
      color = no_color();
    } else if (about_zero) {
      color = diverging_color(static_cast<double>(mesh.vert[v].cQ()) / high);
    } else {
      color.SetColorRamp(static_cast<float>(low), static_cast<float>(high), mesh.vert[v].cQ());
    }
  }
}

/** Where the quality is computed; k1 and k2 are computed elsewhere already. */
void ask_for_quality(umbilic::curvature_outputs &into, Subject subject, CMeshO &mesh) {
  switch (subject) {
    case Subject::mean: into.mean = qualities_of(mesh); break;
    case Subject::gaussian: into.gaussian = qualities_of(mesh); break;
    case Subject::shape_index: into.shape_index = qualities_of(mesh); break;
    case Subject::curvedness: into.curvedness = qualities_of(mesh); break;
    case Subject::k1:
    case Subject::k2:
    case Subject::none: break;
  }
}

void clear_directions(CMeshO &mesh) {
  for (CVertexO &vertex : mesh.vert) vertex.PD1() = vertex.PD2() = Point3m(0, 0, 0);
}

void clear_curvatures(CMeshO &mesh) {
  for (CVertexO &vertex : mesh.vert) vertex.K1() = vertex.K2() = 0;
  clear_directions(mesh);
}

bool has(umbilic::quantities some, umbilic::quantities one) { return (some & one) != umbilic::quantities{}; }

}  // namespace

FilterUmbilic::FilterUmbilic() {
  typeList = {NORMALS, CURVATURE, SEGMENTATION};
  for (const FilterIDType filter : typeList) actionList.append(new QAction(filterName(filter), this));
}

QString FilterUmbilic::pluginName() const { return "FilterUmbilic"; }

QString FilterUmbilic::filterName(FilterIDType filter) const {
  switch (filter) {
    case NORMALS: return "Umbilic: vertex normals";
    case CURVATURE: return "Umbilic: curvature";
    case SEGMENTATION: return "Umbilic: segmentation";
    default: return QString();
  }
}

QString FilterUmbilic::filterInfo(FilterIDType filter) const {
  const QString polygons =
      "<br>Faces that are joined across faux edges count as the polygons that they are. The layer's matrix is not applied: freeze it first "
      "if results are to be those of the mesh as shown.";
  switch (filter) {
    case NORMALS:
      return "Computes unit vertex normals, by one of ten averages over the faces around a vertex or by a fit. They point to the side from which "
             "faces run counter-clockwise, and are 0 where a vertex has no face, or none with an area." +
             polygons;
    case CURVATURE:
      return "Computes the curvature of the surface at each vertex: principal curvatures k1 ≥ k2, in 1/length, and their directions, which become "
             "the layer's curvature directions (PD1 with K1, PD2 with K2), and what is chosen as quality and colors. Positive where the surface bends "
             "away from its normal: with faces that run counter-clockwise seen from outside, a ball of radius r has k1 = k2 = 1/r." +
             polygons;
    case SEGMENTATION:
      return "Cuts the mesh into segments: a label from 0 for each face, in the order of their first faces, becomes its quality and its color; -1 and "
             "gray are faces with fewer than three distinct corners. The method and what follows it are for watershed and regions: they say how "
             "curvatures are estimated." +
             polygons;
    default: return QString();
  }
}

MeshFilterInterface::FilterClass FilterUmbilic::getClass(QAction *action) {
  switch (ID(action)) {
    case CURVATURE: return FilterClass(Normal | Quality | VertexColoring);
    case SEGMENTATION: return FilterClass(Quality | FaceColoring);
    default: return Normal;
  }
}

MeshFilterInterface::FILTER_ARITY FilterUmbilic::filterArity(QAction *) const { return SINGLE_MESH; }

int FilterUmbilic::getPreConditions(QAction *) const { return MeshModel::MM_FACENUMBER; }

int FilterUmbilic::postCondition(QAction *action) const {
  switch (ID(action)) {
    case CURVATURE: return MeshModel::MM_VERTCURVDIR | MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR;
    case SEGMENTATION: return MeshModel::MM_FACEQUALITY | MeshModel::MM_FACECOLOR;
    default: return MeshModel::MM_VERTNORMAL;
  }
}

// The document may be without a mesh, where there is no dialog.
void FilterUmbilic::initParameterSet(QAction *action, MeshDocument &document, RichParameterList &parameters) {
  const float diagonal = document.mm() == nullptr ? 0.0f : static_cast<float>(document.mm()->cm.bbox.Diag());
  switch (ID(action)) {
    case NORMALS: add_normal_parameters(parameters); break;
    case CURVATURE:
      add_color_parameters(parameters);
      add_method_parameters(parameters, diagonal);
      break;
    case SEGMENTATION:
      add_segment_parameters(parameters);
      add_method_parameters(parameters, diagonal);
      break;
    default: break;
  }
}

// MeshLab shows `errorMessage`, meshlabserver nothing but the log.
bool FilterUmbilic::applyFilter(QAction *action, MeshDocument &document, const RichParameterList &given, vcg::CallBackPos *callback) {
  const std::string name = filterName(ID(action)).toStdString();
  errorMessage.clear();
  try {
    MeshModel *model = document.mm();
    if (model == nullptr) throw std::invalid_argument("there is no mesh");
    compact(model->cm);
    if (model->cm.face.empty()) throw std::invalid_argument("the mesh has no faces");
    if (model->cm.Tr != Matrix44m::Identity()) Log("%s: the layer's matrix is not applied", name.c_str());
    const auto progress = [&](double fraction) { return callback == nullptr || callback(static_cast<int>(100.0 * fraction), name.c_str()); };
    switch (ID(action)) {
      case NORMALS: normals(*model, given, progress); break;
      case CURVATURE: curvature(*model, given, progress); break;
      case SEGMENTATION: segmentation(*model, given, progress); break;
      default: throw std::invalid_argument("there is no such filter");
    }
    return true;
  } catch (const std::exception &error) {
    errorMessage = QString::fromUtf8(error.what());
    Log(GLLogStream::WARNING, "%s: %s", name.c_str(), error.what());
    return false;
  }
}

void FilterUmbilic::normals(MeshModel &model, const RichParameterList &given, umbilic::progress_reference progress) {
  CMeshO &mesh = model.cm;
  umbilic::normal_options options = normal_options_of(given);
  options.progress = progress;
  Stopwatch watch;
  const mesh_faces faces = faces_of(mesh);
  const double faces_ms = watch.lap();
  std::vector<std::uint8_t> statuses(mesh.vert.size());
  umbilic::normal_outputs into;
  into.normal = normals_of(mesh);
  into.status = statuses;
  umbilic::vertex_normals(umbilic::faces(faces.polygons), positions_of(mesh), into, options);
  const double library_ms = watch.lap();
  model.updateDataMask(MeshModel::MM_VERTNORMAL);
  tell(mesh, faces.polygons.size(), faces_ms, library_ms, watch.lap());
  tell_of_missing(statuses);
}

void FilterUmbilic::curvature(MeshModel &model, const RichParameterList &given, umbilic::progress_reference progress) {
  CMeshO &mesh = model.cm;
  umbilic::curvature_options options = method_of(given, mesh);
  options.progress = progress;
  const Subject subject = choice(given, "quality", Subject::none);
  const Colors colors = choice(given, "colors", Colors::none);
  const double percentile = percentage(given, "percentile");
  const umbilic::quantities of_method = umbilic::quantity::of_method(options.method);
  const bool has_principal = has(of_method, umbilic::quantity::k1), has_directions = has(of_method, umbilic::quantity::direction1);
  if (!has_principal && (subject == Subject::k1 || subject == Subject::k2)) throw std::invalid_argument("the method has no principal curvatures");
  Stopwatch watch;
  const mesh_faces faces = faces_of(mesh);
  const double faces_ms = watch.lap();

  umbilic::curvature_outputs into;
  if (has_principal) {
    // What is enabled starts as anything at all.
    const bool is_new = !mesh.vert.IsCurvatureDirEnabled();
    model.updateDataMask(MeshModel::MM_VERTCURVDIR);
    if (is_new) clear_curvatures(mesh);
    const principal_curvatures principal(mesh);
    into.k1 = principal.k1;
    into.k2 = principal.k2;
    if (has_directions) {
      into.direction1 = principal.direction1;
      into.direction2 = principal.direction2;
    }
  }
  ask_for_quality(into, subject, mesh);
  std::vector<std::uint8_t> statuses(mesh.vert.size());
  into.status = statuses;
  double rest_ms = watch.lap();
  const umbilic::topology rings(faces.polygons, mesh.vert.size());
  umbilic::curvatures(rings, positions_of(mesh), into, options);
  const double library_ms = watch.lap();

  // Not what another method left.
  if (has_principal && !has_directions) clear_directions(mesh);
  if (subject == Subject::k1 || subject == Subject::k2) {
    for (CVertexO &vertex : mesh.vert) vertex.Q() = static_cast<float>(subject == Subject::k1 ? vertex.K1() : vertex.K2());
  }
  if (subject != Subject::none) {
    model.updateDataMask(MeshModel::MM_VERTQUALITY);
    if (colors != Colors::none) {
      color_vertices(mesh, statuses, subject, colors, percentile);
      model.updateDataMask(MeshModel::MM_VERTCOLOR);
    }
  }
  tell(mesh, faces.polygons.size(), faces_ms, library_ms, rest_ms + watch.lap());
  tell_of_missing(statuses);
}

void FilterUmbilic::segmentation(MeshModel &model, const RichParameterList &given, umbilic::progress_reference progress) {
  CMeshO &mesh = model.cm;
  const umbilic::curvature_options method = method_of(given, mesh);
  const umbilic::creases creases(decimal(given, "creaseAngle") * (M_PI / 180.0));
  Stopwatch watch;
  const mesh_faces faces = faces_of(mesh);
  const double faces_ms = watch.lap();

  umbilic::segmentation found;
  const auto cut = [&](auto &options) {
    options.progress = progress;
    found = umbilic::segment(faces.polygons, positions_of(mesh), options);
  };
  switch (choice(given, "by", Segments::regions)) {
    case Segments::features: {
      umbilic::feature_options options;
      options.creases = &creases;
      cut(options);
      break;
    }
    case Segments::watershed: {
      umbilic::watershed_options options;
      options.depth = decimal(given, "depth");
      options.curvature = &method;
      cut(options);
      break;
    }
    case Segments::regions: {
      umbilic::region_options options;
      options.tolerance = decimal(given, "tolerance");
      options.smallest_share = decimal(given, "smallestShare");
      options.smallest_faces = count(given, "smallestFaces");
      options.creases = &creases;
      options.curvature = &method;
      cut(options);
      break;
    }
  }
  const double library_ms = watch.lap();

  model.updateDataMask(MeshModel::MM_FACEQUALITY | MeshModel::MM_FACECOLOR);
  std::vector<vcg::Color4b> palette;
  for (std::size_t label = 0; label < found.count(); label++) palette.push_back(label_color(static_cast<std::uint32_t>(label)));
  const umbilic::span<const std::uint32_t> labels = found.labels();
  for (std::size_t triangle = 0; triangle < mesh.face.size(); triangle++) {
    const std::uint32_t label = labels[faces.face(triangle)];
    const bool is_in_one = label != UMB_NO_SEGMENT;
    mesh.face[triangle].Q() = is_in_one ? static_cast<float>(label) : -1.0f;
    mesh.face[triangle].C() = is_in_one ? palette[label] : no_color();
  }
  tell(mesh, faces.polygons.size(), faces_ms, library_ms, watch.lap());
  Log("Umbilic: %zu segments", found.count());
}

void FilterUmbilic::tell(const CMeshO &mesh, std::size_t faces, double faces_ms, double library_ms, double rest_ms) {
  Log("Umbilic: %zu vertices, %zu faces of %zu triangles; %.1f ms in the library, %.1f ms to build faces, %.1f ms else", mesh.vert.size(), faces,
      mesh.face.size(), library_ms, faces_ms, rest_ms);
}

void FilterUmbilic::tell_of_missing(const std::vector<std::uint8_t> &statuses) {
  const auto missing = std::count_if(statuses.begin(), statuses.end(), [](std::uint8_t status) { return !has_result(status); });
  if (missing > 0) Log("Umbilic: %zu vertices have no result: no face, or none with an area", static_cast<std::size_t>(missing));
}

/*
 * umbilic for OpenMesh: normals, curvatures and segments in the mesh's own properties. For any mesh over OpenMesh's array kernel,
 * of triangles or polygons, in float or double. Header only; link with umbilic and OpenMeshCore.
 *
 *   umbilic::openmesh::vertex_normals(mesh);                    // N_CM, to the vertex normals
 *   umbilic::openmesh::vertex_normals(mesh, UMB_WEIGHT_ANGLE);
 *   umbilic::openmesh::curvatures(mesh);                        // adaptive jets, to "v:k1", "v:k2", "v:dir1", ...
 *   umbilic::openmesh::halfedge_normals(mesh);                  // split at creases, to the halfedge normals
 *   umbilic::openmesh::segment(mesh, umbilic::region_options());  // to "f:segment"
 *
 * Where positions move and faces stay, build the topology once and hand it in.
 *
 * Copies. Faces are copied out for each topology (4 bytes a corner), because OpenMesh keeps halfedges; the copy is freed once the topology
 * stands. Positions and results stay where they are, in the mesh's arrays, if the mesh's vectors are three `float` or `double`, as they are
 * by default; else they are converted by way of an array of doubles. Halfedge normals and labels of segments are copied from where they
 * were computed.
 *
 * Deleted elements, before `garbage_collection()`: deleted faces count for nothing, and results of deleted elements stay what they were,
 * unless the caller's own list names one: zeros are written there. Positions of deleted vertices make no difference: where they lie outside
 * the box of the others, or are not finite, positions are copied.
 *
 * Errors are thrown, as `umbilic::error` (see umbilic.hpp). A property that has one of the names but another type is left alone, and another
 * added beside it.
 *
 * A module for OpenMesh's decimaters is in umbilic/openmesh_decimater.hpp.
 */
#ifndef UMBILIC_OPENMESH_HPP
#define UMBILIC_OPENMESH_HPP

#include <umbilic.hpp>

#include <algorithm>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

namespace umbilic {
inline namespace UMBILIC_VARIANT {
namespace openmesh {

namespace detail {

template <class Vector>
constexpr bool IN_PLACE = umbilic::detail::IS_VECTOR<Vector, 3>;

/** The scalar of results: that of the mesh if it is float, else double. */
template <class Mesh>
using scalar = std::conditional_t<std::is_same_v<typename Mesh::Scalar, float>, float, double>;

/** The vectors of results: those of the mesh's normals if they are three float or double in a row. */
template <class Mesh>
using vector = std::conditional_t<IN_PLACE<typename Mesh::Normal>, typename Mesh::Normal, OpenMesh::VectorT<scalar<Mesh>, 3>>;

template <class Mesh>
bool has_deleted_vertices(const Mesh &mesh) {
  return mesh.has_vertex_status() && std::any_of(mesh.vertices_begin(), mesh.vertices_end(),
                                                 [&](auto vertex) { return mesh.status(vertex).deleted(); });
}

/** Positions as calls take them, with what had to be copied. Those of deleted vertices make no difference. */
template <class Mesh>
class positions {
  using Point = typename Mesh::Point;

 public:
  explicit positions(const Mesh &mesh) : positions(mesh, has_deleted_vertices(mesh)) {}
  positions(const Mesh &mesh, bool had_gaps) {
    const bool has_gaps = had_gaps && mesh.has_vertex_status(); // a mesh of before is refused by its size
    const auto exists = [&](std::size_t v) { return !mesh.status(mesh.vertex_handle(static_cast<unsigned>(v))).deleted(); };
    if constexpr (IN_PLACE<Point>) {
      view_ = points(mesh.points(), mesh.n_vertices());
      if (!has_gaps || umbilic::detail::gaps_make_no_difference(mesh.points(), mesh.n_vertices(), exists)) return;
    }
    copied_.reserve(mesh.n_vertices());
    for (std::size_t v = 0; v < mesh.n_vertices(); v++) {
      const Point &point = mesh.points()[v];
      copied_.push_back({static_cast<Scalar>(point[0]), static_cast<Scalar>(point[1]), static_cast<Scalar>(point[2])});
    }
    if (has_gaps) umbilic::detail::fill_gaps(copied_, exists);
    view_ = points(copied_);
  }
  positions(const positions &) = delete;
  operator const points &() const noexcept { return view_; }

 private:
  using Scalar = std::conditional_t<IN_PLACE<Point>, scalar<Mesh>, double>;

  std::vector<std::array<Scalar, 3>> copied_;
  points view_;
};

template <class Mesh, class Property>
void have(Mesh &mesh, Property &property, const char *name) {
  if (!mesh.get_property_handle(property, name)) mesh.add_property(property, name);
}

template <class Mesh, class Property>
auto &array_of(Mesh &mesh, Property property) {
  return mesh.property(property).data_vector();
}

}  // namespace detail

// ---- what stays while positions move ----

/** The faces of a mesh, deleted ones left out: copies 4 bytes a corner. Corners run as `mesh.fh_range()` does, at the `to` vertices. */
template <class Mesh>
polygons polygons_of(const Mesh &mesh) {
  polygons loops;
  loops.reserve(mesh.n_halfedges());
  for (const auto face : mesh.faces()) {
    for (const auto halfedge : mesh.fh_range(face)) {
      loops.add_corner(static_cast<std::uint64_t>(mesh.to_vertex_handle(halfedge).idx()));
    }
    loops.end_face();
  }
  return loops;
}

/** The one-rings of a mesh, for the calls below and for those of umbilic.hpp. Good until faces change. */
template <class Mesh>
host_topology build_topology(const Mesh &mesh, const topology_options &options = topology_options()) {
  std::vector<std::uint32_t> existing;
  const bool has_gaps = detail::has_deleted_vertices(mesh);
  if (has_gaps) {
    for (const auto vertex : mesh.vertices()) existing.push_back(static_cast<std::uint32_t>(vertex.idx()));
  }
  return host_topology(topology(polygons_of(mesh), mesh.n_vertices(), options), has_gaps, std::move(existing));
}

// ---- normals ----

/**
 * Unit vertex normals, into the mesh's own, which are requested if it has none.
 *
 * @param weight_or_options N_CM if left out
 * @param statuses may receive `UMB_VERTEX_` bits, `#V`
 */
template <class Mesh>
void vertex_normals(Mesh &mesh, const host_topology &rings, const normal_options &weight_or_options = normal_options(),
                    const byte_output &statuses = byte_output()) {
  if (!mesh.has_vertex_normals()) mesh.request_vertex_normals();
  const normal_options options = rings.restrict_to_existing(weight_or_options);
  const detail::positions<Mesh> where(mesh, rings.has_gaps());
  normal_outputs into;
  into.status = statuses;
  if constexpr (detail::IN_PLACE<typename Mesh::Normal>) {
    into.normal = detail::array_of(mesh, mesh.vertex_normals_pph());
    umbilic::vertex_normals(rings, where, into, options);
  } else {
    std::vector<std::array<double, 3>> normals(mesh.n_vertices());
    into.normal = normals;
    umbilic::vertex_normals(rings, where, into, options);
    const auto take = [&](std::size_t v) {
      typename Mesh::Normal &normal = detail::array_of(mesh, mesh.vertex_normals_pph())[v];
      for (std::size_t k = 0; k < 3; k++) normal[k] = static_cast<std::decay_t<decltype(normal[0])>>(normals[v][k]);
    };
    if (options.run.vertices == nullptr) {
      for (std::size_t v = 0; v < normals.size(); v++) take(v);
    } else {
      for (std::size_t i = 0; i < options.run.vertex_count; i++) take(options.run.vertices[i]);
    }
  }
}

/** Likewise, with a topology for this call alone. */
template <class Mesh>
void vertex_normals(Mesh &mesh, const normal_options &weight_or_options = normal_options(), const byte_output &statuses = byte_output()) {
  vertex_normals(mesh, build_topology(mesh), weight_or_options, statuses);
}

/**
 * Unit corner normals, split at creases, into the mesh's own halfedge normals, which are requested if it has none: that of a halfedge belongs to
 * the corner of its face at its `to` vertex. Those of boundary halfedges stay what they were.
 *
 * @param where which edges are creases: by angle, marked, between smoothing groups (one for each face of the mesh, deleted ones included)
 * @param features whether edges whose status is `feature` are marked as well; where there are any, an angle counts only if it is given
 *
 * Copies an element for each vertex of the cut mesh.
 */
template <class Mesh>
void halfedge_normals(Mesh &mesh, const creases &where = creases(), const normal_options &weight_or_options = normal_options(),
                      bool features = true) {
  using Scalar = detail::scalar<Mesh>;
  creases all = where;
  std::vector<std::uint32_t> marked, groups;
  if (features && mesh.has_edge_status()) {
    for (const auto edge : mesh.edges()) {
      if (!mesh.status(edge).feature()) continue;
      const auto halfedge = mesh.halfedge_handle(edge, 0);
      marked.push_back(static_cast<std::uint32_t>(mesh.from_vertex_handle(halfedge).idx()));
      marked.push_back(static_cast<std::uint32_t>(mesh.to_vertex_handle(halfedge).idx()));
    }
    // Edges that are no pairs are left for the call to refuse.
    if (!marked.empty() && where.edge_count != umbilic::detail::NONE) {
      if (where.edges != nullptr) marked.insert(marked.end(), where.edges, where.edges + 2 * where.edge_count);
      all.mark(marked);
    }
  }
  const polygons loops = polygons_of(mesh);
  if (where.groups != nullptr && where.group_count == mesh.n_faces() && loops.size() < mesh.n_faces()) {
    for (const auto face : mesh.faces()) groups.push_back(where.groups[static_cast<std::size_t>(face.idx())]);
    all.group(groups);
  }

  const detail::positions<Mesh> positions(mesh);
  const cut_mesh cut(loops, positions, all);
  std::vector<std::array<Scalar, 3>> normals(cut.vertex_count());
  corner_outputs into;
  into.normal = normals;
  corner_normals(cut, positions, into, weight_or_options);
  if (!mesh.has_halfedge_normals()) mesh.request_halfedge_normals();
  const span<const std::uint32_t> corners = cut.corners();
  std::size_t corner = 0;
  for (const auto face : mesh.faces()) {
    for (const auto halfedge : mesh.fh_range(face)) {
      const std::array<Scalar, 3> &normal = normals[corners[corner++]];
      typename Mesh::Normal copied;
      for (std::size_t k = 0; k < 3; k++) copied[k] = static_cast<std::decay_t<decltype(copied[0])>>(normal[k]);
      mesh.set_normal(halfedge, copied);
    }
  }
}

// ---- curvatures ----

/** Where `curvatures` has written: invalid handles where nothing was wanted. All others are found by name (see `quantity`). */
template <class Mesh>
struct curvature_properties {
  OpenMesh::VPropHandleT<detail::scalar<Mesh>> k1, k2, mean, gauss;
  OpenMesh::VPropHandleT<detail::vector<Mesh>> dir1, dir2;
};

/**
 * Curvatures at the vertices, into properties of these names, which are added if need be: "v:k1", "v:k2", "v:mean" (1/length), "v:gauss"
 * (1/length^2), "v:dir1", "v:dir2" (unit vectors), and what else is wanted.
 *
 * Scalars and vectors have the mesh's types, if these are float or double.
 *
 * @param options the method; adaptive jets if left out
 * @param wanted `quantity` bits; by default those of the six above that the method has
 */
template <class Mesh>
curvature_properties<Mesh> curvatures(Mesh &mesh, const host_topology &rings, const curvature_options &options = curvature_options(),
                                      quantities wanted = quantity::default_ones) {
  using Number = OpenMesh::VPropHandleT<detail::scalar<Mesh>>;
  using Vector = OpenMesh::VPropHandleT<detail::vector<Mesh>>;
  if (wanted == quantity::default_ones) wanted = quantity::of_method(options.method);
  curvature_properties<Mesh> found;
  curvature_outputs into;
  for (const auto &named : umbilic::detail::NAMED_NUMBERS) {
    if (!umbilic::detail::has(wanted, named.bit)) continue;
    Number property;
    detail::have(mesh, property, named.name);
    into.*named.output = detail::array_of(mesh, property);
    if (named.bit == quantity::k1) found.k1 = property;
    if (named.bit == quantity::k2) found.k2 = property;
    if (named.bit == quantity::mean) found.mean = property;
    if (named.bit == quantity::gaussian) found.gauss = property;
  }
  for (const auto &named : umbilic::detail::NAMED_VECTORS) {
    if (!umbilic::detail::has(wanted, named.bit)) continue;
    Vector property;
    detail::have(mesh, property, named.name);
    into.*named.output = detail::array_of(mesh, property);
    if (named.bit == quantity::direction1) found.dir1 = property;
    if (named.bit == quantity::direction2) found.dir2 = property;
  }
  if (umbilic::detail::has(wanted, quantity::status)) {
    OpenMesh::VPropHandleT<std::uint8_t> property;
    detail::have(mesh, property, umbilic::detail::STATUS_NAME);
    into.status = detail::array_of(mesh, property);
  }
  const detail::positions<Mesh> positions(mesh, rings.has_gaps());
  umbilic::curvatures(rings, positions, into, rings.restrict_to_existing(options));
  return found;
}

/** Likewise, with a topology for this call alone. */
template <class Mesh>
curvature_properties<Mesh> curvatures(Mesh &mesh, const curvature_options &options = curvature_options(),
                                      quantities wanted = quantity::default_ones) {
  return curvatures(mesh, build_topology(mesh), options, wanted);
}

/** Numbers at vertices in a property, to read: heights of a watershed, say. */
template <class Mesh, class Scalar>
scalars numbers_in(const Mesh &mesh, OpenMesh::VPropHandleT<Scalar> property) {
  return scalars(mesh.property(property).data_vector());
}

// ---- segments ----

/**
 * Segments of a mesh, into the face property "f:segment" (`std::uint32_t`, `UMB_NO_SEGMENT` for faces that are ignored), which is added if
 * need be. The way goes with the options: `feature_options`, `watershed_options`, `region_options`.
 *
 * What options hold for each face (heights, groups) goes by existing faces. Copies a label for each face.
 *
 * Answers with the segments: their number, boundary edges (in the mesh's vertices); areas and means by `polygons_of`.
 */
template <class Mesh, class Options>
segmentation segment(Mesh &mesh, const Options &options) {
  const detail::positions<Mesh> positions(mesh);
  segmentation found = umbilic::segment(polygons_of(mesh), positions, options);
  OpenMesh::FPropHandleT<std::uint32_t> property;
  detail::have(mesh, property, "f:segment");
  const span<const std::uint32_t> labels = found.labels();
  std::size_t number = 0;
  for (const auto face : mesh.faces()) mesh.property(property, face) = labels[number++];
  return found;
}

}  // namespace openmesh
}  // namespace UMBILIC_VARIANT
}  // namespace umbilic

#endif  // UMBILIC_OPENMESH_HPP

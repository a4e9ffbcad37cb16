/*
 * umbilic for CGAL: normals, curvatures and segments in property maps. For CGAL::Surface_mesh, and for any model of FaceGraph with points at
 * its vertices (Polyhedron_3, Linear_cell_complex, OpenMesh by way of CGAL ...). Header only; link with umbilic and what CGAL needs.
 *
 *   auto normals = umbilic::cgal::vertex_normals(mesh);                  // N_CM, "v:normal"
 *   auto found = umbilic::cgal::curvatures(mesh);                        // adaptive jets: found.k1 ("v:k1"), found.dir1 ("v:dir1"), ...
 *   umbilic::cgal::segment(mesh, umbilic::region_options());             // "f:segment"
 *
 *   umbilic::cgal::vertex_normals(polyhedron, normal_map, UMB_WEIGHT_ANGLE);
 *   umbilic::cgal::curvatures(polyhedron, umbilic::curvature_options(), umbilic::cgal::to(umbilic::quantity::k1, k1_map));
 *
 * Where positions move and faces stay, build the topology once and hand it in.
 *
 * Copies. Faces are copied out for each topology (4 bytes a corner), because CGAL keeps halfedges; the copy is freed once the topology stands.
 * Points of Surface_mesh whose kernel has three `double` or `float` in a row (Simple_cartesian, EPICK) are read where they are, and results
 * written into maps of Surface_mesh where they belong. Everything else is converted: points by CGAL::to_double (EPECK: the exact
 * value is rounded), results by way of an array and `put`. Labels of segments and halfedge normals are copied.
 *
 * Removed elements of Surface_mesh, before `collect_garbage()`: removed faces count for nothing, and results of removed elements stay what they were,
 * unless the caller's own list names one: zeros are written there. Positions of removed vertices make no difference: where they lie
 * outside the box of the others, or are not finite, positions are copied.
 *
 * Vertices are numbered (in lists, statuses, boundary edges) as in Surface_mesh, `idx()`, and in other graphs in the order of `vertices(graph)`;
 * faces in the order of `faces(graph)`. Errors are thrown, as `umbilic::error` (see umbilic.hpp).
 */
#ifndef UMBILIC_CGAL_HPP
#define UMBILIC_CGAL_HPP

#include <umbilic.hpp>

#include <tuple>

#include <CGAL/Kernel_traits.h>
#include <CGAL/Point_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Vector_3.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

namespace umbilic {
inline namespace UMBILIC_VARIANT {

namespace detail {

/** Whether points and vectors of a kernel are three float or double in a row. */
template <class Kernel, class Vector>
constexpr bool IS_CARTESIAN = [] {
  if constexpr (IS_SCALAR<typename Kernel::FT> && std::is_same_v<typename Kernel::Rep_tag, CGAL::Cartesian_tag>) {
    return sizeof(Vector) == 3 * sizeof(typename Kernel::FT) && HOLDS_ITS_SCALARS<Vector>;
  } else {
    return false;
  }
}();

template <class Kernel, class Vector>
struct cartesian_traits {
  using scalar = std::conditional_t<IS_CARTESIAN<Kernel, Vector>, typename Kernel::FT, void>;
  static constexpr std::size_t size = IS_CARTESIAN<Kernel, Vector> ? 3 : 0;
};

}  // namespace detail

template <class Kernel>
struct vector_traits<CGAL::Point_3<Kernel>> : detail::cartesian_traits<Kernel, CGAL::Point_3<Kernel>> {};
template <class Kernel>
struct vector_traits<CGAL::Vector_3<Kernel>> : detail::cartesian_traits<Kernel, CGAL::Vector_3<Kernel>> {};

namespace cgal {

namespace detail {

template <class Graph>
constexpr bool IS_SURFACE_MESH = false;
template <class Point>
constexpr bool IS_SURFACE_MESH<CGAL::Surface_mesh<Point>> = true;

template <class Graph>
using vertex_of = typename boost::graph_traits<Graph>::vertex_descriptor;
template <class Graph>
using point_map_of = std::remove_cv_t<std::remove_reference_t<typename boost::property_map<Graph, CGAL::vertex_point_t>::const_type>>;

template <class Map, class = void>
constexpr bool IS_MAP = false;
template <class Map>
constexpr bool IS_MAP<Map, std::void_t<typename Map::key_type, typename Map::value_type>> = true;
template <class Map>
using if_map = std::enable_if_t<IS_MAP<Map>, int>;

/** Whether a map is a property of a Surface_mesh's vertices, whose elements lie in one array by `idx()`. */
template <class Graph, class Map>
constexpr bool is_array() {
  if constexpr (IS_SURFACE_MESH<Graph> && IS_MAP<Map>) {
    return std::is_same_v<Map, typename Graph::template Property_map<typename Graph::Vertex_index, typename Map::value_type>>;
  } else {
    return false;
  }
}

/** The number of elements that arrays by vertex have, removed vertices included. */
template <class Graph>
std::size_t slots(const Graph &graph) {
  if constexpr (IS_SURFACE_MESH<Graph>) {
    return static_cast<std::size_t>(graph.number_of_vertices()) + graph.number_of_removed_vertices();
  } else {
    const auto all = vertices(graph);
    return static_cast<std::size_t>(std::distance(all.begin(), all.end()));
  }
}

/** Calls `visit(vertex, slot)` for every vertex that is there. */
template <class Graph, class Visit>
void for_each_vertex(const Graph &graph, Visit visit) {
  std::size_t number = 0;
  for (const auto vertex : vertices(graph)) {
    if constexpr (IS_SURFACE_MESH<Graph>) {
      visit(vertex, static_cast<std::size_t>(vertex.idx()));
    } else {
      visit(vertex, number++);
    }
  }
}

/** The array of a property; CGAL asks that of an empty one for its first element. */
template <class Map>
const typename Map::value_type *data_of(const Map &map, std::size_t count) {
  return count == 0 ? nullptr : map.data();
}

/** Whether a map's keys are vertices: the array of any other property is too short, or too long. */
template <class Graph, class Map>
constexpr bool TAKES_VERTICES = std::is_convertible_v<vertex_of<Graph>, typename boost::property_traits<Map>::key_type>;

/** Whether the vertex of a number has not been removed. */
template <class Point>
auto existence_in(const CGAL::Surface_mesh<Point> &mesh) {
  return [&mesh](std::size_t number) {
    using Vertex = typename CGAL::Surface_mesh<Point>::Vertex_index;
    return !mesh.is_removed(Vertex(static_cast<typename Vertex::size_type>(number)));
  };
}

/** Positions as calls take them, with what had to be copied. Those of removed vertices make no difference. */
template <class Graph, class PointMap>
class positions {
  static_assert(TAKES_VERTICES<Graph, PointMap>, "points belong to vertices");
  using Point = std::decay_t<typename boost::property_traits<PointMap>::value_type>;
  static constexpr bool IN_PLACE = is_array<Graph, PointMap>() && umbilic::detail::IS_VECTOR<Point, 3>;
  using Scalar = std::conditional_t<IN_PLACE, typename vector_traits<Point>::scalar, double>;

 public:
  positions(const Graph &graph, const PointMap &map) : map_(map) {
    const std::size_t count = slots(graph);
    if constexpr (IN_PLACE) {
      view_ = points(data_of(map_, count), count);
      if (graph.number_of_removed_vertices() == 0) return;
      if (umbilic::detail::gaps_make_no_difference(data_of(map_, count), count, existence_in(graph))) return;
    }
    copied_.resize(count);
    for_each_vertex(graph, [&](const auto &vertex, std::size_t slot) {
      const auto &point = get(map, vertex);
      copied_[slot] = {static_cast<Scalar>(CGAL::to_double(point.x())), static_cast<Scalar>(CGAL::to_double(point.y())),
                       static_cast<Scalar>(CGAL::to_double(point.z()))};
    });
    if constexpr (IS_SURFACE_MESH<Graph>) {
      if (graph.number_of_removed_vertices() > 0) umbilic::detail::fill_gaps(copied_, existence_in(graph));
    }
    view_ = points(copied_);
  }
  positions(const positions &) = delete;
  operator const points &() const noexcept { return view_; }

 private:
  PointMap map_;
  std::vector<std::array<Scalar, 3>> copied_;
  points view_;
};

/** A host's vector: a class of a kernel's, or an aggregate of three scalars. */
template <class Vector>
Vector vector_from(const std::array<double, 3> &values) {
  if constexpr (std::is_constructible_v<Vector, double, double, double>) {
    return Vector(values[0], values[1], values[2]);
  } else {
    using Scalar = typename vector_traits<Vector>::scalar;
    return Vector{static_cast<Scalar>(values[0]), static_cast<Scalar>(values[1]), static_cast<Scalar>(values[2])};
  }
}

/** Results on their way to a map: its own array, or one that is put into it afterwards. */
template <class Graph, class Map>
class result {
  static_assert(TAKES_VERTICES<Graph, Map>, "results belong to vertices");

 public:
  using value = typename Map::value_type;
  static constexpr bool IS_BYTE = std::is_same_v<value, std::uint8_t>;
  static constexpr bool IS_NUMBER = std::is_arithmetic_v<value> && !IS_BYTE;
  static constexpr bool IN_PLACE =
      is_array<Graph, Map>() && (IS_BYTE || umbilic::detail::IS_SCALAR<value> || umbilic::detail::IS_VECTOR<value, 3>);
  using element = std::conditional_t<IS_BYTE, std::uint8_t, std::conditional_t<IS_NUMBER, double, std::array<double, 3>>>;

  result(const Graph &graph, const Map &map) : map_(map), room_(slots(graph)) {
    if constexpr (!IN_PLACE) copied_.resize(room_);
  }

  auto output() {
    using Output = std::conditional_t<IS_BYTE, byte_output, std::conditional_t<IS_NUMBER, numbers, vectors>>;
    if constexpr (IN_PLACE) {
      return Output(const_cast<value *>(data_of(map_, room_)), room_);
    } else {
      return Output(copied_.data(), room_);
    }
  }

  /** Puts into the map what was computed, for the vertices of the list if there is one. */
  void finish(const Graph &graph, const umb_run &run) {
    if constexpr (!IN_PLACE) {
      std::vector<bool> listed(run.vertices == nullptr ? 0 : room_);
      for (std::size_t i = 0; i < run.vertex_count; i++) listed[run.vertices[i]] = true;
      for_each_vertex(graph, [&](const auto &vertex, std::size_t slot) {
        if (!listed.empty() && !listed[slot]) return;
        if constexpr (IS_BYTE || IS_NUMBER) {
          put(map_, vertex, static_cast<value>(copied_[slot]));
        } else {
          put(map_, vertex, vector_from<value>(copied_[slot]));
        }
      });
    }
  }

 private:
  Map map_;
  std::size_t room_;
  std::vector<element> copied_;
};

/** The numbers of a graph's vertices, as lists and statuses have them. */
template <class Graph>
class numbers_of {
 public:
  explicit numbers_of(const Graph &graph) : numbers_(get(CGAL::dynamic_vertex_property_t<std::uint64_t>(), graph)) {
    for_each_vertex(graph, [&](const auto &vertex, std::size_t slot) { put(numbers_, vertex, static_cast<std::uint64_t>(slot)); });
  }
  std::uint64_t operator()(const vertex_of<Graph> &vertex) const { return get(numbers_, vertex); }

 private:
  typename boost::property_map<Graph, CGAL::dynamic_vertex_property_t<std::uint64_t>>::const_type numbers_;
};
template <class Point>
class numbers_of<CGAL::Surface_mesh<Point>> {
 public:
  explicit numbers_of(const CGAL::Surface_mesh<Point> &) {}
  std::uint64_t operator()(const vertex_of<CGAL::Surface_mesh<Point>> &vertex) const { return vertex.idx(); }
};

/** The kernel's vector, and a scalar that the C interface knows. */
template <class Point>
using vector_at = typename CGAL::Kernel_traits<Point>::Kernel::Vector_3;
template <class Point>
using scalar_at = std::conditional_t<std::is_same_v<typename CGAL::Kernel_traits<Point>::Kernel::FT, float>, float, double>;

template <class Point, class Value>
using vertex_map = typename CGAL::Surface_mesh<Point>::template Property_map<typename CGAL::Surface_mesh<Point>::Vertex_index, Value>;

}  // namespace detail

// ---- what stays while positions move ----

/** The faces of a graph, without removed ones: copies 4 bytes a corner. Corners are the targets of `halfedges_around_face`. */
template <class Graph>
polygons polygons_of(const Graph &graph) {
  using CGAL::faces;  // beside umbilic::faces
  polygons loops;
  const detail::numbers_of<Graph> number(graph);
  for (const auto face : faces(graph)) {
    for (const auto side : CGAL::halfedges_around_face(halfedge(face, graph), graph)) {
      loops.add_corner(number(target(side, graph)));
    }
    loops.end_face();
  }
  return loops;
}

/**
 * The edges that a map marks, such as `CGAL::Polygon_mesh_processing::detect_sharp_edges` fills, two vertices each, for `creases::mark`.
 *
 * @param is_marked from edges to `bool`
 */
template <class Graph, class EdgeMap>
std::vector<std::array<std::uint32_t, 2>> marked_edges(const Graph &graph, const EdgeMap &is_marked) {
  std::vector<std::array<std::uint32_t, 2>> marked;
  const detail::numbers_of<Graph> number(graph);
  for (const auto edge : edges(graph)) {
    if (!get(is_marked, edge)) continue;
    marked.push_back({static_cast<std::uint32_t>(number(source(edge, graph))), static_cast<std::uint32_t>(number(target(edge, graph)))});
  }
  return marked;
}

/** The one-rings of a graph, for the calls below and for those of umbilic.hpp. Good until faces change. */
template <class Graph>
host_topology build_topology(const Graph &graph, const topology_options &options = topology_options()) {
  std::vector<std::uint32_t> existing;
  bool has_gaps = false;
  if constexpr (detail::IS_SURFACE_MESH<Graph>) {
    has_gaps = graph.number_of_removed_vertices() > 0;
    if (has_gaps) {
      detail::for_each_vertex(graph, [&](const auto &, std::size_t slot) { existing.push_back(static_cast<std::uint32_t>(slot)); });
    }
  }
  return host_topology(topology(polygons_of(graph), detail::slots(graph), options), has_gaps, std::move(existing));
}

// ---- normals ----

/**
 * Unit vertex normals into a map.
 *
 * @param map from vertices to vectors that three doubles make, as the kernel's do
 * @param weight_or_options N_CM if left out
 * @param point_map from vertices to points
 * @param statuses may receive `UMB_VERTEX_` bits, by the number of the vertex
 */
template <class Graph, class Map, class PointMap, detail::if_map<Map> = 0>
void vertex_normals(const Graph &graph, const host_topology &rings, Map map, const normal_options &weight_or_options,
                    const PointMap &point_map, const byte_output &statuses = byte_output()) {
  const normal_options options = rings.restrict_to_existing(weight_or_options);
  const detail::positions<Graph, PointMap> where(graph, point_map);
  detail::result<Graph, Map> normals(graph, map);
  normal_outputs into;
  into.normal = normals.output();
  into.status = statuses;
  umbilic::vertex_normals(rings, where, into, options);
  normals.finish(graph, options.run);
}
/** Likewise, with the graph's own points. */
template <class Graph, class Map, detail::if_map<Map> = 0>
void vertex_normals(const Graph &graph, const host_topology &rings, Map map,
                    const normal_options &weight_or_options = normal_options()) {
  vertex_normals(graph, rings, map, weight_or_options, get(CGAL::vertex_point, graph));
}
/** Likewise, with a topology for this call alone. */
template <class Graph, class Map, class PointMap, detail::if_map<Map> = 0>
void vertex_normals(const Graph &graph, Map map, const normal_options &weight_or_options, const PointMap &point_map) {
  vertex_normals(graph, build_topology(graph), map, weight_or_options, point_map);
}
template <class Graph, class Map, detail::if_map<Map> = 0>
void vertex_normals(const Graph &graph, Map map, const normal_options &weight_or_options = normal_options()) {
  vertex_normals(graph, build_topology(graph), map, weight_or_options);
}

/** Unit vertex normals into the property "v:normal", the kernel's vectors, which is added if need be. */
template <class Point>
detail::vertex_map<Point, detail::vector_at<Point>> vertex_normals(CGAL::Surface_mesh<Point> &mesh, const host_topology &rings,
                                                                   const normal_options &weight_or_options = normal_options(),
                                                                   const byte_output &statuses = byte_output()) {
  using Vertex = typename CGAL::Surface_mesh<Point>::Vertex_index;
  const auto map = mesh.template add_property_map<Vertex, detail::vector_at<Point>>("v:normal").first;
  const CGAL::Surface_mesh<Point> &graph = mesh;
  vertex_normals(graph, rings, map, weight_or_options, get(CGAL::vertex_point, graph), statuses);
  return map;
}
/** Likewise, with a topology for this call alone. */
template <class Point>
detail::vertex_map<Point, detail::vector_at<Point>> vertex_normals(CGAL::Surface_mesh<Point> &mesh,
                                                                   const normal_options &weight_or_options = normal_options(),
                                                                   const byte_output &statuses = byte_output()) {
  return vertex_normals(mesh, build_topology(mesh), weight_or_options, statuses);
}

/**
 * Unit corner normals, split at creases, into a map from halfedges to vectors: that of a halfedge belongs to the corner of its face at its
 * target. Those of border halfedges stay what they were. Copies an element for each vertex of the cut mesh.
 */
template <class Graph, class Map, class PointMap, detail::if_map<Map> = 0>
void halfedge_normals(const Graph &graph, Map map, const creases &where, const normal_options &weight_or_options,
                      const PointMap &point_map) {
  using CGAL::faces;
  const detail::positions<Graph, PointMap> positions(graph, point_map);
  const cut_mesh cut(polygons_of(graph), positions, where);
  std::vector<std::array<double, 3>> normals(cut.vertex_count());
  corner_outputs into;
  into.normal = normals;
  corner_normals(cut, positions, into, weight_or_options);
  const span<const std::uint32_t> corners = cut.corners();
  std::size_t corner = 0;
  for (const auto face : faces(graph)) {
    for (const auto side : CGAL::halfedges_around_face(halfedge(face, graph), graph)) {
      const std::array<double, 3> &normal = normals[corners[corner++]];
      put(map, side, detail::vector_from<typename Map::value_type>(normal));
    }
  }
}
/** Likewise, with the graph's own points. */
template <class Graph, class Map, detail::if_map<Map> = 0>
void halfedge_normals(const Graph &graph, Map map, const creases &where = creases(),
                      const normal_options &weight_or_options = normal_options()) {
  halfedge_normals(graph, map, where, weight_or_options, get(CGAL::vertex_point, graph));
}
/** Likewise, into the property "h:normal", which is added if need be. */
template <class Point>
auto halfedge_normals(CGAL::Surface_mesh<Point> &mesh, const creases &where = creases(),
                      const normal_options &weight_or_options = normal_options()) {
  using Halfedge = typename CGAL::Surface_mesh<Point>::Halfedge_index;
  const auto map = mesh.template add_property_map<Halfedge, detail::vector_at<Point>>("h:normal").first;
  const CGAL::Surface_mesh<Point> &graph = mesh;
  halfedge_normals(graph, map, where, weight_or_options, get(CGAL::vertex_point, graph));
  return map;
}

// ---- curvatures ----

/** A quantity and the map that it goes to. */
template <class Map>
struct destination {
  quantities bit;
  Map map;
};

/** `one` of `quantity` goes to `map`: to numbers, vectors that three doubles make, or std::uint8_t for the status. */
template <class Map>
destination<Map> to(quantities one, Map map) {
  return {one, map};
}

namespace detail {

template <class Graph, class Map>
void connect(result<Graph, Map> &from, quantities bit, curvature_outputs &into) {
  bool known = false;
  if constexpr (result<Graph, Map>::IS_BYTE) {
    known = bit == quantity::status;
    if (known) into.status = from.output();
  } else if constexpr (result<Graph, Map>::IS_NUMBER) {
    for (const auto &named : umbilic::detail::NAMED_NUMBERS) {
      if (named.bit == bit) into.*named.output = from.output(), known = true;
    }
  } else {
    for (const auto &named : umbilic::detail::NAMED_VECTORS) {
      if (named.bit == bit) into.*named.output = from.output(), known = true;
    }
  }
  if (!known) {
    status wrong;
    wrong.fail(UMB_ERROR_NOT_APPLICABLE, "a map is not of the type of the quantity that it shall receive", static_cast<std::uint64_t>(bit));
    wrong.raise();
  }
}

}  // namespace detail

/**
 * Curvatures at the vertices into maps: `curvatures(graph, rings, options, point_map, to(quantity::k1, map), ...)`.
 *
 * @param options the method; by default adaptive jets
 * @param point_map from vertices to points
 */
template <class Graph, class PointMap, class First, class... Maps, detail::if_map<PointMap> = 0>
void curvatures(const Graph &graph, const host_topology &rings, const curvature_options &options, const PointMap &point_map,
                const destination<First> &first, const destination<Maps> &...wanted) {
  const curvature_options existing = rings.restrict_to_existing(options);
  const detail::positions<Graph, PointMap> where(graph, point_map);
  std::tuple<detail::result<Graph, First>, detail::result<Graph, Maps>...> results(detail::result<Graph, First>(graph, first.map),
                                                                                  detail::result<Graph, Maps>(graph, wanted.map)...);
  std::apply(
      [&](auto &first_result, auto &...result) {
        curvature_outputs into;
        detail::connect(first_result, first.bit, into);
        (detail::connect(result, wanted.bit, into), ...);
        umbilic::curvatures(rings, where, into, existing);
        first_result.finish(graph, existing.run);
        (result.finish(graph, existing.run), ...);
      },
      results);
}
/** Likewise, with the graph's own points. */
template <class Graph, class First, class... Maps>
void curvatures(const Graph &graph, const host_topology &rings, const curvature_options &options, const destination<First> &first,
                const destination<Maps> &...wanted) {
  curvatures(graph, rings, options, get(CGAL::vertex_point, graph), first, wanted...);
}
/** Likewise, with a topology for this call alone. */
template <class Graph, class First, class... Maps>
void curvatures(const Graph &graph, const curvature_options &options, const destination<First> &first,
                const destination<Maps> &...wanted) {
  curvatures(graph, build_topology(graph), options, get(CGAL::vertex_point, graph), first, wanted...);
}

/** Where `curvatures` has written in a Surface_mesh; maps of what was not wanted are not valid. All others are found by name (see `quantity`). */
template <class Point>
struct curvature_properties {
  detail::vertex_map<Point, detail::scalar_at<Point>> k1, k2, mean, gauss;
  detail::vertex_map<Point, detail::vector_at<Point>> dir1, dir2;
};

/**
 * Curvatures at the vertices, into properties of these names, which are added if need be: "v:k1", "v:k2", "v:mean" (1/length), "v:gauss"
 * (1/length^2), "v:dir1", "v:dir2" (unit vectors), and what else is wanted. Scalars are double (float if the kernel's are), vectors the
 * kernel's.
 *
 * @param options the method; adaptive jets if left out
 * @param wanted `quantity` bits; by default those of the six above that the method has
 */
template <class Point>
curvature_properties<Point> curvatures(CGAL::Surface_mesh<Point> &mesh, const host_topology &rings,
                                       const curvature_options &options = curvature_options(),
                                       quantities wanted = quantity::default_ones) {
  using Mesh = CGAL::Surface_mesh<Point>;
  using Vertex = typename Mesh::Vertex_index;
  using Numbers = detail::vertex_map<Point, detail::scalar_at<Point>>;
  using Vectors = detail::vertex_map<Point, detail::vector_at<Point>>;
  using Bytes = detail::vertex_map<Point, std::uint8_t>;
  if (wanted == quantity::default_ones) wanted = quantity::of_method(options.method);
  curvature_properties<Point> found;
  std::vector<detail::result<Mesh, Numbers>> numbers_to;
  std::vector<detail::result<Mesh, Vectors>> vectors_to;
  std::vector<detail::result<Mesh, Bytes>> bytes_to;
  curvature_outputs into;
  // Outputs point into these.
  numbers_to.reserve(std::size(umbilic::detail::NAMED_NUMBERS));
  vectors_to.reserve(std::size(umbilic::detail::NAMED_VECTORS));
  bytes_to.reserve(1);
  for (const auto &named : umbilic::detail::NAMED_NUMBERS) {
    if (!umbilic::detail::has(wanted, named.bit)) continue;
    const Numbers map = mesh.template add_property_map<Vertex, detail::scalar_at<Point>>(named.name).first;
    numbers_to.emplace_back(mesh, map);
    detail::connect(numbers_to.back(), named.bit, into);
    if (named.bit == quantity::k1) found.k1 = map;
    if (named.bit == quantity::k2) found.k2 = map;
    if (named.bit == quantity::mean) found.mean = map;
    if (named.bit == quantity::gaussian) found.gauss = map;
  }
  for (const auto &named : umbilic::detail::NAMED_VECTORS) {
    if (!umbilic::detail::has(wanted, named.bit)) continue;
    const Vectors map = mesh.template add_property_map<Vertex, detail::vector_at<Point>>(named.name).first;
    vectors_to.emplace_back(mesh, map);
    detail::connect(vectors_to.back(), named.bit, into);
    if (named.bit == quantity::direction1) found.dir1 = map;
    if (named.bit == quantity::direction2) found.dir2 = map;
  }
  if (umbilic::detail::has(wanted, quantity::status)) {
    bytes_to.emplace_back(mesh, mesh.template add_property_map<Vertex, std::uint8_t>(umbilic::detail::STATUS_NAME).first);
    detail::connect(bytes_to.back(), quantity::status, into);
  }
  const Mesh &graph = mesh;
  const detail::positions<Mesh, detail::point_map_of<Mesh>> positions(graph, get(CGAL::vertex_point, graph));
  const curvature_options existing = rings.restrict_to_existing(options);
  umbilic::curvatures(rings, positions, into, existing);
  for (auto &result : numbers_to) result.finish(graph, existing.run);
  for (auto &result : vectors_to) result.finish(graph, existing.run);
  for (auto &result : bytes_to) result.finish(graph, existing.run);
  return found;
}
/** Likewise, with a topology for this call alone. */
template <class Point>
curvature_properties<Point> curvatures(CGAL::Surface_mesh<Point> &mesh, const curvature_options &options = curvature_options(),
                                       quantities wanted = quantity::default_ones) {
  return curvatures(mesh, build_topology(mesh), options, wanted);
}

// ---- segments ----

/**
 * Segments of a graph, into a map from faces to integers: labels from 0, `UMB_NO_SEGMENT` for faces that are ignored. The way goes with the
 * options: `feature_options`, `watershed_options`, `region_options`. Copies a label for each face.
 *
 * Answers with the segments: their number, boundary edges; areas and means by `polygons_of`.
 */
template <class Graph, class Map, class Options, class PointMap, detail::if_map<Map> = 0>
segmentation segment(const Graph &graph, Map map, const Options &options, const PointMap &point_map) {
  using CGAL::faces;
  const detail::positions<Graph, PointMap> positions(graph, point_map);
  segmentation found = umbilic::segment(polygons_of(graph), positions, options);
  const span<const std::uint32_t> labels = found.labels();
  std::size_t number = 0;
  for (const auto face : faces(graph)) put(map, face, static_cast<typename Map::value_type>(labels[number++]));
  return found;
}
/** Likewise, with the graph's own points. */
template <class Graph, class Map, class Options, detail::if_map<Map> = 0>
segmentation segment(const Graph &graph, Map map, const Options &options) {
  return segment(graph, map, options, get(CGAL::vertex_point, graph));
}
/** Likewise, into the property "f:segment" (std::uint32_t), which is added if need be. */
template <class Point, class Options>
segmentation segment(CGAL::Surface_mesh<Point> &mesh, const Options &options) {
  using Face = typename CGAL::Surface_mesh<Point>::Face_index;
  const auto map = mesh.template add_property_map<Face, std::uint32_t>("f:segment", UMB_NO_SEGMENT).first;
  const CGAL::Surface_mesh<Point> &graph = mesh;
  return segment(graph, map, options, get(CGAL::vertex_point, graph));
}

}  // namespace cgal
}  // namespace UMBILIC_VARIANT
}  // namespace umbilic

#endif  // UMBILIC_CGAL_HPP

/*
 * umbilic: vertex normals, corner normals, curvatures and segments of polygon meshes, and curvatures of polylines, on the caller's own
 * memory.
 *
 * A mesh's one-rings are built once, from faces alone, into a umb_topology; normals and curvatures are then computed
 * from positions as often as these move. Positions, faces and results are the caller's arrays, given as pointer, count and byte stride, and
 * are never kept, and not copied whole but for corner normals.
 *
 * Every function that can fail returns a umb_status, 0 for success, and takes an optional umb_error that names the
 * offending element. Outputs are written only on success. Structs of options and outputs start with their size and may
 * be all zero; a program built against this header runs with any later library of the same UMB_ABI_VERSION.
 *
 * All functions may be called from any thread at any time, and a const handle may be used by many at once. There is no
 * global state but a hook of the library's own runtime, which keeps a caught defect (UMB_ERROR_INTERNAL) from being printed.
 * No signal is touched, no thread outlives the call that started it; threads of the library's take none of the process's signals but those of faults.
 * Whatever floating-point state the host has set (subnormal numbers flushed to zero, another rounding mode, exceptions that trap), results
 * have the same bits, and the host finds its state as it left it (x86 with SSE, 64-bit ARM). A progress callback runs in the host's state.
 *
 * This file is generated; see cbindgen.toml.
 */

#ifndef UMBILIC_H
#define UMBILIC_H

#include <stddef.h>
#include <stdint.h>

#define UMB_VERSION_MAJOR 0
#define UMB_VERSION_MINOR 1
#define UMB_VERSION_PATCH 0
/* Compare with umb_abi_version(). */
#define UMB_ABI_VERSION 0

#if defined(_WIN32) && !defined(UMB_STATIC)
#define UMB_API __declspec(dllimport)
#else
#define UMB_API
#endif

#if defined(__GNUC__) || defined(__clang__)
#define UMB_NODISCARD __attribute__((warn_unused_result))
#else
#define UMB_NODISCARD
#endif

/* Structs with their size set and all else zero. */
#ifdef __cplusplus
#define UMB_INIT_(type) \
  ([] { type value_{}; value_.struct_size = static_cast<uint32_t>(sizeof(type)); return value_; }())
#else
#define UMB_INIT_(type) {.struct_size = sizeof(type)}
#endif
#define UMB_ERROR_INIT UMB_INIT_(umb_error)
#define UMB_TOPOLOGY_OPTIONS_INIT UMB_INIT_(umb_topology_options)
#define UMB_TOPOLOGY_STATS_INIT UMB_INIT_(umb_topology_stats)
#define UMB_ADAPTIVE_MODEL_INIT UMB_INIT_(umb_adaptive_model)
#define UMB_NORMAL_OPTIONS_INIT UMB_INIT_(umb_normal_options)
#define UMB_NORMAL_OUTPUTS_INIT UMB_INIT_(umb_normal_outputs)
#define UMB_FACE_OPTIONS_INIT UMB_INIT_(umb_face_options)
#define UMB_FACE_OUTPUTS_INIT UMB_INIT_(umb_face_outputs)
#define UMB_CREASES_INIT UMB_INIT_(umb_creases)
#define UMB_CORNER_OUTPUTS_INIT UMB_INIT_(umb_corner_outputs)
#define UMB_MOVED_INIT UMB_INIT_(umb_moved)
#define UMB_SHAPE_OPTIONS_INIT UMB_INIT_(umb_shape_options)
#define UMB_FEATURE_OPTIONS_INIT UMB_INIT_(umb_feature_options)
#define UMB_WATERSHED_OPTIONS_INIT UMB_INIT_(umb_watershed_options)
#define UMB_REGION_OPTIONS_INIT UMB_INIT_(umb_region_options)
#define UMB_CURVATURE_OPTIONS_INIT UMB_INIT_(umb_curvature_options)
#define UMB_CURVATURE_OUTPUTS_INIT UMB_INIT_(umb_curvature_outputs)
#define UMB_SECTION_OPTIONS_INIT UMB_INIT_(umb_section_options)
#define UMB_SECTION_OUTPUTS_INIT UMB_INIT_(umb_section_outputs)
#define UMB_POLYLINE_OPTIONS_INIT UMB_INIT_(umb_polyline_options)
#define UMB_POLYLINE_OUTPUTS_INIT UMB_INIT_(umb_polyline_outputs)

/**
 * `umb_error.element` where no element is to blame.
 */
#define UMB_NO_ELEMENT UINT64_MAX

/**
 * Bit of a status byte, and of a vertex's flags (0 is an ordinary interior vertex): an edge at the vertex has only one
 * face.
 */
#define UMB_VERTEX_BOUNDARY 1

/**
 * The faces at the vertex do not form a single fan.
 */
#define UMB_VERTEX_NON_MANIFOLD 2

/**
 * The two faces of an edge at the vertex run through it in the same direction.
 */
#define UMB_VERTEX_WINDING 4

/**
 * No face uses the vertex; its results are zero.
 */
#define UMB_VERTEX_ISOLATED 8

/**
 * The estimator had nothing to work with at the vertex, and a simpler one took its place.
 */
#define UMB_VERTEX_FALLBACK 16

/**
 * Nothing at all could be computed; the results are zero. Also the status of a face without area.
 */
#define UMB_VERTEX_DEGENERATE 32

/**
 * The neighbourhood asked for had too few vertices, or too few in general position, and was widened.
 */
#define UMB_VERTEX_WIDENED 64

/**
 * A face of the vertex is more than 37 degrees from its one-ring normal: a crease, or a very coarse or noisy place. Set by adaptive
 * jets only. Where no smooth surface goes with the faces, `UMB_VERTEX_FALLBACK` is set as well: the normal is then the mean direction
 * of the sides of the crease, and curvatures are those of sections. A vertex without a fit does not carry it.
 */
#define UMB_VERTEX_CREASE 128

/**
 * Bit of a section's status: the plane meets the ring on one side of the vertex only; its mirror image stands in for the
 * other.
 */
#define UMB_SECTION_STATUS_ONE_SIDED 1

/**
 * Bit of a section's status: there is no section (no length, no normal, or nothing of the ring in its plane); its curvature
 * is 0.
 */
#define UMB_SECTION_STATUS_NONE 2

/**
 * Bit of a polyline's status: an end of an open polyline; its curvatures are 0.
 */
#define UMB_POLYLINE_END 1

/**
 * Bit of a polyline's status: a cusp, the next point lies exactly on the side of the previous one.
 */
#define UMB_POLYLINE_CUSP 2

/**
 * Bit of a polyline's status: the point next to the vertex, before or after it, coincides with it. The nearest one
 * along the polyline that does not took its place; if there is none, the curvatures are 0.
 */
#define UMB_POLYLINE_COINCIDENT 4

/**
 * Shape class: nothing is known of the curvature.
 */
#define UMB_SHAPE_UNDEFINED 0

/**
 * Convex in every direction, like a ball: H > 0, K > 0.
 */
#define UMB_SHAPE_PEAK 1

/**
 * Convex in one direction and straight in the other, like a rod: H > 0, K = 0.
 */
#define UMB_SHAPE_RIDGE 2

/**
 * A saddle that is more convex than concave: H > 0, K < 0.
 */
#define UMB_SHAPE_SADDLE_RIDGE 3

/**
 * Not curved: H = 0, K = 0.
 */
#define UMB_SHAPE_FLAT 4

/**
 * A saddle as convex as it is concave, like a minimal surface: H = 0, K < 0.
 */
#define UMB_SHAPE_MINIMAL 5

/**
 * Concave in every direction, like a bowl: H < 0, K > 0.
 */
#define UMB_SHAPE_PIT 6

/**
 * Concave in one direction and straight in the other, like a gutter: H < 0, K = 0.
 */
#define UMB_SHAPE_VALLEY 7

/**
 * A saddle that is more concave than convex: H < 0, K < 0.
 */
#define UMB_SHAPE_SADDLE_VALLEY 8

/**
 * The label of faces that are ignored: those of fewer than three distinct corners in a row.
 */
#define UMB_NO_SEGMENT UINT32_MAX

/**
 * A mesh cut open along its creases: a vertex for each run of faces around a vertex that no crease divides. Whatever is computed over
 * `umb_cut_topology` stops at creases: normals become corner normals, and fits and curvatures of one side take nothing from the
 * other. A `const umb_cut *` may be used from any number of threads at once.
 */
typedef struct umb_cut umb_cut;

/**
 * The faces of a mesh in segments: a label for each. A `const umb_segmentation *` may be used from any number of threads at once.
 *
 * Labels are numbers from 0, in the order of the smallest face of each segment: they follow from which faces are together and from nothing
 * else. A segment is connected across edges that have exactly two faces, which run through it in opposite directions.
 */
typedef struct umb_segmentation umb_segmentation;

/**
 * The one-rings of a mesh, built once from its faces and reused while positions move. A `const umb_topology *` may be
 * used from any number of threads at once.
 */
typedef struct umb_topology umb_topology;

/**
 * What a call came to: 0 is success, 1 to 99 a mistake of the caller, 100 to 199 the surroundings, 900 and above the
 * library itself. Numbers are never reused.
 */
typedef int32_t umb_status;

/**
 * The integer type of an index array: `UMB_INDEX_U32`, `UMB_INDEX_I32` or `UMB_INDEX_U64`.
 */
typedef uint32_t umb_index;

/**
 * Faces, `#F` loops of vertex indices (counter-clockwise seen from outside), borrowed for the call.
 *
 * Without offsets, every face has `arity` corners. With offsets, face `f` has the indices from `offsets[f]` up to
 * `offsets[f + 1]`: there are `face_count + 1` offsets, of the same integer type as the indices.
 */
typedef struct umb_faces {
  /**
   * The corners of all faces, one face after the other, packed and aligned.
   */
  const void *indices;
  /**
   * The number of indices.
   */
  size_t index_count;
  /**
   * Where each face starts, and the end of the last; null if all faces have `arity` corners.
   */
  const void *offsets;
  /**
   * The number of faces; without offsets it may be 0, and follows from `index_count`.
   */
  size_t face_count;
  /**
   * The integer type of indices and offsets.
   */
  umb_index index;
  /**
   * The corners of each face if `offsets` is null, 0 meaning 3; 0 if there are offsets.
   */
  uint32_t arity;
} umb_faces;

/**
 * The widest vectors a call may use: a `UMB_SIMD_` constant. It never changes a bit of a result.
 */
typedef uint32_t umb_simd;

/**
 * How a topology is built. All zero: the defaults.
 */
typedef struct umb_topology_options {
  /**
   * `sizeof(umb_topology_options)`; 0 stands for the size of its first version.
   */
  uint32_t struct_size;
  /**
   * The number of threads, the calling one among them; 0 for as many as pay, at most one a core. At most 256 are used, and
   * they end with the call.
   */
  uint32_t threads;
  /**
   * The widest vectors to use: a `UMB_SIMD_` constant.
   */
  umb_simd simd;
  /**
   * 0
   */
  uint32_t reserved;
} umb_topology_options;

/**
 * What went wrong, in the caller's memory. Written only when a call fails; may be null wherever it is taken.
 */
typedef struct umb_error {
  /**
   * `sizeof(umb_error)`, set by the caller; 0 stands for the size of its first version. If it is smaller than that,
   * nothing is written here; what a longer one has beyond the library's fields is left alone.
   */
  uint32_t struct_size;
  /**
   * The status that the call returned.
   */
  umb_status status;
  /**
   * The offending corner, face, vertex, byte or value, as the message says; `UMB_NO_ELEMENT` if there is none.
   */
  uint64_t element;
  /**
   * What, where, and what was expected: UTF-8 with a closing NUL.
   */
  char message[240];
} umb_error;

/**
 * What a mesh is made of, and what is wrong with it.
 */
typedef struct umb_topology_stats {
  /**
   * `sizeof(umb_topology_stats)`, set by the caller; 0 stands for the size of its first version.
   */
  uint32_t struct_size;
  /**
   * 0
   */
  uint32_t reserved;
  /**
   * Vertices.
   */
  uint64_t vertex_count;
  /**
   * Faces, ignored ones included.
   */
  uint64_t face_count;
  /**
   * Corners of the faces that are not ignored.
   */
  uint64_t corner_count;
  /**
   * Edges, each counted once however many faces it has.
   */
  uint64_t edge_count;
  /**
   * Edges with one face.
   */
  uint64_t boundary_edges;
  /**
   * Edges with more than two faces.
   */
  uint64_t non_manifold_edges;
  /**
   * Edges whose two faces run through them in the same direction.
   */
  uint64_t winding_edges;
  /**
   * Vertices without a face.
   */
  uint64_t isolated_vertices;
  /**
   * Vertices on an edge with one face.
   */
  uint64_t boundary_vertices;
  /**
   * Vertices whose faces do not form a single fan.
   */
  uint64_t non_manifold_vertices;
  /**
   * Faces that name a vertex twice in a row, or that have fewer than three corners.
   */
  uint64_t degenerate_faces;
  /**
   * Degenerate faces of which fewer than three corners remain: they are ignored.
   */
  uint64_t ignored_faces;
  /**
   * Faces that run through the same vertices in the same order as an earlier one. They count like any other.
   */
  uint64_t duplicate_faces;
  /**
   * Pieces, connected through shared vertices; isolated vertices are not counted.
   */
  uint64_t component_count;
  /**
   * Closed loops of edges with one face. At a vertex with several fans the loop follows the fan.
   */
  uint64_t boundary_loops;
  /**
   * Vertices that have faces, minus edges, plus faces that are not ignored.
   */
  int64_t euler_characteristic;
  /**
   * The largest number of edges at a vertex.
   */
  uint64_t max_valence;
  /**
   * Heap memory that the handle holds, in bytes.
   */
  uint64_t bytes;
} umb_topology_stats;

/**
 * One fan of a vertex: a run of faces in which each shares an edge with the next.
 */
typedef struct umb_fan {
  /**
   * The neighbours in counter-clockwise order; the handle's memory, valid until it is destroyed.
   */
  const uint32_t *neighbours;
  /**
   * `corner_count` in a closed fan, one more in an open one.
   */
  size_t neighbour_count;
  /**
   * The number of faces in the fan.
   */
  size_t corner_count;
  /**
   * 1 if the last face meets the first, else 0.
   */
  uint32_t closed;
  /**
   * 0
   */
  uint32_t reserved;
} umb_fan;

/**
 * The scalar type of an array: `UMB_SCALAR_F32`, which is what a zeroed struct says, or `UMB_SCALAR_F64`.
 */
typedef uint32_t umb_scalar;

/**
 * Vertex positions, `#V × 3`, borrowed for the call; also normals and directions, where a struct says so.
 *
 * The coordinates of a vertex lie next to each other; vertices lie `stride` bytes apart, so the points of OpenMesh,
 * CGAL or MeshLab, and interleaved vertex buffers, are read where they are.
 */
typedef struct umb_points {
  /**
   * The first coordinate of the first vertex, aligned to its scalar.
   */
  const void *data;
  /**
   * The number of vertices.
   */
  size_t count;
  /**
   * Bytes from one vertex to the next, a multiple of the scalar's size; 0 if packed.
   */
  size_t stride;
  /**
   * The scalar type.
   */
  umb_scalar scalar;
  /**
   * 0
   */
  uint32_t reserved;
} umb_points;

/**
 * How a vertex normal weighs the faces around the vertex, or what it fits: a `UMB_WEIGHT_` constant.
 *
 * N_i is the unit normal of face i at the vertex, theta_i its interior angle there (up to 2 pi at a reflex corner of a
 * polygon), a and b the lengths of its two edges there, A_i its area, g_i the distance to its centroid.
 */
typedef uint32_t umb_weight;

/**
 * Called on the calling thread with the fraction done, 0 to 1; non-zero cancels. It must return (no `longjmp`, no
 * exception).
 */
typedef int (*umb_progress)(void *user,
                            double fraction);

/**
 * How a call is carried out. All zero: all cores where that pays, the widest vectors, all vertices, no progress. Its layout
 * is final, because it stands inside other structs; whatever comes later will stand in those.
 */
typedef struct umb_run {
  /**
   * The number of threads, at most 256 of which are used; 0 for as many as pay, 1 for the calling thread alone. Never
   * changes a bit of a result.
   */
  uint32_t threads;
  /**
   * The widest vectors to use.
   */
  umb_simd simd;
  /**
   * The vertices to compute; null for all, so an empty list needs a pointer that is not null. Outputs stay indexed by
   * vertex; those of other vertices are left alone, and positions that no listed vertex needs are not looked at (but by adaptive
   * jets without a model, which learn from all). May
   * repeat. The results are the same bits as those of a call for all vertices.
   */
  const uint32_t *vertices;
  /**
   * The number of `vertices`.
   */
  size_t vertex_count;
  /**
   * Called now and then; may be null.
   */
  umb_progress progress;
  /**
   * Handed to `progress`.
   */
  void *user;
} umb_run;

/**
 * The coordinates in which an adaptive jet writes the surface near a vertex: a `UMB_COORDINATES_` constant.
 */
typedef uint32_t umb_coordinates;

/**
 * What adaptive jets know of a mesh before they look at a vertex: how noisy its positions are and how smooth its surface.
 *
 * `umb_learn_model` fills it, and `model` of `umb_normal_options`, `umb_curvature_options` and `umb_section_options` hands it in.
 * A call without model learns its own from all positions of the mesh, with the same bits as result; given the same model, a list
 * of vertices, a part of the mesh or a later frame of it is fitted alike, and a list costs little more than its vertices.
 */
typedef struct umb_adaptive_model {
  /**
   * `sizeof(umb_adaptive_model)`; 0 stands for the size of its first version.
   */
  uint32_t struct_size;
  /**
   * The coordinates that describe the sample better.
   */
  umb_coordinates coordinates;
  /**
   * The median over the vertices of the mean length of a vertex's edges, in the mesh's unit; above 0.
   */
  double edge_length;
  /**
   * The standard deviation of the positions along the normal that is not the surface's, in the mesh's unit; above 0, also
   * when divided by `edge_length` (a quotient that rounds to 0 or to infinity is `UMB_ERROR_OPTION_OUT_OF_RANGE`).
   */
  double noise;
  /**
   * The root mean square size of the surface's Taylor coefficients of degrees 2, 3 and 4, and of what lies beyond, for
   * lengths in units of `edge_length`; above 0.
   */
  double sizes[4];
  /**
   * A vertex's noise is `noise` times its own mean edge length, in units of `edge_length`, to this power: 0 to 2.
   */
  uint32_t noise_exponent;
  /**
   * 1 if `sizes` are understood in units of the vertex's own mean edge length, 0 if in those of `edge_length`.
   */
  uint32_t size_exponent;
  /**
   * The mean logarithm of the evidence of a sample vertex for heights and for circles, each with its own best numbers:
   * larger is better; 0 where it was not looked at. Not read.
   */
  double evidence[2];
  /**
   * How many vertices it was learned from; 0 if there were none to learn from. Not read.
   */
  uint32_t sample;
  /**
   * 0
   */
  uint32_t reserved;
} umb_adaptive_model;

/**
 * Which vertex normals to compute, and how. All zero: N_CM at all vertices.
 */
typedef struct umb_normal_options {
  /**
   * `sizeof(umb_normal_options)`; 0 stands for the size of its first version.
   */
  uint32_t struct_size;
  /**
   * The weight.
   */
  umb_weight weight;
  /**
   * How to run.
   */
  struct umb_run run;
  /**
   * `UMB_WEIGHT_JET` only: the degree of the polynomial, 1 to 4; 0 for 3. Other weights do not look at it.
   */
  uint32_t degree;
  /**
   * Jets only: the rings of neighbours that the polynomial is fitted to, at most 8. 0 stands, for `UMB_WEIGHT_ADAPTIVE_JET`, for as
   * many as have any weight, which is 3 on clean meshes and up to 6 on noisy ones (4 are a fair choice, 3 the cheap one); for
   * `UMB_WEIGHT_JET`, for 1 at degree 1, 2 at degrees 2 and 3, and 3 at degree 4. The first ring of a vertex is all vertices that share a face with it. No more than 255 vertices are
   * used. Other weights do not look at it.
   */
  uint32_t rings;
  /**
   * `UMB_WEIGHT_ADAPTIVE_JET` only: what is known of the mesh, read only during the call; null to learn it from all positions. Other weights do not look at
   * it.
   */
  const struct umb_adaptive_model *model;
} umb_normal_options;

/**
 * An array to write, in the caller's memory: of vectors, `#V x 3`, or of single scalars, `#V`, as the field that holds it
 * says. Null `data`: not wanted.
 *
 * It has an element for every vertex (or face) of the mesh or polyline. The bytes between elements are left alone, so an
 * output may be interleaved with the positions. Its elements must not overlap those of any other array of the call.
 */
typedef struct umb_output {
  /**
   * The first scalar of the first element, aligned.
   */
  void *data;
  /**
   * Bytes from one element to the next, a multiple of the scalar's size; 0 if packed.
   */
  size_t stride;
  /**
   * The scalar type.
   */
  umb_scalar scalar;
  /**
   * 0
   */
  uint32_t reserved;
} umb_output;

/**
 * An array of bytes to write, in the caller's memory: `UMB_VERTEX_` or `UMB_POLYLINE_` bits. Null `data`: not wanted.
 */
typedef struct umb_status_output {
  /**
   * The first byte.
   */
  uint8_t *data;
  /**
   * Bytes from one element to the next; 0 if packed.
   */
  size_t stride;
} umb_status_output;

/**
 * Where vertex normals go; any of them may be left out.
 */
typedef struct umb_normal_outputs {
  /**
   * `sizeof(umb_normal_outputs)`; 0 stands for the size of its first version.
   */
  uint32_t struct_size;
  /**
   * 0
   */
  uint32_t reserved;
  /**
   * Unit normals, `#V x 3`; (0, 0, 0) where the status says isolated or degenerate.
   */
  struct umb_output normal;
  /**
   * The weighted sums before normalisation, `#V x 3`, in the weight's unit: length^2 for areas, 1/length^2 for Max,
   * and so on. For N_CM each fan's weights are divided by their total, so a fan's sum is at most 1 long. Where the
   * status says fallback, it is the sum of that other weight, in its unit. Beyond the scalar's range its largest value
   * stands. For jets and tilted sections, which sum nothing, it is the unit normal itself.
   */
  struct umb_output sum;
  /**
   * `UMB_VERTEX_` bits, `#V`.
   */
  struct umb_status_output status;
} umb_normal_outputs;

/**
 * How face normals are computed. All zero: the defaults.
 */
typedef struct umb_face_options {
  /**
   * `sizeof(umb_face_options)`; 0 stands for the size of its first version.
   */
  uint32_t struct_size;
  /**
   * 0
   */
  uint32_t reserved;
  /**
   * How to run; `vertices` must be null.
   */
  struct umb_run run;
} umb_face_options;

/**
 * Where face normals go; any of them may be left out.
 */
typedef struct umb_face_outputs {
  /**
   * `sizeof(umb_face_outputs)`; 0 stands for the size of its first version.
   */
  uint32_t struct_size;
  /**
   * 0
   */
  uint32_t reserved;
  /**
   * Unit normals, `#F x 3`; (0, 0, 0) where a face has none.
   */
  struct umb_output normal;
  /**
   * Area vectors, `#F x 3`: along the normal, as long as the area is large (length^2).
   */
  struct umb_output area_vector;
  /**
   * 0 or `UMB_VERTEX_DEGENERATE`, `#F`.
   */
  struct umb_status_output status;
} umb_face_outputs;

/**
 * How curvatures are estimated: a `UMB_CURVATURE_` constant.
 *
 * What each has to give; any other output is refused with `UMB_ERROR_NOT_APPLICABLE`:
 *
 * | method                       | k1 k2, shape index, curvedness | directions | H, H N | K | area | integrals | residual | condition |
 * |------------------------------|---|---|---|---|---|-------|-----------|---|
 * | ADAPTIVE_JET                 | x | x | x | x |   |       | length    |   |
 * | JET, QUADRIC, GOLDFEATHER    | x | x | x | x |   |       | length    | x |
 * | LEAST_SQUARES                | x | x | x | x |   |       | 1/length  |   |
 * | TILTED_SECTIONS              | x | x | x | x |   |       |           |   |
 * | TAUBIN, RUSINKIEWICZ         | x | x | x | x |   |       |           |   |
 * | WATANABE                     | x |   | x | x |   |       |           |   |
 * | MEYER                        | x |   | x | x | x | H, K  |           |   |
 * | ANGLE_DEFECT                 |   |   |   | x | x | K     |           |   |
 * | NORMAL_CYCLE                 | x | x | x | x | x | H     |           |   |
 * | CORRECTED_MEASURE            | x | x | x | x | x | H, K  |           |   |
 *
 * Every method has normal and status; `degrees_of_freedom` is `ADAPTIVE_JET`'s alone.
 *
 * Every method takes triangles and polygons, and any vertex: boundary, non-manifold (all fans count together), isolated.
 */
typedef uint32_t umb_curvature_method;

/**
 * The formula of a section's curvature: a `UMB_SECTION_` constant.
 *
 * Of three points A, V, C with a = A - V, c = C - V, phi the angle between them and d = |C - A|, or of one edge x and a unit
 * normal N.
 */
typedef uint32_t umb_section;

/**
 * Which curvatures to compute, and how. All zero: adaptive jets, at all vertices.
 */
typedef struct umb_curvature_options {
  /**
   * `sizeof(umb_curvature_options)`; 0 stands for the size of its first version.
   */
  uint32_t struct_size;
  /**
   * The method.
   */
  umb_curvature_method method;
  /**
   * The formula of sections, for `LEAST_SQUARES`, `TAUBIN` and `WATANABE`; others do not look at it. The parabolas are
   * one here.
   */
  umb_section section;
  /**
   * The weight of the vertex normals, if `normals.data` is null.
   */
  umb_weight weight;
  /**
   * For measures, the radius of a ball around the vertex instead of rings (`rings` is 0 then), in the mesh's unit; 0 for
   * none. A vertex
   * connected to the centre inside the ball counts with its share of the surface, by the part of it inside. The cost
   * grows with the number of vertices in each ball.
   */
  double radius;
  /**
   * The degree of jets, 2 to 4; 0 for 3. Other methods take 0.
   */
  uint32_t degree;
  /**
   * How many rings count, at most 8; 0 for the method's default. Methods of one ring take 0 and 1.
   */
  uint32_t rings;
  /**
   * `UMB_WEIGHT_JET` only: see `degree` of `umb_normal_options`.
   */
  uint32_t normal_degree;
  /**
   * `UMB_WEIGHT_JET` and `UMB_WEIGHT_ADAPTIVE_JET` only: see `rings` of `umb_normal_options`.
   */
  uint32_t normal_rings;
  /**
   * What adaptive jets, as method or as weight, know of the mesh, read only during the call; null to learn it from all
   * positions.
   */
  const struct umb_adaptive_model *model;
  /**
   * Vertex normals of the caller's, `#V x 3`, of any length, on the side from which the faces run counter-clockwise: those
   * on the other change the signs of some methods and leave others without result. A vertex whose normal is zero has no
   * curvature. Null data: computed with `weight`.
   */
  struct umb_points normals;
  /**
   * How to run.
   */
  struct umb_run run;
} umb_curvature_options;

/**
 * Where curvatures go; any of them may be left out. All are pointwise unless the name says integrated.
 */
typedef struct umb_curvature_outputs {
  /**
   * `sizeof(umb_curvature_outputs)`; 0 stands for the size of its first version.
   */
  uint32_t struct_size;
  /**
   * 0
   */
  uint32_t reserved;
  /**
   * The larger principal curvature, `#V`, 1/length.
   */
  struct umb_output k1;
  /**
   * The smaller principal curvature, `#V`, 1/length.
   */
  struct umb_output k2;
  /**
   * The unit tangent direction of k1, `#V x 3`; the first of its largest components is positive. At an umbilic, where
   * every direction is principal, some tangent.
   */
  struct umb_output direction1;
  /**
   * The unit tangent direction of k2, `#V x 3`: normal x direction1.
   */
  struct umb_output direction2;
  /**
   * Mean curvature H = (k1 + k2) / 2, `#V`, 1/length.
   */
  struct umb_output mean;
  /**
   * Gaussian curvature K = k1 k2, `#V`, 1/length^2.
   */
  struct umb_output gaussian;
  /**
   * The mean curvature normal H N, `#V x 3`, 1/length: along the outward normals of a sphere.
   */
  struct umb_output mean_normal;
  /**
   * The area that the vertex stands for, `#V`, length^2.
   */
  struct umb_output area;
  /**
   * Mean curvature integrated over that area, `#V`, length. The normal cycle's is the sum over edges alone; its H is that
   * of the tensor in the tangent plane, and differs from this by the area where the vertex normal leans.
   */
  struct umb_output integrated_mean;
  /**
   * Gaussian curvature integrated over that area, `#V`, without unit.
   */
  struct umb_output integrated_gaussian;
  /**
   * Koenderink's shape index (2/pi) atan((k1 + k2) / (k1 - k2)), `#V`: 1 at a cap, 0.5 on a ridge, 0 at a symmetric
   * saddle and in a plane, -0.5 in a rut, -1 in a cup.
   */
  struct umb_output shape_index;
  /**
   * Koenderink's curvedness sqrt((k1^2 + k2^2) / 2), `#V`, 1/length.
   */
  struct umb_output curvedness;
  /**
   * The root mean square of what a fit left over, `#V`: length where heights were fitted, 1/length where curvatures
   * were; for `GOLDFEATHER`, of heights, and of slopes times the root mean square distance of the neighbours.
   */
  struct umb_output residual;
  /**
   * The condition number of a fit (Frobenius norm, columns of length 1, so not CGAL's), `#V`.
   */
  struct umb_output condition;
  /**
   * `ADAPTIVE_JET` only: how many of the 15 coefficients the data decide, and not the prior, `#V`; 0 where nothing was fitted.
   */
  struct umb_output degrees_of_freedom;
  /**
   * The unit normals that all this belongs to, `#V x 3`.
   */
  struct umb_output normal;
  /**
   * `UMB_VERTEX_` bits, `#V`.
   */
  struct umb_status_output status;
} umb_curvature_outputs;

/**
 * Which sections to compute, and how. All zero: symmetric parabolas with N_CM, at all vertices.
 */
typedef struct umb_section_options {
  /**
   * `sizeof(umb_section_options)`; 0 stands for the size of its first version.
   */
  uint32_t struct_size;
  /**
   * The formula.
   */
  umb_section section;
  /**
   * The weight of the vertex normals, if `normals.data` is null.
   */
  umb_weight weight;
  /**
   * `umb_direction_sections` only: 1 if `directions` is one set for every vertex, 0 if it has one for each.
   */
  uint32_t shared;
  /**
   * Vertex normals of the caller's, `#V x 3`, of any length; a vertex whose normal is zero has no section. Null data:
   * computed with `weight`.
   */
  struct umb_points normals;
  /**
   * `umb_direction_sections` only: directions of any length, `#V x 3`, or `#D x 3` if shared; each is projected onto the
   * tangent plane.
   */
  struct umb_points directions;
  /**
   * `UMB_WEIGHT_JET` only: see `degree` of `umb_normal_options`.
   */
  uint32_t normal_degree;
  /**
   * `UMB_WEIGHT_JET` and `UMB_WEIGHT_ADAPTIVE_JET` only: see `rings` of `umb_normal_options`.
   */
  uint32_t normal_rings;
  /**
   * `UMB_WEIGHT_ADAPTIVE_JET` only: see `model` of `umb_normal_options`.
   */
  const struct umb_adaptive_model *model;
  /**
   * How to run.
   */
  struct umb_run run;
} umb_section_options;

/**
 * Where sections go; any of them may be left out.
 */
typedef struct umb_section_outputs {
  /**
   * `sizeof(umb_section_outputs)`; 0 stands for the size of its first version.
   */
  uint32_t struct_size;
  /**
   * 0
   */
  uint32_t reserved;
  /**
   * The curvature of each section, 1/length; positive where the surface bends away from the normal.
   */
  struct umb_output curvature;
  /**
   * `UMB_SECTION_STATUS_` bits, one byte for each section.
   */
  struct umb_status_output status;
  /**
   * The unit vertex normals that were used, `#V x 3`.
   */
  struct umb_output normal;
} umb_section_outputs;

/**
 * A polyline, `#V x 2` or `#V x 3`, borrowed for the call. It joins each point to the next.
 *
 * The coordinates of a point lie next to each other; points lie `stride` bytes apart.
 */
typedef struct umb_polyline {
  /**
   * The first coordinate of the first point, aligned to its scalar; may be null if there is no point.
   */
  const void *data;
  /**
   * The number of points, which may be 0.
   */
  size_t count;
  /**
   * Bytes from one point to the next, a multiple of the scalar's size; 0 if packed.
   */
  size_t stride;
  /**
   * The scalar type.
   */
  umb_scalar scalar;
  /**
   * The number of coordinates, 2 or 3; 0 means 3.
   */
  uint32_t dimension;
  /**
   * 1 if the last point is joined to the first, 0 if not. The first point need not be repeated at the end; if it is,
   * no harm is done.
   */
  uint32_t closed;
  /**
   * 0
   */
  uint32_t reserved;
} umb_polyline;

/**
 * How the curvatures of a polyline are computed. All zero: the defaults.
 */
typedef struct umb_polyline_options {
  /**
   * `sizeof(umb_polyline_options)`; 0 stands for the size of its first version.
   */
  uint32_t struct_size;
  /**
   * 0
   */
  uint32_t reserved;
  /**
   * How to run; `vertices` must be null.
   */
  struct umb_run run;
} umb_polyline_options;

/**
 * Where the curvatures of a polyline go, each `#V`, in 1/length; any of them may be left out.
 *
 * a and c are the edges from a vertex to the points before and after it, phi is the angle between them, d = |c - a| the
 * distance of these points from each other.
 */
typedef struct umb_polyline_outputs {
  /**
   * `sizeof(umb_polyline_outputs)`; 0 stands for the size of its first version.
   */
  uint32_t struct_size;
  /**
   * 0
   */
  uint32_t reserved;
  /**
   * kappa_C, of the circle through the three points: 2 sin(phi) / d. At most 2 / max(|a|, |c|), however sharp the
   * corner. Exactly 1/r, to rounding, wherever three points lie on a circle of radius r.
   */
  struct umb_output circle;
  /**
   * kappa_P, of the parabola that passes the three points at the parameters 0, 1/2 and 1: 8 |a| |c| sin(phi) / d^3.
   */
  struct umb_output parabola;
  /**
   * kappa_P with the parameter in proportion to lengths, the vertex at |a| / (|a| + |c|):
   * 2 (|a| + |c|)^2 sin(phi) / d^3.
   */
  struct umb_output length_parabola;
  /**
   * kappa_SP, of a parabola symmetric about the corner's bisector: 4 cos(phi/2) / ((|a| + |c|) sin(phi/2)^2). Grows
   * without bound as the corner sharpens.
   */
  struct umb_output symmetric_parabola;
  /**
   * `UMB_POLYLINE_` bits.
   */
  struct umb_status_output status;
} umb_polyline_outputs;

/**
 * Which edges are creases; an edge is one if any field says so. All zero: those that are sharper than 30 degrees.
 *
 * An edge with one face, with more than two, or whose two faces run through it in the same direction separates its faces in any
 * case. If cutting leaves just two of the faces at such an edge, in opposite directions, these meet there in the cut mesh: a sheet on which a
 * fin stands is whole.
 */
typedef struct umb_creases {
  /**
   * `sizeof(umb_creases)`; 0 stands for the size of its first version.
   */
  uint32_t struct_size;
  /**
   * 0
   */
  uint32_t reserved;
  /**
   * An edge is a crease if the normals of its two faces differ by more than this angle, in radians; from pi on none is one by its
   * angle. 0 stands for pi/6 if there are neither `edges` nor `groups`, else for pi. A face without area has the normal of a neighbour, across
   * its longest edge to one that has one: so a sliver along a crease does not join its sides.
   */
  double angle;
  /**
   * Vertices of edges that are creases, two for each, in any order; pairs that no edge joins mean nothing. May be null.
   */
  const uint32_t *edges;
  /**
   * The number of pairs.
   */
  size_t edge_count;
  /**
   * The smoothing group of each face, `#F`, a number as in OBJ files (not a mask of bits as in 3DS files): the edge between two faces is a
   * crease if theirs differ or are 0, which is no group.
   * Null: there are none.
   */
  const uint32_t *groups;
  /**
   * The number of faces, or 0 if `groups` is null.
   */
  size_t group_count;
} umb_creases;

/**
 * Where corner normals go; any of them may be left out.
 */
typedef struct umb_corner_outputs {
  /**
   * `sizeof(umb_corner_outputs)`; 0 stands for the size of its first version.
   */
  uint32_t struct_size;
  /**
   * 0
   */
  uint32_t reserved;
  /**
   * A unit normal for each corner, `#C x 3`, in the order of the indices of the faces; (0, 0, 0) where there is none.
   */
  struct umb_output corner;
  /**
   * The same normals, each once: a unit normal for each vertex of the cut mesh, to which `umb_cut_corners` are the index.
   */
  struct umb_output normal;
  /**
   * By vertex of the cut mesh: see `sum` of `umb_normal_outputs`.
   */
  struct umb_output sum;
  /**
   * `UMB_VERTEX_` bits by vertex of the cut mesh, on which a crease is a boundary.
   */
  struct umb_status_output status;
} umb_corner_outputs;

/**
 * An array of bytes to read: `UMB_VERTEX_` bits or `UMB_SHAPE_` constants, as calls write them. Null `data` and no bytes: there are
 * none.
 */
typedef struct umb_bytes {
  /**
   * The first byte.
   */
  const uint8_t *data;
  /**
   * How many there are.
   */
  size_t count;
  /**
   * Bytes from one element to the next; 0 if packed.
   */
  size_t stride;
} umb_bytes;

/**
 * Vertices that have moved since normals or curvatures were computed.
 */
typedef struct umb_moved {
  /**
   * `sizeof(umb_moved)`; 0 stands for the size of its first version.
   */
  uint32_t struct_size;
  /**
   * 0
   */
  uint32_t reserved;
  /**
   * The vertices; may repeat. May be null if there are none.
   */
  const uint32_t *vertices;
  /**
   * The number of `vertices`.
   */
  size_t vertex_count;
  /**
   * The status bytes of the results as they were, `#V`, which calls for lists have kept up to date: they tell fits whose neighbourhood was
   * widened. May be none: then it is assumed of every vertex, and lists for jets, quadrics and Goldfeather's fits are longer.
   */
  struct umb_bytes status;
} umb_moved;

/**
 * Where the numbers of a `umb_scalars` are: a `UMB_AT_` constant.
 */
typedef uint32_t umb_location;

/**
 * Numbers to read, one for each vertex or for each face, borrowed for the call: curvatures, say.
 */
typedef struct umb_scalars {
  /**
   * The first number, aligned to its scalar.
   */
  const void *data;
  /**
   * How many there are.
   */
  size_t count;
  /**
   * Bytes from one to the next, a multiple of the scalar's size; 0 if packed.
   */
  size_t stride;
  /**
   * The scalar type.
   */
  umb_scalar scalar;
  /**
   * Where they are.
   */
  umb_location location;
} umb_scalars;

/**
 * How shapes are classified. All zero: with the default tolerance.
 */
typedef struct umb_shape_options {
  /**
   * `sizeof(umb_shape_options)`; 0 stands for the size of its first version.
   */
  uint32_t struct_size;
  /**
   * 0
   */
  uint32_t reserved;
  /**
   * H counts as 0 up to this, and K up to its square; 1/length. 0 stands for `umb_shape_tolerance` of `points`; for none take a number that is tiny.
   */
  double tolerance;
  /**
   * Positions of which the default tolerance is taken, read only during the call; may be null if `tolerance` is not 0.
   */
  const struct umb_points *points;
  /**
   * The status bytes of the curvatures, as many: isolated and degenerate vertices are undefined. May be none. (Adaptive jets without a
   * solution write curvatures of 0 with `UMB_VERTEX_FALLBACK` and without `UMB_VERTEX_CREASE`, which this takes for flat.)
   */
  struct umb_bytes status;
  /**
   * How to run; `vertices` must be null.
   */
  struct umb_run run;
} umb_shape_options;

/**
 * How a mesh is cut along its creases. All zero: along edges sharper than 30 degrees.
 */
typedef struct umb_feature_options {
  /**
   * `sizeof(umb_feature_options)`; 0 stands for the size of its first version.
   */
  uint32_t struct_size;
  /**
   * 0
   */
  uint32_t reserved;
  /**
   * Which edges are creases, read only during the call; may be null.
   */
  const struct umb_creases *creases;
  /**
   * How to run; `vertices` must be null.
   */
  struct umb_run run;
} umb_feature_options;

/**
 * How a mesh is cut into basins. All zero: basins of curvedness by adaptive jets, the shallow ones merged.
 */
typedef struct umb_watershed_options {
  /**
   * `sizeof(umb_watershed_options)`; 0 stands for the size of its first version.
   */
  uint32_t struct_size;
  /**
   * 0
   */
  uint32_t reserved;
  /**
   * Basins that are less deep than this are merged with the neighbour over the lowest pass; in the unit of the height, at most infinity. 0: none
   * of a given height; of curvedness, those of less than four times `umb_shape_tolerance`, and a tiny number for none.
   */
  double depth;
  /**
   * The height, at vertices or at faces: low inside segments, high between them. Null for curvedness.
   */
  const struct umb_scalars *height;
  /**
   * How curvedness is computed, `run` aside; null for adaptive jets. Not looked at beside a height.
   */
  const struct umb_curvature_options *curvature;
  /**
   * How to run; `vertices` must be null.
   */
  struct umb_run run;
} umb_watershed_options;

/**
 * How regions grow. All zero: by shape classes from adaptive jets.
 */
typedef struct umb_region_options {
  /**
   * `sizeof(umb_region_options)`; 0 stands for the size of its first version.
   */
  uint32_t struct_size;
  /**
   * 0
   */
  uint32_t reserved;
  /**
   * Regions of less than this share of the whole area become part of a neighbour, 0 to 1; 0 stands for 0.0005, and
   * a tiny number merges none.
   */
  double smallest_share;
  /**
   * For classes that are not given: the tolerance of `umb_shape_classes`, in 1/length; 0 for twice `umb_shape_tolerance`, and a
   * tiny number for none.
   */
  double tolerance;
  /**
   * Regions of fewer faces become part of a neighbour.
   */
  size_t smallest_faces;
  /**
   * Where regions do not grow across, read only during the call; null for edges sharper than 30 degrees.
   */
  const struct umb_creases *creases;
  /**
   * A `UMB_SHAPE_` constant for each vertex, `#V`; none to have them computed.
   */
  struct umb_bytes classes;
  /**
   * For classes that are not given: how curvatures are computed, `run` aside; null for adaptive jets.
   */
  const struct umb_curvature_options *curvature;
  /**
   * How to run; `vertices` must be null.
   */
  struct umb_run run;
} umb_region_options;

/**
 * Success.
 */
#define UMB_OK 0

/**
 * A required pointer is null.
 */
#define UMB_ERROR_NULL_POINTER 1

/**
 * A struct's `struct_size` is smaller than the struct's first version, or beyond 4096.
 */
#define UMB_ERROR_STRUCT_SIZE 2

/**
 * A field that this version of the library does not know, or a reserved one, is not zero.
 */
#define UMB_ERROR_UNKNOWN_FIELD 3

/**
 * A constant is none of those documented for its place.
 */
#define UMB_ERROR_UNKNOWN_CONSTANT 4

/**
 * A stride is smaller than an element, or no multiple of its scalar.
 */
#define UMB_ERROR_STRIDE 5

/**
 * An array does not start at a multiple of its scalar's size.
 */
#define UMB_ERROR_MISALIGNED 6

/**
 * A count does not fit the others, or its bytes exceed the address space.
 */
#define UMB_ERROR_SIZE 7

/**
 * Face offsets do not run upwards from 0 to the number of indices.
 */
#define UMB_ERROR_OFFSETS 8

/**
 * An index is negative, or not below the number of what it counts.
 */
#define UMB_ERROR_INDEX_OUT_OF_RANGE 9

/**
 * A coordinate, or one of a normal or direction given, is NaN or infinite.
 */
#define UMB_ERROR_NON_FINITE 10

/**
 * More vertices, faces or corners than 32-bit tables can hold.
 */
#define UMB_ERROR_TOO_LARGE 11

/**
 * An output is asked for, or an option set, that the method does not have.
 */
#define UMB_ERROR_NOT_APPLICABLE 12

/**
 * An option is outside its range.
 */
#define UMB_ERROR_OPTION_OUT_OF_RANGE 13

/**
 * No memory for a buffer.
 */
#define UMB_ERROR_OUT_OF_MEMORY 100

/**
 * The progress callback asked to stop.
 */
#define UMB_ERROR_CANCELLED 101

/**
 * A defect of the library, caught before it could reach the caller.
 */
#define UMB_ERROR_INTERNAL 900

/**
 * 32-bit floating point; the default.
 */
#define UMB_SCALAR_F32 0

/**
 * 64-bit floating point.
 */
#define UMB_SCALAR_F64 1

/**
 * Unsigned, 32 bits; the default.
 */
#define UMB_INDEX_U32 0

/**
 * Signed, 32 bits; negative indices are refused.
 */
#define UMB_INDEX_I32 1

/**
 * Unsigned, 64 bits.
 */
#define UMB_INDEX_U64 2

/**
 * The widest that the CPU has, or what the environment variable `UMBILIC_SIMD` names if that is narrower (`portable`, `avx2` or
 * `avx512`; read once); the default.
 */
#define UMB_SIMD_BEST 0

/**
 * None: plain code that runs on any CPU.
 */
#define UMB_SIMD_PORTABLE 1

/**
 * The same as [`UMB_SIMD_PORTABLE`], which uses SSE2 on every x86-64.
 */
#define UMB_SIMD_SSE2 2

/**
 * At most AVX2.
 */
#define UMB_SIMD_AVX2 3

/**
 * At most AVX-512.
 */
#define UMB_SIMD_AVX512 4

/**
 * One for each vertex, `#V`; the default.
 */
#define UMB_AT_VERTICES 0

/**
 * One for each face, `#F`.
 */
#define UMB_AT_FACES 1

/**
 * Heights over the tangent plane.
 */
#define UMB_COORDINATES_HEIGHT 0

/**
 * Heights over the distance from the vertex, in the direction of its projection to the tangent plane: spheres are then exactly
 * quadratic.
 */
#define UMB_COORDINATES_CIRCLE 1

/**
 * N_CM of "New Computation of Normal Vector and Curvature": a conformal map of the ring and mean value coordinates.
 * Edge normals unit(N_(i-1) + N_i) with weights (tan(alpha_(i-1)/2) + tan(alpha_i/2)) / (length of the edge), where alpha_i
 * is 2 pi theta_i / (sum of theta) in a closed fan and theta_i in an open one, held just below pi; beyond the ends of an open
 * fan there is no tangent, and its end edges have the normal of their one face. The default; the best one-ring average on
 * irregular smooth meshes.
 */
#define UMB_WEIGHT_CONFORMAL 0

/**
 * 1 (Gouraud 1971, N_G).
 */
#define UMB_WEIGHT_UNIFORM 1

/**
 * theta_i (Thuermer and Wuethrich 1998, N_T). Does not depend on how a flat face is cut up.
 */
#define UMB_WEIGHT_ANGLE 2

/**
 * A_i (N_M).
 */
#define UMB_WEIGHT_AREA 3

/**
 * |sin theta_i| / (a b) (Max 1999). Exact where the vertex and its neighbours lie on a sphere.
 */
#define UMB_WEIGHT_MAX 4

/**
 * A_i / g_i (N_C of Chen and Wu 2004 as the paper prints it).
 */
#define UMB_WEIGHT_CENTROID_AREA 5

/**
 * 1 / g_i^2 (N_C of Chen and Wu 2004 as the paper's tables use it).
 */
#define UMB_WEIGHT_CENTROID 6

/**
 * 1 / sqrt(a b) (Jin, Lewis and West 2005).
 */
#define UMB_WEIGHT_INVERSE_ROOT_EDGES 7

/**
 * |sin theta_i|
 */
#define UMB_WEIGHT_SINE 8

/**
 * theta_i a b
 */
#define UMB_WEIGHT_ANGLE_EDGES 9

/**
 * No average, but the normal of an osculating jet (Cazals and Pouget 2005): a polynomial height field, fitted by least
 * squares to the vertices within several rings, over their plane of least squares. See `degree` and `rings` of
 * `umb_normal_options`. On smooth surfaces of a higher order than any average, and twenty to forty times as expensive; on
 * creases it rounds what the averages keep. The area-weighted normal says to which side it points.
 */
#define UMB_WEIGHT_JET 10

/**
 * No average, but the normal of an adaptive jet: a polynomial height field of degree 4 over three to six rings, whose weights and
 * prior follow from the noise and the smoothness that the mesh itself shows (see `umb_adaptive_model`). The most accurate normals of this
 * library on smooth surfaces, clean or noisy, of triangles or polygons; where a neighbourhood crosses a crease, only what is on the
 * vertex's side counts. A vertex on a crease (`UMB_VERTEX_CREASE` and `UMB_VERTEX_FALLBACK`) has the mean direction of its sides. Three to five times as expensive as
 * `UMB_WEIGHT_JET`. See `rings` and `model` of `umb_normal_options`.
 */
#define UMB_WEIGHT_ADAPTIVE_JET 11

/**
 * Max's normal, tilted so that the sections along the edges of the ring agree best with one shape operator (one 5 x 5 solve). Exact
 * where the vertex and its neighbours lie on a sphere; the most accurate normal of one ring on smooth surfaces with little noise.
 */
#define UMB_WEIGHT_TILTED_SECTIONS 12

/**
 * Adaptive jets: a polynomial height field of degree 4 over `rings` (at most 8; 0: 3 to 6, as many as the noise asks for), whose
 * weights and prior follow from the noise and the smoothness that the mesh itself shows (see `umb_adaptive_model` and `model`), with the curvatures of the fitted
 * surface. The most accurate of all here on clean, noisy, open, closed and creased meshes, of triangles or polygons: the default.
 * Its `normal` is the fitted surface's. Neighbours whose one-ring normals are more than 60 degrees from the vertex's do not count,
 * so nothing is smeared over creases; a vertex on a crease (`UMB_VERTEX_CREASE` and `UMB_VERTEX_FALLBACK`) has the curvatures that fit the
 * circles along its edges best, about the mean direction of its sides: large across, and small along the crease. Where a fit has no solution in range, Max's normal
 * stays, and curvatures are 0 (`UMB_VERTEX_FALLBACK` without `UMB_VERTEX_CREASE`). `normals` and `weight` are not looked at.
 */
#define UMB_CURVATURE_ADAPTIVE_JET 0

/**
 * Osculating jets (Cazals and Pouget 2005): a polynomial height field over several rings, over the plane of least squares of
 * its points, with the curvatures of the fitted surface. `degree` is 2 to 4 (0: 3), `rings` at most 8 (0: 2 up to degree 3,
 * 3 at degree 4). Of order degree - 1 on meshes of any kind. Where points are too few or in special position
 * the neighbourhood is widened (`UMB_VERTEX_WIDENED`), then the degree lowered, then curvatures are 0
 * (`UMB_VERTEX_FALLBACK`). Its `normal` is the fitted surface's. `normals`, if given, tell its sides apart, else area-weighted
 * ones do; `weight` is not looked at.
 */
#define UMB_CURVATURE_JET 1

/**
 * A quadratic height field in the frame of the vertex normal, tangent to its plane (Hamann 1993). `rings` at most 8 (0: 1);
 * widened as jets are. As good as the normals.
 */
#define UMB_CURVATURE_QUADRIC 2

/**
 * Goldfeather and Interrante 2004: a cubic height field fitted to positions and normals of the neighbours. `rings` at most 8
 * (0: 1); widened as jets are. As good as the normals, which it needs of up to four rings more than it was asked for.
 */
#define UMB_CURVATURE_GOLDFEATHER 3

/**
 * The sections (circles) along all edges of one ring, with a tilt of Max's normal (or of the given `normals`; `weight` is not looked
 * at): one 5 x 5 solve for the shape operator and the tilt, whose result is `normal`. Exact on spheres; the most accurate curvature of
 * one ring on smooth surfaces with little noise.
 */
#define UMB_CURVATURE_TILTED_SECTIONS 4

/**
 * The shape operator whose normal curvatures fit those of the sections along all edges best, in least squares. With
 * `UMB_SECTION_CIRCLE` and exact normals exact on spheres. Where the edges leave a part of it undetermined (within about a
 * degree of two perpendicular lines, as in a grid of quads), the point is taken to be as round as they allow
 * (`UMB_VERTEX_FALLBACK`). Does not converge with one-ring normals on irregular meshes.
 */
#define UMB_CURVATURE_LEAST_SQUARES 5

/**
 * Taubin 1995: k = 3 m1 - m2, 3 m2 - m1 for the eigenvalues m of the sum of w kappa T T^T over the edges, w the area of the
 * faces at an edge. Does not converge, unless the edges stand at even angles.
 */
#define UMB_CURVATURE_TAUBIN 6

/**
 * Watanabe and Belyaev 2001: H and (3 H^2 - K)/2 as the means of sectional curvature and of its square, by the trapezoid rule
 * over the angles of the faces. Does not converge, unless the edges stand at even angles.
 */
#define UMB_CURVATURE_WATANABE 7

/**
 * Meyer et al. 2003: H N by cotangents, K by the angle defect, both over the mixed Voronoi area (in polygons: by the
 * Laplacian of Alexa and Wardetzky 2011, over an equal share of the area for each corner). At a boundary the integrals
 * hold the pull and the turning of the boundary. Does not converge on irregular meshes.
 */
#define UMB_CURVATURE_MEYER 8

/**
 * The angle defect of Gauss and Bonnet: 2 pi less the angles of a closed fan, pi less those of an open one; fans add up.
 * The integrals over all vertices sum up to 2 pi times the Euler characteristic; where vertices have several fans or edges
 * end them, to that of the surface cut open there. Without area the pointwise K is 0 (`UMB_VERTEX_FALLBACK`) and the integral
 * stands. Takes no normals.
 */
#define UMB_CURVATURE_ANGLE_DEFECT 9

/**
 * Rusinkiewicz 2004: shape operators of faces from the differences of vertex normals, averaged by mixed area. Converges if
 * the normals are better than first order.
 */
#define UMB_CURVATURE_RUSINKIEWICZ 10

/**
 * The normal cycle (Cohen-Steiner and Morvan 2003): dihedral angles along edges, over a region of `rings` (0: 1) or of
 * `radius`. Edges of a single face have none, so values at a boundary are too small, and so are those on polygons that are
 * not flat, whose twist no edge has. Converges over balls that shrink more slowly than the edges.
 */
#define UMB_CURVATURE_NORMAL_CYCLE 11

/**
 * Interpolated corrected curvature measures (Lachaud, Romon, Thibert and Coeurjolly 2020), over a region of `rings` (0: 1) or
 * of `radius`. Converges if the normals do; exact on spheres with exact normals. H and K are the measures by the area; k1,
 * k2 and the directions come from the tensor, so k1 k2 is K only in the limit.
 */
#define UMB_CURVATURE_CORRECTED_MEASURE 12

/**
 * The symmetric parabola, kappa_SP: 4 cos(phi/2) / ((|a| + |c|) sin^2(phi/2)), or -2 N.x / |x - (N.x) N|^2. It grows
 * without bound as the corner sharpens. The default.
 */
#define UMB_SECTION_SYMMETRIC_PARABOLA 0

/**
 * The circle, kappa_C: 2 sin(phi) / d, or -2 N.x / |x|^2. At most 2 / max(|a|, |c|).
 */
#define UMB_SECTION_CIRCLE 1

/**
 * The parabola with the standard parameter 1/2 at V, kappa_P: 8 |a| |c| sin(phi) / d^3; of one edge as
 * `UMB_SECTION_SYMMETRIC_PARABOLA`.
 */
#define UMB_SECTION_PARABOLA 2

/**
 * The parabola with its parameter in proportion to |a| and |c|: 2 (|a| + |c|)^2 sin(phi) / d^3; of one edge as
 * `UMB_SECTION_SYMMETRIC_PARABOLA`.
 */
#define UMB_SECTION_LENGTH_PARABOLA 3

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * A short English description of a status, for any number. Never null; static.
 *
 * @since 0.1.0
 */
UMB_API
const char *umb_status_string(umb_status status);

/**
 * Builds the one-rings of a mesh.
 *
 * Faces are joined across an edge only where it has exactly two and they run through it in opposite directions; every
 * other edge (one face, three or more, inconsistent winding) ends the fans on all its sides, and is counted. Faces that
 * name a vertex twice in a row lose the repetition; faces of fewer than three corners are ignored. No mesh is refused for
 * its shape.
 *
 * Cost: linear in the number of corners, apart from sorting the corners of vertices with more than eight of them or with
 * several fans; every thread reads all faces. Held are about 16 bytes a triangle, or 60 a quad. While building, 65 more a vertex,
 * or 97 where there are polygons, and with several threads 12 more a triangle. The handle is the same on any number of threads, with any vectors.
 *
 * @param faces the faces; read only during the call
 * @param vertex_count the number of vertices, at most 2^32 - 1, as of faces; there may be at most 2^31 - 1 corners
 * @param options may be null
 * @param topology receives the handle; destroy it with `umb_topology_destroy`
 * @param error may be null
 *
 * Errors: `UMB_ERROR_NULL_POINTER`, `_STRUCT_SIZE`, `_UNKNOWN_FIELD`, `_UNKNOWN_CONSTANT`, `_MISALIGNED`, `_SIZE`,
 * `_OFFSETS` (element: face), `_INDEX_OUT_OF_RANGE` (element: place in `indices`), `_TOO_LARGE`, `_OUT_OF_MEMORY`.
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_topology_create(const struct umb_faces *faces,
                               size_t vertex_count,
                               const struct umb_topology_options *options,
                               struct umb_topology **topology,
                               struct umb_error *error);

/**
 * Frees a topology; null is fine.
 *
 * @since 0.1.0
 */
UMB_API
void umb_topology_destroy(struct umb_topology *topology);

/**
 * The number of vertices; 0 for null.
 *
 * @since 0.1.0
 */
UMB_API
size_t umb_topology_vertex_count(const struct umb_topology *topology);

/**
 * The number of faces, ignored ones included; 0 for null.
 *
 * @since 0.1.0
 */
UMB_API
size_t umb_topology_face_count(const struct umb_topology *topology);

/**
 * The `UMB_VERTEX_` bits of each vertex that follow from the faces alone, `#V` bytes in the handle's memory; null for
 * null.
 *
 * @since 0.1.0
 */
UMB_API
const uint8_t *umb_topology_flags(const struct umb_topology *topology);

/**
 * Counts elements, defects, components and boundary loops. Linear in the size of the mesh.
 *
 * @param topology the handle
 * @param stats receives the counts; set its `struct_size` (or 0) before
 * @param error may be null
 *
 * Errors: `UMB_ERROR_NULL_POINTER`, `_STRUCT_SIZE`, `_OUT_OF_MEMORY`.
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_topology_get_stats(const struct umb_topology *topology,
                                  struct umb_topology_stats *stats,
                                  struct umb_error *error);

/**
 * Where each vertex's ring starts in the ring array, and the end of the last: `#V + 1` numbers, in the topology's memory;
 * null if `topology` is.
 *
 * The ring of a vertex holds its neighbours fan after fan, each counter-clockwise: in a closed fan one for each of its faces,
 * in an open one one more (see `umb_topology_fan`).
 *
 * @param topology the handle
 * @since 0.1.0
 */
UMB_API
const uint32_t *umb_topology_ring_offsets(const struct umb_topology *topology);

/**
 * The ring array: the neighbours of all vertices, in the topology's memory; null if `topology` is.
 *
 * @param topology the handle
 * @since 0.1.0
 */
UMB_API
const uint32_t *umb_topology_ring_neighbours(const struct umb_topology *topology);

/**
 * The number of edges at a vertex. Constant time at a manifold vertex; at one with several fans a copy of its ring is
 * sorted.
 *
 * @param topology the handle
 * @param vertex the vertex
 * @param valence receives the number
 * @param error may be null
 *
 * Errors: `UMB_ERROR_NULL_POINTER`, `_INDEX_OUT_OF_RANGE` (element: the vertex), `_OUT_OF_MEMORY`.
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_topology_valence(const struct umb_topology *topology,
                                size_t vertex,
                                size_t *valence,
                                struct umb_error *error);

/**
 * The number of fans of a vertex: 1 at a manifold vertex, 0 at an isolated one.
 *
 * @param topology the handle
 * @param vertex the vertex
 * @param fan_count receives the number
 * @param error may be null
 *
 * Errors: `UMB_ERROR_NULL_POINTER`, `_INDEX_OUT_OF_RANGE` (element: the vertex).
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_topology_fan_count(const struct umb_topology *topology,
                                  size_t vertex,
                                  size_t *fan_count,
                                  struct umb_error *error);

/**
 * A fan of a vertex: its part of the vertex's ordered one-ring.
 *
 * @param topology the handle
 * @param vertex the vertex
 * @param index which of its fans, below `umb_topology_fan_count`
 * @param fan receives the fan
 * @param error may be null
 *
 * Errors: `UMB_ERROR_NULL_POINTER`, `_INDEX_OUT_OF_RANGE` (element: the vertex, or the index of the fan).
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_topology_fan(const struct umb_topology *topology,
                            size_t vertex,
                            size_t index,
                            struct umb_fan *fan,
                            struct umb_error *error);

/**
 * Learns what adaptive jets use of a mesh, from a sample of all its vertices: declare `umb_adaptive_model model =
 * UMB_ADAPTIVE_MODEL_INIT`, learn, and point `options.model` at it.
 *
 * @param topology the handle
 * @param points the positions of all its vertices; read only during the call
 * @param options of which only `run` counts, and of that not `vertices`; may be null
 * @param model receives the numbers; set its `struct_size` (or 0) before
 * @param error may be null
 *
 * Errors: as `umb_vertex_normals`. Threads, bits: likewise.
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_learn_model(const struct umb_topology *topology,
                           const struct umb_points *points,
                           const struct umb_normal_options *options,
                           struct umb_adaptive_model *model,
                           struct umb_error *error);

/**
 * Computes vertex normals over the one-rings of a topology, or, for jets, over several rings.
 *
 * Pointwise unit vectors; they point to the side from which faces run counter-clockwise. Polygons count by their area
 * vector, taken relative to the polygon. At a boundary vertex the open fan counts as it is; at a non-manifold vertex the
 * sums of all fans are added. Faces whose area is exactly zero, edges without length and pairs of opposite faces drop out
 * of a sum (a face that is thin to rounding counts, with the normal that its coordinates give; one thinner than 1e-135 of
 * its ring does not); if nothing is left, the vertex takes the normal by Max's weight, else by area, else of any face (status
 * `UMB_VERTEX_FALLBACK`), else (0, 0, 0) (`UMB_VERTEX_DEGENERATE`). Nothing is ever NaN or infinite.
 *
 * `UMB_WEIGHT_ADAPTIVE_JET` widens nothing; where its fit has no solution in range, the vertex keeps Max's normal
 * (`UMB_VERTEX_FALLBACK` without `UMB_VERTEX_CREASE`). `UMB_WEIGHT_TILTED_SECTIONS` does likewise. `UMB_WEIGHT_JET`: a neighbourhood with
 * fewer vertices than the polynomial has coefficients, or whose vertices do not determine it, is
 * widened by up to four rings (`UMB_VERTEX_WIDENED`). Where that does not help, the vertex takes a polynomial of lower
 * degree, else the area-weighted normal (`UMB_VERTEX_FALLBACK`), else (0, 0, 0) (`UMB_VERTEX_DEGENERATE`). A jet more than 75
 * degrees from the area-weighted normal is not believed: heights are then taken along that normal instead
 * (`UMB_VERTEX_FALLBACK`).
 *
 * Positions are taken relative to each vertex and scaled by powers of two, so neither the distance from the origin nor
 * the size of the mesh costs accuracy. Single precision is used if positions and outputs all are `f32` and faces are
 * triangles, not for jets and tilted sections, and then only where its error stays below about 1e-6; all else is double precision. The results are the same
 * bits for any number of threads, any vectors and any choice of vertices.
 *
 * Threads: any number of calls may use one topology at once. Cost: linear in the number of corners.
 *
 * @param topology the handle
 * @param points the positions of all its vertices, as many as the topology has; read only during the call
 * @param options may be null
 * @param outputs where results go; each has an element for every vertex. Written only if the call succeeds, or, after
 * a cancel, in part
 * @param error may be null
 *
 * Errors: `UMB_ERROR_NULL_POINTER`, `_STRUCT_SIZE`, `_UNKNOWN_FIELD`, `_UNKNOWN_CONSTANT`, `_STRIDE`, `_MISALIGNED`,
 * `_SIZE`, `_INDEX_OUT_OF_RANGE` (element: place in `vertices`), `_NON_FINITE` (element: vertex), `_OPTION_OUT_OF_RANGE`,
 * `_OUT_OF_MEMORY`, `_CANCELLED`.
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_vertex_normals(const struct umb_topology *topology,
                              const struct umb_points *points,
                              const struct umb_normal_options *options,
                              const struct umb_normal_outputs *outputs,
                              struct umb_error *error);

/**
 * Computes vertex normals once, straight from faces: builds a topology for the call and forgets it. The results are those
 * of `umb_vertex_normals`, to the bit.
 *
 * @param faces the faces; read only during the call
 * @param points the positions of all vertices; read only during the call
 * @param options may be null
 * @param outputs where results go, as in `umb_vertex_normals`
 * @param error may be null
 *
 * Errors: as `umb_vertex_normals` and `umb_topology_create`.
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_vertex_normals_from_faces(const struct umb_faces *faces,
                                         const struct umb_points *points,
                                         const struct umb_normal_options *options,
                                         const struct umb_normal_outputs *outputs,
                                         struct umb_error *error);

/**
 * Computes face normals: unit vectors along each face's area vector, `1/2 sum (p_k - p_0) x (p_(k+1) - p_0)`, which is
 * right for triangles, concave and non-planar polygons, collinear and repeated corners. A face whose area vector vanishes
 * has the normal (0, 0, 0) and the status `UMB_VERTEX_DEGENERATE`. Double precision; same bits on any number of threads.
 *
 * @param faces the faces; read only during the call
 * @param points the positions of all vertices; read only during the call
 * @param options may be null
 * @param outputs where results go; each has an element for every face
 * @param error may be null
 *
 * Errors: as `umb_vertex_normals` and `umb_topology_create`.
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_face_normals(const struct umb_faces *faces,
                            const struct umb_points *points,
                            const struct umb_face_options *options,
                            const struct umb_face_outputs *outputs,
                            struct umb_error *error);

/**
 * Computes curvatures at the vertices of a mesh.
 *
 * Signs: a normal section is positive where the surface bends away from the normal, so a sphere of radius r with outward
 * normals (faces counter-clockwise from outside) has k1 = k2 = H = 1/r and K = 1/r^2. k1 >= k2. Reversing all faces makes k1
 * of -k2 and the other way round, and exchanges the directions; H and its integral change sign, K, H N and areas do not.
 *
 * A vertex without any face is isolated, one where the method has nothing to work with is degenerate (no normal, no area, no
 * edge with a length): all results are 0 there but the normal, if there is one. Nothing is ever NaN or infinite; beyond the scalar's range its largest value
 * stands. What each method makes of a boundary is said with its constant; the status tells boundary vertices.
 *
 * Methods of one ring are computed in single precision if positions, given normals and outputs all are `f32` and faces are triangles
 * (not tilted sections; nor Watanabe's and Meyer's methods with outputs that follow from `k1` and `k2`; nor least squares with
 * residuals), and then only where that is off by less than about 2e-6 by the length of the shortest edge at the vertex; all else is
 * double precision. So asking for an output in `f64`, or for one of those named, changes the last bits of others. Computation is relative to each vertex and scaled by powers of two, so neither the distance
 * from the origin nor the size of the mesh costs accuracy. The results are the same bits for any number of threads, any
 * vectors and any choice of vertices.
 *
 * Threads: any number of calls may use one topology at once. Cost: linear in the number of corners; for methods of several
 * rings, times the vertices within these. A neighbourhood of several rings ends at 255 vertices, breadth first, and takes
 * 64 evenly spaced neighbours of a vertex that has more.
 *
 * @param topology the handle
 * @param points the positions of all its vertices, as many as the topology has; read only during the call
 * @param options may be null
 * @param outputs where results go; each has an element for every vertex. Written only if the call succeeds, or, after
 * a cancel, in part
 * @param error may be null
 *
 * Errors: `UMB_ERROR_NULL_POINTER`, `_STRUCT_SIZE`, `_UNKNOWN_FIELD`, `_UNKNOWN_CONSTANT`, `_STRIDE`, `_MISALIGNED`,
 * `_SIZE`, `_INDEX_OUT_OF_RANGE` (element: place in `vertices`), `_NON_FINITE` (element: vertex), `_NOT_APPLICABLE`,
 * `_OPTION_OUT_OF_RANGE`, `_OUT_OF_MEMORY`, `_CANCELLED`.
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_curvatures(const struct umb_topology *topology,
                          const struct umb_points *points,
                          const struct umb_curvature_options *options,
                          const struct umb_curvature_outputs *outputs,
                          struct umb_error *error);

/**
 * Computes the curvature of the section along every edge of every vertex's ring, with the vertex normal.
 *
 * `curvature` and `status` have an element for each entry of the ring array (`umb_topology_ring_neighbours`): the sections of
 * vertex v are those from entry v of `umb_topology_ring_offsets` on. With a list of vertices only their entries are written.
 * `directions` must be zero.
 *
 * Precision, bits, threads, cost: as `umb_curvatures`.
 *
 * @param topology the handle
 * @param points the positions of all its vertices; read only during the call
 * @param options may be null
 * @param outputs where results go. Written only if the call succeeds, or, after a cancel, in part
 * @param error may be null
 *
 * Errors: as `umb_curvatures`.
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_edge_sections(const struct umb_topology *topology,
                             const struct umb_points *points,
                             const struct umb_section_options *options,
                             const struct umb_section_outputs *outputs,
                             struct umb_error *error);

/**
 * Computes the curvatures of normal sections in given tangent directions: the plane of the vertex normal and a direction cuts
 * the polygon of the ring's neighbours in a point on either side of the vertex, and the three points give the curvature.
 *
 * `curvature` and `status` have an element for each vertex; with a shared set of `#D` directions, `#V x #D`: those of vertex v
 * from v #D on. At a boundary, where the plane meets the ring on one side only, the mirror image of that point stands in
 * for the other (`UMB_SECTION_STATUS_ONE_SIDED`). The two points lie on chords between neighbours, not on the surface, so even
 * with exact normals the error need not shrink with the edges, unless the plane passes close to neighbours.
 *
 * Precision, bits, threads: as `umb_curvatures`. Cost: linear in the number of corners times the number of directions.
 *
 * @param topology the handle
 * @param points the positions of all its vertices; read only during the call
 * @param options the directions, and how; not null
 * @param outputs where results go. Written only if the call succeeds, or, after a cancel, in part
 * @param error may be null
 *
 * Errors: as `umb_curvatures`; `UMB_ERROR_NON_FINITE` also for a direction (element: its index).
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_direction_sections(const struct umb_topology *topology,
                                  const struct umb_points *points,
                                  const struct umb_section_options *options,
                                  const struct umb_section_outputs *outputs,
                                  struct umb_error *error);

/**
 * Computes the curvatures at the vertices of a polyline, each from the vertex and its two neighbours.
 *
 * Pointwise, in 1/length. In the plane, positive where the polyline turns left, so all along a convex polygon that
 * runs counter-clockwise; in space, at least 0. Where the three points lie on a line in this order, exactly 0. If
 * |a| = |c|, the three parabolas agree. As the points of a smooth curve get closer, kappa_C, kappa_PL and kappa_SP tend
 * to its curvature, but kappa_P to 4 |a| |c| / (|a| + |c|)^2 times that, so only on evenly spaced points to the
 * same. Reversing a polyline in the plane changes the sign (but not of 0, nor at a cusp), and no other bit.
 *
 * The ends of an open polyline have curvature 0 (`UMB_POLYLINE_END`). At a cusp (`UMB_POLYLINE_CUSP`) kappa_SP is
 * infinite, and the largest value of the output's scalar is written, positive; the others are 0, as the formulas say,
 * unless both neighbours are one point, as in a closed polyline of two points: then kappa_P and kappa_PL are infinite
 * as well, and kappa_C is 2 / |a|. Points that repeat their neighbour are passed over (`UMB_POLYLINE_COINCIDENT`): all
 * points of such a run get the curvature of the corner that they stand for. What is beyond the scalar's range is
 * written as its largest value. For finite input nothing is ever NaN or infinite.
 *
 * Double precision, edges scaled by powers of two: neither the size of a polyline nor the ratio of its edges costs
 * accuracy. The results are the same bits for any number of threads and any vectors.
 *
 * Threads: any number of calls at once. Cost: linear in the number of points.
 *
 * @param polyline the points; read only during the call
 * @param options may be null
 * @param outputs where results go; each has an element for every point. Written only if the call succeeds, or, after a
 * cancel, in part
 * @param error may be null
 *
 * Errors: `UMB_ERROR_NULL_POINTER`, `_STRUCT_SIZE`, `_UNKNOWN_FIELD`, `_UNKNOWN_CONSTANT` (scalars, `dimension`,
 * `closed`), `_STRIDE`, `_MISALIGNED`, `_SIZE`, `_NON_FINITE` (element: point), `_OUT_OF_MEMORY`, `_CANCELLED`.
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_polyline_curvatures(const struct umb_polyline *polyline,
                                   const struct umb_polyline_options *options,
                                   const struct umb_polyline_outputs *outputs,
                                   struct umb_error *error);

/**
 * Cuts a mesh along its creases.
 *
 * Corners at a vertex stay together if they can be reached from each other across edges at the vertex that two faces share (as
 * `umb_topology_create` joins them) and that are no creases. So a vertex with several fans is cut between them, and a crease that ends
 * in a smooth part does not cut the vertex at its end. Vertices of the cut mesh are numbered by the vertex they come from, those of one by
 * their first corners; a vertex without faces keeps one. So without creases on a manifold mesh, numbers stay what they are.
 *
 * Positions are looked at for the angles only: as they move, the cut stays until the caller makes another.
 *
 * Cost: linear in the number of corners, on one thread but for normals and topology. Held are the topology and 4 bytes a corner, a
 * vertex and a vertex of the cut mesh.
 *
 * @param faces the faces; read only during the call
 * @param points the positions of all vertices; read only during the call
 * @param creases which edges to cut; may be null
 * @param options how to build the topology; may be null
 * @param cut receives the handle; destroy it with `umb_cut_destroy`
 * @param error may be null
 *
 * Errors: those of `umb_topology_create`; `UMB_ERROR_STRIDE`, `_INDEX_OUT_OF_RANGE` also for `creases.edges` (element: place in it),
 * `_NON_FINITE` (element: vertex), `_OPTION_OUT_OF_RANGE` for an angle that is negative or NaN.
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_cut_create(const struct umb_faces *faces,
                          const struct umb_points *points,
                          const struct umb_creases *creases,
                          const struct umb_topology_options *options,
                          struct umb_cut **cut,
                          struct umb_error *error);

/**
 * Frees a cut mesh, its topology included; null is fine.
 *
 * @since 0.1.0
 */
UMB_API
void umb_cut_destroy(struct umb_cut *cut);

/**
 * The topology of the cut mesh, for every call that takes one; it lives as long as the cut mesh and must not be destroyed. Null for
 * null.
 *
 * @since 0.1.0
 */
UMB_API
const struct umb_topology *umb_cut_topology(const struct umb_cut *cut);

/**
 * The number of vertices of the cut mesh; 0 for null.
 *
 * @since 0.1.0
 */
UMB_API
size_t umb_cut_vertex_count(const struct umb_cut *cut);

/**
 * The number of corners, those of ignored faces included; 0 for null.
 *
 * @since 0.1.0
 */
UMB_API
size_t umb_cut_corner_count(const struct umb_cut *cut);

/**
 * The vertex of the cut mesh at each corner, `#C` numbers in the handle's memory: the faces of the cut mesh, with the offsets or the arity
 * of the original ones. Null for null.
 *
 * @since 0.1.0
 */
UMB_API
const uint32_t *umb_cut_corners(const struct umb_cut *cut);

/**
 * The original vertex of each vertex of the cut mesh, ascending, in the handle's memory; null for null.
 *
 * @since 0.1.0
 */
UMB_API
const uint32_t *umb_cut_origins(const struct umb_cut *cut);

/**
 * Where the vertices of the cut mesh that come from each original vertex start, `#V + 1` numbers in the handle's memory: those of vertex `v` are
 * the numbers from `starts[v]` up to `starts[v + 1]`, so that what moves or is marked there is found here. Null for null.
 *
 * @since 0.1.0
 */
UMB_API
const uint32_t *umb_cut_starts(const struct umb_cut *cut);

/**
 * Copies an element for each original vertex, positions for example, to each vertex of the cut mesh that comes from it: what calls
 * over `umb_cut_topology` take. A number beyond the range of the output's scalar becomes its largest; what is not finite stays so.
 *
 * @param cut the handle
 * @param points an element for each original vertex
 * @param output receives an element for each vertex of the cut mesh; must not overlap `points`
 * @param error may be null
 *
 * Errors: `UMB_ERROR_NULL_POINTER`, `_UNKNOWN_FIELD`, `_UNKNOWN_CONSTANT`, `_STRIDE`, `_MISALIGNED`, `_SIZE`.
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_cut_points(const struct umb_cut *cut,
                          const struct umb_points *points,
                          const struct umb_output *output,
                          struct umb_error *error);

/**
 * Computes a unit normal for each corner of each face: smooth where faces go on, split at creases.
 *
 * They are the vertex normals of the cut mesh, by any weight: an open run of faces counts as one at a boundary does. Where nothing is cut, they are those of
 * `umb_vertex_normals`, to the bit if all outputs are of one scalar: one in `f64` has all computed in double precision. `UMB_WEIGHT_ANGLE` is what Blender takes for corner normals, and what those expect who bake
 * or shade with MikkTSpace: it makes tangents, and takes normals as they are given.
 *
 * A renderer that has an index for each attribute takes `normal` with `umb_cut_corners`; one that has a single index
 * takes `umb_cut_corners` as that, `normal`, and positions by `umb_cut_points`; others take `corner`.
 *
 * @param cut the handle
 * @param points the positions of the original vertices; read only during the call
 * @param options as for `umb_vertex_normals`; a list of vertices is one of the cut mesh, and goes without `corner`. May be null
 * @param outputs where results go
 * @param error may be null; the element of a position that is not finite is the original vertex
 *
 * Errors: those of `umb_vertex_normals`; `_NOT_APPLICABLE` for `corner` with a list.
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_corner_normals(const struct umb_cut *cut,
                              const struct umb_points *points,
                              const struct umb_normal_options *options,
                              const struct umb_corner_outputs *outputs,
                              struct umb_error *error);

/**
 * Computes corner normals once, straight from faces: cuts the mesh for the call and forgets it. The results are those of
 * `umb_corner_normals`, to the bit.
 *
 * @param faces the faces; read only during the call
 * @param points the positions of all vertices; read only during the call
 * @param creases which edges to cut; may be null
 * @param options as for `umb_vertex_normals`, without a list; may be null
 * @param corner receives a unit normal for each corner, `#C x 3`, in the order of the indices of the faces
 * @param error may be null
 *
 * Errors: those of `umb_cut_create` and `umb_corner_normals`.
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_corner_normals_from_faces(const struct umb_faces *faces,
                                         const struct umb_points *points,
                                         const struct umb_creases *creases,
                                         const struct umb_normal_options *options,
                                         const struct umb_output *corner,
                                         struct umb_error *error);

/**
 * Lists the vertices whose normals may change as others move: what `vertices` of `umb_run` has to be for a call that brings the normals up
 * to date. Such a call gives, with those it leaves alone, the same bits as a call for all.
 *
 * These are the vertices within as many rings of those that moved as a normal depends on: one for averages, those of the fit for jets,
 * one more than those of the fit for adaptive jets. Adaptive jets need a model (`umb_learn_model`): without, each normal depends on all
 * positions.
 *
 * Threads: any number of calls may use one topology at once. Cost: the rings of what is found, and next to nothing for the rest of
 * the mesh: a byte a vertex that is cleared.
 *
 * @param topology the handle
 * @param moved the vertices that moved
 * @param options those of the call for the normals; `run` is not looked at. May be null
 * @param vertices receives the list, each vertex once, those that moved first; null, with no room, to ask for their number alone
 * @param room how many `vertices` has room for; as many as the topology has vertices are enough for any list
 * @param count receives the number of vertices in the list
 * @param error may be null
 *
 * Errors: `UMB_ERROR_NULL_POINTER`, `_STRUCT_SIZE`, `_UNKNOWN_FIELD`, `_UNKNOWN_CONSTANT`, `_MISALIGNED`, `_SIZE`,
 * `_INDEX_OUT_OF_RANGE` (element: place in `moved->vertices`), `_NOT_APPLICABLE` (no model), `_OPTION_OUT_OF_RANGE`, `_OUT_OF_MEMORY`.
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_affected_normals(const struct umb_topology *topology,
                                const struct umb_moved *moved,
                                const struct umb_normal_options *options,
                                uint32_t *vertices,
                                size_t room,
                                size_t *count,
                                struct umb_error *error);

/**
 * Lists the vertices whose curvatures may change as others move, or as normals do that the caller gives for them. Else as
 * `umb_affected_normals`; the curvatures of regions by `radius` have no list (`UMB_ERROR_NOT_APPLICABLE`).
 *
 * @param topology the handle
 * @param moved the vertices that moved, or whose given normals changed
 * @param options those of the call for the curvatures; `run` is not looked at. May be null
 * @param vertices receives the list, each vertex once, those that moved first; null, with no room, to ask for their number alone
 * @param room how many `vertices` has room for; as many as the topology has vertices are enough for any list
 * @param count receives the number of vertices in the list
 * @param error may be null
 *
 * Errors: as `umb_affected_normals`; `_STRIDE` for given normals.
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_affected_curvatures(const struct umb_topology *topology,
                                   const struct umb_moved *moved,
                                   const struct umb_curvature_options *options,
                                   uint32_t *vertices,
                                   size_t room,
                                   size_t *count,
                                   struct umb_error *error);

/**
 * A tolerance for `umb_shape_classes` that goes with the size of a mesh: one by the diagonal of the bounding box of all points (those without faces as well: a stray one far off makes it small), so that a
 * ball counts as curved up to a radius of the diagonal, and a cylinder up to half of that. 0 if the points are one or none. In 1/length. For
 * meshes with noise take two to four times as much.
 *
 * @param points the positions of all vertices; read only during the call
 * @param tolerance receives the number
 * @param error may be null
 *
 * Errors: `UMB_ERROR_NULL_POINTER`, `_UNKNOWN_FIELD`, `_UNKNOWN_CONSTANT`, `_STRIDE`, `_MISALIGNED`, `_SIZE`, `_NON_FINITE` (element:
 * vertex).
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_shape_tolerance(const struct umb_points *points,
                               double *tolerance,
                               struct umb_error *error);

/**
 * Writes the shape class of each vertex (or face), a `UMB_SHAPE_` constant, from its principal curvatures: by the signs of
 * H = (k1 + k2)/2, which is 0 up to a tolerance t, and of K = k1 k2, which is 0 up to t^2 (Besl and Jain 1986, whose H has the other sign: here
 * it is positive where the surface bends away from its normal, as on a ball with outward normals).
 *
 * Both comparisons are as if without rounding. Same bits on any number of threads. Koenderink's shape index and curvedness are outputs of
 * `umb_curvatures`.
 *
 * @param k1 the principal curvatures, in either order
 * @param k2 likewise, as many, at the same place
 * @param options with a tolerance, or with points for the default
 * @param classes receives a byte for each of `k1`
 * @param error may be null
 *
 * Errors: `UMB_ERROR_NULL_POINTER`, `_STRUCT_SIZE`, `_UNKNOWN_FIELD`, `_UNKNOWN_CONSTANT`, `_STRIDE`, `_MISALIGNED`, `_SIZE`,
 * `_NON_FINITE` (element: vertex), `_OPTION_OUT_OF_RANGE`, `_CANCELLED`.
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_shape_classes(const struct umb_scalars *k1,
                             const struct umb_scalars *k2,
                             const struct umb_shape_options *options,
                             const struct umb_status_output *classes,
                             struct umb_error *error);

/**
 * Cuts a mesh into the parts that its creases bound: faces that meet are in one segment unless the edge between them is a crease. So a
 * crease that ends inside a smooth part separates nothing. A face without area has the normal of a neighbour across its longest edge, and so
 * does not join the two sides of a crease that it lies on.
 *
 * Cost: linear in the number of corners, on one thread.
 *
 * @param faces the faces; read only during the call
 * @param points the positions of all vertices; read only during the call
 * @param options may be null
 * @param segmentation receives the handle; destroy it with `umb_segmentation_destroy`
 * @param error may be null
 *
 * Errors: those of `umb_cut_create`; `_CANCELLED`.
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_segment_features(const struct umb_faces *faces,
                                const struct umb_points *points,
                                const struct umb_feature_options *options,
                                struct umb_segmentation **segmentation,
                                struct umb_error *error);

/**
 * Cuts a mesh into the basins of a height over its faces (Mangan and Whitaker 1999, here with basins that merge by depth as they meet:
 * persistence). A height at vertices becomes one at faces by the mean of the corners. Faces are flooded in ascending order: one without a lower
 * neighbour starts a basin, any other joins that of its lowest neighbour; connected faces of one height are one. Two basins merge
 * where they meet if the shallower of them is less deep than `depth`. Ties go to the face with the smaller index.
 *
 * Same bits on any number of threads. Cost: O(n log n), on one thread but for the curvatures.
 *
 * @param faces the faces; read only during the call
 * @param points the positions of all vertices, read only during the call; beside a height only their number counts
 * @param options may be null
 * @param segmentation receives the handle; destroy it with `umb_segmentation_destroy`
 * @param error may be null
 *
 * Errors: those of `umb_topology_create` and `umb_curvatures`; `UMB_ERROR_NON_FINITE` also for a height (element: place).
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_segment_watershed(const struct umb_faces *faces,
                                 const struct umb_points *points,
                                 const struct umb_watershed_options *options,
                                 struct umb_segmentation **segmentation,
                                 struct umb_error *error);

/**
 * Grows regions of faces by the shape classes of their vertices (see `umb_shape_classes`): flat, cylindrical, spherical and saddle parts,
 * whether creases bound them or not. Faces whose corners, those on creases aside, are all of one class make regions with neighbours of the same class
 * across edges that are no creases; the others, between parts, are added to the neighbour whose normal differs least; at last regions that are too small become
 * part of a neighbour: a smooth one if there is one, then one of the same class, then the one with the longest common border.
 *
 * By default curvatures are those of adaptive jets, which serve clean meshes and such with noise; with more noise than 1 % of the edges take a
 * larger smallest region. On clean meshes of machine parts those of one ring (`UMB_CURVATURE_LEAST_SQUARES`), with half the
 * tolerance, do as well and are faster. Two
 * parts of one class that join smoothly are not separated, nor is a cone, whose curvature has no bound, from what is flat at
 * its wide end by any tolerance.
 *
 * Same bits on any number of threads. Cost: O(n log n) at most, on one thread but for the curvatures.
 *
 * @param faces the faces; read only during the call
 * @param points the positions of all vertices; read only during the call
 * @param options may be null
 * @param segmentation receives the handle; destroy it with `umb_segmentation_destroy`
 * @param error may be null
 *
 * Errors: those of `umb_topology_create` and `umb_curvatures`; `UMB_ERROR_UNKNOWN_CONSTANT` also for a class.
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_segment_regions(const struct umb_faces *faces,
                               const struct umb_points *points,
                               const struct umb_region_options *options,
                               struct umb_segmentation **segmentation,
                               struct umb_error *error);

/**
 * Frees a segmentation; null is fine.
 *
 * @since 0.1.0
 */
UMB_API
void umb_segmentation_destroy(struct umb_segmentation *segmentation);

/**
 * The number of segments; 0 for null.
 *
 * @since 0.1.0
 */
UMB_API
size_t umb_segmentation_count(const struct umb_segmentation *segmentation);

/**
 * The number of faces, ignored ones included; 0 for null.
 *
 * @since 0.1.0
 */
UMB_API
size_t umb_segmentation_face_count(const struct umb_segmentation *segmentation);

/**
 * The label of each face, `#F`, in the handle's memory: below `umb_segmentation_count`, or `UMB_NO_SEGMENT`. Null for null.
 *
 * @since 0.1.0
 */
UMB_API
const uint32_t *umb_segmentation_labels(const struct umb_segmentation *segmentation);

/**
 * The number of edges between segments; 0 for null.
 *
 * @since 0.1.0
 */
UMB_API
size_t umb_segmentation_boundary_edge_count(const struct umb_segmentation *segmentation);

/**
 * The edges between segments, each once, as its lower and its higher vertex, ascending, in the handle's memory: edges at which faces carry
 * different labels, however many faces they have. Null for null.
 *
 * @since 0.1.0
 */
UMB_API
const uint32_t *umb_segmentation_boundary_edges(const struct umb_segmentation *segmentation);

/**
 * The area of each segment, length^2; a polygon's is the length of its area vector. What is beyond the range is its largest value.
 *
 * @param segmentation the handle
 * @param faces the faces that were segmented; read only during the call
 * @param points the positions of all vertices, those of then or others; read only during the call
 * @param areas receives a number for each segment
 * @param count the number of segments
 * @param error may be null
 *
 * Errors: `UMB_ERROR_NULL_POINTER`, `_UNKNOWN_FIELD`, `_UNKNOWN_CONSTANT`, `_STRIDE`, `_MISALIGNED`, `_SIZE`, `_OFFSETS`,
 * `_INDEX_OUT_OF_RANGE`, `_NON_FINITE` (element: vertex), `_OUT_OF_MEMORY`.
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_segmentation_areas(const struct umb_segmentation *segmentation,
                                  const struct umb_faces *faces,
                                  const struct umb_points *points,
                                  double *areas,
                                  size_t count,
                                  struct umb_error *error);

/**
 * The mean of a number over each segment, weighted by the area of the faces; over a segment without area that of its faces. A number at
 * vertices is taken as at faces, by the mean of the corners.
 *
 * @param segmentation the handle
 * @param faces the faces that were segmented; read only during the call
 * @param points the positions of all vertices; read only during the call
 * @param scalars the numbers, at vertices or at faces; read only during the call
 * @param means receives a number for each segment
 * @param count the number of segments
 * @param error may be null
 *
 * Errors: as `umb_segmentation_areas`; `UMB_ERROR_NON_FINITE` also for a number (element: place).
 * @since 0.1.0
 */
UMB_API
UMB_NODISCARD
umb_status umb_segmentation_means(const struct umb_segmentation *segmentation,
                                  const struct umb_faces *faces,
                                  const struct umb_points *points,
                                  const struct umb_scalars *scalars,
                                  double *means,
                                  size_t count,
                                  struct umb_error *error);

/**
 * The version of the library, `"0.1.0"`. Static.
 *
 * @since 0.1.0
 */
UMB_API
const char *umb_version(void);

/**
 * The number of the binary interface, `UMB_ABI_VERSION` of the header it was built with: a program runs with any library
 * that has the number of its header.
 *
 * @since 0.1.0
 */
UMB_API
uint32_t umb_abi_version(void);

/**
 * Name, version and the vectors that calls use by default, in one line for logs: the widest that the CPU has, or those that
 * the environment variable `UMBILIC_SIMD` (`portable`, `avx2`, `avx512`) names if they are narrower. Static.
 *
 * @since 0.1.0
 */
UMB_API
const char *umb_build_info(void);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* UMBILIC_H */

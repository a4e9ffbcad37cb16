/*
 * A copy of the library as a table of functions, and a round of calls of all kinds through it: so the same work can be done
 * by any copy in a process, on any thread, and compared by one number.
 */
#ifndef LIBRARY_H
#define LIBRARY_H

#include <dlfcn.h>

#include "mesh.h"

#define FUNCTIONS(X) \
  X(umb_build_info) X(umb_curvatures) X(umb_edge_sections) X(umb_face_normals) X(umb_learn_model) \
  X(umb_polyline_curvatures) X(umb_topology_create) X(umb_topology_destroy) X(umb_topology_fan) \
  X(umb_topology_get_stats) X(umb_topology_ring_offsets) X(umb_version) X(umb_vertex_normals)

struct library {
#define POINTER(name) __typeof__(name) *name;
  FUNCTIONS(POINTER)
#undef POINTER
};

/* The copy that a handle of dlopen stands for. */
static inline struct library library_of(void *handle) {
  struct library library;
  /* C has no cast from an object pointer to a function pointer; POSIX says that the bytes are the same. */
#define LOOK_UP(name) \
  do { \
    void *symbol = dlsym(handle, #name); \
    CHECK(symbol != NULL); \
    memcpy(&library.name, &symbol, sizeof symbol); \
  } while (0);
  FUNCTIONS(LOOK_UP)
#undef LOOK_UP
  return library;
}

/* What a round does: so that threads can do different things at the same time. */
enum kind { AVERAGES, JETS, ADAPTIVE, CURVATURES, SECTIONS, QUERIES, LEARNING, WITHOUT_HANDLE, KIND_COUNT };

static inline void normals_round(const struct library *library, const umb_topology *topology, const struct mesh *mesh,
                                 umb_weight weight, umb_scalar scalar, uint32_t threads, uint64_t *hash) {
  umb_error error = UMB_ERROR_INIT;
  umb_points points = points_of(mesh, scalar);
  struct array normals = array_of(mesh->vertex_count, 3, 1, scalar);
  umb_normal_options options = UMB_NORMAL_OPTIONS_INIT;
  umb_normal_outputs outputs = UMB_NORMAL_OUTPUTS_INIT;
  options.weight = weight;
  options.run.threads = threads;
  outputs.normal = output_of(&normals);
  SUCCEEDS(library->umb_vertex_normals(topology, &points, &options, &outputs, &error));
  *hash = hash_bytes(*hash, normals.data, normals.bytes);
  free(normals.data);
}

static inline void curvature_round(const struct library *library, const umb_topology *topology, const struct mesh *mesh,
                                   umb_curvature_method method, uint32_t threads, uint64_t *hash) {
  umb_error error = UMB_ERROR_INIT;
  umb_points points = points_of(mesh, UMB_SCALAR_F32);
  struct array gaussian = array_of(mesh->vertex_count, 1, 0, UMB_SCALAR_F32);
  umb_curvature_options options = UMB_CURVATURE_OPTIONS_INIT;
  umb_curvature_outputs outputs = UMB_CURVATURE_OUTPUTS_INIT;
  options.method = method;
  options.run.threads = threads;
  outputs.gaussian = output_of(&gaussian);
  SUCCEEDS(library->umb_curvatures(topology, &points, &options, &outputs, &error));
  *hash = hash_bytes(*hash, gaussian.data, gaussian.bytes);
  free(gaussian.data);
}

static inline void sections_round(const struct library *library, const umb_topology *topology, const struct mesh *mesh,
                                  uint32_t threads, uint64_t *hash) {
  umb_error error = UMB_ERROR_INIT;
  umb_points points = points_of(mesh, UMB_SCALAR_F64);
  size_t entries = library->umb_topology_ring_offsets(topology)[mesh->vertex_count];
  struct array edges = array_of(entries, 1, 0, UMB_SCALAR_F64);
  umb_section_options options = UMB_SECTION_OPTIONS_INIT;
  umb_section_outputs outputs = UMB_SECTION_OUTPUTS_INIT;
  options.run.threads = threads;
  outputs.curvature = output_of(&edges);
  SUCCEEDS(library->umb_edge_sections(topology, &points, &options, &outputs, &error));
  *hash = hash_bytes(*hash, edges.data, edges.bytes);
  free(edges.data);
}

static inline void queries_round(const struct library *library, const umb_topology *topology, const struct mesh *mesh,
                                 uint64_t *hash) {
  umb_error error = UMB_ERROR_INIT;
  umb_topology_stats stats = UMB_TOPOLOGY_STATS_INIT;
  SUCCEEDS(library->umb_topology_get_stats(topology, &stats, &error));
  *hash = hash_bytes(*hash, &stats, sizeof stats);
  for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++) {
    umb_fan fan;
    umb_status status = library->umb_topology_fan(topology, vertex, 0, &fan, &error);
    *hash = hash_bytes(*hash, &status, sizeof status);
    if (status == UMB_OK) *hash = hash_bytes(*hash, fan.neighbours, fan.neighbour_count * sizeof *fan.neighbours);
  }
}

/* Calls that need no handle, and one that fails. */
static inline void round_without_handle(const struct library *library, const struct mesh *mesh, uint32_t threads,
                                        uint64_t *hash) {
  umb_error error = UMB_ERROR_INIT;
  umb_faces faces = faces_of(mesh);
  umb_points points = points_of(mesh, UMB_SCALAR_F64);
  struct array normals = array_of(mesh->face_count, 3, 0, UMB_SCALAR_F64);
  struct array circles = array_of(mesh->vertex_count, 1, 0, UMB_SCALAR_F64);
  umb_face_options face_options = UMB_FACE_OPTIONS_INIT;
  umb_face_outputs face_outputs = UMB_FACE_OUTPUTS_INIT;
  umb_topology_options options = UMB_TOPOLOGY_OPTIONS_INIT;
  umb_polyline polyline = {0};
  umb_polyline_outputs polyline_outputs = UMB_POLYLINE_OUTPUTS_INIT;
  umb_topology *own = NULL;
  face_options.run.threads = options.threads = threads;
  face_outputs.normal = output_of(&normals);
  SUCCEEDS(library->umb_face_normals(&faces, &points, &face_options, &face_outputs, &error));
  *hash = hash_bytes(*hash, normals.data, normals.bytes);
  polyline.data = mesh->positions;
  polyline.count = mesh->vertex_count;
  polyline.scalar = UMB_SCALAR_F64;
  polyline_outputs.circle = output_of(&circles);
  SUCCEEDS(library->umb_polyline_curvatures(&polyline, NULL, &polyline_outputs, &error));
  *hash = hash_bytes(*hash, circles.data, circles.bytes);
  SUCCEEDS(library->umb_topology_create(&faces, mesh->vertex_count, &options, &own, &error));
  queries_round(library, own, mesh, hash);
  library->umb_topology_destroy(own);
  CHECK(library->umb_topology_create(&faces, 1, &options, &own, &error) == UMB_ERROR_INDEX_OUT_OF_RANGE);
  *hash = hash_bytes(*hash, error.message, strlen(error.message));
  free(normals.data);
  free(circles.data);
}

/* One round of one kind; the hash of all that it wrote, which does not depend on `threads`. */
static inline uint64_t work(const struct library *library, const umb_topology *topology, const struct mesh *mesh,
                            enum kind kind, uint32_t threads) {
  umb_error error = UMB_ERROR_INIT;
  umb_points points = points_of(mesh, UMB_SCALAR_F64);
  umb_adaptive_model model = UMB_ADAPTIVE_MODEL_INIT;
  umb_normal_options options = UMB_NORMAL_OPTIONS_INIT;
  uint64_t hash = HASH_START;
  switch (kind) {
    case AVERAGES:
      for (umb_weight weight = UMB_WEIGHT_CONFORMAL; weight < UMB_WEIGHT_JET; weight++) {
        normals_round(library, topology, mesh, weight, weight % 2, threads, &hash);
      }
      normals_round(library, topology, mesh, UMB_WEIGHT_TILTED_SECTIONS, UMB_SCALAR_F32, threads, &hash);
      break;
    case JETS:
      normals_round(library, topology, mesh, UMB_WEIGHT_JET, UMB_SCALAR_F32, threads, &hash);
      break;
    case ADAPTIVE:
      normals_round(library, topology, mesh, UMB_WEIGHT_ADAPTIVE_JET, UMB_SCALAR_F64, threads, &hash);
      break;
    case CURVATURES:
      curvature_round(library, topology, mesh, UMB_CURVATURE_ADAPTIVE_JET, threads, &hash);
      curvature_round(library, topology, mesh, UMB_CURVATURE_GOLDFEATHER, threads, &hash);
      curvature_round(library, topology, mesh, UMB_CURVATURE_ANGLE_DEFECT, threads, &hash);
      curvature_round(library, topology, mesh, UMB_CURVATURE_CORRECTED_MEASURE, threads, &hash);
      break;
    case SECTIONS:
      sections_round(library, topology, mesh, threads, &hash);
      break;
    case QUERIES:
      queries_round(library, topology, mesh, &hash);
      break;
    case LEARNING:
      options.run.threads = threads;
      SUCCEEDS(library->umb_learn_model(topology, &points, &options, &model, &error));
      hash = hash_bytes(hash, &model, sizeof model);
      break;
    case WITHOUT_HANDLE:
    default:
      round_without_handle(library, mesh, threads, &hash);
  }
  return hash;
}

/* Rounds of all kinds, with a topology of its own. */
static inline uint64_t all_work(const struct library *library, const struct mesh *mesh, uint32_t threads) {
  umb_error error = UMB_ERROR_INIT;
  umb_faces faces = faces_of(mesh);
  umb_topology_options options = UMB_TOPOLOGY_OPTIONS_INIT;
  umb_topology *topology = NULL;
  uint64_t hash = HASH_START;
  options.threads = threads;
  SUCCEEDS(library->umb_topology_create(&faces, mesh->vertex_count, &options, &topology, &error));
  for (int kind = 0; kind < KIND_COUNT; kind++) {
    uint64_t one = work(library, topology, mesh, (enum kind)kind, threads);
    hash = hash_bytes(hash, &one, sizeof one);
  }
  library->umb_topology_destroy(topology);
  return hash;
}

/* The copy that the program is linked with. */
#define LINKED_FUNCTION(name) name,
#define LINKED_LIBRARY {FUNCTIONS(LINKED_FUNCTION)}

#endif

/*
 * Topology and normals: every entry point that they have, on triangles, polygons and broken meshes, all weights, both
 * scalars, packed and strided, all vertices and lists. Run under every sanitizer; exactness is tested from Rust.
 */
#include "mesh.h"

static void versions(void) {
  char version[32];
  snprintf(version, sizeof version, "%d.%d.%d", UMB_VERSION_MAJOR, UMB_VERSION_MINOR, UMB_VERSION_PATCH);
  CHECK(strcmp(umb_version(), version) == 0);
  CHECK(umb_abi_version() == UMB_ABI_VERSION);
  CHECK(strstr(umb_build_info(), version) != NULL && strstr(umb_build_info(), "vectors: ") != NULL);
  CHECK(strcmp(umb_status_string(UMB_OK), umb_status_string(UMB_ERROR_INTERNAL)) != 0);
  CHECK(umb_status_string(-7) != NULL);
}

/* Walks over every fan, and compares it with the ring array. */
static void fans(const umb_topology *topology, const struct mesh *mesh) {
  umb_error error = UMB_ERROR_INIT;
  const uint32_t *offsets = umb_topology_ring_offsets(topology), *ring = umb_topology_ring_neighbours(topology);
  const uint8_t *flags = umb_topology_flags(topology);
  CHECK(offsets != NULL && ring != NULL && flags != NULL);
  CHECK(umb_topology_vertex_count(topology) == mesh->vertex_count);
  CHECK(umb_topology_face_count(topology) == mesh->face_count);
  for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++) {
    size_t count = 0, valence = 0, entry = offsets[vertex];
    SUCCEEDS(umb_topology_fan_count(topology, vertex, &count, &error));
    SUCCEEDS(umb_topology_valence(topology, vertex, &valence, &error));
    CHECK((count == 0) == ((flags[vertex] & UMB_VERTEX_ISOLATED) != 0));
    CHECK((count > 1) == ((flags[vertex] & UMB_VERTEX_NON_MANIFOLD) != 0));
    for (size_t index = 0; index < count; index++) {
      umb_fan fan;
      SUCCEEDS(umb_topology_fan(topology, vertex, index, &fan, &error));
      CHECK(fan.neighbour_count == fan.corner_count + (fan.closed ? 0 : 1));
      for (size_t i = 0; i < fan.neighbour_count; i++) {
        CHECK(fan.neighbours[i] == ring[entry + i] && fan.neighbours[i] < mesh->vertex_count);
      }
      entry += fan.neighbour_count;
    }
    CHECK(entry == offsets[vertex + 1]);
    CHECK(count == 0 ? valence == 0 : valence <= entry - offsets[vertex]);
  }
}

static void topologies(const struct mesh *mesh, int64_t euler_characteristic, int closed) {
  umb_error error = UMB_ERROR_INIT;
  for (uint32_t threads = 0; threads <= 3; threads++) {
    umb_topology_stats stats = UMB_TOPOLOGY_STATS_INIT;
    umb_topology *topology = topology_of(mesh, threads);
    fans(topology, mesh);
    SUCCEEDS(umb_topology_get_stats(topology, &stats, &error));
    CHECK(stats.vertex_count == mesh->vertex_count && stats.face_count == mesh->face_count);
    if (closed) {
      CHECK(stats.euler_characteristic == euler_characteristic && stats.component_count == 1);
      CHECK(stats.boundary_edges == 0 && stats.non_manifold_edges == 0 && stats.winding_edges == 0);
    } else {
      CHECK(stats.isolated_vertices == 1 && stats.non_manifold_edges == 2 && stats.winding_edges == 2);
      CHECK(stats.duplicate_faces == 1 && stats.degenerate_faces == 2 && stats.ignored_faces == 2);
    }
    umb_topology_destroy(topology);
  }
}

/* The same faces as signed and as 64-bit indices. */
static void index_types(const struct mesh *mesh) {
  umb_error error = UMB_ERROR_INIT;
  size_t index_bytes = mesh->index_count * sizeof(uint64_t), offset_count = mesh->offsets ? mesh->face_count + 1 : 0;
  uint64_t *indices = (uint64_t *)memory(index_bytes), *offsets = (uint64_t *)memory(offset_count * sizeof(uint64_t));
  umb_faces faces = faces_of(mesh);
  umb_topology *signed_one = NULL, *wide = NULL, *plain = topology_of(mesh, 1);
  for (size_t i = 0; i < mesh->index_count; i++) indices[i] = mesh->indices[i];
  for (size_t i = 0; i < offset_count; i++) offsets[i] = mesh->offsets[i];
  faces.index = UMB_INDEX_I32;
  SUCCEEDS(umb_topology_create(&faces, mesh->vertex_count, NULL, &signed_one, &error));
  faces.index = UMB_INDEX_U64;
  faces.indices = indices;
  faces.offsets = mesh->offsets ? offsets : NULL;
  SUCCEEDS(umb_topology_create(&faces, mesh->vertex_count, NULL, &wide, &error));
  const uint32_t *expected = umb_topology_ring_neighbours(plain);
  size_t entries = umb_topology_ring_offsets(plain)[mesh->vertex_count];
  CHECK(memcmp(umb_topology_ring_neighbours(signed_one), expected, entries * sizeof *expected) == 0);
  CHECK(memcmp(umb_topology_ring_neighbours(wide), expected, entries * sizeof *expected) == 0);
  umb_topology_destroy(plain);
  umb_topology_destroy(signed_one);
  umb_topology_destroy(wide);
  free(indices);
  free(offsets);
}

/* Every normal is of length 1, or zero where the status says so; `radial` ones point away from the origin. */
static void check_normals(const struct array *normals, const unsigned char *status, const struct mesh *mesh, int radial) {
  double tolerance = normals->scalar == UMB_SCALAR_F64 ? 1e-14 : 1e-6;
  for (size_t v = 0; v < mesh->vertex_count; v++) {
    const double *position = mesh->positions + 3 * v;
    double length = length_of(normals, v), along = 0, distance = 0;
    if (status[v] & (UMB_VERTEX_ISOLATED | UMB_VERTEX_DEGENERATE)) {
      CHECK(length == 0);
      continue;
    }
    CHECK(fabs(length - 1) <= tolerance);
    for (size_t i = 0; i < 3; i++) {
      along += get(normals, v, i) * position[i];
      distance += position[i] * position[i];
    }
    if (radial) CHECK(along / sqrt(distance) > 0.99);
  }
}

static void vertex_normals(const struct mesh *mesh, int radial) {
  static const umb_scalar scalars[2] = {UMB_SCALAR_F32, UMB_SCALAR_F64};
  umb_error error = UMB_ERROR_INIT;
  umb_topology *topology = topology_of(mesh, 0);
  umb_faces faces = faces_of(mesh);
  unsigned char *status = (unsigned char *)memory(mesh->vertex_count);
  for (umb_weight weight = UMB_WEIGHT_CONFORMAL; weight <= UMB_WEIGHT_TILTED_SECTIONS; weight++) {
    for (size_t scalar = 0; scalar < 2; scalar++) {
      umb_points points = points_of(mesh, scalars[scalar]);
      for (size_t gap = 0; gap < 4; gap += 3) {
        struct array normals = array_of(mesh->vertex_count, 3, gap, scalars[scalar]);
        struct array sums = array_of(mesh->vertex_count, 3, gap, UMB_SCALAR_F64);
        struct array again = array_of(mesh->vertex_count, 3, gap, scalars[scalar]);
        umb_normal_options options = UMB_NORMAL_OPTIONS_INIT;
        umb_normal_outputs outputs = UMB_NORMAL_OUTPUTS_INIT;
        options.weight = weight;
        outputs.normal = output_of(&normals);
        outputs.status = bytes_of(status);
        SUCCEEDS(umb_vertex_normals(topology, &points, &options, &outputs, &error));
        check_normals(&normals, status, mesh, radial);
        outputs.normal = output_of(&again);
        SUCCEEDS(umb_vertex_normals_from_faces(&faces, &points, &options, &outputs, &error));
        CHECK(memcmp(normals.data, again.data, normals.bytes) == 0);
        outputs.sum = output_of(&sums);
        SUCCEEDS(umb_vertex_normals(topology, &points, &options, &outputs, &error));
        for (size_t v = 0; v < mesh->vertex_count; v++) CHECK(isfinite(length_of(&sums, v)));
        free(normals.data);
        free(sums.data);
        free(again.data);
      }
    }
  }
  free(status);
  umb_topology_destroy(topology);
}

/* Positions and normals in one buffer, as a graphics program keeps them; the rest of it is left alone. */
static void interleaved(const struct mesh *mesh) {
  struct vertex {
    float position[3], normal[3];
    unsigned char colour[4];
  };
  umb_error error = UMB_ERROR_INIT;
  struct vertex *vertices = (struct vertex *)memory(mesh->vertex_count * sizeof *vertices);
  umb_topology *topology = topology_of(mesh, 0);
  umb_points points = {0};
  umb_normal_outputs outputs = UMB_NORMAL_OUTPUTS_INIT;
  for (size_t v = 0; v < mesh->vertex_count; v++) memcpy(vertices[v].position, mesh->rounded + 3 * v, 3 * sizeof(float));
  points.data = vertices[0].position;
  points.count = mesh->vertex_count;
  points.stride = sizeof *vertices;
  outputs.normal.data = vertices[0].normal;
  outputs.normal.stride = sizeof *vertices;
  SUCCEEDS(umb_vertex_normals(topology, &points, NULL, &outputs, &error));
  for (size_t v = 0; v < mesh->vertex_count; v++) {
    CHECK(memcmp(vertices[v].position, mesh->rounded + 3 * v, 3 * sizeof(float)) == 0);
    CHECK(vertices[v].colour[0] == 0x5a && vertices[v].colour[3] == 0x5a);
  }
  umb_topology_destroy(topology);
  free(vertices);
}

/* Only the listed vertices are written, with the bits of a call for all. */
static void lists(const struct mesh *mesh) {
  umb_error error = UMB_ERROR_INIT;
  umb_topology *topology = topology_of(mesh, 0);
  umb_points points = points_of(mesh, UMB_SCALAR_F32);
  struct array all = array_of(mesh->vertex_count, 3, 0, UMB_SCALAR_F32);
  struct array some = array_of(mesh->vertex_count, 3, 0, UMB_SCALAR_F32);
  struct array untouched = array_of(mesh->vertex_count, 3, 0, UMB_SCALAR_F32);
  size_t element = 3 * sizeof(float), count = mesh->vertex_count / 3;
  uint32_t *list = (uint32_t *)memory(count * sizeof *list);
  for (size_t i = 0; i < count; i++) list[i] = (uint32_t)(3 * (count - 1 - i) + 1);
  for (umb_weight weight = UMB_WEIGHT_CONFORMAL; weight <= UMB_WEIGHT_TILTED_SECTIONS; weight++) {
    umb_normal_options options = UMB_NORMAL_OPTIONS_INIT;
    umb_normal_outputs outputs = UMB_NORMAL_OUTPUTS_INIT;
    memcpy(some.data, untouched.data, some.bytes);
    options.weight = weight;
    outputs.normal = output_of(&all);
    SUCCEEDS(umb_vertex_normals(topology, &points, &options, &outputs, &error));
    options.run.vertices = list;
    options.run.vertex_count = count;
    outputs.normal = output_of(&some);
    SUCCEEDS(umb_vertex_normals(topology, &points, &options, &outputs, &error));
    for (size_t v = 0; v < mesh->vertex_count; v++) {
      const unsigned char *expected = v % 3 == 1 && v / 3 < count ? all.data : untouched.data;
      CHECK(memcmp(some.data + v * element, expected + v * element, element) == 0);
    }
  }
  free(list);
  free(all.data);
  free(some.data);
  free(untouched.data);
  umb_topology_destroy(topology);
}

static void face_normals(const struct mesh *mesh) {
  umb_error error = UMB_ERROR_INIT;
  umb_faces faces = faces_of(mesh);
  unsigned char *status = (unsigned char *)memory(mesh->face_count);
  for (umb_scalar scalar = UMB_SCALAR_F32; scalar <= UMB_SCALAR_F64; scalar++) {
    umb_points points = points_of(mesh, scalar);
    struct array normals = array_of(mesh->face_count, 3, 2, scalar);
    struct array areas = array_of(mesh->face_count, 3, 0, UMB_SCALAR_F64);
    umb_face_options options = UMB_FACE_OPTIONS_INIT;
    umb_face_outputs outputs = UMB_FACE_OUTPUTS_INIT;
    options.run.threads = 2;
    outputs.normal = output_of(&normals);
    outputs.area_vector = output_of(&areas);
    outputs.status = bytes_of(status);
    SUCCEEDS(umb_face_normals(&faces, &points, &options, &outputs, &error));
    for (size_t face = 0; face < mesh->face_count; face++) {
      CHECK(fabs(length_of(&normals, face) - (status[face] == UMB_VERTEX_DEGENERATE ? 0 : 1)) < 1e-6);
      CHECK((length_of(&areas, face) > 0) == (status[face] == 0));
    }
    free(normals.data);
    free(areas.data);
  }
  free(status);
}

struct watch {
  int calls, limit;
  double last;
};

static int progress(void *user, double fraction) {
  struct watch *watch = (struct watch *)user;
  CHECK(fraction >= watch->last && fraction <= 1);
  watch->last = fraction;
  return ++watch->calls > watch->limit;
}

static void progress_and_cancelling(const struct mesh *mesh) {
  umb_error error = UMB_ERROR_INIT;
  umb_topology *topology = topology_of(mesh, 0);
  umb_points points = points_of(mesh, UMB_SCALAR_F32);
  umb_normal_outputs outputs = UMB_NORMAL_OUTPUTS_INIT;
  for (uint32_t threads = 1; threads <= 3; threads++) {
    struct watch watch = {0, 1000000, 0};
    umb_normal_options options = UMB_NORMAL_OPTIONS_INIT;
    options.run.threads = threads;
    options.run.progress = progress;
    options.run.user = &watch;
    SUCCEEDS(umb_vertex_normals(topology, &points, &options, &outputs, &error));
    CHECK(watch.calls > 1 && watch.last >= 1);
    watch.calls = 0, watch.limit = 0, watch.last = 0;
    CHECK(umb_vertex_normals(topology, &points, &options, &outputs, &error) == UMB_ERROR_CANCELLED);
    CHECK(watch.calls == 1 && error.status == UMB_ERROR_CANCELLED);
  }
  umb_topology_destroy(topology);
}

int main(void) {
  struct mesh meshes[] = {sphere(2, 24, 16), torus(24, 18), broken(), torus(90, 60)};
  versions();
  topologies(&meshes[0], 2, 1);
  topologies(&meshes[1], 0, 1);
  topologies(&meshes[2], 0, 0);
  for (size_t i = 0; i < 3; i++) {
    index_types(&meshes[i]);
    vertex_normals(&meshes[i], i == 0);
    interleaved(&meshes[i]);
    lists(&meshes[i]);
    face_normals(&meshes[i]);
  }
  topologies(&meshes[3], 0, 1);
  progress_and_cancelling(&meshes[3]);
  for (size_t i = 0; i < sizeof meshes / sizeof *meshes; i++) mesh_free(&meshes[i]);
  puts("normals: all calls are as they should be");
  return 0;
}

/*
 * Shape classes, segmentations and lists of what moved: every entry point that they have, on a solid with sharp edges, on smooth and on
 * broken meshes, and every mistake. Run under every sanitizer; exactness is tested from Rust.
 */
#include "mesh.h"

static const umb_scalar SCALARS[2] = {UMB_SCALAR_F32, UMB_SCALAR_F64};

/* Positions with a gap of two scalars between vertices, in a block that ends with the last coordinate. */
static struct array strided(const struct mesh *mesh, umb_scalar scalar) {
  struct array array = array_of(mesh->vertex_count, 3, 2, scalar);
  for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++) {
    unsigned char *to = array.data + vertex * array.stride;
    if (scalar == UMB_SCALAR_F64) memcpy(to, &mesh->positions[3 * vertex], 3 * sizeof(double));
    else memcpy(to, &mesh->rounded[3 * vertex], 3 * sizeof(float));
  }
  return array;
}

static umb_points points_in(const struct array *array) {
  umb_points points = {0};
  points.data = array->data;
  points.count = array->count;
  points.stride = array->stride;
  points.scalar = array->scalar;
  return points;
}

/* Numbers from 0 up, each in so many places in a row. */
static struct array steps(size_t count, size_t each, size_t gap, umb_scalar scalar) {
  struct array array = array_of(count, 1, gap, scalar);
  for (size_t i = 0; i < count; i++) {
    unsigned char *to = array.data + i * array.stride;
    double wide = (double)(i / each);
    float narrow = (float)wide;
    if (scalar == UMB_SCALAR_F64) memcpy(to, &wide, sizeof wide);
    else memcpy(to, &narrow, sizeof narrow);
  }
  return array;
}

static umb_scalars scalars_of(const struct array *array, umb_location location) {
  umb_scalars scalars = {0};
  scalars.data = array->data;
  scalars.count = array->count;
  scalars.stride = array->stride;
  scalars.scalar = array->scalar;
  scalars.location = location;
  return scalars;
}

/* What holds of every segmentation; frees it, and answers with the number of segments. */
static size_t checked(umb_segmentation *made, const struct mesh *mesh, const umb_points *points) {
  const umb_segmentation *segmentation = made;
  umb_error error = UMB_ERROR_INIT;
  umb_faces faces = faces_of(mesh);
  size_t count = umb_segmentation_count(segmentation), edge_count = umb_segmentation_boundary_edge_count(segmentation);
  const uint32_t *labels = umb_segmentation_labels(segmentation), *edges = umb_segmentation_boundary_edges(segmentation);
  double *areas = (double *)memory(count * sizeof *areas), *means = (double *)memory(count * sizeof *means);
  struct array ones = steps(mesh->face_count, 1, 1, UMB_SCALAR_F32), far = steps(mesh->vertex_count, 1, 0, UMB_SCALAR_F64);
  umb_scalars at_faces = scalars_of(&ones, UMB_AT_FACES), at_vertices = scalars_of(&far, UMB_AT_VERTICES);
  size_t next = 0;
  CHECK(umb_segmentation_face_count(segmentation) == mesh->face_count);
  for (size_t face = 0; face < mesh->face_count; face++) {
    if (labels[face] == UMB_NO_SEGMENT) continue;
    CHECK(labels[face] <= next);
    if (labels[face] == next) next++;
  }
  CHECK(next == count);
  for (size_t i = 0; i < edge_count; i++) {
    const uint32_t *edge = edges + 2 * i;
    CHECK(edge[0] < edge[1] && edge[1] < mesh->vertex_count);
    CHECK(i == 0 || edge[-2] < edge[0] || (edge[-2] == edge[0] && edge[-1] < edge[1]));
  }
  SUCCEEDS(umb_segmentation_areas(segmentation, &faces, points, areas, count, &error));
  for (size_t i = 0; i < count; i++) CHECK(isfinite(areas[i]) && areas[i] >= 0);
  SUCCEEDS(umb_segmentation_means(segmentation, &faces, points, &at_faces, means, count, &error));
  for (size_t i = 0; i < count; i++) CHECK(means[i] >= 0 && means[i] < (double)mesh->face_count);
  SUCCEEDS(umb_segmentation_means(segmentation, &faces, points, &at_vertices, means, count, &error));
  for (size_t i = 0; i < count; i++) CHECK(means[i] >= 0 && means[i] < (double)mesh->vertex_count);
  free(areas);
  free(means);
  free(ones.data);
  free(far.data);
  umb_segmentation_destroy(made);
  return count;
}

static size_t features(const struct mesh *mesh, const umb_points *points, const umb_creases *creases) {
  umb_error error = UMB_ERROR_INIT;
  umb_faces faces = faces_of(mesh);
  umb_feature_options options = UMB_FEATURE_OPTIONS_INIT;
  umb_segmentation *segmentation = NULL;
  options.creases = creases;
  SUCCEEDS(umb_segment_features(&faces, points, &options, &segmentation, &error));
  return checked(segmentation, mesh, points);
}

static size_t basins(const struct mesh *mesh, const umb_points *points, const umb_scalars *height, double depth,
                     umb_curvature_method method) {
  umb_error error = UMB_ERROR_INIT;
  umb_faces faces = faces_of(mesh);
  umb_watershed_options options = UMB_WATERSHED_OPTIONS_INIT;
  umb_curvature_options curvature = UMB_CURVATURE_OPTIONS_INIT;
  umb_segmentation *segmentation = NULL;
  curvature.method = method;
  options.height = height;
  options.depth = depth;
  options.curvature = method == UMB_CURVATURE_ADAPTIVE_JET ? NULL : &curvature;
  SUCCEEDS(umb_segment_watershed(&faces, points, &options, &segmentation, &error));
  return checked(segmentation, mesh, points);
}

static size_t regions(const struct mesh *mesh, const umb_points *points, const unsigned char *classes,
                      umb_curvature_method method) {
  umb_error error = UMB_ERROR_INIT;
  umb_faces faces = faces_of(mesh);
  umb_region_options options = UMB_REGION_OPTIONS_INIT;
  umb_curvature_options curvature = UMB_CURVATURE_OPTIONS_INIT;
  umb_segmentation *segmentation = NULL;
  curvature.method = method;
  if (classes != NULL) options.classes = (umb_bytes){classes, mesh->vertex_count, 0};
  options.smallest_faces = 2;
  options.curvature = method == UMB_CURVATURE_ADAPTIVE_JET ? NULL : &curvature;
  SUCCEEDS(umb_segment_regions(&faces, points, &options, &segmentation, &error));
  return checked(segmentation, mesh, points);
}

/* Every segmentation of a mesh, of `pieces` that hang together, by positions of both kinds, packed and strided. */
static void every_segmentation(const struct mesh *mesh, size_t pieces) {
  static const uint32_t edges[6] = {0, 1, 1, 3, 2, 0};
  uint32_t *groups = (uint32_t *)memory(mesh->face_count * sizeof *groups);
  unsigned char *classes = (unsigned char *)memory(mesh->vertex_count);
  for (size_t face = 0; face < mesh->face_count; face++) groups[face] = (uint32_t)(face * 7 % 3);
  for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++) classes[vertex] = (unsigned char)(vertex / 5 % 9);
  for (size_t kind = 0; kind < 4; kind++) {
    umb_scalar scalar = SCALARS[kind % 2];
    struct array apart = strided(mesh, scalar);
    struct array heights = steps(mesh->vertex_count, 3, kind / 2, scalar), levels = steps(mesh->face_count, 3, kind / 2, scalar);
    umb_points points = kind < 2 ? points_of(mesh, scalar) : points_in(&apart);
    umb_scalars at_vertices = scalars_of(&heights, UMB_AT_VERTICES), at_faces = scalars_of(&levels, UMB_AT_FACES);
    umb_creases creases = UMB_CREASES_INIT;
    size_t most = mesh->face_count;
    CHECK(features(mesh, &points, NULL) <= most);
    creases.angle = 4;
    CHECK(features(mesh, &points, &creases) == pieces);
    creases.edges = edges;
    creases.edge_count = 3;
    creases.groups = groups;
    creases.group_count = mesh->face_count;
    CHECK(features(mesh, &points, &creases) <= most);
    CHECK(basins(mesh, &points, &at_vertices, (double)INFINITY, 0) == pieces);
    CHECK(basins(mesh, &points, &at_faces, (double)INFINITY, 0) == pieces);
    CHECK(basins(mesh, &points, &at_vertices, 0, 0) <= basins(mesh, &points, &at_vertices, 5e-324, 0) + most);
    CHECK(basins(mesh, &points, &at_faces, 0, 0) >= basins(mesh, &points, &at_faces, 2, 0));
    CHECK(basins(mesh, &points, NULL, 0, UMB_CURVATURE_ADAPTIVE_JET) <= most);
    CHECK(basins(mesh, &points, NULL, 1, UMB_CURVATURE_LEAST_SQUARES) <= most);
    CHECK(regions(mesh, &points, classes, 0) <= most);
    CHECK(regions(mesh, &points, NULL, UMB_CURVATURE_ADAPTIVE_JET) <= most);
    CHECK(regions(mesh, &points, NULL, UMB_CURVATURE_TAUBIN) <= most);
    free(apart.data);
    free(heights.data);
    free(levels.data);
  }
  free(groups);
  free(classes);
}

/* The sides of a cube, and the edges between them. */
static void sides(const struct mesh *mesh) {
  umb_error error = UMB_ERROR_INIT;
  umb_faces faces = faces_of(mesh);
  umb_points points = points_of(mesh, UMB_SCALAR_F32);
  umb_segmentation *segmentation = NULL;
  double areas[6];
  SUCCEEDS(umb_segment_features(&faces, &points, NULL, &segmentation, &error));
  CHECK(umb_segmentation_count(segmentation) == 6 && umb_segmentation_boundary_edge_count(segmentation) == 12);
  SUCCEEDS(umb_segmentation_areas(segmentation, &faces, &points, areas, 6, &error));
  for (uint32_t i = 0; i < 6; i++) CHECK(umb_segmentation_labels(segmentation)[i] == i && areas[i] == 1);
  CHECK(checked(segmentation, mesh, &points) == 6);
}

/* Classes of every kind, from curvatures in both scalars, packed and strided. */
static void shapes(const struct mesh *mesh) {
  umb_error error = UMB_ERROR_INIT;
  size_t count = mesh->vertex_count;
  umb_topology *topology = topology_of(mesh, 0);
  for (size_t kind = 0; kind < 4; kind++) {
    umb_scalar scalar = SCALARS[kind % 2];
    struct array apart = strided(mesh, scalar), k1 = array_of(count, 1, kind / 2, scalar), k2 = array_of(count, 1, 3, scalar);
    umb_points points = kind < 2 ? points_of(mesh, scalar) : points_in(&apart);
    umb_scalars one = scalars_of(&k1, UMB_AT_VERTICES), two = scalars_of(&k2, UMB_AT_VERTICES);
    unsigned char *status = (unsigned char *)memory(count), *classes = (unsigned char *)memory(3 * (count - 1) + 1);
    umb_curvature_options options = UMB_CURVATURE_OPTIONS_INIT;
    umb_curvature_outputs outputs = UMB_CURVATURE_OUTPUTS_INIT;
    umb_shape_options shape = UMB_SHAPE_OPTIONS_INIT;
    umb_status_output output = bytes_of(classes);
    double tolerance = -1;
    options.method = UMB_CURVATURE_TAUBIN;
    outputs.k1 = output_of(&k1);
    outputs.k2 = output_of(&k2);
    outputs.status = bytes_of(status);
    SUCCEEDS(umb_curvatures(topology, &points, &options, &outputs, &error));
    SUCCEEDS(umb_shape_tolerance(&points, &tolerance, &error));
    CHECK(tolerance > 0 && isfinite(tolerance));
    shape.points = &points;
    shape.status = (umb_bytes){status, count, 0};
    output.stride = 3;
    SUCCEEDS(umb_shape_classes(&one, &two, &shape, &output, &error));
    for (size_t i = 0; i <= 3 * (count - 1); i++) {
      if (i % 3 != 0) CHECK(classes[i] == 0x5a);
      else CHECK(classes[i] <= UMB_SHAPE_SADDLE_VALLEY);
    }
    for (size_t vertex = 0; vertex < count; vertex++) {
      int none = (status[vertex] & (UMB_VERTEX_ISOLATED | UMB_VERTEX_DEGENERATE)) != 0;
      CHECK((classes[3 * vertex] == UMB_SHAPE_UNDEFINED) == none);
    }
    /* By a tolerance of the caller's no positions are needed, and beyond all curvatures everything is flat. */
    shape.points = NULL;
    shape.status = (umb_bytes){NULL, 0, 0};
    shape.tolerance = 1e9;
    output.stride = 0;
    SUCCEEDS(umb_shape_classes(&one, &two, &shape, &output, &error));
    for (size_t vertex = 0; vertex < count; vertex++) CHECK(classes[vertex] == UMB_SHAPE_FLAT);
    free(apart.data);
    free(k1.data);
    free(k2.data);
    free(status);
    free(classes);
  }
  umb_topology_destroy(topology);
}

/* Normals and curvatures are kept up to date by lists while vertices move. */
static void updates(struct mesh *mesh) {
  umb_error error = UMB_ERROR_INIT;
  size_t count = mesh->vertex_count;
  umb_topology *topology = topology_of(mesh, 0);
  umb_points points = points_of(mesh, UMB_SCALAR_F64);
  uint32_t moved_vertices[3] = {5, 0, 5};
  uint32_t *list = (uint32_t *)memory(count * sizeof *list);
  unsigned char *status = (unsigned char *)memory(count), *whole_status = (unsigned char *)memory(count);
  struct array normals = array_of(count, 3, 0, UMB_SCALAR_F64), all_normals = array_of(count, 3, 0, UMB_SCALAR_F64);
  struct array curvature = array_of(count, 1, 0, UMB_SCALAR_F64), all_curvature = array_of(count, 1, 0, UMB_SCALAR_F64);
  static const umb_curvature_method methods[4] = {UMB_CURVATURE_LEAST_SQUARES, UMB_CURVATURE_QUADRIC, UMB_CURVATURE_JET,
                                                  UMB_CURVATURE_CORRECTED_MEASURE};
  for (umb_weight weight = UMB_WEIGHT_CONFORMAL; weight <= UMB_WEIGHT_TILTED_SECTIONS; weight++) {
    umb_adaptive_model model = UMB_ADAPTIVE_MODEL_INIT;
    umb_normal_options options = UMB_NORMAL_OPTIONS_INIT;
    umb_normal_outputs outputs = UMB_NORMAL_OUTPUTS_INIT, whole = UMB_NORMAL_OUTPUTS_INIT;
    umb_moved moved = UMB_MOVED_INIT;
    size_t found = SIZE_MAX, longer = SIZE_MAX;
    options.weight = weight;
    moved.vertices = moved_vertices;
    moved.vertex_count = 3;
    if (weight == UMB_WEIGHT_ADAPTIVE_JET) {
      fails(umb_affected_normals(topology, &moved, &options, list, count, &found, &error), UMB_ERROR_NOT_APPLICABLE, &error,
              UMB_NO_ELEMENT);
      SUCCEEDS(umb_learn_model(topology, &points, NULL, &model, &error));
      options.model = &model;
    }
    outputs.normal = output_of(&normals);
    outputs.status = bytes_of(status);
    whole.normal = output_of(&all_normals);
    whole.status = bytes_of(whole_status);
    SUCCEEDS(umb_vertex_normals(topology, &points, &options, &outputs, &error));
    for (size_t i = 0; i < 2; i++) mesh_place(mesh, moved_vertices[i], 0.1 * weight, 0.3, 1 - 0.05 * weight + (double)i);
    SUCCEEDS(umb_affected_normals(topology, &moved, &options, list, count, &longer, &error));
    CHECK(longer <= count);
    moved.status = (umb_bytes){status, count, 0};
    SUCCEEDS(umb_affected_normals(topology, &moved, &options, list, count, &found, &error));
    CHECK(found <= longer && found >= 2 && list[0] + list[1] == 5);
    options.run.vertices = list;
    options.run.vertex_count = found;
    SUCCEEDS(umb_vertex_normals(topology, &points, &options, &outputs, &error));
    options.run.vertices = NULL;
    options.run.vertex_count = 0;
    SUCCEEDS(umb_vertex_normals(topology, &points, &options, &whole, &error));
    CHECK(memcmp(normals.data, all_normals.data, normals.bytes) == 0 && memcmp(status, whole_status, count) == 0);
  }
  for (size_t i = 0; i < sizeof methods / sizeof methods[0]; i++) {
    umb_curvature_options options = UMB_CURVATURE_OPTIONS_INIT;
    umb_curvature_outputs outputs = UMB_CURVATURE_OUTPUTS_INIT, whole = UMB_CURVATURE_OUTPUTS_INIT;
    umb_moved moved = UMB_MOVED_INIT;
    size_t found = SIZE_MAX;
    options.method = methods[i];
    outputs.mean = output_of(&curvature);
    outputs.status = bytes_of(status);
    whole.mean = output_of(&all_curvature);
    whole.status = bytes_of(whole_status);
    SUCCEEDS(umb_curvatures(topology, &points, &options, &outputs, &error));
    mesh_place(mesh, moved_vertices[0], 0.2 * (double)i, 0.5, 0.7);
    mesh_place(mesh, moved_vertices[1], 0.4, 0.3 - 0.1 * (double)i, 0.9);
    moved.vertices = moved_vertices;
    moved.vertex_count = 2;
    moved.status = (umb_bytes){status, count, 0};
    SUCCEEDS(umb_affected_curvatures(topology, &moved, &options, list, count, &found, &error));
    options.run.vertices = list;
    options.run.vertex_count = found;
    SUCCEEDS(umb_curvatures(topology, &points, &options, &outputs, &error));
    options.run.vertices = NULL;
    options.run.vertex_count = 0;
    SUCCEEDS(umb_curvatures(topology, &points, &options, &whole, &error));
    CHECK(memcmp(curvature.data, all_curvature.data, curvature.bytes) == 0 && memcmp(status, whole_status, count) == 0);
  }
  free(list);
  free(status);
  free(whole_status);
  free(normals.data);
  free(all_normals.data);
  free(curvature.data);
  free(all_curvature.data);
  umb_topology_destroy(topology);
}

/* What a callback has seen, and the call of it that cancels; 0 for none. */
struct watch {
  size_t calls, cancels;
  double last;
};

static int watched(void *user, double fraction) {
  struct watch *watch = (struct watch *)user;
  CHECK(fraction >= watch->last && fraction <= 1);
  watch->last = fraction;
  return ++watch->calls == watch->cancels;
}

/* Cancels every call that can be at each report of its progress; at the last one it is too late. */
static void cancelled(const struct mesh *mesh) {
  enum { CALLS = 6 };
  umb_error error = UMB_ERROR_INIT;
  umb_faces faces = faces_of(mesh);
  umb_points points = points_of(mesh, UMB_SCALAR_F64);
  struct array heights = steps(mesh->vertex_count, 1, 0, UMB_SCALAR_F32);
  umb_scalars height = scalars_of(&heights, UMB_AT_VERTICES);
  unsigned char *classes = (unsigned char *)memory(mesh->vertex_count);
  umb_status_output output = bytes_of(classes);
  umb_curvature_options curvature = UMB_CURVATURE_OPTIONS_INIT;
  memset(classes, UMB_SHAPE_FLAT, mesh->vertex_count);
  curvature.method = UMB_CURVATURE_LEAST_SQUARES;
  for (size_t call = 0; call < CALLS; call++) {
    size_t reports = 0, cancels = 0;
    do {
      struct watch watch = {0, 0, 0};
      umb_feature_options features = UMB_FEATURE_OPTIONS_INIT;
      umb_watershed_options watershed = UMB_WATERSHED_OPTIONS_INIT;
      umb_region_options regions = UMB_REGION_OPTIONS_INIT;
      umb_shape_options shape = UMB_SHAPE_OPTIONS_INIT;
      umb_run run = features.run;
      umb_segmentation *segmentation = NULL;
      umb_status status;
      watch.cancels = cancels;
      run.progress = watched;
      run.user = &watch;
      features.run = watershed.run = regions.run = shape.run = run;
      shape.points = &points;
      watershed.height = call == 1 ? &height : NULL;
      watershed.curvature = regions.curvature = &curvature;
      if (call == 3) regions.classes = (umb_bytes){classes, mesh->vertex_count, 0};
      if (call == 0) status = umb_segment_features(&faces, &points, &features, &segmentation, &error);
      else if (call < 3) status = umb_segment_watershed(&faces, &points, &watershed, &segmentation, &error);
      else if (call < 5) status = umb_segment_regions(&faces, &points, &regions, &segmentation, &error);
      else status = umb_shape_classes(&height, &height, &shape, &output, &error);
      if (cancels == 0) {
        CHECK(status == UMB_OK && watch.calls > 0 && watch.last == 1);
        reports = watch.calls;
      } else if (cancels < reports) {
        fails(status, UMB_ERROR_CANCELLED, &error, UMB_NO_ELEMENT);
        CHECK(watch.calls == cancels && segmentation == NULL);
      } else {
        CHECK(watch.calls == cancels);
      }
      CHECK((segmentation != NULL) == (status == UMB_OK && call < 5));
      umb_segmentation_destroy(segmentation);
    } while (++cancels <= reports);
  }
  free(heights.data);
  free(classes);
}

static void refused_shapes(const struct mesh *mesh) {
  const uint64_t no = UMB_NO_ELEMENT;
  umb_error error = UMB_ERROR_INIT;
  umb_points points = points_of(mesh, UMB_SCALAR_F64);
  struct array k1 = steps(mesh->vertex_count, 1, 0, UMB_SCALAR_F64), few = steps(3, 1, 0, UMB_SCALAR_F64);
  umb_scalars good = scalars_of(&k1, UMB_AT_VERTICES), less = scalars_of(&few, UMB_AT_VERTICES), bad;
  umb_shape_options options = UMB_SHAPE_OPTIONS_INIT;
  unsigned char *classes = (unsigned char *)memory(mesh->vertex_count);
  umb_status_output output = bytes_of(classes), nothing = bytes_of(NULL);
  uint32_t vertex = 0;
  double tolerance = -1;
  double *numbers = (double *)(void *)k1.data;
  options.points = &points;
  fails(umb_shape_tolerance(NULL, &tolerance, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_shape_tolerance(&points, NULL, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_shape_classes(NULL, &good, &options, &output, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_shape_classes(&good, NULL, &options, &output, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_shape_classes(&good, &good, &options, NULL, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_shape_classes(&good, &good, &options, &nothing, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_shape_classes(&good, &good, NULL, &output, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_shape_classes(&good, &less, &options, &output, &error), UMB_ERROR_SIZE, &error, no);
  bad = good;
  bad.scalar = 2;
  fails(umb_shape_classes(&bad, &good, &options, &output, &error), UMB_ERROR_UNKNOWN_CONSTANT, &error, 2);
  bad = good;
  bad.location = 2;
  fails(umb_shape_classes(&bad, &bad, &options, &output, &error), UMB_ERROR_UNKNOWN_CONSTANT, &error, 2);
  bad.location = UMB_AT_FACES;
  fails(umb_shape_classes(&good, &bad, &options, &output, &error), UMB_ERROR_UNKNOWN_CONSTANT, &error, 1);
  bad = good;
  bad.stride = 9;
  fails(umb_shape_classes(&bad, &good, &options, &output, &error), UMB_ERROR_STRIDE, &error, no);
  bad = good;
  bad.data = k1.data + 1;
  fails(umb_shape_classes(&bad, &good, &options, &output, &error), UMB_ERROR_MISALIGNED, &error, no);
  bad = good;
  bad.data = NULL;
  fails(umb_shape_classes(&bad, &good, &options, &output, &error), UMB_ERROR_NULL_POINTER, &error, no);
  options.reserved = 1;
  fails(umb_shape_classes(&good, &good, &options, &output, &error), UMB_ERROR_UNKNOWN_FIELD, &error, 4);
  options.reserved = 0;
  options.struct_size = 87;
  fails(umb_shape_classes(&good, &good, &options, &output, &error), UMB_ERROR_STRUCT_SIZE, &error, no);
  options.struct_size = (uint32_t)sizeof options;
  options.tolerance = -1;
  fails(umb_shape_classes(&good, &good, &options, &output, &error), UMB_ERROR_OPTION_OUT_OF_RANGE, &error, no);
  options.tolerance = (double)NAN;
  fails(umb_shape_classes(&good, &good, &options, &output, &error), UMB_ERROR_OPTION_OUT_OF_RANGE, &error, no);
  options.tolerance = (double)INFINITY;
  fails(umb_shape_classes(&good, &good, &options, &output, &error), UMB_ERROR_OPTION_OUT_OF_RANGE, &error, no);
  options.tolerance = 0;
  options.status.count = 1;
  fails(umb_shape_classes(&good, &good, &options, &output, &error), UMB_ERROR_NULL_POINTER, &error, no);
  options.status.data = classes;
  fails(umb_shape_classes(&good, &good, &options, &output, &error), UMB_ERROR_SIZE, &error, no);
  options.status = (umb_bytes){NULL, 0, 0};
  options.run.simd = 5;
  fails(umb_shape_classes(&good, &good, &options, &output, &error), UMB_ERROR_UNKNOWN_CONSTANT, &error, 5);
  options.run.simd = 0;
  options.run.vertices = &vertex;
  fails(umb_shape_classes(&good, &good, &options, &output, &error), UMB_ERROR_UNKNOWN_FIELD, &error,
          offsetof(umb_shape_options, run) + offsetof(umb_run, vertices));
  options.run.vertices = NULL;
  numbers[4] = (double)NAN;
  fails(umb_shape_classes(&good, &good, &options, &output, &error), UMB_ERROR_NON_FINITE, &error, 4);
  mesh->positions[3 * 5] = (double)NAN;
  fails(umb_shape_tolerance(&points, &tolerance, &error), UMB_ERROR_NON_FINITE, &error, 5);
  mesh->positions[3 * 5] = 1;
  CHECK(tolerance == -1);
  for (size_t i = 0; i < mesh->vertex_count; i++) CHECK(classes[i] == 0x5a);
  free(k1.data);
  free(few.data);
  free(classes);
}

/* Mistakes that all three segmentations refuse alike. */
#define REFUSED_BY(call, options, type) \
  do { \
    uint32_t vertex_ = 0; \
    fails(call(NULL, &points, NULL, &null, &error), UMB_ERROR_NULL_POINTER, &error, no); \
    fails(call(&faces, NULL, NULL, &null, &error), UMB_ERROR_NULL_POINTER, &error, no); \
    fails(call(&faces, &points, NULL, NULL, &error), UMB_ERROR_NULL_POINTER, &error, no); \
    fails(call(&wrong, &points, NULL, &null, &error), UMB_ERROR_UNKNOWN_CONSTANT, &error, 7); \
    fails(call(&faces, &none, NULL, &null, &error), UMB_ERROR_INDEX_OUT_OF_RANGE, &error, 6); \
    (options).reserved = 1; \
    fails(call(&faces, &points, &(options), &null, &error), UMB_ERROR_UNKNOWN_FIELD, &error, 4); \
    (options).reserved = 0; \
    (options).struct_size = 8; \
    fails(call(&faces, &points, &(options), &null, &error), UMB_ERROR_STRUCT_SIZE, &error, no); \
    (options).struct_size = (uint32_t)sizeof(options); \
    (options).run.simd = 5; \
    fails(call(&faces, &points, &(options), &null, &error), UMB_ERROR_UNKNOWN_CONSTANT, &error, 5); \
    (options).run.simd = 0; \
    (options).run.vertices = &vertex_; \
    fails(call(&faces, &points, &(options), &null, &error), UMB_ERROR_UNKNOWN_FIELD, &error, \
            offsetof(type, run) + offsetof(umb_run, vertices)); \
    (options).run.vertices = NULL; \
    mesh->positions[3 * 5] = (double)NAN; \
    fails(call(&faces, &points, &(options), &null, &error), UMB_ERROR_NON_FINITE, &error, 5); \
    mesh->positions[3 * 5] = 1; \
    CHECK(null == NULL); \
  } while (0)

static void refused_segmentations(const struct mesh *mesh) {
  const uint64_t no = UMB_NO_ELEMENT;
  umb_error error = UMB_ERROR_INIT;
  umb_faces faces = faces_of(mesh), wrong = faces;
  umb_points points = points_of(mesh, UMB_SCALAR_F64), none = points;
  umb_feature_options features = UMB_FEATURE_OPTIONS_INIT;
  umb_watershed_options watershed = UMB_WATERSHED_OPTIONS_INIT;
  umb_region_options regions = UMB_REGION_OPTIONS_INIT;
  umb_curvature_options curvature = UMB_CURVATURE_OPTIONS_INIT;
  umb_creases creases = UMB_CREASES_INIT;
  umb_segmentation *null = NULL;
  struct array heights = steps(mesh->vertex_count, 1, 0, UMB_SCALAR_F64);
  umb_scalars height = scalars_of(&heights, UMB_AT_VERTICES);
  unsigned char classes[8] = {1, 2, 3, 4, 5, 6, 7, 9};
  double *numbers = (double *)(void *)heights.data;
  wrong.index = 7;
  none.count = 7;
  REFUSED_BY(umb_segment_features, features, umb_feature_options);
  REFUSED_BY(umb_segment_watershed, watershed, umb_watershed_options);
  REFUSED_BY(umb_segment_regions, regions, umb_region_options);

  features.creases = &creases;
  creases.angle = -1;
  fails(umb_segment_features(&faces, &points, &features, &null, &error), UMB_ERROR_OPTION_OUT_OF_RANGE, &error, no);
  creases.angle = (double)NAN;
  fails(umb_segment_features(&faces, &points, &features, &null, &error), UMB_ERROR_OPTION_OUT_OF_RANGE, &error, no);
  creases.angle = 0;
  creases.reserved = 1;
  fails(umb_segment_features(&faces, &points, &features, &null, &error), UMB_ERROR_UNKNOWN_FIELD, &error, 4);
  creases.reserved = 0;
  creases.edge_count = 1;
  fails(umb_segment_features(&faces, &points, &features, &null, &error), UMB_ERROR_NULL_POINTER, &error, no);

  /* What is missing has a number; a height has none of its own. */
  curvature.method = UMB_CURVATURE_ANGLE_DEFECT;
  watershed.curvature = regions.curvature = &curvature;
  fails(umb_segment_watershed(&faces, &points, &watershed, &null, &error), UMB_ERROR_NOT_APPLICABLE, &error, no);
  fails(umb_segment_regions(&faces, &points, &regions, &null, &error), UMB_ERROR_NOT_APPLICABLE, &error, no);
  curvature.method = 99;
  fails(umb_segment_watershed(&faces, &points, &watershed, &null, &error), UMB_ERROR_UNKNOWN_CONSTANT, &error, 99);
  fails(umb_segment_regions(&faces, &points, &regions, &null, &error), UMB_ERROR_UNKNOWN_CONSTANT, &error, 99);
  watershed.curvature = regions.curvature = NULL;

  for (int given = 0; given < 2; given++) {
    watershed.height = given ? &height : NULL;
    watershed.depth = -1;
    fails(umb_segment_watershed(&faces, &points, &watershed, &null, &error), UMB_ERROR_OPTION_OUT_OF_RANGE, &error, no);
    watershed.depth = (double)NAN;
    fails(umb_segment_watershed(&faces, &points, &watershed, &null, &error), UMB_ERROR_OPTION_OUT_OF_RANGE, &error, no);
    watershed.depth = 0;
  }
  height.location = UMB_AT_FACES;
  fails(umb_segment_watershed(&faces, &points, &watershed, &null, &error), UMB_ERROR_SIZE, &error, no);
  height.location = 3;
  fails(umb_segment_watershed(&faces, &points, &watershed, &null, &error), UMB_ERROR_UNKNOWN_CONSTANT, &error, 3);
  height.location = UMB_AT_VERTICES;
  height.scalar = 4;
  fails(umb_segment_watershed(&faces, &points, &watershed, &null, &error), UMB_ERROR_UNKNOWN_CONSTANT, &error, 4);
  height.scalar = UMB_SCALAR_F64;
  height.count--;
  fails(umb_segment_watershed(&faces, &points, &watershed, &null, &error), UMB_ERROR_SIZE, &error, no);
  height.count++;
  numbers[6] = (double)INFINITY;
  fails(umb_segment_watershed(&faces, &points, &watershed, &null, &error), UMB_ERROR_NON_FINITE, &error, 6);

  for (int given = 0; given < 2; given++) {
    umb_creases creases = UMB_CREASES_INIT;
    regions.classes = (umb_bytes){given ? classes : NULL, given ? 8 : 0, 0};
    regions.creases = &creases;
    classes[7] = UMB_SHAPE_FLAT;
    creases.angle = -1;
    fails(umb_segment_regions(&faces, &points, &regions, &null, &error), UMB_ERROR_OPTION_OUT_OF_RANGE, &error, no);
    creases.angle = (double)NAN;
    fails(umb_segment_regions(&faces, &points, &regions, &null, &error), UMB_ERROR_OPTION_OUT_OF_RANGE, &error, no);
    creases.angle = 0;
    regions.smallest_share = 1.5;
    fails(umb_segment_regions(&faces, &points, &regions, &null, &error), UMB_ERROR_OPTION_OUT_OF_RANGE, &error, no);
    regions.smallest_share = -0.5;
    fails(umb_segment_regions(&faces, &points, &regions, &null, &error), UMB_ERROR_OPTION_OUT_OF_RANGE, &error, no);
    regions.smallest_share = 0;
    regions.creases = NULL;
  }
  classes[7] = 9;
  fails(umb_segment_regions(&faces, &points, &regions, &null, &error), UMB_ERROR_UNKNOWN_CONSTANT, &error, 9);
  regions.classes.count = 7;
  fails(umb_segment_regions(&faces, &points, &regions, &null, &error), UMB_ERROR_SIZE, &error, no);
  regions.classes.data = NULL;
  fails(umb_segment_regions(&faces, &points, &regions, &null, &error), UMB_ERROR_NULL_POINTER, &error, no);
  regions.classes.count = 0;
  regions.tolerance = -1;
  fails(umb_segment_regions(&faces, &points, &regions, &null, &error), UMB_ERROR_OPTION_OUT_OF_RANGE, &error, no);
  CHECK(null == NULL);
  free(heights.data);
}

static void refused_sums(const struct mesh *mesh) {
  const uint64_t no = UMB_NO_ELEMENT;
  umb_error error = UMB_ERROR_INIT;
  umb_faces faces = faces_of(mesh), fewer = faces;
  umb_points points = points_of(mesh, UMB_SCALAR_F64), none = points;
  umb_segmentation *made = NULL;
  struct array ones = steps(mesh->face_count, 1, 0, UMB_SCALAR_F64);
  umb_scalars field = scalars_of(&ones, UMB_AT_FACES);
  double sums[6] = {-1, -1, -1, -1, -1, -1};
  double *numbers = (double *)(void *)ones.data;
  uint32_t offsets[6] = {0, 4, 8, 12, 16, 24};
  SUCCEEDS(umb_segment_features(&faces, &points, NULL, &made, &error));
  none.count = 7;
  fewer.offsets = offsets;
  fewer.face_count = 5;
  fails(umb_segmentation_areas(NULL, &faces, &points, sums, 6, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_segmentation_areas(made, NULL, &points, sums, 6, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_segmentation_areas(made, &faces, NULL, sums, 6, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_segmentation_areas(made, &faces, &points, NULL, 6, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_segmentation_areas(made, &faces, &points, sums, 5, &error), UMB_ERROR_SIZE, &error, no);
  fails(umb_segmentation_areas(made, &fewer, &points, sums, 6, &error), UMB_ERROR_SIZE, &error, no);
  fails(umb_segmentation_areas(made, &faces, &none, sums, 6, &error), UMB_ERROR_SIZE, &error, no);
  fails(umb_segmentation_means(NULL, &faces, &points, &field, sums, 6, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_segmentation_means(made, &faces, &points, NULL, sums, 6, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_segmentation_means(made, &faces, &points, &field, NULL, 6, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_segmentation_means(made, &faces, &points, &field, sums, 7, &error), UMB_ERROR_SIZE, &error, no);
  field.location = UMB_AT_VERTICES;
  fails(umb_segmentation_means(made, &faces, &points, &field, sums, 6, &error), UMB_ERROR_SIZE, &error, no);
  field.location = 2;
  fails(umb_segmentation_means(made, &faces, &points, &field, sums, 6, &error), UMB_ERROR_UNKNOWN_CONSTANT, &error, 2);
  field.location = UMB_AT_FACES;
  numbers[3] = (double)NAN;
  fails(umb_segmentation_means(made, &faces, &points, &field, sums, 6, &error), UMB_ERROR_NON_FINITE, &error, 3);
  mesh->positions[3 * 5] = (double)NAN;
  fails(umb_segmentation_areas(made, &faces, &points, sums, 6, &error), UMB_ERROR_NON_FINITE, &error, 5);
  mesh->positions[3 * 5] = 1;
  for (size_t i = 0; i < 6; i++) CHECK(sums[i] == -1);
  CHECK(umb_segmentation_count(NULL) == 0 && umb_segmentation_face_count(NULL) == 0);
  CHECK(umb_segmentation_labels(NULL) == NULL && umb_segmentation_boundary_edges(NULL) == NULL);
  CHECK(umb_segmentation_boundary_edge_count(NULL) == 0);
  umb_segmentation_destroy(NULL);
  umb_segmentation_destroy(made);
  free(ones.data);
}

static void refused_lists(const struct mesh *mesh) {
  const uint64_t no = UMB_NO_ELEMENT;
  umb_error error = UMB_ERROR_INIT;
  umb_topology *topology = topology_of(mesh, 1);
  umb_moved moved = UMB_MOVED_INIT;
  umb_normal_options normals = UMB_NORMAL_OPTIONS_INIT;
  umb_curvature_options curvature = UMB_CURVATURE_OPTIONS_INIT;
  uint32_t vertices[3] = {1, 2, 8}, list[8] = {77, 77, 77, 77, 77, 77, 77, 77};
  unsigned char status[8] = {0};
  size_t count = SIZE_MAX;
  normals.weight = UMB_WEIGHT_AREA;
  curvature.method = UMB_CURVATURE_TAUBIN;
  fails(umb_affected_normals(NULL, &moved, &normals, list, 8, &count, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_affected_normals(topology, NULL, &normals, list, 8, &count, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_affected_normals(topology, &moved, &normals, NULL, 8, &count, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_affected_normals(topology, &moved, &normals, list, 8, NULL, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_affected_curvatures(NULL, &moved, &curvature, list, 8, &count, &error), UMB_ERROR_NULL_POINTER, &error, no);
  fails(umb_affected_curvatures(topology, NULL, &curvature, list, 8, &count, &error), UMB_ERROR_NULL_POINTER, &error, no);
  moved.vertex_count = 3;
  fails(umb_affected_normals(topology, &moved, &normals, list, 8, &count, &error), UMB_ERROR_NULL_POINTER, &error, no);
  moved.vertices = vertices;
  fails(umb_affected_normals(topology, &moved, &normals, list, 8, &count, &error), UMB_ERROR_INDEX_OUT_OF_RANGE, &error, 2);
  fails(umb_affected_curvatures(topology, &moved, &curvature, list, 8, &count, &error), UMB_ERROR_INDEX_OUT_OF_RANGE, &error, 2);
  moved.vertices = (const uint32_t *)(const void *)((const unsigned char *)vertices + 1);
  moved.vertex_count = 1;
  fails(umb_affected_normals(topology, &moved, &normals, list, 8, &count, &error), UMB_ERROR_MISALIGNED, &error, no);
  moved.vertices = vertices;
  moved.vertex_count = SIZE_MAX;
  fails(umb_affected_normals(topology, &moved, &normals, list, 8, &count, &error), UMB_ERROR_SIZE, &error, no);
  moved.vertex_count = 2;
  moved.status.count = 8;
  fails(umb_affected_normals(topology, &moved, &normals, list, 8, &count, &error), UMB_ERROR_NULL_POINTER, &error, no);
  moved.status.data = status;
  moved.status.count = 7;
  fails(umb_affected_normals(topology, &moved, &normals, list, 8, &count, &error), UMB_ERROR_SIZE, &error, no);
  moved.status.count = 8;
  moved.reserved = 1;
  fails(umb_affected_normals(topology, &moved, &normals, list, 8, &count, &error), UMB_ERROR_UNKNOWN_FIELD, &error, 4);
  moved.reserved = 0;
  moved.struct_size = 47;
  fails(umb_affected_normals(topology, &moved, &normals, list, 8, &count, &error), UMB_ERROR_STRUCT_SIZE, &error, no);
  moved.struct_size = (uint32_t)sizeof moved;
  normals.weight = 99;
  fails(umb_affected_normals(topology, &moved, &normals, list, 8, &count, &error), UMB_ERROR_UNKNOWN_CONSTANT, &error, 99);
  normals.weight = UMB_WEIGHT_JET;
  normals.degree = 9;
  fails(umb_affected_normals(topology, &moved, &normals, list, 8, &count, &error), UMB_ERROR_OPTION_OUT_OF_RANGE, &error, no);
  curvature.method = 99;
  fails(umb_affected_curvatures(topology, &moved, &curvature, list, 8, &count, &error), UMB_ERROR_UNKNOWN_CONSTANT, &error, 99);
  curvature.method = UMB_CURVATURE_ADAPTIVE_JET;
  fails(umb_affected_curvatures(topology, &moved, &curvature, list, 8, &count, &error), UMB_ERROR_NOT_APPLICABLE, &error, no);
  curvature.method = UMB_CURVATURE_NORMAL_CYCLE;
  curvature.radius = 1;
  fails(umb_affected_curvatures(topology, &moved, &curvature, list, 8, &count, &error), UMB_ERROR_NOT_APPLICABLE, &error, no);
  /* Too little room. */
  normals.weight = UMB_WEIGHT_AREA;
  fails(umb_affected_normals(topology, &moved, &normals, list, 1, &count, &error), UMB_ERROR_SIZE, &error, no);
  for (size_t i = 0; i < 8; i++) CHECK(list[i] == 77);
  CHECK(count == SIZE_MAX);
  /* How much there has to be. */
  SUCCEEDS(umb_affected_normals(topology, &moved, &normals, NULL, 0, &count, &error));
  CHECK(count > 2 && count <= 8);
  /* Nothing has moved. */
  normals.weight = UMB_WEIGHT_AREA;
  SUCCEEDS(umb_affected_normals(topology, &(umb_moved){0}, &normals, list, 8, &count, &error));
  CHECK(count == 0 && list[0] == 77);
  umb_topology_destroy(topology);
}

int main(void) {
  struct mesh meshes[] = {cube(), sphere(2, 14, 8), torus(12, 9), broken()};
  /* The broken mesh has a face twice, neither of which meets another, and a fin that meets nothing. */
  static const size_t pieces[] = {1, 1, 1, 4};
  sides(&meshes[0]);
  for (size_t i = 0; i < sizeof meshes / sizeof meshes[0]; i++) {
    every_segmentation(&meshes[i], pieces[i]);
    shapes(&meshes[i]);
    cancelled(&meshes[i]);
  }
  refused_shapes(&meshes[0]);
  refused_segmentations(&meshes[0]);
  refused_sums(&meshes[0]);
  refused_lists(&meshes[0]);
  for (size_t i = 0; i < sizeof meshes / sizeof meshes[0]; i++) {
    updates(&meshes[i]);
    mesh_free(&meshes[i]);
  }
  puts("segments: cut where they should be");
  return 0;
}

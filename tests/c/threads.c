/*
 * Eight threads start at a barrier and use the same `const` handles at once, each with calls of another kind that themselves use one
 * to three threads; all results are the bytes that a single thread finds. The first argument is the number of rounds. With `apart`
 * as the second, calls use one thread each and none is the first of the process, for helgrind's sake: it only knows the locks of
 * pthread, and takes whatever Rust's guard for a race.
 */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>

#include "library.h"

/* One kind more than the library's table of functions has: calls on a cut mesh and on a segmentation. */
enum { THREADS = 8, MOST_ROUNDS = 1000, PARTS = KIND_COUNT, ALL_KINDS };

static const struct library library = LINKED_LIBRARY;
static pthread_barrier_t start;
static int apart;

struct handles {
  const umb_topology *topology; /* NULL: only calls that need none */
  const umb_cut *cut;
  const umb_segmentation *segmentation;
};

struct task {
  const struct mesh *mesh;
  struct handles handles;
  uint32_t number, rounds;
  pthread_t thread;
  uint64_t found[MOST_ROUNDS];
};

static int kind_of(const struct task *task, uint32_t round) {
  return task->handles.topology != NULL ? (int)((task->number + round) % ALL_KINDS) : (int)WITHOUT_HANDLE;
}

static uint64_t parts_round(const struct mesh *mesh, const struct handles *handles, uint32_t threads) {
  umb_error error = UMB_ERROR_INIT;
  umb_faces faces = faces_of(mesh);
  umb_points points = points_of(mesh, UMB_SCALAR_F64);
  size_t count = umb_segmentation_count(handles->segmentation), copies = umb_cut_vertex_count(handles->cut);
  struct array corners = array_of(mesh->index_count, 3, 0, UMB_SCALAR_F32);
  struct array positions = array_of(copies, 3, 0, UMB_SCALAR_F64), areas = array_of(count, 1, 0, UMB_SCALAR_F64);
  umb_output output = output_of(&positions);
  umb_normal_options options = UMB_NORMAL_OPTIONS_INIT;
  umb_corner_outputs outputs = UMB_CORNER_OUTPUTS_INIT;
  umb_moved moved = UMB_MOVED_INIT;
  uint32_t vertex = 7, *list = (uint32_t *)memory(copies * sizeof *list);
  size_t found = 0;
  uint64_t hash = HASH_START;
  options.weight = UMB_WEIGHT_ANGLE;
  options.run.threads = threads;
  outputs.corner = output_of(&corners);
  SUCCEEDS(umb_corner_normals(handles->cut, &points, &options, &outputs, &error));
  SUCCEEDS(umb_cut_points(handles->cut, &points, &output, &error));
  SUCCEEDS(umb_segmentation_areas(handles->segmentation, &faces, &points, (double *)(void *)areas.data, count, &error));
  moved.vertices = &vertex;
  moved.vertex_count = 1;
  SUCCEEDS(umb_affected_normals(umb_cut_topology(handles->cut), &moved, &options, list, umb_cut_vertex_count(handles->cut), &found, &error));
  hash = hash_bytes(hash, corners.data, corners.bytes);
  hash = hash_bytes(hash, positions.data, positions.bytes);
  hash = hash_bytes(hash, areas.data, areas.bytes);
  hash = hash_bytes(hash, list, found * sizeof *list);
  hash = hash_bytes(hash, umb_segmentation_labels(handles->segmentation), mesh->face_count * sizeof(uint32_t));
  free(corners.data);
  free(positions.data);
  free(areas.data);
  free(list);
  return hash;
}

static uint64_t work_of(const struct mesh *mesh, const struct handles *handles, int kind, uint32_t threads) {
  if (kind == PARTS) return parts_round(mesh, handles, threads);
  return work(&library, handles->topology, mesh, (enum kind)kind, threads);
}

static void *run(void *argument) {
  struct task *task = (struct task *)argument;
  pthread_barrier_wait(&start);
  for (uint32_t round = 0; round < task->rounds; round++) {
    uint32_t threads = apart ? 1 : 1 + (task->number / 2 + round) % 3;
    task->found[round] = work_of(task->mesh, &task->handles, kind_of(task, round), threads);
  }
  return NULL;
}

static void race(const struct mesh *mesh, const struct handles *handles, uint32_t rounds) {
  static struct task tasks[THREADS];
  uint64_t expected[ALL_KINDS];
  CHECK(pthread_barrier_init(&start, NULL, THREADS) == 0);
  for (uint32_t t = 0; t < THREADS; t++) {
    tasks[t].mesh = mesh;
    tasks[t].handles = *handles;
    tasks[t].number = t;
    tasks[t].rounds = rounds;
    CHECK(pthread_create(&tasks[t].thread, NULL, run, &tasks[t]) == 0);
  }
  for (uint32_t t = 0; t < THREADS; t++) CHECK(pthread_join(tasks[t].thread, NULL) == 0);
  pthread_barrier_destroy(&start);
  for (int kind = 0; kind < ALL_KINDS; kind++) {
    if (handles->topology != NULL || kind == WITHOUT_HANDLE) expected[kind] = work_of(mesh, handles, kind, 1);
  }
  for (uint32_t t = 0; t < THREADS; t++) {
    for (uint32_t round = 0; round < rounds; round++) {
      CHECK(tasks[t].found[round] == expected[kind_of(&tasks[t], round)]);
    }
  }
}

int main(int count, char **arguments) {
  uint32_t rounds = count > 1 ? (uint32_t)strtoul(arguments[1], NULL, 10) : 16;
  struct mesh meshes[] = {sphere(2, 24, 16), torus(24, 18), broken(), torus(70, 31)};
  struct handles nothing = {NULL, NULL, NULL};
  CHECK(rounds <= MOST_ROUNDS);
  apart = count > 2 && strcmp(arguments[2], "apart") == 0;
  if (apart) work(&library, NULL, &meshes[0], WITHOUT_HANDLE, 1);
  /* The first calls of the process, so that the threads race to whatever is set up once. */
  race(&meshes[0], &nothing, 1);
  for (size_t i = 0; i < sizeof meshes / sizeof meshes[0]; i++) {
    umb_error error = UMB_ERROR_INIT;
    umb_faces faces = faces_of(&meshes[i]);
    umb_points points = points_of(&meshes[i], UMB_SCALAR_F64);
    umb_topology *topology = topology_of(&meshes[i], 0);
    umb_cut *cut = NULL;
    umb_segmentation *segmentation = NULL;
    struct handles handles;
    SUCCEEDS(umb_cut_create(&faces, &points, NULL, NULL, &cut, &error));
    SUCCEEDS(umb_segment_features(&faces, &points, NULL, &segmentation, &error));
    handles.topology = topology;
    handles.cut = cut;
    handles.segmentation = segmentation;
    race(&meshes[i], &handles, rounds);
    umb_segmentation_destroy(segmentation);
    umb_cut_destroy(cut);
    umb_topology_destroy(topology);
    mesh_free(&meshes[i]);
  }
  puts("threads: the same bytes from eight at once");
  return 0;
}

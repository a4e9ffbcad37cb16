/* Times umbilic alone: see program.h for the arguments, and `SETS` for the sets of tasks. */
#include "ours.h"
#include "program.h"
#include "scatter.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const LEVELS[] = {"best", "portable", "sse2", "avx2", "avx512"};

/* Tasks, and the calls that they point to. */
typedef struct list {
  ours *o;
  const mesh *m;
  float *normals; /* room for those of the loop over quadrilaterals */
  size_t count;
  task tasks[160];
  ours_call calls[160];
} list;

static void add(list *l, const char *name, umb_scalar scalar, uint32_t threads, umb_simd simd) {
  if (l->count == sizeof l->tasks / sizeof *l->tasks) abort();
  ours_call *call = &l->calls[l->count];
  *call = (ours_call){l->o, name, scalar, threads, simd};
  l->tasks[l->count++] = (task){"umbilic",
                                name,
                                scalar == UMB_SCALAR_F64 ? "f64" : "f32",
                                LEVELS[simd],
                                (int)threads,
                                1,
                                ours_run_call,
                                call};
}

static void run_quads(void *context) {
  const list *l = context;
  scatter_quads(l->m, l->normals);
}

/* The plain C loop over quadrilaterals, where there are no others. */
static void add_quads(list *l) {
  if (!all_quads(l->m)) return;
  if (l->count == sizeof l->tasks / sizeof *l->tasks) abort();
  l->normals = allocate(3 * l->m->vertex_count * sizeof *l->normals);
  l->tasks[l->count++] = (task){"C", "scatter over quads", "f32", "as built", 1, 1, run_quads, l};
}

/* Where what is slow is worth its time. */
static int is_small(list *l) {
  return umb_topology_vertex_count(ours_topology(l->o)) < 200000;
}

/* Each name in both scalars on one thread. */
static void add_all(list *l, const char *const *names) {
  for (; *names; names++) {
    add(l, *names, UMB_SCALAR_F32, 1, 0);
    add(l, *names, UMB_SCALAR_F64, 1, 0);
  }
}

static void add_normals(list *l) {
  static const char *const names[] = {"N_CM from faces", "N_CM", "uniform", "angle", "area", "Max", "centroid-area",
                                      "centroid", "inverse-root-edges", "sine", "angle-edges", "angle, at corners",
                                      "angle, at corners by index", "N_CM, at corners", NULL};
  add_quads(l);
  add(l, "topology", UMB_SCALAR_F32, 1, 0);
  add(l, "cut along creases", UMB_SCALAR_F32, 1, 0);
  add_all(l, names);
}

static void add_levels(list *l) {
  static const char *const names[] = {"N_CM", "uniform", "angle", "area", "Max", "least squares", NULL};
  /* Without SSE2, which is another name for what is portable. */
  static const umb_simd levels[] = {UMB_SIMD_PORTABLE, UMB_SIMD_AVX2, UMB_SIMD_AVX512};
  for (size_t i = 0; i < sizeof levels / sizeof *levels; i++)
    for (const char *const *name = names; *name; name++) {
      add(l, *name, UMB_SCALAR_F32, 1, levels[i]);
      if (name == names || !name[1]) add(l, *name, UMB_SCALAR_F64, 1, levels[i]);
    }
}

static void add_threads(list *l) {
  static const char *const names[] = {"area",          "N_CM",
                                      "N_CM from faces", "least squares",
                                      "Rusinkiewicz, on given normals", NULL};
  for (uint32_t threads = 1; threads <= 2; threads++) {
    add(l, "topology", UMB_SCALAR_F32, threads, 0);
    for (const char *const *name = names; *name; name++) add(l, *name, UMB_SCALAR_F32, threads, 0);
    add(l, "N_CM", UMB_SCALAR_F64, threads, 0);
    add(l, "least squares", UMB_SCALAR_F64, threads, 0);
    if (is_small(l)) add(l, "adaptive jets, 4 rings", UMB_SCALAR_F32, threads, 0);
  }
}

/* Those that are worth their time on a large mesh. */
static void add_curvatures(list *l) {
  static const char *const names[] = {"least squares",
                                      "least squares, on given normals",
                                      "Meyer, on given normals",
                                      "Rusinkiewicz, on given normals",
                                      "corrected measure, on given normals",
                                      NULL};
  add_all(l, names);
}

static void add_adaptive(list *l) {
  static const char *const names[] = {"adaptive jets, 4 rings", NULL};
  add_all(l, names);
}

static void add_methods(list *l) {
  static const char *const names[] = {"N_CM",
                                      "tilted-sections",
                                      "jet",
                                      "adaptive-jet, 4 rings",
                                      "edge sections",
                                      "edge sections, on given normals",
                                      "direction sections, one each, on given normals",
                                      "tilted sections",
                                      "least squares",
                                      "least squares, on given normals",
                                      "least squares, circles, on given normals",
                                      "Taubin, on given normals",
                                      "Watanabe, on given normals",
                                      "Meyer, on given normals",
                                      "angle defect",
                                      "Rusinkiewicz",
                                      "Rusinkiewicz, on given normals",
                                      "normal cycle, on given normals",
                                      "normal cycle, 2 rings, on given normals",
                                      "corrected measure",
                                      "corrected measure, on given normals",
                                      "corrected measure, 2 rings, on given normals",
                                      "quadric, on given normals",
                                      "quadric, 2 rings, on given normals",
                                      "Goldfeather, on given normals",
                                      "jets 2, 2 rings",
                                      "jets 3, 2 rings",
                                      "jets 4, 3 rings",
                                      "adaptive jets, 3 rings",
                                      "adaptive jets, 4 rings",
                                      "adaptive jets",
                                      NULL};
  add_all(l, names);
}

/* What allocates: the topology, and whatever writes to memory that is allocated with it. */
static void add_memory(list *l) {
  add(l, "topology", UMB_SCALAR_F32, 1, 0);
  add(l, "area", UMB_SCALAR_F32, 1, 0);
  add(l, "N_CM", UMB_SCALAR_F32, 1, 0);
  add(l, "N_CM from faces", UMB_SCALAR_F32, 1, 0);
  add(l, "least squares", UMB_SCALAR_F32, 1, 0);
}

static void add_memory_both(list *l) {
  add_memory(l);
  add(l, "N_CM", UMB_SCALAR_F64, 1, 0);
  add(l, "least squares", UMB_SCALAR_F64, 1, 0);
}

static void add_scaling(list *l) {
  add_memory(l);
  if (is_small(l)) add(l, "adaptive jets, 4 rings", UMB_SCALAR_F32, 1, 0);
}

static const struct {
  const char *name;
  void (*add)(list *l);
} SETS[] = {{"normals", add_normals}, {"levels", add_levels}, {"threads", add_threads}, {"curvatures", add_curvatures},
            {"adaptive", add_adaptive}, {"methods", add_methods}, {"memory", add_memory_both}, {"scaling", add_scaling}};

static void peak(const program *p, ours *o) {
  double handle = 0;
  if (!strcmp(p->peak, "topology")) handle = ours_handle_bytes(o);
  else if (strcmp(p->peak, "nothing")) ours_run(o, p->peak, UMB_SCALAR_F32, 1, 0);
  print_peak(p, handle);
}

int main(int argc, char **argv) {
  if (argc == 2 && !strcmp(argv[1], "--version")) {
    puts(umb_build_info());
    return 0;
  }
  program p = start_program("umbilic", argc, argv);
  static list l;
  l.o = ours_new(&p.m, !strcmp(p.b.memory, "fresh"));
  l.m = &p.m;
  if (p.peak) {
    peak(&p, l.o);
  } else {
    for (size_t s = 0; s < sizeof SETS / sizeof *SETS; s++)
      if (!strcmp(SETS[s].name, p.tasks)) SETS[s].add(&l);
    if (!l.count) fprintf(stderr, "there are no tasks '%s'\n", p.tasks);
    time_tasks(&p.b, &p.m, l.tasks, l.count);
  }
  free(l.normals);
  ours_free(l.o);
  free_mesh(&p.m);
  return 0;
}

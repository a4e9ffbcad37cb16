#include "program.h"

#include "memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The file's name without folder and suffix. */
static const char *mesh_name(const char *path) {
  static char name[64];
  const char *slash = strrchr(path, '/');
  snprintf(name, sizeof name, "%s", slash ? slash + 1 : path);
  name[strcspn(name, ".")] = 0;
  return name;
}

program start_program(const char *name, int argc, char **argv) {
  int rounds = argc > 4 ? atoi(argv[4]) : 9;
  if (argc < 3 || argc > 5 || rounds < 1) {
    fprintf(stderr, "usage: %s MESH TASKS [MEMORY [ROUNDS]]\n", argv[0]);
    exit(2);
  }
  const char *memory = argc > 3 ? argv[3] : "as it comes";
  set_memory(memory);
  program p = {.b = {name, mesh_name(argv[1]), memory, rounds}, .tasks = argv[2]};
  if (!strncmp(p.tasks, "peak:", 5)) p.peak = p.tasks + 5;
  p.m = read_mesh(argv[1]);
  return p;
}

void print_peak(const program *p, double handle_bytes) {
  printf("{\"program\": \"%s\", \"mesh\": \"%s\", \"triangles\": %zu, \"peak\": \"%s\", \"bytes\": %.0f", p->b.program,
         p->b.mesh_name, p->m.triangle_count, p->peak, peak_memory());
  if (handle_bytes > 0) printf(", \"handle\": %.0f", handle_bytes);
  printf("}\n");
}

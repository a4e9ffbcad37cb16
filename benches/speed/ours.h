/* What umbilic computes in the benchmarks, by name, through its C interface. */
#ifndef UMBILIC_BENCHES_OURS_H
#define UMBILIC_BENCHES_OURS_H

#include "mesh.h"
#include "umbilic.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A mesh with its topology, which is built when first needed, and with room for results. */
typedef struct ours ours;

/* Where results are `fresh`, their memory is allocated and freed in each run. */
ours *ours_new(const mesh *m, int fresh);
void ours_free(ours *o);

/* Runs a variant of ours.c. Positions, given normals and results are of the scalar. */
void ours_run(ours *o, const char *name, umb_scalar scalar, uint32_t threads, umb_simd simd);

const umb_topology *ours_topology(ours *o);
/* The first result of the last run in warm memory: the normals, k1 or the sections. */
const void *ours_result(const ours *o);
/* Heap memory that the topology holds. */
double ours_handle_bytes(ours *o);

/* One call of a name, for lists of calls. */
typedef struct ours_call {
  ours *o;
  const char *name;
  umb_scalar scalar;
  uint32_t threads;
  umb_simd simd;
} ours_call;
/* `call` is an ours_call. */
void ours_run_call(void *call);

#ifdef __cplusplus
}
#endif

#endif

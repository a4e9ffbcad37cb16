/* The plain C scatter kernel that everything is measured against. */
#ifndef UMBILIC_BENCHES_SCATTER_H
#define UMBILIC_BENCHES_SCATTER_H

#include "mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Adds each triangle's cross product to its three vertices and normalises: area weights, float, no checks. */
void scatter_area(const mesh *m, float *normals);

#ifdef __cplusplus
}
#endif

#endif

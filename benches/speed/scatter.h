/* The plain C scatter kernel that everything is measured against, and its like over quadrilaterals. */
#ifndef UMBILIC_BENCHES_SCATTER_H
#define UMBILIC_BENCHES_SCATTER_H

#include "mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Adds each triangle's cross product to its three vertices and normalises: area weights, float, no checks. */
void scatter_area(const mesh *m, float *normals);

/* The same over quadrilaterals: half the cross product of the diagonals has the area and the normal of all four corners. All
 * polygons of the mesh must have four. */
void scatter_quads(const mesh *m, float *normals);

#ifdef __cplusplus
}
#endif

#endif

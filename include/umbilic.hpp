/*
 * umbilic in C++17: the C interface of umbilic.h with handles that free themselves, views of the host's own containers, and errors
 * as exceptions or as values. Header only; link with umbilic.
 *
 *   std::vector<std::array<float, 3>> positions = ...;
 *   std::vector<std::array<std::uint32_t, 3>> triangles = ...;
 *   umbilic::topology mesh(triangles, positions.size());
 *   std::vector<std::array<float, 3>> normals(positions.size());
 *   umbilic::vertex_normals(mesh, positions, normals);                  // N_CM
 *   umbilic::curvature_outputs wanted;
 *   wanted.k1 = k1, wanted.k2 = k2;                                     // std::vector<double>
 *   umbilic::curvatures(mesh, positions, wanted);                       // adaptive jets
 *
 * What the functions compute, in which units and with which errors, is said in umbilic.h at the function of the same name; here
 * stands what is different. Views borrow: what they were made of has to live until the call returns. Nothing is copied or
 * allocated beyond what the C functions do, but where a function returns a std::vector.
 *
 * Errors. Every function comes twice: one throws `umbilic::error`; the other takes an `umbilic::status &` at the end, throws
 * nothing, and sets it. Those that allocate a std::vector, `shape_classes` by positions, and all of the headers for hosts only throw; a
 * `status` does not keep `polygons` and what else is copied from running out of memory. An output that is a container is checked for its length, which C cannot do (`UMB_ERROR_SIZE`). What a progress
 * callback throws passes through both, after the call has been cancelled. Without exceptions (`-fno-exceptions`) the
 * throwing forms end the process.
 *
 * Threads: as in C. A `const` handle may be used by any number of threads at once.
 */
#ifndef UMBILIC_HPP
#define UMBILIC_HPP

// In this order, each over the one before.
#include <umbilic/errors.hpp>
#include <umbilic/containers.hpp>
#include <umbilic/views.hpp>
#include <umbilic/options.hpp>
#include <umbilic/handles.hpp>
#include <umbilic/normals.hpp>
#include <umbilic/curvature.hpp>
#include <umbilic/parts.hpp>
#include <umbilic/adapters.hpp>

#endif  // UMBILIC_HPP

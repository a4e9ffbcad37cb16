// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parameters of umbilic's filters: what MeshLab's dialogs show and scripts name, and what it means to the library.
//
// Entries of lists stand in the order of the library's constants, so that a list's number is the constant; what is no entry the library refuses.
#ifndef UMBILIC_MESHLAB_PARAMETERS_H
#define UMBILIC_MESHLAB_PARAMETERS_H

#include <common/filter_parameter/rich_parameter_list.h>
#include <common/ml_mesh_type.h>

#include <umbilic.hpp>

namespace umbilic_meshlab {

/** What the list "quality" has. */
enum class Subject { mean, gaussian, k2, k1, shape_index, curvedness, none };

/** What the list "colors" has. */
enum class Colors { diverging, ramp, none };

/** What the list "by" has. */
enum class Segments { features, watershed, regions };

// These throw if there is no parameter of that name, or one of another kind or beyond its range.

/** A number of a list, or one without fraction, from 0 to the last. */
std::uint32_t count(const RichParameterList &given, const char *name, std::uint32_t last = std::numeric_limits<std::uint32_t>::max());

/** A number of a list, as what it stands for. */
template <class List>
List choice(const RichParameterList &given, const char *name, List last) {
  return static_cast<List>(count(given, name, static_cast<std::uint32_t>(last)));
}

double decimal(const RichParameterList &given, const char *name);

/** From 0 to 100. */
double percentage(const RichParameterList &given, const char *name);

void add_normal_parameters(RichParameterList &parameters);
umbilic::normal_options normal_options_of(const RichParameterList &given);

/** Those of the method, which curvatures and segments have in common. `diagonal` is that of the mesh's bounding box. */
void add_method_parameters(RichParameterList &parameters, float diagonal);
umbilic::curvature_options method_of(const RichParameterList &given, const CMeshO &mesh);

void add_color_parameters(RichParameterList &parameters);
void add_segment_parameters(RichParameterList &parameters);

}  // namespace umbilic_meshlab

#endif  // UMBILIC_MESHLAB_PARAMETERS_H

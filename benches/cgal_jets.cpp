// CGAL's osculating jets, for curvature.c.
#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Simple_cartesian.h>

#include <cstddef>
#include <cstdint>
#include <vector>

// Fits a jet of `degree` to each neighbourhood: members `offsets[k]` up to `offsets[k + 1]`, the vertex itself first.
// `normals`, of all vertices, tell the sides of the surface apart. Writes the larger principal curvature in umbilic's
// sign.
extern "C" void cgal_jets(const double *points, const double *normals, const std::uint32_t *members,
                          const std::size_t *offsets, std::size_t count, unsigned degree, double *k1) {
  using Kernel = CGAL::Simple_cartesian<double>;
  std::vector<Kernel::Point_3> neighbourhood;
  for (std::size_t k = 0; k < count; k++) {
    neighbourhood.clear();
    for (std::size_t entry = offsets[k]; entry < offsets[k + 1]; entry++) {
      const double *point = points + 3 * static_cast<std::size_t>(members[entry]);
      neighbourhood.emplace_back(point[0], point[1], point[2]);
    }
    CGAL::Monge_via_jet_fitting<Kernel> fitting;
    auto form = fitting(neighbourhood.begin(), neighbourhood.end(), degree, 2);
    const double *normal = normals + 3 * static_cast<std::size_t>(members[offsets[k]]);
    form.comply_wrt_given_normal(Kernel::Vector_3(normal[0], normal[1], normal[2]));
    k1[k] = -form.principal_curvatures(1);
  }
}

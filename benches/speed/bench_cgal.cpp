// Times CGAL, in double precision, and umbilic: see program.h for the arguments; the sets of tasks are "mesh" (structure,
// normals, corrected curvatures) and "jets", and what can be run once is "structure", "normals" and "curvatures". CGAL runs on one
// thread.
//
// Jets are fitted to the same neighbourhoods of a sample of vertices; gathering these is part of umbilic's time, which
// is that of all vertices, and not of CGAL's.
#include "tasks.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/version.h>
#if __has_include(<CGAL/Polygon_mesh_processing/interpolated_corrected_curvatures.h>)
#include <CGAL/Polygon_mesh_processing/interpolated_corrected_curvatures.h>
#define HAS_CORRECTED_CURVATURES
#endif

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Vertex = Mesh::Vertex_index;
namespace Processing = CGAL::Polygon_mesh_processing;

const std::size_t SAMPLE = 500; // vertices

Mesh build(const mesh &m) {
  Mesh out;
  out.reserve(static_cast<Mesh::size_type>(m.vertex_count), static_cast<Mesh::size_type>(m.corner_count / 2),
              static_cast<Mesh::size_type>(m.polygon_count));
  for (std::size_t vertex = 0; vertex < m.vertex_count; vertex++) {
    const double *at = m.positions_double + 3 * vertex;
    out.add_vertex(Point(at[0], at[1], at[2]));
  }
  std::vector<Vertex> corners;
  for (std::size_t polygon = 0; polygon < m.polygon_count; polygon++) {
    const std::size_t begin = m.offsets ? m.offsets[polygon] : 3 * polygon;
    const std::size_t end = m.offsets ? m.offsets[polygon + 1] : 3 * polygon + 3;
    corners.clear();
    for (std::size_t corner = begin; corner < end; corner++) {
      corners.emplace_back(m.corners[corner]);
    }
    if (out.add_face(corners) == Mesh::null_face()) {
      std::fputs("CGAL refuses a face\n", stderr);
      std::exit(1);
    }
  }
  return out;
}

class Measured {
public:
  explicit Measured(const mesh &m) : built(build(m)) {
    normal = built.add_property_map<Vertex, Vector>("v:normal", Vector(0, 0, 0)).first;
  }

  void normals() { Processing::compute_vertex_normals(built, normal); }

  // On the normals that are there; all three curvatures at once.
  void corrected_curvatures() {
#ifdef HAS_CORRECTED_CURVATURES
    using Principal = Processing::Principal_curvatures_and_directions<Kernel>;
    const auto map = built.add_property_map<Vertex, Principal>("v:principal").first;
    Processing::interpolated_corrected_curvatures(
        built, CGAL::parameters::vertex_principal_curvatures_and_directions_map(map).vertex_normal_map(normal));
#endif
  }

private:
  Mesh built;
  Mesh::Property_map<Vertex, Vector> normal;
};

// The vertices within some rings of each vertex of a sample, which comes first. Triangles only.
struct Neighbourhoods {
  Neighbourhoods(const umb_topology *topology, std::size_t vertex_count, unsigned rings) {
    const std::size_t count = std::min(vertex_count, SAMPLE);
    step = vertex_count / count;
    for (std::size_t k = 0; k < count; k++) {
      points.push_back(gather(topology, static_cast<std::uint32_t>(k * step), rings));
    }
  }

  std::vector<std::uint32_t> gather(const umb_topology *topology, std::uint32_t centre, unsigned rings) const {
    const std::uint32_t *starts = umb_topology_ring_offsets(topology), *ring = umb_topology_ring_neighbours(topology);
    std::vector<std::uint32_t> found{centre};
    std::size_t next = 0;
    for (unsigned r = 0; r < rings; r++) {
      for (const std::size_t last = found.size(); next < last; next++) {
        const std::uint32_t *begin = ring + starts[found[next]], *end = ring + starts[found[next] + 1];
        for (const std::uint32_t *each = begin; each < end; each++) {
          if (std::find(found.begin(), found.end(), *each) == found.end()) {
            found.push_back(*each);
          }
        }
      }
    }
    return found;
  }

  std::size_t step;
  std::vector<std::vector<std::uint32_t>> points;
};

// The larger principal curvatures at the sample, in umbilic's sign, by jets of a degree. Normals of all vertices tell the
// sides of the surface apart.
std::vector<double> jets(const mesh &m, const std::vector<double> &normals, const Neighbourhoods &neighbourhoods,
                         unsigned degree) {
  std::vector<double> k1;
  std::vector<Point> points;
  for (const std::vector<std::uint32_t> &members : neighbourhoods.points) {
    points.clear();
    for (const std::uint32_t member : members) {
      const double *at = m.positions_double + 3 * std::size_t(member);
      points.emplace_back(at[0], at[1], at[2]);
    }
    CGAL::Monge_via_jet_fitting<Kernel> fitting;
    auto form = fitting(points.begin(), points.end(), degree, 2);
    const double *normal = &normals[3 * std::size_t(members[0])];
    form.comply_wrt_given_normal(Vector(normal[0], normal[1], normal[2]));
    k1.push_back(-form.principal_curvatures(1));
  }
  return k1;
}

void time_mesh(const program &p) {
  Measured measured(p.m);
  Tasks tasks(p);
  tasks.add_ours("topology", UMB_SCALAR_F64);
  tasks.add_ours("N_CM", UMB_SCALAR_F64);
  tasks.add_ours("Max", UMB_SCALAR_F64);
  tasks.add("CGAL", "structure", "f64", [&p] { build(p.m); });
  tasks.add("CGAL", "compute_vertex_normals", "f64", [&] { measured.normals(); });
#ifdef HAS_CORRECTED_CURVATURES
  if (!p.m.offsets) {
    measured.normals();
    tasks.add_ours("corrected measure, on given normals", UMB_SCALAR_F32);
    tasks.add_ours("corrected measure, on given normals", UMB_SCALAR_F64);
    tasks.add("CGAL", "interpolated_corrected_curvatures", "f64", [&] { measured.corrected_curvatures(); });
  }
#endif
  tasks.time();
}

struct Jet {
  const char *name, *ours;
  unsigned degree, rings;
};

void time_jets(const program &p) {
  static const Jet kinds[] = {{"Monge_via_jet_fitting 2, 2 rings", "jets 2, 2 rings", 2, 2},
                              {"Monge_via_jet_fitting 3, 2 rings", "jets 3, 2 rings", 3, 2},
                              {"Monge_via_jet_fitting 4, 3 rings", "jets 4, 3 rings", 4, 3}};
  Tasks tasks(p);
  const std::vector<double> normals = tasks.result("N_CM", 3);
  std::deque<Neighbourhoods> neighbourhoods;
  std::vector<double> differences;
  for (const Jet &kind : kinds) {
    const Neighbourhoods &near = neighbourhoods.emplace_back(tasks.topology(), p.m.vertex_count, kind.rings);
    const std::vector<double> theirs = jets(p.m, normals, near, kind.degree), ours = tasks.result(kind.ours, 1);
    double worst = 0, size = 0;
    for (std::size_t k = 0; k < theirs.size(); k++) {
      worst = std::max(worst, std::fabs(theirs[k] - ours[k * near.step]));
      size = std::max(size, std::fabs(theirs[k]));
    }
    differences.push_back(worst / size);
    const double share = double(theirs.size()) / double(p.m.vertex_count);
    tasks.add("CGAL", kind.name, "f64", [&] { jets(p.m, normals, near, kind.degree); }, share);
    tasks.add_ours(kind.ours, UMB_SCALAR_F32);
    tasks.add_ours(kind.ours, UMB_SCALAR_F64);
  }
  tasks.add_ours("adaptive jets, 4 rings", UMB_SCALAR_F32);
  tasks.add_ours("adaptive jets, 4 rings", UMB_SCALAR_F64);
  tasks.time();
  for (std::size_t k = 0; k < differences.size(); k++) {
    std::printf("{\"program\": \"cgal\", \"mesh\": \"%s\", \"agreement\": \"%s\", \"difference\": %.1e}\n",
                p.b.mesh_name, kinds[k].ours, differences[k]);
  }
}

void run_once(const program &p) {
#ifndef HAS_CORRECTED_CURVATURES
  if (!std::strcmp(p.peak, "curvatures")) {
    return;
  }
#endif
  if (std::strcmp(p.peak, "nothing") != 0) {
    Measured measured(p.m);
    if (std::strcmp(p.peak, "structure") != 0) {
      measured.normals();
    }
    if (!std::strcmp(p.peak, "curvatures")) {
      measured.corrected_curvatures();
    }
  }
  print_peak(&p, 0);
}

} // namespace

int main(int argc, char **argv) {
  if (argc == 2 && !std::strcmp(argv[1], "--version")) {
    std::puts("CGAL " CGAL_VERSION_STR);
#ifndef HAS_CORRECTED_CURVATURES
    std::puts("CGAL " CGAL_VERSION_STR " has no interpolated corrected curvatures (5.6 and later have): not compared with");
#endif
    return 0;
  }
  program p = start_program("cgal", argc, argv);
  if (p.peak) {
    run_once(p);
  } else if (!std::strcmp(p.tasks, "jets")) {
    time_jets(p);
  } else {
    time_mesh(p);
  }
  free_mesh(&p.m);
  return 0;
}

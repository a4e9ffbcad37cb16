// Vertex normals and osculating jets of CGAL.
//
// The rings of a jet are those of CGAL's example Mesh_estimation: vertices joined by edges, and as many rings as are
// wanted, or more until there are as many points as the polynomial has coefficients.

// CGAL's default are closed formulas of eigenvectors, which lose half the digits.
#define DO_NOT_USE_EIGEN_COMPUTEDIRECT_FOR_DIAGONALIZATION

#include "peer.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/version.h>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Vertex = Mesh::Vertex_index;

class CgalPeer {
public:
  explicit CgalPeer(const peer::Input &input) {
    for (std::size_t vertex = 0; vertex < input.vertices(); vertex++) {
      const double *at = &input.positions[3 * vertex];
      mesh.add_vertex(Point(at[0], at[1], at[2]));
    }
    input.faces([&](std::size_t count, const std::int32_t *face) {
      std::vector<Vertex> corners;
      for (std::size_t corner = 0; corner < count; corner++) {
        corners.emplace_back(static_cast<Mesh::size_type>(face[corner]));
      }
      peer::must(mesh.add_face(corners) != Mesh::null_face());
    });
    // These tell the sides of jets apart.
    normals = mesh.add_property_map<Vertex, Vector>("v:normal", Vector(0, 0, 0)).first;
    CGAL::Polygon_mesh_processing::compute_vertex_normals(mesh, normals);
  }

  static std::string name() { return "CGAL " CGAL_VERSION_STR; }

  std::vector<peer::Method> methods() {
    std::vector<peer::Method> methods{{"compute_vertex_normals", "normal", [this](double *out) {
                                         CGAL::Polygon_mesh_processing::compute_vertex_normals(mesh, normals);
                                         for (const Vertex vertex : mesh.vertices()) {
                                           write(normals[vertex], out + 3 * vertex.idx());
                                         }
                                       }}};
    const unsigned jets[][2] = {{2, 1}, {2, 2}, {3, 2}, {3, 3}, {4, 3}};
    for (const auto &[degree, rings] : jets) {
      const std::string name = "Monge_via_jet_fitting " + std::to_string(degree) + "-" + std::to_string(rings);
      const auto run = [this, degree = degree, rings = rings](double *out) { jet(degree, rings, out); };
      methods.push_back({name, "both", run});
    }
    return methods;
  }

private:
  static void write(const Vector &vector, double *out) {
    out[0] = vector.x();
    out[1] = vector.y();
    out[2] = vector.z();
  }

  void jet(unsigned degree, unsigned rings, double *out) {
    std::vector<unsigned> seen(mesh.number_of_vertices(), 0);
    std::vector<Vertex> found;
    std::vector<Point> points;
    for (const Vertex vertex : mesh.vertices()) {
      gather(vertex, rings, (degree + 1) * (degree + 2) / 2, seen, found);
      points.clear();
      for (const Vertex each : found) {
        points.push_back(mesh.point(each));
      }
      CGAL::Monge_via_jet_fitting<Kernel> fitting;
      auto form = fitting(points.begin(), points.end(), degree, 2);
      form.comply_wrt_given_normal(normals[vertex]);
      write(form.normal_direction(), out + 5 * vertex.idx());
      // In CGAL a surface that bends towards its normal is curved positively.
      out[5 * vertex.idx() + 3] = -form.principal_curvatures(1);
      out[5 * vertex.idx() + 4] = -form.principal_curvatures(0);
    }
  }

  void gather(Vertex centre, unsigned rings, std::size_t enough, std::vector<unsigned> &seen,
              std::vector<Vertex> &found) const {
    const unsigned mark = centre.idx() + 1;
    found.assign(1, centre);
    seen[centre.idx()] = mark;
    std::size_t begin = 0;
    for (unsigned ring = 0; ring < rings || found.size() < enough; ring++) {
      const std::size_t end = found.size();
      for (; begin < end; begin++) {
        for (const Vertex neighbour : mesh.vertices_around_target(mesh.halfedge(found[begin]))) {
          if (seen[neighbour.idx()] != mark) {
            seen[neighbour.idx()] = mark;
            found.push_back(neighbour);
          }
        }
      }
      if (found.size() == end) {
        return;
      }
    }
  }

  Mesh mesh;
  Mesh::Property_map<Vertex, Vector> normals;
};

} // namespace

int main(int arguments, char **argument) { return peer::serve<CgalPeer>(arguments, argument); }

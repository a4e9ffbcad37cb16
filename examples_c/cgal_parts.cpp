/*
 * All that umbilic computes in a CGAL surface mesh, and its parts: normals split at sharp edges and segments between them, compared with
 * CGAL's.
 *
 * Build and run, in this directory, after `cargo build --release` in the one above:
 *
 *   ln -sf libumbilic.so ../target/release/libumbilic.so.0
 *   c++ -std=c++17 -O2 -Wall -Wextra -I../include cgal_parts.cpp -o cgal_parts \
 *     -L../target/release -lumbilic -lgmp -lmpfr -Wl,-rpath,../target/release
 *   ./cgal_parts [-o DIRECTORY] FILE...
 *
 * With -o, each mesh is written there as PLY, with normals, curvatures and segments, these as colours of faces, too.
 *
 * Sharp edges are those that CGAL's `detect_sharp_edges` marks at 30 degrees. Segments have to be CGAL's `connected_components` between them,
 * and a halfedge normal by areas the sum of CGAL's area normals from one sharp edge around its target to the next, to 1e-12.
 */

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>
#include <string>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>

#include <umbilic/cgal.hpp>

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Face = Mesh::Face_index;
using Edge = Mesh::Edge_index;
using Labels = Mesh::Property_map<Face, std::uint32_t>;

void write(Mesh &mesh, const Labels &labels, const std::string &path) {
  auto colors = mesh.add_property_map<Face, CGAL::IO::Color>("f:color").first;
  for (const auto face : mesh.faces()) {
    const std::uint32_t mixed = (labels[face] + 1) * 2654435761U;
    colors[face] = CGAL::IO::Color(static_cast<unsigned char>(80 + (mixed >> 24) % 160), static_cast<unsigned char>(80 + (mixed >> 16) % 160),
                                   static_cast<unsigned char>(80 + (mixed >> 8) % 160));
  }
  std::ofstream file(path, std::ios::binary);
  CGAL::IO::set_binary_mode(file);
  if (!CGAL::IO::write_PLY(file, mesh)) throw std::runtime_error("cannot write " + path);
}

// Whether two labellings part the faces alike.
template <class Theirs>
bool are_same_parts(const Mesh &mesh, const Labels &ours, const Theirs &theirs) {
  std::map<std::size_t, std::uint32_t> ours_of;
  std::set<std::uint32_t> taken;
  for (const auto face : mesh.faces()) {
    const auto [place, is_new] = ours_of.emplace(theirs[face], ours[face]);
    if (place->second != ours[face] || (is_new && !taken.insert(ours[face]).second)) return false;
  }
  return true;
}

// The largest difference of a halfedge normal from the sum of the area normals of the faces around, from one sharp edge to the next.
template <class Normals, class Sharp>
double difference_of_normals(const Mesh &mesh, const Normals &normals, const Sharp &sharp) {
  double largest = 0.0;
  const auto is_end = [&](const auto side) { return mesh.is_border(mesh.edge(side)) || sharp[mesh.edge(side)]; };
  for (const auto side : mesh.halfedges()) {
    if (mesh.is_border(side)) continue;
    auto first = side;
    while (!is_end(first)) {
      first = mesh.prev(mesh.opposite(first));
      if (first == side) break;
    }
    Kernel::Vector_3 sum = CGAL::NULL_VECTOR;
    auto corner = first;
    do {
      const Face face = mesh.face(corner);
      sum += PMP::face_area(face, mesh) * PMP::compute_face_normal(face, mesh);
      const auto next = mesh.opposite(mesh.next(corner));
      if (is_end(next)) break;
      corner = next;
    } while (corner != first);
    largest = std::max(largest, std::sqrt((normals[side] - sum / std::sqrt(sum.squared_length())).squared_length()));
  }
  return largest;
}

bool run(const std::string &path, const std::string &directory) {
  Mesh mesh;
  if (!PMP::IO::read_polygon_mesh(path, mesh)) throw std::runtime_error("cannot be read");
  auto sharp = mesh.add_property_map<Edge, bool>("e:is_feature", false).first;
  PMP::detect_sharp_edges(mesh, 30, sharp);

  umbilic::cgal::vertex_normals(mesh);  // "v:normal"
  umbilic::cgal::curvatures(mesh);      // "v:k1", "v:k2", "v:mean", "v:gauss", "v:dir1", "v:dir2"
  const auto marked = umbilic::cgal::marked_edges(mesh, sharp);
  umbilic::creases creases;
  creases.mark(marked);
  const auto normals = umbilic::cgal::halfedge_normals(mesh, creases, UMB_WEIGHT_AREA);  // "h:normal"
  umbilic::feature_options options;
  options.creases = &creases;
  const umbilic::segmentation segments = umbilic::cgal::segment(mesh, options);  // "f:segment"

  const Labels labels = mesh.property_map<Face, std::uint32_t>("f:segment").first;
  auto components = mesh.add_property_map<Face, std::size_t>("f:component").first;
  const std::size_t count = PMP::connected_components(mesh, components, CGAL::parameters::edge_is_constrained_map(sharp));
  const bool are_same = count == segments.count() && are_same_parts(mesh, labels, components);
  const double difference = difference_of_normals(mesh, normals, sharp);
  const std::string name = path.substr(path.find_last_of('/') + 1);
  std::printf("%-24s %7zu %8zu %8zu %11.1e %9s\n", name.c_str(), static_cast<std::size_t>(mesh.number_of_faces()), marked.size(), count, difference,
              are_same ? "yes" : "no");
  mesh.remove_property_map(components);
  if (!directory.empty()) write(mesh, labels, directory + "/" + name.substr(0, name.find_last_of('.')) + "_segments.ply");
  return are_same && difference < 1e-12;
}

}  // namespace

int main(int argc, char **argv) {
  const bool written = argc > 2 && std::string(argv[1]) == "-o";
  const std::string directory = written ? argv[2] : "";
  const int first = written ? 3 : 1;
  if (argc <= first) {
    std::fprintf(stderr, "usage: %s [-o DIRECTORY] FILE...\n", argv[0]);
    return 2;
  }
  std::printf("%-24s %7s %8s %8s %11s %9s\n", "mesh", "#F", "features", "segments", "difference", "same parts");
  bool good = true;
  for (int index = first; index < argc; index++) {
    try {
      good = run(argv[index], directory) && good;
    } catch (const std::exception &exception) {
      std::fprintf(stderr, "%s: %s\n", argv[index], exception.what());
      good = false;
    }
  }
  std::printf("%s\n", good ? "CGAL has the same." : "FAILED");
  return good ? 0 : 1;
}

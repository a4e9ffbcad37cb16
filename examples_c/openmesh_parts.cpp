/*
 * All that umbilic computes in an OpenMesh mesh, and its parts: normals split at feature edges and segments between them, compared with
 * OpenMesh's.
 *
 * Build and run, in this directory, after `cargo build --release` in the one above:
 *
 *   ln -sf libumbilic.so ../target/release/libumbilic.so.0
 *   c++ -std=c++17 -O2 -Wall -Wextra -I../include openmesh_parts.cpp -o openmesh_parts \
 *     -L../target/release -lumbilic -lOpenMeshCore -Wl,-rpath,../target/release
 *   ./openmesh_parts [-o DIRECTORY] FILE...
 *
 * With -o, each mesh is written there as PLY, with normals, and segments as colours of faces.
 *
 * Feature edges are those that OpenMesh's `find_feature_edges` marks at 30 degrees. OpenMesh's `calc_halfedge_normal` adds up the unit normals
 * of the faces between them, which is UMB_WEIGHT_UNIFORM: both have to agree within 1e-12. And segments have to be the faces
 * that OpenMesh's half-edges join without crossing a feature edge.
 */

#if defined(__GNUC__) && !defined(__clang__)
// OpenMesh fills its arrays with vectors that it leaves uninitialised, which gcc reports after inlining.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include <umbilic/openmesh.hpp>

namespace {

using Mesh = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;
using Labels = OpenMesh::FPropHandleT<std::uint32_t>;

constexpr double PI = 3.14159265358979323846;
constexpr double ANGLE = PI / 6;

std::vector<std::uint32_t> feature_edges(const Mesh &mesh) {
  std::vector<std::uint32_t> pairs;
  for (const auto edge : mesh.edges()) {
    if (!mesh.status(edge).feature()) continue;
    pairs.push_back(static_cast<std::uint32_t>(edge.v0().idx()));
    pairs.push_back(static_cast<std::uint32_t>(edge.v1().idx()));
  }
  return pairs;
}

// The largest difference of a halfedge normal from OpenMesh's.
double difference_of_normals(const Mesh &mesh) {
  double largest = 0.0;
  for (const auto halfedge : mesh.halfedges()) {
    // Only features count: no angle is larger than pi.
    if (!halfedge.is_boundary()) largest = std::max(largest, (mesh.normal(halfedge) - mesh.calc_halfedge_normal(halfedge, PI)).norm());
  }
  return largest;
}

// Whether the labels part the faces as feature edges do.
bool is_parted_by_features(const Mesh &mesh, Labels labels, std::size_t count) {
  std::vector<bool> reached(mesh.n_faces());
  std::vector<bool> taken(count);
  std::vector<OpenMesh::FaceHandle> front;
  for (const auto seed : mesh.faces()) {
    if (reached[static_cast<std::size_t>(seed.idx())]) continue;
    const std::uint32_t label = mesh.property(labels, seed);
    if (label >= count || taken[label]) return false;
    taken[label] = true;
    reached[static_cast<std::size_t>(seed.idx())] = true;
    front.push_back(seed);
    while (!front.empty()) {
      const auto face = front.back();
      front.pop_back();
      if (mesh.property(labels, face) != label) return false;
      for (const auto halfedge : mesh.fh_range(face)) {
        const auto across = halfedge.opp().face();
        if (!across.is_valid() || mesh.status(halfedge.edge()).feature() || reached[static_cast<std::size_t>(across.idx())]) continue;
        reached[static_cast<std::size_t>(across.idx())] = true;
        front.push_back(across);
      }
    }
  }
  return std::find(taken.begin(), taken.end(), false) == taken.end();
}

// Neighbouring labels get hues far apart.
void write(Mesh &mesh, Labels labels, const std::string &path) {
  mesh.request_face_colors();
  for (const auto face : mesh.faces()) {
    const std::uint32_t mixed = (mesh.property(labels, face) + 1) * 2654435761U;
    const OpenMesh::Vec3uc color(static_cast<unsigned char>(80 + (mixed >> 24) % 160), static_cast<unsigned char>(80 + (mixed >> 16) % 160),
                                 static_cast<unsigned char>(80 + (mixed >> 8) % 160));
    mesh.set_color(face, OpenMesh::color_cast<Mesh::Color>(color));
  }
  if (!OpenMesh::IO::write_mesh(mesh, path, OpenMesh::IO::Options::VertexNormal | OpenMesh::IO::Options::FaceColor)) {
    throw std::runtime_error("cannot write " + path);
  }
}

bool run(const std::string &path, const std::string &directory) {
  Mesh mesh;
  if (!OpenMesh::IO::read_mesh(mesh, path)) throw std::runtime_error("cannot be read");
  mesh.request_face_normals();
  mesh.update_face_normals();
  mesh.request_edge_status();
  mesh.find_feature_edges(ANGLE);

  umbilic::openmesh::vertex_normals(mesh);                                        // the mesh's own
  umbilic::openmesh::curvatures(mesh);                                            // "v:k1", "v:k2", "v:mean", "v:gauss", "v:dir1", "v:dir2"
  umbilic::openmesh::halfedge_normals(mesh, umbilic::creases(), UMB_WEIGHT_UNIFORM);  // split at the mesh's feature edges

  const std::vector<std::uint32_t> pairs = feature_edges(mesh);
  umbilic::creases features;
  features.mark(pairs);
  umbilic::feature_options options;
  options.creases = &features;
  const umbilic::segmentation segments = umbilic::openmesh::segment(mesh, options);  // "f:segment"

  Labels labels;
  mesh.get_property_handle(labels, "f:segment");
  const double difference = difference_of_normals(mesh);
  const bool is_parted = is_parted_by_features(mesh, labels, segments.count());
  const std::string name = path.substr(path.find_last_of('/') + 1);
  std::printf("%-24s %7zu %8zu %8zu %11.1e %9s\n", name.c_str(), mesh.n_faces(), pairs.size() / 2, static_cast<std::size_t>(segments.count()),
              difference, is_parted ? "yes" : "no");
  if (!directory.empty()) write(mesh, labels, directory + "/" + name.substr(0, name.find_last_of('.')) + "_segments.ply");
  return is_parted && difference < 1e-12;
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
  std::printf("%s\n", good ? "OpenMesh has the same." : "FAILED");
  return good ? 0 : 1;
}

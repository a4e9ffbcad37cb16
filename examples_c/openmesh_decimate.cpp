/*
 * Decimates OpenMesh meshes by error quadrics, plain and weighted by umbilic's curvature, and compares what is left with what there was.
 *
 * Build and run, in this directory, after `cargo build --release` in the one above:
 *
 *   ln -sf libumbilic.so ../target/release/libumbilic.so.0
 *   c++ -std=c++17 -O2 -Wall -Wextra -I../include openmesh_decimate.cpp -o openmesh_decimate \
 *     -L../target/release -lumbilic -lOpenMeshCore -lOpenMeshTools -Wl,-rpath,../target/release
 *   ./openmesh_decimate [-o DIRECTORY] [FILE...]
 *
 * Without a file it takes a torus with bumps of its own. With -o, the meshes are written there as PLY, coloured by their curvedness.
 *
 * Lines are: ModQuadricT of OpenMesh; umbilic::openmesh::ModCurvatureT as it comes; and with only one of its two parts, the curvedness that
 * quadrics are multiplied with and the normals that are added to them. 5 % of the faces
 * are left. Errors are measured at the middle of the faces of the mesh as it was, by their area, at the nearest point of what is left:
 *
 *   distance  root mean square and largest, in thousandths of the diagonal of the bounding box
 *   faces     root mean square angle between the normals of the faces, in degrees
 *   shading   that between vertex normals, interpolated over the faces, in degrees
 *
 * On the torus, curvature and normals have to leave smaller angles than plain quadrics, or the program fails.
 */

#if defined(__GNUC__) && !defined(__clang__)
// OpenMesh fills its arrays with vectors that it leaves uninitialised, which gcc reports after inlining.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include <umbilic/openmesh_decimater.hpp>

namespace {

using Vec3d = OpenMesh::Vec3d;
using Mesh = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

constexpr double PI = 3.14159265358979323846;

// A torus with bumps: curved much in some places, and little in others.
Mesh bumpy_torus() {
  constexpr int AROUND = 192, ACROSS = 80;
  Mesh mesh;
  std::vector<OpenMesh::VertexHandle> vertices;
  for (int i = 0; i < AROUND; i++) {
    for (int j = 0; j < ACROSS; j++) {
      const double u = 2.0 * PI * i / AROUND, v = 2.0 * PI * (j + 0.5 * i) / ACROSS;
      const double bump = 0.08 * std::pow(std::sin(3.0 * u) * std::cos(2.0 * v), 8);
      const double thickness = 0.4 + bump, distance = 1.0 + thickness * std::cos(v);
      vertices.push_back(mesh.add_vertex(Vec3d(distance * std::cos(u), distance * std::sin(u), thickness * std::sin(v))));
    }
  }
  // Every row is turned by half a vertex against the last one: after all, by AROUND / 2.
  const auto at = [&](int i, int j) {
    const int turned = j + (i == AROUND ? AROUND / 2 : 0);
    return vertices[static_cast<std::size_t>(i % AROUND * ACROSS + turned % ACROSS)];
  };
  for (int i = 0; i < AROUND; i++) {
    for (int j = 0; j < ACROSS; j++) {
      mesh.add_face(at(i, j), at(i + 1, j), at(i, j + 1));
      mesh.add_face(at(i, j + 1), at(i + 1, j), at(i + 1, j + 1));
    }
  }
  return mesh;
}

// ---- the nearest point ----

struct Triangle {
  Vec3d corners[3], normal, vertex_normals[3], middle;
  double radius;
};

// The barycentric coordinates of the point of a triangle that is nearest to a point (Ericson 2005).
Vec3d nearest(const Triangle &triangle, const Vec3d &point) {
  const Vec3d &a = triangle.corners[0], &b = triangle.corners[1], &c = triangle.corners[2];
  const Vec3d ab = b - a, ac = c - a, ap = point - a, bp = point - b, cp = point - c;
  const double d1 = ab | ap, d2 = ac | ap, d3 = ab | bp, d4 = ac | bp, d5 = ab | cp, d6 = ac | cp;
  if (d1 <= 0.0 && d2 <= 0.0) return {1.0, 0.0, 0.0};
  if (d3 >= 0.0 && d4 <= d3) return {0.0, 1.0, 0.0};
  if (d6 >= 0.0 && d5 <= d6) return {0.0, 0.0, 1.0};
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return {1.0 - d1 / (d1 - d3), d1 / (d1 - d3), 0.0};
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return {1.0 - d2 / (d2 - d6), 0.0, d2 / (d2 - d6)};
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) {
    const double along = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0.0, 1.0 - along, along};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

Vec3d mix(const Vec3d (&of)[3], const Vec3d &by) { return of[0] * by[0] + of[1] * by[1] + of[2] * by[2]; }

// Triangles, with vertex normals by umbilic.
std::vector<Triangle> triangles_of(Mesh &mesh) {
  umbilic::openmesh::vertex_normals(mesh);
  std::vector<Triangle> triangles;
  for (const auto face : mesh.faces()) {
    Triangle triangle;
    int k = 0;
    for (const auto vertex : mesh.fv_range(face)) {
      triangle.corners[k] = mesh.point(vertex);
      triangle.vertex_normals[k++] = mesh.normal(vertex);
    }
    triangle.normal = (triangle.corners[1] - triangle.corners[0]) % (triangle.corners[2] - triangle.corners[0]);
    triangle.middle = (triangle.corners[0] + triangle.corners[1] + triangle.corners[2]) / 3.0;
    triangle.radius = 0.0;
    for (const Vec3d &corner : triangle.corners) triangle.radius = std::max(triangle.radius, (corner - triangle.middle).norm());
    triangles.push_back(triangle);
  }
  return triangles;
}

double angle(const Vec3d &a, const Vec3d &b) { return std::atan2((a % b).norm(), a | b) * 180.0 / PI; }

struct Errors {
  double distance = 0.0, largest_distance = 0.0, faces = 0.0, shading = 0.0;
};

Errors compare(Mesh &before, Mesh &after, double diagonal) {
  const std::vector<Triangle> fine = triangles_of(before), coarse = triangles_of(after);
  const std::size_t step = 1 + fine.size() / 20000;
  Errors errors;
  double area = 0.0;
  for (std::size_t i = 0; i < fine.size(); i += step) {
    const Triangle &from = fine[i];
    double least = std::numeric_limits<double>::max();
    const Triangle *found = nullptr;
    Vec3d where;
    for (const Triangle &to : coarse) {
      if ((to.middle - from.middle).norm() - to.radius >= least) continue;
      const Vec3d coordinates = nearest(to, from.middle);
      const double distance = (mix(to.corners, coordinates) - from.middle).norm();
      if (distance < least) least = distance, found = &to, where = coordinates;
    }
    const double weight = from.normal.norm();
    if (found == nullptr || weight == 0.0) continue;
    area += weight;
    errors.distance += weight * least * least;
    errors.largest_distance = std::max(errors.largest_distance, least);
    errors.faces += weight * std::pow(angle(from.normal, found->normal), 2);
    errors.shading += weight * std::pow(angle(mix(from.vertex_normals, {1.0, 1.0, 1.0}), mix(found->vertex_normals, where)), 2);
  }
  errors.distance = 1000.0 * std::sqrt(errors.distance / area) / diagonal;
  errors.largest_distance *= 1000.0 / diagonal;
  errors.faces = std::sqrt(errors.faces / area);
  errors.shading = std::sqrt(errors.shading / area);
  return errors;
}

// ---- decimation ----

struct Priority {
  const char *name;
  bool plain;
  double power, normal_weight;
};

void decimate(Mesh &mesh, std::size_t faces, const Priority &priority) {
  OpenMesh::Decimater::DecimaterT<Mesh> decimater(mesh);
  OpenMesh::Decimater::ModQuadricT<Mesh>::Handle quadrics;
  umbilic::openmesh::ModCurvatureT<Mesh>::Handle curvature;
  if (priority.plain) {
    decimater.add(quadrics);
  } else {
    decimater.add(curvature);
    decimater.module(curvature).set_power(priority.power);
    decimater.module(curvature).set_normal_weight(priority.normal_weight);
  }
  if (!decimater.initialize()) {
    throw std::runtime_error("the decimater has no module for priorities");
  }
  decimater.decimate_to_faces(0, faces);
  mesh.garbage_collection();
}

// Coloured by curvedness, white to red.
void write(Mesh &mesh, const std::string &path) {
  umbilic::openmesh::curvatures(mesh, {}, umbilic::quantity::curvedness);
  OpenMesh::VPropHandleT<double> curvedness;
  mesh.get_property_handle(curvedness, "v:curvedness");
  std::vector<double> values = mesh.property(curvedness).data_vector();
  const auto full = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 9 / 10);
  std::nth_element(values.begin(), full, values.end());
  mesh.request_vertex_colors();
  for (const auto vertex : mesh.vertices()) {
    const double part = *full > 0.0 ? std::min(mesh.property(curvedness, vertex) / *full, 1.0) : 0.0;
    const auto pale = static_cast<unsigned char>(255.0 * (1.0 - part));
    mesh.set_color(vertex, OpenMesh::color_cast<Mesh::Color>(OpenMesh::Vec3uc(255, pale, pale)));
  }
  if (!OpenMesh::IO::write_mesh(mesh, path, OpenMesh::IO::Options::VertexColor)) {
    throw std::runtime_error("cannot write " + path);
  }
}

// Prints the lines of one mesh; answers whether angles are smaller than with plain quadrics.
bool run(const std::string &name, Mesh &mesh, const std::string &directory) {
  mesh.request_vertex_status(), mesh.request_halfedge_status(), mesh.request_edge_status(), mesh.request_face_status();
  Vec3d low = mesh.point(OpenMesh::VertexHandle(0)), high = low;
  for (const auto vertex : mesh.vertices()) {
    low.minimize(mesh.point(vertex));
    high.maximize(mesh.point(vertex));
  }
  const double diagonal = (high - low).norm();
  const std::size_t left = mesh.n_faces() / 20;
  const Priority priorities[] = {
      {"quadrics", true, 0.0, 0.0}, {"both", false, 0.5, 0.03}, {"curvature", false, 0.5, 0.0}, {"normals", false, 0.0, 0.03}};
  Errors plain, both;
  for (const Priority &priority : priorities) {
    Mesh coarse = mesh;
    decimate(coarse, left, priority);
    const Errors errors = compare(mesh, coarse, diagonal);
    std::printf("%-20s %7zu %6zu  %-9s %8.3f %8.2f %8.2f %8.2f\n", name.c_str(), mesh.n_faces(), coarse.n_faces(), priority.name,
                errors.distance, errors.largest_distance, errors.faces, errors.shading);
    if (priority.plain) plain = errors;
    if (priority.power > 0.0 && priority.normal_weight > 0.0) both = errors;
    if (!directory.empty()) {
      write(coarse, directory + "/" + name.substr(0, name.find_last_of('.')) + "_" + priority.name + ".ply");
    }
  }
  return both.faces < plain.faces && both.shading < plain.shading;
}

}  // namespace

int main(int argc, char **argv) {
  const bool written = argc > 2 && std::string(argv[1]) == "-o";
  const std::string directory = written ? argv[2] : "";
  const int first = written ? 3 : 1;
  omerr().disable();  // OpenMesh reports every face that it has to take apart
  std::printf("%-20s %7s %6s  %-9s %8s %8s %8s %8s\n", "mesh", "#F", "left", "priority", "distance", "largest", "faces", "shading");
  bool good = true;
  try {
    if (argc <= first) {
      Mesh mesh = bumpy_torus();
      good = run("bumpy torus", mesh, directory);
      std::printf("%s\n", good ? "By curvature and normals, angles are smaller." : "FAILED");
    }
    for (int index = first; index < argc; index++) {
      const std::string path = argv[index];
      Mesh mesh;
      if (!OpenMesh::IO::read_mesh(mesh, path) || mesh.n_faces() == 0) {
        throw std::runtime_error("OpenMesh cannot read " + path);
      }
      run(path.substr(path.find_last_of('/') + 1), mesh, directory);
    }
  } catch (const std::exception &exception) {
    std::fprintf(stderr, "%s\n", exception.what());
    good = false;
  }
  return good ? 0 : 1;
}

/* umbilic in vectors of the caller's structs, as umbilic.hpp takes them: what the user writes, and what it costs. Prints what host.hpp says. */
#include <cstdint>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

#include <umbilic.hpp>

#include "host.hpp"

namespace {

struct Vertex {
  float position[3], normal[3];
  float k1, k2, direction1[3], direction2[3];
  std::uint32_t color;
};

struct Mesh {
  std::vector<Vertex> vertices;
  umbilic::polygons faces;
};

bool read(const char *path, Mesh &mesh) {
  std::ifstream file(path);
  std::string magic;
  std::size_t vertices = 0, faces = 0, edges = 0;
  if (!(file >> magic >> vertices >> faces >> edges) || magic != "OFF") return false;
  mesh.vertices.resize(vertices);
  for (Vertex &vertex : mesh.vertices) file >> vertex.position[0] >> vertex.position[1] >> vertex.position[2];
  for (std::size_t f = 0; f < faces; f++) {
    std::uint64_t corners = 0, corner = 0;
    for (file >> corners; file && corners > 0; corners--) {
      file >> corner;
      mesh.faces.add_corner(corner);
    }
    mesh.faces.end_face();
  }
  return static_cast<bool>(file);
}

void compute(Mesh &mesh) {
  // begin: user code
  umbilic::topology rings(mesh.faces, mesh.vertices.size());
  umbilic::vertex_normals(rings, {mesh.vertices, &Vertex::position}, {mesh.vertices, &Vertex::normal});
  umbilic::curvature_outputs into;
  into.k1 = {mesh.vertices, &Vertex::k1};
  into.k2 = {mesh.vertices, &Vertex::k2};
  into.direction1 = {mesh.vertices, &Vertex::direction1};
  into.direction2 = {mesh.vertices, &Vertex::direction2};
  umbilic::curvatures(rings, {mesh.vertices, &Vertex::position}, into);
  // end: user code
}

/** The same by the C interface alone. */
void check(umb_status status) {
  if (status != UMB_OK) throw std::runtime_error(umb_status_string(status));
}

void run(Mesh &mesh) {
  compute(mesh);
  umbilic::topology_options one;
  one.threads = 1;
  const umb_faces faces = umbilic::faces(mesh.faces);
  host::report(
      "C++ structs", "topology", "0",
      [&] {
        umb_topology *made = nullptr;
        check(umb_topology_create(&faces, mesh.vertices.size(), &one, &made, nullptr));
        umb_topology_destroy(made);
      },
      [&] { umbilic::topology(mesh.faces, mesh.vertices.size(), one); });

  const umbilic::topology rings(mesh.faces, mesh.vertices.size());
  const umb_points positions = {mesh.vertices[0].position, mesh.vertices.size(), sizeof(Vertex), UMB_SCALAR_F32, 0};
  const auto output = [](float *data) { return umb_output{data, sizeof(Vertex), UMB_SCALAR_F32, 0}; };
  umbilic::normal_options normals;
  normals.run.threads = 1;
  umb_normal_outputs normals_to = UMB_NORMAL_OUTPUTS_INIT;
  normals_to.normal = output(mesh.vertices[0].normal);
  host::report(
      "C++ structs", "vertex normals", "0", [&] { check(umb_vertex_normals(rings.get(), &positions, &normals, &normals_to, nullptr)); },
      [&] {
        umbilic::vertex_normals(rings, {mesh.vertices, &Vertex::position}, {mesh.vertices, &Vertex::normal}, normals);
      });

  umbilic::curvature_options curvatures;
  curvatures.run.threads = 1;
  umb_curvature_outputs curvatures_to = UMB_CURVATURE_OUTPUTS_INIT;
  curvatures_to.k1 = output(&mesh.vertices[0].k1);
  curvatures_to.k2 = output(&mesh.vertices[0].k2);
  curvatures_to.direction1 = output(mesh.vertices[0].direction1);
  curvatures_to.direction2 = output(mesh.vertices[0].direction2);
  host::report(
      "C++ structs", "curvature", "0", [&] { check(umb_curvatures(rings.get(), &positions, &curvatures, &curvatures_to, nullptr)); },
      [&] {
        umbilic::curvature_outputs into;
        into.k1 = {mesh.vertices, &Vertex::k1};
        into.k2 = {mesh.vertices, &Vertex::k2};
        into.direction1 = {mesh.vertices, &Vertex::direction1};
        into.direction2 = {mesh.vertices, &Vertex::direction2};
        umbilic::curvatures(rings, {mesh.vertices, &Vertex::position}, into, curvatures);
      });
}

}  // namespace

int main(int count, char **arguments) try {
  Mesh mesh;
  if (count != 2 || !read(arguments[1], mesh)) {
    std::fprintf(stderr, "usage: %s MESH.off\n", arguments[0]);
    return 2;
  }
  run(mesh);
} catch (const std::exception &failure) {
  std::fprintf(stderr, "%s\n", failure.what());
  return 1;
}

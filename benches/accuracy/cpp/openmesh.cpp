// Vertex normals of OpenMesh, in double precision: what its meshes have by default (fast), and its two others.

#if defined(__GNUC__) && !defined(__clang__)
// OpenMesh fills its arrays with vectors that it leaves uninitialised, which gcc reports after inlining.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include "peer.h"

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

namespace {

using Mesh = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

class OpenMeshPeer {
public:
  explicit OpenMeshPeer(const peer::Input &input) {
    for (std::size_t vertex = 0; vertex < input.vertices(); vertex++) {
      const double *at = &input.positions[3 * vertex];
      mesh.add_vertex(Mesh::Point(at[0], at[1], at[2]));
    }
    std::vector<Mesh::VertexHandle> corners;
    input.faces([&](std::size_t count, const std::int32_t *face) {
      corners.clear();
      for (std::size_t corner = 0; corner < count; corner++) {
        corners.push_back(Mesh::VertexHandle(face[corner]));
      }
      peer::must(mesh.add_face(corners).is_valid());
    });
    mesh.request_face_normals();
  }

  static std::string name() {
    return "OpenMesh " + std::to_string(OM_GET_VER) + "." + std::to_string(OM_GET_MAJ);
  }

  std::vector<peer::Method> methods() {
    return {
        {"calc_vertex_normal_fast", "normal",
         [this](double *out) {
           mesh.update_face_normals();
           all(out, &Mesh::calc_vertex_normal_fast);
         }},
        {"calc_vertex_normal_correct", "normal",
         [this](double *out) { all(out, &Mesh::calc_vertex_normal_correct); }},
        {"calc_vertex_normal_loop", "normal", [this](double *out) { all(out, &Mesh::calc_vertex_normal_loop); }},
    };
  }

private:
  void all(double *out, void (Mesh::*method)(Mesh::VertexHandle, Mesh::Normal &) const) {
    for (const Mesh::VertexHandle vertex : mesh.vertices()) {
      Mesh::Normal normal;
      (mesh.*method)(vertex, normal);
      // Only calc_vertex_normal_fast divides by the length.
      normal.normalize_cond();
      std::copy(normal.begin(), normal.end(), out + 3 * vertex.idx());
    }
  }

  Mesh mesh;
};

} // namespace

int main(int arguments, char **argument) { return peer::serve<OpenMeshPeer>(arguments, argument); }

// Every class and function of umbilic.hpp, beside the C interface. From C++17 on.
#include "umbilic.hpp"

#include <cmath>
#include <cstring>
#include <string>
#include <thread>

#if __cplusplus >= 202002L
#include <span>
#endif

#include "allocations.hpp"
#include "check.hpp"

namespace host {
// Points of a host that says what they are.
struct Opaque {
  Opaque() = default;
  float values[4] = {};
};
}  // namespace host

template <>
struct umbilic::vector_traits<host::Opaque> {
  using scalar = float;
  static constexpr std::size_t size = 3;
};

namespace {

constexpr double PI = 3.14159265358979323846;

using Double3 = std::array<double, 3>;
using Float3 = std::array<float, 3>;
using Triangle = std::array<std::uint32_t, 3>;

struct Plain {
  float x, y, z;
};
struct Typed {
  using value_type = double;
  double values[3];
};
// An interleaved buffer.
struct Vertex {
  std::uint32_t color;
  float position[3];
  Float3 normal;
  float x, y, z;
  float mean;
  std::uint8_t status;
};
// As Eigen has them.
template <bool Rows>
struct Matrix {
  static constexpr bool IsRowMajor = Rows, IsVectorAtCompileTime = false;
  static constexpr int ColsAtCompileTime = 3;
  const double *data() const { return nullptr; }
  long size() const { return 0; }
};

// What is taken, and what is not.
using umbilic::byte_output;
using umbilic::bytes;
using umbilic::faces;
using umbilic::numbers;
using umbilic::points;
using umbilic::vectors;
template <class T>
using List = std::vector<T>;
static_assert(std::is_constructible_v<points, List<Double3> &> && std::is_constructible_v<points, const List<float> &>);
static_assert(std::is_constructible_v<points, List<Plain> &> && std::is_constructible_v<points, List<Typed> &>);
static_assert(std::is_constructible_v<points, List<host::Opaque> &> && std::is_constructible_v<points, List<float[3]> &>);
static_assert(std::is_constructible_v<points, Matrix<true> &> && !std::is_constructible_v<points, Matrix<false> &>);
static_assert(!std::is_constructible_v<points, List<List<double>> &>, "the size of a std::vector is that of three doubles");
static_assert(!std::is_constructible_v<points, List<int> &> && !std::is_constructible_v<points, List<Vertex> &>);
static_assert(!std::is_constructible_v<points, List<std::array<float, 4>> &> && !std::is_constructible_v<points, int>);
static_assert(std::is_constructible_v<vectors, List<Double3> &> && !std::is_constructible_v<vectors, const List<Double3> &>);
static_assert(std::is_constructible_v<numbers, List<float> &> && !std::is_constructible_v<numbers, List<Float3> &>);
static_assert(std::is_constructible_v<byte_output, List<std::byte> &> && !std::is_constructible_v<byte_output, List<char> &>);
static_assert(std::is_constructible_v<bytes, const List<std::byte> &> && !std::is_constructible_v<byte_output, const List<std::byte> &>);
static_assert(std::is_constructible_v<faces, List<Triangle> &> && std::is_constructible_v<faces, List<int> &>);
static_assert(std::is_constructible_v<faces, List<std::uint64_t> &> && !std::is_constructible_v<faces, List<std::uint16_t> &>);
static_assert(!std::is_constructible_v<faces, List<float> &> && !std::is_constructible_v<faces, List<Double3> &>);
static_assert(!std::is_constructible_v<faces, List<int> &, List<std::uint32_t> &>, "offsets are of the indices' type");
static_assert(!std::is_copy_constructible_v<umbilic::topology> && std::is_nothrow_move_constructible_v<umbilic::topology>);
static_assert(!std::is_copy_constructible_v<umbilic::cut_mesh> && std::is_nothrow_move_constructible_v<umbilic::cut_mesh>);
static_assert(!std::is_copy_constructible_v<umbilic::segmentation> && std::is_nothrow_move_assignable_v<umbilic::segmentation>);
static_assert(std::is_trivially_copyable_v<umbilic::status>);

double length(const Double3 &a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

// A closed sphere of triangles of radius 2, or a quarter of it less with `open`.
struct Sphere {
  List<Double3> positions;
  List<Triangle> triangles;

  explicit Sphere(std::uint32_t around = 24, std::uint32_t across = 12) {
    for (std::uint32_t i = 0; i + 1 < across; i++) {
      for (std::uint32_t j = 0; j < around; j++) {
        const double down = PI * (i + 1) / across, turn = 2 * PI * (j + 0.5 * i) / around;
        positions.push_back({2 * std::sin(down) * std::cos(turn), 2 * std::sin(down) * std::sin(turn), 2 * std::cos(down)});
      }
    }
    positions.push_back({0, 0, 2});
    positions.push_back({0, 0, -2});
    const std::uint32_t south = (across - 1) * around + 1, north = south - 1;
    for (std::uint32_t i = 0; i + 1 < across; i++) {
      for (std::uint32_t j = 0; j < around; j++) {
        const std::uint32_t here = i * around + j, next = i * around + (j + 1) % around;
        if (i == 0) {
          triangles.push_back({north, here, next});
        } else {
          triangles.push_back({here - around, here, next - around});
          triangles.push_back({next - around, here, next});
        }
        if (i + 2 == across) triangles.push_back({next, here, south});
      }
    }
  }
};

// A cube of quads.
const List<Double3> CUBE = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
const List<std::array<int, 4>> QUADS = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

template <class Call>
umb_status thrown(Call call, const char *words, std::uint64_t element = UMB_NO_ELEMENT) {
  try {
    call();
  } catch (const umbilic::error &error) {
    if (std::string(error.what()).find(words) == std::string::npos) std::fprintf(stderr, "what(): %s\n", error.what());
    CHECK(std::string(error.what()).find(words) != std::string::npos);
    CHECK(element == UMB_NO_ELEMENT || error.element() == element);
    return error.status();
  }
  return UMB_OK;
}

List<Double3> normals_by_c(const Sphere &sphere, umb_weight weight) {
  umb_faces loops = umb_faces();
  loops.indices = sphere.triangles.data();
  loops.index_count = 3 * sphere.triangles.size();
  umb_points positions = umb_points();
  positions.data = sphere.positions.data();
  positions.count = sphere.positions.size();
  positions.scalar = UMB_SCALAR_F64;
  List<Double3> normals(positions.count);
  umb_normal_options options = UMB_NORMAL_OPTIONS_INIT;
  options.weight = weight;
  umb_normal_outputs outputs = UMB_NORMAL_OUTPUTS_INIT;
  outputs.normal.data = normals.data();
  outputs.normal.scalar = UMB_SCALAR_F64;
  CHECK(umb_vertex_normals_from_faces(&loops, &positions, &options, &outputs, nullptr) == UMB_OK);
  return normals;
}

// Positions and normals in every shape, with the bits of the C interface.
void views() {
  const Sphere sphere;
  const std::size_t count = sphere.positions.size();
  const List<Double3> expected = normals_by_c(sphere, UMB_WEIGHT_ANGLE);
  const umbilic::topology mesh(sphere.triangles, count);
  const umbilic::normal_options options(UMB_WEIGHT_ANGLE);
  CHECK(umbilic::vertex_normals(mesh, sphere.positions, options) == expected);
  CHECK(umbilic::vertex_normals(sphere.triangles, sphere.positions, options) == expected);

  List<Double3> normals(count);
  umbilic::vertex_normals(mesh, sphere.positions, normals, options);
  CHECK(normals == expected);
  List<double> flat(3 * count), flat_normals(3 * count);
  std::memcpy(flat.data(), sphere.positions.data(), count * sizeof(Double3));
  umbilic::vertex_normals(mesh, flat, flat_normals, options);
  CHECK(std::memcmp(flat_normals.data(), expected.data(), count * sizeof(Double3)) == 0);
  flat_normals.assign(3 * count, 0);
  umbilic::vertex_normals(mesh, {flat.data(), count}, {flat_normals.data(), count}, options);
  CHECK(std::memcmp(flat_normals.data(), expected.data(), count * sizeof(Double3)) == 0);
  normals.assign(count, {});
  umbilic::vertex_normals(mesh, points(sphere.positions.data(), count), vectors(normals.data(), count), options);
  CHECK(normals == expected);
  normals.assign(count, {});
  umbilic::vertex_normals(sphere.triangles, sphere.positions, normals, options);
  CHECK(normals == expected);
  List<Typed> typed(count);
  umbilic::vertex_normals(mesh, sphere.positions, typed, options);
  CHECK(std::memcmp(typed.data(), expected.data(), count * sizeof(Typed)) == 0);

  // In single precision, in an interleaved buffer: by members, by the first of three scalars, by the byte offset.
  List<Vertex> buffer(count);
  List<Float3> rounded(count);
  List<Plain> plain(count);
  List<host::Opaque> opaque(count);
  for (std::size_t v = 0; v < count; v++) {
    for (std::size_t k = 0; k < 3; k++) {
      buffer[v].position[k] = opaque[v].values[k] = rounded[v][k] = static_cast<float>(sphere.positions[v][k]);
    }
    plain[v] = {rounded[v][0], rounded[v][1], rounded[v][2]};
    buffer[v].color = 7;
  }
  const List<Float3> single = umbilic::vertex_normals<float>(mesh, rounded, options);
  umbilic::normal_outputs into;
  into.normal = {buffer, &Vertex::normal};
  into.sum = {buffer, &Vertex::x};
  into.status = {buffer, &Vertex::status};
  umbilic::vertex_normals(mesh, {buffer, &Vertex::position}, into, options);
  for (std::size_t v = 0; v < count; v++) {
    const Vertex &vertex = buffer[v];
    CHECK(vertex.normal == single[v] && vertex.color == 7 && vertex.status == 0);
    CHECK(vertex.x * vertex.normal[0] + vertex.y * vertex.normal[1] + vertex.z * vertex.normal[2] > 6.0f);
  }
  List<Float3> again(count);
  umbilic::vertex_normals(mesh, points::at_offset<float>(buffer, offsetof(Vertex, position)), again, options);
  CHECK(again == single);
  umbilic::vertex_normals(mesh, plain, again, options);
  CHECK(again == single);
  umbilic::vertex_normals(mesh, opaque, again, options);
  CHECK(again == single);
  umbilic::vertex_normals(mesh, {&buffer[0].position[0], count, sizeof(Vertex)},
                          vectors::at_offset<float>(buffer, offsetof(Vertex, normal)), options);
  CHECK(buffer[5].normal == single[5]);
  umbilic::vertex_normals(mesh, rounded, {&buffer[0].x, count, sizeof(Vertex)}, options);
  CHECK(buffer[9].z == single[9][2]);

  umbilic::curvature_outputs curvature;
  curvature.mean = {buffer, &Vertex::mean};
  umbilic::curvatures(mesh, rounded, curvature);
  CHECK(std::abs(buffer[30].mean - 0.5f) < 1e-3f);

  // Nothing at all.
  const umbilic::topology empty(List<Triangle>{}, 0);
  List<Float3> none;
  umbilic::vertex_normals(empty, none, none);
  CHECK(umbilic::vertex_normals(empty, none).empty());

#if __cplusplus >= 202002L
  const std::span<const Double3> seen(sphere.positions);
  CHECK(umbilic::vertex_normals(mesh, seen, options) == expected);
  normals.assign(count, {});
  umbilic::vertex_normals(mesh, seen, {.normal = std::span(normals)}, options);
  CHECK(normals == expected);
  const std::span<const std::uint8_t> flags = mesh.flags();
  CHECK(flags.size() == count);
#endif
}

// Faces in every shape.
void loops() {
  const auto expected = umbilic::face_normals(QUADS, CUBE);
  CHECK(expected.size() == 6 && expected[0][2] == -1.0 && expected[1][2] == 1.0);
  List<std::int32_t> signed_indices;
  List<std::uint64_t> wide, offsets{0};
  List<List<int>> ragged;
  for (const auto &quad : QUADS) {
    ragged.emplace_back(quad.begin(), quad.end());
    for (const int vertex : quad) {
      signed_indices.push_back(vertex);
      wide.push_back(static_cast<std::uint64_t>(vertex));
    }
    offsets.push_back(wide.size());
  }
  CHECK(umbilic::face_normals({signed_indices, 4}, CUBE) == expected);
  CHECK(umbilic::face_normals({wide, 4}, CUBE) == expected);
  CHECK(umbilic::face_normals({wide, offsets}, CUBE) == expected);
  CHECK(umbilic::face_normals({wide.data(), wide.size(), 4}, CUBE) == expected);
  CHECK(umbilic::face_normals({wide.data(), wide.size(), offsets.data(), 6}, CUBE) == expected);
  const umbilic::polygons copied(ragged);
  CHECK(copied.size() == 6 && copied.corner_count() == 24 && umbilic::face_normals(copied, CUBE) == expected);

  // Triangles first, then another: offsets come late, and count what was before.
  const List<List<int>> mixed = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6, 7}, {0, 1, 5}};
  const auto several = umbilic::face_normals(umbilic::polygons(mixed), CUBE);
  CHECK(several.size() == 4 && several[1][2] == -1.0 && several[2][2] == 1.0 && several[3][1] == -1.0);
  CHECK(umbilic::polygons().size() == 0 && umbilic::face_normals(umbilic::polygons(), CUBE).empty());

  umbilic::status result;
  List<std::int64_t> negative(wide.begin(), wide.end());
  negative[3] = -1;
  umbilic::topology refused({negative, 4}, 8, {}, result);
  CHECK(result.value() == UMB_ERROR_INDEX_OUT_OF_RANGE && result.element() == 3 && !refused);
  umbilic::polygons far;
  for (const std::uint64_t vertex : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1} << 32}) far.add_corner(vertex);
  far.end_face();
  CHECK(thrown([&] { umbilic::topology(far, 8); }, "indices[2]", 2) == UMB_ERROR_INDEX_OUT_OF_RANGE);
  CHECK(thrown([&] { umbilic::topology({wide, List<std::uint64_t>{}}, 8); }, "") == UMB_ERROR_SIZE);
}

void errors() {
  const Sphere sphere;
  List<Triangle> wrong = sphere.triangles;
  wrong[2][1] = 1000000;
  CHECK(thrown([&] { umbilic::topology(wrong, sphere.positions.size()); }, "faces.indices[7]", 7) == UMB_ERROR_INDEX_OUT_OF_RANGE);

  umbilic::status result;
  CHECK(!result && result.value() == UMB_OK && std::strlen(result.message()) == 0);
  const umbilic::topology refused(wrong, sphere.positions.size(), {}, result);
  CHECK(!refused && result && result.element() == 7 && std::strstr(result.message(), "1000000"));
  CHECK(result.code() == std::errc::invalid_argument && std::strcmp(result.code().category().name(), "umbilic") == 0);
  CHECK(!result.code().message().empty());
  const umbilic::topology mesh(sphere.triangles, sphere.positions.size(), {}, result);
  CHECK(!result && mesh && result.element() == UMB_NO_ELEMENT && std::strlen(result.message()) == 0);

  // Without a handle.
  CHECK(thrown([&] { umbilic::vertex_normals(refused, sphere.positions); }, "null") == UMB_ERROR_NULL_POINTER);
  CHECK(refused.vertex_count() == 0 && refused.ring_offsets().empty() && refused.ring_neighbours().empty());

  // Lengths, which the C interface takes on trust.
  List<Double3> normals(sphere.positions.size() - 1);
  umbilic::vertex_normals(mesh, sphere.positions, normals, {}, result);
  CHECK(result.value() == UMB_ERROR_SIZE && result.element() == normals.size() && std::strstr(result.message(), "normal"));
  CHECK(thrown([&] { umbilic::vertex_normals(sphere.triangles, sphere.positions, normals); }, "normal") == UMB_ERROR_SIZE);
  List<double> k1(3), none;
  umbilic::curvature_outputs wanted;
  wanted.k1 = none;
  CHECK(thrown([&] { umbilic::curvatures(mesh, sphere.positions, wanted); }, "`k1` has 0") == UMB_ERROR_SIZE);
  List<double> uneven(3 * sphere.positions.size() + 1);
  CHECK(thrown([&] { umbilic::vertex_normals(mesh, uneven); }, "") == UMB_ERROR_SIZE);
  CHECK(thrown([&] { umbilic::vertex_normals(sphere.triangles, uneven); }, "") == UMB_ERROR_SIZE);
  uneven.resize(uneven.size() + 1);
  normals.resize(sphere.positions.size());
  CHECK(thrown([&] { umbilic::vertex_normals(mesh, sphere.positions, uneven); }, "") == UMB_ERROR_SIZE);
  CHECK(thrown([&] { umbilic::vertex_normals(mesh, k1); }, "") == UMB_ERROR_SIZE);

  List<Double3> infinite = sphere.positions;
  infinite[11][1] = INFINITY;
  CHECK(thrown([&] { umbilic::vertex_normals(mesh, infinite); }, "", 11) == UMB_ERROR_NON_FINITE);
  try {
    umbilic::vertex_normals(mesh, infinite);
    CHECK(false);
  } catch (const std::runtime_error &error) {
    CHECK(dynamic_cast<const umbilic::error &>(error).code() == std::errc::invalid_argument);
  }
  CHECK(thrown([&] { umbilic::curvatures(mesh, sphere.positions, umbilic::curvature_options(UMB_CURVATURE_WATANABE)); }, "") ==
        UMB_ERROR_NOT_APPLICABLE);
  result.fail(UMB_ERROR_INTERNAL, std::string(1000, 'x').c_str());
  CHECK(std::strlen(result.message()) == 239 && thrown([&] { result.raise(); }, "xxx") == UMB_ERROR_INTERNAL);
  CHECK(std::error_code(UMB_ERROR_OUT_OF_MEMORY, umbilic::category()) == std::errc::not_enough_memory);
  CHECK(std::error_code(UMB_ERROR_CANCELLED, umbilic::category()) == std::errc::operation_canceled);
}

struct Stop : std::exception {};

void progress() {
  const Sphere sphere(200, 100);
  const umbilic::topology mesh(sphere.triangles, sphere.positions.size());
  umbilic::curvature_options options;
  int calls = 0;
  double last = -1;
  auto watch = [&](double fraction) {
    CHECK(fraction >= last && fraction <= 1.0);
    last = fraction;
    calls++;
  };
  options.progress = watch;
  const auto expected = umbilic::curvatures(mesh, sphere.positions, options);
  CHECK(calls > 1 && last == 1.0);

  auto stop = [&](double) { return --calls > 0; };
  options.progress = stop;
  calls = 2;
  CHECK(thrown([&] { umbilic::curvatures(mesh, sphere.positions, options); }, "") == UMB_ERROR_CANCELLED && calls == 0);

  // Past the C frames, from both forms.
  auto fail = [&](double fraction) -> bool {
    calls++;
    if (fraction > 0.0) throw Stop();
    return true;
  };
  options.progress = fail;
  calls = 0;
  bool caught = false;
  try {
    umbilic::curvatures(mesh, sphere.positions, options);
  } catch (const Stop &) {
    caught = true;
  }
  CHECK(caught);
  List<double> mean(sphere.positions.size());
  umbilic::curvature_outputs into;
  into.mean = mean;
  umbilic::status result;
  caught = false;
  try {
    umbilic::curvatures(mesh, sphere.positions, into, options, result);
  } catch (const Stop &) {
    caught = true;
  }
  CHECK(caught && result.value() == UMB_ERROR_CANCELLED && result.code() == std::errc::operation_canceled);
  // A segmentation that is thrown out of leaves nothing behind.
  umbilic::watershed_options basins;
  basins.progress = fail;
  caught = false;
  try {
    umbilic::segment(sphere.triangles, sphere.positions, basins);
  } catch (const Stop &) {
    caught = true;
  }
  CHECK(caught);

  // The callback of C is still there.
  options = umbilic::curvature_options();
  options.run.progress = [](void *user, double) { return ++*static_cast<int *>(user) > 1 ? 1 : 0; };
  options.run.user = &calls;
  calls = 0;
  CHECK(thrown([&] { umbilic::curvatures(mesh, sphere.positions, options); }, "") == UMB_ERROR_CANCELLED && calls == 2);
  static_assert(!std::is_constructible_v<umbilic::progress_reference, decltype(stop)>, "a temporary would be gone by the call");
  // Const callables, and the same bits as without.
  const auto go_on = [](double) { return true; };
  options = umbilic::curvature_options();
  options.progress = go_on;
  CHECK(umbilic::curvatures(mesh, sphere.positions, options).k1 == expected.k1);
}

void topologies() {
  const Sphere sphere;
  umbilic::topology mesh(sphere.triangles, sphere.positions.size());
  const umb_topology *handle = mesh.get();
  CHECK(mesh.vertex_count() == sphere.positions.size() && mesh.face_count() == sphere.triangles.size());
  CHECK(mesh.stats().euler_characteristic == 2 && mesh.valence(0) == mesh.ring(0).size() && mesh.fan_count(0) == 1);
  CHECK(mesh.fan(0, 0).closed == 1 && mesh.fan(0, 0).neighbours == mesh.ring(0).data());
  CHECK(mesh.ring_neighbours().size() == 3 * sphere.triangles.size() && mesh.flags()[3] == 0);
  CHECK(thrown([&] { mesh.valence(100000); }, "") == UMB_ERROR_INDEX_OUT_OF_RANGE);
  CHECK(thrown([&] { mesh.fan_count(100000); }, "") == UMB_ERROR_INDEX_OUT_OF_RANGE);
  CHECK(thrown([&] { mesh.fan(0, 1); }, "") == UMB_ERROR_INDEX_OUT_OF_RANGE);

  umbilic::topology moved(std::move(mesh));
  CHECK(!mesh && mesh.get() == nullptr && moved.get() == handle);
  mesh = std::move(moved);
  CHECK(!moved && mesh.get() == handle);
  umbilic::topology &same = mesh;
  mesh = std::move(same);
  CHECK(mesh.get() == handle);
  const umbilic::topology_view view = mesh;
  CHECK(view.get() == handle && view.stats().face_count == sphere.triangles.size());
  umb_topology *raw = mesh.release();
  CHECK(!mesh && raw == handle);
  mesh = umbilic::topology(raw);
  CHECK(mesh.get() == handle);
  CHECK(thrown([&] { moved.stats(); }, "") == UMB_ERROR_NULL_POINTER);
}

void lists() {
  const Sphere sphere;
  const umbilic::topology mesh(sphere.triangles, sphere.positions.size());
  const auto all = umbilic::vertex_normals(mesh, sphere.positions);
  umbilic::normal_options options;
  const List<std::uint32_t> some = {3, 1, 4, 1, 5};
  options.only(some);
  const auto few = umbilic::vertex_normals(mesh, sphere.positions, options);
  CHECK(few[3] == all[3] && few[5] == all[5] && few[0] == Double3{});
  const List<std::uint32_t> nothing;
  options.only(nothing);
  CHECK(umbilic::vertex_normals(mesh, sphere.positions, options) == List<Double3>(all.size()));

  // A frame later.
  List<Double3> next = sphere.positions;
  next[17] = {3, 0, 0};
  const List<std::uint32_t> which = {17};
  const auto affected = umbilic::affected_normals(mesh, umbilic::moved(which));
  CHECK(affected.size() == 1 + mesh.valence(17) && affected[0] == 17);
  options = umbilic::normal_options();
  options.only(affected);
  auto updated = all;
  umbilic::vertex_normals(mesh, next, updated, options);
  CHECK(updated == umbilic::vertex_normals(mesh, next) && updated != all);

  umbilic::curvature_options jets(UMB_CURVATURE_JET);
  List<std::uint8_t> statuses(mesh.vertex_count());
  const auto near = umbilic::affected_curvatures(mesh, umbilic::moved(which, statuses), jets);
  CHECK(near.size() > affected.size() && near.size() < umbilic::affected_curvatures(mesh, umbilic::moved(which), jets).size());
  umbilic::status result;
  List<std::uint32_t> room(3);
  umbilic::affected_normals(mesh, umbilic::moved(which), {}, {room.data(), room.size()}, result);
  CHECK(result.value() == UMB_ERROR_SIZE);
  CHECK(umbilic::affected_normals(mesh, umbilic::moved(which), {}, {}, result) == affected.size() && !result);
  CHECK(umbilic::affected_curvatures(mesh, umbilic::moved(which, statuses), jets, {}, result) == near.size() && !result);

  // What adaptive jets learn.
  umbilic::adaptive_model model = umbilic::learn_model(mesh, sphere.positions);
  CHECK(model.sample > 0 && model.edge_length > 0);
  umbilic::curvature_options known;
  known.model = &model;
  CHECK(umbilic::curvatures(mesh, sphere.positions, known).k1 == umbilic::curvatures(mesh, sphere.positions).k1);
}

void curvatures() {
  const Sphere sphere(60, 30);
  const std::size_t count = sphere.positions.size();
  const umbilic::topology mesh(sphere.triangles, count);
  const auto principal = umbilic::curvatures(mesh, sphere.positions);
  for (std::size_t v = 0; v < count; v++) {
    CHECK(std::abs(principal.k1[v] - 0.5) < 1e-3 && std::abs(principal.k2[v] - 0.5) < 1e-3);
    CHECK(std::abs(length(principal.direction1[v]) - 1) < 1e-12);
  }
  // Every output, with a method that has it.
  umbilic::curvature_outputs into;
  List<double> values[12];
  for (auto &value : values) value.assign(count, -7);
  List<Double3> directions[4];
  for (auto &direction : directions) direction.assign(count, {-7, 0, 0});
  List<std::uint8_t> status(count, 99);
  into.k1 = values[0], into.k2 = values[1], into.mean = values[2], into.gaussian = values[3];
  into.direction1 = directions[0], into.direction2 = directions[1], into.mean_normal = directions[2], into.normal = directions[3];
  into.shape_index = values[4], into.curvedness = values[5], into.area = values[6];
  into.integrated_mean = values[7], into.integrated_gaussian = values[8];
  into.status = status;
  umbilic::curvatures(mesh, sphere.positions, into, UMB_CURVATURE_CORRECTED_MEASURE);
  into = umbilic::curvature_outputs();
  into.residual = values[9], into.condition = values[10];
  umbilic::curvatures(mesh, sphere.positions, into, UMB_CURVATURE_JET);
  into = umbilic::curvature_outputs();
  into.degrees_of_freedom = values[11];
  umbilic::curvatures(mesh, sphere.positions, into);
  for (const auto &value : values) CHECK(value[40] != -7);
  for (const auto &direction : directions) CHECK(direction[40][0] != -7);
  CHECK(status[40] == 0);

  // The host's own normals.
  umbilic::curvature_options given(UMB_CURVATURE_LEAST_SQUARES);
  given.section = UMB_SECTION_CIRCLE;
  given.normals = points(sphere.positions);
  const auto exact = umbilic::curvatures(mesh, sphere.positions, given);
  CHECK(std::abs(exact.k1[40] - 0.5) < 1e-12 && std::abs(exact.k2[40] - 0.5) < 1e-12);

  List<std::uint8_t> classes(count);
  umbilic::shape_classes(sphere.positions, principal.k1, principal.k2, classes);
  CHECK(classes[40] == UMB_SHAPE_PEAK);
  CHECK(std::abs(umbilic::shape_tolerance(sphere.positions) * std::sqrt(48.0) - 1) < 0.01);
  umbilic::shape_options options;
  options.status = bytes(status);
  options.tolerance = 2;
  List<std::byte> raw(count);
  umbilic::shape_classes(principal.k1, principal.k2, raw, options);
  CHECK(raw[40] == std::byte{UMB_SHAPE_FLAT});

  // Sections.
  umbilic::section_outputs sections;
  List<double> along(mesh.ring_neighbours().size()), across(2 * count);
  List<std::uint8_t> section_status(along.size());
  sections.curvature = along;
  sections.status = section_status;
  umbilic::section_options circles(UMB_SECTION_CIRCLE);
  circles.normals = points(sphere.positions);
  umbilic::edge_sections(mesh, sphere.positions, sections, circles);
  CHECK(std::abs(along[100] - 0.5) < 1e-12);
  const List<Double3> directed = {{1, 0, 0}, {0, 1, 1}};
  circles.directions = points(directed);
  circles.shared = 1;
  sections = umbilic::section_outputs();
  sections.curvature = across;
  umbilic::direction_sections(mesh, sphere.positions, sections, circles);
  CHECK(std::abs(across[2 * 700] - 0.5) < 0.05);
  across.pop_back();
  sections.curvature = across;
  CHECK(thrown([&] { umbilic::direction_sections(mesh, sphere.positions, sections, circles); }, "curvature") == UMB_ERROR_SIZE);
  along.pop_back();
  sections.curvature = along;
  CHECK(thrown([&] { umbilic::edge_sections(mesh, sphere.positions, sections); }, "curvature") == UMB_ERROR_SIZE);

  // A circle of radius 2, in the plane.
  List<std::array<double, 2>> circle;
  for (int i = 0; i < 16; i++) circle.push_back({2 * std::cos(PI * i / 8), 2 * std::sin(PI * i / 8)});
  List<double> bent(16), flat;
  umbilic::polyline_outputs curve;
  curve.circle = bent;
  umbilic::polyline_curvatures(umbilic::polyline(circle, true), curve);
  CHECK(std::abs(bent[3] - 0.5) < 1e-12);
  umbilic::polyline_curvatures(umbilic::polyline(circle[0].data(), 16, 2), curve);
  CHECK(bent[0] == 0 && std::abs(bent[3] - 0.5) < 1e-12);
  curve.parabola = flat;
  CHECK(thrown([&] { umbilic::polyline_curvatures(umbilic::polyline(circle), curve); }, "parabola") == UMB_ERROR_SIZE);
}

void parts() {
  // Corner normals of a cube are those of its faces; the cut mesh has three vertices at each corner.
  const auto corners = umbilic::corner_normals(QUADS, CUBE);
  const auto flat = umbilic::face_normals(QUADS, CUBE);
  for (std::size_t c = 0; c < corners.size(); c++) CHECK(corners[c] == flat[c / 4]);
  umbilic::cut_mesh cut(QUADS, CUBE);
  CHECK(cut.vertex_count() == 24 && cut.corner_count() == 24 && cut.origins()[3] == 1 && cut.corners().size() == 24);
  CHECK(cut.topology().face_count() == 6);
  List<Double3> positions(24), normals(24), each(24);
  umbilic::cut_points(cut, CUBE, positions);
  CHECK(positions[0] == CUBE[0] && positions[23] == CUBE[7]);
  umbilic::corner_outputs into;
  into.corner = each;
  into.normal = normals;
  umbilic::corner_normals(cut, CUBE, into);
  CHECK(each == corners && normals[cut.corners()[5]] == corners[5]);
  CHECK(umbilic::vertex_normals(cut.topology(), positions) == normals);
  each.pop_back();
  into.corner = each;
  CHECK(thrown([&] { umbilic::corner_normals(cut, CUBE, into); }, "corner") == UMB_ERROR_SIZE);
  CHECK(thrown([&] { umbilic::cut_points(cut, CUBE, each); }, "into") == UMB_ERROR_SIZE);
  CHECK(cut.starts().size() == 9 && cut.starts()[1] == 3 && cut.starts()[8] == 24 && umbilic::cut_mesh().starts().empty());
  const umbilic::cut_mesh moved(std::move(cut));
  CHECK(!cut && cut.vertex_count() == 0 && moved.vertex_count() == 24);

  // Creases by angle, by mark, by group.
  umbilic::creases none(3.2);
  CHECK(umbilic::cut_mesh(QUADS, CUBE, none).vertex_count() == 8);
  const List<std::array<std::uint32_t, 2>> pairs = {{4, 5}, {5, 6}, {6, 7}, {7, 4}};
  none.mark(pairs);
  CHECK(umbilic::cut_mesh(QUADS, CUBE, none).vertex_count() == 12);
  List<std::uint32_t> flat_pairs = {4, 5, 5, 6, 6, 7, 7, 4};
  none.mark(flat_pairs);
  CHECK(umbilic::cut_mesh(QUADS, CUBE, none).vertex_count() == 12);
  flat_pairs.pop_back();
  none.mark(flat_pairs);
  CHECK(thrown([&] { umbilic::cut_mesh(QUADS, CUBE, none); }, "") == UMB_ERROR_SIZE);
  umbilic::polygons loops(List<List<int>>{{0, 1, 2, 3}, {0, 2, 1}});
  umbilic::polygons taken(std::move(loops));
  CHECK(taken.size() == 2 && taken.corner_count() == 7 && loops.size() == 0 && umbilic::faces(loops).size() == 0);
  loops.push_back(List<int>{0, 1, 2});
  CHECK(loops.size() == 1 && umbilic::faces(loops).size() == 1);
  loops = std::move(taken);
  CHECK(loops.size() == 2 && taken.size() == 0 && taken.corner_count() == 0);

  umbilic::creases grouped(3.2);
  const List<std::uint32_t> groups = {1, 2, 1, 1, 1, 1};
  grouped.group(groups);
  CHECK(umbilic::cut_mesh(QUADS, CUBE, grouped).vertex_count() == 12);

  umbilic::feature_options features;
  umbilic::segmentation segments = umbilic::segment(QUADS, CUBE, features);
  CHECK(segments.count() == 6 && segments.face_count() == 6 && segments.labels()[4] == 4 && segments.boundary_edges().size() == 24);
  CHECK(segments.areas(QUADS, CUBE) == List<double>(6, 4.0));
  const List<double> heights = {-1, -1, -1, -1, 1, 1, 1, 1}, at_faces = {1, 2, 3, 4, 5, 6};
  CHECK(segments.means(QUADS, CUBE, heights)[1] == 1.0 && segments.means(QUADS, CUBE, heights)[2] == 0.0);
  CHECK(segments.means(QUADS, CUBE, {at_faces, UMB_AT_FACES}) == at_faces);
  features.creases = &none;
  umbilic::status result;
  CHECK(!umbilic::segment(QUADS, CUBE, features, result) && result.value() == UMB_ERROR_SIZE);
  features.creases = &grouped;
  CHECK(umbilic::segment(QUADS, CUBE, features).count() == 2);

  const Sphere sphere;
  CHECK(umbilic::segment(sphere.triangles, sphere.positions, umbilic::region_options()).count() == 1);
  umbilic::watershed_options basins;
  List<double> height;
  for (const Double3 &position : sphere.positions) height.push_back(-std::abs(position[2]));
  const umbilic::scalars over(height);
  basins.height = &over;
  basins.depth = 1;
  CHECK(umbilic::segment(sphere.triangles, sphere.positions, basins).count() == 2);
}

// The wrapper asks for no memory where the C functions do not: not for calls, and not for failures that are values.
void memory() {
  const Sphere sphere;
  List<Double3> normals(sphere.positions.size());
  List<double> k1(sphere.positions.size());
  umbilic::normal_outputs into;
  into.normal = normals;
  umbilic::curvature_outputs curvature;
  curvature.k1 = k1;
  auto go_on = [](double) { return true; };
  umbilic::curvature_options options;
  options.progress = go_on;
  umbilic::status result;
  const std::size_t before = allocations;
  umbilic::topology mesh(sphere.triangles, sphere.positions.size(), {}, result);
  umbilic::vertex_normals(mesh, sphere.positions, into, {}, result);
  umbilic::vertex_normals(mesh, sphere.positions, normals);
  umbilic::curvatures(mesh, sphere.positions, curvature, options, result);
  umbilic::segmentation segments = umbilic::segment(sphere.triangles, sphere.positions, umbilic::feature_options(), result);
  CHECK(!result);
  umbilic::vertex_normals(mesh, k1, into, {}, result);
  CHECK(result);
  CHECK(allocations == before);
}

void threads() {
  const Sphere sphere;
  const umbilic::topology mesh(sphere.triangles, sphere.positions.size());
  const auto expected = umbilic::vertex_normals(mesh, sphere.positions);
  List<std::thread> workers;
  for (int worker = 0; worker < 4; worker++) {
    workers.emplace_back([&] {
      for (int round = 0; round < 20; round++) {
        CHECK(umbilic::vertex_normals(mesh, sphere.positions) == expected);
        CHECK(thrown([&] { mesh.valence(1000000); }, "") == UMB_ERROR_INDEX_OUT_OF_RANGE);
      }
    });
  }
  for (std::thread &worker : workers) worker.join();
}

// What does not compile, since it would be misread or outlived.
template <class Options, class Container, class = void>
constexpr bool TAKES_ONLY = false;
template <class Options, class Container>
constexpr bool TAKES_ONLY<Options, Container, std::void_t<decltype(std::declval<Options &>().only(std::declval<Container>()))>> = true;
template <class Container, class = void>
constexpr bool TAKES_MARKS = false;
template <class Container>
constexpr bool TAKES_MARKS<Container, std::void_t<decltype(std::declval<umbilic::creases &>().mark(std::declval<Container>()),
                                                           std::declval<umbilic::creases &>().group(std::declval<Container>()))>> = true;
using Indices = std::vector<std::uint32_t>;
static_assert(TAKES_ONLY<umbilic::normal_options, Indices &> && TAKES_ONLY<umbilic::normal_options, const Indices &>);
static_assert(!TAKES_ONLY<umbilic::normal_options, Indices> && !TAKES_ONLY<umbilic::normal_options, const Indices>);
static_assert(TAKES_ONLY<umbilic::normal_options, umbilic::span<const std::uint32_t>>);
static_assert(TAKES_MARKS<Indices &> && !TAKES_MARKS<Indices>);
static_assert(std::is_constructible_v<umbilic::numbers, std::vector<double> &> && !std::is_constructible_v<umbilic::numbers, std::vector<double>>);
static_assert(std::is_constructible_v<umbilic::numbers, umbilic::span<double>> &&
              !std::is_constructible_v<umbilic::byte_output, std::vector<std::uint8_t>>);
static_assert(std::is_convertible_v<double, umbilic::creases> && std::is_convertible_v<float, umbilic::creases> &&
              !std::is_constructible_v<umbilic::creases, int> && !std::is_constructible_v<umbilic::creases, umb_weight>);
static_assert(!std::is_convertible_v<umb_curvature_method, umbilic::quantities> && !std::is_convertible_v<umbilic::quantities, std::uint32_t>);
using Answers = bool(double);
static_assert(std::is_constructible_v<umbilic::progress_reference, Answers &>);
static_assert(!std::is_constructible_v<umbilic::progress_reference, int (&)(double)>);
static_assert(std::is_same_v<umbilic::points, umbilic::with_exceptions::points>, "other names than without exceptions");

int asked = 0;
bool ask(double) { return ++asked < 0; }

void references() {
  umbilic::progress_reference first = ask;
  // A copy, not a reference to it.
  umbilic::progress_reference second(first);
  first = umbilic::progress_reference();
  CHECK(!first && second && !second(0.5) && asked == 1);
  const auto count = [](double) { asked++; };
  second = count;
  CHECK(second(0.5) && asked == 2);
}

}  // namespace

int main() {
  CHECK(umbilic::library_fits());
  views();
  loops();
  errors();
  progress();
  topologies();
  lists();
  curvatures();
  parts();
  memory();
  threads();
  references();
  std::printf("wrapper: as the C interface, C++%ld\n", (__cplusplus / 100L) % 100L);
  return 0;
}

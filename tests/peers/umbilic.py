"""umbilic for Python, through its C interface, with ctypes and numpy: see include/umbilic.h for what everything means.

    umbilic = Umbilic("target/release/libumbilic.so")
    with umbilic.mesh(faces, len(positions)) as mesh:
        normals, statuses = mesh.normals(positions, "conformal")
        found = mesh.curvatures(positions, "jet", ("k1", "k2", "status"), rings=2)

Faces are an array `#F x n`, or a sequence of sequences of vertices. Arrays go over in double precision, or rounded to
single precision if a call is given the scalar "f32"; results are double precision arrays either way.
"""

import ctypes

import numpy

WEIGHTS = {
    name: value
    for value, name in enumerate(
        "conformal uniform angle area max centroid-area centroid inverse-root-edges sine angle-edges jet "
        "adaptive-jet tilted-sections".split()
    )
}  # UMB_WEIGHT_
METHODS = {
    name: value
    for value, name in enumerate(
        "adaptive-jet jet quadric goldfeather tilted-sections least-squares taubin watanabe meyer angle-defect "
        "rusinkiewicz normal-cycle corrected-measure".split()
    )
}  # UMB_CURVATURE_
SECTIONS = {
    name: value for value, name in enumerate("symmetric-parabola circle parabola length-parabola".split())
}  # UMB_SECTION_
SCALARS = {"f32": (numpy.float32, 0), "f64": (numpy.float64, 1)}  # with UMB_SCALAR_
BOUNDARY, NON_MANIFOLD, WINDING, ISOLATED, FALLBACK, DEGENERATE, WIDENED, CREASE = (1 << bit for bit in range(8))  # UMB_VERTEX_
ONE_SIDED, NO_SECTION = 1, 2  # UMB_SECTION_STATUS_
VECTORS = ("direction1", "direction2", "mean_normal", "normal")  # the outputs of curvatures that are no single scalars

u32, size, pointer, double = ctypes.c_uint32, ctypes.c_size_t, ctypes.c_void_p, ctypes.c_double


def struct(name, **fields):
    return type(name, (ctypes.Structure,), {"_fields_": list(fields.items())})


Faces = struct("Faces", indices=pointer, index_count=size, offsets=pointer, face_count=size, index=u32, arity=u32)
Points = struct("Points", data=pointer, count=size, stride=size, scalar=u32, reserved=u32)
Run = struct("Run", threads=u32, simd=u32, vertices=pointer, vertex_count=size, progress=pointer, user=pointer)
Output = struct("Output", data=pointer, stride=size, scalar=u32, reserved=u32)
StatusOutput = struct("StatusOutput", data=pointer, stride=size)
Error = struct("Error", struct_size=u32, status=ctypes.c_int32, element=ctypes.c_uint64, message=ctypes.c_char * 240)
AdaptiveModel = struct(
    "AdaptiveModel",
    struct_size=u32,
    coordinates=u32,
    edge_length=double,
    noise=double,
    sizes=double * 4,
    noise_exponent=u32,
    size_exponent=u32,
    evidence=double * 2,
    sample=u32,
    reserved=u32,
)
NormalOptions = struct("NormalOptions", struct_size=u32, weight=u32, run=Run, degree=u32, rings=u32, model=pointer)
NormalOutputs = struct("NormalOutputs", struct_size=u32, reserved=u32, normal=Output, sum=Output, status=StatusOutput)
Creases = struct(
    "Creases",
    struct_size=u32,
    reserved=u32,
    angle=double,
    edges=pointer,
    edge_count=size,
    groups=pointer,
    group_count=size,
)
CornerOutputs = struct(
    "CornerOutputs", struct_size=u32, reserved=u32, corner=Output, normal=Output, sum=Output, status=StatusOutput
)
CurvatureOptions = struct(
    "CurvatureOptions",
    **dict.fromkeys(("struct_size", "method", "section", "weight"), u32),
    radius=double,
    **dict.fromkeys(("degree", "rings", "normal_degree", "normal_rings"), u32),
    model=pointer,
    normals=Points,
    run=Run,
)
CURVATURES = (
    "k1 k2 direction1 direction2 mean gaussian mean_normal area integrated_mean integrated_gaussian shape_index "
    "curvedness residual condition degrees_of_freedom normal".split()
)
CurvatureOutputs = struct(
    "CurvatureOutputs", struct_size=u32, reserved=u32, **dict.fromkeys(CURVATURES, Output), status=StatusOutput
)
SectionOptions = struct(
    "SectionOptions",
    **dict.fromkeys(("struct_size", "section", "weight", "shared"), u32),
    normals=Points,
    directions=Points,
    normal_degree=u32,
    normal_rings=u32,
    model=pointer,
    run=Run,
)
SectionOutputs = struct(
    "SectionOutputs", struct_size=u32, reserved=u32, curvature=Output, status=StatusOutput, normal=Output
)


class Umbilic:
    """The library."""

    def __init__(self, path):
        self.library = ctypes.CDLL(str(path))
        self.library.umb_topology_destroy.argtypes = [pointer]
        self.library.umb_topology_destroy.restype = None
        self.library.umb_build_info.restype = ctypes.c_char_p
        self.library.umb_cut_destroy.argtypes = [pointer]
        self.library.umb_cut_destroy.restype = None
        self.library.umb_cut_corners.argtypes = [pointer]
        self.library.umb_cut_corners.restype = ctypes.POINTER(u32)
        for rings in ("umb_topology_ring_offsets", "umb_topology_ring_neighbours"):
            getattr(self.library, rings).argtypes = [pointer]
            getattr(self.library, rings).restype = ctypes.POINTER(u32)

    def build_info(self):
        return self.library.umb_build_info().decode()

    def mesh(self, faces, vertex_count):
        return Mesh(self, faces, vertex_count)

    def corner_normals(self, triangles, positions, angle, weight="conformal"):
        """Normals of the corners, `#F x 3 x 3`, split at edges sharper than the angle in radians, and for each corner the vertex
        of the cut mesh."""
        points, keep = points_of(positions, "f64")
        indices = numpy.ascontiguousarray(triangles, numpy.uint32)
        faces = Faces(indices=address(indices), index_count=indices.size, arity=3)
        cut = pointer()
        self.call(
            "umb_cut_create", *map(ctypes.byref, (faces, points, sized(Creases, angle=angle))), None, ctypes.byref(cut)
        )
        normals, corner = output(indices.size, 3, "f64")
        options = sized(NormalOptions, weight=WEIGHTS[weight])
        outputs = sized(CornerOutputs, corner=corner)
        self.call("umb_corner_normals", cut, *map(ctypes.byref, (points, options, outputs)))
        corners = numpy.ctypeslib.as_array(self.library.umb_cut_corners(cut), (indices.size,)).copy()
        self.library.umb_cut_destroy(cut)
        del keep
        return normals.reshape(-1, 3, 3), corners.reshape(-1, 3)

    def call(self, function, *arguments):
        error = sized(Error)
        if getattr(self.library, function)(*arguments, ctypes.byref(error)) != 0:
            raise RuntimeError(f"{function}: {error.message.decode()}")


class Mesh:
    """A topology, which keeps its memory until it is closed."""

    def __init__(self, umbilic, faces, vertex_count):
        self.umbilic, self.vertex_count, self.handle = umbilic, vertex_count, pointer()
        if isinstance(faces, numpy.ndarray):
            indices = numpy.ascontiguousarray(faces, numpy.uint32)
            view = Faces(indices=address(indices), index_count=indices.size, arity=faces.shape[1])
        else:
            offsets = numpy.concatenate(([0], numpy.cumsum([len(face) for face in faces]))).astype(numpy.uint32)
            indices = numpy.array([vertex for face in faces for vertex in face], numpy.uint32)
            view = Faces(
                indices=address(indices), index_count=indices.size, offsets=address(offsets), face_count=len(faces)
            )
        umbilic.call(
            "umb_topology_create", ctypes.byref(view), size(vertex_count), None, ctypes.byref(self.handle)
        )

    def close(self):
        self.umbilic.library.umb_topology_destroy(self.handle)
        self.handle = pointer()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def model(self, positions, scalar="f64"):
        """What adaptive jets learn of the mesh, to look at, or as the option `model` of normals and curvatures."""
        points, keep = points_of(positions, scalar)
        model = sized(AdaptiveModel)
        self.compute("umb_learn_model", points, sized(NormalOptions), model)
        del keep
        return model

    def normals(self, positions, weight="conformal", scalar="f64", **options):
        """Normals and statuses. Options: degree, rings, model, threads."""
        points, keep = points_of(positions, scalar)
        normals, normal = output(self.vertex_count, 3, scalar)
        statuses, status = status_output(self.vertex_count)
        model = model_of(options)
        options = sized(NormalOptions, weight=WEIGHTS[weight], run=run_of(options), **options)
        self.compute("umb_vertex_normals", points, options, sized(NormalOutputs, normal=normal, status=status))
        del keep, model
        return normals.astype(float), statuses

    def curvatures(self, positions, method, wanted=("k1", "k2"), scalar="f64", section="symmetric-parabola", **options):
        """A dictionary of the outputs `wanted`. Options: weight, normals, radius, degree, rings, normal_degree,
        normal_rings, model, threads."""
        points, keep = points_of(positions, scalar)
        results, fields = {}, {}
        for name in wanted:
            if name == "status":
                results[name], fields[name] = status_output(self.vertex_count)
            else:
                results[name], fields[name] = output(self.vertex_count, 3 if name in VECTORS else 1, scalar)
        given = normals_of(options, scalar), model_of(options)
        options = sized(
            CurvatureOptions, method=METHODS[method], section=SECTIONS[section], run=run_of(options), **options
        )
        self.compute("umb_curvatures", points, options, sized(CurvatureOutputs, **fields))
        del keep, given
        return {name: result if name == "status" else result.astype(float) for name, result in results.items()}

    def rings(self):
        """Offsets, one more than vertices, and the neighbours that they delimit."""
        offsets = self.umbilic.library.umb_topology_ring_offsets(self.handle)
        offsets = numpy.ctypeslib.as_array(offsets, (self.vertex_count + 1,)).copy()
        neighbours = self.umbilic.library.umb_topology_ring_neighbours(self.handle)
        return offsets, numpy.ctypeslib.as_array(neighbours, (int(offsets[-1]),)).copy()

    def edge_sections(self, positions, section="symmetric-parabola", scalar="f64", **options):
        """Curvatures and statuses along the edges, parallel to the neighbours of `rings`. Options: as of curvatures."""
        return self.sections("umb_edge_sections", len(self.rings()[1]), positions, section, scalar, options)

    def direction_sections(self, positions, directions, section="symmetric-parabola", scalar="f64", **options):
        """Curvatures and statuses in `directions`: `#V x 3`, one of each vertex, or if `shared`, `#D x 3` for all of
        them, and then the results are `#V x #D`."""
        options["directions"], keep = points_of(directions, scalar)
        count = self.vertex_count * (len(directions) if options.get("shared") else 1)
        found = self.sections("umb_direction_sections", count, positions, section, scalar, options)
        del keep
        return [result.reshape(self.vertex_count, -1) for result in found] if options.get("shared") else found

    def sections(self, function, count, positions, section, scalar, options):
        points, keep = points_of(positions, scalar)
        curvatures, curvature = output(count, 1, scalar)
        statuses, status = status_output(count)
        given = normals_of(options, scalar)
        if "shared" in options:
            options["shared"] = int(options["shared"])
        filled = sized(SectionOptions, section=SECTIONS[section], run=run_of(options), **options)
        self.compute(function, points, filled, sized(SectionOutputs, curvature=curvature, status=status))
        del keep, given
        return curvatures.astype(float), statuses

    def compute(self, function, *structs):
        self.umbilic.call(function, self.handle, *(ctypes.byref(struct) for struct in structs))


# Structs and the arrays that they point into. The caller holds the arrays for as long as the struct is in use.


def sized(kind, **fields):
    return kind(struct_size=ctypes.sizeof(kind), **fields)


def address(array):
    return array.ctypes.data


def points_of(values, scalar):
    dtype, code = SCALARS[scalar]
    values = numpy.ascontiguousarray(values, dtype)
    return Points(data=address(values), count=len(values), scalar=code), values


def output(count, width, scalar):
    dtype, code = SCALARS[scalar]
    values = numpy.empty((count, width) if width > 1 else count, dtype)
    return values, Output(data=address(values), scalar=code)


def status_output(count):
    values = numpy.empty(count, numpy.uint8)
    return values, StatusOutput(data=address(values))


def normals_of(options, scalar):
    """Replaces names and arrays among options by what the struct holds; answers with the array to hold."""
    if "weight" in options:
        options["weight"] = WEIGHTS[options["weight"]]
    if options.get("normals") is None:
        options.pop("normals", None)
        return None
    options["normals"], keep = points_of(options["normals"], scalar)
    return keep


def model_of(options):
    """Replaces a model among options by its address; answers with the model to hold."""
    model = options.get("model")
    if model is not None:
        options["model"] = ctypes.addressof(model)
    return model


def run_of(options):
    return Run(threads=options.pop("threads", 0))

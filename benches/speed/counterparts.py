"""What of umbilic's computes the same as a peer's method, or what comes nearest."""

# Of each program, the peer's method with the name and the scalar of umbilic's.
COUNTERPARTS = {
    "openmesh": {
        "structure": ("topology", "f32"),
        "calc_vertex_normal_fast": ("uniform", "f32"),
        "calc_vertex_normal_correct": ("area", "f32"),
        "calc_vertex_normal_loop": ("N_CM", "f32"),
    },
    "cgal": {
        "structure": ("topology", "f64"),
        "compute_vertex_normals": ("N_CM", "f64"),
        "interpolated_corrected_curvatures": ("corrected measure, on given normals", "f64"),
        "Monge_via_jet_fitting 2, 2 rings": ("jets 2, 2 rings", "f64"),
        "Monge_via_jet_fitting 3, 2 rings": ("jets 3, 2 rings", "f64"),
        "Monge_via_jet_fitting 4, 3 rings": ("jets 4, 3 rings", "f64"),
    },
    "libigl": {
        "per_vertex_normals uniform": ("uniform", "f64"),
        "per_vertex_normals area": ("area", "f64"),
        "per_vertex_normals angle": ("angle", "f64"),
        "gaussian_curvature": ("angle defect", "f64"),
        "principal_curvature, radius 2": ("jets 2, 2 rings", "f64"),
        "principal_curvature, radius 5": ("jets 2, 5 rings", "f64"),
    },
    "vcg": {
        "structure": ("topology", "f64"),
        "normals average": ("uniform", "f64"),
        "normals angle": ("angle", "f64"),
        "normals area": ("area", "f64"),
        "normals max": ("Max", "f64"),
        "discrete mean curvature": ("Meyer, on given normals", "f64"),
        "principal directions, Taubin": ("Taubin", "f64"),
        "principal directions, quadric fitting": ("quadric", "f64"),
    },
    "vtk": {
        "structure": ("topology", "f32"),
        "vtkTriangleMeshPointNormals": ("area", "f32"),
        "vtkPolyDataNormals, no splitting": ("uniform", "f32"),
        "vtkCurvatures, Gauss": ("angle defect", "f32"),
        "vtkCurvatures, mean": ("normal cycle, on given normals", "f32"),
    },
    "open3d": {
        "structure": ("topology", "f64"),
        "compute_vertex_normals": ("area", "f64"),
        "compute_vertex_normals of tensors": ("area", "f32"),
    },
    "meshlib": {
        "structure": ("topology", "f32"),
        "computePerVertNormals": ("area", "f32"),
        "computePerVertPseudoNormals": ("angle", "f32"),
        "getNumpyGaussianCurvature": ("angle defect", "f32"),
    },
}

# What of umbilic's does without a structure: peers that have one are at an advantage without these lines.
NOTES = {
    "openmesh": "The loop normals are limits of subdivision, and have no counterpart; N_CM stands for it.",
    "cgal": "Its normals are the most visible ones, not N_CM. Jets: of 500 vertices, without the time that it takes to "
    "gather their neighbourhoods.",
    "libigl": "It takes arrays: its curvatures build what they need of a structure in every call, umbilic's topology is there.",
    "vcg": "Its mean curvature is that of cotangents, without principal values; both filters of principal directions "
    "also colour the mesh. The normals of a MeshSet are those of vertices and faces.",
    "vtk": "Its structure is a copy of points and polygons without neighbours; the normals of `vtkPolyDataNormals` and the "
    "curvatures build these in every call. For `vtkCurvatures` mean, umbilic's normal cycle, a tensor on given normals, "
    "comes nearest.",
    "open3d": "Its structure is a copy of vertices and triangles without neighbours.",
    "meshlib": "",
}

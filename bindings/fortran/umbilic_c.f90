! The functions, structs and constants of include/umbilic.h that the module umbilic uses, as they are in C.
module umbilic_c
  use, intrinsic :: iso_c_binding
  implicit none

  integer(c_int32_t), parameter :: UMB_OK = 0, UMB_ERROR_SIZE = 7
  integer(c_int32_t), parameter :: UMB_SCALAR_F64 = 1, UMB_INDEX_I32 = 1

  type, bind(C) :: umb_error
    integer(c_int32_t) :: struct_size = 256, status = 0
    integer(c_int64_t) :: element = -1
    character(kind=c_char) :: message(240) = c_null_char
  end type

  type, bind(C) :: umb_faces
    type(c_ptr) :: indices = c_null_ptr
    integer(c_size_t) :: index_count = 0
    type(c_ptr) :: offsets = c_null_ptr
    integer(c_size_t) :: face_count = 0
    integer(c_int32_t) :: index = UMB_INDEX_I32, arity = 0
  end type

  type, bind(C) :: umb_topology_options
    integer(c_int32_t) :: struct_size = 16, threads = 0, simd = 0, reserved = 0
  end type

  type, bind(C) :: umb_points
    type(c_ptr) :: data = c_null_ptr
    integer(c_size_t) :: count = 0, stride = 0
    integer(c_int32_t) :: scalar = UMB_SCALAR_F64, reserved = 0
  end type

  type, bind(C) :: umb_output
    type(c_ptr) :: data = c_null_ptr
    integer(c_size_t) :: stride = 0
    integer(c_int32_t) :: scalar = UMB_SCALAR_F64, reserved = 0
  end type

  type, bind(C) :: umb_status_output
    type(c_ptr) :: data = c_null_ptr
    integer(c_size_t) :: stride = 0
  end type

  type, bind(C) :: umb_run
    integer(c_int32_t) :: threads = 0, simd = 0
    type(c_ptr) :: vertices = c_null_ptr
    integer(c_size_t) :: vertex_count = 0
    type(c_funptr) :: progress = c_null_funptr
    type(c_ptr) :: user = c_null_ptr
  end type

  type, bind(C) :: umb_normal_options
    integer(c_int32_t) :: struct_size = 64, weight = 0
    type(umb_run) :: run
    integer(c_int32_t) :: degree = 0, rings = 0
    type(c_ptr) :: model = c_null_ptr
  end type

  type, bind(C) :: umb_normal_outputs
    integer(c_int32_t) :: struct_size = 72, reserved = 0
    type(umb_output) :: normal, sum
    type(umb_status_output) :: status
  end type

  type, bind(C) :: umb_curvature_options
    integer(c_int32_t) :: struct_size = 120, method = 0, section = 0, weight = 0
    real(c_double) :: radius = 0
    integer(c_int32_t) :: degree = 0, rings = 0, normal_degree = 0, normal_rings = 0
    type(c_ptr) :: model = c_null_ptr
    type(umb_points) :: normals
    type(umb_run) :: run
  end type

  type, bind(C) :: umb_curvature_outputs
    integer(c_int32_t) :: struct_size = 408, reserved = 0
    type(umb_output) :: k1, k2, direction1, direction2, mean, gaussian, mean_normal, area, integrated_mean, integrated_gaussian, &
      shape_index, curvedness, residual, condition, degrees_of_freedom, normal
    type(umb_status_output) :: status
  end type

  interface
    function umb_topology_create(faces, vertex_count, options, topology, error) result(status) bind(C)
      import
      type(umb_faces), intent(in) :: faces
      integer(c_size_t), value :: vertex_count
      type(umb_topology_options), intent(in) :: options
      type(c_ptr), intent(inout) :: topology ! kept as it was where the call fails
      type(umb_error), intent(inout) :: error
      integer(c_int32_t) :: status
    end function

    subroutine umb_topology_destroy(topology) bind(C)
      import
      type(c_ptr), value :: topology
    end subroutine

    pure function umb_topology_vertex_count(topology) result(vertex_count) bind(C)
      import
      type(c_ptr), value, intent(in) :: topology
      integer(c_size_t) :: vertex_count
    end function

    function umb_vertex_normals(topology, points, options, outputs, error) result(status) bind(C)
      import
      type(c_ptr), value :: topology
      type(umb_points), intent(in) :: points
      type(umb_normal_options), intent(in) :: options
      type(umb_normal_outputs), intent(in) :: outputs
      type(umb_error), intent(inout) :: error
      integer(c_int32_t) :: status
    end function

    function umb_curvatures(topology, points, options, outputs, error) result(status) bind(C)
      import
      type(c_ptr), value :: topology
      type(umb_points), intent(in) :: points
      type(umb_curvature_options), intent(in) :: options
      type(umb_curvature_outputs), intent(in) :: outputs
      type(umb_error), intent(inout) :: error
      integer(c_int32_t) :: status
    end function

    function umb_abi_version() result(version) bind(C)
      import
      integer(c_int32_t) :: version
    end function
  end interface
end module

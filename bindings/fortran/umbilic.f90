! umbilic for Fortran: vertex normals and curvatures of polygon meshes, on arrays. See include/umbilic.h for what everything means.
!
!   type(topology) :: mesh
!   type(vertex_curvatures) :: found
!   call mesh%create(indices, vertex_count)                     ! integer(c_int32_t), triangles
!   call mesh%curvatures(positions, found)                      ! real(c_double), 3 x the number of vertices
!
! Vertices and faces are counted from 0, as in files and in errors. Arrays are neither copied nor kept (a section that is not
! contiguous the compiler copies). Without stat, what the library refuses ends the program with its message (error stop); with
! stat, which is then a UMB_ERROR_ constant or 0, errmsg receives that message (240 characters are enough for any) and element the
! offending corner, face, vertex or value, -1 if there is none.
! A topology is freed by destroy, or where its variable ends; any number of threads may use it meanwhile. A copy by allocate with source=,
! which no module can refuse, would be freed a second time.
module umbilic
  use umbilic_c
  implicit none
  private
  public :: topology, vertex_normals, vertex_curvatures

  !> The one-rings of a mesh, built once from its faces and used while positions move. Not to be assigned: it owns memory.
  type :: topology
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure :: create, destroy, normals, curvatures
    procedure, private :: refuse_assignment
    generic :: assignment(=) => refuse_assignment
    final :: finalise
  end type

  type :: vertex_normals
    real(c_double), allocatable :: normal(:, :) !< unit vectors, 3 x the number of vertices
    integer(c_int8_t), allocatable :: status(:) !< UMB_VERTEX_ bits
  end type

  type :: vertex_curvatures
    real(c_double), allocatable :: k1(:), k2(:), mean(:), gaussian(:)
    real(c_double), allocatable :: direction1(:, :), direction2(:, :) !< unit vectors, 3 x the number of vertices
    integer(c_int8_t), allocatable :: status(:) !< UMB_VERTEX_ bits
  end type

contains

  !> Builds it from the vertices of all faces, one face after the other; offsets say where each face starts and the last ends, and
  !> are left out for triangles. threads: as many as pay, if left out.
  subroutine create(self, indices, vertex_count, offsets, threads, stat, element, errmsg)
    class(topology), intent(inout) :: self
    integer(c_int32_t), intent(in), contiguous, target :: indices(:)
    integer, intent(in) :: vertex_count
    integer(c_int32_t), intent(in), contiguous, target, optional :: offsets(:)
    integer, intent(in), optional :: threads
    integer, intent(out), optional :: stat
    integer(c_int64_t), intent(out), optional :: element
    character(*), intent(inout), optional :: errmsg
    type(umb_faces) :: faces
    type(umb_topology_options) :: options
    type(umb_error) :: error

    if (umb_abi_version() /= 0) error stop 'libumbilic has another binary interface than umbilic.f90'
    call self%destroy()
    faces%indices = c_loc(indices)
    faces%index_count = size(indices, kind=c_size_t)
    if (present(offsets)) then
      faces%offsets = c_loc(offsets)
      faces%face_count = size(offsets, kind=c_size_t) - 1
    end if
    if (present(threads)) options%threads = threads
    call report(umb_topology_create(faces, int(vertex_count, c_size_t), options, self%handle, error), error, stat, element, &
      errmsg)
  end subroutine

  !> Frees it now; calls that follow are refused.
  subroutine destroy(self)
    class(topology), intent(inout) :: self
    call umb_topology_destroy(self%handle)
    self%handle = c_null_ptr
  end subroutine

  !> Unit normals (N_CM).
  subroutine normals(self, positions, found, threads, stat, element, errmsg)
    class(topology), intent(in) :: self
    real(c_double), intent(in), contiguous, target :: positions(:, :)
    type(vertex_normals), intent(out), target :: found
    integer, intent(in), optional :: threads
    integer, intent(out), optional :: stat
    integer(c_int64_t), intent(out), optional :: element
    character(*), intent(inout), optional :: errmsg
    type(umb_normal_options) :: options
    type(umb_normal_outputs) :: outputs
    type(umb_error) :: error
    integer(c_size_t) :: vertices

    vertices = umb_topology_vertex_count(self%handle)
    allocate(found%normal(3, vertices), found%status(vertices))
    outputs%normal%data = c_loc(found%normal)
    outputs%status%data = c_loc(found%status)
    if (present(threads)) options%run%threads = threads
    call report(umb_vertex_normals(self%handle, points_of(positions), options, outputs, error), error, stat, element, &
      errmsg)
  end subroutine

  !> Curvatures by adaptive jets.
  subroutine curvatures(self, positions, found, threads, stat, element, errmsg)
    class(topology), intent(in) :: self
    real(c_double), intent(in), contiguous, target :: positions(:, :)
    type(vertex_curvatures), intent(out), target :: found
    integer, intent(in), optional :: threads
    integer, intent(out), optional :: stat
    integer(c_int64_t), intent(out), optional :: element
    character(*), intent(inout), optional :: errmsg
    type(umb_curvature_options) :: options
    type(umb_curvature_outputs) :: outputs
    type(umb_error) :: error
    integer(c_size_t) :: vertices

    vertices = umb_topology_vertex_count(self%handle)
    allocate(found%k1(vertices), found%k2(vertices), found%mean(vertices), found%gaussian(vertices), &
      found%direction1(3, vertices), found%direction2(3, vertices), found%status(vertices))
    outputs%k1%data = c_loc(found%k1)
    outputs%k2%data = c_loc(found%k2)
    outputs%direction1%data = c_loc(found%direction1)
    outputs%direction2%data = c_loc(found%direction2)
    outputs%mean%data = c_loc(found%mean)
    outputs%gaussian%data = c_loc(found%gaussian)
    outputs%status%data = c_loc(found%status)
    if (present(threads)) options%run%threads = threads
    call report(umb_curvatures(self%handle, points_of(positions), options, outputs, error), error, stat, element, errmsg)
  end subroutine

  function points_of(positions) result(points)
    real(c_double), intent(in), contiguous, target :: positions(:, :)
    type(umb_points) :: points
    if (size(positions, 1) /= 3) return ! no data: the library refuses it
    points%data = c_loc(positions)
    points%count = size(positions, 2, kind=c_size_t)
  end function

  subroutine report(status, error, stat, element, errmsg)
    integer(c_int32_t), intent(in) :: status
    type(umb_error), intent(in) :: error
    integer, intent(out), optional :: stat
    integer(c_int64_t), intent(out), optional :: element
    character(*), intent(inout), optional :: errmsg
    character(size(error%message)) :: message
    character(64) :: where
    integer :: i

    if (present(stat)) stat = status
    if (present(element)) element = -1
    if (status == UMB_OK) return
    message = ''
    do i = 1, size(error%message)
      if (error%message(i) == c_null_char) exit
      message(i:i) = error%message(i)
    end do
    if (.not. present(stat)) then
      write(where, '(a, i0, a, i0, a)') ' (status ', status, ', element ', error%element, ')'
      if (error%element < 0) write(where, '(a, i0, a)') ' (status ', status, ')'
      error stop 'umbilic: ' // trim(message) // trim(where)
    end if
    if (present(element)) element = error%element
    if (present(errmsg)) errmsg = message
  end subroutine

  ! Elemental, this and the next one, so that arrays of topologies are no exception.
  impure elemental subroutine refuse_assignment(self, other)
    class(topology), intent(inout) :: self
    class(topology), intent(in) :: other
    error stop 'umbilic: a topology cannot be assigned'
  end subroutine

  impure elemental subroutine finalise(self)
    type(topology), intent(inout) :: self
    call self%destroy()
  end subroutine
end module

! What tests/ffi/test.py asks of bindings/fortran: check layout | MISTAKE.
program check
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use umbilic_c
  use umbilic
  implicit none

  ! A tetrahedron.
  integer(c_int32_t) :: indices(12) = [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2]
  real(c_double) :: positions(3, 4) = reshape([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1] * 1.0_c_double, [3, 4])
  type(topology) :: mesh, other
  type(vertex_normals) :: normals, normals3
  type(vertex_curvatures) :: found, found3
  integer :: stat, i
  integer(c_int64_t) :: element
  character(240) :: errmsg
  character(32) :: action, blamed
  integer(c_int32_t), allocatable :: none(:)

  stat = 0
  allocate(none(0))
  call get_command_argument(1, action)
  if (action == 'layout') then
    call layout()
    stop
  end if
  call mesh%create(indices, 4)

  select case (action)
  case ('index')
    indices(5) = 4
    call mesh%create(indices, 4, stat=stat, element=element, errmsg=errmsg)
  case ('offsets')
    call mesh%create(indices, 4, [0, 3, 2, 9, 12], stat=stat, element=element, errmsg=errmsg)
  case ('no-offsets')
    call mesh%create(indices, 4, none, stat=stat, element=element, errmsg=errmsg)
  case ('indices-size')
    call mesh%create(indices(:11), 4, stat=stat, element=element, errmsg=errmsg)
  case ('count')
    call mesh%create(indices, -1, stat=stat, element=element, errmsg=errmsg)
  case ('positions-size')
    call mesh%normals(positions(:, :3), normals, stat=stat, element=element, errmsg=errmsg)
  case ('ragged')
    call mesh%curvatures(positions(:2, :), found, stat=stat, element=element, errmsg=errmsg)
  case ('nan-normals')
    positions(2, 3) = ieee_value(0.0_c_double, ieee_quiet_nan)
    call mesh%normals(positions, normals, stat=stat, element=element, errmsg=errmsg)
  case ('nan-curvatures')
    positions(2, 3) = ieee_value(0.0_c_double, ieee_quiet_nan)
    call mesh%curvatures(positions, found, stat=stat, element=element, errmsg=errmsg)
  case ('closed-normals')
    call mesh%destroy()
    call mesh%normals(positions, normals, stat=stat, element=element, errmsg=errmsg)
  case ('closed-curvatures')
    call mesh%destroy()
    call mesh%curvatures(positions, found, stat=stat, element=element, errmsg=errmsg)
  case ('error-stop')
    call mesh%destroy()
    call mesh%curvatures(positions, found)
  case ('error-stop-at')
    call mesh%create(indices, 3)
  case ('assigned')
    other = mesh
  case ('assigned-arrays')
    call assign()
  case ('twice')
    call mesh%destroy()
    call mesh%destroy()
  case ('empty')
    call mesh%create(indices(:0), 0)
    call mesh%normals(positions(:, :0), normals)
    call mesh%curvatures(positions(:, :0), found)
    if (size(normals%normal) /= 0 .or. size(found%k1) /= 0) error stop 'not as expected'
  case ('threads')
    call mesh%create(indices, 4, threads=1)
    call mesh%normals(positions, normals, threads=1)
    call mesh%curvatures(positions, found, threads=1)
    call mesh%create(indices, 4, threads=3)
    call mesh%normals(positions, normals3, threads=3)
    call mesh%curvatures(positions, found3, threads=3)
    if (any(transfer(normals%normal, [0_c_int64_t]) /= transfer(normals3%normal, [0_c_int64_t]))) error stop 'not as expected'
    if (any(transfer(found%k1, [0_c_int64_t]) /= transfer(found3%k1, [0_c_int64_t]))) error stop 'not as expected'
  case ('forgotten')
    do i = 1, 10
      call forget()
      call forget_several()
    end do
  case default
    error stop 'what?'
  end select

  call mesh%destroy() ! Fortran finalises no variable of a main program
  if (stat /= 0) then
    blamed = ''
    if (element >= 0) write(blamed, '(a, i0)') ', element ', element
    write(error_unit, '(a, a, a, i0, a, a)') 'umbilic: ', trim(errmsg), ' (status ', stat, trim(blamed), ')'
    stop 1, quiet=.true.
  end if

contains

  subroutine forget()
    type(topology) :: local
    call local%create(indices, 4)
  end subroutine

  subroutine forget_several()
    type(topology) :: locals(2)
    type(topology), allocatable :: more(:, :)
    allocate(more(1, 2))
    call locals(2)%create(indices, 4)
    call more(1, 1)%create(indices, 4)
    call more(1, 2)%create(indices, 4)
  end subroutine

  subroutine assign()
    type(topology) :: locals(2), others(2)
    call locals(1)%create(indices, 4)
    others = locals
  end subroutine

  subroutine size_of(struct, bytes)
    character(*), intent(in) :: struct
    integer(c_size_t), intent(in) :: bytes
    print '(a, a, i0)', struct, ' ', bytes
  end subroutine

  subroutine place(field, struct_at, field_at)
    character(*), intent(in) :: field
    type(c_ptr), intent(in) :: struct_at, field_at
    print '(a, a, i0)', field, ' ', transfer(field_at, 0_c_intptr_t) - transfer(struct_at, 0_c_intptr_t)
  end subroutine

  subroutine layout()
    type(umb_error), target :: error
    type(umb_faces), target :: faces
    type(umb_topology_options), target :: topology_options
    type(umb_points), target :: points
    type(umb_output), target :: output
    type(umb_status_output), target :: status_output
    type(umb_run), target :: run
    type(umb_normal_options), target :: normal_options
    type(umb_normal_outputs), target :: normal_outputs
    type(umb_curvature_options), target :: curvature_options
    type(umb_curvature_outputs), target :: curvature_outputs

    ! The sizes that are written in umbilic_c by hand.
    if (error%struct_size /= c_sizeof(error)) error stop 'size of umb_error'
    if (topology_options%struct_size /= c_sizeof(topology_options)) error stop 'size of umb_topology_options'
    if (normal_options%struct_size /= c_sizeof(normal_options)) error stop 'size of umb_normal_options'
    if (normal_outputs%struct_size /= c_sizeof(normal_outputs)) error stop 'size of umb_normal_outputs'
    if (curvature_options%struct_size /= c_sizeof(curvature_options)) error stop 'size of umb_curvature_options'
    if (curvature_outputs%struct_size /= c_sizeof(curvature_outputs)) error stop 'size of umb_curvature_outputs'

    call size_of('umb_error', c_sizeof(error))
    call place('umb_error.struct_size', c_loc(error), c_loc(error%struct_size))
    call place('umb_error.status', c_loc(error), c_loc(error%status))
    call place('umb_error.element', c_loc(error), c_loc(error%element))
    call place('umb_error.message', c_loc(error), c_loc(error%message))

    call size_of('umb_faces', c_sizeof(faces))
    call place('umb_faces.indices', c_loc(faces), c_loc(faces%indices))
    call place('umb_faces.index_count', c_loc(faces), c_loc(faces%index_count))
    call place('umb_faces.offsets', c_loc(faces), c_loc(faces%offsets))
    call place('umb_faces.face_count', c_loc(faces), c_loc(faces%face_count))
    call place('umb_faces.index', c_loc(faces), c_loc(faces%index))
    call place('umb_faces.arity', c_loc(faces), c_loc(faces%arity))

    call size_of('umb_topology_options', c_sizeof(topology_options))
    call place('umb_topology_options.struct_size', c_loc(topology_options), c_loc(topology_options%struct_size))
    call place('umb_topology_options.threads', c_loc(topology_options), c_loc(topology_options%threads))
    call place('umb_topology_options.simd', c_loc(topology_options), c_loc(topology_options%simd))
    call place('umb_topology_options.reserved', c_loc(topology_options), c_loc(topology_options%reserved))

    call size_of('umb_points', c_sizeof(points))
    call place('umb_points.data', c_loc(points), c_loc(points%data))
    call place('umb_points.count', c_loc(points), c_loc(points%count))
    call place('umb_points.stride', c_loc(points), c_loc(points%stride))
    call place('umb_points.scalar', c_loc(points), c_loc(points%scalar))
    call place('umb_points.reserved', c_loc(points), c_loc(points%reserved))

    call size_of('umb_output', c_sizeof(output))
    call place('umb_output.data', c_loc(output), c_loc(output%data))
    call place('umb_output.stride', c_loc(output), c_loc(output%stride))
    call place('umb_output.scalar', c_loc(output), c_loc(output%scalar))
    call place('umb_output.reserved', c_loc(output), c_loc(output%reserved))

    call size_of('umb_status_output', c_sizeof(status_output))
    call place('umb_status_output.data', c_loc(status_output), c_loc(status_output%data))
    call place('umb_status_output.stride', c_loc(status_output), c_loc(status_output%stride))

    call size_of('umb_run', c_sizeof(run))
    call place('umb_run.threads', c_loc(run), c_loc(run%threads))
    call place('umb_run.simd', c_loc(run), c_loc(run%simd))
    call place('umb_run.vertices', c_loc(run), c_loc(run%vertices))
    call place('umb_run.vertex_count', c_loc(run), c_loc(run%vertex_count))
    call place('umb_run.progress', c_loc(run), c_loc(run%progress))
    call place('umb_run.user', c_loc(run), c_loc(run%user))

    call size_of('umb_normal_options', c_sizeof(normal_options))
    call place('umb_normal_options.struct_size', c_loc(normal_options), c_loc(normal_options%struct_size))
    call place('umb_normal_options.weight', c_loc(normal_options), c_loc(normal_options%weight))
    call place('umb_normal_options.run', c_loc(normal_options), c_loc(normal_options%run))
    call place('umb_normal_options.degree', c_loc(normal_options), c_loc(normal_options%degree))
    call place('umb_normal_options.rings', c_loc(normal_options), c_loc(normal_options%rings))
    call place('umb_normal_options.model', c_loc(normal_options), c_loc(normal_options%model))

    call size_of('umb_normal_outputs', c_sizeof(normal_outputs))
    call place('umb_normal_outputs.struct_size', c_loc(normal_outputs), c_loc(normal_outputs%struct_size))
    call place('umb_normal_outputs.reserved', c_loc(normal_outputs), c_loc(normal_outputs%reserved))
    call place('umb_normal_outputs.normal', c_loc(normal_outputs), c_loc(normal_outputs%normal))
    call place('umb_normal_outputs.sum', c_loc(normal_outputs), c_loc(normal_outputs%sum))
    call place('umb_normal_outputs.status', c_loc(normal_outputs), c_loc(normal_outputs%status))

    call size_of('umb_curvature_options', c_sizeof(curvature_options))
    call place('umb_curvature_options.struct_size', c_loc(curvature_options), c_loc(curvature_options%struct_size))
    call place('umb_curvature_options.method', c_loc(curvature_options), c_loc(curvature_options%method))
    call place('umb_curvature_options.section', c_loc(curvature_options), c_loc(curvature_options%section))
    call place('umb_curvature_options.weight', c_loc(curvature_options), c_loc(curvature_options%weight))
    call place('umb_curvature_options.radius', c_loc(curvature_options), c_loc(curvature_options%radius))
    call place('umb_curvature_options.degree', c_loc(curvature_options), c_loc(curvature_options%degree))
    call place('umb_curvature_options.rings', c_loc(curvature_options), c_loc(curvature_options%rings))
    call place('umb_curvature_options.normal_degree', c_loc(curvature_options), c_loc(curvature_options%normal_degree))
    call place('umb_curvature_options.normal_rings', c_loc(curvature_options), c_loc(curvature_options%normal_rings))
    call place('umb_curvature_options.model', c_loc(curvature_options), c_loc(curvature_options%model))
    call place('umb_curvature_options.normals', c_loc(curvature_options), c_loc(curvature_options%normals))
    call place('umb_curvature_options.run', c_loc(curvature_options), c_loc(curvature_options%run))

    call size_of('umb_curvature_outputs', c_sizeof(curvature_outputs))
    call place('umb_curvature_outputs.struct_size', c_loc(curvature_outputs), c_loc(curvature_outputs%struct_size))
    call place('umb_curvature_outputs.reserved', c_loc(curvature_outputs), c_loc(curvature_outputs%reserved))
    call place('umb_curvature_outputs.k1', c_loc(curvature_outputs), c_loc(curvature_outputs%k1))
    call place('umb_curvature_outputs.k2', c_loc(curvature_outputs), c_loc(curvature_outputs%k2))
    call place('umb_curvature_outputs.direction1', c_loc(curvature_outputs), c_loc(curvature_outputs%direction1))
    call place('umb_curvature_outputs.direction2', c_loc(curvature_outputs), c_loc(curvature_outputs%direction2))
    call place('umb_curvature_outputs.mean', c_loc(curvature_outputs), c_loc(curvature_outputs%mean))
    call place('umb_curvature_outputs.gaussian', c_loc(curvature_outputs), c_loc(curvature_outputs%gaussian))
    call place('umb_curvature_outputs.mean_normal', c_loc(curvature_outputs), c_loc(curvature_outputs%mean_normal))
    call place('umb_curvature_outputs.area', c_loc(curvature_outputs), c_loc(curvature_outputs%area))
    call place('umb_curvature_outputs.integrated_mean', c_loc(curvature_outputs), c_loc(curvature_outputs%integrated_mean))
    call place('umb_curvature_outputs.integrated_gaussian', c_loc(curvature_outputs), c_loc(curvature_outputs%integrated_gaussian))
    call place('umb_curvature_outputs.shape_index', c_loc(curvature_outputs), c_loc(curvature_outputs%shape_index))
    call place('umb_curvature_outputs.curvedness', c_loc(curvature_outputs), c_loc(curvature_outputs%curvedness))
    call place('umb_curvature_outputs.residual', c_loc(curvature_outputs), c_loc(curvature_outputs%residual))
    call place('umb_curvature_outputs.condition', c_loc(curvature_outputs), c_loc(curvature_outputs%condition))
    call place('umb_curvature_outputs.degrees_of_freedom', c_loc(curvature_outputs), c_loc(curvature_outputs%degrees_of_freedom))
    call place('umb_curvature_outputs.normal', c_loc(curvature_outputs), c_loc(curvature_outputs%normal))
    call place('umb_curvature_outputs.status', c_loc(curvature_outputs), c_loc(curvature_outputs%status))
  end subroutine
end program

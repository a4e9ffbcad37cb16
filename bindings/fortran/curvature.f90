! Vertex normals and curvatures of a mesh with umbilic.
!
!   curvature MESH.off RESULTS    writes them as doubles, statuses as bytes, one array after the other
!   curvature --time MESH.off     prints how long each call takes, in milliseconds, on one thread
program curvature
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  use umbilic
  implicit none

  real(c_double), allocatable :: positions(:, :)
  integer(c_int32_t), allocatable :: indices(:), offsets(:)
  integer :: vertex_count
  character(4096) :: first, second

  if (command_argument_count() /= 2) call fail('usage: curvature MESH.off RESULTS | --time MESH.off')
  call get_command_argument(1, first)
  call get_command_argument(2, second)
  if (first == '--time') then
    call read_off(trim(second))
    call time()
  else
    call read_off(trim(first))
    call compute(trim(second))
  end if

contains

  subroutine fail(message)
    character(*), intent(in) :: message
    write(error_unit, '(a)') message
    stop 1, quiet=.true.
  end subroutine

  !> Ends the program with the library's message if there is one.
  subroutine check(stat, element, errmsg)
    integer, intent(in) :: stat
    integer(c_int64_t), intent(in) :: element
    character(*), intent(in) :: errmsg
    character(80) :: where
    if (stat == 0) return
    write(where, '(a, i0, a, i0, a)') ' (status ', stat, ', element ', element, ')'
    if (element < 0) write(where, '(a, i0, a)') ' (status ', stat, ')'
    call fail('umbilic: ' // trim(errmsg) // trim(where))
  end subroutine

  !> The next line of an OFF file that says something, however long.
  function next(unit) result(line)
    integer, intent(in) :: unit
    character(:), allocatable :: line
    character(1024) :: part
    integer :: length, stat
    do
      line = ''
      do
        read(unit, '(a)', advance='no', size=length, iostat=stat) part
        line = line // part(:length)
        if (stat /= 0) exit
      end do
      if (.not. is_iostat_eor(stat) .and. len(line) == 0) call fail('the file ends early')
      if (index(line, '#') > 0) line = line(:index(line, '#') - 1)
      line = adjustl(line)
      if (verify(line, ' ' // achar(9)) > 0) return
    end do
  end function

  subroutine need(good, line)
    logical, intent(in) :: good
    character(*), intent(in) :: line
    if (.not. good) call fail('cannot read: ' // line)
  end subroutine

  subroutine read_off(path)
    character(*), intent(in) :: path
    integer :: unit, stat, face_count, face, vertex, corner, corners, skipped
    integer(c_int32_t), allocatable :: longer(:)
    character(:), allocatable :: line
    character(256) :: message

    open(newunit=unit, file=path, status='old', action='read', iostat=stat, iomsg=message)
    if (stat /= 0) call fail(trim(message))
    line = next(unit)
    if (index(line // ' ', 'OFF ') /= 1) call fail(path // ': no OFF file')
    line = line(4:)
    if (line == ' ') line = next(unit)
    read(line, *, iostat=stat) vertex_count, face_count
    call need(stat == 0 .and. vertex_count >= 0 .and. face_count >= 0, line)
    allocate(positions(3, vertex_count), offsets(face_count + 1), indices(4 * face_count))
    do vertex = 1, vertex_count
      line = next(unit)
      read(line, *, iostat=stat) positions(:, vertex)
      call need(stat == 0, line)
    end do
    offsets(1) = 0
    do face = 1, face_count
      line = next(unit)
      read(line, *, iostat=stat) corners
      call need(stat == 0 .and. corners >= 0 .and. corners <= len(line), line)
      offsets(face + 1) = offsets(face) + corners
      if (offsets(face + 1) > size(indices)) then
        allocate(longer(2 * offsets(face + 1)))
        longer(:size(indices)) = indices
        call move_alloc(longer, indices)
      end if
      read(line, *, iostat=stat) skipped, (indices(offsets(face) + corner), corner = 1, corners)
      call need(stat == 0, line)
    end do
    indices = indices(:offsets(face_count + 1))
    close(unit)
  end subroutine

  subroutine compute(results)
    character(*), intent(in) :: results
    type(topology) :: mesh
    type(vertex_normals) :: normals
    type(vertex_curvatures) :: found
    integer :: stat, unit
    integer(c_int64_t) :: element
    character(256) :: errmsg

    ! begin: user code
    call mesh%create(indices, vertex_count, offsets, stat=stat, element=element, errmsg=errmsg)
    call check(stat, element, errmsg)
    call mesh%normals(positions, normals, stat=stat, element=element, errmsg=errmsg)
    call check(stat, element, errmsg)
    call mesh%curvatures(positions, found, stat=stat, element=element, errmsg=errmsg)
    call check(stat, element, errmsg)
    ! end: user code

    open(newunit=unit, file=results, access='stream', status='replace', action='write', iostat=stat, iomsg=errmsg)
    if (stat /= 0) call fail(trim(errmsg))
    write(unit) normals%normal, normals%status, found%k1, found%k2, found%direction1, found%direction2, found%mean, &
      found%gaussian, found%status
    close(unit)
  end subroutine

  subroutine time()
    type(topology) :: mesh
    type(vertex_normals) :: normals
    type(vertex_curvatures) :: found
    integer(c_int64_t) :: clock(4)
    integer :: round

    do round = 1, 20
      call system_clock(clock(1))
      call mesh%create(indices, vertex_count, offsets, threads=1)
      call system_clock(clock(2))
      call mesh%normals(positions, normals, threads=1)
      call system_clock(clock(3))
      call mesh%curvatures(positions, found, threads=1)
      call system_clock(clock(4))
      print '(2(f0.6, a), f0.6)', milliseconds(clock(1), clock(2)), achar(9), milliseconds(clock(2), clock(3)), achar(9), &
        milliseconds(clock(3), clock(4))
      call mesh%destroy()
    end do
  end subroutine

  real(c_double) function milliseconds(from, until)
    integer(c_int64_t), intent(in) :: from, until
    integer(c_int64_t) :: rate
    call system_clock(count_rate=rate)
    milliseconds = 1e3_c_double * real(until - from, c_double) / real(rate, c_double)
  end function
end program

!> The files for ParaView of a run: bodies, joints and mode shapes of a stage, their pieces and their list. A stage with OUTPUT
!! = VTU has a file of the bodies and one of the joints, with STEPS after every increment, and one of the shapes of natural
!! modes. Several files of a kind have the list NAME.pvd. Bodies that are distributed over several processes are written in
!! pieces, one file for each process, with the index NAME.pvtu. All files stay unnamed until the whole run is complete.
module vtu_results
   use analysis_state, only: analysis_type
   use body_parts, only: all_shown
   use c_library, only: is_regular_file, read_all_bytes, remove_file
   use distribution, only: subdomain_output_type
   use incomplete_results, only: remove_old
   use kinds, only: wp
   use mode_values, only: modes_type
   use mesh_queries, only: n_points
   use model_data, only: model_type
   use output_file, only: output_file_type
   use restart_stream, only: restart_stream_type
   use result_page, only: label_type
   use stage_plan, only: stage_plan_type
   use text_tools, only: integer_text, real_text
   use vtu_file, only: piece_of, point_data, vtu_file_type, write_collection, write_index, xml_text
   use vtu_grids, only: write_bodies, write_joints, write_mesh
   implicit none
   private

   public :: start_vtu, write_vtu, write_modes, finish_vtu, discard_vtu, mark_vtu, return_to_mark_vtu, record_vtu, vtu_names, &
             is_vtu_ending, remove_old_vtu

   integer, parameter :: of_bodies = 0, of_joints = 1, of_modes = 2 ! parts of one time

   !> A file of the run, or its pieces.
   type :: part_type
      type(output_file_type), allocatable :: files(:)
      logical :: is_index = .false.               ! the files are pieces, and the name is that of their index
      logical :: is_indexed = .false.             ! the index has its name
      character(48) :: ending = ''                ! of its name
      real(wp) :: time = 0.0_wp                   ! number of its stage less one, plus the load fraction
      integer  :: part = of_bodies
   end type part_type

   type, public :: vtu_results_type
      private
      character(:), allocatable :: name           ! beginning of the names; empty: no files
      type(label_type) :: labels
      type(part_type), allocatable :: parts(:)
      integer :: n = 0
      integer :: n_kept = 0                       ! files up to the last mark
      logical :: many = .false.                   ! more than one stage, or every increment of one
      logical :: is_listed = .false.              ! the list has its name
      class(subdomain_output_type), allocatable :: subdomains ! allocated where the bodies are written in pieces
   end type vtu_results_type

contains

   !> NAME: beginning of the names of the files, folder included; empty: no files. SUBDOMAINS, if present, writes the bodies; it is
   !! moved into RESULTS.
   subroutine start_vtu(results, name, labels, plan, subdomains)
      type(vtu_results_type), intent(inout) :: results
      character(*), intent(in)              :: name
      type(label_type), intent(in)          :: labels
      type(stage_plan_type), intent(in)     :: plan
      class(subdomain_output_type), allocatable, intent(inout), optional :: subdomains
      integer :: most, s

      results%name = name
      results%labels = labels
      results%n = 0
      results%n_kept = 0
      results%is_listed = .false.
      results%many = size(plan%stages) > 1 .or. any(plan%stages%output%steps)
      if (allocated(results%subdomains)) deallocate (results%subdomains)
      if (present(subdomains)) call move_alloc(subdomains, results%subdomains)
      most = sum([(merge(size(plan%stages(s)%fractions), 1, plan%stages(s)%output%steps), s = 1, size(plan%stages))])
      if (allocated(results%parts)) deallocate (results%parts)
      allocate (results%parts(2*most + size(plan%stages)))
   end subroutine start_vtu

   !> Write the files of the increment just completed, where the stage asks for any.
   subroutine write_vtu(results, model, plan, analysis)
      type(vtu_results_type), intent(inout) :: results
      type(model_type), intent(in)          :: model
      type(stage_plan_type), intent(in)     :: plan
      type(analysis_type), intent(in)       :: analysis
      type(vtu_file_type) :: grid
      character(:), allocatable :: words
      real(wp) :: time

      associate (stage => plan%stages(analysis%stage))
         if (results%name == '' .or. .not. stage%output%vtu) return
         words = ''
         if (stage%output%steps) words = '.'//integer_text(analysis%increment)
         time = real(stage%id - 1, wp) + analysis%fraction
         if (model%mesh%n_elements > 0 .and. allocated(results%subdomains)) then
            call begin_part(results, stage%id, words//'.pvtu', time, of_bodies)
            call write_pieces(results, analysis)
         else if (model%mesh%n_elements > 0) then
            call begin_part(results, stage%id, words//'.vtu', time, of_bodies, grid)
            call write_bodies(grid, results%labels, model, all_shown(model), analysis%all_u, analysis%now%temperature)
            call end_part(results, grid)
         end if
         if (size(model%joints%element) == 0) return
         call begin_part(results, stage%id, words//'.joint.vtu', time, of_joints, grid)
         call write_joints(grid, results%labels, model, analysis)
         call end_part(results, grid)
      end associate
   end subroutine write_vtu

   !> Begin the next part of RESULTS in the stage with the number STAGE: one file, the GRID, or without it pieces.
   subroutine begin_part(results, stage, ending, time, part, grid)
      type(vtu_results_type), intent(inout) :: results
      integer, intent(in)                   :: stage, part
      character(*), intent(in)              :: ending !! of its name, behind the number of the stage where there are several
      real(wp), intent(in)                  :: time
      type(vtu_file_type), intent(inout), optional :: grid

      results%n = results%n + 1
      associate (next => results%parts(results%n))
         next = part_type()
         next%time = time
         next%part = part
         next%ending = ending
         if (results%many) next%ending = '.'//integer_text(stage)//ending
         next%is_index = .not. present(grid)
         if (next%is_index) allocate (next%files(results%subdomains%n))
         if (next%is_index) return
         allocate (next%files(1))
         call grid%start(path_of(results, results%n, 1))
      end associate
   end subroutine begin_part

   !> Complete the file of the present part of RESULTS, a GRID.
   subroutine end_part(results, grid)
      type(vtu_results_type), intent(inout) :: results
      type(vtu_file_type), intent(inout)    :: grid

      call grid%complete()
      results%parts(results%n)%files(1) = grid%file
      grid%file = output_file_type()
   end subroutine end_part

   !> The final path of file K of part I.
   pure function path_of(results, i, k) result(path)
      type(vtu_results_type), intent(in) :: results
      integer, intent(in)                :: i, k
      character(:), allocatable :: path

      associate (part => results%parts(i))
         path = results%name//trim(part%ending)
         if (part%is_index) path = piece_of(path, k - 1)
      end associate
   end function path_of

   !> Write all pieces of the present part, on the processes that hold them; none where one cannot be written.
   subroutine write_pieces(results, analysis)
      type(vtu_results_type), intent(inout) :: results
      type(analysis_type), intent(in)       :: analysis
      integer :: k, longest
      logical :: ok

      associate (files => results%parts(results%n)%files, labels => results%labels)
         longest = 0
         do k = 1, size(files)
            call files(k)%start(path_of(results, results%n, k))
            call files(k)%close()
            longest = max(longest, len(files(k)%part))
         end do
         ok = .not. any(files%fault)
         if (ok) then
            block
               character(longest) :: names(size(files))

               do k = 1, size(names)
                  names(k) = files(k)%part
               end do
               call results%subdomains%write(analysis%all_u, analysis%now%temperature, labels%length//labels%pressure, names, ok)
            end block
         end if
         if (.not. ok) then
            do k = 1, size(files)
               call files(k)%discard()
            end do
         end if
      end associate
   end subroutine write_pieces

   !> Write the file of the natural MODES about the end of the stage with this number: a nodal vector for each mode.
   subroutine write_modes(results, model, stage, modes)
      type(vtu_results_type), intent(inout) :: results
      type(model_type), intent(in)          :: model
      integer, intent(in)                   :: stage
      type(modes_type), intent(in)          :: modes
      type(vtu_file_type) :: grid
      real(wp), allocatable :: u(:, :)
      integer :: k

      if (results%name == '' .or. model%mesh%n_elements == 0) return
      call begin_part(results, stage, '.modes.vtu', real(stage, wp), of_modes, grid)
      call write_mesh(grid, model, all_shown(model))
      allocate (u(3, n_points(model%mesh)), source=0.0_wp)
      do k = 1, size(modes%modes)
         u(:model%mesh%dimension, :) = modes%modes(k)%u(:, :n_points(model%mesh))
         call grid%add(point_data, 'mode '//integer_text(modes%n_before + k)//', frequency '// &
                       real_text(modes%modes(k)%frequency), u)
      end do
      call end_part(results, grid)
   end subroutine write_modes

   !> Give all files their names, all or none: OK is false where a file could not be written.
   subroutine finish_vtu(results, ok)
      type(vtu_results_type), intent(inout) :: results
      logical, intent(out)                  :: ok
      character(:), allocatable :: base
      integer :: i, k

      ok = .true.
      do i = 1, results%n
         do k = 1, size(results%parts(i)%files)
            if (ok) call results%parts(i)%files(k)%finish(ok)
         end do
         associate (part => results%parts(i))
            if (ok .and. part%is_index) call write_index(results%name//trim(part%ending), size(part%files), part%is_indexed)
            ok = ok .and. (part%is_indexed .or. .not. part%is_index)
         end associate
      end do
      if (ok .and. results%many .and. results%n > 0) then
         base = results%name(index(results%name, '/', back=.true.) + 1:)
         associate (parts => results%parts(:results%n))
            call write_collection(results%name//'.pvd', parts%time, parts%part, base//parts%ending, ok)
         end associate
         results%is_listed = ok
      end if
      if (.not. ok) call discard_vtu(results)
   end subroutine finish_vtu

   !> The endings of the files, each after a comma; of many files only the list.
   pure function vtu_names(results) result(words)
      type(vtu_results_type), intent(in) :: results
      character(:), allocatable :: words
      integer :: i

      words = ''
      if (results%many .and. results%n > 0) words = ', .pvd'
      if (.not. results%many) then
         do i = 1, results%n
            words = words//', '//trim(results%parts(i)%ending)
         end do
      end if
   end function vtu_names

   !> Discard all files, even those that already have their names.
   subroutine discard_vtu(results)
      type(vtu_results_type), intent(inout) :: results
      integer :: i, k

      do i = 1, results%n
         associate (part => results%parts(i))
            do k = 1, size(part%files)
               call part%files(k)%discard()
               if (part%files(k)%is_named) call remove_file(path_of(results, i, k))
            end do
            if (part%is_indexed) call remove_file(results%name//trim(part%ending))
            part%is_indexed = .false.
         end associate
      end do
      if (results%is_listed) call remove_file(results%name//'.pvd')
      results%is_listed = .false.
      results%n = 0
   end subroutine discard_vtu

   !> Mark the files so far: a run that ends early keeps them.
   pure subroutine mark_vtu(results)
      type(vtu_results_type), intent(inout) :: results

      results%n_kept = results%n
   end subroutine mark_vtu

   !> Discard the files behind the mark, none of which has a name yet.
   subroutine return_to_mark_vtu(results)
      type(vtu_results_type), intent(inout) :: results
      integer :: i, k

      do i = results%n_kept + 1, results%n
         if (.not. allocated(results%parts(i)%files)) cycle
         do k = 1, size(results%parts(i)%files)
            call results%parts(i)%files(k)%discard()
         end do
      end do
      results%n = results%n_kept
   end subroutine return_to_mark_vtu

   !> Write the files so far to a restart file, or read them.
   subroutine record_vtu(results, stream)
      type(vtu_results_type), intent(inout)    :: results
      type(restart_stream_type), intent(inout) :: stream
      character(:), allocatable :: ending
      integer :: i, k, n, n_files

      n = results%n
      call stream%part('vtu_results_type', 1)
      call stream%item('n_kept', results%n_kept)
      call stream%extent('parts', n, 64)
      n = min(n, size(results%parts))
      do i = 1, n
         associate (part => results%parts(i))
            call stream%part('part_type', 1)
            ending = trim(part%ending)
            call stream%text('ending', ending)
            if (allocated(ending)) part%ending = ending
            call stream%item('time', part%time)
            call stream%item('part', part%part)
            call stream%item('is_index', part%is_index)
            n_files = 1
            if (allocated(part%files)) n_files = size(part%files)
            call stream%extent('files', n_files, 8)
            if (.not. stream%writes) then
               part%is_indexed = .false.
               if (allocated(part%files)) deallocate (part%files)
               allocate (part%files(n_files))
            end if
            do k = 1, n_files
               if (.not. stream%writes) call part%files(k)%start(path_of(results, i, k))
               call part%files(k)%record(stream)
               call part%files(k)%close()
            end do
         end associate
         results%n = max(results%n, i)
      end do
   end subroutine record_vtu

   !> Whether ENDING, behind the name of the deck, is that of a file for ParaView: .vtu, .pvtu and its pieces .p0.vtu, .p1.vtu and
   !! so on, .joint.vtu, .modes.vtu, all optionally preceded by the number of a stage, or of a stage and an increment; .pvd.
   pure logical function is_vtu_ending(ending)
      character(*), intent(in)  :: ending
      character(:), allocatable :: pattern ! the ending with 0 for every number
      integer :: k

      pattern = ''
      do k = 1, len(ending)
         if (scan(ending(k:k), '0123456789') == 0) then
            pattern = pattern//ending(k:k)
         else if (scan(ending(max(1, k - 1):k - 1), '0123456789') == 0) then
            pattern = pattern//'0'
         end if
      end do
      is_vtu_ending = pattern == '.pvd'
      do k = 1, 2
         if (index(pattern, '.0') == 1) pattern = pattern(3:)
      end do
      is_vtu_ending = is_vtu_ending .or. any(pattern == [character(10) :: '.vtu', '.pvtu', '.p0.vtu', '.joint.vtu', '.modes.vtu'])
   end function is_vtu_ending

   !> Remove the files of an earlier run: those without a number, and those in its lists.
   subroutine remove_old_vtu(name)
      character(*), intent(in) :: name

      call remove_old(name//'.vtu')
      call remove_old(name//'.joint.vtu')
      call remove_old(name//'.modes.vtu')
      call remove_list(name, '.pvtu', 'Source="')
      call remove_list(name, '.pvd', 'file="')
   end subroutine remove_old_vtu

   !> Remove the file of NAME with this ENDING, the files that it names behind MARK, and the pieces of those that are indexes.
   recursive subroutine remove_list(name, ending, mark)
      character(*), intent(in) :: name, ending, mark
      character(:), allocatable :: bytes, base, listed
      integer :: at, first
      logical :: ok

      if (.not. is_regular_file(name//ending)) return
      call read_all_bytes(name//ending, bytes, ok)
      if (.not. ok) return
      base = mark//xml_text(name(index(name, '/', back=.true.) + 1:))
      first = 1
      do
         at = index(bytes(first:), base)
         if (at == 0) exit
         first = first + at - 1 + len(base)
         listed = bytes(first:first + index(bytes(first:)//'"', '"') - 2)
         if (.not. is_vtu_ending(listed)) cycle
         if (ending == '.pvd' .and. index(listed, '.pvtu') > 0) call remove_list(name, listed, 'Source="')
         call remove_old(name//listed)
      end do
      call remove_old(name//ending)
   end subroutine remove_list

end module vtu_results

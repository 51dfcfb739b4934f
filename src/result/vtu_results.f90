!> Results for ParaView: for a stage with OUTPUT = VTU the bodies in one file and the joints in another, with STEPS after every
!! increment, the shapes of natural modes in a third; where there may be more than one of each their list NAME.pvd. All stay unnamed until the whole run is complete.
module vtu_results
   use analysis_state, only: analysis_type
   use c_library, only: is_regular_file, read_all_bytes, remove_file
   use incomplete_results, only: remove_old
   use kinds, only: wp
   use listing_table, only: label_type
   use mode_values, only: modes_type
   use model_data, only: model_type
   use restart_stream, only: restart_stream_type
   use stage_plan, only: stage_plan_type
   use text_tools, only: integer_text
   use vtu_bodies, only: write_bodies, write_shapes
   use vtu_file, only: vtu_file_type, write_collection, xml_text
   use vtu_joints, only: write_joints
   implicit none
   private

   public :: start_vtu, write_vtu, write_modes, finish_vtu, discard_vtu, record_vtu, remove_old_vtu, vtu_names, is_vtu_ending

   !> A file of the run.
   type :: part_type
      type(vtu_file_type) :: file
      character(48) :: ending = ''                ! of its name
      real(wp) :: time = 0.0_wp                   ! of its stage the number less one, and how much of its load is on
      integer  :: part = 0                        ! 0 the bodies, 1 the joints, 2 the natural modes
   end type part_type

   type, public :: vtu_results_type
      private
      character(:), allocatable :: name           ! files begin with it; empty: none are written
      type(label_type) :: labels
      type(part_type), allocatable :: parts(:)
      integer :: n = 0
      logical :: many = .false.                   ! more than one stage, or every increment of one
      logical :: is_listed = .false.              ! the list has its name
   end type vtu_results_type

contains

   !> NAME: what the names of the files begin with, folder included; empty: none are written.
   subroutine start_vtu(results, name, labels, plan)
      type(vtu_results_type), intent(inout) :: results
      character(*), intent(in)              :: name
      type(label_type), intent(in)          :: labels
      type(stage_plan_type), intent(in)     :: plan
      integer :: most, s

      results%name = name
      results%labels = labels
      results%n = 0
      results%is_listed = .false.
      results%many = size(plan%stages) > 1 .or. any(plan%stages%steps)
      most = 0
      do s = 1, size(plan%stages)
         most = most + merge(size(plan%stages(s)%shares), 1, plan%stages(s)%steps)
      end do
      if (allocated(results%parts)) deallocate (results%parts)
      allocate (results%parts(2*most + size(plan%stages)))
   end subroutine start_vtu

   !> Write the files of the increment just completed, where the stage asks for any.
   subroutine write_vtu(results, model, plan, analysis)
      type(vtu_results_type), intent(inout) :: results
      type(model_type), intent(in)          :: model
      type(stage_plan_type), intent(in)     :: plan
      type(analysis_type), intent(in)       :: analysis

      if (results%name == '' .or. .not. plan%stages(analysis%stage)%vtu) return
      if (model%n_elements > 0) then
         call open_next('.vtu', 0)
         call write_bodies(results%parts(results%n)%file, results%labels, model, analysis)
         call results%parts(results%n)%file%complete()
      end if
      if (size(model%interface) > 0) then
         call open_next('.joint.vtu', 1)
         call write_joints(results%parts(results%n)%file, results%labels, model, analysis)
         call results%parts(results%n)%file%complete()
      end if

   contains

      subroutine open_next(ending, part)
         character(*), intent(in) :: ending
         integer, intent(in)      :: part

         results%n = results%n + 1
         associate (next => results%parts(results%n), stage => plan%stages(analysis%stage))
            next%time = real(stage%id - 1, wp) + analysis%fraction
            next%part = part
            next%ending = ending
            if (stage%steps) next%ending = '.'//integer_text(analysis%increment)//next%ending
            if (results%many) next%ending = '.'//integer_text(stage%id)//next%ending
            call next%file%start(results%name//trim(next%ending))
         end associate
      end subroutine open_next

   end subroutine write_vtu

   !> Write the file of the natural MODES about the end of the stage with this number.
   subroutine write_modes(results, model, stage, modes)
      type(vtu_results_type), intent(inout) :: results
      type(model_type), intent(in)          :: model
      integer, intent(in)                   :: stage
      type(modes_type), intent(in)          :: modes

      if (results%name == '' .or. model%n_elements == 0) return
      results%n = results%n + 1
      associate (part => results%parts(results%n))
         part%time = real(stage, wp)
         part%part = 2
         part%ending = '.modes.vtu'
         if (results%many) part%ending = '.'//integer_text(stage)//part%ending
         call part%file%start(results%name//trim(part%ending))
         call write_shapes(part%file, model, modes)
         call part%file%complete()
      end associate
   end subroutine write_modes

   !> Give all files their names. All or none: OK is false where one could not be written.
   subroutine finish_vtu(results, ok)
      type(vtu_results_type), intent(inout) :: results
      logical, intent(out)                  :: ok
      character(:), allocatable :: base
      integer :: i

      ok = .true.
      do i = 1, results%n
         call results%parts(i)%file%finish(ok)
         if (.not. ok) exit
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

   !> The files by their endings, each behind a comma: of many their list alone.
   pure function vtu_names(results) result(words)
      type(vtu_results_type), intent(in) :: results
      character(:), allocatable :: words
      integer :: i

      words = ''
      if (results%many .and. results%n > 0) then
         words = ', .pvd'
      else
         do i = 1, results%n
            words = words//', '//trim(results%parts(i)%ending)
         end do
      end if
   end function vtu_names

   !> Leave nothing behind, files that have their names already included.
   subroutine discard_vtu(results)
      type(vtu_results_type), intent(inout) :: results
      integer :: i

      do i = 1, results%n
         call results%parts(i)%file%discard()
      end do
      if (results%is_listed) call remove_file(results%name//'.pvd')
      results%is_listed = .false.
      results%n = 0
   end subroutine discard_vtu

   !> Write the files so far to a restart file, or read them.
   subroutine record_vtu(results, stream)
      type(vtu_results_type), intent(inout)    :: results
      type(restart_stream_type), intent(inout) :: stream
      integer :: i, n

      call stream%mark('PARAVIEW')
      n = results%n
      call stream%count(n, 68)
      n = min(n, size(results%parts))
      do i = 1, n
         associate (part => results%parts(i))
            call stream%item(part%ending)
            call stream%item(part%time)
            call stream%item(part%part)
            call part%file%record(results%name//trim(part%ending), stream)
         end associate
         results%n = max(results%n, i)
      end do
   end subroutine record_vtu

   !> Whether a file of a deck may end so, behind the name of the deck: .vtu, .joint.vtu, both with the number of a stage before
   !! them, or of a stage and an increment; .pvd.
   pure logical function is_vtu_ending(ending)
      character(*), intent(in) :: ending
      integer :: first, k, length

      is_vtu_ending = ending == '.pvd'
      first = 1
      do k = 0, 2
         is_vtu_ending = is_vtu_ending .or. any(ending(first:) == [character(10) :: '.vtu', '.joint.vtu', '.modes.vtu'])
         if (is_vtu_ending .or. len(ending) < first + 2) return
         length = verify(ending(first + 1:), '0123456789') - 1
         if (ending(first:first) /= '.' .or. length < 1) return
         first = first + 1 + length
      end do
   end function is_vtu_ending

   !> Remove what an earlier run left: the files without a number, and those of its list.
   subroutine remove_old_vtu(name)
      character(*), intent(in) :: name
      character(*), parameter   :: mark = 'file="'
      character(:), allocatable :: bytes, base, ending
      integer :: at, first
      logical :: ok

      call remove_old(name//'.vtu')
      call remove_old(name//'.joint.vtu')
      call remove_old(name//'.modes.vtu')
      if (.not. is_regular_file(name//'.pvd')) return
      call read_all_bytes(name//'.pvd', bytes, ok)
      if (.not. ok) return
      base = mark//xml_text(name(index(name, '/', back=.true.) + 1:))
      first = 1
      do
         at = index(bytes(first:), base)
         if (at == 0) exit
         first = first + at - 1 + len(base)
         ending = bytes(first:first + index(bytes(first:)//'"', '"') - 2)
         if (is_vtu_ending(ending)) call remove_old(name//ending)
      end do
      call remove_old(name//'.pvd')
   end subroutine remove_old_vtu

end module vtu_results

!> Results for ParaView: for a stage with OUTPUT = VTU the bodies in one file and the interface elements in another, and where
!! there is more than one stage their list NAME.pvd. All stay unnamed until the whole run is complete.
module vtu_results
   use, intrinsic :: iso_fortran_env, only: int8
   use analysis_state, only: analysis_type
   use body_elements, only: node_stresses, whole_stress
   use c_library, only: remove_file
   use element_kinds, only: element_table
   use elasticity, only: max_stresses
   use interface_operator, only: at_first_end
   use kinds, only: wp
   use model_data, only: corners_of, has_gaps, model_type, n_points
   use normal_stiffness, only: branch_open
   use output_file, only: output_file_type
   use stage_plan, only: stage_plan_type
   use stress_measures, only: principal_stresses, von_mises
   use text_tools, only: integer_text
   use vtu_file, only: cell_data, point_data, vtk_vertex, vtu_file_type, write_collection, xml_text
   implicit none
   private

   public :: start_vtu, write_vtu, finish_vtu, discard_vtu, remove_old_vtu, is_vtu_ending

   integer, parameter :: most_old = 999 ! stages whose old files are looked for

   !> A file of the run.
   type :: part_type
      type(vtu_file_type) :: file
      character(24) :: ending = ''                ! of its name
      integer :: stage = 0
      integer :: part = 0                         ! of the stage: 0 the bodies, 1 the joint
   end type part_type

   type, public :: vtu_results_type
      private
      character(:), allocatable :: name           ! files begin with it; empty: none are written
      type(part_type), allocatable :: parts(:)
      integer :: n = 0
      logical :: many = .false.                   ! more than one stage
   end type vtu_results_type

contains

   !> NAME: what the names of the files begin with, folder included; empty: none are written.
   subroutine start_vtu(results, name, plan)
      type(vtu_results_type), intent(inout) :: results
      character(*), intent(in)              :: name
      type(stage_plan_type), intent(in)     :: plan

      results%name = name
      results%n = 0
      results%many = size(plan%stages) > 1
      if (allocated(results%parts)) deallocate (results%parts)
      allocate (results%parts(2*size(plan%stages)))
   end subroutine start_vtu

   !> Write the files of the stage just completed, where it asks for them.
   subroutine write_vtu(results, model, plan, analysis)
      type(vtu_results_type), intent(inout) :: results
      type(model_type), intent(in)          :: model
      type(stage_plan_type), intent(in)     :: plan
      type(analysis_type), intent(in)       :: analysis

      if (results%name == '' .or. .not. plan%stages(analysis%stage)%vtu) return
      if (model%n_elements > 0) then
         call open_next('.vtu', 0)
         call write_bodies(results%parts(results%n)%file, model, analysis)
      end if
      if (size(model%interface) > 0) then
         call open_next('.joint.vtu', 1)
         call write_joint(results%parts(results%n)%file, model, analysis)
      end if

   contains

      subroutine open_next(ending, part)
         character(*), intent(in) :: ending
         integer, intent(in)      :: part

         results%n = results%n + 1
         associate (next => results%parts(results%n))
            next%stage = plan%stages(analysis%stage)%id
            next%part = part
            next%ending = ending
            if (results%many) next%ending = '.'//integer_text(next%stage)//ending
            call next%file%start(results%name//trim(next%ending))
         end associate
      end subroutine open_next

   end subroutine write_vtu

   !> Elements with stresses at their centres, nodes with displacements and the mean of the stresses of its elements there.
   subroutine write_bodies(file, model, analysis)
      type(vtu_file_type), intent(inout) :: file
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(in)    :: analysis
      real(wp), allocatable :: u(:, :), at_node(:, :), at_centre(:, :), principal(:, :)
      integer, allocatable       :: connected(:), ends(:), properties(:)
      integer(int8), allocatable :: types(:)
      integer :: e, i, m, n

      m = n_points(model)
      allocate (u(3, m), source=0.0_wp)
      allocate (at_node(max_stresses, m), at_centre(max_stresses, model%n_elements), principal(3, model%n_elements))
      allocate (connected(count(model%element_nodes > 0)))
      allocate (ends(model%n_elements), types(model%n_elements), properties(model%n_elements))
      u(:model%dimension, :) = analysis%all_u(:, :m)
      n = 0
      do e = 1, model%n_elements
         associate (nodes => corners_of(model, e))
            connected(n + 1:n + size(nodes)) = nodes(element_table(model%element_kind(e))%vtk_nodes(:size(nodes)))
            n = n + size(nodes)
            ends(e) = n
            types(e) = int(element_table(model%element_kind(e))%vtk_type, int8)
            properties(e) = model%properties(model%element_property(e))%id
            at_centre(:, e) = whole_stress(model, e, analysis%all_u, analysis%temperature)
            principal(:, e) = principal_stresses(at_centre(:, e))
         end associate
      end do
      call node_stresses(model, analysis%all_u, analysis%temperature, at_node)
      call file%points(model%x(:, :m))
      call file%cells(connected, ends, types)
      call file%add(point_data, 'node', model%node_id(:m))
      call file%add(point_data, 'displacement', u)
      call file%add(point_data, 'stress', at_node)
      call file%add(point_data, 'von_mises', [(von_mises(at_node(:, i)), i = 1, m)])
      call file%add(cell_data, 'element', model%element_id)
      call file%add(cell_data, 'property', properties)
      call file%add(cell_data, 'stress_at_centre', at_centre)
      call file%add(cell_data, 'principal_stress', principal)
      call file%add(cell_data, 'von_mises_at_centre', [(von_mises(at_centre(:, e)), e = 1, model%n_elements)])
   end subroutine write_bodies

   !> A vertex for every interface element, at its node 1. BRANCH is 1 load, 2 unload, 3 open, 4 reload as in the chart; TAU the
   !! shear stress on side 2 in global axes; GAP, in decks with a JGAP, how far an open element is from touching now.
   subroutine write_joint(file, model, analysis)
      type(vtu_file_type), intent(inout) :: file
      type(model_type), intent(in)       :: model
      type(analysis_type), intent(in)    :: analysis
      real(wp), allocatable :: x(:, :), tau(:, :), u(:, :)
      integer :: i, n

      n = size(model%interface)
      allocate (x(3, n), tau(3, n))
      allocate (u(3, n), source=0.0_wp)
      do i = 1, n
         associate (element => model%interface(i))
            x(:, i) = at_first_end(element, model%x)
            u(:model%dimension, i) = at_first_end(element, analysis%all_u)
            tau(:, i) = matmul(element%axes(:, :2), analysis%states(i)%shear%tau)
         end associate
      end do
      call file%points(x)
      call file%cells([(i, i = 1, n)], [(i, i = 1, n)], [(vtk_vertex, i = 1, n)])
      call file%add(point_data, 'element', model%interface%id)
      call file%add(point_data, 'joint', model%joints(model%interface%joint)%id)
      call file%add(point_data, 'displacement', u)
      call file%add(point_data, 'lambda', analysis%states%normal%lambda)
      call file%add(point_data, 'p', analysis%states%normal%pressure)
      call file%add(point_data, 'branch', analysis%states%normal%branch)
      call file%add(point_data, 'tau', tau)
      call file%add(point_data, 'slip', merge(1, 0, analysis%states%slips))
      call file%add(point_data, 'area', model%interface%area)
      if (has_gaps(model)) call file%add(point_data, 'gap', merge(analysis%states%normal%lambda_b - analysis%states%normal%lambda, &
                                                                  0.0_wp, analysis%states%normal%branch == branch_open))
   end subroutine write_joint

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
            call write_collection(results%name//'.pvd', parts%stage, parts%part, base//parts%ending, ok)
         end associate
      end if
      if (.not. ok) call discard_vtu(results)
   end subroutine finish_vtu

   !> Leave nothing behind, files that have their names already included.
   subroutine discard_vtu(results)
      type(vtu_results_type), intent(inout) :: results
      integer :: i

      do i = 1, results%n
         call results%parts(i)%file%discard()
         call remove_file(results%name//trim(results%parts(i)%ending))
      end do
      if (results%n > 0) call remove_file(results%name//'.pvd')
      results%n = 0
   end subroutine discard_vtu

   !> Whether a file of a deck may end so, behind the name of the deck: .vtu, .joint.vtu, both with the number of a stage before
   !! them, .pvd.
   pure logical function is_vtu_ending(ending)
      character(*), intent(in) :: ending
      integer :: first

      is_vtu_ending = ending == '.vtu' .or. ending == '.joint.vtu' .or. ending == '.pvd'
      if (is_vtu_ending .or. len(ending) < 2) return
      if (ending(1:1) /= '.') return
      first = verify(ending(2:), '0123456789') + 1
      if (first > 2) is_vtu_ending = ending(first:) == '.vtu' .or. ending(first:) == '.joint.vtu'
   end function is_vtu_ending

   !> Remove what an earlier run left.
   subroutine remove_old_vtu(name)
      character(*), intent(in) :: name
      logical :: there
      integer :: k

      call remove_file(name//'.vtu')
      call remove_file(name//'.joint.vtu')
      inquire (file=name//'.pvd', exist=there)
      if (.not. there) return
      do k = 1, most_old
         call remove_file(name//'.'//integer_text(k)//'.vtu')
         call remove_file(name//'.'//integer_text(k)//'.joint.vtu')
      end do
      call remove_file(name//'.pvd')
   end subroutine remove_old_vtu

end module vtu_results

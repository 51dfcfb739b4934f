!> Displacement systems: nodes with CD have their unknowns along the directions of that system, so that supports and prescribed
!! displacements act along these.
module frame_build
   use coordinate_systems, only: directions_at
   use deck_check, only: checked_deck
   use kinds, only: wp
   use model_data, only: model_type
   use node_coupling, only: couple_node
   use system_build, only: find_system
   use text_tools, only: integer_text
   implicit none
   private

   public :: build_frames

contains

   !> Couple the nodes of MODEL that have a CD, and their twins of split surfaces, to unknowns along its directions.
   !! Errors: no such system; a node on the axis of a cylindrical or spherical one; directions out of the plane of a plane
   !! model.
   subroutine build_frames(deck, model)
      type(checked_deck), intent(in)  :: deck
      type(model_type), intent(inout) :: model
      real(wp) :: directions(3, 3)
      integer  :: i, node, system
      logical  :: ok

      do i = 1, size(deck%bulk%grid)
         associate (grid => deck%bulk%grid(i))
            if (grid%cd <= 0) cycle
            call find_system(deck, grid%line, 'CD', grid%cd, model%systems, system)
            node = model%node_table%find(grid%id)
            if (system == 0 .or. node == 0) cycle
            call directions_at(model%systems(system), model%x(:, node), directions, ok)
            if (.not. ok) call deck%field_error(grid%line, 'CD', 'the node lies on the axis of system '// &
               integer_text(grid%cd)//', where its first two directions are not defined')
            if (ok .and. model%dimension == 2) call check_plane_frame(deck, grid%line, directions, ok)
            if (.not. ok) cycle
            call turn_node(node)
            if (model%twin(node) > 0) call turn_node(model%twin(node))
         end associate
      end do

   contains

      subroutine turn_node(k)
         integer, intent(in) :: k

         if (.not. allocated(model%node_system)) allocate (model%node_system(model%n_nodes), source=0)
         if (model%node_system(k) > 0) return ! of a number given twice there is one node
         model%node_system(k) = system
         associate (d => model%dimension)
            call couple_node(model%coupling, model%n_nodes, k, [k], reshape(directions(:d, :d), [d, d, 1]))
         end associate
      end subroutine turn_node

   end subroutine build_frames

   !> The first two DIRECTIONS of a node lie in the plane of a plane model.
   subroutine check_plane_frame(deck, line, directions, ok)
      type(checked_deck), intent(in) :: deck
      integer, intent(in)            :: line
      real(wp), intent(in)           :: directions(3, 3)
      logical, intent(out)           :: ok

      ok = all(abs(directions(3, :2)) <= 1.0e-10_wp)
      if (.not. ok) call deck%field_error(line, 'CD', 'the first two directions of the system do not lie in the plane '// &
                                          'of the model, x-y')
   end subroutine check_plane_frame

end module frame_build

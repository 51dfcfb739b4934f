!> What holds the parts of the structure along the axes while gaps are open: supports and pressed interface elements. Where nothing
!! does, NEWTON takes the gaps of a part as closed at first.
module held_parts
   use interface_operator, only: nodes_of_end
   use joint_laws, only: element_state
   use kinds, only: wp
   use mesh_queries, only: n_points
   use model_data, only: model_type
   use tolerances, only: pressure_floor
   implicit none
   private

   public :: find_held_parts, is_needed

   real(wp), parameter :: along = 0.5_wp ! cosine of a normal and an axis from which on an element holds along the axis

contains

   !> Along which axes a part is held by supports or pressed by interface elements; the rigid base is behind the last part.
   pure function find_held_parts(model, states) result(rests)
      type(model_type), intent(in)    :: model
      type(element_state), intent(in) :: states(:)
      logical :: rests(model%mesh%dimension, model%freedoms%n_parts + 1)
      integer :: end, i, node

      rests = .false.
      rests(:, size(rests, 2)) = .true.
      do node = 1, n_points(model%mesh)
         associate (part => model%freedoms%part(node))
            rests(:, part) = rests(:, part) .or. model%freedoms%held(:, node)
         end associate
      end do
      do i = 1, size(states)
         if (states(i)%normal%pressure <= pressure_floor*states(i)%normal%p_av) cycle
         do end = 1, 2
            rests(:, part_at(model, i, end)) = rests(:, part_at(model, i, end)) .or. is_along(model, i)
         end do
      end do
   end function find_held_parts

   !> Whether one of the parts that open interface element I would press, given which parts REST along which axes, needs it to be held
   !! along its normal.
   pure logical function is_needed(model, rests, i)
      type(model_type), intent(in) :: model
      logical, intent(in)          :: rests(:, :) !! of find_held_parts
      integer, intent(in)          :: i

      is_needed = any(is_along(model, i) .and. .not. (rests(:, part_at(model, i, 1)) .and. rests(:, part_at(model, i, 2))))
   end function is_needed

   !> Which axes the normal of interface element I is near to.
   pure function is_along(model, i)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: i
      logical :: is_along(model%mesh%dimension)

      is_along = abs(model%joints%element(i)%axes(:model%mesh%dimension, 3)) > along
   end function is_along

   !> The part of the first node of END 1 or 2 of interface element I, or the rigid base.
   pure integer function part_at(model, i, end) result(part)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: i, end

      part = model%freedoms%n_parts + 1
      associate (nodes => nodes_of_end(model%joints%element(i), end))
         if (size(nodes) > 0) part = model%freedoms%part(nodes(1))
      end associate
   end function part_at

end module held_parts

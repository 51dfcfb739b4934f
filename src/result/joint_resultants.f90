!> What a joint transmits: its resultant and its largest pressure, and the planes of symmetry that cut it.
module joint_resultants
   use analysis_state, only: analysis_type, element_force
   use interface_operator, only: at_first_end, nodes_of_end
   use kinds, only: wp
   use model_data, only: joint_type, model_type
   use numbers, only: cross, first_largest
   use symmetry_planes, only: cut_type, planes_through, symmetry_plane
   use table_writer, only: noise
   use text_tools, only: above
   implicit none
   private

   public :: find_resultant, find_largest_pressure, joint_cut

   !> The force and moment of side 1 on side 2.
   type, public :: joint_resultant
      real(wp) :: normal = 0.0_wp           !! N: sum of the normal forces of the elements, compression positive [force]
      real(wp) :: across = 0.0_wp           !! total force along the mean normal of the joint [force]
      real(wp) :: along(2) = 0.0_wp         !! sums of the shear forces in the elements' own x and y [force]
      real(wp) :: shear(3) = 0.0_wp         !! the same as a vector, global axes [force]
      real(wp) :: force(3) = 0.0_wp         !! total, global axes [force]
      real(wp) :: moment(3) = 0.0_wp        !! about the centroid of the area, global axes [force x length]
   end type joint_resultant

contains

   !> The present resultant of JOINT.
   pure function find_resultant(model, analysis, joint) result(total)
      type(model_type), intent(in)    :: model
      type(analysis_type), intent(in) :: analysis
      type(joint_type), intent(in)    :: joint
      type(joint_resultant) :: total
      real(wp) :: force(3)
      integer  :: i

      do i = joint%first, joint%last
         associate (element => model%interface(i), state => analysis%states(i))
            force = element_force(element, state)
            total%force = total%force + force
            total%across = total%across + dot_product(force, joint%normal)
            total%moment = total%moment + cross(at_first_end(element, model%x) - joint%frame%centroid, force)
            total%normal = total%normal + state%normal%sumf
            total%along = total%along + state%shear%tau*element%area
            total%shear = total%shear + matmul(element%axes(:, :2), state%shear%tau*element%area)
         end associate
      end do
   end function find_resultant

   !> The largest PRESSURE in JOINT and its interface element AT, the first of several; both are 0 where none is pressed beyond
   !! rounding.
   pure subroutine find_largest_pressure(analysis, joint, pressure, at)
      type(analysis_type), intent(in) :: analysis
      type(joint_type), intent(in)    :: joint
      real(wp), intent(out)           :: pressure !! [pressure]
      integer, intent(out)            :: at       !! position

      associate (p => analysis%states(joint%first:joint%last)%normal%pressure)
         pressure = above(max(0.0_wp, maxval(p)), noise*analysis%largest_p)
         at = 0
         if (pressure > 0.0_wp) at = joint%first - 1 + first_largest(p, p > 0.0_wp)
      end associate
   end subroutine find_largest_pressure

   !> The PLANES of symmetry that cut JOINT.
   pure function joint_cut(model, planes, joint) result(cut)
      type(model_type), intent(in)     :: model
      type(symmetry_plane), intent(in) :: planes(:)
      type(joint_type), intent(in)     :: joint
      type(cut_type) :: cut
      integer, allocatable :: nodes(:)
      integer :: i, n

      if (size(planes) == 0) return
      allocate (nodes(sum(model%interface(joint%first:joint%last)%n_1)))
      n = 0
      do i = joint%first, joint%last
         associate (element => model%interface(i))
            nodes(n + 1:n + element%n_1) = nodes_of_end(element, 1)
            n = n + element%n_1
         end associate
      end do
      cut = planes_through(model, planes, nodes)
   end function joint_cut

end module joint_resultants

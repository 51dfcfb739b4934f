!> What a joint transmits: its resultant and its largest pressure, and the planes of symmetry that cut its bodies.
module joint_resultants
   use analysis_state, only: analysis_type, element_force
   use connected_bodies, only: number_parts
   use interface_operator, only: at_first_end
   use kinds, only: wp
   use model_data, only: joint_type, model_type
   use numbers, only: cross, first_largest
   use symmetry_planes, only: cut_by, cut_type, find_planes, parts_cut, symmetry_plane
   use table_writer, only: noise
   use text_tools, only: above
   implicit none
   private

   public :: find_resultant, find_largest_pressure, find_cuts

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

   !> The PLANES of symmetry of MODEL, and those that cut all bodies on both sides of each joint; a rigid base has no part in it.
   !! Bodies are parts that bolts do not connect.
   pure subroutine find_cuts(model, planes, cuts)
      type(model_type), intent(in)                   :: model
      type(symmetry_plane), allocatable, intent(out) :: planes(:)
      type(cut_type), allocatable, intent(out)       :: cuts(:) !! (joints)
      integer, allocatable :: part(:)
      logical, allocatable :: all_cut(:), of_part(:, :)
      integer :: i, j, k, n_parts

      call find_planes(model, planes)
      allocate (cuts(size(model%joints)))
      if (size(planes) == 0) return
      call number_parts(model, .false., part, n_parts)
      allocate (of_part, source=parts_cut(model, planes, part, n_parts))
      allocate (all_cut(size(planes)))
      do j = 1, size(cuts)
         all_cut = .true.
         do i = model%joints(j)%first, model%joints(j)%last
            associate (nodes => model%interface(i)%node)
               do k = 1, size(nodes)
                  all_cut = all_cut .and. of_part(part(nodes(k)), :)
               end do
            end associate
         end do
         cuts(j) = cut_by(planes, all_cut)
      end do
   end subroutine find_cuts

end module joint_resultants

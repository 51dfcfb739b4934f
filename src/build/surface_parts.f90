!> Parts of a marked surface that several JOINT cards name: the sides that face the other surface of each joint.
!! A side that faces two surfaces in part belongs to both parts; the mortar projection gives each joint the area that it covers.
module surface_parts
   use deck_check, only: checked_deck
   use kinds, only: wp
   use model_data, only: mesh_type, surface_type, whole_share
   use node_pairing, only: shares_facing, twice
   use surface_build, only: side_name
   use text_tools, only: integer_text
   implicit none
   private

   public :: divide_shared_surfaces, side_of_joint

contains

   !> Append the parts of all surfaces that several JOINT cards with two sides name. Error: a side that faces the surfaces of two
   !! joints at the same place.
   subroutine divide_shared_surfaces(deck, mesh)
      type(checked_deck), intent(in)  :: deck
      type(mesh_type), intent(inout) :: mesh
      real(wp), allocatable :: covered(:), share(:)
      integer :: j, k, o, s

      associate (cards => deck%bulk%joint)
         do s = 1, size(mesh%surfaces)
            if (count([(any(cards(j)%sides == mesh%surfaces(s)%id), j = 1, size(cards))]) < 2) cycle
            allocate (covered(mesh%surfaces(s)%n), share(mesh%surfaces(s)%n), source=0.0_wp)
            do j = 1, size(cards)
               k = findloc(cards(j)%sides, mesh%surfaces(s)%id, dim=1)
               if (k == 0 .or. any(cards(j)%sides == 0)) cycle
               o = side_of_joint(mesh, 0, cards(j)%sides(3 - k))
               if (o == 0) cycle ! reported elsewhere
               if (mesh%surfaces(o)%n == 0) cycle
               call shares_facing(mesh, mesh%surfaces(s), mesh%surfaces(o), cards(j)%tolerance, share)
               covered = covered + share
               o = findloc(covered > twice .and. share > 1.0_wp - whole_share, .true., dim=1)
               if (o > 0) then
                  call deck%field_error(cards(j)%line, 'SIDE'//integer_text(k), 'the '//side_name(mesh, &
                     mesh%surfaces(s)%nodes(:mesh%surfaces(s)%corners(o), o))//' of surface '//integer_text(mesh%surfaces(s)%id)// &
                     ' faces the other side of an earlier JOINT at the same place; expected joints beside each other')
                  exit
               end if
               if (all(share >= whole_share .or. share <= 1.0_wp - whole_share)) & ! rims that rounding leaves do not count
                  share = merge(share, 0.0_wp, share >= whole_share)
               if (any(share > 0.0_wp)) call append_part(mesh%surfaces, s, share > 0.0_wp, j)
            end do
            deallocate (covered, share)
         end do
      end associate
   end subroutine divide_shared_surfaces

   !> Append the sides of surface S that are MEANT, for JOINT card J.
   pure subroutine append_part(surfaces, s, meant, j)
      type(surface_type), allocatable, intent(inout) :: surfaces(:)
      integer, intent(in)                            :: s
      logical, intent(in)                            :: meant(:) !! (sides of surface S)
      integer, intent(in)                            :: j
      type(surface_type), allocatable :: longer(:)
      integer, allocatable :: kept(:)
      integer :: i

      allocate (longer(size(surfaces) + 1))
      longer(:size(surfaces)) = surfaces
      kept = pack([(i, i = 1, surfaces(s)%n)], meant)
      associate (whole => surfaces(s), part => longer(size(longer)))
         part%id = whole%id
         part%n = size(kept)
         part%corners = whole%corners(kept)
         part%n_nodes = whole%n_nodes(kept)
         part%nodes = whole%nodes(:, kept)
         part%element = whole%element(kept)
         part%other = whole%other(kept)
         part%strip = whole%strip(kept)
         part%line = whole%line(kept)
         part%joint = j
      end associate
      call move_alloc(longer, surfaces)
   end subroutine append_part

   !> The position of surface ID for JOINT card J: its part for this joint where it has one; 0: there is no such surface.
   pure integer function side_of_joint(mesh, j, id) result(s)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)         :: j, id

      s = findloc(mesh%surfaces%id == id .and. mesh%surfaces%joint == j, .true., dim=1)
      if (s == 0 .and. j > 0) s = findloc(mesh%surfaces%id, id, dim=1)
   end function side_of_joint

end module surface_parts

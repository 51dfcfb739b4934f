!> Which nodes of a face carry interface elements, and what each has of the face: the areas of influence of its nodes, the integrals
!! of the N_k, are shared out among the elements. Shares of a node add up to 1, so that the areas add up to that of the face.
!! Edges and linear faces: an element at every node. Faces with mid-side nodes: elements at these alone, because the areas of the
!! corners are zero or negative (0 and 1/3 of the triangle with 6 nodes; -1/12 and 1/3 of the quadrilateral with 8).
module face_shares
   use element_kinds, only: max_side_nodes
   use kinds, only: wp
   implicit none
   private

   public :: whole_shares, partial_shares

contains

   !> How many of the N nodes of a face are corners: the first ones.
   pure integer function n_corners(dimension, n)
      integer, intent(in) :: dimension !! of the model: 2, edges, or 3, faces
      integer, intent(in) :: n

      n_corners = n
      if (dimension == 2) n_corners = 2
      if (n > 4) n_corners = n/2
   end function n_corners

   !> Shares of a whole face: SHARE(i, k) is what the element at node i has of the area, the movement and the normal of node k.
   !! Elements at mid-side nodes have half of each corner beside them.
   pure function whole_shares(dimension, n) result(share)
      integer, intent(in) :: dimension !! of the model: 2, edges, or 3, faces
      integer, intent(in) :: n         !! nodes of the face
      real(wp) :: share(max_side_nodes, max_side_nodes)
      integer  :: corners, k

      share = 0.0_wp
      do k = 1, n
         share(k, k) = 1.0_wp
      end do
      corners = n_corners(dimension, n)
      if (dimension == 2 .or. n == corners) return
      do k = 1, corners
         share(k, k) = 0.0_wp
         share(corners + k, k) = 0.5_wp
         share(corners + k, modulo(k, corners) + 1) = 0.5_wp
      end do
   end function whole_shares

   !> Shares of a face of which only a part is covered: the element at node i has the function phi_i = sum of SHARE(i, k) N_k, none
   !! of which is negative on the face: N_i itself where that is linear; ((1-s)/2)^2, ((1+s)/2)^2 and (1-s^2)/2 on an edge with three
   !! nodes; (L1+L2)/2 of the sides of a triangle, (1-eta)/4 and so on of a quadrilateral. A sum of N_k, because all of them are
   !! polynomials that the N_k represent; the shares are their values at the nodes.
   pure function partial_shares(dimension, n) result(share)
      integer, intent(in) :: dimension, n !! as above
      real(wp) :: share(max_side_nodes, max_side_nodes)
      integer  :: corners, k, next

      share = whole_shares(dimension, n)
      if (dimension == 2) then
         if (n == 3) share(:3, 3) = [0.25_wp, 0.25_wp, 0.5_wp]
         return
      end if
      corners = n_corners(dimension, n)
      if (n == corners) return
      do k = 1, corners
         next = modulo(k, corners) + 1
         if (corners == 3) then              ! (L1 + L2)/2: 1/2 at its corners and between them, 1/4 on the other two sides
            share(4:6, corners + k) = 0.25_wp
            share(corners + k, corners + k) = 0.5_wp
         else                                ! (1 - eta)/4: 1/2 on its side, 1/4 on those beside it, 0 on the opposite one
            share(5:8, corners + k) = 0.25_wp
            share(corners + k, corners + k) = 0.5_wp
            share(corners + modulo(k + 1, 4) + 1, corners + k) = 0.0_wp
         end if
      end do
   end function partial_shares

end module face_shares

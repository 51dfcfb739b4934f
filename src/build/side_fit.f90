!> A joint between sides that do not match: for every face of SIDE1 the faces of SIDE2 that cover it are found, and what the
!! interface elements at its nodes hang on is fitted.
module side_fit
   use box_search, only: box_search_type
   use element_kinds, only: max_side_nodes
   use face_fit, only: face_part, fit_face
   use face_frames, only: face_frame, in_frame, make_frame
   use face_integrals, only: add_overlap, cover_integrals, own_face, start_integrals
   use face_overlap, only: plane_points, seen_area
   use facing_nodes, only: facing
   use id_table, only: id_table_type
   use interface_sums, only: interface_sums_type
   use kinds, only: wp
   use model_data, only: joint_cover, model_type, surface_type, whole_share
   use surface_build, only: side_influence, surface_node_list
   implicit none
   private

   public :: fit_side

   real(wp), parameter :: twice = 1.01_wp     ! share above which faces lie behind one another

   real(wp), parameter, public :: default_reach = 0.1_wp !! of the longest side of a face of SIDE1

   !> How well SIDE2 covers SIDE1, face by face.
   type, public :: side_cover
      type(joint_cover) :: cover             !! on the whole
      logical  :: is_any = .false.           !! whether anything is covered
      integer  :: double = 0                 !! a face of SIDE1 that is covered twice, 0: none
      real(wp) :: double_share = 0.0_wp      !! how often
      real(wp) :: reach = 0.0_wp             !! largest of the search [length]
      logical, allocatable :: partly(:)      !! (nodes of SIDE1) at a face that is covered in part
   end type side_cover

   !> The faces of SIDE2 as the search needs them.
   type :: opposite_faces
      type(box_search_type) :: boxes
      real(wp), allocatable :: normal(:, :)  ! (3, n) at their centres
      real(wp), allocatable :: area(:)       ! (n) as seen at right angles
      logical, allocatable  :: covers(:)     ! (n) something of SIDE1
   end type opposite_faces

contains

   !> What the elements at the NODES of SIDE1 hang on. REACH: the search along the normal, 0: the default.
   subroutine fit_side(model, side1, side2, nodes, reach, sums, found)
      type(model_type), intent(in)             :: model
      type(surface_type), intent(in)           :: side1, side2
      type(surface_node_list), intent(in)      :: nodes !! of SIDE1
      real(wp), intent(in)                     :: reach
      type(interface_sums_type), intent(inout) :: sums  !! empty
      type(side_cover), intent(out)            :: found
      type(opposite_faces)  :: opposite
      type(id_table_type)   :: place
      type(plane_points)    :: points
      type(cover_integrals) :: integrals
      type(face_part)       :: part
      type(own_face)        :: face
      real(wp) :: area(max_side_nodes), normal(3, max_side_nodes), share, all_area
      integer  :: elements(max_side_nodes), k, n, own_parts, s
      integer, allocatable :: near(:)

      found%cover%fitted = .true.
      found%cover%share = 0.0_wp
      call place%build(nodes%node)
      call sums%start(nodes%n, model%n_nodes)
      call list_opposite(model, side2, opposite)
      allocate (found%partly(nodes%n), source=.false.)
      allocate (near(0))
      all_area = 0.0_wp
      own_parts = 0
      do s = 1, side1%n
         n = side1%n_nodes(s)
         call side_influence(model, side1, s, area, normal)
         all_area = all_area + sum(area)
         call look_at(model, side1, s, reach, face)
         found%reach = max(found%reach, face%reach)
         call cover_face(model, side2, face, opposite, near, points, integrals)
         share = integrals%seen/max(seen_area(face%seen), tiny(1.0_wp))
         if (share > max(twice, found%double_share)) then
            found%double = s
            found%double_share = share
         end if
         if (integrals%seen <= 0.0_wp) cycle
         found%is_any = .true.
         own_parts = own_parts + n_parts(model%dimension, n)
         found%cover%spacing(1) = found%cover%spacing(1) + seen_area(face%seen)
         call fit_face(model%dimension, n, share >= whole_share, integrals, part)
         do k = 1, n
            elements(k) = place%find(side1%nodes(k, s))
            if (share < whole_share) found%partly(elements(k)) = .true.
         end do
         call sums%add_face(elements(:n), side1%nodes(:n, s), integrals%node(:integrals%n), part)
         found%cover%share = found%cover%share + merge(1.0_wp, share, share >= whole_share)*sum(area)
         found%cover%farthest = max(found%cover%farthest, integrals%farthest)
      end do
      call sums%finish()
      found%cover%share = found%cover%share/max(all_area, tiny(1.0_wp))
      found%cover%spacing(1) = found%cover%spacing(1)/max(1, own_parts)
      found%cover%spacing(2) = sum(opposite%area, mask=opposite%covers) &
                         /max(1, sum([(n_parts(model%dimension, side2%n_nodes(s)), s = 1, side2%n)], mask=opposite%covers))
   end subroutine fit_side

   !> As how many linear edges, or triangles, a face with N nodes counts where the fineness of meshes is compared.
   pure integer function n_parts(dimension, n)
      integer, intent(in) :: dimension, n

      n_parts = n - dimension + 1
   end function n_parts

   !> The faces of SIDE2 for the search.
   subroutine list_opposite(model, side2, opposite)
      type(model_type), intent(in)      :: model
      type(surface_type), intent(in)    :: side2
      type(opposite_faces), intent(out) :: opposite
      type(face_frame) :: frame
      real(wp), allocatable :: box(:, :, :)
      integer :: s

      allocate (box(3, 2, side2%n), opposite%normal(3, side2%n), opposite%area(side2%n))
      allocate (opposite%covers(side2%n), source=.false.)
      do s = 1, side2%n
         associate (x => model%x(:, side2%nodes(:side2%n_nodes(s), s)))
            box(:, 1, s) = minval(x, dim=2)
            box(:, 2, s) = maxval(x, dim=2)
            call make_frame(model%dimension, x, frame)
            opposite%area(s) = seen_area(in_frame(model%dimension, x, frame))
         end associate
         opposite%normal(:, s) = frame%axes(:, 3)
      end do
      call opposite%boxes%build(box)
   end subroutine list_opposite

   !> Face S of SIDE1 in its own frame.
   subroutine look_at(model, side1, s, reach, face)
      type(model_type), intent(in)   :: model
      type(surface_type), intent(in) :: side1
      integer, intent(in)            :: s
      real(wp), intent(in)           :: reach
      type(own_face), intent(out)    :: face
      real(wp) :: longest
      integer  :: corners, k, n

      n = side1%n_nodes(s)
      corners = side1%corners(s)
      associate (x => model%x(:, side1%nodes(:n, s)))
         call make_frame(model%dimension, x, face%frame)
         face%seen = in_frame(model%dimension, x, face%frame)
         longest = 0.0_wp
         do k = 1, corners
            longest = max(longest, norm2(x(:, modulo(k, corners) + 1) - x(:, k)))
         end do
      end associate
      face%on_ring = model%axisymmetric
      if (model%dimension == 2) face%thickness = model%properties(model%element_property(side1%element(s)))%thickness
      face%reach = merge(reach, default_reach*longest, reach > 0.0_wp)
   end subroutine look_at

   !> INTEGRALS over what SIDE2 covers of FACE.
   subroutine cover_face(model, side2, face, opposite, near, points, integrals)
      type(model_type), intent(in)         :: model
      type(surface_type), intent(in)       :: side2
      type(own_face), intent(in)           :: face
      type(opposite_faces), intent(inout)  :: opposite
      integer, allocatable, intent(inout)  :: near(:)
      type(plane_points), intent(inout)    :: points
      type(cover_integrals), intent(inout) :: integrals
      real(wp) :: low(3), high(3), before
      integer  :: d, i, n

      call start_integrals(integrals)
      do d = 1, 3
         associate (x => face%frame%centre(d) + matmul(face%frame%axes(d, :), face%seen%x(:, :face%seen%n)))
            low(d) = minval(x) - face%reach
            high(d) = maxval(x) + face%reach
         end associate
      end do
      call opposite%boxes%list_meeting(low, high, near, n)
      do i = 1, n
         associate (f => near(i))
            if (dot_product(opposite%normal(:, f), face%frame%axes(:, 3)) > facing) cycle
            before = integrals%seen
            associate (nodes => side2%nodes(:side2%n_nodes(f), f))
               call add_overlap(face, in_frame(model%dimension, model%x(:, nodes), face%frame), nodes, points, integrals)
            end associate
            if (integrals%seen > before) opposite%covers(f) = .true.
         end associate
      end do
   end subroutine cover_face

end module side_fit

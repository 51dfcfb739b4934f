!> Suggested cards (--joints) for joints that a deck may lack, and a support for a model without any. A JOINT is suggested
!! wherever outer sides of two bodies face each other, one for each plane or smooth surface of either body and each mark of the deck
!! there, with the marks of both sides. The support is for a flat underside.
module joint_suggestions
   use curved_faces, only: smooth
   use deck_input, only: deck_type
   use element_kinds, only: element_table
   use facing_bodies, only: body_type, body_words, box_words, facing_type, find_facing, gather_facing, list_bodies, &
                            list_outer_sides, outer_side, rounded
   use kinds, only: wp
   use lists, only: join, list_owners, root_of
   use model_data, only: mesh_type, model_type
   use output_file, only: output_file_type
   use text_tools, only: clean, integer_text, one_of, real_text, upper
   use tolerances, only: at_the_bottom, most_aside, parallel_in_mesh
   implicit none
   private

   public :: suggest_joints

   !> Numbers that are free in the deck, and the numbers of its cards that the suggestions name.
   type :: next_numbers
      integer :: element = 0, mark = 0, joint = 0, law = 1
   end type next_numbers

contains

   !> Print the suggestions for MODEL of DECK, which is named NAME, into FILE: cards in free format, and comments about them. Each
   !! pair of bodies has a joint, unless one connects them there. The numbers of new cards are above those of the deck.
   subroutine suggest_joints(name, deck, model, file)
      character(*), intent(in)              :: name
      type(deck_type), intent(in)           :: deck
      type(model_type), intent(in)          :: model
      type(output_file_type), intent(inout) :: file
      type(body_type), allocatable   :: bodies(:)
      type(outer_side), allocatable  :: sides(:)
      type(facing_type), allocatable :: pairs(:)
      type(next_numbers)   :: next
      character(1), parameter :: nl = new_line('a')
      integer, allocatable :: mark(:), own(:), patch(:), group(:), key(:, :)
      logical, allocatable :: on_side(:, :)
      integer  :: body(model%mesh%n_elements), first, i, k, marks(2), p
      logical  :: is_new(2), stands_apart
      real(wp) :: reach

      call list_bodies(model%mesh, body, bodies)
      call list_outer_sides(model%mesh, body, sides)
      call find_facing(model%mesh, sides)
      call find_marks(model, sides, mark)
      call find_patches(model%mesh, sides, patch)
      own = [(merge(0, mark(i), any(mark == mark(i) .and. sides%body == sides(i)%body .and. patch > 0 .and. patch /= patch(i))), &
              i = 1, size(sides))] ! without marks over several patches
      allocate (key(4, size(sides)), source=0) ! patch and mark of the body with the lower number, of the other one
      do i = 1, size(sides)
         k = sides(i)%sees
         if (k == 0) cycle
         key(:, i) = [patch(i), own(i), patch(k), own(k)]
         if (sides(i)%body > sides(k)%body) key(:, i) = key([3, 4, 1, 2], i)
      end do
      call gather_facing(sides, key, pairs, group)
      associate (bulk => deck%bulk)
         next%element = 1 + maxval([0, model%mesh%element_id, bulk%edge%id, bulk%element%id, bulk%rigid%id, &
                                    bulk%conrod%id, bulk%spring%id, bulk%mass%id, bulk%cjoint%id])
         next%mark = 1 + maxval([0, bulk%pmark%id, bulk%pshell%id, bulk%paxis%id, bulk%psolid%id, bulk%prod%id, &
                                 bulk%beam_property%id, bulk%spring_property%id])
         next%joint = 1 + maxval([0, bulk%joint%id])
         if (size(bulk%pjoint) > 0) next%law = bulk%pjoint(1)%id
      end associate
      call file%put('$ '//name//': '//integer_text(size(bodies))//' bodies')
      do i = 1, size(bodies)
         call file%put('$ '//body_words(i, bodies(i)))
      end do
      first = next%joint
      allocate (on_side(size(sides), 2))
      each_pair: do p = 1, size(pairs)
         associate (pair => pairs(p))
            call file%put('$')
            call file%put('$ bodies '//integer_text(pair%body(1))//' and '//integer_text(pair%body(2))//' face each other: '// &
               integer_text(pair%n(1))//' and '//integer_text(pair%n(2))//' sides, areas '//number(pair%area(1))//' and '// &
               number(pair%area(2))//', gap '//number(pair%gap(1))//' to '//number(pair%gap(2))// &
               ', normal '//box_words(pair%normal))
            do k = 1, 2 ! with the sides of a coarser mesh that are seen, but whose centres see no side of this group
               on_side(:, k) = sides%body == pair%body(k) .and. group == p
               if (k == 2) on_side(pack(sides%sees, group == p .and. sides%body == pair%body(1)), k) = .true.
            end do
            stands_apart = pair%gap(2) > most_aside*minval(sides%size, mask=on_side(:, 1))
            if (stands_apart .and. pair%n(2) == 0) then
               call file%put('$ only body '//integer_text(pair%body(1))//' has sides opposite to the other, apart: no JOINT')
               cycle
            end if
            do i = 1, size(deck%bulk%joint) ! a joint connects them there if its marks cover more than half of the area
               associate (joint => deck%bulk%joint(i))
                  do k = 1, 2
                     is_new(k) = sum(sides%area, mask=on_side(:, k) .and. mark > 0 .and. (mark == joint%sides(1) .or. &
                                 mark == joint%sides(2))) <= 0.5_wp*sum(sides%area, mask=on_side(:, k))
                  end do
                  if (any(is_new) .and. (joint%sides(2) /= 0 .or. all(is_new))) cycle
                  call file%put('$ JOINT '//integer_text(joint%id)//' of the deck connects them there')
                  cycle each_pair
               end associate
            end do
            do k = 1, 2
               call take_mark(deck, pack(own, on_side(:, k)), next, marks(k), is_new(k))
               if (is_new(k)) call file%put('PMARK,'//integer_text(marks(k)))
            end do
            reach = max(2.0_wp*pair%gap(2), 0.01_wp*minval(sides%size, mask=sides%body == pair%body(1))) ! TOL
            call file%put('JOINT,'//integer_text(next%joint)//','//integer_text(next%law)//','//integer_text(marks(1))//','// &
                          integer_text(marks(2))//','//number(reach))
            if (stands_apart) call file%put('JGAP,'//integer_text(next%joint)//',TRUE')
            next%joint = next%joint + 1
            do k = 1, 2
               if (is_new(k)) call put_sides(model, pack(sides, on_side(:, k)), marks(k), next, file)
            end do
         end associate
      end do each_pair
      if (size(pairs) == 0) call file%put('$ no sides of two bodies face each other within a tenth of the edge of a side')
      if (next%joint > first .and. all(deck%bulk%pjoint%id /= next%law)) call file%put_lines('$'//nl// &
         '$ PJOINT '//integer_text(next%law)//', the laws of these joints, is not in the deck; a published surface:'//nl// &
         '$ PJOINT,'//integer_text(next%law)//",9106,9106,9106"//nl//"$ INCLUDE 'surfaces/"// &
         one_of(upper(deck%control%force_unit) == 'KGF', 'mm_kgf', 'mm_n')//"/ground_on_ground.bdf'"//nl)
      if (size(deck%bulk%support) == 0) call suggest_support(deck, model, sides, mark, next, file)
   end subroutine suggest_joints

   !> The PATCH of each of SIDES that sees or is seen, 0: neither. Sides of a body are of one patch if they lie in one plane, or
   !! share an edge at which the surface is smooth.
   pure subroutine find_patches(mesh, sides, patch)
      type(mesh_type), intent(in)       :: mesh
      type(outer_side), intent(in)      :: sides(:)
      integer, allocatable, intent(out) :: patch(:)
      logical :: faces(size(sides))
      integer :: i, j, k

      faces = sides%sees > 0
      faces(pack(sides%sees, faces)) = .true.
      patch = [(i, i = 1, size(sides))]
      do i = 1, size(sides)
         if (.not. faces(i)) cycle
         do j = 1, i - 1
            associate (a => sides(i), b => sides(j))
               if (.not. faces(j) .or. a%body /= b%body .or. dot_product(a%normal, b%normal) < smooth) cycle
               if (count([(any(b%corners(:b%n) == a%corners(k)), k = 1, a%n)]) >= mesh%dimension - 1 .or. &
                   norm2(a%normal - b%normal) < parallel_in_mesh .and. &
                   abs(dot_product(a%centre - b%centre, b%normal)) < most_aside*(a%size + b%size)) call join(patch, i, j)
            end associate
         end do
      end do
      patch = [(merge(root_of(patch, i), 0, faces(i)), i = 1, size(sides))]
   end subroutine find_patches

   !> The MARK of the deck of each of SIDES, the last of several; 0: none.
   subroutine find_marks(model, sides, mark)
      type(model_type), intent(in)      :: model
      type(outer_side), intent(in)      :: sides(:)
      integer, allocatable, intent(out) :: mark(:)
      integer, allocatable :: first(:), owners(:)
      integer :: i, j, k, s

      allocate (mark(size(sides)), source=0)
      call list_owners(model%mesh%n_elements, reshape(sides%element, [1, size(sides)]), first, owners)
      do k = 1, size(model%mesh%surfaces)
         associate (surface => model%mesh%surfaces(k))
            do s = 1, surface%n
               do j = first(surface%element(s)), first(surface%element(s) + 1) - 1
                  i = owners(j)
                  if (surface%corners(s) /= sides(i)%n) cycle
                  if (same_side(surface%nodes(:sides(i)%n, s), sides(i))) mark(i) = surface%id
               end do
            end do
         end associate
      end do

   contains

      !> Whether SIDE has these CORNERS, or the opposite corners after a split, or the nodes of shells below them, in the same
      !! sense.
      pure logical function same_side(corners, side)
         integer, intent(in)          :: corners(:)
         type(outer_side), intent(in) :: side
         integer :: at, c, below(size(corners))

         below = corners
         if (size(model%mesh%face_of) > 0) then
            do c = 1, size(corners)
               if (model%mesh%face_of(corners(c)) > 0) below(c) = model%mesh%faces(model%mesh%face_of(corners(c)))%point
            end do
         end if
         same_side = .false.
         do at = 1, size(corners)
            same_side = same_side .or. all([(any([side%corners(c), model%mesh%duplicate(side%corners(c))] == &
                                                 below(1 + modulo(at + c - 2, size(corners)))), c = 1, size(corners))])
         end do
      end function same_side

   end subroutine find_marks

   !> The MARK for sides with the marks NOW: that of the deck if all of these sides and no others have it, otherwise a new one.
   subroutine take_mark(deck, now, next, mark, is_new)
      type(deck_type), intent(in)       :: deck
      integer, intent(in)               :: now(:)
      type(next_numbers), intent(inout) :: next
      integer, intent(out)              :: mark
      logical, intent(out)              :: is_new

      mark = now(1)
      is_new = mark == 0 .or. any(now /= mark) .or. all(deck%bulk%pmark%id /= mark)
      if (.not. is_new) return
      mark = next%mark
      next%mark = next%mark + 1
   end subroutine take_mark

   !> The cards of marked SIDES: CBAR edges in the plane, faces in space, with their mid-side nodes.
   subroutine put_sides(model, sides, mark, next, file)
      type(model_type), intent(in)          :: model
      type(outer_side), intent(in)          :: sides(:)
      integer, intent(in)                   :: mark
      type(next_numbers), intent(inout)     :: next
      type(output_file_type), intent(inout) :: file
      character(:), allocatable :: line
      integer, allocatable :: nodes(:)
      integer :: i, k

      do i = 1, size(sides)
         nodes = sides(i)%corners(:sides(i)%n)
         if (sides(i)%side > 0) then
            associate (kind => element_table(model%mesh%element_kind(sides(i)%element)), side => sides(i)%side)
               nodes = model%mesh%element_nodes(kind%side_nodes(:kind%side_size(side), side), sides(i)%element)
            end associate
         end if
         select case (sides(i)%n)
         case (2)
            line = 'CBAR'
         case (3)
            line = one_of(size(nodes) > 3, 'CTRIA6', 'CTRIA3')
         case default
            line = one_of(size(nodes) > 4, 'CQUAD8', 'CQUAD4')
         end select
         line = line//','//integer_text(next%element)//','//integer_text(mark)
         do k = 1, size(nodes)
            if (k == 7) line = line//new_line('a')//'+'
            line = line//','//integer_text(model%mesh%node_id(nodes(k)))
         end do
         call file%put_lines(line//new_line('a'))
         next%element = next%element + 1
      end do
   end subroutine put_sides

   !> A support for the flat sides at the lowest z (y in the plane) that face down and see no other body.
   subroutine suggest_support(deck, model, sides, mark, next, file)
      type(deck_type), intent(in)           :: deck
      type(model_type), intent(in)          :: model
      type(outer_side), intent(in)          :: sides(:)
      integer, intent(in)                   :: mark(:)
      type(next_numbers), intent(inout)     :: next
      type(output_file_type), intent(inout) :: file
      logical  :: lowest(size(sides)), is_new
      real(wp) :: extent
      integer  :: d, id

      d = model%mesh%dimension
      if (size(sides) == 0) return
      extent = maxval(sides%centre(d)) - minval(sides%centre(d))
      lowest = sides%centre(d) <= minval(sides%centre(d)) + at_the_bottom*extent .and. sides%normal(d) < -0.999_wp .and. &
               sides%sees == 0
      if (.not. any(lowest)) return
      call take_mark(deck, pack(mark, lowest), next, id, is_new)
      call file%put('$')
      call file%put('$ the model has no support; the lowest flat sides have an area of '//number(sum(sides%area, mask=lowest)))
      if (is_new) call file%put('PMARK,'//integer_text(id))
      call file%put('SPCM,1,'//one_of(d == 2, '12', '123')//','//integer_text(id))
      if (is_new) call put_sides(model, pack(sides, lowest), id, next, file)
   end subroutine suggest_support

   !> VALUE with three digits, as a real number of a card.
   pure function number(value) result(words)
      real(wp), intent(in)      :: value
      character(:), allocatable :: words

      words = real_text(rounded(clean(value)))
      if (scan(words, '.E') == 0) words = words//'.0'
   end function number

end module joint_suggestions

!> Checks of load cards against the model: missing nodes, surfaces and sets, directions that the model does not have.
module load_checks
   use bulk_data, only: bulk_data_type, has_component
   use deck_check, only: checked_deck
   use kinds, only: wp
   use model_data, only: model_type, supported
   use node_coupling, only: place_of_component
   use surface_build, only: find_surface
   use surface_sides, only: nodes_of
   use text_tools, only: integer_text
   implicit none
   private

   public :: check_surface_loads, check_displacements, check_combinations, check_plane, has_set

   character(*), parameter :: others = 'PLOAD4, PLOADE, PLOAD, PLOAD1, PLOAD2, PLOADM, FORCEM, GRAV or SPCD' ! the other load cards
   character(*), parameter, public :: nor_others = ', nor a '//others                 !! behind the text `there is no FORCE`

contains

   !> Whether any load card belongs to SET.
   pure logical function has_set(bulk, set)
      type(bulk_data_type), intent(in) :: bulk
      integer, intent(in)              :: set

      has_set = any(bulk%force%set == set) .or. any(bulk%pressure%set == set) .or. any(bulk%surface_load%set == set) .or. &
                any(bulk%gravity%set == set) .or. any(bulk%displacement%set == set) .or. any(bulk%beam_load%set == set)
   end function has_set

   !> Error: a z component of VECTOR in a plane model. It stands in N3 of the card on LINE, unless TURNED or ALONG.
   subroutine check_plane(deck, model, line, vector, along, turned)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      integer, intent(in)            :: line
      real(wp), intent(in)           :: vector(3) !! in global axes
      logical, intent(in), optional  :: along     !! whether it is the vector between two nodes, without field N3; default false
      logical, intent(in), optional  :: turned    !! whether it is given in system CID; default false
      real(wp), parameter :: rounding = 1.0e-12_wp
      character(:), allocatable :: field

      if (model%dimension == 3 .or. abs(vector(3)) <= rounding*norm2(vector)) return
      field = 'N3'
      if (present(turned)) then
         if (turned) field = 'CID'
      end if
      if (present(along)) then
         if (along) field = 'G1'
      end if
      if (field == 'N3') then
         call deck%field_error(line, field, 'not zero, but a plane model lies in x-y')
      else
         call deck%field_error(line, field, 'the load points out of the plane, but a plane model lies in x-y')
      end if
   end subroutine check_plane

   !> Errors of PLOADM and FORCEM: missing surfaces, and a pressure on a surface with bodies on both sides.
   subroutine check_surface_loads(deck, model)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      integer :: i, s

      do i = 1, size(deck%bulk%surface_load)
         associate (card => deck%bulk%surface_load(i))
            if (card%surface == 0) cycle
            call find_surface(deck, card%line, 'PID', card%surface, model, s)
            if (s == 0) cycle
            associate (surface => model%surfaces(s))
               if (card%is_pressure .and. (any(surface%other(:surface%n) > 0) .or. surface%was_split)) &
                  call deck%field_error(card%line, 'PID', 'bodies lie on both sides of surface '//integer_text(card%surface)// &
                                        ': the loaded body is ambiguous')
               if (model%axisymmetric .and. surface%n > 0 .and. all(abs(model%x(1, nodes_of(surface))) <= 0.0_wp)) &
                  call deck%field_error(card%line, 'PID', 'surface '//integer_text(card%surface)// &
                                        ' lies on the axis and has no area')
            end associate
            call check_plane(deck, model, card%line, card%force)
         end associate
      end do
   end subroutine check_surface_loads

   !> Error: an SPCD on a component that is not supported.
   subroutine check_displacements(deck, model)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      character(:), allocatable :: words
      logical :: held(model%dimension)
      integer :: d, i, node

      do i = 1, size(deck%bulk%displacement)
         associate (card => deck%bulk%displacement(i))
            node = model%node_table%find(card%node)
            if (node == 0) cycle
            do d = 1, 6
               if (.not. has_component(card%components, d)) cycle
               words = ''
               associate (place => place_of_component(model, node, d))
                  if (place%node == 0) then
                     words = ', expected 1 to '//integer_text(model%dimension)
                  else
                     held = supported(model, place%node)
                     if (.not. held(place%d)) words = ' of node '//integer_text(card%node)// &
                                                      ' is not supported: SPCD moves components that an SPC holds'
                  end if
               end associate
               if (words /= '') call deck%field_error(card%line, card%field + 1, 'component '//integer_text(d)//words, &
                                                      called='C')
            end do
         end associate
      end do
   end subroutine check_displacements

   !> Error: a LOAD card that combines missing sets.
   subroutine check_combinations(deck)
      type(checked_deck), intent(in) :: deck
      character(:), allocatable :: name
      integer :: i, k

      name = ''
      do i = 1, size(deck%bulk%load)
         associate (card => deck%bulk%load(i))
            do k = 1, size(card%sets)
               if (card%sets(k) <= 0 .or. has_set(deck%bulk, card%sets(k))) cycle
               if (any(deck%bulk%load%set == card%sets(k))) then
                  call deck%field_error(card%line, card%at(k), integer_text(card%sets(k))//' is a LOAD too; expected the '// &
                                        'sets of forces and pressures that it combines', called='L'//integer_text(k))
               else
                  call deck%field_error(card%line, card%at(k), 'there is no FORCE with set '//integer_text(card%sets(k))// &
                                        nor_others, called='L'//integer_text(k))
               end if
            end do
            if (.not. has_set(deck%bulk, card%set)) cycle
            name = others
            if (any(deck%bulk%force%set == card%set)) name = 'FORCE'
            call deck%field_error(card%line, 'SID', 'set '//integer_text(card%set)//' is that of a '//name// &
                                  ' too: case control is ambiguous')
         end associate
      end do
   end subroutine check_combinations

end module load_checks

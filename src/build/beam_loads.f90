!> Loads along beams, PLOAD1 and gravity: what the ends of each beam bear, and the forces and moments on its nodes.
module beam_loads
   use acceleration_fields, only: acceleration_at, acceleration_field
   use property_cards, only: load_types
   use beam_element, only: beam_axes, beam_length, beam_line_load, beam_nodal_forces, beam_point_load
   use bulk_data, only: beam_load_card
   use deck_check, only: checked_deck
   use kinds, only: wp
   use model_data, only: is_beam, model_type, own_nodes, stage_load_type
   use structural_elements, only: beam_ends, onto_own
   use text_tools, only: integer_text
   implicit none
   private

   public :: add_beam_gravity, add_beam_loads, check_beam_loads

contains

   !> Every PLOAD1 names a beam, and acts on it.
   subroutine check_beam_loads(deck, model)
      type(checked_deck), intent(in) :: deck
      type(model_type), intent(in)   :: model
      real(wp) :: length
      integer  :: e, i

      do i = 1, size(deck%bulk%beam_load)
         associate (card => deck%bulk%beam_load(i))
            e = beam_of(model, card)
            if (card%element > 0 .and. e == 0) call deck%field_error(card%line, 'EID', 'there is no beam '// &
               integer_text(card%element)//': no CBAR or CBEAM with a PBAR, PBARL, PBEAM or PBEAML')
            if (e == 0 .or. deck%errors%any()) cycle
            length = beam_length(model%structural%beams(model%structural%place(e)), beam_ends(model, e))
            if (.not. card%is_fraction .and. any(card%x > length*(1.0_wp + 1.0e-9_wp))) &
               call deck%field_error(card%line, 'X1', 'X1 or X2 lies beyond the end of the beam')
            if (model%dimension == 2 .and. card%kind <= 6 .and. any(load_types(card%kind) == ['FZ ', 'MX ', 'MY '])) &
               call deck%field_error(card%line, 'TYPE', trim(load_types(card%kind))//' in a plane model, which lies in x-y')
         end associate
      end do
   end subroutine check_beam_loads

   !> The beam that a CARD names; 0: there is none.
   pure integer function beam_of(model, card) result(e)
      type(model_type), intent(in)     :: model
      type(beam_load_card), intent(in) :: card

      e = findloc(model%element_id, card%element, dim=1)
      if (e == 0) return
      if (.not. is_beam(model, e)) e = 0
   end function beam_of

   !> Add FACTOR times the PLOAD1 of SET to LOADS, and the forces on nodes to FORCE.
   subroutine add_beam_loads(deck, model, set, factor, loads, force)
      type(checked_deck), intent(in)       :: deck
      type(model_type), intent(in)         :: model
      integer, intent(in)                  :: set
      real(wp), intent(in)                 :: factor
      type(stage_load_type), intent(inout) :: loads
      real(wp), intent(inout)              :: force(:, :) !! (3, n_nodes) [force]
      integer :: e, i

      do i = 1, size(deck%bulk%beam_load)
         if (deck%bulk%beam_load(i)%set /= set) cycle
         e = beam_of(model, deck%bulk%beam_load(i))
         if (e > 0) call add(model, e, factor*at_ends(model, e, deck%bulk%beam_load(i)), loads, force)
      end do
   end subroutine add_beam_loads

   !> What the ends of beam E bear of the load of CARD, in the axes of the beam.
   pure function at_ends(model, e, card) result(f)
      type(model_type), intent(in)     :: model
      integer, intent(in)              :: e
      type(beam_load_card), intent(in) :: card
      real(wp) :: f(12), axes(3, 3), q(6, 2), s(2), direction(3)
      integer  :: first, k

      associate (law => model%structural%beams(model%structural%place(e)), x => beam_ends(model, e))
         s = card%x
         if (.not. card%is_fraction) s = min(1.0_wp, s/beam_length(law, x))
         axes = beam_axes(law, x)
         direction = 0.0_wp
         direction(modulo(card%kind - 1, 3) + 1) = 1.0_wp
         if (card%kind > 6) direction = axes(:, modulo(card%kind - 1, 3) + 1)
         q = 0.0_wp
         first = merge(3, 0, modulo(card%kind - 1, 6) >= 3)
         do k = 1, 2
            q(first + 1:first + 3, k) = card%p(k)*direction
         end do
         if (s(2) > s(1)) then
            if (card%is_projected .and. card%kind <= 6) q = q*norm2(direction - dot_product(direction, axes(:, 1))*axes(:, 1))
            f = beam_line_load(law, x, q, s(1), s(2))
         else
            f = beam_point_load(law, x, q(:, 1), s(1))
         end if
      end associate
   end function at_ends

   !> What an acceleration FIELD makes on all beams: to LOADS what their ends bear, to FORCE what their nodes bear.
   subroutine add_beam_gravity(model, field, loads, force)
      type(model_type), intent(in)         :: model
      type(acceleration_field), intent(in) :: field
      type(stage_load_type), intent(inout) :: loads
      real(wp), intent(inout)              :: force(:, :) !! (3, n_nodes)
      real(wp) :: q(6, 2), x(3, 2)
      integer  :: e, end

      do e = 1, model%n_elements
         if (.not. is_beam(model, e)) cycle
         x = beam_ends(model, e)
         associate (law => model%structural%beams(model%structural%place(e)))
            q = 0.0_wp
            do end = 1, 2
               q(:3, end) = (law%rho*law%area + law%extra_mass)*acceleration_at(field, x(:, end) + law%offset(:, end))
            end do
            call add(model, e, beam_line_load(law, x, q, 0.0_wp, 1.0_wp), loads, force)
         end associate
      end do
   end subroutine add_beam_gravity

   !> Add what the ends of beam E bear, F, to LOADS, and what its nodes bear to FORCE.
   subroutine add(model, e, f, loads, force)
      type(model_type), intent(in)         :: model
      integer, intent(in)                  :: e
      real(wp), intent(in)                 :: f(12)
      type(stage_load_type), intent(inout) :: loads
      real(wp), intent(inout), optional    :: force(:, :)
      real(wp) :: own(model%dimension, 4)

      associate (place => model%structural%place(e), d => model%dimension)
         if (.not. allocated(loads%beam)) allocate (loads%beam(12, size(model%structural%beams)), source=0.0_wp)
         loads%beam(:, place) = loads%beam(:, place) + f
         if (.not. present(force)) return
         call onto_own(model, e, beam_nodal_forces(model%structural%beams(place), beam_ends(model, e), f), own)
         associate (nodes => own_nodes(model, e))
            force(:d, nodes) = force(:d, nodes) + own
         end associate
      end associate
   end subroutine add

end module beam_loads

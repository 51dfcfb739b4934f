!> The cards of distributed loads, gravity, prescribed displacements and bolts: PLOAD4, PLOADE, PLOADM, FORCEM, GRAV, SPCD, BOLT.
!! A table and a routine each.
module surface_load_cards
   use bulk_data, only: bulk_data_type
   use card_fields, only: card_values, check_direction, decode_card, field_error
   use card_lines, only: card_type
   use deck_errors, only: deck_error_list
   use field_rules, only: blank_field, component_field, field_rule, integer_field, real_field
   use kinds, only: wp
   implicit none
   private

   public :: read_pload4, read_ploade, read_ploadm, read_forcem, read_grav, read_spcd, read_bolt

contains

   !> PLOAD4: pressure on a face of a solid, positive into it: P1 at G1, P2 to P4 at the next corners as the right hand goes
   !! about the outward normal, where blank as P1. The face is named by G1 and, for CHEXA and CPENTA, the opposite corner G3; for
   !! CTETRA G4 is the corner that the face does not have.
   subroutine read_pload4(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)

      if (.not. allocated(table)) table = [integer_field('SID'), integer_field('EID'), real_field('P1'), &
         real_field('P2', default=0.0_wp), real_field('P3', default=0.0_wp), real_field('P4', default=0.0_wp), &
         integer_field('G1'), integer_field('G34', default=0)]
      call decode_card(card, table, .false., values, errors)
      bulk%n_pressure = bulk%n_pressure + 1
      associate (pressure => bulk%pressure(bulk%n_pressure))
         pressure%line = card%line
         pressure%on_face = .true.
         pressure%set = values%integers(1)
         pressure%first = values%integers(2)
         pressure%corners = values%integers(7:8)
         pressure%pressure = merge(values%reals(3:6), values%reals(3), values%given(3:6))
      end associate
   end subroutine read_pload4


   !> PLOADE: pressure on the edge G1-G2 of a plane or axisymmetric element, positive into the body.
   subroutine read_ploade(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)

      if (.not. allocated(table)) table = [integer_field('SID'), integer_field('EID'), real_field('P'), &
         integer_field('G1'), integer_field('G2')]
      call decode_card(card, table, .false., values, errors)
      bulk%n_pressure = bulk%n_pressure + 1
      associate (pressure => bulk%pressure(bulk%n_pressure))
         pressure%line = card%line
         pressure%set = values%integers(1)
         pressure%first = values%integers(2)
         pressure%corners = values%integers(4:5)
         pressure%pressure = values%reals(3)
      end associate
   end subroutine read_ploade


   !> PLOADM: pressure on a marked surface, positive into the body.
   subroutine read_ploadm(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)

      if (.not. allocated(table)) table = [integer_field('SID'), real_field('P'), integer_field('PID')]
      call decode_card(card, table, .false., values, errors)
      bulk%n_surface_load = bulk%n_surface_load + 1
      associate (load => bulk%surface_load(bulk%n_surface_load))
         load%line = card%line
         load%set = values%integers(1)
         load%is_pressure = .true.
         load%pressure = values%reals(2)
         load%surface = values%integers(3)
      end associate
   end subroutine read_ploadm


   !> FORCEM: a total force F (N1, N2, N3), spread evenly over a marked surface.
   subroutine read_forcem(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)

      if (.not. allocated(table)) table = [integer_field('SID'), real_field('F'), real_field('N1', default=0.0_wp), &
         real_field('N2', default=0.0_wp), real_field('N3', default=0.0_wp), integer_field('PID')]
      call decode_card(card, table, .false., values, errors)
      call check_direction(card, table, 3, 'the force', values, errors)
      bulk%n_surface_load = bulk%n_surface_load + 1
      associate (load => bulk%surface_load(bulk%n_surface_load))
         load%line = card%line
         load%set = values%integers(1)
         load%force = values%reals(2)*values%reals(3:5)
         load%surface = values%integers(6)
      end associate
   end subroutine read_forcem


   !> GRAV: acceleration A (N1, N2, N3) on all bodies, with RHO of MAT1.
   subroutine read_grav(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)

      if (.not. allocated(table)) table = [integer_field('SID'), blank_field('CID'), real_field('A'), &
         real_field('N1', default=0.0_wp), real_field('N2', default=0.0_wp), real_field('N3', default=0.0_wp)]
      call decode_card(card, table, .false., values, errors)
      call check_direction(card, table, 4, 'the acceleration', values, errors)
      bulk%n_gravity = bulk%n_gravity + 1
      associate (gravity => bulk%gravity(bulk%n_gravity))
         gravity%line = card%line
         gravity%set = values%integers(1)
         gravity%acceleration = values%reals(3)*values%reals(4:6)
      end associate
   end subroutine read_grav


   !> SPCD: displacements of held components, in a load set: the total at the end of the stage, as for forces.
   subroutine read_spcd(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)

      if (.not. allocated(table)) table = [integer_field('SID'), integer_field('G1'), component_field('C1'), real_field('D1'), &
         integer_field('G2', default=0), component_field('C2', default=0), real_field('D2', default=0.0_wp)]
      call decode_card(card, table, .false., values, errors)
      if (any(values%given(5:7)) .and. .not. all(values%given(5:6))) &
         call field_error(card, 5, 'G2: node, components C2 and displacement D2 go together', errors)
      call store(2)
      if (values%given(5)) call store(5)

   contains

      subroutine store(first)
         integer, intent(in) :: first

         bulk%n_displacement = bulk%n_displacement + 1
         associate (displacement => bulk%displacement(bulk%n_displacement))
            displacement%line = card%line
            displacement%set = values%integers(1)
            displacement%field = first
            displacement%node = values%integers(first)
            displacement%components = values%integers(first + 1)
            displacement%value = values%reals(first + 2)
         end associate
      end subroutine store

   end subroutine read_spcd


   !> BOLT: the CROD EID, or the solid cut at the surface PMARK, tightened to PRELOAD in SUBCASE STAGE and locked in the later
   !! ones.
   subroutine read_bolt(card, bulk, values, errors)
      type(card_type), intent(in)          :: card
      type(bulk_data_type), intent(inout)  :: bulk
      type(card_values), intent(inout)     :: values
      type(deck_error_list), intent(inout) :: errors
      type(field_rule), save, allocatable :: table(:)

      if (.not. allocated(table)) table = [integer_field('BID'), integer_field('EID', default=0), &
         real_field('PRELOAD', above=0.0_wp), integer_field('STAGE', default=1), integer_field('PMARK', default=0)]
      call decode_card(card, table, .false., values, errors)
      if (values%given(2) .and. values%given(5)) then
         call field_error(card, 5, 'PMARK: a bolt is a CROD, EID, or a solid cut at a surface, PMARK, not both', errors)
      else if (.not. (values%given(2) .or. values%given(5))) then
         call field_error(card, 2, 'EID: blank, expected a CROD, or in field 6 the PMARK at which a solid is cut', errors)
      end if
      bulk%n_bolt = bulk%n_bolt + 1
      associate (bolt => bulk%bolt(bulk%n_bolt))
         bolt%line = card%line
         bolt%id = values%integers(1)
         bolt%element = values%integers(2)
         bolt%preload = values%reals(3)
         bolt%stage = values%integers(4)
         bolt%surface = values%integers(5)
      end associate
   end subroutine read_bolt

end module surface_load_cards

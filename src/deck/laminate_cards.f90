!> Reads the cards of laminates and of materials without isotropy: PCOMP, PCOMPG, MAT2, MAT8 and MAT9.
module laminate_cards
   use bulk_data, only: bulk_data_type, ply_card
   use card_fields, only: card_fields_type
   use field_rules, only: at_least_1, not_negative, positive, real_range
   use kinds, only: wp
   use text_tools, only: integer_text
   implicit none
   private

   public :: read_laminate, read_plate_material, read_solid_material

contains

   !> MAT8: an orthotropic material in plane stress; blank moduli of transverse shear are rigid. MAT2: a matrix of plane stress. Of the
   !! strengths none has an effect.
   subroutine read_plate_material(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      real(wp) :: g(6), modulus(2), nu

      associate (material => bulk%mat1(card%i))
         material%name = card%name(:4)
         call card%field('MID', material%id)
         if (card%name == 'MAT8') then
            call card%field(['E1', 'E2'], modulus, positive)
            call card%field('NU12', nu)
            call card%field('G12', g(6), positive)
            call card%field(['G1Z', 'G2Z'], material%shear_moduli, not_negative, default=0.0_wp)
            call card%field('RHO', material%rho, not_negative, default=0.0_wp)
            call card%field(['A1', 'A2'], material%expansions(:2), default=0.0_wp)
            call card%field('TREF', material%reference, default=0.0_wp)
            call card%skip(['XT', 'XC', 'YT', 'YC', 'S '])
            call card%field('GE', material%damping, not_negative, default=0.0_wp)
            call card%skip(['F12 ', 'STRN'])
            call card%finish(material%line)
            if (card%is_faulty()) return
            if (nu**2*modulus(2) >= modulus(1)) call card%error('NU12', &
               'no material has it with these E1 and E2; expected NU12**2 below E1/E2')
            g(:5) = [modulus(1), nu*modulus(2), 0.0_wp, modulus(2), 0.0_wp]
            g(:5) = g(:5)/(1.0_wp - nu**2*modulus(2)/modulus(1))
         else
            call card%field(['G11', 'G12', 'G13', 'G22', 'G23', 'G33'], g, default=0.0_wp)
            call card%field('RHO', material%rho, not_negative, default=0.0_wp)
            call card%field(['A1 ', 'A2 ', 'A12'], material%expansions, default=0.0_wp)
            call card%field('TREF', material%reference, default=0.0_wp)
            call card%field('GE', material%damping, not_negative, default=0.0_wp)
            call card%skip(['ST   ', 'SC   ', 'SS   ', 'MCSID'])
            call card%finish(material%line)
            if (card%is_faulty()) return
            material%shear_moduli = [g(1), g(4)]
            modulus = [g(1), g(4)]
            nu = g(2)/max(g(4), tiny(1.0_wp))
            if (min(g(1), g(4)) <= 0.0_wp .or. g(2)**2 >= g(1)*g(4) .or. g(6) < 0.0_wp) call card%error('G11', &
               'no material has these; expected G11, G22 positive, G33 at least 0 and G12**2 below G11 G22')
         end if
         material%reference_given = card%given('TREF')
         material%stress = reshape([g(1), g(2), g(3), g(2), g(4), g(5), g(3), g(5), g(6)], [3, 3])
         material%e = modulus(2) ! across the fibres, as through the thickness
         material%nu = nu
         material%alpha = material%expansions(1)
         if (material%damping > 0.0_wp) call bulk%ignored%wait('GE of '//material%name, card%line, needs_response=.false.)
      end associate
   end subroutine read_plate_material

   !> MAT9: a material of solids by its matrix, upper triangle, in the order xx, yy, zz, xy, yz, zx.
   subroutine read_solid_material(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      character(3) :: names(21)
      real(wp) :: g(21), expansions(6)
      integer  :: i, j, n

      associate (material => bulk%mat1(card%i))
         material%name = 'MAT9'
         call card%field('MID', material%id)
         n = 0
         allocate (material%solid(6, 7), source=0.0_wp)
         do i = 1, 6
            do j = i, 6
               n = n + 1
               names(n) = 'G'//integer_text(i)//integer_text(j)
            end do
         end do
         call card%field(names, g, default=0.0_wp)
         call card%field('RHO', material%rho, not_negative, default=0.0_wp)
         call card%field(['A1', 'A2', 'A3', 'A4', 'A5', 'A6'], expansions, default=0.0_wp)
         call card%field('TREF', material%reference, default=0.0_wp)
         call card%field('GE', material%damping, not_negative, default=0.0_wp)
         call card%finish(material%line)
         n = 0
         do i = 1, 6
            do j = i, 6
               n = n + 1
               material%solid(i, j) = g(n)
               material%solid(j, i) = g(n)
            end do
         end do
         material%solid(:, 7) = expansions
         material%reference_given = card%given('TREF')
         if (material%damping > 0.0_wp) call bulk%ignored%wait('GE of MAT9', card%line, needs_response=.false.)
      end associate
   end subroutine read_solid_material

   !> PCOMP: a laminate, its plies from the lower face to the upper one; blank MID and T are those of the ply before. PCOMPG: the same
   !! with the numbers of the plies. Bonding strength and theory of failure have no effect.
   subroutine read_laminate(card, bulk)
      type(card_fields_type), intent(inout) :: card
      type(bulk_data_type), intent(inout)   :: bulk
      type(ply_card), allocatable :: plies(:)
      type(ply_card) :: ply
      character(8) :: word
      integer :: k, n, stride
      logical :: ok

      associate (property => bulk%pshell(card%i))
         property%name = card%name(:6)
         call card%field('PID', property%id)
         call card%field('Z0', property%lowest, default=huge(1.0_wp))
         call card%field('NSM', property%extra_mass, not_negative, default=0.0_wp)
         call card%skip(['SB', 'FT'])
         call card%field('TREF', property%reference, default=0.0_wp)
         call card%field('GE', property%damping, not_negative, default=0.0_wp)
         call card%word('LAM', '||SYM|', word)
         if (card%name == 'PCOMPG') call card%skip(['GPLYID'])
         call card%skip(['MID'])
         property%line = card%line
         stride = merge(8, 4, card%name == 'PCOMPG')
         allocate (plies(0))
         do k = 9, card%n, stride
            n = k + merge(1, 0, stride == 8)
            ply%id = size(plies) + 1
            if (stride == 8) call card%integer_at(k, 'GPLYID', ply%id, ok, at_least_1)
            if (card%text_at(n)//card%text_at(n + 1)//card%text_at(n + 2) == '') cycle
            if (card%text_at(n) /= '' .or. size(plies) == 0) call card%integer_at(n, 'MID', ply%material, ok, at_least_1)
            if (card%text_at(n + 1) /= '' .or. size(plies) == 0) call card%real_at(n + 1, 'T', ply%thickness, ok, positive)
            ply%at = n
            ply%angle = 0.0_wp
            if (card%text_at(n + 2) /= '') call card%real_at(n + 2, 'THETA', ply%angle, ok, real_range())
            ply%shown = card%text_at(n + 3) == 'YES'
            if (all(card%text_at(n + 3) /= ['   ', 'YES', 'NO '])) call card%wrong_entry(n + 3, 'SOUT', 'expected YES or NO')
            plies = [plies, ply]
         end do
         if (size(plies) == 0) then
            call card%error_at(9, 'no ply; expected MID, T and THETA of each ply')
            return
         end if
         if (word == 'SYM') then
            plies = [plies, plies(size(plies):1:-1)]
            plies%id = [(k, k = 1, size(plies))]
         end if
         property%plies = plies
         property%material = plies(1)%material
         property%material_at = plies(1)%at
         property%bending = property%material
         property%thickness = sum(plies%thickness)
         if (property%lowest >= huge(1.0_wp)) property%lowest = -0.5_wp*property%thickness
         property%fibre = [-0.5_wp, 0.5_wp]*property%thickness
         property%fibre_given = .true.
      end associate
   end subroutine read_laminate

end module laminate_cards

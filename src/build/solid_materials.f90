!> Materials of solids that are not isotropic: the matrix of a MAT9, turned from the axes of CORDM into those of the model.
!! The elements assemble a material that is orthotropic along x, y and z from nine numbers, any other one from all of [D].
module solid_materials
   use bulk_data, only: mat1_card, property_card
   use coordinate_systems, only: rectangular
   use deck_check, only: checked_deck
   use displacement_systems, only: find_system
   use elasticity, only: max_stresses, solid
   use kinds, only: wp
   use model_data, only: mesh_type, property_type
   use numbers, only: identity
   use text_tools, only: integer_text
   use tolerances, only: no_coupling
   implicit none
   private

   public :: take_solid_material, turned_stresses

   ! terms that are zero of a material that is orthotropic along the axes
   logical, parameter :: f = .false., t = .true.
   logical, parameter :: is_zero(max_stresses, max_stresses) = reshape([f, f, f, t, t, t, f, f, f, t, t, t, f, f, f, t, t, t, &
      t, t, t, f, t, t, t, t, t, t, f, t, t, t, t, t, t, f], [max_stresses, max_stresses])
   integer, parameter :: pair(2, max_stresses) = reshape([1, 1, 2, 2, 3, 3, 1, 2, 2, 3, 3, 1], [2, max_stresses])

contains

   !> Give PROPERTY the MATERIAL of its CARD, a MAT9. Errors: no PSOLID; a system that is not rectangular; a matrix that is not positive
   !! definite.
   subroutine take_solid_material(deck, mesh, card, material, property)
      type(checked_deck), intent(in)     :: deck
      type(mesh_type), intent(in)        :: mesh
      type(property_card), intent(in)    :: card
      type(mat1_card), intent(in)        :: material
      type(property_type), intent(inout) :: property
      real(wp) :: alpha(max_stresses), axes(3, 3), d(max_stresses, max_stresses), m(max_stresses, max_stresses)
      character(:), allocatable :: words
      integer :: i

      words = 'MAT9 '//integer_text(card%material)
      if (card%state /= solid) then
         call deck%field_error(card%line, card%material_at, words//' is for solids: PSOLID; expected a MAT1')
         return
      end if
      axes = identity
      if (card%system > 0) then
         call find_system(deck, card%line, 'CORDM', card%system, mesh%systems, i)
         if (i == 0) return
         if (mesh%systems(i)%kind /= rectangular) call deck%field_error(card%line, 'CORDM', integer_text(card%system)// &
            ' is not rectangular, but '//words//' has one direction everywhere')
         axes = mesh%systems(i)%axes
      end if
      if (card%system < 0) call deck%field_error(card%line, 'CORDM', '-1, the axes of the element; '//words// &
                                                 ' needs a rectangular system, or 0')
      m = turned_stresses(axes)
      d = matmul(matmul(m, material%solid(:, :6)), transpose(m))
      alpha = matmul(m, [material%solid(:3, 7), 0.5_wp*material%solid(4:, 7)]) ! tensor components turn as stresses
      alpha(4:) = 2.0_wp*alpha(4:)
      if (.not. modulus(d, 1) > 0.0_wp) then
         call deck%field_error(card%line, card%material_at, words//' is no material; expected a positive definite matrix')
         return
      end if
      property%is_coupled = any(abs(pack(d, is_zero)) > no_coupling*maxval(d)) .or. &
                            any(abs(alpha(4:)) > no_coupling*maxval(abs(alpha)))
      if (.not. property%is_coupled) where (is_zero) d = 0.0_wp
      property%e = sum([(modulus(d, i), i = 1, 3)])/3.0_wp ! the mean of the moduli along x, y and z
      property%nu = 0.0_wp
      property%alpha = alpha(maxloc(abs(alpha(:3)), dim=1))
      allocate (property%solid(max_stresses, 7))
      property%solid(:, :6) = d
      property%solid(:, 7) = alpha
   end subroutine take_solid_material

   !> The stress of unit strain in component C where the stresses of all other components are zero; 0 where [D] is not positive
   !! definite.
   pure real(wp) function modulus(d, c)
      real(wp), intent(in) :: d(:, :)
      integer, intent(in)  :: c
      real(wp) :: a(max_stresses, max_stresses)
      integer  :: i, k, order(max_stresses)

      order = [pack([(i, i = 1, max_stresses)], [(i /= c, i = 1, max_stresses)]), c]
      a = d(order, order)
      modulus = 0.0_wp
      do k = 1, max_stresses
         if (a(k, k) <= no_coupling*abs(d(order(k), order(k)))) return
         do i = k + 1, max_stresses
            a(i, k + 1:) = a(i, k + 1:) - a(i, k)/a(k, k)*a(k, k + 1:)
         end do
      end do
      modulus = a(max_stresses, max_stresses)
   end function modulus

   !> M: stresses xx, yy, zz, xy, yz, zx in the axes of the model from those along AXES, sigma = A sigma' A^T. A matrix [D'] becomes
   !! M [D'] M^T, because strains along AXES are M^T {epsilon}.
   pure function turned_stresses(axes) result(m)
      real(wp), intent(in) :: axes(3, 3)             !! unit vectors, one a column
      real(wp) :: m(max_stresses, max_stresses), s(3, 3)
      integer  :: c, i

      do c = 1, max_stresses
         s = 0.0_wp
         s(pair(1, c), pair(2, c)) = 1.0_wp
         s(pair(2, c), pair(1, c)) = 1.0_wp
         s = matmul(matmul(axes, s), transpose(axes))
         m(:, c) = [(s(pair(1, i), pair(2, i)), i = 1, max_stresses)]
      end do
   end function turned_stresses

end module solid_materials

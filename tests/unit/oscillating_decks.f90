!> Decks brought to oscillate, for tests of natural modes: chains of springs, columns; and all of their modes by LAPACK.
module oscillating_decks
   use blas_lapack, only: dsygv
   use deck_runs, only: run_lines, run_type
   use dense_structure, only: dense_bodies, dense_joints, dense_mass, free_rows
   use kinds, only: wp
   use model_data, only: model_type
   use oscillating_structure, only: oscillating_type, start_oscillation
   use text_tools, only: integer_text
   implicit none
   private

   public :: chain_deck, dense_modes, oscillate

   character(*), parameter, public :: two_columns = 'METHOD=NEWTON;SPC=1;SUBCASE 1;LOAD=10;BEGIN BULK;MAT1,1,9500.,,.25,2.-3;'// &
      'PSOLID,1,1;BLOCK3,1,1,2,2,4,0.,0.,0.;+,10.,10.,60.;+,,,,,20,21;BLOCK3,2,1,2,2,3,0.,0.,60.;+,10.,10.,100.,,,,101,101;+,,,,,22,23;'// &
      'PMARK,20;PMARK,21;PMARK,22;PMARK,23;SPCM,1,123,20;JOINT,7,1,21,22;PJOINT,1,3,4,4;JNORM,3,8.-3,.5,50.;JSHEAR,4,40.,2.;'// &
      'PLOADM,10,5.,23;ENDDATA' !! square columns with a joint between them, pressed; 225 unknowns, 198 of them free

   character(*), parameter, public :: short_columns = 'METHOD=NEWTON;SPC=1;SUBCASE 1;LOAD=10;BEGIN BULK;MAT1,1,9500.,,.25,2.-3;'// &
      'PSOLID,1,1;BLOCK3,1,1,1,1,2,0.,0.,0.;+,10.,10.,60.;+,,,,,20,21;BLOCK3,2,1,1,1,2,0.,0.,60.;+,10.,10.,100.,,,,101,101;+,,,,,22,23;'// &
      'PMARK,20;PMARK,21;PMARK,22;PMARK,23;SPCM,1,123,20;JOINT,7,1,21,22;PJOINT,1,3,4,4;JNORM,3,8.-3,.5,50.;JSHEAR,4,40.,2.;'// &
      'PLOADM,10,5.,23;ENDDATA' !! the same of few unknowns

contains

   !> N masses of 1/4 in a row along x, springs of 4 between them and before the first one; held at the ground.
   pure function chain_deck(n) result(lines)
      integer, intent(in) :: n
      character(:), allocatable :: lines, here, before
      integer :: i

      lines = 'SUBCASE 1;LOAD=10;BEGIN BULK;'
      do i = 1, n
         here = integer_text(i)
         if (i > 1) before = integer_text(1000 + i)//',4.,'//integer_text(i - 1)//',1,'//here//',1'
         if (i == 1) before = '1001,4.,1,1'
         lines = lines//'GRID,'//here//',,'//here//'.,0.,0.,,2;CELAS2,'//before//';CONM2,'//integer_text(2000 + i)//','//here// &
            ',,.25;'
      end do
      lines = lines//'FORCE,10,'//here//',,1.,1.;ENDDATA'
   end function chain_deck

   !> Run the deck with these LINES, and start its oscillation; masses of chains and all.
   subroutine oscillate(lines, run, structure, on_loading, lumped)
      character(*), intent(in)            :: lines
      type(run_type), intent(out)         :: run
      type(oscillating_type), intent(out) :: structure
      logical, intent(in), optional       :: on_loading, lumped !! false

      call run_lines(lines, run)
      if (run%problem /= '') error stop 'oscillating_decks: a deck is at fault'
      if (present(lumped)) run%model%mesh%lumped = lumped
      if (present(on_loading)) then
         call start_oscillation(run%model, run%analysis, run%system, on_loading, structure, run%failure)
      else
         call start_oscillation(run%model, run%analysis, run%system, .false., structure, run%failure)
      end if
   end subroutine oscillate

   !> All modes of MODEL, which has neither coupled nodes nor sections, with the stiffnesses K of its interface elements.
   subroutine dense_modes(model, k, lambda, shapes)
      type(model_type), intent(in)       :: model
      real(wp), intent(in)               :: k(:, :)      !! (3, interface elements), or 4 with k_sxy
      real(wp), allocatable, intent(out) :: lambda(:)    !! ascending
      real(wp), allocatable, intent(out) :: shapes(:, :) !! (free unknowns, modes) of mass 1
      real(wp), allocatable :: m(:, :), work(:), k_int(:, :, :)
      integer, allocatable  :: rows(:)
      integer :: c, i, info

      allocate (k_int(3, 3, size(k, 2)), source=0.0_wp)
      do i = 1, size(k, 2)
         do c = 1, 3
            k_int(c, c, i) = k(c, i)
         end do
         if (size(k, 1) == 3) cycle
         k_int(1, 2, i) = k(4, i)
         k_int(2, 1, i) = k(4, i)
      end do
      rows = free_rows(model)
      allocate (lambda(size(rows)), work(34*size(rows)))
      shapes = dense_bodies(model) + dense_joints(model, k_int)
      shapes = shapes(rows, rows)
      m = dense_mass(model)
      m = m(rows, rows)
      call dsygv(1, 'V', 'L', size(rows), shapes, size(rows), m, size(rows), lambda, work, size(work), info)
      if (info /= 0) error stop 'oscillating_decks: the mass is not positive definite'
   end subroutine dense_modes

end module oscillating_decks

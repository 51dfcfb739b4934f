!> The table of a backbone: frequency and loss of a mode over its amplitude, and where the joints lose it.
module listing_backbone
   use backbone, only: backbone_type
   use element_mapping, only: two_pi
   use kinds, only: wp
   use listing_table, only: column, listing_table_type, page_type
   use model_data, only: model_type
   use text_tools, only: clean, integer_text, upper
   implicit none
   private

   public :: list_backbone

   real(wp), parameter :: percent = 100.0_wp
   real(wp), parameter :: tiny_share = 1.0e-7_wp   ! of an amplitude, of a loss: rounding

contains

   !> FOUND, an amplitude a row, and what every joint has of the loss.
   subroutine list_backbone(page, model, found)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(backbone_type), intent(in) :: found
      type(listing_table_type) :: table
      real(wp) :: linear
      integer  :: i

      call page%file%put('')
      call page%file%put(' BACKBONE OF MODE '//integer_text(found%mode)//' ABOUT THE END OF '//page%stage// &
                         '   LOOPS UNDER +/- ALPHA [M] PHI, BY NEWTON')
      if (size(found%loops) > 0) then
         linear = sqrt(found%omega_squared)/two_pi
         call page%file%put('  AMPLITUDE: OF THE MODE AT NODE '//integer_text(model%node_id(found%node))// &
                            '; SHIFT: AGAINST THE FREQUENCY THAT MODES HAS FOUND; LOSS FACTOR: THAT OF THE JOINTS, TWICE ZETA')
         call table%start('FREQUENCY AND LOSS OVER AMPLITUDE', [column('AMPLITUDE', 'es14.5', page%labels%length), &
                          column('FREQUENCY', 'es14.5', '1/TIME'), column('SHIFT', 'f10.4', 'PERCENT'), &
                          column('LOSS FACTOR', 'es14.4'), column('SLIPPING', 'f10.2', 'PERCENT'), &
                          column('OPEN', 'f8.2', 'PERCENT'), column('CENTRE', 'f9.4'), column('NOT CLOSED', 'f12.6'), &
                          column('DISTORTION', 'f12.5'), column('LOOPS', 'i7')], page%file)
         do i = 1, size(found%loops)
            associate (loop => found%loops(i))
               call table%add([loop%q*found%peak, sqrt(loop%omega_squared)/two_pi])
               call table%add([clean(percent*(sqrt(loop%omega_squared)/(two_pi*linear) - 1.0_wp), percent*tiny_share)])
               call table%add([loop%loss, percent*loop%slipping, percent*loop%open])
               call table%add(clean([loop%centre, loop%gap, loop%distortion], tiny_share))
               call table%add([loop%n_loops])
               call table%print_row(page%file)
            end associate
         end do
         if (size(model%joints) > 1) call list_shares(page, model, found)
         if (allocated(found%answers)) call list_resonance(page, found)
      end if
      if (found%is_limited) then
         call page%file%put('  WARNING: LARGER AMPLITUDES ARE NOT BORNE; THE LAST ONE IS THAT OF THE LARGEST LOAD FOUND')
         call page%file%put('  '//upper(found%problem))
      else if (found%problem /= '') then
         call page%file%put('  WARNING: NO BACKBONE: '//upper(found%problem))
      end if
   end subroutine list_backbone

   !> Where the mode alone, of the backbone's frequency and loss, has its resonances under the load that oscillates.
   subroutine list_resonance(page, found)
      type(page_type), intent(inout)  :: page
      type(backbone_type), intent(in) :: found
      type(listing_table_type) :: table
      integer :: i

      call table%start('RESPONSE OF THIS MODE ALONE BY ITS BACKBONE: RESONANCES', &
                       [column('AMPLITUDE', 'es14.5', page%labels%length), column('FREQUENCY', 'es14.5', '1/TIME')], page%file)
      do i = 1, size(found%answers, 2)
         if (found%answers(3, i) > -90.0_wp .or. found%answers(5, i) < -90.0_wp) cycle
         call table%add(found%answers(1:2, i))
         call table%print_row(page%file)
      end do
      if (.not. any(found%answers(3, :) <= -90.0_wp)) call page%file%put( &
         '  NONE UP TO THE LARGEST AMPLITUDE: THE BRANCHES DO NOT MEET')
   end subroutine list_resonance

   !> What every joint has of the loss.
   subroutine list_shares(page, model, found)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      type(backbone_type), intent(in) :: found
      type(listing_table_type) :: table
      integer :: i, j

      call table%start('SHARE OF THE LOSS BY JOINT', [column('AMPLITUDE', 'es14.5', page%labels%length), column('JOINT', 'i11'), &
                                                      column('SHARE', 'f10.2', 'PERCENT')], page%file)
      do i = 1, size(found%loops)
         if (.not. found%loops(i)%loss > 0.0_wp) cycle
         do j = 1, size(model%joints)
            call table%add([found%loops(i)%q*found%peak])
            call table%add([model%joints(j)%id], [clean(percent*found%loops(i)%lost(j), tiny_share)])
            call table%print_row(page%file)
         end do
      end do
   end subroutine list_shares

end module listing_backbone

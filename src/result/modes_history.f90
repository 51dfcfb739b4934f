!> NAME.modes.csv: the natural modes of every stage that asks for them; NAME.modes.energy.csv: the shares of their strain energy. Both
!! in full precision; a field is empty where there is nothing to say.
module modes_history
   use csv_line, only: csv_line_type
   use kinds, only: wp
   use mode_values, only: modes_type
   use model_data, only: model_type
   use output_file, only: output_file_type
   use text_tools, only: above
   use vibration_plan, only: vibration_plan_type
   implicit none
   private

   real(wp), parameter :: no_mass = 1.0e-12_wp ! of the structure's: rounding

   public :: write_modes_header, write_modes, write_energies_header, write_energies

contains

   subroutine write_modes_header(file)
      type(output_file_type), intent(inout) :: file

      call file%put('stage,mode,frequency,omega,residual,mass_x,mass_y,mass_z,loss_factor')
   end subroutine write_modes_header

   !> The rows of STAGE, a mode each: effective masses are those of the mode; the loss factor where PLAN has losses.
   subroutine write_modes(file, stage, plan, modes)
      type(output_file_type), intent(inout) :: file
      integer, intent(in)                   :: stage !! its number
      type(vibration_plan_type), intent(in) :: plan
      type(modes_type), intent(in)          :: modes
      type(csv_line_type) :: line
      integer :: m

      do m = 1, size(modes%modes)
         associate (mode => modes%modes(m))
            line%length = 0
            call line%add([stage, modes%n_before + m])
            call line%add([mode%frequency, mode%omega, mode%residual])
            call line%add(above(mode%effective, no_mass*modes%mass))
            if (plan%has_losses .and. .not. mode%is_rigid) then
               call line%add([mode%loss])
            else
               call line%add('')
            end if
            call file%put(line%text(:line%length))
         end associate
      end do
   end subroutine write_modes

   subroutine write_energies_header(file)
      type(output_file_type), intent(inout) :: file

      call file%put('stage,mode,kind,id,normal,shear')
   end subroutine write_energies_header

   !> The rows of STAGE: what bodies and bars have stands under normal; a motion without strain has no rows.
   subroutine write_energies(file, stage, model, modes)
      type(output_file_type), intent(inout) :: file
      integer, intent(in)                   :: stage
      type(model_type), intent(in)          :: model
      type(modes_type), intent(in)          :: modes
      integer :: i, m

      do m = 1, size(modes%modes)
         if (modes%modes(m)%is_rigid) cycle
         associate (energy => modes%modes(m)%energy)
            do i = 1, size(energy%body)
               call put('BODY', i, [energy%body(i), 0.0_wp])
            end do
            do i = 1, size(energy%normal)
               call put('JOINT', model%joints(i)%id, [energy%normal(i), energy%shear(i)])
            end do
            do i = 1, size(energy%bar)
               call put('BAR', model%bars(i)%id, [energy%bar(i), 0.0_wp])
            end do
         end associate
      end do

   contains

      subroutine put(kind, id, shares)
         character(*), intent(in) :: kind
         integer, intent(in)      :: id
         real(wp), intent(in)     :: shares(2)
         type(csv_line_type) :: line

         line%length = 0
         call line%add([stage, modes%n_before + m])
         call line%add(kind)
         call line%add([id])
         call line%add(shares)
         call file%put(line%text(:line%length))
      end subroutine put

   end subroutine write_energies

end module modes_history

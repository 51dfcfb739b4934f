!> Parts of a structure in a mode: the one with most of the strain energy, and which modes a part or an effective mass selects.
!! A part is the solids and beams of a body, the shells of a body, a joint, or a bar. Bodies are numbered as find_bodies does.
module mode_parts
   use kinds, only: wp
   use mode_values, only: energy_type, mode_type
   use model_data, only: model_type, n_bars
   use numbers, only: first_largest
   use stage_entries, only: mode_filter
   implicit none
   private

   public :: main_part, is_selected

   real(wp), parameter :: least_share = 0.1_wp ! of the strain energy in the part that selects a mode
   real(wp), parameter :: percent = 100.0_wp

   type, public :: mode_part
      character(6) :: kind = ''       !! BODY, SHELLS, JOINT, BAR; '': no strain
      integer      :: id = 0          !! of the body, JID, EID
      real(wp)     :: share = 0.0_wp  !! of the strain energy of the mode [-]
   end type mode_part

contains

   !> The part of MODEL with most of the strain ENERGY of a mode, the first of almost equal ones.
   pure function main_part(model, energy) result(part)
      type(model_type), intent(in)  :: model
      type(energy_type), intent(in) :: energy !! shares
      type(mode_part) :: part
      type(mode_part) :: parts(2*size(energy%body) + size(energy%normal) + size(energy%bar))
      integer :: i

      parts = [(mode_part('BODY', i, energy%body(i) - energy%shell(i)), i = 1, size(energy%body)), &
               (mode_part('SHELLS', i, energy%shell(i)), i = 1, size(energy%shell)), &
               (mode_part('JOINT', model%joints%list(i)%id, energy%normal(i) + energy%shear(i)), i = 1, size(energy%normal)), &
               (mode_part('BAR', model%mesh%bars(i)%id, energy%bar(i)), i = 1, n_bars(model%mesh))]
      if (size(parts) == 0) return
      i = first_largest(parts%share)
      if (parts(i)%share > 0.0_wp) part = parts(i)
   end function main_part

   !> Whether FILTER selects MODE: by its effective mass along an axis, or by its energy in a part. Without a filter all modes are.
   pure logical function is_selected(model, filter, mass, mode)
      type(model_type), intent(in)  :: model
      type(mode_filter), intent(in) :: filter
      real(wp), intent(in)          :: mass !! of the structure
      type(mode_type), intent(in)   :: mode
      real(wp) :: share
      integer  :: i

      is_selected = .not. filter%is_given
      if (filter%least_mass > 0.0_wp) is_selected = any(percent*mode%effective >= filter%least_mass*mass)
      share = 0.0_wp
      select case (filter%kind)
      case ('BODY')
         share = mode%energy%body(filter%id)
      case ('SHELLS')
         share = mode%energy%shell(filter%id)
      case ('JOINT')
         i = findloc(model%joints%list%id, filter%id, dim=1)
         share = mode%energy%normal(i) + mode%energy%shear(i)
      end select
      is_selected = is_selected .or. share >= least_share
   end function is_selected

end module mode_parts

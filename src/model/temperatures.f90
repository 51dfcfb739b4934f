!> Temperatures of elements and nodes relative to the reference temperature TREF.
module temperatures
   use element_kinds, only: element_table
   use kinds, only: wp
   use mesh_queries, only: element_points, is_beam, is_shell, own_column
   use model_data, only: model_type, slope_row, temperature_type
   implicit none
   private

   public :: beam_slopes, element_rise, element_slope, temperature_between, has_temperatures, node_temperatures

contains

   !> T - TREF at the nodes of element E [temperature].
   pure function element_rise(model, e, temperature) result(rise)
      type(model_type), intent(in)       :: model
      integer, intent(in)                :: e
      type(temperature_type), intent(in) :: temperature
      real(wp) :: rise(element_table(model%mesh%element_kind(e))%n_nodes)

      rise = 0.0_wp
      if (.not. allocated(temperature%at)) return
      rise = temperature%at(element_points(model%mesh, e)) - temperature%reference_share* &
             model%mesh%properties(model%mesh%element_property(e))%reference
      if (.not. allocated(temperature%own)) return
      if (is_shell(model%mesh, e) .or. is_beam(model%mesh, e)) rise = rise + temperature%own(:size(rise), own_column(model%mesh, e))
   end function element_rise

   !> Gradient of T - TREF over the thickness of shell E [temperature/length].
   pure real(wp) function element_slope(model, e, temperature) result(slope)
      type(model_type), intent(in)       :: model
      integer, intent(in)                :: e
      type(temperature_type), intent(in) :: temperature

      slope = 0.0_wp
      if (allocated(temperature%own)) slope = temperature%own(slope_row, own_column(model%mesh, e))
   end function element_slope

   !> Gradients of T - TREF over the section of beam E, (end, along y or z) [temperature/length].
   pure function beam_slopes(model, e, temperature) result(slope)
      type(model_type), intent(in)       :: model
      integer, intent(in)                :: e
      type(temperature_type), intent(in) :: temperature
      real(wp) :: slope(2, 2)

      slope = 0.0_wp
      if (allocated(temperature%own)) slope = reshape(temperature%own(3:6, own_column(model%mesh, e)), [2, 2])
   end function beam_slopes

   !> Whether any stage of MODEL has temperatures.
   pure logical function has_temperatures(model)
      type(model_type), intent(in) :: model
      integer :: s

      has_temperatures = any([(allocated(model%history%stages(s)%temperature%at), s = 1, size(model%history%stages))])
   end function has_temperatures

   !> Nodal temperatures [temperature]. Where the deck gives none they are TREF; at a node between materials, the mean over its
   !! elements. During a stage that begins or ends without temperatures, TREF counts with the remaining share.
   pure function node_temperatures(model, temperature) result(t)
      type(model_type), intent(in)       :: model
      type(temperature_type), intent(in) :: temperature
      real(wp) :: t(model%mesh%n_nodes)
      integer  :: i

      t = 0.0_wp
      if (temperature%reference_share < 1.0_wp) then
         do i = 1, model%mesh%n_nodes
            associate (elements => model%mesh%elements_at(model%mesh%first_at(i):model%mesh%first_at(i + 1) - 1))
               if (size(elements) > 0) t(i) = (1.0_wp - temperature%reference_share)* &
                  sum(model%mesh%properties(model%mesh%element_property(elements))%reference)/size(elements)
            end associate
         end do
      end if
      if (allocated(temperature%at)) t = t + temperature%at
   end function node_temperatures

   !> The temperatures at a FRACTION of the way from BEFORE to AFTER, linear in between.
   pure function temperature_between(before, after, fraction) result(now)
      type(temperature_type), intent(in) :: before, after
      real(wp), intent(in)               :: fraction !! [-], 0 to 1
      type(temperature_type) :: now

      if (fraction >= 1.0_wp) then
         now = after
         return
      end if
      now%reference_share = before%reference_share + fraction*(after%reference_share - before%reference_share)
      if (allocated(before%at)) now%at = (1.0_wp - fraction)*before%at
      if (allocated(before%own)) now%own = (1.0_wp - fraction)*before%own
      if (allocated(after%at)) then
         if (.not. allocated(now%at)) now%at = 0.0_wp*after%at
         now%at = now%at + fraction*after%at
      end if
      if (allocated(after%own)) then
         if (.not. allocated(now%own)) now%own = 0.0_wp*after%own
         now%own = now%own + fraction*after%own
      end if
   end function temperature_between

end module temperatures
